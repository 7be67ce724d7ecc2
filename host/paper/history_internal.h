/* history_internal.h - the list of operations, where the sheet is in it, and checkpoints.
 *
 *     ops     put   air   step x 300        blot   step x 200        put
 *            +-----+-----+-----------------+------+-----------------+-----+
 *              0     1     2                 3      4                 5
 *                                  ^                    ^                  ^
 *                       at {2, 180}           now {4, 60}            count 6
 *
 * `now` is what the sheet is to its user; `at` is what the machine's fields hold, and is brought to `now` when somebody looks
 * (sheet_ready). Operations from `now` on are undone, or, while a saved run is followed, expected. */
#ifndef LUTETIA_PAPER_HISTORY_INTERNAL_H
#define LUTETIA_PAPER_HISTORY_INTERNAL_H

#include "event.h"
#include "history.h"

struct operation {
    enum sheet_event_kind kind;
    int steps;      /* that it takes */
    uint8_t *bytes; /* arguments, deflated if stored < raw */
    size_t raw, stored;
};

/* Operations before `op`, and `step` steps of it. op < 0: unknown. */
struct position {
    int op, step;
};

struct plane_copy {
    int users;
    uint32_t words[];
};

struct checkpoint {
    struct position position;
    long work; /* operations and steps before it */
    struct paper_air air;
    struct event_bytes extras;
    double plane_bytes;
    int planes_count;
    struct plane_copy *planes[PAPER_PLANES_MAX];
};

enum { CHECKPOINTS_MAX = 256, CHECKPOINT_EVERY = 24 };

struct sheet_history {
    struct operation *ops;
    int count, room;
    struct position now, at;
    long work;         /* at `at` */
    long steps_before; /* of the sheet, before what is performed */
    bool open;         /* the last operation's steps may get more */
    bool following, diverged;
    bool unfinished;  /* something was done since the last step */
    bool performing;  /* what is asked for meanwhile is a part of the operation */
    int inserting_at; /* operations before it are not undone; -1: no insertion */
    struct operation *tail;
    int tail_count;
    struct checkpoint points[CHECKPOINTS_MAX]; /* by position */
    int points_count;
    bool pinned; /* the last checkpoint is a saved state: it stays until it has been reached */
    double budget_bytes, held_bytes, ops_bytes;
    paper_history_watch watch;
    void *watch_context;
};

static inline int position_compare(struct position a, struct position b)
{
    return a.op != b.op ? (a.op > b.op) - (a.op < b.op) : (a.step > b.step) - (a.step < b.step);
}

/* ---- operations (history_list.c) ---- */

enum paper_status operation_make(const struct paper_sheet *p, enum sheet_event_kind kind,
                                 const void *arguments, struct operation *op);
void operation_free(struct operation *op);
bool operation_same(const struct operation *a, const struct operation *b);
/* Errors: BAD_FILE, NO_MEMORY. Owns: the caller frees *arguments by event_free(). */
enum paper_status operation_arguments(const struct paper_sheet_config *config,
                                      const struct operation *op, void **arguments);
/* Takes op over, also when it fails. Errors: NO_MEMORY. */
enum paper_status history_append(struct sheet_history *h, struct operation op);
/* What is from `now` on is gone. Errors: NO_MEMORY. */
enum paper_status history_cut(struct sheet_history *h);
/* Makes a boundary between operations at the position. Errors: NO_MEMORY. */
enum paper_status history_split(struct sheet_history *h, struct position position);
void history_free(struct sheet_history *h);

/* ---- checkpoints (checkpoint.c) ---- */

/* Keeps a copy of the sheet as it is `at` if it is time for one and the budget allows; that it cannot is no failure. */
void checkpoint_offer(struct paper_sheet *p, bool now);
void checkpoints_drop_after(struct sheet_history *h, struct position position);
/* The last at or before the position; NULL: none. */
const struct checkpoint *checkpoint_before(const struct sheet_history *h,
                                           struct position position);
enum paper_status checkpoint_restore(struct paper_sheet *p, const struct checkpoint *point);
/* A saved state as one that stays. Errors: NO_MEMORY, the source's. */
enum paper_status checkpoint_pin(struct paper_sheet *p, paper_plane_source source,
                                 void *context, const struct paper_air *air,
                                 const struct event_reader *extras);
/* The state straight into the sheet. */
enum paper_status planes_load(struct paper_sheet *p, paper_plane_source source, void *context);
void checkpoints_free(struct sheet_history *h);

/* ---- planes (sheet_planes.c) ---- */

/* As the fields hold it. */
enum paper_status sheet_plane_fetch(struct paper_sheet *p, int number, void *words);
/* Between paper_enter() and paper_leave(). */
void sheet_plane_write(struct paper_sheet *p, int number, const void *words);
/* After all have been written: what follows from them. */
void sheet_planes_written(struct paper_sheet *p);
/* What is in no plane: brushes with what they hold, whether there is salt or varnish. */
enum paper_status sheet_extras_encode(struct paper_sheet *p, struct event_bytes *b);
/* Errors: BAD_FILE (only what bytes from outside can bring about), NO_MEMORY, MACHINE_FAILED. */
enum paper_status sheet_extras_decode(struct paper_sheet *p, struct event_reader *r);
void sheet_extras_reset(struct paper_sheet *p);
/* The sheet is as it was made. */
enum paper_status sheet_reset(struct paper_sheet *p);

#endif
