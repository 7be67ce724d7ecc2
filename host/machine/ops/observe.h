/* observe.h - what the front end's reading and writing of fields, and of blocks of them,
 * share. */
#ifndef LUTETIA_MACHINE_OBSERVE_H
#define LUTETIA_MACHINE_OBSERVE_H

#include "memory/memory.h"

/* The field that these bits are in, and where; noted calls are performed first. NULL: error
 * set. */
struct field *observe_field(struct machine *m, uint32_t id, struct machine_type type,
                            uint32_t *offset);
/* v, which is in memory and the content of these bits, or a copy of it: its buffer may be
 * written over, since only this part of the field refers to it. NULL: error set. */
struct machine_value *observe_own(struct machine *m, const struct field *f, uint32_t offset,
                                  struct machine_value *v);
/* The value in all processors of the set, as machine_field_download() has it; what: of an
 * error's message. */
enum machine_status observe_out(struct machine *m, int set, struct machine_value *v, void *out,
                                const char *what);
/* Bits beyond the type's width become 0. */
void observe_mask(unsigned char *data, uint64_t count, struct machine_type type);

#endif
