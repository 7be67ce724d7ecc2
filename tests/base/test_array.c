/* test_array.c - arrays that grow by doubling. */
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <array.h>

static void elements_stay_as_the_array_grows(void **state)
{
    (void)state;
    int *items = NULL, capacity = 0, grown = 0;
    for (int count = 0; count < 10000; count++) {
        int before = capacity;
        assert_true(array_reserve(&items, &capacity, count + 1, sizeof *items));
        assert_true(capacity > count && (capacity == before || capacity >= 2 * before));
        grown += capacity != before;
        items[count] = 3 * count;
    }
    for (int i = 0; i < 10000; i++)
        assert_int_equal(items[i], 3 * i);
    assert_int_equal(grown, 11); /* 16 to 16384 */
    free(items);
}

static void room_that_is_there_is_left_alone(void **state)
{
    (void)state;
    char *items = NULL, *before;
    int capacity = 0;
    assert_true(array_reserve(&items, &capacity, 100, 1));
    assert_true(capacity >= 100);
    before = items;
    int was = capacity;
    assert_true(array_reserve(&items, &capacity, was, 1));
    assert_true(array_reserve(&items, &capacity, 0, 1));
    assert_ptr_equal(items, before);
    assert_int_equal(capacity, was);
    free(items);
}

static void what_cannot_be_had_changes_nothing(void **state)
{
    (void)state;
    double *items = NULL;
    int capacity = 0;
    assert_true(array_reserve(&items, &capacity, 1, sizeof *items));
    double *before = items;
    int was = capacity;
    items[0] = 0.5;
    assert_false(array_reserve(&items, &capacity, INT_MAX, SIZE_MAX / 2));
    assert_ptr_equal(items, before);
    assert_int_equal(capacity, was);
    assert_true(items[0] == 0.5);
    free(items);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_stay_as_the_array_grows),
        cmocka_unit_test(room_that_is_there_is_left_alone),
        cmocka_unit_test(what_cannot_be_had_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
