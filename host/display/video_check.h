/* video_check.h - reads a film back before it takes the old one's place. */
#ifndef LUTETIA_VIDEO_CHECK_H
#define LUTETIA_VIDEO_CHECK_H

#include <stdbool.h>
#include <stddef.h>

/* What a film must hold. */
struct video_held {
    const char *format; /* ffmpeg's name of the container */
    long frames;        /* pictures */
    bool
        exactly; /* no more and no fewer; else at least one, and the end of a .gif or an .ogv */
    bool sounds; /* there is sound, too */
};

/* Whether ffmpeg finds the film in the open file: its index, all of its pictures, and no end
 * too soon. That an encoder ended well is no proof: what it writes last, on a full disk, is
 * lost without a word. False: `said` has what is wrong. */
bool video_read_back(int file, const struct video_held *held, char *said, size_t room);

#endif
