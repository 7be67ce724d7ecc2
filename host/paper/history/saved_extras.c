/* saved_extras.c - the part of a sheet that is in no plane, as bytes: brushes, salt and varnish
 * flags.
 *
 * For each brush: its description, and the content of its bristles.
 */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

enum { EXTRA_VARNISHED = 1, EXTRA_SALTED = 2 };

enum paper_status sheet_extras_encode(struct paper_sheet *p, struct event_bytes *b)
{
    enum paper_status status = PAPER_OK;
    int count = 0;
    for (int i = 0; i < PAPER_BRUSHES_MAX; i++)
        count += sheet_brush_get(p, i) != NULL;
    event_put_number(b, (p->varnished ? EXTRA_VARNISHED : 0) | (p->salted ? EXTRA_SALTED : 0),
                     1);
    event_put_double(b, p->salt_reach);
    event_put_double(b, p->salt_strength);
    event_put_number(b, (uint64_t)count, 1);
    for (int i = 0; i < PAPER_BRUSHES_MAX && status == PAPER_OK; i++) {
        const struct paper_brush *brush = sheet_brush_get(p, i);
        if (!brush)
            continue;
        event_encode(b, sheet_event_kind(SHEET_EVENT_BRUSH), brush, &p->config);
        for (int j = 0; j <= p->config.pigments_count && status == PAPER_OK; j++) {
            double grains[PAPER_BRISTLES_MAX];
            status = sheet_brush_read(p, i, j, grains);
            for (int k = 0; k < brush->bristles && status == PAPER_OK; k++)
                event_put_double(b, grains[k]);
        }
    }
    return status;
}

/* The decoded bytes, without the brushes. */
struct extras {
    int flags, brushes;
    double salt_reach, salt_strength;
};

static enum paper_status damaged(const char *what)
{
    return paper_fail(PAPER_BAD_FILE, "%s damaged", what);
}

static enum paper_status extras_begin(struct event_reader *r, struct extras *x)
{
    x->flags = (int)event_get_number(r, 1);
    x->salt_reach = event_get_double(r);
    x->salt_strength = event_get_double(r);
    x->brushes = (int)event_get_number(r, 1);
    bool good = !r->bad && x->salt_reach >= 1 && x->salt_reach <= 100 &&
                x->salt_strength >= 0 && x->salt_strength <= 4 &&
                (x->flags & ~(EXTRA_VARNISHED | EXTRA_SALTED)) == 0 &&
                x->brushes <= PAPER_BRUSHES_MAX;
    return good ? PAPER_OK : damaged("what is on the sheet is");
}

/* Decodes and checks the next brush; the caller frees it by event_free(). */
static enum paper_status brush_decode(const struct paper_sheet *p, struct event_reader *r,
                                      struct paper_brush **out)
{
    const struct event_kind *kind = sheet_event_kind(SHEET_EVENT_BRUSH);
    size_t size = event_size(kind);
    const uint8_t *bytes = event_get_bytes(r, size);
    void *brush = NULL;
    *out = NULL;
    if (!bytes)
        return damaged("its brushes are");
    enum paper_status status = sheet_event_decoded(
        event_decode(bytes, size, kind, &p->config, &brush), SHEET_EVENT_BRUSH);
    if (status == PAPER_OK)
        status = sheet_event_check(p, SHEET_EVENT_BRUSH, brush);
    if (status == PAPER_OK) {
        *out = brush;
        return PAPER_OK;
    }
    event_free(sheet_event_kind(SHEET_EVENT_BRUSH), brush);
    return status;
}

static void grains_get(struct event_reader *r, const struct paper_brush *brush, double *grains)
{
    for (int i = 0; i < brush->bristles; i++)
        grains[i] = event_get_double(r);
}

enum paper_status sheet_extras_check(const struct paper_sheet *p,
                                     const struct event_reader *bytes)
{
    struct event_reader r = *bytes;
    struct extras x;
    int last = -1;
    enum paper_status status = extras_begin(&r, &x);
    for (int i = 0; i < x.brushes && status == PAPER_OK; i++) {
        struct paper_brush *brush;
        status = brush_decode(p, &r, &brush);
        if (status != PAPER_OK)
            break;
        bool good = brush->number > last;
        last = brush->number;
        for (int j = 0; j <= p->config.pigments_count && !r.bad; j++) {
            double grains[PAPER_BRISTLES_MAX];
            grains_get(&r, brush, grains);
            for (int k = 0; k < brush->bristles; k++)
                good &= sheet_bristle_may_hold(grains[k]);
        }
        if (r.bad || !good)
            status = damaged("its brushes are");
        event_free(sheet_event_kind(SHEET_EVENT_BRUSH), brush);
    }
    if (status == PAPER_BAD_ARGUMENT || (status == PAPER_OK && r.at != r.end))
        return damaged("its brushes are");
    return status;
}

/* Makes the brush, and fills its bristles. */
static enum paper_status brush_restore(struct paper_sheet *p, struct event_reader *r)
{
    struct paper_brush *brush;
    enum paper_status status = brush_decode(p, r, &brush);
    if (status != PAPER_OK)
        return status;
    status = sheet_event_perform(p, SHEET_EVENT_BRUSH, brush);
    for (int j = 0; j <= p->config.pigments_count && status == PAPER_OK && !r->bad; j++) {
        double grains[PAPER_BRISTLES_MAX];
        grains_get(r, brush, grains);
        status = sheet_brush_write(p, brush->number, j, grains);
    }
    event_free(sheet_event_kind(SHEET_EVENT_BRUSH), brush);
    return status;
}

enum paper_status sheet_extras_decode(struct paper_sheet *p, struct event_reader *r)
{
    struct extras x;
    sheet_extras_reset(p);
    enum paper_status status = extras_begin(r, &x);
    if (status != PAPER_OK)
        return status;
    p->varnished = (x.flags & EXTRA_VARNISHED) != 0;
    p->salted = (x.flags & EXTRA_SALTED) != 0;
    p->salt_reach = x.salt_reach;
    p->salt_strength = x.salt_strength;
    for (int i = 0; i < x.brushes && status == PAPER_OK && !r->bad; i++)
        status = brush_restore(p, r);
    return status;
}
