/* studio_paper.c - see studio_paper.h.
 *
 *     take messages -> do them -> steps that are due -> a picture, if the last one has been looked at -> wait
 *
 * The hand comes first: no more than STEPS_AT_ONCE steps are done between two looks at the
 * messages. Steps that the machine is too slow for are left out, so that time on the paper
 * never runs after the hand. */
#include "studio_paper_internal.h"
#include "studio_session_internal.h"

#include <array.h>
#include <input.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STEPS_AT_ONCE = 2 };
#define LATE_MOST 2.0  /* steps that may be due */
#define REST_S 0.25    /* between looks while nothing happens */
#define UNSEEN_S 0.004 /* until a picture is looked at */
#define HEAR_S 0.02    /* of messages, then a picture */
#define STILL_S 0.05   /* a hand that is not heard for so long rests */
#define PACE_LEAST 5.0 /* steps a second of a stroke */
#define PACE_SHARE 0.7 /* of the time goes to a stroke, the rest to pictures */

/* ---- telling ---- */

static void report_make(struct studio_paper *p)
{
    struct studio_report *r = &p->now;
    if (p->kept && studio_keeper_failed(&p->keeper, r->error, sizeof r->error))
        r->errors++;
    r->ready = p->session != NULL;
    r->looked = !p->dirty && !p->flows;
    if (p->session) {
        struct paper_sheet *sheet = studio_session_sheet(p->session);
        r->can_undo = studio_session_can_undo(p->session);
        r->can_redo = studio_session_can_redo(p->session);
        r->held = studio_session_held(p->session);
        r->wet = studio_session_wet(p->session);
        r->steps = paper_sheet_steps(sheet);
        r->operations = paper_history_done(sheet);
        r->history_bytes = paper_history_bytes(sheet);
        studio_paper_past_look(p);
        studio_paper_outline_look(p);
    }
    r->budget_bytes = p->def.budget_bytes;
    pthread_mutex_lock(&p->lock);
    const bool other = memcmp(&p->report, r, sizeof *r) != 0;
    if (other)
        p->report = *r;
    pthread_mutex_unlock(&p->lock);
    if (other)
        p->def.wake(p->def.context);
}

/* ---- messages ---- */

/* What the hand must have finished before. */
static bool needs_rest(enum studio_message_kind kind)
{
    return kind == STUDIO_MESSAGE_CARE || kind == STUDIO_MESSAGE_DRY ||
           kind == STUDIO_MESSAGE_SEAL || kind == STUDIO_MESSAGE_SELECT_NONE ||
           kind == STUDIO_MESSAGE_SELECT_INVERT || kind == STUDIO_MESSAGE_TYPE ||
           kind == STUDIO_MESSAGE_SCREEN || kind == STUDIO_MESSAGE_STAMP ||
           kind == STUDIO_MESSAGE_NEW || kind == STUDIO_MESSAGE_OPEN ||
           kind == STUDIO_MESSAGE_SAVE || kind == STUDIO_MESSAGE_PICTURE ||
           kind == STUDIO_MESSAGE_SCRIPT || kind == STUDIO_MESSAGE_FILM ||
           (kind >= STUDIO_MESSAGE_VISIT && kind <= STUDIO_MESSAGE_WAY);
}

static void note(struct studio_paper *p, bool other, const char *path)
{
    snprintf(p->now.note, sizeof p->now.note, "%s", path);
    p->now.note_other = other;
    p->now.notes++;
}

static enum paper_status save(struct studio_paper *p, const struct studio_message *m)
{
    enum paper_status status = PAPER_OK;
    if (m->kind != STUDIO_MESSAGE_PICTURE && studio_session_visits(p->session)) {
        status = studio_session_present(p->session); /* all of the past is saved */
        p->dirty = p->flows = true;
    }
    if (status != PAPER_OK)
        return status;
    if (m->kind == STUDIO_MESSAGE_FILM) {
        char written[STUDIO_TEXT_MAX];
        status = studio_paper_film(p, m->text, m->value, written, sizeof written);
        if (status == PAPER_OK)
            note(p, true, written);
        return status;
    }
    if (m->kind == STUDIO_MESSAGE_PICTURE || m->kind == STUDIO_MESSAGE_SCRIPT) {
        status = m->kind == STUDIO_MESSAGE_SCRIPT
                     ? studio_session_script(p->session, m->text)
                     : studio_session_picture(p->session, m->text, (int)m->value);
        if (status == PAPER_OK)
            note(p, true, m->text);
        return status;
    }
    if (studio_paper_held(p, m->text))
        return PAPER_BAD_ARGUMENT;
    status = studio_session_save(p->session, m->text);
    if (status == PAPER_OK) {
        snprintf(p->now.path, sizeof p->now.path, "%s", m->text);
        p->now.changed = false;
        studio_paper_journal(p, m->text, NULL, NULL);
        note(p, false, m->text);
    }
    return status;
}

