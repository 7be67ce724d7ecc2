/* verb_font.c - `lutetia font FILE`: a specimen of a font, a glyph at each level of the pipeline, and filters. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"

#include <levels.h>
#include <visible_text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct font_verb {
    const char *file, *axes, *filter, *glyph, *text, *out_path, *master_in, *master_out;
    double size_px;
    int face, em_px, merge;
    bool show_filter;
};

static int font_options(struct font_verb *v, int argc, char **argv, bool *help)
{
    const struct option_row rows[] = {
        {"out", 'o', OPTION_PNG, "FILE", "the picture, PNG (out.png)", &v->out_path, 0, 0, 0},
        {"face", 0, OPTION_INTEGER, "N", "which face of a collection (0)", &v->face, 0, 65535,
         0},
        {"axes", 0, OPTION_TEXT, "A=V,..",
         "positions of a variable font's axes: wght=700,wdth=80", &v->axes, 0, 0, 0},
        {"text", 0, OPTION_TEXT, "TEXT", "text of the specimen's lines", &v->text, 0, 0, 0},
        {"glyph", 0, OPTION_TEXT, "C", "draw this glyph at each level: a character, or U+0041",
         &v->glyph, 0, 0, 0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the glyph in gray (12.25)", &v->size_px, 0.5,
         200, 0},
        {"em", 0, OPTION_INTEGER, "N", "pixels to the em of the glyph's master (860)",
         &v->em_px, 16, 4096, 0},
        {"master-out", 0, OPTION_PNG, "FILE",
         "write the glyph's master as PNG, to be retouched", &v->master_out, 0, 0, 0},
        {"master", 0, OPTION_TEXT, "FILE", "take this master, a PNG that was retouched",
         &v->master_in, 0, 0, 0},
        {"merge", 0, OPTION_INTEGER, "N",
         "join rectangles whose sides differ by up to N pixels", &v->merge, 1, 4096, 0},
        {"filter", 0, OPTION_TEXT, "F", "the filter's name (gaussian-fast)", &v->filter, 0, 0,
         0},
        {"show-filter", 0, OPTION_FLAG, NULL,
         "draw the filter itself: its plot and what is known of it", &v->show_filter, 0, 0, 0},
        {0}};
    struct option_words words;
    if (!options_parse("font", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("font", rows, NULL);
    if (words.count > 1)
        return fail_usage("font", "there is one font (then came '%.60s')", words.words[1]);
    v->file = words.count ? words.words[0] : NULL;
    if (!v->glyph && (v->master_in || v->master_out || v->merge))
        return fail_usage("font", "--master, --master-out and --merge want a --glyph");
    if (!v->file && !v->show_filter)
        return fail_usage("font", "give a font file, a font file's name or a family");
    return EXIT_SUCCESS;
}

/* ---- drawing ---- */

static void box_fill(struct display_image *image, double x0, double y0, double x1, double y1,
                     const uint8_t rgb[3])
{
    int c0 = (int)fmax(0, floor(x0 + 0.5)), c1 = (int)fmin(image->width_px, floor(x1 + 0.5));
    int r0 = (int)fmax(0, floor(y0 + 0.5)), r1 = (int)fmin(image->height_px, floor(y1 + 0.5));
    for (int r = r0; r < r1; r++)
        for (int c = c0; c < c1; c++)
            memcpy(image->pixels + 3 * ((size_t)r * (size_t)image->width_px + (size_t)c), rgb,
                   3);
}

/* Draws a line of some width through points, as type is drawn: as the outlines of its
 * pieces. */
