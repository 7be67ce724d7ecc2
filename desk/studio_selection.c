/* studio_selection.c - see studio_selection.h. */
#include "studio_selection.h"

#include <arguments.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define APART 0.5 /* fibers between two corners of a lasso */

/* ---- outlines ---- */

int studio_outline_points(enum studio_outline outline, double x1, double y1, double x2,
                          double y2, double *points)
{
    if (outline != STUDIO_OUTLINE_ELLIPSE) {
        const double corners[8] = {x1, y1, x2, y1, x2, y2, x1, y2};
        memcpy(points, corners, sizeof corners);
        return 4;
    }
    for (int i = 0; i < STUDIO_OUTLINE_CORNERS; i++) {
        const double angle = 2 * PI * i / STUDIO_OUTLINE_CORNERS;
        points[2 * i] = (x1 + x2) / 2 + (x2 - x1) / 2 * cos(angle);
        points[2 * i + 1] = (y1 + y2) / 2 + (y2 - y1) / 2 * sin(angle);
    }
    return STUDIO_OUTLINE_CORNERS;
}

/* Leaves out what is nearer than `apart` to the one before. */
static int points_thin(const double *from, int count, double apart, double *to)
{
    int left = 0;
    for (int i = 0; i < count; i++) {
        if (left > 0 &&
            hypot(from[2 * i] - to[2 * left - 2], from[2 * i + 1] - to[2 * left - 1]) < apart)
            continue;
        to[2 * left] = from[2 * i];
        to[2 * left + 1] = from[2 * i + 1];
        left++;
    }
    return left;
}

int studio_lasso_points(const double *samples, int count, double *points)
{
    int left = points_thin(samples, count, APART, points);
    for (double apart = 2 * APART; left > STUDIO_LASSO_CORNERS; apart *= 2)
        left = points_thin(points, left, apart, points);
    return left;
}

/* ---- around an outline ---- */

enum paper_status studio_around_make(const double *points, int count,
                                     const struct paper_sheet_config *config,
                                     struct studio_around *out)
{
    struct event_bytes bytes = {0};
    double area = 0;
    *out = (struct studio_around){0};
    for (int i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        area += a[0] * b[1] - b[0] * a[1];
    }
    if (count < 3 || fabs(area) < 2)
        return PAPER_OK;
    paper_drawing_polygon(&bytes, points, count);
    paper_drawing_number(&bytes, '-', 1, true);
    out->drawing = (struct paper_drawing){bytes.at, bytes.count, 1};
    if (bytes.short_of_memory)
        return PAPER_NO_MEMORY;
    const enum paper_status status = paper_drawing_screen(
        &out->drawing, 1, config->width, config->height, &out->screen, &out->x, &out->y);
    const size_t fibers = (size_t)out->screen.width_px * (size_t)out->screen.height_px;
    size_t covered = 0;
    while (covered < fibers && out->screen.gray[covered] == 255)
        covered++;
    if (covered == fibers) /* nothing of the outline is on the sheet */
        paper_screen_destroy(&out->screen);
    out->screen.drawing = &out->drawing;
    return status;
}

void studio_around_free(struct studio_around *around)
{
    paper_screen_destroy(&around->screen);
    free(around->drawing.bytes);
    *around = (struct studio_around){0};
}

/* ---- what the history says ---- */

static bool planes_there(struct studio_selection *s, size_t fibers)
{
    s->fluid = s->fluid ? s->fluid : calloc(fibers, 1);
    s->frisket = s->frisket ? s->frisket : calloc(fibers, 1);
    return s->fluid && s->frisket;
}

static void nothing_selected(struct studio_selection *s)
{
    free(s->points);
    s->points = NULL;
    s->points_count = 0;
}

/* Fluid is painted on through a gray, or rubbed off. */
static void gray_take(uint8_t *plane, int gray, bool on)
{
    if (on)
        *plane = gray > *plane ? (uint8_t)gray : *plane;
    else
        *plane = 255 - gray < *plane ? (uint8_t)(255 - gray) : *plane;
}

