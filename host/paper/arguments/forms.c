/* forms.c - see arguments/forms.h. A screen is stored as a byte (enum place_kind), x, y, width,
 * height (4 bytes each) and its gray; then, if there is one, its drawing: length (4 bytes),
 * scale, bytes. */
#include "arguments/forms.h"

#include "arguments/resample.h"
#include "arguments/rows.h"
#include "drawing.h"

#include <scale.h>
#include <stream.h>

#include <math.h>
#include <stdlib.h>

/* The description of the sheet that the arguments belong to. */
static const struct paper_sheet_config *sheet_of(const struct event_stream *s)
{
    return s->context;
}

/* ---- places: a screen and where it lies ---- */

struct rectangle {
    int64_t x, y, width, height;
};

/* The part of a screen that lies on the sheet. */
static struct rectangle on_sheet(const struct paper_place *place,
                                 const struct paper_sheet_config *config)
{
    int64_t x1 = place->x > 0 ? place->x : 0, y1 = place->y > 0 ? place->y : 0;
    int64_t x2 = (int64_t)place->x + place->screen->width_px,
            y2 = (int64_t)place->y + place->screen->height_px;
    x2 = x2 < config->width ? x2 : config->width;
    y2 = y2 < config->height ? y2 : config->height;
    if (x1 >= x2 || y1 >= y2)
        return (struct rectangle){0, 0, 0, 0};
    return (struct rectangle){x1, y1, x2 - x1, y2 - y1};
}

/* An empty screen is stored as one dot of 0, so that every place has a valid screen. */
static void screen_get(struct event_stream *s, const struct rectangle *r,
                       struct paper_place *place)
{
    event_stream_expect(s, r->x <= sheet_of(s)->width && r->y <= sheet_of(s)->height &&
                               r->width <= sheet_of(s)->width - r->x &&
                               r->height <= sheet_of(s)->height - r->y &&
                               (r->width == 0) == (r->height == 0));
    if (s->in->bad)
        return;
    struct paper_screen *screen = malloc(sizeof *screen);
    uint8_t *gray =
        r->width ? event_pass_array(s, NULL, (size_t)(r->width * r->height)) : calloc(1, 1);
    if (!screen || !gray) {
        s->short_of_memory = !s->in->bad;
        free(screen);
        free(gray);
        return;
    }
    *screen = (struct paper_screen){.width_px = r->width ? (int)r->width : 1,
                                    .height_px = r->height ? (int)r->height : 1,
                                    .gray = gray};
    *place = (struct paper_place){screen, (int)r->x, (int)r->y};
}

#define DRAWING_SCALE_MOST 1e4

/* What the screen that was read was drawn from. */
static void drawing_get(struct event_stream *s, struct paper_screen *screen)
{
    const uint64_t count = event_pass_number(s, 0, 4);
    double scale = 0;
    event_pass_words(s, &scale, 1);
    event_stream_expect(s, count > 0 && count <= PAPER_DRAWING_MOST && scale > 0 &&
                               scale < DRAWING_SCALE_MOST);
    void *bytes = s->in->bad ? NULL : event_pass_array(s, NULL, (size_t)count);
    struct paper_drawing *drawing = malloc(sizeof *drawing);
    if (!bytes || !drawing) {
        s->short_of_memory = s->short_of_memory || !s->in->bad;
        free(bytes);
        free(drawing);
        return;
    }
    *drawing = (struct paper_drawing){bytes, (size_t)count, scale};
    screen->drawing = drawing;
}

enum place_kind { PLACE_SCREEN, PLACE_EVERYWHERE, PLACE_DRAWN };

static void place_pass(struct event_stream *s, void *start, void *of)
{
    (void)of;
    struct paper_place *place = start;
    const struct paper_drawing *drawing = place->screen ? place->screen->drawing : NULL;
    enum place_kind kind = !place->screen ? PLACE_EVERYWHERE : PLACE_SCREEN;
    if (drawing && drawing->count > 0 && drawing->count <= PAPER_DRAWING_MOST)
        kind = PLACE_DRAWN;
    kind = (enum place_kind)event_pass_number(s, kind, 1);
    event_stream_expect(s, kind <= PLACE_DRAWN);
    if (kind == PLACE_EVERYWHERE || (s->in && s->in->bad))
        return;
    struct rectangle r = {0, 0, 0, 0};
    if (!s->in)
        r = on_sheet(place, sheet_of(s));
    int64_t *const numbers[4] = {&r.x, &r.y, &r.width, &r.height};
    for (int i = 0; i < 4; i++)
        *numbers[i] = (int64_t)event_pass_number(s, (uint64_t)*numbers[i], 4);
    if (s->in) {
        screen_get(s, &r, place);
        if (kind == PLACE_DRAWN && place->screen && !s->in->bad)
            drawing_get(s, members_owned(place->screen));
        return;
    }
    const struct paper_screen *screen = place->screen;
    for (int64_t y = r.y; y < r.y + r.height; y++)
        event_put_bytes(s->out,
                        screen->gray + (y - place->y) * (int64_t)screen->width_px +
                            (r.x - place->x),
                        (size_t)r.width);
    if (kind == PLACE_DRAWN) {
        event_put_number(s->out, drawing->count, 4);
        event_put_double(s->out, drawing->scale);
        event_put_bytes(s->out, drawing->bytes, drawing->count);
    }
}

