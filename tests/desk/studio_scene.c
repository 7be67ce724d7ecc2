/* studio_scene.c - see studio_scene.h. */
#include "studio_scene.h"

#include <brush.h>
#include <techniques.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SECOND 0.0625 /* between two samples */
#define DEED 10.0     /* between two deeds */

const struct scene_deed scene_deeds[] = {
    {STUDIO_TOOL_WASH, 14, 2, {{8, 8, 0.5}, {80.5, 40.25, 0.5}}, 4, SCENE_KEPT},
    {STUDIO_TOOL_BRUSH,
     14,
     4,
     {{10, 20, 0.3}, {30.5, 12, 0.6}, {60, 40.125, 0.9}, {85, 30, 0.2}},
     5,
     SCENE_KEPT},
    {STUDIO_TOOL_BRUSH, 14, 3, {{70, 60, 0.5}, {40, 58, 0.7}, {12, 64, 0.5}}, 3, SCENE_UNDONE},
    {STUDIO_TOOL_WATER, 9, 3, {{20, 55, 0.5}, {44, 50, 0.75}, {80, 55, 0.5}}, 6, SCENE_KEPT},
    {STUDIO_TOOL_BRUSH, 9, 3, {{5, 5, 0.5}, {50, 30, 0.75}, {90, 66, 0.5}}, 0, SCENE_DROPPED},
    {STUDIO_TOOL_DROP, 9, 1, {{48, 36, 0.5}}, 4, SCENE_KEPT},
    {STUDIO_TOOL_MASK, 8, 2, {{60, 10, 0.5}, {60, 62, 0.5}}, 1, SCENE_KEPT},
    {STUDIO_TOOL_SPLATTER, 8, 2, {{30, 40, 0.5}, {60, 48, 0.5}}, 2, SCENE_KEPT},
    {STUDIO_TOOL_SALT, 8, 1, {{40, 30, 0.5}}, 6, SCENE_KEPT},
    {STUDIO_TOOL_UNMASK, 8, 2, {{60, 10, 0.5}, {60, 40, 0.5}}, 1, SCENE_KEPT},
    {STUDIO_TOOL_BLOT, 12, 3, {{15, 15, 0.5}, {25, 30, 0.5}, {40, 25, 0.5}}, 2, SCENE_KEPT},
    {STUDIO_TOOL_LIFT, 12, 2, {{70, 15, 0.5}, {85, 35, 0.5}}, 2, SCENE_KEPT},
    {STUDIO_TOOL_VARNISH, 20, 2, {{5, 66, 0.5}, {90, 66, 0.5}}, 1, SCENE_UNDONE},
    {STUDIO_TOOL_BRUSH, 20, 3, {{90, 10, 0.9}, {50, 14, 0.6}, {10, 40, 0.3}}, 8, SCENE_KEPT},
};
const int scene_deeds_count = sizeof scene_deeds / sizeof *scene_deeds;

struct paper_sheet_config scene_config(void)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = SCENE_WIDTH;
    config.height = SCENE_HEIGHT;
    config.seed = 1;
    config.stock = *paper_stock_find("cold press");
    config.pigments[config.pigments_count++] = *paper_pigment_find("french ultramarine");
    config.pigments[config.pigments_count++] = *paper_pigment_find("quinacridone rose");
    return config;
}

/* ---- by the paper's own functions ---- */

struct painting {
    struct paper_sheet *sheet;
    double width; /* of the brush that there is; 0: none */
};

/* How far a fiber is from the way of the hand. */
static double away(const struct scene_deed *d, int count, double x, double y)
{
    double least = 1e9;
    for (int i = 0; i < count; i++) {
        const double *a = d->way[i], *b = d->way[i + 1 < count ? i + 1 : i];
        const double wx = b[0] - a[0], wy = b[1] - a[1], all = wx * wx + wy * wy;
        double t = all > 0 ? ((x - a[0]) * wx + (y - a[1]) * wy) / all : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        least = fmin(least, hypot(x - a[0] - t * wx, y - a[1] - t * wy));
    }
    return least;
}

