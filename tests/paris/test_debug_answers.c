/* test_debug_answers.c - what a debugger is told of fields and flags, by both ways of looking:
 * in a child of fork(), and in the process itself, as where the device has memory of its own.
 * Both tell what the program reads, and neither changes a bit of what it computes.
 *
 * For the second way the device is said not to be PoCL's while it is asked; with
 * LUTETIA_NEAR=0, which the test is run with, too, its memory is read by the driver alone. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/parts.h"
#include "debug.h"
#include "device.h"
#include "device/device.h"
#include "paris_state.h"

enum way { BY_CHILD, BY_ITSELF, WAYS, NOT = WAYS };

/* An answer begins so: debug.h. */
struct answer {
    uint64_t bytes, text_bytes;
    char text[];
};

static struct asked {
    char text[1000];
    uint8_t arrays[COUNT * 17];
    size_t arrays_bytes;
} asked[WAYS];

static enum way way_set(enum way way)
{
    static bool is_pocl;
    struct device *d = paris_the.machine->device;
    is_pocl = is_pocl || d->is_pocl;
    d->is_pocl = is_pocl && way == BY_CHILD;
    return way;
}

static void keep(struct asked *into, const void *told)
{
    const struct answer *a = told;
    unsigned long at = 0;
    assert_non_null(a);
    assert_true(a->text_bytes < sizeof into->text);
    memcpy(into->text, a->text, a->text_bytes);
    into->text[a->text_bytes] = '\0';
    const char *place = strstr(into->text, "\"at\": ");
    into->arrays_bytes = 0;
    if (!place)
        return;
    assert_int_equal(sscanf(place, "\"at\": %lu", &at), 1);
    assert_true(at < a->bytes && a->bytes - at <= sizeof into->arrays);
    into->arrays_bytes = a->bytes - at;
    memcpy(into->arrays, (const char *)told + at, into->arrays_bytes);
}

/* Asks both ways; the answers are the same. */
static const struct asked *field_asked(CM_field_id_t field, char letter, unsigned int len,
                                       unsigned int e)
{
    for (enum way way = BY_CHILD; way < WAYS; way++) {
        way_set(way);
        keep(&asked[way], CM_debug_field(field, (unsigned char)letter, len, e));
        way_set(BY_CHILD);
    }
    assert_string_equal(asked[BY_CHILD].text, asked[BY_ITSELF].text);
    assert_int_equal(asked[BY_CHILD].arrays_bytes, asked[BY_ITSELF].arrays_bytes);
    assert_memory_equal(asked[BY_CHILD].arrays, asked[BY_ITSELF].arrays,
                        asked[BY_CHILD].arrays_bytes);
    return &asked[BY_CHILD];
}

/* Of each width: the context, then the numbers that were written, whatever waits. */
static void values_are_those_that_the_program_has(void **unused)
{
    static const int widths[] = {1, 5, 8, 12, 24, 32, 33, 64, 100, 128};
    number numbers[COUNT], mask[COUNT], one[COUNT];
    (void)unused;
    device_seed(11);
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        const int width = widths[i];
        const CM_field_id_t field = CM_allocate_heap_field((unsigned int)width),
                            active = CM_allocate_heap_field(1);
        device_integers(numbers, width);
        device_mask(mask, (int)i);
        device_put(active, 1, mask);
        device_put(field, width, numbers);
        CM_set_context();
        CM_lognot_1_1L(field, (unsigned int)width); /* waits */
        CM_load_context(active);
        const struct asked *a = field_asked(field, 'u', (unsigned int)width, 0);
        const size_t element = (a->arrays_bytes - COUNT) / COUNT;
        assert_non_null(strstr(a->text, "\"axes\": [5, 13]"));
        for (int k = 0; k < COUNT; k++) {
            const number all = width == 128 ? ~(number)0 : ((number)1 << width) - 1;
            one[k] = 0;
            memcpy(&one[k], a->arrays + COUNT + (size_t)k * element, element);
            assert_int_equal(a->arrays[k], mask[k]);
            assert_true(one[k] == (~numbers[k] & all));
        }
        CM_set_context();
        CM_deallocate_heap_field(active);
        CM_deallocate_heap_field(field);
    }
}

