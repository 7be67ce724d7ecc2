/* history_internal.h - the list of operations, where the sheet is in it, and checkpoints.
 *
 *     ops     put   air   step x 300        blot   step x 200        put
 *            +-----+-----+-----------------+------+-----------------+-----+
 *              0     1     2                 3      4                 5
 *                                  ^                    ^                  ^
 *                       at {2, 180}           now {4, 60}            count 6
 *
 * `now` is what the sheet is to its user; `at` is what the machine's fields hold, and is brought to `now` when somebody looks
 * (sheet_ready). Operations from `now` on are undone. While a saved run is followed, operations are listed and not performed: `at`
 * stays behind. */
#ifndef LUTETIA_PAPER_HISTORY_INTERNAL_H
#define LUTETIA_PAPER_HISTORY_INTERNAL_H

#include "event/event.h"
#include "history.h"

#include <log.h>

/* What the program did (history/notes.c): an operation, whose kind is `what`, or a move. */
enum note_move {
    NOTE_UNDO = 240, /* in files: never changed */
    NOTE_REDO,
    NOTE_SEEK,
    NOTE_INSERT,
    NOTE_INSERT_END,
    NOTE_MOVES_END
};
struct note {
    int what;
    long number; /* steps of an operation; of a move how many, when, or whether it is kept */
    uint64_t digest; /* of an operation's arguments */
};
struct notes {
    struct note *at;
    int count, room;
    bool lost;    /* there was no memory for one */
    int repeated; /* while they are followed: how many; and steps of the next */
    long steps;
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
    bool pinned; /* a saved state: it stays until it has been reached */
};

enum { CHECKPOINTS_MAX = 256, CHECKPOINT_EVERY = 24 };

struct sheet_history {
    struct event_log log; /* the operations: kinds are enum sheet_event_kind */
    struct position now, at;
    struct paper_air air; /* history_air()'s */
    long work;            /* at `at` */
    long steps_before;    /* of the sheet, before what is performed */
    bool open;            /* the last operation's steps may get more */
    struct notes notes;
    bool following, diverged;
    long resumed;             /* when the saved run had been followed to its end; -1: not yet */
    bool loaded;              /* the fields hold what is where the notes end */
    struct checkpoint *saved; /* ... or this does; NULL: neither, or it is among the points */
    bool unfinished;          /* something was done since the last step */
    bool performing;          /* what is asked for meanwhile is a part of the operation */
    int inserting_at;         /* operations before it are not undone; -1: no insertion */
    struct event_record *tail; /* what follows the insertion */
    int tail_count;
    struct checkpoint points[CHECKPOINTS_MAX]; /* by position */
    int points_count;
    double budget_bytes, held_bytes;
    paper_history_watch watch;
    void *watch_context;
};

static inline int position_compare(struct position a, struct position b)
{
    return a.op != b.op ? (a.op > b.op) - (a.op < b.op) : (a.step > b.step) - (a.step < b.step);
}

/* ---- operations (history/list.c) ---- */

static inline enum sheet_event_kind operation_kind(const struct event_record *op)
{
    return (enum sheet_event_kind)op->kind;
}
/* Owns: a history takes it over, or the caller frees it by event_record_free(). */
enum paper_status operation_make(const struct paper_sheet *p, enum sheet_event_kind kind,
                                 const void *arguments, struct event_record *op);
/* Errors: BAD_FILE, NO_MEMORY. Owns: the caller frees *arguments by event_free(). */
enum paper_status operation_arguments(const struct paper_sheet_config *config,
                                      const struct event_record *op, void **arguments);
/* Takes op over, also when it fails. Errors: NO_MEMORY. */
enum paper_status history_append(struct sheet_history *h, struct event_record op);
/* What is from `now` on is gone. Errors: NO_MEMORY. */
enum paper_status history_cut(struct sheet_history *h);
/* Makes a boundary between operations at the position. Errors: NO_MEMORY. */
enum paper_status history_split(struct sheet_history *h, struct position position);

