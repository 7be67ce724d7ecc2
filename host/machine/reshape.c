/* reshape.c - aliases: the same memory seen from another VP set.
 *
 * A field of L bits in a set of VP ratio R is R * L bits of each physical processor, one VP's after
 * the other. An alias is a field of its own, with slots of its own, that says which of these bits are
 * its VPs' (struct view). The field that owns the memory is its root. Of a root and its aliases the one
 * stored into last is right; whoever else is touched next takes the content over, as a whole:
 *
 *     newest alias -> root -> the one touched
 *
 * The usual alias is finer or coarser by a whole factor k, and what goes over are whole values:
 *
 *     coarse (p, j)    | slice 0 | slice 1 | ... | slice k-1 |      p: physical processor
 *     fine         (p, j*k) (p, j*k+1)   ...    (p, j*k+k-1)
 *
 * From fine to coarse a value becomes k slices of it, which are nodes without a buffer: moved about
 * they cost nothing, and one that is looked at is unpacked together with those beside it (kernel
 * `slices`, 16 at a time: one cache line of the fine array). From coarse to fine k values are woven
 * into one (`weave`); but k slices of one value in their order are that value again, and k equal
 * expressions of slices are that expression of the whole values (lift): a program that goes through
 * its elements in a loop has its loop rolled up here. Bits stored as words of many elements are taken
 * apart in the kernel.
 *
 * All other shapes go through an image of the memory, bit by bit (`put`, `get`).
 *
 * Virtual processors that do not exist (of a set whose size is no multiple of P) have no memory: the
 * bits where they would be read as 0, and storing through another alias does not keep them. */
#include "internal.h"

#include <stdlib.h>
#include <string.h>

#include "call.h"
#include "kernels.h"

enum { BLOCK = 16, PROCESSORS_RUN = 512, LIFT_NODES = 1 << 18, PIECES_MANY = 8 };

static void call_set(struct kernel_call *c, const struct machine *m, const struct vpset *s)
{
    call_order(c, m, s);
    call_layout(c, s);
}

/* A work-item for so many physical processors, times y. */
static enum machine_status call_processors(struct kernel_call *c, struct machine *m, size_t y)
{
    size_t run = m->device.is_cpu ? PROCESSORS_RUN : 1, p = (size_t)m->processors_count;
    return call_start(c, m, (p + run - 1) / run, y, "reshaping");
}

static uint64_t processors_run(const struct machine *m)
{
    return m->device.is_cpu ? PROCESSORS_RUN : 1;
}

/* ---- slices ---- */

bool reshape_unpack(struct machine *m, struct machine_value *slice)
{
    struct machine_value *fine = slice->in[0], *out[BLOCK] = {NULL};
    const struct vpset *f = &m->sets[fine->set], *s = &m->sets[slice->set];
    uint32_t k = (uint32_t)slice->imm.lo, wanted = 0;
    int first = slice->detail / BLOCK * BLOCK, count = (int)k - first;
    struct machine_value key = *slice;
    struct device_buffer *b[BLOCK] = {NULL}, *any = NULL;
    size_t bytes = observe_buffer_bytes(s, slice->type);
    count = count < BLOCK ? count : BLOCK;
    for (int i = 0; i < count; i++) {
        key.detail = first + i;
        out[i] = first + i == slice->detail ? slice : graph_find(m, &key);
        if (!out[i] || out[i]->buffer)
            continue;
        b[i] = device_buffer_get(m, bytes);
        if (!b[i]) {
            for (; i >= 0; i--)
                if (b[i])
                    device_buffer_unref(m, b[i]);
            return false;
        }
        any = b[i];
        wanted |= 1u << i;
    }
    char options[64];
    snprintf(options, sizeof options, "-DELEMENT=%s%s", call_element(type_bytes(slice->type)),
             type_bytes(slice->type) == 16 ? " -DPAIR" : "");
    struct kernel_call c = call_begin(m, kernel_reshape_cl, options, "slices");
    call_set(&c, m, f);
    call_set(&c, m, s);
    call_uint(&c, processors_run(m));
    call_uint(&c, k);
    call_uint(&c, (uint64_t)first);
    call_uint(&c, (uint64_t)count);
    call_uint(&c, wanted);
    call_buffer(&c, fine->buffer);
    for (int i = 0; i < BLOCK; i++)
        call_buffer(&c, b[i] ? b[i] : any);
    enum machine_status status = call_processors(&c, m, (size_t)s->ratio);
    for (int i = 0; i < BLOCK; i++)
        if (b[i] && status)
            device_buffer_unref(m, b[i]);
        else if (b[i])
            graph_materialised(m, out[i], b[i]);
    return status == MACHINE_OK;
}

