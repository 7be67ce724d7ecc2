/* Tests calls that are no rows of the table of instructions: fields and their parts,
 * processors, arrays, reductions, long fields, random numbers, timers, lights. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

static CM_field_id_t stack_with(int width, const number *numbers)
{
    CM_field_id_t field = CM_allocate_stack_field((unsigned int)width);
    device_put(field, width, numbers);
    return field;
}

/* ---- fields ---- */

static void field_parts_are_its_bits(void **unused)
{
    (void)unused;
    number colour[COUNT], part[COUNT];
    device_integers(colour, 24);
    CM_field_id_t image = stack_with(24, colour);
    for (int channel = 0; channel < 3; channel++) {
        device_get(CM_add_offset_to_field_id(image, 8 * channel), 8, part);
        for (int i = 0; i < COUNT; i++)
            assert_int_equal((int)part[i], (int)(colour[i] >> (8 * channel) & 255));
    }
    CM_u_add_constant_2_1L(CM_add_offset_to_field_id(image, 8), 1, 8);
    CM_u_move_zero_1L(CM_add_offset_to_field_id(image, 21), 3);
    device_get(image, 24, part);
    for (int i = 0; i < COUNT; i++) {
        number wanted = (colour[i] & 0x1f00ff) | (((colour[i] >> 8) + 1) & 255) << 8;
        assert_int_equal((int)part[i], (int)wanted);
    }
    CM_deallocate_stack_through(image);
}

static void field_inquiries_answer(void **unused)
{
    (void)unused;
    CM_field_id_t a = CM_allocate_stack_field(40), b = CM_allocate_stack_field(7),
                  h = CM_allocate_heap_field(9);
    assert_true(CM_is_field_valid(a) && CM_is_field_in_stack(a) && !CM_is_field_in_heap(a));
    assert_true(CM_is_field_in_heap(h) && !CM_is_field_in_stack(h));
    assert_true(CM_is_stack_field_newer(b, a) && !CM_is_stack_field_newer(a, b));
    assert_int_equal(CM_field_length(CM_add_offset_to_field_id(a, 8)), 32);
    assert_int_equal(CM_field_vp_set(a), CM_current_vp_set);
    CM_deallocate_stack_through(a);
    CM_deallocate_heap_field(h);
    assert_false(CM_is_field_valid(a) || CM_is_field_valid(b) || CM_is_field_valid(h));
    assert_false(CM_is_field_valid(CM_no_field));
}

/* ---- one processor ---- */

static void processors_are_read_and_written(void **unused)
{
    (void)unused;
    CM_field_id_t f = CM_allocate_stack_field(128);
    CM_clear_context(); /* which does not matter */
    CM_u_write_to_processor_1L(3, f, 0xdeadbeef, 32);
    assert_int_equal(CM_u_read_from_processor_1L(3, f, 32), 0xdeadbeef);
    assert_int_equal(CM_s_read_from_processor_1L(3, f, 32), (int)0xdeadbeef);
    assert_int_equal(CM_s_read_from_processor_1L(3, f, 17), (int)0xffffbeef);
    assert_int_equal(CM_u_read_from_processor(3, f, 5), 0xf);
    CM_s_write_to_processor_1L(8, f, -5, 100);
    assert_true(CM_s_read_from_processor_long_1L(8, f, 100) == -5);
    assert_int_equal(CM_u_read_from_processor_1L(8, CM_add_offset_to_field_id(f, 90), 12),
                     0x3ff);
    CM_f_write_to_processor_1L(0, f, 0.1, 23, 8);
    assert_true(CM_f_read_from_processor_1L(0, f, 23, 8) == (double)0.1f);
    CM_f_write_to_processor(0, f, -0.1, 52, 11);
    assert_true(CM_f_read_from_processor(0, f, 52, 11) == -0.1);
    CM_u_write_to_processor_1L(0, f, 0x123456789abcul, 48);
    assert_true(CM_u_read_from_processor_long_1L(0, f, 48) == 0x123456789abcul);
    CM_set_context();
    CM_deallocate_stack_through(f);
}