static enum paper_status area_paint(struct painting *p, const struct scene_deed *d)
{
    static uint8_t gray[SCENE_WIDTH * SCENE_HEIGHT];
    const struct paper_screen screen = {
        .width_px = SCENE_WIDTH, .height_px = SCENE_HEIGHT, .gray = gray};
    const double drop[1 + PAPER_PIGMENTS_MAX] = {0.8, 0.6};
    const int count = d->tool == STUDIO_TOOL_DROP ? 1 : d->count;
    const double radius = d->tool == STUDIO_TOOL_DROP ? 8 : d->width / 2;
    for (int y = 0; y < SCENE_HEIGHT; y++)
        for (int x = 0; x < SCENE_WIDTH; x++) {
            const double cover = radius + 0.5 - away(d, count, x + 0.5, y + 0.5);
            gray[y * SCENE_WIDTH + x] = (uint8_t)lrint(255 * (cover < 0   ? 0
                                                              : cover > 1 ? 1
                                                                          : cover));
        }
    if (d->tool == STUDIO_TOOL_DROP)
        return paper_sheet_put(p->sheet, &screen, 0, 0, drop);
    if (d->tool == STUDIO_TOOL_BLOT)
        return paper_sheet_blot(p->sheet, &screen, 0, 0, 0.8, 0);
    if (d->tool == STUDIO_TOOL_LIFT)
        return paper_sheet_lift(p->sheet, &(struct paper_lift){{&screen, 0, 0}, 0.6});
    if (d->tool == STUDIO_TOOL_VARNISH)
        return paper_sheet_varnish(p->sheet, &(struct paper_varnish){{&screen, 0, 0}, 0.8});
    return paper_sheet_resist(p->sheet, &screen, 0, 0, d->tool == STUDIO_TOOL_MASK);
}

static enum paper_status stroke_paint(struct painting *p, const struct scene_deed *d)
{
    struct paper_brush brush = paper_brush_default();
    struct paper_stroke_sample samples[SCENE_SAMPLES];
    const struct paper_dip dip = {
        .part = 1, .side = {-1, 1}, .amount = {0.8, d->tool == STUDIO_TOOL_BRUSH ? 0.6 : 0}};
    enum paper_status status = PAPER_OK;
    brush.width = d->width; /* a round one */
    brush.depth = 0.75 * d->width;
    brush.point = 0.75;
    brush.splay = 0.25;
    brush.bristles = (int)fmax(12, 8 * d->width);
    brush.thickness = fmax(1.2, 0.07 * d->width);
    brush.reach = 30 * d->width;
    if (p->width != d->width)
        status = paper_sheet_brush(p->sheet, &brush);
    p->width = d->width;
    for (int i = 0; i < d->count; i++)
        samples[i] = (struct paper_stroke_sample){.time_s = i * SECOND,
                                                  .x = d->way[i][0],
                                                  .y = d->way[i][1],
                                                  .pressure = d->way[i][2]};
    if (status == PAPER_OK)
        status = paper_sheet_dip(p->sheet, &dip);
    return status == PAPER_OK
               ? paper_sheet_stroke(p->sheet,
                                    &(struct paper_stroke){.pace = 0,
                                                           .samples_count = d->count,
                                                           .samples = samples},
                                    NULL)
               : status;
}

static enum paper_status wash_paint(struct painting *p, const struct scene_deed *d)
{
    const double *a = d->way[0], *b = d->way[1],
                 corners[] = {a[0], a[1], b[0], a[1], b[0], b[1], a[0], b[1]};
    struct paper_screen screen;
    struct paper_wash wash = {.from = {a[0], a[1]},
                              .to = {a[0], b[1]},
                              .amount = {0.8, 0.6},
                              .end = {0.8, 0.2 * 0.6}};
    enum paper_status status = paper_polygon_screen(corners, 4, SCENE_WIDTH, SCENE_HEIGHT,
                                                    &screen, &wash.place.x, &wash.place.y);
    wash.place.screen = &screen;
    if (status == PAPER_OK)
        status = paper_sheet_wash(p->sheet, &wash);
    paper_screen_destroy(&screen);
    return status;
}

static enum paper_status deed_paint(struct painting *p, const struct scene_deed *d)
{
    const double *a = d->way[0], *b = d->way[d->count - 1],
                 length = hypot(b[0] - a[0], b[1] - a[1]);
    const uint64_t seed = 1 + (uint64_t)paper_history_done(p->sheet);
    if (d->tool == STUDIO_TOOL_BRUSH || d->tool == STUDIO_TOOL_WATER)
        return stroke_paint(p, d);
    if (d->tool == STUDIO_TOOL_WASH)
        return wash_paint(p, d);
    if (d->tool == STUDIO_TOOL_SPLATTER)
        return paper_sheet_splatter(
            p->sheet, &(struct paper_splatter){.x = a[0],
                                               .y = a[1],
                                               .radius = 80,
                                               .toward = atan2(b[1] - a[1], b[0] - a[0]),
                                               .thrown = 4 * length / 120,
                                               .drops = 60,
                                               .size = {0.6, 4},
                                               .seed = seed,
                                               .amount = {0.8, 0.6}});
    if (d->tool == STUDIO_TOOL_SALT)
        return paper_sheet_salt(p->sheet, &(struct paper_salt){.x = a[0],
                                                               .y = a[1],
                                                               .radius = 80,
                                                               .grains = 60,
                                                               .size = {0.7, 1.6},
                                                               .strength = 1,
                                                               .reach = 10,
                                                               .seed = seed});
    return area_paint(p, d);
}