/* Value i of the k that fine (in memory) is cut into, in the VP set. */
static struct machine_value *slice_of(struct machine *m, struct machine_value *fine, int set,
                                      uint32_t k, uint32_t i)
{
    if (fine->op == NODE_CONSTANT || (k == 1 && fine->set == set))
        return fine;
    m->sliced = true;
    struct machine_value key = {.op = NODE_SLICE,
                                .type = fine->type,
                                .set = (uint16_t)set,
                                .detail = (int32_t)i,
                                .imm = {k, 0},
                                .in = {fine, NULL, NULL}};
    return graph_node(m, &key);
}

bool reshape_forget_set(struct machine *m, int set)
{
    for (uint32_t i = 0; i < m->table_size; i++)
        for (struct machine_value *v = m->table[i]; v; v = v->next)
            if (v->op == NODE_SLICE && !v->buffer && (v->set == set || v->in[0]->set == set) &&
                !reshape_unpack(m, v))
                return false;
    for (uint32_t i = 0; i < m->table_size; i++)
        for (struct machine_value *v = m->table[i], *next; v; v = next) {
            next = v->next;
            if ((v->op == NODE_SLICE && (v->set == set || v->in[0]->set == set)) ||
                (v->buffer && v->set == set)) {
                graph_forget(m, v);
                next = m->table[i]; /* its input may have gone with it */
            }
        }
    return true;
}

struct machine_value *reshape_lay_out(struct machine *m, struct machine_value *v, int set,
                                      const struct vpset *to)
{
    v = observe_materialise(m, set, v);
    struct device_buffer *b =
        v ? device_buffer_get(m, observe_buffer_bytes(to, v->type)) : NULL;
    if (!b)
        return NULL;
    size_t bytes = type_bytes(v->type);
    char options[64];
    snprintf(options, sizeof options, "-DELEMENT=%s%s", call_element(bytes),
             bytes == 16 ? " -DPAIR" : "");
    struct kernel_call c = call_begin(m, kernel_reshape_cl, options, "slices");
    call_set(&c, m, &m->sets[set]);
    call_set(&c, m, to);
    call_uint(&c, processors_run(m));
    call_uint(&c, 1); /* one slice, all of it */
    call_uint(&c, 0);
    call_uint(&c, 1);
    call_uint(&c, 1);
    call_buffer(&c, v->buffer);
    for (int i = 0; i < BLOCK; i++)
        call_buffer(&c, b);
    enum machine_status status = call_processors(&c, m, (size_t)to->ratio);
    if (!status)
        return graph_buffer_node(m, v->type, set, b);
    device_buffer_unref(m, b);
    return NULL;
}

/* ---- rolling up ---- */

/* Does to each processor's number alone what it does. */
static bool is_elementwise(const struct machine_value *v)
{
    return v->op < MACHINE_OP_COUNT_PUBLIC || v->op == NODE_SELECT ||
           (v->op >= NODE_ZERO_EXTEND && v->op <= NODE_OVERFLOW_FDIV);
}

/* The one value of the finer set whose k slices these are; NULL: there is none to be had for
 * nothing. */
static struct machine_value *lift(struct machine *m, struct machine_value *const *y, uint32_t k,
                                  int set, int *budget)
{
    const struct machine_value *a = y[0];
    if ((*budget -= (int)k) < 0)
        return NULL;
    if (k == 1 && a->set == set)
        return y[0];
    if (a->op == NODE_CONSTANT) {
        for (uint32_t i = 1; i < k; i++)
            if (y[i] != a)
                return NULL;
        return y[0];
    }
    if (a->op == NODE_SLICE) {
        if (a->in[0]->set != set || a->imm.lo != k)
            return NULL;
        for (uint32_t i = 0; i < k; i++)
            if (y[i]->op != NODE_SLICE || y[i]->in[0] != a->in[0] || y[i]->imm.lo != k ||
                y[i]->detail != (int32_t)i)
                return NULL;
        return a->in[0];
    }
    if (a->buffer || !is_elementwise(a))
        return NULL;
    for (uint32_t i = 1; i < k; i++)
        if (y[i]->op != a->op || y[i]->buffer || !type_equal(y[i]->type, a->type) ||
            y[i]->detail != a->detail || y[i]->axis != a->axis || y[i]->imm.lo != a->imm.lo ||
            y[i]->imm.hi != a->imm.hi)
            return NULL;
    struct machine_value key = {.op = a->op,
                                .type = a->type,
                                .axis = a->axis,
                                .set = (uint16_t)set,
                                .detail = a->detail,
                                .imm = a->imm};
    struct machine_value **in = malloc(k * sizeof *in);
    bool good = in != NULL;
    for (int n = 0; n < node_ops[a->op].inputs && good; n++) {
        for (uint32_t i = 0; i < k; i++)
            in[i] = y[i]->in[n];
        key.in[n] = lift(m, in, k, set, budget);
        good = key.in[n] != NULL;
    }
    free(in);
    return good ? graph_node(m, &key) : NULL;
}

