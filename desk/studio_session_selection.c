/* studio_session_selection.c - what a hand selects, and what of its tools stays inside:
 * brushes, washes and all that is put heed the masking fluid around a selection; these here do
 * not. */
#include "studio_session_internal.h"

#include <stdlib.h>
#include <string.h>

static enum paper_status selection_look(struct studio_session *s)
{
    const enum paper_status status = studio_selection_look(&s->selection, s->sheet);
    return status == PAPER_NO_MEMORY
               ? studio_session_failed(status, "no memory for a selection")
               : status;
}

const double *studio_session_selected(struct studio_session *s, int *count)
{
    const enum paper_status status = selection_look(s);
    *count = status == PAPER_OK ? s->selection.points_count : 0;
    return status == PAPER_OK ? s->selection.points : NULL;
}

/* All of the frisket is rubbed off, and of the fluid that a hand has painted nothing. */
static enum paper_status frisket_off(struct studio_session *s)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const size_t fibers = (size_t)config->width * (size_t)config->height;
    size_t free_fibers = 0;
    while (free_fibers < fibers && s->selection.fluid[free_fibers] == 0)
        free_fibers++;
    if (free_fibers == fibers)
        return paper_sheet_resist(s->sheet, NULL, 0, 0, false);
    const struct paper_screen screen = {
        .width_px = config->width, .height_px = config->height, .gray = malloc(fibers)};
    if (!screen.gray)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a selection");
    for (size_t i = 0; i < fibers; i++)
        screen.gray[i] = (uint8_t)(255 - s->selection.fluid[i]);
    const enum paper_status status = paper_sheet_resist(s->sheet, &screen, 0, 0, false);
    free(screen.gray);
    return status;
}

/* What was around the selection of before, and is not around that of now, is rubbed off. */
static enum paper_status frisket_off_but(struct studio_session *s,
                                         const struct studio_around *around)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const size_t fibers = (size_t)config->width * (size_t)config->height;
    const struct paper_screen *stays = &around->screen;
    const struct paper_screen screen = {
        .width_px = config->width, .height_px = config->height, .gray = malloc(fibers)};
    if (!screen.gray)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a selection");
    for (size_t i = 0; i < fibers; i++)
        screen.gray[i] = (uint8_t)(255 - s->selection.fluid[i]);
    for (int y = 0; y < stays->height_px; y++)
        for (int x = 0; x < stays->width_px; x++) {
            const int gray = 255 - stays->gray[(size_t)y * (size_t)stays->width_px + (size_t)x];
            uint8_t *at = &screen.gray[(size_t)(y + around->y) * (size_t)config->width +
                                       (size_t)(x + around->x)];
            *at = gray < *at ? (uint8_t)gray : *at;
        }
    const enum paper_status status = paper_sheet_resist(s->sheet, &screen, 0, 0, false);
    free(screen.gray);
    return status;
}

static enum paper_status select_points(struct studio_session *s, enum studio_join join,
                                       const double *points, int count)
{
    struct studio_around around;
    enum paper_status status = selection_look(s);
    if (status != PAPER_OK)
        return status;
    const bool before = s->selection.points != NULL;
    status = studio_around_make(&s->selection, join, points, count,
                                paper_sheet_get_config(s->sheet), &around);
    if (status == PAPER_NO_MEMORY)
        studio_session_failed(status, "no memory for a selection");
    if (status == PAPER_BAD_ARGUMENT && around.drawing.count > PAPER_DRAWING_MOST)
        studio_session_failed(status, "what is selected has too many corners by now; select "
                                      "it anew, as fewer parts");
    if (status == PAPER_OK && around.screen.gray) {
        status = paper_sheet_resist(s->sheet, &around.screen, around.x, around.y, true);
        if (status == PAPER_OK && before)
            status = frisket_off_but(s, &around);
    } else if (status == PAPER_OK && before &&
               (around.drawing.count > 0 || join == STUDIO_JOIN_NEW))
        status = frisket_off(s); /* all of the sheet is selected, or nothing */
    studio_around_free(&around);
    return status;
}

enum paper_status studio_session_select(struct studio_session *s)
{
    const struct paper_stroke_sample *first = &s->samples[0],
                                     *last = &s->samples[s->samples_count - 1];
    const enum studio_outline outline = (enum studio_outline)s->at.value[STUDIO_OUTLINE];
    const enum studio_join join = (enum studio_join)s->at.value[STUDIO_JOIN];
    double corners[2 * STUDIO_OUTLINE_CORNERS];
    if (outline != STUDIO_OUTLINE_LASSO)
        return select_points(
            s, join, corners,
            studio_outline_points(outline, first->x, first->y, last->x, last->y, corners));
    double *points = malloc(2 * (size_t)s->samples_count * sizeof *points);
    if (!points)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a selection");
    for (int i = 0; i < s->samples_count; i++) {
        points[2 * i] = s->samples[i].x;
        points[2 * i + 1] = s->samples[i].y;
    }
    const enum paper_status status =
        select_points(s, join, points, studio_lasso_points(points, s->samples_count, points));
    free(points);
    return status;
}

enum paper_status studio_session_select_none(struct studio_session *s)
{
    int count;
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    if (!studio_session_selected(s, &count))
        return PAPER_OK;
    const enum paper_status status = studio_session_insert(s);
    return studio_session_deed_done(s, status == PAPER_OK ? frisket_off(s) : status);
}

enum paper_status studio_session_select_invert(struct studio_session *s)
{
    int count;
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    if (!studio_session_selected(s, &count))
        return PAPER_OK;
    enum paper_status status = studio_session_insert(s);
    const int before = paper_history_done(s->sheet);
    if (status == PAPER_OK)
        status = select_points(s, STUDIO_JOIN_INVERT, NULL, 0);
    if (status != PAPER_OK && paper_history_done(s->sheet) > before) { /* a half of it */
        paper_history_undo(s->sheet, paper_history_done(s->sheet) - before);
        studio_session_selection_forget(s);
    }
    return studio_session_deed_done(s, status);
}

const int *studio_session_selected_loops(const struct studio_session *s, int *count)
{
    *count = s->selection.loops;
    return s->selection.ends;
}

enum paper_status studio_session_selection_clip(struct studio_session *s,
                                                struct paper_screen *screen, int x, int y)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const enum paper_status status = selection_look(s);
    if (status == PAPER_OK && s->selection.points)
        studio_selection_clip(&s->selection, config->width, config->height, screen, x, y);
    return status;
}

enum paper_status studio_session_selection_place(struct studio_session *s,
                                                 struct paper_screen *screen,
                                                 struct paper_place *place)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const size_t fibers = (size_t)config->width * (size_t)config->height;
    int count;
    *screen = (struct paper_screen){0};
    *place = (struct paper_place){0};
    if (!studio_session_selected(s, &count))
        return PAPER_OK;
    screen->gray = malloc(fibers);
    if (!screen->gray)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a selection");
    screen->width_px = config->width;
    screen->height_px = config->height;
    memset(screen->gray, 255, fibers);
    place->screen = screen;
    return studio_session_selection_clip(s, screen, 0, 0);
}