static struct studio_type type_of(const struct studio_message *m)
{
    return (struct studio_type){m->text, m->font, m->features, m->type_x, m->type_y};
}

static enum paper_status type_show(struct studio_paper *p, const struct studio_message *m)
{
    struct paper_screen screen = {0};
    struct studio_shown shown = {0};
    uint32_t missing;
    const struct studio_type type = type_of(m);
    enum paper_status status = PAPER_OK;
    if (m->text[strspn(m->text, " \n\t")])
        status = studio_session_type_screen(studio_session_settings(p->session), &type, &screen,
                                            &shown.x, &shown.y, &missing);
    if (status == PAPER_BAD_TEXT)
        status = PAPER_OK; /* nothing to be seen yet */
    shown.width = screen.width_px;
    shown.height = screen.height_px;
    shown.gray = screen.gray; /* which is the window's now */
    studio_paper_show(p, &shown);
    return status;
}

/* How many steps a second strokes may ask for follows from what they took. */
static void stroke_measure(struct studio_paper *p)
{
    const int steps = studio_session_stroke_steps(p->session);
    if (steps >= 10 && p->worked_s > 0)
        studio_session_pace_most(p->session,
                                 fmax(PACE_LEAST, PACE_SHARE * steps / p->worked_s));
}

static enum paper_status point_do(struct studio_paper *p, const struct studio_message *m)
{
    const double began_s = input_now_s();
    if (m->point.kind == STUDIO_POINT_DOWN) {
        p->before_hand = m->number - 1;
        p->worked_s = 0;
        for (int i = 0; i < POINTS_UNSEEN; i++)
            p->points[i] = m->number - 1;
    }
    for (int i = 0; i + 1 < POINTS_UNSEEN; i++)
        p->points[i] = p->points[i + 1];
    p->points[POINTS_UNSEEN - 1] = m->number;
    const bool way = studio_session_way_waits(p->session);
    const int deed = way ? studio_session_deeds_done(p->session) - 1 : 0;
    const enum paper_status status = studio_session_point(p->session, &m->point);
    if (way && !studio_session_way_waits(p->session)) { /* a stroke of the past has it */
        studio_paper_past_forget(p, deed);
        p->flows = true;
    }
    p->rested_s = input_now_s();
    p->worked_s += p->rested_s - began_s;
    if (m->point.kind == STUDIO_POINT_UP)
        stroke_measure(p);
    return status;
}

static enum paper_status past_do(struct studio_paper *p, const struct studio_message *m)
{
    struct studio_session *s = p->session;
    const int deed = studio_session_deeds_done(s) - 1;
    switch ((int)m->kind) {
    case STUDIO_MESSAGE_VISIT:
        return studio_session_visit(s, (int)m->value);
    case STUDIO_MESSAGE_PRESENT:
        studio_paper_past_forget(p, studio_session_inserts(s) ? deed : p->past.count);
        return studio_session_present(s);
    case STUDIO_MESSAGE_FROM_HERE:
        studio_session_from_here(s);
        return PAPER_OK;
    case STUDIO_MESSAGE_WAY:
        return studio_session_way(s);
    case STUDIO_MESSAGE_BOOKMARK:
        return m->text ? studio_session_bookmark_name(s, m->text) : studio_session_bookmark(s);
    case STUDIO_MESSAGE_BOOKMARK_VISIT:
        return studio_session_bookmark_visit(s, m->value != 0);
    default:
        studio_paper_past_forget(p, deed);
        return m->kind == STUDIO_MESSAGE_DISH ? studio_session_dish(s)
                                              : studio_session_remove(s);
    }
}

