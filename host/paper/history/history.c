/* history.c - moves in a sheet's list of operations, and brings the fields to the position
 * that the user sees. */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

static const struct position beginning = {0, 0};

/* ---- life ---- */

enum paper_status paper_history_begin(struct paper_sheet *p, double budget_bytes)
{
    if (p->history || p->touched)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "a history begins with a sheet that nothing has been done to");
    p->history = calloc(1, sizeof *p->history);
    if (!p->history)
        return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    p->history->budget_bytes = budget_bytes;
    p->history->inserting_at = -1;
    p->history->resumed = -1;
    return PAPER_OK;
}

static void history_free(struct sheet_history *h)
{
    if (h->inserting_at >= 0)
        event_log_put_back(&h->log, h->tail, h->tail_count);
    event_log_free(&h->log);
    notes_free(&h->notes);
    checkpoints_free(h);
    free(h);
}

void history_sheet_destroy(struct paper_sheet *p)
{
    if (p)
        sheet_growing_end(p, NULL);
    if (p && p->history)
        history_free(p->history);
    if (p)
        sheet_destroy(p);
}

bool paper_history_has(const struct paper_sheet *p)
{
    return p->history != NULL;
}

double paper_history_bytes(const struct paper_sheet *p)
{
    return p->history ? p->history->held_bytes + p->history->log.bytes : 0;
}

void paper_history_set_watch(struct paper_sheet *p, paper_history_watch watch, void *context)
{
    if (!p->history)
        return;
    p->history->watch = watch;
    p->history->watch_context = context;
}

/* ---- where it is ---- */

int paper_history_done(const struct paper_sheet *p)
{
    return p->history ? p->history->now.op + (p->history->now.step > 0) : 0;
}

int paper_history_undone(const struct paper_sheet *p)
{
    const struct sheet_history *h = p->history;
    return h ? h->log.count - h->now.op : 0;
}

long paper_sheet_steps(const struct paper_sheet *p)
{
    return p->history ? history_time(p->history, p->history->now) : p->steps;
}

long paper_sheet_now(const struct paper_sheet *p)
{
    const struct sheet_history *h = p->history;
    return h && (h->performing || h->painting)
               ? history_time(h, h->now) + (p->steps - h->steps_before)
               : paper_sheet_steps(p);
}

bool paper_history_moment(const struct paper_sheet *p, int number, struct paper_moment *out)
{
    const struct sheet_history *h = p->history;
    if (!h || number < 0 || number >= h->log.count)
        return false;
    *out =
        (struct paper_moment){.what = sheet_event_name(operation_kind(&h->log.records[number])),
                              .time = history_time(h, (struct position){number, 0}),
                              .steps = h->log.records[number].steps};
    return true;
}

enum paper_status paper_history_moment_put(const struct paper_sheet *p, int number,
                                           double amount[1 + PAPER_PIGMENTS_MAX], int box[4],
                                           bool *puts)
{
    const struct event_record *op = &p->history->log.records[number];
    *puts = op->kind == SHEET_EVENT_PUT || op->kind == SHEET_EVENT_WASH;
    if (!*puts)
        return PAPER_OK;
    void *arguments = NULL;
    enum paper_status status = operation_arguments(&p->config, op, &arguments);
    if (status == PAPER_OK) {
        const struct event_put *put = arguments;
        const struct paper_wash *wash = arguments;
        const bool even = op->kind == SHEET_EVENT_PUT;
        const struct paper_place *place = even ? &put->place : &wash->place;
        memcpy(amount, even ? put->amount : wash->amount, sizeof put->amount);
        const int all[4] = {0, 0, p->config.width, p->config.height};
        memcpy(box, all, sizeof all);
        if (place->screen) {
            box[0] = place->x;
            box[1] = place->y;
            box[2] = place->screen->width_px;
            box[3] = place->screen->height_px;
        }
    }
    event_free(sheet_event_kind(operation_kind(op)), arguments);
    return status;
}

int paper_history_following(const struct paper_sheet *p)
{
    return p->history && p->history->following
               ? p->history->notes.count - p->history->notes.repeated
               : 0;
}

long paper_history_resumed(const struct paper_sheet *p)
{
    return p->history ? p->history->resumed : -1;
}

bool paper_history_diverged(const struct paper_sheet *p)
{
    return p->history && p->history->diverged;
}

