/* history_internal.h - the list of operations, the sheet's positions in it, and checkpoints.
 *
 *     ops     put   air   step x 300        blot   step x 200        put
 *            +-----+-----+-----------------+------+-----------------+-----+
 *              0     1     2                 3      4                 5
 *                                  ^                    ^                  ^
 *                       at {2, 180}           now {4, 60}            count 6
 *
 * `now` is the position that the user sees. `at` is the position of the machine's fields,
 * which are brought to `now` before they are read (sheet_ready). Operations from `now` on
 * are undone. While a saved run is followed, operations are listed but not performed, and
 * `at` stays behind.
 */
#ifndef LUTETIA_PAPER_HISTORY_INTERNAL_H
#define LUTETIA_PAPER_HISTORY_INTERNAL_H

#include "event/event.h"
#include "history.h"
#include "history/tiles.h"

#include <log.h>

/* What the program did (history/notes.c): an operation, whose kind is `what`, or a move in
 * the history. */
enum note_move {
    NOTE_UNDO = 240, /* in files: never changed */
    NOTE_REDO,
    NOTE_SEEK,
    NOTE_INSERT,
    NOTE_INSERT_END,
    NOTE_REMOVE,
    NOTE_REMOVE_LEAVING_TIME,
    NOTE_CHANGE,
    NOTE_INSERT_BEFORE,
    NOTE_MOVES_END
};
struct note {
    int what;
    long number;     /* of an operation its steps; of a move a count, a time, or whether it is
                  * kept */
    uint64_t digest; /* of an operation: digest of its arguments */
};
struct notes {
    struct note *at;
    int count, room;
    bool lost;    /* a note was lost for want of memory */
    int repeated; /* while they are followed: how many were repeated; and steps of the next */
    long steps;
};

/* A position: after the operations before `op`, and `step` steps of it. op < 0: unknown. */
struct position {
    int op, step;
};

struct checkpoint {
    struct position position;
    long work; /* number of operations and steps before it */
    struct paper_air air;
    struct event_bytes extras;
    struct planes_copy *planes;
    bool pinned; /* a saved state: kept until it has been reached */
};

enum { CHECKPOINTS_MAX = 256, CHECKPOINT_EVERY = 24, CHECKPOINT_SPARED = 16 };

/* Hears of each operation that is listed (`move` 0; joined: of a step, it went to the last
 * operation), and of each move. */
typedef void (*history_teller)(void *context, const struct event_record *op, bool joined,
                               enum note_move move, long number);

