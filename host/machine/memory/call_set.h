/* call_set.h - a VP set among the arguments of a kernel that is written by hand: see call.h. */
#ifndef LUTETIA_MACHINE_CALL_SET_H
#define LUTETIA_MACHINE_CALL_SET_H

#include "device/call.h"
#include "values/values.h"

/* How rows lie in a buffer: width, pitch, halo. */
static inline void call_layout(struct kernel_call *c, const struct vpset *s)
{
    call_uint(c, (uint64_t)s->width);
    call_uint(c, s->pitch);
    call_uint(c, (uint64_t)s->halo);
}

/* Which row-major index an address is: count, ratio, logarithm of the processors, order. */
static inline void call_order(struct kernel_call *c, const struct machine *m,
                              const struct vpset *s)
{
    call_uint(c, s->count);
    call_uint(c, s->ratio);
    call_uint(c, (uint64_t)m->values->processors_log2);
    call_uint(c, s->order == MACHINE_SEND_ORDER);
}

static inline void call_set(struct kernel_call *c, const struct machine *m,
                            const struct vpset *s)
{
    call_order(c, m, s);
    call_layout(c, s);
}

/* A work-item for each run of columns of each row. */
static inline enum machine_status call_over(struct kernel_call *c, struct machine *m,
                                            const struct vpset *s, const char *what)
{
    size_t run = call_run(m);
    return call_start(c, m, ((size_t)s->width + run - 1) / run, (size_t)s->rows, what);
}

/* A work-item for each run of physical processors, times y. */
static inline enum machine_status call_processors(struct kernel_call *c, struct machine *m,
                                                  size_t y, const char *what)
{
    size_t run = call_processors_run(m), p = (size_t)m->values->processors_count;
    return call_start(c, m, (p + run - 1) / run, y, what);
}

#endif