/* ---- arrays ---- */

/* A block of a 6 x 20 array; the array's dimension j lies along axis[j]. */
struct block {
    int offset[2], start[2], end[2], axis[2], dimensions[2];
};
#define VECTORS(b)                                                                             \
    (CM_vector_t){.ints = b.offset}, (CM_vector_t){.ints = b.start},                           \
        (CM_vector_t){.ints = b.end}, (CM_vector_t)                                            \
    {                                                                                          \
        .ints = b.axis                                                                         \
    }
#define DIMENSIONS(b)                                                                          \
    (CM_vector_t)                                                                              \
    {                                                                                          \
        .ints = b.dimensions                                                                   \
    }

static const struct block blocks[] = {
    {{0, 0}, {0, 0}, {ROWS, COLUMNS}, {0, 1}, {ROWS, COLUMNS}}, /* all, as it is */
    {{1, 3}, {2, 4}, {5, 12}, {0, 1}, {6, 20}},                 /* a part */
    {{3, 2}, {1, 0}, {13, 3}, {1, 0}, {16, 6}},                 /* transposed */
    {{0, 0}, {4, 12}, {5, 13}, {0, 1}, {1, 1}},                 /* one element */
    {{2, 2}, {3, 3}, {3, 9}, {0, 1}, {6, 20}},                  /* nothing */
};
enum { BLOCKS = sizeof blocks / sizeof blocks[0], ARRAY = 6 * 20 };

/* The processor of element k of the array; -1: none. */
static int processor_of(const struct block *b, int k)
{
    int subscript[2] = {k / b->dimensions[1], k % b->dimensions[1]}, at[2] = {0, 0};
    for (int j = 0; j < 2; j++) {
        int c = subscript[j] - b->offset[j] + b->start[j];
        if (subscript[j] >= b->dimensions[j] || c < b->start[j] || c >= b->end[j])
            return -1;
        at[b->axis[j]] = c;
    }
    return at[0] * COLUMNS + at[1];
}

static void integer_blocks(unsigned int format, int bytes, int width, bool is_signed)
{
    for (int n = 0; n < BLOCKS; n++) {
        struct block b = blocks[n];
        unsigned char array[ARRAY * 8], back[ARRAY * 8];
        number before[COUNT], after[COUNT];
        for (size_t i = 0; i < sizeof array; i++)
            array[i] = (unsigned char)device_random();
        memset(back, 0xa5, sizeof back);
        device_integers(before, width);
        CM_field_id_t f = stack_with(width, before);
        (is_signed ? CM_s_write_to_news_array_1L : CM_u_write_to_news_array_1L)(
            array, VECTORS(b), f, (unsigned)width, 2, DIMENSIONS(b), format);
        device_get(f, width, after);
        for (int k = 0; k < b.dimensions[0] * b.dimensions[1]; k++) {
            number element = 0;
            int p = processor_of(&b, k);
            if (p < 0)
                continue;
            memcpy(&element, array + k * bytes, (size_t)bytes);
            before[p] = oracle_extend(element, 8 * bytes, is_signed) & oracle_mask(width);
        }
        for (int p = 0; p < COUNT; p++)
            if (before[p] != after[p])
                fail_msg("write: format %u, %d bits, block %d, processor %d: %llx, wanted %llx",
                         format, width, n, p, (unsigned long long)after[p],
                         (unsigned long long)before[p]);
        (is_signed ? CM_s_read_from_news_array_1L : CM_u_read_from_news_array_1L)(
            back, VECTORS(b), f, (unsigned)width, 2, DIMENSIONS(b), format);
        for (int k = 0; k < ARRAY; k++) {
            number got = 0, wanted = 0;
            int p = k < b.dimensions[0] * b.dimensions[1] ? processor_of(&b, k) : -1;
            memcpy(&got, back + k * bytes, (size_t)bytes);
            memset(&wanted, 0xa5, (size_t)bytes); /* untouched */
            if (p >= 0)
                wanted = oracle_extend(after[p], width, is_signed) & oracle_mask(8 * bytes);
            if (got != wanted)
                fail_msg("read: format %u, %d bits, block %d, element %d: %llx, wanted %llx",
                         format, width, n, k, (unsigned long long)got,
                         (unsigned long long)wanted);
        }
        CM_deallocate_stack_through(f);
    }
}

