/* frame_buffer.h - shared by the files of the frame buffer.
 *
 *     frame_buffer.c           displays, what is seen of them
 *     frame_buffer_pixels.c    fields to pixels
 *     frame_buffer_record.c    pieces for who looks on
 */
#ifndef PARIS_FRAME_BUFFER_H
#define PARIS_FRAME_BUFFER_H

#include "paris_state.h"

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif
#include <cm/cmfb.h>
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

struct frame_buffer {
    bool attached;
    char name[64];
    unsigned int bits; /* 0: it has no size */
    int width, height;
    unsigned int seen;
    unsigned int zoom[2];
    int pan[2];
    bool axes_given;
    unsigned int axes[2]; /* of columns, of rows */
    uint8_t map[CMFB_colors][3];
};

/* NULL: there is no such display, or it has no size; said. */
struct frame_buffer *frame_buffer_of(CMFB_display_id_t display);
bool frame_buffer_good_buffer(unsigned int buffer);

/* ---- the recording (LUTETIA_DISPLAY) ---- */

/* "lutetia display 1\n", then pieces: a head of 24 bytes, numbers lowest byte first, and
 * `bytes` bytes more.
 *
 *     kind 1, display 1 (1..8), buffer 1, bytes of a pixel 1, bytes 4, microseconds since the first piece 8, x 4, y 4
 *
 *     kind            x, y               more
 *     1 size          width, height      the title; a new display, or a new size: pixels are 0, all else is as in the beginning
 *     2 pixels        offset             columns 4, then the pixels, row by row
 *     3 clear         value, 0
 *     4 map                              256 rows of red, green, blue
 *     5 view          pan                zoom 4, 4; `buffer` is seen
 *     6 end           a display is detached
 *     7 room          offset             columns 4, slot 4, bytes of the pixels 4
 *
 * Pixels of 24 bits have 4 bytes, red, green, blue and 0. Those of a piece of kind 7, which no
 * file has, lie in a slot of the memory that is shared with the window (picture_room.h), blue,
 * green, red and 0, as X11's servers show them; who reads the piece gives the slot back. */
enum frame_buffer_kind {
    FRAME_BUFFER_SIZE = 1,
    FRAME_BUFFER_PIXELS,
    FRAME_BUFFER_CLEAR,
    FRAME_BUFFER_MAP,
    FRAME_BUFFER_VIEW,
    FRAME_BUFFER_END,
    FRAME_BUFFER_ROOM
};
enum { FRAME_BUFFER_HEAD = 24 };

/* A piece that is filled in place: `more` has room for the bytes asked for. */
struct frame_buffer_piece {
    enum frame_buffer_kind kind;
    CMFB_display_id_t display;
    unsigned int buffer, pixel_bytes;
    uint32_t x, y, bytes;
    uint8_t *more;
};

bool frame_buffer_watched(void);
/* Makes room for that many bytes more. False: no memory; said. The library keeps the room for
 * the next piece. */
bool frame_buffer_piece_make(struct frame_buffer_piece *piece, size_t bytes);
void frame_buffer_piece_add(struct frame_buffer_piece *piece);

/* A piece of pixels: `pixels` has room for so many bytes, where the window sees them if there
 * is such memory. What was made is added or dropped. */
struct frame_buffer_pixels {
    struct frame_buffer_piece piece; /* the caller sets all but its kind, bytes and more */
    uint32_t columns;
    uint8_t *pixels;
    int slot; /* -1: they are in the piece */
    size_t bytes;
};
bool frame_buffer_pixels_make(struct frame_buffer_pixels *p, size_t bytes);
void frame_buffer_pixels_add(struct frame_buffer_pixels *p);
void frame_buffer_pixels_drop(struct frame_buffer_pixels *p);

#endif
