/* font_glyph.c - a glyph at each level of the pipeline, drawn, written out and taken in: see
 * font_verb.h. */
#include "font_verb.h"
#include "lutetia.h"
#include "type_common.h"

#include <visible_text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
        status = font_stroke_draw(image, p, n + 1, 1.4, ink);
    }
    for (int i = 0; i < o->segments_count; i++)
        for (int k = 0; k < o->segments[i].degree; k++) {
            struct font_point p = o->segments[i].p[k];
            double px = x + p.x * scale, py = y - p.y * scale;
            font_box_fill(image, px - 2, py - 2, px + 3, py + 3, k ? off : on);
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
        font_box_fill(&image, x0, y0, fmax(x1, x0 + 1), fmax(y1, y0 + 1), colours[i % 6]);
    }
    font_gray_show(&image, gray, x + width + GAP, TOP, zoom);
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

int font_level_write(const struct font_verb *v, struct font_face *face, uint32_t glyph,
                     const struct font_edits *edits, struct font_levels *levels)
{
    char file[FONT_EDITS_FILE_BYTES];
    struct font_edits_out out = {.glyph = glyph,
                                 .ending = strcmp(v->write, "glif") == 0 ? ".glif" : NULL,
                                 .here = v->axes != NULL,
                                 .from_px = v->sizes[0],
                                 .to_px = v->sizes[1]};
    while (!out.ending && out.level < FONT_EDITS_LEVELS &&
           strcmp(v->write, font_edits_level_name(out.level)) != 0)
        out.level++;
    if (out.level == FONT_EDITS_FILTER && font_levels_filter_set(levels, v->filter) != FONT_OK)
        return fail_font("font");
    if (font_edits_write(v->edits, edits, face, &out, levels, file) != FONT_OK)
        return fail_font("font");
    visible_print("written: %s/%s\n", v->edits, file);
    return EXIT_SUCCESS;
}

int font_levels_show(const struct font_verb *v, struct font_face *face,
                     const struct font_edits *edits)
{
    uint32_t glyph;
    struct font_levels *levels = NULL;
    char name[FONT_GLYPH_NAME_BYTES];
    enum font_status named = font_face_glyph_named(face, v->glyph, &glyph);
    if (named != FONT_OK)
        return named == FONT_BAD_ARGUMENT ? fail_usage("font", "--glyph: %s", font_error())
                                          : fail_font("font");
    snprintf(name, sizeof name, "%s", v->glyph);
    int status = EXIT_SUCCESS;
    if (font_edits_levels(edits, face, glyph, v->em_px, v->size_px, v->filter, &levels) !=
        FONT_OK)
        status = fail_font("font");
    if (status == EXIT_SUCCESS && v->write)
        status = font_level_write(v, face, glyph, edits, levels);
    if (status == EXIT_SUCCESS)
        status = levels_edit(v, levels);
    if (status == EXIT_SUCCESS)
        status = levels_draw(v, levels, name);
    font_levels_destroy(levels);
    return status;
}
