/* colour_spread.c - a layout whose glyphs of layers are those layers: see text.h, colour.h. */
#include "colour.h"
#include "edges.h"
#include "internal.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* The number of an ink for a layer; 0: the text's own. -1: no memory. */
static int layer_ink(struct font_layout *to, const struct font_placed *g,
                     const struct font_colour_layer *layer)
{
    if (!layer->own)
        return g->ink;
    double left = 1;
    if (g->ink > 0 && to->inks[g->ink - 1].kind == FONT_INK_PLAIN)
        left = to->inks[g->ink - 1].rgba[3];
    const double *c = layer->rgba;
    const struct font_ink own = font_ink_plain(c[0], c[1], c[2], c[3] * left);
    int number = font_layout_ink_add(to, &own);
    return number ? number : -1;
}

static bool glyph_add(struct font_layout *to, const struct font_placed *g)
{
    if (!array_reserve(&to->glyphs, &to->glyphs_capacity, to->glyphs_count + 1,
                       sizeof *to->glyphs))
        return false;
    to->glyphs[to->glyphs_count++] = *g;
    return true;
}

static bool glyph_spread(struct font_layout *to, const struct font_placed *g)
{
    struct font_colour_layer layers[FONT_COLOUR_LAYERS_MAX];
    if (font_colour_of(g->face, g->glyph) != FONT_COLOUR_LAYERS)
        return glyph_add(to, g);
    int count = font_colour_layers(g->face, g->glyph, layers);
    for (int i = 0; i < count; i++) {
        struct font_placed one = *g;
        one.glyph = layers[i].glyph;
        one.ink = layer_ink(to, g, &layers[i]);
        if (one.ink < 0 || !glyph_add(to, &one))
            return false;
    }
    return true;
}

enum font_status font_colour_spread(const struct font_layout *from, struct font_layout *out)
{
    *out = *from;
    out->glyphs = NULL;
    out->lines = NULL;
    out->inks = NULL;
    out->maps = NULL;
    out->glyphs_count = out->glyphs_capacity = out->lines_count = out->lines_capacity = 0;
    out->inks_count = out->inks_capacity = out->maps_count = out->maps_capacity = 0;
    bool good = true;
    for (int i = 0; good && i < from->inks_count; i++)
        good = font_layout_ink_add(out, &from->inks[i]);
    for (int i = 0; good && i < from->maps_count; i++)
        good = font_layout_map_add(out, &from->maps[i]);
    for (int i = 0; good && i < from->glyphs_count; i++)
        good = glyph_spread(out, &from->glyphs[i]);
    if (good)
        return FONT_OK;
    font_layout_finish(out);
    return font_fail(FONT_NO_MEMORY, "no memory for layers of colours");
}
