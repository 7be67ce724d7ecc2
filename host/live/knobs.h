/* knobs.h - the knobs of an instrument on a stage's controls: learnt by turning them, kept in a
 * file, with scenes that a program change calls.
 *
 *     struct knobs *knobs;
 *     // the file need not be there yet
 *     if (knobs_open(stage, "stage.knobs", "dark", false, &knobs) != STAGE_OK)
 *         die(stage_error());
 *     // the next knob that is turned moves this control
 *     knobs_learn(knobs, row);
 *     knobs_message(knobs, &message);              // each message
 *     // before each picture: fades, the clock's beat
 *     knobs_frame(knobs, now_s, &beat);
 *     knobs_close(knobs);                          // what was learnt is in the file
 *
 * A message moves a control between the knob's two ends, along its slider's way. A scene is the
 * values of all controls; between two scenes controls go along their ways, too, in the seconds
 * of the file's `fade`.
 *
 * Threads: the stage's.
 */
#ifndef LUTETIA_LIVE_KNOBS_H
#define LUTETIA_LIVE_KNOBS_H

#include "beat.h"

#include <panel.h>
#include <stage.h>

#include "knobs_file.h"

struct knobs;

/* stage: borrowed. theme: the stage's, which a new file will name; NULL: none. is_there: the
 * file must be. Errors: BAD_FILE (also where the file names a control that this stage has not),
 * NO_MEMORY. */
enum stage_status knobs_open(struct stage *stage, const char *path, const char *theme,
                             bool is_there, struct knobs **out);
/* Saves what is not saved yet. NULL is fine. */
void knobs_close(struct knobs *knobs);

void knobs_message(struct knobs *knobs, const struct midi_message *m);
/* now_s: of the same clock in all calls. beat: of the clock that is heard; NULL: none is. Saves
 * what was changed a second ago. */
void knobs_frame(struct knobs *knobs, double now_s, const struct beat *beat);

/* The next knob is this control's; the control's that waits for one: it waits no more. */
void knobs_learn(struct knobs *knobs, int row);
/* Moves the nearer one of the two ends to a place of the slider's way. Nothing where no knob
 * moves the control. */
void knobs_end(struct knobs *knobs, int row, double along);
void knobs_forget(struct knobs *knobs, int row);
/* False: no knob moves the control, and none is waited for. out->text lasts until the next
 * call. */
bool knobs_of(struct knobs *knobs, int row, struct stage_panel_knob *out);

/* Keeps what all controls are as a scene, 1..128. Errors: BAD_ARGUMENT, NO_MEMORY; the scene is
 * then as it was. */
enum stage_status knobs_scene_keep(struct knobs *knobs, int scene);
/* Errors: BAD_ARGUMENT: it was not kept. The action can be undone. */
enum stage_status knobs_scene_play(struct knobs *knobs, int scene);

/* What there is to say since the last call: a knob was learnt, a scene is there, a file cannot
 * be written; NULL: nothing. */
const char *knobs_said(struct knobs *knobs);

#endif