static void arrays_of_integers_move(void **unused)
{
    (void)unused;
    static const int widths[] = {1, 5, 8, 16, 24, 32, 33, 64, 100};
    static const struct {
        unsigned int format;
        int bytes;
    } formats[] = {{CM_8_bit, 1}, {CM_16_bit, 2}, {CM_32_bit, 4}, {CM_64_bit, 8}};
    for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++)
        for (int f = 0; f < 4; f++) {
            integer_blocks(formats[f].format, formats[f].bytes, widths[w], false);
            if (widths[w] > 1)
                integer_blocks(formats[f].format, formats[f].bytes, widths[w], true);
        }
}

static void arrays_of_floats_move(void **unused)
{
    (void)unused;
    struct block b = blocks[2];
    float singles[ARRAY], singles_back[ARRAY];
    double doubles[ARRAY], doubles_back[ARRAY];
    CM_field_id_t f = CM_allocate_stack_field(64);
    for (int k = 0; k < ARRAY; k++) {
        doubles[k] = ldexp((double)(int64_t)device_random(), (int)(device_random() % 100) - 80);
        singles[k] = (float)-doubles[k];
    }
    CM_f_write_to_news_array_1L(doubles, VECTORS(b), f, 23, 8, 2, DIMENSIONS(b),
                                CM_float_double);
    CM_f_read_from_news_array_1L(singles_back, VECTORS(b), f, 23, 8, 2, DIMENSIONS(b),
                                 CM_float_single);
    CM_f_write_to_news_array_1L(singles, VECTORS(b), f, 52, 11, 2, DIMENSIONS(b),
                                CM_float_single);
    CM_f_read_from_news_array_1L(doubles_back, VECTORS(b), f, 52, 11, 2, DIMENSIONS(b),
                                 CM_float_double);
    for (int k = 0; k < b.dimensions[0] * b.dimensions[1]; k++)
        if (processor_of(&b, k) >= 0) {
            assert_true(singles_back[k] == (float)doubles[k]);
            assert_true(doubles_back[k] == (double)singles[k]);
        }
    CM_deallocate_stack_through(f);
}

/* Of rows with halos, in a set of its own: a copy that shares the field's memory stays as it
 * is, and neighbours are found round the edge. */
