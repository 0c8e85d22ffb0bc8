/* Figures: what is drawn, and how it looks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart.h"
#include "gnuplot.h"

bool figure_check(const char *path, struct reason *why)
{
    if (strcmp(path, "-") == 0) return refuse(why, "--figure = -: must be a file that ends in .svg, .png or .pdf");
    return output_check(path, "--figure", why) && gnuplot_check(path, why);
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

static void write_frame(FILE *commands, const struct settings *settings, const char *title)
{
    char description[600], origin[160];
    write_description(&settings->values, description, sizeof description);
    chart_origin(settings, origin, sizeof origin);
    chart_frame(commands, title, description, origin);
}

static double cell_number(const struct cases *cases, size_t row, size_t column)
{
    return strtod(cases_cell(cases, row, column), NULL);
}

static bool is_words(const struct cases *cases, size_t column)
{
    return field_of_column(cases_name(cases, column)) == FIELD_COUNT;
}

/* Numbers are compared as such: 1 and 1.0 are the same. */
struct cell_at {
    const char *words;
    double number;
    size_t row;
};

static struct cell_at cell_at(const struct cases *cases, size_t column, size_t row)
{
    return is_words(cases, column) ? (struct cell_at){cases_cell(cases, row, column), 0, row}
                                   : (struct cell_at){"", cell_number(cases, row, column), row};
}

static int cell_order(const struct cell_at *a, const struct cell_at *b)
{
    const int order = (a->number > b->number) - (a->number < b->number);
    return order ? order : strcmp(a->words, b->words);
}

static int by_row(const void *left, const void *right)
{
    const size_t a = *(const size_t *)left, b = *(const size_t *)right;
    return (a > b) - (a < b);
}

static int by_cell(const void *left, const void *right)
{
    const struct cell_at *a = left, *b = right;
    const int order = cell_order(a, b);
    return order ? order : by_row(&a->row, &b->row);
}

/* Different cells of a column in order of appearance, as rows in which they stand. */
struct distinct {
    size_t count;
    size_t *row;
};

static struct distinct distinct_of(const struct cases *cases, size_t column)
{
    struct distinct d = {0, allocate(cases->rows, sizeof *d.row)};
    struct cell_at *cells = allocate(cases->rows, sizeof *cells);
    for (size_t i = 0; i < cases->rows; i++)
        cells[i] = cell_at(cases, column, i);
    qsort(cells, cases->rows, sizeof *cells, by_cell);
    for (size_t i = 0; i < cases->rows; i++)
        if (i == 0 || cell_order(&cells[i], &cells[i - 1]) != 0) d.row[d.count++] = cells[i].row;
    qsort(d.row, d.count, sizeof *d.row, by_row);
    free(cells);
    return d;
}

/* What a figure of cases has along x, and what its curves differ in; NO_COLUMN: there is one curve. */
#define NO_COLUMN SIZE_MAX
struct figure_axes {
    size_t x, curves;
};

/* Of a file: the columns that vary, the one with fewer values for the curves. */
static bool varying_columns(const struct cases *cases, struct figure_axes *axes, struct reason *why)
{
    size_t found = 0, most = 0;
    for (size_t column = 0; column < cases->columns; column++) {
        const struct distinct d = distinct_of(cases, column);
        free(d.row);
        if (d.count < 2) continue;
        if (++found > 2) break;
        const bool along_x = !is_words(cases, column) && d.count > most;
        if (along_x) most = d.count;
        if (found == 1) axes->x = column;
        if (found == 2) axes->curves = along_x ? axes->x : column;
        if (found == 2 && along_x) axes->x = column;
    }
    if (found == 1 || found == 2) return true;
    return refuse(why, "--figure: %s columns of %.200s vary: must be one or two", found ? "more than two" : "no",
                  cases->source);
}

static bool find_axes(const struct cases *cases, struct figure_axes *axes, struct reason *why)
{
    *axes = (struct figure_axes){cases->axes == 2, cases->axes == 2 ? 0 : NO_COLUMN};
    if (!cases->axes && !varying_columns(cases, axes, why)) return false;
    return is_words(cases, axes->x) ? refuse(why, "--figure: %s has no numbers to be an axis: vary another one too",
                                             cases_name(cases, axes->x))
                                    : true;
}

