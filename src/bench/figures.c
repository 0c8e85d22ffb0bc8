/* The figures of the report as gnuplot commands with their data inline.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "figures.h"

#include <math.h>

/* Told apart in colour blindness; in the order of the methods. */
static unsigned colour_of(int method)
{
    static const unsigned colours[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9};
    return colours[method % (int)(sizeof colours / sizeof *colours)];
}

/* Lines get thinner from method to method, so that two that coincide are both seen. */
static double thickness(int method)
{
    return fmax(1, 3.6 - 0.9 * method);
}

static void write_style(FILE *commands)
{
    fputs("set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\n"
          "set grid linecolor rgb '#dddddd' linewidth 0.7 linetype 1\n",
          commands);
}

/* An error of rounding or none at all is drawn here. */
static const double least_error = 1e-10;

void bench_draw_precision(const struct bench_scenes *scenes, const struct bench_runs *runs, FILE *commands)
{
    struct bench_summary list[BENCH_SUMMARIES];
    const size_t n = bench_summarise(scenes, runs, BENCH_TRUTH | BENCH_STIFF | BENCH_PRONY, list);
    int blocks[BENCH_METHODS], drawn = 0;
    fputs("$runs << END\n", commands);
    for (int m = 0; m < BENCH_METHODS; m++) {
        int points = 0;
        for (size_t i = 0; i < n; i++)
            if (list[i].method == m && bench_summary_complete(&list[i]) && ++points)
                fprintf(commands, "%.4g %.4g %.4g %.4g\n", list[i].seconds.median, fmax(least_error, list[i].error.min),
                        fmax(least_error, list[i].error.median), fmax(least_error, list[i].error.max));
        blocks[m] = points ? drawn++ : -1;
        if (points) fputs("\n\n", commands);
    }
    fputs("END\n", commands);
    write_style(commands);
    fprintf(commands,
            "set title 'Error against run time: median of %zu scenes, band from least to largest error'\n"
            "set logscale xy\nset format '10^{%%T}'\nset xlabel 'time of one impact  (s)'\n"
            "set ylabel 'largest of the errors of e_z and e_x'\nset yrange [1e-10:1]\nset key bottom left opaque\n",
            scenes->count);
    const char *separator = "plot ";
    for (int m = 0; m < BENCH_METHODS; m++) {
        if (blocks[m] < 0) continue;
        fprintf(commands,
                "%s$runs index %d using 1:2:4 with filledcurves fillstyle transparent solid 0.12 noborder "
                "linecolor rgb "
                "'#%06x' notitle, $runs index %d using 1:3 with linespoints pointtype 7 pointsize %g linewidth %g "
                "linecolor rgb '#%06x' title '%s'",
                separator, blocks[m], colour_of(m), blocks[m], 0.25 * thickness(m), thickness(m), colour_of(m),
                bench_methods[m].name);
        separator = ", ";
    }
    fputs(drawn ? "\n" : "plot 1 notitle\n", commands);
}

void bench_draw_omissions(const struct bench_omission *rows, size_t n, FILE *commands)
{
    size_t bars = 0;
    fputs("$bars << END\n", commands);
    for (size_t i = 0; i < n; i++) {
        const struct bench_omission *row = &rows[i];
        if (row->status) continue;
        fprintf(commands, "%zu \"%s: %s / %s\" %.4g %u\n", bars++, bench_methods[row->method].name, row->full,
                row->lean, row->ratio, colour_of(row->method));
    }
    fputs("END\n", commands);
    write_style(commands);
    fprintf(commands,
            "set title 'What leaving out saves: time of the first over that of the second'\n"
            "set style fill solid 0.7 noborder\nset yrange [%g:-0.6] noreverse\nset xrange [0:*]\nset xlabel 'ratio'\n"
            "set key off\nset ytics noenhanced\n"
            "plot $bars using (0.5*$3):1:(0.5*$3):(0.35):4:yticlabels(2) with boxxyerror linecolor rgb variable\n",
            (double)bars - 0.4);
}

void bench_size_map(unsigned methods, int levels, int *width, int *height)
{
    int rows = 0;
    for (int m = 0; m < BENCH_METHODS; m++)
        rows += (methods & 1u << m) != 0;
    *width = 170 + 230 * levels;
    *height = 40 + 230 * rows;
}