enum paper_status scene_paint(struct paper_sheet *sheet)
{
    struct painting p = {.sheet = sheet};
    enum paper_status status = PAPER_OK;
    for (int i = 0; i < scene_deeds_count && status == PAPER_OK; i++) {
        const struct scene_deed *d = &scene_deeds[i];
        if (d->end != SCENE_KEPT) { /* an undo makes the brush anew, as far as bits go */
            p.width = d->end == SCENE_UNDONE ? 0 : p.width;
            continue;
        }
        status = deed_paint(&p, d);
        for (int k = 0; k < d->steps && status == PAPER_OK; k++)
            status = paper_sheet_step(sheet);
    }
    return status;
}

/* ---- by a hand ---- */

enum paper_status scene_play(struct studio_session *s)
{
    enum paper_status status = studio_session_set(s, STUDIO_PAUSED, 1);
    for (int i = 0; i < scene_deeds_count && status == PAPER_OK; i++) {
        const struct scene_deed *d = &scene_deeds[i];
        status = studio_session_set(s, STUDIO_TOOL, d->tool);
        if (status == PAPER_OK)
            status = studio_session_set(s, STUDIO_WIDTH, d->width);
        for (int k = 0; k < d->count && status == PAPER_OK; k++) {
            struct studio_point point = {.kind = k ? STUDIO_POINT_MOVE : STUDIO_POINT_DOWN,
                                         .time_s = DEED * i + SECOND * k,
                                         .x = d->way[k][0],
                                         .y = d->way[k][1],
                                         .pressure = d->way[k][2]};
            if (k == 1) /* a setting that is changed in mid-stroke is the next one's */
                studio_session_set(s, STUDIO_WIDTH, 77);
            if (k > 0 && k == d->count - 1 && d->end != SCENE_DROPPED)
                point.kind = STUDIO_POINT_UP;
            status = studio_session_point(s, &point);
        }
        if (d->count == 1) /* a click: it is lifted where it came down, at once */
            status = studio_session_point(s, &(struct studio_point){.kind = STUDIO_POINT_UP,
                                                                    .time_s = DEED * i,
                                                                    .x = d->way[0][0],
                                                                    .y = d->way[0][1],
                                                                    .pressure = d->way[0][2]});
        if (status == PAPER_OK && d->steps)
            status = studio_session_steps(s, d->steps, NULL);
        if (d->end != SCENE_KEPT)
            studio_session_undo(s);
    }
    return status;
}

void scene_write(FILE *out, double zoom)
{
    fprintf(out, "0 set paused on\n0 view %g %g %g 0 0\n", zoom, SCENE_WIDTH / 2.0,
            SCENE_HEIGHT / 2.0);
    for (int i = 0; i < scene_deeds_count; i++) {
        const struct scene_deed *d = &scene_deeds[i];
        const double begins =
            0.25 * i; /* the numbers of seconds are exact: so are their differences */
        char tool[32];
        control_text(&studio_controls[STUDIO_TOOL], d->tool, tool, sizeof tool);
        fprintf(out, "%g set tool %s\n%g set width %g\n", begins, tool, begins, d->width);
        for (int k = 0; k < d->count; k++) {
            const double x = zoom * (d->way[k][0] - SCENE_WIDTH / 2.0),
                         y = zoom * (d->way[k][1] - SCENE_HEIGHT / 2.0);
            const char *word = !k                                            ? "down"
                               : k < d->count - 1 || d->end == SCENE_DROPPED ? "move"
                                                                             : "up";
            fprintf(out, "%.17g %s %.17g %.17g %.17g\n", begins + SECOND * k, word, x, y,
                    d->way[k][2]);
            if (d->count == 1)
                fprintf(out, "%g up %.17g %.17g %.17g\n", begins, x, y, d->way[k][2]);
        }
        if (d->steps)
            fprintf(out, "%g step %d\n", begins + 0.1875, d->steps);
        if (d->end != SCENE_KEPT)
            fprintf(out, "%g undo\n", begins + 0.1875);
    }
}

enum paper_status scene_sweep(struct studio_session *session, double y, double rises,
                              bool lifted)
{
    enum paper_status status = PAPER_OK;
    for (int k = 0; k < 4 && status == PAPER_OK; k++)
        status = studio_session_point(
            session, &(struct studio_point){.kind = k == 0             ? STUDIO_POINT_DOWN
                                                    : k < 3 || !lifted ? STUDIO_POINT_MOVE
                                                                       : STUDIO_POINT_UP,
                                            .time_s = 5 + 0.05 * k,
                                            .x = 15 + 20 * k,
                                            .y = y + rises * k,
                                            .pressure = 0.7});
    return status;
}
