/* studio_deeds.c - what each tool does with the way of a hand. */
#include "studio_mask.h"
#include "studio_session_internal.h"
#include "studio_stamp.h"

#include <array.h>
#include <techniques.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Samples of a stroke ascend in time; two reports of one moment are this far apart. */
#define MOMENT_S 1e-4
#define THROW_LENGTH 120.0 /* fibers of a drag that throw as far as drops are ever thrown */
#define THROW_MOST 4.0
#define SALT_REACH 10.0

static const struct paper_stroke_sample *first_of(const struct studio_session *s)
{
    return &s->samples[0];
}

static const struct paper_stroke_sample *last_of(const struct studio_session *s)
{
    return &s->samples[s->samples_count - 1];
}

/* ---- strokes ---- */

/* An inserted brush leaves that of what follows as it is. */
static int brush_number(const struct studio_session *s)
{
    return s->inserting >= 0 ? PAPER_BRUSHES_MAX - 1 : 0;
}

/* Only what a brush was dipped in is different from stroke to stroke; a brush that is as it was
 * stays as it is. */
static enum paper_status brush_ready(struct studio_session *s,
                                     const struct studio_settings *settings)
{
    struct paper_brush brush = studio_settings_brush(settings);
    brush.number = brush_number(s);
    const struct paper_brush *b = &s->brush;
    if (s->has_brush && b->width == brush.width && b->angle == brush.angle &&
        b->follows == brush.follows && b->flat == brush.flat && b->point == brush.point &&
        b->uneven == brush.uneven && b->splay == brush.splay && b->bend == brush.bend &&
        b->bristles == brush.bristles && b->depth == brush.depth &&
        b->thickness == brush.thickness && b->reach == brush.reach && b->load == brush.load &&
        b->flow == brush.flow && b->mixing == brush.mixing)
        return PAPER_OK;
    enum paper_status status = paper_sheet_brush(s->sheet, &brush);
    s->has_brush = status == PAPER_OK;
    s->brush = brush;
    return status;
}

static enum paper_status brush_dip(struct studio_session *s,
                                   const struct studio_settings *settings, bool inked)
{
    struct paper_dip dip = {.number = brush_number(s), .part = 1, .side = {-1, 1}};
    studio_settings_amounts(settings, dip.amount);
    if (!inked) {
        memset(dip.amount, 0, sizeof dip.amount);
        dip.amount[0] = settings->value[STUDIO_WATER];
    }
    dip.amount[0] = fmin(1, dip.amount[0]);
    return paper_sheet_dip(s->sheet, &dip);
}

/* The brush comes down: from here on it paints as the samples come. Where time stands still, it
 * stands still under the brush, too; else the paper makes as many steps a second as are set, or
 * as it can. */
static enum paper_status stroke_begin(struct studio_session *s)
{
    const struct studio_tool *tool = studio_tool_of(&s->at);
    const bool had_brush = s->has_brush;
    s->operations = paper_history_done(s->sheet);
    enum paper_status status = studio_session_air(s);
    if (status == PAPER_OK)
        status = brush_ready(s, &s->at);
    const bool fresh = s->has_brush && !had_brush;
    if (status == PAPER_OK && (fresh || s->at.value[STUDIO_REFILL] != 0 || !tool->inked))
        status = brush_dip(s, &s->at, tool->inked);
    double pace =
        s->at.value[STUDIO_PAUSED] != 0 || s->inserting >= 0 ? 0 : s->at.value[STUDIO_PACE];
    if (s->pace_most > 0)
        pace = fmin(pace, s->pace_most);
    return status == PAPER_OK ? paper_sheet_stroke_begin(s->sheet, brush_number(s), pace)
                              : status;
}

enum paper_status studio_session_care(struct studio_session *s, enum studio_care care)
{
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    enum paper_status status = studio_session_insert(s);
    if (status == PAPER_OK)
        status = brush_ready(s, &s->settings);
    const struct paper_dip wipe = {.number = brush_number(s), .part = 1, .side = {-1, 1}};
    if (status == PAPER_OK)
        status = care == STUDIO_WIPE ? paper_sheet_dip(s->sheet, &wipe)
                                     : brush_dip(s, &s->settings, care == STUDIO_DIP);
    return status;
}

