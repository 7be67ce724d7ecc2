/* verb_font.c - `lutetia font FILE`: a specimen of a font, a glyph at each level of the
 * pipeline, and filters. */
#include "font_verb.h"
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"

#include <own.h>
#include <typeface.h>
#include <visible_text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is shown, and what is written where. */
static int wishes_check(const struct font_verb *v)
{
    static const char *const levels[] = {"outline", "glif", "master", "rectangles",
                                         "filter",  "gray", NULL};
    const bool filter = v->write && strcmp(v->write, "filter") == 0;
    int i = 0;
    if ((v->proof != NULL) + (v->waterfall != NULL) + (v->against != NULL) +
            (v->glyph != NULL) + v->show_filter + (v->typeface_px > 0) >
        1)
        return fail_usage("font",
                          "there is one of --proof, --waterfall, --against, --typeface, "
                          "--glyph and --show-filter at a time");
    if (v->write && (!(v->glyph || filter) || !v->edits))
        return fail_usage("font", "--write wants a --glyph, and --edits to write to");
    while (v->write && levels[i] && strcmp(v->write, levels[i]) != 0)
        i++;
    if (v->write && !levels[i])
        return fail_usage("font",
                          "--write must be outline, glif, master, rectangles, filter or gray "
                          "(got '%.60s')",
                          v->write);
    if (v->sizes[1] > 0 && (!filter || !(v->sizes[0] < v->sizes[1])))
        return fail_usage("font", "--sizes are for --write filter, from the least to the most");
    return EXIT_SUCCESS;
}

