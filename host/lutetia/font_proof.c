/* font_proof.c - `lutetia font FILE --proof WORD`: one word by every filter at several sizes on
 * a sheet, with what it keeps in numbers. */
#include "font_verb.h"
#include "lutetia.h"
#include "type_common.h"

#include <own.h>
#include <proof.h>
#include <visible_text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A display's pixels are this far apart where distances are told. */
#define PITCH_MM (25.4 / 96)
#define ARCMIN (M_PI / 180 / 60)

enum { SIZES = 6, LINES_MAX = 16, LEFT = 130, TOP = 64, GAP = 26, NUMBERS = 34, BELOW = 12 };
static const double sizes[SIZES] = {9, 11, 13, 16, 20, 28};

struct sheet {
    const struct font_verb *v;
    struct font_face *face;
    struct font_shaper *shaper;
    enum font_display display;
    double x_height; /* of the em */
    const char *filters[LINES_MAX];
    int filters_count;
    bool has_own; /* the last line is by what the font has of its own */
    struct font_layout layouts[SIZES];
    double left[SIZES], width[SIZES], line_top[LINES_MAX], line_height;
    struct font_filter_fit fits[SIZES][LINES_MAX]; /* of the named ones, which are the first */
    int named_count;
    double stem; /* of the em */
    struct font_proof proofs[LINES_MAX][SIZES];
};

/* The height of x, or half an em where the font has none. */
static double x_height_of(struct font_face *face)
{
    struct font_outline o;
    uint32_t glyph = font_face_glyph(face, 'x');
    if (!glyph || font_face_outline(face, glyph, &o) != FONT_OK)
        return 0.5;
    double height = o.segments_count ? o.box.y1 / o.units_per_em : 0;
    font_outline_finish(&o);
    return height > 0.1 ? height : 0.5;
}

static enum font_status filters_take(struct sheet *s)
{
    bool there = false;
    for (const char *const *name = font_filter_names(); *name && s->named_count < LINES_MAX - 2;
         name++) {
        struct font_filter *filter;
        enum font_status status = font_filter_create_named(*name, &filter);
        if (status != FONT_OK)
            return status;
        for (int i = 0; i < SIZES; i++)
            s->fits[i][s->named_count] =
                font_filter_fit(filter, s->stem * sizes[i], s->display);
        font_filter_destroy(filter);
        there |= strcmp(*name, s->v->filter) == 0;
        s->filters[s->named_count++] = *name;
    }
    s->filters_count = s->named_count;
    if (!there)
        s->filters[s->filters_count++] = s->v->filter; /* one that was given by numbers */
    s->has_own = font_own_any(s->face);
    if (s->has_own)
        s->filters[s->filters_count++] = s->v->filter;
    return FONT_OK;
}

static bool is_own(const struct sheet *s, int line)
{
    return s->has_own && line == s->filters_count - 1;
}

/* Whether the line's filter suits the display best at a size. */
static bool suits(const struct sheet *s, int line, int i)
{
    return type_fits_best(s->fits[i], s->named_count, -1) == line;
}

static enum font_status sheet_measure(struct sheet *s)
{
    enum font_status status = FONT_OK;
    double x = LEFT, high = 0;
    for (int i = 0; i < SIZES && status == FONT_OK; i++) {
        status = font_shaper_layout(s->shaper, s->v->proof, strlen(s->v->proof), sizes[i], NULL,
                                    &s->layouts[i]);
        s->left[i] = x;
        s->width[i] = fmax(120, ceil(s->layouts[i].width_px));
        x += s->width[i] + GAP;
        high = fmax(high, s->layouts[i].ascent_px + s->layouts[i].descent_px);
    }
    s->line_height = ceil(high) + NUMBERS + 20;
    for (int line = 0; line < s->filters_count; line++)
        for (int i = 0; i < SIZES && status == FONT_OK; i++) {
            const struct font_proof_def def = {.layout = &s->layouts[i],
                                               .filter = s->filters[line],
                                               .display = s->display,
                                               .x_height_px = s->x_height * sizes[i],
                                               .own = is_own(s, line)};
            status = font_proof_make(&def, &s->proofs[line][i]);
        }
    return status;
}

/* From how far the word can be read by the model, in metres. */
static double metres(const struct sheet *s, int line, int i)
{
    return s->proofs[line][i].reach * s->x_height * sizes[i] * PITCH_MM / (5 * ARCMIN) / 1000;
}

