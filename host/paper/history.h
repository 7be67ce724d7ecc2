/* history.h - a sheet's time as something one edits: what was done to it is a list, and it can be undone, changed and done again.
 *
 *     paper_history_begin(sheet, 256e6);
 *     paper_sheet_put(sheet, &disc, 10, 10, amount);
 *     for (int step = 0; step < 300; step++)
 *         paper_sheet_step(sheet);
 *     paper_history_undo(sheet, 1);              // the 300 steps: as if they had not been
 *     paper_history_redo(sheet, 1);
 *     paper_history_insert_begin(sheet, 100);    // back to step 100,
 *     paper_sheet_blot(sheet, &cloth, 0, 0, 1, 0);
 *     paper_history_insert_end(sheet, true);     // and what followed, after it
 *     paper_sheet_view(sheet, &view, rgb);       // computed when it is looked at
 *
 * A run is the sheet's description (with its seed) and the list of operations: each call that changed the sheet, and the steps
 * between them. The same list gives the same bits, so a state of the past need not be kept: it is computed again, from the nearest
 * copy of the whole sheet that is (a checkpoint), or from the fresh sheet. Nothing is computed before the sheet is
 * looked at or changed: going back and forth is free.
 *
 * Moments are told by their time, the steps gone by since the sheet was made.
 *
 * Errors and threads: as paper.h says. */
#ifndef LUTETIA_PAPER_HISTORY_H
#define LUTETIA_PAPER_HISTORY_H

#include "sheet.h"

/* Records from here on. A sheet's checkpoints take up to `budget_bytes` (0: none; what is undone is then computed from the
 * beginning). Errors: BAD_ARGUMENT unless the sheet is as it was made, NO_MEMORY. */
enum paper_status paper_history_begin(struct paper_sheet *sheet, double budget_bytes);
bool paper_history_has(const struct paper_sheet *sheet);

/* Operations that are done, and those undone that can be done again. */
int paper_history_done(const struct paper_sheet *sheet);
int paper_history_undone(const struct paper_sheet *sheet);
/* Whether a brush of that number has been made by now. */
bool paper_history_brush(const struct paper_sheet *sheet, int number);
/* Steps gone by. */
long paper_sheet_steps(const struct paper_sheet *sheet);
/* Memory that the list and the checkpoints take. */
double paper_history_bytes(const struct paper_sheet *sheet);

struct paper_moment {
    const char *what; /* "put", "air", "step", ... */
    long time;        /* steps gone by before it */
    long steps;       /* that it took */
};
/* Operation `number` from 0, also of those undone; false when there is none. */
bool paper_history_moment(const struct paper_sheet *sheet, int number,
                          struct paper_moment *out);

/* Steps that follow each other are one operation, until something else is done or this is called. */
void paper_history_mark(struct paper_sheet *sheet);

/* Takes back the last operations, or does them again; returns how many. What is done after undoing takes the place of what was
 * undone. */
int paper_history_undo(struct paper_sheet *sheet, int count);
int paper_history_redo(struct paper_sheet *sheet, int count);
/* To the sheet after so many steps and all that was done before the next one, backwards, or forwards into what was undone.
 * Errors: BAD_ARGUMENT (no such time). */
enum paper_status paper_history_seek(struct paper_sheet *sheet, long time);

/* What is done between these two is done at a time of the past, after what was done then, and all that followed is done after it
 * again. Steps among it delay what follows. `keep` false: as if nothing had been inserted.
 * Errors: BAD_ARGUMENT (no such time, or within another insertion), NO_MEMORY. */
enum paper_status paper_history_insert_begin(struct paper_sheet *sheet, long time);
enum paper_status paper_history_insert_end(struct paper_sheet *sheet, bool keep);

/* While something is computed again this is asked after every step; false: stop. The call that needed it fails then with
 * MACHINE_FAILED, "stopped", and may be tried again. NULL: nobody is asked. */
typedef bool (*paper_history_watch)(void *context, long done, long total);
void paper_history_set_watch(struct paper_sheet *sheet, paper_history_watch watch,
                             void *context);

/* The same run on a sheet `scale` times as wide and high, from 1/64 to 64: places, lengths, grain of the paper and the width of edges
 * are scaled, and each step becomes `pace` steps (scale * scale: diffusion, levelling and drying keep their shapes) in which as
 * much less sinks in, dries and settles. docs/paper.md says what does not scale. *out has a history of its own if `budget_bytes` is
 * not negative. Errors: BAD_ARGUMENT (a size that cannot be), NO_MEMORY, MACHINE_FAILED, ... Owns: the caller
 * destroys *out. */
enum paper_status paper_history_render(struct paper_sheet *sheet, double scale, double pace,
                                       double budget_bytes, struct paper_sheet **out);

/* ---- states, for files ---- */

enum { PAPER_PLANES_MAX = 20 + 3 * PAPER_PIGMENTS_MAX };
/* What changes in a sheet is held in planes of one word of 4 bytes for each fiber. */
struct paper_plane {
    char name[40];
    bool whole; /* uint32_t, else float */
};
int paper_sheet_planes(const struct paper_sheet *sheet,
                       struct paper_plane planes[PAPER_PLANES_MAX]);
int paper_config_planes(const struct paper_sheet_config *config,
                        struct paper_plane planes[PAPER_PLANES_MAX]);
/* Shape: height * width words, rows from the top. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_plane_read(struct paper_sheet *sheet, int number, void *words);

/* The sheet's description and its operations, as bytes. Owns: the caller frees *bytes. Errors: BAD_ARGUMENT (no history),
 * NO_MEMORY. */
enum paper_status paper_history_encode(struct paper_sheet *sheet, uint8_t **bytes,
                                       size_t *count);
/* Only the description: what a sheet of that state takes. Errors: BAD_FILE. */
enum paper_status paper_history_describe(const uint8_t *bytes, size_t count,
                                         struct paper_sheet_config *config);
/* Sees whether two descriptions are of the same sheet. */
bool paper_sheet_config_same(const struct paper_sheet_config *a,
                             const struct paper_sheet_config *b);

/* Gives plane `number` of a saved state. */
typedef enum paper_status (*paper_plane_source)(void *context, int number, void *words);

/* Makes the sheet that was saved, with its history. With `follow` it begins as a fresh one, and a program that does again what was
 * done, also what it undid, redid and inserted, has nothing computed, unless it looks, until it comes to the end of what was
 * saved; where it does something else, it goes its own way from there, and what it did up to there is computed.
 * Errors: BAD_FILE, NO_MEMORY, MACHINE_FAILED, and what the source says. Owns: the caller destroys *out. */
enum paper_status paper_history_decode(const uint8_t *bytes, size_t count, bool follow,
                                       double budget_bytes, paper_plane_source source,
                                       void *context, struct paper_sheet **out);
/* What the program is still expected to do again, and the time at which it had done all (-1: not yet); whether it has gone its own
 * way. */
int paper_history_following(const struct paper_sheet *sheet);
long paper_history_resumed(const struct paper_sheet *sheet);
bool paper_history_diverged(const struct paper_sheet *sheet);

#endif
