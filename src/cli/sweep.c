/* Figures with a name, one after the other: each is a batch of its own, whose rows become files, a chart and checks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sweep.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "batch.h"
#include "files/number.h"
#include "gnuplot.h"
#include "output.h"
#include "places.h"
#include "rows_hdf5.h"
#include "sweep_charts.h"

static bool make(void *context, struct cases *cases, struct reason *why)
{
    (void)why;
    sweep_plan(context);
    sweep_cases(context, cases);
    return true;
}

/* FOLDER/NAME and an ending, on the heap. */
static char *file_of(const struct sweep *sweep, const char *ending)
{
    const char *folder = sweep->folder;
    const size_t size = strlen(folder) + strlen(sweep->figure->name) + strlen(ending) + 2;
    char *path = allocate(size, 1);
    snprintf(path, size, "%s/%s%s", folder, sweep->figure->name, ending);
    return path;
}

/* What is drawn, as numbers: the name of the curve, x, y. */
static bool write_curves(const char *path, const struct chart *chart, struct reason *why)
{
    struct output output;
    if (!output_open(path, &output, why)) return false;
    fputs("panel,curve,drawn,x,y\n", output.stream);
    for (size_t p = 0; p < chart->panels; p++)
        for (size_t k = 0; k < chart->panel[p].count; k++) {
            const struct series *s = &chart->panel[p].series[k];
            for (size_t i = 0; i < s->count; i++) {
                fprintf(output.stream, "%zu,", p + 1);
                cell_write(output.stream, s->name);
                fprintf(output.stream, ",%s,%s,%s\n", s->mark == MARK_POINTS ? "points" : "line",
                        number_text(s->x[i]).text, number_text(s->y[i]).text);
            }
        }
    return output_finish(&output, why);
}

static bool write_files(const struct sweep *sweep, const struct cases *cases, const struct row *rows,
                        const struct chart *chart, const json_t *record, struct reason *why)
{
    static const char *const endings[] = {"-curves.csv", ".h5", ".svg", ".pdf"};
    bool good = true;
    for (size_t i = 0; i < sizeof endings / sizeof *endings && good; i++) {
        char *path = file_of(sweep, endings[i]);
        if (i == 0)
            good = write_curves(path, chart, why);
        else if (i == 1)
            good = !rows_hdf5_built() || rows_hdf5_write(path, cases, rows, record, why);
        else
            good = chart_draw(chart, path, why);
        free(path);
    }
    return good;
}

static int finish(void *context, const struct cases *cases, const struct row *rows, json_t *record)
{
    const struct sweep *sweep = context;
    struct reason why;
    struct chart *chart = sweep_chart(sweep, cases, rows);
    if (batch_interrupted()) {
        chart_release(chart);
        json_decref(record);
        complain("interrupted while %s is drawn; make it again", sweep->figure->name);
        return EXIT_INTERRUPTED;
    }
    printf("%s: %s\n", sweep->figure->name, sweep->figure->title);
    const bool good = write_files(sweep, cases, rows, chart, record, &why);
    const int failed = sweep_check(sweep, rows, chart);
    fflush(stdout);
    chart_release(chart);
    json_decref(record);
    if (!good) return complain("%s", why.text);
    return failed ? EXIT_SOME_FAILED : EXIT_DONE;
}

/* FOLDER/NAME-1of4.csv of a shard; those of --join K. */
static char *table_of(const struct sweep *sweep, size_t shard, size_t shards)
{
    char ending[64] = ".csv";
    if (shards > 1) snprintf(ending, sizeof ending, "-%zuof%zu.csv", shard, shards);
    return file_of(sweep, ending);
}

/* --join K: the shards 1 to K of this figure, in its folder. */
static char *shards_of(const struct sweep *sweep, const char *text, struct reason *why)
{
    double shards;
    if (rst_number_read(text, &shards) != RESTITUTE_OK || !(shards >= 2 && shards <= 10000) ||
        shards != (double)(size_t)shards) {
        refuse(why, "--join = \"%.64s\": must be the number of shards, 2 to 10000", text);
        return NULL;
    }
    char *list = copy_of("");
    for (size_t i = 1; i <= (size_t)shards; i++) {
        char *path = table_of(sweep, i, (size_t)shards), *before = list;
        const size_t size = strlen(list) + strlen(path) + 2;
        list = allocate(size, 1);
        snprintf(list, size, "%s%s%s", before, *before ? "," : "", path);
        free(before);
        free(path);
    }
    return list;
}

static int run_figure(const struct settings *given, const struct sweep_figure *figure)
{
    struct settings settings = *given;
    struct sweep sweep = {.figure = figure,
                          .settings = &settings,
                          .material = given->values.material,
                          .folder = given->text[TEXT_OUTPUT] ? given->text[TEXT_OUTPUT] : "."};
    const struct batch_maker maker = {make, finish, &sweep};
    struct reason why;
    int status = EXIT_USAGE;
    settings.values = values_none();
    settings.sweep = (char *)figure->name;
    settings.text[TEXT_MATERIAL] = NULL;
    settings.text[TEXT_OUTPUT] = table_of(&sweep, given->shard, given->shards);
    if (given->text[TEXT_JOIN]) settings.text[TEXT_JOIN] = shards_of(&sweep, given->text[TEXT_JOIN], &why);
    if (given->text[TEXT_JOIN] && !settings.text[TEXT_JOIN])
        complain("%s", why.text);
    else
        status = batch_run(&settings, &maker);
    free(settings.text[TEXT_OUTPUT]);
    if (given->text[TEXT_JOIN]) free(settings.text[TEXT_JOIN]);
    free(sweep.samples);
    return status;
}

