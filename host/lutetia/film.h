/* film.h - a run as a film. A camera shows one sheet every so many steps: in a video, and in
 * numbered pictures of its colour, water and masks in 16 bits. */
#ifndef LUTETIA_FILM_H
#define LUTETIA_FILM_H

#include <sheet.h>

#include <stdbool.h>

struct film {
    /* set by the caller; zeros: no film */
    const char *video, *folder;
    int fps, every;       /* frames a second; steps from frame to frame */
    double camera[4];     /* x, y, width, height in fibers; width 0: the whole sheet */
    enum paper_show show; /* PAPER_SHOW_COLOR or PAPER_SHOW_WET */
    int paper;            /* the number of the paper that is filmed */
    /* its own */
    struct video *file;
    int width, height;  /* of the video */
    long after;         /* the time of the last frame, plus 1 */
    bool filmed_before; /* the sheet repeats the steps of a run that is resumed; their frames
                        * exist */
    bool failed;
    char error[400];
};

static inline bool film_on(const struct film *film)
{
    return film->video || film->folder;
}

/* Adds a frame if this paper is filmed and a frame is due. False: film->error says why; it
 * stays false from then on. */
bool film_step(struct film *film, int paper, struct paper_sheet *sheet);
/* Completes the video, also of a run that was interrupted. False: film->error. Frees what
 * the film holds. */
bool film_end(struct film *film);

#endif