/* Small pictures from a deed on that is changed back, or again, are of before. */
static void undo_do(struct studio_paper *p, bool undo)
{
    struct studio_session *s = p->session;
    const bool changes =
        undo ? studio_session_change_waits(s) : studio_session_change_returns(s);
    if (changes && !studio_session_busy(s))
        studio_paper_past_forget(p, studio_session_change_deed(s));
    if (undo)
        studio_session_undo(s);
    else
        studio_session_redo(s);
}

static enum paper_status message_do(struct studio_paper *p, const struct studio_message *m)
{
    struct studio_session *s = p->session;
    const struct studio_type type = type_of(m);
    switch (m->kind) {
    case STUDIO_MESSAGE_POINT:
        return point_do(p, m);
    case STUDIO_MESSAGE_SET:
        if (m->setting == STUDIO_PAUSED && m->value == 0)
            studio_session_go_on(s);
        return studio_session_set(s, m->setting, m->value);
    case STUDIO_MESSAGE_CARE:
        return studio_session_care(s, (enum studio_care)m->setting);
    case STUDIO_MESSAGE_STEP:
        studio_session_go_on(s);
        return studio_session_steps(s, (int)m->value, NULL);
    case STUDIO_MESSAGE_GO_ON:
        studio_session_go_on(s);
        return PAPER_OK;
    case STUDIO_MESSAGE_UNDO:
    case STUDIO_MESSAGE_REDO:
        undo_do(p, m->kind == STUDIO_MESSAGE_UNDO);
        return PAPER_OK;
    case STUDIO_MESSAGE_VISIT:
    case STUDIO_MESSAGE_PRESENT:
    case STUDIO_MESSAGE_FROM_HERE:
    case STUDIO_MESSAGE_REMOVE:
    case STUDIO_MESSAGE_DISH:
    case STUDIO_MESSAGE_BOOKMARK:
    case STUDIO_MESSAGE_BOOKMARK_VISIT:
    case STUDIO_MESSAGE_WAY:
        return past_do(p, m);
    case STUDIO_MESSAGE_FLOW:
        return PAPER_OK;
    case STUDIO_MESSAGE_DRY:
        return studio_session_dry(s);
    case STUDIO_MESSAGE_SEAL:
        return studio_session_seal(s);
    case STUDIO_MESSAGE_SELECT_NONE:
        return studio_session_select_none(s);
    case STUDIO_MESSAGE_SELECT_INVERT:
        return studio_session_select_invert(s);
    case STUDIO_MESSAGE_TYPE:
        return studio_session_type(s, &type);
    case STUDIO_MESSAGE_TYPE_SHOW:
        return type_show(p, m);
    case STUDIO_MESSAGE_SCREEN:
        return studio_session_put(s, &m->screen, (int)m->type_x, (int)m->type_y);
    case STUDIO_MESSAGE_STAMP:
    case STUDIO_MESSAGE_STAMP_SHOW:
        return studio_paper_stamp(p, m);
    case STUDIO_MESSAGE_NEW:
        studio_paper_sheet_make(p, m->config);
        return PAPER_OK;
    case STUDIO_MESSAGE_OPEN:
        studio_paper_sheet_open(p, m->text, NULL);
        return PAPER_OK;
    case STUDIO_MESSAGE_SAVE:
    case STUDIO_MESSAGE_PICTURE:
    case STUDIO_MESSAGE_SCRIPT:
    case STUDIO_MESSAGE_FILM:
        return save(p, m);
    case STUDIO_MESSAGE_END:
        p->end = true;
        return PAPER_OK;
    }
    return PAPER_OK;
}

/* Whether it goes back or forth in the past, or changes it. */
static bool of_past(enum studio_message_kind kind)
{
    return kind >= STUDIO_MESSAGE_UNDO && kind <= STUDIO_MESSAGE_FLOW;
}

/* Whether the sheet is another one after it. */
static bool changes(const struct studio_message *m)
{
    return of_past(m->kind) || m->kind == STUDIO_MESSAGE_DRY ||
           m->kind == STUDIO_MESSAGE_SEAL || m->kind == STUDIO_MESSAGE_TYPE ||
           m->kind == STUDIO_MESSAGE_SELECT_NONE || m->kind == STUDIO_MESSAGE_SELECT_INVERT ||
           m->kind == STUDIO_MESSAGE_SCREEN || m->kind == STUDIO_MESSAGE_STAMP ||
           m->kind == STUDIO_MESSAGE_STEP || m->kind == STUDIO_MESSAGE_POINT;
}