struct point {
    double x, y;
};

static int by_x(const void *left, const void *right)
{
    const double a = ((const struct point *)left)->x, b = ((const struct point *)right)->x;
    return (a > b) - (a < b);
}

static int by_point(const void *left, const void *right)
{
    const double a = ((const struct point *)left)->y, b = ((const struct point *)right)->y;
    const int order = by_x(left, right);
    return order ? order : (a > b) - (a < b);
}

static bool all_differ(const struct cases *cases, const struct figure_axes *axes)
{
    struct point *points = allocate(cases->rows, sizeof *points);
    bool differ = true;
    for (size_t i = 0; i < cases->rows; i++)
        points[i] = (struct point){cell_number(cases, i, axes->x), cell_number(cases, i, axes->curves)};
    qsort(points, cases->rows, sizeof *points, by_point);
    for (size_t i = 1; i < cases->rows; i++)
        differ &= by_point(&points[i], &points[i - 1]) != 0;
    free(points);
    return differ;
}

bool figure_check_cases(const struct cases *cases, bool contours, struct reason *why)
{
    struct figure_axes axes;
    if (!find_axes(cases, &axes, why)) return false;
    if (axes.curves == NO_COLUMN)
        return contours ? refuse(why, "--contours: needs two columns or axes that vary") : true;
    const struct distinct x = distinct_of(cases, axes.x), curves = distinct_of(cases, axes.curves);
    const size_t n_x = x.count, n_curves = curves.count;
    free(x.row);
    free(curves.row);
    if (!contours && n_curves > KEY_LINES)
        return refuse(why, "--figure: %zu curves of %s: must be at most %d; or take --contours", n_curves,
                      cases_name(cases, axes.curves), KEY_LINES);
    if (!contours) return true;
    if (is_words(cases, axes.curves)) return refuse(why, "--contours: needs two columns of numbers that vary");
    if (n_x * n_curves != cases->rows || n_x < 3 || n_curves < 3 || !all_differ(cases, &axes))
        return refuse(why, "--contours: %zu rows are no full grid of %zu by %zu, each node once and both at least 3",
                      cases->rows, n_x, n_curves);
    return true;
}

/* Values along an axis: over more than two decades, or so asked for. */
static bool is_logarithmic(const struct cases *cases, size_t column)
{
    double low = INFINITY, high = 0;
    if (cases->axes) return cases->logarithmic[column];
    for (size_t i = 0; i < cases->rows; i++) {
        low = fmin(low, cell_number(cases, i, column));
        high = fmax(high, cell_number(cases, i, column));
    }
    return low > 0 && high >= 100 * low;
}

void figure_label(enum field field, char *text, size_t size)
{
    static const char *const names[FIELD_COUNT] = {[FIELD_CHI] = "χ",
                                                   [FIELD_PSI] = "ψ",
                                                   [FIELD_DELTA1] = "δ_1",
                                                   [FIELD_GAMMA] = "γ",
                                                   [FIELD_DELTA2] = "δ_2",
                                                   [FIELD_SPEED] = "speed  v",
                                                   [FIELD_FRICTION] = "friction  μ",
                                                   [FIELD_ANGLE] = "angle from the normal  θ",
                                                   [FIELD_TIME_SHIFT] = "time shift  a_T"};
    const struct field_rule *rule = &field_rules[field];
    const char *unit = field == FIELD_ANGLE ? "degrees" : rule->unit,
               *name = names[field] ? names[field] : rule->option;
    if (strcmp(unit, "1") == 0)
        snprintf(text, size, "%s", name);
    else
        snprintf(text, size, "%s  (%s)", name, unit);
}

static double normal_speed(const struct cases *cases, size_t row, size_t speed, size_t angle)
{
    return cell_number(cases, row, speed) * cos(cell_number(cases, row, angle) * 3.14159265358979323846 / 180.0);
}

