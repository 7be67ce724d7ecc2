/* sums.h - sums of what the hooks report, for machine_explain(). */
#ifndef LUTETIA_MACHINE_SUMS_H
#define LUTETIA_MACHINE_SUMS_H

#include "base/node_ops.h"
#include "watch/watch.h"

struct kernel_note {
    struct kernel_note *next;
    uint64_t kernel; /* device_kernel.id; 0: not of one kernel */
    struct machine_explained_kernel facts;
    char *name; /* owned by the note, as are the strings in its list of stores */
};

enum { CALL_NAMES_SIZE = 4096, CALL_NAMES_MOST = CALL_NAMES_SIZE / 2 };

struct watch_sums {
    struct machine_explained facts;
    struct kernel_note *notes;
    struct machine_explained_row calls[CALL_NAMES_MOST];
    int16_t calls_hashed[CALL_NAMES_SIZE]; /* + 1 */
    uint64_t vanished[NODE_OP_COUNT];
    uint64_t overwritten;                     /* values overwritten before they were in
                                               * memory */
    uint64_t evaluations[WATCH_ASKED_TO + 1]; /* by enum watch_why */
    struct machine_explained_row phases[WATCH_PHASES_COUNT];
    struct machine_explained_kernel *kernels; /* as last told */
    struct machine_explained_family *families;
    cl_kernel copies[2]; /* see copies.c; NULL: none */
    void (*between)(void);
};

struct watch_sums *sums_create(void); /* NULL: not enough memory */

void sums_destroy(struct watch_sums *e);
/* Counts a recorded call, or that many foreseen ones. */
void sums_call(struct watch_sums *e, const char *name, int foreseen, double time_s);
/* Returns the kernel's note, and makes it if there is none: its name, whether hand-written,
 * and its VP set (0: none). */
struct kernel_note *sums_note(struct watch_sums *e, uint64_t kernel, const char *name,
                              int vpset, uint64_t processors);

#endif
