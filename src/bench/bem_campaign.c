/* Boundary elements against the foundation, on impacts drawn at random: the domain is that of the truth tables in
 * tests/data, chi from 1/3 (blocked rotation) to 4 (thin shells and beyond), psi from nearly full stick to slip to the
 * end. SPDX-License-Identifier: BSD-3-Clause */
#include "bem_campaign.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"
#include "timing.h"

static const char *const solid_names[DRAWN_SOLIDS] = {"elastic", "standard", "prony"};

void bench_draw_impact(unsigned seed, long index, struct bench_draw *draw)
{
    uint64_t state = (uint64_t)seed * UINT64_C(0xd1342543de82ef95) + (uint64_t)index * UINT64_C(0x2545f4914f6cdd1d);
    const double lot = random_in(&state, 0, 1);
    *draw = (struct bench_draw){.kind = lot < 1.0 / 6 ? DRAWN_ELASTIC : lot < 2.0 / 3 ? DRAWN_STANDARD : DRAWN_PRONY};
    draw->chi = random_log(&state, 1.0 / 3, 4);
    draw->psi = random_log(&state, 0.05, 10);
    if (draw->kind == DRAWN_STANDARD) {
        draw->delta1 = random_log(&state, 1e-3, 100);
        draw->gamma = random_log(&state, 1e-3, 200);
    } else if (draw->kind == DRAWN_PRONY) {
        draw->n_terms = 2 + (int)random_in(&state, 0, BENCH_MOST_TERMS - 1);
        draw->g_inf = random_in(&state, 0, 1) < 0.2 ? 0 : 1; /* some flow, and some of these never rebound */
        for (int k = 0; k < draw->n_terms; k++) {
            draw->tau[k] = random_log(&state, 1e-3, 100);
            draw->g[k] = random_log(&state, 0.05, 5);
        }
    }
}

int64_t bench_bem_elements(int grid)
{
    return (int64_t)floor((grid / 2 - 1.5) / 1.03);
}

static double solve(restitute_solver *solver, const restitute_impact *impact, restitute_result *result, int *status)
{
    const double before = bench_clock();
    restitute_result_init(result);
    result->ez = result->ex = result->error_ez = result->error_ex = NAN;
    *status = restitute_solve(solver, impact, result, NULL, NULL, NULL);
    return bench_clock() - before;
}

int bench_bem_run(restitute_solver *sync, restitute_solver *bem, long index, const struct bench_draw *draw,
                  struct bench_bem_row *row)
{
    restitute_impact impact;
    restitute_result result;
    restitute_material *solid = NULL;
    restitute_impact_init(&impact);
    impact.chi = draw->chi;
    impact.psi = draw->psi;
    impact.delta1 = draw->delta1;
    if (draw->kind == DRAWN_STANDARD) impact.gamma = draw->gamma;
    if (draw->kind == DRAWN_PRONY &&
        restitute_material_prony(draw->g_inf, 0, (size_t)draw->n_terms, draw->tau, draw->g, 0.5, &solid, NULL) < 0)
        return 1;
    impact.material = solid;
    *row = (struct bench_bem_row){.index = index, .draw = *draw};
    row->seconds_sync = solve(sync, &impact, &result, &row->status_sync);
    row->ez_sync = result.ez, row->ex_sync = result.ex;
    row->seconds_bem = solve(bem, &impact, &result, &row->status_bem);
    row->ez_bem = result.ez, row->ex_bem = result.ex;
    row->error_ez = result.error_ez, row->error_ex = result.error_ex;
    restitute_material_destroy(solid);
    return 0;
}

static const char header[] =
    "index,solid,chi,psi,delta1,gamma,g_inf,tau_g,ez_sync,ex_sync,ez_bem,ex_bem,difference_ez,difference_ex,"
    "error_ez,error_ex,seconds_sync,seconds_bem,status_sync,status_bem\n";

void bench_write_bem_header(FILE *stream)
{
    fputs(header, stream);
}

int bench_is_bem_header(const char *line)
{
    return strcmp(line, header) == 0;
}

