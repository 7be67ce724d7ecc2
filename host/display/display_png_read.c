/* display_png_read.c - any PNG as gray or as red, green, blue.
 *
 * libpng's simplified reader would round-trip through colour management; the transformations
 * asked for here are plain: palette and low depths expanded, 16 bits scaled, transparency put
 * over white, colours weighed. */
#include "display_internal.h"

#include <input_file.h>
#include <patience.h>

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct png_source {
    FILE *file;
    int error; /* errno of a read that failed; 0 if the file ended too soon */
    char message[256];
    uint8_t
        *rows; /* as libpng gives them, gray+alpha or RGB+alpha; one row, or all if the image
               * is interlaced */
    struct display_image image; /* channels: 1 or 3, as the caller asked */
    bool with_alpha;            /* how opaque pixels are is wanted, too */
    uint8_t *alpha;
};

static void source_read(png_structp png, png_bytep bytes, size_t count)
{
    struct png_source *source = png_get_io_ptr(png);
    if (fread(bytes, 1, count, source->file) == count)
        return;
    if (ferror(source->file))
        source->error = errno ? errno : EIO;
    png_error(png, "the file ends too early");
}

_Noreturn static void source_error(png_structp png, png_const_charp message)
{
    struct png_source *source = png_get_error_ptr(png);
    snprintf(source->message, sizeof source->message, "%s", message);
    png_longjmp(png, 1);
}

static void source_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message; /* a warning: the image is readable all the same */
}

/* One row of `channels` (2 gray+alpha, 4 RGB+alpha) over white; Rec. 709 weights in 1/256. */
static void row_to_gray(const uint8_t *row, int channels, int width_px, uint8_t *gray)
{
    for (int x = 0; x < width_px; x++, row += channels) {
        unsigned luminance = channels == 2
                                 ? row[0]
                                 : (54u * row[0] + 183u * row[1] + 19u * row[2] + 128u) / 256u;
        unsigned alpha = row[channels - 1];
        gray[x] = (uint8_t)((luminance * alpha + 255u * (255u - alpha) + 127u) / 255u);
    }
}

/* How opaque one row of RGB+alpha is. */
static void row_to_alpha(const uint8_t *row, int width_px, uint8_t *alpha)
{
    for (int x = 0; x < width_px; x++)
        alpha[x] = row[4 * x + 3];
}

/* One row of RGB+alpha over white. */
static void row_to_rgb(const uint8_t *row, int width_px, uint8_t *rgb)
{
    for (int x = 0; x < width_px; x++, row += 4)
        for (int c = 0; c < 3; c++)
            *rgb++ =
                (uint8_t)((row[c] * (unsigned)row[3] + 255u * (255u - row[3]) + 127u) / 255u);
}

/* All of the calls that may longjmp(). Allocations are kept in source, so that the caller
 * frees them. */
