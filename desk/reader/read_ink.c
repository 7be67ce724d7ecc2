/* read_ink.c - ink over the page: drawn with a pen or a mouse, translucent, as wide as it was
 * pressed; erased, moved, played back. It hangs on the word that is nearest to its middle, in
 * ems, so it goes with the text and grows with it. */
#include "read_desk.h"

#include <math.h>

enum { ERASER_PX = 10 };

/* ---- drawing ---- */

/* So many of its points, from where it was moved to. spots: where none of it is drawn;
 * NULL: all is. */
static void stroke_draw(cairo_t *cairo, const struct reader_remark *r, int count, double x,
                        double y, double em, const struct read_desk *spots)
{
    const unsigned rgba = r->rgba;
    const double red = (rgba >> 24) / 255.0, green = (rgba >> 16 & 255) / 255.0,
                 blue = (rgba >> 8 & 255) / 255.0, alpha = (rgba & 255) / 255.0;
    cairo_push_group(cairo); /* where it crosses itself it is no darker */
    cairo_set_source_rgb(cairo, red, green, blue);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    for (int i = 0; i < count; i++) {
        const struct reader_ink_place a = reader_ink_place(r, i > 0 ? i - 1 : 0),
                                      b = reader_ink_place(r, i);
        if (spots && (read_spots_at(spots, x + em * a.x, y + em * a.y) ||
                      read_spots_at(spots, x + em * b.x, y + em * b.y)))
            continue;
        cairo_set_line_width(cairo, fmax(0.6, em * b.width));
        cairo_move_to(cairo, x + em * a.x, y + em * a.y);
        cairo_line_to(cairo, x + em * b.x, y + em * b.y);
        cairo_stroke(cairo);
    }
    cairo_pop_group_to_source(cairo);
    cairo_paint_with_alpha(cairo, alpha);
}

/* How many of a stroke's points are seen when the playback has come to `time_s` of it. */
static int points_until(const struct reader_remark *r, double time_s)
{
    int count = 0;
    while (count < r->points_count && (double)r->points[count].time_s <= time_s)
        count++;
    return count;
}

/* Those that were drawn later lie over the others. */
static void strokes_draw(struct read_desk *d, cairo_t *cairo)
{
    const int room = d->remarks ? reader_remarks_count(d->remarks) : 0;
    struct reader_played *played = g_new(struct reader_played, (gsize)room + 1);
    int strokes = 0;
    d->play_end_s =
        room ? reader_remarks_play(d->remarks, d->playing_erased, played, &strokes) : 0;
    for (int i = 0; i < strokes; i++) {
        struct reader_remark r = *reader_remarks_get(d->remarks, played[i].index);
        double x, y;
        const int count =
            d->playing ? points_until(&r, d->play_s - played[i].begins_s) : r.points_count;
        read_chosen_previewed(d, played[i].index, &r);
        if (count && read_text_origin(d, &r, &x, &y))
            stroke_draw(cairo, &r, count, x, y, d->size_px, d->spots->len ? d : NULL);
    }
    g_free(played);
}

void read_ink_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    const bool some = d->stroke->len > 0;
    bool kept = false;
    for (int i = 0; d->remarks && !kept && i < reader_remarks_count(d->remarks); i++)
        kept = reader_remarks_get(d->remarks, i)->kind == READER_REMARK_INK;
    if (!some && !kept)
        return;
    cairo_t *cairo =
        gtk_snapshot_append_cairo(snapshot, &GRAPHENE_RECT_INIT(0, 0, (float)d->setup.width_px,
                                                                (float)d->setup.height_px));
    strokes_draw(d, cairo);
    if (some)
        stroke_draw(cairo,
                    &(const struct reader_remark){
                        .points = (struct reader_ink_point *)(void *)d->stroke->data,
                        .points_count = (int)d->stroke->len,
                        .width = d->ink_width * d->size_px,
                        .rgba = d->ink_rgba,
                        .scale_x = 1,
                        .scale_y = 1},
                    (int)d->stroke->len, 0, 0, 1, NULL);
    read_chosen_draw(d, cairo);
    cairo_destroy(cairo);
}

/* ---- the hand ---- */

static void point_add(struct read_desk *d, double x, double y, double pressure, double time_s)
{
    if (d->stroke->len >= READER_INK_POINTS_MAX)
        return;
    if (!d->stroke->len)
        d->stroke_s = time_s;
    const struct reader_ink_point point = {(float)x, (float)y, (float)CLAMP(pressure, 0, 1),
                                           (float)fmax(0, time_s - d->stroke_s)};
    g_array_append_val(d->stroke, point);
    read_page_changed(d);
}

static void erase_at(struct read_desk *d, double x, double y)
{
    const int index = read_chosen_at(d, x, y, ERASER_PX);
    if (index >= 0)
        read_remarks_erase(d, index);
}

