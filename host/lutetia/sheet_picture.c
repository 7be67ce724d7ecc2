/* sheet_picture.c - sheets with layers as pictures of 8 bits. */
#include "sheet_picture.h"
#include "lutetia.h"

#include <stdint.h>
#include <stdlib.h>

int sheet_picture_read(const char *verb, struct paper_sheet *sheet,
                       const struct paper_sheet_view *view, struct display_image *image)
{
    const size_t count = 3 * (size_t)image->width_px * (size_t)image->height_px;
    uint16_t *rgb = malloc(count * sizeof *rgb);
    if (!rgb)
        return fail(verb, "no memory for a picture");
    int status = EXIT_SUCCESS;
    if (paper_sheet_view(sheet, view, rgb) != PAPER_OK)
        status = fail_paper(verb);
    for (size_t i = 0; i < count && status == EXIT_SUCCESS; i++)
        image->pixels[i] = (uint8_t)((rgb[i] * 255u + 32767) / 65535);
    free(rgb);
    return status;
}

int sheet_picture_write(const char *verb, struct paper_sheet *sheet,
                        const struct paper_sheet_view *view, const char *path)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct display_image image = {
        .width_px = config->width, .height_px = config->height, .channels = 3};
    if (display_image_create(&image) != DISPLAY_OK)
        return fail(verb, "%s", display_error());
    const int status = sheet_picture_read(verb, sheet, view, &image);
    return picture_finish(verb, status, path, &image);
}
