/* The command line of `restitute fit`, and what its input holds.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FIT_SETTINGS_H
#define CLI_FIT_SETTINGS_H

#include <restitute/fit.h>

#include "arguments.h"
#include "files/csv_table.h"
#include "problem.h"

enum fit_text {
    /* of impacts alone */
    FIT_PARTNER,
    FIT_MODEL,
    FIT_TERMS,
    FIT_KNOWN,
    FIT_LOSS,
    FIT_CONFIDENCE,
    FIT_STARTS,
    FIT_SEED,
    FIT_THREADS,
    /* of both kinds */
    FIT_INPUT,
    FIT_DMA,
    FIT_REFERENCE,
    FIT_WLF,
    FIT_NOISE,
    FIT_NAME,
    FIT_OUTPUT,
    FIT_FIGURE,
    FIT_TEXTS
};

struct fit_settings {
    char *text[FIT_TEXTS];    /* as given; NULL: not given */
    char *field[FIELD_COUNT]; /* of the scene, likewise */
    struct values values;     /* of the scene, for all rows */
    bool tension;
    restitute_fit_options options;
    double terms[20], known[RESTITUTE_FIT_CONSTANTS]; /* arrays of the options */
    restitute_dma_options dma;
    int argument_count;
    const char *const *arguments;
};

extern const char *const fit_models[]; /* names, from RESTITUTE_FIT_MODEL_ELASTIC on */

/* STOP: help was printed, FAILED: a complaint. To be released in any case. */
enum reading fit_options_read(int count, char **arguments, struct fit_settings *settings);
void fit_options_release(struct fit_settings *settings);

/* The measurements of --input or --dma. */
struct fit_input {
    const char *source;
    struct rst_csv *csv;
    struct materials materials; /* of partners */
    size_t n;
    double *numbers; /* of the columns */
    restitute_fit_point *points;
    restitute_scene *scenes;                                /* of the points */
    const double *frequency, *storage, *loss, *temperature; /* of --dma; temperature NULL: no such column */
};

bool fit_input_read(struct fit_settings *settings, struct fit_input *input, struct reason *why);
void fit_input_release(struct fit_input *input);

/* A library's message that names points[i] or row[i], with the line of the file instead. Always false. */
bool fit_input_place(const struct fit_input *input, const char *message, struct reason *why);

/* Report, material file and figure. */
bool fit_write(const struct fit_settings *settings, const struct fit_input *input, const restitute_fitter *fitter,
               const restitute_fit_result *result, struct reason *why);
bool fit_write_dma(const struct fit_settings *settings, const struct fit_input *input,
                   const restitute_dma_result *result, struct reason *why);

#endif
