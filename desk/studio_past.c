/* studio_past.c - time under the hand: the deeds of the past, going there, and doing something
 * there.
 *
 *     operations   brush dip stroke | dip stroke step x 90 | put step x 30
 *     deeds        0                | 1                    | 2
 *                                   ^ visited: `done`                      ^ `present`
 *
 * Who paints while an earlier moment is visited inserts: what followed is taken away until the
 * present is gone to, and then flows anew. An inserted brush has a number of its own and is
 * made anew, so that strokes which follow find theirs as they left it. */
#include "studio_session_internal.h"

#include <arguments.h>
#include <array.h>

#include <stdlib.h>
#include <string.h>

/* ---- deeds ---- */

/* Operations first..end - 1 are a deed: the brushes and dips before it, itself, and the time
 * after it. */
struct span {
    int first, itself, end;
};

/* Calls for each deed until it returns false. */
static void deeds_walk(const struct studio_session *s,
                       bool (*each)(void *context, const struct span *span), void *context)
{
    const int all = paper_history_done(s->sheet) + paper_history_undone(s->sheet);
    struct span span = {-1, -1, -1};
    int first = -1;
    for (int i = 0; i < all; i++) {
        const enum studio_part part = studio_session_part(s, i);
        if (part == STUDIO_PART_BEFORE) {
            first = first < 0 ? i : first;
            continue;
        }
        if (part == STUDIO_PART_DEED) {
            if (span.itself >= 0 && !each(context, &span))
                return;
            span = (struct span){first < 0 ? i : first, i, i + 1};
        } else
            span.end = i + 1;
        first = -1;
    }
    if (span.itself >= 0)
        each(context, &span);
}

struct listing {
    const struct studio_session *session;
    struct studio_bookmark *bookmarks;
    int bookmarks_count;
    struct studio_deed *deeds;
    int count, capacity;
    bool short_of_memory;
};

static bool deed_list(void *context, const struct span *span)
{
    struct listing *l = context;
    struct paper_moment begins, last;
    if (!array_reserve(&l->deeds, &l->capacity, l->count + 1, sizeof *l->deeds)) {
        l->short_of_memory = true;
        return false;
    }
    const struct studio_bookmark *marked = NULL; /* the last one */
    for (int i = 0; i < l->bookmarks_count; i++)
        if (l->bookmarks[i].operation > span->itself && l->bookmarks[i].operation < span->end)
            marked = &l->bookmarks[i];
    paper_history_moment(l->session->sheet, span->itself, &begins);
    paper_history_moment(l->session->sheet, span->end - 1, &last);
    const bool selects = strcmp(begins.what, "resist") == 0 &&
                         studio_session_selects(l->session, span->itself) == STUDIO_SELECTS;
    l->deeds[l->count++] =
        (struct studio_deed){.what = selects ? "selection" : begins.what,
                             .time = begins.time,
                             .steps = last.time + last.steps - begins.time,
                             .done = paper_history_done(l->session->sheet) > span->itself,
                             .marked = marked != NULL};
    if (marked)
        memcpy(l->deeds[l->count - 1].name, marked->name, sizeof marked->name);
    return true;
}

enum paper_status studio_session_deeds(const struct studio_session *s,
                                       struct studio_deed **deeds, int *count)
{
    struct listing l = {.session = s};
    const enum paper_status status =
        studio_session_bookmarks(s, &l.bookmarks, &l.bookmarks_count);
    deeds_walk(s, deed_list, &l);
    free(l.bookmarks);
    *deeds = l.deeds;
    *count = l.count;
    return l.short_of_memory
               ? studio_session_failed(PAPER_NO_MEMORY, "no memory for the list of deeds")
               : status;
}

/* The deed of that number; *end: the operations before it. */
struct search {
    int number, count;
    struct span found;
};

static bool deed_search(void *context, const struct span *span)
{
    struct search *search = context;
    if (search->count++ < search->number)
        return true;
    search->found = *span;
    return false;
}

static bool deed_find(const struct studio_session *s, int number, struct span *span)
{
    struct search search = {.number = number, .found = {-1, -1, -1}};
    deeds_walk(s, deed_search, &search);
    *span = search.found;
    return span->itself >= 0;
}

struct counting {
    int done, count;
};

static bool deed_count(void *context, const struct span *span)
{
    struct counting *c = context;
    c->count += span->itself < c->done;
    return span->itself < c->done;
}

int studio_session_deeds_done(const struct studio_session *s)
{
    struct counting c = {paper_history_done(s->sheet), 0};
    deeds_walk(s, deed_count, &c);
    return c.count;
}

/* ---- going there ---- */

bool studio_session_visits(const struct studio_session *s)
{
    return s->present >= 0 || s->inserting >= 0;
}

