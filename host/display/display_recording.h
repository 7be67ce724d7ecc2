/* display_recording.h - reads what libparis writes where LUTETIA_DISPLAY is set: the displays
 * of the frame buffer (<cm/cmfb.h>) as they change.
 *
 *     struct display_reader reader = {.take = draw, .context = &picture};
 *     while ((count = fread(bytes, 1, sizeof bytes, file)) > 0)
 *         if (display_reader_feed(&reader, bytes, count) != DISPLAY_OK)
 *             die(display_error());
 *     if (display_reader_end(&reader) != DISPLAY_OK)
 *         die(display_error());
 *     display_reader_finish(&reader);
 *
 * A recording is the line "lutetia display 1\n" and then pieces (paris_compat/frame_buffer.h).
 * Where a piece could begin the line may come again: recordings one behind the other are one
 * (the times begin anew). The reader is fed pieces of any size, from a file or a pipe. */
#ifndef LUTETIA_DISPLAY_RECORDING_H
#define LUTETIA_DISPLAY_RECORDING_H

#include "display.h"

#include <picture_room.h>
#include <stdbool.h>

#define DISPLAY_RECORDING_LINE "lutetia display 1\n"

enum { DISPLAY_SCREENS = 8, DISPLAY_SCREEN_SIDE_MAX = 8192, DISPLAY_PIECE_HEAD = 24 };

struct display_screen {
    bool there;
    char title[68];
    int width_px, height_px;
    /* 1: a row of the map; 4: blue, green, red, each by its own column of it, and 0 */
    int pixel_bytes;
    uint8_t *pixels[2]; /* NULL: all 0 */
    int slot[2]; /* 0: the pixels are the screen's own; n: in slot n - 1 of the shared memory */
    int kept;    /* n: slot n - 1 is being shown, and not given back until another is */
    int seen;
    uint32_t zoom[2];
    int32_t pan[2];
    uint8_t map[256][3];
};

struct display_change {
    int number;       /* of the display, 1 to DISPLAY_SCREENS */
    bool seen;        /* there is another picture to be seen */
    bool opened;      /* the display is new, or has a new size */
    bool closed;      /* it has gone: its screen is as it was last, and free after the call */
    uint64_t time_us; /* since the recording began */
};

struct display_reader {
    /* Receives each change; returns 0 to stop. */
    int (*take)(void *context, const struct display_change *change);
    void *context;
    struct picture_room *shared; /* NULL: pictures come in the pieces alone */

    struct display_screen screens[DISPLAY_SCREENS];
    uint64_t pieces, read; /* taken so far; bytes understood so far */
    bool begun, stopped;
    uint8_t *bytes; /* an incomplete piece */
    size_t held, room;
};

/* Errors: BAD_FILE if the bytes are no recording; NO_MEMORY. */
enum display_status display_reader_feed(struct display_reader *reader, const uint8_t *bytes,
                                        size_t count);
/* Errors: BAD_FILE if the recording ends within a piece, or before its first line is
 * complete. */
enum display_status display_reader_end(const struct display_reader *reader);
/* Frees the screens; take() is not called any more. */
void display_reader_finish(struct display_reader *reader);

/* What is to be seen of a screen, as red, green and blue. Makes the image, or makes it anew
 * where it has another size. Errors: NO_MEMORY. Owns: the caller destroys the image. */
enum display_status display_screen_picture(const struct display_screen *screen,
                                           struct display_image *image);
/* The same into a room of the screen's size: the same colours, byte for byte. */
void display_screen_paint(const struct display_screen *screen, const struct display_room *room);
/* Where the seen pixels lie in the shared memory and are what is to be seen, as they are: blue,
 * green, red and a byte without meaning. Else NULL. */
const uint8_t *display_screen_as_is(const struct display_screen *screen);
/* The seen pixels are being shown from there: they stay until the next call. shown: false, what
 * is shown lies elsewhere. */
void display_reader_keep(struct display_reader *reader, int number, bool shown);

#endif
