/* display_pieces.h - makes recordings of displays for tests, by the format's description,
 * without the library's code. */
#ifndef LUTETIA_TEST_DISPLAY_PIECES_H
#define LUTETIA_TEST_DISPLAY_PIECES_H

#include <stdint.h>
#include <string.h>

enum { PIECES_MOST = 1 << 18 };

struct pieces {
    size_t count;
    uint8_t bytes[PIECES_MOST];
};

static inline void pieces_number(struct pieces *p, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        p->bytes[p->count++] = (uint8_t)(number >> 8 * i);
}

static inline void pieces_line(struct pieces *p)
{
    memcpy(p->bytes + p->count, "lutetia display 1\n", 18);
    p->count += 18;
}

static inline void pieces_head(struct pieces *p, int kind, int display, int buffer,
                               int pixel_bytes, size_t more, uint64_t us, int x, int y)
{
    const int bytes[] = {kind, display, buffer, pixel_bytes};
    for (int i = 0; i < 4; i++)
        pieces_number(p, (uint64_t)bytes[i], 1);
    pieces_number(p, more, 4);
    pieces_number(p, us, 8);
    pieces_number(p, (uint32_t)x, 4);
    pieces_number(p, (uint32_t)y, 4);
}

static inline void pieces_size(struct pieces *p, int display, int pixel_bytes, int width,
                               int height, uint64_t us)
{
    pieces_head(p, 1, display, 0, pixel_bytes, 4, us, width, height);
    pieces_number(p, 0x74696374, 4); /* a title of four letters */
}

static inline void pieces_pixels(struct pieces *p, int display, int buffer, int pixel_bytes,
                                 int columns, int rows, int x, int y, const void *pixels,
                                 uint64_t us)
{
    const size_t bytes = (size_t)(columns * rows * pixel_bytes);
    pieces_head(p, 2, display, buffer, pixel_bytes, 4 + bytes, us, x, y);
    pieces_number(p, (uint64_t)columns, 4);
    memcpy(p->bytes + p->count, pixels, bytes);
    p->count += bytes;
}

static inline void pieces_map(struct pieces *p, int display, uint8_t map[256][3], uint64_t us)
{
    enum { MAP_BYTES = 256 * 3 };
    pieces_head(p, 4, display, 0, 0, MAP_BYTES, us, 0, 0);
    memcpy(p->bytes + p->count, map, MAP_BYTES);
    p->count += MAP_BYTES;
}

static inline void pieces_view(struct pieces *p, int display, int buffer, int x_zoom,
                               int y_zoom, int x, int y, uint64_t us)
{
    pieces_head(p, 5, display, buffer, 0, 8, us, x, y);
    pieces_number(p, (uint64_t)x_zoom, 4);
    pieces_number(p, (uint64_t)y_zoom, 4);
}

#endif
