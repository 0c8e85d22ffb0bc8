/* What the programs of the extreme campaign share (docs/records/extremes.md): faults, each with the
 * number of the case that shows it, and the numbers of a case whose program crashed or hangs.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCHMARK_EXTREMES_H
#define BENCHMARK_EXTREMES_H

#include <fenv.h>
#include <signal.h>
#include <stdarg.h>
#include <unistd.h>

#include "../support/prepared.h"
#include "../support/random.h"
#include "../support/remarks.h"

enum { shown_faults = 20 };

static long faults;
static volatile long current; /* case */

/* Counts a fault; the first ones are described. */
static inline void fault(const char *form, ...)
{
    va_list list;
    if (++faults > shown_faults) return;
    printf("FAULT case %ld: ", current);
    va_start(list, form);
    vprintf(form, list);
    va_end(list);
    printf("\n");
    fflush(stdout);
}

#define EXPECT(condition, ...) ((condition) ? (void)0 : fault(__VA_ARGS__))

static void report_signal(int number)
{
    char text[64];
    const int length = snprintf(text, sizeof text, "case %ld: signal %d\n", current, number);
    _exit(write(STDOUT_FILENO, text, (size_t)length) < 0 ? 4 : 3);
}

static inline void watch_signals(void)
{
    static const int numbers[] = {SIGALRM, SIGSEGV, SIGFPE, SIGABRT, SIGBUS, SIGILL};
    for (int k = 0; k < 6; k++)
        signal(numbers[k], report_signal);
}

/* Hosts may trap what a call of the library must not raise. */
static inline void expect_no_exception(const char *what)
{
    const int raised = fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    EXPECT(!raised, "%s raises the floating-point flags %#x", what, (unsigned)raised);
    feclearexcept(FE_ALL_EXCEPT);
}

/* The first message of each form. */
static inline void print_remarks(const struct remark remarks[most_remarks])
{
    for (int k = 0; k < most_remarks && remarks[k].count > 0; k++)
        printf("%8ld times status %d: %s\n", remarks[k].count, remarks[k].status, remarks[k].text);
}

/* The largest value, and its case. */
struct worst {
    double value;
    long number;
};

static inline void keep_worst(struct worst *worst, double value)
{
    if (value > worst->value) *worst = (struct worst){value, current};
}

/* The random numbers of a case: the same whatever was run before. */
static inline uint64_t random_of(uint64_t seed, long number)
{
    uint64_t random = seed ^ ((uint64_t)number * UINT64_C(0xd1342543de82ef95));
    random_bits(&random);
    return random;
}

#endif