static enum font_status stroke_draw(struct display_image *image, const struct font_point *p,
                                    int count, double width, const double ink[3])
{
    struct font_outline o = {.units_per_em = 1};
    struct font_filter *filter = NULL;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    enum font_status status = font_filter_create_named("gaussian-fast", &filter);
    for (int i = 0; i + 1 < count && status == FONT_OK; i++) {
        double dx = p[i + 1].x - p[i].x, dy = p[i + 1].y - p[i].y, length = hypot(dx, dy);
        if (length == 0)
            continue;
        double u = dx / length * width / 2, v = dy / length * width / 2;
        double x0 = p[i].x - u / 2, y0 = p[i].y - v / 2, x1 = p[i + 1].x + u / 2,
               y1 = p[i + 1].y + v / 2;
        status = font_outline_move(&o, x0 - v, y0 + u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x1 - v, y1 + u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x1 + v, y1 - u);
        if (status == FONT_OK)
            status = font_outline_line(&o, x0 + v, y0 - u);
    }
    struct font_map map = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    if (status == FONT_OK)
        status = font_outline_prepare(&o, FONT_NONZERO);
    if (status == FONT_OK)
        status = font_edges_build(&edges, &o, &map, filter);
    if (status == FONT_OK)
        status = font_gray_draw(&gray, &edges, filter, 0, 0);
    for (int r = 0; status == FONT_OK && r < gray.height_px; r++)
        for (int c = 0; c < gray.width_px; c++) {
            int x = gray.left_px + c, y = gray.top_px + r;
            if (x < 0 || y < 0 || x >= image->width_px || y >= image->height_px)
                continue;
            double cover = gray.pixels[r * gray.pitch + c] / 255.0;
            uint8_t *to = image->pixels + 3 * ((size_t)y * (size_t)image->width_px + (size_t)x);
            for (int i = 0; i < 3; i++) {
                double light = font_light(to[i] / 255.0, 0);
                light += (font_light(ink[i], 0) - light) * cover;
                to[i] = (uint8_t)lrint(255 * font_number(light, 0));
            }
        }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_filter_destroy(filter);
    font_outline_finish(&o);
    return status;
}

/* Draws gray pixels enlarged. */
static void gray_draw(struct display_image *image, const struct font_gray *g, double x,
                      double y, int zoom)
{
    for (int r = 0; r < g->height_px; r++)
        for (int c = 0; c < g->width_px; c++) {
            double light = 1 - g->pixels[r * g->pitch + c] / 255.0;
            uint8_t v = (uint8_t)lrint(255 * font_number(light, 0)), rgb[3] = {v, v, v};
            box_fill(image, x + c * zoom, y + r * zoom, x + (c + 1) * zoom, y + (r + 1) * zoom,
                     rgb);
        }
}

/* ---- the specimen ---- */

struct specimen {
    struct font_shaper *shaper;
    struct font_painter *painter;
    struct display_image *image; /* NULL: only measure the height */
    double y, width;
};

static enum font_status line_set(struct specimen *s, const char *text, double size_px)
{
    struct font_layout layout;
    enum font_status status =
        font_shaper_layout(s->shaper, text, strlen(text), size_px, NULL, &layout);
    bool fits = layout.width_px <= s->width - 48 || size_px < 20; /* larger ones do not fit */
    if (status == FONT_OK && s->image && fits) {
        struct font_picture picture = type_picture(s->image);
        status = font_painter_layout(s->painter, &layout, NULL, 24, s->y + layout.ascent_px,
                                     &picture);
    }
    if (status == FONT_OK && fits)
        s->y += layout.ascent_px + layout.descent_px + 10;
    font_layout_finish(&layout);
    return status;
}

/* Shows the first glyphs with an outline, in rows. */
static enum font_status glyphs_set(struct specimen *s, struct font_face *face, double width)
{
    enum { SHOWN_MAX = 384 };
    const double size = 30, cell = 44;
    struct font_face_info info;
    enum font_status status = FONT_OK;
    double x = 24;
    int shown = 0;
    font_face_describe(face, &info);
    for (uint32_t g = 1;
         g < (uint32_t)info.glyphs_count && shown < SHOWN_MAX && status == FONT_OK; g++) {
        struct font_outline o;
        if (font_face_outline(face, g, &o) != FONT_OK)
            continue;
        bool empty = o.segments_count == 0;
        double advance = o.advance * size / info.units_per_em;
        font_outline_finish(&o);
        if (empty)
            continue;
        if (x + cell > width) {
            x = 24;
            s->y += cell;
        }
        if (s->image) {
            struct font_placed placed = {
                .face = face, .glyph = g, .x_px = (cell - advance) / 2};
            struct font_layout one = {.glyphs = &placed, .glyphs_count = 1, .size_px = size};
            struct font_picture picture = type_picture(s->image);
            status =
                font_painter_layout(s->painter, &one, NULL, x, s->y + cell * 0.75, &picture);
        }
        x += cell;
        shown++;
    }
    s->y += cell;
    return status;
}