/* One curve: the rows that have this value, by x. A row that failed leaves a gap. */
static void add_curve(const struct cases *cases, const struct row *rows, const struct figure_axes *axes, int number,
                      size_t of_row, struct series *series)
{
    struct point *points = allocate(cases->rows, sizeof *points);
    size_t count = 0;
    const bool all = axes->curves == NO_COLUMN;
    const struct cell_at of = all ? (struct cell_at){"", 0, 0} : cell_at(cases, axes->curves, of_row);
    for (size_t i = 0; i < cases->rows; i++) {
        const struct cell_at cell = all ? of : cell_at(cases, axes->curves, i);
        if (cell_order(&cell, &of) == 0)
            points[count++] =
                (struct point){cell_number(cases, i, axes->x), rows[i].solved ? rows[i].number[number] : NAN};
    }
    qsort(points, count, sizeof *points, by_x);
    for (size_t i = 0; i < count; i++)
        series_add(series, points[i].x, points[i].y);
    free(points);
}

static void name_curve(const struct cases *cases, size_t column, size_t row, char *text, size_t size)
{
    const char *cell = cases_cell(cases, row, column), *slash = strrchr(cell, '/');
    if (is_words(cases, column))
        snprintf(text, size, "%.*s", (int)strcspn(slash ? slash + 1 : cell, "."), slash ? slash + 1 : cell);
    else
        snprintf(text, size, "%.4g", cell_number(cases, row, column));
}

static void add_curves(struct chart *chart, const struct cases *cases, const struct row *rows,
                       const struct figure_axes *axes)
{
    static const int numbers[] = {ROW_EZ, ROW_EX};
    struct distinct d = {1, allocate(cases->rows, sizeof *d.row)};
    if (axes->curves != NO_COLUMN) free(d.row), d = distinct_of(cases, axes->curves);
    for (size_t remaining = d.count; remaining > 0; remaining--)
        for (size_t panel = 0; panel < 2; panel++) {
            char name[48] = "";
            if (axes->curves != NO_COLUMN) name_curve(cases, axes->curves, d.row[remaining - 1], name, sizeof name);
            struct series *s = chart_series(&chart->panel[panel], MARK_BOTH, remaining - 1, cases->rows, name);
            add_curve(cases, rows, axes, numbers[panel], d.row[remaining - 1], s);
        }
    free(d.row);
}

/* ez depends on the normal speed alone: a grid of speeds and angles has one curve of it. */
static void merge_normal_speeds(struct panel *panel, const struct cases *cases, const struct row *rows, size_t speed,
                                size_t angle)
{
    struct point *points = allocate(cases->rows, sizeof *points);
    size_t count = 0;
    double low = INFINITY, high = 0;
    for (size_t i = 0; i < cases->rows; i++)
        if (rows[i].solved)
            points[count++] = (struct point){normal_speed(cases, i, speed, angle), rows[i].number[ROW_EZ]};
    qsort(points, count, sizeof *points, by_x);
    for (size_t k = 0; k < panel->count; k++)
        panel->series[k].count = 0;
    for (size_t i = 0; i < count; i++) {
        series_add(&panel->series[0], points[i].x, points[i].y);
        low = fmin(low, points[i].x), high = fmax(high, points[i].x);
    }
    panel->series[0].style = 0;
    panel->xlog = true;
    panel->xrange[0] = 0.7 * low, panel->xrange[1] = 1.4 * high;
    snprintf(panel->xlabel, sizeof panel->xlabel, "normal speed  v cos θ  (m/s)");
    free(points);
}

