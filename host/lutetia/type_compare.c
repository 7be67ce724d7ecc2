/* type_compare.c - `lutetia type --compare`: the same text in gray by the pipeline, by the
 * definition in double precision and by FreeType's rasteriser, and how far they are from
 * each other, as pictures. FreeType has only the box filter, so it is compared with the
 * exact box. */
#include "lutetia.h"
#include "type_common.h"

#include <gold.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H
#include FT_OUTLINE_H

struct compare {
    const struct font_layout *layout;
    const struct font_map *map;
    struct font_filter *filter, *box;
    int left, top, width, height;
    double *ours, *gold, *gold_box, *freetype; /* 1 is full */
};

/* The map from one glyph to the picture, including its place. */
static enum font_status glyph_map(const struct compare *c, int i, double x_px, double y_px,
                                  struct font_map *out)
{
    const struct font_placed *g = &c->layout->glyphs[i];
    struct font_face_info info;
    struct font_map pixels;
    double x, y;
    font_face_describe(g->face, &info);
    struct font_map own = font_map_size(font_placed_size(c->layout, g), info.units_per_em);
    enum font_status status =
        font_placed_map(c->layout, i, c->map, x_px, y_px, &pixels, &x, &y);
    if (status == FONT_OK)
        status = font_map_compose(&own, &pixels, out);
    struct font_map move = {FONT_AFFINE, {1, 0, x, 0, 1, y}};
    *out = font_map_then(*out, move);
    return status;
}

/* Called for each glyph. */
typedef int each_glyph(struct compare *c, const struct font_placed *g,
                       const struct font_outline *outline, const struct font_map *map);

static int glyphs_each(struct compare *c, double x_px, double y_px, each_glyph *each)
{
    int status = EXIT_SUCCESS;
    for (int i = 0; i < c->layout->glyphs_count && status == EXIT_SUCCESS; i++) {
        const struct font_placed *g = &c->layout->glyphs[i];
        struct font_outline outline = {0};
        struct font_map map;
        if (font_face_outline(g->face, g->glyph, &outline) != FONT_OK ||
            glyph_map(c, i, x_px, y_px, &map) != FONT_OK)
            status = fail_font("type");
        if (status == EXIT_SUCCESS)
            status = each(c, g, &outline, &map);
        font_outline_finish(&outline);
    }
    return status;
}

static int bounds_take(struct compare *c, const struct font_placed *g,
                       const struct font_outline *outline, const struct font_map *map)
{
    struct font_edges edges = {0};
    struct font_gray place;
    (void)g;
    int status = EXIT_SUCCESS;
    if (font_edges_build(&edges, outline, map, c->filter) != FONT_OK ||
        font_gray_place(&place, &edges, c->filter, 0, 0) != FONT_OK)
        status = fail_font("type");
    else if (place.width_px) {
        int right = c->left + c->width, bottom = c->top + c->height;
        bool first = c->width == 0;
        int x1 = place.left_px + place.width_px + 1, y1 = place.top_px + place.height_px + 1;
        c->left = first || place.left_px - 1 < c->left ? place.left_px - 1 : c->left;
        c->top = first || place.top_px - 1 < c->top ? place.top_px - 1 : c->top;
        c->width = (first || x1 > right ? x1 : right) - c->left;
        c->height = (first || y1 > bottom ? y1 : bottom) - c->top;
    }
    font_edges_finish(&edges);
    return status;
}

static int pixels_take(struct compare *c, const struct font_placed *g,
                       const struct font_outline *outline, const struct font_map *map)
{
    (void)g;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    size_t count = (size_t)c->width * (size_t)c->height;
    double *part = malloc(count * sizeof *part);
    int status = EXIT_SUCCESS;
    if (!part)
        status = fail("type", "no memory to compare");
    else if (font_edges_build(&edges, outline, map, c->filter) != FONT_OK ||
             font_gray_draw(&gray, &edges, c->filter, 0, 0) != FONT_OK)
        status = fail_font("type");
    for (int r = 0; status == EXIT_SUCCESS && gray.pixels && r < gray.height_px; r++)
        for (int k = 0; k < gray.width_px; k++)
            c->ours[(gray.top_px + r - c->top) * c->width + gray.left_px + k - c->left] +=
                gray.pixels[r * gray.pitch + k] / 255.0;
    for (int n = 0; n < 2 && status == EXIT_SUCCESS; n++) {
        double *to = n ? c->gold_box : c->gold;
        if (font_gold_draw(outline, map, n ? c->box : c->filter, 0, 0, c->left, c->top,
                           c->width, c->height, part) != FONT_OK)
            status = fail_font("type");
        for (size_t i = 0; status == EXIT_SUCCESS && i < count; i++)
            to[i] += part[i];
    }
    free(part);
    font_edges_finish(&edges);
    font_gray_finish(&gray);
    return status;
}