const struct paper_air *history_air(const struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    if (!h || h->performing || h->painting ||
        (h->at.op >= 0 && position_compare(h->at, h->now) == 0))
        return &p->air;
    h->air = paper_air_default();
    for (int i = h->now.op - 1; i >= 0; i--) {
        void *arguments = NULL;
        if (h->log.records[i].kind != SHEET_EVENT_AIR)
            continue;
        if (operation_arguments(&p->config, &h->log.records[i], &arguments) == PAPER_OK)
            h->air = *(const struct paper_air *)arguments;
        event_free(sheet_event_kind(SHEET_EVENT_AIR), arguments);
        break;
    }
    return &h->air;
}

bool paper_history_brush(const struct paper_sheet *p, int number)
{
    const struct sheet_history *h = p->history;
    if (!h)
        return sheet_brush_get(p, number) != NULL;
    bool there = false;
    for (int i = 0; i < h->now.op && !there; i++) {
        void *arguments = NULL;
        if (h->log.records[i].kind != SHEET_EVENT_BRUSH)
            continue;
        if (operation_arguments(&p->config, &h->log.records[i], &arguments) == PAPER_OK)
            there = ((const struct paper_brush *)arguments)->number == number;
        event_free(sheet_event_kind(SHEET_EVENT_BRUSH), arguments);
    }
    return there;
}

/* ---- doing ---- */

void paper_history_mark(struct paper_sheet *p)
{
    if (p->history)
        p->history->open = false;
}

/* Performs `steps` steps, or one operation, at the sheet's position; `at` follows. */
static enum paper_status operation_perform(struct paper_sheet *p, const struct event_record *op,
                                           const void *arguments)
{
    struct sheet_history *h = p->history;
    struct position at = h->at;
    h->at.op = -1; /* unknown unless it succeeds, or changes nothing */
    h->performing = true;
    h->steps_before = p->steps;
    /* steps use the same kernels whatever was done before */
    bool step = op->kind == SHEET_EVENT_STEP || op->kind == SHEET_EVENT_STROKE;
    enum paper_status status = step && h->unfinished ? sheet_finish(p) : PAPER_OK;
    h->unfinished = !step;
    if (status == PAPER_OK)
        status = sheet_event_perform(p, operation_kind(op), arguments);
    h->performing = false;
    if (status == PAPER_BAD_ARGUMENT)
        h->at = at;
    if (status != PAPER_OK)
        return status;
    const long steps = p->steps - h->steps_before; /* a stroke makes them, too */
    h->work += op->kind == SHEET_EVENT_STEP ? 1 : 1 + steps;
    h->spared += (double)steps * (1 - sheet_share(p));
    at.step++;
    bool ends = op->kind != SHEET_EVENT_STEP || at.step == op->steps;
    h->at = ends ? (struct position){at.op + 1, 0} : at;
    return PAPER_OK;
}

enum paper_status history_record(struct sheet_history *h, struct event_record op, bool *joined)
{
    struct event_record *last = h->log.count > 0 ? &h->log.records[h->log.count - 1] : NULL;
    h->inserted.count = 0;
    bool steps = op.kind == SHEET_EVENT_STEP;
    *joined = steps && h->open && last && last->kind == SHEET_EVENT_STEP &&
              last->steps < INT32_MAX / 2 && h->log.count != h->inserting_at;
    if (*joined) {
        /* its end is now inside the joined operation */
        struct checkpoint *point = h->points_count ? &h->points[h->points_count - 1] : NULL;
        if (point && point->position.op == h->log.count)
            point->position = (struct position){h->log.count - 1, last->steps};
        last->steps++;
    } else {
        enum paper_status status = history_append(h, op);
        if (status != PAPER_OK)
            return status;
        h->open = steps;
    }
    h->now = (struct position){h->log.count, 0};
    if (h->tell)
        h->tell(h->tell_context, &h->log.records[h->log.count - 1], *joined, 0, 0);
    return PAPER_OK;
}

/* A program that is run again repeats the operation: it is listed, and computed only if the
 * sheet is read. */
static enum paper_status repeat(struct sheet_history *h, struct event_record op)
{
    bool joined;
    enum paper_status status = history_cut(h);
    if (status == PAPER_OK)
        status = history_record(h, op, &joined);
    else
        event_record_free(&op);
    if (status == PAPER_OK)
        history_followed(h);
    else
        history_stray(h);
    return status;
}