static int by_value(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static size_t index_of(const double *sorted, size_t count, double value)
{
    return (size_t)((const double *)bsearch(&value, sorted, count, sizeof value, by_value) - sorted);
}

static void add_heights(struct panel *panel, const struct cases *cases, const struct row *rows,
                        const struct figure_axes *axes, int number, double noise)
{
    const struct distinct x = distinct_of(cases, axes->x), y = distinct_of(cases, axes->curves);
    chart_heights(panel, number == ROW_EZ ? "e_z" : "e_x", x.count, y.count, noise);
    struct heights *h = &panel->heights;
    for (size_t i = 0; i < x.count; i++)
        h->x[i] = cell_number(cases, x.row[i], axes->x);
    for (size_t i = 0; i < y.count; i++)
        h->y[i] = cell_number(cases, y.row[i], axes->curves);
    qsort(h->x, h->nx, sizeof *h->x, by_value);
    qsort(h->y, h->ny, sizeof *h->y, by_value);
    for (size_t i = 0; i < cases->rows; i++)
        h->z[index_of(h->y, h->ny, cell_number(cases, i, axes->curves)) * h->nx +
             index_of(h->x, h->nx, cell_number(cases, i, axes->x))] = rows[i].solved ? rows[i].number[number] : NAN;
    free(x.row);
    free(y.row);
}

static void label_panels(struct chart *chart, const struct cases *cases, const struct figure_axes *axes, bool contours)
{
    static const char *const titles[] = {"Normal restitution", "Tangential restitution"};
    static const char *const quantities[] = {"e_z", "e_x"};
    for (size_t i = 0; i < 2; i++) {
        struct panel *p = &chart->panel[i];
        const bool words = axes->curves != NO_COLUMN && is_words(cases, axes->curves);
        snprintf(p->title, sizeof p->title, "%s%s%s", titles[i], contours ? " " : "", contours ? quantities[i] : "");
        snprintf(p->ylabel, sizeof p->ylabel, "%s", quantities[i]);
        figure_label(field_of_column(cases_name(cases, axes->x)), p->xlabel, sizeof p->xlabel);
        p->xlog = is_logarithmic(cases, axes->x);
        if (!contours) p->yrange[0] = i ? NAN : 0;
        if (axes->curves == NO_COLUMN || words) continue;
        const enum field field = field_of_column(cases_name(cases, axes->curves));
        if (contours)
            figure_label(field, p->ylabel, sizeof p->ylabel), p->ylog = is_logarithmic(cases, axes->curves);
        else
            figure_label(field, p->key, sizeof p->key);
    }
}

static const char *title_of(const struct settings *settings, const struct cases *cases, struct materials *materials)
{
    struct reason why;
    const char *path = settings->values.material;
    const struct material_entry *entry = path ? materials_get(materials, path, &why) : NULL;
    if (entry) return entry->info.name;
    for (size_t i = 0; i < cases->columns; i++)
        if (field_of_column(cases_name(cases, i)) <= FIELD_LAST_DIMENSIONLESS)
            return "Impacts in dimensionless numbers";
    return values_dimensionless(&settings->values) ? "Impacts in dimensionless numbers" : "Impacts";
}

bool figure_of_cases(const char *path, const struct settings *settings, const struct cases *cases,
                     struct materials *materials, const struct row *rows, struct reason *why)
{
    struct figure_axes axes;
    bool any = false;
    for (size_t i = 0; i < cases->rows; i++)
        any |= rows[i].solved;
    if (!any) return refuse(why, "%.200s: not drawn, no row was solved", path);
    if (!find_axes(cases, &axes, why)) return false;
    struct chart *chart = chart_new(settings, 2);
    snprintf(chart->title, sizeof chart->title, "%s", title_of(settings, cases, materials));
    write_description(&settings->values, chart->description, sizeof chart->description);
    label_panels(chart, cases, &axes, settings->contours);
    if (settings->contours) {
        const double noise = 2 * settings->solver.tolerance;
        add_heights(&chart->panel[0], cases, rows, &axes, ROW_EZ, noise);
        add_heights(&chart->panel[1], cases, rows, &axes, ROW_EX, noise);
    } else {
        add_curves(chart, cases, rows, &axes);
    }
    const size_t speed = cases->axes == 2 ? 0 : NO_COLUMN;
    if (!settings->contours && speed == 0 && strcmp(cases_name(cases, 0), "speed_m_s") == 0 &&
        strcmp(cases_name(cases, 1), "angle_deg") == 0)
        merge_normal_speeds(&chart->panel[0], cases, rows, 0, 1);
    const bool drawn = chart_draw(chart, path, why);
    chart_release(chart);
    return drawn;
}

/* A panel of the history: its place, and the two arrays it shows. */
struct history_panel {
    double left, right;
    const char *title, *quantity, *unit, *dimensionless, *key;
    size_t array[2]; /* numbers in arrays_of() */
    const char *name[2];
};

static const struct history_panel panels[] = {
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

static void plot_panel(FILE *commands, const struct history_panel *panel, const restitute_history *history,
                       bool physical)
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
                i ? ", " : "plot ", time.factor, panel->array[i] + 1, scale.factor, chart_colour(i ? 0.75 : 0.25),
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
