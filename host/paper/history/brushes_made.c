/* brushes_made.c - which brushes operations use, and whether each has been made before it is
 * used. */
#include "history/history_internal.h"
#include "model/model.h"

int history_brush_of(enum sheet_event_kind kind, const void *arguments)
{
    if (kind == SHEET_EVENT_BRUSH)
        return ((const struct paper_brush *)arguments)->number;
    if (kind == SHEET_EVENT_DIP)
        return ((const struct paper_dip *)arguments)->number;
    return kind == SHEET_EVENT_STROKE ? ((const struct paper_stroke *)arguments)->number : -1;
}

enum paper_status history_operation_brush(const struct paper_sheet *p,
                                          const struct event_record *op, int *brush)
{
    void *arguments;
    enum paper_status status = operation_arguments(&p->config, op, &arguments);
    *brush = status == PAPER_OK ? history_brush_of(operation_kind(op), arguments) : -1;
    event_free(sheet_event_kind(operation_kind(op)), arguments);
    return status;
}

/* *made: a bit for each brush so far. */
static enum paper_status brush_follow(const struct paper_sheet *p,
                                      const struct event_record *op, unsigned *made)
{
    int brush = -1;
    if (op->kind != SHEET_EVENT_BRUSH && op->kind != SHEET_EVENT_DIP &&
        op->kind != SHEET_EVENT_STROKE)
        return PAPER_OK;
    const enum paper_status status = history_operation_brush(p, op, &brush);
    if (status != PAPER_OK || brush < 0)
        return status;
    if (op->kind == SHEET_EVENT_BRUSH)
        *made |= 1u << brush;
    return *made >> brush & 1
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT,
                            "what follows uses brush %d, which would not be made", brush);
}

enum paper_status history_brushes_check(const struct paper_sheet *p, int without, int first)
{
    const struct sheet_history *h = p->history;
    enum paper_status status = PAPER_OK;
    unsigned made = 0;
    for (int i = 0; i < h->log.count && status == PAPER_OK; i++)
        if (i != without)
            status = brush_follow(p, &h->log.records[i], &made);
    for (int i = first; i < h->tail_count && status == PAPER_OK; i++)
        status = brush_follow(p, &h->tail[i], &made);
    return status;
}
