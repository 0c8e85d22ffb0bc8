/* Figures: what is drawn, and how it looks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gnuplot.h"

bool figure_check(const char *path, struct reason *why)
{
    if (strcmp(path, "-") == 0) return refuse(why, "--figure = -: must be a file that ends in .svg or .png");
    return output_check(path, "--figure", why) && gnuplot_check(path, why);
}

/* A colour between dark violet and light green, dark to light for slow to fast, told apart in grey print too. */
static unsigned colour_at(double fraction)
{
    static const unsigned char anchors[][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139}, {44, 113, 142},
                                               {33, 144, 141}, {39, 173, 129}, {92, 200, 99}, {170, 220, 50}};
    const int last = sizeof anchors / sizeof anchors[0] - 1;
    const double at = fraction * last;
    const int cell = at >= last ? last - 1 : (int)at;
    unsigned colour = 0;
    for (int i = 0; i < 3; i++) {
        const double value = anchors[cell][i] + (at - cell) * (anchors[cell + 1][i] - anchors[cell][i]);
        colour = colour << 8 | (unsigned)lround(value);
    }
    return colour;
}

/* What was given besides the axes: "radius 0.005 m, density 7800 kg/m^3, friction 0.3". */
static void write_description(const struct values *values, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (enum field field = 0; field < FIELD_COUNT && used < size; field++) {
        const struct field_rule *rule = &field_rules[field];
        const char *unit = strcmp(rule->unit, "1") == 0 ? "" : rule->unit;
        if (values->given[field])
            used += (size_t)snprintf(text + used, size - used, "%s%s %s%s%s", used ? ", " : "", rule->option,
                                     number_text(values->number[field]).text, *unit ? " " : "", unit);
    }
    if (values->deformable == RESTITUTE_BOTH_BODIES_DEFORM && used < size)
        used += (size_t)snprintf(text + used, size - used, ", both bodies deform");
    if (values->partner && used < size)
        used += (size_t)snprintf(text + used, size - used, ", partner %.60s", values->partner);
    if (values->rotation_blocked > 0 && used < size) snprintf(text + used, size - used, ", rotation blocked");
}

/* Title, what was given, and how it was made, around the panels. */
static void write_frame(FILE *commands, const struct settings *settings, const char *title)
{
    char description[600], origin[160];
    write_description(&settings->values, description, sizeof description);
    snprintf(origin, sizeof origin, "restitute %s, method %s, tolerance %s", restitute_version(),
             restitute_method_name(settings->solver.method), number_text(settings->solver.tolerance).text);
    fputs("set label 1 ", commands);
    gnuplot_string(commands, title);
    fputs(" at screen 0.02,0.955 font ',16' noenhanced\nset label 2 ", commands);
    gnuplot_string(commands, description);
    fputs(" at screen 0.02,0.89 font ',12' textcolor rgb '#555555' noenhanced\nset label 3 ", commands);
    gnuplot_string(commands, origin);
    fputs(" at screen 0.985,0.955 right font ',10' textcolor rgb '#888888' noenhanced\n", commands);
    fputs("set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\n"
          "set grid linecolor rgb '#dddddd' linewidth 0.7 linetype 1\nset key noautotitle\n",
          commands);
}

/* One point of ez over the normal speed. */
struct point {
    double x, y;
};

static int by_x(const void *left, const void *right)
{
    const double a = ((const struct point *)left)->x, b = ((const struct point *)right)->x;
    return (a > b) - (a < b);
}

static double cell_number(const struct cases *cases, size_t row, size_t column)
{
    return strtod(cases_cell(cases, row, column), NULL);
}

static double normal_speed(const struct cases *cases, size_t row)
{
    return cell_number(cases, row, 0) * cos(cell_number(cases, row, 1) * 3.14159265358979323846 / 180.0);
}

static void write_ez_data(FILE *commands, const struct cases *cases, const struct row *rows)
{
    struct point *points = allocate(cases->rows, sizeof *points);
    size_t count = 0;
    for (size_t i = 0; i < cases->rows; i++)
        if (rows[i].solved) points[count++] = (struct point){normal_speed(cases, i), rows[i].number[ROW_EZ]};
    qsort(points, count, sizeof *points, by_x);
    fputs("$ez << END\n", commands);
    for (size_t i = 0; i < count; i++)
        fprintf(commands, "%.17g %.17g\n", points[i].x, points[i].y);
    fputs("END\n", commands);
    free(points);
}

