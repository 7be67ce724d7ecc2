/* draw_list.c - see draw_list.h. */
#include "draw_list.h"

#include <array.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ITEMS_MAX = 1 << 22 };
static const double place_most_px = 1e6, letter_most_px = STAGE_LETTER_MAX_PX;

void stage_draw_finish(struct stage_draw_list *list)
{
    free(list->items);
    memset(list, 0, sizeof *list);
}

void stage_draw_begin(struct stage_draw_list *list, struct stage_view view)
{
    list->count = 0;
    list->incomplete = false;
    list->view = view;
}

void stage_draw_view(struct stage_draw_list *list, struct stage_view view)
{
    list->view = view;
}

void stage_view_to_px(struct stage_view view, double x, double y, double *x_px, double *y_px)
{
    *x_px = view.scale != 0 ? view.x0_px + view.scale * x : x;
    *y_px = view.scale != 0 ? view.y0_px - view.scale * y : y;
}

void stage_view_to_world(struct stage_view view, double x_px, double y_px, double *x, double *y)
{
    *x = view.scale != 0 ? (x_px - view.x0_px) / view.scale : x_px;
    *y = view.scale != 0 ? (view.y0_px - y_px) / view.scale : y_px;
}

/* Appends a new item; NULL: no memory. */
static struct stage_item *item_add(struct stage_draw_list *list, enum stage_draw_kind kind,
                                   struct stage_color color)
{
    if (list->count == ITEMS_MAX ||
        !array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items)) {
        list->incomplete = true;
        return NULL;
    }
    struct stage_item *item = &list->items[list->count++];
    memset(item, 0, sizeof *item);
    item->kind = kind;
    item->color = color;
    return item;
}

static bool is_near(double x_px, double y_px)
{
    return fabs(x_px) <= place_most_px && fabs(y_px) <= place_most_px;
}

/* ---- bars ---- */

static void bar_add(struct stage_draw_list *list, const struct stage_bar *bar,
                    struct stage_color color)
{
    double reach = bar->half_length_px + bar->half_width_px;
    if (!is_near(bar->x_px, bar->y_px) || !(reach <= 4 * place_most_px) || color.a <= 0)
        return;
    struct stage_item *item = item_add(list, STAGE_DRAW_BAR, color);
    if (item)
        item->bar = *bar;
}

void stage_draw_line(struct stage_draw_list *list, double x0, double y0, double x1, double y1,
                     double width_px, struct stage_color color)
{
    stage_view_to_px(list->view, x0, y0, &x0, &y0);
    stage_view_to_px(list->view, x1, y1, &x1, &y1);
    double length = hypot(x1 - x0, y1 - y0), half = width_px / 2;
    struct stage_bar bar = {.x_px = (x0 + x1) / 2,
                            .y_px = (y0 + y1) / 2,
                            .ux = length > 0 ? (x1 - x0) / length : 1,
                            .uy = length > 0 ? (y1 - y0) / length : 0,
                            .half_length_px = length / 2 + half,
                            .half_width_px = half,
                            .radius_px = half};
    bar_add(list, &bar, color);
}

void stage_draw_ring(struct stage_draw_list *list, double x, double y, double radius_px,
                     double width_px, struct stage_color color)
{
    struct stage_bar bar = {.ux = 1,
                            .half_length_px = radius_px,
                            .half_width_px = radius_px,
                            .radius_px = radius_px,
                            .ring_px = width_px};
    stage_view_to_px(list->view, x, y, &bar.x_px, &bar.y_px);
    bar_add(list, &bar, color);
}

void stage_draw_disc(struct stage_draw_list *list, double x, double y, double radius_px,
                     struct stage_color color)
{
    stage_draw_ring(list, x, y, radius_px, 0, color);
}

void stage_draw_box(struct stage_draw_list *list, double x0, double y0, double x1, double y1,
                    double radius_px, double ring_px, struct stage_color color)
{
    stage_view_to_px(list->view, x0, y0, &x0, &y0);
    stage_view_to_px(list->view, x1, y1, &x1, &y1);
    double half_length = fabs(x1 - x0) / 2, half_width = fabs(y1 - y0) / 2;
    struct stage_bar bar = {.x_px = (x0 + x1) / 2,
                            .y_px = (y0 + y1) / 2,
                            .ux = 1,
                            .half_length_px = half_length,
                            .half_width_px = half_width,
                            .radius_px = fmin(radius_px, fmin(half_length, half_width)),
                            .ring_px = ring_px};
    bar_add(list, &bar, color);
}

/* ---- letters ---- */