static void blocks_spare_copies_and_reach_halos(void **unused)
{
    (void)unused;
    enum { HIGH = 7, WIDE = 70, ALL = HIGH * WIDE };
    int sides[2] = {HIGH, WIDE}, zeros[2] = {0, 0}, axes[2] = {0, 1};
    const CM_vp_set_id_t before = CM_current_vp_set;
    CM_vp_set_id_t set = CM_allocate_vp_set(CM_create_geometry(sides, 2));
    CM_set_vp_set(set);
    CM_set_context();
    CM_field_id_t f = CM_allocate_heap_field(32), copy = CM_allocate_heap_field(32),
                  next = CM_allocate_heap_field(32);
    static float in[ALL], expected[ALL], out[ALL];
    for (int i = 0; i < ALL; i++)
        expected[i] = (float)i;
    CM_f_write_to_news_array_1L(expected, zeros, zeros, sides, axes, f, 23, 8, 2, sides,
                                CM_float_single);
    for (int turn = 0; turn < 40; turn++) {
        int from[2], to[2], size[2];
        for (int j = 0; j < 2; j++) {
            from[j] = (int)(device_random() % (unsigned)sides[j]);
            to[j] = from[j] + 1 + (int)(device_random() % (unsigned)(sides[j] - from[j]));
            size[j] = to[j] - from[j];
        }
        for (int i = 0; i < size[0] * size[1]; i++)
            in[i] = (float)(1000 * turn + i);
        if (turn % 2)
            CM_f_move_1L(copy, f, 23, 8);
        CM_f_write_to_news_array_1L(in, zeros, from, to, axes, f, 23, 8, 2, size,
                                    CM_float_single);
        if (turn % 2) {
            CM_f_read_from_news_array_1L(out, zeros, zeros, sides, axes, copy, 23, 8, 2, sides,
                                         CM_float_single);
            assert_memory_equal(out, expected, sizeof out);
        }
        for (int i = 0; i < size[0] * size[1]; i++)
            expected[(from[0] + i / size[1]) * WIDE + from[1] + i % size[1]] = in[i];
        CM_get_from_news_1L(next, f, 1, turn % 3 ? CM_upward : CM_downward, 32);
        CM_f_read_from_news_array_1L(out, zeros, zeros, sides, axes, next, 23, 8, 2, sides,
                                     CM_float_single);
        for (int i = 0; i < ALL; i++)
            assert_true(
                out[i] ==
                expected[i / WIDE * WIDE + (i % WIDE + (turn % 3 ? 1 : WIDE - 1)) % WIDE]);
        CM_f_read_from_news_array_1L(in, zeros, from, to, axes, f, 23, 8, 2, size,
                                     CM_float_single);
        for (int i = 0; i < size[0] * size[1]; i++)
            assert_true(in[i] == (float)(1000 * turn + i));
    }
    CM_set_vp_set(before);
    CM_deallocate_vp_set(set);
}

/* ---- reductions ---- */

static void integer_reductions(int width, int which)
{
    number x[COUNT], context[COUNT], all = 0, any = 0, odd = 0;
    device_integers(x, width);
    device_mask(context, which);
    CM_field_id_t f = stack_with(width, x), c = stack_with(1, context);
    unsigned int len = (unsigned int)width;
    unsigned long u_sum = 0, u_min = (unsigned long)oracle_mask(width), u_max = 0;
    long s_sum = 0, s_min = (long)oracle_mask(width - 1), s_max = -s_min - 1;
    unsigned int active = 0;
    all = oracle_mask(width);
    for (int i = 0; i < COUNT; i++) {
        unsigned long u = (unsigned long)x[i];
        long s = (long)oracle_extend(x[i], width, true);
        if (!context[i])
            continue;
        active++;
        u_sum += u;
        s_sum = (long)((unsigned long)s_sum + (unsigned long)s);
        u_min = u < u_min ? u : u_min;
        u_max = u > u_max ? u : u_max;
        s_min = s < s_min ? s : s_min;
        s_max = s > s_max ? s : s_max;
        all &= x[i];
        any |= x[i];
        odd ^= x[i];
    }
    CM_load_context(c);
    assert_true(CM_global_u_add_long_1L(f, len) == u_sum);
    assert_int_equal(CM_global_u_add_1L(f, len), (unsigned int)u_sum);
    assert_true(CM_global_s_add_long_1L(f, len) == s_sum);
    assert_true(CM_global_u_min_long_1L(f, len) == u_min);
    assert_true(CM_global_u_max_long_1L(f, len) == u_max);
    assert_true(CM_global_s_min_long_1L(f, len) == s_min);
    assert_true(CM_global_s_max_long_1L(f, len) == s_max);
    assert_true(CM_global_logand_long_1L(f, len) == (unsigned long)all);
    assert_true(CM_global_logior_long_1L(f, len) == (unsigned long)any);
    assert_true(CM_global_logxor_long_1L(f, len) == (unsigned long)odd);
    assert_int_equal(CM_global_count_context(), active);
    assert_int_equal(CM_global_count_bit(c), active);
    assert_int_equal(CM_global_logior_bit(c), active > 0);
    assert_int_equal(CM_global_logand_bit(c), 1);
    assert_int_equal(CM_global_logand_bit_always(c), active == COUNT);
    CM_clear_context();
    assert_int_equal(CM_global_count_bit_always(c), active);
    assert_int_equal(CM_global_count_context(), 0);
    CM_set_context();
    CM_deallocate_stack_through(f);
}

