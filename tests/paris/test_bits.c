/* Compares moves, swaps, reversals and logical operations on fields of any length, and arrays
 * in each processor, with the same operations on arrays of bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

enum { BITS = 700 };

typedef unsigned char memory[COUNT][BITS]; /* the bits of a field, for each processor */

static CM_field_id_t field;  /* of BITS bits */
static memory model, before; /* what is in it, and was */
static number active[COUNT];

static void write_model(void)
{
    for (int at = 0; at < BITS; at += 100) {
        number numbers[COUNT] = {0};
        for (int i = 0; i < COUNT; i++)
            for (int k = 0; k < 100; k++)
                numbers[i] |= (number)model[i][at + k] << k;
        device_put(field + (CM_field_id_t)at, 100, numbers);
    }
}

static void begin(void)
{
    number bits[COUNT];
    CM_set_context();
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < BITS; k++)
            model[i][k] = device_random() >> 20 & 1;
    write_model();
    device_mask(active, 2);
    memcpy(bits, active, sizeof bits);
    CM_field_id_t f = CM_allocate_stack_field(1);
    device_put(f, 1, bits);
    CM_load_context(f);
    CM_deallocate_stack_through(f);
}

/* Copies the field's pieces in one evaluation, then downloads them: each download of bits that
 * were stored in other pieces would need a kernel. */
static void expect(const char *what)
{
    enum { PIECES = BITS / 100 };
    CM_field_id_t copies[PIECES];
    for (int p = 0; p < PIECES; p++) {
        copies[p] = CM_allocate_stack_field(100);
        CM_u_move_always_1L(copies[p], field + (CM_field_id_t)(100 * p), 100);
    }
    assert_int_equal(machine_finish(paris_machine()), MACHINE_OK);
    for (int p = 0; p < PIECES; p++) {
        number numbers[COUNT];
        device_get(copies[p], 100, numbers);
        for (int i = 0; i < COUNT; i++)
            for (int k = 0; k < 100; k++)
                if ((numbers[i] >> k & 1) != model[i][100 * p + k])
                    fail_msg("%s: processor %d, bit %d", what, i, 100 * p + k);
    }
    CM_deallocate_stack_through(copies[0]);
}

enum { MOVE, REVERSED, SWAP, XOR, NOT };

/* Carries out an operation on the model; dest, source and other are bit numbers. */
static void model_do(int what, int dest, int source, int other, int len, bool always)
{
    memcpy(before, model, sizeof before);
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < len && (active[i] || always); k++) {
            const unsigned char *b = before[i];
            unsigned char *m = model[i];
            m[dest + k] = what == REVERSED ? b[source + len - 1 - k]
                          : what == XOR    ? b[source + k] ^ b[other + k]
                          : what == NOT    ? !b[source + k]
                                           : b[source + k];
            if (what == SWAP)
                m[source + k] = b[dest + k];
        }
}

#define AT(k) (field + (CM_field_id_t)(k))

static void long_fields_are_the_oracles(void **unused)
{
    (void)unused;
    begin();
    CM_s_move_1L(AT(300), AT(10), 290);
    model_do(MOVE, 300, 10, 0, 290, false);
    CM_u_move_always_1L(AT(0), AT(400), 131);
    model_do(MOVE, 0, 400, 0, 131, true);
    CM_logxor_3_1L(AT(350), AT(3), AT(170), 150);
    model_do(XOR, 350, 3, 170, 150, false);
    CM_logxor_always_2_1L(AT(0), AT(300), 200);
    model_do(XOR, 0, 0, 300, 200, true);
    CM_lognot_1_1L(AT(100), 300);
    model_do(NOT, 100, 100, 0, 300, false);
    CM_lognot_1_1L(AT(100), 0);
    CM_u_move_zero_always_1L(AT(100), 0);
    CM_u_move_zero_always_1L(AT(100), 250);
    for (int i = 0; i < COUNT; i++)
        memset(&model[i][100], 0, 250);
    CM_u_move_2L(AT(500), AT(99), 190, 5);
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 190 && active[i]; k++)
            model[i][500 + k] = k < 5 ? model[i][99 + k] : 0;
    CM_s_move_2L(AT(200), AT(40), 180, 7);
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 180 && active[i]; k++)
            model[i][200 + k] = model[i][40 + (k < 7 ? k : 6)];
    expect("zeros and longer fields");
}

