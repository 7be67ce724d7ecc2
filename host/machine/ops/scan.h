/* scan.h - lines of elements along an axis. */
#ifndef LUTETIA_MACHINE_SCAN_H
#define LUTETIA_MACHINE_SCAN_H

#include "device/call.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"

/* Lines of elements in a buffer: see kernels/scan.cl. */
struct lines {
    cl_ulong base;
    cl_long step;
    cl_ulong inner_stride, outer_stride;
    size_t inner, outer; /* rows of lines */
    cl_int length, columns, width, halo, along;
};

/* As in kernels/scan.cl. */
enum lines_op { LINES_COPY, LINES_ADD, LINES_MULTIPLY, LINES_MIN, LINES_OR, LINES_XOR };

/* What lines consist of: kind 0 integers of up to 64 bits, 1 floats, 2 pairs of 64 bits. */
struct element {
    const char *name, *mask;
    int kind;
    size_t bytes;
};

/* Which of the elements below. */
enum { LINES_UINT32, LINES_UINT64, LINES_UINT128, LINES_FLOAT32, LINES_FLOAT64 };
extern const struct element lines_elements[];

struct line_scan {
    const struct element *element;
    enum lines_op op;
    bool exclusive;
    bool streams;          /* results are stored past the caches */
    bool starts, backward; /* segments begin in active processors only; after a 1, not at it */
    struct machine_scalar identity, flip, cut;
    const struct device_buffer *in, *context, *bits; /* NULL: no context, all processors are
                                                      * active; no segments */
    struct device_buffer *out, *sums;                /* sums NULL: not needed */
};

/* Where lines that are filled take their element from. */
struct origin {
    cl_ulong base, inner, outer;
};

struct lines lines_of(const struct vpset *s, int axis, bool downward);

static inline size_t lines_count(const struct lines *l)
{
    return l->outer * l->inner * (size_t)l->columns;
}

/* Scans lines of an array, and fills each line with an element of `from`. */
enum machine_status lines_scan(struct machine *m, const struct lines *l,
                               const struct line_scan *j);
enum machine_status lines_fill(struct machine *m, const struct lines *l,
                               const struct element *e, struct device_buffer *from,
                               struct origin origin, struct device_buffer *out);
/* Work of lines, which other ranks know, too. `of` begins with the address of an element, but
 * for ranks. */
enum lines_kind { LINES_SCANS, LINES_SPREADS, LINES_FILLS, LINES_RANKS };
struct lines_job {
    enum lines_kind kind;
    sequencers_work *work;
    const void *of;
    uint32_t bytes;
};
/* Work on arrays in one piece, or in blocks, where some of the values' arrays are; `across`: it
 * looks along the first axis of the current set. NULL: error set. */
struct device_buffer *lines_worked(struct machine *m, struct machine_type type,
                                   struct machine_value *const *values, int count, bool across,
                                   const struct lines_job *job);
/* The same job on a rank that was told of it. NULL: it is none of these, or an error is set. */
struct device_buffer *scan_told(struct machine *m, const struct vpset *s,
                                struct device_buffer *const *in, enum lines_kind kind,
                                const void *bytes, size_t count);
struct device_buffer *rank_told(struct machine *m, const struct vpset *s,
                                struct device_buffer *const *in, const void *bytes,
                                size_t count);
/* Puts an element's number in the place of its address, and the other way round. False: there
 * is none of that number. */
void lines_element_out(void *bytes);
bool lines_element_in(void *bytes);
/* A scan of the only line of the current set, in blocks: of elements, the context and bits,
 * some of whose arrays are in blocks. lines_can_chain(): whether it can be done so. NULL: error
 * set. */
bool lines_can_chain(struct machine *m, const struct line_scan *j, bool downward);
struct device_buffer *lines_chain(struct machine *m, struct machine_type type,
                                  const struct line_scan *j, bool downward,
                                  struct machine_value *const in[3]);
/* Replaces each 32-bit number of dense lines by the sum of those before it. */
enum machine_status lines_sum_up(struct machine *m, struct device_buffer *b, size_t lines,
                                 size_t length);
/* machine_scan() in another context. */
struct machine_value *scan_where(struct machine *m, const struct machine_scan *how,
                                 struct machine_value *value, struct machine_value *context);
/* Where segments begin when lines are scanned in that direction; NULL: only at the ends. */
struct machine_value *scan_boundaries(struct machine *m, const struct machine_scan *how);
/* false: error set. */
bool scan_arguments_good(struct machine *m, const struct vpset *s, int axis,
                         const struct machine_value *value, const struct machine_value *bits);
/* Returns the value, or one that has the same bits in memory, so that these are stored once. */
static inline struct machine_value *in_memory(struct machine *m, struct machine_value *v)
{
    return v->op == NODE_REINTERPRET && !v->buffer ? graph_borrow(m, v->in[0]) : v;
}
/* Bits that sort like the floats; NaNs become `nan`. */
struct machine_value *float_order(struct machine *m, struct machine_value *v, uint64_t nan);

/* Passes lines of elements, in runs or chunks: kernels/scan.cl, kernels/sort.cl. */
static inline void call_lines(struct kernel_call *c, const struct lines *l, int run)
{
    call_ulong(c, l->base);
    call_ulong(c, (uint64_t)l->step);
    call_ulong(c, l->inner_stride);
    call_ulong(c, l->outer_stride);
    call_int(c, l->length);
    call_int(c, run);
    call_int(c, l->columns);
}

/* Passes how lines lie in rows. */
static inline void call_lines_rows(struct kernel_call *c, const struct lines *l)
{
    call_int(c, l->width);
    call_int(c, l->halo);
    call_int(c, l->along);
}

#endif
