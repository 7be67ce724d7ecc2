/* type_common.c - see type_common.h. */
#include "type_common.h"
#include "lutetia.h"

#include <edits.h>
#include <input_file.h>
#include <output_file.h>
#include <visible_text.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const double pixels_max = 4e8;

int fail_font(const char *verb)
{
    return fail(verb, "%s", font_error());
}

int type_image_create(const char *verb, double width, double height,
                      struct display_image *image)
{
    width = fmax(1, width);
    height = fmax(1, height);
    if (!(width <= DISPLAY_SIDE_MAX && height <= DISPLAY_SIDE_MAX &&
          width * height <= pixels_max))
        return fail(verb,
                    "the picture would be %.0fx%.0f pixels; %d a side and %.0f million in all "
                    "are the most",
                    width, height, DISPLAY_SIDE_MAX, pixels_max * 1e-6);
    *image =
        (struct display_image){.width_px = (int)width, .height_px = (int)height, .channels = 3};
    if (display_image_create(image) != DISPLAY_OK)
        return fail(verb, "%s", display_error());
    memset(image->pixels, 255, 3 * (size_t)image->width_px * (size_t)image->height_px);
    return EXIT_SUCCESS;
}

struct font_picture type_picture(const struct display_image *image)
{
    return (struct font_picture){image->width_px, image->height_px, 3 * image->width_px,
                                 image->pixels};
}

enum type_out type_out_of(const char *path)
{
    const char *base = strrchr(path, '/'), *ending = strrchr(base ? base : path, '.');
    return !ending || strcasecmp(ending, ".png") == 0 ? TYPE_OUT_PNG
           : strcasecmp(ending, ".svg") == 0          ? TYPE_OUT_SVG
           : strcasecmp(ending, ".pdf") == 0          ? TYPE_OUT_PDF
                                                      : TYPE_OUT_NONE;
}

void type_missing_tell(const char *verb, const char *font, const struct font_layout *layout)
{
    if (!layout->missing_count)
        return;
    char which[10 * FONT_MISSING_MAX + 1] = "";
    size_t used = 0;
    for (int i = 0; i < layout->missing_count && i < FONT_MISSING_MAX; i++)
        used += (size_t)snprintf(which + used, sizeof which - used, " U+%04X",
                                 (unsigned)layout->missing[i]);
    tell(verb, "no font has a glyph for%s%s; %s's sign for that is set instead", which,
         layout->missing_count > FONT_MISSING_MAX ? " and more" : "", font);
}

void type_damaged_tell(const char *verb, int damaged)
{
    if (damaged)
        tell(verb, "the text is not UTF-8 in %d places; U+FFFD stands there", damaged);
}

void type_edits_tell(const char *verb)
{
    const char *what = font_edits_said();
    if (what)
        tell(verb, "%s", what);
}

void type_left_out_tell(const char *verb)
{
    const char *what = font_left_out();
    type_edits_tell(verb);
    if (what)
        tell(verb, "%s", what);
}

void type_text_check(const char *verb, const char *font, struct font_face *face,
                     const char *text)
{
    struct font_shaper *shaper;
    struct font_layout layout = {0};
    if (font_shaper_create(face, &shaper) != FONT_OK)
        return; /* whoever draws the text says why */
    if (font_shaper_layout(shaper, text, strlen(text), 16, NULL, &layout) == FONT_OK)
        type_missing_tell(verb, font, &layout);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
}

int type_drawing_write(const char *verb, const char *path, const struct font_drawing *drawing,
                       const struct font_layout *layout, const struct font_map *map,
                       double x_px, double y_px)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return fail(verb, "%s: cannot write: %s", path, out.why);
    enum font_status status =
        type_out_of(path) == TYPE_OUT_PDF
            ? font_drawing_pdf(drawing, layout, map, x_px, y_px, out.stream)
            : font_drawing_svg(drawing, layout, map, x_px, y_px, out.stream);
    if (status != FONT_OK) {
        output_file_abandon(&out);
        return fail_font(verb);
    }
    return output_file_commit(&out) ? EXIT_SUCCESS
                                    : fail(verb, "%s: cannot write: %s", path, out.why);
}

int type_image_write(const char *verb, const char *path, const struct display_image *image)
{
    if (display_png_write(path, image) != DISPLAY_OK)
        return fail(verb, "%s", display_error());
    return EXIT_SUCCESS;
}

int type_face_open(const char *verb, const char *name, int index, const char *axes,
                   bool coloured, struct font_face **out)
{
    if (font_edits_open(name, index, coloured, out) != FONT_OK)
        return fail_font(verb);
    type_edits_tell(verb);
    enum font_status status = font_face_axes_set(*out, axes);
    if (status != FONT_OK) {
        font_face_close(*out);
        *out = NULL;
        return status == FONT_BAD_ARGUMENT ? fail_usage(verb, "%s", font_error())
                                           : fail_font(verb);
    }
    return EXIT_SUCCESS;
}

