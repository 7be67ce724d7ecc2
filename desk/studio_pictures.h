/* studio_pictures.h - pictures from one thread to another through three places; neither waits
 * for the other.
 *
 *     studio_pictures_begin(&p, width, height);
 *     one thread:  paint (p.canvas); studio_pictures_publish(&p, &changed, heard);
 *     // NULL: nothing new
 *     the other:   const struct studio_picture *seen = studio_pictures_take(&p);
 *
 *     canvas ---changed rectangles---> [being written] <-> [newest] <-> [being looked at]
 *
 * The painter keeps one picture, the canvas, and copies what has changed of it to one of three
 * places, which then becomes the newest. Who looks takes the newest; what he takes stays as it
 * is until he takes another one. A picture tells in which rectangle it may differ from the one
 * that was taken before it, though others between them were never taken.
 *
 * Threads: one that publishes, one that takes. The lock is held while numbers are exchanged,
 * never while pixels are copied. */
#ifndef LUTETIA_STUDIO_PICTURES_H
#define LUTETIA_STUDIO_PICTURES_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

/* From left, top to before right, bottom; empty if right <= left. */
struct studio_rectangle {
    int left, top, right, bottom;
};
struct studio_rectangle studio_rectangle_join(struct studio_rectangle a,
                                              struct studio_rectangle b);

enum { STUDIO_PIXEL = 4 }; /* red, green, blue, and 255 */

struct studio_picture {
    int width, height;
    uint8_t *pixels;                 /* rows from the top, no padding */
    struct studio_rectangle changed; /* against what was taken before */
    unsigned long heard;             /* the number of the last message that it shows */
    /* private */
    struct studio_rectangle stale; /* where it is older than the canvas */
};

struct studio_pictures {
    int width, height;
    uint8_t *canvas;
    /* private */
    pthread_mutex_t lock;
    struct studio_picture places[3];
    int writing, newest, looking;
    bool fresh; /* the newest has not been taken */
};

/* False: no memory. */
bool studio_pictures_begin(struct studio_pictures *p, int width, int height);
void studio_pictures_finish(struct studio_pictures *p);
void studio_pictures_publish(struct studio_pictures *p, const struct studio_rectangle *changed,
                             unsigned long heard);
const struct studio_picture *studio_pictures_take(struct studio_pictures *p);
/* Whether the last that was published has been taken. */
bool studio_pictures_taken(struct studio_pictures *p);

#endif
