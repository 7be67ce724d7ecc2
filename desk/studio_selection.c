/* studio_selection.c - see studio_selection.h. */
#include "studio_selection.h"

#include <arguments.h>
#include <array.h>

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

/* ---- around a selection ---- */

/* More than a click or a line, and something of the sheet is in its box. The triangles from the
 * first corner are counted whichever way round they are: a way that crosses itself has area. */
static bool polygon_selects(const double *points, int count,
                            const struct paper_sheet_config *config)
{
    double area = 0, left = HUGE_VAL, top = HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        area += fabs((a[0] - points[0]) * (b[1] - points[1]) -
                     (b[0] - points[0]) * (a[1] - points[1]));
        left = fmin(left, a[0]);
        right = fmax(right, a[0]);
        top = fmin(top, a[1]);
        bottom = fmax(bottom, a[1]);
    }
    return count >= 3 && area >= 2 && right > 0 && bottom > 0 && left < config->width &&
           top < config->height;
}

/* The polygon, in the numbers of the drawing that it is added to. */
static void polygon_put(struct event_bytes *b, const double *points, int count, double scale)
{
    double *scaled = malloc(2 * (size_t)count * sizeof *scaled);
    for (int i = 0; scaled && i < 2 * count; i++)
        scaled[i] = points[i] / scale;
    if (scaled)
        paper_drawing_polygon(b, scaled, count);
    b->short_of_memory = b->short_of_memory || !scaled;
    free(scaled);
}

/* What is selected then. */
static void joined_put(struct event_bytes *b, const struct paper_drawing *before,
                       enum studio_join join, const double *points, int count, double scale)
{
    const size_t within =
        join == STUDIO_JOIN_INVERT && before->count ? paper_drawing_within(before) : 0;
    if (within > 0) { /* turned back, and not twice around */
        paper_drawing_again(b, &(struct paper_drawing){before->bytes, within, scale});
        return;
    }
    if (join != STUDIO_JOIN_NEW)
        paper_drawing_again(b, before);
    if (join != STUDIO_JOIN_INVERT)
        polygon_put(b, points, count, scale);
    if (before->count && join == STUDIO_JOIN_ADD)
        paper_drawing_join(b, '+');
    if (before->count && join == STUDIO_JOIN_SUBTRACT)
        paper_drawing_join(b, '-');
    if (join == STUDIO_JOIN_INVERT || (!before->count && join == STUDIO_JOIN_SUBTRACT))
        paper_drawing_number(b, '-', 1, true);
}

/* Whether all fibers of the sheet have that gray. */
static bool all_are(const struct paper_screen *screen, const struct paper_sheet_config *config,
                    uint8_t gray)
{
    const size_t fibers = (size_t)screen->width_px * (size_t)screen->height_px;
    size_t i = 0;
    while (i < fibers && screen->gray[i] == gray)
        i++;
    return i == fibers &&
           (gray == 0 || fibers == (size_t)config->width * (size_t)config->height);
}

