/* Tests base/crew.h: threads share the parts of one job, and each part is done once, by a
 * thread that is free. In a child after fork(), and without threads, the caller does all
 * parts. */
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "../skip.h"
#include "base/clock.h"
#include "base/crew.h"

enum { PARTS_MOST = 100, JOBS = 3000, THREADS = 4 };

struct job {
    int parts, of_a_part;
    atomic_int done[PARTS_MOST];
    atomic_int strangers; /* calls with impossible numbers */
    uint64_t sums[CREW_MOST];
};

static void part(void *of, int number, int worker)
{
    struct job *j = of;
    if (worker < 0 || worker >= CREW_MOST || number < 0 || number >= j->parts) {
        atomic_fetch_add(&j->strangers, 1);
        return;
    }
    for (int i = 0; i < j->of_a_part; i++)
        j->sums[worker] += (uint64_t)(number + i);
    atomic_fetch_add(&j->done[number], 1);
}

/* Runs a job; true if each part was done once and the sum is right. */
static bool job_is_done(struct crew *crew, int parts, int of_a_part)
{
    static struct job j;
    uint64_t sum = 0, should = 0;
    memset(&j, 0, sizeof j);
    j.parts = parts;
    j.of_a_part = of_a_part;
    crew_run(crew, parts, part, &j);
    bool good = !atomic_load(&j.strangers);
    for (int i = 0; i < parts; i++) {
        good = good && atomic_load(&j.done[i]) == 1;
        for (int k = 0; k < of_a_part; k++)
            should += (uint64_t)(i + k);
    }
    for (int i = 0; i < CREW_MOST; i++)
        sum += j.sums[i];
    return good && sum == should;
}

static void each_part_is_done_once(void **unused)
{
    (void)unused;
    for (int threads = 0; threads <= THREADS; threads++) {
        struct crew *crew = crew_create(threads);
        assert_int_equal(crew != NULL, threads > 1);
        assert_int_equal(crew_size(crew), threads > 1 ? threads : 1);
        for (int i = 0; i < JOBS; i++)
            assert_true(job_is_done(crew, i * 7 % PARTS_MOST, i % 50));
        crew_destroy(crew);
    }
}

static void threads_that_sleep_wake_up(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(THREADS);
    for (int i = 0; i < 50; i++) {
        usleep(1000);
        assert_true(job_is_done(crew, 40, 2000));
    }
    crew_destroy(crew);
}

static void crews_that_never_worked_end(void **unused)
{
    (void)unused;
    crew_destroy(NULL);
    crew_destroy(crew_create(THREADS));
}

