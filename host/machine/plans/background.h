/* background.h - compiles kernels in a separate process while others run: one batch at a time.
 *
 *     if (background_on(m) && !background_busy(m)) {
 *         int number = background_want(m, &wish);    // and others
 *         background_begin(m);
 *     }
 *     ... the program goes on; now and then:
 *     switch (background_take(m)) {
 *     case BACKGROUND_LOADED: kernel = background_kernel(m, number); // and background_drop(m)
 *     case BACKGROUND_LOST: ...                                      // background_drop(m)
 *     case BACKGROUND_WAITS: ...
 *     }
 */
#ifndef LUTETIA_MACHINE_BACKGROUND_H
#define LUTETIA_MACHINE_BACKGROUND_H

#include <CL/cl.h>

#include "machine.h"

struct background_wish {
    const char *const *parts; /* DEVICE_PARTS; all but the last stay as they are */
    const char *options, *name;
    const char *arguments; /* as compiler.h has them */
    uint32_t dimensions;
    uint32_t group;  /* work-items of a work-group, along the first; 0: 1 */
    uint64_t widest; /* as there */
};

enum background_state {
    BACKGROUND_WAITS, /* waiting for the process, or for a kernel's turn to be loaded */
    BACKGROUND_LOADED,
    BACKGROUND_LOST /* the process failed, and no kernels will be compiled so from now on */
};

/* Decides whether better kernels are compiled beside the program; otherwise the program
 * waits for them. */
bool background_on(struct machine *m);
/* Whether a batch is under way. */
bool background_busy(const struct machine *m);
/* Adds a kernel to the next batch. Returns its number there; -1: no memory. */
int background_want(struct machine *m, const struct background_wish *wish);
/* Called before the machine itself compiles this kernel, for which better ones will be
 * wanted. If no cache has it, which takes long, the process is started meanwhile: PoCL reads
 * its library for most of a second before it compiles anything. */
void background_foresee(struct machine *m, const struct background_wish *wish);
/* Whether the driver has all kernels of the next batch, by what is known of it: nothing of the
 * batch has to be compiled. */
bool background_has_all(const struct machine *m);
/* False: no memory. */
bool background_begin(struct machine *m);
/* Returns the state of the batch; never waits. One kernel after the other is loaded, a large
 * one by a thread (loading.h). */
enum background_state background_take(struct machine *m);
/* A kernel of a batch that is loaded. */
struct device_kernel *background_kernel(const struct machine *m, int number);
/* Drops the batch. */
void background_drop(struct machine *m);
/* Waits until no thread of the machine's is in the driver. */
void background_rest(struct machine *m);
/* Called before the process ends: no thread is in the driver any more. */
void background_leave(struct machine *m);
/* Called when the machine is destroyed. */
void background_finish(struct machine *m);

#endif
