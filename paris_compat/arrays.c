/* Transfers blocks of front-end arrays to and from blocks of processors.
 *
 * The array has block.rank dimensions and is row-major. Its element (offset + k), for each k
 * of the block, belongs to the processor whose coordinate on axis[j] is start[j] + k[j]; end
 * is exclusive; on axes that are not named the coordinate is 0. The context does not matter.
 */
#include <stdlib.h>
#include <string.h>

#include "paris_state.h"

struct element {
    size_t bytes;
    char letter;        /* u, s, f */
    unsigned int width; /* of the bits that count */
};

struct walk {
    unsigned int rank;
    uint64_t extent[MACHINE_AXES_MAX];
    uint64_t array_step[MACHINE_AXES_MAX], processor_step[MACHINE_AXES_MAX]; /* in elements */
    uint64_t array_first, processor_first;
    uint64_t count;
};

static bool format_element(unsigned int format, char letter, struct element *e)
{
    static const uint8_t bytes[] = {
        [CM_8_bit] = 1,        [CM_16_bit] = 2,       [CM_32_bit] = 4,
        [CM_float_single] = 4, [CM_float_double] = 8, [CM_64_bit] = 8};
    bool is_float = format == CM_float_single || format == CM_float_double;
    if (format < CM_8_bit || format > CM_64_bit) {
        paris_fail("format: must be CM_8_bit (1) .. CM_64_bit (6) (got %d)", (int)format);
        return false;
    }
    if (is_float != (letter == 'f')) {
        paris_fail(
            letter == 'f'
                ? "format: floats want CM_float_single or CM_float_double (got %u)"
                : "format: integers want CM_8_bit, CM_16_bit, CM_32_bit or CM_64_bit (got %u)",
            format);
        return false;
    }
    *e = (struct element){bytes[format], letter, 8u * bytes[format]};
    return true;
}

static bool axes_good(const struct paris_geometry *g, struct paris_block block)
{
    uint32_t seen = 0;
    for (unsigned int j = 0; j < block.rank; j++) {
        unsigned int axis = (unsigned int)block.axis[j];
        if (axis >= (unsigned int)g->rank || seen >> axis & 1) {
            paris_fail("axis_vector[%u]: must be 0..%d, and each axis once (got %d)", j,
                       g->rank - 1, block.axis[j]);
            return false;
        }
        seen |= 1u << axis;
    }
    return true;
}

static bool extent_good(const struct paris_geometry *g, struct paris_block block,
                        unsigned int j)
{
    int length = g->dimensions[block.axis[j]];
    if (block.start[j] < 0 || block.end[j] > length || block.start[j] > block.end[j]) {
        paris_fail(
            "start_vector[%u], end_vector[%u]: must be within 0..%d and in order (got %d, %d)",
            j, j, length, block.start[j], block.end[j]);
        return false;
    }
    int extent = block.end[j] - block.start[j];
    if (block.offset[j] < 0 || block.dimensions[j] < 0 ||
        block.offset[j] > block.dimensions[j] - extent) {
        paris_fail("offset_vector[%u]: %d and the block's %d elements reach out of the array's "
                   "dimension of %d",
                   j, block.offset[j], extent, block.dimensions[j]);
        return false;
    }
    return true;
}

static bool walk_make(const struct paris_geometry *g, struct paris_block block, struct walk *w)
{
    if (!block.offset || !block.start || !block.end || !block.axis || !block.dimensions) {
        paris_fail("one of the vectors is NULL");
        return false;
    }
    if (block.rank < 1 || block.rank > (unsigned int)g->rank) {
        paris_fail("rank: must be 1..%d in this VP set (got %d)", g->rank, (int)block.rank);
        return false;
    }
    uint64_t stride[MACHINE_AXES_MAX], step = 1;
    for (int axis = g->rank - 1; axis >= 0; axis--) {
        stride[axis] = step;
        step *= (uint64_t)g->dimensions[axis];
    }
    if (!axes_good(g, block))
        return false;
    *w = (struct walk){.rank = block.rank, .count = 1};
    step = block.pairs ? 2 : 1;
    w->array_first = block.second;
    for (unsigned int j = block.rank; j-- > 0;) {
        if (!extent_good(g, block, j))
            return false;
        w->extent[j] = (uint64_t)(block.end[j] - block.start[j]);
        w->array_step[j] = step;
        w->processor_step[j] = stride[block.axis[j]];
        w->array_first += step * (uint64_t)block.offset[j];
        w->processor_first += w->processor_step[j] * (uint64_t)block.start[j];
        w->count *= w->extent[j];
        step *= (uint64_t)block.dimensions[j];
    }
    return true;
}

