/* machine_rows.h - fields' values where they lie.
 *
 *     struct machine_rows rows[3];
 *     if (machine_fields_look (m, rgb, 3, MACHINE_UINT (8), rows) == MACHINE_OK && rows[0].at)
 *         draw (rows[0].at + y * rows[0].pitch);
 *
 * Errors, Threads: as machine.h. */
#ifndef LUTETIA_MACHINE_ROWS_H
#define LUTETIA_MACHINE_ROWS_H

#include "machine.h"

/* The values that machine_field_download() has, to be read and not copied: rows along the last
 * axis, `pitch` bytes apart, until the machine is called again. at is NULL where they are not
 * in the front end's memory. */
struct machine_rows {
    const unsigned char *at;
    size_t pitch;
};

/* The fields, at most MACHINE_LOOK_MAX, are of one VP set. What of them waits is computed by
 * one evaluation, which is faster than one for each. */
enum { MACHINE_LOOK_MAX = 4 };
enum machine_status machine_fields_look(struct machine *m, const uint32_t *fields, int count,
                                        struct machine_type type, struct machine_rows *rows);

/* Works at rows first to end - 1. Several threads are at it at once, each at its own rows. */
typedef void machine_rows_work(void *context, size_t first, size_t end);
/* Has all rows worked at, shared out between the machine's threads where that takes less
 * time. It copies, or takes as long as copying: row_bytes are written for a row. */
void machine_rows_share(struct machine *m, size_t rows, size_t row_bytes,
                        machine_rows_work *work, void *context);

#endif
