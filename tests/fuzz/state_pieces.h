/* state_pieces.h - a saved state taken apart: its run in pieces, its planes, and where both are in a file in which nothing is
 * deflated. What is changed in a piece can be put together again (state_pieces_join()), or into the file where it is. */
#ifndef LUTETIA_TESTS_STATE_PIECES_H
#define LUTETIA_TESTS_STATE_PIECES_H

#include <event/event.h>
#include <history.h>

enum { PIECES_MAX = 64 };

struct piece {
    uint8_t *at;
    size_t count;
};

/* magic to air; now; names; extras; operations with their heads; notes. */
enum { PIECE_BEGIN, PIECE_NOW, PIECE_NAMES, PIECE_EXTRAS, PIECE_OPERATIONS };
enum { OPERATION_HEAD = 1 + 4 + 8 + 8 };

struct state_pieces {
    struct piece piece[PIECES_MAX];
    int count; /* the last one is the notes */
    uint8_t *planes[PAPER_PLANES_MAX];
    int planes_count;
    /* in a file, in which nothing is deflated */
    uint8_t *file;
    size_t file_count, run_at, run_count, plane_at[PAPER_PLANES_MAX];
};

/* The sheet `which`: 0 with all operations, 1 with something undone and inserted besides, 2 the thesis's paper. Its file is made
 * under that path. */
void state_pieces_make(struct state_pieces *s, int which, const char *path);

/* The run of these pieces. The caller frees out->at. */
void state_pieces_join(const struct piece *piece, int count, struct event_bytes *out);

#endif
