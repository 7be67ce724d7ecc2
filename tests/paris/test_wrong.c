/* Wrong programs: each makes one mistake on a machine that has just been initialised. In safety
 * mode the message names the call and the argument in one line. Without safety mode the call
 * may give no message, and must not harm the host. In both cases the machine goes on working.
 * Child processes test programs without an error handler. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "../lutetia/child.h"
#include "paris_internal.h"
#include <cm/paris.h>

#define V(...) ((CM_vector_t){.ints = (const int[]){__VA_ARGS__}})
#define NONE ((CM_vector_t){.ints = NULL})
#define WILD 0x12345678u

/* ---- what programs begin with ---- */

static CM_field_id_t stack(unsigned int bits)
{
    return CM_allocate_stack_field(bits);
}

static CM_field_id_t heap(unsigned int bits)
{
    return CM_allocate_heap_field(bits);
}

static CM_vp_set_id_t set_of(int rows, int columns)
{
    return CM_allocate_vp_set(CM_create_geometry(V(rows, columns), 2));
}

static CM_field_id_t dead_heap(void)
{
    CM_field_id_t f = heap(32);
    CM_deallocate_heap_field(f);
    return f;
}

static CM_field_id_t dead_stack(void)
{
    CM_field_id_t f = stack(32);
    CM_deallocate_stack_through(f);
    return f;
}

static CM_field_id_t foreign(void)
{
    return CM_allocate_heap_field_vp_set(32, set_of(3, 5));
}

static CM_vp_set_id_t dead_set(void)
{
    CM_vp_set_id_t set = set_of(3, 5);
    CM_deallocate_vp_set(set);
    return set;
}

static CM_geometry_id_t dead_geometry(void)
{
    CM_geometry_id_t g = CM_create_geometry(V(3, 5), 2);
    CM_deallocate_geometry(g);
    return g;
}

static unsigned char array[4096];

/* ---- the programs ---- */

struct row {
    const char *call, *word; /* the beginning of the message, and a word in it */
    bool only_safe; /* without safety mode the call gives no message and does something else */
};

enum { FIRST = __COUNTER__ + 1 };

/* Returns wrong program number `which` in *row; run: also makes its calls. False: there is
 * none. */