/* What k equal expressions have been rolled up into is computed, alone, and each of them is from now on a
 * slice of it: whoever else holds them need not compute them one by one. */
static bool unroll(struct machine *m, struct machine_value *whole,
                   struct machine_value *const *y, uint32_t k)
{
    if (node_is_leaf(whole) || node_is_cheap(whole) || whole == y[0])
        return true;
    uint64_t evaluated = m->stores_evaluated;
    m->stores_evaluated = m->stores; /* nobody else is looked at */
    enum machine_status status = run_evaluate(m, &whole, 1, false);
    m->stores_evaluated = evaluated;
    for (uint32_t i = 0; i < k && !status; i++) {
        struct machine_value key = {.op = NODE_SLICE,
                                    .type = y[i]->type,
                                    .set = y[i]->set,
                                    .detail = (int32_t)i,
                                    .imm = {k, 0},
                                    .in = {whole, NULL, NULL}};
        if (!y[i]->buffer && y[i]->op != NODE_SLICE && y[i]->interned)
            graph_become(m, y[i], &key);
    }
    return status == MACHINE_OK;
}

/* ---- rolling up what waits ---- */

static bool waits(const struct machine_value *v)
{
    return !node_is_leaf(v) && v->op != NODE_SLICE && !node_is_cheap(v);
}

/* A first slice somewhere in v; NULL: none is found. */
static const struct machine_value *first_slice(const struct machine_value *v, int *budget)
{
    if (v->op == NODE_SLICE)
        return v->detail == 0 ? v : NULL;
    if (v->buffer || --*budget < 0)
        return NULL;
    for (int n = 0; n < node_ops[v->op].inputs; n++) {
        const struct machine_value *found = first_slice(v->in[n], budget);
        if (found)
            return found;
    }
    return NULL;
}

static bool same_shape(const struct machine_value *a, const struct machine_value *b)
{
    return a->op == b->op && type_equal(a->type, b->type) && a->detail == b->detail &&
           a->height == b->height;
}

/* k slots that a loop has gone through, or is going through: then those before the place where it is hold
 * what the others do as an operand. *partial: it has only begun. False: error set. */
static bool roll_slots(struct machine *m, const struct slot *slots, uint32_t k, int set,
                       bool *partial)
{
    struct machine_value **y = malloc(k * sizeof *y), *whole = NULL;
    const struct machine_value *last = slots[k - 1].value;
    uint32_t cut = 0;
    bool good = y != NULL;
    if (!good)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    while (cut < k - 1 && !same_shape(slots[cut].value, last))
        cut++;
    *partial = *partial || cut >= BLOCK;
    for (int n = 0; good && waits(last) && n < (cut ? 3 : 1) && !whole; n++) {
        int budget = LIFT_NODES;
        bool there = true;
        for (uint32_t i = 0; i < k && there; i++) {
            y[i] = i < cut ? slots[i].value->in[n] : slots[i].value;
            there = y[i] && type_equal(y[i]->type, last->type);
        }
        whole = there ? lift(m, y, k, set, &budget) : NULL;
        good = !whole || unroll(m, whole, y, k);
    }
    free(y);
    return good;
}

bool reshape_roll(struct machine *m, bool *partial)
{
    *partial = false;
    if (!m->sliced || m->rolling)
        return true;
    m->rolling = true;
    bool good = true;
    for (int i = 0; i < m->fields_count && good; i++) {
        const struct field *f = m->fields[i];
        uint32_t k;
        for (int at = 0; at < f->slots_count && good; at += (int)k) {
            const struct slot *slots = &f->slots[at];
            int budget = 64;
            const struct machine_value *slice =
                waits(slots[0].value) ? first_slice(slots[0].value, &budget) : NULL;
            k = slice ? (uint32_t)slice->imm.lo : 1;
            uint32_t there = (uint32_t)(f->slots_count - at);
            if (k < 2 || k > there) { /* a loop that fills a new field has not come far */
                *partial = *partial || (k > there && there >= BLOCK);
                k = k > there ? there : 1;
                continue;
            }
            bool even = slots[k - 1].offset == slots[0].offset + (k - 1) * slots[0].bits;
            for (uint32_t n = 1; n < k && even; n++)
                even = slots[n].bits == slots[0].bits;
            if (even)
                good = roll_slots(m, slots, k, slice->in[0]->set, partial);
            else
                k = 1;
        }
    }
    m->rolling = false;
    return good;
}

