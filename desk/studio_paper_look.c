/* studio_paper_look.c - pictures of what has changed, and what is shown over them; failures. */
#include "studio_paper_internal.h"
#include "studio_session_internal.h"

#include <picture.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void studio_paper_complain(struct studio_paper *p)
{
    snprintf(p->now.error, sizeof p->now.error, "%s", studio_session_error());
    p->now.errors++;
}

/* ---- pictures ---- */

/* Copies an area of the picture to the canvas; where it is another one there. */
static struct studio_rectangle canvas_fill(struct studio_pictures *pictures, const uint8_t *rgb,
                                           const struct paper_area *area)
{
    struct studio_rectangle changed = {0};
    for (int y = area->y; y < area->y + area->height; y++) {
        const size_t at = (size_t)y * (size_t)pictures->width + (size_t)area->x;
        const uint8_t *from = rgb + 3 * at;
        uint8_t *to = pictures->canvas + STUDIO_PIXEL * at;
        int first = pictures->width, last = -1;
        for (int x = area->x; x < area->x + area->width; x++, from += 3, to += STUDIO_PIXEL) {
            const uint8_t now[STUDIO_PIXEL] = {from[0], from[1], from[2], 255};
            if (memcmp(to, now, sizeof now) == 0)
                continue;
            memcpy(to, now, sizeof now);
            first = x < first ? x : first;
            last = x;
        }
        if (last >= 0)
            changed = studio_rectangle_join(
                changed, (struct studio_rectangle){first, y, last + 1, y + 1});
    }
    return changed;
}

/* The number of the last message that can be seen: of a stroke that grows the newest samples
 * are not painted yet, and of another deed nothing is before the hand is lifted. */
static unsigned long seen_of(const struct studio_paper *p)
{
    if (!studio_session_busy(p->session))
        return p->heard;
    return studio_session_grows(p->session) ? p->points[0] : p->before_hand;
}

void studio_paper_look(struct studio_paper *p)
{
    const struct paper_sheet_view view = studio_session_view(p->session);
    struct paper_sheet *sheet = studio_session_sheet(p->session);
    struct paper_area areas[PAPER_AREAS_MAX];
    struct studio_rectangle changed = {0};
    const int width = p->pictures->width;
    p->looking = true;
    p->interrupted = false;
    int count = paper_sheet_changed(sheet, areas);
    if (p->view_other) {
        areas[0] = (struct paper_area){0, 0, width, p->pictures->height};
        count = 1;
    }
    p->dirty = p->view_other = false;
    for (int i = 0; i < count; i++) {
        const size_t at = (size_t)areas[i].y * (size_t)width + (size_t)areas[i].x;
        if (paper_sheet_view_area(sheet, &view, &areas[i], p->view + 3 * at,
                                  3 * (size_t)width) != PAPER_OK) {
            if (!p->interrupted)
                studio_paper_complain(p);
            p->view_other = true; /* what was not seen is looked at with the next change */
            break;
        }
        changed = studio_rectangle_join(changed, canvas_fill(p->pictures, p->view, &areas[i]));
    }
    studio_paper_flowed(p, !p->view_other || !p->interrupted);
    if (p->view_other && p->interrupted)
        return; /* the old picture is seen until the new one is whole */
    studio_pictures_publish(p->pictures, &changed, seen_of(p));
    studio_paper_pictured(p);
    if (p->shown_ends)
        studio_paper_show(p, &(struct studio_shown){0});
    p->def.wake(p->def.context);
}

/* ---- the outline of what is selected ---- */

static bool outline_same(const struct studio_outlined *a, const struct studio_outlined *b)
{
    return a->count == b->count && a->loops == b->loops &&
           (a->count == 0 ||
            memcmp(a->points, b->points, 2 * (size_t)a->count * sizeof *a->points) == 0) &&
           (a->loops == 0 || memcmp(a->ends, b->ends, (size_t)a->loops * sizeof *a->ends) == 0);
}

