/* `restitute bench --stability`: cell after cell into PREFIX-stability.csv.partial, whose first line tells the
 * settings. SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "figures.h"
#include "gnuplot.h"
#include "tables.h"
#include "unfinished.h"

enum { places = MAP_DECADES * MAP_DECADES, most_cells = places * MAP_LEVELS * BENCH_METHODS };

struct map {
    const struct bench_settings *settings;
    struct bench_cell *cells; /* in the order in which they are made */
    size_t count, done;       /* done: of an interrupted run */
    int levels;
    struct unfinished partial;
};

static void write_map(const void *context, FILE *stream)
{
    const struct map *map = context;
    bench_write_map_header(stream);
    for (size_t i = 0; i < map->count; i++)
        bench_write_cell(&map->cells[i], stream);
}

/* A quick map has every fourth decade. */
static bool wanted(const struct map *map, int place)
{
    return !map->settings->quick || (place / MAP_DECADES % 4 == 0 && place % MAP_DECADES % 4 == 0);
}

static void settings_line(const struct map *map, char *line, size_t size)
{
    const struct bench_plan *plan = &map->settings->plan;
    size_t used = (size_t)snprintf(line, size, "# restitute %s, budget %g s, quick %d, methods", restitute_version(),
                                   plan->budget, map->settings->quick);
    for (int m = 0; m < BENCH_METHODS && used < size; m++)
        if (plan->methods & 1u << m) used += (size_t)snprintf(line + used, size - used, " %s", bench_methods[m].name);
    if (used < size) snprintf(line + used, size - used, "\n");
}

/* Cells of an interrupted run with the same settings. A last line without its end was not written whole and is done
 * again. */
static bool read_partial(struct map *map, struct reason *why)
{
    char expected[256], line[512];
    FILE *stream = fopen(map->partial.path, "r");
    if (!stream) return refuse(why, "%.200s: %s", map->partial.path, strerror(errno));
    settings_line(map, expected, sizeof expected);
    bool good = fgets(line, sizeof line, stream) && strcmp(line, expected) == 0;
    if (!good) refuse(why, "--resume: %.200s is of a run with other settings", map->partial.path);
    while (good && fgets(line, sizeof line, stream) && strchr(line, '\n')) {
        if (map->done < most_cells && bench_read_cell(line, &map->cells[map->done]))
            map->done++;
        else
            good = refuse(why, "--resume: %.200s line %zu: is no cell of a map", map->partial.path, map->done + 2);
    }
    fclose(stream);
    return good;
}

static bool open_partial(struct map *map, struct reason *why)
{
    struct output line;
    char text[256];
    if (!map->settings->output) return true;
    char *path = path_with_suffix(map->settings->output, "-stability.csv");
    bool good = unfinished_open(path, map->settings->resume, &map->partial, why);
    free(path);
    if (good && !map->partial.empty) good = read_partial(map, why) && unfinished_cut(&map->partial, why);
    if (!good || !map->partial.empty) return good;
    settings_line(map, text, sizeof text);
    if (!output_open(NULL, &line, why)) return false;
    fputs(text, line.stream);
    return unfinished_append(&map->partial, &line, why);
}

static bool append(struct map *map, const struct bench_cell *cell, struct reason *why)
{
    struct output line;
    if (!map->partial.path) return true;
    if (!output_open(NULL, &line, why)) return false;
    bench_write_cell(cell, line.stream);
    return unfinished_append(&map->partial, &line, why);
}

/* The levels of one method at one place; cells that are done are passed over. */
static bool fill_column(struct map *map, const struct bench_scene *scene, int method, struct reason *why)
{
    for (int level = 0; level < map->levels && !bench_interrupted(); level++) {
        struct bench_cell *cell = &map->cells[map->count];
        if (map->count < map->done) {
            const bool same = cell->method == method && cell->steps == bench_map_steps(level) &&
                              fabs(cell->delta1 / scene->delta1 - 1) < 1e-5 &&
                              fabs(cell->gamma / scene->gamma - 1) < 1e-5;
            if (!same) return refuse(why, "%.200s line %zu: is not of this map", map->partial.path, map->count + 2);
        } else {
            if (bench_map_cell(scene, method, level, map->settings->plan.budget, level ? cell - 1 : NULL, cell))
                return refuse(why, "out of memory");
            if (!append(map, cell, why)) return false;
        }
        map->count++;
    }
    return true;
}

static int methods_of(const struct map *map)
{
    int n = 0;
    for (int m = 0; m < BENCH_METHODS; m++)
        n += (map->settings->plan.methods & 1u << m) != 0;
    return n;
}

static bool fill_map(struct map *map, struct reason *why)
{
    const size_t per_place = (size_t)(map->levels * methods_of(map));
    for (int place = 0; place < places && !bench_interrupted(); place++) {
        struct bench_scene scene;
        char text[80];
        if (!wanted(map, place)) continue;
        snprintf(text, sizeof text, "place %d of %d of the map", place + 1, places);
        bench_progress(text);
        bench_map_scene(place, map->count + per_place <= map->done ? 1 : map->settings->quick, &scene);
        for (int m = 0; m < BENCH_METHODS; m++)
            if (map->settings->plan.methods & 1u << m && !fill_column(map, &scene, m, why)) return false;
    }
    bench_progress(NULL);
    return true;
}

static bool draw(const struct map *map, struct reason *why)
{
    struct gnuplot gnuplot;
    int width, height;
    const unsigned methods = map->settings->plan.methods;
    if (!map->settings->figure) return true;
    bench_size_map(methods, map->levels, &width, &height);
    if (!gnuplot_open(map->settings->figure, width, height, &gnuplot, why)) return false;
    bench_draw_map(map->cells, map->count, methods, map->levels, gnuplot.commands);
    return gnuplot_close(&gnuplot, why);
}

static bool report(struct map *map, struct reason *why)
{
    if (!bench_write_table(map->settings, "stability", write_map, map, why) || !draw(map, why)) return false;
    unfinished_remove(&map->partial);
    bench_print_map(map->cells, map->count, stdout);
    return true;
}

int bench_map_run(const struct bench_settings *settings)
{
    struct map map = {.settings = settings, .levels = settings->quick ? 3 : MAP_LEVELS};
    struct reason why;
    map.cells = allocate(most_cells, sizeof *map.cells);
    const bool good = open_partial(&map, &why) && fill_map(&map, &why) && (bench_interrupted() || report(&map, &why));
    unfinished_leave(&map.partial);
    free(map.cells);
    if (!good) return complain("%s", why.text);
    if (!bench_interrupted()) return EXIT_DONE;
    complain("interrupted%s", settings->output ? ": continue with --resume" : "");
    return EXIT_INTERRUPTED;
}