struct sheet_history {
    history_teller tell; /* NULL: nobody hears */
    void *tell_context;
    struct event_log log; /* the operations; their kinds are enum sheet_event_kind */
    struct position now, at;
    struct paper_air air;  /* history_air()'s */
    long work;             /* at `at` */
    double spared;         /* of the steps since the last checkpoint, by boxes */
    long exchanges_before; /* the sheet's, before the stroke that is being painted */
    long steps_before;     /* the sheet's time before the operation that is being performed */
    bool open;             /* further steps may be joined to the last operation */
    struct notes notes;
    bool following, diverged;
    long resumed;               /* the time at which the saved run had been followed to its
                               * end; -1: not yet */
    bool loaded;                /* the fields hold the saved state, at the end of the notes */
    struct checkpoint *saved;   /* ... or this checkpoint does; NULL: neither, or it is among
                               * the points */
    bool unfinished;            /* an operation was done since the last step */
    bool performing;            /* calls made now are part of an operation */
    bool painting;              /* the fields hold `now` and the stroke that grows so far */
    struct position painted_at; /* `at` when it began */
    bool changing;              /* the first operation of `tail` is being replaced */
    int inserting_at;           /* operations before it cannot be undone; -1: no insertion */
    struct event_record *tail;  /* the operations after the insertion */
    int tail_count;
    struct {
        int op,
            /* the last insertion's operations; count 0: something was done or moved since */
            count;
        bool split; /* it divided the steps around it */
    } inserted;
    struct checkpoint points[CHECKPOINTS_MAX]; /* by position */
    int points_count;
    struct planes_copy *known; /* what the planes were at the last checkpoint that was taken or
                                * given back; NULL: nobody knows */
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
/* Owns: a history takes the operation over, or the caller frees it by event_record_free(). */
enum paper_status operation_make(const struct paper_sheet *p, enum sheet_event_kind kind,
                                 const void *arguments, struct event_record *op);
/* Errors: BAD_FILE, NO_MEMORY. Owns: the caller frees *arguments by event_free(). */
enum paper_status operation_arguments(const struct paper_sheet_config *config,
                                      const struct event_record *op, void **arguments);
/* Takes op over, also on failure. Errors: NO_MEMORY. */
enum paper_status history_append(struct sheet_history *h, struct event_record op);
/* Removes operations from `now` on. Errors: NO_MEMORY. */
enum paper_status history_cut(struct sheet_history *h);
/* Splits an operation so that there is a boundary at the position. Errors: NO_MEMORY. */
enum paper_status history_split(struct sheet_history *h, struct position position);
/* Removes the operations of the last insertion, which must be h->inserted. */
void history_insertion_remove(struct sheet_history *h);

/* ---- as bytes, one by one (history/run.c): for a run and for a journal ---- */

/* Names of the kinds, in the order of their numbers here; and the numbers here of those that
 * were written. Errors: BAD_FILE. */
void history_names_put(struct event_bytes *b);
enum paper_status history_names_get(struct event_reader *r, int kinds[256]);
/* An operation. Errors: BAD_FILE, NO_MEMORY. Owns: the caller frees *op by
 * event_record_free(). */
void history_operation_put(struct event_bytes *b, const struct event_record *op);
enum paper_status history_operation_get(struct event_reader *r, const struct paper_sheet *p,
                                        const int kinds[256], struct event_record *op);
int history_brush_of(enum sheet_event_kind kind, const void *arguments);
/* The brush that an operation makes, dips or leads; -1: none. Errors: BAD_FILE, NO_MEMORY. */
enum paper_status history_operation_brush(const struct paper_sheet *p,
                                          const struct event_record *op, int *brush);
/* Whether the operation is possible on this sheet after others. *brushes: a bit for each brush
 * that there is. Errors: BAD_FILE, NO_MEMORY. */
enum paper_status history_operation_check(const struct paper_sheet *p,
                                          const struct event_record *op, unsigned *brushes);

/* ---- again what a journal tells (history/retell.c) ---- */

/* NULL: none. */
struct sheet_history *history_of(const struct paper_sheet *p);
/* Lists the operation as if it had been done now; it is computed when somebody looks. Takes op
 * over, also on failure. Errors: BAD_FILE (not possible here), NO_MEMORY. */
enum paper_status history_retell(struct paper_sheet *p, struct event_record op, bool joined);
/* Makes the move. Errors: BAD_FILE (not possible here), NO_MEMORY. */
enum paper_status history_remake(struct paper_sheet *p, int move, long number);

/* ---- positions (history/positions.c) ---- */

/* Steps before the position; operations and steps before it. */
long history_time(const struct sheet_history *h, struct position position);
long history_work(const struct sheet_history *h, struct position position);
/* The position after all operations of that time; .op < 0: no such time before `end`. */
struct position history_position(const struct sheet_history *h, long time, struct position end);

/* ---- doing (history/history.c) ---- */

/* Checks and performs the operation, and records it if there is a history; or notes that it
 * was repeated. */
enum paper_status sheet_event(struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments);
/* Brings the fields to the user's position: called before every read. */
enum paper_status sheet_ready(struct paper_sheet *p);
/* The air at the user's position, which the fields may not have reached. */
const struct paper_air *history_air(const struct paper_sheet *p);
/* Destroys the sheet and its history. NULL is fine. */
void history_sheet_destroy(struct paper_sheet *p);

/* Lists an operation at `now`, which is the end of the list; *joined: as part of the last one.
 * Takes op over, also on failure. Errors: NO_MEMORY. */
enum paper_status history_record(struct sheet_history *h, struct event_record op, bool *joined);
/* Records an operation that has been performed, and took op's steps; takes op over, also on
 * failure. Errors: NO_MEMORY. */
enum paper_status history_keep(struct paper_sheet *p, struct event_record op);

/* ---- a stroke that grows (history/painting.c, half_stroke.c) ---- */

/* As the public functions of brush.h. */
enum paper_status history_stroke_begin(struct paper_sheet *p, int number, double pace);
enum paper_status history_stroke_add(struct paper_sheet *p,
                                     const struct paper_stroke_sample *samples, int count);
enum paper_status history_stroke_end(struct paper_sheet *p);
void history_stroke_drop(struct paper_sheet *p);
/* Errors: BAD_ARGUMENT while one grows. */
enum paper_status history_no_stroke(const struct paper_sheet *p);
/* Errors: BAD_ARGUMENT without a history, and while something is inserted or a stroke grows
 * (history/history.c). */
enum paper_status history_changeable(const struct paper_sheet *p);

/* ---- operations taken out or replaced (history/change.c, brushes_made.c) ---- */

/* Whether each brush that is dipped or leads is made before, if the log, followed by records
 * from `first` of the tail on, were the list. Errors: BAD_ARGUMENT (one is not), NO_MEMORY,
 * BAD_FILE. */
enum paper_status history_brushes_check(const struct paper_sheet *p, int without, int first);

/* ---- notes (history/notes.c) ---- */

void notes_add(struct notes *n, struct note note);
/* Makes the notes of a program that did the operations up to `now`. False: no memory. */
bool notes_derive(struct sheet_history *h);
void notes_free(struct notes *n);
/* True if the operation is the next of a run that is followed; *steps (may be NULL) gets its
 * number of steps, unless it is a step itself. Otherwise following ends. */
bool history_foreseen(struct sheet_history *h, struct note note, int *steps);
/* Notes the move, or compares it with the followed run. */
void history_moved(struct sheet_history *h, enum note_move what, long number);
/* Called after a followed operation: if it was the last, makes the saved state current. */
void history_followed(struct sheet_history *h);
/* Ends following: the program did something else. */
void history_stray(struct sheet_history *h);
/* Writes nothing if the notes follow from the operations. */
void notes_encode(struct event_bytes *b, const struct sheet_history *h);
/* Reads notes. False: no memory. kinds: the kinds of the file's numbers; -1: none. */
bool notes_decode(struct event_reader *r, const int kinds[256], struct notes *n);

/* ---- checkpoints (history/checkpoint.c) ---- */

/* Keeps a copy of the sheet at `at` if one is due and the budget allows it. Failing to do so
 * is no error. */
void checkpoint_offer(struct paper_sheet *p, bool now);
void checkpoints_drop_after(struct sheet_history *h, struct position position);
/* The last checkpoint at or before the position; NULL: none. */
const struct checkpoint *checkpoint_before(const struct sheet_history *h,
                                           struct position position);
enum paper_status checkpoint_restore(struct paper_sheet *p, const struct checkpoint *point);
/* Keeps a saved state as a checkpoint for the end of the notes. Errors: NO_MEMORY, the
 * source's. */
enum paper_status checkpoint_pin(struct paper_sheet *p, paper_plane_source source,
                                 void *context, const struct paper_air *air,
                                 const struct event_reader *extras);
/* The sheet has reached the checkpoint, which may be dropped from now on. */
void checkpoint_reached(struct sheet_history *h, const struct checkpoint *point);
/* Adds the saved state to the checkpoints, at `now`. */
void checkpoint_saved_place(struct sheet_history *h);
void checkpoint_saved_free(struct sheet_history *h);
/* Loads the saved state directly into the sheet. */
enum paper_status planes_load(struct paper_sheet *p, paper_plane_source source, void *context);
void checkpoints_free(struct sheet_history *h);

/* ---- what is in no plane, as bytes (history/saved_extras.c) ---- */

/* Encodes brushes with their contents, and whether there is salt or varnish. */
enum paper_status sheet_extras_encode(struct paper_sheet *p, struct event_bytes *b);
/* Checks the bytes against a sheet of this description. Errors: BAD_FILE, NO_MEMORY. */
enum paper_status sheet_extras_check(const struct paper_sheet *p,
                                     const struct event_reader *bytes);
/* Decodes bytes that this program made, or that sheet_extras_check() has accepted. Errors:
 * NO_MEMORY, MACHINE_FAILED. */
enum paper_status sheet_extras_decode(struct paper_sheet *p, struct event_reader *r);

#endif
