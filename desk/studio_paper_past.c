/* studio_paper_past.c - the past as the window shows it: deeds with small pictures; and how far
 * the past has flowed anew. */
#include "studio_film.h"
#include "studio_paper_internal.h"
#include "studio_session_internal.h"

#include <array.h>
#include <input.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONG_S 0.2    /* what takes less is not told */
#define TELL_S 0.03   /* between two reports of a past that flows anew */
#define PICTURE_S 0.5 /* between two small pictures of one deed */
enum { SAMPLES = 4 }; /* places each way that a pixel of a small picture is the mean of */

/* ---- flowing anew ---- */

/* Called by the paper while it computes again. */
static bool flow_watch(void *context, long done, long total)
{
    struct studio_paper *p = context;
    const double now_s = input_now_s();
    const bool stop = atomic_load(&p->stop),
               other = p->looking && studio_messages_waiting(&p->messages);
    p->interrupted = p->interrupted || stop || other;
    if (p->now.flow_total == 0)
        p->flow_told_s = now_s + LONG_S - TELL_S;
    p->now.flow_done = done;
    p->now.flow_total = total;
    if (now_s - p->flow_told_s > TELL_S) {
        p->flow_told_s = now_s;
        pthread_mutex_lock(&p->lock);
        p->report.flow_done = done;
        p->report.flow_total = total;
        pthread_mutex_unlock(&p->lock);
        p->def.wake(p->def.context);
    }
    return !stop && !other;
}

void studio_paper_flow_watch(struct studio_paper *p)
{
    paper_history_set_watch(studio_session_sheet(p->session), flow_watch, p);
}

void studio_paper_flowed(struct studio_paper *p, bool good)
{
    p->looking = false;
    p->now.flow_done = p->now.flow_total = 0;
    if (good) {
        p->flows = p->now.stopped = false;
        return;
    }
    p->view_other = true; /* what was not seen is looked at with the next change */
    if (atomic_exchange(&p->stop, false))
        p->now.stopped = true;
    else
        p->dirty = true; /* first the message that came */
}

enum paper_status studio_paper_film(struct studio_paper *p, const char *path, double seconds,
                                    char *written, size_t room)
{
    const struct paper_sheet_view view = studio_session_view(p->session);
    const struct studio_film_def def = {.path = path,
                                        .view = &view,
                                        .seconds_most = seconds,
                                        .watch = flow_watch,
                                        .context = p};
    p->looking = p->interrupted = false;
    atomic_store(&p->stop, false);
    pthread_mutex_lock(&p->lock);
    p->report.films = p->now.films = true;
    pthread_mutex_unlock(&p->lock);
    const enum paper_status status =
        studio_film_write(studio_session_sheet(p->session), &def, written, room);
    atomic_store(&p->stop, false);
    p->now.films = p->interrupted = false;
    p->now.flow_done = p->now.flow_total = 0;
    return status;
}

/* ---- the list ---- */

static bool deeds_take(struct studio_paper *p, const struct studio_deed *deeds, int count)
{
    const int before = p->past.count;
    if (!array_reserve(&p->past.deeds, &p->past_capacity, count, sizeof *p->past.deeds))
        return false;
    for (int i = before; i < count; i++)
        p->past.deeds[i].pictured = false;
    for (int i = 0; i < count; i++) {
        struct studio_past_deed *to = &p->past.deeds[i];
        snprintf(to->what, sizeof to->what, "%s", deeds[i].what);
        to->time = deeds[i].time;
        to->steps = deeds[i].steps;
        to->marked = deeds[i].marked;
        memcpy(to->name, deeds[i].name, sizeof to->name);
    }
    p->past.count = count;
    return true;
}

void studio_paper_past_look(struct studio_paper *p)
{
    const struct paper_sheet *sheet = studio_session_sheet(p->session);
    const int done = paper_history_done(sheet), undone = paper_history_undone(sheet);
    struct studio_deed *deeds;
    int count;
    p->now.visits = studio_session_visits(p->session);
    p->now.inserts = studio_session_inserts(p->session);
    p->now.way = studio_session_way_waits(p->session);
    if (p->past_sheet == p->now.sheets && p->past_done == done && p->past_undone == undone)
        return;
    if (p->past_sheet != p->now.sheets)
        p->past.count = 0;
    p->past_sheet = p->now.sheets;
    p->past_done = done;
    p->past_undone = undone;
    if (studio_session_deeds(p->session, &deeds, &count) == PAPER_OK) {
        pthread_mutex_lock(&p->lock);
        deeds_take(p, deeds, count);
        pthread_mutex_unlock(&p->lock);
        p->now.deeds = count;
        p->now.deeds_done = studio_session_deeds_done(p->session);
        p->now.past++;
    }
    free(deeds);
}

/* ---- small pictures ---- */

static void picture_take(const struct studio_pictures *from, uint8_t *rgb)
{
    for (int y = 0; y < STUDIO_SMALL_HEIGHT; y++)
        for (int x = 0; x < STUDIO_SMALL_WIDTH; x++, rgb += 3) {
            unsigned sum[3] = {0, 0, 0};
            for (int k = 0; k < SAMPLES * SAMPLES; k++) {
                const int column = SAMPLES * x + k % SAMPLES, row = SAMPLES * y + k / SAMPLES;
                const size_t i = (size_t)((2 * column + 1) * from->width /
                                          (2 * SAMPLES * STUDIO_SMALL_WIDTH)),
                             j = (size_t)((2 * row + 1) * from->height /
                                          (2 * SAMPLES * STUDIO_SMALL_HEIGHT));
                const uint8_t *pixel =
                    from->canvas + STUDIO_PIXEL * (j * (size_t)from->width + i);
                for (int c = 0; c < 3; c++)
                    sum[c] += pixel[c];
            }
            for (int c = 0; c < 3; c++)
                rgb[c] = (uint8_t)(sum[c] / (SAMPLES * SAMPLES));
        }
}

void studio_paper_pictured(struct studio_paper *p)
{
    studio_paper_past_look(p);
    const double now_s = input_now_s();
    const int done = p->now.deeds_done;
    if (done == 0 || done > p->past.count || studio_session_busy(p->session))
        return;
    struct studio_past_deed *deed = &p->past.deeds[done - 1];
    if (deed->pictured && now_s - p->pictured_s < PICTURE_S)
        return;
    p->pictured_s = now_s;
    pthread_mutex_lock(&p->lock);
    picture_take(p->pictures, deed->rgb);
    deed->pictured = true;
    pthread_mutex_unlock(&p->lock);
    p->now.past++;
}

void studio_paper_past_forget(struct studio_paper *p, int from)
{
    for (int i = from > 0 ? from : 0; i < p->past.count; i++)
        p->past.deeds[i].pictured = false;
}

/* ---- the window's side ---- */

void studio_paper_stop(struct studio_paper *p)
{
    atomic_store(&p->stop, true);
}

bool studio_paper_past(struct studio_paper *p, struct studio_past *past)
{
    pthread_mutex_lock(&p->lock);
    struct studio_past_deed *deeds =
        realloc(past->deeds, ((size_t)p->past.count + 1) * sizeof *deeds);
    if (deeds) {
        if (p->past.count) /* else there may be no deeds to copy from */
            memcpy(deeds, p->past.deeds, (size_t)p->past.count * sizeof *deeds);
        *past = (struct studio_past){p->past.count, deeds};
    }
    pthread_mutex_unlock(&p->lock);
    return deeds != NULL;
}
