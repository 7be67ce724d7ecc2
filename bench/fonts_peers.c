/* fonts_peers.c - see fonts_peers.h: FreeType and direct filtering. */
#include "fonts_peers.h"

#include <filter.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

static bool room(void **memory, size_t *have, size_t bytes)
{
    if (bytes <= *have)
        return true;
    free(*memory);
    *memory = malloc(bytes);
    *have = *memory ? bytes : 0;
    return *memory != NULL;
}

/* ---- FreeType ---- */

struct peer_freetype {
    FT_Library library;
    FT_Face face;
    FT_Outline slots[PEER_SLOTS];
    bool kept[PEER_SLOTS];
    uint8_t *pixels;
    size_t pixels_size;
};

struct peer_freetype *peer_freetype_create(const void *bytes, size_t count, double size_px)
{
    struct peer_freetype *p = calloc(1, sizeof *p);
    if (p && (FT_Init_FreeType(&p->library) ||
              FT_New_Memory_Face(p->library, bytes, (FT_Long)count, 0, &p->face) ||
              FT_Set_Char_Size(p->face, (FT_F26Dot6)lrint(size_px * 64), 0, 72, 72))) {
        peer_freetype_destroy(p);
        return NULL;
    }
    return p;
}

void peer_freetype_destroy(struct peer_freetype *p)
{
    if (!p)
        return;
    for (int i = 0; i < PEER_SLOTS; i++)
        if (p->kept[i])
            FT_Outline_Done(p->library, &p->slots[i]);
    if (p->library)
        FT_Done_FreeType(p->library);
    free(p->pixels);
    free(p);
}

bool peer_freetype_draw(struct peer_freetype *p, uint32_t glyph, double x_px, double y_px,
                        struct font_gray *gray)
{
    if (FT_Load_Glyph(p->face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP))
        return false;
    FT_GlyphSlot slot = p->face->glyph;
    if (x_px != 0 || y_px != 0)
        FT_Outline_Translate(&slot->outline, lrint(x_px * 64), -lrint(y_px * 64));
    if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL))
        return false;
    *gray = (struct font_gray){.left_px = slot->bitmap_left,
                               .top_px = -slot->bitmap_top,
                               .width_px = (int)slot->bitmap.width,
                               .height_px = (int)slot->bitmap.rows,
                               .pitch = slot->bitmap.pitch,
                               .pixels = slot->bitmap.buffer};
    return true;
}

bool peer_freetype_keep(struct peer_freetype *p, int slot, uint32_t glyph, double x_px,
                        double y_px)
{
    if (FT_Load_Glyph(p->face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP))
        return false;
    FT_Outline *from = &p->face->glyph->outline, *to = &p->slots[slot];
    if (p->kept[slot])
        FT_Outline_Done(p->library, to);
    p->kept[slot] =
        FT_Outline_New(p->library, (FT_UInt)from->n_points, from->n_contours, to) == 0;
    if (!p->kept[slot] || FT_Outline_Copy(from, to))
        return false;
    FT_Outline_Translate(to, lrint(x_px * 64), -lrint(y_px * 64));
    return true;
}

bool peer_freetype_raster(struct peer_freetype *p, int slot, struct font_gray *gray)
{
    FT_BBox box;
    FT_Outline *outline = &p->slots[slot];
    FT_Outline_Get_CBox(outline, &box);
    int left = (int)(box.xMin >> 6), bottom = (int)(box.yMin >> 6);
    int width = (int)((box.xMax + 63) >> 6) - left,
        height = (int)((box.yMax + 63) >> 6) - bottom;
    size_t size = (size_t)width * (size_t)height;
    if (!room((void **)&p->pixels, &p->pixels_size, size))
        return false;
    FT_Bitmap bitmap = {.rows = (unsigned)height,
                        .width = (unsigned)width,
                        .pitch = width,
                        .buffer = p->pixels,
                        .num_grays = 256,
                        .pixel_mode = FT_PIXEL_MODE_GRAY};
    memset(p->pixels, 0, size);
    FT_Outline_Translate(outline, -left * 64, -bottom * 64);
    bool ok = FT_Outline_Get_Bitmap(p->library, outline, &bitmap) == 0;
    FT_Outline_Translate(outline, left * 64, bottom * 64);
    *gray = (struct font_gray){.left_px = left,
                               .top_px = -(bottom + height),
                               .width_px = width,
                               .height_px = height,
                               .pitch = width,
                               .pixels = p->pixels};
    return ok;
}

