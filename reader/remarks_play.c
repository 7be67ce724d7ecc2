/* remarks_play.c - strokes: when they are played back, how wide they are: see
 * reader_remarks.h. */
#include "reader_internal.h"
#include "reader_remarks.h"

#include <math.h>
#include <stdlib.h>

static double lasts_s(const struct reader_remark *r)
{
    return (double)r->points[r->points_count - 1].time_s;
}

static int by_begin(const void *a, const void *b)
{
    const struct reader_played *x = a, *y = b;
    if (x->begins_s != y->begins_s)
        return x->begins_s < y->begins_s ? -1 : 1;
    return x->index - y->index;
}

/* What is drawn while something else is keeps its distance from that; a pause is no longer than
 * it may be. */
static double pauses_shorten(const struct reader_remarks *remarks, struct reader_played *played,
                             int count)
{
    double drawn_s = 0, played_s = 0; /* until when, as it was drawn and as it is played */
    for (int i = 0; i < count; i++) {
        const double begins_s = played[i].begins_s,
                     ends_s = begins_s + lasts_s(reader_remarks_get(remarks, played[i].index));
        if (i == 0)
            drawn_s = begins_s;
        played[i].begins_s = fmax(0, played_s + fmin(begins_s - drawn_s, READER_PAUSE_MOST_S));
        if (ends_s > drawn_s || i == 0) {
            played_s = played[i].begins_s + (ends_s - begins_s);
            drawn_s = ends_s;
        }
    }
    return played_s;
}

double reader_remarks_play(const struct reader_remarks *remarks, bool erased,
                           struct reader_played *played, int *count)
{
    *count = 0;
    for (int i = 0; i < reader_remarks_count(remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, i);
        if (r->kind == READER_REMARK_INK && !r->hidden && (r->gone_s == 0 || erased))
            played[(*count)++] = (struct reader_played){i, r->made_s - lasts_s(r)};
    }
    qsort(played, (size_t)*count, sizeof *played, by_begin);
    return pauses_shorten(remarks, played, *count);
}

struct reader_ink_place reader_ink_place(const struct reader_remark *r, int i)
{
    return (struct reader_ink_place){
        r->scale_x * (double)r->points[i].x, r->scale_y * (double)r->points[i].y,
        sqrt(r->scale_x * r->scale_y) * reader_ink_width(r->points, i, r->width)};
}

double reader_ink_width(const struct reader_ink_point *points, int i, double full)
{
    const double before = (double)points[i > 0 ? i - 1 : 0].pressure;
    return full * (0.25 + 0.75 * (before + (double)points[i].pressure) / 2);
}