static void overlapping_moves_read_first(void **unused)
{
    (void)unused;
    begin();
    CM_u_move_1L(AT(37), AT(0), 600);
    model_do(MOVE, 37, 0, 0, 600, false);
    CM_s_move_always_1L(AT(1), AT(90), 600);
    model_do(MOVE, 1, 90, 0, 600, true);
    CM_logxor_2_1L(AT(65), AT(0), 400);
    model_do(XOR, 65, 65, 0, 400, false);
    CM_lognot_2_1L(AT(20), AT(10), 100);
    model_do(NOT, 20, 10, 0, 100, false);
    expect("short ones");
}

static void swapped_and_reversed_fields_are_the_oracles(void **unused)
{
    static const int lengths[] = {1, 7, 32, 64, 65, 128, 129, 300};
    (void)unused;
    begin();
    for (int k = 0; k < 8; k++) {
        int len = lengths[k];
        CM_swap_2_1L(AT(350), AT(11), (unsigned int)len);
        model_do(SWAP, 350, 11, 0, len, false);
        CM_swap_always_2_1L(AT(0), AT(400), (unsigned int)len);
        model_do(SWAP, 0, 400, 0, len, true);
        CM_move_reversed_1L(AT(355), AT(5), (unsigned int)len);
        model_do(REVERSED, 355, 5, 0, len, false);
        CM_u_move_reversed_always_1L(AT(2), AT(2), (unsigned int)len);
        model_do(REVERSED, 2, 2, 0, len, true);
        if (k % 4 == 3)
            expect("swapped and reversed");
    }
    CM_move_reversed_1L(AT(100), AT(50), 200);
    model_do(REVERSED, 100, 50, 0, 200, false);
    CM_swap_2_1L(AT(0), AT(0), 0);
    expect("a reversed field that overlaps");
}

static void bits_move_in_safety_mode(void **unused)
{
    (void)unused;
    begin();
    CM_set_safety_mode(1);
    CM_s_move_1L(AT(600), AT(13), 1);
    model_do(MOVE, 600, 13, 0, 1, false);
    CM_s_move_always_1L(AT(100), AT(300), 129);
    model_do(MOVE, 100, 300, 0, 129, true);
    expect("in safety mode");
    device_message[0] = 0;
    CM_s_truncate_2_1L(AT(0), AT(40), 1);
    assert_string_equal(device_message,
                        "CM_s_truncate_2_1L: dest: length must be 2..128 bits (got 1)");
    CM_u_rem_2_1L(AT(0), AT(40), 129);
    assert_string_equal(device_message,
                        "CM_u_rem_2_1L: dest: length must be 1..128 bits (got 129)");
    paris_safety_usual();
    CM_s_s_shift_2_2L(AT(0), AT(40), 32, 0);
    assert_string_equal(device_message,
                        "CM_s_s_shift_2_2L: source2: length must be 2..128 bits (got 0)");
    CM_swap_2_1L(AT(0), AT(40), 50);
    assert_string_equal(device_message,
                        "CM_swap_2_1L: fields that overlap in part cannot change "
                        "places");
    CM_aref_2L(AT(0), AT(40), AT(300), 33, 8, 4, 32);
    assert_string_equal(device_message,
                        "CM_aref_2L: dest: has 33 bits, but an element only 32");
    expect("what is wrong has no effect");
}

/* ---- arrays in each processor ---- */

static number at_index(const number *array, int stride, number index, int i)
{
    return array[(size_t)index * (size_t)stride + (size_t)i];
}

