/* near_router.h - sends and gets on the front end's own thread: what kernels/router.cl does,
 * the same bits. */
#ifndef LUTETIA_MACHINE_NEAR_ROUTER_H
#define LUTETIA_MACHINE_NEAR_ROUTER_H

#include "ops/near_addresses.h"

/* source: in memory, or a number that all send. out holds the old dest. arrived: bits, all 0;
 * NULL: nobody wants to know. combiner: MACHINE_COMBINE_. */
void near_send(const struct near_route *r, enum machine_combiner combiner,
               struct machine_type type, const struct machine_value *source,
               struct device_buffer *out, struct device_buffer *arrived);
/* Of elements of so many bytes; 0 from a processor that does not exist. */
void near_get(const struct near_route *r, size_t bytes, const struct device_buffer *source,
              struct device_buffer *out);
/* The other end of each row, on both sides: what sends and gets do at last. */
void near_rows_repeat(const struct vpset *s, size_t bytes, struct device_buffer *b);
/* Whether each address is of a processor, also where nobody sends; and whether then no two are
 * of the same. */
bool near_all_there(const struct near_route *r);
bool near_are_distinct(const struct near_route *r);
/* How many send to a processor that does not exist. */
uint64_t near_wrong(const struct near_route *r);

#endif