/* log10 of the error for a cell with an error, below -20 by the verdict for the others. */
static double value_of(const struct bench_cell *cell)
{
    if (cell->verdict == BENCH_ERROR) return fmax(-8, fmin(0, log10(fmax(cell->error_ez, cell->error_ex))));
    return -20 - (double)cell->verdict;
}

static void write_map(const struct bench_cell *cells, size_t n, int method, int level, FILE *commands)
{
    fprintf(commands, "$map_%d_%d << END\n", method, level);
    for (size_t i = 0; i < n; i++)
        if (cells[i].method == method && cells[i].steps == bench_map_steps(level))
            fprintf(commands, "%.0f %.0f %.3g\n", log10(cells[i].delta1), log10(cells[i].gamma), value_of(&cells[i]));
    fputs("NaN NaN NaN\nEND\n", commands);
}

/* Squares of one colour for each verdict that is no error. */
static void plot_map(int method, int level, FILE *commands)
{
    static const struct {
        enum bench_verdict verdict;
        unsigned colour;
    } others[] = {{BENCH_REFUSED, 0xbbbbbb},
                  {BENCH_UNSTABLE, 0x000000},
                  {BENCH_WRONG, 0xff00ff},
                  {BENCH_TOO_SLOW, 0xe8e8ff},
                  {BENCH_NO_REFERENCE, 0xffffff}};
    fprintf(commands, "plot $map_%d_%d using ($3>-20?$1:NaN):2:(0.5):(0.5):3 with boxxyerror palette notitle", method,
            level);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        fprintf(commands,
                ", $map_%d_%d using ($3==%d?$1:NaN):2:(0.5):(0.5) with boxxyerror linecolor rgb '#%06x' notitle",
                method, level, -20 - (int)others[i].verdict, others[i].colour);
    fputc('\n', commands);
}

static void write_legend(int width, int height, FILE *commands)
{
    fprintf(commands,
            "set label 1 'log_{10} of the error of (e_z, e_x)' at screen %g,%g right font ',11'\n"
            "set label 2 'grey: refused   black: unstable   magenta: wrong   pale: too slow   white: no reference' at "
            "screen %g,%g left font ',11'\n",
            1 - 15.0 / width, 1 - 12.0 / height, 20.0 / width, 1 - 12.0 / height);
}

void bench_draw_map(const struct bench_cell *cells, size_t n, unsigned methods, int levels, FILE *commands)
{
    int width, height, row = 0;
    bench_size_map(methods, levels, &width, &height);
    for (int m = 0; m < BENCH_METHODS; m++)
        for (int level = 0; level < levels; level++)
            if (methods & 1u << m) write_map(cells, n, m, level, commands);
    fputs("set style fill solid 1 noborder\nset palette defined (0 '#440154', 1 '#3b518b', 2 '#21908d', 3 '#5cc863', 4 "
          "'#fde725')\nset cbrange [-8:0]\nset xrange [-6.5:6.5]\n"
          "set yrange [-6.5:6.5]\nset xtics 3\nset ytics 3\nset border 15 linecolor rgb '#444444'\nset key off\n",
          commands);
    write_legend(width, height, commands);
    fputs("set multiplot\n", commands);
    for (int m = 0; m < BENCH_METHODS; m++) {
        if (!(methods & 1u << m)) continue;
        const double top = 1 - (45.0 + 230.0 * row) / height, bottom = top - 165.0 / height;
        for (int level = 0; level < levels; level++) {
            const double left = (70.0 + 230.0 * level) / width;
            fprintf(commands,
                    "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\n"
                    "set bmargin at screen %g\nset title '%s, %lld steps' font ',12' offset 0,-0.6\n"
                    "set xlabel '%s' offset 0,0.5\nset ylabel '%s'\n%s",
                    left, left + 165.0 / width, top, bottom, bench_methods[m].name, (long long)bench_map_steps(level),
                    methods >> (m + 1) ? "" : "log_{10} δ_1", level ? "" : "log_{10} γ",
                    level == levels - 1 ? "set colorbox\n" : "unset colorbox\n");
            plot_map(m, level, commands);
            fputs("unset label\n", commands);
        }
        row++;
    }
    fputs("unset multiplot\n", commands);
}