int type_font_name(const char *verb, const char *given, const char *edits, const char *usual,
                   char **out)
{
    size_t bytes =
        (given ? strlen(given) : 0) + (edits ? strlen(edits) : 0) + strlen(usual) + 2;
    *out = NULL;
    if (edits && !font_edits_is(edits))
        return fail(verb,
                    "%s/edits.txt: there is no such file, as `lutetia font FONT --glyph G "
                    "--edits DIR --write LEVEL` makes one",
                    edits);
    *out = malloc(bytes);
    if (!*out)
        return fail(verb, "no memory");
    if (edits && given)
        snprintf(*out, bytes, "%s+%s", given, edits);
    else
        snprintf(*out, bytes, "%s", edits ? edits : given ? given : usual);
    return EXIT_SUCCESS;
}

int type_filter_read(const char *verb, const char *name, char **out)
{
    enum { BYTES_MAX = 16384 };
    if (name[0] != '@') {
        *out = strdup(name);
        return *out ? EXIT_SUCCESS : fail(verb, "no memory");
    }
    const char *why;
    size_t count;
    *out = input_file_read(name + 1, BYTES_MAX, &count, &why);
    if (!*out)
        return errno == EFBIG
                   ? fail(verb, "%s: a filter's file has up to %d bytes", name + 1, BYTES_MAX)
                   : fail(verb, "%s: %s", name + 1, why);
    font_filter_words(*out, count, *out); /* it gets shorter, if anything */
    return EXIT_SUCCESS;
}

int type_display_read(const char *verb, const char *word, enum font_display *out)
{
    static const char *const words[] = {
        [FONT_DISPLAY_LCD] = "lcd", [FONT_DISPLAY_CRT] = "crt", [FONT_DISPLAY_PRINT] = "print"};
    for (int i = FONT_DISPLAY_LCD; i <= FONT_DISPLAY_PRINT; i++)
        if (strcmp(word, words[i]) == 0) {
            *out = (enum font_display)i;
            return EXIT_SUCCESS;
        }
    return fail_usage(verb, "--display must be lcd, crt or print (got '%.60s')", word);
}

/* A filter's losses in words. */
static void fit_print(const char *name, const struct font_filter_fit *fit)
{
    visible_print("%s loses %.0f %% of a line's contrast, %.1f %% of it come and go with its "
                  "place, an edge rings by %.1f %%",
                  name, 100 * fit->lost, 100 * fit->uneven, 100 * fit->rings);
}

int type_fits_best(const struct font_filter_fit *fits, int count, int but)
{
    int best = -1;
    for (int i = 0; i < count; i++)
        if (i != but && (best < 0 || fits[i].cost < fits[best].cost))
            best = i;
    return best;
}

void type_fits_print(const char *const *names, const struct font_filter_fit *fits, int count,
                     double detail_px)
{
    int best = type_fits_best(fits, count, -1), second = type_fits_best(fits, count, best);
    visible_print("%s, for lines of %.2f pixels: ", names[best], detail_px);
    fit_print(names[best], &fits[best]);
    if (second >= 0) {
        visible_print("; next ");
        fit_print(names[second], &fits[second]);
    }
    visible_print("\n");
}

const char *type_filter_choose(const char *verb, double detail_px, enum font_display display)
{
    enum { MOST = 32 };
    struct font_filter_fit fits[MOST] = {{0}};
    const char *const *names = font_filter_names();
    int count = 0;
    for (; names[count] && count < MOST; count++) {
        struct font_filter *filter;
        if (font_filter_create_named(names[count], &filter) != FONT_OK) {
            fail_font(verb);
            return NULL;
        }
        fits[count] = font_filter_fit(filter, detail_px, display);
        font_filter_destroy(filter);
    }
    printf("filter: ");
    type_fits_print(names, fits, count, detail_px);
    return names[type_fits_best(fits, count, -1)];
}

/* ---- labels ---- */

struct type_labels {
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_painter *painter;
    double size_px;
};

struct type_labels *type_labels_create(double size_px)
{
    struct type_labels *l = calloc(1, sizeof *l);
    struct font_painter_def def = font_painter_def_default();
    if (!l)
        return NULL;
    l->size_px = size_px;
    def.places = 4;
    if (font_face_open("DejaVuSans", 0, &l->face) != FONT_OK ||
        font_shaper_create(l->face, &l->shaper) != FONT_OK ||
        font_painter_create(&def, &l->painter) != FONT_OK) {
        type_labels_destroy(l);
        return NULL;
    }
    return l;
}

void type_labels_destroy(struct type_labels *l)
{
    if (!l)
        return;
    font_painter_destroy(l->painter);
    font_shaper_destroy(l->shaper);
    font_face_close(l->face);
    free(l);
}

void type_label(struct type_labels *l, struct display_image *image, double x, double y,
                const char *format, ...)
{
    if (!l)
        return;
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    struct font_layout layout;
    struct font_picture picture = type_picture(image);
    if (font_shaper_layout(l->shaper, text, strlen(text), l->size_px, NULL, &layout) == FONT_OK)
        font_painter_layout(l->painter, &layout, NULL, x, y, &picture);
    font_layout_finish(&layout);
}

bool type_axis_there(const struct font_face *face, const char *tag)
{
    struct font_face_info info;
    struct font_axis axis;
    font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count; i++)
        if (font_face_axis(face, i, &axis) == FONT_OK && strcmp(axis.tag, tag) == 0)
            return true;
    return false;
}
