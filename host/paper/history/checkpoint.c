/* checkpoint.c - copies of the whole sheet in the front end's memory, within a budget.
 *
 * A checkpoint is offered every CHECKPOINT_EVERY steps and operations: of steps that are done
 * in boxes, as many more as take as long, up to CHECKPOINT_SPARED times as many. What has not
 * changed is shared with the checkpoint before (tiles.h). When the budget is full, the
 * checkpoint is dropped whose neighbours are nearest to each other relative to their age. So
 * the recent past is kept in fine steps and the far past in coarse ones.
 */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

static size_t plane_words(const struct paper_sheet *p)
{
    return (size_t)p->page.grid.width * (size_t)p->page.grid.height;
}

static void point_free(struct sheet_history *h, struct checkpoint *point)
{
    planes_copy_drop(point->planes, &h->held_bytes);
    point->planes = NULL;
    free(point->extras.at);
    point->extras = (struct event_bytes){0};
}

/* What the planes are from now on known to have been. NULL: nobody knows. */
static void known_set(struct sheet_history *h, struct planes_copy *planes)
{
    planes_copy_share(planes);
    planes_copy_drop(h->known, &h->held_bytes);
    h->known = planes;
}

static void point_drop(struct sheet_history *h, int number)
{
    point_free(h, &h->points[number]);
    memmove(&h->points[number], &h->points[number + 1],
            (size_t)(h->points_count - number - 1) * sizeof *h->points);
    h->points_count--;
}

/* Drops a checkpoint. False: none can be dropped. */
static bool point_drop_least(struct sheet_history *h)
{
    int least = -1;
    double least_worth = 0;
    for (int i = 0; i < h->points_count; i++) {
        if (h->points[i].pinned)
            continue;
        long before = i > 0 ? h->points[i - 1].work : 0;
        long after = i + 1 < h->points_count ? h->points[i + 1].work : h->work;
        double worth =
            (double)(after - before) / (double)(labs(h->work - h->points[i].work) + 1);
        if (least < 0 || worth < least_worth) {
            least = i;
            least_worth = worth;
        }
    }
    if (least >= 0)
        point_drop(h, least);
    return least >= 0;
}

void checkpoints_drop_after(struct sheet_history *h, struct position position)
{
    while (h->points_count > 0 &&
           position_compare(h->points[h->points_count - 1].position, position) > 0)
        point_free(h, &h->points[--h->points_count]);
}

void checkpoints_free(struct sheet_history *h)
{
    checkpoints_drop_after(h, (struct position){-1, 0});
    checkpoint_saved_free(h);
    known_set(h, NULL);
}

const struct checkpoint *checkpoint_before(const struct sheet_history *h,
                                           struct position position)
{
    for (int i = h->points_count - 1; i >= 0; i--)
        if (position_compare(h->points[i].position, position) <= 0)
            return &h->points[i];
    return NULL;
}

/* ---- taking ---- */

/* The place of a checkpoint for the position, or -1 if there is one. */
static int place_find(const struct sheet_history *h, struct position position)
{
    int place = h->points_count;
    while (place > 0 && position_compare(h->points[place - 1].position, position) > 0)
        place--;
    if (place > 0 && position_compare(h->points[place - 1].position, position) == 0)
        return -1;
    return place;
}

/* Inserts a checkpoint. There must be room, and none at its position. */
static void point_insert(struct sheet_history *h, const struct checkpoint *point)
{
    int place = place_find(h, point->position);
    memmove(&h->points[place + 1], &h->points[place],
            (size_t)(h->points_count - place) * sizeof *h->points);
    h->points[place] = *point;
    h->points_count++;
}

/* Makes room for so many bytes. False: there is none, whatever is dropped. */
static bool room_make(const struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    while (h->points_count == CHECKPOINTS_MAX ||
           h->held_bytes + planes_copy_bytes(p, h->known) > h->budget_bytes) {
        if (point_drop_least(h))
            continue;
        if (!h->known || h->points_count == CHECKPOINTS_MAX)
            return false;
        known_set(h, NULL);
    }
    return true;
}

/* Fills the checkpoint from the sheet. False: failed. */
static bool point_fill(struct paper_sheet *p, struct checkpoint *point)
{
    struct sheet_history *h = p->history;
    point->planes = planes_copy_take(p, h->known, &h->held_bytes);
    if (point->planes && sheet_extras_encode(p, &point->extras) == PAPER_OK &&
        !point->extras.short_of_memory) {
        known_set(h, point->planes);
        return true;
    }
    known_set(h, point->planes);
    point_free(h, point);
    return false;
}