/* The screen, drawn anew from what it was drawn from. False: it cannot be: there is no drawing,
 * or its font is not here. */
static bool place_draw(struct paper_place *place, struct paper_screen *screen,
                       const struct event_scaling *scaling)
{
    const struct paper_sizes *sizes = scaling->context;
    struct paper_drawing *drawing = screen->drawing;
    if (!drawing || !sizes->draw)
        return false;
    drawing->scale *= scaling->length;
    struct paper_screen made;
    int x, y;
    if (sizes->draw(drawing, drawing->scale, sizes->new_width, sizes->new_height, &made, &x,
                    &y) != PAPER_OK ||
        !made.gray)
        return false;
    free(screen->gray);
    *screen = (struct paper_screen){.width_px = made.width_px,
                                    .height_px = made.height_px,
                                    .gray = made.gray,
                                    .drawing = drawing};
    place->x = x;
    place->y = y;
    return true;
}

static bool place_scale(void *start, void *of, const struct event_scaling *scaling)
{
    (void)of;
    const struct paper_sizes *sizes = scaling->context;
    struct paper_place *place = start;
    struct paper_screen *screen = members_owned(place->screen);
    if (!screen || place_draw(place, screen, scaling))
        return true;
    struct paper_resampling r = {.scale = scaling->length,
                                 .old_x = place->x,
                                 .old_y = place->y,
                                 .old_width = screen->width_px,
                                 .old_height = screen->height_px};
    double s = scaling->length;
    /* edges of a pixel of the old sheet, spread over as many pixels of the new one */
    r.x0 = (int)fmax(0, floor((place->x - 1) * s));
    r.y0 = (int)fmax(0, floor((place->y - 1) * s));
    int x1 = (int)fmin(sizes->new_width, ceil((place->x + screen->width_px + 1) * s));
    int y1 = (int)fmin(sizes->new_height, ceil((place->y + screen->height_px + 1) * s));
    r.width = x1 > r.x0 ? x1 - r.x0 : 1;
    r.height = y1 > r.y0 ? y1 - r.y0 : 1;
    size_t old_count = (size_t)r.old_width * (size_t)r.old_height,
           count = (size_t)r.width * (size_t)r.height;
    float *old = malloc(old_count * sizeof *old), *new = malloc(count * sizeof *new);
    uint8_t *gray = malloc(count);
    bool done = old && new &&gray;
    for (size_t i = 0; done && i < old_count; i++)
        old[i] = screen->gray[i];
    done = done && paper_resample(&r, old, new);
    for (size_t i = 0; done && i < count; i++)
        gray[i] = (uint8_t)lrintf(new[i]);
    free(done ? screen->gray : gray);
    if (done) {
        *screen = (struct paper_screen){.width_px = r.width,
                                        .height_px = r.height,
                                        .gray = gray,
                                        .drawing = screen->drawing};
        place->x = r.x0;
        place->y = r.y0;
    }
    free(old);
    free(new);
    return done;
}

static void place_free(void *start, void *of)
{
    (void)of;
    const struct paper_place *place = start;
    if (place->screen) {
        free(place->screen->gray);
        if (place->screen->drawing)
            free(place->screen->drawing->bytes);
        free(place->screen->drawing);
    }
    free(members_owned(place->screen));
}

const struct member_form place_form = {place_pass, place_scale, place_free};

/* ---- planes: a number for each fiber ---- */

static void plane_pass(struct event_stream *s, void *start, void *of)
{
    (void)of;
    const float **values = start;
    size_t count = (size_t)sheet_of(s)->width * (size_t)sheet_of(s)->height;
    void *plane = event_pass_array(s, *values, count * sizeof **values);
    if (s->in)
        *values = plane;
}

static bool plane_scale(void *start, void *of, const struct event_scaling *scaling)
{
    (void)of;
    const struct paper_sizes *sizes = scaling->context;
    struct paper_resampling r = {.scale = scaling->length,
                                 .width = sizes->new_width,
                                 .height = sizes->new_height,
                                 .old_width = sizes->width,
                                 .old_height = sizes->height,
                                 .edge_goes_on = true};
    return paper_array_resample(&r, start);
}

static void plane_free(void *start, void *of)
{
    (void)of;
    free(members_owned(*(const float *const *)start));
}

