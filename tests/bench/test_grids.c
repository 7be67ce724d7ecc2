/* test_grids.c - Life and heat in Paris and in C with OpenMP give the bits of a plain double
 * loop. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "grids.h"
#include "harness.h"
#include "paris_internal.h"

enum { CELLS_MAX = 16384, STEPS = 7 };

static const int sizes[][2] = {{128, 5}, {100, 37}, {3, 3}};

enum { SIZES_COUNT = sizeof sizes / sizeof *sizes };

static void machine_renew(void)
{
    struct machine_config config = machine_config_default();

    assert_true(paris_reset(&config));
}

static void fields_pass(grid_field field, bool up, struct machine_type type, void *cells)
{
    assert_int_equal(up ? machine_field_upload(paris_machine(), field, type, cells)
                        : machine_field_download(paris_machine(), field, type, cells),
                     MACHINE_OK);
}

/* ---- Life ---- */

static void life_plain(const uint8_t *old, uint8_t *now, int width, int height)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int sum = 0;

            for (int dy = -1; dy <= 1; dy++)
                for (int dx = -1; dx <= 1; dx++)
                    if (dx || dy)
                        sum +=
                            old[(y + dy + height) % height * width + (x + dx + width) % width];
            now[y * width + x] = sum == 3 || (sum == 2 && old[y * width + x]);
        }
}

static void life_agrees(void **state)
{
    static uint8_t cells[2][CELLS_MAX], mine[CELLS_MAX];

    (void)state;
    for (int n = 0; n < SIZES_COUNT; n++) {
        int width = sizes[n][0], height = sizes[n][1];
        size_t count = (size_t)width * (size_t)height;
        struct life_paris paris;

        for (size_t i = 0; i < count; i++)
            cells[0][i] = (i * 2654435761u >> 7) % 5 < 2;
        machine_renew();
        life_paris_allocate(&paris, width, height);
        fields_pass(paris.alive, true, MACHINE_UINT(1), cells[0]);
        struct grid_openmp *bytes = life_openmp_create(width, height, cells[0]);
        struct grid_openmp *bits =
            width % 64 ? NULL : life_bits_create(width, height, cells[0]);
        assert_non_null(bytes);
        for (int step = 0; step < STEPS; step++) {
            life_plain(cells[step % 2], cells[1 - step % 2], width, height);
            life_paris_step(&paris);
            assert_int_equal(machine_flush(paris_machine()), MACHINE_OK);
        }
        fields_pass(paris.alive, false, MACHINE_UINT(1), mine);
        assert_memory_equal(mine, cells[STEPS % 2], count);
        life_openmp_steps(bytes, STEPS);
        life_openmp_read(bytes, mine);
        assert_memory_equal(mine, cells[STEPS % 2], count);
        if (width % 64 == 0) {
            assert_non_null(bits);
            life_bits_steps(bits, STEPS);
            life_bits_read(bits, mine);
            assert_memory_equal(mine, cells[STEPS % 2], count);
        }
        grid_openmp_destroy(bytes);
        grid_openmp_destroy(bits);
    }
}

static void life_bits_of_part_of_a_word_are_refused(void **state)
{
    uint8_t cells[65 * 3] = {0};

    (void)state;
    assert_null(life_bits_create(65, 3, cells));
    assert_non_null(strstr(bench_error(), "multiple of 64 (got 65)"));
}

/* ---- heat ---- */

static void heat_plain(const float *old, float *now, int width, int height)
{
    memcpy(now, old, (size_t)width * (size_t)height * sizeof *now);
    for (int y = 1; y < height - 1; y++)
        for (int x = 1; x < width - 1; x++) {
            const float *h = old + y * width + x;
            float corners = h[width + 1] + h[width - 1];
            float t = h[width] + h[-width];

            corners += h[1 - width];
            corners += h[-1 - width];
            t += h[1];
            t += h[-1];
            t *= 4.0f;
            t += corners;
            t -= *h * 20.0f;
            t *= (float)HEAT_RATE;
            now[y * width + x] = *h + t;
        }
}

static void heat_agrees(void **state)
{
    static float cells[2][CELLS_MAX], mine[CELLS_MAX];

    (void)state;
    for (int n = 0; n < SIZES_COUNT; n++) {
        int width = sizes[n][0], height = sizes[n][1];
        size_t count = (size_t)width * (size_t)height, bytes = count * sizeof(float);
        struct heat_paris paris;

        for (size_t i = 0; i < count; i++)
            cells[0][i] = (float)((i * 2654435761u >> 8) & 0xffff) / 65536.0f;
        machine_renew();
        heat_paris_allocate(&paris, width, height);
        fields_pass(paris.heat, true, MACHINE_F32, cells[0]);
        struct grid_openmp *openmp = heat_openmp_create(width, height, cells[0]);
        assert_non_null(openmp);
        for (int step = 0; step < STEPS; step++) {
            heat_plain(cells[step % 2], cells[1 - step % 2], width, height);
            heat_paris_step(&paris);
            assert_int_equal(machine_flush(paris_machine()), MACHINE_OK);
        }
        fields_pass(paris.heat, false, MACHINE_F32, mine);
        assert_memory_equal(mine, cells[STEPS % 2], bytes);
        heat_openmp_steps(openmp, 3);
        heat_openmp_steps(openmp, STEPS - 3);
        heat_openmp_read(openmp, mine);
        assert_memory_equal(mine, cells[STEPS % 2], bytes);
        grid_openmp_destroy(openmp);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(life_agrees),
        cmocka_unit_test(life_bits_of_part_of_a_word_are_refused),
        cmocka_unit_test(heat_agrees),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
