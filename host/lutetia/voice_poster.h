/* voice_poster.h - the poster of `lutetia voice`: lines on which time runs, on as many pages as
 * they need. */
#ifndef LUTETIA_VOICE_POSTER_H
#define LUTETIA_VOICE_POSTER_H

#include <voice_picture.h>

struct voice_poster_def {
    const char *path;          /* of the first page; the others are numbered: NAME-2.png */
    double size_px, rise_px;   /* the most */
    double second_px, line_px; /* line_px 0: one line, or several where it would be very long */
};

/* EXIT_SUCCESS, or prints why not. */
int voice_poster_write(struct voice_type *type, const struct voice_poster_def *def);

#endif