/* ---- weaving ---- */

/* What is woven: words one after the other, each of some elements, lowest first. */
struct word {
    struct machine_value *value;
    uint32_t parts;
};

/* All values in memory, by one evaluation. */
static bool words_evaluate(struct machine *m, struct word *y, uint32_t count, int set)
{
    struct machine_value **wanted = malloc(count * sizeof *wanted);
    int wanted_count = 0;
    if (!wanted) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reshape a field");
        return false;
    }
    for (uint32_t i = 0; i < count; i++)
        if (!node_is_leaf(y[i].value) && (i == 0 || y[i].value != y[i - 1].value))
            wanted[wanted_count++] = y[i].value;
    bool good = !wanted_count || run_evaluate(m, wanted, wanted_count, false) == MACHINE_OK;
    free(wanted);
    struct machine_value *known = NULL, *in_memory = NULL; /* numbers come in long rows */
    for (uint32_t i = 0; i < count && good; i++) {
        if (y[i].value != known) {
            known = y[i].value;
            in_memory = observe_materialise(m, set, known);
            good = in_memory != NULL;
        }
        y[i].value = in_memory;
    }
    return good;
}

/* A buffer of the finer set. */
static struct machine_value *weave(struct machine *m, struct word *y, uint32_t count,
                                   int coarse, int fine, uint32_t k, struct machine_type type)
{
    const struct vpset *f = &m->sets[fine], *s = &m->sets[coarse];
    size_t element = type_bytes(type);
    struct device_buffer *out = NULL;
    enum machine_status status = MACHINE_OK;
    if (!words_evaluate(m, y, count, coarse) ||
        !(out = device_buffer_get(m, observe_buffer_bytes(f, type))))
        return NULL;
    for (uint32_t at = 0, n, first = 0; at < count && !status;
         first += n * y[at].parts, at += n) {
        size_t whole = type_bytes(y[at].value->type);
        for (n = 1; n < BLOCK && at + n < count; n++)
            if (y[at + n].parts != y[at].parts || type_bytes(y[at + n].value->type) != whole)
                break;
        char options[96];
        snprintf(options, sizeof options, "-DELEMENT=%s -DWHOLE=%s%s", call_element(element),
                 call_element(whole),
                 element == 16 ? " -DPAIR"
                 : whole == 16 ? " -DWIDE"
                               : "");
        struct kernel_call c = call_begin(m, kernel_reshape_cl, options, "weave");
        call_set(&c, m, f);
        call_set(&c, m, s);
        call_uint(&c, processors_run(m));
        call_uint(&c, k);
        call_uint(&c, first);
        call_uint(&c, n);
        call_uint(&c, y[at].parts);
        call_uint(&c, type.width);
        call_ulong(&c, scalar_ones(type.width).lo);
        for (uint32_t i = 0; i < BLOCK; i++)
            call_buffer(&c, y[at + (i < n ? i : 0)].value->buffer);
        call_buffer(&c, out);
        status = call_processors(&c, m, (size_t)s->ratio);
    }
    if (!status)
        return graph_buffer_node(m, type, fine, out);
    device_buffer_unref(m, out);
    return NULL;
}

/* ---- between a finer and a coarser field ---- */

/* Element i of the k has bits [origin + i * stride, + length) of the coarse field, and all the fine
 * one's. */
struct factor {
    struct field *fine, *coarse;
    uint32_t k, origin, stride, length;
};

/* Where the slots of all elements begin and end, as marks of one; wider: there is a slot that
 * goes over an element. */
static unsigned char *marks_make(const struct factor *f, uint32_t *widest)
{
    unsigned char *marks = calloc((size_t)f->length + 1, 1);
    *widest = 0;
    for (int i = 0; marks && i < f->coarse->slots_count; i++) {
        const struct slot *s = &f->coarse->slots[i];
        uint32_t end = f->origin + (f->k - 1) * f->stride + f->length;
        if (s->offset >= end || s->offset + s->bits <= f->origin)
            continue;
        *widest = s->bits > *widest ? s->bits : *widest;
        if (s->offset >= f->origin && (s->offset - f->origin) % f->stride < f->length)
            marks[(s->offset - f->origin) % f->stride] = 1;
        if (s->offset + s->bits < end &&
            (s->offset + s->bits - f->origin) % f->stride < f->length)
            marks[(s->offset + s->bits - f->origin) % f->stride] = 1;
    }
    return marks;
}

