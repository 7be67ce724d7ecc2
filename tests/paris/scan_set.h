/* scan_set.h - a VP set of any geometry with numbers, masks and segments, on the device and in
 * the oracle. */
#ifndef PARIS_TESTS_SCAN_SET_H
#define PARIS_TESTS_SCAN_SET_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "device.h"
#include "oracle_scan.h"

/* ---- a VP set with numbers ---- */

struct set {
    struct scan_grid grid;
    CM_vp_set_id_t id;
    CM_field_id_t context, sbit, source, dest;
    number *context_bits, *sbits, *numbers, *old, *got;
};

static number *numbers_new(int count)
{
    number *n = calloc((size_t)count, sizeof *n);
    assert_non_null(n);
    return n;
}

static struct machine_type type_of(char letter, int width)
{
    return letter != 'f' ? MACHINE_UINT(width) : width == 32 ? MACHINE_F32 : MACHINE_F64;
}

static void put(const struct set *s, CM_field_id_t field, char letter, int width,
                const number *n)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char *dense = calloc((size_t)s->grid.count, bytes);
    for (int i = 0; i < s->grid.count; i++)
        memcpy(dense + (size_t)i * bytes, &n[i], bytes);
    assert_int_equal(
        machine_field_upload(paris_machine(), field, type_of(letter, width), dense),
        MACHINE_OK);
    free(dense);
}

static void get(const struct set *s, CM_field_id_t field, char letter, int width, number *n)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char *dense = calloc((size_t)s->grid.count, bytes);
    if (machine_field_download(paris_machine(), field, type_of(letter, width), dense) !=
        MACHINE_OK)
        fail_msg("%s", machine_error(paris_machine()));
    memset(n, 0, (size_t)s->grid.count * sizeof *n);
    for (int i = 0; i < s->grid.count; i++)
        memcpy(&n[i], dense + (size_t)i * bytes, bytes);
    free(dense);
}

static struct set set_new(int rank, const int *dimensions)
{
    struct set s = {.grid = {.rank = rank, .count = 1}};
    for (int i = 0; i < rank; i++) {
        s.grid.dimensions[i] = dimensions[i];
        s.grid.count *= dimensions[i];
    }
    s.id = CM_allocate_vp_set(
        CM_create_geometry((CM_vector_t){.ints = dimensions}, (unsigned int)rank));
    CM_set_vp_set(s.id);
    s.context = CM_allocate_heap_field(1);
    s.sbit = CM_allocate_heap_field(1);
    s.context_bits = numbers_new(s.grid.count);
    s.sbits = numbers_new(s.grid.count);
    s.numbers = numbers_new(s.grid.count);
    s.old = numbers_new(s.grid.count);
    s.got = numbers_new(s.grid.count);
    return s;
}

/* Makes fields for numbers of this width. A field that held numbers of another width would be
 * stored in pieces. */
static void fields_new(struct set *s, int width)
{
    if (s->source)
        CM_deallocate_stack_through(s->source);
    s->source = CM_allocate_stack_field((unsigned)width);
    s->dest = CM_allocate_stack_field((unsigned)width);
}

static void set_free(struct set *s)
{
    if (s->source)
        CM_deallocate_stack_through(s->source);
    CM_set_context();
    CM_deallocate_vp_set(s->id);
    free(s->context_bits);
    free(s->sbits);
    free(s->numbers);
    free(s->old);
    free(s->got);
}

/* Draws numbers, COUNT at a time. */
static void numbers_random(number *n, int count, int width, bool floats)
{
    number some[COUNT];
    for (int i = 0; i < count; i++) {
        if (i % COUNT == 0 && floats)
            device_floats(some, width);
        else if (i % COUNT == 0)
            device_integers(some, width);
        n[i] = some[i % COUNT];
        /* few NaNs and infinities: after the first one a sum shows nothing more */
        if (floats && device_random() % (count > 4000 ? 1000u : 8u))
            n[i] = oracle_float_bits(width, (double)(int64_t)device_random() / 3e18);
    }
}

/* Sets the context (0 few, 1 all, 2 most processors) and the segment bits (one processor in
 * `length`). */
static void set_masks(struct set *s, int who, int length)
{
    for (int i = 0; i < s->grid.count; i++) {
        s->context_bits[i] = who == 1 || (device_random() >> 20) % 4 < (who ? 3u : 1u);
        s->sbits[i] = (device_random() >> 20) % (unsigned)length == 0;
    }
    put(s, s->sbit, 'b', 1, s->sbits);
    put(s, s->context, 'b', 1, s->context_bits);
    CM_set_context();
    if (who != 1)
        CM_load_context(s->context);
}

static void compare(const struct set *s, const char *what, const struct scan_case *c)
{
    get(s, s->dest, c->letter, c->width, s->got);
    for (int i = 0; i < s->grid.count; i++)
        if (s->got[i] != s->old[i])
            fail_msg("%s_%c_%s, %d bits, axis %d of %d (%d %d %d), direction %d, inclusion %d, "
                     "smode %d: processor %d: got %016llx%016llx, wanted %016llx%016llx",
                     what, c->letter, c->op, c->width, c->axis, s->grid.rank,
                     s->grid.dimensions[0], s->grid.dimensions[1], s->grid.dimensions[2],
                     c->direction, c->inclusion, c->smode, i,
                     (unsigned long long)(s->got[i] >> 64), (unsigned long long)s->got[i],
                     (unsigned long long)(s->old[i] >> 64), (unsigned long long)s->old[i]);
}

#endif
