/* stage.h - actors, their time, and a picture of them; the same in a window, in a film and in a
 * test.
 *
 *     struct stage *stage;
 *     struct stage_def def = stage_def_default();
 *     def.actor = springs;                                  // the stage's now
 *     stage_create(&def, &stage);
 *     for (int frame = 0; frame < 300; frame++) {           // a film
 *         stage_frame(stage, frame / 30.0);
 *         stage_picture(stage, 1280, 720, 1, &list);
 *         stage_exact_draw(exact, &list, stage_background(stage), &image);
 *     }
 *     stage_destroy(stage);
 *
 * Time advances in fixed steps (frame_clock.h); a picture between two steps is extrapolated. A
 * film's time is frame / fps, a window's is the clock's; the actor sees no difference.
 *
 * Each action of the user can be undone: stage_mark() keeps the state before it.
 *
 * Threads. A stage belongs to one thread.
 */
#ifndef LUTETIA_STAGE_H
#define LUTETIA_STAGE_H

#include <frame_clock.h>

#include "actor.h"
#include "session.h"

enum { STAGE_SKINS_MAX = 32, STAGE_UNDO_MAX = STAGE_SESSION_MARKS_MAX };

struct stage_def {
    struct stage_actor actor;
    const char *theme; /* "light" */
    double step_s;     /* 1/240 */
    bool forgets;      /* keeps no session: for windows that play for days */
};
struct stage_def stage_def_default(void);

struct stage;
/* Owns: the actor, also on failure. Errors: BAD_FILE (the theme), NO_MEMORY. */
enum stage_status stage_create(const struct stage_def *def, struct stage **out);
void stage_destroy(struct stage *stage); /* NULL is fine */

struct stage_actor stage_actor(const struct stage *stage);

/* ---- controls ---- */

/* The controls of the stage and then those of the actor, as one table: pass `stage` to
 * control_read() and so on. */
const struct control *stage_controls(struct stage *stage, int *count);
/* Sets NAME=VALUE. Errors: BAD_ARGUMENT. */
enum stage_status stage_set(struct stage *stage, const char *assignment);

/* ---- time ---- */

/* Advances to a real time (the first call begins): makes as many steps as are due. *steps:
 * how many, if it is not NULL. Errors: the actor's. */
enum stage_status stage_frame(struct stage *stage, double now_s, int *steps);
/* The stage's clock, to pause, step and read it. */
struct frame_clock *stage_clock(struct stage *stage);

/* ---- pictures ---- */

/* Draws the present, back to front. px: pixels for each pixel of a 96 dpi screen. The view
 * shows the whole actor, as it is when a size is first requested, and does not change later. */
void stage_picture(struct stage *stage, int width_px, int height_px, double px,
                   struct stage_draw_list *list);
struct stage_view stage_view(const struct stage *stage);
const struct stage_theme *stage_theme(const struct stage *stage);
struct stage_color stage_background(const struct stage *stage);

/* ---- hands ---- */

/* Passes a pointer action in the picture to the actor; places are pixels of the last
 * picture. True: the actor took it. */
bool stage_hand(struct stage *stage, enum stage_event_kind kind, double x_px, double y_px,
                double pressure, int button, unsigned modifiers);

/* ---- going back ---- */

/* Keeps the state before an action; of many the oldest are dropped. Errors: NO_MEMORY. */
enum stage_status stage_mark(struct stage *stage);
/* Drops the last mark: there was no action. */
void stage_mark_drop(struct stage *stage);
/* Goes back to the last mark. False: there is none. */
bool stage_undo(struct stage *stage);
/* Goes back to the beginning; this can be undone. */
enum stage_status stage_reset(struct stage *stage);
/* Saves and loads a file, see actor.h; loading can be undone. Errors: the actor's, or that
 * it has no files. */
enum stage_status stage_save(struct stage *stage, const char *path);
enum stage_status stage_load(struct stage *stage, const char *path);

/* Puts other words on the stage: UTF-8, STAGE_TEXT_BYTES at most, with line ends. This can be
 * undone. Errors: BAD_ARGUMENT (no such text, or the actor has none that can be changed); the
 * stage is as it was. */
enum stage_status stage_text(struct stage *stage, const char *words);

/* Whether stage_text() takes them, but for what making the letters needs. Errors:
 * BAD_ARGUMENT. */
enum stage_status stage_text_check(const struct stage *stage, const char *words);

/* ---- sessions: see session.h ---- */

/* Saves the actions since the first frame. Errors: BAD_FILE; BAD_ARGUMENT: a file was
 * loaded that was gone at once, or there were too many actions. */
enum stage_status stage_session_save(struct stage *stage, const char *path);
/* The session is in this file from the first frame on and grows as it happens, so that a
 * program that is killed leaves it (session_file.h). Errors: BAD_FILE, NO_MEMORY. */
enum stage_status stage_session_follow(struct stage *stage, const char *path);
/* Ends that file. Errors: those of stage_session_save(). */
enum stage_status stage_session_end(struct stage *stage);
/* What is wrong with that file, once; NULL: nothing. */
const char *stage_session_said(struct stage *stage);
/* Repeats a session's actions at their steps; call before the first frame. Errors: BAD_FILE
 * (also if a file that it loads is not there, or has changed), NO_MEMORY. If the stage began in
 * another way than the session did, stage_frame() says so. */
enum stage_status stage_session_replay(struct stage *stage, const char *path);
/* How long what is replayed takes from now on, by the stage's rate and those that are set in
 * it; 0: nothing is. */
double stage_replay_seconds(const struct stage *stage);

#endif
