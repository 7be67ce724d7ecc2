/* Arrays in each processor, with an index of its own: CM_aref, CM_aset.
 *
 * An array is its elements one after the other, from the lowest bits on. What an index finds is
 * chosen from all elements,
 *
 *     dest = index is 0 ? element 0 : index is 1 ? element 1 : ... : dest
 *
 * which is as much work as on the original machine, whose processors could not address memory
 * individually. The selection is done in chunks of CHUNK elements, each evaluated before the
 * next. All chunks are alike, so one small kernel computes them all.
 *
 * The original kept arrays for fast access "slicewise", 32 processors together: bit k of a
 * number in the memory of the k-th of them. CM_transpose32 went to and from that layout, and
 * aref32 wanted it. Here aref32 takes arrays in the usual layout, and the transposition does
 * nothing: a program that fills an array by aset32, or by moves and a transposition, reads
 * back what it stored. A shared array of n elements belongs to 32 physical processors (all,
 * if there are fewer): processor p of them has the elements p, p + 32, p + 64, ... one after
 * the other, which is what transposing moved there. VP k of each shares with VP k of the
 * others.
 */
#include "paris_state.h"

#include <stdlib.h>
#include <string.h>

enum { CHUNK = 16, GROUP = 32 };

struct indexed {
    CM_field_id_t field, array; /* dest or source */
    unsigned int len, element_len, index_len;
    uint64_t limit; /* number of elements that an index can reach */
};

static unsigned int reach(unsigned int index_limit, unsigned int index_len)
{
    return index_len < 32 && index_limit > 1u << index_len ? 1u << index_len : index_limit;
}

static bool check(const struct indexed *x, CM_field_id_t index, const char *role,
                  uint64_t array_bits)
{
    struct machine_type type;
    if (x->len > x->element_len) {
        paris_fail("%s: has %u bits, but an element only %u", role, x->len, x->element_len);
        return false;
    }
    if (array_bits > UINT32_MAX) {
        paris_fail("array: %u elements of %u bits are too many", (unsigned int)x->limit,
                   x->element_len);
        return false;
    }
    return paris_type(paris_u(index, x->index_len), "index", &type) &&
           paris_check_field(x->field, x->len, role) &&
           paris_check_field(x->array, (unsigned int)array_bits, "array") &&
           paris_check_overlap(paris_b(x->array, (unsigned int)array_bits),
                               paris_b(x->field, x->len));
}

static struct machine_value *number(struct machine *m, unsigned int width, uint64_t n)
{
    return machine_constant(m, MACHINE_UINT(width), (struct machine_scalar){n, 0});
}

/* Puts values that later chunks need into memory. */
static bool settle(struct machine *m, struct machine_value **values, int count)
{
    if (machine_settle(m, values, count) == MACHINE_OK)
        return true;
    paris_fail_machine();
    return false;
}

/* Bits [at, at + len) of element i. */
static struct paris_operand place_of(const struct indexed *x, uint64_t i, unsigned int at,
                                     unsigned int len)
{
    return paris_b(x->array + (CM_field_id_t)(i * x->element_len) + at, len);
}

/* 1 in processors whose index is i. */
static struct machine_value *hits(struct machine *m, const struct indexed *x,
                                  struct machine_value *index, uint64_t i)
{
    return machine_binary(m, MACHINE_EQ, index, number(m, x->index_len, i));
}

/* Ends a chunk: computes the selection so far, because the chain would become long. */
static bool chunk_ends(const struct indexed *x, uint64_t i)
{
    return (i + 1) % CHUNK == 0 && i + 1 < x->limit;
}

static bool fetch_piece(struct machine *m, const struct indexed *x, struct machine_value *index,
                        unsigned int at, unsigned int len)
{
    struct machine_value *sum =
        paris_load(m, paris_b(x->field + at, len), "dest", MACHINE_WHERE_ACTIVE);
    for (uint64_t i = 0; sum && i < x->limit; i++) {
        struct machine_value *element =
            paris_load(m, place_of(x, i, at, len), "array", MACHINE_WHERE_ACTIVE);
        struct machine_value *hit = hits(m, x, index, i);
        if (!element)
            return false;
        sum = machine_select(m, hit, element, sum);
        if (sum && chunk_ends(x, i) && !settle(m, (struct machine_value *[]){index, sum}, 2))
            return false;
    }
    return paris_store(m, paris_b(x->field + at, len), sum, MACHINE_WHERE_ACTIVE);
}

