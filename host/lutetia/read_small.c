/* read_small.c - see read_small.h. */
#include "read_small.h"
#include "lutetia.h"

#include <display.h>
#include <reader_miniatures.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GAP_PX = 8, DESK = 0x9a };
static const double PIXELS_MOST = 250e6;

/* The picture is a third wider than high, as far as whole pages allow. */
static int sheet_make(struct reader_miniatures *small, struct display_image *image,
                      int *columns)
{
    const int count = reader_miniatures_count(small);
    int width, height;
    reader_miniatures_size(small, &width, &height);
    *columns = (int)fmax(
        1, fmin(count, ceil(sqrt(4.0 / 3 * count * (height + GAP_PX) / (width + GAP_PX)))));
    const double across = GAP_PX + (double)*columns * (width + GAP_PX),
                 down = GAP_PX + ceil((double)count / *columns) * (height + GAP_PX);
    if (across * down > PIXELS_MOST || fmax(across, down) > DISPLAY_SIDE_MAX)
        return fail("read",
                    "%d pages of %d pixels are too large for a picture; take a smaller "
                    "--miniatures",
                    count, width);
    *image =
        (struct display_image){.width_px = (int)across, .height_px = (int)down, .channels = 3};
    if (display_image_create(image) != DISPLAY_OK)
        return fail("read", "%s", display_error());
    memset(image->pixels, DESK, 3 * (size_t)image->width_px * (size_t)image->height_px);
    return EXIT_SUCCESS;
}

int read_small_write(const char *path, const struct reader_document *document,
                     const struct reader_pages_setup *setup, int width_px)
{
    const struct reader_miniatures_def def = {.setup = setup, .width_px = width_px};
    struct reader_miniatures *small;
    struct display_image image = {0};
    int columns = 1, width, height;
    if (reader_miniatures_make(document, &def, &small) != READER_OK)
        return fail("read", "%s", reader_error());
    reader_miniatures_size(small, &width, &height);
    int status = sheet_make(small, &image, &columns);
    const size_t row = 3 * (size_t)image.width_px;
    for (int i = 0; i < reader_miniatures_count(small) && status == EXIT_SUCCESS; i++) {
        const size_t x = GAP_PX + (size_t)(i % columns) * (size_t)(width + GAP_PX),
                     y = GAP_PX + (size_t)(i / columns) * (size_t)(height + GAP_PX);
        if (reader_miniatures_paint(small, i, image.pixels + y * row + 3 * x, row) != READER_OK)
            status = fail("read", "%s", reader_error());
    }
    if (status == EXIT_SUCCESS && display_png_write(path, &image) != DISPLAY_OK)
        status = fail("read", "%s", display_error());
    display_image_destroy(&image);
    reader_miniatures_destroy(small);
    return status;
}
