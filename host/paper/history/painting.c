/* painting.c - a stroke that grows, in a history: one operation, which is recorded when it
 * ends.
 *
 * Until then the fields are beyond `now`, where the list ends for everybody else. If the stroke
 * is dropped they are computed again from what is listed. While a saved run is followed a
 * stroke's samples are only gathered: at its end it is an operation like any other, which the
 * run may have. */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>

/* Exchanges that take as long as a step of a sheet of 1024x1024. */
#define EXCHANGES_A_STEP 20.0

static enum paper_status stroke_there(const struct paper_sheet *p)
{
    return sheet_growing(p) ? PAPER_OK
                            : paper_fail(PAPER_BAD_ARGUMENT, "no stroke is being painted");
}

enum paper_status history_stroke_begin(struct paper_sheet *p, int number, double pace)
{
    struct sheet_history *h = p->history;
    const struct paper_stroke_sample sample = {0};
    const struct paper_stroke like = {
        .number = number, .pace = pace, .samples_count = 1, .samples = &sample};
    const bool painted = !(h && h->following);
    enum paper_status status = history_no_stroke(p);
    if (status == PAPER_OK)
        status = sheet_event_check(p, SHEET_EVENT_STROKE, &like);
    if (status == PAPER_OK && painted)
        status = sheet_ready(p);
    if (status == PAPER_OK && painted && !sheet_brush_get(p, number))
        status = paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no brush %d", number);
    if (status == PAPER_OK && painted && h && h->unfinished)
        status = sheet_finish(p); /* as before each operation that makes steps */
    if (status == PAPER_OK)
        status = sheet_growing_begin(p, number, pace, painted);
    if (status != PAPER_OK || !painted)
        return status;
    if (!h) {
        p->touched = true;
        return PAPER_OK;
    }
    h->unfinished = false;
    h->painting = true;
    h->painted_at = h->at;
    h->steps_before = p->steps;
    h->exchanges_before = p->exchanges;
    h->at.op = -1;
    return PAPER_OK;
}

enum paper_status history_stroke_add(struct paper_sheet *p,
                                     const struct paper_stroke_sample *samples, int count)
{
    enum paper_status status = stroke_there(p);
    if (status == PAPER_OK)
        status = sheet_growing_add(p, samples, count);
    if (status != PAPER_OK && status != PAPER_BAD_ARGUMENT)
        history_stroke_drop(p);
    return status;
}

/* The operation that the stroke is. */
static enum paper_status stroke_record(struct paper_sheet *p, const struct paper_stroke *stroke)
{
    struct sheet_history *h = p->history;
    struct event_record op;
    enum paper_status status = operation_make(p, SHEET_EVENT_STROKE, stroke, &op);
    if (status != PAPER_OK)
        return status;
    status = history_cut(h); /* what had been undone */
    if (status != PAPER_OK) {
        event_record_free(&op);
        return status;
    }
    op.steps = (int)(p->steps - h->steps_before);
    h->work += 1 + op.steps;
    h->spared += op.steps * (1 - sheet_share(p)) -
                 (double)(p->exchanges - h->exchanges_before) / EXCHANGES_A_STEP;
    return history_keep(p, op);
}

enum paper_status history_stroke_end(struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    enum paper_status status = stroke_there(p);
    if (status != PAPER_OK)
        return status;
    struct paper_stroke stroke = *sheet_growing(p);
    const bool painted = !h || h->painting;
    if (stroke.samples_count == 0) {
        history_stroke_drop(p);
        return PAPER_OK;
    }
    if (painted)
        status = sheet_growing_finish(p);
    if (status != PAPER_OK) {
        history_stroke_drop(p);
        return status;
    }
    struct paper_stroke_sample *samples;
    sheet_growing_end(p, &samples);
    stroke.samples = samples;
    if (h)
        h->painting = false;
    if (h)
        status =
            painted ? stroke_record(p, &stroke) : sheet_event(p, SHEET_EVENT_STROKE, &stroke);
    free(samples);
    return status;
}
