/* display_png_write.c - whole PNG files or none.
 *
 * libpng writes through sink_write() below, which keeps the system's errno. output_file.h
 * brings the file under its name. */
#include "display_internal.h"

#include <output_file.h>
#include <patience.h>

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct png_sink {
    FILE *file;
    int error; /* errno of the first write that failed */
    char message[256];
};

static void sink_write(png_structp png, png_bytep bytes, size_t count)
{
    struct png_sink *sink = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, sink->file) != count) {
        sink->error = errno ? errno : EIO;
        png_error(png, "write failed");
    }
}

static void sink_flush(png_structp png)
{
    struct png_sink *sink = png_get_io_ptr(png);
    if (fflush(sink->file) != 0 && !sink->error)
        sink->error = errno ? errno : EIO;
}

_Noreturn static void sink_error(png_structp png, png_const_charp message)
{
    struct png_sink *sink = png_get_error_ptr(png);
    snprintf(sink->message, sizeof sink->message, "%s", message);
    png_longjmp(png, 1);
}

static void sink_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message; /* warnings about a file that was written are ignored */
}

/* The pixels to write, of one or two bytes; two-byte pixels in this machine's byte order. */
struct png_source {
    int width_px, height_px, channels, bytes;
    const uint8_t *pixels;
};

/* Writes everything between signature and IEND. False with sink's error or message set. No
 * local is changed after setjmp(), so none needs to be volatile. */
static int png_encode(struct png_sink *sink, const struct png_source *image)
{
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, sink, sink_error, sink_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        sink->error = ENOMEM;
        return 0;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return 0;
    }
    png_set_write_fn(png, sink, sink_write, sink_flush);
    png_set_IHDR(png, info, (png_uint_32)image->width_px, (png_uint_32)image->height_px,
                 8 * image->bytes,
                 image->channels == 1   ? PNG_COLOR_TYPE_GRAY
                 : image->channels == 3 ? PNG_COLOR_TYPE_RGB
                                        : PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    /* Level 2 takes a tenth of the default level's time. Files with the paper's grain are a
     * tenth larger; files of type are no larger. */
    png_set_compression_level(png, 2);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    if (image->bytes == 2 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
        png_set_swap(png);
    size_t row_bytes = (size_t)image->width_px * (size_t)image->channels * (size_t)image->bytes;
    for (int y = 0; y < image->height_px; y++) {
        if (y % 16 == 0 && patience_over())
            png_error(png, "it takes too long");
        png_write_row(png, image->pixels + (size_t)y * row_bytes);
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return 1;
}

static enum display_status source_write(const char *path, const struct png_source *image)
{
    if (!path || !image->pixels || image->width_px < 1 || image->height_px < 1 ||
        (image->channels != 1 && image->channels != 3 && image->channels != 4))
        return display_fail(DISPLAY_BAD_ARGUMENT, "%s: there is no image to write",
                            path ? path : "(no file name)");

    struct output_file out;
    if (!output_file_open(&out, path))
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", path, out.why);
    struct png_sink sink = {.file = out.stream};
    errno = 0;
    int encoded = png_encode(&sink, image);
    if (encoded && output_file_commit(&out))
        return DISPLAY_OK;
    if (encoded)
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", path, out.why);
    output_file_abandon(&out);
    return display_fail(sink.error == ENOMEM ? DISPLAY_NO_MEMORY : DISPLAY_IO_FAILED,
                        "%s: cannot write: %s", path,
                        sink.error ? output_file_explain(sink.error) : sink.message);
}

enum display_status display_png_write(const char *path, const struct display_image *image)
{
    struct png_source source = {.bytes = 1};
    if (image) {
        source.width_px = image->width_px;
        source.height_px = image->height_px;
        source.channels = image->channels;
        source.pixels = image->pixels;
    }
    return source_write(path, &source);
}

enum display_status display_png_write_16(const char *path, int width_px, int height_px,
                                         int channels, const uint16_t *pixels)
{
    return source_write(path, &(struct png_source){.width_px = width_px,
                                                   .height_px = height_px,
                                                   .channels = channels,
                                                   .bytes = 2,
                                                   .pixels = (const uint8_t *)pixels});
}