/* ---- direct ---- */

struct peer_direct {
    const struct font_filter *filter;
    uint8_t *master; /* a byte a pixel */
    size_t master_size;
    uint8_t *pixels;
    size_t pixels_size;
    float *weights;
    size_t weights_size;
};

struct peer_direct *peer_direct_create(const struct font_filter *filter)
{
    struct peer_direct *p = calloc(1, sizeof *p);
    if (p)
        p->filter = filter;
    return p;
}

void peer_direct_destroy(struct peer_direct *p)
{
    if (!p)
        return;
    free(p->master);
    free(p->pixels);
    free(p->weights);
    free(p);
}

bool peer_direct_draw(struct peer_direct *p, const struct font_master *m, double size_px,
                      double x_px, double y_px, struct font_gray *gray)
{
    struct font_filter_info info;
    font_filter_describe(p->filter, &info);
    double scale = m->em_px / size_px, r = info.radius_px; /* master pixels for each pixel */
    int left = (int)floor(m->left_px / scale + x_px - r),
        top = (int)floor(m->top_px / scale + y_px - r);
    int right = (int)ceil((m->left_px + m->width_px) / scale + x_px + r);
    int bottom = (int)ceil((m->top_px + m->height_px) / scale + y_px + r);
    int width = right - left, height = bottom - top, reach = (int)ceil(2 * r * scale) + 2;
    size_t ink = (size_t)m->width_px * (size_t)m->height_px;
    if (!room((void **)&p->master, &p->master_size, ink) ||
        !room((void **)&p->pixels, &p->pixels_size, (size_t)width * (size_t)height) ||
        !room((void **)&p->weights, &p->weights_size, 2 * (size_t)reach * sizeof(float)))
        return false;
    for (int y = 0; y < m->height_px; y++)
        for (int x = 0; x < m->width_px; x++)
            p->master[(size_t)y * (size_t)m->width_px + (size_t)x] =
                font_master_at(m, x + m->left_px, y + m->top_px);
    float *wx = p->weights, *wy = p->weights + reach;
    double peak = font_filter_at(p->filter, 0, 0);
    for (int j = 0; j < height; j++) {
        double yc = (top + j + 0.5 - y_px) * scale - m->top_px;
        int y0 = (int)fmax(0, ceil(yc - r * scale)),
            y1 = (int)fmin(m->height_px, floor(yc + r * scale));
        for (int y = y0; y < y1; y++)
            wy[y - y0] = (float)(font_filter_at(p->filter, 0, (y + 0.5 - yc) / scale) / peak);
        for (int i = 0; i < width; i++) {
            double xc = (left + i + 0.5 - x_px) * scale - m->left_px;
            int x0 = (int)fmax(0, ceil(xc - r * scale));
            int x1 = (int)fmin(m->width_px, floor(xc + r * scale));
            float sum = 0;
            for (int x = x0; x < x1; x++)
                wx[x - x0] = (float)(font_filter_at(p->filter, (x + 0.5 - xc) / scale, 0));
            for (int y = y0; y < y1; y++) {
                const uint8_t *row = p->master + (size_t)y * (size_t)m->width_px;
                float along = 0;
                for (int x = x0; x < x1; x++)
                    along += wx[x - x0] * row[x];
                sum += along * wy[y - y0];
            }
            double value = 255 * sum / (scale * scale) + 0.5;
            p->pixels[(size_t)j * (size_t)width + (size_t)i] =
                (uint8_t)fmin(255, fmax(0, value));
        }
    }
    *gray = (struct font_gray){.left_px = left,
                               .top_px = top,
                               .width_px = width,
                               .height_px = height,
                               .pitch = width,
                               .pixels = p->pixels};
    return true;
}
