/* sheet_picture.h - sheets with layers as pictures of 8 bits. */
#ifndef LUTETIA_SHEET_PICTURE_H
#define LUTETIA_SHEET_PICTURE_H

#include <display.h>
#include <sheet.h>

/* Fills an image as large as the sheet. EXIT_SUCCESS, or prints why not. */
int sheet_picture_read(const char *verb, struct paper_sheet *sheet,
                       const struct paper_sheet_view *view, struct display_image *image);

/* Writes the picture as PNG. EXIT_SUCCESS, EXIT_INTERRUPTED, or prints why not. */
int sheet_picture_write(const char *verb, struct paper_sheet *sheet,
                        const struct paper_sheet_view *view, const char *path);

#endif
