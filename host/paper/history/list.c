/* list.c - the list of operations: the log, and the positions of checkpoints in it. */
#include "history/history_internal.h"
#include "model/model.h"

enum paper_status operation_make(const struct paper_sheet *p, enum sheet_event_kind kind,
                                 const void *arguments, struct event_record *op)
{
    if (!event_record_make(op, (int)kind, sheet_event_kind(kind), arguments, &p->config))
        return paper_fail(PAPER_NO_MEMORY, "no memory to record an operation (%s)",
                          sheet_event_name(kind));
    op->steps = kind == SHEET_EVENT_STEP;
    return PAPER_OK;
}

enum paper_status operation_arguments(const struct paper_sheet_config *config,
                                      const struct event_record *op, void **arguments)
{
    enum sheet_event_kind kind = operation_kind(op);
    return sheet_event_decoded(
        event_record_arguments(op, sheet_event_kind(kind), config, arguments), kind);
}

static enum paper_status no_memory(void)
{
    return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
}

enum paper_status history_append(struct sheet_history *h, struct event_record op)
{
    return event_log_append(&h->log, op) ? PAPER_OK : no_memory();
}

enum paper_status history_split(struct sheet_history *h, struct position at)
{
    if (at.step == 0)
        return PAPER_OK;
    if (!event_log_split(&h->log, at.op, at.step))
        return no_memory();
    /* places whose numbers change */
    struct position *places[CHECKPOINTS_MAX + 2] = {&h->now, &h->at};
    int count = 2;
    for (int i = 0; i < h->points_count; i++)
        places[count++] = &h->points[i].position;
    for (int i = 0; i < count; i++) {
        if (position_compare(*places[i], at) < 0)
            continue;
        if (places[i]->op == at.op)
            places[i]->step -= at.step;
        places[i]->op++;
    }
    return PAPER_OK;
}

enum paper_status history_cut(struct sheet_history *h)
{
    enum paper_status status = history_split(h, h->now);
    if (status != PAPER_OK)
        return status;
    if (h->log.count == h->now.op)
        return PAPER_OK;
    event_log_cut(&h->log, h->now.op);
    h->open = false;
    checkpoints_drop_after(h, h->now);
    if (position_compare(h->at, h->now) > 0)
        h->at.op = -1;
    return PAPER_OK;
}

/* A position at the boundary of two operations that are joined. */
static void joined_place(struct position *place, int op, int steps)
{
    if (place->op == op && place->step == 0)
        *place = (struct position){op - 1, steps};
}

void history_insertion_remove(struct sheet_history *h)
{
    const struct position place = {h->inserted.op, 0};
    checkpoints_drop_after(h, place);
    if (position_compare(h->at, place) > 0)
        h->at.op = -1;
    event_log_remove(&h->log, place.op, h->inserted.count);
    if (h->inserted.split && place.op > 0 && place.op < h->log.count) {
        const int steps = h->log.records[place.op - 1].steps;
        joined_place(&h->at, place.op, steps);
        for (int i = 0; i < h->points_count; i++)
            joined_place(&h->points[i].position, place.op, steps);
        event_log_join(&h->log, place.op);
    }
    h->inserted.count = 0;
    h->now = (struct position){h->log.count, 0};
}
