/* machine_direct.h - the short way for an instruction on two whole fields.
 *
 *     struct machine_direct d = {.op = MACHINE_ADD, .type = MACHINE_UINT (32), .dest = sum, .a = x, .b = y, .overflow = true};
 *     if (!machine_direct (m, &d))
 *         ...                              the usual way, call by call
 */
#ifndef LUTETIA_MACHINE_DIRECT_H
#define LUTETIA_MACHINE_DIRECT_H

#include "machine.h"

/* dest = a op b as by machine_field_value(), machine_binary() and machine_field_store(), where
 * all processors are active and operations on a set so small are computed as they are
 * called. */
struct machine_direct {
    enum machine_op op; /* of two operands of that type */
    struct machine_type type;
    uint32_t dest; /* MACHINE_NO_FIELD: the test flag, for a comparison */
    uint32_t a, b; /* b MACHINE_NO_FIELD: the number */
    struct machine_scalar number;
    bool overflow, is_signed; /* the overflow is recorded: see machine_overflow_record() */
};
/* False: it cannot be done so, and nothing has changed. Errors: none. */
bool machine_direct(struct machine *m, const struct machine_direct *d);

#endif