static struct machine_value *number_of(struct machine *m, uint32_t width, bool ones)
{
    uint64_t bits = ones ? UINT64_MAX : 0;
    return machine_constant(m, MACHINE_UINT(width), (struct machine_scalar){bits, bits});
}

static bool is_zero(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT && !v->imm.lo && !v->imm.hi;
}

/* The values of [at, at + width) of each element; y has room for k. */
static struct machine_value *piece_of_each(struct machine *m, const struct factor *f,
                                           struct machine_value **y, uint32_t at,
                                           uint32_t width)
{
    int budget = LIFT_NODES;
    bool alike = true;
    for (uint32_t i = 0; i < f->k; i++) {
        y[i] = field_content(m, f->coarse, f->origin + i * f->stride + at, width);
        if (!y[i])
            return NULL;
        alike = alike && type_equal(y[i]->type, y[0]->type);
    }
    for (uint32_t i = 0; i < f->k && !alike; i++)
        if (!(y[i] = machine_reinterpret(m, y[i], MACHINE_UINT(width))))
            return NULL;
    struct machine_value *v = lift(m, y, f->k, f->fine->vpset, &budget);
    if (v && !unroll(m, v, y, f->k))
        return NULL;
    struct word *words = v ? NULL : malloc(f->k * sizeof *words);
    for (uint32_t i = 0; words && i < f->k; i++)
        words[i] = (struct word){y[i], 1};
    if (words)
        v = weave(m, words, f->k, f->coarse->vpset, f->fine->vpset, f->k, y[0]->type);
    free(words);
    return v;
}

/* The words that hold whole elements of up to 32 bits: slots as they are where each begins and ends with
 * an element, so that kernels do not depend on where; else what 64 bits hold. Returns how many. */
static uint32_t words_of(struct machine *m, const struct factor *f, struct word *out)
{
    uint32_t width = f->length, end = f->k * width, most = 64 / width * width, count = 0;
    bool even = true;
    for (int i = 0; i < f->coarse->slots_count; i++) {
        const struct slot *s = &f->coarse->slots[i];
        if (s->offset < f->origin + end && s->offset + s->bits > f->origin)
            even = even && s->offset >= f->origin && (s->offset - f->origin) % width == 0 &&
                   s->bits % width == 0 && s->offset + s->bits <= f->origin + end;
    }
    int i = 0;
    for (uint32_t at = 0, bits; at < end; at += bits) {
        bits = end - at < most ? end - at : most;
        while (even && i < f->coarse->slots_count &&
               f->coarse->slots[i].offset + f->coarse->slots[i].bits <= f->origin + at)
            i++;
        if (even && i < f->coarse->slots_count) {
            uint32_t offset = f->coarse->slots[i].offset - f->origin;
            if (offset == at)
                bits = f->coarse->slots[i].bits;
            else if (offset < at + bits)
                bits = offset - at; /* nothing is stored there */
        }
        struct machine_value *v = field_content(m, f->coarse, f->origin + at, bits);
        if (!v)
            return 0;
        out[count++] = (struct word){v, bits / width};
    }
    return count;
}

static struct machine_value *words_of_elements(struct machine *m, const struct factor *f)
{
    struct word *words = malloc(f->k * sizeof *words);
    uint32_t count = words ? words_of(m, f, words) : 0;
    bool zeros = true, ones = true;
    for (uint32_t i = 0; i < count; i++) {
        zeros = zeros && is_zero(words[i].value);
        ones = ones && words[i].value == number_of(m, words[i].value->type.width, true);
    }
    struct machine_value *v = NULL;
    if (count && (zeros || ones))
        v = number_of(m, f->length, ones);
    else if (count)
        v = weave(m, words, count, f->coarse->vpset, f->fine->vpset, f->k,
                  MACHINE_UINT(f->length));
    free(words);
    return v;
}

static struct slot slot_of(const struct machine *m, uint32_t offset, struct machine_value *v)
{
    graph_ref(v);
    return (struct slot){
        .value = v, .offset = offset, .bits = v->type.width, .epoch_created = m->epoch};
}