static void message_hear(struct studio_paper *p, struct studio_message *m)
{
    if (p->session && needs_rest(m->kind) && studio_session_busy(p->session) &&
        array_reserve(&p->later, &p->later_capacity, p->later_count + 1, sizeof *p->later)) {
        p->later[p->later_count++] = *m;
        return;
    }
    studio_session_error_forget();
    p->heard = m->number;
    if (m->kind == STUDIO_MESSAGE_END) {
        p->end = true;
        p->forget = m->value != 0;
    } else if (p->session) {
        if (message_do(p, m) != PAPER_OK)
            studio_paper_complain(p);
        p->dirty = p->dirty || changes(m);
        p->flows =
            p->flows || (m->kind >= STUDIO_MESSAGE_UNDO && m->kind <= STUDIO_MESSAGE_FLOW);
        if (m->kind == STUDIO_MESSAGE_SET &&
            (m->setting == STUDIO_SHOW || m->setting == STUDIO_SHOWN))
            p->dirty = p->view_other = true;
        p->now.changed = p->now.changed || changes(m);
    }
    p->now.answered = m->number;
    p->now.flow_done = p->now.flow_total = 0;
    studio_message_free(m);
}

static void later_hear(struct studio_paper *p)
{
    if (studio_session_busy(p->session))
        return;
    for (int i = 0; i < p->later_count; i++)
        message_hear(p, &p->later[i]);
    p->later_count = 0;
}

static void messages_hear(struct studio_paper *p)
{
    struct studio_message m;
    const double until_s = input_now_s() + HEAR_S;
    while (!p->end && input_now_s() < until_s && studio_messages_take(&p->messages, &m)) {
        message_hear(p, &m);
        if (p->later_count > 0)
            later_hear(p);
        if (p->now.error[0] || m.kind == STUDIO_MESSAGE_SAVE)
            report_make(p);
        if (m.kind == STUDIO_MESSAGE_POINT && m.point.kind == STUDIO_POINT_UP)
            break; /* a deed is seen before the next one */
    }
}

/* ---- time ---- */

/* A hand that rests on the paper is told again, so that the paper goes on under it. */
static void rest(struct studio_paper *p, double now_s)
{
    if (!studio_session_grows(p->session) || now_s - p->rested_s < STILL_S)
        return;
    if (studio_session_rest(p->session, now_s - p->rested_s) != PAPER_OK)
        studio_paper_complain(p);
    p->rested_s = now_s;
    p->dirty = true;
}

static void time_go(struct studio_paper *p)
{
    const double *value = studio_session_settings(p->session)->value, now_s = input_now_s(),
                 gone_s = now_s - p->looked_s;
    int done = 0;
    p->looked_s = now_s;
    rest(p, now_s);
    if (p->flows || value[STUDIO_PAUSED] != 0 || studio_session_busy(p->session) ||
        studio_session_held(p->session) || !studio_session_wet(p->session)) {
        p->due = 0;
        return;
    }
    p->due = fmin(LATE_MOST, p->due + gone_s * value[STUDIO_PACE]);
    const int steps = (int)fmin(STEPS_AT_ONCE, floor(p->due));
    if (steps > 0 && studio_session_steps(p->session, steps, &done) != PAPER_OK) {
        studio_paper_complain(p);
        studio_session_set(p->session, STUDIO_PAUSED, 1); /* one line, not sixty a second */
    }
    p->due -= steps;
    p->dirty = p->dirty || done > 0;
}

static double wait_s(const struct studio_paper *p)
{
    const double *value = studio_session_settings(p->session)->value;
    if (p->dirty)
        return UNSEEN_S;
    if (studio_session_grows(p->session) && value[STUDIO_PAUSED] == 0)
        return STILL_S;
    if (p->flows || value[STUDIO_PAUSED] != 0 || studio_session_busy(p->session) ||
        studio_session_held(p->session) || !studio_session_wet(p->session))
        return REST_S;
    return fmax(0, (1 - p->due) / value[STUDIO_PACE]);
}