static void reductions_of_integers_are_the_oracles(void **unused)
{
    (void)unused;
    static const int widths[] = {2, 8, 31, 32, 33, 64};
    for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++)
        for (int mask = 0; mask < 3; mask++)
            integer_reductions(widths[w], mask);
}

/* Sums in the order that machine.h defines: a row has sixteen sums of columns, which are added
 * by halves; the rows' sums are added pairwise. */
static double single_sum(const float *x, const number *context)
{
    float rows[ROWS];
    for (int row = 0; row < ROWS; row++) {
        volatile float lane[16] = {0};
        for (int column = 0; column < COLUMNS; column++)
            if (context[row * COLUMNS + column])
                lane[column % 16] += x[row * COLUMNS + column];
        for (int half = 8; half; half /= 2)
            for (int i = 0; i < half; i++)
                lane[i] += lane[i + half];
        rows[row] = lane[0];
    }
    for (int left = ROWS; left > 1; left = (left + 1) / 2)
        for (int i = 0; 2 * i < left; i++) {
            volatile float sum = 2 * i + 1 < left ? rows[2 * i] + rows[2 * i + 1] : rows[2 * i];
            rows[i] = sum;
        }
    return (double)rows[0];
}

static void reductions_of_floats_are_the_oracles(void **unused)
{
    (void)unused;
    for (int mask = 0; mask < 3; mask++) {
        float x[COUNT];
        number bits[COUNT], context[COUNT];
        double least = INFINITY, greatest = -INFINITY;
        device_mask(context, mask);
        for (int i = 0; i < COUNT; i++) {
            x[i] = (float)(int64_t)device_random() / 1e15f;
            bits[i] = oracle_float_bits(32, (double)x[i]);
            if (context[i]) {
                least = fmin(least, (double)x[i]);
                greatest = fmax(greatest, (double)x[i]);
            }
        }
        CM_field_id_t f = stack_with(32, bits), c = stack_with(1, context);
        CM_load_context(c);
        assert_true(CM_global_f_add_1L(f, 23, 8) == single_sum(x, context));
        assert_true(CM_global_f_min_1L(f, 23, 8) == least);
        assert_true(CM_global_f_max_1L(f, 23, 8) == greatest);
        CM_set_context();
        CM_deallocate_stack_through(f);
    }
}

/* ---- long fields ---- */

enum { LONG = 200 };

static void long_get(CM_field_id_t field, number low[COUNT], number high[COUNT])
{
    device_get(field, 128, low);
    device_get(field + 128, LONG - 128, high);
}

