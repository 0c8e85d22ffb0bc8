/* The terms of a Prony series on their way from a file to the material: checked, with the line each
 * came from.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RESTITUTE_PRONY_TERMS_H
#define RESTITUTE_PRONY_TERMS_H

#include <restitute/restitute.h>

struct prony_terms {
    size_t count;
    double *relaxation_time; /* s */
    double *modulus;         /* Pa */
    size_t *line;            /* of the file that the term stands in */
};

/* Room for `count` terms, all zero. */
int rst_prony_terms_allocate(size_t count, struct prony_terms *terms, restitute_error *error);
void rst_prony_terms_release(struct prony_terms *terms);

/* Refuse values that are not finite and > 0 and two terms with one relaxation time; `file` is for
 * the message, the key names are those of the file's format. */
int rst_prony_terms_check(const struct prony_terms *terms, const char *file, const char *time_key,
                          const char *modulus_key, restitute_error *error);

/* Read the columns tau_s and G_Pa of a CSV file, and its fingerprint. */
int rst_prony_terms_read_csv(const char *path, struct prony_terms *terms, uint64_t *fingerprint,
                             restitute_error *error);

#endif
