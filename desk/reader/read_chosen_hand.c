/* read_chosen_hand.c - strokes are chosen by a press, by a frame that is dragged around them,
 * and by keys; dragged they are moved, at the handles of their box scaled.
 *
 *     0---1---2      a corner keeps the proportions,
 *     3   4   5      the middle of a side stretches;
 *     6---7---8      4, which is none, is the inside */
#include "read_desk.h"

#include <math.h>

#define HANDLE_PX 9.0 /* a square's side */
#define REACH_PX 9.0  /* around its middle */
#define FRAME_PX 4.0  /* between the ink and its box */
#define ROOM_PX 40.0  /* a box's side, at least, so that there is an inside */
#define STEP_EM 0.25
#define STEP_SCALE 1.1
#define LEAST_PX 4.0 /* a box's side, as its handles count it */

enum { GRAB_PX = 12, INSIDE = 4, HANDLES = 9 };

/* ---- handles ---- */

/* The part of a box's side at which a handle is: 0, 0.5 or 1. */
static double handle_x(int handle)
{
    return handle % 3 / 2.0;
}

static double handle_y(int handle)
{
    return handle / 3 / 2.0;
}

/* The box that is seen around that of the ink. */
static struct reader_box around(const struct reader_box *box)
{
    const double x = fmax(FRAME_PX, (ROOM_PX - box->width) / 2),
                 y = fmax(FRAME_PX, (ROOM_PX - box->height) / 2);
    return (struct reader_box){.x = box->x - x,
                               .y = box->y - y,
                               .width = box->width + 2 * x,
                               .height = box->height + 2 * y};
}

/* The handle at a point, or INSIDE; -1: it is outside. */
static int handle_at(const struct reader_box *box, double x, double y)
{
    const struct reader_box all = around(box);
    for (int i = 0; i < HANDLES; i++)
        if (i != INSIDE && fabs(all.x + handle_x(i) * all.width - x) <= REACH_PX &&
            fabs(all.y + handle_y(i) * all.height - y) <= REACH_PX)
            return i;
    return x >= all.x && x <= all.x + all.width && y >= all.y && y <= all.y + all.height
               ? INSIDE
               : -1;
}

/* What has become of the box by dragging its handle so far; what is opposite stays. */
static struct read_lay lay_of(int handle, const struct reader_box *box, double by_x,
                              double by_y)
{
    const double way_x = 2 * handle_x(handle) - 1, way_y = 2 * handle_y(handle) - 1,
                 width = fmax(LEAST_PX, box->width), height = fmax(LEAST_PX, box->height);
    struct read_lay lay = {.scale_x = 1, .scale_y = 1};
    if (handle == INSIDE) {
        lay.by_x = by_x;
        lay.by_y = by_y;
        return lay;
    }
    lay.from_x = box->x + (way_x < 0 ? box->width : 0);
    lay.from_y = box->y + (way_y < 0 ? box->height : 0);
    if (way_x != 0 && way_y != 0)
        lay.scale_x = lay.scale_y = 1 + (by_x * way_x * width + by_y * way_y * height) /
                                            (width * width + height * height);
    else if (way_x != 0)
        lay.scale_x = 1 + by_x * way_x / width;
    else
        lay.scale_y = 1 + by_y * way_y / height;
    return lay;
}

/* ---- the hand ---- */