static void long_fields_go_in_pieces(void **unused)
{
    (void)unused;
    number al[COUNT], ah[COUNT], bl[COUNT], bh[COUNT], low[COUNT], high[COUNT], context[COUNT];
    CM_field_id_t a = CM_allocate_stack_field(LONG), b = CM_allocate_stack_field(LONG),
                  d = CM_allocate_stack_field(LONG);
    device_integers(al, 128);
    device_integers(ah, LONG - 128);
    device_integers(bl, 128);
    device_integers(bh, LONG - 128);
    device_mask(context, 2);
    device_put(a, 128, al);
    device_put(a + 128, LONG - 128, ah);
    device_put(b, 128, bl);
    device_put(b + 128, LONG - 128, bh);
    CM_field_id_t c = stack_with(1, context);

    CM_u_move_1L(d, b, LONG);
    CM_load_context(c);
    CM_logxor_3_1L(d, a, b, LONG);
    CM_set_context();
    long_get(d, low, high);
    for (int i = 0; i < COUNT; i++) {
        assert_true(low[i] == (context[i] ? al[i] ^ bl[i] : bl[i]));
        assert_true(high[i] == (context[i] ? ah[i] ^ bh[i] : bh[i]));
    }
    CM_s_move_2L(d, a, LONG, 77);
    long_get(d, low, high);
    for (int i = 0; i < COUNT; i++) {
        assert_true(low[i] == oracle_extend(al[i], 77, true));
        assert_true(high[i] == ((al[i] >> 76 & 1) ? oracle_mask(LONG - 128) : 0));
    }
    CM_u_move_2L(d, a, LONG, 131);
    long_get(d, low, high);
    for (int i = 0; i < COUNT; i++)
        assert_true(low[i] == al[i] && high[i] == (ah[i] & 7));
    CM_s_move_constant_1L(d, -2, LONG);
    long_get(d, low, high);
    assert_true(low[9] == oracle_extend(2, 2, true) && high[9] == oracle_mask(LONG - 128));
    CM_get_from_news_1L(d, a, 1, CM_downward, LONG);
    long_get(d, low, high);
    assert_true(low[1] == al[0] && high[1] == ah[0] && low[0] == al[COLUMNS - 1]);
    CM_lognot_1_1L(a, 0); /* length 0 does nothing, as in an old program's empty loop */
    CM_u_move_zero_always_1L(a, LONG);
    long_get(a, low, high);
    assert_true(low[5] == 0 && high[5] == 0);
    CM_deallocate_stack_through(a);
}

/* ---- the rest ---- */

static void random_numbers_keep_their_range(void **unused)
{
    (void)unused;
    number first[COUNT], again[COUNT], next[COUNT];
    CM_field_id_t f = CM_allocate_stack_field(32), g = CM_allocate_stack_field(64);
    CM_initialize_random_generator(357);
    CM_u_random_1L(f, 32, 1000);
    device_get(f, 32, first);
    CM_u_random_1L(f, 32, 1000);
    device_get(f, 32, next);
    CM_initialize_random_generator(357);
    CM_u_random(f, 32, 1000);
    device_get(f, 32, again);
    assert_memory_equal(first, again, sizeof first);
    assert_memory_not_equal(first, next, sizeof first);
    for (int i = 0; i < COUNT; i++)
        assert_true(first[i] < 1000);
    CM_f_random_1L(f, 23, 8);
    CM_f_random_1L(g, 52, 11);
    assert_true(CM_global_f_min_1L(f, 23, 8) >= 0 && CM_global_f_max_1L(f, 23, 8) < 1);
    assert_true(CM_global_f_min_1L(g, 52, 11) >= 0 && CM_global_f_max_1L(g, 52, 11) < 1);
    assert_true(CM_global_f_min_1L(g, 52, 11) < CM_global_f_max_1L(g, 52, 11));
    CM_deallocate_stack_through(f);
}

static void bits_are_set_and_cleared(void **unused)
{
    (void)unused;
    number mask[COUNT];
    device_mask(mask, 2);
    CM_field_id_t c = stack_with(1, mask), b = CM_allocate_stack_field(1);
    unsigned int active = CM_global_count_bit(c);
    CM_load_context(c);
    CM_set_bit(b);
    assert_int_equal(CM_global_count_bit_always(b), active);
    CM_invert_bit_always(b);
    assert_int_equal(CM_global_count_bit_always(b), COUNT - active);
    CM_invert_bit(b);
    assert_int_equal(CM_global_count_bit_always(b), COUNT);
    CM_clear_bit(b);
    assert_int_equal(CM_global_count_bit_always(b), COUNT - active);
    CM_clear_bit_always(b);
    assert_int_equal(CM_global_count_bit_always(b), 0);
    CM_set_bit_always(b);
    assert_int_equal(CM_global_count_bit_always(b), COUNT);
    CM_set_test_always();
    CM_set_overflow_always();
    CM_clear_all_flags();
    CM_set_context();
    assert_int_equal(CM_global_count_test(), COUNT - active);
    assert_int_equal(CM_global_count_overflow(), COUNT - active);
    CM_clear_all_flags_always();
    assert_int_equal(CM_global_logior_test(), 0);
    CM_deallocate_stack_through(c);
}