static int font_options(struct font_verb *v, int argc, char **argv, bool *help)
{
    const struct option_row rows[] = {
        {"out", 'o', OPTION_PNG, "FILE", "the picture, PNG (out.png)", &v->out_path, 0, 0, 0},
        {"face", 0, OPTION_INTEGER, "N", "which face of a collection (0)", &v->face, 0, 65535,
         0},
        {"axes", 0, OPTION_TEXT, "A=V,..",
         "positions of a variable font's axes: wght=700,wdth=80", &v->axes, 0, 0, 0},
        {"text", 0, OPTION_TEXT, "TEXT", "text of the specimen's lines", &v->text, 0, 0, 0},
        {"glyph", 0, OPTION_TEXT, "G",
         "draw this glyph at each level: a character, U+0041, a name (f_f_i) or #214",
         &v->glyph, 0, 0, 0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the glyph in gray (12.25)", &v->size_px, 0.5,
         200, 0},
        {"em", 0, OPTION_INTEGER, "N", "pixels to the em of the glyph's master (860)",
         &v->em_px, 16, 4096, 0},
        {"master-out", 0, OPTION_PNG, "FILE",
         "write the glyph's master as PNG, to be retouched", &v->master_out, 0, 0, 0},
        {"master", 0, OPTION_TEXT, "FILE", "take this master, a PNG that was retouched",
         &v->master_in, 0, 0, 0},
        {"edits", 0, OPTION_TEXT, "DIR",
         "show the font with the edits in this folder, and say what they are", &v->edits, 0, 0,
         0},
        {"write", 0, OPTION_TEXT, "LEVEL",
         "write the glyph's outline, glif, master, rectangles, filter or gray to --edits, to "
         "be "
         "edited; without --glyph a filter for all glyphs",
         &v->write, 0, 0, 0},
        {"sizes", 0, OPTION_NUMBERS, "PX,PX",
         "the sizes that a filter is written for, up to the second (all)", v->sizes, 0,
         FONT_SIDE_MAX, 2},
        {"merge", 0, OPTION_INTEGER, "N",
         "join rectangles whose sides differ by up to N pixels", &v->merge, 1, 4096, 0},
        {"filter", 0, OPTION_TEXT, "F", "the filter's name (gaussian-fast)", &v->filter, 0, 0,
         0},
        {"proof", 0, OPTION_TEXT, "WORD",
         "this word by every filter at several sizes, with what it keeps in numbers", &v->proof,
         0, 0, 0},
        {"display", 0, OPTION_TEXT, "D",
         "the display that the proof is for: lcd, crt or print (lcd)", &v->display, 0, 0, 0},
        {"waterfall", 0, OPTION_TEXT, "AXIS",
         "a line of type at nine places along a variable font's axis: wght", &v->waterfall, 0,
         0, 0},
        {"typeface", 0, OPTION_NUMBER, "PX",
         "all glyphs at this size in one picture, drawn on the OpenCL device, and a table of "
         "where each is: out.csv",
         &v->typeface_px, FONT_TYPEFACE_LEAST_PX, FONT_TYPEFACE_MOST_PX, 0},
        {"against", 0, OPTION_TEXT, "FILE",
         "compare with another version of the font: both, and what is different", &v->against,
         0, 0, 0},
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
    if (v->edits && v->show_filter)
        return fail_usage("font", "--edits goes without --show-filter");
    if (!v->file && !v->show_filter)
        return fail_usage("font", "give a font file, a font file's name or a family");
    return wishes_check(v);
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

static void face_print(struct font_face *face)
{
    struct font_face_info info;
    font_face_describe(face, &info);
    visible_print("%s %s: %s, %d glyphs, %g units to the em, face %d of %d\n%s\n", info.family,
                  info.style, info.format, info.glyphs_count, info.units_per_em, info.index,
                  info.faces_count, info.path);
    font_list_print(face);
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
        drawn = font_stroke_draw(&image, tick, 2, 1, gray);
    }
    struct font_point base[] = {{x0, y0}, {x0 + SIDE, y0}};
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = font_stroke_draw(&image, base, 2, 1, gray);
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = font_stroke_draw(&image, edge, CURVE, 1.6, blue);
    if (status == EXIT_SUCCESS && drawn == FONT_OK)
        drawn = font_stroke_draw(&image, profile, CURVE, 2, red);
    if (drawn != FONT_OK)
        status = fail_font("font");
    for (int r = 0; r < SIDE && status == EXIT_SUCCESS; r++)
        for (int c = 0; c < SIDE; c++) { /* the filter itself, negative values in blue */
            double u = -reach + 2 * reach * (c + 0.5) / SIDE,
                   w = -reach + 2 * reach * (r + 0.5) / SIDE;
            double value = font_filter_at(f, u, w) / info.peak;
            uint8_t ink = (uint8_t)lrint(255 * (1 - fmin(1, fabs(value))));
            uint8_t rgb[3] = {ink, ink, value < 0 ? 255 : ink};
            font_box_fill(&image, 2 * GAP + SIDE + c, TOP + r, 2 * GAP + SIDE + c + 1,
                          TOP + r + 1, rgb);
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

/* ---- edits ---- */

static void edits_print(const struct font_edits *edits)
{
    for (int i = 0; i < font_edits_count(edits); i++) {
        struct font_edit e = font_edits_at(edits, i);
        char sizes[64] = "";
        if (e.level == FONT_EDITS_GRAY)
            snprintf(sizes, sizeof sizes, " at %g px", e.from_px);
        if (e.level == FONT_EDITS_FILTER && e.to_px < FONT_SIDE_MAX)
            snprintf(sizes, sizeof sizes, " for %g to %g px", e.from_px, e.to_px);
        visible_print("%s of %s%s%s%s: %s, %s\n", font_edits_level_name(e.level), e.name, sizes,
                      *e.setting ? " where " : "", *e.setting ? e.setting + 1 : "", e.file,
                      e.edited ? "edited" : "as it was written");
    }
    if (font_edits_changed(edits))
        tell("font", "%s", font_edits_changed(edits));
}

/* A filter for every glyph, and the edits as they are then. */
static int filter_write(const struct font_verb *v, struct font_face *face,
                        struct font_edits **edits)
{
    struct font_levels *levels;
    const struct font_outline none = {.units_per_em = 1000};
    if (font_levels_create(&none, v->em_px, v->size_px, v->filter, &levels) != FONT_OK)
        return fail_font("font");
    int status = font_level_write(v, face, FONT_EVERY_GLYPH, *edits, levels);
    font_levels_destroy(levels);
    font_edits_destroy(*edits);
    *edits = NULL;
    if (status == EXIT_SUCCESS && font_edits_read(v->edits, face, edits) != FONT_OK)
        status = fail_font("font");
    return status;
}

/* The picture that was asked for, of the font with its edits. A folder that is to be written to
 * need not be there. */
static int picture_make(const struct font_verb *v, struct font_face *face)
{
    struct font_edits *edits = NULL;
    if (v->edits && (!v->write || font_edits_is(v->edits)) &&
        font_edits_read(v->edits, face, &edits) != FONT_OK)
        return fail_font("font");
    face_print(face);
    if (edits)
        edits_print(edits);
    int status = v->write && !v->glyph ? filter_write(v, face, &edits) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS && v->glyph)
        status = font_levels_show(v, face, edits);
    else if (status == EXIT_SUCCESS && edits && font_edits_apply(edits, face) != FONT_OK)
        status = fail_font("font");
    else if (status == EXIT_SUCCESS)
        status = v->proof             ? font_proof_show(v, face)
                 : v->waterfall       ? font_waterfall_show(v, face)
                 : v->against         ? font_against_show(v, face)
                 : v->typeface_px > 0 ? font_typeface_show(v, face)
                                      : specimen_make(v, face);
    font_edits_destroy(edits);
    return status;
}

int verb_font(int argc, char **argv)
{
    struct font_verb v = {.filter = "gaussian-fast",
                          .out_path = "out.png",
                          .size_px = 12.25,
                          .em_px = 860,
                          .display = "lcd"};
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
    if (status == EXIT_SUCCESS)
        status = picture_make(&v, face);
    font_face_close(face);
    free(filter);
    return status;
}