/* A block for each speed: angle, ex. A row that failed leaves a gap. */
static void write_ex_data(FILE *commands, const struct cases *cases, const struct row *rows)
{
    fputs("$ex << END\n", commands);
    for (size_t i = 0; i < cases->rows; i++) {
        if (i && i % cases->axis[1] == 0) fputs("\n\n", commands);
        if (rows[i].solved)
            fprintf(commands, "%s %.17g %.17g %.17g\n", cases_cell(cases, i, 1), rows[i].number[ROW_EX],
                    normal_speed(cases, i), rows[i].number[ROW_EZ]);
        else
            fputs("NaN NaN NaN NaN\n", commands);
    }
    fputs("END\n", commands);
}

static double speed_fraction(const struct cases *cases, size_t curve)
{
    return cases->axis[0] > 1 ? (double)curve / (double)(cases->axis[0] - 1) : 0.4;
}

static void plot_ez(FILE *commands, const struct cases *cases)
{
    double slowest = INFINITY, fastest = 0;
    for (size_t i = 0; i < cases->rows; i++) {
        slowest = fmin(slowest, normal_speed(cases, i));
        fastest = fmax(fastest, normal_speed(cases, i));
    }
    fputs("set lmargin at screen 0.085\nset rmargin at screen 0.45\nset bmargin at screen 0.14\n"
          "set tmargin at screen 0.76\nset title 'Normal restitution' offset 0,-0.4\n"
          "set xlabel 'normal speed  v cos θ  (m/s)'\nset ylabel 'e_z'\nset yrange [0:*]\n",
          commands);
    fprintf(commands, "set logscale x\nset format x '%%g'\nset xrange [%.3g:%.3g]\n", 0.7 * slowest, 1.4 * fastest);
    fputs("plot $ez using 1:2 with lines linewidth 1.5 linecolor rgb '#999999'", commands);
    for (size_t curve = 0; curve < cases->axis[0]; curve++)
        fprintf(commands,
                ", \\\n  $ex index %zu using 3:4 with points pointtype 7 pointsize 0.45 linecolor rgb '#%06x'", curve,
                colour_at(speed_fraction(cases, curve)));
    fputs("\nunset logscale x\nset xrange [*:*]\nunset label\n", commands);
}

static void plot_ex(FILE *commands, const struct cases *cases)
{
    const size_t most_named = 12, step = (cases->axis[0] + most_named - 1) / most_named;
    const double last = cell_number(cases, cases->rows - 1, 1);
    fputs("set lmargin at screen 0.56\nset rmargin at screen 0.855\n"
          "set title 'Tangential restitution' offset 0,-0.5\nset xlabel 'angle from the normal  θ  (degrees)'\n"
          "set ylabel 'e_x'\nset yrange [*:*]\nset xzeroaxis linetype 1 linewidth 1 linecolor rgb '#444444'\n"
          "set key at screen 0.99,0.79 right top title 'v (m/s)' samplen 1.6 spacing 1.1\n",
          commands);
    if (last > 45) fputs("set xrange [0:90]\nset xtics 15\n", commands);
    fputs("plot ", commands);
    for (size_t remaining = cases->axis[0]; remaining > 0; remaining--) {
        const size_t curve = remaining - 1;
        fprintf(commands,
                "$ex index %zu using 1:2 with linespoints pointtype 7 pointsize 0.35 linewidth 1.8 linecolor rgb "
                "'#%06x'",
                curve, colour_at(speed_fraction(cases, curve)));
        if (curve % step == 0) fprintf(commands, " title '%.3g'", cell_number(cases, curve * cases->axis[1], 0));
        fputs(curve ? ", \\\n  " : "\n", commands);
    }
}

bool figure_of_grid(const char *path, const struct settings *settings, const struct cases *cases,
                    struct materials *materials, const struct row *rows, struct reason *why)
{
    struct gnuplot gnuplot;
    const struct material_entry *entry = materials_get(materials, settings->values.material, why);
    bool any = false;
    for (size_t i = 0; i < cases->rows; i++)
        any |= rows[i].solved;
    if (!any) return refuse(why, "%.200s: not drawn, no row was solved", path);
    if (!entry || !gnuplot_open(path, 1080, 480, &gnuplot, why)) return false;
    FILE *commands = gnuplot.commands;
    write_ez_data(commands, cases, rows);
    write_ex_data(commands, cases, rows);
    write_frame(commands, settings, entry->info.name);
    fputs("set multiplot\n", commands);
    plot_ez(commands, cases);
    plot_ex(commands, cases);
    fputs("unset multiplot\n", commands);
    return gnuplot_close(&gnuplot, why);
}

/* A panel of the history: its place, and the two arrays it shows. */
struct panel {
    double left, right;
    const char *title, *quantity, *unit, *dimensionless, *key;
    size_t array[2]; /* numbers in arrays_of() */
    const char *name[2];
};

