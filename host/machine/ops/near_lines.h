/* near_lines.h - scans of lines, and lines filled, on the front end's own thread: what
 * kernels/scan.cl does, the same bits. */
#ifndef LUTETIA_MACHINE_NEAR_LINES_H
#define LUTETIA_MACHINE_NEAR_LINES_H

#include "ops/scan.h"

/* run: how many elements of a line floats are combined of, before these are joined. The arrays
 * are the front end's, and the device is not at them. Where there are sums, `out` is not
 * written. In so many parts, shared out among the crew. */
void near_lines_scan(struct crew *crew, int parts, const struct lines *l,
                     const struct line_scan *j, int run);
/* Fills each line with one element of so many bytes. */
void near_lines_fill(struct crew *crew, int parts, const struct lines *l, size_t bytes,
                     const struct device_buffer *from, struct origin origin,
                     struct device_buffer *out);

/* Where a row of lines begins; the other ends of all rows that the lines are in, into the
 * halos. */
size_t near_lines_row(const struct lines *l, size_t row);
void near_lines_repeat(const struct lines *l, void *out, size_t bytes);

#endif