const struct member_form plane_form = {plane_pass, plane_scale, plane_free};

/* ---- samples of a stroke, and their count ---- */

#define PLACE_MAX 1e6
#define TIME_MAX 1e5
#define TILT_MAX 1.5

static const struct member sample_rows[] = {
    MEMBER(paper_stroke_sample, time_s, DOUBLE, 1, NOT, "time", 0, TIME_MAX),
    MEMBER(paper_stroke_sample, x, DOUBLE, 1, LENGTH, "x", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_stroke_sample, y, DOUBLE, 1, LENGTH, "y", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_stroke_sample, pressure, DOUBLE, 1, NOT, "pressure", 0, 1),
    MEMBER(paper_stroke_sample, tilt_x, DOUBLE, 1, NOT, "tilt along x", -TILT_MAX, TILT_MAX),
    MEMBER(paper_stroke_sample, tilt_y, DOUBLE, 1, NOT, "tilt along y", -TILT_MAX, TILT_MAX),
};
const struct members paper_sample_members = MEMBERS_OF(sample_rows);

static void samples_pass(struct event_stream *s, void *start, void *of)
{
    (void)start;
    struct paper_stroke *stroke = of;
    uint64_t count = event_pass_number(s, (uint64_t)stroke->samples_count, 4);
    struct paper_stroke_sample *samples = members_owned(stroke->samples);
    if (s->in) {
        event_stream_expect(s, count > 0 && count <= PAPER_STROKE_SAMPLES_MAX &&
                                   count * sizeof *samples <= (size_t)(s->in->end - s->in->at));
        samples = s->in->bad ? NULL : calloc((size_t)count, sizeof *samples);
        s->short_of_memory = !samples && !s->in->bad;
        if (!samples)
            return;
        stroke->samples_count = (int)count;
        stroke->samples = samples;
    }
    for (uint64_t i = 0; i < count; i++)
        event_pass_members(s, &paper_sample_members, &samples[i]);
}

static bool samples_scale(void *start, void *of, const struct event_scaling *scaling)
{
    (void)start;
    struct paper_stroke *stroke = of;
    struct paper_stroke_sample *samples = members_owned(stroke->samples);
    for (int i = 0; i < stroke->samples_count; i++)
        if (!members_scale(&paper_sample_members, &samples[i], scaling))
            return false;
    return true;
}

static void samples_free(void *start, void *of)
{
    (void)start;
    free(members_owned(((const struct paper_stroke *)of)->samples));
}

const struct member_form samples_form = {samples_pass, samples_scale, samples_free};

/* ---- the arrays of a print ---- */

/* Passes the rectangle, and for each substance a flag and its array. An invalid rectangle is
 * stored without arrays, so that it is refused when it is read. */
static void amounts_pass(struct event_stream *s, void *start, void *of)
{
    (void)start;
    struct paper_print *print = of;
    int *const rectangle[4] = {&print->x, &print->y, &print->width, &print->height};
    for (int i = 0; i < 4; i++)
        event_pass_int(s, rectangle[i], -64 * PAPER_SIDE_MAX, 64 * PAPER_SIDE_MAX);
    bool good = print->width > 0 && print->height > 0 && print->width <= PAPER_SIDE_MAX &&
                print->height <= PAPER_SIDE_MAX;
    event_stream_expect(s, good);
    for (int i = 0; i <= sheet_of(s)->pigments_count && event_stream_good(s); i++) {
        bool there = good && print->amount[i];
        event_pass_flag(s, &there);
        if (!there)
            continue;
        void *amounts = event_pass_array(
            s, print->amount[i], (size_t)print->width * (size_t)print->height * sizeof(float));
        if (s->in)
            print->amount[i] = amounts;
    }
}

static bool amounts_scale(void *start, void *of, const struct event_scaling *scaling)
{
    (void)start;
    struct paper_print *print = of;
    double s = scaling->length;
    struct paper_resampling r = {
        .scale = s,
        .x0 = (int)floor(print->x * s),
        .y0 = (int)floor(print->y * s),
        .width = (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->width * s))),
        .height = (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->height * s))),
        .old_x = print->x,
        .old_y = print->y,
        .old_width = print->width,
        .old_height = print->height,
        .edge_goes_on = true};
    bool done = true;
    for (int i = 0; i <= PAPER_PIGMENTS_MAX && done; i++)
        done = !print->amount[i] || paper_array_resample(&r, &print->amount[i]);
    print->x = r.x0;
    print->y = r.y0;
    print->width = r.width;
    print->height = r.height;
    return done;
}

static void amounts_free(void *start, void *of)
{
    (void)start;
    for (int i = 0; i <= PAPER_PIGMENTS_MAX; i++)
        free(members_owned(((const struct paper_print *)of)->amount[i]));
}

const struct member_form amounts_form = {amounts_pass, amounts_scale, amounts_free};