enum paper_status history_keep(struct paper_sheet *p, struct event_record op)
{
    struct sheet_history *h = p->history;
    bool joined;
    enum paper_status status = history_record(h, op, &joined);
    if (status != PAPER_OK) {
        h->at.op = -1;
        return status;
    }
    h->at = h->now;
    if (joined && h->notes.count > 0)
        h->notes.at[h->notes.count - 1].number++;
    else
        notes_add(&h->notes, (struct note){op.kind, op.steps, op.digest});
    checkpoint_offer(p, false);
    return PAPER_OK;
}

enum paper_status sheet_event(struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments)
{
    struct sheet_history *h = p->history;
    struct event_record op;
    enum paper_status status = history_no_stroke(p);
    if (status == PAPER_OK)
        status = sheet_event_check(p, kind, arguments);
    if (status != PAPER_OK)
        return status;
    if (!h || h->performing) {
        p->touched = true;
        return sheet_event_perform(p, kind, arguments);
    }
    status = operation_make(p, kind, arguments, &op);
    if (status != PAPER_OK)
        return status;
    if (history_foreseen(h, (struct note){(int)kind, 0, op.digest}, &op.steps))
        return repeat(h, op);
    status = history_cut(h);
    if (status == PAPER_OK)
        status = sheet_ready(p);
    long before = p->steps;
    if (status == PAPER_OK)
        status = operation_perform(p, &op, arguments);
    if (status != PAPER_OK) {
        event_record_free(&op);
        return status;
    }
    if (kind != SHEET_EVENT_STEP) /* a stroke */
        op.steps += (int)(p->steps - before);
    return history_keep(p, op);
}

/* ---- computing again ---- */

/* The number of steps between two positions. */
static long steps_between(const struct sheet_history *h, struct position from,
                          struct position to)
{
    return history_time(h, to) - history_time(h, from);
}

/* Brings the fields from `at` to `now`. */
static enum paper_status catch_up(struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    long total = steps_between(h, h->at, h->now), done = 0;
    while (position_compare(h->at, h->now) < 0) {
        const struct event_record *op = &h->log.records[h->at.op];
        void *arguments;
        enum paper_status status = operation_arguments(&p->config, op, &arguments);
        if (status == PAPER_OK)
            status = operation_perform(p, op, arguments);
        event_free(sheet_event_kind(operation_kind(op)), arguments);
        if (status == PAPER_OK && op->kind == SHEET_EVENT_STEP)
            status = sheet_finish(p);
        if (status != PAPER_OK)
            return status;
        done += op->kind == SHEET_EVENT_STEP ? 1 : op->steps;
        checkpoint_offer(p, false);
        if (h->watch && !h->watch(h->watch_context, done, total))
            return paper_fail(PAPER_MACHINE_FAILED, "stopped");
    }
    return PAPER_OK;
}

enum paper_status sheet_ready(struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    enum paper_status status = PAPER_OK;
    if (!h || h->performing || h->painting ||
        (h->at.op >= 0 && position_compare(h->at, h->now) == 0))
        return PAPER_OK;
    const struct checkpoint *point = checkpoint_before(h, h->now);
    struct position from = point ? point->position : beginning;
    if (h->at.op < 0 || position_compare(h->at, h->now) > 0 ||
        position_compare(h->at, from) < 0) {
        h->at.op = -1;
        status = point ? checkpoint_restore(p, point) : sheet_reset(p);
        if (status != PAPER_OK) {
            h->at.op = -1;
            return status;
        }
        if (!point) {
            h->at = beginning;
            h->work = 0;
        } else
            checkpoint_reached(h, point);
        h->loaded = false;
    }
    const long before = h->work;
    status = catch_up(p);
    if (status == PAPER_OK && h->work - before >= CHECKPOINT_EVERY)
        checkpoint_offer(p, true); /* who came here will come again: undo, and undo again */
    return status;
}

/* ---- back and forth ---- */

static void move_to(struct paper_sheet *p, struct position position)
{
    struct sheet_history *h = p->history;
    if (position_compare(position, h->now) < 0 && h->at.op >= 0)
        checkpoint_offer(p, true); /* the way back */
    h->now = position;
    h->open = false;
    h->inserted.count = 0;
    history_followed(h);
}

