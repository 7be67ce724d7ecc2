/* read_chosen.c - strokes that are chosen: with those of their groups; moved, scaled, grouped
 * and erased, each as one deed. What is chosen and not in the window is moved with the others,
 * not scaled. */
#include "read_desk.h"

#include <math.h>

/* ---- which ---- */

bool read_chosen_can(const struct read_desk *d, int index)
{
    const struct reader_remark *r = reader_remarks_get(d->remarks, index);
    return r->kind == READER_REMARK_INK && reader_remark_seen(r) && !r->orphan &&
           r->layer == reader_remarks_written(d->remarks);
}

/* What was erased, hidden or lost meanwhile is chosen no longer. */
static GArray *chosen_now(const struct read_desk *d)
{
    GArray *strokes = d->chosen;
    if (!d->remarks)
        g_array_set_size(strokes, 0);
    for (guint i = strokes->len; i-- > 0;)
        if (!read_chosen_can(d, g_array_index(strokes, int, i)))
            g_array_remove_index(strokes, i);
    return strokes;
}

bool read_chosen_is(const struct read_desk *d, int index)
{
    const GArray *strokes = chosen_now(d);
    for (guint i = 0; i < strokes->len; i++)
        if (g_array_index(strokes, int, i) == index)
            return true;
    return false;
}

int read_chosen_count(struct read_desk *d)
{
    return (int)chosen_now(d)->len;
}

void read_chosen_none(struct read_desk *d)
{
    d->laid = false;
    if (!d->chosen->len)
        return;
    g_array_set_size(d->chosen, 0);
    d->acted(d);
    read_page_changed(d);
}

/* Whether two strokes are taken together. */
static bool is_with(const struct read_desk *d, int a, int b)
{
    const struct reader_remark *x = reader_remarks_get(d->remarks, a),
                               *y = reader_remarks_get(d->remarks, b);
    return a == b || (x->group >= 0 && x->group == y->group && read_chosen_can(d, b));
}

void read_chosen_take(struct read_desk *d, int index, bool more)
{
    if (!more)
        g_array_set_size(d->chosen, 0);
    const int count = reader_remarks_count(d->remarks);
    const bool grouped = reader_remarks_get(d->remarks, index)->group >= 0;
    for (int i = grouped ? 0 : index; i < (grouped ? count : index + 1); i++)
        if (is_with(d, index, i) && !read_chosen_is(d, i))
            g_array_append_val(d->chosen, i);
    d->acted(d);
    read_page_changed(d);
}

void read_chosen_leave(struct read_desk *d, int index)
{
    GArray *strokes = d->chosen;
    for (guint i = strokes->len; i-- > 0;)
        if (is_with(d, index, g_array_index(strokes, int, i)))
            g_array_remove_index(strokes, i);
    d->acted(d);
    read_page_changed(d);
}

void read_chosen_all(struct read_desk *d)
{
    g_array_set_size(d->chosen, 0);
    for (int i = 0; d->remarks && i < reader_remarks_count(d->remarks); i++)
        if (read_chosen_can(d, i))
            g_array_append_val(d->chosen, i);
    d->acted(d);
    read_page_changed(d);
}

/* ---- where ---- */

bool read_chosen_box_of(struct read_desk *d, int index, struct reader_box *box)
{
    const struct reader_remark *r = reader_remarks_get(d->remarks, index);
    const double em = d->size_px;
    double x, y, x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    if (!read_text_origin(d, r, &x, &y))
        return false;
    for (int i = 0; i < r->points_count; i++) {
        const struct reader_ink_place p = reader_ink_place(r, i);
        const double half = em * p.width / 2;
        x0 = fmin(x0, x + em * p.x - half);
        y0 = fmin(y0, y + em * p.y - half);
        x1 = fmax(x1, x + em * p.x + half);
        y1 = fmax(y1, y + em * p.y + half);
    }
    *box = (struct reader_box){.x = x0, .y = y0, .width = x1 - x0, .height = y1 - y0};
    return true;
}

