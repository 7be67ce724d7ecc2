/* studio_session.h - what a hand does, done to a sheet: tools, strokes, undo. Without a window
 * and without threads of its own.
 *
 *     struct studio_session *session;
 *     if (studio_session_create(&config, 256e6, &session) != PAPER_OK)
 *         die(paper_error());
 *     studio_session_set(session, STUDIO_WIDTH, 40);
 *     studio_session_point(session, &(struct studio_point){.kind = STUDIO_POINT_DOWN, .time_s = 0, .x = 40, .y = 60, .pressure = 0.5});
 *     studio_session_point(session, &(struct studio_point){.kind = STUDIO_POINT_UP, .time_s = 1, .x = 300, .y = 90, .pressure = 0.5});
 *     studio_session_steps(session, 60);
 *     studio_session_undo(session);
 *
 * A deed is what one undo takes back: a stroke with the brush and the dip before it, a wash, a
 * drop, type, drying; and the time after it. A deed begins with the tool and the settings of
 * that moment, and keeps them until the hand is lifted. Deeds are found in the sheet's own
 * history (history.h), so a sheet that was saved and opened again can be undone, too.
 *
 * After an undo time stands still, as long as there is something to redo: a step would be the
 * beginning of another present.
 *
 * Errors: as paper.h says, but the text is where studio_session_error() finds it. Threads: as
 * paper.h says. */
#ifndef LUTETIA_STUDIO_SESSION_H
#define LUTETIA_STUDIO_SESSION_H

#include "studio_settings.h"

#include <history.h>
#include <journal.h>

enum studio_point_kind {
    STUDIO_POINT_DOWN,
    STUDIO_POINT_MOVE,
    STUDIO_POINT_UP,
    STUDIO_POINT_DROP /* the deed that the hand has begun is given up */
};

struct studio_point {
    enum studio_point_kind kind;
    double time_s;         /* of any clock that does not go back */
    double x, y;           /* fibers */
    double pressure;       /* 0..1 */
    double tilt_x, tilt_y; /* radians */
};

/* Type as it is set on the sheet; numbers are in the settings. */
struct studio_type {
    const char *text, *font, *features; /* features "": none */
    double x, y;                        /* the origin of the first line */
};

struct studio_session;

/* Detail of this thread's last failure since it was forgotten, one line; "" if there was none,
 * never NULL. */
const char *studio_session_error(void);
void studio_session_error_forget(void);

enum paper_status studio_session_create(const struct paper_sheet_config *config,
                                        double budget_bytes, struct studio_session **out);
/* Opens what studio_session_save() saved, or any saved state with one sheet. Errors: as
 * paper_state_load(), and BAD_FILE of a sheet without parts. */
enum paper_status studio_session_open(const char *path, double budget_bytes,
                                      struct studio_session **out);
/* The same with what its journal tells (journal.h); state NULL: a sheet that was never
 * saved. */
enum paper_status studio_session_find(const char *journal, const char *state,
                                      double budget_bytes, struct paper_journal_found *found,
                                      struct studio_session **out);
void studio_session_destroy(struct studio_session *session); /* NULL is fine */
struct paper_sheet *studio_session_sheet(struct studio_session *session);

const struct studio_settings *studio_session_settings(const struct studio_session *session);
/* Errors: BAD_ARGUMENT outside of the range. */
enum paper_status studio_session_set(struct studio_session *session, int setting, double value);

/* ---- deeds ---- */

enum paper_status studio_session_point(struct studio_session *session,
                                       const struct studio_point *point);
/* Whether a hand is down; whether it paints a stroke, which is on the sheet already. */
bool studio_session_busy(const struct studio_session *session);
bool studio_session_grows(const struct studio_session *session);
/* The hand has rested so long: the paper goes on under it. Nothing where time stands still, or
 * no stroke is painted. */
enum paper_status studio_session_rest(struct studio_session *session, double seconds);
/* The sheet as it is looked at, by the settings. */
struct paper_sheet_view studio_session_view(const struct studio_session *session);
/* The steps that the paper has made under the stroke, or the last one; how many a second
 * strokes may ask for at the most (0: any). */
int studio_session_stroke_steps(const struct studio_session *session);
void studio_session_pace_most(struct studio_session *session, double pace);
/* A brush that is dipped, rinsed (clean water) or wiped: no deed of its own. */
enum studio_care { STUDIO_DIP, STUDIO_RINSE, STUDIO_WIPE };
enum paper_status studio_session_care(struct studio_session *session, enum studio_care care);
enum paper_status studio_session_dry(struct studio_session *session);
enum paper_status studio_session_seal(struct studio_session *session);
/* What the type covers, with its place on the sheet; the caller destroys *screen. Errors: as
 * paper_line_screen(). */
enum paper_status studio_session_type_screen(const struct studio_settings *settings,
                                             const struct studio_type *type,
                                             struct paper_screen *screen, int *x, int *y,
                                             uint32_t *missing);
enum paper_status studio_session_type(struct studio_session *session,
                                      const struct studio_type *type);

/* What is in the dish through a screen whose upper left corner is at x, y, as type. Errors: as
 * paper_sheet_put(). */
enum paper_status studio_session_put(struct studio_session *session,
                                     const struct paper_screen *screen, int x, int y);

/* A picture with its middle at a place, as the settings say. Errors: as
 * studio_stamp_place(), paper_sheet_put(), paper_sheet_print(). */
