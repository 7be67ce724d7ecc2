/* display_screen.c - what is seen of a display of the frame buffer.
 *
 * A row of the buffer becomes a row of numbers of 32 bits, as a window's room has them. An
 * image of red, green and blue is made of those. */
#include "display_internal.h"
#include "display_recording.h"

#include <endian.h>
#include <string.h>

#define BLACK UINT32_C(0xff000000)

/* The colour map as numbers that are joined. */
struct colours {
    uint32_t whole[256];   /* of a pixel of 8 bits */
    uint32_t part[3][256]; /* of one of three */
    bool same;             /* each part's number stays as it is */
};

static void colours_make(struct colours *c, const struct display_screen *s)
{
    c->same = true;
    for (unsigned i = 0; i < 256; i++) {
        for (int k = 0; k < 3; k++) {
            c->part[k][i] = (uint32_t)s->map[i][k] << (16 - 8 * k);
            c->same = c->same && s->map[i][k] == i;
        }
        c->whole[i] = BLACK | c->part[0][i] | c->part[1][i] | c->part[2][i];
    }
}

static uint32_t number_at(const uint8_t *pixel)
{
    uint32_t number;
    memcpy(&number, pixel, sizeof number);
    return le32toh(number);
}

/* Pixels of 8 bits through the map. Eight are read at a time, which is faster. */
static void looked_up(const struct colours *c, const uint8_t *from, size_t count, uint32_t *to)
{
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        uint64_t eight;
        memcpy(&eight, from + i, sizeof eight);
        eight = le64toh(eight);
        for (int k = 0; k < 8; k++)
            to[i + (size_t)k] = c->whole[eight >> 8 * k & 0xff];
    }
    for (; i < count; i++)
        to[i] = c->whole[from[i]];
}

/* The pixels of a row of the buffer, as they stand. Compilers make vectors of the loops without
 * a table. */
static void span_paint(const struct display_screen *s, const struct colours *c,
                       const uint8_t *from, size_t count, uint32_t *to)
{
    if (s->pixel_bytes == 1 && !c->same) {
        looked_up(c, from, count, to);
    } else if (s->pixel_bytes == 1) {
        for (size_t i = 0; i < count; i++) {
            const uint32_t n = from[i];
            to[i] = BLACK | n << 16 | n << 8 | n;
        }
    } else if (c->same) {
        for (size_t i = 0; i < count; i++) {
            const uint32_t n = number_at(from + 4 * i);
            to[i] = BLACK | n;
        }
    } else {
        for (size_t i = 0; i < count; i++, from += 4)
            to[i] = BLACK | c->part[0][from[2]] | c->part[1][from[1]] | c->part[2][from[0]];
    }
}

static void fill(uint32_t *to, int64_t count, uint32_t number)
{
    for (int64_t i = 0; i < count; i++)
        to[i] = number;
}

static int64_t clamp(int64_t value, int64_t least, int64_t most)
{
    return value < least ? least : value > most ? most : value;
}

/* A row of the buffer (NULL: all 0), panned and zoomed; black beyond it. */
static void row_paint(const struct display_screen *s, const struct colours *c,
                      const uint8_t *from, uint32_t *to)
{
    static const uint8_t zero[4];
    const int64_t width = s->width_px, zoom = s->zoom[0], pan = s->pan[0];
    const int64_t left = clamp(-pan * zoom, 0, width),
                  right = clamp((width - pan) * zoom, left, width);
    uint32_t one;
    fill(to, left, BLACK);
    fill(to + right, width - right, BLACK);
    if (!from) {
        span_paint(s, c, zero, 1, &one);
        fill(to + left, right - left, one);
    } else if (zoom == 1) {
        span_paint(s, c, from + (pan + left) * s->pixel_bytes, (size_t)(right - left),
                   to + left);
    } else {
        for (int64_t X = left; X < right;) {
            const int64_t x = pan + X / zoom, end = clamp((X / zoom + 1) * zoom, 0, right);
            span_paint(s, c, from + x * s->pixel_bytes, 1, &one);
            fill(to + X, end - X, one);
            X = end;
        }
    }
}

/* The row of the buffer that is seen in a row; -1: none. */
static int64_t row_seen(const struct display_screen *s, int row)
{
    const int64_t y = s->pan[1] + (int64_t)row / s->zoom[1];
    return y < 0 || y >= s->height_px ? -1 : y;
}

/* Paints what is seen in row `row`. */
static void seen_paint(const struct display_screen *s, const struct colours *c, int row,
                       uint32_t *to)
{
    const int64_t y = row_seen(s, row);
    const uint8_t *pixels = s->pixels[s->seen];
    if (y < 0)
        fill(to, s->width_px, BLACK);
    else
        row_paint(s, c,
                  pixels ? pixels + (size_t)y * (size_t)s->width_px * (size_t)s->pixel_bytes
                         : NULL,
                  to);
}

const uint8_t *display_screen_as_is(const struct display_screen *s)
{
    struct colours c;
    if (!s->slot[s->seen] || s->pixel_bytes != 4 || s->zoom[0] != 1 || s->zoom[1] != 1 ||
        s->pan[0] || s->pan[1])
        return NULL;
    colours_make(&c, s);
    return c.same ? s->pixels[s->seen] : NULL;
}

void display_screen_paint(const struct display_screen *s, const struct display_room *room)
{
    struct colours c;
    colours_make(&c, s);
    for (int row = 0; row < s->height_px; row++) {
        uint32_t *to = room->pixels + (size_t)row * room->stride;
        if (row && row_seen(s, row) == row_seen(s, row - 1))
            memcpy(to, to - room->stride, sizeof *to * (size_t)s->width_px);
        else
            seen_paint(s, &c, row, to);
    }
}

/* Four bytes are written for a pixel of three, which is faster; the next pixel is written over
 * the fourth. After the last one there may be no room for it. */
static void row_pack(const uint32_t *from, uint8_t *to, int count)
{
    for (int i = 0; i < count; i++) {
        const uint32_t four = htobe32(from[i] << 8);
        memcpy(to + 3 * (size_t)i, &four, i < count - 1 ? 4 : 3);
    }
}

enum display_status display_screen_picture(const struct display_screen *s,
                                           struct display_image *image)
{
    struct colours c;
    uint32_t line[DISPLAY_SCREEN_SIDE_MAX];
    if (image->width_px != s->width_px || image->height_px != s->height_px || !image->pixels) {
        display_image_destroy(image);
        *image = (struct display_image){s->width_px, s->height_px, 3, NULL};
        const enum display_status status = display_image_create(image);
        if (status != DISPLAY_OK)
            return status;
    }
    colours_make(&c, s);
    for (int row = 0; row < s->height_px; row++) {
        seen_paint(s, &c, row, line);
        row_pack(line, image->pixels + 3 * (size_t)row * (size_t)s->width_px, s->width_px);
    }
    return DISPLAY_OK;
}
