/* retell.c - what a journal tells of is done again: operations are listed and not performed, as
 * where a saved run is followed. */
#include "history/history_internal.h"
#include "model/model.h"

struct sheet_history *history_of(const struct paper_sheet *p)
{
    return p->history;
}

static enum paper_status impossible(void)
{
    return paper_fail(PAPER_BAD_FILE, "a journal tells of what this sheet's history cannot do");
}

/* Whether the brush that an operation dips or leads has been made before `now`: mostly just
 * before. */
static enum paper_status brush_check(const struct paper_sheet *p, const struct event_record *op)
{
    const struct sheet_history *h = p->history;
    int needed, made = -1;
    if (op->kind != SHEET_EVENT_DIP && op->kind != SHEET_EVENT_STROKE)
        return PAPER_OK;
    enum paper_status status = history_operation_brush(p, op, &needed);
    for (int i = h->now.op - 1; i >= 0 && made != needed && status == PAPER_OK; i--)
        if (h->log.records[i].kind == SHEET_EVENT_BRUSH)
            status = history_operation_brush(p, &h->log.records[i], &made);
    return status == PAPER_OK && made != needed ? impossible() : status;
}

enum paper_status history_retell(struct paper_sheet *p, struct event_record op, bool joined)
{
    struct sheet_history *h = p->history;
    const int kind = op.kind, more = kind == SHEET_EVENT_STEP ? op.steps - 1 : 0;
    const int end = h->now.op + (h->now.step > 0);
    const bool fits =
        !joined || (kind == SHEET_EVENT_STEP && end > 0 && end != h->inserting_at &&
                    h->log.records[end - 1].kind == SHEET_EVENT_STEP &&
                    h->log.records[end - 1].steps < INT32_MAX / 2 - op.steps);
    unsigned brushes = ~0u;
    enum paper_status status = fits ? history_operation_check(p, &op, &brushes) : impossible();
    if (status == PAPER_OK)
        status = brush_check(p, &op);
    if (status == PAPER_OK)
        status = history_cut(h);
    if (status != PAPER_OK) {
        event_record_free(&op);
        return status;
    }
    op.digest = event_record_digest(&op);
    h->open = joined;
    op.steps -= more;
    const struct note note = {kind, op.steps, op.digest};
    bool was_joined;
    status = history_record(h, op, &was_joined);
    if (status != PAPER_OK)
        return status;
    if (!was_joined || h->notes.count == 0)
        notes_add(&h->notes, note);
    else
        h->notes.at[h->notes.count - 1].number++;
    h->log.records[h->log.count - 1].steps += more;
    if (h->notes.count > 0)
        h->notes.at[h->notes.count - 1].number += more;
    return PAPER_OK;
}

enum paper_status history_remake(struct paper_sheet *p, int move, long number)
{
    enum paper_status status = PAPER_OK;
    const int count = number > 0 && number <= INT32_MAX ? (int)number : 0;
    switch (move) {
    case NOTE_UNDO:
        return paper_history_undo(p, count) == count && count > 0 ? PAPER_OK : impossible();
    case NOTE_REDO:
        return paper_history_redo(p, count) == count && count > 0 ? PAPER_OK : impossible();
    case NOTE_SEEK:
        status = paper_history_seek(p, number);
        break;
    case NOTE_INSERT:
        status = paper_history_insert_begin(p, number);
        break;
    case NOTE_INSERT_END:
        if (p->history->inserting_at < 0)
            return impossible();
        status = paper_history_insert_end(p, number != 0);
        break;
    case NOTE_REMOVE:
    case NOTE_REMOVE_LEAVING_TIME:
        status = paper_history_remove(p, (int)number, move == NOTE_REMOVE_LEAVING_TIME);
        break;
    case NOTE_CHANGE:
        status = paper_history_change_begin(p, (int)number);
        break;
    case NOTE_INSERT_BEFORE:
        status = paper_history_insert_before(p, (int)number);
        break;
    default:
        return impossible();
    }
    return status == PAPER_BAD_ARGUMENT ? impossible() : status;
}
