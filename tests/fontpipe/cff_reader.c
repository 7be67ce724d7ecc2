/* cff_reader.c - see cff_reader.h: Adobe's Technical Notes 5176 and 5177. */
#include "cff_reader.h"

#include <string.h>

enum { STACK = 64, DEPTH = 12 };

struct index {
    const uint8_t *data, *offsets;
    int count, size;
    const uint8_t *end;
};

struct state {
    struct cff_reader *reader;
    struct index global, local;
    double stack[STACK], x, y, first_x, first_y;
    int count, hints;
    bool open, width_seen, ended, bad;
};

static uint32_t number(const uint8_t *p, int bytes)
{
    uint32_t n = 0;
    for (int i = 0; i < bytes; i++)
        n = n << 8 | p[i];
    return n;
}

static struct index index_read(const uint8_t *p)
{
    struct index x = {.count = (int)number(p, 2)};
    x.end = p + 2;
    if (!x.count)
        return x;
    x.size = p[2];
    x.offsets = p + 3;
    x.data = p + 3 + (x.count + 1) * x.size - 1;
    x.end = x.data + number(x.offsets + x.count * x.size, x.size);
    return x;
}

static const uint8_t *item(const struct index *x, int i, const uint8_t **end)
{
    *end = x->data + number(x->offsets + (i + 1) * x->size, x->size);
    return x->data + number(x->offsets + i * x->size, x->size);
}

/* The whole numbers of an operator in a dictionary; how many. */
static int dict_find(const uint8_t *p, const uint8_t *end, int op, int *values)
{
    int found[48], n = 0;
    while (p < end) {
        int b = *p++;
        if (b <= 21) {
            b = b == 12 ? 1200 + *p++ : b;
            if (b == op) {
                memcpy(values, found, (size_t)(n < 2 ? n : 2) * sizeof *found);
                return n;
            }
            n = 0;
        } else if (b == 30) { /* a real number, which none of these is */
            while ((*p & 15) != 15 && *p >> 4 != 15)
                p++;
            p++;
            found[n++ % 48] = 0;
        } else if (b == 28) {
            found[n++ % 48] = (int16_t)number(p, 2);
            p += 2;
        } else if (b == 29) {
            found[n++ % 48] = (int32_t)number(p, 4);
            p += 4;
        } else if (b <= 246) {
            found[n++ % 48] = b - 139;
        } else if (b <= 250) {
            found[n++ % 48] = (b - 247) * 256 + *p++ + 108;
        } else {
            found[n++ % 48] = -(b - 251) * 256 - *p++ - 108;
        }
    }
    return 0;
}

static void line_by(struct state *s, double dx, double dy)
{
    const double p[4] = {s->x, s->y, s->x + dx, s->y + dy};
    s->reader->line(s->reader->context, p);
    s->x = p[2];
    s->y = p[3];
}

static void curve_by(struct state *s, double ax, double ay, double bx, double by, double cx,
                     double cy)
{
    const double p[8] = {
        s->x,           s->y,           s->x + ax,           s->y + ay,
        s->x + ax + bx, s->y + ay + by, s->x + ax + bx + cx, s->y + ay + by + cy};
    s->reader->cubic(s->reader->context, p);
    s->x = p[6];
    s->y = p[7];
}

/* The next contour begins relative to where this one's last piece of its own ended. */
static void contour_close(struct state *s)
{
    double x = s->x, y = s->y;
    if (s->open && (x != s->first_x || y != s->first_y))
        line_by(s, s->first_x - x, s->first_y - y);
    s->x = x;
    s->y = y;
    s->open = false;
}

static void move_by(struct state *s, double dx, double dy)
{
    contour_close(s);
    s->x += dx;
    s->y += dy;
    s->first_x = s->x;
    s->first_y = s->y;
    s->open = true;
}

/* vhcurveto and hvcurveto: tangents in turns along the axes. */
static void turns_draw(struct state *s, bool across)
{
    const double *a = s->stack;
    for (int i = 0; i + 4 <= s->count; i += 4, across = !across) {
        double last = s->count - i == 5 ? a[i + 4] : 0;
        if (across)
            curve_by(s, a[i], 0, a[i + 1], a[i + 2], last, a[i + 3]);
        else
            curve_by(s, 0, a[i], a[i + 1], a[i + 2], a[i + 3], last);
    }
}

static void flex_draw(struct state *s, int op)
{
    const double *a = s->stack;
    double y = s->y, x = s->x;
    if (op == 35) {
        curve_by(s, a[0], a[1], a[2], a[3], a[4], a[5]);
        curve_by(s, a[6], a[7], a[8], a[9], a[10], a[11]);
    } else if (op == 34) {
        curve_by(s, a[0], 0, a[1], a[2], a[3], 0);
        curve_by(s, a[4], 0, a[5], y - s->y, a[6], 0);
    } else if (op == 36) {
        curve_by(s, a[0], a[1], a[2], a[3], a[4], 0);
        curve_by(s, a[5], 0, a[6], a[7], a[8], y - (s->y + a[7]));
    } else if (op == 37) {
        double dx = a[0] + a[2] + a[4] + a[6] + a[8], dy = a[1] + a[3] + a[5] + a[7] + a[9];
        bool along = dx * dx > dy * dy;
        curve_by(s, a[0], a[1], a[2], a[3], a[4], a[5]);
        curve_by(s, a[6], a[7], a[8], a[9], along ? a[10] : x - (s->x + a[6] + a[8]),
                 along ? y - (s->y + a[7] + a[9]) : a[10]);
    } else {
        s->bad = true;
    }
}

