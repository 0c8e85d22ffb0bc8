/* `restitute table build`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure.h"
#include "files/number.h"
#include "output.h"
#include "places.h"
#include "table_settings.h"

/* FROM:TO, or one number. The library checks them. */
static bool read_speed(const struct table_settings *s, double range[2], struct reason *why)
{
    const char *text = s->text[TABLE_SPEED];
    char first[64];
    if (!text) return true;
    const size_t length = strcspn(text, ":");
    const char *second = text[length] ? text + length + 1 : text;
    snprintf(first, sizeof first, "%.*s", (int)(length < sizeof first ? length : 0), text);
    if (rst_number_read(first, &range[0]) == RESTITUTE_OK &&
        rst_number_read(text[length] ? second : first, &range[1]) == RESTITUTE_OK)
        return true;
    return refuse(why, "--speed = \"%.64s\": must be FROM:TO or one number", text);
}

/* What a build needs. */
struct build {
    const struct table_settings *settings;
    struct materials materials;
    struct problem problem;
    restitute_table_options options;
};

static bool read_scene(struct build *b, struct reason *why)
{
    struct values values = b->settings->values;
    if (!values_physical(&values))
        return refuse(why, "no table is described: give --material, or moduli, and a contact; see --help");
    values.given[FIELD_SPEED] = true; /* the library takes no notice of it */
    values.number[FIELD_SPEED] = 1;
    return problem_build(&values, NAME_OPTIONS, &b->materials, &b->problem, why);
}

static bool read_options(struct build *b, struct reason *why)
{
    restitute_table_options_init(&b->options);
    double threads = 0, most = (double)b->options.max_impacts;
    if (!read_speed(b->settings, b->options.speed, why) ||
        !table_number(b->settings, TABLE_TOLERANCE, 1e-7, 0.1, &b->options.tolerance, why) ||
        !table_number(b->settings, TABLE_THREADS, 1, 1024, &threads, why) ||
        !table_number(b->settings, TABLE_MAX_IMPACTS, 1, 1e15, &most, why) ||
        !table_number(b->settings, TABLE_TIME_LIMIT, 1e-3, INFINITY, &b->options.time_limit, why))
        return false;
    if (threads != floor(threads)) return refuse(why, "--threads = %g: must be a whole number", threads);
    b->options.threads = (int)threads;
    b->options.max_impacts = (int64_t)most;
    return true;
}

static bool check_places(const struct build *b, struct reason *why)
{
    struct places places = {0};
    char *const *text = b->settings->text;
    places_read(&places, "--material", text[TABLE_MATERIAL]);
    places_read(&places, "--partner", b->settings->values.partner);
    places_read_materials(&places, &b->materials);
    places_write(&places, "--output", text[TABLE_OUTPUT]);
    places_write(&places, "--figure", text[TABLE_FIGURE]);
    return places_check(&places, why);
}

static void tell(const char *path, const restitute_table *table)
{
    restitute_table_info info;
    char name[1000], limits[400];
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    snprintf(name, sizeof name, "%s", path);
    escape(name, sizeof name);
    printf("%s: errors %.2g (ez), %.2g (ex), verified at %lld places; %lld impacts solved, %.3g MB\n", name,
           info.error_ez, info.error_ex, (long long)info.checks, (long long)info.impacts, (double)info.bytes / 1e6);
    table_limits(&info, limits, sizeof limits);
    if (*limits) printf("%s\n", limits);
}

static int build(const struct build *b)
{
    restitute_table *table = NULL;
    restitute_error error, written;
    struct reason why;
    char *const *text = b->settings->text;
    const int status = restitute_table_build(&b->problem.scene, &b->options, &table, &error);
    if (status < 0) return complain("%s", error.message);
    int result = status == RESTITUTE_OK ? EXIT_DONE : EXIT_SOME_FAILED;
    if (restitute_table_write(table, text[TABLE_OUTPUT], &written) < 0)
        result = complain("%s", written.message);
    else {
        tell(text[TABLE_OUTPUT], table);
        if (status != RESTITUTE_OK) complain("%s", error.message);
        if (text[TABLE_FIGURE] && !table_figure(table, b->settings, text[TABLE_FIGURE], &why))
            result = complain("%s", why.text);
    }
    restitute_table_destroy(table);
    return result;
}

int table_build_run(const struct table_settings *settings)
{
    struct reason why;
    struct build *b = allocate(1, sizeof *b);
    const char *output = settings->text[TABLE_OUTPUT], *figure = settings->text[TABLE_FIGURE];
    int status = EXIT_USAGE;
    b->settings = settings;
    if (output_is_stream(output))
        complain("--output = %.200s: a table needs a file", output);
    else if (!output_check(output, "--output", &why) || (figure && !figure_check(figure, &why)) || !read_scene(b, &why) ||
             !read_options(b, &why) || !check_places(b, &why) ||
             (figure && b->options.speed[0] >= b->options.speed[1] &&
              !refuse(&why, "--figure: a table of one speed has no curves")))
        complain("%s", why.text);
    else
        status = build(b);
    materials_release(&b->materials);
    free(b);
    return status;
}
