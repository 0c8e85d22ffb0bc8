/* gnuplot as a child process.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
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
    posix_spawnattr_t attributes;
    sigset_t defaults;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints, STDERR_FILENO);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int failed = posix_spawnp(process, "gnuplot", &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
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
    if (form != FORM_SVG && form != FORM_PNG) return refuse(why, "--figure = %.200s: must end in .svg or .png", path);
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
    else
        fprintf(commands,
                "set terminal pngcairo size %d,%d enhanced font 'Sans,12' fontscale 1.8 linewidth 2 pointscale "
                "2 background 'white'\n",
                2 * width, 2 * height);
}

bool gnuplot_open(const char *path, int width, int height, struct gnuplot *gnuplot, struct reason *why)
{
    int ends[2];
    memset(gnuplot, 0, sizeof *gnuplot);
    if (!output_open(path, &gnuplot->picture, why)) return false;
    gnuplot->complaints = tmpfile();
    if (!gnuplot->complaints || pipe(ends) != 0) {
        refuse(why, "%.200s: no pipe to gnuplot: %s", path, strerror(errno));
        if (gnuplot->complaints) fclose(gnuplot->complaints);
        output_abandon(&gnuplot->picture);
        return false;
    }
    signal(SIGPIPE, SIG_IGN); /* a gnuplot that dies is reported by its exit status */
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    const int failed =
        start("-d", ends[0], fileno(gnuplot->picture.stream), fileno(gnuplot->complaints), &gnuplot->process);
    close(ends[0]);
    gnuplot->commands = failed ? NULL : fdopen(ends[1], "w");
    if (!gnuplot->commands) {
        close(ends[1]);
        fclose(gnuplot->complaints);
        output_abandon(&gnuplot->picture);
        return refuse(why, "%.200s: gnuplot cannot be started: %s", path, strerror(failed));
    }
    set_terminal(path, width, height, gnuplot->commands);
    return true;
}

bool gnuplot_close(struct gnuplot *gnuplot, struct reason *why)
{
    char line[200] = "no message";
    const bool fed = fclose(gnuplot->commands) == 0;
    const bool well = ended_well(gnuplot->process);
    const bool drawn = well && fed && lseek(fileno(gnuplot->picture.stream), 0, SEEK_END) > 0;
    rewind(gnuplot->complaints);
    while (!drawn && fgets(line, sizeof line, gnuplot->complaints) && strspn(line, " \t\r\n^") == strlen(line))
        continue;
    fclose(gnuplot->complaints);
    if (drawn) return output_finish(&gnuplot->picture, why);
    line[strcspn(line, "\r\n")] = '\0';
    refuse(why, "%.150s: gnuplot failed: %s", gnuplot->picture.place, line);
    output_abandon(&gnuplot->picture);
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
