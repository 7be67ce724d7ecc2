/* rank.c - ranks along an axis: a radix sort from the lowest digit up; does not wait.
 *
 * Keys are converted to unsigned integers of the wanted order. A bit above the key puts
 * inactive processors last; with segments, the number of the processor's segment is above
 * that. Then a processor's place in the sorted line is its rank: segments keep all their
 * processors, so each segment begins where it did. Keys are divided into words of 32 bits,
 * and words into digits; each digit is a pass (kernels/sort.cl).
 */
#include <stdio.h>
#include <string.h>

#include "base/scalar.h"
#include "kernels.h"
#include "memory/memory.h"
#include "ops/near.h"
#include "ops/near_rank.h"
#include "ops/scan.h"
#include "run/materialise.h"
#include "values/graph.h"

enum { WORDS_MAX = 6 };
enum { NEAR_SHARED = 64 }; /* LUTETIA_NEAR=2: longer lines are shared out */

enum { WORD, PAIR, GATHER }; /* as in kernels/sort.cl */

struct words {
    struct machine_value *values[WORDS_MAX];
    struct device_buffer *arrays[WORDS_MAX]; /* theirs, or what a block has of them */
    int bits[WORDS_MAX];
    int count;
};

/* Adds words of a key; of the last word only the low bits count. */
static bool words_add(struct machine *m, struct words *w, struct machine_value *key, int last)
{
    for (int at = 0; key && at < key->type.width; at += 32) {
        int bits = key->type.width - at < 32 ? key->type.width - at : 32;
        struct machine_value *word =
            machine_resize(m, machine_extract(m, key, at, bits), 32, false);
        if (!word)
            return false;
        w->values[w->count] = in_memory(m, word);
        w->bits[w->count++] = at + 32 < key->type.width ? 32 : last;
    }
    return key != NULL;
}

/* Converts values to unsigned integers in the requested order. */
static struct machine_value *key_of(struct machine *m, struct machine_value *v, bool downward,
                                    bool is_signed)
{
    int width = v->type.width;
    struct machine_type type = MACHINE_UINT(width);
    if (v->type.kind == MACHINE_FLOAT) {
        struct machine_type plain = width == 32 ? MACHINE_F32 : MACHINE_F64;
        v = machine_to_float(m, v, plain, false);
        /* -0 + 0 is 0 */
        v = v ? machine_binary(m, MACHINE_FADD, v,
                               machine_constant(m, plain, (struct machine_scalar){0, 0}))
              : NULL;
        if (!v)
            return NULL;
        v = float_order(m, v, downward ? 0 : scalar_ones(width).lo);
    } else if (is_signed) {
        v = machine_binary(m, MACHINE_XOR, v, machine_constant(m, type, scalar_sign(width)));
    }
    return v && downward ? machine_unary(m, MACHINE_NOT, v) : v;
}

static int bits_of(int x)
{
    int bits = 0;
    for (; x; x >>= 1)
        bits++;
    return bits;
}

static bool words_of(struct machine *m, const struct machine_scan *how,
                     struct machine_value *key, struct words *w)
{
    const struct vpset *s = &m->values->sets[m->values->set_current];
    struct machine_value *context = flag_held(m, m->values->set_current, MACHINE_CONTEXT);
    int length = s->dimensions[how->axis];
    struct machine_value *inactive = machine_unary(m, MACHINE_NOT, context);
    if (!key || !inactive)
        return false;
    bool all = inactive->op == NODE_CONSTANT && !inactive->buffer && !inactive->imm.lo;
    int last = (key->type.width - 1) % 32 + 1, above_bits = 1;
    if (how->segments == MACHINE_UNSEGMENTED && all)
        return words_add(m, w, key, last);
    if (how->segments == MACHINE_UNSEGMENTED && key->type.width < 128)
        return words_add(m, w, machine_concat(m, key, inactive), key->type.width % 32 + 1);
    struct machine_value *above = inactive;
    struct machine_value *everyone =
        machine_constant(m, MACHINE_BIT, (struct machine_scalar){1, 0});
    if (how->segments != MACHINE_UNSEGMENTED) {
        struct machine_scan number = {.op = MACHINE_SCAN_ADD, .axis = how->axis, .bits = NULL};
        struct machine_value *begins = scan_boundaries(m, how);
        struct machine_value *segment =
            begins ? scan_where(m, &number, machine_resize(m, begins, 32, false), everyone)
                   : NULL;
        segment = machine_resize(m, segment, 31, false);
        above_bits += bits_of(length);
        above = segment ? machine_concat(m, inactive, segment) : NULL;
    }
    return above && words_add(m, w, key, last) && words_add(m, w, above, above_bits);
}

