/* Rows and columns. A number that does not exist is an empty cell.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "work.h"

/* Text of a status for a cell: nothing for OK. */
static const char *status_cell(int status)
{
    return status == RESTITUTE_OK ? "" : restitute_status_text(status);
}

static void write_number(FILE *stream, const char *format, double value, char after)
{
    if (!isnan(value)) fprintf(stream, format, value);
    fputc(after, stream);
}

/* A text that may hold a comma. */
static void write_text(FILE *stream, const char *text, char after)
{
    fprintf(stream, strchr(text, ',') ? "\"%s\"%c" : "%s%c", text, after);
}

static const char *set_name(unsigned sets)
{
    for (int i = 0; i < BENCH_SETS; i++)
        if (sets == 1u << i) return bench_set_names[i];
    return "all";
}

static void write_whole(FILE *stream, int64_t value, char after)
{
    if (value > 0) fprintf(stream, "%lld", (long long)value);
    fputc(after, stream);
}

void bench_write_runs(const struct bench_scenes *scenes, const struct bench_runs *runs, FILE *stream)
{
    fputs("set,scene,chi,psi,delta1,gamma,method,tolerance,elements_asked,steps_asked,seconds,"
          "repeats,ez,ex,error_ez,error_ex,estimate,"
          "reference_error,reference,elements,steps,work,restarts,events,status\n",
          stream);
    for (size_t i = 0; i < runs->count; i++) {
        const struct bench_run *r = &runs->runs[i];
        const struct bench_scene *s = &scenes->scenes[r->scene];
        fprintf(stream, "%s,%s,%.17g,%.17g,", set_name(s->set), s->name, s->chi, s->psi);
        write_number(stream, "%.17g", s->delta1, ',');
        write_number(stream, "%.17g", s->gamma, ',');
        fprintf(stream, "%s,", bench_methods[r->method].name);
        write_number(stream, "%g", r->tolerance, ',');
        write_whole(stream, r->elements_asked, ',');
        write_whole(stream, r->steps_asked, ',');
        fprintf(stream, "%.4g,%d,", r->seconds, r->repeats);
        write_number(stream, "%.12f", r->ez, ',');
        write_number(stream, "%.12f", r->ex, ',');
        write_number(stream, "%.3g", r->error_ez, ',');
        write_number(stream, "%.3g", r->error_ex, ',');
        write_number(stream, "%.3g", r->estimate, ',');
        fprintf(stream, "%.3g,%s,", bench_scene_uncertainty(s), s->reference);
        write_whole(stream, r->elements, ',');
        write_whole(stream, r->steps, ',');
        write_number(stream, "%.3g", r->work, ',');
        write_whole(stream, r->restarts, ',');
        write_whole(stream, r->events, ',');
        write_text(stream, status_cell(r->status), '\n');
    }
}

static void write_range(FILE *stream, const struct bench_range *range)
{
    write_number(stream, "%.4g", range->min, ',');
    write_number(stream, "%.4g", range->median, ',');
    write_number(stream, "%.4g", range->max, ',');
}

static void write_set(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets, FILE *stream)
{
    struct bench_summary list[BENCH_SUMMARIES];
    const size_t n = bench_summarise(scenes, runs, sets, list);
    for (size_t i = 0; i < n; i++) {
        const struct bench_summary *s = &list[i];
        fprintf(stream, "%s,%s,", set_name(sets), bench_methods[s->method].name);
        write_number(stream, "%g", s->tolerance, ',');
        write_whole(stream, s->elements, ',');
        write_whole(stream, s->steps, ',');
        fprintf(stream, "%zu,%zu,%zu,", s->runs, s->solved, s->met);
        write_range(stream, &s->seconds);
        write_range(stream, &s->error);
        write_number(stream, "%.3g", s->estimate_ratio, ',');
        write_number(stream, "%.4f", s->honest, ',');
        write_number(stream, "%.3g", s->worst, '\n');
    }
}

void bench_write_summary(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets, FILE *stream)
{
    fputs("set,method,tolerance,elements,steps,runs,solved,tolerance_met,seconds_min,seconds_median,seconds_max,"
          "error_min,error_median,error_max,estimate_over_error_median,honest_part,error_over_estimate_max\n",
          stream);
    for (int i = 0; i < BENCH_SETS; i++)
        if (sets & 1u << i) write_set(scenes, runs, 1u << i, stream);
    if (sets & (sets - 1)) write_set(scenes, runs, sets, stream);
}

void bench_write_speed(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned methods, FILE *stream)
{
    fputs("method,error,scenes,elements_asked,steps_asked,seconds_asked,within,seconds_got,reached,ratio_asked,"
          "ratio_got\n",
          stream);
    for (int m = 0; m < BENCH_METHODS; m++)
        for (int i = 0; i < BENCH_SPEED_ERRORS; i++) {
            if (!(methods & 1u << m)) continue;
            const struct bench_speed s = bench_speed_of(scenes, runs, m, bench_speed_errors[i]);
            fprintf(stream, "%s,%g,%zu,", bench_methods[m].name, s.error, s.scenes);
            write_whole(stream, s.elements, ',');
            write_whole(stream, s.steps, ',');
            write_number(stream, "%.4g", s.seconds_asked, ',');
            fprintf(stream, "%zu,", s.within);
            write_number(stream, "%.4g", s.seconds_got, ',');
            fprintf(stream, "%zu,", s.reached);
            write_number(stream, "%.4g", s.ratio_asked, ',');
            write_number(stream, "%.4g", s.ratio_got, '\n');
        }
}

