/* Materials read once and kept, so that a case file may name the same one in every row.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_MATERIALS_H
#define CLI_MATERIALS_H

#include <restitute/files.h>

#include "message.h"

struct material_entry {
    struct material_entry *next;
    char *path;
    char *series;                 /* path of the CSV that it names as prony_csv; NULL: none */
    restitute_material *material; /* NULL: could not be read, and `why` tells the reason */
    restitute_material_info info;
    struct reason why;
};

/* Two materials as one solid. */
struct material_pair {
    struct material_pair *next;
    const struct material_entry *first, *second;
    restitute_material *material;
};

/* A solid of numbers: modulus2 infinite: Kelvin-Voigt, viscosity 0: elastic, modulus1 0: Maxwell. With a base: that
 * solid instead, its times multiplied by `shift`. */
struct solid_numbers {
    const struct material_entry *base;
    double modulus1, modulus2, viscosity, poisson, shift;
};

struct material_made {
    struct material_made *next;
    struct solid_numbers numbers;
    struct material_entry entry;
};

struct materials {
    struct material_entry *first;
    struct material_made *made; /* the latest first */
    struct material_pair *pairs;
    void *by_path, *by_members; /* the same as search trees: a case file may name another material in every row */
};

/* The material of this file, read on first use. NULL if it cannot be read. It belongs to `materials`. */
const struct material_entry *materials_get(struct materials *materials, const char *path, struct reason *why);

/* The solid that this material and the one in the file `partner` are to each other, made on first use; NULL: refused.
 * */
const restitute_material *materials_pair(struct materials *materials, const struct material_entry *entry,
                                         const char *partner, struct reason *why);

/* A solid of numbers; NULL: refused. */
const struct material_entry *materials_make(struct materials *materials, const struct solid_numbers *numbers,
                                            struct reason *why);

void materials_release(struct materials *materials);

#endif
