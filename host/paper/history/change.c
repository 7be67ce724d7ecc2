/* change.c - operations of the past that are taken out, or replaced by others. What followed
 * flows anew: checkpoints behind them are dropped, and the rest is history.c's, as after an
 * insertion. */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>

static enum paper_status number_check(struct paper_sheet *p, int number)
{
    const enum paper_status status = history_changeable(p);
    if (status != PAPER_OK)
        return status;
    const int done = paper_history_done(p);
    return number >= 0 && number < done
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "an operation must be 0..%d (got %d)", done - 1,
                            number);
}

static void change_from(struct sheet_history *h, int number)
{
    const struct position place = {number, 0};
    checkpoints_drop_after(h, place);
    if (position_compare(h->at, place) > 0)
        h->at.op = -1;
    h->open = false;
    h->inserted.count = 0;
}

/* Steps in the place of operation `number`, before it. */
static enum paper_status steps_put(struct paper_sheet *p, int number, int steps)
{
    struct sheet_history *h = p->history;
    struct event_record op, *tail;
    int count;
    enum paper_status status = operation_make(p, SHEET_EVENT_STEP, NULL, &op);
    if (status != PAPER_OK)
        return status;
    op.steps = steps;
    if (!event_log_take_away(&h->log, number, &tail, &count)) {
        event_record_free(&op);
        return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    }
    status = history_append(h, op);
    if (!event_log_put_back(&h->log, tail, count) && status == PAPER_OK)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    return status;
}

enum paper_status paper_history_remove(struct paper_sheet *p, int number, bool leave_time)
{
    struct sheet_history *h = p->history;
    enum paper_status status = number_check(p, number);
    if (status == PAPER_OK)
        status = history_cut(h);
    if (status == PAPER_OK && h->log.records[number].kind == SHEET_EVENT_BRUSH)
        status = history_brushes_check(p, number, 0);
    if (status != PAPER_OK)
        return status;
    const struct event_record *op = &h->log.records[number];
    const int steps = op->kind != SHEET_EVENT_STEP && leave_time ? op->steps : 0;
    change_from(h, number);
    if (steps > 0)
        status = steps_put(p, number, steps);
    if (status != PAPER_OK)
        return status;
    history_moved(h, leave_time ? NOTE_REMOVE_LEAVING_TIME : NOTE_REMOVE, number);
    event_log_remove(&h->log, number + (steps > 0), 1);
    h->now = (struct position){h->log.count, 0};
    history_followed(h);
    return PAPER_OK;
}

/* The operations from `number` on are taken away, until paper_history_insert_end(). */
static enum paper_status part_at(struct paper_sheet *p, int number, enum note_move move)
{
    struct sheet_history *h = p->history;
    enum paper_status status = number_check(p, number);
    if (status == PAPER_OK)
        status = history_cut(h);
    if (status != PAPER_OK)
        return status;
    change_from(h, number);
    if (!event_log_take_away(&h->log, number, &h->tail, &h->tail_count))
        return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    history_moved(h, move, number);
    h->now = (struct position){number, 0};
    h->inserting_at = number;
    h->inserted.split = false;
    h->changing = move == NOTE_CHANGE;
    history_followed(h);
    return PAPER_OK;
}

enum paper_status paper_history_change_begin(struct paper_sheet *p, int number)
{
    return part_at(p, number, NOTE_CHANGE);
}

enum paper_status paper_history_insert_before(struct paper_sheet *p, int number)
{
    return part_at(p, number, NOTE_INSERT_BEFORE);
}

enum paper_status paper_history_change_end(struct paper_sheet *p, bool keep)
{
    return paper_history_insert_end(p, keep);
}