static void print_number(FILE *stream, int width, const char *format, double value)
{
    char text[32] = "-";
    if (!isnan(value)) snprintf(text, sizeof text, format, value);
    fprintf(stream, " %*s", width, text);
}

static void print_summary(const struct bench_scenes *scenes, const struct bench_runs *runs, FILE *stream)
{
    struct bench_summary list[BENCH_SUMMARIES];
    const size_t n = bench_summarise(scenes, runs, BENCH_TRUTH | BENCH_STIFF | BENCH_PRONY, list);
    fputs("Error against run time over all scenes\n"
          "method        tolerance elements    steps runs solved   us min median    max  error min median    max"
          "  estimate/true  honest  worst\n",
          stream);
    for (size_t i = 0; i < n; i++) {
        const struct bench_summary *s = &list[i];
        fprintf(stream, "%-13s", bench_methods[s->method].name);
        print_number(stream, 9, "%.0e", s->tolerance);
        print_number(stream, 8, "%.0f", s->elements ? (double)s->elements : NAN);
        print_number(stream, 8, "%.0f", s->steps ? (double)s->steps : NAN);
        fprintf(stream, " %4zu %6zu  ", s->runs, s->solved);
        print_number(stream, 6, "%.3g", 1e6 * s->seconds.min);
        print_number(stream, 6, "%.3g", 1e6 * s->seconds.median);
        print_number(stream, 7, "%.3g", 1e6 * s->seconds.max);
        print_number(stream, 9, "%.1e", s->error.min);
        print_number(stream, 7, "%.1e", s->error.median);
        print_number(stream, 7, "%.1e", s->error.max);
        print_number(stream, 10, "%.3g", s->estimate_ratio);
        print_number(stream, 11, "%.3f", s->honest);
        print_number(stream, 6, "%.2g", s->worst);
        fputc('\n', stream);
    }
}

static void print_time(FILE *stream, double seconds)
{
    if (isnan(seconds))
        fputs(" not reached", stream);
    else
        print_number(stream, 11, "%.4g", 1e6 * seconds);
}

static void print_speed(const struct bench_speed *s, FILE *stream)
{
    char pair[48] = "";
    if (s->elements) snprintf(pair, sizeof pair, "  (%lld x %lld)", (long long)s->elements, (long long)s->steps);
    fprintf(stream, "%-13s %6.0e ", bench_methods[s->method].name, s->error);
    print_time(stream, s->seconds_asked);
    fprintf(stream, " %3zu/%-3zu", s->within, s->scenes);
    print_number(stream, 7, "%.3g", s->ratio_asked);
    print_time(stream, s->seconds_got);
    fprintf(stream, " %3zu/%-3zu", s->reached, s->scenes);
    print_number(stream, 7, "%.3g", s->ratio_got);
    fprintf(stream, "%s\n", pair);
}

void bench_print_precision(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned methods,
                           FILE *stream)
{
    print_summary(scenes, runs, stream);
    bench_print_work(runs, methods, stream);
    fputs("\nTime for an error, us, median over the standard solids with 0 < psi < psi_c\n"
          "asked for: as tolerance; of the paper's algorithm the fastest (elements x steps) with it in half of them\n"
          "got: in each scene the fastest run with a true error that small; within, reached: scenes where it is\n"
          "not reached: in at most half of them by any run made; ratio: paper-euler's time over this one\n"
          "method         error   asked for  within   ratio         got reached   ratio\n",
          stream);
    for (int m = 0; m < BENCH_METHODS; m++)
        for (int i = 0; i < BENCH_SPEED_ERRORS; i++)
            if (methods & 1u << m) {
                const struct bench_speed s = bench_speed_of(scenes, runs, m, bench_speed_errors[i]);
                print_speed(&s, stream);
            }
}

void bench_write_omissions(const struct bench_omission *rows, size_t n, FILE *stream)
{
    fputs("method,left_out,full,lean,elements,steps_full,steps_lean,seconds_full,seconds_lean,ratio,status\n", stream);
    for (size_t i = 0; i < n; i++) {
        const struct bench_omission *r = &rows[i];
        fprintf(stream, "%s,%s,%s,%s,", bench_methods[r->method].name, r->left_out, r->full, r->lean);
        write_whole(stream, r->elements, ',');
        write_whole(stream, r->steps_full, ',');
        write_whole(stream, r->steps_lean, ',');
        write_number(stream, "%.4g", r->seconds_full, ',');
        write_number(stream, "%.4g", r->seconds_lean, ',');
        write_number(stream, "%.3f", r->ratio, ',');
        write_text(stream, status_cell(r->status), '\n');
    }
}