/* ---- FreeType ---- */

/* Opens the face again, by FreeType alone, with the same axes. */
static FT_Face freetype_open(FT_Library library, struct font_face *face)
{
    FT_Face ft;
    size_t count;
    const void *bytes = font_face_bytes(face, &count);
    struct font_face_info info;
    font_face_describe(face, &info);
    if (FT_New_Memory_Face(library, bytes, (FT_Long)count, info.index, &ft))
        return NULL;
    FT_Fixed values[64];
    struct font_axis axis;
    int n = 0;
    for (; n < info.axes_count && n < 64 && font_face_axis(face, n, &axis) == FONT_OK; n++)
        values[n] = lrint(axis.value * 65536);
    if (n)
        FT_Set_Var_Design_Coordinates(ft, (FT_UInt)n, values);
    return ft;
}

/* Draws a glyph by FreeType: a size in 1/64 pixels, a matrix and an offset. It has no
 * distortions that bend lines. */
static int freetype_glyph(struct compare *c, FT_Face ft, const struct font_placed *g,
                          const struct font_map *map, uint8_t *pixels)
{
    double size = c->layout->size_px;
    struct font_face_info info;
    font_face_describe(g->face, &info);
    double em = info.units_per_em / size;
    if (FT_Set_Char_Size(ft, (FT_F26Dot6)lrint(size * 64), 0, 72, 72) ||
        FT_Load_Glyph(ft, g->glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) ||
        ft->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
        return fail("type", "FreeType cannot draw glyph %u", (unsigned)g->glyph);
    FT_Matrix matrix = {lrint(map->m[0] * em * 65536), lrint(map->m[1] * em * 65536),
                        -lrint(map->m[3] * em * 65536), -lrint(map->m[4] * em * 65536)};
    FT_Outline_Transform(&ft->glyph->outline, &matrix);
    FT_Outline_Translate(&ft->glyph->outline, lrint((map->m[2] - c->left) * 64),
                         lrint((c->height + c->top - map->m[5]) * 64));
    FT_Bitmap bitmap = {.rows = (unsigned)c->height,
                        .width = (unsigned)c->width,
                        .pitch = c->width,
                        .buffer = pixels,
                        .num_grays = 256,
                        .pixel_mode = FT_PIXEL_MODE_GRAY};
    memset(pixels, 0, (size_t)c->width * (size_t)c->height);
    if (FT_Outline_Get_Bitmap(ft->glyph->library, &ft->glyph->outline, &bitmap))
        return fail("type", "FreeType cannot draw glyph %u", (unsigned)g->glyph);
    for (size_t i = 0; i < (size_t)c->width * (size_t)c->height; i++)
        c->freetype[i] += pixels[i] / 255.0;
    return EXIT_SUCCESS;
}

static int freetype_draw(struct compare *c, double x_px, double y_px)
{
    FT_Library library;
    if (FT_Init_FreeType(&library))
        return fail("type", "FreeType cannot be started");
    uint8_t *pixels = malloc((size_t)c->width * (size_t)c->height);
    int status = pixels ? EXIT_SUCCESS : fail("type", "no memory to compare");
    FT_Face ft = NULL;
    const struct font_face *last = NULL;
    for (int i = 0; i < c->layout->glyphs_count && status == EXIT_SUCCESS; i++) {
        const struct font_placed *g = &c->layout->glyphs[i];
        struct font_map map;
        if (g->face != last) {
            if (ft)
                FT_Done_Face(ft);
            ft = freetype_open(library, g->face);
            last = g->face;
        }
        if (!ft)
            status = fail("type", "FreeType cannot open the font");
        else if (glyph_map(c, i, x_px, y_px, &map) != FONT_OK)
            status = fail_font("type");
        else
            status = freetype_glyph(c, ft, g, &map, pixels);
    }
    free(pixels);
    FT_Done_FreeType(library);
    return status;
}

/* ---- the picture ---- */

struct panel {
    const char *what;
    const double *pixels, *against; /* with `against`: shows the difference as colour */
};

static void panel_draw(const struct compare *c, const struct panel *p, int zoom,
                       struct display_image *image, int x, int y)
{
    for (int r = 0; r < c->height * zoom; r++)
        for (int k = 0; k < c->width * zoom; k++) {
            size_t at = (size_t)(r / zoom) * (size_t)c->width + (size_t)(k / zoom);
            uint8_t *to = image->pixels +
                          3 * ((size_t)(y + r) * (size_t)image->width_px + (size_t)(x + k));
            if (p->against) { /* red: too much ink, blue: too little; 1/32 of full coverage
                               * is the full colour */
                double d = 32 * (p->pixels[at] - fmin(fmax(p->against[at], 0), 1));
                double much = fmin(1, fmax(0, d)), little = fmin(1, fmax(0, -d));
                to[0] = (uint8_t)lrint(255 * (1 - little));
                to[1] = (uint8_t)lrint(255 * (1 - much - little));
                to[2] = (uint8_t)lrint(255 * (1 - much));
            } else {
                double light = 1 - fmin(1, fmax(0, p->pixels[at]));
                to[0] = to[1] = to[2] = (uint8_t)lrint(255 * font_number(light, 0));
            }
        }
}

static void difference(const struct compare *c, const double *a, const double *gold,
                       double *max, double *psnr)
{
    double square = 0;
    size_t count = (size_t)c->width * (size_t)c->height;
    *max = 0;
    for (size_t i = 0; i < count; i++) {
        double d = a[i] - fmin(fmax(gold[i], 0), 1);
        *max = fmax(*max, 255 * fabs(d));
        square += d * d;
    }
    *psnr = square > 0 ? -10 * log10(square / (double)count) : 200;
}

static int compare_write(const struct compare *c, const char *path, const char *filter,
                         int zoom)
{
    enum { LABEL = 22, GAP = 8 };
    struct panel panels[] = {{"lutetia", c->ours, NULL},
                             {"exact, in double precision", c->gold, NULL},
                             {"lutetia - exact", c->ours, c->gold},
                             {"FreeType", c->freetype, NULL},
                             {"exact box", c->gold_box, NULL},
                             {"FreeType - exact box", c->freetype, c->gold_box}};
    bool affine = c->map->kind == FONT_AFFINE;
    int rows = affine ? 2 : 1, panel_width = c->width * zoom + GAP;
    int panel_height = c->height * zoom + LABEL + GAP;
    double max, psnr, width = 3.0 * panel_width + GAP;
    struct display_image image = {0};
    int status = type_image_create("type", fmax(width, 2.0 * panel_width + 370),
                                   rows * (double)panel_height + GAP, &image);
    if (status != EXIT_SUCCESS)
        return status;
    struct type_labels *labels = type_labels_create(13);
    for (int i = 0; i < 3 * rows; i++) {
        int x = GAP + i % 3 * panel_width, y = GAP + i / 3 * panel_height + LABEL;
        panel_draw(c, &panels[i], zoom, &image, x, y);
        if (panels[i].against) {
            difference(c, panels[i].pixels, panels[i].against, &max, &psnr);
            type_label(labels, &image, x, y - 6, "%s: at most %.2f of 255, %.1f dB",
                       panels[i].what, max, psnr);
            printf("%s: at most %.2f of 255, %.1f dB\n", panels[i].what, max, psnr);
        } else {
            type_label(labels, &image, x, y - 6, "%s%s%s", panels[i].what, i == 0 ? ", " : "",
                       i == 0 ? filter : "");
        }
    }
    type_labels_destroy(labels);
    status = type_image_write("type", path, &image);
    display_image_destroy(&image);
    return status;
}

int type_compare(const char *verb, const char *path, const struct font_layout *layout,
                 const struct font_map *map, const char *filter, double x_px, double y_px,
                 int zoom)
{
    struct compare c = {.layout = layout, .map = map};
    int status = EXIT_SUCCESS;
    if (font_filter_create_named(filter, &c.filter) != FONT_OK ||
        font_filter_create_named("box", &c.box) != FONT_OK)
        status = fail_font(verb);
    if (status == EXIT_SUCCESS)
        status = glyphs_each(&c, x_px, y_px, bounds_take);
    if (status == EXIT_SUCCESS && (double)c.width * c.height > 4e6)
        status = fail(verb, "--compare is for small pictures: %dx%d pixels would take hours",
                      c.width, c.height);
    if (status == EXIT_SUCCESS && c.width == 0)
        status = fail(verb, "there is no ink to compare");
    if (status == EXIT_SUCCESS) {
        size_t count = (size_t)c.width * (size_t)c.height;
        double *all = calloc(4 * count, sizeof *all);
        c.ours = all;
        if (!all) {
            status = fail(verb, "no memory to compare");
        } else {
            c.gold = all + count;
            c.gold_box = all + 2 * count;
            c.freetype = all + 3 * count;
            status = glyphs_each(&c, x_px, y_px, pixels_take);
        }
    }
    if (status == EXIT_SUCCESS && map->kind == FONT_AFFINE)
        status = freetype_draw(&c, x_px, y_px);
    if (status == EXIT_SUCCESS)
        status = compare_write(&c, path, filter, zoom);
    free(c.ours);
    font_filter_destroy(c.filter);
    font_filter_destroy(c.box);
    return status;
}