bool studio_session_inserts(const struct studio_session *s)
{
    return s->inserting >= 0;
}

static void moved(struct studio_session *s)
{
    studio_session_selection_forget(s);
    s->has_brush = false;
    s->wet = true;
}

static void go_to(struct studio_session *s, int operations)
{
    const int done = paper_history_done(s->sheet);
    if (studio_session_inserted(s)) /* from here on it is not taken out by one undo */
        paper_history_seek(s->sheet, paper_sheet_steps(s->sheet));
    s->inserted = -1;
    if (operations < done)
        paper_history_undo(s->sheet, done - operations);
    else if (operations > done)
        paper_history_redo(s->sheet, operations - done);
    moved(s);
}

static enum paper_status hand_is_off(const struct studio_session *s)
{
    return s->down ? studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper")
                   : PAPER_OK;
}

enum paper_status studio_session_present(struct studio_session *s)
{
    const bool inserts = s->inserting >= 0,
               keep = inserts && paper_history_done(s->sheet) > s->inserting;
    enum paper_status status = hand_is_off(s);
    if (status != PAPER_OK)
        return status;
    if (inserts)
        status = paper_history_insert_end(s->sheet, keep);
    else if (s->present >= 0)
        go_to(s, s->present);
    if (status == PAPER_OK)
        s->inserting = s->present = s->way = -1;
    if (status == PAPER_OK && keep) {
        s->inserted = paper_history_done(s->sheet);
        s->inserted_steps = paper_sheet_steps(s->sheet);
    }
    moved(s);
    return status;
}

void studio_session_visit_to(struct studio_session *s, int operations)
{
    if (s->present < 0)
        s->present = paper_history_done(s->sheet);
    go_to(s, operations);
    if (operations >= s->present)
        s->present = -1;
    s->way = -1;
    s->held = true;
}

enum paper_status studio_session_visit(struct studio_session *s, int deeds)
{
    struct span span = {0, 0, 0};
    enum paper_status status = hand_is_off(s);
    if (status == PAPER_OK && s->inserting >= 0)
        status = studio_session_present(s);
    if (status != PAPER_OK)
        return status;
    if (deeds < 0 || !deed_find(s, deeds > 0 ? deeds - 1 : 0, &span))
        return studio_session_failed(PAPER_BAD_ARGUMENT, "so many deeds are not there: %d",
                                     deeds);
    studio_session_visit_to(s, deeds > 0 ? span.end : span.first);
    return PAPER_OK;
}

void studio_session_from_here(struct studio_session *s)
{
    studio_session_change_forget(s);
    if (s->inserting < 0)
        s->present = -1;
}

/* ---- what was changed, as it was ---- */

static void operation_forget(struct studio_operation *o)
{
    free(o->bytes);
    *o = (struct studio_operation){0};
}

void studio_session_change_forget(struct studio_session *s)
{
    operation_forget(&s->changed.operation);
    operation_forget(&s->changed.second);
    s->changed.state = CHANGE_NONE;
}

/* Keeps operation `number`, before it is changed. */
static enum paper_status change_keep(struct studio_session *s, int number, bool replaced)
{
    studio_session_change_forget(s);
    s->changed.number = number;
    s->changed.replaced = replaced;
    s->changed.removed = false;
    return paper_history_operation(s->sheet, number, &s->changed.operation.bytes,
                                   &s->changed.operation.count);
}

/* After it: what goes on from here is no part of what is in its place. */
static enum paper_status change_made(struct studio_session *s, enum paper_status status)
{
    if (status != PAPER_OK)
        studio_session_change_forget(s);
    else
        s->changed.state = CHANGE_DONE;
    paper_history_mark(s->sheet);
    studio_session_selection_forget(s);
    return status;
}

bool studio_session_change_waits(const struct studio_session *s)
{
    return s->changed.state == CHANGE_DONE && !studio_session_visits(s);
}

bool studio_session_change_returns(const struct studio_session *s)
{
    return s->changed.state == CHANGE_UNDONE && !studio_session_visits(s) &&
           paper_history_undone(s->sheet) == 0 &&
           s->changed.number + (s->changed.second.bytes != NULL) < paper_history_done(s->sheet);
}

int studio_session_change_deed(const struct studio_session *s)
{
    struct counting c = {s->changed.number, 0};
    deeds_walk(s, deed_count, &c);
    return c.count;
}

static enum paper_status operation_again(struct studio_session *s,
                                         const struct studio_operation *o)
{
    return o->bytes ? paper_sheet_again(s->sheet, o->bytes, o->count) : PAPER_OK;
}

/* The operation that was kept takes the place of the one that is there, which is kept
 * instead. */
