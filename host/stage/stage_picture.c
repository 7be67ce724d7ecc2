/* stage_picture.c - what a stage's picture has: the grid, earlier moments, shadows, the
 * actor. */
#include "stage_internal.h"

#include <math.h>

void stage_skins_drop(struct stage *s)
{
    s->skins_count = 0;
    s->skin_taken_s = -INFINITY;
}

static struct stage_look look_of(const struct stage *s)
{
    return (struct stage_look){.theme = &s->theme,
                               .view = s->view,
                               .width_px = s->width_px,
                               .height_px = s->height_px,
                               .px = s->px,
                               .fraction = frame_clock_fraction(&s->clock),
                               .step_s = s->clock.step_s};
}

void stage_skin_take(struct stage *s)
{
    double now_s = (double)s->clock.steps_count * s->clock.step_s;
    if (s->settings.skins < 1 || s->width_px == 0 ||
        now_s < s->skin_taken_s + s->settings.skin_every_s - s->clock.step_s / 2)
        return;
    s->skin_taken_s = now_s;
    s->skins_last = (s->skins_last + 1) % STAGE_SKINS_MAX;
    if (s->skins_count < STAGE_SKINS_MAX)
        s->skins_count++;
    struct stage_look look = look_of(s);
    look.fraction = 0;
    stage_draw_begin(&s->skins[s->skins_last], s->view);
    s->actor.kind->draw(s->actor.self, &look, &s->skins[s->skins_last]);
}

/* Centres the actor with a margin; the scale is the same along both axes. */
static void view_make(struct stage *s, int width_px, int height_px, double px)
{
    struct font_box box = {-1, -1, 1, 1};
    if (s->actor.kind->extent)
        box = s->actor.kind->extent(s->actor.self);
    double width = fmax(1e-6, box.x1 - box.x0), height = fmax(1e-6, box.y1 - box.y0);
    double scale = fmin(width_px / width, height_px / height);
    s->view.scale = scale;
    s->view.x0_px = width_px / 2.0 - scale * (box.x0 + box.x1) / 2;
    s->view.y0_px = height_px / 2.0 + scale * (box.y0 + box.y1) / 2;
    s->width_px = width_px;
    s->height_px = height_px;
    s->px = px;
    stage_skins_drop(s);
}

void stage_view_grow(struct stage *s)
{
    double x0, y0, x1, y1;
    if (s->width_px == 0 || !s->actor.kind->extent)
        return;
    const struct font_box box = s->actor.kind->extent(s->actor.self);
    stage_view_to_world(s->view, 0, s->height_px, &x0, &y0);
    stage_view_to_world(s->view, s->width_px, 0, &x1, &y1);
    const double touch = 1e-9 * (x1 - x0 + y1 - y0);
    if (box.x0 < x0 - touch || box.y0 < y0 - touch || box.x1 > x1 + touch ||
        box.y1 > y1 + touch)
        view_make(s, s->width_px, s->height_px, s->px);
}

static void grid_draw(const struct stage *s, struct stage_draw_list *list)
{
    double x0, y0, x1, y1, px = s->px * s->theme.sizes[STAGE_SIZE_GRID_WIDTH];
    const struct stage_color color = s->theme.colors[STAGE_COLOR_GRID];
    stage_view_to_world(s->view, 0, s->height_px, &x0, &y0);
    stage_view_to_world(s->view, s->width_px, 0, &x1, &y1);
    if (!(x1 - x0 < 500 && y1 - y0 < 500)) /* lines everywhere */
        return;
    for (double x = ceil(x0); x <= x1; x++)
        stage_draw_line(list, x, y0, x, y1, px, color);
    for (double y = ceil(y0); y <= y1; y++)
        stage_draw_line(list, x0, y, x1, y, px, color);
}

/* The opacity of the newest skin, relative to the present. */
static const double skin_most = 0.7;

static void skins_draw(const struct stage *s, struct stage_draw_list *list)
{
    int count = (int)s->settings.skins;
    bool all = s->settings.skin_of != 0;
    if (count > s->skins_count)
        count = s->skins_count;
    for (int back = count - 1; back >= 0; back--) {
        int i = (s->skins_last - back + STAGE_SKINS_MAX) % STAGE_SKINS_MAX;
        stage_draw_again(list, &s->skins[i], 0, 0,
                         all ? NULL : &s->theme.colors[STAGE_COLOR_SKIN],
                         skin_most * (1 - (double)back / (count + 1)), !all);
    }
}

void stage_picture(struct stage *s, int width_px, int height_px, double px,
                   struct stage_draw_list *list)
{
    if (width_px != s->width_px || height_px != s->height_px || px != s->px)
        view_make(s, width_px, height_px, px);
    struct stage_look look = look_of(s);
    stage_draw_begin(&s->own, s->view);
    s->actor.kind->draw(s->actor.self, &look, &s->own);
    stage_draw_begin(list, s->view);
    if (s->settings.grid != 0)
        grid_draw(s, list);
    skins_draw(s, list);
    if (s->settings.shadow != 0)
        stage_draw_again(list, &s->own, px * s->theme.sizes[STAGE_SIZE_SHADOW_X],
                         px * s->theme.sizes[STAGE_SIZE_SHADOW_Y],
                         &s->theme.colors[STAGE_COLOR_SHADOW], 1, true);
    stage_draw_again(list, &s->own, 0, 0, NULL, 1, false);
    list->incomplete |= s->own.incomplete;
}

struct stage_view stage_view(const struct stage *s)
{
    return s->view;
}

const struct stage_theme *stage_theme(const struct stage *s)
{
    return &s->theme;
}

struct stage_color stage_background(const struct stage *s)
{
    return s->theme.colors[STAGE_COLOR_BACKGROUND];
}
