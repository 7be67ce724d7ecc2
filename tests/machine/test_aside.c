/* Tests base/aside.h: work goes on in a thread while the caller does something else; in a child
 * after fork() it is lost, and ending it does not wait. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/aside.h"

enum { WORKS = 300 };

struct sum {
    atomic_bool may_end;
    uint64_t of, is;
    bool takes_signals;
};

static void add(void *of)
{
    struct sum *s = of;
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    s->takes_signals = !sigismember(&blocked, SIGINT) || !sigismember(&blocked, SIGALRM);
    while (!atomic_load(&s->may_end))
        usleep(100);
    for (uint64_t i = 1; i <= s->of; i++)
        s->is += i;
}

static void work_is_done_while_the_caller_goes_on(void **state)
{
    struct aside a = {0};
    (void)state;
    assert_false(aside_is_done(&a));
    aside_end(&a);
    for (uint64_t i = 0; i < WORKS; i++) {
        struct sum s = {.of = i};
        assert_true(aside_begin(&a, add, &s));
        assert_false(aside_is_done(&a));
        assert_false(aside_is_lost(&a));
        atomic_store(&s.may_end, true);
        for (int tries = 0; i % 2 && tries < 10000 && !aside_is_done(&a); tries++)
            usleep(100);
        assert_true(i % 2 == 0 || aside_is_done(&a));
        aside_end(&a);
        assert_false(aside_is_done(&a));
        assert_int_equal(s.is, i * (i + 1) / 2);
        assert_false(s.takes_signals);
    }
}

static void of_a_child_it_is_lost(void **state)
{
    struct aside a = {0};
    struct sum s = {.of = 10};
    int status = 1;
    (void)state;
    assert_true(aside_begin(&a, add, &s));
    pid_t child = fork();
    if (child == 0) {
        bool lost = aside_is_lost(&a) && !aside_is_done(&a);
        aside_end(&a); /* does not wait for a thread that is not here */
        struct sum own = {.of = 4};
        atomic_store(&own.may_end, true);
        lost = lost && aside_begin(&a, add, &own);
        aside_end(&a);
        _exit(lost && own.is == 10 ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    atomic_store(&s.may_end, true);
    aside_end(&a);
    assert_int_equal(s.is, 55);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_is_done_while_the_caller_goes_on),
        cmocka_unit_test(of_a_child_it_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
