/* osc_stage.h - a stage by OSC, both ways.
 *
 *     struct osc_stage_def def = {.port = {.listen = "9000", .send = "127.0.0.1:9001"}, .stage = stage};
 *     struct osc_stage *osc;
 *     if (osc_stage_open(&def, &osc) != STAGE_OK)
 *         die(stage_error());
 *     osc_stage_take(osc);                         // before each picture
 *     osc_stage_tell(osc);                         // after its steps: what has changed
 *     osc_stage_close(osc);
 *
 *     heard                                        sent
 *     /control/NAME value   a number, or a name    /control/NAME value   when it is another one, and all at first
 *     /control/NAME         asks for its value     /sound/NAME strength x y
 *     /along/NAME part      as a slider, 0..1
 *     /scene n, /knobs n, /text words, /undo, /reset
 *     any other address, for a map's osc()             what a map sends
 *
 * NAME may be a pattern. A control that was set by OSC is not sent back.
 *
 * Threads: the stage's.
 */
#ifndef LUTETIA_LIVE_OSC_STAGE_H
#define LUTETIA_LIVE_OSC_STAGE_H

#include <stage.h>

#include "osc.h"
#include "osc_port.h"

struct osc_stage_def {
    struct osc_port_def port;
    struct stage *stage; /* borrowed */
    /* What is asked for besides controls; each may be NULL. They return NULL, or why it cannot
     * be. */
    const char *(*scene)(void *context, int number);
    const char *(*knobs)(void *context, int number);
    const char *(*go)(void *context, int number); /* number: of no meaning */
    const char *(*text)(void *context, const char *text);
    /* Any other address; false: nobody knows it. */
    bool (*other)(void *context, const struct osc_message *m);
    void (*tell)(void *context, const char *text); /* a line: what was wrong with a message */
    void *context;
};

struct osc_stage;
/* Errors: those of osc_port_open(), NO_MEMORY. Owns: the caller closes *out. */
enum stage_status osc_stage_open(const struct osc_stage_def *def, struct osc_stage **out);
void osc_stage_close(struct osc_stage *osc); /* NULL is fine */

void osc_stage_take(struct osc_stage *osc);
void osc_stage_tell(struct osc_stage *osc);
/* A message of somebody's own, as it was written. */
void osc_stage_send(struct osc_stage *osc, const uint8_t *bytes, size_t count);
void osc_stage_sound(struct osc_stage *osc, const struct stage_sound *sound);

/* The port that is heard, for tests. */
int osc_stage_port(const struct osc_stage *osc);

#endif
