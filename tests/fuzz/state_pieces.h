/* state_pieces.h - a saved state taken apart: the pieces of its run, its planes, and their
 * places in a file in which nothing is deflated. Changed pieces can be joined again
 * (state_pieces_join()), or written into the file at their places. */
#ifndef LUTETIA_TESTS_STATE_PIECES_H
#define LUTETIA_TESTS_STATE_PIECES_H

#include <event/event.h>
#include <history.h>

enum { PIECES_MAX = 64 };

struct piece {
    uint8_t *at;
    size_t count;
};

/* The pieces: magic to air; now; names; extras; one for each operation with its head; notes. */
enum { PIECE_BEGIN, PIECE_NOW, PIECE_NAMES, PIECE_EXTRAS, PIECE_OPERATIONS };
enum { OPERATION_HEAD = 1 + 4 + 8 + 8 };

struct state_pieces {
    struct piece piece[PIECES_MAX];
    int count; /* the last one is the notes */
    uint8_t *planes[PAPER_PLANES_MAX];
    int planes_count;
    /* the same in a file in which nothing is deflated */
    uint8_t *file;
    size_t file_count, run_at, run_count, plane_at[PAPER_PLANES_MAX];
};

/* Takes a sheet apart and writes its file. which: 0 with all operations, 1 also with undone and
 * inserted ones on a sheet with a deckle, 2 the thesis's paper. */
void state_pieces_make(struct state_pieces *s, int which, const char *path);

/* Joins pieces to a run. The caller frees out->at. */
void state_pieces_join(const struct piece *piece, int count, struct event_bytes *out);

#endif
