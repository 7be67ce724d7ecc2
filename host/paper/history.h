/* history.h - the history of a sheet: the list of operations, which can be undone, changed and
 * redone.
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
 * A run is the sheet's description (with its seed) and the list of operations: each call that
 * changed the sheet, and the steps between them. The same list gives the same bits, so past
 * states need not be kept. They are computed again, from the nearest checkpoint (a copy of the
 * whole sheet), or from the fresh sheet. Going back and forth costs nothing; the sheet is
 * computed when it is read or changed.
 *
 * A moment is given by its time: the number of steps since the sheet was made.
 *
 * Errors, ownership and threads: as paper.h says.
 */
#ifndef LUTETIA_PAPER_HISTORY_H
#define LUTETIA_PAPER_HISTORY_H

#include "sheet.h"

/* Begins recording. A sheet's checkpoints take up to `budget_bytes` (0: none; earlier states
 * are then computed from the beginning). Errors: BAD_ARGUMENT unless the sheet is as it was
 * made, NO_MEMORY. */
enum paper_status paper_history_begin(struct paper_sheet *sheet, double budget_bytes);
/* Whether the sheet records. */
bool paper_history_has(const struct paper_sheet *sheet);

/* The number of operations done, and of undone operations that can be redone. */
int paper_history_done(const struct paper_sheet *sheet);
int paper_history_undone(const struct paper_sheet *sheet);
/* Whether a brush of that number exists at this point of the history. */
bool paper_history_brush(const struct paper_sheet *sheet, int number);
/* Steps gone by. */
long paper_sheet_steps(const struct paper_sheet *sheet);
/* The memory of the list and the checkpoints. */
double paper_history_bytes(const struct paper_sheet *sheet);

struct paper_moment {
    const char *what; /* "put", "air", "step", ... */
    long time;        /* steps gone by before it */
    long steps;       /* that it took */
};
/* Describes operation `number`, from 0, including undone ones; false if there is none. */
bool paper_history_moment(const struct paper_sheet *sheet, int number,
                          struct paper_moment *out);

/* What operation `number` put: amounts as in paper_sheet_put(), and where: x, y, width, height
 * (all of the sheet if there was no screen). *puts false: it put no amounts. Errors: BAD_FILE,
 * NO_MEMORY. */
enum paper_status paper_history_moment_put(const struct paper_sheet *sheet, int number,
                                           double amount[1 + PAPER_PIGMENTS_MAX], int box[4],
                                           bool *puts);

/* The arguments of operation `number`: the struct of sheet.h, brush.h, techniques.h or
 * arguments.h for what paper_moment calls "air", "put", "stroke", ...; NULL for those without
 * any ("step", "dry", "seal"). Errors: BAD_ARGUMENT (no such operation), BAD_FILE, NO_MEMORY;
 * *arguments is then NULL. Owns: the caller gives them to paper_history_arguments_free(), with
 * the same moment's `what`. */
enum paper_status paper_history_arguments(const struct paper_sheet *sheet, int number,
                                          void **arguments);
void paper_history_arguments_free(const char *what, void *arguments); /* NULL is fine */

/* Operation `number` as bytes, and what they say done again, on this or another sheet of the
 * same pigments (and size, for layers): as if its public function were called; of steps one.
 * Errors: of the first BAD_ARGUMENT (no such operation), NO_MEMORY; of the second BAD_FILE (no
 * such bytes), and the operation's own. Owns: the caller frees *bytes. */
enum paper_status paper_history_operation(const struct paper_sheet *sheet, int number,
                                          uint8_t **bytes, size_t *count);
enum paper_status paper_sheet_again(struct paper_sheet *sheet, const uint8_t *bytes,
                                    size_t count);

/* Consecutive steps are one operation, until another operation or a call of this function. */
void paper_history_mark(struct paper_sheet *sheet);

/* Undoes the last operations, or redoes operations; returns how many. A new operation after an
 * undo replaces the undone ones. Right after an insertion, all that was inserted is the last
 * operation; it is taken out, and cannot be redone. */
int paper_history_undo(struct paper_sheet *sheet, int count);
int paper_history_redo(struct paper_sheet *sheet, int count);
/* Goes to the sheet after that many steps, and all operations before the next step;
 * backwards, or forwards into undone operations. Errors: BAD_ARGUMENT (no such time). */
enum paper_status paper_history_seek(struct paper_sheet *sheet, long time);

/* Operations between these two calls are inserted at a time of the past, after the
 * operations of that time. All later operations then follow. Inserted steps delay them.
 * `keep` false: removes the insertion. Errors: BAD_ARGUMENT (no such time, or within another
 * insertion), NO_MEMORY. */
enum paper_status paper_history_insert_begin(struct paper_sheet *sheet, long time);
/* The same just before operation `number` (of those that are done), where many operations have
 * one time. Errors: BAD_ARGUMENT (no such operation, or within another insertion),
 * NO_MEMORY. */