/* A pen that is turned round erases. */
static enum read_tool tool_now(const struct read_desk *d)
{
    return d->tool == READ_TOOL_PEN && d->eraser ? READ_TOOL_ERASER : d->tool;
}

void read_ink_press(struct read_desk *d, double x, double y, double pressure, double time_s,
                    bool more)
{
    const enum read_tool tool = tool_now(d);
    d->drawn = true;
    d->playing = false;
    d->pointer_x = x;
    d->pointer_y = y;
    if (tool == READ_TOOL_ERASER)
        erase_at(d, x, y);
    else if (tool == READ_TOOL_SPOTS)
        read_spots_add(d, x, y);
    else if (tool == READ_TOOL_MOVE)
        read_chosen_press(d, x, y, more);
    else
        point_add(d, x, y, pressure, time_s);
}

void read_ink_move(struct read_desk *d, double x, double y, double pressure, double time_s)
{
    const enum read_tool tool = tool_now(d);
    d->pointer_x = x;
    d->pointer_y = y;
    if (!d->drawn)
        return;
    if (tool == READ_TOOL_ERASER)
        erase_at(d, x, y);
    else if (tool == READ_TOOL_SPOTS)
        read_spots_add(d, x, y);
    else if (tool == READ_TOOL_MOVE)
        read_chosen_drag(d, x, y);
    else if (tool == READ_TOOL_PEN)
        point_add(d, x, y, pressure, time_s);
}

/* The word that is nearest to a stroke's middle; false: nothing is there. */
static bool word_find(struct read_desk *d, const struct reader_ink_point *points, guint count,
                      struct read_range *word)
{
    double x0 = (double)points[0].x, x1 = x0, y0 = (double)points[0].y, y1 = y0;
    size_t byte;
    bool inside;
    for (guint i = 1; i < count; i++) {
        x0 = fmin(x0, (double)points[i].x);
        x1 = fmax(x1, (double)points[i].x);
        y0 = fmin(y0, (double)points[i].y);
        y1 = fmax(y1, (double)points[i].y);
    }
    if (!reader_view_hit(d->view, (x0 + x1) / 2, (y0 + y1) / 2, &byte, &inside))
        return false;
    *word = read_text_word(d, byte);
    while (word->begin == word->end && byte > 0) /* a blank, a sign: the word before it */
        *word = read_text_word(d, --byte);
    return word->begin < word->end;
}

/* The stroke, in ems from the word. */
static void stroke_keep(struct read_desk *d)
{
    struct reader_ink_point *points = (struct reader_ink_point *)(void *)d->stroke->data;
    struct read_range word;
    struct reader_box box;
    if (!word_find(d, points, d->stroke->len, &word) ||
        reader_view_boxes(d->view, word.begin, word.begin + 1, &box, 1) < 1)
        return;
    for (guint i = 0; i < d->stroke->len; i++) {
        points[i].x = (float)(((double)points[i].x - box.x) / d->size_px);
        points[i].y = (float)(((double)points[i].y - box.y) / d->size_px);
    }
    read_remarks_add(d,
                     &(struct reader_remark){.kind = READER_REMARK_INK,
                                             .rgba = d->ink_rgba,
                                             .width = d->ink_width,
                                             .points = points,
                                             .points_count = (int)d->stroke->len},
                     word.begin, word.end);
}

void read_ink_release(struct read_desk *d, double x, double y)
{
    if (!d->drawn)
        return;
    d->drawn = false;
    if (d->spots->len)
        read_spots_end(d);
    if (d->stroke->len)
        stroke_keep(d);
    g_array_set_size(d->stroke, 0);
    if (d->tool == READ_TOOL_MOVE) {
        read_chosen_drag(d, x, y);
        read_chosen_release(d);
    }
    read_page_changed(d);
}

/* ---- playing back ---- */

static gboolean play_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data)
{
    struct read_desk *d = data;
    const gint64 now_us = gdk_frame_clock_get_frame_time(clock);
    (void)widget;
    if (d->play_us)
        d->play_s += fmin(0.1, (double)(now_us - d->play_us) * 1e-6);
    d->play_us = now_us;
    if (d->play_s > d->play_end_s)
        d->playing = false;
    if (!d->playing)
        d->playing_erased = false;
    read_page_changed(d);
    return d->playing ? G_SOURCE_CONTINUE : G_SOURCE_REMOVE;
}

void read_ink_play(struct read_desk *d, bool erased)
{
    if (d->playing) { /* the same key ends it */
        d->playing = false;
        return;
    }
    d->playing = true;
    d->playing_erased = erased;
    d->play_s = 0;
    d->play_us = 0;
    d->play_end_s = G_MAXDOUBLE;
    gtk_widget_add_tick_callback(d->page, play_tick, d, NULL);
}
