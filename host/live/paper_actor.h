/* paper_actor.h - a sheet of wet paper as an actor of a stage: keys print their letters on it,
 * a hand or a map leads a brush.
 *
 *     struct paper_actor_def def = paper_actor_def_default();
 *     def.keys.face = face;
 *     struct stage_actor actor;
 *     if (paper_actor_create(&def, &actor) != STAGE_OK)
 *         die(stage_error());
 *     paper_actor_play(&actor, message.bytes);              // between two steps
 *
 * A key's letter is as large as its velocity says, where keys_actor.h would show it, and of the
 * pigment that is chosen. Aftertouch gives it more water, which runs.
 *
 * The brush is where the controls brush_x and brush_y say: a brush of brush.h that does not run
 * dry. While brush_ink or brush_water is above 0 it is down, and paints along the way between
 * two steps. The pointer is another brush, of the same size and pigment.
 *
 * Units of the world: fibers, y upwards. */
#ifndef LUTETIA_PAPER_ACTOR_H
#define LUTETIA_PAPER_ACTOR_H

#include <sheet.h>

#include "keys_actor.h"

enum { PAPER_ACTOR_PIGMENTS = 6 };

struct paper_actor_def {
    struct keys_actor_def keys; /* places and letters; its def of sizes in time is not used */
    int width, height;          /* fibers */
    const char *stock;          /* paper_stock_find() */
    const char *pigments
        [PAPER_ACTOR_PIGMENTS]; /* paper_pigment_find(); the control `pigment` chooses one */
    int pigments_count;
    uint64_t seed;
};
struct paper_actor_def paper_actor_def_default(void); /* 480x180, cold press, four pigments */

/* The machine is set up already (paris_reset()), or becomes as usual. Errors: BAD_ARGUMENT
 * (names, with the known ones; keys_actor.h's), NO_MEMORY, FAILED. */
enum stage_status paper_actor_create(const struct paper_actor_def *def,
                                     struct stage_actor *out);

/* As keys_actor_play(). */
enum stage_status paper_actor_play(const struct stage_actor *actor, const uint8_t *bytes);

/* The sheet, to look at. */
struct paper_sheet *paper_actor_sheet(const struct stage_actor *actor);

#endif
