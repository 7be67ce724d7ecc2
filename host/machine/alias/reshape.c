/* reshape.c - converts content between a root and its aliases: interleaved by a kernel, or
 * through an image of the memory. See reshape.h. */
#include "alias/reshape.h"

#include <stdlib.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "kernels.h"
#include "memory/call_set.h"
#include "run/evaluate.h"
#include "run/materialise.h"
#include "run/near_shapes.h"
#include "run/roll.h"
#include "run/slices.h"
#include "values/graph.h"

enum { PIECES_MANY = 8 };

/* ---- weaving ---- */

/* The words to interleave, one after the other; each holds some elements, lowest first. */
struct word {
    struct machine_value *value;
    uint32_t parts;
};

/* Puts all values into memory, by one evaluation. */
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
    bool good = !wanted_count || evaluate_values(m, wanted, wanted_count, false) == MACHINE_OK;
    free(wanted);
    struct machine_value *known = NULL, *filled = NULL; /* equal numbers come in long rows:
                                                         * reuse the last buffer */
    for (uint32_t i = 0; i < count && good; i++) {
        if (y[i].value != known) {
            known = y[i].value;
            filled = materialise(m, set, known);
            good = filled != NULL;
        }
        y[i].value = filled;
    }
    return good;
}

/* Of the finer value that words become. */
struct woven {
    int coarse, fine; /* sets */
    uint32_t k;
    struct machine_type type;
    struct device_buffer *out;
};

/* n words that are alike, whose first part is element `first`. */
static enum machine_status words_weave(struct machine *m, const struct woven *w,
                                       const struct word *y, uint32_t n, uint32_t first)
{
    const struct vpset *f = &m->values->sets[w->fine], *s = &m->values->sets[w->coarse];
    const size_t element = type_bytes(w->type), whole = type_bytes(y->value->type);
    const struct device_buffer *in[SLICES_BLOCK];
    for (uint32_t i = 0; i < SLICES_BLOCK; i++)
        in[i] = y[i < n ? i : 0].value->buffer;
    if (near_weave(m, f, s, w->k, first, n, y->parts, w->type.width, whole, in, element,
                   w->out))
        return MACHINE_OK;
    char options[96];
    snprintf(options, sizeof options, "-DELEMENT=%s -DWHOLE=%s%s", call_element(element),
             call_element(whole),
             element == 16 ? " -DPAIR"
             : whole == 16 ? " -DWIDE"
                           : "");
    struct kernel_call c = call_begin(m, kernel_reshape_cl, options, "weave");
    call_set(&c, m, f);
    call_set(&c, m, s);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, w->k);
    call_uint(&c, first);
    call_uint(&c, n);
    call_uint(&c, y->parts);
    call_uint(&c, w->type.width);
    call_ulong(&c, scalar_ones(w->type.width).lo);
    for (uint32_t i = 0; i < SLICES_BLOCK; i++)
        call_buffer(&c, in[i]);
    call_buffer(&c, w->out);
    return call_processors(&c, m, (size_t)s->ratio, "reshaping");
}

/* Interleaves into a buffer of the finer set. */
static struct machine_value *weave(struct machine *m, struct word *y, uint32_t count,
                                   int coarse, int fine, uint32_t k, struct machine_type type)
{
    struct woven w = {.coarse = coarse, .fine = fine, .k = k, .type = type};
    enum machine_status status = MACHINE_OK;
    if (!words_evaluate(m, y, count, coarse) ||
        !(w.out = device_rows_get(m, geometry_rows(&m->values->sets[fine], type))))
        return NULL;
    for (uint32_t at = 0, n, first = 0; at < count && !status;
         first += n * y[at].parts, at += n) {
        size_t whole = type_bytes(y[at].value->type);
        for (n = 1; n < SLICES_BLOCK && at + n < count; n++)
            if (y[at + n].parts != y[at].parts || type_bytes(y[at + n].value->type) != whole)
                break;
        status = words_weave(m, &w, y + at, n, first);
    }
    if (!status)
        return graph_buffer_node(m, type, fine, w.out);
    device_buffer_unref(m, w.out);
    return NULL;
}

/* ---- between a finer and a coarser field ---- */

/* Marks where the slots of all elements begin and end, relative to one element. wider: some
 * slot spans two elements. */
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

/* Allocates words for each element; NULL: error set. */
static struct word *words_room(struct machine *m, const struct factor *f)
{
    struct word *words = malloc(f->k * sizeof *words);
    if (!words)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reshape a field");
    return words;
}

