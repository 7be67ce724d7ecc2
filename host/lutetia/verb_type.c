/* verb_type.c - `lutetia type`: text as a picture, at any size, place, angle and distortion. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"
#include "type_formula.h"
#include "type_ink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <visible_text.h>

struct type {
    const char *text, *font, *edits, *axes, *filter, *features, *language, *warp, *display,
        *out_path, *align, *math;
    double size_px, rotate, shear, place[2], ink[3], gamma, darken_px, spacing_px, leading;
    double margin_px, width_px;
    struct option_list corners;
    struct type_ink more;
    int face, zoom;
    bool stripes, to_left, no_fallback, compare, gl, statistics;
};

static int type_options(struct type *t, int argc, char **argv, bool *help)
{
    const double far = FONT_SIDE_MAX;
    const struct option_row rows[] = {
        {"out", 'o', OPTION_TEXT, "FILE", "the picture: .png, .svg or .pdf (out.png)",
         &t->out_path, 0, 0, 0},
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (DejaVuSans)", &t->font, 0, 0, 0},
        TYPE_EDITS_OPTION(&t->edits),
        {"face", 0, OPTION_INTEGER, "N", "which face of a collection (0)", &t->face, 0, 65535,
         0},
        {"axes", 0, OPTION_TEXT, "A=V,..",
         "positions of a variable font's axes: wght=700,wdth=80", &t->axes, 0, 0, 0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the em, any fraction (48)", &t->size_px, 0.1,
         10000, 0},
        {"filter", 0, OPTION_TEXT, "F",
         "the filter's name, or auto for the display (gaussian-fast)", &t->filter, 0, 0, 0},
        {"display", 0, OPTION_TEXT, "D",
         "the display that auto chooses a filter for: lcd, crt or print (lcd)", &t->display, 0,
         0, 0},
        {"place", 0, OPTION_NUMBERS, "X,Y", "moves the text by parts of a pixel (0,0)",
         t->place, -1000, 1000, 2},
        {"rotate", 0, OPTION_NUMBER, "DEG", "turns the text counterclockwise (0)", &t->rotate,
         -3600, 3600, 0},
        {"shear", 0, OPTION_NUMBER, "S", "moves each pixel up so far to the right (0)",
         &t->shear, -10, 10, 0},
        {"corners", 0, OPTION_LIST, "X,Y,..",
         "distorts the text: where its four corners go, eight numbers in pixels", &t->corners,
         -far, far, 8},
        {"warp", 0, OPTION_TEXT, "KIND",
         "the map between --corners: projective or bilinear (projective)", &t->warp, 0, 0, 0},
        {"ink", 0, OPTION_NUMBERS, "R,G,B", "colour of the ink, each 0..1 (0,0,0)", t->ink, 0,
         1, 3},
        {"cover", 0, OPTION_NUMBER, "C", "how much ink covers of what is below, 0..1 (1)",
         &t->more.cover, 0, 1, 0},
        {"gradient", 0, OPTION_LIST, "X,Y,X,Y",
         "a gradient along this way, in pixels from the beginning of the first baseline",
         &t->more.gradient, -far, far, 4},
        {"radial", 0, OPTION_LIST, "X,Y,R",
         "a gradient outwards from this place, to this radius", &t->more.radial, -far, far, 3},
        {"stop", 0, OPTION_LIST, "AT,R,G,B,C",
         "a colour of the gradient, and how it covers, each 0..1; up to 8 times",
         &t->more.stops, 0, 1, 5},
        {"texture", 0, OPTION_TEXT, "FILE", "a PNG that is repeated as ink", &t->more.picture,
         0, 0, 0},
        {"mix-numbers", 0, OPTION_FLAG, NULL, "mix ink as numbers, not as light",
         &t->more.numbers, 0, 0, 0},
        {"gamma", 0, OPTION_NUMBER, "G",
         "the power by which light is mixed; 1: not at all (sRGB's)", &t->gamma, 0.2, 5, 0},
        {"darken", 0, OPTION_NUMBER, "PX",
         "widens the stems of small type; 0: does not (as their width needs)", &t->darken_px, 0,
         2, 0},
        {"stripes", 0, OPTION_FLAG, NULL,
         "draw for a display with stripes of red, green and blue", &t->stripes, 0, 0, 0},
        {"features", 0, OPTION_TEXT, "F,..", "OpenType features to switch: -liga,ss01,kern=0",
         &t->features, 0, 0, 0},
        {"language", 0, OPTION_TEXT, "L", "language of the text: fr", &t->language, 0, 0, 0},
        {"right-to-left", 0, OPTION_FLAG, NULL, "lines run to the left", &t->to_left, 0, 0, 0},
        {"spacing", 0, OPTION_NUMBER, "PX", "space that is added between letters (0)",
         &t->spacing_px, -1000, 1000, 0},
        {"leading", 0, OPTION_NUMBER, "L", "distance of lines, of the size (the font's)",
         &t->leading, 0.1, 10, 0},
        {"width", 0, OPTION_NUMBER, "PX", "break lines to fit this width (only at line ends)",
         &t->width_px, 1, 1e6, 0},
        {"align", 0, OPTION_TEXT, "A", "left, right, center or justify (as the text runs)",
         &t->align, 0, 0, 0},
        {"margin", 0, OPTION_NUMBER, "PX", "margin around the text (8)", &t->margin_px, 0, 4096,
         0},
        {"no-fallback", 0, OPTION_FLAG, NULL,
         "take no other font for characters that this one lacks", &t->no_fallback, 0, 0, 0},
        {"math", 0, OPTION_TEXT, "STYLE",
         "the text is a formula in TeX's notation: display, or text as within a line", &t->math,
         0, 0, 0},
        {"compare", 0, OPTION_FLAG, NULL,
         "draw the text by FreeType and in exact gray beside it, enlarged", &t->compare, 0, 0,
         0},
        {"zoom", 0, OPTION_INTEGER, "N", "how much --compare enlarges (8)", &t->zoom, 1, 64, 0},
        {"gl", 0, OPTION_FLAG, NULL, "draw by OpenGL, without a window, as on a display",
         &t->gl, 0, 0, 0},
        {"statistics", 0, OPTION_FLAG, NULL, "also print what was drawn and kept",
         &t->statistics, 0, 0, 0},
        {0}};
    struct option_words words;
    if (!options_parse("type", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("type", rows, NULL);
    if (t->math && strcmp(t->math, "display") != 0 && strcmp(t->math, "text") != 0)
        return fail_usage(
            "type", "--math must be display or text, and the formula follows (got '%.60s')",
            t->math);
    if (words.count != 1)
        return fail_usage("type",
                          words.count ? "there is one text; put it in quotes (then came "
                                        "'%.60s')"
                                      : "give a text%s",
                          words.count ? words.words[1] : "");
    t->text = words.words[0];
    if (!*t->text)
        return fail_usage("type", "the text is empty: there is nothing to draw");
    if (t->corners.count > 1)
        return fail_usage("type", "--corners can be given once");
    if (t->gl && (t->gamma != 0 || t->stripes || t->compare))
        return fail_usage("type", "--gl goes without --gamma, --stripes and --compare");
    if (t->math &&
        (t->compare || t->features || t->language || t->to_left || t->spacing_px != 0 ||
         t->leading != 0 || t->width_px != 0 || t->align || t->no_fallback))
        return fail_usage("type", "--math sets one formula: it goes without --compare, "
                                  "--features, --language, --right-to-left, --spacing, "
                                  "--leading, --width, --align and --no-fallback");
    if (t->compare && t->stripes)
        return fail_usage("type", "--compare goes without --stripes: it shows gray");
    if (t->compare && type_ink_given(&t->more))
        return fail_usage("type", "--compare shows gray: it goes without inks");
    enum type_out kind = type_out_of(t->out_path);
    if (kind == TYPE_OUT_NONE)
        return fail_usage("type", "-o names a picture: FILE.png, .svg or .pdf (got '%.80s')",
                          t->out_path);
    if (kind != TYPE_OUT_PNG && (t->gl || t->compare || t->stripes))
        return fail_usage("type", "--gl, --compare and --stripes make pixels: -o FILE.png");
    if (t->warp && strcmp(t->warp, "projective") != 0 && strcmp(t->warp, "bilinear") != 0)
        return fail_usage("type", "--warp must be projective or bilinear (got '%.60s')",
                          t->warp);
    enum font_display display;
    if (type_display_read("type", t->display, &display) != EXIT_SUCCESS)
        return EXIT_USAGE;
    enum font_align align;
    if (t->align && !font_align_named(t->align, &align))
        return fail_usage(
            "type", "--align must be left, right, center or justify (got '%.60s')", t->align);
    return type_ink_check("type", &t->more);
}

/* The box around the text after an affine map, from the first ascent to the last descent. */
static struct font_box type_box(const struct font_layout *l, const struct font_map *map)
{
    const double y[2] = {-l->ascent_px, l->height_px + l->descent_px};
    struct font_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < 4; i++) {
        struct font_point at = {i & 1 ? l->width_px : 0, y[i >> 1]};
        double jacobian[4];
        font_map_point(map, at, &at, jacobian);
        box.x0 = fmin(box.x0, at.x);
        box.y0 = fmin(box.y0, at.y);
        box.x1 = fmax(box.x1, at.x);
        box.y1 = fmax(box.y1, at.y);
    }
    return box;
}