bool read_chosen_box(struct read_desk *d, struct reader_box *box)
{
    const GArray *strokes = chosen_now(d);
    bool any = false;
    for (guint i = 0; i < strokes->len; i++) {
        struct reader_box b;
        if (!read_chosen_box_of(d, g_array_index(strokes, int, i), &b))
            continue;
        const double right = any ? fmax(box->x + box->width, b.x + b.width) : b.x + b.width,
                     bottom = any ? fmax(box->y + box->height, b.y + b.height) : b.y + b.height;
        *box = (struct reader_box){.x = any ? fmin(box->x, b.x) : b.x,
                                   .y = any ? fmin(box->y, b.y) : b.y};
        box->width = right - box->x;
        box->height = bottom - box->y;
        any = true;
    }
    return any;
}

int read_chosen_at(struct read_desk *d, double px, double py, double reach)
{
    for (int i = d->remarks ? reader_remarks_count(d->remarks) - 1 : -1; i >= 0; i--) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, i);
        double x, y;
        if (!read_chosen_can(d, i) || !read_text_origin(d, r, &x, &y))
            continue;
        for (int k = 0; k < r->points_count; k++) {
            const struct reader_ink_place p = reader_ink_place(r, k);
            if (hypot(x + d->size_px * p.x - px, y + d->size_px * p.y - py) < reach)
                return i;
        }
    }
    return -1;
}

/* ---- moved and scaled ---- */

/* As far as all of them can be scaled. */
static struct read_lay lay_within(struct read_desk *d, const struct read_lay *wanted)
{
    struct read_lay lay = *wanted;
    const GArray *strokes = chosen_now(d);
    for (guint i = 0; i < strokes->len; i++) {
        const struct reader_remark *r =
            reader_remarks_get(d->remarks, g_array_index(strokes, int, i));
        lay.scale_x =
            CLAMP(lay.scale_x, READER_SCALE_LEAST / r->scale_x, READER_SCALE_MOST / r->scale_x);
        lay.scale_y =
            CLAMP(lay.scale_y, READER_SCALE_LEAST / r->scale_y, READER_SCALE_MOST / r->scale_y);
    }
    return lay;
}

static double moved_within(double em)
{
    return CLAMP(em, -READER_MOVED_MOST, READER_MOVED_MOST);
}

static struct reader_arranged arranged_by(struct read_desk *d, int index,
                                          const struct read_lay *lay)
{
    struct reader_arranged to = reader_remarks_arranged(d->remarks, index);
    double x, y;
    to.x += lay->by_x / d->size_px;
    to.y += lay->by_y / d->size_px;
    if (read_text_origin(d, reader_remarks_get(d->remarks, index), &x, &y)) {
        to.x += (lay->scale_x - 1) * (x - lay->from_x) / d->size_px;
        to.y += (lay->scale_y - 1) * (y - lay->from_y) / d->size_px;
        to.scale_x = CLAMP(to.scale_x * lay->scale_x, READER_SCALE_LEAST, READER_SCALE_MOST);
        to.scale_y = CLAMP(to.scale_y * lay->scale_y, READER_SCALE_LEAST, READER_SCALE_MOST);
    }
    to.x = moved_within(to.x);
    to.y = moved_within(to.y);
    return to;
}

void read_chosen_lay(struct read_desk *d, const struct read_lay *wanted)
{
    const GArray *strokes = chosen_now(d);
    const struct read_lay lay = lay_within(d, wanted);
    if (!strokes->len)
        return;
    struct reader_arranged *to = g_new(struct reader_arranged, strokes->len);
    for (guint i = 0; i < strokes->len; i++)
        to[i] = arranged_by(d, g_array_index(strokes, int, i), &lay);
    read_remarks_arrange(d, to, (int)strokes->len);
    g_free(to);
}

void read_chosen_preview(struct read_desk *d, const struct read_lay *lay)
{
    d->laid = lay;
    if (lay)
        d->lay = lay_within(d, lay);
    read_page_changed(d);
}

void read_chosen_previewed(struct read_desk *d, int index, struct reader_remark *r)
{
    if (!d->laid || !read_chosen_is(d, index))
        return;
    const struct reader_arranged to = arranged_by(d, index, &d->lay);
    r->x = to.x;
    r->y = to.y;
    r->scale_x = to.scale_x;
    r->scale_y = to.scale_y;
}

