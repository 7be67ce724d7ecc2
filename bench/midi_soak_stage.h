/* midi_soak_stage.h - a stage of 60 pictures a second as a process of its own, for the soak:
 * the server's instrument turns a knob of it, and OSC sets another control and asks for it.
 *
 *     struct soak_stage stage;
 *     if (soak_stage_begin(&stage, &scene)) {
 *         soak_stage_ask(&stage);                  // now and then
 *         soak_stage_played(&stage, &message);     // for each message of the instrument
 *         soak_stage_settle(&stage);               // when all has been played
 *     }
 *     soak_stage_end(&stage);
 */
#ifndef LUTETIA_BENCH_MIDI_SOAK_STAGE_H
#define LUTETIA_BENCH_MIDI_SOAK_STAGE_H

#include "midi_scene.h"

struct soak_stage {
    pid_t process;
    int asks,
        hears; /* sockets: for questions and their answers, and for what the stage tells */
    char knobs[128]; /* a file */
    uint64_t asked, answered;
    uint64_t wrong; /* answers that are not what was set, are missing, or knobs that stood
                        * elsewhere than the instrument's */
    int wanted;     /* the controller's last value; -1: none yet */
    double told;    /* the control's, as the stage told it last */
    uint64_t moved; /* values of the knob's control that the stage has told */
};

/* Starts it; scene is that of a server that runs. Errors: false. */
bool soak_stage_begin(struct soak_stage *s, const struct midi_scene *scene);
/* Sets a control to another value and asks for it; checks the answers that have come. */
void soak_stage_ask(struct soak_stage *s);
/* What the instrument has played: the knob's control must get there. */
void soak_stage_played(struct soak_stage *s, const struct midi_message *m);
/* Waits, five seconds at most, until all answers have come and the knob's control is where the
 * instrument has moved it; what is missing then is wrong. */
void soak_stage_settle(struct soak_stage *s);
/* NULL is none; takes zeros. */
void soak_stage_end(struct soak_stage *s);

#endif