/* Makes the text's map: shear, rotation, corners. */
static int type_map(const struct type *t, const struct font_layout *layout,
                    struct font_map *map)
{
    *map = font_map_then(font_map_shear(t->shear), font_map_rotation(t->rotate));
    if (!t->corners.count)
        return EXIT_SUCCESS;
    struct font_point corners[4];
    for (int i = 0; i < 4; i++)
        corners[i] =
            (struct font_point){t->corners.numbers[0][2 * i], t->corners.numbers[0][2 * i + 1]};
    enum font_map_kind kind =
        t->warp && strcmp(t->warp, "bilinear") == 0 ? FONT_BILINEAR : FONT_PROJECTIVE;
    struct font_map warp;
    const struct font_box box = type_box(layout, map);
    if (font_map_corners(kind, box.x0, box.y0, box.x1, box.y1, corners, &warp) != FONT_OK ||
        font_map_compose(map, &warp, map) != FONT_OK)
        return fail_font("type");
    return EXIT_SUCCESS;
}

static void type_report(const struct type *t, const struct font_layout *layout)
{
    type_damaged_tell("type", layout->damaged_count);
    type_missing_tell("type", t->font, layout);
}

static int type_draw(const struct type *t, struct font_painter *painter,
                     const struct font_layout *layout, const struct font_map *map)
{
    struct font_box box;
    struct display_image image = {0};
    if (font_painter_measure(painter, layout, map, 0, 0, &box) != FONT_OK)
        return fail_font("type");
    if (t->corners.count) /* the corners give the place in the picture */
        box.x0 = box.y0 = 0;
    else if (box.x1 < box.x0)
        box = (struct font_box){0, -layout->ascent_px, layout->width_px, layout->descent_px};
    double x = ceil(t->margin_px - box.x0), y = ceil(t->margin_px - box.y0);
    if (t->corners.count)
        x = y = 0;
    if (type_out_of(t->out_path) != TYPE_OUT_PNG) {
        const struct font_drawing drawing = {.width_px = ceil(x + box.x1 + t->margin_px + 1),
                                             .height_px = ceil(y + box.y1 + t->margin_px + 1),
                                             .ink = {t->ink[0], t->ink[1], t->ink[2]},
                                             .text = t->text,
                                             .bytes = strlen(t->text),
                                             .title = t->text,
                                             .language = t->language};
        return type_drawing_write("type", t->out_path, &drawing, layout, map, x + t->place[0],
                                  y + t->place[1]);
    }
    int status = type_image_create("type", ceil(x + box.x1 + t->margin_px + 1),
                                   ceil(y + box.y1 + t->margin_px + 1), &image);
    struct font_picture picture = type_picture(&image);
    if (status == EXIT_SUCCESS && t->gl)
        status = type_gl("type", layout, map, t->filter, t->darken_px, x + t->place[0],
                         y + t->place[1], t->ink, &image);
    else if (status == EXIT_SUCCESS &&
             font_painter_layout(painter, layout, map, x + t->place[0], y + t->place[1],
                                 &picture) != FONT_OK)
        status = fail_font("type");
    if (status == EXIT_SUCCESS)
        status = type_image_write("type", t->out_path, &image);
    display_image_destroy(&image);
    return status;
}

