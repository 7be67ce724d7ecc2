/* place.c - the position of a layout's glyph, from the glyph's own map, its place and the
 * text's map. See text.h. */
#include "edges.h"
#include "internal.h"
#include "text.h"

double font_placed_size(const struct font_layout *layout, const struct font_placed *g)
{
    return g->size_px > 0 ? (double)g->size_px : layout->size_px;
}

/* First the one, then the other, where that is a map of a kind there is. */
static enum font_status map_join(const struct font_map *first, const struct font_map *second,
                                 struct font_map *out)
{
    if (first->kind == FONT_AFFINE)
        return font_map_compose(first, second, out);
    if (second->kind == FONT_AFFINE) {
        *out = font_map_then(*first, *second);
        return FONT_OK;
    }
    if (first->kind != FONT_PROJECTIVE || second->kind != FONT_PROJECTIVE)
        return font_fail(FONT_BAD_ARGUMENT,
                         "a glyph with a distortion of its own cannot be distorted again, "
                         "unless both are projective");
    struct font_map joined = {.kind = FONT_PROJECTIVE};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                joined.m[3 * r + c] += second->m[3 * r + k] * first->m[3 * k + c];
    *out = joined;
    return FONT_OK;
}

enum font_status font_placed_map(const struct font_layout *layout, int i,
                                 const struct font_map *map, double x_px, double y_px,
                                 struct font_map *out, double *x, double *y)
{
    static const struct font_map same = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    const struct font_placed *g = &layout->glyphs[i];
    struct font_map own = g->map > 0 ? layout->maps[g->map - 1] : same;
    struct font_map text = map ? *map : same;
    struct font_map moved = {FONT_AFFINE, {1, 0, g->x_px, 0, 1, g->y_px}};
    *x = x_px;
    *y = y_px;
    if (own.kind != FONT_AFFINE || text.kind != FONT_AFFINE) {
        enum font_status status = map_join(&own, &moved, &own);
        return status == FONT_OK ? map_join(&own, &text, out) : status;
    }
    /* What is left over as a translation is the place. */
    struct font_point at = {g->x_px + own.m[2], g->y_px + own.m[5]};
    double jacobian[4];
    font_map_point(&text, at, &at, jacobian);
    own.m[2] = own.m[5] = text.m[2] = text.m[5] = 0;
    *out = font_map_then(own, text);
    *x += at.x;
    *y += at.y;
    return FONT_OK;
}

int font_layout_map_add(struct font_layout *l, const struct font_map *map)
{
    if (!array_reserve(&l->maps, &l->maps_capacity, l->maps_count + 1, sizeof *l->maps))
        return 0;
    l->maps[l->maps_count] = *map;
    return ++l->maps_count;
}

int font_layout_ink_add(struct font_layout *l, const struct font_ink *ink)
{
    if (!array_reserve(&l->inks, &l->inks_capacity, l->inks_count + 1, sizeof *l->inks))
        return 0;
    l->inks[l->inks_count] = *ink;
    return ++l->inks_count;
}
