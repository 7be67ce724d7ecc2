/* read_spots.c - an eraser that takes spots out of strokes: what is left of a stroke is one
 * stroke or several, which were drawn when they were drawn, and all that one movement has
 * erased is one deed. */
#include "read_desk.h"

#include <math.h>

#define SPOT_PX 8.0 /* around the way of the eraser */
#define STEP_PX 2.0 /* how finely a stroke is looked at */

struct spot {
    double x, y; /* in the window */
};

/* A run of points that stays. */
struct piece {
    GArray *points; /* struct reader_ink_point */
    double made_s;
    int of; /* a stroke */
};

/* ---- where it was ---- */

static double way_distance(const struct spot *a, const struct spot *b, double x, double y)
{
    const double dx = b->x - a->x, dy = b->y - a->y, all = dx * dx + dy * dy;
    const double part = all > 0 ? CLAMP(((x - a->x) * dx + (y - a->y) * dy) / all, 0, 1) : 0;
    return hypot(a->x + part * dx - x, a->y + part * dy - y);
}

bool read_spots_at(const struct read_desk *d, double x, double y)
{
    for (guint i = 0; i < d->spots->len; i++) {
        const struct spot *b = &g_array_index(d->spots, struct spot, i), *a = i ? b - 1 : b;
        if (way_distance(a, b, x, y) < SPOT_PX)
            return true;
    }
    return false;
}

void read_spots_add(struct read_desk *d, double x, double y)
{
    const struct spot spot = {x, y};
    g_array_append_val(d->spots, spot);
    read_page_changed(d);
}

/* ---- cutting ---- */

static void piece_clear(gpointer item)
{
    g_array_unref(((struct piece *)item)->points);
}

/* A stroke that is being cut. */
struct cut {
    struct read_desk *desk;
    const struct reader_remark *from;
    int of;
    double x, y, em; /* where its points are counted from */
    bool touched;
    GArray *run, *pieces;
};

static void run_end(struct cut *c)
{
    const struct reader_remark *from = c->from;
    struct piece piece = {c->run, 0, c->of};
    if (!c->run->len)
        return;
    const float first_s = g_array_index(c->run, struct reader_ink_point, 0).time_s,
                last_s = g_array_index(c->run, struct reader_ink_point, c->run->len - 1).time_s;
    piece.made_s = fmax(0, from->made_s - (double)from->points[from->points_count - 1].time_s +
                               (double)last_s);
    for (guint i = 0; i < c->run->len; i++)
        g_array_index(c->run, struct reader_ink_point, i).time_s -= first_s;
    g_array_append_val(c->pieces, piece);
    c->run = g_array_new(FALSE, FALSE, sizeof(struct reader_ink_point));
}

static bool point_is_hit(const struct cut *c, const struct reader_ink_point *p)
{
    return read_spots_at(c->desk, c->x + c->em * (double)p->x, c->y + c->em * (double)p->y);
}

static void point_cut(struct cut *c, struct reader_ink_point p)
{
    if (point_is_hit(c, &p)) {
        c->touched = true;
        run_end(c);
        return;
    }
    p.x += (float)c->from->x; /* a piece has not been moved */
    p.y += (float)c->from->y;
    g_array_append_val(c->run, p);
}

static struct reader_ink_point between(const struct reader_ink_point *a,
                                       const struct reader_ink_point *b, float part)
{
    return (struct reader_ink_point){a->x + part * (b->x - a->x), a->y + part * (b->y - a->y),
                                     a->pressure + part * (b->pressure - a->pressure),
                                     a->time_s + part * (b->time_s - a->time_s)};
}

/* What lies between two points, as finely as the spots need it, where one is there. */
static void way_cut(struct cut *c, const struct reader_ink_point *a,
                    const struct reader_ink_point *b)
{
    const double px = c->em * hypot((double)(b->x - a->x), (double)(b->y - a->y));
    const int steps = (int)ceil(fmin(px, 20000) / STEP_PX);
    bool hit = false;
    for (int i = 1; i < steps && !hit; i++) {
        const struct reader_ink_point p = between(a, b, (float)i / (float)steps);
        hit = point_is_hit(c, &p);
    }
    for (int i = 1; i < steps && hit; i++)
        point_cut(c, between(a, b, (float)i / (float)steps));
}

/* A piece is not scaled. */
static struct reader_ink_point as_scaled(const struct reader_remark *r, int i)
{
    const struct reader_ink_place place = reader_ink_place(r, i);
    return (struct reader_ink_point){(float)place.x, (float)place.y, r->points[i].pressure,
                                     r->points[i].time_s};
}

/* Whether a spot is on the stroke; what stays of it is added to the pieces. */
static bool stroke_cut(struct read_desk *d, int of, GArray *pieces)
{
    const struct reader_remark *r = reader_remarks_get(d->remarks, of);
    struct cut c = {.desk = d, .from = r, .of = of, .em = d->size_px, .pieces = pieces};
    const guint before = pieces->len;
    if (!read_chosen_can(d, of) || !read_text_origin(d, r, &c.x, &c.y))
        return false;
    c.run = g_array_new(FALSE, FALSE, sizeof(struct reader_ink_point));
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_point point = as_scaled(r, i);
        if (i) {
            const struct reader_ink_point before_it = as_scaled(r, i - 1);
            way_cut(&c, &before_it, &point);
        }
        point_cut(&c, point);
    }
    run_end(&c);
    g_array_unref(c.run);
    if (!c.touched)
        g_array_set_size(pieces, before);
    return c.touched;
}

/* In the group of the stroke that it is of. */
static void piece_keep(struct read_desk *d, const struct piece *p)
{
    const struct reader_remark from = *reader_remarks_get(d->remarks, p->of);
    const int index = read_remarks_add(
        d,
        &(struct reader_remark){.kind = READER_REMARK_INK,
                                .rgba = from.rgba,
                                .width = from.width * sqrt(from.scale_x * from.scale_y),
                                .made_s = p->made_s,
                                .points = (struct reader_ink_point *)(void *)p->points->data,
                                .points_count =
                                    MIN((int)p->points->len, (int)READER_INK_POINTS_MAX)},
        from.begin, from.end);
    if (index < 0 || (from.group < 0 && !from.around))
        return;
    struct reader_arranged to = reader_remarks_arranged(d->remarks, index);
    if (from.group >= 0)
        to.hangs = from.hangs;
    to.group = from.group;
    to.around = from.around;
    read_remarks_arrange(d, &to, 1);
}

void read_spots_end(struct read_desk *d)
{
    const int count = d->remarks ? reader_remarks_count(d->remarks) : 0;
    GArray *pieces = g_array_new(FALSE, FALSE, sizeof(struct piece)),
           *cut = g_array_new(FALSE, FALSE, sizeof(int));
    g_array_set_clear_func(pieces, piece_clear);
    for (int i = 0; i < count && d->spots->len; i++)
        if (stroke_cut(d, i, pieces))
            g_array_append_val(cut, i);
    g_array_set_size(d->spots, 0);
    read_remarks_group(d, true);
    for (guint i = 0; i < cut->len; i++)
        read_remarks_erase(d, g_array_index(cut, int, i));
    for (guint i = 0; i < pieces->len; i++)
        piece_keep(d, &g_array_index(pieces, struct piece, i));
    read_remarks_group(d, false);
    g_array_unref(pieces);
    g_array_unref(cut);
    read_page_changed(d);
}
