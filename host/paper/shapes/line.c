/* line.c - type as a screen, by the font pipeline.
 *
 * The text is shaped, set in lines, turned by its angle and drawn at its place between
 * fibers. A screen's shade is the part of a fiber that the letters cover, through the
 * filter. Where letters overlap, each covers its part of what the others leave.
 */
#include "base/base.h"

#include <edits.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCREEN_SIDE_MAX = 32768 };
static const double screen_pixels_max = 1 << 29;

struct line_setting {
    const struct paper_line *line;
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_painter *painter;
    struct font_layout layout;
    struct font_map map;
};

/* Converts a failure of the font pipeline to the paper's. */
static enum paper_status pipeline_failed(enum font_status status, enum paper_status otherwise)
{
    return paper_fail(status == FONT_NO_MEMORY ? PAPER_NO_MEMORY : otherwise, "%s",
                      font_error());
}

static enum paper_status line_check(const struct paper_line *line)
{
    if (!line->text || !(line->size_px >= 1 && line->size_px <= 8192) ||
        !(fabs(line->tracking_em) <= 16))
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "type is 1..8192 pixels large and tracked by at most 16 em (got %g, %g)",
            line->size_px, line->tracking_em);
    if (!(fabs(line->x_px) <= 1 && fabs(line->y_px) <= 1 && fabs(line->angle_deg) <= 3600 &&
          line->width_px >= 0 && line->width_px <= 1e6 && line->leading >= 0 &&
          line->leading <= 100 && line->anchor >= 0 && line->anchor <= 1 &&
          (unsigned)line->align <= PAPER_ALIGN_JUSTIFY))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "type is placed by -1..1 fibers, turned by up to 3600 degrees, set "
                          "in columns of up to 1e6 pixels with a leading of up to 100, and "
                          "anchored at 0..1 (got %g, %g; %g; %g; %g; %g)",
                          line->x_px, line->y_px, line->angle_deg, line->width_px,
                          line->leading, line->anchor);
    for (int i = 0; line->corners && i < 8; i++)
        if (!(fabs(line->corners[i]) <= SCREEN_SIDE_MAX))
            return paper_fail(PAPER_BAD_ARGUMENT, "a corner of type must be within %d (got %g)",
                              SCREEN_SIDE_MAX, line->corners[i]);
    const char *at = line->text, *end = at + strlen(at);
    for (uint32_t character; at < end;) {
        size_t byte = (size_t)(at - line->text) + 1;
        if (!font_utf8_next(&at, end, &character))
            return paper_fail(PAPER_BAD_TEXT, "the text is not UTF-8 at its byte %zu", byte);
    }
    return PAPER_OK;
}

/* Maps the type's own rectangle, from the first ascent to the last descent, to the corners. */
static enum font_status line_map_corners(struct line_setting *set)
{
    const struct font_layout *l = &set->layout;
    struct font_point to[4];
    for (int i = 0; i < 4; i++)
        to[i] = (struct font_point){set->line->corners[2 * i], set->line->corners[2 * i + 1]};
    return font_map_corners(set->line->bilinear ? FONT_BILINEAR : FONT_PROJECTIVE, 0,
                            -l->ascent_px, l->width_px, l->height_px + l->descent_px, to,
                            &set->map);
}

static enum paper_status line_set(struct line_setting *set)
{
    static const enum font_align aligns[] = {FONT_ALIGN_START, FONT_ALIGN_LEFT,
                                             FONT_ALIGN_RIGHT, FONT_ALIGN_CENTER,
                                             FONT_ALIGN_JUSTIFY};
    const struct paper_line *line = set->line;
    struct font_painter_def def = font_painter_def_default();
    def.filter = line->filter ? line->filter : "box";
    def.darken_px = line->darken_px;
    struct font_text_options options = {.features = line->features,
                                        .language = line->language,
                                        .letter_spacing_px = line->tracking_em * line->size_px,
                                        .line_height = line->leading,
                                        .width_px = line->width_px,
                                        .align = aligns[line->align],
                                        .right_to_left = line->right_to_left};
    enum font_status status = font_edits_open(line->font, 0, false, &set->face);
    if (status != FONT_OK)
        return pipeline_failed(status, PAPER_BAD_FONT);
    if (font_face_axes_set(set->face, line->axes) != FONT_OK)
        return pipeline_failed(FONT_BAD_ARGUMENT, PAPER_BAD_ARGUMENT);
    status = font_shaper_create(set->face, &set->shaper);
    if (status == FONT_OK)
        status = font_painter_create(&def, &set->painter);
    if (status == FONT_OK)
        status = font_shaper_layout(set->shaper, line->text, strlen(line->text), line->size_px,
                                    &options, &set->layout);
    set->map = font_map_rotation(line->angle_deg);
    if (status == FONT_OK && line->corners)
        status = line_map_corners(set);
    return status == FONT_OK ? PAPER_OK : pipeline_failed(status, PAPER_BAD_ARGUMENT);
}

/* Whether anything but the font's sign for missing characters would be drawn. */
static bool anything_found(const struct line_setting *set)
{
    bool found = false;
    for (int i = 0; i < set->layout.glyphs_count && !found; i++) {
        const struct font_placed *g = &set->layout.glyphs[i];
        struct font_outline outline;
        if (g->glyph && font_face_outline_raw(g->face, g->glyph, &outline) == FONT_OK) {
            found = outline.segments_count > 0;
            font_outline_finish(&outline);
        }
    }
    return found;
}

