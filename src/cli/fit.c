/* `restitute fit`: a thin caller of restitute/fit.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit.h"

#ifdef RESTITUTE_WITH_FIT
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "figure.h"
#include "fit_settings.h"
#include "output.h"
#include "places.h"

static volatile sig_atomic_t stopped;

static void on_signal(int number)
{
    stopped = 1;
    signal(number, SIG_DFL); /* a second one does not wait for the end of a batch */
}

static bool check_outputs(const struct fit_settings *s, const struct fit_input *input, struct reason *why)
{
    struct places places = {0};
    const char *output = s->text[FIT_OUTPUT], *figure = s->text[FIT_FIGURE];
    const char *ending = output ? strrchr(output, '.') : NULL;
    if (output && (!ending || strcmp(ending, ".json") != 0))
        return refuse(why, "--output = %.200s: a material file must end in .json", output);
    if (!output_check(output, "--output", why) || (figure && !figure_check(figure, why))) return false;
    places_read(&places, "--input", s->text[FIT_INPUT]);
    places_read(&places, "--dma", s->text[FIT_DMA]);
    places_read_materials(&places, &input->materials);
    if (output) {
        places_write(&places, "--output", output);
        places_write_beside(&places, "--output", output, ".meta.json");
    }
    if (figure) places_write(&places, "--figure", figure);
    return places_check(&places, why);
}

static int is_stopped(void *data)
{
    (void)data;
    return stopped;
}

/* All pieces, with progress; false: failed or stopped by a signal. A DMA curve comes in one piece: there signals end the
 * program as they always do, and nothing was written. */
static bool run(restitute_fitter *fitter, struct reason *why)
{
    restitute_error error;
    double done = 0;
    char text[60];
    int status = RESTITUTE_OK;
    if (signal(SIGINT, SIG_IGN) != SIG_IGN) signal(SIGINT, on_signal);
    if (signal(SIGTERM, SIG_IGN) != SIG_IGN) signal(SIGTERM, on_signal);
    while (done < 1 && !status) {
        status = restitute_fitter_run(fitter, &done, &error);
        snprintf(text, sizeof text, "fit: %.0f %%", 100 * done);
        if (isatty(STDERR_FILENO)) fprintf(stderr, "\rrestitute: %-70s%s", text, done < 1 && !status ? "" : "\n");
    }
    return !stopped && (!status || refuse(why, "%s", error.message));
}

/* Remarks are printed; those that a caller in a script must not overlook make another exit status. */
static int finish(bool done, int flags, const char *remarks, const struct reason *why)
{
    if (!done && stopped && !why->text[0]) return EXIT_INTERRUPTED;
    if (!done) return complain("%s", why->text);
    for (const char *line = remarks, *end; (end = strchr(line, '\n')); line = end + 1)
        complain("remark: %.*s", (int)(end - line), line);
    return flags & (RESTITUTE_FIT_FLAG_UNDETERMINED | RESTITUTE_FIT_FLAG_MISFIT | RESTITUTE_FIT_FLAG_UNFINISHED)
               ? EXIT_SOME_FAILED
               : EXIT_DONE;
}

static int fit_points(const struct fit_settings *s, const struct fit_input *input)
{
    restitute_fitter *fitter = NULL;
    restitute_fit_result result;
    restitute_error error;
    struct reason why = {""};
    restitute_fit_options options = s->options;
    options.interrupted = is_stopped;
    restitute_fit_result_init(&result);
    const bool done = (restitute_fitter_create(input->n, input->points, &options, &fitter, &error) >= 0 ||
                       fit_input_place(input, error.message, &why)) &&
                      run(fitter, &why) &&
                      (restitute_fitter_result(fitter, &result, &error) >= 0 || refuse(&why, "%s", error.message)) &&
                      fit_write(s, input, fitter, &result, &why);
    restitute_fitter_destroy(fitter);
    restitute_material_destroy(result.material);
    return finish(done, result.flags, result.remarks, &why);
}

static int fit_curve(const struct fit_settings *s, const struct fit_input *input)
{
    restitute_dma_result result;
    restitute_error error;
    struct reason why = {""};
    restitute_dma_result_init(&result);
    const bool done = (restitute_dma_fit(input->n, input->frequency, input->storage, input->loss, input->temperature,
                                         &s->dma, &result, &error) >= 0 ||
                       fit_input_place(input, error.message, &why)) &&
                      fit_write_dma(s, input, &result, &why);
    restitute_material_destroy(result.material);
    return finish(done, result.flags, result.remarks, &why);
}

int fit_main(int count, char **arguments)
{
    struct fit_settings settings;
    struct fit_input input;
    struct reason why;
    const enum reading reading = fit_options_read(count, arguments, &settings);
    int status = reading == READING_STOP ? EXIT_DONE : EXIT_USAGE;
    if (reading == READING_GO_ON) {
        const bool good = fit_input_read(&settings, &input, &why) && check_outputs(&settings, &input, &why);
        status = !good                      ? complain("%s", why.text)
                 : settings.text[FIT_INPUT] ? fit_points(&settings, &input)
                                            : fit_curve(&settings, &input);
        fit_input_release(&input);
    }
    fit_options_release(&settings);
    return status;
}
#else
int fit_main(int count, char **arguments)
{
    (void)count;
    (void)arguments;
    return complain("fit: this build has no component fit, which needs GSL");
}
#endif
