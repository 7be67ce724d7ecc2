/* test_awake.c - what keeps processors from halting: the system, here a usual file in its
 * place, or threads of the lowest priority; for as long as was asked, and no longer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "../skip.h"
#include "base/awake.h"
#include "base/clock.h"

static double used_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void pause_s(double seconds)
{
    struct timespec t = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
    while (nanosleep(&t, &t))
        continue;
}

/* Threads of this process that have the lowest priority. */
static int threads_last(void)
{
    int last = 0;
    DIR *d = opendir("/proc/self/task");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) {
        int id = atoi(e->d_name);
        last += id > 0 && sched_getscheduler(id) == SCHED_IDLE;
    }
    closedir(d);
    return last;
}

/* Whether the system lets a thread be of the lowest priority, on a processor of its own. */
static bool is_allowed(void)
{
    pid_t child = fork();
    if (!child) {
        const struct sched_param none = {0};
        cpu_set_t set;
        _exit(sched_getaffinity(0, sizeof set, &set) ||
              sched_setaffinity(0, sizeof set, &set) ||
              sched_setscheduler(0, SCHED_IDLE, &none));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static int processors(void)
{
    cpu_set_t set;
    assert_int_equal(sched_getaffinity(0, sizeof set, &set), 0);
    return CPU_COUNT(&set);
}

static void threads_are_last_and_end(void **unused)
{
    (void)unused;
    struct awake *a = awake_create(NULL, true);
    if (processors() < 2)
        assert_null(a);
    if (!a || !is_allowed()) /* there are more processors than it is for */
        skip_because("this is not for so many processors, or so few");
    assert_int_equal(threads_last(), 0);
    awake_for(a, 30);
    double deadline = clock_s() + 20;
    while (threads_last() < processors() && clock_s() < deadline) /* it takes them a moment */
        pause_s(0.001);
    assert_int_equal(threads_last(), processors());
    awake_destroy(a);
    deadline = clock_s() + 20; /* on a busy processor they may take longer than was waited */
    while (threads_last() > 0 && clock_s() < deadline)
        pause_s(0.001);
    assert_int_equal(threads_last(), 0);
}

static void after_that_nobody_looks(void **unused)
{
    (void)unused;
    struct awake *a = awake_create(NULL, true);
    if (!a)
        skip_because("this is not for so many processors, or so few");
    for (int turn = 0; turn < 3; turn++) {
        awake_for(a, 30);
        pause_s(0.02);
        awake_for(a, 0); /* until now */
        pause_s(0.3);    /* a thread that got no time yet sees that it is over */
        double least = 1;
        for (int i = 0; i < 5; i++) {
            double used = used_s();
            pause_s(0.1);
            used = used_s() - used;
            least = used < least ? used : least;
        }
        assert_true(least < 0.05); /* two that look use 0.1 to 0.2 */
    }
    awake_destroy(a);
}

static void a_child_has_no_threads(void **unused)
{
    (void)unused;
    struct awake *a = awake_create(NULL, true);
    if (!a)
        skip_because("this is not for so many processors, or so few");
    awake_for(a, 30);
    pid_t child = fork();
    if (!child) {
        alarm(60);
        awake_for(a, 1);
        awake_destroy(a);
        _exit(7);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
    awake_for(a, 1);
    awake_destroy(a);
    awake_for(NULL, 1);
    awake_destroy(NULL);
}

/* What the system has been asked for last; -1: nothing. */
static long asked(int file)
{
    int32_t all[64];
    ssize_t bytes = pread(file, all, sizeof all, 0);
    assert_true(bytes >= 0 && bytes % 4 == 0 && bytes < (ssize_t)sizeof all);
    return bytes ? all[bytes / 4 - 1] : -1;
}

static long asked_in_time(int file, long value)
{
    double deadline = clock_s() + 20;
    while (asked(file) != value && clock_s() < deadline)
        pause_s(0.001);
    return asked(file);
}

static void the_system_is_asked_and_told_when_it_is_over(void **unused)
{
    enum { ANY = 2000000000 };
    char path[] = "/tmp/lutetia-awake-XXXXXX";
    (void)unused;
    int file = mkstemp(path);
    assert_true(file >= 0);
    struct awake *a = awake_create(path, false);
    if (!a) /* there are other numbers of processors than it is for */
        skip_because("this is not for so many processors, or so few");
    assert_int_equal(asked(file), -1);
    awake_for(a, 30);
    assert_int_equal(asked(file), 0);
    awake_for(a, 30); /* once is enough */
    assert_int_equal(lseek(file, 0, SEEK_END), 4);
    pid_t child = fork();
    if (!child) { /* the parent's processors are its own business */
        awake_for(a, 0);
        awake_destroy(a);
        _exit(7);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
    awake_for(a, 0.02); /* sooner than it was to be */
    assert_int_equal(asked_in_time(file, ANY), ANY);
    awake_for(a, 30);
    assert_int_equal(asked(file), 0);
    awake_destroy(a);
    assert_int_equal(asked(file), ANY);

    assert_int_equal(ftruncate(file, 0), 0);
    assert_non_null(a = awake_create(path, false));
    for (int turn = 0; turn < 3; turn++) {
        awake_for(a, 0.02);
        assert_int_equal(asked(file), 0);
        assert_int_equal(asked_in_time(file, ANY), ANY);
    }
    awake_destroy(a);
    assert_int_equal(asked(file), ANY);
    close(file);
    unlink(path);
    assert_null(awake_create(path, false)); /* it is not there */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_are_last_and_end),
        cmocka_unit_test(after_that_nobody_looks),
        cmocka_unit_test(a_child_has_no_threads),
        cmocka_unit_test(the_system_is_asked_and_told_when_it_is_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