static const struct panel panels[] = {
    {0.07, 0.32, "Forces", "force", "N", "F_z / F_0,  F_x / (μ F_0)", "top right", {4, 5}, {"normal", "tangential"}},
    {0.4,
     0.65,
     "Contact and stick radius",
     "radius",
     "m",
     "radius / a_{el}",
     "bottom center",
     {2, 3},
     {"contact", "stick"}},
    {0.735,
     0.985,
     "Velocities",
     "velocity",
     "m/s",
     "v_z / v_0,  v_x / V_0",
     "top right",
     {6, 7},
     {"normal", "tangential"}},
};
enum { HISTORY_ARRAYS = 8 };

static void arrays_of(const restitute_history *history, const double *arrays[HISTORY_ARRAYS])
{
    const double *all[HISTORY_ARRAYS] = {
        history->time,         history->indentation,      history->contact_radius,  history->stick_radius,
        history->normal_force, history->tangential_force, history->normal_velocity, history->tangential_velocity};
    memcpy(arrays, all, sizeof all);
}

/* The unit prefix under which the largest of `values` lies between 0.1 and 100. */
struct prefix {
    double factor;
    const char *name;
};

static struct prefix prefix_for(const double *values, size_t count, bool physical)
{
    static const struct prefix prefixes[] = {{1e-9, "n"}, {1e-6, "μ"}, {1e-3, "m"}, {1.0, ""}, {1e3, "k"}, {1e6, "M"}};
    double largest = 0;
    struct prefix chosen = {1.0, ""};
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(values[i]));
    if (!physical) return chosen;
    chosen = prefixes[0];
    for (size_t i = 1; i < sizeof prefixes / sizeof prefixes[0]; i++)
        if (largest >= 0.1 * prefixes[i].factor) chosen = prefixes[i];
    return chosen;
}

static void write_history_data(FILE *commands, const restitute_history *history)
{
    const double *arrays[HISTORY_ARRAYS];
    arrays_of(history, arrays);
    fputs("$history << END\n", commands);
    for (size_t i = 0; i < history->count; i++)
        for (size_t k = 0; k < HISTORY_ARRAYS; k++)
            fprintf(commands, "%.17g%c", arrays[k][i], k + 1 < HISTORY_ARRAYS ? ' ' : '\n');
    fputs("END\n", commands);
}

static void plot_panel(FILE *commands, const struct panel *panel, const restitute_history *history, bool physical)
{
    const double *arrays[HISTORY_ARRAYS];
    arrays_of(history, arrays);
    const struct prefix time = prefix_for(history->time, history->count, physical);
    const struct prefix scale = prefix_for(arrays[panel->array[0]], history->count, physical);
    fprintf(commands, "set lmargin at screen %g\nset rmargin at screen %g\nset title '%s' offset 0,-0.4\n", panel->left,
            panel->right, panel->title);
    fprintf(commands, "set key inside %s samplen 1.6\nset xlabel 'time  (%s%s)'\n", panel->key, time.name,
            physical ? "s" : "T");
    if (physical)
        fprintf(commands, "set ylabel '%s  (%s%s)'\n", panel->quantity, scale.name, panel->unit);
    else
        fprintf(commands, "set ylabel '%s'\n", panel->dimensionless);
    for (int i = 0; i < 2; i++)
        fprintf(commands, "%s$history using ($1/%g):($%zu/%g) with lines linewidth 2 linecolor rgb '#%06x' title '%s'",
                i ? ", " : "plot ", time.factor, panel->array[i] + 1, scale.factor, colour_at(i ? 0.75 : 0.25),
                panel->name[i]);
    fputs("\nunset label\n", commands);
}

bool figure_of_history(const char *path, const struct settings *settings, const struct problem *problem,
                       const restitute_history *history, struct reason *why)
{
    struct gnuplot gnuplot;
    if (!gnuplot_open(path, 1320, 440, &gnuplot, why)) return false;
    FILE *commands = gnuplot.commands;
    write_history_data(commands, history);
    write_frame(commands, settings, problem->physical ? problem->info->name : "Impact in dimensionless numbers");
    fputs("set bmargin at screen 0.16\nset tmargin at screen 0.76\nset multiplot\n"
          "set xzeroaxis linetype 1 linewidth 1 linecolor rgb '#444444'\n",
          commands);
    for (size_t i = 0; i < sizeof panels / sizeof panels[0]; i++)
        plot_panel(commands, &panels[i], history, problem->physical);
    fputs("unset multiplot\n", commands);
    return gnuplot_close(&gnuplot, why);
}
