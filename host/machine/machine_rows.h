/* machine_rows.h - a field's values where they lie.
 *
 *     struct machine_rows rows;
 *     if (machine_field_look (m, field, MACHINE_UINT (8), &rows) == MACHINE_OK && rows.at)
 *         draw (rows.at + y * rows.pitch);
 *
 * Errors, Threads: as machine.h. */
#ifndef LUTETIA_MACHINE_ROWS_H
#define LUTETIA_MACHINE_ROWS_H

#include "machine.h"

/* The values that machine_field_download() has, to be read and not copied: rows along the last
 * axis, `pitch` bytes apart, until the machine is called again. at is NULL where they are not
 * in the front end's memory. A field that was looked at, and has not changed since, is not
 * moved by looking at others. */
struct machine_rows {
    const unsigned char *at;
    size_t pitch;
};
enum machine_status machine_field_look(struct machine *m, uint32_t field,
                                       struct machine_type type, struct machine_rows *rows);

#endif
