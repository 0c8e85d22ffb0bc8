/* The data and the model of a fit: the constants, and the measured quantities that follow from
 * them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_MODEL_H
#define RST_FIT_MODEL_H

#include <restitute/fit.h>

enum rst_fit_kind { RST_FIT_EZ, RST_FIT_EX, RST_FIT_TIME, RST_FIT_KINDS };

/* One measured value. */
struct rst_fit_row {
    size_t point;
    enum rst_fit_kind kind;
    double measured, sigma;
};

/* An impact to be solved for every set of constants, and its T apart from a factor of its group. */
struct rst_fit_impact {
    restitute_scene scene;
    size_t group;
    int own; /* of one point */
    double time;
};

/* Impacts of a point: its own one, or `count` for interpolation. */
enum { RST_FIT_STENCIL = 6 };
struct rst_fit_place {
    double time, weight[RST_FIT_STENCIL];
    size_t first, count;
};

/* Results of a set of constants for a point. */
struct rst_fit_values {
    double of[RST_FIT_KINDS];
};

/* Distinct temperatures, ascending. Of the reference, and where no temperature was given, the value
 * may be NaN. */
struct rst_temperatures {
    double reference_value, c1, c2; /* NaN: the first one's; no law of shifts */
    size_t reference, count;
    double value[RESTITUTE_DMA_SHIFTS];
};

/* Copies of the points and options, what follows from them, and points of one temperature and
 * partner. */
struct rst_fit_data {
    size_t n, rows, groups;
    restitute_fit_point *points; /* their scenes are those below */
    restitute_scene *scene;
    restitute_fit_options options;
    double *memory; /* relaxation times and known constants */
    struct rst_fit_row *row;
    size_t needed; /* impacts, of a set of constants */
    struct rst_fit_impact *impact;
    size_t stride; /* one of so many own impacts is solved; rows of the others have no residual */
    struct rst_fit_place *place;
    size_t *group, *first, *at; /* group of a point; first point of a group; temperature of a point */
    struct rst_temperatures temperature;
    restitute_options solver;
    int64_t impacts; /* that were solved */
};

/* One solid and which of its constants are fitted. Constants: those of the solid, friction,
 * shifts. */
struct rst_fit_model {
    int kind;
    size_t solid, count;
    size_t friction, shift;                /* places; friction = count: none. shift: the first one */
    double known[RESTITUTE_FIT_CONSTANTS]; /* NaN: fitted */
    double centre[RESTITUTE_FIT_CONSTANTS], spread[RESTITUTE_FIT_CONSTANTS]; /* of the logarithm, for the starts */
    double viscosity; /* scale of one */
    int scaled;       /* contact times or a known constant set a scale; else 1 MPa is assumed */
    size_t free, index[RESTITUTE_FIT_CONSTANTS]; /* which are fitted */
};

/* points.c */
int rst_fit_data_create(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                        struct rst_fit_data *data, restitute_error *error);
void rst_fit_data_release(struct rst_fit_data *data);

/* A value out of its range is refused by its name; NaN is. */
int rst_fit_outside(const char *name, double value, double low, double high, restitute_error *error);

/* How many constants a solid has. */
size_t rst_fit_solid_constants(int kind, size_t terms);

/* The part of a standard solid that is constant i of an elastic, Kelvin-Voigt, standard solid or
 * Maxwell body. */
enum { RST_FIT_MODULUS1, RST_FIT_MODULUS2, RST_FIT_VISCOSITY, RST_FIT_PARTS };
int rst_fit_part(int kind, size_t i);

/* temperatures.c: sort what was measured at n places, of which `what` is the name for messages;
 * NaN: at the reference. */
int rst_temperatures_sort(size_t n, const double *measured, const char *what, struct rst_temperatures *temperatures,
                          size_t *at, restitute_error *error);

/* log10 a_T by the constants of Williams, Landel and Ferry. */
double rst_temperatures_wlf(const struct rst_temperatures *temperatures, size_t which);

/* model.c: the model of the options with the data's friction and shifts; `kind` may be a rival of
 * theirs. */
void rst_fit_model_make(const struct rst_fit_data *data, int kind, const double *known, struct rst_fit_model *model);
void rst_fit_name(const struct rst_fit_data *data, const struct rst_fit_model *model, size_t constant,
                  char name[RESTITUTE_FIT_NAME]);

/* Modulus of the elastic solid with this contact time at a point. */
double rst_fit_elastic_modulus(const struct rst_fit_data *data, size_t point, double contact_time);

/* All constants from logarithms of the fitted ones, which are kept within the range where impacts
 * can be solved. */
void rst_fit_constants(const struct rst_fit_model *model, const double *logs, double *constants);

int rst_fit_solid(const struct rst_fit_data *data, const struct rst_fit_model *model, const double *constants,
                  double shift, restitute_material **material, restitute_error *error);

/* Results of `sets` sets of constants at every point: values[set * n + point]. e_z is NaN where an
 * impact failed. */
int rst_fit_solve(struct rst_fit_data *data, const struct rst_fit_model *model, size_t sets, const double *constants,
                  struct rst_fit_values *values);

/* Every point by an impact of its own, with friction, whatever was measured. */
int rst_fit_solve_points(struct rst_fit_data *data, const struct rst_fit_model *model, const double *constants,
                         restitute_result *results);

/* Residual of a row, in its standard deviations; 0 if its impact was skipped. */
double rst_fit_residual(const struct rst_fit_data *data, size_t row, const struct rst_fit_values *values);

/* impacts.c: the impacts that are needed, and from them the values of the points. */
int rst_fit_impacts(struct rst_fit_data *data, restitute_error *error);
int rst_fit_passed_over(const struct rst_fit_data *data, size_t impact);

/* For the search of starts: about a hundred of the own impacts, or all of them. */
void rst_fit_thin(struct rst_fit_data *data, int thin);
void rst_fit_values(const struct rst_fit_data *data, const restitute_result *solved, struct rst_fit_values *values);

#endif