static bool fine_from_coarse(struct machine *m, const struct factor *f)
{
    uint32_t widest, pieces = 1;
    if (f->length == 0)
        return true;
    unsigned char *marks = marks_make(f, &widest);
    struct machine_value **y = malloc(f->k * sizeof *y), *v;
    bool good = marks && y;
    if (!good)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reshape a field");
    for (uint32_t at = 1; good && at < f->length; at++)
        pieces += marks[at];
    bool words = f->length <= 32 && f->k > 1 && f->stride == f->length &&
                 (widest > f->length || pieces > PIECES_MANY);
    field_slots_put(m, f->fine, 0, f->fine->bits, NULL, 0);
    if (good && words) {
        v = words_of_elements(m, f);
        good = v != NULL;
        struct slot s = good ? slot_of(m, 0, v) : (struct slot){.bits = 0};
        if (good)
            field_slots_put(m, f->fine, 0, 0, &s, 1);
    }
    bool whole = pieces > PIECES_MANY && f->length <= 64;
    for (uint32_t at = 0, next; good && !words && at < f->length; at = next) {
        next = at + 1;
        while (next < f->length && next - at < 128 && (whole || !marks[next]))
            next++;
        if (next - at == 128 && next < f->length && !marks[next])
            next = at + 64; /* long fields in words */
        v = piece_of_each(m, f, y, at, next - at);
        good = v != NULL;
        if (good && !is_zero(v)) {
            struct slot s = slot_of(m, at, v);
            field_slots_put(m, f->fine, at, at, &s, 1);
        }
    }
    free(marks);
    free(y);
    return good;
}

static bool coarse_from_fine(struct machine *m, const struct factor *f)
{
    uint32_t count = (uint32_t)f->fine->slots_count;
    struct machine_value **wanted = malloc((count + 1) * sizeof *wanted);
    struct slot *slots = malloc(((size_t)count * f->k + 1) * sizeof *slots);
    bool good = wanted && slots;
    int wanted_count = 0, put = 0;
    if (!good)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reshape a field");
    bool same_set = f->k == 1 && f->fine->vpset == f->coarse->vpset;
    for (uint32_t n = 0; good && n < count; n++)
        if (!node_is_leaf(f->fine->slots[n].value) && !same_set)
            wanted[wanted_count++] = f->fine->slots[n].value;
    if (wanted_count)
        good = run_evaluate(m, wanted, wanted_count, false) == MACHINE_OK;
    for (uint32_t i = 0; good && i < f->k; i++)
        for (uint32_t n = 0; n < count; n++) {
            const struct slot *s = &f->fine->slots[n];
            if (!is_zero(s->value))
                slots[put++] = slot_of(m, f->origin + i * f->stride + s->offset,
                                       slice_of(m, s->value, f->coarse->vpset, f->k, i));
        }
    if (good && f->length)
        field_slots_put(m, f->coarse, f->origin, f->origin + (f->k - 1) * f->stride + f->length,
                        slots, put);
    free(wanted);
    free(slots);
    return good;
}

/* ---- any shape: through an image of the memory ---- */

static uint32_t image_words(const struct machine *m, const struct field *root)
{
    return (uint32_t)((m->sets[root->vpset].ratio * root->bits + 31) / 32);
}

static struct view view_of(const struct field *f)
{
    return f->root ? f->view : (struct view){0, 1, f->bits, 0};
}

/* name: "put" or "get"; at: of the value's first bit in f. */
static enum machine_status image_pass(struct machine *m, const char *name,
                                      const struct field *f, uint32_t words, uint32_t at,
                                      struct machine_type type,
                                      const struct device_buffer *from,
                                      const struct device_buffer *to)
{
    const struct vpset *s = &m->sets[f->vpset];
    struct view view = view_of(f);
    char options[64];
    size_t bytes = type_bytes(type);
    snprintf(options, sizeof options, "-DELEMENT=%s%s", call_element(bytes),
             bytes == 16 ? " -DPAIR" : "");
    struct kernel_call c = call_begin(m, kernel_reshape_cl, options, name);
    call_set(&c, m, s);
    call_uint(&c, processors_run(m));
    call_uint(&c, words);
    call_uint(&c, view.start + at);
    call_uint(&c, view.parts);
    call_uint(&c, view.outer);
    call_uint(&c, view.inner);
    call_uint(&c, type.width);
    call_buffer(&c, from);
    call_buffer(&c, to);
    return call_processors(&c, m, 1);
}

