/* sheet_picture.h - sheets with layers as pictures of 8 bits, lit as scripts light them. */
#ifndef LUTETIA_SHEET_PICTURE_H
#define LUTETIA_SHEET_PICTURE_H

#include <display.h>
#include <sheet.h>

/* Fills an image as large as the sheet. EXIT_SUCCESS, or prints why not. */
int sheet_picture_read(const char *verb, struct paper_sheet *sheet, enum paper_show show,
                       struct display_image *image);

/* Writes the picture as PNG. EXIT_SUCCESS, EXIT_INTERRUPTED, or prints why not. */
int sheet_picture_write(const char *verb, struct paper_sheet *sheet, enum paper_show show,
                        const char *path);

#endif
