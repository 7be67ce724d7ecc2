/* chunks.h - memory that arrays are parts of, where the device computes in the front end's.
 *
 * A page that the system gives when it is first written costs more than all that is computed
 * there, and a large one some times as much as a small one. So arrays up to half a large page
 * are parts of chunks: the smallest of one that is written when the machine is made, others of
 * large pages. The crew has these written before they are used: one ahead of the program, and
 * as many as the fields that it allocates will need.
 *
 *     small     | 2 KiB | 16 KiB | 4 KiB | ...                      512 KiB, for arrays up to 32 KiB
 *     middle    | 400 kB | 100 kB | 400 kB | 400 kB | ...           a large page
 *     next      |                        |                          others, which the crew makes ready
 *
 * A chunk is freed with its last part, when the device takes no more of it. */
#ifndef LUTETIA_MACHINE_CHUNKS_H
#define LUTETIA_MACHINE_CHUNKS_H

#include "device/device.h"

void chunks_begin(struct device *d);
void chunks_finish(struct device *d);
/* Makes the array a part of a chunk. False: it has to have memory of its own. */
bool chunk_take(struct device *d, struct rows rows, struct device_buffer *b);
/* The device's memory object of that part; NULL: no memory. It holds the part from then on. */
cl_mem chunk_mem(const struct device_buffer *b);
void chunk_leave(struct chunk *c); /* by a part */

#endif