enum paper_status studio_around_make(const struct studio_selection *selection,
                                     enum studio_join join, const double *points, int count,
                                     const struct paper_sheet_config *config,
                                     struct studio_around *out)
{
    const struct paper_drawing none = {NULL, 0, 1}, *before = selection && selection->points &&
                                                                      join != STUDIO_JOIN_NEW
                                                                  ? &selection->drawing
                                                                  : &none;
    struct event_bytes bytes = {0};
    *out = (struct studio_around){0};
    if (join == STUDIO_JOIN_INVERT ? !before->count : !polygon_selects(points, count, config))
        return PAPER_OK;
    joined_put(&bytes, before, join, points, count, before->scale);
    paper_drawing_number(&bytes, '-', 1, true);
    out->drawing = (struct paper_drawing){bytes.at, bytes.count, before->scale};
    if (bytes.short_of_memory)
        return PAPER_NO_MEMORY;
    if (bytes.count > PAPER_DRAWING_MOST)
        return PAPER_BAD_ARGUMENT;
    const enum paper_status status =
        paper_drawing_screen(&out->drawing, before->scale, config->width, config->height,
                             &out->screen, &out->x, &out->y);
    if (out->screen.gray &&
        (all_are(&out->screen, config, 255) || all_are(&out->screen, config, 0)))
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

/* ---- outlines of what is selected ---- */

/* A walk along fibers' edges with what is selected at its right hand. */
struct walk {
    const uint8_t *frisket;
    int width, height;
    uint8_t *walked; /* upper edges of fibers */
    double *points;
    int count, capacity;
    int *ends;
    int loops, loops_capacity;
};

enum { HALF = 128 };

static bool walk_inside(const struct walk *w, int x, int y)
{
    return x >= 0 && y >= 0 && x < w->width && y < w->height &&
           w->frisket[(size_t)y * (size_t)w->width + (size_t)x] < HALF;
}

/* Around one part, from the upper left corner of fiber x, y. False: no memory. */
static bool walk_loop(struct walk *w, int x, int y)
{
    static const int dx[4] = {1, 0, -1, 0}, dy[4] = {0, 1, 0, -1}; /* right, down, left, up */
    /* the fibers ahead, at the right and at the left hand */
    static const int rx[4] = {0, -1, -1, 0}, ry[4] = {0, 0, -1, -1}, lx[4] = {0, 0, -1, -1},
                     ly[4] = {-1, 0, 0, -1};
    const int first_x = x, first_y = y;
    int way = 0, before = 3;
    do {
        if (way != before) {
            if (!array_reserve(&w->points, &w->capacity, 2 * (w->count + 1), sizeof(double)))
                return false;
            w->points[2 * w->count] = x;
            w->points[2 * w->count + 1] = y;
            w->count++;
        }
        before = way;
        if (way == 0)
            w->walked[(size_t)y * (size_t)w->width + (size_t)x] = 1;
        x += dx[way];
        y += dy[way];
        if (!walk_inside(w, x + rx[way], y + ry[way]))
            way = (way + 1) % 4;
        else if (walk_inside(w, x + lx[way], y + ly[way]))
            way = (way + 3) % 4;
    } while (x != first_x || y != first_y || way != 0);
    if (!array_reserve(&w->ends, &w->loops_capacity, w->loops + 1, sizeof(int)))
        return false;
    w->ends[w->loops++] = w->count;
    return true;
}

/* False: no memory. */
static bool walk_all(struct walk *w)
{
    for (int y = 0; y < w->height; y++)
        for (int x = 0; x < w->width; x++)
            if (walk_inside(w, x, y) && !walk_inside(w, x, y - 1) &&
                !w->walked[(size_t)y * (size_t)w->width + (size_t)x] && !walk_loop(w, x, y))
                return false;
    return true;
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
    free(s->ends);
    free(s->drawing.bytes);
    s->points = NULL;
    s->ends = NULL;
    s->drawing = (struct paper_drawing){0};
    s->points_count = s->loops = 0;
}

/* What lies within a drawing that is all around it is selected. A polygon is its own outline;
 * else the outline is along the fibers' edges. False: no memory. */
static bool drawing_select(struct studio_selection *s, const struct paper_drawing *around,
                           size_t within, const struct paper_sheet_config *config,
                           const uint8_t *frisket)
{
    struct walk w = {.frisket = frisket, .width = config->width, .height = config->height};
    nothing_selected(s);
    s->drawing = (struct paper_drawing){malloc(within), within, around->scale};
    bool good = s->drawing.bytes != NULL;
    if (good)
        memcpy(s->drawing.bytes, around->bytes, within);
    if (good && paper_drawing_around(around, &w.points, &w.count)) {
        w.ends = malloc(sizeof *w.ends);
        good = w.ends != NULL;
        if (good)
            w.ends[w.loops++] = w.count;
    } else if (good) {
        w.walked = calloc((size_t)w.width, (size_t)w.height);
        good = w.walked && walk_all(&w);
    }
    free(w.walked);
    if (good && !w.points) /* nowhere is a half of a fiber selected: no line, but it is */
        w.points = calloc(2, sizeof *w.points);
    s->points = w.points;
    s->points_count = w.count;
    s->ends = w.ends;
    s->loops = w.loops;
    if (!good)
        nothing_selected(s);
    return good;
}

/* Fluid is painted on through a gray, or rubbed off. */
static void gray_take(uint8_t *plane, int gray, bool on)
{
    if (on)
        *plane = gray > *plane ? (uint8_t)gray : *plane;
    else
        *plane = 255 - gray < *plane ? (uint8_t)(255 - gray) : *plane;
}

/* The gray that a place has at a fiber; 255 where there is no screen. */
static int place_gray(const struct paper_place *place, int x, int y)
{
    const struct paper_screen *screen = place->screen;
    if (!screen)
        return 255;
    x -= place->x;
    y -= place->y;
    return x >= 0 && y >= 0 && x < screen->width_px && y < screen->height_px
               ? screen->gray[(size_t)y * (size_t)screen->width_px + (size_t)x]
               : 0;
}

/* How many bytes of its drawing are of what it selects; 0: it selects nothing. */
static size_t resist_selects(const struct event_resist *resist)
{
    const struct paper_screen *screen = resist->place.screen;
    return resist->on && screen && screen->drawing ? paper_drawing_within(screen->drawing) : 0;
}

/* False: no memory. */
static bool resist_take(struct studio_selection *s, const struct event_resist *resist,
                        const struct paper_sheet_config *config)
{
    const struct paper_screen *screen = resist->place.screen;
    const int left = screen ? resist->place.x : 0, top = screen ? resist->place.y : 0,
              right = screen ? left + screen->width_px : config->width,
              bottom = screen ? top + screen->height_px : config->height;
    const size_t within = resist_selects(resist);
    for (int y = top > 0 ? top : 0; y < bottom && y < config->height; y++)
        for (int x = left > 0 ? left : 0; x < right && x < config->width; x++) {
            const size_t at = (size_t)y * (size_t)config->width + (size_t)x;
            const int gray = place_gray(&resist->place, x, y);
            if (!within)
                gray_take(&s->fluid[at], gray, resist->on);
            if (within || !resist->on)
                gray_take(&s->frisket[at], gray, resist->on);
        }
    return !within || drawing_select(s, screen->drawing, within, config, s->frisket);
}

/* Of a pair of operations that select something else: what the first one has put on is all
 * that there is now. False: no memory. */
static bool pair_take(struct studio_selection *s, const struct event_resist *first,
                      const struct paper_sheet_config *config)
{
    const struct paper_drawing *around = first->place.screen->drawing;
    for (int y = 0; y < config->height; y++)
        for (int x = 0; x < config->width; x++)
            s->frisket[(size_t)y * (size_t)config->width + (size_t)x] =
                (uint8_t)place_gray(&first->place, x, y);
    return drawing_select(s, around, paper_drawing_within(around), config, s->frisket);
}

/* Whether the second one leaves all that the first one has put on. */
static bool pair_is(const struct event_resist *first, const struct event_resist *second,
                    const struct paper_sheet_config *config)
{
    const struct paper_place *off = &second->place;
    if (!resist_selects(first) || second->on || !off->screen || off->x != 0 || off->y != 0 ||
        off->screen->width_px != config->width || off->screen->height_px != config->height)
        return false;
    for (int y = 0; y < config->height; y++)
        for (int x = 0; x < config->width; x++)
            if (place_gray(off, x, y) + place_gray(&first->place, x, y) > 255)
                return false;
    return true;
}

static struct event_resist *resist_of(const struct paper_sheet *sheet, int number)
{
    struct paper_moment moment;
    void *arguments = NULL;
    if (number >= 0 && paper_history_moment(sheet, number, &moment) &&
        strcmp(moment.what, "resist") == 0 &&
        paper_history_arguments(sheet, number, &arguments) == PAPER_OK)
        return arguments;
    return NULL;
}

bool studio_selection_begins(const struct paper_sheet *sheet, int number)
{
    struct event_resist *resist = resist_of(sheet, number);
    const bool begins = resist && resist_selects(resist) > 0;
    paper_history_arguments_free("resist", resist);
    return begins;
}

bool studio_selection_ends(const struct paper_sheet *sheet, int number)
{
    struct event_resist *second = resist_of(sheet, number),
                        *first = second && !second->on ? resist_of(sheet, number - 1) : NULL;
    const bool ends = first && pair_is(first, second, paper_sheet_get_config(sheet));
    paper_history_arguments_free("resist", first);
    paper_history_arguments_free("resist", second);
    return ends;
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
    if (status != PAPER_OK)
        return status;
    bool good = planes_there(s, fibers);
    if (good) {
        const struct event_layer *layer = arguments;
        const bool resist = strcmp(what, "resist") == 0;
        struct event_resist *first = resist && s->points ? resist_of(sheet, number - 1) : NULL;
        if (resist)
            good = resist_take(s, arguments, config);
        else if (layer->layer == PAPER_LAYER_RESIST)
            layer_take(s, layer, fibers);
        if (good && first && pair_is(first, arguments, config))
            good = pair_take(s, first, config);
        if (good && !frisket_left(s, fibers)) {
            nothing_selected(s);
            memset(s->frisket, 0, fibers);
        }
        paper_history_arguments_free("resist", first);
    }
    paper_history_arguments_free(what, arguments);
    return good ? PAPER_OK : PAPER_NO_MEMORY;
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
    nothing_selected(s);
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
