/* picture_stream.h - pictures that other programs read as they come: through a loopback device
 * of Video4Linux (the kernel's module v4l2loopback), which is a camera for them, or PipeWire.
 *
 *     struct picture_stream_def def;
 *     struct picture_stream *stream;
 *     if (picture_stream_read("/dev/video9,1280x720,30", &def) != DISPLAY_OK ||
 *         picture_stream_open(&def, &stream) != DISPLAY_OK)
 *         die(display_error());
 *     picture_stream_put(stream, &image);          // each 1 / fps seconds
 *     picture_stream_close(stream);
 *
 * A thread hands the pictures out. Where it is not done with one when two more come, the older
 * one is left out: who puts never waits. A device or a server that goes away is tried again
 * once a second.
 *
 * A device gets YUYV (ITU-R BT.601, limited range), with alpha ARGB of 32 bits with blue first;
 * PipeWire BGRx, RGBx, BGRA or RGBA, as its reader wishes. Colours are not multiplied by alpha.
 *
 * Errors: functions that can fail return a status and leave one line in display_error().
 * Threads: a stream belongs to one. */
#ifndef LUTETIA_PICTURE_STREAM_H
#define LUTETIA_PICTURE_STREAM_H

#include "display.h"

#include <stdbool.h>

enum { PICTURE_STREAM_SIDE_MAX = 8192, PICTURE_STREAM_FPS_MAX = 240 };

struct picture_stream_def {
    char to[128];            /* "pipewire", or a device's path */
    int width_px, height_px; /* even; 0: not said */
    double fps;
    bool alpha;
};

/* Reads TO[,WIDTHxHEIGHT][,FPS]; without FPS it is 30. Errors: BAD_ARGUMENT. */
enum display_status picture_stream_read(const char *text, struct picture_stream_def *def);

struct picture_stream;
/* Errors: BAD_ARGUMENT (a size, a rate), IO_FAILED (no such device or server: what is wrong,
 * and what to do), NO_MEMORY. Owns: the caller closes *out. */
enum display_status picture_stream_open(const struct picture_stream_def *def,
                                        struct picture_stream **out);
void picture_stream_close(struct picture_stream *stream); /* NULL is fine */

/* The next picture, of the stream's size with 3 channels, or 4 where it has alpha. Its pixels
 * are exchanged for others of that size, whose contents are of no meaning: nothing is copied.
 * Waits for nobody. Errors: BAD_ARGUMENT (another size). */
enum display_status picture_stream_put(struct picture_stream *stream,
                                       struct display_image *image);

/* What there is to say since the last call: that the stream is interrupted, and why, or goes
 * on; NULL: nothing. Valid until the next call. */
const char *picture_stream_said(struct picture_stream *stream);

#endif
