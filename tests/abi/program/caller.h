/* A program that calls every public function, compiled with the headers of an earlier release. It
 * prints each call before it is made, and what came out. Behind its structs begins a page that
 * nobody may touch: a library that takes them for longer ones ends the program there.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CALLER_H
#define CALLER_H

#include <math.h>
#include <stdio.h>

#include <restitute/restitute.h>

/* n structs restitute_NAME, prepared. */
#define MANY(NAME, variable, n)                                                                                        \
    restitute_##NAME *const variable = guarded(n, sizeof *variable);                                                   \
    for (size_t i = 0; i < (n); i++)                                                                                   \
    restitute_##NAME##_init(&variable[i])
#define ONE(NAME, variable) MANY(NAME, variable, 1)

#define DONE(call) (puts(#call), done(call))
#define TEXT(call) (puts(#call), printf("    %s\n", call))
#define SHOW(...)                                                                                                      \
    (puts(#__VA_ARGS__), show(sizeof((const double[]){__VA_ARGS__}) / sizeof(double), (const double[]){__VA_ARGS__}))

extern restitute_error error;

void *guarded(size_t n, size_t size);
void done(int status);
void show(size_t n, const double *values);

/* A standard solid, and a sphere of it on a wall. */
restitute_material *rubber(void);
void ball(restitute_scene *scene, const restitute_material *material);

void call_core(void);
void call_contact(void);
void call_table(void);
void call_table_files(void);
void call_cvode(void);
void call_bem(void);
void call_files(void);
void call_fit(void);

#endif
