/* Tables of all pairs of some materials.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

enum { most_materials = 1000 };

struct work;

struct job {
    struct work *work;
    int begins; /* no table before it has failed */
    restitute_table *table;
    int status;
    restitute_error why;
};

struct work {
    const restitute_material *const *materials;
    const restitute_scene *scene;
    const restitute_table_options *options;
    restitute_table_progress progress;
    void *data;
    struct job *job;
    size_t done, count;
    size_t failed; /* first table that failed, of those that are done; count: none */
};

/* The materials of table k, i <= j. */
static void pair_of(size_t k, size_t *i, size_t *j)
{
    for (*j = 0; (*j + 1) * (*j + 2) / 2 <= k; ++*j)
        ;
    *i = k - *j * (*j + 1) / 2;
}

/* After a failure tables before it are still built, so that the first failure is the same for any
 * number of threads. */
static void ask(void *of)
{
    struct job *job = of;
    job->begins = (size_t)(job - job->work->job) < job->work->failed;
}

static void tell(void *of)
{
    const struct job *job = of;
    struct work *w = job->work;
    const size_t k = (size_t)(job - w->job);
    if (job->status < 0 && k < w->failed) w->failed = k;
    w->done++;
    if (w->progress) w->progress(w->data, w->done, w->count);
}

static void one_at_a_time(void (*act)(void *of), void *of)
{
#ifdef _OPENMP
#pragma omp critical(rst_table_one_at_a_time)
#endif
    act(of);
}

static void turn(void *of, int thread, int64_t k)
{
    struct work *w = of;
    struct job *job = &w->job[k];
    restitute_material *unlike = NULL;
    restitute_scene scene = *w->scene;
    size_t i, j;
    (void)thread;
    job->work = w;
    one_at_a_time(ask, job);
    if (!job->begins) return;
    pair_of((size_t)k, &i, &j);
    scene.material = w->materials[i];
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    if (i != j) {
        job->status = restitute_material_effective(w->materials[i], w->materials[j], &unlike, &job->why);
        scene.material = unlike;
        scene.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    }
    if (job->status >= 0) job->status = rst_build(&scene, w->options, 1, &job->table, &job->why);
    restitute_material_destroy(unlike);
    one_at_a_time(tell, job);
}

/* The first failure, else the first remark. */
static int finish(const struct work *w, restitute_table **tables, restitute_error *error)
{
    size_t first = w->failed, i, j;
    for (size_t k = w->count; w->failed == w->count && k-- > 0;)
        if (w->job[k].status > 0) first = k;
    const int status = first < w->count ? w->job[first].status : RESTITUTE_OK;
    for (size_t k = 0; k < w->count; k++)
        if (status < 0)
            restitute_table_destroy(w->job[k].table);
        else
            tables[k] = w->job[k].table;
    if (status == RESTITUTE_OK) return rst_done(error);
    pair_of(first, &i, &j);
    return rst_report(error, status, "materials[%zu] and [%zu]: %.200s", i, j, w->job[first].why.message);
}

int restitute_table_build_many(size_t count, const restitute_material *const *materials, const restitute_scene *scene,
                               const restitute_table_options *options, restitute_table_progress progress, void *data,
                               restitute_table **tables, restitute_error *error)
{
    restitute_table_options own;
    restitute_scene all;
    if (!materials || !scene || !tables)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !materials ? "materials"
                          : !scene   ? "scene"
                                     : "tables");
    if (count < 1 || count > most_materials)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "count = %zu: must be in [1, %d]", count, most_materials);
    for (size_t i = 0; i < count; i++)
        if (!materials[i]) return rst_report(error, RESTITUTE_ERROR_NULL, "materials[%zu] is NULL", i);
    int status = rst_table_take_options(options, &own, error);
    if (!status) status = RST_TAKE(scene, &all, scene, error);
    if (status) return status;
    struct work w = {materials, &all, &own, progress, data, NULL, 0, count * (count + 1) / 2, 0};
    w.failed = w.count;
    w.job = calloc(w.count, sizeof *w.job);
    if (!w.job) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu tables", w.count);
    rst_loop(own.threads, (int64_t)w.count, turn, &w);
    status = finish(&w, tables, error);
    free(w.job);
    return status;
}