static void lights_show_what_was_latched(void **unused)
{
    (void)unused;
    number mask[COUNT], context[COUNT];
    uint8_t lights[COUNT];
    device_mask(mask, 2);
    device_mask(context, 2);
    CM_field_id_t b = stack_with(1, mask), c = stack_with(1, context);
    CM_latch_leds_always(b);
    assert_int_equal(paris_leds_read(lights, COUNT), COUNT);
    for (int i = 0; i < COUNT; i++)
        assert_int_equal(lights[i], (int)mask[i]);
    CM_load_context(c);
    CM_invert_bit(b);
    CM_latch_leds(b);
    CM_set_context();
    paris_leds_read(lights, COUNT);
    for (int i = 0; i < COUNT; i++)
        assert_int_equal(lights[i], (int)(mask[i] ^ context[i]));
    CM_deallocate_stack_through(b);
}

static void timers_add_up(void **unused)
{
    (void)unused;
    CM_timer_clear(3);
    CM_timer_start(3);
    assert_int_equal(CM_timer_read_run_state(3), 1);
    CM_timer_stop(3);
    double once = CM_timer_read_elapsed(3);
    CM_timer_start(3);
    CM_timer_stop(3);
    assert_true(CM_timer_read_elapsed(3) >= once && once >= 0);
    assert_true(CM_timer_read_cm_busy(3) <= CM_timer_read_elapsed(3) + 1e-3);
    assert_int_equal(CM_timer_read_starts(3), 2);
    assert_int_equal(CM_timer_read_run_state(3), 0);
}

/* Last, because it deallocates everything. */
static void init_gives_all_back(void **unused)
{
    (void)unused;
    CM_field_id_t h = CM_allocate_heap_field(32);
    CM_vp_set_id_t set = CM_current_vp_set;
    CM_init();
    assert_false(CM_is_field_valid(h));
    assert_false(CM_is_vp_set_valid(set) && CM_current_vp_set == set &&
                 CM_geometry_total_processors(CM_vp_set_geometry(set)) == COUNT);
    assert_int_equal(CM_physical_processors_limit, 16);
    assert_int_equal(CM_physical_processors_length, 4);
    assert_int_equal(CM_geometry_total_processors(CM_vp_set_geometry(CM_current_vp_set)), 16);
    assert_int_equal(CM_global_count_context(), 16);
    assert_int_equal(CM_attach_to_processors(64), 64);
    assert_int_equal(CM_physical_processors_limit, 64);
    CM_detach();
    assert_int_equal(CM_attached(), 0);
    assert_int_equal(CM_attach(), 64);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(field_parts_are_its_bits),
        cmocka_unit_test(field_inquiries_answer),
        cmocka_unit_test(processors_are_read_and_written),
        cmocka_unit_test(arrays_of_integers_move),
        cmocka_unit_test(arrays_of_floats_move),
        cmocka_unit_test(blocks_spare_copies_and_reach_halos),
        cmocka_unit_test(reductions_of_integers_are_the_oracles),
        cmocka_unit_test(reductions_of_floats_are_the_oracles),
        cmocka_unit_test(long_fields_go_in_pieces),
        cmocka_unit_test(random_numbers_keep_their_range),
        cmocka_unit_test(bits_are_set_and_cleared),
        cmocka_unit_test(lights_show_what_was_latched),
        cmocka_unit_test(timers_add_up),
        cmocka_unit_test(init_gives_all_back),
    };
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
