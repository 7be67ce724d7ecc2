/* picture.h - the picture of a part of a sheet, and where it has changed: for whoever looks at
 * paper while it is painted.
 *
 *     struct paper_area areas[PAPER_AREAS_MAX];
 *     const int count = paper_sheet_changed(sheet, areas);
 *     for (int i = 0; i < count; i++) {
 *         uint8_t *first = rgb + 3 * ((size_t)areas[i].y * width + areas[i].x);
 *         paper_sheet_view_area(sheet, &view, &areas[i], first, 3 * width);
 *         show(rgb, &areas[i]);
 *     }
 *
 * After this rgb is the picture of the whole sheet. It costs what has changed: while steps go
 * on in boxes around what is wet (paper_sheet_confine()), only boxes are looked at, and nothing
 * of them is copied back to the sheet.
 *
 * Errors, ownership and threads: as sheet.h says. */
#ifndef LUTETIA_PAPER_PICTURE_H
#define LUTETIA_PAPER_PICTURE_H

#include "sheet.h"

enum { PAPER_AREAS_MAX = 16 };

/* Fibers x..x + width - 1, y..y + height - 1 of a sheet. */
struct paper_area {
    int x, y, width, height;
};

/* The picture of an area, one pixel a fiber, in 8 bits: the upper 8 of what paper_sheet_view()
 * gives there. view->scale must be 1 or 0, and view->alpha NULL. Shape: rgb is the area's first
 * pixel; 3 bytes a pixel, pitch_bytes from row to row. Errors: BAD_ARGUMENT (an area that is
 * empty or not on the sheet, too small a pitch, a view that cannot be shown), NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status paper_sheet_view_area(struct paper_sheet *sheet,
                                        const struct paper_sheet_view *view,
                                        const struct paper_area *area, uint8_t *rgb,
                                        size_t pitch_bytes);

/* Where the picture may have changed since this was called last, whatever the view: areas that
 * are on the sheet and not empty, and may overlap. The first time it is the whole sheet, and
 * also after undo and the like. Returns how many. What has been undone or redone is computed
 * first, as before each look; where that fails the whole sheet is told, and the look fails. */
int paper_sheet_changed(struct paper_sheet *sheet, struct paper_area areas[PAPER_AREAS_MAX]);

#endif