static void a_child_works_alone(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(THREADS);
    assert_true(job_is_done(crew, 40, 2000)); /* there are threads */
    pid_t child = fork();
    if (child == 0) {
        alarm(20);
        bool good = job_is_done(crew, 40, 2000);
        crew_destroy(crew);
        _exit(good ? 0 : 1);
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_true(job_is_done(crew, 40, 2000));
    crew_destroy(crew);
}

static atomic_int signals_of_others;
static pid_t caller;

static void caught(int number)
{
    (void)number;
    if (gettid() != caller)
        atomic_fetch_add(&signals_of_others, 1);
}

static void no_thread_takes_a_signal(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(THREADS);
    struct sigaction act = {.sa_handler = caught}, before;
    caller = gettid();
    sigaction(SIGUSR1, &act, &before);
    for (int i = 0; i < 200; i++) {
        assert_true(job_is_done(crew, 40, 200));
        kill(getpid(), SIGUSR1);
    }
    sigaction(SIGUSR1, &before, NULL);
    assert_int_equal(atomic_load(&signals_of_others), 0);
    crew_destroy(crew);
}

static void short_work_is_not_shared_out(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(2);
    const struct crew_costs costs = {.awake = 100, .asleep = 100, .late = 1000, .part = 10};
    assert_int_equal(crew_parts(crew, 99, &costs), 1);
    assert_int_equal(crew_parts(NULL, 1e9, &costs), 1);
    assert_int_equal(crew_parts(crew, 100, &costs), 10);
    assert_true(crew_parts(crew, 1e9, &costs) <= 100);
    crew_destroy(crew);
}

static atomic_bool other_began;

/* The other thread stops in the middle of its part, as if the system ran somebody else. */
static void part_stopped(void *context, int part, int worker)
{
    (void)context;
    (void)part;
    if (worker) {
        atomic_store(&other_began, true);
        usleep(20000);
    }
    while (!atomic_load(&other_began))
        sched_yield();
}

static void short_work_is_not_shared_out_after_a_late_part(void **unused)
{
    (void)unused;
    const struct crew_costs costs = {.awake = 100, .asleep = 100, .late = 1000, .part = 10};
    struct crew *crew = crew_create(2);
    int alone[3];
    for (int turn = 0; turn < 3; turn++) {
        atomic_store(&other_began, false);
        crew_run(crew, 2, part_stopped, NULL);
        assert_true(crew_parts(crew, 1000, &costs) > 1);
        for (alone[turn] = 0; crew_parts(crew, 999, &costs) == 1; alone[turn]++)
            assert_true(alone[turn] < 100000);
    }
    assert_true(alone[0] > 10 && alone[1] > alone[0] && alone[2] > alone[1]);
    crew_destroy(crew);
}

/* Long enough for a thread that slept to wake. */
static void part_waits(void *context, int part, int worker)
{
    const double end = clock_s() + 50e-6;
    (void)context;
    (void)part;
    (void)worker;
    while (clock_s() < end)
        continue;
}

/* Runs jobs until it has been measured how far the threads are apart. False: it never is, since
 * none looks for work while the caller runs (there is one processor, or others' programs are on
 * it). */
static bool trip_measured(struct crew *crew)
{
    const double end = clock_s() + 2;
    while (crew_trip(crew) == 0 && clock_s() < end) {
        crew_run(crew, 8, part_waits, NULL);
        usleep(1000);
    }
    assert_true(crew_trip(crew) >= 0 && crew_trip(crew) < 1e6);
    return crew_trip(crew) > 0;
}

static void short_work_is_not_shared_out_between_threads_apart(void **unused)
{
    (void)unused;
    const struct crew_costs
        near = {.awake = 100, .asleep = 100, .apart = 1000, .part = 10, .trip = 1e6},
        apart = {.awake = 100, .asleep = 100, .apart = 1000, .part = 10, .trip = 1e-3};
    for (int threads = 2; threads <= 4; threads += 2) {
        struct crew *crew = crew_create(threads);
        assert_true(crew_trip(crew) == 0);
        assert_true(crew_parts(crew, 999, &apart) > 1); /* nothing is known yet */
        crew_meet(crew);
        if (!trip_measured(crew)) {
            crew_destroy(crew);
            skip_because("no thread looked for work while the caller ran");
        }
        bool alone = false;
        for (int i = 0; i < 100 && !alone; i++) { /* until the measurement is a new one */
            alone = crew_parts(crew, 499, &apart) == 1;
            crew_run(crew, 8, part_waits, NULL);
            usleep(alone ? 0 : 6000);
        }
        assert_true(alone);
        assert_true(crew_parts(crew, 1000 * 2 / threads, &apart) > 1); /* long enough */
        assert_true(crew_parts(crew, 499, &near) > 1);
        usleep(30000);
        assert_true(crew_parts(crew, 499, &apart) > 1); /* after a while it is tried again */
        crew_destroy(crew);
    }
    crew_meet(NULL);
    assert_true(crew_trip(NULL) == 0);
}

/* ---- errands ---- */

static atomic_int errands_done, errands_dropped;
static atomic_bool errands_wait;

static void errand(void *context, bool wanted)
{
    atomic_fetch_add((atomic_int *)context, wanted);
    atomic_fetch_add(&errands_dropped, !wanted);
    while (wanted && atomic_load(&errands_wait))
        sched_yield();
}

static void errands_are_done_beside_jobs(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(THREADS);
    int taken = 0;
    atomic_store(&errands_done, 0);
    for (int i = 0; i < JOBS; i++) {
        taken += crew_errand(crew, errand, &errands_done);
        if (i % 3 == 0)
            assert_true(job_is_done(crew, i % 20, 50));
    }
    assert_true(taken > 0);
    while (atomic_load(&errands_done) < taken)
        sched_yield();
    crew_destroy(crew);
    assert_int_equal(atomic_load(&errands_done), taken);
}

/* A thread that is on an errand has no part of a job, and what has not begun when the crew ends
 * is let go of. */
static void errands_hold_up_nobody(void **unused)
{
    (void)unused;
    struct crew *crew = crew_create(2);
    int taken = 0;
    atomic_store(&errands_done, 0);
    atomic_store(&errands_dropped, 0);
    atomic_store(&errands_wait, true);
    assert_true(crew_errand(crew, errand, &errands_done));
    while (!atomic_load(&errands_done))
        sched_yield();
    while (crew_errand(crew, errand, &errands_done))
        taken++;
    assert_true(taken > 0);
    assert_true(job_is_done(crew, 40, 2000));
    assert_int_equal(atomic_load(&errands_done), 1);
    atomic_store(&errands_wait, false);
    crew_destroy(crew);
    assert_int_equal(atomic_load(&errands_done) + atomic_load(&errands_dropped), 1 + taken);
}

static void without_threads_there_are_no_errands(void **unused)
{
    (void)unused;
    assert_false(crew_errand(NULL, errand, &errands_done));
    struct crew *crew = crew_create(2);
    assert_true(crew_errand(crew, errand, &errands_done));
    pid_t child = fork();
    if (!child) {
        bool none = !crew_errand(crew, errand, &errands_done);
        crew_destroy(crew);
        _exit(none ? 0 : 1);
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    crew_destroy(crew);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_part_is_done_once),
        cmocka_unit_test(threads_that_sleep_wake_up),
        cmocka_unit_test(crews_that_never_worked_end),
        cmocka_unit_test(a_child_works_alone),
        cmocka_unit_test(no_thread_takes_a_signal),
        cmocka_unit_test(short_work_is_not_shared_out),
        cmocka_unit_test(short_work_is_not_shared_out_after_a_late_part),
        cmocka_unit_test(short_work_is_not_shared_out_between_threads_apart),
        cmocka_unit_test(errands_are_done_beside_jobs),
        cmocka_unit_test(errands_hold_up_nobody),
        cmocka_unit_test(without_threads_there_are_no_errands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
