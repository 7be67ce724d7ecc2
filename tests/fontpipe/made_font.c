/* made_font.c - see made_font.h. */
#include "made_font.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* The place where a child's offset is written. Bit 31: in the list of bases; bit 30: in that of
 * layers; else within the paints. */
#define OF_BASES 0x80000000u
#define OF_LAYERS 0x40000000u

uint8_t *made_put(uint8_t *at, uint32_t value, int bytes)
{
    for (int k = bytes - 1; k >= 0; k--)
        *at++ = (uint8_t)(value >> (8 * k));
    return at;
}

static uint32_t get(const uint8_t *at, int bytes)
{
    uint32_t value = 0;
    for (int k = 0; k < bytes; k++)
        value = value << 8 | at[k];
    return value;
}

static int tags_compare(const void *a, const void *b)
{
    return memcmp(a, b, 4);
}

uint8_t *made_font(const uint8_t *from, size_t count, const struct made_table *tables,
                   int tables_count, size_t *made_count)
{
    unsigned there = get(from + 4, 2), more = 0;
    size_t bytes = count + 4;
    for (int i = 0; i < tables_count; i++)
        bytes += 16 + (tables[i].count + 3) / 4 * 4;
    uint8_t *made = calloc(1, bytes), *entry = made + 12;
    size_t directory = 16 * (size_t)tables_count, at = (count + directory + 3) / 4 * 4;
    memcpy(made, from, 12);
    for (int i = 0; i < tables_count; i++, more++) {
        memcpy(entry, tables[i].tag, 4);
        made_put(made_put(entry + 8, (uint32_t)at, 4), (uint32_t)tables[i].count, 4);
        memcpy(made + at, tables[i].bytes, tables[i].count);
        at += (tables[i].count + 3) / 4 * 4;
        entry += 16;
    }
    memcpy(entry, from + 12, 16 * there);
    for (unsigned t = 0; t < there; t++)
        made_put(entry + 16 * t + 8, get(from + 12 + 16 * t + 8, 4) + (uint32_t)directory, 4);
    memcpy(entry + 16 * there, from + 12 + 16 * there, count - 12 - 16 * there);
    made_put(made + 4, there + more, 2);
    qsort(made + 12, there + more, 16, tags_compare);
    *made_count = at;
    return made;
}

/* ---- paints ---- */

struct made_paints *made_paints_begin(void)
{
    struct made_paints *p = calloc(1, sizeof *p);
    p->bases_count = 4; /* how many */
    p->layers_count = 4;
    p->clips_count = 5;
    return p;
}

size_t made_base(struct made_paints *p, unsigned glyph)
{
    made_put(p->bases, get(p->bases, 4) + 1, 4);
    made_put(p->bases + p->bases_count, glyph, 2);
    p->bases_count += 6;
    return OF_BASES | (p->bases_count - 4);
}

size_t made_layer(struct made_paints *p)
{
    made_put(p->layers, get(p->layers, 4) + 1, 4);
    p->layers_count += 4;
    return OF_LAYERS | (p->layers_count - 4);
}

size_t made_paint(struct made_paints *p, size_t of, unsigned format, const char *widths, ...)
{
    size_t begin = p->paints_count;
    uint8_t *at = made_put(p->paints + begin, format, 1);
    va_list numbers;
    if (of & OF_BASES) /* made_colr() adds the list's length */
        made_put(p->bases + (of & ~OF_BASES), (uint32_t)begin, 4);
    else if (of & OF_LAYERS)
        made_put(p->layers + (of & ~OF_LAYERS), (uint32_t)begin, 4);
    else /* until then the place holds its parent's beginning */
        made_put(p->paints + of, (uint32_t)begin - get(p->paints + of, 3), 3);
    va_start(numbers, widths);
    for (const char *w = widths; *w; w++) {
        long value = va_arg(numbers, int);
        at = made_put(at, *w == '3' ? (uint32_t)begin : (uint32_t)value, *w - '0');
    }
    va_end(numbers);
    p->paints_count = (size_t)(at - p->paints);
    return begin;
}

void made_clip(struct made_paints *p, unsigned glyph, int x0, int y0, int x1, int y1)
{
    uint8_t *at = p->clips + p->clips_count;
    at = made_put(made_put(at, glyph, 2), glyph, 2);
    at = made_put(at, 0, 3); /* made_colr() writes the box's offset */
    at = made_put(at, 1, 1);
    at = made_put(made_put(at, (uint32_t)x0, 2), (uint32_t)y0, 2);
    at = made_put(made_put(at, (uint32_t)x1, 2), (uint32_t)y1, 2);
    p->clips_count = (size_t)(at - p->clips);
}

uint8_t *made_colr(const struct made_paints *p, size_t *count)
{
    enum { HEADER = 34, CLIP_KEPT = 16, CLIP = 7, BOX = 9 };
    size_t clips = (p->clips_count - 5) / CLIP_KEPT;
    size_t bases = HEADER, layers = bases + p->bases_count, paints = layers + p->layers_count,
           boxes = paints + p->paints_count;
    *count = boxes + p->clips_count;
    uint8_t *made = calloc(1, *count), *at;
    made_put(made, 1, 2); /* of version 0 there is nothing */
    at = made_put(made + 14, (uint32_t)bases, 4);
    at = made_put(at, (uint32_t)layers, 4);
    at = made_put(at, clips ? (uint32_t)boxes : 0, 4);
    memcpy(made + bases, p->bases, p->bases_count);
    memcpy(made + layers, p->layers, p->layers_count);
    memcpy(made + paints, p->paints, p->paints_count);
    for (size_t i = 4; i < p->bases_count; i += 6)
        made_put(made + bases + i + 2, get(p->bases + i + 2, 4) + (uint32_t)(paints - bases),
                 4);
    for (size_t i = 4; i < p->layers_count; i += 4)
        made_put(made + layers + i, get(p->layers + i, 4) + (uint32_t)(paints - layers), 4);
    at = made_put(made_put(made + boxes, 1, 1), (uint32_t)clips, 4);
    for (size_t i = 0; i < clips; i++) {
        const uint8_t *from = p->clips + 5 + i * CLIP_KEPT;
        size_t box = 5 + clips * CLIP + i * BOX;
        memcpy(at, from, 4);
        at = made_put(at + 4, (uint32_t)box, 3);
        memcpy(made + boxes + box, from + CLIP, BOX);
    }
    return made;
}

size_t made_cpal(const uint8_t (*bgra)[4], int colours, uint8_t *out)
{
    uint8_t *at = made_put(made_put(out, 0, 2), (uint32_t)colours, 2);
    at = made_put(made_put(at, 1, 2), (uint32_t)colours, 2);
    at = made_put(made_put(at, 14, 4), 0, 2);
    memcpy(at, bgra, 4 * (size_t)colours);
    return 14 + 4 * (size_t)colours;
}

size_t made_svg(const char *document, unsigned first, unsigned last, uint8_t *out)
{
    uint8_t *at = made_put(made_put(made_put(out, 0, 2), 10, 4), 0, 4);
    at = made_put(made_put(made_put(at, 1, 2), first, 2), last, 2);
    at = made_put(made_put(at, 14, 4), (uint32_t)strlen(document), 4);
    memcpy(at, document, strlen(document));
    return 24 + strlen(document);
}