void read_chosen_press(struct read_desk *d, double x, double y, bool more)
{
    struct reader_box box;
    const bool boxed = read_chosen_box(d, &box);
    const int handle = boxed && !more ? handle_at(&box, x, y) : -1,
              stroke = handle < 0 || handle == INSIDE ? read_chosen_at(d, x, y, GRAB_PX) : -1;
    d->hold.what = READ_HOLD_BOX;
    d->hold.handle = handle < 0 ? INSIDE : handle;
    d->hold.from_x = d->hold.x = x;
    d->hold.from_y = d->hold.y = y;
    if (stroke >= 0 && more && read_chosen_is(d, stroke)) {
        read_chosen_leave(d, stroke);
        d->hold.what = READ_HOLD_NOTHING;
    } else if (stroke >= 0 && !read_chosen_is(d, stroke)) {
        read_chosen_take(d, stroke, more);
    } else if (stroke < 0 && handle < 0) {
        if (!more)
            read_chosen_none(d);
        d->hold.what = READ_HOLD_FRAME;
    }
    if (d->hold.what == READ_HOLD_BOX && !read_chosen_box(d, &d->hold.box))
        d->hold.what = READ_HOLD_NOTHING;
}

void read_chosen_drag(struct read_desk *d, double x, double y)
{
    d->hold.x = x;
    d->hold.y = y;
    if (d->hold.what == READ_HOLD_BOX) {
        const struct read_lay lay =
            lay_of(d->hold.handle, &d->hold.box, x - d->hold.from_x, y - d->hold.from_y);
        read_chosen_preview(d, &lay);
    }
    read_page_changed(d);
}

static struct reader_box frame(const struct read_desk *d)
{
    return (struct reader_box){.x = fmin(d->hold.from_x, d->hold.x),
                               .y = fmin(d->hold.from_y, d->hold.y),
                               .width = fabs(d->hold.x - d->hold.from_x),
                               .height = fabs(d->hold.y - d->hold.from_y)};
}

/* Those that are within the frame, all of each. */
static void frame_take(struct read_desk *d)
{
    const struct reader_box all = frame(d);
    for (int i = 0; d->remarks && i < reader_remarks_count(d->remarks); i++) {
        struct reader_box b;
        if (read_chosen_can(d, i) && read_chosen_box_of(d, i, &b) && b.x >= all.x &&
            b.y >= all.y && b.x + b.width <= all.x + all.width &&
            b.y + b.height <= all.y + all.height)
            read_chosen_take(d, i, true);
    }
}

void read_chosen_release(struct read_desk *d)
{
    const bool moved = d->hold.x != d->hold.from_x || d->hold.y != d->hold.from_y;
    if (d->hold.what == READ_HOLD_FRAME)
        frame_take(d);
    read_chosen_preview(d, NULL);
    if (d->hold.what == READ_HOLD_BOX && moved) {
        const struct read_lay lay =
            lay_of(d->hold.handle, &d->hold.box, d->hold.x - d->hold.from_x,
                   d->hold.y - d->hold.from_y);
        read_around_lay(d, &lay);
    }
    d->hold.what = READ_HOLD_NOTHING;
}

/* ---- keys ---- */

/* The next stroke that can be chosen, or its group; it comes into the window. */
static bool step(struct read_desk *d, bool forward, bool more)
{
    const int count = d->remarks ? reader_remarks_count(d->remarks) : 0;
    struct reader_box box;
    if (!read_chosen_count(d))
        d->hold.at = forward ? -1 : count;
    for (int i = d->hold.at + (forward ? 1 : -1); i >= 0 && i < count; i += forward ? 1 : -1)
        if (read_chosen_can(d, i) && !read_chosen_is(d, i)) {
            d->hold.at = i;
            read_chosen_take(d, i, more);
            const struct reader_remark *r = reader_remarks_get(d->remarks, i);
            if (!read_chosen_box_of(d, i, &box) || box.y < 0 || box.y > d->setup.height_px)
                reader_view_go(d->view, r->begin, floor(d->setup.height_px / 3));
            read_page_changed(d);
            return true;
        }
    return false;
}

/* From its middle, in both directions or one. */
static void scale_by(struct read_desk *d, double x, double y)
{
    struct reader_box box;
    if (read_chosen_box(d, &box))
        read_around_lay(d, &(struct read_lay){.from_x = box.x + box.width / 2,
                                              .from_y = box.y + box.height / 2,
                                              .scale_x = x,
                                              .scale_y = y});
}

