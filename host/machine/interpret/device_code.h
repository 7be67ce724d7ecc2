/* device_code.h - byte code for a device with memory of its own: kernels/interpret.cl performs
 * it, a work-item for each processor.
 *
 *     struct device_code *c = device_code_make(m, &kernels, program, set);     NULL: those
 *                                                                              kernels cannot
 *                                                                              perform it
 *     status = device_code_run(m, c, set, buffers, nodes);
 *
 * There are two kernels: the second has the transcendental functions, too. Each is built when
 * it is first asked for. */
#ifndef LUTETIA_MACHINE_DEVICE_CODE_H
#define LUTETIA_MACHINE_DEVICE_CODE_H

#include "interpret/byte_code.h"

struct device_code;
struct device_kernel;

/* The kernels, which stay in memory. All zero: none has been asked for. */
struct device_kernels {
    struct {
        struct device_kernel *kernel; /* held; NULL: it is not built, or cannot be */
        bool asked;
    } of[2];
};
struct machine_value;

/* NULL: the program takes more arrays, numbers or registers than the kernel has, or the kernel
 * cannot be built. */
struct device_code *device_code_make(struct machine *m, struct device_kernels *kernels,
                                     const struct byte_code *p, const struct vpset *set);
/* buffers: of each node that is an array. nodes: those that are numbers. Does not wait. */
enum machine_status device_code_run(struct machine *m, const struct device_code *c,
                                    const struct vpset *set,
                                    struct device_buffer *const *buffers,
                                    struct machine_value *const *nodes);
/* How long a run takes, about. */
double device_code_time_s(const struct machine *m, const struct device_code *c,
                          const struct vpset *set);
/* For those who watch. */
const struct device_kernel *device_code_kernel(const struct device_code *c);
void device_code_free(struct machine *m, struct device_code *c);

#endif
