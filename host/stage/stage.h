/* stage.h - actors, their time, and a picture of them; the same in a window, in a film and in a test.
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
 * Time goes in fixed steps (frame_clock.h); what a picture shows between two steps is drawn so far ahead. Time for a film is
 * frame / fps, for a window what its clock says: the actor sees no difference.
 *
 * Each thing that a person does can be undone: stage_mark() before it keeps the state.
 *
 * Threads. A stage belongs to one thread. */
#ifndef LUTETIA_STAGE_H
#define LUTETIA_STAGE_H

#include <frame_clock.h>

#include "actor.h"

enum { STAGE_SKINS_MAX = 32, STAGE_UNDO_MAX = 64 };

struct stage_def {
    struct stage_actor actor;
    const char *theme; /* "light" */
    double step_s;     /* 1/240 */
};
struct stage_def stage_def_default(void);

struct stage;
/* Owns: the actor, also on failure. Errors: BAD_FILE (the theme), NO_MEMORY. */
enum stage_status stage_create(const struct stage_def *def, struct stage **out);
void stage_destroy(struct stage *stage); /* NULL is fine */

struct stage_actor stage_actor(const struct stage *stage);

/* ---- controls ---- */

/* Those of the stage and then those of the actor, as one table: handed `stage` by stage_control_read() and so on. */
const struct stage_control *stage_controls(struct stage *stage, int *count);
/* NAME=VALUE. Errors: BAD_ARGUMENT. */
enum stage_status stage_set(struct stage *stage, const char *assignment);

/* ---- time ---- */

/* A frame at a real time (the first one begins): as many steps as are due. *steps: how many, if it is not NULL. Errors: the
 * actor's. */
enum stage_status stage_frame(struct stage *stage, double now_s, int *steps);
/* Its clock: to pause, to step, to ask. */
struct frame_clock *stage_clock(struct stage *stage);

/* ---- pictures ---- */

/* The picture of the present, back to front. px: pixels in one of a screen of 96 dpi. The view is such that the whole actor, as
 * it is when a size is first asked for, is seen, and the same from then on. */
void stage_picture(struct stage *stage, int width_px, int height_px, double px,
                   struct stage_draw_list *list);
struct stage_view stage_view(const struct stage *stage);
const struct stage_theme *stage_theme(const struct stage *stage);
struct stage_color stage_background(const struct stage *stage);

/* ---- hands ---- */

/* Hands what a person does in the picture to the actor; places in pixels of the last picture. True: it took it. */
bool stage_hand(struct stage *stage, enum stage_event_kind kind, double x_px, double y_px,
                double pressure, int button, unsigned modifiers);

/* ---- going back ---- */

/* Keeps the state before something is done; of many the oldest are forgotten. Errors: NO_MEMORY. */
enum stage_status stage_mark(struct stage *stage);
/* Nothing was done after all: the last mark is forgotten. */
void stage_mark_drop(struct stage *stage);
/* Back to what was marked last. False: nothing is marked. */
bool stage_undo(struct stage *stage);
/* As it was in the beginning, which can be undone. */
enum stage_status stage_reset(struct stage *stage);
/* A file, see actor.h; loading can be undone. Errors: the actor's, or that it has no files. */
enum stage_status stage_save(struct stage *stage, const char *path);
enum stage_status stage_load(struct stage *stage, const char *path);

/* ---- sessions: see session.h ---- */

/* What was done since the first frame. Errors: BAD_FILE; BAD_ARGUMENT: something was loaded, or it was too much. */
enum stage_status stage_session_save(struct stage *stage, const char *path);
/* Does what a session says, at its steps; before the first frame. Errors: BAD_FILE, NO_MEMORY. */
enum stage_status stage_session_replay(struct stage *stage, const char *path);

#endif