static void floats_and_flags(void **unused)
{
    (void)unused;
    const CM_field_id_t f = CM_allocate_heap_field(32), mark = CM_allocate_heap_field(1);
    float value;
    CM_set_context();
    CM_u_move_constant_1L(f, 7, 32);
    CM_f_u_float_2_2L(f, f, 32, 23, 8);
    CM_f_divide_constant_2_1L(f, 4.0, 23, 8);
    const struct asked *a = field_asked(f, '\0', 0, 0);
    memcpy(&value, a->arrays + COUNT, sizeof value);
    assert_non_null(strstr(a->text, "\"letter\": \"f\""));
    assert_true(value == 1.75f);
    CM_f_gt_constant_1L(f, 1.0, 23, 8);
    CM_store_test(mark);
    for (enum way way = BY_CHILD; way < WAYS; way++) {
        way_set(way);
        keep(&asked[way], CM_debug_flag(MACHINE_TEST));
        way_set(BY_CHILD);
        assert_int_equal(asked[way].arrays_bytes, COUNT);
        for (int k = 0; k < COUNT; k++)
            assert_int_equal(asked[way].arrays[k], 1);
    }
    assert_non_null(strstr(field_asked(f, 'u', 200, 0)->text, "\"error\": "));
    assert_non_null(strstr(field_asked(f + 1, 'u', 32, 0)->text, "\"error\": "));
}

/* Sixty steps, with a look at every third; the sum. */
static double steps_taken(enum way way)
{
    device_start(-1);
    const CM_field_id_t heat = CM_allocate_heap_field(32), near = CM_allocate_heap_field(32);
    CM_set_context();
    CM_initialize_random_generator(5);
    CM_f_random_1L(heat, 23, 8);
    for (int i = 0; i < 60; i++) {
        CM_get_from_news_1L(near, heat, 1, CM_upward, 32);
        CM_f_subtract_2_1L(near, heat, 23, 8);
        CM_f_multiply_constant_2_1L(near, 0.25, 23, 8);
        CM_f_gt_zero_1L(near, 23, 8);
        CM_logand_context_with_test();
        CM_f_add_2_1L(heat, near, 23, 8);
        CM_set_context();
        if (way == NOT || i % 3)
            continue;
        way_set(way);
        keep(&asked[way], CM_debug_field(i % 2 ? heat : near, 'f', 23, 8));
        way_set(BY_CHILD);
        assert_int_equal(asked[way].arrays_bytes, COUNT * 5);
    }
    return CM_global_f_add_1L(heat, 23, 8);
}

/* A program that ignores, or handles, its children's ends is looked at, and told of none. */
static volatile sig_atomic_t ends_told;

static void end_take(int of)
{
    (void)of;
    ends_told++;
}

static void programs_with_children(void **unused)
{
    (void)unused;
    const CM_field_id_t f = CM_allocate_heap_field(8);
    void (*const handlers[])(int) = {SIG_IGN, end_take, SIG_DFL};
    CM_set_context();
    for (int i = 0; i < 3; i++) {
        signal(SIGCHLD, handlers[i]);
        CM_u_move_constant_1L(f, (unsigned long)i + 40, 8);
        assert_int_equal(field_asked(f, 'u', 8, 0)->arrays[COUNT], i + 40);
        assert_true(signal(SIGCHLD, SIG_DFL) == handlers[i]);
    }
    assert_int_equal(ends_told, 0);
}

static void nothing_that_is_computed_changes(void **unused)
{
    (void)unused;
    const double plain = steps_taken(NOT);
    assert_true(plain > 0);
    assert_true(steps_taken(BY_CHILD) == plain);
    assert_true(steps_taken(BY_ITSELF) == plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(values_are_those_that_the_program_has, device_setup),
        cmocka_unit_test_setup(floats_and_flags, device_setup),
        cmocka_unit_test_setup(programs_with_children, device_setup),
        cmocka_unit_test(nothing_that_is_computed_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