static bool set_piece(struct machine *m, const struct indexed *x, struct machine_value *index,
                      unsigned int at, unsigned int len)
{
    struct machine_value *source =
        paris_load(m, paris_b(x->field + at, len), "source", MACHINE_WHERE_ACTIVE);
    struct machine_value *done[CHUNK + 2] = {index, source};
    for (uint64_t i = 0; source && i < x->limit; i++) {
        struct paris_operand place = place_of(x, i, at, len);
        struct machine_value *element = paris_load(m, place, "array", MACHINE_WHERE_ACTIVE);
        struct machine_value *hit = hits(m, x, index, i);
        if (!element || !paris_store(m, place, machine_select(m, hit, source, element),
                                     MACHINE_WHERE_ACTIVE))
            return false;
        done[2 + i % CHUNK] = paris_load(m, place, "array", MACHINE_EVERYWHERE);
        if (!done[2 + i % CHUNK] || (chunk_ends(x, i) && !settle(m, done, CHUNK + 2)))
            return false;
    }
    return source != NULL;
}

/* Processes fields longer than an integer in pieces. */
static void indexed_do(struct machine *m, const struct indexed *x, CM_field_id_t index_field,
                       bool sets)
{
    const char *role = sets ? "source" : "dest";
    if (!check(x, index_field, role, x->limit * x->element_len))
        return;
    struct paris_operand index = paris_u(index_field, x->index_len);
    struct machine_value *v = paris_load(m, index, "index", MACHINE_WHERE_ACTIVE);
    unsigned int step = x->len > PARIS_INTEGER_MAX ? PARIS_PIECE : x->len;
    for (unsigned int at = 0; v && at < x->len; at += step) {
        unsigned int len = x->len - at < step ? x->len - at : step;
        if (!(sets ? set_piece : fetch_piece)(m, x, v, at, len))
            return;
    }
}

static void indexed_call(const char *name, CM_field_id_t field, CM_field_id_t array,
                         CM_field_id_t index, unsigned int len, unsigned int index_len,
                         unsigned int index_limit, unsigned int element_len, bool sets)
{
    struct machine *m = paris_begin(name);
    struct indexed x = {field,     array,
                        len,       element_len ? element_len : len,
                        index_len, reach(index_limit, index_len)};
    indexed_do(m, &x, index, sets);
}

void CM_aref_2L(CM_field_id_t dest, CM_field_id_t array, CM_field_id_t index, unsigned int dlen,
                unsigned int index_len, unsigned int index_limit, unsigned int element_len)
{
    indexed_call("CM_aref_2L", dest, array, index, dlen, index_len, index_limit, element_len,
                 false);
}

void CM_aset_2L(CM_field_id_t source, CM_field_id_t array, CM_field_id_t index,
                unsigned int slen, unsigned int index_len, unsigned int index_limit,
                unsigned int element_len)
{
    indexed_call("CM_aset_2L", source, array, index, slen, index_len, index_limit, element_len,
                 true);
}

void CM_aref32_2L(CM_field_id_t dest, CM_field_id_t array, CM_field_id_t index,
                  unsigned int dlen, unsigned int index_len, unsigned int index_limit)
{
    indexed_call("CM_aref32_2L", dest, array, index, dlen, index_len, index_limit, dlen, false);
}

void CM_aset32_2L(CM_field_id_t source, CM_field_id_t array, CM_field_id_t index,
                  unsigned int slen, unsigned int index_len, unsigned int index_limit)
{
    indexed_call("CM_aset32_2L", source, array, index, slen, index_len, index_limit, slen,
                 true);
}

/* ---- arrays of 32 processors, on the front end ---- */

struct shared {
    const struct paris_geometry *geometry;
    uint64_t count, rows; /* number of virtual processors; elements in each */
    unsigned int group;
    size_t bytes, index_bytes; /* of an element, of an index */
    unsigned char *numbers, *indices, *context, *array;
};

static void shared_free(struct shared *s)
{
    free(s->numbers);
    free(s->indices);
    free(s->context);
    free(s->array);
}

/* Reads the context of the current VP set, through a temporary field. */
static bool context_read(struct machine *m, unsigned char *out)
{
    uint32_t field = machine_field_allocate(m, machine_vpset_current(m), 1, MACHINE_HEAP);
    bool good = field &&
                machine_field_store(m, field,
                                    machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE),
                                    MACHINE_EVERYWHERE) == MACHINE_OK &&
                machine_field_download(m, field, MACHINE_BIT, out) == MACHINE_OK;
    if (field)
        machine_field_deallocate(m, field);
    return good;
}

