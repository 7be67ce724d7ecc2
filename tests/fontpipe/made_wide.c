/* made_wide.c - adds an axis of widths to a font: see made_font.h. */
#include "made_font.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_MAX = 600, PHANTOMS = 4 };

static uint32_t get(const uint8_t *at, int bytes)
{
    uint32_t value = 0;
    for (int k = 0; k < bytes; k++)
        value = value << 8 | at[k];
    return value;
}

static const uint8_t *table_of(const uint8_t *font, const char *tag)
{
    unsigned tables = get(font + 4, 2);
    for (unsigned t = 0; t < tables; t++)
        if (memcmp(font + 12 + 16 * t, tag, 4) == 0)
            return font + get(font + 12 + 16 * t + 8, 4);
    return NULL;
}

/* Reads the x of the points of a simple glyph; returns how many. */
static int points_read(const uint8_t *glyph, int x[POINTS_MAX])
{
    int contours = (int16_t)get(glyph, 2), count, n = 0, at = 0;
    uint8_t flags[POINTS_MAX];
    if (contours <= 0)
        return 0;
    count = (int)get(glyph + 10 + 2 * (contours - 1), 2) + 1;
    if (count > POINTS_MAX - PHANTOMS)
        return 0;
    const uint8_t *p = glyph + 10 + 2 * contours;
    p += 2 + get(p, 2); /* instructions */
    while (n < count) {
        uint8_t flag = *p++;
        int repeats = flag & 8 ? *p++ : 0;
        for (int i = 0; i <= repeats && n < count; i++)
            flags[n++] = flag;
    }
    for (int i = 0; i < count; i++) {
        if (flags[i] & 2) {
            at += flags[i] & 16 ? *p : -*p;
            p++;
        } else if (!(flags[i] & 16)) {
            at += (int16_t)get(p, 2);
            p += 2;
        }
        x[i] = at;
    }
    return count;
}

/* Writes differences in x as runs of words, and differences of 0 in y. */
static uint8_t *deltas_put(uint8_t *to, const int *x, int count, int sign)
{
    enum { RUN = 64 };
    *to++ = 0; /* all points */
    for (int i = 0; i < count; i += RUN) {
        int n = count - i < RUN ? count - i : RUN;
        *to++ = (uint8_t)(0x40 | (n - 1));
        for (int k = i; k < i + n; k++)
            to = made_put(to, (uint32_t)(sign * ((x[k] + (x[k] < 0 ? -5 : 5)) / 10)), 2);
    }
    for (int i = 0; i < count; i += RUN)
        *to++ = (uint8_t)(0x80 | ((count - i < RUN ? count - i : RUN) - 1));
    return to;
}

/* Writes the variations of a glyph; returns the place after them. */
static uint8_t *glyph_put(uint8_t *to, const uint8_t *glyph, int advance)
{
    int x[POINTS_MAX], count = points_read(glyph, x);
    if (!count)
        return to;
    const int phantoms[PHANTOMS] = {0, advance, 0, 0};
    memcpy(x + count, phantoms, sizeof phantoms);
    uint8_t *data = to + 12, *end = data;
    made_put(made_put(to, 2, 2), 12, 2);
    for (int k = 0; k < 2; k++) {
        uint8_t *begin = end;
        end = deltas_put(begin, x, count + PHANTOMS, k ? -1 : 1);
        made_put(made_put(to + 4 + 4 * k, (uint32_t)(end - begin), 2), 0x2000u | (unsigned)k,
                 2);
    }
    return end;
}

uint8_t *made_wide(const uint8_t *from, size_t count, size_t *made_count)
{
    static const uint8_t fvar[] = {0, 1,   0, 0, 0,   16,  0,   2,   0, 1,  0, 20,
                                   0, 0,   0, 8, 'w', 'd', 't', 'h', 0, 90, 0, 0,
                                   0, 100, 0, 0, 0,   110, 0,   0,   0, 0,  1, 0};
    const uint8_t *loca = table_of(from, "loca"), *glyf = table_of(from, "glyf"),
                  *hmtx = table_of(from, "hmtx");
    bool large = get(table_of(from, "head") + 50, 2);
    unsigned glyphs = get(table_of(from, "maxp") + 4, 2),
             metrics = get(table_of(from, "hhea") + 34, 2);
    size_t data = 20 + 4 * ((size_t)glyphs + 1) + 4;
    uint8_t *gvar = calloc(1, data + 6 * count + 64), *end = gvar + data;
    made_put(gvar, 0x00010000, 4);
    made_put(made_put(made_put(gvar + 4, 1, 2), 2, 2), (uint32_t)data - 4, 4);
    made_put(made_put(made_put(gvar + 12, glyphs, 2), 1, 2), (uint32_t)data, 4);
    made_put(made_put(gvar + data - 4, 0x4000, 2), 0xc000, 2); /* 1 and -1 */
    for (unsigned g = 0; g < glyphs; g++) {
        uint32_t begin = large ? get(loca + 4 * g, 4) : 2 * get(loca + 2 * g, 2),
                 next = large ? get(loca + 4 * g + 4, 4) : 2 * get(loca + 2 * g + 2, 2);
        int advance = (int)get(hmtx + 4 * (g < metrics ? g : metrics - 1), 2);
        made_put(gvar + 20 + 4 * g, (uint32_t)(end - gvar - (ptrdiff_t)data), 4);
        if (next > begin)
            end = glyph_put(end, glyf + begin, advance);
        end += (end - gvar) & 1;
    }
    made_put(gvar + 20 + 4 * (size_t)glyphs, (uint32_t)(end - gvar - (ptrdiff_t)data), 4);
    const struct made_table tables[] = {{"fvar", fvar, sizeof fvar},
                                        {"gvar", gvar, (size_t)(end - gvar)}};
    uint8_t *made = made_font(from, count, tables, 2, made_count);
    free(gvar);
    return made;
}