static bool image_put(struct machine *m, const struct field *f, uint32_t words,
                      struct device_buffer *image)
{
    for (int i = 0; i < f->slots_count; i++) {
        const struct slot *s = &f->slots[i];
        struct machine_value *v = observe_materialise(m, f->vpset, s->value);
        if (!v || image_pass(m, "put", f, words, s->offset, v->type, v->buffer, image))
            return false;
    }
    return true;
}

static bool image_get(struct machine *m, struct field *f, uint32_t words,
                      const struct device_buffer *image)
{
    const struct vpset *s = &m->sets[f->vpset];
    field_slots_put(m, f, 0, f->bits, NULL, 0);
    for (uint32_t at = 0; at < f->bits; at += 64) {
        struct machine_type type = MACHINE_UINT(f->bits - at < 64 ? f->bits - at : 64);
        struct device_buffer *b = device_buffer_get(m, observe_buffer_bytes(s, type));
        if (!b)
            return false;
        struct slot slot = slot_of(m, at, graph_buffer_node(m, type, f->vpset, b));
        field_slots_put(m, f, at, at, &slot, 1);
        if (image_pass(m, "get", f, words, at, type, image, b))
            return false;
    }
    return true;
}

/* newest (or NULL) is laid over the root's memory; to then takes its content from there. */
static bool through_image(struct machine *m, struct field *root, struct field *newest,
                          struct field *to)
{
    uint32_t words = image_words(m, root);
    size_t bytes = (size_t)words * 4 * (size_t)m->processors_count;
    struct device_buffer *image = device_buffer_get(m, bytes ? bytes : 4);
    cl_uint zero = 0;
    if (!image)
        return false;
    bool good = device_fill(m, image, &zero, sizeof zero, "reshaping") == MACHINE_OK &&
                image_put(m, root, words, image) &&
                (!newest || image_put(m, newest, words, image)) &&
                image_get(m, to, words, image);
    device_buffer_unref(m, image);
    return good;
}

/* ---- who has the content ---- */

/* Whether the alias is finer or coarser than its root by a whole factor, and how. */
static bool factor_of(const struct machine *m, struct field *alias, struct factor *out)
{
    struct field *root = alias->root;
    uint64_t ra = m->sets[root->vpset].ratio, rx = m->sets[alias->vpset].ratio;
    const struct view *v = &alias->view;
    if (rx % ra == 0) {
        uint32_t k = (uint32_t)(rx / ra), stride = alias->bits ? alias->bits : 1;
        bool fits = k == 1          ? v->parts == 1 && (ra == 1 || v->outer == root->bits)
                    : v->parts == k ? ra == 1 || v->outer == root->bits
                                    : ra == 1 && v->parts == 1;
        if (k > 1)
            stride = v->parts == k ? v->inner : v->outer;
        *out = (struct factor){alias, root, k, v->start, stride, alias->bits};
        return fits && stride > 0 &&
               (uint64_t)v->start + (uint64_t)(k - 1) * stride + alias->bits <= root->bits;
    }
    if (ra % rx == 0) {
        uint32_t k = (uint32_t)(ra / rx);
        *out = (struct factor){root, alias, k, 0, root->bits, root->bits};
        return v->start == 0 && v->parts == 1 && alias->bits == k * root->bits &&
               (rx == 1 || v->outer == alias->bits);
    }
    return false;
}

bool reshape_settle(struct machine *m, struct field *root)
{
    struct field *from = root->newest;
    struct factor f;
    if (!from)
        return true;
    bool good = !factor_of(m, from, &f) ? through_image(m, root, from, root)
                : f.fine == from        ? coarse_from_fine(m, &f)
                                        : fine_from_coarse(m, &f);
    if (good)
        root->newest = NULL;
    return good;
}

static bool take_over(struct machine *m, struct field *alias)
{
    struct factor f;
    if (!factor_of(m, alias, &f))
        return through_image(m, alias->root, NULL, alias);
    return f.fine == alias ? fine_from_coarse(m, &f) : coarse_from_fine(m, &f);
}

bool reshape_bring(struct machine *m, struct field *f, bool writes, bool whole)
{
    struct field *root = f->root ? f->root : f;
    if (!root->aliases)
        return true;
    if (f == root && writes && whole)
        root->newest = NULL;
    if (root->newest != f && !reshape_settle(m, root))
        return false;
    if (f->root && !f->current) {
        if (!(writes && whole) && !take_over(m, f))
            return false;
        f->current = true;
    }
    if (writes) {
        for (struct field *a = root->aliases; a; a = a->next_alias)
            a->current = a == f;
        root->newest = f == root ? NULL : f;
    }
    return true;
}