static enum font_status specimen_set(struct specimen *s, const struct font_verb *v,
                                     struct font_face *face, const char *title, double width)
{
    static const double sizes[] = {72, 48, 36, 24, 18, 14, 12.25, 10, 8};
    const char *text =
        v->text ? v->text : "Sphinx of black quartz, judge my vow 0123456789 &?!";
    enum font_status status = line_set(s, title, 20);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes && status == FONT_OK; i++)
        status = line_set(s, text, sizes[i]);
    s->y += 16;
    if (status == FONT_OK)
        status = glyphs_set(s, face, width);
    s->y += 24;
    return status;
}

static void face_print(const struct font_face *face)
{
    struct font_face_info info;
    struct font_axis axis;
    font_face_describe(face, &info);
    visible_print("%s %s: %s, %d glyphs, %g units to the em, face %d of %d\n%s\n", info.family,
                  info.style, info.format, info.glyphs_count, info.units_per_em, info.index,
                  info.faces_count, info.path);
    for (int i = 0; i < info.axes_count && font_face_axis(face, i, &axis) == FONT_OK; i++)
        visible_print("axis %s (%s): %g..%g, usually %g, now %g\n", axis.tag, axis.name,
                      axis.least, axis.most, axis.usual, axis.value);
}

static int specimen_make(const struct font_verb *v, struct font_face *face)
{
    const double width = 1100;
    struct font_painter_def def = font_painter_def_default();
    struct specimen s = {.width = width};
    struct display_image image = {0};
    struct font_face_info info;
    char title[300];
    font_face_describe(face, &info);
    snprintf(title, sizeof title, "%.120s %.120s", info.family, info.style);
    def.filter = v->filter;
    def.places = 16;
    int status = EXIT_SUCCESS;
    if (font_painter_create(&def, &s.painter) != FONT_OK ||
        font_shaper_create(face, &s.shaper) != FONT_OK ||
        specimen_set(&s, v, face, title, width) != FONT_OK)
        status = fail_font("font");
    if (status == EXIT_SUCCESS)
        status = type_image_create("font", width, s.y, &image);
    s.image = &image;
    s.y = 16;
    if (status == EXIT_SUCCESS && specimen_set(&s, v, face, title, width) != FONT_OK)
        status = fail_font("font");
    if (status == EXIT_SUCCESS)
        status = type_image_write("font", v->out_path, &image);
    display_image_destroy(&image);
    font_painter_destroy(s.painter);
    font_shaper_destroy(s.shaper);
    return status;
}

/* ---- a glyph's levels ---- */

static bool character_read(const char *text, uint32_t *character)
{
    if ((text[0] == 'U' || text[0] == 'u') && text[1] == '+') {
        char *end;
        unsigned long value = strtoul(text + 2, &end, 16);
        *character = (uint32_t)value;
        return end != text + 2 && !*end && value <= 0x10ffff;
    }
    const char *at = text, *end = text + strlen(text);
    return font_utf8_next(&at, end, character) && at == end;
}

static const uint8_t colours[6][3] = {{230, 140, 130}, {240, 200, 120}, {170, 210, 130},
                                      {120, 200, 200}, {140, 160, 225}, {205, 150, 210}};

static enum font_status outline_draw(struct display_image *image, const struct font_outline *o,
                                     double scale, double x, double y)
{
    static const double ink[3] = {0.1, 0.1, 0.1};
    const uint8_t on[3] = {200, 40, 40}, off[3] = {60, 90, 200};
    enum font_status status = FONT_OK;
    for (int i = 0; i < o->segments_count && status == FONT_OK; i++) {
        const struct font_segment *s = &o->segments[i];
        struct font_point p[33];
        int n = s->degree == 1 ? 1 : 32;
        for (int k = 0; k <= n; k++) {
            struct font_point at = font_segment_at(s, (double)k / n, NULL);
            p[k] = (struct font_point){x + at.x * scale, y - at.y * scale};
        }
        status = stroke_draw(image, p, n + 1, 1.4, ink);
    }
    for (int i = 0; i < o->segments_count; i++)
        for (int k = 0; k < o->segments[i].degree; k++) {
            struct font_point p = o->segments[i].p[k];
            double px = x + p.x * scale, py = y - p.y * scale;
            box_fill(image, px - 2, py - 2, px + 3, py + 3, k ? off : on);
        }
    return status;
}