/* The material can be read, and neither it nor its series is a file that a figure writes. */
static bool check_material(const struct settings *settings, const struct sweep_figure *figure, struct reason *why)
{
    static const char *const endings[] = {".csv", ".csv.meta.json", ".csv.partial", ".csv.partial.json",
                                          "-curves.csv", ".h5", ".svg", ".pdf"};
    const char *folder = settings->text[TEXT_OUTPUT];
    struct materials materials = {0};
    struct places places = {0};
    if (!settings->values.material) return true;
    if (figure && figure->kind != SWEEP_TEMPERATURE)
        return refuse(why, "--material: only with the figure temperature, or all");
    bool good = materials_get(&materials, settings->values.material, why);
    places_read_materials(&places, &materials);
    for (size_t i = 0; i < sweep_figure_count; i++)
        for (size_t k = 0; k < sizeof endings / sizeof *endings && (!figure || figure == &sweep_figures[i]); k++) {
            const struct sweep sweep = {.figure = &sweep_figures[i], .folder = folder ? folder : "."};
            char *path = file_of(&sweep, endings[k]);
            places_write(&places, "--output", path);
            free(path);
        }
    struct reason other;
    good = places_check(&places, good ? why : &other) && good;
    materials_release(&materials);
    return good;
}

/* An impact of the user has no place in a figure whose impacts are drawn. */
static bool check_options(const struct settings *settings, const struct sweep_figure *figure, struct reason *why)
{
    const char *const *text = (const char *const *)settings->text;
    if (settings->contours) return refuse(why, "--contours: not with a figure that has a name");
    static const enum text_option foreign[] = {TEXT_INPUT, TEXT_GRID, TEXT_FIGURE, TEXT_FORMAT, TEXT_PARTNER};
    static const char *const names[] = {"--input", "--grid", "--figure", "--format", "--partner"};
    const char *folder = text[TEXT_OUTPUT] ? text[TEXT_OUTPUT] : ".";
    struct stat status;
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (text[foreign[i]]) return refuse(why, "%s: not with a figure that has a name", names[i]);
    if (settings->solver.tolerance < 1e-6)
        return refuse(why, "--tolerance = %.64s: must be at least 1e-6 with a figure that has a name; its lines are "
                      "solved with a hundredth", text[TEXT_TOLERANCE]);
    if (settings->values.rotation_blocked >= 0)
        return refuse(why, "--rotation-blocked: not with a figure that has a name");
    for (enum field field = 0; field < FIELD_COUNT; field++)
        if (settings->values.given[field])
            return refuse(why, "--%s: not with a figure that has a name, whose impacts are drawn at random",
                          field_rules[field].option);
    if (figure && figure->kind == SWEEP_TEMPERATURE && !settings->values.material)
        return refuse(why, "--material is missing: the figure temperature needs that of polyisobutylene, "
                           "examples/materials/polyisobutylene.json");
    for (size_t i = 0; i < sweep_figure_count; i++) {
        const struct sweep_figure *f = &sweep_figures[i];
        if ((!figure || figure == f) && settings->shards > f->curves * f->points)
            return refuse(why, "--shard = %.60s: K is at most %zu, the rows of %s", text[TEXT_SHARD],
                          f->curves * f->points, f->name);
    }
    if (!check_material(settings, figure, why)) return false;
    if (!settings->text[TEXT_SHARD] && !gnuplot_check("figure.svg", why)) return false;
    if (mkdir(folder, 0777) != 0 && (stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)))
        return refuse(why, "--output = %.200s: must be a folder, or a new one in a folder that there is", folder);
    return true;
}

int sweep_run(const struct settings *given)
{
    struct settings settings = *given;
    struct reason why;
    const bool all = strcmp(given->sweep, "all") == 0;
    const struct sweep_figure *one = sweep_figure_named(given->sweep);
    int worst = EXIT_DONE;
    if (!all && !one)
        return complain("sweep: \"%.64s\": must be fig4 to fig11, maxwell, temperature, tangent, friction or all",
                        given->sweep);
    if (!given->text[TEXT_METHOD]) settings.solver.method = restitute_method_sync();
    if (!given->text[TEXT_TOLERANCE]) settings.solver.tolerance = 1e-5;
    if (!check_options(&settings, one, &why)) return complain("%s", why.text);
    for (size_t i = 0; i < sweep_figure_count; i++) {
        const struct sweep_figure *figure = &sweep_figures[i];
        if (one && figure != one) continue;
        if (!one && figure->kind == SWEEP_TEMPERATURE && !settings.values.material) {
            printf("%s: left out, needs --material\n", figure->name);
            continue;
        }
        if (batch_interrupted()) {
            complain("interrupted before %s", figure->name);
            return EXIT_INTERRUPTED;
        }
        const int status = run_figure(&settings, figure);
        if (status == EXIT_INTERRUPTED) return status;
        if (status > worst) worst = status;
    }
    return worst;
}
