/* test_kit.c - Paris's error messages as a status, and grids against plain loops. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <kit.h>
#include <kit_float.h>
#include <kit_grid.h>

enum { WIDTH = 13, HEIGHT = 5, COUNT = WIDTH * HEIGHT };

static struct kit_grid grid;
static CM_field_id_t a, b;
static float numbers[COUNT], out[COUNT];

static int grid_begin(void **state)
{
    (void)state;
    if (kit_attach() != KIT_OK)
        return -1;
    kit_grid_make(&grid, WIDTH, HEIGHT);
    a = CM_allocate_heap_field(KIT_FLOAT_BITS);
    b = CM_allocate_heap_field(KIT_FLOAT_BITS);
    for (int i = 0; i < COUNT; i++)
        numbers[i] = (float)(i * 37 % 11) * 0.75f - 3;
    kit_grid_f_write(&grid, a, numbers);
    return kit_leave() == KIT_OK ? 0 : -1;
}

static int grid_end(void **state)
{
    (void)state;
    kit_grid_free(&grid);
    kit_grid_free(&grid); /* zeros are fine */
    return 0;
}

/* ---- complaints ---- */

static void what_is_right_leaves_no_complaint(void **state)
{
    (void)state;
    kit_enter(grid.vp_set);
    kit_f_add(b, a, a);
    assert_int_equal(kit_leave(), KIT_OK);
    assert_int_equal(kit_finish(grid.vp_set), KIT_OK);
}

static void first_complaint_is_heard_and_the_rest_runs(void **state)
{
    (void)state;
    kit_enter(grid.vp_set);
    kit_f_set(b, 1);
    CM_f_add_2_1L(b, a, 99, 8);
    CM_u_add_2_1L(b, a, 999);
    kit_f_plus(b, b, 1);
    assert_int_equal(kit_leave(), KIT_WRONG_CALL);
    assert_int_equal(CM_error_status(), CM_error_call);
    assert_memory_equal(kit_error(), "CM_f_add_2_1L: ", 15);
    kit_enter(grid.vp_set);
    kit_grid_f_read(&grid, out, b);
    assert_int_equal(kit_leave(), KIT_OK);
    for (int i = 0; i < COUNT; i++)
        assert_true(out[i] == 2);
}

/* All fields together may have 2^31 bits. The machine's message for this does not mention
 * memory, but the status does. */
static void lack_of_room_is_a_status_whatever_the_words(void **state)
{
    (void)state;
    CM_field_id_t large[8];
    int count = 0;
    kit_enter(grid.vp_set);
    while (count < 8 && kit_leave() == KIT_OK)
        large[count++] = CM_allocate_heap_field(1u << 28);
    assert_int_equal(kit_leave(), KIT_NO_MEMORY);
    assert_int_equal(CM_error_status(), CM_error_memory);
    assert_null(strstr(kit_error(), "memory"));
    for (int i = 0; i < count - 1; i++)
        CM_deallocate_heap_field(large[i]);
    assert_int_equal(kit_finish(grid.vp_set), KIT_OK);
}

/* A grid that is too large: the error is the first message, not those of later calls without a
 * VP set. */
static void first_complaint_of_a_grid_is_its_size(void **state)
{
    (void)state;
    struct kit_grid large;
    kit_grid_make(&large, 1 << 20, 1 << 20);
    assert_int_equal(kit_leave(), KIT_WRONG_CALL);
    assert_memory_equal(kit_error(), "CM_create_geometry: ", 20);
    kit_grid_free(&large);
    assert_int_equal(kit_finish(grid.vp_set), KIT_OK);
}

/* ---- grids ---- */

static void coordinates_have_bits_for_the_last_one(void **state)
{
    (void)state;
    assert_int_equal(kit_coordinate_bits(1), 1);
    assert_int_equal(kit_coordinate_bits(2), 1);
    assert_int_equal(kit_coordinate_bits(3), 2);
    assert_int_equal(kit_coordinate_bits(1024), 10);
    assert_int_equal(kit_coordinate_bits(1025), 11);
    assert_int_equal(grid.x_bits, 4);
    assert_int_equal(grid.y_bits, 3);
}

static void coordinates_are_columns_and_rows(void **state)
{
    (void)state;
    uint32_t x[COUNT], y[COUNT];
    kit_enter(grid.vp_set);
    kit_grid_u_read(&grid, x, grid.x_coord, (unsigned)grid.x_bits, CM_32_bit);
    kit_grid_u_read(&grid, y, grid.y_coord, (unsigned)grid.y_bits, CM_32_bit);
    assert_int_equal(kit_leave(), KIT_OK);
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(x[i], i % WIDTH);
        assert_int_equal(y[i], i / WIDTH);
    }
}

static void narrow_is_a_rectangle_cut_off_at_the_edges(void **state)
{
    (void)state;
    static const int rectangles[][4] = {
        {0, 0, WIDTH, HEIGHT}, {3, 1, 7, 4}, {-4, -4, 2, 99},     {12, 4, 13, 5},
        {5, 2, 5, 4},          {5, 4, 9, 2}, {13, 0, 20, HEIGHT}, {1, 0, 99, 1},
    };
    for (size_t r = 0; r < sizeof rectangles / sizeof *rectangles; r++) {
        const int *at = rectangles[r];
        kit_enter(grid.vp_set);
        CM_set_context();
        kit_f_set(b, 0);
        kit_grid_narrow(&grid, at[0], at[1], at[2], at[3]);
        kit_f_set(b, 1);
        kit_grid_widen(&grid);
        kit_f_plus(b, b, 2); /* everywhere again */
        kit_grid_f_read(&grid, out, b);
        assert_int_equal(kit_leave(), KIT_OK);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                bool in = x >= at[0] && x < at[2] && y >= at[1] && y < at[3];
                assert_true(out[y * WIDTH + x] == (in ? 3 : 2));
            }
    }
}