void stage_draw_letter(struct stage_draw_list *list, const struct stage_letter *letter,
                       const struct font_point corners[4], struct stage_color color)
{
    struct font_point px[4];
    struct stage_glyph glyph = {.face = letter->face,
                                .glyph = letter->glyph,
                                .size_px = letter->size,
                                .axes = letter->axes};
    if (color.a <= 0)
        return;
    for (int i = 0; i < 4; i++) {
        stage_view_to_px(list->view, corners[i].x, corners[i].y, &px[i].x, &px[i].y);
        if (!is_near(px[i].x, px[i].y) || !(fabs(px[i].x - px[0].x) <= letter_most_px) ||
            !(fabs(px[i].y - px[0].y) <= letter_most_px))
            return;
    }
    if (font_map_corners(FONT_SMOOTH, letter->x0, letter->y0, letter->x1, letter->y1, px,
                         &glyph.map) != FONT_OK)
        return;
    struct stage_item *item = item_add(list, STAGE_DRAW_GLYPH, color);
    if (item)
        item->glyph = glyph;
}

void stage_draw_text(struct stage_draw_list *list, const struct font_layout *layout, double x,
                     double y, struct stage_color color)
{
    stage_view_to_px(list->view, x, y, &x, &y);
    for (int i = 0; i < layout->glyphs_count; i++) {
        const struct font_placed *g = &layout->glyphs[i];
        if (!is_near(x + g->x_px, y + g->y_px))
            continue;
        struct stage_item *item = item_add(list, STAGE_DRAW_GLYPH, color);
        if (!item)
            return;
        item->glyph = (struct stage_glyph){.face = g->face,
                                           .glyph = g->glyph,
                                           .size_px = layout->size_px,
                                           .map = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}},
                                           .x_px = x + g->x_px,
                                           .y_px = y + g->y_px};
    }
}

void stage_draw_image(struct stage_draw_list *list, const uint8_t *rgb, int width, int height,
                      double x0, double y0, double x1, double y1)
{
    stage_view_to_px(list->view, x0, y0, &x0, &y0);
    stage_view_to_px(list->view, x1, y1, &x1, &y1);
    if (!is_near(x0, y0) || !is_near(x1, y1) || width < 1 || height < 1)
        return;
    struct stage_item *item =
        item_add(list, STAGE_DRAW_IMAGE, (struct stage_color){.r = 1, .g = 1, .b = 1, .a = 1});
    if (item)
        item->image = (struct stage_image){
            rgb, width, height, fmin(x0, x1), fmin(y0, y1), fmax(x0, x1), fmax(y0, y1)};
}

/* ---- again ---- */

static void item_move(struct stage_item *item, double x_px, double y_px)
{
    struct font_map to = {FONT_AFFINE, {1, 0, x_px, 0, 1, y_px}};
    if (item->kind == STAGE_DRAW_BAR) {
        item->bar.x_px += x_px;
        item->bar.y_px += y_px;
    } else if (item->kind == STAGE_DRAW_IMAGE) {
        item->image.x0_px += x_px;
        item->image.x1_px += x_px;
        item->image.y0_px += y_px;
        item->image.y1_px += y_px;
    } else if (item->glyph.map.kind == FONT_AFFINE) {
        item->glyph.x_px += x_px;
        item->glyph.y_px += y_px;
    } else {
        item->glyph.map = font_map_then(item->glyph.map, to);
    }
}

void stage_draw_again(struct stage_draw_list *list, const struct stage_draw_list *other,
                      double x_px, double y_px, const struct stage_color *tint, double fade,
                      bool letters_only)
{
    for (int i = 0; i < other->count; i++) {
        struct stage_item from = other->items[i];
        if (letters_only && from.kind != STAGE_DRAW_GLYPH)
            continue;
        if (tint)
            from.color = stage_color_fade(*tint, (double)from.color.a);
        struct stage_item *item = item_add(list, from.kind, stage_color_fade(from.color, fade));
        if (!item)
            return;
        from.color = item->color;
        *item = from;
        item_move(item, x_px, y_px);
    }
}

static void item_scale(struct stage_item *item, double scale)
{
    struct font_map to = {FONT_AFFINE, {scale, 0, 0, 0, scale, 0}};
    if (item->kind == STAGE_DRAW_BAR) {
        struct stage_bar *b = &item->bar;
        double *const lengths[] = {&b->x_px,          &b->y_px,      &b->half_length_px,
                                   &b->half_width_px, &b->radius_px, &b->ring_px};
        for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
            *lengths[i] *= scale;
    } else if (item->kind == STAGE_DRAW_IMAGE) {
        item->image.x0_px *= scale;
        item->image.x1_px *= scale;
        item->image.y0_px *= scale;
        item->image.y1_px *= scale;
    } else {
        item->glyph.x_px *= scale;
        item->glyph.y_px *= scale;
        item->glyph.map = font_map_then(item->glyph.map, to);
    }
}

void stage_draw_scaled(struct stage_draw_list *list, const struct stage_draw_list *other,
                       double scale, double x_px, double y_px)
{
    for (int i = 0; i < other->count; i++) {
        struct stage_item *item = item_add(list, other->items[i].kind, other->items[i].color);
        if (!item)
            return;
        *item = other->items[i];
        if (scale != 1)
            item_scale(item, scale);
        item_move(item, x_px, y_px);
    }
    list->incomplete |= other->incomplete;
}