/* Crops empty rows and columns: a filter's reach is larger than its rounded result. False:
 * there is no ink at all. */
static bool screen_crop(struct paper_screen *s)
{
    int left = s->width_px, right = -1, top = s->height_px, bottom = -1;
    for (int y = 0; y < s->height_px; y++) {
        const uint8_t *row = s->gray + (size_t)y * (size_t)s->width_px;
        int first = 0, last = s->width_px - 1;
        while (first <= last && !row[first])
            first++;
        if (first > last)
            continue;
        while (!row[last])
            last--;
        left = first < left ? first : left;
        right = last > right ? last : right;
        top = top < y ? top : y;
        bottom = y;
    }
    if (bottom < 0)
        return false;
    size_t width = (size_t)(right - left + 1), height = (size_t)(bottom - top + 1);
    for (size_t y = 0; y < height; y++)
        memmove(s->gray + y * width,
                s->gray + ((size_t)top + y) * (size_t)s->width_px + (size_t)left, width);
    uint8_t *less = realloc(s->gray, width * height);
    s->gray = less ? less : s->gray;
    s->origin_x_px -= left;
    s->baseline_y_px -= top;
    s->width_px = (int)width;
    s->height_px = (int)height;
    return true;
}

static enum paper_status line_draw(struct line_setting *set, struct paper_screen *screen)
{
    const struct paper_line *line = set->line;
    struct font_box box;
    struct font_point anchor = {-line->anchor * set->layout.width_px, 0};
    double jacobian[4];
    double x = 0, y = 0;
    if (!line->corners) {
        font_map_point(&set->map, anchor, &anchor, jacobian);
        x = line->x_px + anchor.x;
        y = line->y_px + anchor.y;
    }
    enum font_status status =
        font_painter_measure(set->painter, &set->layout, &set->map, x, y, &box);
    if (status != FONT_OK)
        return pipeline_failed(status, PAPER_BAD_FONT);
    double width = box.x1 - box.x0, height = box.y1 - box.y0;
    double most = line->pixels_max > 0 ? line->pixels_max : screen_pixels_max;
    if (width > SCREEN_SIDE_MAX || height > SCREEN_SIDE_MAX || width * height > most)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "the type would be %.0fx%.0f pixels, and %d a side and %.0f in all "
                          "are the most; set it smaller",
                          width, height, SCREEN_SIDE_MAX, most);
    if (width > 0 && height > 0) {
        *screen = (struct paper_screen){.width_px = (int)width,
                                        .height_px = (int)height,
                                        .origin_x_px = -(int)box.x0,
                                        .baseline_y_px = -(int)box.y0};
        screen->gray = calloc((size_t)screen->height_px, (size_t)screen->width_px);
        if (!screen->gray)
            return paper_fail(PAPER_NO_MEMORY, "no memory for type of %dx%d pixels",
                              screen->width_px, screen->height_px);
        struct font_cover cover = {screen->width_px, screen->height_px, screen->width_px,
                                   screen->gray};
        status = font_painter_cover(set->painter, &set->layout, &set->map,
                                    x + screen->origin_x_px, y + screen->baseline_y_px, &cover);
        if (status != FONT_OK)
            return pipeline_failed(status, PAPER_BAD_FONT);
    }
    if (!screen->gray || !screen_crop(screen))
        return paper_fail(PAPER_BAD_TEXT, "the text \"%.60s\" leaves no mark on the paper",
                          line->text);
    screen->advance_px = set->layout.width_px;
    const struct font_layout *l = &set->layout;
    screen->lines_count = l->lines_count;
    screen->line_height_px =
        l->line_height_px +
        (l->height_px - (l->lines_count - 1) * l->line_height_px) / l->lines_count;
    return PAPER_OK;
}

enum paper_status paper_line_screen(const struct paper_line *line, struct paper_screen *screen,
                                    uint32_t *missing)
{
    struct line_setting set = {.line = line};
    *screen = (struct paper_screen){0};
    if (missing)
        *missing = 0;
    enum paper_status status = line_check(line);
    font_simd_plain_here(true); /* no SIMD variants, so that a sheet is the same on every
                                 * processor */
    if (status == PAPER_OK)
        status = line_set(&set);
    if (status == PAPER_OK && set.layout.missing_count && !anything_found(&set))
        status = paper_fail(PAPER_BAD_TEXT,
                            "there are no glyphs for \"%.60s\" in any font (U+%04X is the "
                            "first that is lacking)",
                            line->text, (unsigned)set.layout.missing[0]);
    if (status == PAPER_OK)
        status = line_draw(&set, screen);
    font_simd_plain_here(false);
    if (status == PAPER_OK && missing && set.layout.missing_count)
        *missing = set.layout.missing[0];
    if (status != PAPER_OK)
        paper_screen_destroy(screen);
    font_layout_finish(&set.layout);
    font_painter_destroy(set.painter);
    font_shaper_destroy(set.shaper);
    font_face_close(set.face);
    return status;
}

void paper_screen_destroy(struct paper_screen *screen)
{
    if (!screen)
        return;
    free(screen->gray);
    *screen = (struct paper_screen){0};
}
