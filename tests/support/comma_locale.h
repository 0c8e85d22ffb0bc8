/* A locale that writes 1,5, made by localedef: machines for tests seldom have one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_COMMA_LOCALE_H
#define TEST_COMMA_LOCALE_H

#include <locale.h>
#include <stdlib.h>

#include "check.h"

/* Sets it, or skips the test and prints why. setlocale(LC_ALL, "C") is the way back, before
 * anything can fail. */
static inline void set_comma_locale(void)
{
    char folder[] = "/tmp/restitute-locale-XXXXXX", command[400];
    assert_non_null(mkdtemp(folder));
    snprintf(command, sizeof command,
             "printf 'LC_NUMERIC\\ndecimal_point \",\"\\nthousands_sep \"\"\\ngrouping -1\\nEND LC_NUMERIC\\n' "
             ">%s/comma.src && "
             "localedef -c -i %s/comma.src %s/comma >/dev/null 2>&1",
             folder, folder, folder);
    const int made = system(command); /* not 0 either way: other categories are missing */
    setenv("LOCPATH", folder, 1);
    const char *found = setlocale(LC_NUMERIC, "comma");
    unsetenv("LOCPATH");
    snprintf(command, sizeof command, "rm -r %s", folder);
    if (system(command)) print_message("%s is left\n", folder);
    if (found) {
        assert_int_equal(localeconv()->decimal_point[0], ',');
        return;
    }
    print_message("skipped: localedef makes no locale with a decimal comma here (%d)\n", made);
    skip();
}

#endif
