/* Pieces of a fit.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "pieces.h"

#include <pthread.h>
#include <stdlib.h>

#include <restitute/fit.h>

/* Impacts of a piece: some tenths of a second of oblique ones at the precision of the end. */
enum { PIECE = 200 };

struct rst_pieces {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t handed;
    int (*work)(void *own);
    void *own;
    int works; /* whose turn: the work's, or the caller's */
    int ended, unwanted, status;
    size_t impacts; /* of this piece */
};

/* Gives the turn to the other side and waits until it is back. With the lock held. */
static void hand_over(struct rst_pieces *p, int works)
{
    p->works = works;
    pthread_cond_signal(&p->handed);
    while (p->works == works)
        pthread_cond_wait(&p->handed, &p->lock);
}

static void *work(void *own)
{
    struct rst_pieces *p = own;
    pthread_mutex_lock(&p->lock);
    while (!p->works)
        pthread_cond_wait(&p->handed, &p->lock);
    if (!p->unwanted) p->status = p->work(p->own);
    p->ended = 1;
    p->works = 0;
    pthread_cond_signal(&p->handed);
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

int rst_pieces_create(int (*of)(void *own), void *own, struct rst_pieces **pieces)
{
    struct rst_pieces *p = calloc(1, sizeof *p);
    if (!p) return RESTITUTE_ERROR_MEMORY;
    p->work = of, p->own = own;
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->handed, NULL);
    if (pthread_create(&p->thread, NULL, work, p)) {
        pthread_cond_destroy(&p->handed);
        pthread_mutex_destroy(&p->lock);
        free(p);
        return RESTITUTE_ERROR_MEMORY;
    }
    *pieces = p;
    return RESTITUTE_OK;
}

int rst_pieces_run(struct rst_pieces *p, int *ended)
{
    pthread_mutex_lock(&p->lock);
    p->impacts = 0;
    if (!p->ended) hand_over(p, 1);
    *ended = p->ended;
    pthread_mutex_unlock(&p->lock);
    return p->status;
}

int rst_pieces_pause(struct rst_pieces *p, size_t impacts)
{
    if (!p) return RESTITUTE_OK;
    p->impacts += impacts;
    if (p->impacts >= PIECE && !p->unwanted) hand_over(p, 0); /* the lock is held by the work while it works */
    return p->unwanted ? RESTITUTE_ERROR_INTERNAL : RESTITUTE_OK;
}

void rst_pieces_destroy(struct rst_pieces *p)
{
    if (!p) return;
    pthread_mutex_lock(&p->lock);
    p->unwanted = 1;
    if (!p->ended) hand_over(p, 1);
    pthread_mutex_unlock(&p->lock);
    pthread_join(p->thread, NULL);
    pthread_cond_destroy(&p->handed);
    pthread_mutex_destroy(&p->lock);
    free(p);
}