static void arrays_are_the_oracles(void **unused)
{
    enum { ELEMENTS = 37, LIMIT = 35, LEN = 32, SHORT = 19 };
    static number array[ELEMENTS][COUNT];
    number index[COUNT], dest[COUNT], source[COUNT], got[COUNT];
    (void)unused;
    begin();
    CM_field_id_t a = CM_allocate_stack_field(ELEMENTS * LEN), x = CM_allocate_stack_field(7),
                  d = CM_allocate_stack_field(64), e = CM_allocate_stack_field(64);
    for (int k = 0; k < ELEMENTS; k++) {
        device_integers(array[k], LEN);
        device_put(a + (CM_field_id_t)(k * LEN), LEN, array[k]);
    }
    for (int i = 0; i < COUNT; i++)
        index[i] = device_random() % 43;
    device_integers(dest, 64);
    device_put(x, 7, index);
    device_put(d, 64, dest);
    device_put(e, 64, dest);
    CM_aref_2L(d, a, x, LEN, 7, LIMIT, LEN);
    CM_aref_2L(e, a, x, SHORT, 7, LIMIT, LEN);
    for (int pass = 0; pass < 2; pass++) {
        int len = pass ? SHORT : LEN;
        device_get(pass ? e : d, 64, got);
        for (int i = 0; i < COUNT; i++) {
            number wanted = dest[i], mask = oracle_mask(len);
            if (active[i] && index[i] < LIMIT)
                wanted = (wanted & ~mask) | (at_index(array[0], COUNT, index[i], i) & mask);
            assert_true(got[i] == wanted);
        }
    }
    device_integers(source, 64);
    device_put(d, 64, source);
    CM_aset_2L(d, a, x, LEN, 7, LIMIT, LEN);
    CM_aset32_2L(d + 32, a, x, LEN, 3, 8); /* by the index's low bits */
    for (int i = 0; i < COUNT; i++) {
        if (active[i] && index[i] < LIMIT)
            array[index[i]][i] = source[i] & oracle_mask(LEN);
        if (active[i])
            array[index[i] & 7][i] = source[i] >> 32;
    }
    for (int k = 0; k < ELEMENTS; k++) {
        device_get(a + (CM_field_id_t)(k * LEN), LEN, got);
        assert_memory_equal(got, array[k], sizeof got);
    }
    CM_transpose32_1_1L(a, ELEMENTS * LEN);
    CM_aref32_2L(e, a, x, LEN, 7, 127); /* beyond the array no test follows */
    CM_deallocate_stack_through(a);
}

/* 64 processors: two groups of 32, with a VP ratio of 2. */
static void shared_arrays_are_shared_by_32(void **unused)
{
    enum { PROCESSORS = 64, RATIO = 2, ELEMENTS = 70, ROWS_OF_IT = 3, LEN = 32 };
    struct machine_config config = machine_config_default();
    int dimensions[1] = {PROCESSORS * RATIO};
    uint32_t index[PROCESSORS * RATIO], value[PROCESSORS * RATIO], got[PROCESSORS * RATIO];
    uint32_t model_of[RATIO][2][ELEMENTS] = {0};
    (void)unused;
    config.processors_count = PROCESSORS;
    assert_true(paris_reset(&config));
    CM_set_error_handler(device_error_catch);
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = dimensions}, 1)));
    CM_field_id_t a = CM_allocate_heap_field(ROWS_OF_IT * LEN), x = CM_allocate_heap_field(32),
                  d = CM_allocate_heap_field(32), address = CM_allocate_heap_field(32);
    CM_my_send_address(address);
    uint32_t send[PROCESSORS * RATIO];
    machine_field_download(paris_machine(), address, MACHINE_UINT(32), send);
    for (int turn = 0; turn < 4; turn++) {
        for (int i = 0; i < PROCESSORS * RATIO; i++) {
            index[i] = (uint32_t)(device_random() % (ELEMENTS + 2));
            value[i] = (uint32_t)device_random();
        }
        machine_field_upload(paris_machine(), x, MACHINE_UINT(32), index);
        machine_field_upload(paris_machine(), d, MACHINE_UINT(32), value);
        CM_u_lt_constant_1L(address, 100, 32);
        CM_load_context(address + 3);
        CM_aset32_shared_2L(d, a, x, LEN, 32, ELEMENTS);
        for (int i = 0; i < PROCESSORS * RATIO; i++)
            if (send[i] >> 3 & 1 && index[i] < ELEMENTS)
                model_of[send[i] % RATIO][send[i] / RATIO / 32][index[i]] = value[i];
        for (int i = 0; i < PROCESSORS * RATIO; i++)
            index[i] = (uint32_t)(device_random() % (ELEMENTS + 2));
        machine_field_upload(paris_machine(), x, MACHINE_UINT(32), index);
        CM_invert_context();
        CM_aref32_shared_2L(d, a, x, LEN, 32, ELEMENTS);
        machine_field_download(paris_machine(), d, MACHINE_UINT(32), got);
        for (int i = 0; i < PROCESSORS * RATIO; i++) {
            uint32_t wanted = value[i];
            if (!(send[i] >> 3 & 1) && index[i] < ELEMENTS)
                wanted = model_of[send[i] % RATIO][send[i] / RATIO / 32][index[i]];
            assert_int_equal(got[i], wanted);
        }
        CM_set_context();
    }
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    field = CM_allocate_heap_field(BITS);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_fields_are_the_oracles),
        cmocka_unit_test(overlapping_moves_read_first),
        cmocka_unit_test(swapped_and_reversed_fields_are_the_oracles),
        cmocka_unit_test(bits_move_in_safety_mode),
        cmocka_unit_test(arrays_are_the_oracles),
        cmocka_unit_test(shared_arrays_are_shared_by_32),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
