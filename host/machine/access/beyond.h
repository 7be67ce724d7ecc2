/* beyond.h - a lenient machine: what is past a field's end is what lies after it
 * (machine.h). */
#ifndef LUTETIA_MACHINE_BEYOND_H
#define LUTETIA_MACHINE_BEYOND_H

#include "memory/memory.h"

/* The field from whose end on these bits go on; NULL: they do not, or the machine is strict. */
struct field *beyond_field(const struct machine *m, uint32_t id, uint32_t bits);
/* The id of the bit that lies `at` bits after that one, and in *bits how many of so many from
 * there on are in the same field. MACHINE_NO_FIELD: it lies after the last field. */
uint32_t beyond_part(const struct machine *m, uint32_t id, uint32_t at, uint32_t *bits);

#endif
