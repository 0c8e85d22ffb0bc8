/* restitute: the command. It reads the command line, calls the library and writes what comes back.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "batch.h"
#include "fit.h"
#include "history.h"
#include "single.h"
#include "sweep.h"
#include "table.h"

static const char usage[] =
    "Usage: restitute pair [OPTION...]       the restitution pair (ez, ex) of one impact or of many\n"
    "       restitute history [OPTION...]    forces, radii and velocities during one impact\n"
    "       restitute sweep NAME|all [OPTION...]  the figures of the paper and more, remade and checked\n"
    "       restitute table ACTION [OPTION...]  build tables of pairs, look up in them\n"
    "       restitute fit [OPTION...]        material constants from measured impacts or a DMA curve\n"
    "       restitute pair --help, restitute history --help, and likewise for sweep, table and fit,\n"
    "       restitute --version\n"
    "\n"
    "Oblique impact of linear-viscoelastic spheres with friction. The manual is restitute(1).\n";

static const char licence[] = "Licence: BSD-3-Clause."
#ifdef RESTITUTE_WITH_BEM
                              " This build links FFTW, which is under the GNU General Public License, version 2 or\n"
                              "later, for the method bem: it can be passed on under that licence only."
#endif
#ifdef RESTITUTE_WITH_FIT
                              " This build links GSL, which is under the GNU General Public License, version 3 or\n"
                              "later, for the command fit: it can be passed on under that licence only."
#endif
                              "\n";

static int run_subcommand(int count, char **arguments)
{
    struct settings settings;
    int status = EXIT_DONE;
    const enum reading reading = options_read(count, arguments, &settings);
    if (reading == READING_FAILED)
        status = EXIT_USAGE;
    else if (reading == READING_GO_ON && settings.command == COMMAND_HISTORY)
        status = history_run(&settings);
    else if (reading == READING_GO_ON && settings.sweep)
        status = sweep_run(&settings);
    else if (reading == READING_GO_ON && settings.command == COMMAND_SWEEP && !settings.text[TEXT_INPUT] &&
             !settings.text[TEXT_GRID])
        status = complain("sweep: a figure, --grid or --input is missing; see restitute sweep --help");
    else if (reading == READING_GO_ON)
        status =
            settings.text[TEXT_INPUT] || settings.text[TEXT_GRID] ? batch_run(&settings, NULL) : single_run(&settings);
    options_release(&settings);
    return status;
}

/* A standard descriptor that is closed would become an output file, and messages would land in it. Opened in the wrong
 * direction it still cannot be used, so that a result that could not be printed is an error. */
static bool hold_standard_descriptors(void)
{
    static const int unusable[] = {O_WRONLY, O_RDONLY, O_RDONLY};
    for (int i = 0; i < 3; i++)
        if (fcntl(i, F_GETFD) < 0 && open("/dev/null", unusable[i]) != i) return false;
    return true;
}

/* No setlocale anywhere: numbers have a point in every country. */
int main(int count, char **arguments)
{
    const char *word = count > 1 ? arguments[1] : "";
    if (!hold_standard_descriptors()) return EXIT_USAGE;
    signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error as on a full disk */
    int status = EXIT_DONE;
    if (strcmp(word, "pair") == 0 || strcmp(word, "history") == 0 || strcmp(word, "sweep") == 0)
        status = run_subcommand(count, arguments);
    else if (strcmp(word, "table") == 0)
        status = table_main(count, arguments);
    else if (strcmp(word, "fit") == 0)
        status = fit_main(count, arguments);
    else if (strcmp(word, "--help") == 0)
        fputs(usage, stdout);
    else if (strcmp(word, "--version") == 0)
        printf("restitute %s\n%s", restitute_version(), licence);
    else
        status =
            *word ? complain(
                        "unknown command \"%.64s\": must be pair, history, sweep, table or fit; see restitute --help",
                        word)
                  : complain("a command is missing: pair, history, sweep, table or fit; see restitute --help");
    errno = 0;
    if ((fflush(stdout) != 0 || ferror(stdout)) && status == EXIT_DONE)
        status = complain("standard output cannot be written: %s", strerror(errno ? errno : EIO));
    return status;
}