/* ---- what covers an area ---- */

static enum paper_status swept_apply(struct studio_session *s,
                                     const struct paper_screen *screen, int x, int y)
{
    const double *value = s->at.value;
    const struct paper_place place = {screen, x, y};
    switch ((enum studio_tool_number)value[STUDIO_TOOL]) {
    case STUDIO_TOOL_BLOT:
        return paper_sheet_blot(s->sheet, screen, x, y, value[STUDIO_SOAK], 0);
    case STUDIO_TOOL_LIFT:
        return paper_sheet_lift(s->sheet, &(struct paper_lift){place, value[STUDIO_RUB]});
    case STUDIO_TOOL_MASK:
    case STUDIO_TOOL_UNMASK:
        return paper_sheet_resist(s->sheet, screen, x, y,
                                  (int)value[STUDIO_TOOL] == STUDIO_TOOL_MASK);
    case STUDIO_TOOL_VARNISH:
        return paper_sheet_varnish(s->sheet,
                                   &(struct paper_varnish){place, value[STUDIO_GLOSS]});
    case STUDIO_TOOL_DROP: {
        double amount[1 + PAPER_PIGMENTS_MAX];
        studio_settings_amounts(&s->at, amount);
        return paper_sheet_put(s->sheet, screen, x, y, amount);
    }
    case STUDIO_TOOL_BRUSH:
    case STUDIO_TOOL_WATER:
    case STUDIO_TOOL_WASH:
    case STUDIO_TOOL_SPLATTER:
    case STUDIO_TOOL_SALT:
    case STUDIO_TOOL_TYPE:
    case STUDIO_TOOL_SELECT:
    case STUDIO_TOOL_STAMP:
    case STUDIO_TOOLS:
        break;
    }
    return PAPER_OK;
}

/* Whether a selection holds it by itself: all that is put heeds the fluid around. */
static bool heeds_fluid(int tool)
{
    return tool != STUDIO_TOOL_MASK && tool != STUDIO_TOOL_UNMASK &&
           tool != STUDIO_TOOL_VARNISH;
}

/* The way as wide as the brush under the hand's pressure; a drop falls where the hand came
 * down. */
static enum paper_status swept_do(struct studio_session *s)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const bool drop = (int)s->at.value[STUDIO_TOOL] == STUDIO_TOOL_DROP;
    const int count = drop ? 1 : s->samples_count;
    struct studio_disc *discs = malloc((size_t)count * sizeof *discs);
    struct paper_screen screen = {0};
    int x = 0, y = 0;
    if (!discs)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for the way of the hand");
    for (int i = 0; i < count; i++)
        discs[i] = (struct studio_disc){s->samples[i].x, s->samples[i].y,
                                        drop ? s->at.value[STUDIO_SIZE]
                                             : s->at.value[STUDIO_WIDTH] / 2};
    enum paper_status status =
        studio_mask_sweep(discs, count, config->width, config->height, &screen, &x, &y);
    if (status == PAPER_NO_MEMORY)
        studio_session_failed(status, "no memory for the way of the hand");
    if (status == PAPER_OK && screen.gray && !heeds_fluid((int)s->at.value[STUDIO_TOOL]))
        status = studio_session_selection_clip(s, &screen, x, y);
    if (status == PAPER_OK && screen.gray)
        status = swept_apply(s, &screen, x, y);
    paper_screen_destroy(&screen);
    free(discs);
    return status;
}

