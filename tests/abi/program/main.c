/* See caller.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE /* MAP_ANONYMOUS */

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "caller.h"

restitute_error error;

static struct {
    const char *place;
    size_t n, size;
} given[100];
static size_t number;
static int failed;

void *guarded(size_t n, size_t size)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), whole = (n * size + page - 1) / page * page;
    char *pages = mmap(NULL, whole + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED || mprotect(pages + whole, page, PROT_NONE) != 0 || number == sizeof given / sizeof *given)
        abort();
    given[number].place = pages + whole - n * size, given[number].n = n, given[number].size = size;
    number++;
    return memset(pages + whole - n * size, 0xa5, n * size), pages + whole - n * size;
}

/* Within an array what is too long runs into the next one's struct_size. */
static void check_sizes(void)
{
    for (size_t g = 0; g < number; g++)
        for (size_t i = 0; i < given[g].n; i++)
            if (memcmp(given[g].place + i * given[g].size, &given[g].size, sizeof(size_t)) != 0)
                printf("struct_size of element %zu of %zu: not %zu any more\n", i, given[g].n, given[g].size),
                    failed = 1;
}

void done(int status)
{
    printf("    %d %s\n", status, status == RESTITUTE_OK ? "" : error.message);
    if (status < 0) failed = 1;
}

/* Nine digits: a constant that the compiler folds may differ from libm's in the last. */
void show(size_t n, const double *values)
{
    for (size_t i = 0; i < n; i++)
        printf("    %.9g\n", values[i]);
}

restitute_material *rubber(void)
{
    restitute_material *material;
    DONE(restitute_material_standard_solid(1e6, 2e6, 50, 0.5, &material, &error));
    return material;
}

void ball(restitute_scene *scene, const restitute_material *material)
{
    scene->material = material, scene->radius1 = 0.01, scene->mass1 = 4e-3, scene->friction = 0.3;
    scene->normal_speed = 0.2, scene->tangential_speed = 0.1;
}

int main(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0);
    call_core();
#ifdef RESTITUTE_WITH_CONTACT
    call_contact();
#endif
#ifdef RESTITUTE_WITH_TABLE
    call_table();
#endif
#ifdef RESTITUTE_WITH_TABLE_FILES
    call_table_files();
#endif
#ifdef RESTITUTE_WITH_CVODE
    call_cvode();
#endif
#ifdef RESTITUTE_WITH_BEM
    call_bem();
#endif
#ifdef RESTITUTE_WITH_FILES
    call_files();
#endif
#ifdef RESTITUTE_WITH_FIT
    call_fit();
#endif
    check_sizes();
    return failed;
}
