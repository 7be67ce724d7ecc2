/* reader_around.h - ink that text flows around, as obstacles of paragraphs.
 *
 *     struct reader_obstacle *obstacles;
 *     int count;
 *     reader_around_find(remarks, document, &obstacles, &count);
 *     reader_view_around(view, obstacles, count);
 *     free(obstacles);
 *
 * Strokes of a group are one obstacle; what lies between its strokes in one height is of it,
 * too, so that no line stands within a ring. An obstacle is of the paragraph that its anchor
 * is in: it is counted from an edge of that one's column and from its upper edge, in ems. Only
 * paragraphs and headings of the third level and below have some: before others it is ink as
 * any other.
 *
 * Threads: no function keeps anything. */
#ifndef LUTETIA_READER_AROUND_H
#define LUTETIA_READER_AROUND_H

#include "reader_remarks.h"

#include <page.h>

enum { READER_OBSTACLE_ROWS = 128, READER_OBSTACLES_MAX = 1000 };

struct reader_obstacle {
    int block; /* of the document's */
    enum reader_around side;
    double x, y, width, height;                 /* x: from that side's edge, to the right */
    struct page_row rows[READER_OBSTACLE_ROWS]; /* ems from its left edge, all as high */
    int rows_count;
};

/* Whether text flows around what stands beside the block. */
bool reader_around_has(const struct reader_block *block);
/* The block of the document's that ink is an obstacle of; -1: it is none, and is counted from
 * its word. */
int reader_around_block(const struct reader_document *document, const struct reader_remark *r);
/* Those of ink that is seen and whose words are there, that is at most 200 ems wide and high,
 * and at most 1,000 from its paragraph's corner; no more than the first READER_OBSTACLES_MAX.
 * Errors: NO_MEMORY. Owns: the caller frees *out. */
enum reader_status reader_around_find(const struct reader_remarks *remarks,
                                      const struct reader_document *document,
                                      struct reader_obstacle **out, int *count);

#endif