static enum paper_status wash_do(struct studio_session *s)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    const double x[2] = {first_of(s)->x, last_of(s)->x}, y[2] = {first_of(s)->y, last_of(s)->y};
    const double corners[] = {x[0], y[0], x[1], y[0], x[1], y[1], x[0], y[1]};
    struct paper_screen screen;
    struct paper_wash wash = {.from = {x[0], y[0]}, .to = {x[0], y[1]}};
    if (fabs(x[1] - x[0]) < 1 || fabs(y[1] - y[0]) < 1)
        return PAPER_OK; /* a click */
    studio_settings_amounts(&s->at, wash.amount);
    for (int i = 0; i <= PAPER_PIGMENTS_MAX; i++)
        wash.end[i] = i ? s->at.value[STUDIO_FADE] * wash.amount[i] : wash.amount[i];
    enum paper_status status = paper_polygon_screen(corners, 4, config->width, config->height,
                                                    &screen, &wash.place.x, &wash.place.y);
    if (status != PAPER_OK)
        return status;
    wash.place.screen = &screen;
    if (screen.gray)
        status = paper_sheet_wash(s->sheet, &wash);
    paper_screen_destroy(&screen);
    return status;
}

/* Another throw is another chance: the seed follows from what was done before. */
static uint64_t seed_of(const struct studio_session *s)
{
    return 1 + (uint64_t)paper_history_done(s->sheet);
}

static enum paper_status splatter_do(struct studio_session *s)
{
    const double *value = s->at.value, along = last_of(s)->x - first_of(s)->x,
                 down = last_of(s)->y - first_of(s)->y, length = hypot(along, down);
    struct paper_splatter splatter = {
        .x = first_of(s)->x,
        .y = first_of(s)->y,
        .radius = value[STUDIO_SCATTER],
        .toward = length > 4 ? atan2(down, along) : 0,
        .thrown = length > 4 ? fmin(THROW_MOST, THROW_MOST * length / THROW_LENGTH) : 0,
        .drops = (int)value[STUDIO_DROPS],
        .size = {0.6, 4},
        .seed = seed_of(s)};
    studio_settings_amounts(&s->at, splatter.amount);
    return paper_sheet_splatter(s->sheet, &splatter);
}

static enum paper_status salt_do(struct studio_session *s)
{
    const double *value = s->at.value;
    struct paper_screen screen;
    struct paper_salt salt = {.x = first_of(s)->x,
                              .y = first_of(s)->y,
                              .radius = value[STUDIO_SCATTER],
                              .grains = (int)value[STUDIO_GRAINS],
                              .size = {0.7, 1.6},
                              .strength = value[STUDIO_SALT],
                              .reach = SALT_REACH,
                              .seed = seed_of(s)};
    enum paper_status status = studio_session_selection_place(s, &screen, &salt.place);
    if (status == PAPER_OK)
        status = paper_sheet_salt(s->sheet, &salt);
    paper_screen_destroy(&screen);
    return status;
}

/* ---- the hand ---- */

static enum paper_status deed_do(struct studio_session *s)
{
    enum paper_status status = studio_session_air(s);
    if (status != PAPER_OK)
        return status;
    switch ((enum studio_tool_number)s->at.value[STUDIO_TOOL]) {
    case STUDIO_TOOL_WASH:
        return wash_do(s);
    case STUDIO_TOOL_SPLATTER:
        return splatter_do(s);
    case STUDIO_TOOL_SALT:
        return salt_do(s);
    case STUDIO_TOOL_SELECT:
        return studio_session_select(s);
    case STUDIO_TOOL_DROP:
    case STUDIO_TOOL_BLOT:
    case STUDIO_TOOL_LIFT:
    case STUDIO_TOOL_MASK:
    case STUDIO_TOOL_UNMASK:
    case STUDIO_TOOL_VARNISH:
        return swept_do(s);
    case STUDIO_TOOL_BRUSH: /* grows while the hand moves */
    case STUDIO_TOOL_WATER:
    case STUDIO_TOOL_TYPE: /* studio_session_type() */
    case STUDIO_TOOL_STAMP:
    case STUDIO_TOOLS:
        break;
    }
    return PAPER_OK;
}

