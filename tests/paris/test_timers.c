/* Timers: what the machine does is its time, whoever computes it, in all tiers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "device.h"
#include "tier.h"

enum { TIMER = 5 };

static const struct tier tiers[] = {
    {"as usual", "1", "1", "1", false, 1, NULL, NULL},
    {"one at a time", "1", "1", "1", true, 1, NULL, NULL},
    {"byte code", "1", "2", "0", false, 1, NULL, NULL},
    {"byte code, shared out", "2", "2", "0", false, 1, NULL, NULL},
    {"always at once", "1", "2", "2", false, 1, NULL, NULL},
    {"kernels", "0", "0", "0", false, 1, NULL, NULL},
    {"kernels, byte code on the device", "0", "3", "0", false, 1, NULL, NULL},
};

static CM_field_id_t a, b, c;

static void set_make(unsigned int count)
{
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(&count, 1)));
    CM_set_context();
    a = CM_allocate_heap_field(32);
    b = CM_allocate_heap_field(32);
    c = CM_allocate_heap_field(32);
    CM_my_news_coordinate_1L(c, 0, 32);
    CM_f_u_float_2_2L(b, c, 32, 23, 8);
    CM_f_move_constant_1L(a, 1.5, 23, 8);
}

/* Of each processor by itself. */
static void compute(int turns)
{
    for (int i = 0; i < turns; i++) {
        CM_f_multiply_2_1L(a, b, 23, 8);
        CM_f_add_2_1L(a, b, 23, 8);
        CM_f_sqrt_1_1L(a, 23, 8);
    }
}

static void communicate(int turns)
{
    for (int i = 0; i < turns; i++) {
        CM_scan_with_u_add_1L(a, c, 0, 32, CM_upward, CM_inclusive, CM_none, CM_no_field);
        CM_u_rank_2L(b, a, 0, 32, 32, CM_upward, CM_none, CM_no_field);
        CM_send_with_u_add_1L(a, b, c, 32, CM_no_field);
    }
}

/* Where other programs take the processor between two instructions, the machine has less of the
 * time: then once more. */
enum { TRIES = 20 };

/* False: the machine had less of the time. */
static bool check(const char *tier, const char *what, double least)
{
    const double elapsed = CM_timer_read_elapsed(TIMER), busy = CM_timer_read_cm_busy(TIMER),
                 idle = CM_timer_read_cm_idle(TIMER);
    if (!(busy > 0 && busy <= elapsed && idle >= 0))
        fail_msg("%s, %s: elapsed %g, busy %g, idle %g", tier, what, elapsed, busy, idle);
    return busy >= least * elapsed;
}

static void timed(const struct tier *t, unsigned int count, int turns, double least)
{
    static const struct work {
        void (*run)(int turns);
        const char *name;
    } works[] = {{compute, "arithmetic"}, {communicate, "communication"}};
    set_make(count);
    for (int w = 0; w < 2; w++) {
        bool enough = false;
        for (int i = 0; i < TRIES && !enough;
             i++) { /* in the first ones kernels are compiled */
            CM_timer_clear(TIMER);
            CM_timer_start(TIMER);
            works[w].run(turns);
            CM_timer_stop(TIMER);
            enough = check(t->name, works[w].name, least);
        }
        if (!enough)
            fail_msg("%s, %s: elapsed %g, busy %g", t->name, works[w].name,
                     CM_timer_read_elapsed(TIMER), CM_timer_read_cm_busy(TIMER));
    }
}

/* Of 300,000 processors nearly all time is the machine's; of 500 some is. What kernels do while
 * the front end goes on is not counted, so there it is some of it only. */
static void what_is_computed_is_the_machines_time(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof tiers / sizeof *tiers; i++) {
        tier_begin(&tiers[i], 16);
        timed(&tiers[i], 300000, 2, tiers[i].near[0] == '0' ? 0 : 0.2);
        timed(&tiers[i], 500, 20, 0);
    }
}

/* The front end's own time is none of it. */
static void what_the_front_end_does_is_idle(void **unused)
{
    (void)unused;
    tier_begin(&tiers[0], 16);
    set_make(500);
    CM_timer_clear(TIMER);
    CM_timer_start(TIMER);
    const double until = CM_timer_read_elapsed(TIMER) + 0.05;
    while (CM_timer_read_elapsed(TIMER) < until)
        continue;
    CM_timer_stop(TIMER);
    assert_true(CM_timer_read_cm_idle(TIMER) > 0.04);
}

static void a_timer_goes_on_from_machine_to_machine(void **unused)
{
    double busy;
    (void)unused;
    tier_begin(&tiers[2], 16);
    CM_timer_clear(TIMER);
    CM_timer_start(TIMER);
    set_make(100000);
    compute(2);
    CM_global_f_max_1L(a, 23, 8);
    busy = CM_timer_read_cm_busy(TIMER);
    assert_true(busy > 0);
    CM_detach();
    assert_true(CM_timer_read_cm_busy(TIMER) >= busy); /* and no machine is made for that */
    assert_int_equal(CM_attached(), 0);
    tier_begin(&tiers[2], 16);
    busy = CM_timer_read_cm_busy(TIMER);
    set_make(100000);
    compute(2);
    CM_timer_stop(TIMER);
    assert_true(CM_timer_read_cm_busy(TIMER) > busy);
    assert_true(check("two machines", "arithmetic", 0));
}

int main(void)
{
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_computed_is_the_machines_time),
        cmocka_unit_test(what_the_front_end_does_is_idle),
        cmocka_unit_test(a_timer_goes_on_from_machine_to_machine)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
