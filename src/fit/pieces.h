/* A fit in pieces: its work runs on a thread of its own and takes turns with the caller's, so that only one runs at any time.
 * The work may lie deep within GSL where a piece ends, which is why it is not cut by hand.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_PIECES_H
#define RST_FIT_PIECES_H

#include <stddef.h>

struct rst_pieces;

/* `work` begins with the first rst_pieces_run. Returns a restitute_status. */
int rst_pieces_create(int (*work)(void *own), void *own, struct rst_pieces **pieces);

/* The caller's side: the next piece. Returns what the work returned, if this was its last one. */
int rst_pieces_run(struct rst_pieces *pieces, int *ended);

/* The work's side: `impacts` more were solved. Negative: the caller wants no more, the work has to return this at once.
 * Without pieces (NULL) nothing happens. */
int rst_pieces_pause(struct rst_pieces *pieces, size_t impacts);

/* The caller's side: ends the work wherever it is. NULL is allowed. */
void rst_pieces_destroy(struct rst_pieces *pieces);

#endif
