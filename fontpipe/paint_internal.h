/* paint_internal.h - what paint.c and paint_blend.c share. */
#ifndef LUTETIA_FONT_PAINT_INTERNAL_H
#define LUTETIA_FONT_PAINT_INTERNAL_H

#include "colour.h"
#include "internal.h"
#include "paint.h"

enum { BUCKETS = 4096, TO_LIGHT = 256, TO_NUMBER = 4096 };

/* Compared whole: no padding, all of it set. */
struct key {
    uint64_t version;
    double map[FONT_MAP_NUMBERS];
    uint32_t glyph;
    int32_t kind;
    int32_t place_x, place_y; /* of a gray picture; -1 for edges; -2 for one in colours */
};

struct entry {
    struct key key;
    struct font_edges edges; /* or: */
    struct font_gray gray;
    struct font_colour_picture picture;
    size_t bytes;
    struct entry *next;          /* of the bucket */
    struct entry *newer, *older; /* in order of use */
};

struct font_painter {
    struct font_painter_def def;
    struct font_filter *filter;
    struct font_filter *area; /* the box, once glyphs have been drawn as pictures */
    struct entry *buckets[BUCKETS];
    struct entry *newest, *oldest;
    struct font_painter_stats stats;
    struct font_gray scratch[3];
    struct font_gray own; /* a face's own pixels, borrowed, at a place */
    uint64_t stem_of;     /* the version of the face whose stems are known */
    double stem;
    double ink[3]; /* the last plain one, and its light */
    float ink_light[3];
    float to_light[TO_LIGHT];
    uint8_t to_number[TO_NUMBER + 1];
};

/* paint.c: what is kept. */
struct entry *font_painter_entry_find(struct font_painter *p, const struct key *key);
struct entry *font_painter_entry_make(struct font_painter *p, const struct key *key);
void font_painter_entry_weigh(struct font_painter *p, struct entry *e, size_t bytes);
/* paint.c: glyph i of a layout as its outline in an ink, and the box around it, untouched if it
 * has no ink. */
enum font_status font_painter_outline_draw(struct font_painter *p,
                                           const struct font_layout *layout, int i,
                                           const struct font_map *map, double x_px, double y_px,
                                           const struct font_ink *ink,
                                           struct font_picture *picture);
enum font_status font_painter_outline_measure(struct font_painter *p,
                                              const struct font_layout *layout, int i,
                                              const struct font_map *map, double x_px,
                                              double y_px, struct font_box *box);

/* The gray picture of a glyph, counted from the pixel (x, y), onto a picture: in one channel,
 * or all (-1). The ink's places count from (ink_x, ink_y). */
void font_blend(struct font_painter *p, const struct font_gray *gray, int x, int y, int channel,
                const struct font_ink *ink, double ink_x, double ink_y,
                struct font_picture *to);
/* A glyph's own picture, of which `cover` is left, through a map that takes pixels around its
 * origin to pixels around (x, y). */
void font_blend_picture(const struct font_painter *p, const struct font_colour_picture *from,
                        const struct font_map *map, double size_px, double x, double y,
                        double cover, struct font_picture *to);
/* The same as pixels of its own: those within a picture of that size that it may touch. */
enum font_status font_tile_draw(const struct font_painter *p,
                                const struct font_colour_picture *from,
                                const struct font_map *map, double size_px, double x, double y,
                                double cover, int width_px, int height_px,
                                struct font_tile *out);
/* The box around it. False: a point has no place. */
bool font_blend_picture_box(const struct font_colour_picture *from, const struct font_map *map,
                            double size_px, double x, double y, struct font_box *box);
/* The same onto what is covered so far. */
void font_blend_cover(const struct font_gray *gray, int x, int y, struct font_cover *to);

#endif
