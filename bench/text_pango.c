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
    peer_pango_set(p, family, size_px, width_px);
    return p;
}

void peer_pango_set(struct peer_pango *p, const char *family, double size_px, double width_px)
{
    pango_font_description_set_family(p->font, family);
    pango_font_description_set_absolute_size(p->font, size_px * PANGO_SCALE);
    p->width_px = width_px;
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

int peer_pango_keep(struct peer_pango *p, const char *text, size_t bytes, void **kept)
{
    PangoLayout *layout = pango_layout_new(p->context);
    pango_layout_set_font_description(layout, p->font);
    pango_layout_set_width(layout, (int)lrint(p->width_px * PANGO_SCALE));
    pango_layout_set_justify(layout, TRUE);
    pango_layout_set_text(layout, text, (int)bytes);
    *kept = layout;
    return pango_layout_get_line_count(layout);
}

void peer_pango_release(void *kept)
{
    if (kept)
        g_object_unref(kept);
}

int peer_pango_layout(struct peer_pango *p, const char *text, size_t bytes)
{
    void *layout;
    const int lines = peer_pango_keep(p, text, bytes, &layout);
    peer_pango_release(layout);
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

void peer_pango_set(struct peer_pango *p, const char *family, double size_px, double width_px)
{
    (void)p;
    (void)family;
    (void)size_px;
    (void)width_px;
}

int peer_pango_layout(struct peer_pango *p, const char *text, size_t bytes)
{
    (void)p;
    (void)text;
    (void)bytes;
    return 0;
}

int peer_pango_keep(struct peer_pango *p, const char *text, size_t bytes, void **kept)
{
    (void)p;
    (void)text;
    (void)bytes;
    *kept = NULL;
    return 0;
}

void peer_pango_release(void *kept)
{
    (void)kept;
}

#endif