struct sort {
    struct lines lines;
    const struct vpset *set;
    int chunk, chunks, digit; /* chunk: processors in a chunk; digit: bits */
    struct device_buffer *pairs[2], *counts, *ranks;
    size_t counts_bytes;
};

static struct sort sort_of(const struct machine *m, const struct vpset *s, int axis)
{
    struct sort t = {.lines = lines_of(s, axis, false), .set = s, .chunks = 1};
    int length = t.lines.length, chunk = m->device->shape.sort_chunk;
    t.digit = shape_sort_digit(&m->device->shape, length);
    t.chunk = length;
    if (chunk && length > chunk) {
        t.chunk = chunk;
    } else if (length >= m->device->shape.sort_long) {
        int wanted = 2 * m->device->units;
        t.chunk = (length - 1) / wanted + 1;
    }
    t.chunks = (length - 1) / t.chunk + 1;
    return t;
}

static struct kernel_call sort_part(struct machine *m, int number)
{
    char options[64];
    snprintf(options, sizeof options, "-DPART=%d -DDIGIT=%d", number,
             m->device->is_cpu ? 11 : 8);
    return call_begin(m, kernel_sort_cl, options, "sort");
}

static enum machine_status sort_pass(struct machine *m, const struct sort *t,
                                     const struct device_buffer *word, int source, int shift,
                                     int bits, int from, bool last)
{
    const struct lines *l = &t->lines;
    size_t rows = l->inner * (size_t)l->columns;
    for (int number = 0; number < 2; number++) {
        struct kernel_call c = sort_part(m, number);
        call_lines(&c, l, t->chunk);
        call_int(&c, source);
        call_int(&c, shift);
        call_int(&c, bits);
        call_buffer(&c, word);
        call_buffer(&c, t->pairs[from]);
        call_buffer(&c, t->counts);
        if (number == 1) {
            call_int(&c, last);
            call_lines_rows(&c, l);
            call_buffer(&c, t->pairs[!from]);
            call_buffer(&c, t->ranks);
        }
        enum machine_status status =
            call_start_3d(&c, m, (size_t)t->chunks, rows, l->outer, "sorting");
        if (!status && number == 0)
            status = lines_sum_up(m, t->counts, lines_count(l), (size_t)t->chunks << bits);
        if (status)
            return status;
    }
    return MACHINE_OK;
}

static enum machine_status sort_words(struct machine *m, const struct sort *t,
                                      const struct words *w)
{
    int from = 0;
    for (int i = 0; i < w->count; i++) {
        int passes = (w->bits[i] - 1) / t->digit + 1;
        for (int k = 0; k < passes; k++) {
            int begin = w->bits[i] * k / passes, end = w->bits[i] * (k + 1) / passes;
            bool last = i == w->count - 1 && k == passes - 1;
            enum machine_status status = sort_pass(m, t, w->arrays[i],
                                                   k   ? PAIR
                                                   : i ? GATHER
                                                       : WORD,
                                                   begin, end - begin, from, last);
            if (status)
                return status;
            from = !from;
        }
    }
    return MACHINE_OK;
}

