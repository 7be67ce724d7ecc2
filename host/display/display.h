/* display.h - images in memory, written and read as PNG files.
 *
 *     struct display_image page = {.width_px = 640, .height_px = 480, .channels = 3};
 *     if (display_image_create(&page) != DISPLAY_OK)
 *         die(display_error());
 *     fill(page.pixels);
 *     if (display_png_write("page.png", &page) != DISPLAY_OK)
 *         die(display_error());
 *     display_image_destroy(&page);
 *
 * Errors. Functions that can fail return a status and leave one line in display_error().
 * Threads. Any; display_error() belongs to the thread that failed.
 */
#ifndef LUTETIA_DISPLAY_H
#define LUTETIA_DISPLAY_H

#include <stddef.h>
#include <stdint.h>

enum display_status {
    DISPLAY_OK = 0,
    DISPLAY_BAD_ARGUMENT, /* an image without size, pixels or a known number of channels */
    DISPLAY_BAD_FILE,     /* not a PNG, or a damaged one */
    DISPLAY_IO_FAILED,    /* the system's reason is in display_error() */
    DISPLAY_NO_MEMORY,
    DISPLAY_NO_WINDOW /* no display to open one on */
};

/* The longest side of an image that is read or written. */
#define DISPLAY_SIDE_MAX 65536

/* Rows from top to bottom, pixels from left to right, channels together, no padding. */
struct display_image {
    int width_px, height_px;
    /* 1: gray; 3: red, green, blue; 4: with alpha, which the colours are not multiplied by */
    int channels;
    uint8_t *pixels;
};

/* Memory for a picture that belongs to another, as a window's: a number for each pixel, its
 * bits 16 to 23 red, 8 to 15 green, 0 to 7 blue, and the highest eight 1. The size is known
 * from elsewhere. */
struct display_room {
    uint32_t *pixels;
    size_t stride; /* numbers from a row to the next */
};

/* Detail of this thread's last failure, one line without a newline; "" if there was none.
 * Owns: the library; valid until this thread's next failure. */
const char *display_error(void);

/* Allocates pixels, all 0, for the size and channels that image holds.
 * Errors: BAD_ARGUMENT, NO_MEMORY; pixels is then NULL. */
enum display_status display_image_create(struct display_image *image);
/* Cuts off an odd last column and an odd last row. */
void display_image_make_even(struct display_image *image);

/* Frees the pixels; an image of zeros is fine. */
void display_image_destroy(struct display_image *image);

/* Writes 8-bit gray, RGB or RGB with alpha. The file appears under its name only when it is
 * whole (output_file.h). Errors: BAD_ARGUMENT, IO_FAILED (a full disk, a folder that is missing
 * or closed), NO_MEMORY; a file that had the name is unchanged, and no part file is left. */
enum display_status display_png_write(const char *path, const struct display_image *image);

/* The same with 16 bits for each channel. Shape: height_px * width_px * channels numbers, as in
 * a display_image. */
enum display_status display_png_write_16(const char *path, int width_px, int height_px,
                                         int channels, const uint16_t *pixels);

/* Reads any PNG as 8-bit gray: colours by their luminance, transparency over white, 16 bits
 * rounded to 8. Errors: BAD_FILE, IO_FAILED, NO_MEMORY; *image is then zeros. Owns: the caller
 * destroys *image. */
enum display_status display_png_read_gray(const char *path, struct display_image *image);
/* The memory that reading a PNG file takes, by its header alone: the image of 1 or 3 channels,
 * and what it is read by. 0 if the file is no PNG, which reading it will say. */
double display_png_bytes(const char *path, int channels);

/* The same as 8-bit red, green, blue. */
enum display_status display_png_read_rgb(const char *path, struct display_image *image);

#endif