static enum paper_status sample_add(struct studio_session *s, const struct studio_point *point)
{
    double time_s = point->time_s - s->began_s;
    if (!array_reserve(&s->samples, &s->samples_capacity, s->samples_count + 1,
                       sizeof *s->samples))
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a longer stroke");
    if (s->samples_count > 0)
        time_s = fmax(time_s, last_of(s)->time_s + MOMENT_S);
    s->samples[s->samples_count++] =
        (struct paper_stroke_sample){.time_s = time_s,
                                     .x = point->x,
                                     .y = point->y,
                                     .pressure = fmin(1, fmax(0, point->pressure)),
                                     .tilt_x = fmin(1.5, fmax(-1.5, point->tilt_x)),
                                     .tilt_y = fmin(1.5, fmax(-1.5, point->tilt_y))};
    return PAPER_OK;
}

static bool grows(const struct studio_session *s)
{
    const int tool = (int)s->at.value[STUDIO_TOOL];
    return s->way < 0 && (tool == STUDIO_TOOL_BRUSH || tool == STUDIO_TOOL_WATER);
}

/* What the hand does between coming down and being lifted. */
static enum paper_status hand_moves(struct studio_session *s, const struct studio_point *point)
{
    enum paper_status status = PAPER_OK;
    if (s->samples_count == PAPER_STROKE_SAMPLES_MAX)
        return status;
    status = sample_add(s, point);
    if (status == PAPER_OK && grows(s)) {
        int steps = 0;
        status = paper_sheet_stroke_add(s->sheet, last_of(s), 1, &steps);
        s->stroke_steps += steps;
    }
    return status;
}

static enum paper_status hand_lifts(struct studio_session *s)
{
    if (s->way >= 0)
        return studio_session_way_end(s);
    return grows(s) ? paper_sheet_stroke_end(s->sheet, NULL) : deed_do(s);
}

enum paper_status studio_session_point(struct studio_session *s,
                                       const struct studio_point *point)
{
    enum paper_status status = PAPER_OK;
    if (point->kind == STUDIO_POINT_DROP || (point->kind == STUDIO_POINT_DOWN && s->down))
        studio_session_drop(s);
    if (point->kind == STUDIO_POINT_DOWN) {
        s->down = true;
        s->at = s->settings;
        s->began_s = point->time_s;
        s->stroke_steps = 0;
        if (s->way < 0)
            status = studio_session_insert(s);
        s->operations = paper_history_done(s->sheet);
        if (status == PAPER_OK && grows(s))
            status = stroke_begin(s);
    }
    if (s->down && status == PAPER_OK)
        status = hand_moves(s, point);
    if (s->down && status == PAPER_OK && point->kind == STUDIO_POINT_UP) {
        status = hand_lifts(s);
        s->down = false;
        s->samples_count = 0;
        s->held = false;
        s->wet = true;
    }
    if (status != PAPER_OK)
        studio_session_drop(s);
    return status;
}

enum paper_status studio_session_rest(struct studio_session *s, double seconds)
{
    if (!s->down || !grows(s) || s->samples_count == 0 || s->at.value[STUDIO_PAUSED] != 0 ||
        s->inserting >= 0)
        return PAPER_OK;
    const struct paper_stroke_sample *last = last_of(s);
    const struct studio_point point = {.kind = STUDIO_POINT_MOVE,
                                       .time_s = s->began_s + last->time_s + seconds,
                                       .x = last->x,
                                       .y = last->y,
                                       .pressure = last->pressure,
                                       .tilt_x = last->tilt_x,
                                       .tilt_y = last->tilt_y};
    return studio_session_point(s, &point);
}

bool studio_session_grows(const struct studio_session *s)
{
    return s->down && grows(s);
}

int studio_session_stroke_steps(const struct studio_session *s)
{
    return s->stroke_steps;
}

void studio_session_pace_most(struct studio_session *s, double pace)
{
    s->pace_most = pace;
}

/* ---- deeds without a hand ---- */

static enum paper_status deed_ready(struct studio_session *s)
{
    return s->down ? studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper")
                   : studio_session_insert(s);
}

enum paper_status studio_session_dry(struct studio_session *s)
{
    const enum paper_status status = deed_ready(s);
    return status == PAPER_OK ? studio_session_deed_done(s, paper_sheet_dry(s->sheet)) : status;
}

enum paper_status studio_session_seal(struct studio_session *s)
{
    const enum paper_status status = deed_ready(s);
    return status == PAPER_OK ? studio_session_deed_done(s, paper_sheet_seal(s->sheet))
                              : status;
}

