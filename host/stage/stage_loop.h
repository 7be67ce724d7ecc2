/* stage_loop.h - a film whose end goes over into its beginning: the first pictures are kept,
 * and those after the last are faded into them.
 *
 *     drawn     0 .. loop-1 | loop .. count-1 | count .. count+loop-1
 *               kept        | written as they are | each faded into a kept one, and written
 *
 * Written so, the last picture is followed by the first as it was when it moved. */
#ifndef LUTETIA_STAGE_LOOP_H
#define LUTETIA_STAGE_LOOP_H

#include <display.h>

#include "stage_status.h"

#include <stdbool.h>

struct stage_loop {
    int loop, count;            /* pictures that are faded, and those that are written */
    struct display_image *kept; /* the first `loop` */
};

/* Owns: the caller finishes it, also where it fails. Errors: BAD_ARGUMENT (a fade that is as
 * long as the film), NO_MEMORY. */
enum stage_status stage_loop_begin(struct stage_loop *loop, double loop_s, double seconds,
                                   int fps);
void stage_loop_finish(struct stage_loop *loop);

/* Takes a picture, and fades it into its kept one if it is behind the last. False: it is kept,
 * and not written. *status: NO_MEMORY. */
bool stage_loop_take(struct stage_loop *loop, int frame, struct display_image *image,
                     enum stage_status *status);

/* `from` into `into`, of equal size: part 0: `from`, 1: `into`. By light, and of pictures with
 * four channels by what they cover. The result is in `from`. */
void stage_loop_fade(struct display_image *from, const struct display_image *into, double part);

#endif