/* Straight and curved pieces with all their numbers. */
static void pieces_draw(struct state *s, int op)
{
    const double *a = s->stack;
    int i = 0, n = s->count;
    int curves_end = op == 25 ? 0 : op == 24 ? n - 2 : n, lines_end = op == 25 ? n - 6 : 0;
    if (op == 5)
        lines_end = n, curves_end = 0;
    for (; i + 2 <= lines_end; i += 2)
        line_by(s, a[i], a[i + 1]);
    for (curves_end = op == 25 ? n : curves_end; i + 6 <= curves_end; i += 6)
        curve_by(s, a[i], a[i + 1], a[i + 2], a[i + 3], a[i + 4], a[i + 5]);
    if (op == 24)
        line_by(s, a[i], a[i + 1]);
}

/* hhcurveto and vvcurveto. */
static void level_draw(struct state *s, bool across)
{
    const double *a = s->stack;
    int i = s->count % 4 == 1;
    double other = i ? a[0] : 0;
    for (; i + 4 <= s->count; i += 4, other = 0)
        if (across)
            curve_by(s, a[i], other, a[i + 1], a[i + 2], a[i + 3], 0);
        else
            curve_by(s, other, a[i], a[i + 1], a[i + 2], 0, a[i + 3]);
}

/* The first operator that clears the stack may have the advance before its own numbers. */
static const double *own(struct state *s, int wanted)
{
    int extra = !s->width_seen && s->count > wanted ? s->count - wanted : 0;
    s->width_seen = true;
    return s->stack + extra;
}

static void run(struct state *s, const uint8_t *p, const uint8_t *end, int depth);

static void subroutine(struct state *s, const struct index *x, int depth)
{
    int bias = x->count < 1240 ? 107 : x->count < 33900 ? 1131 : 32768;
    int which = s->count ? (int)s->stack[--s->count] + bias : -1;
    const uint8_t *end;
    if (which < 0 || which >= x->count || depth == DEPTH) {
        s->bad = true;
        return;
    }
    const uint8_t *p = item(x, which, &end);
    run(s, p, end, depth + 1);
}

static void draw(struct state *s, int op)
{
    const double *a;
    bool across = op == 6;
    switch (op) {
    case 4:
        a = own(s, 1);
        move_by(s, 0, a[0]);
        break;
    case 22:
        a = own(s, 1);
        move_by(s, a[0], 0);
        break;
    case 21:
        a = own(s, 2);
        move_by(s, a[0], a[1]);
        break;
    case 6:
    case 7:
        for (int i = 0; i < s->count; i++, across = !across)
            line_by(s, across ? s->stack[i] : 0, across ? 0 : s->stack[i]);
        break;
    case 5:
    case 8:
    case 24:
    case 25:
        pieces_draw(s, op);
        break;
    case 26:
    case 27:
        level_draw(s, op == 27);
        break;
    case 30:
    case 31:
        turns_draw(s, op == 31);
        break;
    default:
        s->bad = true;
    }
    s->count = 0;
}

static void run(struct state *s, const uint8_t *p, const uint8_t *end, int depth)
{
    while (p < end && !s->ended && !s->bad) {
        int b = *p++;
        if (b == 28) {
            s->stack[s->count++ % STACK] = (int16_t)number(p, 2);
            p += 2;
        } else if (b == 255) {
            s->stack[s->count++ % STACK] = (int32_t)number(p, 4) / 65536.0;
            p += 4;
        } else if (b >= 251) {
            s->stack[s->count++ % STACK] = -(b - 251) * 256 - *p++ - 108;
        } else if (b >= 247) {
            s->stack[s->count++ % STACK] = (b - 247) * 256 + *p++ + 108;
        } else if (b >= 32) {
            s->stack[s->count++ % STACK] = b - 139;
        } else if (b == 1 || b == 3 || b == 18 || b == 23 || b == 19 || b == 20) {
            s->hints += s->count / 2;
            s->count = 0;
            s->width_seen = true;
            if (b == 19 || b == 20)
                p += (s->hints + 7) / 8;
        } else if (b == 10 || b == 29) {
            subroutine(s, b == 10 ? &s->local : &s->global, depth);
        } else if (b == 11) {
            return;
        } else if (b == 14) {
            s->bad = s->count >= 4; /* an accented character */
            s->ended = true;
        } else if (b == 12) {
            flex_draw(s, *p++);
            s->count = 0;
        } else {
            draw(s, b);
        }
    }
}

bool cff_glyph_read(struct cff_reader *reader, const uint8_t *table, size_t bytes,
                    uint32_t glyph)
{
    struct state s = {.reader = reader};
    int values[2], private_at[2];
    const uint8_t *end;
    if (bytes < 4)
        return false;
    struct index names = index_read(table + table[2]), tops = index_read(names.end),
                 strings = index_read(tops.end);
    s.global = index_read(strings.end);
    const uint8_t *top = item(&tops, 0, &end);
    if (dict_find(top, end, 1230, values) || dict_find(top, end, 1207, values) ||
        !dict_find(top, end, 17, values))
        return false;
    struct index glyphs = index_read(table + values[0]);
    if (dict_find(top, end, 18, private_at) == 2) {
        const uint8_t *own_dict = table + private_at[1];
        if (dict_find(own_dict, own_dict + private_at[0], 19, values))
            s.local = index_read(own_dict + values[0]);
    }
    if (glyph >= (uint32_t)glyphs.count)
        return false;
    const uint8_t *p = item(&glyphs, (int)glyph, &end);
    run(&s, p, end, 0);
    contour_close(&s);
    return !s.bad;
}
