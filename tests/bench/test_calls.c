/* test_calls.c - a call costs the front end little time, and a million calls do not make memory
 * grow. The limits are generous; `lutetia bench calls` measures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

#include "calls.h"
#include "paris_internal.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0 /* 1: freed memory is kept for a while, and everything is slow */
#endif

enum { GROWTH_MOST_BYTES = 8 << 20 };

/* Makes that many calls; returns this thread's processor time in seconds. Does not wait for the
 * device. */
static double calls_record(const struct calls *c, int calls_count, int *turn)
{
    struct timespec start, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
    for (int i = 0; i < calls_count / CALLS_IN_TURN; i++) {
        calls_turn(c, (*turn)++);
        machine_flush(paris_machine());
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
}

/* Uses few processors, because the front end's work is the same for any number. Evaluates after
 * each turn, so that there are few kernels. */
static void calls_cost_little_and_leave_nothing(void **state)
{
    struct calls c;
    struct machine_stats before, after;
    int turn = 0, count = SANITIZED ? 100000 : 1000000;

    (void)state;
    /* Without the background the moment of compilation depends on the turns only. */
    setenv("LUTETIA_BACKGROUND", "0", 1);
    calls_init(&c, 64, 16);
    /* Builds the kernels, and after 4096 turns optimised ones, for which a compiler may have to
     * be loaded; fills all caches. */
    calls_record(&c, 10000 * CALLS_IN_TURN, &turn);
    double recorded_s = calls_record(&c, 10000, &turn);
    machine_stats_get(paris_machine(), &before);
    size_t resident = calls_resident_bytes();
    calls_record(&c, count, &turn);
    machine_stats_get(paris_machine(), &after);
    size_t now = calls_resident_bytes();
    print_message("%.3f us/call recorded; %ld KiB more after %d calls\n", recorded_s * 1e2,
                  ((long)now - (long)resident) / 1024, count);
    assert_true(recorded_s / 10000 < (SANITIZED ? 1e-3 : 2e-5));
    assert_true(after.values_live <= before.values_live + 1024); /* of a turn or two */
    assert_true(after.bytes_held <= before.bytes_held + (1 << 20));
    assert_int_equal(after.plans_built, before.plans_built);
    assert_int_equal(after.kernels_built, before.kernels_built);
    if (!SANITIZED)
        assert_true(now <= resident + GROWTH_MOST_BYTES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calls_cost_little_and_leave_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