void bench_print_omissions(const struct bench_omission *rows, size_t n, FILE *stream)
{
    fputs("What leaving out saves: time in full over time without\n"
          "method        left out                           full               lean                          us full"
          "    us lean  ratio\n",
          stream);
    for (size_t i = 0; i < n; i++) {
        const struct bench_omission *r = &rows[i];
        fprintf(stream, "%-13s %-34s %-18s %-25s", bench_methods[r->method].name, r->left_out, r->full, r->lean);
        print_number(stream, 10, "%.2f", 1e6 * r->seconds_full);
        print_number(stream, 10, "%.2f", 1e6 * r->seconds_lean);
        print_number(stream, 6, "%.2f", r->ratio);
        fputs(r->status ? " refused\n" : "\n", stream);
    }
}

void bench_write_map_header(FILE *stream)
{
    fputs("method,steps,delta1,gamma,verdict,ez,ex,error_ez,error_ex,estimate,reference_error,seconds\n", stream);
}

void bench_write_cell(const struct bench_cell *c, FILE *stream)
{
    fprintf(stream, "%s,%lld,%g,%g,%s,", bench_methods[c->method].name, (long long)c->steps, c->delta1, c->gamma,
            bench_verdict_names[c->verdict]);
    write_number(stream, "%.9f", c->ez, ',');
    write_number(stream, "%.9f", c->ex, ',');
    write_number(stream, "%.3g", c->error_ez, ',');
    write_number(stream, "%.3g", c->error_ex, ',');
    write_number(stream, "%.3g", c->estimate, ',');
    write_number(stream, "%.3g", c->uncertainty, ',');
    fprintf(stream, "%.3g\n", c->seconds);
}

/* The next cell of a line; NULL where there is none. */
static char *next_cell(char **rest)
{
    char *cell = *rest;
    if (!cell) return NULL;
    char *comma = strchr(cell, ',');
    if (comma) *comma = '\0';
    *rest = comma ? comma + 1 : NULL;
    return cell;
}

int bench_read_cell(const char *line, struct bench_cell *cell)
{
    char copy[512], *rest = copy, *text[12];
    snprintf(copy, sizeof copy, "%s", line);
    copy[strcspn(copy, "\r\n")] = '\0';
    for (int i = 0; i < 12; i++)
        if (!(text[i] = next_cell(&rest))) return 0;
    double *const numbers[] = {&cell->ez,       &cell->ex,          &cell->error_ez, &cell->error_ex,
                               &cell->estimate, &cell->uncertainty, &cell->seconds};
    cell->method = bench_method_index(text[0], strlen(text[0]));
    cell->steps = strtoll(text[1], NULL, 10);
    cell->delta1 = strtod(text[2], NULL);
    cell->gamma = strtod(text[3], NULL);
    cell->verdict = BENCH_VERDICTS;
    for (int i = 0; i < BENCH_VERDICTS; i++)
        if (strcmp(text[4], bench_verdict_names[i]) == 0) cell->verdict = (enum bench_verdict)i;
    if (cell->method < 0 || cell->verdict == BENCH_VERDICTS || rest) return 0;
    const int paper = !bench_methods[cell->method].handle; /* whose pair may be beyond all bounds */
    for (int i = 0; i < 7; i++) {
        const double low = i == 1 ? -1 : 0, high = i < 2 ? 1 : INFINITY;
        char *end = text[5 + i];
        *numbers[i] = *end ? strtod(end, &end) : NAN;
        if (*end || (!(paper && i < 2) && (*numbers[i] < low || *numbers[i] > high))) return 0;
    }
    return 1;
}

void bench_print_map(const struct bench_cell *cells, size_t n, FILE *stream)
{
    fputs("Stability map: cells by verdict\nmethod           steps", stream);
    for (int v = 0; v < BENCH_VERDICTS; v++)
        fprintf(stream, " %12s", bench_verdict_names[v]);
    fputs("  error max\n", stream);
    for (int m = 0; m < BENCH_METHODS; m++)
        for (int level = 0; level < MAP_LEVELS; level++) {
            size_t count[BENCH_VERDICTS] = {0}, all = 0;
            double largest = NAN;
            for (size_t i = 0; i < n; i++) {
                if (cells[i].method != m || cells[i].steps != bench_map_steps(level)) continue;
                count[cells[i].verdict]++;
                all++;
                if (cells[i].verdict == BENCH_ERROR)
                    largest = fmax(largest, fmax(cells[i].error_ez, cells[i].error_ex));
            }
            if (all == 0) continue;
            fprintf(stream, "%-13s %8lld", bench_methods[m].name, (long long)bench_map_steps(level));
            for (int v = 0; v < BENCH_VERDICTS; v++)
                fprintf(stream, " %12zu", count[v]);
            print_number(stream, 10, "%.1e", largest);
            fputc('\n', stream);
        }
}