static void resist_take(struct studio_selection *s, const struct event_resist *resist,
                        const struct paper_sheet_config *config)
{
    const struct paper_screen *screen = resist->place.screen;
    const int left = screen ? resist->place.x : 0, top = screen ? resist->place.y : 0,
              right = screen ? left + screen->width_px : config->width,
              bottom = screen ? top + screen->height_px : config->height;
    double *points = NULL;
    int count = 0;
    const bool around = resist->on && screen && screen->drawing &&
                        paper_drawing_around(screen->drawing, &points, &count);
    if (around) {
        nothing_selected(s);
        s->points = points;
        s->points_count = count;
    }
    for (int y = top > 0 ? top : 0; y < bottom && y < config->height; y++)
        for (int x = left > 0 ? left : 0; x < right && x < config->width; x++) {
            const size_t at = (size_t)y * (size_t)config->width + (size_t)x;
            const int gray = screen
                                 ? screen->gray[(size_t)(y - top) * (size_t)screen->width_px +
                                                (size_t)(x - left)]
                                 : 255;
            if (!around)
                gray_take(&s->fluid[at], gray, resist->on);
            if (around || !resist->on)
                gray_take(&s->frisket[at], gray, resist->on);
        }
}

/* A script may have written the whole layer. */
static void layer_take(struct studio_selection *s, const struct event_layer *layer,
                       size_t fibers)
{
    for (size_t i = 0; i < fibers; i++)
        s->fluid[i] = (uint8_t)lrint(255 * fmin(1, fmax(0, (double)layer->values[i])));
    memset(s->frisket, 0, fibers);
}

/* Where nothing of the frisket is left, nothing is selected. */
static bool frisket_left(const struct studio_selection *s, size_t fibers)
{
    for (size_t i = 0; i < fibers; i++)
        if (s->frisket[i] > s->fluid[i])
            return true;
    return false;
}

static enum paper_status operation_take(struct studio_selection *s,
                                        const struct paper_sheet *sheet, int number,
                                        const char *what)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    const size_t fibers = (size_t)config->width * (size_t)config->height;
    void *arguments;
    enum paper_status status = paper_history_arguments(sheet, number, &arguments);
    if (status == PAPER_OK && !planes_there(s, fibers))
        status = PAPER_NO_MEMORY;
    if (status == PAPER_OK) {
        const struct event_layer *layer = arguments;
        if (strcmp(what, "resist") == 0)
            resist_take(s, arguments, config);
        else if (layer->layer == PAPER_LAYER_RESIST)
            layer_take(s, layer, fibers);
        if (!frisket_left(s, fibers))
            nothing_selected(s);
    }
    paper_history_arguments_free(what, arguments);
    return status;
}

enum paper_status studio_selection_look(struct studio_selection *s,
                                        const struct paper_sheet *sheet)
{
    const int done = paper_history_done(sheet);
    enum paper_status status = PAPER_OK;
    struct paper_moment moment;
    if (s->operations == 0 || s->operations > done)
        studio_selection_free(s);
    while (s->operations < done && status == PAPER_OK) {
        if (paper_history_moment(sheet, s->operations, &moment) &&
            (strcmp(moment.what, "resist") == 0 || strcmp(moment.what, "layer") == 0))
            status = operation_take(s, sheet, s->operations, moment.what);
        s->operations += status == PAPER_OK;
    }
    return status;
}

void studio_selection_free(struct studio_selection *s)
{
    free(s->points);
    free(s->fluid);
    free(s->frisket);
    *s = (struct studio_selection){0};
}

void studio_selection_clip(const struct studio_selection *s, int width, int height,
                           struct paper_screen *screen, int x, int y)
{
    for (int row = 0; row < screen->height_px; row++)
        for (int column = 0; column < screen->width_px; column++) {
            const int at_x = x + column, at_y = y + row;
            uint8_t *gray =
                &screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column];
            if (at_x >= 0 && at_y >= 0 && at_x < width && at_y < height)
                *gray = (uint8_t)paper_gray_join(
                    '-', *gray, s->frisket[(size_t)at_y * (size_t)width + (size_t)at_x]);
        }
}