static void unsigned_numbers_go_in_and_out(void **state)
{
    (void)state;
    uint8_t bytes[COUNT], back[COUNT];
    kit_enter(grid.vp_set);
    CM_field_id_t u = CM_allocate_heap_field(6);
    for (int i = 0; i < COUNT; i++)
        bytes[i] = (uint8_t)(i * 29 % 64);
    kit_grid_u_write(&grid, u, 6, bytes, CM_8_bit);
    kit_grid_u_read(&grid, back, u, 6, CM_8_bit);
    CM_deallocate_heap_field(u);
    assert_int_equal(kit_leave(), KIT_OK);
    assert_memory_equal(bytes, back, sizeof bytes);
}

/* ---- floats ---- */

enum operation {
    ADD,
    SUB,
    MUL,
    MIN,
    MAX,
    PLUS,
    TIMES,
    FROM,
    MOST,
    LEAST,
    WHOLE,
    COPY,
    NEXT,
    PREVIOUS
};

static float wanted(enum operation operation, int i)
{
    float x = numbers[i], y = x * 0.5f;
    int row = i / WIDTH * WIDTH;
    switch (operation) {
    case ADD:
        return x + y;
    case SUB:
        return x - y;
    case MUL:
        return x * y;
    case MIN:
        return x < y ? x : y;
    case MAX:
        return x > y ? x : y;
    case PLUS:
        return x + 1.5f;
    case TIMES:
        return x * -4;
    case FROM:
        return 10 - x;
    case MOST:
        return x < 1 ? x : 1;
    case LEAST:
        return x > 1 ? x : 1;
    case WHOLE:
        return nearbyintf(x);
    case COPY:
        return x;
    case NEXT:
        return numbers[row + (i - row + 1) % WIDTH];
    case PREVIOUS:
        return numbers[row + (i - row + WIDTH - 1) % WIDTH];
    }
    return -999;
}

static void compute(enum operation operation)
{
    kit_f_times(b, a, 0.5);
    switch (operation) {
    case ADD:
        kit_f_add(b, a, b);
        break;
    case SUB:
        kit_f_sub(b, a, b);
        break;
    case MUL:
        kit_f_mul(b, a, b);
        break;
    case MIN:
        kit_f_min(b, a, b);
        break;
    case MAX:
        kit_f_max(b, a, b);
        break;
    case PLUS:
        kit_f_plus(b, a, 1.5);
        break;
    case TIMES:
        kit_f_times(b, a, -4);
        break;
    case FROM:
        kit_f_from(b, 10, a);
        break;
    case MOST:
        kit_f_most(b, a, 1);
        break;
    case LEAST:
        kit_f_least(b, a, 1);
        break;
    case WHOLE:
        kit_f_copy(b, a);
        kit_f_whole(b);
        break;
    case COPY:
        kit_f_copy(b, a);
        break;
    case NEXT:
        kit_f_next(b, a, KIT_AXIS_X);
        break;
    case PREVIOUS:
        kit_f_previous(b, a, KIT_AXIS_X);
        break;
    }
}

static void short_names_are_their_paris_calls(void **state)
{
    (void)state;
    for (int operation = ADD; operation <= PREVIOUS; operation++) {
        kit_enter(grid.vp_set);
        CM_set_context();
        compute((enum operation)operation);
        kit_grid_f_read(&grid, out, b);
        assert_int_equal(kit_leave(), KIT_OK);
        for (int i = 0; i < COUNT; i++)
            if (out[i] != wanted((enum operation)operation, i))
                fail_msg("operation %d of %g (processor %d): %g, not %g", operation,
                         (double)numbers[i], i, (double)out[i],
                         (double)wanted((enum operation)operation, i));
    }
}

static void quotient_is_of_the_first_by_the_second(void **state)
{
    (void)state;
    kit_enter(grid.vp_set);
    kit_f_set(b, -8);
    kit_f_div(b, a, b);
    kit_grid_f_read(&grid, out, b);
    assert_int_equal(kit_leave(), KIT_OK);
    for (int i = 0; i < COUNT; i++)
        assert_true(out[i] == numbers[i] / -8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_right_leaves_no_complaint),
        cmocka_unit_test(first_complaint_is_heard_and_the_rest_runs),
        cmocka_unit_test(lack_of_room_is_a_status_whatever_the_words),
        cmocka_unit_test(first_complaint_of_a_grid_is_its_size),
        cmocka_unit_test(coordinates_have_bits_for_the_last_one),
        cmocka_unit_test(coordinates_are_columns_and_rows),
        cmocka_unit_test(narrow_is_a_rectangle_cut_off_at_the_edges),
        cmocka_unit_test(unsigned_numbers_go_in_and_out),
        cmocka_unit_test(short_names_are_their_paris_calls),
        cmocka_unit_test(quotient_is_of_the_first_by_the_second),
    };
    return cmocka_run_group_tests(tests, grid_begin, grid_end);
}