/* ---- one element to another ---- */

static struct machine_scalar element_get(struct element e, const unsigned char *at)
{
    struct machine_scalar x = {0, 0};
    memcpy(&x, at, e.bytes); /* the host is little-endian, as OpenCL's devices are */
    if (e.letter == 's' && e.width < 128) {
        uint64_t *top = e.width > 64 ? &x.hi : &x.lo;
        unsigned int unused = 63 - (e.width - 1) % 64;
        *top = (uint64_t)((int64_t)(*top << unused) >> unused);
        if (e.width <= 64)
            x = scalar_signed((int64_t)x.lo);
    }
    return x;
}

static void element_put(struct element e, unsigned char *at, struct machine_scalar x)
{
    x = scalar_cut(x, (int)e.width);
    memcpy(at, &x, e.bytes);
}

static void float_copy(size_t to_bytes, unsigned char *to, size_t from_bytes,
                       const unsigned char *from)
{
    float single;
    double number;
    if (from_bytes == sizeof single) {
        memcpy(&single, from, sizeof single);
        number = single;
    } else {
        memcpy(&number, from, sizeof number);
    }
    if (to_bytes == sizeof single) {
        single = (float)number;
        memcpy(to, &single, sizeof single);
    } else {
        memcpy(to, &number, sizeof number);
    }
}

/* Whether both sides have the same bits; else they must be filled. Bits that a processor's
 * number does not use are 0, and what goes to processors is cut to its width by the machine. */
static bool elements_same(struct element to, struct element from)
{
    return to.bytes == from.bytes && (to.letter != 's' || to.width == from.width);
}

/* Copies `count` elements; steps in bytes. */
static void row_copy(struct element to, unsigned char *t, size_t to_step, struct element from,
                     const unsigned char *f, size_t from_step, uint64_t count)
{
    bool same = elements_same(to, from);
    if (same && to_step == to.bytes && from_step == from.bytes) {
        memcpy(t, f, count * to.bytes);
        return;
    }
    for (uint64_t i = 0; i < count; i++, t += to_step, f += from_step) {
        if (same)
            memcpy(t, f, to.bytes);
        else if (to.letter == 'f')
            float_copy(to.bytes, t, from.bytes, f);
        else
            element_put(to, t, element_get(from, f));
    }
}

/* to_array: from processors into the array. */
static void block_copy(const struct walk *w, struct element array_element, unsigned char *array,
                       struct element processor_element, unsigned char *processors,
                       bool to_array)
{
    uint64_t at[MACHINE_AXES_MAX] = {0};
    unsigned int last = w->rank - 1;
    uint64_t a = w->array_first, p = w->processor_first;
    if (w->count == 0)
        return;
    for (;;) {
        unsigned char *x = array + a * array_element.bytes,
                      *y = processors + p * processor_element.bytes;
        size_t x_step = w->array_step[last] * array_element.bytes;
        size_t y_step = w->processor_step[last] * processor_element.bytes;
        if (to_array)
            row_copy(array_element, x, x_step, processor_element, y, y_step, w->extent[last]);
        else
            row_copy(processor_element, y, y_step, array_element, x, x_step, w->extent[last]);
        unsigned int j = last;
        while (j > 0) {
            j--;
            a += w->array_step[j];
            p += w->processor_step[j];
            if (++at[j] < w->extent[j])
                break;
            a -= w->array_step[j] * w->extent[j];
            p -= w->processor_step[j] * w->extent[j];
            at[j] = 0;
            if (j == 0)
                return;
        }
        if (last == 0)
            return;
    }
}

/* ---- the instructions ---- */

struct transfer {
    struct machine *m;
    struct machine_type type;
    struct element array, processor;
    struct walk walk;
    uint64_t processors_count;
    bool direct; /* the block is all processors in their order, element by element */
    bool rows;   /* it is a part of them, rows of the last axis in their order */
    unsigned char *processors;
};

static bool is_direct(const struct transfer *t)
{
    const struct walk *w = &t->walk;
    bool same = w->count == t->processors_count && elements_same(t->processor, t->array);
    uint64_t step = 1;
    for (unsigned int j = w->rank; same && j-- > 0; step *= w->extent[j])
        same = w->array_step[j] == step && w->processor_step[j] == step;
    return same;
}