static bool arrow(struct read_desk *d, double x, double y, bool stretch)
{
    const double px = STEP_EM * d->size_px;
    if (stretch)
        scale_by(d, pow(STEP_SCALE, x), pow(STEP_SCALE, -y));
    else
        read_around_lay(
            d, &(struct read_lay){.scale_x = 1, .scale_y = 1, .by_x = px * x, .by_y = px * y});
    return true;
}

/* Of what is chosen. */
static bool deed_key(struct read_desk *d, guint key, bool shift)
{
    switch (key) {
    case GDK_KEY_Left:
        return arrow(d, -1, 0, shift);
    case GDK_KEY_Right:
        return arrow(d, 1, 0, shift);
    case GDK_KEY_Up:
        return arrow(d, 0, -1, shift);
    case GDK_KEY_Down:
        return arrow(d, 0, 1, shift);
    case GDK_KEY_plus:
    case GDK_KEY_equal:
    case GDK_KEY_KP_Add:
        scale_by(d, STEP_SCALE, STEP_SCALE);
        return true;
    case GDK_KEY_minus:
    case GDK_KEY_KP_Subtract:
        scale_by(d, 1 / STEP_SCALE, 1 / STEP_SCALE);
        return true;
    case GDK_KEY_g:
    case GDK_KEY_G:
        read_chosen_group(d, key == GDK_KEY_g);
        return true;
    case GDK_KEY_f:
        read_around_toggle(d);
        return true;
    case GDK_KEY_Delete:
    case GDK_KEY_BackSpace:
        read_chosen_erase(d);
        return true;
    case GDK_KEY_Escape:
        read_chosen_none(d);
        return true;
    default:
        return false;
    }
}

bool read_chosen_key(struct read_desk *d, guint key, bool shift)
{
    switch (key) {
    case GDK_KEY_Tab:
    case GDK_KEY_ISO_Left_Tab:
        return step(d, key == GDK_KEY_Tab && !shift, false);
    case GDK_KEY_a:
        step(d, true, true);
        return true;
    case GDK_KEY_A:
        read_chosen_all(d);
        return true;
    default:
        return read_chosen_count(d) && deed_key(d, key, shift);
    }
}

/* ---- drawing ---- */

static void box_stroke(cairo_t *cairo, const struct reader_box *box)
{
    cairo_rectangle(cairo, floor(box->x) + 0.5, floor(box->y) + 0.5, ceil(box->width),
                    ceil(box->height));
    cairo_stroke(cairo);
}

void read_chosen_draw(struct read_desk *d, cairo_t *cairo)
{
    const double *c = d->colours->link, *paper = d->colours->paper;
    struct reader_box box;
    if (d->tool != READ_TOOL_MOVE)
        return;
    cairo_set_source_rgb(cairo, c[0], c[1], c[2]);
    cairo_set_line_width(cairo, 1);
    if (d->hold.what == READ_HOLD_FRAME) {
        box = frame(d);
        box_stroke(cairo, &box);
    }
    if (d->hold.what == READ_HOLD_BOX || !read_chosen_box(d, &box))
        return;
    box = around(&box);
    box_stroke(cairo, &box);
    for (int i = 0; i < HANDLES; i++) {
        const double x = box.x + handle_x(i) * box.width, y = box.y + handle_y(i) * box.height;
        if (i == INSIDE)
            continue;
        cairo_rectangle(cairo, floor(x - HANDLE_PX / 2) + 0.5, floor(y - HANDLE_PX / 2) + 0.5,
                        HANDLE_PX - 1, HANDLE_PX - 1);
        cairo_set_source_rgb(cairo, paper[0], paper[1], paper[2]);
        cairo_fill_preserve(cairo);
        cairo_set_source_rgb(cairo, c[0], c[1], c[2]);
        cairo_stroke(cairo);
    }
}