/* Gets the values of bits [at, at + width) of each element; y has room for k. */
static struct machine_value *piece_of_each(struct machine *m, const struct factor *f,
                                           struct machine_value **y, uint32_t at,
                                           uint32_t width)
{
    struct machine_value *v;
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
    if (!roll_lift(m, y, f->k, f->fine->vpset, RUN_LOOKED, &v))
        return NULL;
    if (v)
        return v;
    struct word *words = words_room(m, f);
    if (!words)
        return NULL;
    for (uint32_t i = 0; i < f->k; i++)
        words[i] = (struct word){y[i], 1};
    v = weave(m, words, f->k, f->coarse->vpset, f->fine->vpset, f->k, y[0]->type);
    free(words);
    return v;
}

/* Divides elements of up to 32 bits into words: the slots as they are, if each begins and
 * ends with an element, so that kernels do not depend on their places; else words of 64
 * bits. Returns the number of words. */
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
                bits = offset - at; /* a gap: nothing is stored there */
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
    struct word *words = words_room(m, f);
    uint32_t count = words ? words_of(m, f, words) : 0;
    bool zeros = true, ones = true;
    for (uint32_t i = 0; i < count; i++) {
        zeros = zeros && machine_value_is_zero(words[i].value);
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
        .value = v, .offset = offset, .bits = v->type.width, .epoch_created = m->values->epoch};
}

bool reshape_fine_from_coarse(struct machine *m, const struct factor *f)
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
            next = at + 64; /* long fields are divided into words of 64 bits */
        v = piece_of_each(m, f, y, at, next - at);
        good = v != NULL;
        if (good && !machine_value_is_zero(v)) {
            struct slot s = slot_of(m, at, v);
            field_slots_put(m, f->fine, at, at, &s, 1);
        }
    }
    free(marks);
    free(y);
    return good;
}

bool reshape_coarse_from_fine(struct machine *m, const struct factor *f)
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
        good = evaluate_values(m, wanted, wanted_count, false) == MACHINE_OK;
    for (uint32_t i = 0; good && i < f->k; i++)
        for (uint32_t n = 0; n < count; n++) {
            const struct slot *s = &f->fine->slots[n];
            if (!machine_value_is_zero(s->value))
                slots[put++] = slot_of(m, f->origin + i * f->stride + s->offset,
                                       slice_make(m, s->value, f->coarse->vpset, f->k, i));
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
    return (uint32_t)((m->values->sets[root->vpset].ratio * root->bits + 31) / 32);
}

/* put: from the value into the image, else from there; at: the value's first bit in f. */
static enum machine_status image_pass(struct machine *m, bool put, const struct field *f,
                                      uint32_t words, uint32_t at, struct machine_type type,
                                      const struct device_buffer *from,
                                      const struct device_buffer *to)
{
    const struct vpset *s = &m->values->sets[f->vpset];
    struct view view = reshape_view(f);
    if (near_image(m, s,
                   &(struct near_view){words, view.start + at, view.parts, view.outer,
                                       view.inner, type.width},
                   put, type_bytes(type), put ? from : to, put ? to : from))
        return MACHINE_OK;
    struct kernel_call c = slices_call(m, type, put ? "put" : "get");
    call_set(&c, m, s);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, words);
    call_uint(&c, view.start + at);
    call_uint(&c, view.parts);
    call_uint(&c, view.outer);
    call_uint(&c, view.inner);
    call_uint(&c, type.width);
    call_buffer(&c, from);
    call_buffer(&c, to);
    return call_processors(&c, m, 1, "reshaping");
}

static bool image_put(struct machine *m, const struct field *f, uint32_t words,
                      struct device_buffer *image)
{
    for (int i = 0; i < f->slots_count; i++) {
        const struct slot *s = &f->slots[i];
        struct machine_value *v = materialise(m, f->vpset, s->value);
        if (!v || image_pass(m, true, f, words, s->offset, v->type, v->buffer, image))
            return false;
    }
    return true;
}

static bool image_get(struct machine *m, struct field *f, uint32_t words,
                      const struct device_buffer *image)
{
    const struct vpset *s = &m->values->sets[f->vpset];
    field_slots_put(m, f, 0, f->bits, NULL, 0);
    for (uint32_t at = 0; at < f->bits; at += 64) {
        struct machine_type type = MACHINE_UINT(f->bits - at < 64 ? f->bits - at : 64);
        struct device_buffer *b = device_rows_get(m, geometry_rows(s, type));
        if (!b)
            return false;
        struct slot slot = slot_of(m, at, graph_buffer_node(m, type, f->vpset, b));
        field_slots_put(m, f, at, at, &slot, 1);
        if (image_pass(m, false, f, words, at, type, image, b))
            return false;
    }
    return true;
}

bool reshape_through_image(struct machine *m, struct field *root, struct field *newest,
                           struct field *to)
{
    uint32_t words = image_words(m, root);
    size_t bytes = (size_t)words * 4 * (size_t)m->values->processors_count;
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