static int png_decode(png_structp png, png_infop info, struct png_source *source)
{
    if (setjmp(png_jmpbuf(png)))
        return 0;
    png_set_read_fn(png, source, source_read);
    png_set_user_limits(png, DISPLAY_SIDE_MAX, DISPLAY_SIDE_MAX);
    png_set_chunk_malloc_max(png, 1 << 24);
    png_read_info(png, info);
    png_set_expand(png);
    png_set_scale_16(png);
    int wanted = source->image.channels;
    if (wanted == 3)
        png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    int channels = png_get_channels(png, info);
    source->image = (struct display_image){.width_px = (int)png_get_image_width(png, info),
                                           .height_px = (int)png_get_image_height(png, info),
                                           .channels = wanted};
    if (channels != 4 && (channels != 2 || wanted == 3))
        png_error(png, "unknown kind of pixels");
    size_t height = (size_t)source->image.height_px, row_bytes = png_get_rowbytes(png, info);
    const size_t width = (size_t)source->image.width_px;
    if (display_image_create(&source->image) != DISPLAY_OK ||
        !(source->rows = calloc(passes > 1 ? height : 1, row_bytes)) ||
        (source->with_alpha && !(source->alpha = malloc(height * width)))) {
        source->error = ENOMEM;
        png_error(png, "no memory");
    }
    for (int pass = 0; pass < passes; pass++)
        for (size_t y = 0; y < height; y++) {
            if (y % 16 == 0 && patience_over())
                png_error(png, "it takes too long");
            uint8_t *row = source->rows + (passes > 1 ? y * row_bytes : 0);
            png_read_row(png, row, NULL);
            uint8_t *out = source->image.pixels + y * width * (size_t)source->image.channels;
            if (pass == passes - 1 && source->image.channels == 3)
                row_to_rgb(row, source->image.width_px, out);
            else if (pass == passes - 1)
                row_to_gray(row, channels, source->image.width_px, out);
            if (pass == passes - 1 && source->with_alpha)
                row_to_alpha(row, source->image.width_px, source->alpha + y * width);
        }
    png_read_end(png, NULL);
    return 1;
}

double display_png_bytes(const char *path, int channels)
{
    /* signature, then IHDR: length, kind, width, height, depth, colour, compression, filter,
     * interlacing */
    enum { WIDTH = 16, HEIGHT = 20, DEPTH = 24, INTERLACED = 28, HEADER = 29, PLANES = 4 };
    static const uint8_t begins[WIDTH] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                          0,    0,   0,   13,  'I',  'H',  'D',  'R'};
    uint8_t header[HEADER];
    FILE *file = input_file_open(path, NULL);
    const bool read = file && fread(header, 1, sizeof header, file) == sizeof header;
    if (file)
        fclose(file);
    if (!read || memcmp(header, begins, sizeof begins) != 0)
        return 0;
    double side[2] = {0, 0};
    for (int i = 0; i < 4; i++) {
        side[0] = 256 * side[0] + header[WIDTH + i];
        side[1] = 256 * side[1] + header[HEIGHT + i];
    }
    const double rows = header[INTERLACED] ? side[1] : 4, wide = header[DEPTH] > 8 ? 2 : 1;
    return side[0] * side[1] * channels + side[0] * rows * PLANES * wide;
}

/* alpha: NULL: it is not wanted. */
static enum display_status read_as(const char *path, int channels, struct display_image *image,
                                   uint8_t **alpha)
{
    *image = (struct display_image){0};
    const char *why = "";
    struct png_source source = {.file = input_file_open(path, &why),
                                .image = {.channels = channels},
                                .with_alpha = alpha != NULL};
    if (!source.file)
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot read: %s", path, why);
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, source_error, source_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    int decoded = 0;
    if (info)
        decoded = png_decode(png, info, &source);
    else
        source.error = ENOMEM;
    png_destroy_read_struct(&png, &info, NULL);
    free(source.rows);
    fclose(source.file);
    if (decoded) {
        *image = source.image;
        if (alpha)
            *alpha = source.alpha;
        return DISPLAY_OK;
    }
    display_image_destroy(&source.image);
    free(source.alpha);
    if (source.error)
        return display_fail(source.error == ENOMEM ? DISPLAY_NO_MEMORY : DISPLAY_IO_FAILED,
                            "%s: cannot read: %s", path, strerror(source.error));
    return display_fail(DISPLAY_BAD_FILE, "%s: not a readable PNG: %s", path, source.message);
}

enum display_status display_png_read_gray(const char *path, struct display_image *image)
{
    return read_as(path, 1, image, NULL);
}

enum display_status display_png_read_rgb(const char *path, struct display_image *image)
{
    return read_as(path, 3, image, NULL);
}

enum display_status display_png_read_rgb_alpha(const char *path, struct display_image *image,
                                               uint8_t **alpha)
{
    *alpha = NULL;
    return read_as(path, 3, image, alpha);
}
