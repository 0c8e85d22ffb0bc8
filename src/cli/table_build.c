/* `restitute table build`: in pieces, with progress; what is solved is put down in FILE.partial
 * after a second, then every ten, and when a signal asks to stop.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench.h"
#include "places.h"
#include "table_settings.h"
#include "unfinished.h"

static volatile sig_atomic_t interrupted;

static void on_signal(int number)
{
    (void)number;
    interrupted = 1;
}

static void catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        struct sigaction action, before;
        memset(&action, 0, sizeof action);
        action.sa_handler = on_signal;
        sigemptyset(&action.sa_mask);
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
    }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* "0.5", or a fraction such as 7/6, in which chi is usually known. */
static bool read_end(const char *text, size_t length, double *value)
{
    char copy[64], *slash;
    double divisor = 1;
    if (length >= sizeof copy) return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    if ((slash = strchr(copy, '/'))) {
        *slash = '\0';
        if (restitute_number_read(slash + 1, &divisor) != RESTITUTE_OK || !(divisor > 0)) return false;
    }
    if (restitute_number_read(copy, value) != RESTITUTE_OK) return false;
    *value /= divisor;
    return true;
}

/* FROM:TO, or FROM alone. The library checks the numbers. */
static bool read_range(const struct table_settings *s, enum table_text option, double range[2], struct reason *why)
{
    const char *text = s->text[option];
    if (!text) return true;
    const char *colon = strchr(text, ':');
    const size_t first = colon ? (size_t)(colon - text) : strlen(text);
    bool good = read_end(text, first, &range[0]);
    range[1] = range[0];
    if (good && colon) good = read_end(colon + 1, strlen(colon + 1), &range[1]);
    return good ? true : refuse(why, "--%s = \"%.64s\": must be FROM:TO or one number", table_text_names[option], text);
}

/* What a build needs. */
struct build {
    const struct table_settings *settings;
    struct materials materials;
    struct problem problem;
    restitute_table_family family;
    restitute_table_options options;
    char line[1000]; /* all that the table depends on */
    struct unfinished partial;
};

static bool read_family(struct build *b, struct reason *why)
{
    struct values values = b->settings->values;
    restitute_table_family_init(&b->family);
    char *const *text = b->settings->text;
    if (!read_range(b->settings, TABLE_SPEED, b->family.speed, why) ||
        !read_range(b->settings, TABLE_CHI, b->family.chi, why) ||
        !read_range(b->settings, TABLE_DELTA1, b->family.delta1, why) ||
        !read_range(b->settings, TABLE_GAMMA, b->family.gamma, why))
        return false;
    const bool ranges = text[TABLE_CHI] || text[TABLE_DELTA1] || text[TABLE_GAMMA];
    if (!values_physical(&values)) {
        if (text[TABLE_SPEED]) return refuse(why, "--speed: needs a contact, see --material");
        return ranges ? true
                      : refuse(why, "no table is described: give --material and a contact, or --delta1, --gamma, "
                                    "--chi; see --help");
    }
    if (ranges) return refuse(why, "--chi, --delta1, --gamma: not with a contact, which has its own");
    values.given[FIELD_SPEED] = true; /* the library takes no notice of it */
    values.number[FIELD_SPEED] = 1;
    if (!problem_build(&values, NAME_OPTIONS, &b->materials, &b->problem, why)) return false;
    b->family.scene = &b->problem.scene;
    return true;
}

static bool read_options(struct build *b, struct reason *why)
{
    double threads = 0, most = 2e7;
    restitute_table_options_init(&b->options);
    if (!table_number(b->settings, TABLE_TOLERANCE, 1e-7, 0.1, &b->options.tolerance, why) ||
        !table_number(b->settings, TABLE_THREADS, 1, 1024, &threads, why) ||
        !table_number(b->settings, TABLE_MAX_IMPACTS, 1, 1e15, &most, why))
        return false;
    if (threads != floor(threads)) return refuse(why, "--threads = %g: must be a whole number", threads);
    b->options.threads = (int)threads;
    b->options.max_impacts = (int64_t)most;
    return true;
}

static bool check_places(const struct build *b, struct reason *why)
{
    struct places places = {0};
    const char *output = b->settings->text[TABLE_OUTPUT];
    places_read(&places, "--material", b->settings->text[TABLE_MATERIAL]);
    places_read(&places, "--partner", b->settings->values.partner);
    places_read_materials(&places, &b->materials);
    places_write(&places, "--output", output);
    places_write_beside(&places, "--output", output, ".partial");
    return places_check(&places, why);
}

/* Bits of the numbers, so that equal lines mean equal tables. */
static void describe(struct build *b)
{
    const restitute_table_family *f = &b->family;
    const restitute_scene *s = f->scene;
    uint64_t fingerprint = 0;
    for (const struct material_entry *e = b->materials.first; e; e = e->next)
        fingerprint = 31 * fingerprint + e->info.fingerprint;
    int length = snprintf(b->line, sizeof b->line, "tolerance %a, ", b->options.tolerance);
    if (s)
        snprintf(b->line + length, sizeof b->line - (size_t)length,
                 "material %016" PRIx64
                 ", deformable %d, spheres %a %a %a %a %a %a, blocked %d, friction %a, speed %a %a",
                 fingerprint, s->deformable, s->radius1, s->mass1, s->inertia1, s->radius2, s->mass2, s->inertia2,
                 s->rotation_blocked, s->friction, f->speed[0], f->speed[1]);
    else
        snprintf(b->line + length, sizeof b->line - (size_t)length, "chi %a %a, delta1 %a %a, gamma %a %a", f->chi[0],
                 f->chi[1], f->delta1[0], f->delta1[1], f->gamma[0], f->gamma[1]);
}

