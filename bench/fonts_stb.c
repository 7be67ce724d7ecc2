/* fonts_stb.c - see fonts_peers.h: stb_truetype, compiled here, as its users do. */
#include "fonts_peers.h"

#include <stdlib.h>
#include <string.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#pragma GCC diagnostic ignored "-Wundef"
#pragma GCC diagnostic ignored "-Wswitch-enum"
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb_truetype.h>
#pragma GCC diagnostic pop

struct peer_stb {
    stbtt_fontinfo font;
    float scale;
    uint8_t *pixels;
    size_t size;
};

struct peer_stb *peer_stb_create(const void *bytes, double size_px)
{
    struct peer_stb *p = calloc(1, sizeof *p);
    if (p && !stbtt_InitFont(&p->font, bytes, stbtt_GetFontOffsetForIndex(bytes, 0))) {
        free(p);
        return NULL;
    }
    if (p)
        p->scale = stbtt_ScaleForMappingEmToPixels(&p->font, (float)size_px);
    return p;
}

void peer_stb_destroy(struct peer_stb *p)
{
    if (p)
        free(p->pixels);
    free(p);
}

bool peer_stb_draw(struct peer_stb *p, uint32_t glyph, double x_px, double y_px,
                   struct font_gray *gray)
{
    int x0, y0, x1, y1;
    stbtt_GetGlyphBitmapBoxSubpixel(&p->font, (int)glyph, p->scale, p->scale, (float)x_px,
                                    (float)y_px, &x0, &y0, &x1, &y1);
    int width = x1 - x0, height = y1 - y0;
    size_t size = (size_t)width * (size_t)height;
    if (size > p->size) {
        free(p->pixels);
        p->pixels = malloc(size);
        p->size = p->pixels ? size : 0;
        if (!p->pixels)
            return false;
    }
    memset(p->pixels, 0, size);
    stbtt_MakeGlyphBitmapSubpixel(&p->font, p->pixels, width, height, width, p->scale, p->scale,
                                  (float)x_px, (float)y_px, (int)glyph);
    *gray = (struct font_gray){.left_px = x0,
                               .top_px = y0,
                               .width_px = width,
                               .height_px = height,
                               .pitch = width,
                               .pixels = p->pixels};
    return true;
}
