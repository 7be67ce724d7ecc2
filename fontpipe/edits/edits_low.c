/* edits_low.c - the levels below the rectangles in files: filter tables and gray. See
 * edits_internal.h. */
#include "edits_internal.h"

#include <display.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum font_status edits_filter_read(struct edits_row *row, const char *path, const char *bytes,
                                   size_t count)
{
    struct font_filter *made;
    if (count > EDITS_FILTER_BYTES_MAX)
        return font_fail(FONT_TOO_LARGE, "%s: a filter's file has up to %d bytes", path,
                         EDITS_FILTER_BYTES_MAX);
    row->words = malloc(count + 1);
    if (!row->words)
        return font_fail(FONT_NO_MEMORY, "no memory for %s", path);
    font_filter_words(bytes, count, row->words);
    enum font_status status = font_filter_create_named(row->words, &made);
    if (status != FONT_OK)
        return font_fail(status == FONT_NO_MEMORY ? status : FONT_BAD_FILE, "%s: %.300s", path,
                         font_error());
    font_filter_destroy(made);
    return FONT_OK;
}

enum font_status edits_gray_read(struct edits_row *row, const char *path)
{
    struct display_image image = {0};
    if (display_png_bytes(path, 1) > EDITS_PNG_BYTES_MAX)
        return font_fail(FONT_TOO_LARGE, "%s: a picture of so many pixels is no glyph", path);
    if (display_png_read_gray(path, &image) != DISPLAY_OK)
        return font_fail(FONT_BAD_FILE, "%s", display_error());
    const struct font_gray_frame frame = {row->left_px, row->top_px, image.width_px,
                                          image.height_px};
    for (size_t i = 0; i < (size_t)image.width_px * (size_t)image.height_px; i++)
        image.pixels[i] = (uint8_t)(255 - image.pixels[i]);
    enum font_status status =
        font_gray_put(&row->gray, &frame, image.pixels, (size_t)image.width_px);
    display_image_destroy(&image);
    return status == FONT_OK ? status : font_fail(status, "%s: %.300s", path, font_error());
}

enum font_status edits_filter_text(const struct font_filter *filter, char **text, size_t *count)
{
    enum { SAMPLES = 33 };
    struct font_filter_info info;
    font_filter_describe(filter, &info);
    *text = NULL;
    FILE *f = open_memstream(text, count);
    if (f) {
        fprintf(f,
                "# %s as a table: %s, the radius in pixels, and values from the centre to the "
                "radius, as many as wanted.\n"
                "# A filter's name may stand in its place: cone, or gaussian:0.6,2.\n%s:%.9g\n",
                info.name,
                info.terms > 1 ? "round (the same in all directions)"
                               : "samples (a product: of columns and of rows)",
                info.terms > 1 ? "round" : "samples", info.radius_px);
        for (int i = 0; i < SAMPLES;
             i++) { /* just within the radius, where some end in a step */
            double u = info.radius_px * fmin((double)i / (SAMPLES - 1), 1 - 1e-9);
            fprintf(f, "%.6g\n", font_filter_at(filter, u, 0) / info.peak);
        }
    }
    if (f && fclose(f) == 0 && *text)
        return FONT_OK;
    free(*text);
    *text = NULL;
    return font_fail(FONT_NO_MEMORY, "no memory for a filter");
}

enum font_status edits_gray_picture(struct font_levels *levels, struct edits_row *row,
                                    struct display_image *image)
{
    enum { MARGIN = 2 };
    const struct font_gray *g;
    enum font_status status = font_levels_gray(levels, 0, 0, &g);
    if (status != FONT_OK)
        return status;
    *image = (struct display_image){.width_px = g->width_px + 2 * MARGIN,
                                    .height_px = g->height_px + 2 * MARGIN,
                                    .channels = 1};
    if (display_image_create(image) != DISPLAY_OK)
        return font_fail(FONT_NO_MEMORY, "%s", display_error());
    size_t pitch = (size_t)image->width_px;
    memset(image->pixels, 255, pitch * (size_t)image->height_px);
    for (int r = 0; r < g->height_px; r++)
        for (int c = 0; c < g->width_px; c++)
            image->pixels[(size_t)(r + MARGIN) * pitch + (size_t)(c + MARGIN)] =
                (uint8_t)(255 - g->pixels[(size_t)r * (size_t)g->pitch + (size_t)c]);
    row->left_px = g->left_px - MARGIN;
    row->top_px = g->top_px - MARGIN;
    return FONT_OK;
}
