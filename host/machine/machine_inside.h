/* machine_inside.h - what a machine has in it, for debuggers.
 *
 *     struct machine_waiting waiting = machine_waiting (m);
 *     printf ("%llu values wait\n", (unsigned long long)waiting.values);
 *
 * Errors: as machine.h. Threads: as machine.h, but machine_busy() may be asked by any. */
#ifndef LUTETIA_MACHINE_INSIDE_H
#define LUTETIA_MACHINE_INSIDE_H

#include "machine.h"

#include <sys/types.h>

/* NULL: the machine can be asked. Else why it cannot be: it belongs to another thread, or is in
 * the midst of an evaluation. */
const char *machine_busy(const struct machine *m);

/* Whether a child after fork() has the machine, with all that waits: see machine.h. If not,
 * asking the machine is a look as of any program. */
bool machine_forks(const struct machine *m);

/* fork() that waits for no lock of the C library, of a process that has crashed while it may
 * hold one. Where it does hold malloc's, the child waits for ever. */
pid_t machine_fork_bare(void);

/* What is recorded and not computed: values, and calls that were foreseen and only counted. */
struct machine_waiting {
    uint64_t values, calls;
};
struct machine_waiting machine_waiting(const struct machine *m);

/* How these bits of a field were stored: as a float of 32 or 64 bits, or as bits. The bits lie
 * in the field. */
struct machine_type machine_field_stored(struct machine *m, uint32_t field, uint32_t bits);

/* With LUTETIA_BLOCKS: plans, and whole instructions, run in blocks; arrays put into blocks,
 * and together again; arrays whose ghosts were fetched. */
struct machine_blocks {
    uint64_t run, divided, gathered, fetched;
    int sequencers; /* machines that they have: one for each, or one for all */
};
struct machine_blocks machine_blocks(const struct machine *m);

/* The fields in the order of their ids: the i-th one. False: there are not so many. */
bool machine_field_at(const struct machine *m, int i, struct machine_field_info *out);

/* Whether something that is stored in the whole field waits to be computed. */
bool machine_field_waits(const struct machine *m, uint32_t field);

/* A flag of a VP set: one byte, 0 or 1, for each processor, in row-major order. */
enum machine_status machine_flag_download(struct machine *m, int vpset, enum machine_flag flag,
                                          uint8_t *out);

#endif