static bool wrong(int which, bool run, struct row *row)
{
#define WRONG(name, word, only_safe, ...)                                                      \
    case __COUNTER__ - FIRST:                                                                  \
        *row = (struct row){#name, word, only_safe};                                           \
        if (run) {                                                                             \
            __VA_ARGS__;                                                                       \
        }                                                                                      \
        return true

    switch (which) {
        /* fields that were deallocated or never allocated */
        WRONG(CM_s_add_2_1L, "source", 0, CM_s_add_2_1L(stack(32), dead_heap(), 32));
        WRONG(CM_s_add_3_1L, "dest", 0, CM_s_add_3_1L(dead_stack(), heap(8), heap(8), 8));
        WRONG(CM_f_multiply_2_1L, "not a field", 0, CM_f_multiply_2_1L(WILD, stack(32), 23, 8));
        WRONG(CM_u_move_1L, "CM_no_field", 1, CM_u_move_1L(stack(8), CM_no_field, 8));
        WRONG(CM_logand_2_1L, "source2", 0, CM_logand_2_1L(stack(8), dead_heap(), 8));
        WRONG(CM_lognot_1_1L, "dest", 0, CM_lognot_1_1L((CM_field_id_t)-1, 8));
        WRONG(CM_u_eq_1L, "source2", 0, CM_u_eq_1L(stack(8), dead_stack(), 8));
        WRONG(CM_load_context, "source", 0, CM_load_context(CM_no_field));
        WRONG(CM_store_context, "dest", 0, CM_store_context(dead_heap()));
        WRONG(CM_set_bit, "dest", 0, CM_set_bit(WILD));
        WRONG(CM_latch_leds, "source", 0, CM_latch_leds(dead_heap()));
        WRONG(CM_f_s_float_2_2L, "source", 0,
              CM_f_s_float_2_2L(stack(32), dead_heap(), 32, 23, 8));
        WRONG(CM_get_from_news_1L, "source", 0,
              CM_get_from_news_1L(stack(8), dead_heap(), 0, 0, 8));
        WRONG(CM_my_send_address, "dest", 0, CM_my_send_address(dead_heap()));
        WRONG(CM_u_random_1L, "dest", 0, CM_u_random_1L(dead_heap(), 8, 4));
        WRONG(CM_global_s_add_1L, "source", 0, CM_global_s_add_1L(dead_heap(), 8));
        WRONG(CM_f_read_from_processor_1L, "source", 0,
              CM_f_read_from_processor_1L(0, CM_no_field, 23, 8));
        WRONG(CM_field_length, "field", 0, CM_field_length(dead_heap()));
        WRONG(CM_field_vp_set, "field", 0, CM_field_vp_set(WILD));
        WRONG(CM_is_stack_field_newer, "field", 0,
              CM_is_stack_field_newer(dead_stack(), stack(8)));
        WRONG(CM_add_offset_to_field_id, "field", 1, CM_add_offset_to_field_id(dead_heap(), 8));
        /* fields deallocated twice, in the wrong order, or by the wrong call */
        WRONG(CM_deallocate_heap_field, "heap", 0, CM_deallocate_heap_field(dead_heap()));
        WRONG(CM_deallocate_stack_through, "stack", 0,
              CM_deallocate_stack_through(dead_stack()));
        WRONG(CM_deallocate_heap_field, "heap", 0, CM_deallocate_heap_field(stack(8)));
        WRONG(CM_deallocate_stack_through, "stack", 0, CM_deallocate_stack_through(heap(8)));
        WRONG(CM_deallocate_heap_field, "heap", 0, CM_deallocate_heap_field(heap(32) + 8));
        WRONG(CM_deallocate_stack_through, "stack", 0, {
            CM_field_id_t first = stack(8), second = stack(8);
            CM_deallocate_stack_through(first);
            CM_deallocate_stack_through(second); /* went with the first */
        });
        WRONG(CM_deallocate_stack_through, "stack", 0,
              CM_deallocate_stack_through(CM_no_field));
        WRONG(CM_allocate_stack_field, "bits", 0, stack(0x80000000u));
        WRONG(CM_allocate_stack_field_vp_set, "vp_set", 0,
              CM_allocate_stack_field_vp_set(8, dead_set()));
        /* fields of another VP set; where they hold zeros, the call may pass without safety
         * mode */
        WRONG(CM_u_add_2_1L, "VP set", 0, CM_u_add_2_1L(stack(32), foreign(), 8));
        WRONG(CM_u_add_2_1L, "VP set", 0, CM_u_add_2_1L(foreign(), stack(32), 8));
        WRONG(CM_u_add_constant_2_1L, "VP set", 0, CM_u_add_constant_2_1L(foreign(), 1, 8));
        WRONG(CM_u_add_3_1L, "VP set", 0, {
            CM_field_id_t f = foreign();
            CM_u_add_3_1L(f, f, f, 8);
            CM_store_overflow(stack(1));
        });
        WRONG(CM_s_subtract_constant_2_1L, "VP set", 0, {
            CM_vp_set_id_t here = CM_current_vp_set;
            CM_set_vp_set(set_of(3, 5));
            CM_field_id_t f = heap(32);
            CM_my_news_coordinate_1L(f, 0, 32); /* not a constant: its set is known */
            CM_set_vp_set(here);
            CM_s_subtract_constant_2_1L(f, 1, 32);
            CM_store_overflow(stack(1));
        });
        WRONG(CM_load_test, "VP set", 0, CM_load_test(foreign()));
        WRONG(CM_f_lt_zero_1L, "VP set", 0, CM_f_lt_zero_1L(foreign(), 23, 8));
        WRONG(CM_global_u_max_1L, "VP set", 0, CM_global_u_max_1L(foreign(), 8));
        WRONG(CM_send_to_news_1L, "VP set", 0,
              CM_send_to_news_1L(foreign(), stack(8), 0, 0, 8));
        WRONG(CM_u_write_to_news_array_1L, "VP set", 0,
              CM_u_write_to_news_array_1L(array, V(0), V(0), V(2), V(0), foreign(), 8, 1, V(2),
                                          CM_8_bit));
        /* lengths */
        WRONG(CM_u_add_2_1L, "length", 0, CM_u_add_2_1L(stack(8), stack(8), 0));
        WRONG(CM_u_multiply_3_1L, "129", 0,
              CM_u_multiply_3_1L(stack(200), stack(200), heap(200), 129));
        WRONG(CM_s_add_2_1L, "2..128", 0, CM_s_add_2_1L(stack(8), stack(8), 1));
        WRONG(CM_s_max_3_3L, "length", 0, CM_s_max_3_3L(stack(8), stack(8), stack(8), 8, 0, 8));
        WRONG(CM_u_subtract_2_2L, "length", 0,
              CM_u_subtract_2_2L(stack(8), stack(8), 8, (unsigned)-8));
        WRONG(CM_f_add_2_1L, "significand", 0, CM_f_add_2_1L(stack(64), stack(64), 0, 8));
        WRONG(CM_f_add_2_1L, "exponent", 0, CM_f_add_2_1L(stack(64), stack(64), 23, 0));
        WRONG(CM_f_sqrt_1_1L, "60", 0, CM_f_sqrt_1_1L(stack(128), 60, 11));
        WRONG(CM_f_move_1L, "exponent", 0, CM_f_move_1L(stack(64), stack(64), 0xffffffffu, 8));
        WRONG(CM_s_f_floor_2_2L, "length", 0,
              CM_s_f_floor_2_2L(stack(32), stack(32), 0, 23, 8));
        WRONG(CM_u_add_constant_2_1L, "300", 1, CM_u_add_constant_2_1L(stack(8), 300, 8));
        WRONG(CM_s_move_constant_1L, "-129", 1, CM_s_move_constant_1L(stack(8), -129, 8));
        WRONG(CM_u_random_1L, "limit", 1, CM_u_random_1L(stack(8), 8, 257));
        /* beyond the end of a field */
        WRONG(CM_u_add_2_1L, "bits", 0, CM_u_add_2_1L(stack(8), stack(32), 32));
        WRONG(CM_u_add_2_1L, "bits", 0, CM_u_add_2_1L(stack(32) + 8, stack(32), 32));
        WRONG(CM_u_move_1L, "bits", 0, CM_u_move_1L(stack(32), stack(32), 33));
        WRONG(CM_logxor_2_1L, "bits", 0, CM_logxor_2_1L(stack(500), stack(499), 500));
        WRONG(CM_logior_3_1L, "bits", 0,
              CM_logior_3_1L(stack(9), stack(9), stack(9), 0xffffffffu));
        WRONG(CM_u_move_constant_1L, "bits", 0,
              CM_u_move_constant_1L(stack(9), 1, 0xffffffffu));
        WRONG(CM_get_from_news_1L, "bits", 0,
              CM_get_from_news_1L(stack(64), stack(8), 0, 0, 64));
        WRONG(CM_u_write_to_processor_1L, "bits", 0,
              CM_u_write_to_processor_1L(0, stack(8), 1, 16));
        WRONG(CM_u_read_from_news_array_1L, "bits", 0,
              CM_u_read_from_news_array_1L(array, V(0), V(0), V(4), V(0), stack(8), 9, 1, V(4),
                                           CM_16_bit));
        WRONG(CM_u_add_2_1L, "not a field", 0,
              CM_u_add_2_1L(CM_add_offset_to_field_id(stack(32), -8), stack(8), 8));
        /* operands that share a part */
        WRONG(CM_u_add_2_1L, "overlap", 1, {
            CM_field_id_t f = stack(64);
            CM_u_add_2_1L(f, f + 4, 8);
        });
        WRONG(CM_f_divide_3_1L, "overlap", 1, {
            CM_field_id_t f = stack(128);
            CM_f_divide_3_1L(f + 16, f, f + 64, 23, 8);
        });
        WRONG(CM_u_move_1L, "overlap", 1, {
            CM_field_id_t f = stack(300);
            CM_u_move_1L(f, f + 1, 250);
        });
        WRONG(CM_send_to_news_1L, "overlap", 1, {
            CM_field_id_t f = stack(64);
            CM_send_to_news_1L(f + 8, f, 0, 0, 16);
        });
        /* axes, directions, coordinates, addresses */
        WRONG(CM_get_from_news_1L, "axis", 0, CM_get_from_news_1L(stack(8), stack(8), 2, 0, 8));
        WRONG(CM_get_from_news_1L, "-1", 0,
              CM_get_from_news_1L(stack(8), stack(8), (unsigned)-1, 0, 8));
        WRONG(CM_send_to_news_1L, "direction", 0,
              CM_send_to_news_1L(stack(8), stack(8), 0, 2, 8));
        WRONG(CM_my_news_coordinate_1L, "axis", 0, CM_my_news_coordinate_1L(stack(8), 31, 8));
        WRONG(CM_fe_make_news_coordinate, "coordinate", 0,
              CM_fe_make_news_coordinate(CM_current_geometry, 0, 4));
        WRONG(CM_fe_deposit_news_coordinate, "coordinate", 0,
              CM_fe_deposit_news_coordinate(CM_current_geometry, 0, 1, (unsigned)-1));
        WRONG(CM_fe_extract_news_coordinate, "send_address", 0,
              CM_fe_extract_news_coordinate(CM_current_geometry, 0, 16));
        WRONG(CM_u_read_from_processor_1L, "send_address", 0,
              CM_u_read_from_processor_1L(16, stack(8), 8));
        WRONG(CM_s_write_to_processor_1L, "send_address", 0,
              CM_s_write_to_processor_1L((unsigned)-1, stack(8), 1, 8));
        /* geometries */
        WRONG(CM_create_geometry, "rank", 0, CM_create_geometry(V(4, 4), 0));
        WRONG(CM_create_geometry, "rank", 0, CM_create_geometry(V(4, 4), 32));
        WRONG(CM_create_geometry, "rank", 0, CM_create_geometry(V(4, 4), (unsigned)-1));
        WRONG(CM_create_geometry, "dimensions", 0, CM_create_geometry(V(4, 0), 2));
        WRONG(CM_create_geometry, "dimensions", 0, CM_create_geometry(V(-4, 4), 2));
        WRONG(CM_create_geometry, "dimensions", 0, CM_create_geometry(V(65536, 65536), 2));
        WRONG(CM_intern_geometry, "NULL", 0, CM_intern_geometry(NONE, 2));
        WRONG(CM_create_detailed_geometry, "NULL", 0, CM_create_detailed_geometry(NULL, 2));
        WRONG(CM_create_detailed_geometry, "ordering", 0, {
            struct CM_axis_descriptor axis = {.length = 4, .ordering = 5};
            CM_axis_descriptor_t axes[1] = {&axis};
            CM_create_detailed_geometry(axes, 1);
        });
        WRONG(CM_geometry_rank, "geometry", 0, CM_geometry_rank(dead_geometry()));
        WRONG(CM_geometry_axis_length, "axis", 0,
              CM_geometry_axis_length(CM_current_geometry, 2));
        WRONG(CM_deallocate_geometry, "geometry", 0, CM_deallocate_geometry(dead_geometry()));
        WRONG(CM_deallocate_geometry, "VP sets", 0,
              CM_deallocate_geometry(CM_current_geometry));
        WRONG(CM_allocate_vp_set, "geometry", 0, CM_allocate_vp_set(dead_geometry()));
        WRONG(CM_allocate_vp_set, "geometry", 0, CM_allocate_vp_set((int)stack(8)));
        /* VP sets */
        WRONG(CM_set_vp_set, "vp_set", 0, CM_set_vp_set(dead_set()));
        WRONG(CM_set_vp_set, "vp_set", 0, CM_set_vp_set((int)stack(8)));
        WRONG(CM_vp_set_geometry, "vp_set", 0, CM_vp_set_geometry(-1));
        WRONG(CM_deallocate_vp_set, "vp_set", 0, CM_deallocate_vp_set(dead_set()));
        WRONG(CM_deallocate_vp_set, "default", 0, CM_deallocate_vp_set(CM_current_vp_set));
        WRONG(CM_deallocate_vp_set, "current", 1, {
            CM_set_vp_set(set_of(3, 5));
            CM_deallocate_vp_set(CM_current_vp_set);
        });
        WRONG(CM_s_negate_1_1L, "dest", 0, { /* went with its VP set */
                                             CM_vp_set_id_t set = set_of(3, 5);
                                             CM_field_id_t f =
                                                 CM_allocate_heap_field_vp_set(8, set);
                                             CM_deallocate_vp_set(set);
                                             CM_s_negate_1_1L(f, 8);
        });
        /* arrays */
        WRONG(CM_u_write_to_news_array_1L, "axis_vector", 0,
              CM_u_write_to_news_array_1L(array, V(0), V(0), V(2), V(7), stack(8), 8, 1, V(2),
                                          1));
        WRONG(CM_u_write_to_news_array_1L, "axis_vector", 0,
              CM_u_write_to_news_array_1L(array, V(0, 0), V(0, 0), V(2, 2), V(1, 1), stack(8),
                                          8, 2, V(2, 2), 1));
        WRONG(CM_u_write_to_news_array_1L, "end_vector", 0,
              CM_u_write_to_news_array_1L(array, V(0), V(0), V(5), V(0), stack(8), 8, 1, V(5),
                                          1));
        WRONG(CM_s_read_from_news_array_1L, "start_vector", 0,
              CM_s_read_from_news_array_1L(array, V(0), V(-1), V(2), V(0), stack(8), 8, 1, V(5),
                                           1));
        WRONG(CM_s_read_from_news_array_1L, "offset_vector", 0,
              CM_s_read_from_news_array_1L(array, V(3), V(0), V(4), V(0), stack(8), 8, 1, V(5),
                                           1));
        WRONG(CM_f_read_from_news_array_1L, "format", 0,
              CM_f_read_from_news_array_1L(array, V(0), V(0), V(4), V(0), stack(32), 23, 8, 1,
                                           V(4), 99));
        WRONG(CM_u_read_from_news_array_1L, "format", 0,
              CM_u_read_from_news_array_1L(array, V(0), V(0), V(4), V(0), stack(8), 8, 1, V(4),
                                           CM_float_single));
        WRONG(CM_u_read_from_news_array_1L, "array", 0,
              CM_u_read_from_news_array_1L(NULL, V(0), V(0), V(4), V(0), stack(8), 8, 1, V(4),
                                           1));
        WRONG(CM_u_read_from_news_array_1L, "NULL", 0,
              CM_u_read_from_news_array_1L(array, V(0), NONE, V(4), V(0), stack(8), 8, 1, V(4),
                                           1));
        WRONG(CM_u_read_from_news_array_1L, "rank", 0,
              CM_u_read_from_news_array_1L(array, V(0), V(0), V(4), V(0), stack(8), 8, 0, V(4),
                                           1));
        /* other arguments; calls before CM_init and after CM_detach */
        WRONG(CM_timer_start, "timer", 0, CM_timer_start(64));
        WRONG(CM_timer_read_elapsed, "-1", 0, CM_timer_read_elapsed((unsigned)-1));
        WRONG(CM_attach_to_processors, "count", 0, CM_attach_to_processors(3));
        WRONG(CM_set_system_leds_mode, "mode", 0, CM_set_system_leds_mode(8));
        WRONG(CM_u_add_2_1L, "not a field", 0, {
            CM_field_id_t f = stack(8);
            CM_detach();
            CM_u_add_2_1L(f, stack(8), 8);
        });
        WRONG(CM_set_vp_set, "vp_set", 0, {
            CM_vp_set_id_t set = set_of(3, 5);
            CM_detach();
            CM_set_vp_set(set);
        });
        WRONG(CM_deallocate_geometry, "geometry", 0, {
            CM_geometry_id_t g = CM_create_geometry(V(3, 5), 2);
            CM_detach();
            CM_deallocate_geometry(g);
        });
        WRONG(CM_store_context, "not a field", 0, {
            CM_field_id_t f = stack(1);
            CM_init();
            CM_store_context(f);
        });
    default:
        return false;
    }
}

/* ---- what is said ---- */

static char said[1024];
static int times;

static void listen(const char *message)
{
    if (times++ == 0)
        snprintf(said, sizeof said, "%s", message);
}

/* Runs a wrong program on a machine that has just been initialised. */
static struct row run(int which, unsigned int safety)
{
    struct row row;
    CM_init();
    safety ? CM_set_safety_mode(1) : paris_safety_usual();
    said[0] = '\0';
    times = 0;
    assert_true(wrong(which, true, &row));
    return row;
}

static bool is_explained(const struct row *row, const char *message)
{
    size_t length = strlen(row->call);
    return strncmp(message, row->call, length) == 0 &&
           strncmp(message + length, ": ", 2) == 0 && strstr(message + length, row->word) &&
           !strchr(message, '\n') && strlen(message) < 250;
}

/* Checks that the machine still computes correctly. */
static void check_machine(int which)
{
    CM_set_safety_mode(1);
    times = 0;
    CM_init();
    CM_field_id_t f = heap(16);
    CM_my_news_coordinate_1L(f, 1, 16);
    CM_u_add_constant_2_1L(f, 40, 16);
    if (CM_u_read_from_processor_1L(0, f, 16) != 40 || times)
        fail_msg("after program %d of %s the machine does not work: %s", which, said, said);
}

static void safety_mode_explains(void **unused)
{
    (void)unused;
    int which = 0;
    for (struct row row; wrong(which, false, &row); which++) {
        row = run(which, 1);
        if (times != 1 || !is_explained(&row, said))
            fail_msg("program %d of %s, about \"%s\": %d messages, the first: \"%s\"", which,
                     row.call, row.word, times, said);
        check_machine(which);
    }
    assert_true(which >= 100);
}

static void without_it_nothing_breaks(void **unused)
{
    (void)unused;
    struct row row;
    for (int which = 0; wrong(which, false, &row); which++) {
        row = run(which, 0);
        if (times == 0 && !row.only_safe)
            fail_msg("program %d of %s: nothing is said", which, row.call);
        if (times && strncmp(said, row.call, strlen(row.call)) != 0)
            fail_msg("program %d of %s says: %s", which, row.call, said);
        check_machine(which);
    }
}

/* Without an error handler a wrong program prints the line and ends with status 1. */
static void programs_end_with_the_line(void **unused)
{
    (void)unused;
    struct row row;
    for (int which = 0; wrong(which, false, &row); which += 17)
        for (int safety = 0; safety < 2; safety++) {
            char number[16], self[4096];
            ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
            assert_true(length > 0);
            self[length] = '\0';
            snprintf(number, sizeof number, "%d", which);
            struct child child = {.arguments = {self, number, safety ? "1" : "0"}};
            child_run(&child);
            char *end = strchr(child.errors, '\n');
            bool silent = row.only_safe && !safety;
            if (child.status != (silent && !child.errors[0] ? 0 : 1) ||
                (child.errors[0] && (!end || end[1])) ||
                (child.errors[0] && strncmp(child.errors, row.call, strlen(row.call)) != 0))
                fail_msg("program %d of %s: status %d and \"%s\"", which, row.call,
                         child.status, child.errors);
        }
}

static int start(void **unused)
{
    (void)unused;
    CM_set_error_handler(listen);
    return 0;
}

int main(int argc, char **argv)
{
    unsetenv("LUTETIA_LEDS");
    setenv("LUTETIA_PROCESSORS", "16", 1);
    if (argc == 3) {
        struct row row;
        CM_init();
        argv[2][0] == '1' ? CM_set_safety_mode(1) : paris_safety_usual();
        return !wrong(atoi(argv[1]), true, &row);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(safety_mode_explains),
        cmocka_unit_test(without_it_nothing_breaks),
        cmocka_unit_test(programs_end_with_the_line),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
