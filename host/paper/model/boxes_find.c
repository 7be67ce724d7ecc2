/* boxes_find.c - see boxes_find.h.
 *
 * The sheet is divided into cells of unit x unit fibers. Each cell that has an active fiber is
 * a box, as small as can be; boxes that would touch with their margins become one, until none
 * do, and then the two that lose least by it, until there are few. */
#include "model/boxes_find.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>

/* A part of an axis of the torus: from..from + length - 1, from within 0..sheet - 1. */
struct range {
    int from, length;
};

static int wrapped(int at, int sheet)
{
    return ((at % sheet) + sheet) % sheet;
}

/* The shorter way to have both. */
static struct range range_joined(struct range a, struct range b, int sheet)
{
    const int to_b = wrapped(b.from - a.from, sheet), to_a = wrapped(a.from - b.from, sheet);
    const int from_a = a.length > to_b + b.length ? a.length : to_b + b.length,
              from_b = b.length > to_a + a.length ? b.length : to_a + a.length;
    struct range r =
        from_a <= from_b ? (struct range){a.from, from_a} : (struct range){b.from, from_b};
    return r.length < sheet ? r : (struct range){0, sheet};
}

static bool ranges_touch(struct range a, struct range b, int sheet)
{
    return wrapped(b.from - a.from, sheet) < a.length ||
           wrapped(a.from - b.from, sheet) < b.length;
}

/* 1, 2, 3, 4, 6, 8, 12, ... units: boxes of few lengths, so that few kernels are made. */
static int length_of_few(int least, int unit)
{
    for (int power = 1;; power *= 2) {
        if (power * unit >= least)
            return power * unit;
        if (power > 1 && power / 2 * 3 * unit >= least)
            return power / 2 * 3 * unit;
    }
}

/* With the margin, and as long as a box is. */
static struct range range_boxed(struct range r, const struct boxes_wish *wish, int sheet)
{
    const int least = r.length + 2 * wish->margin, length = length_of_few(least, wish->unit);
    if (length >= sheet)
        return (struct range){0, sheet};
    return (struct range){wrapped(r.from - wish->margin - (length - least) / 2, sheet), length};
}

struct tight { /* around active fibers, without a margin */
    struct range x, y;
};

static struct box boxed(const struct boxes_wish *wish, const struct tight *t)
{
    const struct range x = range_boxed(t->x, wish, wish->width),
                       y = range_boxed(t->y, wish, wish->height);
    return (struct box){x.from, y.from, x.length, y.length};
}

static bool boxes_touch(const struct boxes_wish *wish, const struct tight *a,
                        const struct tight *b)
{
    const struct box p = boxed(wish, a), q = boxed(wish, b);
    return ranges_touch((struct range){p.x, p.width}, (struct range){q.x, q.width},
                        wish->width) &&
           ranges_touch((struct range){p.y, p.height}, (struct range){q.y, q.height},
                        wish->height);
}

static struct tight tight_joined(const struct boxes_wish *wish, const struct tight *a,
                                 const struct tight *b)
{
    return (struct tight){range_joined(a->x, b->x, wish->width),
                          range_joined(a->y, b->y, wish->height)};
}

static double area(const struct boxes_wish *wish, const struct tight *t)
{
    const struct box b = boxed(wish, t);
    return (double)b.width * (double)b.height;
}

/* The active fibers of x1..x2 - 1, y1..y2 - 1 of rows of `width`. False: there is none. */
static bool tight_make(const uint8_t *active, int width, int x1, int y1, int x2, int y2,
                       struct tight *t)
{
    int left = x2, right = x1 - 1, top = y2, bottom = y1 - 1;
    for (int y = y1; y < y2; y++) {
        const uint8_t *row = active + (size_t)y * (size_t)width;
        int first = x1, last = x2 - 1;
        while (first < x2 && !row[first])
            first++;
        if (first == x2)
            continue;
        while (!row[last])
            last--;
        left = first < left ? first : left;
        right = last > right ? last : right;
        top = y < top ? y : top;
        bottom = y;
    }
    *t = (struct tight){{left, right - left + 1}, {top, bottom - top + 1}};
    return right >= left;
}

/* ---- joining ---- */

/* Adds one, joined with whatever it touches. */
static void add(const struct boxes_wish *wish, struct tight *all, int *count, struct tight t)
{
    for (int i = 0; i < *count;)
        if (boxes_touch(wish, &all[i], &t)) {
            t = tight_joined(wish, &all[i], &t);
            all[i] = all[--*count];
            i = 0; /* those before may touch it now */
        } else {
            i++;
        }
    all[(*count)++] = t;
}

/* Joins the two that lose least by it. */
static void fewer(const struct boxes_wish *wish, struct tight *all, int *count)
{
    int best[2] = {0, 1};
    double least = INFINITY;
    for (int a = 0; a < *count; a++)
        for (int b = a + 1; b < *count; b++) {
            const struct tight both = tight_joined(wish, &all[a], &all[b]);
            const double lost = area(wish, &both) - area(wish, &all[a]) - area(wish, &all[b]);
            if (lost < least) {
                least = lost;
                best[0] = a;
                best[1] = b;
            }
        }
    const struct tight both = tight_joined(wish, &all[best[0]], &all[best[1]]);
    all[best[1]] = all[--*count];
    all[best[0]] = all[--*count];
    add(wish, all, count, both);
}

int boxes_find(const struct boxes_wish *wish, const uint8_t *active,
               struct box boxes[BOXES_MOST])
{
    enum { TOGETHER = 64 }; /* that are kept apart while there are more cells to come */
    struct tight all[TOGETHER + 1], t;
    int count = 0;
    for (int y = 0; y < wish->height; y += wish->unit)
        for (int x = 0; x < wish->width; x += wish->unit) {
            const int x2 = x + wish->unit < wish->width ? x + wish->unit : wish->width,
                      y2 = y + wish->unit < wish->height ? y + wish->unit : wish->height;
            if (!tight_make(active, wish->width, x, y, x2, y2, &t))
                continue;
            add(wish, all, &count, t);
            while (count > TOGETHER)
                fewer(wish, all, &count);
        }
    while (count > BOXES_MOST)
        fewer(wish, all, &count);
    for (int i = 0; i < count; i++)
        boxes[i] = boxed(wish, &all[i]);
    return count;
}

int boxes_distance(const struct boxes_wish *wish, const struct box *box, const uint8_t *active)
{
    struct tight t;
    if (!tight_make(active, box->width, 0, 0, box->width, box->height, &t))
        return INT_MAX;
    int distance = INT_MAX;
    const struct {
        int from, length, box, sheet;
    } axes[2] = {{t.x.from, t.x.length, box->width, wish->width},
                 {t.y.from, t.y.length, box->height, wish->height}};
    for (int i = 0; i < 2; i++) {
        const int before = axes[i].from, after = axes[i].box - axes[i].from - axes[i].length,
                  least = before < after ? before : after;
        if (axes[i].box != axes[i].sheet && least < distance)
            distance = least;
    }
    return distance;
}