/* The library puts a new file in the place of the old one, which was locked. */
static bool put_down(struct build *b, const restitute_table_builder *builder, struct reason *why)
{
    restitute_error error;
    if (restitute_table_builder_write(builder, b->line, b->partial.path, &error) < 0)
        return refuse(why, "%s", error.message);
    b->partial.empty = false;
    return unfinished_lock_again(&b->partial, why);
}

static void show(const restitute_table_builder *builder, double since)
{
    char text[100];
    const int64_t done = restitute_table_builder_solved(builder), all = restitute_table_builder_expected(builder);
    snprintf(text, sizeof text, "%lld of about %lld impacts, %.0f s", (long long)done, (long long)all,
             seconds() - since);
    bench_progress(text);
}

/* Solve until the table is there or a signal came. Pieces last about a fifth of a second. */
static int run(struct build *b, restitute_table_builder *builder, restitute_table **table, restitute_error *error,
               struct reason *why)
{
    const double start = seconds();
    double written = start - 9, last = start; /* put down after a second, then every ten */
    size_t piece = 64;
    int status = RESTITUTE_OK;
    while (!*table && !interrupted && status >= 0) {
        status = restitute_table_builder_run(builder, piece, table, error);
        const double now = seconds();
        if (now - last < 0.1 && piece < 1000000) piece *= 2;
        if (now - last > 0.4 && piece > 16) piece /= 2;
        last = now;
        show(builder, start);
        if (*table || status < 0 || now - written < 10) continue;
        written = now;
        if (!put_down(b, builder, why)) complain("%s", why->text); /* the build itself is none the worse */
    }
    bench_progress(NULL);
    return status;
}

static int finish(struct build *b, restitute_table *table, int status, const restitute_error *error)
{
    restitute_error written;
    restitute_table_info info;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    const int failed = restitute_table_write(table, b->settings->text[TABLE_OUTPUT], &written) < 0;
    if (failed)
        return complain("%s%s", written.message,
                        b->partial.empty ? "" : "; continue with --resume when that is mended");
    unfinished_remove(&b->partial);
    char name[1000];
    snprintf(name, sizeof name, "%s", b->settings->text[TABLE_OUTPUT]);
    escape(name, sizeof name);
    printf("%s: errors %.2g (ez), %.2g (ex), verified at %lld points; %lld impacts solved, %.3g MB\n", name,
           info.error_ez, info.error_ex, (long long)info.checks, (long long)info.impacts, (double)info.bytes / 1e6);
    if (status == RESTITUTE_OK) return EXIT_DONE;
    complain("%s", error->message);
    return EXIT_SOME_FAILED;
}

static int build(struct build *b)
{
    restitute_table_builder *builder;
    restitute_table *table = NULL;
    restitute_error error;
    struct reason why;
    if (restitute_table_builder_create(&b->family, &b->options, &builder, &error) < 0)
        return complain("%s", error.message);
    if (!unfinished_open(b->settings->text[TABLE_OUTPUT], b->settings->resume, &b->partial, &why)) {
        restitute_table_builder_destroy(builder);
        return complain("%s", why.text);
    }
    if (!b->partial.empty && restitute_table_builder_read(builder, b->line, b->partial.path, &error) < 0) {
        restitute_table_builder_destroy(builder);
        return complain("%s", error.message);
    }
    catch_signals();
    const int status = run(b, builder, &table, &error, &why);
    int result;
    if (table)
        result = finish(b, table, status, &error);
    else if (status < 0)
        result = complain("%s", error.message);
    else {
        result = put_down(b, builder, &why) ? EXIT_INTERRUPTED : complain("%s", why.text);
        if (result == EXIT_INTERRUPTED) fprintf(stderr, "restitute: interrupted; go on with --resume\n");
    }
    restitute_table_destroy(table);
    restitute_table_builder_destroy(builder);
    return result;
}

int table_build_run(const struct table_settings *settings)
{
    struct reason why;
    struct build *b = allocate(1, sizeof *b);
    const char *output = settings->text[TABLE_OUTPUT];
    int status = EXIT_DONE;
    b->settings = settings;
    if (output_is_stream(output))
        refuse(&why, "--output = %.200s: a table needs a file", output), status = EXIT_USAGE;
    else if (!output_check(output, "--output", &why) || !read_family(b, &why) || !read_options(b, &why) ||
             !check_places(b, &why))
        status = EXIT_USAGE;
    if (status == EXIT_DONE) {
        describe(b);
        status = build(b);
        if (b->partial.empty) unfinished_remove(&b->partial); /* nothing was put down */
        unfinished_leave(&b->partial);
    } else
        complain("%s", why.text);
    materials_release(&b->materials);
    free(b);
    return status;
}