/* ---- type ---- */

enum paper_status studio_session_type_screen(const struct studio_settings *settings,
                                             const struct studio_type *type,
                                             struct paper_screen *screen, int *x, int *y,
                                             uint32_t *missing)
{
    const double *value = settings->value;
    const double left = floor(type->x), top = floor(type->y);
    const struct paper_line line = {
        .text = type->text,
        .font = type->font,
        .features = type->features && type->features[0] ? type->features : NULL,
        .size_px = value[STUDIO_TYPE_SIZE],
        .angle_deg = value[STUDIO_TYPE_ANGLE],
        .width_px = value[STUDIO_TYPE_COLUMN],
        .leading = value[STUDIO_TYPE_LEADING],
        .align = (enum paper_align)value[STUDIO_TYPE_ALIGN],
        .x_px = type->x - left,
        .y_px = type->y - top};
    const enum paper_status status = paper_line_screen(&line, screen, missing);
    *x = (int)left - screen->origin_x_px;
    *y = (int)top - screen->baseline_y_px;
    return status;
}

enum paper_status studio_session_put(struct studio_session *s,
                                     const struct paper_screen *screen, int x, int y)
{
    double amount[1 + PAPER_PIGMENTS_MAX];
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    enum paper_status status = studio_session_insert(s);
    if (status == PAPER_OK)
        status = studio_session_air(s);
    studio_settings_amounts(&s->settings, amount);
    if (status == PAPER_OK)
        status = paper_sheet_put(s->sheet, screen, x, y, amount);
    return studio_session_deed_done(s, status);
}

enum paper_status studio_session_type(struct studio_session *s, const struct studio_type *type)
{
    struct paper_screen screen;
    uint32_t missing;
    int x, y;
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    enum paper_status status =
        studio_session_type_screen(&s->settings, type, &screen, &x, &y, &missing);
    status = status == PAPER_OK ? studio_session_put(s, &screen, x, y)
                                : studio_session_deed_done(s, status);
    paper_screen_destroy(&screen);
    return status;
}

/* ---- stamps ---- */

static enum paper_status stamp_put(struct studio_session *s, struct studio_printed *printed)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    struct paper_screen *screen = &printed->screen;
    const enum studio_stamp_as as = (enum studio_stamp_as)s->settings.value[STUDIO_STAMP_AS];
    double amount[1 + PAPER_PIGMENTS_MAX];
    struct paper_print print;
    float *planes;
    enum paper_status status;
    studio_settings_amounts(&s->settings, amount);
    switch (as) {
    case STUDIO_STAMP_FLUID:
        status = studio_session_selection_clip(s, screen, printed->x, printed->y);
        return status == PAPER_OK
                   ? paper_sheet_resist(s->sheet, screen, printed->x, printed->y, true)
                   : status;
    case STUDIO_STAMP_COLOURS:
        status = studio_printed_separate(printed, config, amount[0], &print, &planes);
        if (status == PAPER_OK)
            status = paper_sheet_print(s->sheet, &print);
        free(planes);
        return status;
    case STUDIO_STAMP_WATER:
        memset(amount + 1, 0, sizeof amount - sizeof *amount);
        break;
    case STUDIO_STAMP_PAINT:
        break;
    }
    return paper_sheet_put(s->sheet, screen, printed->x, printed->y, amount);
}

enum paper_status studio_session_stamp(struct studio_session *s,
                                       const struct studio_stamp *stamp, double x, double y)
{
    struct studio_printed printed = {0};
    enum paper_status status = PAPER_OK;
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    status = studio_stamp_place(stamp, &s->settings, x, y, paper_sheet_get_config(s->sheet),
                                &printed);
    if (status != PAPER_OK || !printed.screen.gray)
        return status;
    status = studio_session_insert(s);
    if (status == PAPER_OK)
        status = studio_session_air(s);
    if (status == PAPER_OK)
        status = stamp_put(s, &printed);
    studio_printed_free(&printed);
    return studio_session_deed_done(s, status);
}
