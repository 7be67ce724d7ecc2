/* display_image.c - images in memory, and this thread's last error. */
#include "display_internal.h"

#include <stdlib.h>
#include <string.h>

_Thread_local struct error_text display_last_error;

const char *display_error(void)
{
    return display_last_error.text;
}

enum display_status display_image_create(struct display_image *image)
{
    image->pixels = NULL;
    if (image->width_px < 1 || image->height_px < 1 || image->width_px > DISPLAY_SIDE_MAX ||
        image->height_px > DISPLAY_SIDE_MAX ||
        (image->channels != 1 && image->channels != 3 && image->channels != 4))
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "an image is 1..%d pixels wide and high with 1, 3 or 4 channels "
                            "(got %dx%d with %d)",
                            DISPLAY_SIDE_MAX, image->width_px, image->height_px,
                            image->channels);
    size_t row_bytes = (size_t)image->width_px * (size_t)image->channels;
    image->pixels = calloc((size_t)image->height_px, row_bytes);
    if (!image->pixels)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for an image of %dx%d pixels",
                            image->width_px, image->height_px);
    return DISPLAY_OK;
}

void display_image_make_even(struct display_image *image)
{
    const int width = image->width_px & ~1, height = image->height_px & ~1;
    const size_t bytes = (size_t)image->channels;
    for (int y = 0; width != image->width_px && y < height; y++)
        memmove(image->pixels + bytes * (size_t)y * (size_t)width,
                image->pixels + bytes * (size_t)y * (size_t)image->width_px,
                bytes * (size_t)width);
    image->width_px = width;
    image->height_px = height;
}

void display_image_destroy(struct display_image *image)
{
    if (!image)
        return;
    free(image->pixels);
    image->pixels = NULL;
}