int paper_history_undo(struct paper_sheet *p, int count)
{
    struct sheet_history *h = p->history;
    if (!h || count < 1)
        return 0;
    if (sheet_growing(p)) { /* it is the last operation */
        history_stroke_drop(p);
        return 1 + paper_history_undo(p, count - 1);
    }
    int done = paper_history_done(p), least = h->inserting_at > 0 ? h->inserting_at : 0;
    count = count < done - least ? count : done - least;
    if (count <= 0)
        return 0;
    history_moved(h, NOTE_UNDO, count);
    int before = count;
    if (h->inserted.count > 0 && h->inserting_at < 0) { /* all of it counts as one */
        history_insertion_remove(h);
        done = h->log.count;
        before = count - 1 < done ? count - 1 : done;
    }
    move_to(p, (struct position){done - before, 0});
    return count;
}

int paper_history_redo(struct paper_sheet *p, int count)
{
    struct sheet_history *h = p->history;
    if (!h || count < 1 || sheet_growing(p))
        return 0;
    int left = paper_history_undone(p);
    count = count < left ? count : left;
    if (count <= 0)
        return 0;
    history_moved(h, NOTE_REDO, count);
    move_to(p, (struct position){h->now.op + count, 0});
    return count;
}

enum paper_status history_changeable(const struct paper_sheet *p)
{
    if (!p->history)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no history");
    if (p->history->inserting_at >= 0)
        return paper_fail(PAPER_BAD_ARGUMENT, "something is being inserted already");
    return history_no_stroke(p);
}

static enum paper_status time_check(const struct paper_sheet *p, long time, struct position end,
                                    struct position *position)
{
    const struct sheet_history *h = p->history;
    const enum paper_status status = history_changeable(p);
    if (status != PAPER_OK)
        return status;
    *position = history_position(h, time, end);
    if (position->op < 0)
        return paper_fail(PAPER_BAD_ARGUMENT, "a time must be 0..%ld steps (got %ld)",
                          history_time(h, end), time);
    return PAPER_OK;
}

enum paper_status paper_history_seek(struct paper_sheet *p, long time)
{
    struct position position, end = beginning;
    if (p->history)
        end = (struct position){p->history->log.count, 0};
    enum paper_status status = time_check(p, time, end, &position);
    if (status != PAPER_OK)
        return status;
    history_moved(p->history, NOTE_SEEK, time);
    move_to(p, position);
    return PAPER_OK;
}

/* ---- earlier ---- */

enum paper_status paper_history_insert_begin(struct paper_sheet *p, long time)
{
    struct position position;
    enum paper_status status =
        time_check(p, time, p->history ? p->history->now : beginning, &position);
    if (status != PAPER_OK)
        return status;
    struct sheet_history *h = p->history;
    status = history_cut(h);
    h->inserted.count = 0;
    h->inserted.split = position.step > 0;
    if (status == PAPER_OK)
        status = history_split(h, position);
    if (status != PAPER_OK)
        return status;
    if (position.step > 0)
        position = (struct position){position.op + 1, 0};
    if (!event_log_take_away(&h->log, position.op, &h->tail, &h->tail_count))
        return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    history_moved(h, NOTE_INSERT, time);
    h->now = position;
    h->open = false;
    h->inserting_at = position.op;
    checkpoints_drop_after(h, position);
    if (position_compare(h->at, position) > 0)
        h->at.op = -1;
    history_followed(h);
    return PAPER_OK;
}

enum paper_status paper_history_insert_end(struct paper_sheet *p, bool keep)
{
    struct sheet_history *h = p->history;
    if (!h || h->inserting_at < 0)
        return PAPER_OK;
    if (history_no_stroke(p) != PAPER_OK)
        return PAPER_BAD_ARGUMENT;
    const bool replaced = h->changing && keep;
    enum paper_status status = replaced ? history_brushes_check(p, -1, 1) : PAPER_OK;
    if (status != PAPER_OK)
        return status;
    history_moved(h, NOTE_INSERT_END, keep);
    if (!keep)
        h->now = (struct position){h->inserting_at, 0};
    status = history_cut(h); /* at a boundary, which takes no memory */
    const int end = h->log.count;
    h->inserted.op = h->inserting_at;
    h->inserted.count = h->changing ? 0 : end - h->inserting_at;
    if (!event_log_put_back(&h->log, h->tail, h->tail_count) && status == PAPER_OK)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
    if (replaced && end < h->log.count)
        event_log_remove(&h->log, end, 1);
    h->tail = NULL;
    h->tail_count = 0;
    h->inserting_at = -1;
    h->changing = false;
    h->now = (struct position){h->log.count, 0};
    h->open = false;
    history_followed(h);
    return status;
}