static bool is_rows(const struct transfer *t, const struct paris_geometry *g,
                    struct paris_block block)
{
    const struct walk *w = &t->walk;
    return elements_same(t->processor, t->array) && g->rank == 2 && w->rank == 2 &&
           block.axis[0] == 0 && w->array_step[1] == 1;
}

static struct machine_block block_rows(const struct walk *w)
{
    const uint64_t width = w->processor_step[0];
    return (struct machine_block){w->processor_first / width, w->extent[0],
                                  (int)(w->processor_first % width), (int)w->extent[1]};
}

/* Checks all and allocates, unless it is direct, the dense array of the processors'
 * elements. */
static bool transfer_begin(struct transfer *t, const struct paris_instruction *self,
                           const void *array, struct paris_block block,
                           struct paris_operand field, const char *role)
{
    t->m = paris_begin(self->name);
    const struct paris_geometry *g = paris_geometry_current();
    if (!paris_type(field, role, &t->type) || !paris_check_operand(field, role) ||
        !format_element(block.format, field.letter, &t->array) ||
        !walk_make(g, block, &t->walk))
        return false;
    struct machine_field_info info;
    if (machine_field_lookup(t->m, field.field, &info) && info.vpset != CM_current_vp_set) {
        paris_fail(
            "%s: the field belongs to VP set %d, but %d is current: call CM_set_vp_set first",
            role, info.vpset, CM_current_vp_set);
        return false;
    }
    if (!array && t->walk.count) {
        paris_fail("array: is NULL");
        return false;
    }
    t->processor =
        (struct element){machine_element_bytes(t->type), field.letter, t->type.width};
    t->processors_count = g->count;
    t->processors = NULL;
    t->direct = is_direct(t);
    t->rows = !t->direct && is_rows(t, g, block);
    if (t->direct || t->rows)
        return true;
    t->processors = malloc(g->count * t->processor.bytes);
    if (!t->processors)
        paris_fail_memory("not enough memory for an array of %llu elements",
                          (unsigned long long)g->count);
    return t->processors != NULL;
}

void paris_array_write(const struct paris_instruction *self, const void *array,
                       struct paris_block block, struct paris_operand dest)
{
    struct transfer t;
    if (!transfer_begin(&t, self, array, block, dest, "dest"))
        return;
    bool all = t.walk.count == t.processors_count;
    union {
        const void *in;
        unsigned char *bytes; /* block_copy() only reads it */
    } source = {.in = array};
    if (t.direct) {
        if (machine_field_upload(t.m, dest.field, t.type,
                                 source.bytes + t.walk.array_first * t.array.bytes) !=
            MACHINE_OK)
            paris_fail_machine();
    } else if (t.rows) {
        const struct machine_block of = block_rows(&t.walk);
        if (t.walk.count &&
            machine_block_upload(t.m, dest.field, t.type, &of,
                                 source.bytes + t.walk.array_first * t.array.bytes,
                                 t.walk.array_step[0] * t.array.bytes) != MACHINE_OK)
            paris_fail_machine();
    } else if (!all &&
               machine_field_download(t.m, dest.field, t.type, t.processors) != MACHINE_OK) {
        paris_fail_machine();
    } else if (t.walk.count) {
        block_copy(&t.walk, t.array, source.bytes, t.processor, t.processors, false);
        if (machine_field_upload(t.m, dest.field, t.type, t.processors) != MACHINE_OK)
            paris_fail_machine();
    }
    free(t.processors);
}

void paris_array_read(const struct paris_instruction *self, void *array,
                      struct paris_block block, struct paris_operand source)
{
    struct transfer t;
    if (!transfer_begin(&t, self, array, block, source, "source"))
        return;
    if (t.rows) {
        const struct machine_block of = block_rows(&t.walk);
        if (t.walk.count &&
            machine_block_download(t.m, source.field, t.type, &of,
                                   (unsigned char *)array + t.walk.array_first * t.array.bytes,
                                   t.walk.array_step[0] * t.array.bytes) != MACHINE_OK)
            paris_fail_machine();
        return;
    }
    unsigned char *to =
        t.direct ? (unsigned char *)array + t.walk.array_first * t.array.bytes : t.processors;
    if (machine_field_download(t.m, source.field, t.type, to) != MACHINE_OK)
        paris_fail_machine();
    else if (!t.direct)
        block_copy(&t.walk, t.array, array, t.processor, t.processors, true);
    free(t.processors);
}