static int type_text_layout(const struct type *t, struct font_face *face,
                            const struct font_text_options *options,
                            struct font_shaper **shaper, struct font_layout *layout)
{
    if (font_shaper_create(face, shaper) != FONT_OK)
        return fail_font("type");
    if (!t->compare)
        font_shaper_colour(*shaper);
    return font_shaper_layout(*shaper, t->text, strlen(t->text), t->size_px, options, layout) ==
                   FONT_OK
               ? EXIT_SUCCESS
               : fail_font("type");
}

static int type_run(struct type *t, struct font_face *face)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_text_options options = {.features = t->features,
                                        .language = t->language,
                                        .letter_spacing_px = t->spacing_px,
                                        .line_height = t->leading,
                                        .width_px = t->width_px,
                                        .no_fallback = t->no_fallback,
                                        .right_to_left = t->to_left ? 1 : 0};
    struct font_shaper *shaper = NULL;
    struct font_math *math = NULL;
    struct font_painter *painter = NULL;
    struct font_layout layout = {0};
    struct font_map map;
    if (t->align)
        font_align_named(t->align, &options.align);
    if (strcmp(t->filter, "auto") == 0) {
        enum font_display display = FONT_DISPLAY_LCD;
        (void)type_display_read("type", t->display, &display); /* was read before */
        t->filter = type_filter_choose("type", font_face_stem(face) * t->size_px, display);
        if (!t->filter)
            return EXIT_FAILED;
    }
    def.filter = t->filter;
    memcpy(def.ink, t->ink, sizeof def.ink);
    def.gamma = t->gamma;
    def.darken_px = t->darken_px;
    def.stripes = t->stripes;
    int status = EXIT_SUCCESS;
    if (font_painter_create(&def, &painter) != FONT_OK)
        status = fail_font("type");
    else if (t->math)
        status = type_formula_layout("type", face, t->text, t->size_px,
                                     strcmp(t->math, "display") == 0, &math, &layout);
    else
        status = type_text_layout(t, face, &options, &shaper, &layout);
    if (status == EXIT_SUCCESS) {
        type_report(t, &layout);
        status = type_map(t, &layout, &map);
    }
    if (status == EXIT_SUCCESS && type_ink_given(&t->more))
        status = type_ink_apply("type", &t->more, t->ink, &layout);
    if (status == EXIT_SUCCESS)
        status = t->compare ? type_compare("type", t->out_path, &layout, &map, t->filter,
                                           t->place[0], t->place[1], t->zoom)
                            : type_draw(t, painter, &layout, &map);
    type_left_out_tell("type");
    if (status == EXIT_SUCCESS && t->statistics) {
        struct font_painter_stats stats;
        font_painter_stats_get(painter, &stats);
        printf("%d glyphs, %d lines, %.2f pixels wide; %d in another font; edges kept of %d "
               "glyphs, used again %ld times\n",
               layout.glyphs_count, layout.lines_count, layout.width_px, layout.fallback_count,
               stats.kept_count, stats.edges_hits);
    }
    font_layout_finish(&layout);
    font_painter_destroy(painter);
    font_shaper_destroy(shaper);
    font_math_destroy(math);
    return status;
}

int verb_type(int argc, char **argv)
{
    static struct type t; /* the list of corners is large */
    bool help = false;
    t = (struct type){.filter = "gaussian-fast",
                      .display = "lcd",
                      .out_path = "out.png",
                      .size_px = 48,
                      .darken_px = FONT_DARKEN_BY_STEM,
                      .margin_px = 8,
                      .more.cover = 1,
                      .zoom = 8};
    int status = type_options(&t, argc, argv, &help);
    struct font_face *face = NULL;
    char *filter = NULL, *font = NULL;
    if (status == EXIT_SUCCESS && !help)
        status = type_filter_read("type", t.filter, &filter);
    t.filter = filter;
    if (status == EXIT_SUCCESS && !help)
        status =
            type_font_name("type", t.font, t.edits,
                           t.math ? font_face_first(font_math_fonts) : "DejaVuSans", &font);
    t.font = font;
    if (status == EXIT_SUCCESS && !help)
        status = type_face_open("type", t.font, t.face, t.axes, true, &face);
    if (status == EXIT_SUCCESS && !help)
        status = type_run(&t, face);
    type_ink_finish(&t.more);
    font_face_close(face);
    free(filter);
    free(font);
    return status;
}
