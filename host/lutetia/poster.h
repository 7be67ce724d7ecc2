/* poster.h - posters of what takes time: lines along which time runs, on as many pages as they
 * need. */
#ifndef LUTETIA_POSTER_H
#define LUTETIA_POSTER_H

#include <paint.h>

/* A poster of one line is no longer than LINE_MOST unless it is asked for; several lines are
 * about LINE. */
#define POSTER_LINE_MOST_PX 9600.0
#define POSTER_LINE_PX 4800.0

struct poster {
    const char *verb, *path; /* of the first page; the others are numbered: NAME-2.png */
    int lines;
    double margin_px, pitch_px, width_px; /* pitch: from line to line */
    void *of;                             /* handed to both */
    void (*paper)(void *of, struct font_picture *picture);
    /* The line with its top there. EXIT_SUCCESS, or prints why not. */
    int (*draw)(void *of, int line, double top_px, struct font_picture *picture);
};

/* EXIT_SUCCESS, or prints why not. */
int poster_write(const struct poster *poster);

#endif