static int levels_draw(const struct font_verb *v, struct font_levels *levels, const char *name)
{
    enum { GAP = 24, TOP = 40 };
    const struct font_master *m;
    const struct font_rectangles *r;
    const struct font_edges *edges;
    const struct font_gray *gray;
    const struct font_outline *o = font_levels_outline(levels);
    if (font_levels_master(levels, &m) != FONT_OK ||
        font_levels_rectangles(levels, &r) != FONT_OK ||
        font_levels_edges(levels, &edges) != FONT_OK ||
        font_levels_gray(levels, 0, 0, &gray) != FONT_OK)
        return fail_font("font");
    printf("outline: %d segments%s\nmaster: %dx%d pixels, %ld of them black\nrectangles: %d\n"
           "edges at %g px: %d nodes and %d lines\ngray: %dx%d pixels\n",
           o->segments_count, o->rebuilt ? ", rebuilt where contours overlapped" : "",
           m->width_px, m->height_px, font_master_ink(m), r->count, v->size_px,
           edges->nodes_count, edges->lines_count, gray->width_px, gray->height_px);
    if (!m->width_px)
        return fail("font", "%s has no ink", name);
    double panel = fmin(520, fmax(m->width_px, m->height_px));
    double scale = panel / fmax(m->width_px, m->height_px);
    double width = m->width_px * scale, height = m->height_px * scale;
    int zoom = (int)fmax(1, floor(panel / fmax(gray->width_px, gray->height_px)));
    double gray_width = zoom * gray->width_px;
    struct display_image image = {0};
    int status = type_image_create("font", 2 * width + fmax(gray_width, 160) + 4 * GAP,
                                   fmax(height, zoom * gray->height_px) + TOP + GAP, &image);
    if (status != EXIT_SUCCESS)
        return status;
    double unit = scale * v->em_px / o->units_per_em;
    if (outline_draw(&image, o, unit, GAP - m->left_px * scale, TOP - m->top_px * scale) !=
        FONT_OK)
        status = fail_font("font");
    double x = 2 * GAP + width;
    for (int i = 0; i < r->count; i++) {
        const struct font_rectangle *q = &r->items[i];
        double x0 = x + (q->x0 - m->left_px) * scale, x1 = x + (q->x1 - m->left_px) * scale;
        double y0 = TOP + (q->y0 - m->top_px) * scale, y1 = TOP + (q->y1 - m->top_px) * scale;
        box_fill(&image, x0, y0, fmax(x1, x0 + 1), fmax(y1, y0 + 1), colours[i % 6]);
    }
    gray_draw(&image, gray, x + width + GAP, TOP, zoom);
    struct type_labels *labels = type_labels_create(13);
    type_label(labels, &image, GAP, 24, "outline of %s: %d segments", name, o->segments_count);
    type_label(labels, &image, x, 24, "master %dx%d: %d rectangles", m->width_px, m->height_px,
               r->count);
    type_label(labels, &image, x + width + GAP, 24, "gray, %g px", v->size_px);
    type_labels_destroy(labels);
    if (status == EXIT_SUCCESS)
        status = type_image_write("font", v->out_path, &image);
    display_image_destroy(&image);
    return status;
}

/* ---- the master retouched ---- */

static int master_write(const struct font_verb *v, struct font_levels *levels)
{
    const struct font_master *m;
    if (font_levels_master(levels, &m) != FONT_OK)
        return fail_font("font");
    int margin = m->em_px / 16;
    struct display_image image = {.width_px = m->width_px + 2 * margin,
                                  .height_px = m->height_px + 2 * margin,
                                  .channels = 1};
    if (display_image_create(&image) != DISPLAY_OK)
        return fail("font", "%s", display_error());
    font_master_to_picture(m, margin, image.pixels);
    int status = type_image_write("font", v->master_out, &image);
    display_image_destroy(&image);
    return status;
}

