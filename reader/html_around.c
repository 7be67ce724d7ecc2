/* html_around.c - ink that text flows around, as boxes that float in their paragraphs and have
 * the ink's outline: see html_internal.h. */
#include "html_internal.h"

#include <math.h>
#include <stdlib.h>

enum reader_status html_around_begin(struct html *h)
{
    return h->setup->remarks ? reader_around_find(h->setup->remarks, h->document, &h->obstacles,
                                                  &h->obstacles_count)
                             : READER_OK;
}

/* All of a paragraph's ink on one side: one box, as wide and as high as reaches around it. */
struct floating {
    enum reader_around side;
    double width, height; /* ems, from the paragraph's upper edge and the column's edge */
};

static bool floating_find(const struct html *h, int block, enum reader_around side,
                          struct floating *out)
{
    bool any = false;
    *out = (struct floating){.side = side};
    for (int i = 0; i < h->obstacles_count; i++) {
        const struct reader_obstacle *o = &h->obstacles[i];
        if (o->block != block || o->side != side)
            continue;
        any = true;
        out->width = fmax(out->width, side == READER_AROUND_LEFT ? o->x + o->width : -o->x);
        out->height = fmax(out->height, o->y + o->height);
    }
    return any && out->width > 0 && out->height > 0;
}

/* How far the ink reaches into the column at that height. */
static double reach_at(const struct html *h, int block, enum reader_around side, double y)
{
    double reach = 0;
    for (int i = 0; i < h->obstacles_count; i++) {
        const struct reader_obstacle *o = &h->obstacles[i];
        if (o->block != block || o->side != side || y < o->y || y >= o->y + o->height)
            continue;
        const int at = (int)((y - o->y) / o->height * o->rows_count);
        const struct page_row *row = &o->rows[at < o->rows_count ? at : o->rows_count - 1];
        if (row->to_px > row->from_px)
            reach = fmax(reach, side == READER_AROUND_LEFT ? o->x + row->to_px
                                                           : -(o->x + row->from_px));
    }
    return reach;
}

/* What lines keep away from, from row to row. */
static void outline_put(struct html *h, int block, const struct floating *f)
{
    enum { ROWS_MOST = 200 };
    const double step = fmax(0.25, f->height / ROWS_MOST);
    const bool left = f->side == READER_AROUND_LEFT;
    fprintf(h->f, "polygon(%.2frem 0", left ? 0 : f->width);
    for (double y = 0; y < f->height; y += step) {
        double reach = 0;
        for (int k = 0; k < 4; k++) /* of what is between two rows, the most */
            reach = fmax(reach, reach_at(h, block, f->side, y + step * (k + 0.5) / 4));
        const double x = left ? reach : f->width - reach, end = fmin(y + step, f->height);
        fprintf(h->f, ",%.2frem %.2frem,%.2frem %.2frem", x, y, x, end);
    }
    fprintf(h->f, ",%.2frem %.2frem)", left ? 0 : f->width, f->height);
}

void html_around_put(struct html *h, const struct reader_block *block)
{
    static const enum reader_around sides[] = {READER_AROUND_LEFT, READER_AROUND_RIGHT};
    const struct reader_document *d = h->document;
    if (!h->obstacles_count || block < d->blocks || block >= d->blocks + d->blocks_count)
        return;
    const int own = (int)(block - d->blocks), count = reader_remarks_count(h->setup->remarks);
    for (int s = 0; s < 2; s++) {
        struct floating f;
        if (!floating_find(h, own, sides[s], &f))
            continue;
        fprintf(h->f,
                "<span class=\"around %s\" style=\"width:%.2frem;height:%.2frem;"
                "shape-outside:",
                s ? "r" : "l", f.width, f.height);
        outline_put(h, own, &f);
        fputs("\">", h->f);
        for (int i = 0; i < count; i++) {
            const struct reader_remark *r = reader_remarks_get(h->setup->remarks, i);
            if (r->around == sides[s] && reader_around_block(d, r) == own)
                html_ink_put(h, r);
        }
        fputs("</span>", h->f);
    }
}
