/* gray.h - the pipeline's last level: a glyph in gray, filtered, at a place between pixels.
 *
 *     struct font_gray gray = {0};
 *     if (font_gray_draw(&gray, &edges, filter, 0.25, 0) != FONT_OK)
 *         die(font_error());
 *     blend(gray.pixels, gray.pitch, gray.left_px, gray.top_px, gray.width_px, gray.height_px);
 *     font_gray_finish(&gray);
 *
 * A pixel is 255 times the filter's integral over the ink, rounded; what a filter with negative
 * lobes takes beyond 0 and 255 is cut off. The picture is as large as the ink and the filter's
 * radius around it.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: a picture's memory is its own, and is used again by the next drawing;
 * font_gray_finish() frees it.
 *
 * Threads: a struct font_gray belongs to one thread at a time. */
#ifndef LUTETIA_FONT_GRAY_H
#define LUTETIA_FONT_GRAY_H

#include "edges.h"

#include <stddef.h>
#include <stdint.h>

/* All zeros is an empty picture. */
struct font_gray {
    int left_px, top_px; /* of the first pixel, from the glyph's origin's pixel; y downwards */
    int width_px, height_px;
    int pitch;       /* bytes from row to row, a multiple of 16, at least width_px */
    uint8_t *pixels; /* valid until the next drawing into it; NULL if there is no ink */
    float
        *exact; /* the same pixels before they were rounded, if asked for; pitch floats a row */
    /* What drawing keeps. */
    void *memory, *work;
    size_t memory_bytes, work_bytes;
};

/* Frees its memory, and makes it empty. */
void font_gray_finish(struct font_gray *gray);

/* x_px, y_px: where the glyph's origin is, 0..1 or any other number below FONT_SIDE_MAX;
 * left_px and top_px count from there. Errors: BAD_ARGUMENT, NO_MEMORY, TOO_LARGE past
 * FONT_SIDE_MAX pixels a side; the picture is then empty. */
enum font_status font_gray_draw(struct font_gray *gray, const struct font_edges *edges,
                                const struct font_filter *filter, double x_px, double y_px);
/* The same, and gray->exact. Errors: as font_gray_draw(). */
enum font_status font_gray_draw_exact(struct font_gray *gray, const struct font_edges *edges,
                                      const struct font_filter *filter, double x_px,
                                      double y_px);

/* Gray that comes from elsewhere: a copy, rows of `cover` being `pitch` bytes apart. What *gray
 * had is not freed. Owns: the caller finishes it. Errors: TOO_LARGE, NO_MEMORY; it is then
 * empty. */
struct font_gray_frame {
    int left_px, top_px, width_px, height_px;
};
enum font_status font_gray_put(struct font_gray *gray, const struct font_gray_frame *frame,
                               const uint8_t *cover, size_t pitch);
/* Likewise, of another's pixels. Errors: as font_gray_put(). */
enum font_status font_gray_copy(const struct font_gray *from, struct font_gray *to);

/* Where the picture will be, without drawing it. Errors: BAD_ARGUMENT, TOO_LARGE. */
enum font_status font_gray_place(struct font_gray *gray, const struct font_edges *edges,
                                 const struct font_filter *filter, double x_px, double y_px);

/* The instructions that drawing uses. The best that the processor has is found by itself; less
 * can be asked for, for tests and measurements. Returns what will be used. Not while another
 * thread draws. */
enum font_simd { FONT_SIMD_PLAIN, FONT_SIMD_AVX2, FONT_SIMD_AVX512 };
enum font_simd font_simd_use(enum font_simd most);
/* On this thread the plain ones alone, whatever the processor has: the others round the last
 * bit otherwise, and with these pictures are the same everywhere. */
void font_simd_plain_here(bool plain);
/* "AVX2" and so on: a constant, valid for ever; never NULL. */
const char *font_simd_name(enum font_simd simd);

#endif