/* The picture may be larger than the master, by equal margins on opposite sides. */
static int master_read(const struct font_verb *v, struct font_levels *levels)
{
    const struct font_master *m;
    struct font_master retouched = {0};
    struct display_image image = {0};
    if (font_levels_master(levels, &m) != FONT_OK)
        return fail_font("font");
    if (display_png_read_gray(v->master_in, &image) != DISPLAY_OK)
        return fail("font", "%s", display_error());
    int more_x = image.width_px - m->width_px, more_y = image.height_px - m->height_px;
    int status = EXIT_SUCCESS;
    if (more_x < 0 || more_y < 0 || more_x % 2 || more_y % 2) {
        status =
            fail("font",
                 "%s is %dx%d pixels, and the master %dx%d; retouch what --master-out wrote "
                 "with the same --em",
                 v->master_in, image.width_px, image.height_px, m->width_px, m->height_px);
    } else {
        const struct font_master_frame frame = {
            m->em_px,       m->left_px - more_x / 2, m->top_px - more_y / 2,
            image.width_px, image.height_px,         m->advance_px};
        if (font_master_from_picture(&retouched, &frame, image.pixels) != FONT_OK)
            status = fail_font("font");
        if (status == EXIT_SUCCESS) {
            printf("retouched: %ld pixels\n", font_master_differs(m, &retouched));
            if (font_levels_master_set(levels, &retouched) != FONT_OK)
                status = fail_font("font");
        }
    }
    font_master_finish(&retouched);
    display_image_destroy(&image);
    return status;
}

/* Applies the requested edits before anything is shown, each level made from the one above. */
static int levels_edit(const struct font_verb *v, struct font_levels *levels)
{
    int status = EXIT_SUCCESS, gone;
    if (v->master_out)
        status = master_write(v, levels);
    if (status == EXIT_SUCCESS && v->master_in)
        status = master_read(v, levels);
    if (status != EXIT_SUCCESS || !v->merge)
        return status;
    if (font_levels_rectangles_merge(levels, v->merge, &gone) != FONT_OK)
        return fail_font("font");
    printf("merged: %d rectangles gone\n", gone);
    return EXIT_SUCCESS;
}

static int levels_make(const struct font_verb *v, struct font_face *face)
{
    uint32_t character, glyph;
    struct font_outline outline = {0};
    struct font_levels *levels = NULL;
    char name[40];
    if (!character_read(v->glyph, &character))
        return fail_usage("font", "--glyph must be one character, or like U+0041 (got '%.60s')",
                          v->glyph);
    glyph = font_face_glyph(face, character);
    if (!glyph)
        return fail("font", "the font has no glyph for U+%04X", (unsigned)character);
    snprintf(name, sizeof name, "U+%04X", (unsigned)character);
    int status = EXIT_SUCCESS;
    if (font_face_outline(face, glyph, &outline) != FONT_OK ||
        font_levels_create(&outline, v->em_px, v->size_px, v->filter, &levels) != FONT_OK)
        status = fail_font("font");
    else
        status = levels_edit(v, levels);
    if (status == EXIT_SUCCESS)
        status = levels_draw(v, levels, name);
    font_levels_destroy(levels);
    font_outline_finish(&outline);
    return status;
}

/* ---- a filter ---- */

static void filter_print(const struct font_filter_info *f)
{
    visible_print("%s: radius %g pixels, %d product%s of %d taps, %zu bytes of tables\n",
                  f->name, f->radius_px, f->terms, f->terms == 1 ? "" : "s", f->taps, f->bytes);
    printf("integral before it was made 1: %.6g; peak %.4f; half as high over %.3f pixels\n",
           f->raw_integral, f->peak, f->half_width_px);
    printf("what the products leave out: %.3f of 255\n", 255 * f->residual);
    printf(
        "a thin line's weight changes with its place by %.2f%%; an edge goes %.2f%% beyond\n",
        100 * f->ripple, 100 * f->undershoot);
    printf("of waves of two pixels %.1f%% are left, of waves of one %.1f%%\n",
           100 * f->response_nyquist, 100 * f->response_pixel);
    if (f->step_px > 0)
        printf("edges are integrated in steps of 1/%g pixel\n", 1 / f->step_px);
    else
        printf("edges are integrated %s\n", f->drawn);
}

