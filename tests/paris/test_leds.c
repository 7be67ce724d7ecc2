/* The lights: which processors each light shows, and the recording of LUTETIA_LEDS. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "device.h"

#define V(v) ((CM_vector_t){.ints = v})

enum { LINE = 20, FRAME = 520 };

static CM_field_id_t bit_make(const int *dimensions, unsigned int rank, uint8_t *bits,
                              uint64_t count)
{
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(V(dimensions), rank)));
    CM_field_id_t field = CM_allocate_heap_field(1);
    for (uint64_t i = 0; i < count; i++)
        bits[i] = device_random() % 3 == 0;
    assert_int_equal(machine_field_upload(paris_machine(), field, MACHINE_BIT, bits),
                     MACHINE_OK);
    return field;
}

static bool on(const uint8_t *lights, int l)
{
    return lights[l / 8] >> l % 8 & 1;
}

/* Compares the lights with their definition: a light is on if any of its processors' bits is
 * set. */
static void lights_stand_for_patches_of_the_set(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{64, 64, 1}, {256, 128, 1}, {5, 13, 1}, {100, 77, 1},
                                    {3, 7, 65},  {1, 4096, 1},  {1, 9, 1},  {1, 70000, 1}};
    for (size_t c = 0; c < sizeof shapes / sizeof *shapes; c++) {
        int three = shapes[c][2] > 1, line = shapes[c][0] == 1;
        unsigned int rank = three ? 3 : line ? 1 : 2;
        uint64_t columns = (uint64_t)shapes[c][three ? 2 : 1];
        uint64_t rows = (uint64_t)(three ? shapes[c][0] * shapes[c][1] : shapes[c][0]);
        uint64_t side = line ? 4096 : 64;
        uint8_t *bits = malloc(rows * columns), lights[PARIS_LIGHTS_BYTES],
                expected[4096] = {0};
        CM_latch_leds_always(bit_make(shapes[c] + line, rank, bits, rows * columns));
        for (uint64_t l = 0; l < 4096; l++)
            for (uint64_t r = l / side * rows / side, r0 = r;
                 r == r0 || r < (l / side + 1) * rows / side; r++)
                for (uint64_t k = l % side * columns / side, k0 = k;
                     k == k0 || k < (l % side + 1) * columns / side; k++)
                    expected[l] |= bits[r * columns + k];
        assert_true(paris_lights_read(lights));
        for (int l = 0; l < 4096; l++)
            if (on(lights, l) != expected[l])
                fail_msg("shape %zu: light %d is %d", c, l, on(lights, l));
        free(bits);
    }
}

static size_t file_bytes(const char *path, uint8_t *bytes, size_t limit)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t count = fread(bytes, 1, limit, file);
    fclose(file);
    return count;
}

static uint64_t time_of(const uint8_t *frame)
{
    uint64_t t = 0;
    for (int i = 0; i < 8; i++)
        t |= (uint64_t)frame[i] << 8 * i;
    return t;
}

/* Each latch records one frame. Inactive processors keep their lights. The system's patterns
 * replace the lights, and return them afterwards. A program has one recording, so one test
 * checks all of it. */
static void latches_are_recorded(void **unused)
{
    (void)unused;
    static uint8_t bytes[64 * FRAME], bits[3][4096];
    static const int shape[2] = {64, 64};
    const char *path = scratch_path("lights");
    setenv("LUTETIA_LEDS", path, 1);
    CM_field_id_t f[3];
    f[0] = bit_make(shape, 2, bits[0], 4096);
    for (int i = 1; i < 3; i++) {
        f[i] = CM_allocate_heap_field(1);
        for (int k = 0; k < 4096; k++)
            bits[i][k] = device_random() % 2 == 0;
        machine_field_upload(paris_machine(), f[i], MACHINE_BIT, bits[i]);
    }
    CM_latch_leds(f[0]);
    CM_load_context(f[1]);
    CM_latch_leds(f[2]); /* where f[1] */
    CM_set_system_leds_mode(PARIS_PATTERN_RANDOM);
    assert_int_equal(CM_system_leds_mode(), PARIS_PATTERN_RANDOM);
    CM_latch_leds_always(f[2]);
    CM_set_system_leds_mode(0);
    size_t count = file_bytes(path, bytes, sizeof bytes);
    assert_int_equal(count, LINE + 5 * FRAME);
    assert_memory_equal(bytes, "lutetia leds 1 4096\n", LINE);
    uint8_t *frames = bytes + LINE;
    for (int l = 0; l < 4096; l++) {
        assert_int_equal(on(frames + 8, l), bits[0][l]);
        assert_int_equal(on(frames + FRAME + 8, l), bits[1][l] ? bits[2][l] : bits[0][l]);
        assert_int_equal(on(frames + 4 * FRAME + 8, l), bits[2][l]);
    }
    /* The pattern's rows have moved by one light, even rows to the right and odd rows to the
     * left. */
    const uint8_t *one = frames + 2 * FRAME + 8, *two = frames + 3 * FRAME + 8;
    int lit = 0;
    for (int row = 0; row < 64; row++)
        for (int column = 0; column < 63; column++) {
            int l = row * 64 + column;
            lit += on(one, l);
            assert_int_equal(on(two, row % 2 ? l : l + 1), on(one, row % 2 ? l + 1 : l));
        }
    assert_in_range(lit, 800, 1300); /* about a quarter */
    for (int i = 1; i < 5; i++)
        assert_true(time_of(frames + i * FRAME) >= time_of(frames + (i - 1) * FRAME));
    unsetenv("LUTETIA_LEDS");
    CM_latch_leds_always(f[0]);
    assert_int_equal(file_bytes(path, bytes, sizeof bytes), count);
}

static void wrong_modes_are_refused(void **unused)
{
    (void)unused;
    device_message[0] = '\0';
    CM_set_system_leds_mode(8);
    device_said("CM_set_system_leds_mode", "mode");
    assert_int_equal(CM_system_leds_mode(), 0);
    uint8_t lights[PARIS_LIGHTS_BYTES];
    struct paris_pattern pattern = paris_pattern_begin(PARIS_PATTERN_ON);
    paris_pattern_step(&pattern, lights);
    for (int i = 0; i < PARIS_LIGHTS_BYTES; i++)
        assert_int_equal(lights[i], 255);
}

static int start(void **unused)
{
    (void)unused;
    unsetenv("LUTETIA_LEDS");
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_stand_for_patches_of_the_set),
        cmocka_unit_test(latches_are_recorded),
        cmocka_unit_test(wrong_modes_are_refused),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
