/* call_set.h - passing a VP set to a hand-written kernel: see call.h. */
#ifndef LUTETIA_MACHINE_CALL_SET_H
#define LUTETIA_MACHINE_CALL_SET_H

#include "device/call.h"
#include "values/values.h"

/* Passes how rows lie in a buffer: width, pitch, halo. */
static inline void call_layout(struct kernel_call *c, const struct vpset *s)
{
    call_uint(c, (uint64_t)s->width);
    call_uint(c, s->pitch);
    call_uint(c, (uint64_t)s->halo);
}

/* Passes where processors live: count, ratio, logarithm of the number of processors, which
 * layout, and for subgrids the index that each bit of an address stands for. */
static inline void call_order(struct kernel_call *c, const struct machine *m,
                              const struct vpset *s)
{
    cl_uint bits[32] = {0};
    call_uint(c, s->count);
    call_uint(c, s->ratio);
    call_uint(c, (uint64_t)m->values->processors_log2);
    call_uint(c, s->layout.blocks ? 2 : s->layout.order == MACHINE_SEND_ORDER);
    for (int i = 0; s->layout.blocks && UINT64_C(1) << i < s->count; i++)
        bits[i] = (cl_uint)machine_layout_index(&s->layout, UINT64_C(1) << i);
    call_argument(c, 16 * sizeof *bits, bits);
    call_argument(c, 16 * sizeof *bits, bits + 16);
}

static inline void call_set(struct kernel_call *c, const struct machine *m,
                            const struct vpset *s)
{
    call_order(c, m, s);
    call_layout(c, s);
}

/* Starts a work-item for each run of columns of each row. */
static inline enum machine_status call_over(struct kernel_call *c, struct machine *m,
                                            const struct vpset *s, const char *what)
{
    size_t run = call_run(m);
    return call_start(c, m, ((size_t)s->width + run - 1) / run, (size_t)s->rows, what);
}

/* Starts a work-item for each run of physical processors, times y. */
static inline enum machine_status call_processors(struct kernel_call *c, struct machine *m,
                                                  size_t y, const char *what)
{
    size_t run = call_processors_run(m), p = (size_t)m->values->processors_count;
    return call_start(c, m, (p + run - 1) / run, y, what);
}

#endif