static enum paper_status change_swap(struct studio_session *s)
{
    const int number = s->changed.number;
    struct studio_operation there = {0};
    enum paper_status status =
        paper_history_operation(s->sheet, number, &there.bytes, &there.count);
    if (status == PAPER_OK)
        status = paper_history_change_begin(s->sheet, number);
    if (status == PAPER_OK) {
        status = operation_again(s, &s->changed.operation);
        const enum paper_status end = paper_history_change_end(s->sheet, status == PAPER_OK);
        status = status == PAPER_OK ? end : status;
    }
    if (status == PAPER_OK) {
        operation_forget(&s->changed.operation);
        s->changed.operation = there;
    } else
        operation_forget(&there);
    return status;
}

/* What was taken out is where it was. */
static enum paper_status change_return(struct studio_session *s)
{
    const int number = s->changed.number;
    const bool last = number >= paper_history_done(s->sheet);
    enum paper_status status = last ? PAPER_OK
                               : s->changed.replaced
                                   ? paper_history_change_begin(s->sheet, number)
                                   : paper_history_insert_before(s->sheet, number);
    if (status != PAPER_OK)
        return status;
    status = operation_again(s, &s->changed.operation);
    if (status == PAPER_OK)
        status = operation_again(s, &s->changed.second);
    const enum paper_status end =
        last ? PAPER_OK : paper_history_insert_end(s->sheet, status == PAPER_OK);
    return status == PAPER_OK ? end : status;
}

/* Takes out the operation, and the second one of a pair. */
static enum paper_status change_remove(struct studio_session *s)
{
    enum paper_status status = PAPER_OK;
    if (s->changed.second.bytes)
        status = paper_history_remove(s->sheet, s->changed.number + 1, false);
    return status == PAPER_OK ? paper_history_remove(s->sheet, s->changed.number, true)
                              : status;
}

/* It is as if it had always been there. */
static bool change_ended(struct studio_session *s, enum paper_status status,
                         enum studio_change state)
{
    if (status == PAPER_OK) {
        s->changed.state = state;
        paper_history_seek(s->sheet, paper_sheet_steps(s->sheet));
    } else
        studio_session_change_forget(s);
    paper_history_mark(s->sheet);
    s->inserted = -1;
    moved(s);
    return status == PAPER_OK;
}

bool studio_session_change_undo(struct studio_session *s)
{
    return studio_session_change_waits(s) &&
           change_ended(s, s->changed.removed ? change_return(s) : change_swap(s),
                        CHANGE_UNDONE);
}

bool studio_session_change_redo(struct studio_session *s)
{
    return studio_session_change_returns(s) &&
           change_ended(s, s->changed.removed ? change_remove(s) : change_swap(s), CHANGE_DONE);
}

/* ---- doing something there ---- */

enum paper_status studio_session_insert(struct studio_session *s)
{
    const int at = paper_history_done(s->sheet);
    studio_session_change_forget(s);
    if (s->present < 0 || s->inserting >= 0)
        return PAPER_OK;
    go_to(s, s->present);
    const enum paper_status status = paper_history_insert_before(s->sheet, at);
    studio_session_selection_forget(s);
    if (status == PAPER_OK)
        s->inserting = at;
    else
        go_to(s, at);
    return status;
}

/* The last deed before the visited moment; then the present is gone to. */
static enum paper_status deed_choose(struct studio_session *s, struct span *span)
{
    enum paper_status status = hand_is_off(s);
    const int done = studio_session_deeds_done(s);
    if (status == PAPER_OK && s->inserting >= 0)
        status = studio_session_failed(PAPER_BAD_ARGUMENT,
                                       "something is being inserted; go to the present first");
    if (status == PAPER_OK && (done == 0 || !deed_find(s, done - 1, span)))
        status =
            studio_session_failed(PAPER_BAD_ARGUMENT, "there is no deed before this moment");
    return status;
}

enum paper_status studio_session_remove(struct studio_session *s)
{
    struct span span = {-1, -1, -1};
    enum paper_status status = deed_choose(s, &span);
    if (status == PAPER_OK)
        status = studio_session_present(s);
    struct paper_moment moment;
    paper_history_moment(s->sheet, span.itself, &moment);
    if (status == PAPER_OK)
        status = change_keep(s, span.itself, moment.steps > 0);
    if (status == PAPER_OK && span.itself + 1 < span.end &&
        studio_session_selects(s, span.itself + 1) == STUDIO_SELECTS_SECOND)
        status = paper_history_operation(s->sheet, span.itself + 1, &s->changed.second.bytes,
                                         &s->changed.second.count);
    s->changed.removed = true;
    if (status == PAPER_OK)
        status = change_remove(s);
    return change_made(s, status);
}

