/* film.h - a run as a film: a camera that looks at one sheet every so many steps, into a video, and into numbered pictures of its
 * colour, water and masks in 16 bits. */
#ifndef LUTETIA_FILM_H
#define LUTETIA_FILM_H

#include <sheet.h>

#include <stdbool.h>

struct film {
    /* set by whoever begins; zeros: nothing is filmed */
    const char *video, *folder;
    int fps, every;       /* frames a second; steps from frame to frame */
    double camera[4];     /* x, y, width, height in fibers; width 0: the whole sheet */
    enum paper_show show; /* PAPER_SHOW_COLOR or PAPER_SHOW_WET */
    int paper;            /* the number of the one that is filmed */
    /* its own */
    struct video *file;
    int width, height; /* of the video */
    long after;        /* the last frame; its time and 1 */
    bool
        filmed_before; /* the sheet repeats what a run did that is resumed: its frames are there */
    bool failed;
    char error[400];
};

static inline bool film_on(const struct film *film)
{
    return film->video || film->folder;
}

/* Looks at the sheet if it is the one, and it is time. False: film->error says why, now and from then on. */
bool film_step(struct film *film, int paper, struct paper_sheet *sheet);
/* Completes the video, also of a run that was stopped. False: film->error. Frees what the film holds. */
bool film_end(struct film *film);

#endif