void checkpoint_offer(struct paper_sheet *p, bool now)
{
    struct sheet_history *h = p->history;
    if (h->at.op < 0 || place_find(h, h->at) < 0)
        return;
    const struct checkpoint *before = checkpoint_before(h, h->at);
    long since = h->work - (before ? before->work : 0);
    bool due = now ? since >= 1
                   : since >= CHECKPOINT_EVERY * CHECKPOINT_SPARED ||
                         (double)since - h->spared >= CHECKPOINT_EVERY;
    if (!due || !room_make(p))
        return;
    struct checkpoint point = {.position = h->at, .work = h->work, .air = p->air};
    h->spared = 0;
    if (point_fill(p, &point))
        point_insert(h, &point);
}

void checkpoint_reached(struct sheet_history *h, const struct checkpoint *point)
{
    h->points[point - h->points].pinned = false;
}

/* ---- giving back ---- */

enum paper_status checkpoint_restore(struct paper_sheet *p, const struct checkpoint *point)
{
    struct sheet_history *h = p->history;
    enum paper_status status = planes_copy_restore(p, point->planes, h->known);
    known_set(h, status == PAPER_OK ? point->planes : NULL);
    struct event_reader r = {point->extras.at, point->extras.at + point->extras.count, false};
    if (status == PAPER_OK)
        status = sheet_extras_decode(p, &r);
    p->air = point->air;
    h->at = point->position;
    h->work = point->work;
    h->spared = 0;
    return status;
}

enum paper_status planes_load(struct paper_sheet *p, paper_plane_source source, void *context)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    int count = paper_sheet_planes(p, planes);
    uint32_t *words = malloc(4 * plane_words(p));
    enum paper_status status = PAPER_OK;
    if (!words)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a saved sheet of %dx%d",
                          p->page.grid.width, p->page.grid.height);
    for (int i = 0; i < count && status == PAPER_OK; i++) {
        status = source(context, i, words);
        if (status == PAPER_OK)
            status = sheet_plane_check(p, i, words);
        if (status != PAPER_OK)
            break;
        sheet_change_all(p);
        sheet_plane_write(p, i, words);
        status = paper_leave(&p->page);
    }
    free(words);
    if (status != PAPER_OK)
        return status;
    sheet_change_all(p);
    sheet_planes_written(p);
    return paper_leave(&p->page);
}

enum paper_status checkpoint_pin(struct paper_sheet *p, paper_plane_source source,
                                 void *context, const struct paper_air *air,
                                 const struct event_reader *extras)
{
    struct sheet_history *h = p->history;
    struct paper_plane planes[PAPER_PLANES_MAX];
    const int count = paper_sheet_planes(p, planes);
    struct checkpoint *saved = malloc(sizeof *saved), point = {.air = *air, .pinned = true};
    uint32_t *words = malloc(4 * plane_words(p));
    point.planes = planes_copy_new(p, &h->held_bytes);
    enum paper_status status = PAPER_OK;
    bool room = saved && words && point.planes;
    for (int i = 0; i < count && status == PAPER_OK && room; i++) {
        status = source(context, i, words);
        if (status == PAPER_OK)
            status = sheet_plane_check(p, i, words);
        room = status != PAPER_OK || planes_copy_put(point.planes, i, words, &h->held_bytes);
    }
    free(words);
    if (!room)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a saved sheet of %dx%d",
                            p->page.grid.width, p->page.grid.height);
    event_put_bytes(&point.extras, extras->at, (size_t)(extras->end - extras->at));
    if (status == PAPER_OK && point.extras.short_of_memory)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a saved sheet's brushes");
    if (status != PAPER_OK) {
        point_free(h, &point);
        free(saved);
        return status;
    }
    *saved = point;
    h->saved = saved;
    return PAPER_OK;
}

void checkpoint_saved_place(struct sheet_history *h)
{
    int place = place_find(h, h->now);
    if (!h->saved)
        return;
    /* there is a checkpoint already, or all places are taken by pinned ones */
    if (place < 0 || (h->points_count == CHECKPOINTS_MAX && !point_drop_least(h))) {
        checkpoint_saved_free(h);
        return;
    }
    h->saved->position = h->now;
    h->saved->work = history_work(h, h->now);
    point_insert(h, h->saved);
    free(h->saved);
    h->saved = NULL;
}

void checkpoint_saved_free(struct sheet_history *h)
{
    if (h->saved)
        point_free(h, h->saved);
    free(h->saved);
    h->saved = NULL;
}