struct studio_stamp;
enum paper_status studio_session_stamp(struct studio_session *session,
                                       const struct studio_stamp *stamp, double x, double y);

/* ---- the selection (studio_selection.h) ---- */

/* The tool STUDIO_TOOL_SELECT selects: masking fluid lies around, until nothing is selected any
 * more. That is a deed, too; where nothing was selected it is none. Errors: BAD_ARGUMENT (a
 * hand is down), NO_MEMORY, MACHINE_FAILED. */
enum paper_status studio_session_select_none(struct studio_session *session);
/* What was not selected is, and the other way round; the same errors. */
enum paper_status studio_session_select_invert(struct studio_session *session);
/* The outline of what is selected, pairs of x, y; NULL: nothing is. Then, of each of its loops,
 * how many points there are up to its end. Owns: the session; valid until it is changed. */
const double *studio_session_selected(struct studio_session *session, int *count);
const int *studio_session_selected_loops(const struct studio_session *session, int *count);

/* ---- time ---- */

/* So many steps, fewer if time stands still. *done (may be NULL) gets how many. */
enum paper_status studio_session_steps(struct studio_session *session, int count, int *done);
/* Whether time stands still after an undo. */
bool studio_session_held(const struct studio_session *session);
/* Time goes on in the present, and what was undone is gone. */
void studio_session_go_on(struct studio_session *session);
/* Whether anything is wet, so that a step may change the sheet. */
bool studio_session_wet(const struct studio_session *session);

/* False: there is nothing to undo or redo. In mid-stroke the stroke alone is given up. */
bool studio_session_undo(struct studio_session *session);
bool studio_session_redo(struct studio_session *session);
/* Whether there is. */
bool studio_session_can_undo(const struct studio_session *session);
bool studio_session_can_redo(const struct studio_session *session);

/* ---- the past ---- */

/* Deeds in their order, with those that are undone. While something is inserted, what follows
 * it is not among them. */
struct studio_deed {
    const char *what; /* the operation: "stroke", "wash", "put", ...; or "selection" */
    long time, steps; /* gone by before it; that it took, with the time after it */
    bool done;
    bool marked;               /* a bookmark is in it, */
    char name[PAPER_NAME_MAX]; /* whose name is this */
};
/* Owns: the caller frees *deeds. Errors: NO_MEMORY. */
enum paper_status studio_session_deeds(const struct studio_session *session,
                                       struct studio_deed **deeds, int *count);
int studio_session_deeds_done(const struct studio_session *session);
/* Goes to the moment after so many deeds and the time after the last of them. An insertion ends
 * before, and is kept. Errors: BAD_ARGUMENT (there are not so many; a hand is down). */
enum paper_status studio_session_visit(struct studio_session *session, int deeds);
/* Whether an earlier moment is visited; whether something is being inserted there. A deed that
 * is begun there is inserted: it takes no time, and has the air of that moment. */
bool studio_session_visits(const struct studio_session *session);
bool studio_session_inserts(const struct studio_session *session);
/* Back to the present; what followed an insertion flows anew when somebody looks, and one undo
 * takes the insertion out. Errors: BAD_ARGUMENT (a hand is down), NO_MEMORY. */
enum paper_status studio_session_present(struct studio_session *session);
/* The visited moment is the present: what followed is as if it had been undone. */
void studio_session_from_here(struct studio_session *session);
/* Whether an undo gives back what was last taken out or changed as the next three do; the first
 * deed that is then another one. */
bool studio_session_change_waits(const struct studio_session *session);
/* Whether a redo takes it out, or changes it, again. */
bool studio_session_change_returns(const struct studio_session *session);
int studio_session_change_deed(const struct studio_session *session);
/* A bookmark at this moment (studio_bookmarks.c), or none any more where one is; going to the
 * one before or after it, or to the present where there is no later one. Errors: BAD_ARGUMENT
 * (nothing has been painted; something is inserted; a hand is down; what was undone would be
 * lost; there is no earlier one), NO_MEMORY. */
enum paper_status studio_session_bookmark(struct studio_session *session);
/* The bookmark at this moment gets a name; where none is there will be one. The same errors,
 * and BAD_ARGUMENT (a name of more than PAPER_NAME_MAX - 1 bytes). */
enum paper_status studio_session_bookmark_name(struct studio_session *session,
                                               const char *name);
enum paper_status studio_session_bookmark_visit(struct studio_session *session, bool later);
/* Of the last deed before the visited moment: takes it out, and its time stays; paints it with
 * what is in the dish now; gives a stroke the way of the hand's next one. The present is gone
 * to. Errors: BAD_ARGUMENT (no such deed; nothing of the dish was in it; no stroke; a hand is
 * down; something is inserted), NO_MEMORY, MACHINE_FAILED. */
enum paper_status studio_session_remove(struct studio_session *session);
enum paper_status studio_session_dish(struct studio_session *session);
enum paper_status studio_session_way(struct studio_session *session);
bool studio_session_way_waits(const struct studio_session *session);

/* ---- files ---- */

enum paper_status studio_session_save(struct studio_session *session, const char *path);
/* The picture as it is looked at, with 16 bits a channel; scale: pixels a fiber each way, 1, 2
 * or 4. */
enum paper_status studio_session_picture(struct studio_session *session, const char *path,
                                         int scale);

/* A script that makes the same sheet, to the bit (script_session.h); `path` ends in ".lua". */
enum paper_status studio_session_script(struct studio_session *session, const char *path);

#endif