void bench_write_bem_row(const struct bench_bem_row *r, FILE *stream)
{
    const struct bench_draw *d = &r->draw;
    fprintf(stream, "%ld,%s,%.9g,%.9g,", r->index, solid_names[d->kind], d->chi, d->psi);
    if (d->kind == DRAWN_STANDARD)
        fprintf(stream, "%.9g,%.9g", d->delta1, d->gamma);
    else
        fputc(',', stream);
    if (d->kind == DRAWN_PRONY)
        fprintf(stream, ",%g,", d->g_inf);
    else
        fputs(",,", stream);
    for (int k = 0; k < d->n_terms; k++)
        fprintf(stream, "%s%.9g:%.9g", k ? " " : "", d->tau[k], d->g[k]);
    fprintf(stream, ",%.9g,%.9g,%.9g,%.9g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%d,%d\n", r->ez_sync, r->ex_sync, r->ez_bem,
            r->ex_bem, r->ez_bem - r->ez_sync, r->ex_bem - r->ex_sync, r->error_ez, r->error_ex, r->seconds_sync,
            r->seconds_bem, r->status_sync, r->status_bem);
}

/* Start of the cell `count` commas further on; NULL if there are not so many. */
static const char *skip_cells(const char *line, int count)
{
    for (; line && count > 0; count--) {
        line = strchr(line, ',');
        if (line) line++;
    }
    return line;
}

static int within(double value, double low, double high)
{
    return value >= low && value <= high;
}