static int filter_show(const struct font_verb *v)
{
    enum { SIDE = 420, GAP = 30, TOP = 40, CURVE = 421 };
    struct font_filter *f;
    struct font_filter_info info;
    struct display_image image = {0};
    static const double red[3] = {0.75, 0.1, 0.1}, blue[3] = {0.1, 0.2, 0.7};
    static const double gray[3] = {0.8, 0.8, 0.8};
    if (font_filter_create_named(v->filter, &f) != FONT_OK)
        return fail_font("font");
    font_filter_describe(f, &info);
    filter_print(&info);
    int status = type_image_create("font", 2 * SIDE + 3 * GAP, SIDE + TOP + GAP, &image);
    double reach = fmax(1, ceil(info.radius_px)), x0 = GAP, y0 = TOP + SIDE - 60.0;
    /* Profile: through the centre, with 100 for its peak. Edge: the picture of an edge. */
    struct font_point profile[CURVE], edge[CURVE];
    double high = SIDE - 100;
    for (int i = 0; i < CURVE; i++) {
        double u = -reach + 2 * reach * i / (CURVE - 1),
               x = x0 + i * (double)SIDE / (CURVE - 1);
        profile[i] = (struct font_point){x, y0 - high * font_filter_at(f, u, 0) / info.peak};
        edge[i] = (struct font_point){x, y0 - high * font_filter_edge(f, u)};
    }
    enum font_status drawn = FONT_OK;
    for (int k = (int)-reach; k <= (int)reach && status == EXIT_SUCCESS && drawn == FONT_OK;
         k++) {
        double x = x0 + (k + reach) / (2 * reach) * SIDE;
        struct font_point tick[] = {{x, y0 + 8}, {x, y0 - high}};
        drawn = stroke_draw(&image, tick, 2, 1, gray);
    }
    struct font_point base[] = {{x0, y0}, {x0 + SIDE, y0}};
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = stroke_draw(&image, base, 2, 1, gray);
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = stroke_draw(&image, edge, CURVE, 1.6, blue);
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = stroke_draw(&image, profile, CURVE, 2, red);
    if (drawn != FONT_OK)
        status = fail_font("font");
    for (int r = 0; r < SIDE && status == EXIT_SUCCESS; r++)
        for (int c = 0; c < SIDE; c++) { /* the filter itself, negative values in blue */
            double u = -reach + 2 * reach * (c + 0.5) / SIDE,
                   w = -reach + 2 * reach * (r + 0.5) / SIDE;
            double value = font_filter_at(f, u, w) / info.peak;
            uint8_t ink = (uint8_t)lrint(255 * (1 - fmin(1, fabs(value))));
            uint8_t rgb[3] = {ink, ink, value < 0 ? 255 : ink};
            box_fill(&image, 2 * GAP + SIDE + c, TOP + r, 2 * GAP + SIDE + c + 1, TOP + r + 1,
                     rgb);
        }
    if (status == EXIT_SUCCESS) {
        struct type_labels *labels = type_labels_create(13);
        type_label(labels, &image, GAP, 24, "%s, radius %g: profile (red), an edge (blue)",
                   info.name, info.radius_px);
        type_label(labels, &image, 2 * GAP + SIDE, 24, "the filter, %g pixels across",
                   2 * reach);
        type_labels_destroy(labels);
        status = type_image_write("font", v->out_path, &image);
    }
    display_image_destroy(&image);
    font_filter_destroy(f);
    return status;
}

int verb_font(int argc, char **argv)
{
    struct font_verb v = {
        .filter = "gaussian-fast", .out_path = "out.png", .size_px = 12.25, .em_px = 860};
    bool help = false;
    int status = font_options(&v, argc, argv, &help);
    if (status != EXIT_SUCCESS || help)
        return status;
    char *filter;
    status = type_filter_read("font", v.filter, &filter);
    if (status != EXIT_SUCCESS)
        return status;
    v.filter = filter;
    if (v.show_filter) {
        status = filter_show(&v);
        free(filter);
        return status;
    }
    struct font_face *face = NULL;
    status = type_face_open("font", v.file, v.face, v.axes, false, &face);
    if (status == EXIT_SUCCESS) {
        face_print(face);
        status = v.glyph ? levels_make(&v, face) : specimen_make(&v, face);
    }
    font_face_close(face);
    free(filter);
    return status;
}
