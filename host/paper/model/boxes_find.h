/* boxes_find.h - boxes around what can change on a sheet. */
#ifndef LUTETIA_PAPER_BOXES_FIND_H
#define LUTETIA_PAPER_BOXES_FIND_H

#include <stdbool.h>
#include <stdint.h>

enum { BOXES_MOST = 6 };

/* Fibers x..x + width - 1, y..y + height - 1. The sheet is taken for a torus: a box may go over
 * its edge, and is then not as long as the sheet; one that is as long begins at 0. */
struct box {
    int x, y, width, height;
};

struct boxes_wish {
    int width, height; /* of the sheet */
    int unit;          /* sides of boxes are a few multiples of it */
    int margin;        /* fibers around what is active, at least */
};

/* Boxes that do not touch each other and have all active fibers (other than 0) in them, at
 * least `margin` from their sides; fewer than BOXES_MOST + 1. Shape: height * width. Returns
 * how many. */
int boxes_find(const struct boxes_wish *wish, const uint8_t *active,
               struct box boxes[BOXES_MOST]);
/* How far the active fibers of a box stay from its sides; sides of an axis that is as long as
 * the sheet do not count. INT_MAX: there is none. Shape: box->height * box->width. */
int boxes_distance(const struct boxes_wish *wish, const struct box *box, const uint8_t *active);

#endif
