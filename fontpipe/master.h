/* master.h - the pipeline's second and third level: a glyph as many black and white pixels, and
 * those as rectangles.
 *
 *     struct font_master master = {0};
 *     font_master_make(&master, &outline, 980);              // 980 pixels to the em
 *     font_master_fill(&master, 100, -300, 40, 40, false);   // retouched
 *     struct font_rectangles parts = {0};
 *     font_rectangles_make(&parts, &master);
 *     font_rectangles_edges(&parts, 12.25, &edges);          // ready for font_gray_draw()
 *
 * This is the way of the thesis and of Naiman and Fournier: what is filtered is rectangles, of
 * which a glyph has a few hundred, not pixels, of which it has a million. The gray level is as
 * good as the master is fine: 80 of its pixels to one of the picture's leave an error of a
 * 255th. Edges made from the outline are both faster and exact; a master can be retouched.
 *
 * Units. Master pixels, y downwards, (0, 0) the pixel right of and below the glyph's origin.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: a master's and the rectangles' arrays are their own; their finish() frees them.
 *
 * Threads: each belongs to one thread at a time while it is changed; any number may read. */
#ifndef LUTETIA_FONT_MASTER_H
#define LUTETIA_FONT_MASTER_H

#include "edges.h"
#include "outline.h"

#include <stddef.h>
#include <stdint.h>

/* All zeros is an empty master. Bit i of a word is pixel i of its 64. */
struct font_master {
    int em_px;
    int left_px, top_px, width_px, height_px;
    int row_words;
    uint64_t *bits;
    double advance_px;
};

enum { FONT_MASTER_EM_MAX = 16384 };

/* Frees its bits, and makes it empty. */
void font_master_finish(struct font_master *m);
/* A pixel is black if its centre is inside. The outline is prepared. Errors: BAD_ARGUMENT (em
 * 1..FONT_MASTER_EM_MAX), TOO_LARGE, NO_MEMORY; the master is then empty. */
enum font_status font_master_make(struct font_master *m, const struct font_outline *outline,
                                  int em_px);
/* Whether the pixel is black; outside all are white. */
bool font_master_at(const struct font_master *m, int x, int y);
/* Blackens or whitens a rectangle; what lies outside the master's box is not changed. */
void font_master_fill(struct font_master *m, int x, int y, int width, int height, bool black);
long font_master_ink(const struct font_master *m); /* black pixels */

/* ---- as pictures, for retouching (master_picture.c) ---- */

/* Bytes, rows from the top, without padding: 0 is ink, 255 is none; with a margin of white all
 * around. Shape: (width_px + 2 * margin_px) * (height_px + 2 * margin_px). */
void font_master_to_picture(const struct font_master *m, int margin_px, uint8_t *gray);
/* Ink is what is below 128. Shape: frame->width_px * frame->height_px. Errors: BAD_ARGUMENT,
 * NO_MEMORY; the master is then empty. */
struct font_master_frame {
    int em_px, left_px, top_px, width_px, height_px;
    double advance_px;
};
enum font_status font_master_from_picture(struct font_master *m,
                                          const struct font_master_frame *frame,
                                          const uint8_t *gray);
/* Errors: NO_MEMORY; *to is then as it was. */
enum font_status font_master_copy(const struct font_master *from, struct font_master *to);
long font_master_differs(const struct font_master *a, const struct font_master *b); /* pixels */

/* ---- as outlines (master_outline.c) ---- */

/* The boundary of the black pixels, to the pixel: what is drawn of it is what is drawn of the
 * master, at any size. rough: from the middle of each pixel's side to the middle of the next,
 * without steps; for whoever works on it further. It is in font units, with the master's
 * advance. Owns: the caller finishes *out, which is empty on failure. Errors: TOO_LARGE (of
 * more corners than FONT_SEGMENTS_MAX), NO_MEMORY. */
enum font_status font_master_outline(const struct font_master *m, double units_per_em,
                                     bool rough, struct font_outline *out);

/* ---- rectangles ---- */

/* x1, y1: one past the last. */
struct font_rectangle {
    int x0, y0, x1, y1;
};

struct font_rectangles {
    struct font_rectangle *items;
    int count, capacity;
    int em_px;
    double advance_px;
    bool columns; /* cut along columns, not along rows */
};

/* Frees the rectangles, and leaves none. */
void font_rectangles_finish(struct font_rectangles *r);
/* Runs of black that are the same in rows that follow each other are one rectangle; or in
 * columns, where that makes fewer. None overlap. Errors: NO_MEMORY. */
enum font_status font_rectangles_make(struct font_rectangles *r, const struct font_master *m);
/* Cuts into rows alone. These are more rectangles, but those of neighbouring rows are alike, as
 * merging needs them. Errors: NO_MEMORY. */
enum font_status font_rectangles_make_rows(struct font_rectangles *r,
                                           const struct font_master *m);
/* Joins rectangles that follow each other, down the rows or along the columns as they were cut,
 * and whose sides differ by at most `slack` master pixels, into one with their mean sides:
 * fewer, and not quite the same ink. Returns how many are gone. */
int font_rectangles_merge(struct font_rectangles *r, int slack);
/* The least rectangle around them; all zeros around none. */
struct font_rectangle font_rectangles_box(const struct font_rectangles *r);
/* The master that they cover, whether they overlap or not. Errors: TOO_LARGE, NO_MEMORY,
 * BAD_ARGUMENT (no em); it is then empty. */
enum font_status font_rectangles_master(const struct font_rectangles *r, struct font_master *m);
/* The rectangles' sides at a size: two lines each. Errors: as font_edges_build(). */
enum font_status font_rectangles_edges(const struct font_rectangles *r, double size_px,
                                       struct font_edges *edges);

#endif