/* ---- making aliases ---- */

/* Where VPs of a set of ratio `to` have their bits, when they share out those that VPs of ratio `from`
 * have from bit `offset` of a view of `bits` on. False: they cannot. */
static bool view_divide(struct view v, uint32_t bits, uint32_t offset, uint64_t from,
                        uint64_t to, struct view *out, uint32_t *out_bits)
{
    bool even = v.parts == 1 || v.inner * v.parts == v.outer;
    uint32_t stride = v.parts == 1 ? v.outer : v.inner, left = bits - offset;
    *out = v;
    out->start += offset;
    if (to == from) {
        *out_bits = left;
    } else if (from == 1 || (to % from == 0 && even)) {
        uint32_t k = (uint32_t)(to / from);
        *out_bits = left / k;
        out->parts = k;
        out->outer = stride;
        out->inner = *out_bits;
    } else if (from % to == 0 && even) {
        uint32_t k = (uint32_t)(from / to);
        *out_bits = (k - 1) * stride + left;
        out->parts = 1;
        out->outer = k * stride;
        out->inner = 0;
    } else if (even && stride == bits) {
        *out_bits = (uint32_t)(((from - 1) * stride + left) / to);
        out->parts = 1;
        out->outer = *out_bits;
        out->inner = 0;
    } else {
        return false;
    }
    return true;
}

/* The view of an alias of the field in the VP set. */
static bool view_make(struct machine *m, uint32_t field, int vpset, struct field **root,
                      struct view *view, uint32_t *bits)
{
    struct machine_field_info info;
    uint32_t offset = 0;
    if (!vpset_get(m, vpset))
        return false;
    if (!machine_field_lookup(m, field, &info)) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", field);
        return false;
    }
    struct field *f = field_exact(m, info.base);
    offset = info.offset;
    *root = f->root ? f->root : f;
    if (!view_divide(view_of(f), f->bits, offset, m->sets[f->vpset].ratio, m->sets[vpset].ratio,
                     view, bits)) {
        machine_fail(
            m, MACHINE_BAD_ARGUMENT,
            "memory of a set of VP ratio %llu cannot be shared out among %llu VPs here: "
            "make the alias of the whole field",
            (unsigned long long)m->sets[f->vpset].ratio,
            (unsigned long long)m->sets[vpset].ratio);
        return false;
    }
    return true;
}

uint32_t machine_alias_make(struct machine *m, uint32_t field, int vpset)
{
    struct field *root;
    struct view view;
    uint32_t bits;
    if (!view_make(m, field, vpset, &root, &view, &bits))
        return MACHINE_NO_FIELD;
    uint32_t id = machine_field_allocate(m, vpset, bits, root->region);
    if (id == MACHINE_NO_FIELD)
        return id;
    struct field *f = field_exact(m, id);
    f->root = root;
    f->view = view;
    f->next_alias = root->aliases;
    root->aliases = f;
    return id;
}

static struct field *alias_exact(struct machine *m, uint32_t alias)
{
    struct field *f = field_exact(m, alias);
    if (f && f->root)
        return f;
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%u is not an alias (any more)", alias);
    return NULL;
}

enum machine_status machine_alias_change(struct machine *m, uint32_t alias, uint32_t field)
{
    struct field *f = alias_exact(m, alias), *root;
    struct view view;
    uint32_t bits;
    if (!f || !view_make(m, field, f->vpset, &root, &view, &bits))
        return m->status;
    if (!field_room(m, f, bits))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "an alias of %u bits cannot become one of %u: make another",
                            f->bits, bits);
    if (f->root->newest == f && !reshape_settle(m, f->root))
        return m->status;
    field_unlink_alias(f);
    field_slots_put(m, f, 0, f->bits, NULL, 0);
    f->root = root;
    f->view = view;
    f->bits = bits;
    f->current = false;
    f->next_alias = root->aliases;
    root->aliases = f;
    return MACHINE_OK;
}

enum machine_status machine_alias_remove(struct machine *m, uint32_t alias)
{
    struct field *f = alias_exact(m, alias);
    if (!f)
        return m->status;
    if (f->root->newest == f && !reshape_settle(m, f->root))
        return m->status;
    field_destroy(m, f);
    return MACHINE_OK;
}

bool machine_is_alias(struct machine *m, uint32_t field)
{
    struct machine_field_info info;
    if (!machine_field_lookup(m, field, &info))
        return false;
    const struct field *f = field_exact(m, info.base);
    return f && f->root;
}
