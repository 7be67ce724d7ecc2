/* font_waterfall.c - `lutetia font FILE --waterfall AXIS`: a line of type at places along an
 * axis, others as they are set. */
#include "font_verb.h"
#include "lutetia.h"
#include "type_common.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES = 9, LEFT = 110, GAP = 14, TOP = 34 };
static const double size_px = 34;

/* The axis of that tag; or what there are, told. */
static int axis_find(const struct font_verb *v, const struct font_face *face,
                     struct font_axis *out)
{
    struct font_face_info info;
    char all[512] = "";
    size_t used = 0;
    font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count && font_face_axis(face, i, out) == FONT_OK; i++) {
        if (strcmp(out->tag, v->waterfall) == 0)
            return EXIT_SUCCESS;
        if (used + 8 < sizeof all)
            used += (size_t)snprintf(all + used, sizeof all - used, " %s", out->tag);
    }
    return info.axes_count
               ? fail_usage("font", "%s has no axis '%.20s'; it has%s", v->file, v->waterfall,
                            all)
               : fail_usage("font", "%s has no axes: --waterfall wants a variable font",
                            v->file);
}

/* The line at one place, or only how large it is. */
static enum font_status line_set(const struct font_verb *v, struct font_face *face,
                                 double value, struct font_painter *painter,
                                 struct type_labels *labels, struct display_image *image,
                                 double *y, double *width)
{
    static const char usual[] = "Hamburgefonstiv 0123 &?";
    const char *text = v->text ? v->text : usual;
    struct font_shaper *shaper = NULL;
    struct font_layout layout = {0};
    enum font_status status = font_face_axis_set(face, v->waterfall, value);
    if (status == FONT_OK)
        status = font_shaper_create(face, &shaper);
    if (status == FONT_OK)
        status = font_shaper_layout(shaper, text, strlen(text), size_px, NULL, &layout);
    if (status == FONT_OK && image) {
        struct font_picture picture = type_picture(image);
        type_label(labels, image, 16, *y + layout.ascent_px, "%.4g", value);
        status =
            font_painter_layout(painter, &layout, NULL, LEFT, *y + layout.ascent_px, &picture);
    }
    *y += layout.ascent_px + layout.descent_px + GAP;
    *width = fmax(*width, layout.width_px);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    return status;
}

/* All places, and where the axis is usually. */
static enum font_status lines_set(const struct font_verb *v, struct font_face *face,
                                  const struct font_axis *axis, struct font_painter *painter,
                                  struct type_labels *labels, struct display_image *image,
                                  double *y, double *width)
{
    enum font_status status = FONT_OK;
    bool usual_shown = false;
    for (int i = 0; i < PLACES && status == FONT_OK; i++) {
        double value = axis->least + (axis->most - axis->least) * i / (PLACES - 1);
        if (!usual_shown && value >= axis->usual) {
            usual_shown = true;
            if (value > axis->usual)
                status = line_set(v, face, axis->usual, painter, labels, image, y, width);
        }
        if (status == FONT_OK)
            status = line_set(v, face, value, painter, labels, image, y, width);
    }
    return status;
}

int font_waterfall_show(const struct font_verb *v, struct font_face *face)
{
    struct font_axis axis;
    struct font_face_info info;
    struct display_image image = {0};
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter = NULL;
    double y = TOP, width = 0;
    int status = axis_find(v, face, &axis);
    if (status != EXIT_SUCCESS)
        return status;
    def.filter = v->filter;
    font_face_describe(face, &info);
    if (font_painter_create(&def, &painter) != FONT_OK ||
        lines_set(v, face, &axis, painter, NULL, NULL, &y, &width) != FONT_OK)
        status = fail_font("font");
    if (status == EXIT_SUCCESS)
        status = type_image_create("font", fmax(LEFT + width + 24, 560), y + 8, &image);
    struct type_labels *labels = type_labels_create(13);
    y = TOP;
    if (status == EXIT_SUCCESS) {
        type_label(labels, &image, 16, 22, "%.80s: %s (%.60s), %g to %g, usually %g",
                   info.family, axis.tag, axis.name, axis.least, axis.most, axis.usual);
        if (lines_set(v, face, &axis, painter, labels, &image, &y, &width) != FONT_OK)
            status = fail_font("font");
    }
    type_labels_destroy(labels);
    if (status == EXIT_SUCCESS)
        status = type_image_write("font", v->out_path, &image);
    display_image_destroy(&image);
    font_painter_destroy(painter);
    return status;
}