static void *paper_run(void *context)
{
    struct studio_paper *p = context;
    p->kept = studio_keeper_begin(&p->keeper);
    if (p->def.path || p->def.found)
        studio_paper_sheet_open(p, p->def.path, p->def.path ? NULL : p->def.found);
    if (!p->session && !p->def.path)
        studio_paper_sheet_make(p, &p->config);
    p->now.failed = !p->session;
    p->looked_s = input_now_s();
    report_make(p);
    while (!p->end) {
        messages_hear(p);
        if (p->session && !p->end) {
            time_go(p);
            if (p->dirty && studio_pictures_taken(p->pictures))
                studio_paper_look(p);
            report_make(p);
        }
        if (!p->end && !studio_messages_waiting(&p->messages))
            studio_messages_wait(&p->messages, p->session ? wait_s(p) : REST_S);
    }
    if (p->kept && (p->forget || !p->now.changed))
        studio_keeper_leave(&p->keeper);
    if (p->kept)
        studio_keeper_end(&p->keeper);
    studio_session_destroy(p->session);
    p->session = NULL;
    return NULL;
}

/* ---- the window's side ---- */

struct studio_paper *studio_paper_start(const struct studio_paper_def *def)
{
    struct studio_paper *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    p->def = *def;
    p->def.path = def->path ? strdup(def->path) : NULL;
    p->def.found = def->found ? strdup(def->found) : NULL;
    p->def.folder = def->folder ? strdup(def->folder) : NULL;
    if (def->config)
        p->config = *def->config;
    studio_messages_begin(&p->messages);
    pthread_mutex_init(&p->lock, NULL);
    p->started = pthread_create(&p->thread, NULL, paper_run, p) == 0;
    if (p->started)
        return p;
    studio_paper_end(p, false, NULL);
    return NULL;
}

void studio_paper_end(struct studio_paper *p, bool forget, struct studio_report *last)
{
    if (!p)
        return;
    if (p->started) {
        studio_messages_put(
            &p->messages, (struct studio_message){.kind = STUDIO_MESSAGE_END, .value = forget});
        while (p->messages.waiting_count > 0) {
            studio_messages_flush(&p->messages);
            sched_yield();
        }
        pthread_join(p->thread, NULL);
        if (last)
            *last = p->now;
    }
    if (p->looked && p->looked != p->pictures) {
        studio_pictures_finish(p->looked);
        free(p->looked);
    }
    if (p->pictures)
        studio_pictures_finish(p->pictures);
    free(p->pictures);
    for (int i = 0; i < p->later_count; i++)
        studio_message_free(&p->later[i]);
    free(p->later);
    studio_messages_finish(&p->messages);
    pthread_mutex_destroy(&p->lock);
    free((void *)(uintptr_t)p->shown.gray);
    free(p->shown_gray);
    free(p->view);
    free(p->past.deeds);
    studio_outlined_free(&p->outline);
    studio_stamp_free(&p->stamp);
    free((char *)(uintptr_t)p->def.path);
    free((char *)(uintptr_t)p->def.found);
    free((char *)(uintptr_t)p->def.folder);
    free(p);
}

unsigned long studio_paper_send(struct studio_paper *p, struct studio_message message)
{
    return studio_messages_put(&p->messages, message);
}

unsigned long studio_paper_sent(const struct studio_paper *p)
{
    return p->messages.numbered;
}

void studio_paper_flush(struct studio_paper *p)
{
    studio_messages_flush(&p->messages);
}

void studio_paper_report(struct studio_paper *p, struct studio_report *out)
{
    pthread_mutex_lock(&p->lock);
    *out = p->report;
    pthread_mutex_unlock(&p->lock);
}

const struct studio_picture *studio_paper_picture(struct studio_paper *p)
{
    pthread_mutex_lock(&p->lock);
    struct studio_pictures *before = p->looked;
    p->looked = p->pictures;
    pthread_mutex_unlock(&p->lock);
    if (before && before != p->looked) {
        studio_pictures_finish(before);
        free(before);
    }
    return p->looked ? studio_pictures_take(p->looked) : NULL;
}

bool studio_paper_shown(struct studio_paper *p, struct studio_shown *out)
{
    pthread_mutex_lock(&p->lock);
    const bool other = p->shown_new;
    if (other) {
        free(p->shown_gray);
        p->shown_gray = (uint8_t *)(uintptr_t)p->shown.gray;
        *out = p->shown;
        p->shown.gray = NULL;
        p->shown_new = false;
    }
    pthread_mutex_unlock(&p->lock);
    return other;
}
