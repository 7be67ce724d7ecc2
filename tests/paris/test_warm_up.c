/* test_warm_up.c - what CM_init performs before the program's first instruction leaves nothing
 * behind: the first machine of a process, which warms up, gives a program what the next one
 * gives, which does not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "paris_internal.h"
#include <cm/paris.h>

enum { NUMBERS = 24 };

static int complaints;

static void complain(const char *message)
{
    (void)message;
    complaints++;
}

/* A number for each thing that a warm-up could have changed. */
static void look(unsigned long out[NUMBERS])
{
    unsigned int dimensions[2] = {8, 12};
    struct machine_stats stats;
    int n = 0;
    memset(out, 0, NUMBERS * sizeof *out);
    machine_stats_get(paris_machine(), &stats);
    out[n++] = stats.stores;
    out[n++] = stats.values_live;
    out[n++] = stats.plans_built;
    out[n++] = stats.bytes_held;
    out[n++] = stats.kernels_built;
    out[n++] = stats.kernels_run;
    out[n++] = stats.interpreted;
    out[n++] = (unsigned long)CM_current_vp_set;
    out[n++] = (unsigned long)CM_current_geometry;
    out[n++] = CM_current_send_address_length;
    out[n++] = CM_virtual_to_physical_processor_ratio;
    out[n++] = CM_physical_processors_limit;
    out[n++] = CM_global_count_context();
    out[n++] = (unsigned long)CM_global_logior_overflow();
    out[n++] = (unsigned long)CM_global_logior_test();
    CM_field_id_t field = CM_allocate_stack_field(32);
    out[n++] = field;
    out[n++] = CM_global_logior_1L(field, 32);
    CM_u_random_1L(field, 32, 0);
    out[n++] = CM_global_logxor_1L(field, 32);
    CM_geometry_id_t geometry = CM_create_geometry(dimensions, 2);
    out[n++] = (unsigned long)geometry;
    CM_vp_set_id_t set = CM_allocate_vp_set(geometry);
    out[n++] = (unsigned long)set;
    CM_set_vp_set(set);
    out[n++] = CM_allocate_heap_field(17);
    out[n++] = CM_error_status();
    out[n++] = strlen(paris_error());
    out[n++] = (unsigned long)complaints;
    assert_int_equal(n, NUMBERS);
}

static void it_leaves_nothing_behind(void **state)
{
    unsigned long first[NUMBERS], next[NUMBERS];
    (void)state;
    CM_set_error_handler(complain);
    CM_init();
    assert_true(machine_warms_up(paris_machine()));
    look(first);
    CM_detach();
    CM_init();
    look(next);
    for (int i = 0; i < NUMBERS; i++)
        if (first[i] != next[i])
            fail_msg("number %d is %lu after a warm-up, else %lu", i, first[i], next[i]);
    assert_int_equal(complaints, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_leaves_nothing_behind)};
    setenv("LUTETIA_INTERPRET", "1", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
