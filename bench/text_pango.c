/* text_pango.c - see text_pango.h. */
#include "text_pango.h"

#include <stdlib.h>

#ifdef LUTETIA_PANGO
#include <math.h>
#include <pango/pangoft2.h>

struct peer_pango {
    PangoFontMap *map;
    PangoContext *context;
    PangoFontDescription *font;
    double width_px;
};

struct peer_pango *peer_pango_create(const char *family, double size_px, double width_px)
{
    struct peer_pango *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    p->map = pango_ft2_font_map_new();
    pango_ft2_font_map_set_resolution(PANGO_FT2_FONT_MAP(p->map), 72, 72);
    p->context = pango_font_map_create_context(p->map);
    p->font = pango_font_description_new();
    pango_font_description_set_family(p->font, family);
    pango_font_description_set_absolute_size(p->font, size_px * PANGO_SCALE);
    p->width_px = width_px;
    return p;
}

void peer_pango_destroy(struct peer_pango *p)
{
    if (!p)
        return;
    pango_font_description_free(p->font);
    g_object_unref(p->context);
    g_object_unref(p->map);
    free(p);
}

int peer_pango_layout(struct peer_pango *p, const char *text, size_t bytes)
{
    PangoLayout *layout = pango_layout_new(p->context);
    pango_layout_set_font_description(layout, p->font);
    pango_layout_set_width(layout, (int)lrint(p->width_px * PANGO_SCALE));
    pango_layout_set_justify(layout, TRUE);
    pango_layout_set_text(layout, text, (int)bytes);
    int lines = pango_layout_get_line_count(layout);
    g_object_unref(layout);
    return lines;
}

#else

struct peer_pango *peer_pango_create(const char *family, double size_px, double width_px)
{
    (void)family;
    (void)size_px;
    (void)width_px;
    return NULL;
}

void peer_pango_destroy(struct peer_pango *p)
{
    free(p);
}

int peer_pango_layout(struct peer_pango *p, const char *text, size_t bytes)
{
    (void)p;
    (void)text;
    (void)bytes;
    return 0;
}

#endif
