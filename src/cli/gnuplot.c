/* gnuplot as a child process.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file_form.h"

extern char **environ;

/* Start `gnuplot argument` with these files as its standard input, output and error. Returns 0 or an errno. */
static int start(const char *argument, int input, int output, int complaints, pid_t *process)
{
    char *const arguments[] = {(char *)"gnuplot", (char *)argument, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints, STDERR_FILENO);
    const int failed = posix_spawnp(process, "gnuplot", &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

/* Wait; true if it ended by itself with status 0. */
static bool ended_well(pid_t process)
{
    int status;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool gnuplot_check(const char *path, struct reason *why)
{
    const enum file_form form = file_form_of(path);
    if (form != FORM_SVG && form != FORM_PNG && form != FORM_PDF)
        return refuse(why, "--figure = %.200s: must end in .svg, .png or .pdf", path);
    pid_t process;
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    const int failed = nothing < 0 ? errno : start("--version", nothing, nothing, nothing, &process);
    if (nothing >= 0) close(nothing);
    if (failed || !ended_well(process))
        return refuse(why,
                      "--figure = %.150s: needs the program gnuplot, which does not run here (%s); on Debian: the "
                      "package gnuplot-nox",
                      path, failed ? strerror(failed) : "it fails");
    return true;
}

static void set_terminal(const char *path, int width, int height, FILE *commands)
{
    fputs("set encoding utf8\n", commands);
    if (file_form_of(path) == FORM_SVG)
        fprintf(commands, "set terminal svg size %d,%d enhanced font 'Helvetica,14' background 'white'\n", width,
                height);
    else if (file_form_of(path) == FORM_PDF) /* fonts as large beside the axes as in SVG */
        fprintf(commands,
                "set terminal pdfcairo size %g,%g enhanced font 'Sans,14' fontscale 0.53 linewidth 1.4 background "
                "'white'\n",
                width / 100.0, height / 100.0);
    else
        fprintf(commands,
                "set terminal pngcairo size %d,%d enhanced font 'Sans,12' fontscale 1.8 linewidth 2 pointscale "
                "2 background 'white'\n",
                2 * width, 2 * height);
}

bool gnuplot_open(const char *path, int width, int height, struct gnuplot *gnuplot, struct reason *why)
{
    if (!output_open(path, &gnuplot->picture, why)) return false;
    gnuplot->commands = tmpfile();
    if (!gnuplot->commands) {
        outputs_abandon(&gnuplot->picture, 1);
        return refuse(why, "%.200s: no temporary file for gnuplot: %s", path, strerror(errno));
    }
    set_terminal(path, width, height, gnuplot->commands);
    return true;
}

/* All that comes out of a descriptor. */
static void receive(int descriptor, FILE *stream)
{
    char bytes[4096];
    ssize_t count;
    while ((count = read(descriptor, bytes, sizeof bytes)) > 0 || (count < 0 && errno == EINTR))
        if (count > 0) fwrite(bytes, 1, (size_t)count, stream);
}

/* Let gnuplot draw what the commands say. Returns 0, an errno, or -1 if it failed by itself. */
static int draw(const struct gnuplot *gnuplot, FILE *complaints)
{
    int ends[2];
    pid_t process;
    if (!complaints || fflush(gnuplot->commands) != 0) return errno;
    if (ferror(gnuplot->commands)) return EIO; /* part of the commands is lost */
    if (lseek(fileno(gnuplot->commands), 0, SEEK_SET) < 0 || pipe(ends) != 0) return errno;
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    const int failed = start("-d", fileno(gnuplot->commands), ends[1], fileno(complaints), &process);
    close(ends[1]);
    if (!failed) receive(ends[0], gnuplot->picture.stream);
    close(ends[0]);
    return failed ? failed : ended_well(process) ? 0 : -1;
}

bool gnuplot_close(struct gnuplot *gnuplot, struct reason *why)
{
    char line[200] = "no message";
    FILE *complaints = tmpfile();
    int failed = draw(gnuplot, complaints);
    if (!failed && ftell(gnuplot->picture.stream) <= 0) failed = -1;
    fclose(gnuplot->commands);
    if (complaints) rewind(complaints);
    while (failed == -1 && fgets(line, sizeof line, complaints) && strspn(line, " \t\r\n^") == strlen(line))
        continue;
    if (complaints) fclose(complaints);
    if (!failed) return output_finish(&gnuplot->picture, why);
    line[strcspn(line, "\r\n")] = '\0';
    refuse(why, "%.150s: gnuplot failed: %s", gnuplot->picture.path, failed == -1 ? line : strerror(failed));
    outputs_abandon(&gnuplot->picture, 1);
    return false;
}

void gnuplot_string(FILE *commands, const char *text)
{
    /* Between single quotes gnuplot expands nothing; only the quote itself and line ends could get out of them. */
    fputc('\'', commands);
    for (; *text; text++) {
        if (*text == '\'') fputc('\'', commands);
        fputc((unsigned char)*text < 32 || *text == 127 ? ' ' : *text, commands);
    }
    fputc('\'', commands);
}