int bench_read_bem_row(const char *line, unsigned seed, struct bench_bem_row *r)
{
    char *end;
    double chi, psi, difference_ez, difference_ex;
    const char *drawn = skip_cells(line, 2), *solved = skip_cells(line, 8);
    *r = (struct bench_bem_row){.index = strtol(line, &end, 10)};
    if (end == line || *end != ',' || r->index < 0 || !drawn || !solved) return 0;
    if (sscanf(drawn, "%lf,%lf", &chi, &psi) != 2) return 0;
    if (sscanf(solved, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%d,%d", &r->ez_sync, &r->ex_sync, &r->ez_bem,
               &r->ex_bem, &difference_ez, &difference_ex, &r->error_ez, &r->error_ex, &r->seconds_sync,
               &r->seconds_bem, &r->status_sync, &r->status_bem) != 12)
        return 0;
    if (!within(r->ez_sync, 0, 1) || !within(r->ez_bem, 0, 1) || !within(r->ex_sync, -1, 1) ||
        !within(r->ex_bem, -1, 1) || !(r->error_ez >= 0) || !(r->error_ex >= 0))
        return 0;
    bench_draw_impact(seed, r->index, &r->draw);
    return fabs(chi / r->draw.chi - 1) < 1e-8 && fabs(psi / r->draw.psi - 1) < 1e-8; /* nine digits were written */
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int failed(const struct bench_bem_row *r)
{
    return r->status_sync < 0 || r->status_bem < 0;
}

/* One finds a rebound and the other none. */
static int ends_differently(const struct bench_bem_row *r)
{
    return !failed(r) && (r->status_sync == RESTITUTE_NO_REBOUND) != (r->status_bem == RESTITUTE_NO_REBOUND);
}

/* Median, 95 of 100 and largest absolute difference of the rows of a solid (DRAWN_SOLIDS: of all). */
static void print_line(const struct bench_bem_row *rows, size_t n, int kind, double *ez, double *ex, FILE *stream)
{
    size_t count = 0, failures = 0;
    double seconds = 0;
    for (size_t i = 0; i < n; i++) {
        if (kind != DRAWN_SOLIDS && (int)rows[i].draw.kind != kind) continue;
        seconds += rows[i].seconds_bem;
        if (failed(&rows[i])) {
            failures++;
            continue;
        }
        ez[count] = fabs(rows[i].ez_bem - rows[i].ez_sync);
        ex[count++] = fabs(rows[i].ex_bem - rows[i].ex_sync);
    }
    if (count + failures == 0) return;
    fprintf(stream, "  %-9s %5zu %8zu", kind == DRAWN_SOLIDS ? "all" : solid_names[kind], count, failures);
    qsort(ez, count, sizeof *ez, by_value);
    qsort(ex, count, sizeof *ex, by_value);
    for (int which = 0; which < 2 && count > 0; which++) {
        const double *d = which ? ex : ez;
        fprintf(stream, "   %8.1e %8.1e %8.1e", d[count / 2], d[count * 95 / 100], d[count - 1]);
    }
    fprintf(stream, "   %8.3f\n", seconds / (double)(count + failures));
}

void bench_print_bem(const struct bench_bem_row *rows, size_t n, double limit, FILE *stream)
{
    double *ez = malloc((n + 1) * sizeof *ez), *ex = malloc((n + 1) * sizeof *ex);
    if (ez && ex) {
        fputs("Boundary elements minus sync, absolute\n"
              "                           difference in ez               difference in ex\n"
              "  solid      sets   failed     median   95 %     largest     median   95 %     largest   s a set\n",
              stream);
        for (int kind = 0; kind <= DRAWN_SOLIDS; kind++)
            print_line(rows, n, kind, ez, ex, stream);
    }
    free(ez);
    free(ex);
    size_t different = 0;
    for (size_t i = 0; i < n; i++)
        different += ends_differently(&rows[i]) ? 1 : 0;
    fprintf(stream, "  rebound in one and none in the other: %zu\n", different);
    for (size_t i = 0; i < n; i++) {
        const struct bench_bem_row *r = &rows[i];
        if (ends_differently(r))
            fprintf(stream, "  set %ld ends differently: sync: %s; bem: %s\n", r->index,
                    restitute_status_text(r->status_sync), restitute_status_text(r->status_bem));
        const double dz = r->ez_bem - r->ez_sync, dx = r->ex_bem - r->ex_sync;
        if (failed(r))
            fprintf(stream, "  set %ld failed: sync: %s; bem: %s\n", r->index, restitute_status_text(r->status_sync),
                    restitute_status_text(r->status_bem));
        else if (!(fabs(dz) <= limit && fabs(dx) <= limit))
            fprintf(stream,
                    "  set %ld (%s, chi %.4g, psi %.4g): differences %.2g (ez), %.2g (ex); bem estimates %.1g, %.1g\n",
                    r->index, solid_names[r->draw.kind], r->draw.chi, r->draw.psi, dz, dx, r->error_ez, r->error_ex);
    }
}

static void send_points(const struct bench_bem_row *rows, size_t n, int kind, int of_ex, FILE *commands)
{
    for (size_t i = 0; i < n; i++) {
        const struct bench_bem_row *r = &rows[i];
        const double difference = of_ex ? r->ex_bem - r->ex_sync : r->ez_bem - r->ez_sync;
        if ((int)r->draw.kind != kind || failed(r)) continue;
        fprintf(commands, "%.9g %.9g\n", r->draw.psi, fmax(1e-8, fabs(difference)));
    }
    fputs("e\n", commands);
}

void bench_draw_bem(const struct bench_bem_row *rows, size_t n, FILE *commands)
{
    static const char *const colours[DRAWN_SOLIDS] = {"#4477aa", "#ee6677", "#228833"};
    static const char *const titles[DRAWN_SOLIDS] = {"elastic", "standard solid", "Prony series"};
    fputs("set multiplot layout 1,2\nset logscale xy\nset xlabel '{/Symbol y}'\nset format y '10^{%L}'\nset yrange "
          "[1e-8:1e-2]\n"
          "set xrange [0.04:12]\nset key bottom right\nset grid\n",
          commands);
    for (int of_ex = 0; of_ex < 2; of_ex++) {
        fprintf(commands, "set title '|difference in %s|'\nplot 0.002 lc '#888888' dt 2 title '0.002'",
                of_ex ? "e_x" : "e_z");
        for (int kind = 0; kind < DRAWN_SOLIDS; kind++)
            fprintf(commands, ", '-' with points pt 7 ps 0.5 lc rgb '%s' title '%s'", colours[kind], titles[kind]);
        fputc('\n', commands);
        for (int kind = 0; kind < DRAWN_SOLIDS; kind++)
            send_points(rows, n, kind, of_ex, commands);
    }
    fputs("unset multiplot\n", commands);
}