/* ---- positions (history/positions.c) ---- */

/* Steps before the position; operations and steps before it. */
long history_time(const struct sheet_history *h, struct position position);
long history_work(const struct sheet_history *h, struct position position);
/* After all that was done by that time; .op < 0: there is no such time before `end`. */
struct position history_position(const struct sheet_history *h, long time, struct position end);

/* ---- doing (history/history.c) ---- */

/* Checks, performs and, where there is a history, records it; or takes note that it is done already. */
enum paper_status sheet_event(struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments);
/* Sees that the sheet is what its history says: before every look at it. */
enum paper_status sheet_ready(struct paper_sheet *p);
/* Of the sheet as it is to its user, who may not have looked yet. */
const struct paper_air *history_air(const struct paper_sheet *p);
/* The sheet with its history. NULL is fine. */
void history_sheet_destroy(struct paper_sheet *p);

/* ---- notes (history/notes.c) ---- */

void notes_add(struct notes *n, struct note note);
/* Those of a program that did the operations up to `now`. False: no memory. */
bool notes_derive(struct sheet_history *h);
void notes_free(struct notes *n);
/* True: it is the next of a run that is followed; *steps (may be NULL) gets what it took, if it is no step itself. Else nothing is
 * followed any more. */
bool history_foreseen(struct sheet_history *h, struct note note, int *steps);
/* Notes the move, or sees that it was foreseen. */
void history_moved(struct sheet_history *h, enum note_move what, long number);
/* After what was foreseen has been done: if it was the last, the saved state is there. */
void history_followed(struct sheet_history *h);
/* The program goes its own way. */
void history_stray(struct sheet_history *h);
/* Nothing where they follow from the operations. */
void notes_encode(struct event_bytes *b, const struct sheet_history *h);
/* False: no memory. kinds: what the file's numbers stand for; -1: nothing. */
bool notes_decode(struct event_reader *r, const int kinds[256], struct notes *n);

/* ---- checkpoints (history/checkpoint.c) ---- */

/* Keeps a copy of the sheet as it is `at` if it is time for one and the budget allows; that it cannot is no failure. */
void checkpoint_offer(struct paper_sheet *p, bool now);
void checkpoints_drop_after(struct sheet_history *h, struct position position);
/* The last at or before the position; NULL: none. */
const struct checkpoint *checkpoint_before(const struct sheet_history *h,
                                           struct position position);
enum paper_status checkpoint_restore(struct paper_sheet *p, const struct checkpoint *point);
/* A saved state, for where the notes end. Errors: NO_MEMORY, the source's. */
enum paper_status checkpoint_pin(struct paper_sheet *p, paper_plane_source source,
                                 void *context, const struct paper_air *air,
                                 const struct event_reader *extras);
/* The sheet is as it says: it may go. */
void checkpoint_reached(struct sheet_history *h, const struct checkpoint *point);
/* It is among the checkpoints from here on, at `now`. */
void checkpoint_saved_place(struct sheet_history *h);
void checkpoint_saved_free(struct sheet_history *h);
/* The state straight into the sheet. */
enum paper_status planes_load(struct paper_sheet *p, paper_plane_source source, void *context);
void checkpoints_free(struct sheet_history *h);

/* ---- what is in no plane, as bytes (history/extras.c) ---- */

/* Brushes with what they hold, whether there is salt or varnish. */
enum paper_status sheet_extras_encode(struct paper_sheet *p, struct event_bytes *b);
/* Whether the bytes are what a sheet of this description can have. Errors: BAD_FILE, NO_MEMORY. */
enum paper_status sheet_extras_check(const struct paper_sheet *p,
                                     const struct event_reader *bytes);
/* The bytes are good: this program made them, or sheet_extras_check() has seen them. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status sheet_extras_decode(struct paper_sheet *p, struct event_reader *r);

#endif
