/* extras.c - what of a sheet is in none of its planes, as bytes: brushes, and what there may be on it.
 *
 * For each brush that there is: its description, and what its bristles hold. */
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
        event_encode(b, &p->config, SHEET_EVENT_BRUSH, brush);
        for (int j = 0; j <= p->config.pigments_count && status == PAPER_OK; j++) {
            double grains[PAPER_BRISTLES_MAX];
            status = sheet_brush_read(p, i, j, grains);
            for (int k = 0; k < brush->bristles && status == PAPER_OK; k++)
                event_put_double(b, grains[k]);
        }
    }
    return status;
}

/* One brush; what is wrong with bytes from outside is found by the functions that make brushes. */
static enum paper_status brush_decode(struct paper_sheet *p, struct event_reader *r)
{
    size_t size = event_size(SHEET_EVENT_BRUSH);
    const uint8_t *bytes = event_get_bytes(r, size);
    void *brush = NULL;
    if (!bytes)
        return PAPER_OK;
    enum paper_status status = event_decode(bytes, size, &p->config, SHEET_EVENT_BRUSH, &brush);
    if (status == PAPER_OK)
        status = event_check(p, SHEET_EVENT_BRUSH, brush);
    if (status == PAPER_OK)
        status = event_perform(p, SHEET_EVENT_BRUSH, brush);
    if (status == PAPER_OK) {
        const struct paper_brush *made = brush;
        for (int j = 0; j <= p->config.pigments_count && status == PAPER_OK && !r->bad; j++) {
            double grains[PAPER_BRISTLES_MAX];
            for (int k = 0; k < made->bristles; k++)
                grains[k] = event_get_double(r);
            status = sheet_brush_write(p, made->number, j, grains);
        }
    }
    event_free(SHEET_EVENT_BRUSH, brush);
    return status;
}

enum paper_status sheet_extras_decode(struct paper_sheet *p, struct event_reader *r)
{
    enum paper_status status = PAPER_OK;
    sheet_extras_reset(p);
    int flags = (int)event_get_number(r, 1);
    double reach = event_get_double(r), strength = event_get_double(r);
    int count = (int)event_get_number(r, 1);
    if (r->bad || !(reach >= 1 && reach <= 100 && strength >= 0 && strength <= 4))
        return paper_fail(PAPER_BAD_FILE, "what is on the sheet is damaged");
    p->varnished = (flags & EXTRA_VARNISHED) != 0;
    p->salted = (flags & EXTRA_SALTED) != 0;
    p->salt_reach = reach;
    p->salt_strength = strength;
    for (int i = 0; i < count && status == PAPER_OK && !r->bad; i++)
        status = brush_decode(p, r);
    if (status == PAPER_BAD_ARGUMENT || (status == PAPER_OK && (r->bad || r->at != r->end)))
        return paper_fail(PAPER_BAD_FILE, "its brushes are damaged");
    return status;
}
