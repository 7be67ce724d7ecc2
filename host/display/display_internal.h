/* display_internal.h - what the files of this folder share. */
#ifndef LUTETIA_DISPLAY_INTERNAL_H
#define LUTETIA_DISPLAY_INTERNAL_H

#include "display.h"

#include <error_text.h>

/* Records the detail of a failure and returns its status. */
extern _Thread_local struct error_text display_last_error;
#define display_fail(status, ...)                                                              \
    ((enum display_status)error_text_fail(&display_last_error, (int)(status), __VA_ARGS__))

/* display_png_read.c: display_png_read_rgb(), with how opaque each pixel is. Owns: the caller
 * frees *alpha. */
enum display_status display_png_read_rgb_alpha(const char *path, struct display_image *image,
                                               uint8_t **alpha);

#endif
