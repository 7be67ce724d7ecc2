/* stage_film.h - a stage without a window: a still, a strip of moments, a film, or a folder of
 * pictures.
 *
 *     struct stage_film_def def = stage_film_def_default();
 *     def.still = "word.png";
 *     def.seconds = 1.5;
 *     if (stage_film(stage, &def) != STAGE_OK)
 *         die(stage_error());
 *
 * Where the theme's background is not opaque, exact pictures have alpha: stills, frames, and
 * films whose format holds it (video_alpha()); other films are drawn on the background's
 * colour, and so is what `over` changes.
 *
 * Time is frame / fps: the pictures are the same each time, however long drawing takes.
 */
#ifndef LUTETIA_STAGE_FILM_H
#define LUTETIA_STAGE_FILM_H

#include <display.h>

#include "stage.h"

/* The way of drawing: through fontpipe's filter, or by OpenGL in one of its ways. */
enum stage_film_way { STAGE_FILM_EXACT, STAGE_FILM_EGL, STAGE_FILM_OSMESA };

struct stage_film_def {
    /* The files to write; NULL: not written. */
    const char *still; /* a PNG of the last moment */
    const char *video; /* as video.h has it */
    int sound; /* a descriptor of a whole WAV file for the video, see video.h; -1: none */
    const char *frames; /* an existing folder, for frame-000000.png and so on */
    int strip[2]; /* columns and rows of moments in the still, from the first to the last; 1, 1:
              * the last only */
    int width_px, height_px; /* 1280x720; of a strip, the size of the whole */
    /* pixels for each pixel of a 96 dpi screen; 0: 1, and more where the picture is larger than
     * usual: where its shorter side (of a strip: that of a moment) has more than 720, as many
     * times as much */
    double px;
    int fps;        /* 30 */
    double seconds; /* 5 */
    /* above 0: the last seconds of film and frames are faded into the first, so that they can
     * be repeated (stage_loop.h) */
    double loop_s;
    double settle_s;         /* how long the stage moves before the first picture; 0 */
    enum stage_film_way way; /* EXACT */
    const char *filter;      /* for exact pictures; "gaussian-fast" */
    /* Called before the steps of each sixtieth of a second and of each picture, for whoever
     * plays the stage, and when something is due; NULL: nobody does. */
    enum stage_status (*before)(void *context, struct stage *stage, double now_s);
    /* When something is due that has a time of its own, between pictures, too: before() is then
     * called at that time, and takes it. INFINITY: nothing is. NULL: nothing ever is. */
    double (*due_s)(void *context);
    /* Called when a picture is drawn, with what it was drawn from, and may change it; then all
     * pictures are drawn, also those that are not written. NULL: nothing is called. */
    enum stage_status (*over)(void *context, struct stage *stage,
                              const struct stage_draw_list *list, struct display_image *image);
    /* Called after each picture; true: no more, what is whole by then is kept. NULL: nothing is
     * called. */
    bool (*after)(void *context, int frame, int frames);
    void *context;
};
struct stage_film_def stage_film_def_default(void);

/* Runs the stage from the beginning. Errors: NO_DISPLAY (no OpenGL in that way), BAD_FILE (a
 * file cannot be written), NO_MEMORY, and the actor's. Incomplete files are removed. */
enum stage_status stage_film(struct stage *stage, const struct stage_film_def *def);

#endif