/* ---- grouped ---- */

/* Of those that are chosen the one whose words are nearest to their middle: a group hangs on
 * its anchor. -1: one of them is not in the window. */
static int leader_find(struct read_desk *d, const GArray *strokes)
{
    struct reader_box all, word;
    double nearest = INFINITY;
    int leader = -1;
    if (!read_chosen_box(d, &all))
        return -1;
    for (guint i = 0; i < strokes->len; i++) {
        const int index = g_array_index(strokes, int, i);
        const struct reader_remark *r = reader_remarks_get(d->remarks, index);
        if (reader_view_boxes(d->view, r->begin, r->begin + 1, &word, 1) < 1)
            return -1;
        const double away = hypot(word.x + word.width / 2 - all.x - all.width / 2,
                                  word.y + word.height / 2 - all.y - all.height / 2);
        if (away < nearest) {
            nearest = away;
            leader = index;
        }
    }
    return leader;
}

/* Where it is, counted from the leader's words. */
static struct reader_arranged grouped_by(struct read_desk *d, int index, int leader)
{
    const struct reader_remark *r = reader_remarks_get(d->remarks, index),
                               *on = reader_remarks_get(d->remarks, leader);
    struct reader_arranged to = reader_remarks_arranged(d->remarks, index);
    double x, y, on_x, on_y;
    if (read_text_origin(d, r, &x, &y) && read_text_origin(d, on, &on_x, &on_y)) {
        to.x = moved_within(on->x + (x - on_x) / d->size_px);
        to.y = moved_within(on->y + (y - on_y) / d->size_px);
    }
    to.hangs = on->hangs;
    to.group = leader;
    to.around = on->around;
    return to;
}

void read_chosen_group(struct read_desk *d, bool together)
{
    const GArray *strokes = chosen_now(d);
    if (strokes->len < (together ? 2u : 1u))
        return;
    const int leader = together ? leader_find(d, strokes) : -1;
    if (together && leader < 0) {
        d->say(d, _("Strokes that are to be a group must be in the window, all of them."));
        return;
    }
    struct reader_arranged *to = g_new(struct reader_arranged, strokes->len);
    for (guint i = 0; i < strokes->len; i++) {
        const int index = g_array_index(strokes, int, i);
        to[i] = together ? grouped_by(d, index, leader)
                         : reader_remarks_arranged(d->remarks, index);
        to[i].group = leader;
    }
    read_remarks_arrange(d, to, (int)strokes->len);
    g_free(to);
}

void read_chosen_erase(struct read_desk *d)
{
    GArray *strokes = g_array_copy(chosen_now(d));
    read_remarks_group(d, true);
    for (guint i = 0; i < strokes->len; i++)
        read_remarks_erase(d, g_array_index(strokes, int, i));
    read_remarks_group(d, false);
    g_array_unref(strokes);
}

char *read_chosen_heard(struct read_desk *d)
{
    const int all = d->remarks ? reader_remarks_count(d->remarks) : 0,
              count = read_chosen_count(d);
    int can = 0, first = -1;
    if (d->tool != READ_TOOL_MOVE)
        return NULL;
    for (int i = 0; i < all; i++) {
        if (!read_chosen_can(d, i))
            continue;
        can++;
        first = first < 0 && read_chosen_is(d, i) ? i : first;
    }
    if (!count || first < 0)
        return g_strdup_printf(_("No ink is chosen, of %d strokes. Tab chooses one."), can);
    const struct reader_remark *r = reader_remarks_get(d->remarks, first);
    char *words = g_strndup(d->document->plain + r->begin, MIN(r->end - r->begin, 60));
    char *valid = g_utf8_make_valid(words, -1);
    char *says =
        g_strdup_printf(r->around != READER_AROUND_NOT
                            ? _("Ink is chosen: %d of %d strokes, at %s, text flows around it")
                        : r->group >= 0 ? _("Ink is chosen: %d of %d strokes, a group, at %s")
                                        : _("Ink is chosen: %d of %d strokes, at %s"),
                        count, can, valid);
    g_free(valid);
    g_free(words);
    return says;
}