enum paper_status paper_history_insert_before(struct paper_sheet *sheet, int number);
/* Without an insertion nothing happens. Errors: BAD_ARGUMENT (within a stroke that is being
 * made), NO_MEMORY. */
enum paper_status paper_history_insert_end(struct paper_sheet *sheet, bool keep);

/* Takes operation `number` (of those that are done) out of the past; what followed it flows
 * anew when somebody looks. With `leave_time` the steps that it took stay, so that all else
 * dries as it did: a stroke with a pace. What had been undone is dropped, and the removal
 * itself cannot be undone. Errors: BAD_ARGUMENT (no such operation; later ones use the brush
 * that it made; while something is inserted, changed or painted), NO_MEMORY. */
enum paper_status paper_history_remove(struct paper_sheet *sheet, int number, bool leave_time);

/* What is done between these two calls takes the place of operation `number`: another amount,
 * pigment or way of a stroke say, from paper_history_arguments(). Undo goes back as far as to
 * the beginning. Without `keep` the operation is as it was. Errors: as paper_history_remove();
 * if later operations use a brush that is no longer made, the change has not ended. */
enum paper_status paper_history_change_begin(struct paper_sheet *sheet, int number);
enum paper_status paper_history_change_end(struct paper_sheet *sheet, bool keep);

/* Called after every step and operation while the past is computed again, with the steps done
 * and how many there are; returns false to stop. The call that needed it then fails with
 * MACHINE_FAILED, "stopped", and may be repeated: it goes on where it was. NULL: no call. */
typedef bool (*paper_history_watch)(void *context, long done, long total);
void paper_history_set_watch(struct paper_sheet *sheet, paper_history_watch watch,
                             void *context);

/* The same run on a sheet `scale` times as wide and high, from 1/64 to 64: places, lengths,
 * grain of the paper and the width of edges are scaled, and each step becomes `pace` steps
 * (scale * scale: diffusion, levelling and drying keep their shapes), in which
 * proportionally less sinks in, dries and settles. docs/paper.md lists what does not scale.
 * *out has a history of its own if `budget_bytes` is not negative. Errors: BAD_ARGUMENT (a
 * size that cannot be), NO_MEMORY, MACHINE_FAILED, ... Owns: the caller destroys *out. */
enum paper_status paper_history_render(struct paper_sheet *sheet, double scale, double pace,
                                       double budget_bytes, struct paper_sheet **out);

/* ---- states, for files ---- */

enum { PAPER_PLANES_MAX = 21 + 3 * PAPER_PIGMENTS_MAX };
/* The parts of a sheet that change are held in planes, each with a word of 4 bytes for each
 * fiber. */
struct paper_plane {
    char name[40];
    bool whole; /* uint32_t, else float */
    int since;  /* the first version of the model that has it (PAPER_MODEL_VERSION) */
};
int paper_sheet_planes(const struct paper_sheet *sheet,
                       struct paper_plane planes[PAPER_PLANES_MAX]);
int paper_config_planes(const struct paper_sheet_config *config,
                        struct paper_plane planes[PAPER_PLANES_MAX]);
/* Shape: height * width words, rows from the top. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_plane_read(struct paper_sheet *sheet, int number, void *words);

/* The sheet's description and its operations, as bytes. Owns: the caller frees *bytes. Errors:
 * BAD_ARGUMENT (no history), NO_MEMORY. */
enum paper_status paper_history_encode(struct paper_sheet *sheet, uint8_t **bytes,
                                       size_t *count);
/* Decodes only the description, with the size of the sheet. Errors: BAD_FILE. */
enum paper_status paper_history_describe(const uint8_t *bytes, size_t count,
                                         struct paper_sheet_config *config);
/* Whether two descriptions are of the same sheet. */
bool paper_sheet_config_same(const struct paper_sheet_config *a,
                             const struct paper_sheet_config *b);

/* Gets plane `number` of a saved state. */
typedef enum paper_status (*paper_plane_source)(void *context, int number, void *words);

/* Makes the sheet that was saved, with its history. With `follow` it begins as a fresh
 * sheet, and a program repeats what was done, including undos, redos and insertions. Nothing
 * is computed, unless the program reads the sheet, until it reaches the end of what was
 * saved. If the program does something else, its operations up to there are computed, and
 * the saved state is dropped. Errors: BAD_FILE, NO_MEMORY, MACHINE_FAILED, and those of the
 * source. Owns: the caller destroys *out. */
enum paper_status paper_history_decode(const uint8_t *bytes, size_t count, bool follow,
                                       double budget_bytes, paper_plane_source source,
                                       void *context, struct paper_sheet **out);
/* The number of operations that the program is still expected to repeat, and the time at
 * which it had repeated all (-1: not yet); whether it has done something else. */
int paper_history_following(const struct paper_sheet *sheet);
long paper_history_resumed(const struct paper_sheet *sheet);
bool paper_history_diverged(const struct paper_sheet *sheet);

#endif