static struct device_buffer *ranks_far(struct machine *m, const struct vpset *s, int axis,
                                       const struct words *w)
{
    struct sort t = sort_of(m, s, axis);
    size_t lines = lines_count(&t.lines), count = lines * (size_t)t.lines.length;
    struct device_buffer **const all[4] = {&t.pairs[0], &t.pairs[1], &t.counts, &t.ranks};
    const size_t bytes[4] = {count * 8, count * 8, (lines * (size_t)t.chunks << t.digit) * 4,
                             geometry_bytes(s, MACHINE_UINT(32))};
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < 4 && !status; i++)
        if (!(*all[i] = device_buffer_get(m, bytes[i])))
            status = m->status;
    if (!status)
        status = sort_words(m, &t, w);
    for (int i = 0; i < 3; i++)
        if (*all[i])
            device_buffer_unref(m, *all[i]);
    if (status && t.ranks)
        device_buffer_unref(m, t.ranks);
    device_flush(m);
    return status ? NULL : t.ranks;
}

/* By the front end. False: nothing has been done. */
static bool ranks_near(struct machine *m, const struct vpset *s, const struct lines *l,
                       const struct words *w, struct device_buffer *ranks)
{
    const struct device *d = m->device;
    struct near_word words[WORDS_MAX];
    double start, seconds = 1e-9 * d->shape.rank_ns * (double)s->count * w->count;
    int parts = device_parts(m, seconds);
    bool shared = parts > 1 &&
                  l->length > (m->settings.near < 2 ? d->shape.rank_alone_most : NEAR_SHARED);
    for (int i = 0; i < w->count; i++)
        words[i] = (struct near_word){.word = w->arrays[i]->host, .bits = w->bits[i]};
    if (!near_begin(m, ranks, &start))
        return false;
    struct device_buffer *pairs = shared ? device_buffer_get(m, 16 * (size_t)l->length) : NULL;
    bool good = shared ? pairs && near_rank_shared(d, parts, l, words, w->count, pairs, ranks)
                       : near_rank(d, parts, l, words, w->count, ranks);
    if (pairs)
        device_buffer_unref(m, pairs);
    if (good)
        near_end(m, "sorting", start);
    return good;
}

/* By the front end; else by the device. NULL: error set. */
static struct device_buffer *ranks_of(struct machine *m, const struct vpset *s, int axis,
                                      const struct words *w)
{
    const struct lines l = lines_of(s, axis, false);
    struct device_buffer *ranks = device_rows_get(m, geometry_rows(s, MACHINE_UINT(32)));
    if (!ranks || ranks_near(m, s, &l, w, ranks))
        return ranks;
    device_buffer_unref(m, ranks);
    return m->status ? NULL : ranks_far(m, s, axis, w);
}

struct rank_work {
    int axis;
    struct words words; /* without arrays */
};

static struct device_buffer *rank_work(struct machine *m, const struct vpset *s,
                                       struct device_buffer *const *in, const void *of)
{
    const struct rank_work *r = of;
    struct words w = r->words;
    for (int i = 0; i < w.count; i++)
        w.arrays[i] = in[i];
    return ranks_of(m, s, r->axis, &w);
}

struct device_buffer *rank_told(struct machine *m, const struct vpset *s,
                                struct device_buffer *const *in, const void *bytes,
                                size_t count)
{
    struct rank_work work;
    if (count != sizeof work)
        return NULL;
    memcpy(&work, bytes, count);
    return work.words.count <= WORDS_MAX ? rank_work(m, s, in, &work) : NULL;
}

struct machine_value *machine_rank(struct machine *m, int axis, bool downward, bool is_signed,
                                   enum machine_segments segments, struct machine_value *bits,
                                   struct machine_value *value)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    struct machine_scan how = {.axis = axis, .segments = segments, .bits = bits};
    bool segmented = segments != MACHINE_UNSEGMENTED;
    struct words w = {.count = 0};
    if (!value || !s || (segmented && !bits) ||
        !scan_arguments_good(m, s, axis, value, segmented ? bits : NULL) ||
        !words_of(m, &how, key_of(m, value, downward, is_signed), &w) ||
        !materialise_all_in_blocks(m, m->values->set_current, w.values, w.count))
        return NULL;
    const struct rank_work work = {axis, w};
    const struct lines_job job = {LINES_RANKS, rank_work, &work, sizeof work};
    struct device_buffer *ranks =
        lines_worked(m, MACHINE_UINT(32), w.values, w.count, axis == 0, &job);
    return ranks ? graph_buffer_node(m, MACHINE_UINT(32), m->values->set_current, ranks) : NULL;
}
