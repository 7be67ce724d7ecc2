/* beside.h - pictures that a document's text names: a PNG in the folder of the document's file,
 * or below it.
 *
 *     struct display_image image;
 *     if (display_beside_read("docs/reader.md", "images/page.png", &image))
 *         ...
 */
#ifndef LUTETIA_DISPLAY_BESIDE_H
#define LUTETIA_DISPLAY_BESIDE_H

#include "display.h"

#include <stdbool.h>
#include <stdio.h>

/* False: it is elsewhere, no PNG, larger than 512 MB, or cannot be read. Owns: the caller
 * destroys *out. */
bool display_beside_read(const char *file, const char *target, struct display_image *out);
/* The same, with how opaque each pixel is; *alpha NULL: all are. Owns: the caller frees
 * *alpha. */
bool display_beside_read_alpha(const char *file, const char *target, struct display_image *out,
                               uint8_t **alpha);

/* The same, and its bytes as they are, which are those of a PNG. */
bool display_beside_copy(const char *file, const char *target, FILE *to);

#endif