static bool shared_read(struct machine *m, struct shared *s, const struct indexed *x,
                        CM_field_id_t index)
{
    struct machine_type type = MACHINE_UINT(x->len), index_type = MACHINE_UINT(x->index_len);
    s->bytes = machine_element_bytes(type);
    s->index_bytes = machine_element_bytes(index_type);
    s->numbers = malloc(s->count * s->bytes);
    s->indices = malloc(s->count * s->index_bytes);
    s->context = malloc(s->count);
    s->array = malloc(s->count * s->rows * s->bytes);
    if (!s->numbers || !s->indices || !s->context || !s->array) {
        paris_fail_memory("not enough memory for the arrays of %llu processors",
                          (unsigned long long)s->count);
        return false;
    }
    bool good = context_read(m, s->context) &&
                machine_field_download(m, x->field, type, s->numbers) == MACHINE_OK &&
                machine_field_download(m, index, index_type, s->indices) == MACHINE_OK;
    for (uint64_t row = 0; good && row < s->rows; row++)
        good = machine_field_download(m, x->array + (CM_field_id_t)(row * x->len), type,
                                      s->array + row * s->count * s->bytes) == MACHINE_OK;
    if (!good)
        paris_fail_machine();
    return good;
}

/* The place of the element for a processor's index; NULL: there is none. */
static unsigned char *shared_place(const struct shared *s, const struct indexed *x,
                                   uint64_t processor)
{
    uint64_t words[2] = {0, 0};
    memcpy(words, s->indices + processor * s->index_bytes, s->index_bytes);
    if (words[1] || words[0] >= x->limit)
        return NULL;
    uint64_t ratio = s->geometry->ratio,
             address = paris_address_of_index(s->geometry, processor);
    uint64_t physical = address / ratio / s->group * s->group + words[0] % s->group;
    uint64_t other = paris_index_of_address(s->geometry, physical * ratio + address % ratio);
    if (other == UINT64_MAX)
        return NULL;
    return s->array + (words[0] / s->group * s->count + other) * s->bytes;
}

static void shared_do(struct machine *m, const struct indexed *x, CM_field_id_t index,
                      bool sets)
{
    const char *role = sets ? "source" : "dest";
    struct machine_type type;
    unsigned int processors = (unsigned int)machine_processors_count(m);
    struct shared s = {.geometry = paris_geometry_current()};
    if (!s.geometry)
        return;
    s.count = s.geometry->count;
    s.group = processors < GROUP ? processors : GROUP;
    s.rows = (x->limit + s.group - 1) / s.group;
    if (!paris_type(paris_u(x->field, x->len), role, &type) ||
        !check(x, index, role, s.rows * x->len))
        return;
    if (s.rows && shared_read(m, &s, x, index)) {
        for (uint64_t i = 0; i < s.count; i++) {
            unsigned char *place = s.context[i] ? shared_place(&s, x, i) : NULL;
            if (place && sets)
                memcpy(place, s.numbers + i * s.bytes, s.bytes);
            else if (place)
                memcpy(s.numbers + i * s.bytes, place, s.bytes);
        }
        bool good = sets || machine_field_upload(m, x->field, type, s.numbers) == MACHINE_OK;
        for (uint64_t row = 0; sets && good && row < s.rows; row++)
            good = machine_field_upload(m, x->array + (CM_field_id_t)(row * x->len), type,
                                        s.array + row * s.count * s.bytes) == MACHINE_OK;
        if (!good)
            paris_fail_machine();
    }
    shared_free(&s);
}

static void shared_call(const char *name, CM_field_id_t field, CM_field_id_t array,
                        CM_field_id_t index, unsigned int len, unsigned int index_len,
                        unsigned int index_limit, bool sets)
{
    struct machine *m = paris_begin(name);
    struct indexed x = {field, array, len, len, index_len, reach(index_limit, index_len)};
    shared_do(m, &x, index, sets);
}

void CM_aref32_shared_2L(CM_field_id_t dest, CM_field_id_t array, CM_field_id_t index,
                         unsigned int dlen, unsigned int index_len, unsigned int index_limit)
{
    shared_call("CM_aref32_shared_2L", dest, array, index, dlen, index_len, index_limit, false);
}

void CM_aset32_shared_2L(CM_field_id_t source, CM_field_id_t array, CM_field_id_t index,
                         unsigned int slen, unsigned int index_len, unsigned int index_limit)
{
    shared_call("CM_aset32_shared_2L", source, array, index, slen, index_len, index_limit,
                true);
}

/* ---- the other layout ---- */

void CM_transpose32_1_1L(CM_field_id_t dest, unsigned int len)
{
    paris_begin("CM_transpose32_1_1L");
    paris_check_field(dest, len, "dest");
}

void CM_transpose32_2_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int len)
{
    static const struct paris_instruction self = {"CM_transpose32_2_1L", 0, 0, 0,
                                                  MACHINE_EVERYWHERE};
    paris_move(&self, paris_b(dest, len), paris_b(source, len));
}
