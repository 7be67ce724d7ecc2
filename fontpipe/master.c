/* master.c - see master.h. A prepared outline covers nothing twice, so a row is found by
 * turning bits over: each edge that crosses the row's middle turns all pixels right of it, and
 * two turns are none. Of a tangled outline winding numbers are counted. */
#include "master.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 1 << 26 };

void font_master_finish(struct font_master *m)
{
    free(m->bits);
    *m = (struct font_master){0};
}

/* Turns the first pixel right of each crossing of a row's middle; or notes in `winding` by how
 * much the number changes there. */
static void line_turn(struct font_master *m, int *winding, struct font_point a,
                      struct font_point b)
{
    int direction = 1;
    if (a.y > b.y) {
        struct font_point swap = a;
        a = b;
        b = swap;
        direction = -1;
    }
    int first = (int)fmax(0, ceil(a.y - 0.5)), end = (int)fmin(m->height_px, ceil(b.y - 0.5));
    for (int y = first; y < end; y++) {
        double x = a.x + (b.x - a.x) * ((y + 0.5 - a.y) / (b.y - a.y));
        int at = (int)fmax(0, ceil(x - 0.5));
        if (at >= m->width_px)
            continue;
        if (winding)
            winding[(size_t)y * (size_t)m->width_px + (size_t)at] += direction;
        else
            m->bits[(size_t)y * (size_t)m->row_words + (size_t)(at / 64)] ^= 1ull << (at % 64);
    }
}

/* Turns the pixels at which the filling changes, of a row whose winding number changes so. */
static void row_turn(uint64_t *row, const int *winding, int width, enum font_fill rule)
{
    int number = 0;
    for (int x = 0; x < width; x++) {
        bool before = font_fill_has(number, rule);
        number += winding[x];
        if (before != font_fill_has(number, rule))
            row[x / 64] ^= 1ull << (x % 64);
    }
}

/* Each bit becomes the parity of those up to it. */
static void row_fill(uint64_t *row, int words)
{
    uint64_t carry = 0;
    for (int i = 0; i < words; i++) {
        uint64_t w = row[i];
        for (int shift = 1; shift < 64; shift *= 2)
            w ^= w << shift;
        row[i] = w ^ carry;
        carry = row[i] >> 63 ? ~0ull : 0;
    }
}

static void segments_turn(struct font_master *m, int *winding, const struct font_outline *o,
                          double scale)
{
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        double length = 0;
        for (int k = 0; k < s->degree; k++)
            length += hypot(s->p[k + 1].x - s->p[k].x, s->p[k + 1].y - s->p[k].y) * scale;
        /* A piece of length l leaves a curve by some l^2 over its length: a small part of a
         * pixel. */
        int n = s->degree == 1 ? 1 : 2 + (int)ceil(2 * sqrt(length));
        struct font_point a = {s->p[0].x * scale - m->left_px, -s->p[0].y * scale - m->top_px};
        for (int k = 1; k <= n; k++) {
            struct font_point p =
                k == n ? s->p[s->degree] : font_segment_at(s, (double)k / n, NULL);
            struct font_point b = {p.x * scale - m->left_px, -p.y * scale - m->top_px};
            line_turn(m, winding, a, b);
            a = b;
        }
    }
}

enum font_status font_master_make(struct font_master *m, const struct font_outline *o,
                                  int em_px)
{
    font_master_finish(m);
    if (em_px < 1 || em_px > FONT_MASTER_EM_MAX || !o->prepared || !(o->units_per_em > 0))
        return font_fail(FONT_BAD_ARGUMENT, "a master's em must be 1..%d pixels (got %d)",
                         FONT_MASTER_EM_MAX, em_px);
    double scale = em_px / o->units_per_em;
    m->em_px = em_px;
    m->advance_px = o->advance * scale;
    if (!o->segments_count)
        return FONT_OK;
    struct font_box box = o->box;
    double x0 = floor(box.x0 * scale), y0 = floor(-box.y1 * scale);
    double width = ceil(box.x1 * scale) - x0, height = ceil(-box.y0 * scale) - y0;
    if (!(fabs(x0) < 1e6 && fabs(y0) < 1e6 && width * height / 64 < WORDS_MAX)) {
        font_master_finish(m);
        return font_fail(FONT_TOO_LARGE, "a master of %.0fx%.0f pixels is too large", width,
                         height);
    }
    m->left_px = (int)x0;
    m->top_px = (int)y0;
    m->width_px = (int)fmax(1, width);
    m->height_px = (int)fmax(1, height);
    m->row_words = (m->width_px + 63) / 64;
    m->bits = calloc((size_t)m->row_words * (size_t)m->height_px, sizeof *m->bits);
    if (!m->bits) {
        font_master_finish(m);
        return font_fail(FONT_NO_MEMORY, "no memory for a master");
    }
    int *winding = NULL;
    if (o->tangled) {
        winding = calloc((size_t)m->width_px * (size_t)m->height_px, sizeof *winding);
        if (!winding) {
            font_master_finish(m);
            return font_fail(FONT_NO_MEMORY, "no memory for a master");
        }
    }
    segments_turn(m, winding, o, scale);
    for (int y = 0; winding && y < m->height_px; y++)
        row_turn(m->bits + (size_t)y * (size_t)m->row_words,
                 winding + (size_t)y * (size_t)m->width_px, m->width_px, o->rule);
    free(winding);
    for (int y = 0; y < m->height_px; y++)
        row_fill(m->bits + (size_t)y * (size_t)m->row_words, m->row_words);
    /* Beyond the width nothing is black. */
    if (m->width_px % 64)
        for (int y = 0; y < m->height_px; y++)
            m->bits[(size_t)(y + 1) * (size_t)m->row_words - 1] &=
                (1ull << (m->width_px % 64)) - 1;
    return FONT_OK;
}

bool font_master_at(const struct font_master *m, int x, int y)
{
    x -= m->left_px;
    y -= m->top_px;
    if (x < 0 || y < 0 || x >= m->width_px || y >= m->height_px)
        return false;
    return m->bits[(size_t)y * (size_t)m->row_words + (size_t)(x / 64)] >> (x % 64) & 1;
}

void font_master_fill(struct font_master *m, int x, int y, int width, int height, bool black)
{
    long x0 = (long)x - m->left_px, y0 = (long)y - m->top_px, x1 = x0 + width, y1 = y0 + height;
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 > m->width_px ? m->width_px : x1;
    y1 = y1 > m->height_px ? m->height_px : y1;
    for (long r = y0; r < y1; r++)
        for (long c = x0; c < x1; c++) {
            uint64_t *word = &m->bits[(size_t)r * (size_t)m->row_words + (size_t)(c / 64)];
            uint64_t bit = 1ull << (c % 64);
            *word = black ? *word | bit : *word & ~bit;
        }
}

long font_master_ink(const struct font_master *m)
{
    long ink = 0;
    for (size_t i = 0; i < (size_t)m->row_words * (size_t)m->height_px; i++)
        ink += __builtin_popcountll(m->bits[i]);
    return ink;
}