/* False: no memory. */
static bool outline_copy(const struct studio_outlined *from, struct studio_outlined *to)
{
    const size_t points = 2 * (size_t)from->count * sizeof *from->points,
                 ends = (size_t)from->loops * sizeof *from->ends;
    *to = (struct studio_outlined){from->count, malloc(points + 1), from->loops,
                                   malloc(ends + 1)};
    if (!to->points || !to->ends) {
        studio_outlined_free(to);
        return false;
    }
    if (points > 0)
        memcpy(to->points, from->points, points);
    if (ends > 0)
        memcpy(to->ends, from->ends, ends);
    return true;
}

void studio_outlined_free(struct studio_outlined *outline)
{
    free(outline->points);
    free(outline->ends);
    *outline = (struct studio_outlined){0};
}

void studio_paper_outline_look(struct studio_paper *p)
{
    int count, loops;
    const double *points = studio_session_selected(p->session, &count);
    const int *ends = studio_session_selected_loops(p->session, &loops);
    const struct studio_outlined now = {points ? count : 0, (double *)(uintptr_t)points,
                                        points ? loops : 0, (int *)(uintptr_t)ends};
    struct studio_outlined made = {0};
    p->now.selected = points != NULL;
    if (outline_same(&now, &p->outline) || !outline_copy(&now, &made))
        return;
    pthread_mutex_lock(&p->lock);
    studio_outlined_free(&p->outline);
    p->outline = made;
    pthread_mutex_unlock(&p->lock);
    p->now.outlines++;
}

bool studio_paper_outline(struct studio_paper *p, struct studio_outlined *outline)
{
    pthread_mutex_lock(&p->lock);
    struct studio_outlined made;
    const bool good = outline_copy(&p->outline, &made);
    pthread_mutex_unlock(&p->lock);
    if (good) {
        studio_outlined_free(outline);
        *outline = made;
    }
    return good;
}

/* ---- what is shown as it would be ---- */

void studio_paper_show(struct studio_paper *p, const struct studio_shown *shown)
{
    p->shown_ends = !shown->gray && p->dirty;
    if (!p->shown_ends) /* what was let into the paper is seen until the paper is, with it */
        studio_paper_show_now(p, shown);
}

void studio_paper_show_now(struct studio_paper *p, const struct studio_shown *shown)
{
    pthread_mutex_lock(&p->lock);
    uint8_t *before = (uint8_t *)(uintptr_t)p->shown.gray;
    p->shown = *shown;
    p->shown_new = true;
    pthread_mutex_unlock(&p->lock);
    free(before);
    p->def.wake(p->def.context);
}

/* A picture that is wanted again stays as it was read. */
static enum paper_status stamp_have(struct studio_paper *p, const char *path, bool anew)
{
    struct studio_stamp read;
    if (!anew && p->stamp.path && strcmp(p->stamp.path, path) == 0)
        return PAPER_OK;
    const enum paper_status status = studio_stamp_read(path, &read);
    if (status != PAPER_OK)
        return status;
    studio_stamp_free(&p->stamp);
    p->stamp = read;
    return PAPER_OK;
}

enum paper_status studio_paper_stamp(struct studio_paper *p, const struct studio_message *m)
{
    struct studio_printed printed = {0};
    enum paper_status status = m->text[0] ? stamp_have(p, m->text, m->value != 0) : PAPER_OK;
    if (m->kind == STUDIO_MESSAGE_STAMP)
        return status == PAPER_OK
                   ? studio_session_stamp(p->session, &p->stamp, m->type_x, m->type_y)
                   : status;
    if (status == PAPER_OK && m->text[0])
        status = studio_stamp_place(&p->stamp, studio_session_settings(p->session), 0, 0, NULL,
                                    &printed);
    const struct studio_shown shown = {printed.x, printed.y, printed.screen.width_px,
                                       printed.screen.height_px, printed.screen.gray};
    printed.screen.gray = NULL; /* which is the window's now */
    studio_printed_free(&printed);
    studio_paper_show(p, &shown);
    return status;
}
