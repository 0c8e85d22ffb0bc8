/* What every part of the command shares: exit statuses, messages on standard error, numbers as text.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_MESSAGE_H
#define CLI_MESSAGE_H

#include <stdbool.h>
#include <stddef.h>

enum exit_status { EXIT_DONE = 0, EXIT_SOME_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* One line that tells why something cannot be done. */
struct reason {
    char text[400];
};

/* Make a text harmless to a terminal: control characters, and what is no UTF-8, become \xNN. Cut to
 * `size` bytes. */
void escape(char *text, size_t size);

/* Write the reason down; always returns false, so that a check can end with `return refuse(...)`. */
bool refuse(struct reason *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Print "restitute: ..." and a newline on standard error; returns EXIT_USAGE. */
int complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The shortest decimal text that reads back as exactly this number; "inf" and "nan" as such. */
struct number_text {
    char text[32];
};
struct number_text number_text(double value);

/* A copy on the heap; ends the program if there is no memory for it. */
char *copy_of(const char *text);

/* Memory, zeroed; ends the program if there is none. */
void *allocate(size_t count, size_t size);
void out_of_memory(void) __attribute__((noreturn));

#endif
