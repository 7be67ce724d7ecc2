/* made_font.h - makes fonts for tests: adds tables to a font's bytes, and writes graphs of
 * paints as bytes (COLR 1). */
#ifndef LUTETIA_TESTS_MADE_FONT_H
#define LUTETIA_TESTS_MADE_FONT_H

#include <stddef.h>
#include <stdint.h>

/* Writes a number's bytes, the highest first; returns the place after them. */
uint8_t *made_put(uint8_t *at, uint32_t value, int bytes);

struct made_table {
    char tag
        [5]; /* before the font's own in the alphabet, or one of its own, which it replaces */
    const uint8_t *bytes;
    size_t count;
};
/* Owns: the caller frees it. */
uint8_t *made_font(const uint8_t *from, size_t count, const struct made_table *tables,
                   int tables_count, size_t *made_count);

/* A COLR table of version 1. A paint is written after its parent:
 *
 *     struct made_paints *p = made_paints_begin();
 *     // glyph 36: the outline of glyph 50
 *     size_t glyph = made_glyph(p, made_base(p, 36), 50);
 *     made_paint(p, glyph, 2, "22", 0, 0x4000);              // in the palette's first colour
 */
struct made_paints {
    uint8_t bases[2048], layers[1024], clips[1024], paints[8192];
    size_t bases_count, layers_count, clips_count, paints_count;
};
struct made_paints *made_paints_begin(void); /* free() ends it */
/* Adds a base glyph or a layer. Returns the place for its paint's offset, the parent of the
 * next paint. */
size_t made_base(struct made_paints *p, unsigned glyph);
size_t made_layer(struct made_paints *p);
/* Writes a paint as the child at place `of`. widths: the bytes of each number, 1 to 4; '3' is a
 * child's offset. Returns the paint's place; its children's places are that plus 1 and so
 * on. */
size_t made_paint(struct made_paints *p, size_t of, unsigned format, const char *widths, ...);
void made_clip(struct made_paints *p, unsigned glyph, int x0, int y0, int x1, int y1);
/* Owns: the caller frees it. */
uint8_t *made_colr(const struct made_paints *p, size_t *count);
/* Writes a CPAL table of one palette: blue, green, red, cover. */
size_t made_cpal(const uint8_t (*bgra)[4], int colours, uint8_t *out);
/* Writes an SVG table of one document for the glyphs first to last. */
size_t made_svg(const char *document, unsigned first, unsigned last, uint8_t *out);

/* Adds an axis `wdth`, 90..110, default 100, to a TrueType font. Outlines widen along it,
 * except those of composite glyphs. Owns: the caller frees it. */
uint8_t *made_wide(const uint8_t *from, size_t count, size_t *made_count);

#endif