static void sheet_print(const struct sheet *s)
{
    printf("%-24s %5s  %8s  %7s  %7s  %6s\n", "filter", "px", "contrast", "edge px", "error",
           "read m");
    for (int line = 0; line < s->filters_count; line++)
        for (int i = 0; i < SIZES; i++) {
            const struct font_proof *p = &s->proofs[line][i];
            visible_print("%-24.24s %5g  %6.0f %%  %7.2f  %7.1f  %6.2f%s\n",
                          is_own(s, line) ? "the font's own" : s->filters[line], sizes[i],
                          100 * p->contrast, p->edge_px, p->error, metres(s, line, i),
                          suits(s, line, i) ? "  suits the display" : "");
        }
    for (int i = 0; i < SIZES; i++) {
        printf("%g px: ", sizes[i]);
        type_fits_print(s->filters, s->fits[i], s->named_count, s->stem * sizes[i]);
    }
}

static enum font_status line_draw(const struct sheet *s, int line, struct type_labels *small,
                                  struct display_image *image)
{
    static const uint8_t frame[3] = {120, 160, 220}, white[3] = {255, 255, 255};
    const double top = TOP + line * s->line_height;
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_picture picture = type_picture(image);
    def.filter = s->filters[line];
    def.without_own = !is_own(s, line);
    enum font_status status = font_painter_create(&def, &painter);
    for (int i = 0; i < SIZES && status == FONT_OK; i++) {
        const struct font_proof *p = &s->proofs[line][i];
        const double x = s->left[i],
                     base = top + s->line_height - NUMBERS - 14 - s->layouts[i].descent_px;
        if (suits(s, line, i)) {
            const double right = x + s->width[i] + 7, low = top + s->line_height - 6;
            font_box_fill(image, x - 7, top - 2, right, low, frame);
            font_box_fill(image, x - 6, top - 1, right - 1, low - 1, white);
        }
        status = font_painter_layout(painter, &s->layouts[i], NULL, x, base, &picture);
        type_label(small, image, x, top + s->line_height - 28, "%.0f %%   %.2f px",
                   100 * p->contrast, p->edge_px);
        type_label(small, image, x, top + s->line_height - 14, "error %.1f   %.2f m", p->error,
                   metres(s, line, i));
    }
    font_painter_destroy(painter);
    return status;
}

static int sheet_draw(const struct sheet *s)
{
    static const char *const displays[] = {"lcd", "crt", "print"};
    struct display_image image = {0};
    struct font_face_info info;
    font_face_describe(s->face, &info);
    int status = type_image_create("font", s->left[SIZES - 1] + s->width[SIZES - 1] + GAP,
                                   TOP + s->filters_count * s->line_height + BELOW, &image);
    struct type_labels *labels = type_labels_create(13), *small = type_labels_create(10.5);
    if (status == EXIT_SUCCESS)
        type_label(labels, &image, 12, 24,
                   "%.80s %.60s: contrast, width of an edge; error to the cover, of 255; read "
                   "from (96 pixels to the inch, %s). Framed: suits the display",
                   info.family, info.style, displays[s->display]);
    for (int i = 0; i < SIZES && status == EXIT_SUCCESS; i++)
        type_label(small, &image, s->left[i], 48, "%g px, stems of %.2f", sizes[i],
                   s->stem * sizes[i]);
    for (int line = 0; line < s->filters_count && status == EXIT_SUCCESS; line++) {
        const char *name = is_own(s, line) ? "the font's own" : s->filters[line];
        type_label(labels, &image, 12, TOP + (line + 1) * s->line_height - NUMBERS - 18,
                   "%.18s%s", name, strlen(name) > 18 ? ".." : "");
        if (line_draw(s, line, small, &image) != FONT_OK)
            status = fail_font("font");
    }
    type_labels_destroy(labels);
    type_labels_destroy(small);
    if (status == EXIT_SUCCESS)
        status = type_image_write("font", s->v->out_path, &image);
    display_image_destroy(&image);
    return status;
}

int font_proof_show(const struct font_verb *v, struct font_face *face)
{
    static struct sheet s; /* its numbers are many */
    s = (struct sheet){
        .v = v, .face = face, .x_height = x_height_of(face), .stem = font_face_stem(face)};
    int status = type_display_read("font", v->display, &s.display);
    if (status != EXIT_SUCCESS)
        return status;
    if (filters_take(&s) != FONT_OK || font_shaper_create(face, &s.shaper) != FONT_OK ||
        sheet_measure(&s) != FONT_OK)
        status = fail_font("font");
    if (status == EXIT_SUCCESS) {
        type_missing_tell("font", v->file, &s.layouts[0]);
        sheet_print(&s);
        status = sheet_draw(&s);
    }
    for (int i = 0; i < SIZES; i++)
        font_layout_finish(&s.layouts[i]);
    font_shaper_destroy(s.shaper);
    return status;
}