/* The operation that has the deed's amounts; -1: none. */
static int amounts_of(const struct studio_session *s, const struct span *span)
{
    struct paper_moment moment;
    paper_history_moment(s->sheet, span->itself, &moment);
    if (strcmp(moment.what, "stroke") != 0)
        return strcmp(moment.what, "put") == 0 || strcmp(moment.what, "wash") == 0 ||
                       strcmp(moment.what, "splatter") == 0
                   ? span->itself
                   : -1;
    for (int i = span->itself - 1; i >= span->first; i--)
        if (paper_history_moment(s->sheet, i, &moment) && strcmp(moment.what, "dip") == 0)
            return i;
    return -1;
}

/* The same again with other amounts. */
static enum paper_status amounts_again(struct studio_session *s, const char *what,
                                       void *arguments, double *amount)
{
    struct event_put *put = arguments;
    struct paper_wash *wash = arguments;
    struct paper_splatter *splatter = arguments;
    struct paper_dip *dip = arguments;
    if (strcmp(what, "put") == 0)
        return paper_sheet_put(s->sheet, put->place.screen, put->place.x, put->place.y, amount);
    if (strcmp(what, "wash") == 0) {
        for (int i = 0; i <= PAPER_PIGMENTS_MAX; i++)
            wash->end[i] = i ? s->settings.value[STUDIO_FADE] * amount[i] : amount[i];
        memcpy(wash->amount, amount, sizeof wash->amount);
        return paper_sheet_wash(s->sheet, wash);
    }
    if (strcmp(what, "splatter") == 0) {
        memcpy(splatter->amount, amount, sizeof splatter->amount);
        return paper_sheet_splatter(s->sheet, splatter);
    }
    memcpy(dip->amount, amount, sizeof dip->amount);
    dip->amount[0] = amount[0] < 1 ? amount[0] : 1;
    return paper_sheet_dip(s->sheet, dip);
}

enum paper_status studio_session_dish(struct studio_session *s)
{
    struct span span = {-1, -1, -1};
    struct paper_moment moment;
    void *arguments = NULL;
    double amount[1 + PAPER_PIGMENTS_MAX];
    enum paper_status status = deed_choose(s, &span);
    if (status != PAPER_OK)
        return status;
    const int number = amounts_of(s, &span);
    if (number < 0)
        return studio_session_failed(PAPER_BAD_ARGUMENT,
                                     "this deed took nothing from the dish");
    paper_history_moment(s->sheet, number, &moment);
    studio_settings_amounts(&s->settings, amount);
    status = paper_history_arguments(s->sheet, number, &arguments);
    if (status == PAPER_OK)
        status = studio_session_present(s);
    if (status == PAPER_OK)
        status = change_keep(s, number, true);
    if (status == PAPER_OK)
        status = paper_history_change_begin(s->sheet, number);
    if (status == PAPER_OK) {
        status = amounts_again(s, moment.what, arguments, amount);
        const enum paper_status end = paper_history_change_end(s->sheet, status == PAPER_OK);
        status = status == PAPER_OK ? end : status;
    }
    paper_history_arguments_free(moment.what, arguments);
    return change_made(s, status);
}

enum paper_status studio_session_way(struct studio_session *s)
{
    struct span span = {-1, -1, -1};
    struct paper_moment moment;
    const enum paper_status status = deed_choose(s, &span);
    if (status != PAPER_OK)
        return status;
    paper_history_moment(s->sheet, span.itself, &moment);
    if (strcmp(moment.what, "stroke") != 0)
        return studio_session_failed(PAPER_BAD_ARGUMENT,
                                     "only a stroke can have another way (this is a %s)",
                                     moment.what);
    s->way = span.itself;
    return PAPER_OK;
}

bool studio_session_way_waits(const struct studio_session *s)
{
    return s->way >= 0;
}

enum paper_status studio_session_way_end(struct studio_session *s)
{
    const int number = s->way;
    void *arguments = NULL;
    s->down = false;
    s->way = -1;
    enum paper_status status = paper_history_arguments(s->sheet, number, &arguments);
    if (status == PAPER_OK)
        status = studio_session_present(s);
    if (status == PAPER_OK)
        status = change_keep(s, number, true);
    if (status == PAPER_OK)
        status = paper_history_change_begin(s->sheet, number);
    if (status == PAPER_OK) {
        struct paper_stroke stroke = *(const struct paper_stroke *)arguments;
        stroke.samples = s->samples;
        stroke.samples_count = s->samples_count;
        status = paper_sheet_stroke(s->sheet, &stroke, NULL);
        const enum paper_status end = paper_history_change_end(s->sheet, status == PAPER_OK);
        status = status == PAPER_OK ? end : status;
    }
    paper_history_arguments_free("stroke", arguments);
    return change_made(s, status);
}
