/* The reference values of tests/data.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_DATA_H
#define TEST_DATA_H

#include <stdio.h>
#include <string.h>

#include "check.h"

#ifdef RESTITUTE_TEST_DATA
#define TEST_DATA RESTITUTE_TEST_DATA
#elif defined(RESTITUTE_SOURCE_DIR)
#define TEST_DATA RESTITUTE_SOURCE_DIR "/tests/data"
#else
#define TEST_DATA "tests/data" /* started from the top of the source tree */
#endif

/* One row of impact_truth.csv. */
struct truth {
    double chi, psi, delta1, gamma;
    double ez, ex, err_ez, err_ex;
    double max_indentation, contact_time;
};

enum { truth_rows = 60, pib_terms = 30 };

static inline FILE *open_data(const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", TEST_DATA, name);
    FILE *file = fopen(path, "r");
    CHECK(file != NULL, "cannot read %s", path);
    return file;
}

/* All rows of impact_truth.csv. */
static inline void read_truth(struct truth rows[truth_rows])
{
    FILE *file = open_data("impact_truth.csv");
    char line[512];
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        struct truth t;
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t.chi, &t.psi, &t.delta1, &t.gamma, &t.ez, &t.ex,
                   &t.err_ez, &t.err_ex, &t.max_indentation, &t.contact_time) != 10)
            continue; /* comment or header */
        CHECK(count < truth_rows, "more rows than %d", truth_rows);
        rows[count++] = t;
    }
    fclose(file);
    CHECK(count == truth_rows, "%d rows", count);
}

/* The relaxation times (s) and moduli (Pa) of pib_prony.csv. */
static inline void read_pib(double tau[pib_terms], double g[pib_terms])
{
    FILE *file = open_data("pib_prony.csv");
    char line[512];
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        double time, modulus;
        if (sscanf(line, "%lf,%lf", &time, &modulus) != 2) continue;
        CHECK(count < pib_terms, "more terms than %d", pib_terms);
        tau[count] = time;
        g[count++] = modulus;
    }
    fclose(file);
    CHECK(count == pib_terms, "%d terms", count);
}

#endif
