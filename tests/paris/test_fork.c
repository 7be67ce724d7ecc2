/* test_fork.c - programs that start other processes: by system(), popen(), fork() and exec. A
 * child after fork() ends, becomes another program, or goes on with the machine as it was: with
 * the same bits as its parent, without a kernel. It never hangs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <fcntl.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include "paris_internal.h"
#include <cm/paris.h>

enum { SIDE = 64, CELLS = SIDE * SIDE, HANGS_S = 30 };

/* ---- work of many kinds; what comes of it is a number ---- */

struct work {
    CM_field_id_t cell, other, address, real;
};

static struct work begin(void)
{
    unsigned int sides[2] = {SIDE, SIDE};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sides, 2)));
    CM_set_context();
    struct work w = {CM_allocate_heap_field(32), CM_allocate_heap_field(32),
                     CM_allocate_heap_field(32), CM_allocate_heap_field(32)};
    CM_my_send_address(w.address);
    CM_u_multiply_constant_3_1L(w.cell, w.address, 2654435761u, 32);
    CM_f_u_float_2_2L(w.real, w.cell, 32, 23, 8);
    return w;
}

static void turn(const struct work *w)
{
    CM_get_from_news_1L(w->other, w->cell, 0, CM_upward, 32);
    CM_u_add_2_1L(w->cell, w->other, 32);
    CM_get_from_news_1L(w->other, w->cell, 1, CM_downward, 32);
    CM_logxor_2_1L(w->cell, w->other, 32);
}

/* Also what needs hand-written kernels on other devices: sends, gets, scans, ranks, reductions,
 * functions. */
static uint64_t work(const struct work *w, int turns)
{
    for (int i = 0; i < turns; i++)
        turn(w);
    CM_field_id_t to = CM_allocate_stack_field(32), sum = CM_allocate_stack_field(32),
                  rank = CM_allocate_stack_field(32), root = CM_allocate_stack_field(32);
    CM_u_move_1L(to, w->address, 32);
    CM_logxor_constant_2_1L(to, 5, 32);
    CM_u_move_zero_1L(sum, 32);
    CM_send_with_u_add_1L(sum, to, w->cell, 32, CM_no_field);
    CM_get_1L(rank, to, sum, 32);
    CM_u_add_2_1L(w->cell, rank, 32);
    CM_scan_with_u_add_1L(sum, w->cell, 1, 32, CM_upward, CM_inclusive, CM_none, CM_no_field);
    CM_u_add_2_1L(w->cell, sum, 32);
    CM_u_rank_2L(rank, w->cell, 0, 32, 32, CM_upward, CM_none, CM_no_field);
    CM_logxor_2_1L(w->cell, rank, 32);
    CM_f_sqrt_2_1L(root, w->real, 23, 8);
    CM_f_sin_2_1L(root, root, 23, 8);
    CM_f_add_2_1L(w->real, root, 23, 8);
    uint64_t all = CM_global_u_add_1L(w->cell, 32);
    all = all * 31 + CM_u_read_from_processor_1L(77, w->cell, 32);
    all = all * 31 + CM_u_read_from_processor_1L(99, w->real, 32);
    CM_deallocate_stack_through(to);
    return all;
}

/* ---- children ---- */

/* What a child says to its parent: a number, by a pipe. It ends after HANGS_S seconds, whatever
 * it does. */
struct child {
    pid_t process;
    int from;
};

static struct child child_begin(void)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    fflush(stdout);
    struct child c = {fork(), ends[0]};
    assert_true(c.process >= 0);
    if (c.process) {
        close(ends[1]);
        return c;
    }
    alarm(HANGS_S);
    close(ends[0]);
    c.from = ends[1];
    return c;
}

_Noreturn static void child_says(const struct child *c, uint64_t number)
{
    const bool said = write(c->from, &number, sizeof number) == sizeof number;
    exit(said ? 0 : 9); /* with all that is to be done at a program's end */
}

static uint64_t child_said(const struct child *c)
{
    uint64_t number = 0;
    int status;
    assert_int_equal(read(c->from, &number, sizeof number), sizeof number);
    close(c->from);
    assert_int_equal(waitpid(c->process, &status, 0), c->process);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    return number;
}

/* The exit status of a child that is to end now. */
static int ended(pid_t process)
{
    int status;
    assert_int_equal(waitpid(process, &status, 0), process);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* ---- what programs do ---- */

static void other_programs_run(void)
{
    char word[20] = "";
    assert_int_equal(WEXITSTATUS(system("exit 3")), 3);
    FILE *f = popen("echo here", "r");
    assert_non_null(f);
    assert_int_equal(fscanf(f, "%19s", word), 1);
    assert_int_equal(pclose(f), 0);
    assert_string_equal(word, "here");
    for (int how = 0; how < 3; how++) {
        fflush(stdout);
        pid_t child = fork();
        if (!child) {
            alarm(HANGS_S);
            if (how == 0)
                execlp("sh", "sh", "-c", "exit 0", (char *)NULL);
            else if (how == 1)
                _exit(0);
            exit(0);
        }
        assert_int_equal(ended(child), 0);
    }
}

/* A child goes on as its parent does. */
static void both_go_on(const struct work *w)
{
    const struct child c = child_begin();
    const uint64_t all = work(w, 12);
    if (!c.process)
        child_says(&c, all);
    assert_int_equal(child_said(&c), all);
}

/* ---- cases ---- */

/* In a process of its own, in which nothing has been done yet. */
static void before_there_is_a_machine(void **state)
{
    (void)state;
    const struct child c = child_begin();
    if (c.process) {
        assert_int_equal(child_said(&c), 1);
        return;
    }
    other_programs_run();
    const struct child first = child_begin();
    const struct work w = begin();
    const uint64_t all = work(&w, 8);
    if (!first.process)
        child_says(&first, all);
    child_says(&c, child_said(&first) == all);
}

static void between_calls(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    const struct work w = begin();
    other_programs_run();
    both_go_on(&w);
    for (int i = 0; i < 4; i++) {
        work(&w, 40);
        turn(&w); /* which waits */
        other_programs_run();
        both_go_on(&w);
    }
}

/* Kernels are queued, noted turns wait, better kernels are compiled and loaded. */
static void while_much_goes_on(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    const struct work w = begin();
    for (int i = 0; i < 12; i++) {
        for (int k = 0; k < 150 + 7 * i; k++)
            turn(&w);
        if (i % 3 == 0)
            other_programs_run();
        both_go_on(&w);
    }
}

/* A child makes a machine anew, and has a child itself. */
static void children_begin_anew(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    struct work w = begin();
    work(&w, 3);
    const struct child c = child_begin();
    if (!c.process) {
        both_go_on(&w);
        CM_detach();
        w = begin();
        work(&w, 3);
        both_go_on(&w);
        CM_cold_boot();
        w = begin();
        child_says(&c, work(&w, 30));
    }
    assert_true(paris_reset(NULL));
    w = begin();
    const uint64_t all = work(&w, 30);
    assert_int_equal(child_said(&c), all);
}

/* ---- a fork in another thread ---- */

static void *fork_and_compute(void *of)
{
    const struct work *w = of;
    int *status = malloc(sizeof *status), file;
    char line[400] = "";
    FILE *said = tmpfile();
    assert_non_null(status);
    assert_non_null(said);
    pid_t child = fork();
    if (!child) {
        alarm(HANGS_S);
        file = fileno(said);
        dup2(file, STDERR_FILENO);
        work(w, 3);
        exit(0);
    }
    *status = ended(child);
    rewind(said);
    if (*status) { /* one line says why */
        assert_non_null(fgets(line, sizeof line, said));
        assert_non_null(strstr(line, "child of fork()"));
        assert_null(fgets(line, sizeof line, said));
    }
    fclose(said);
    return status;
}

static void in_another_thread(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    const struct work w = begin();
    for (int i = 0; i < 20; i++) {
        pthread_t thread;
        int *status;
        for (int k = 0; k < 200; k++)
            turn(&w);
        assert_int_equal(pthread_create(&thread, NULL, fork_and_compute, (void *)(uintptr_t)&w),
                         0);
        assert_int_equal(pthread_join(thread, (void **)&status), 0);
        assert_true(*status == 0 || *status == 1);
        free(status);
    }
    const uint64_t all = work(&w, 1);
    assert_true(all != 0);
}

static int by_kernels(void **state)
{
    (void)state;
    setenv("LUTETIA_INTERPRET", "0", 1);
    setenv("LUTETIA_FLUSH_AFTER", "40", 1);
    return 0;
}

static int with_better_kernels(void **state)
{
    (void)state;
    unsetenv("LUTETIA_INTERPRET");
    unsetenv("LUTETIA_BACKGROUND");
    setenv("LUTETIA_BOX_AFTER", "400000", 1);
    setenv("LUTETIA_OPTIMISE_AFTER", "100000", 1);
    return 0;
}

static int by_the_device(void **state)
{
    (void)state;
    setenv("LUTETIA_NEAR", "0", 1);
    setenv("LUTETIA_INTERPRET", "3", 1);
    return 0;
}

static int as_usual(void **state)
{
    static const char *const names[] = {"LUTETIA_NEAR",       "LUTETIA_INTERPRET",
                                        "LUTETIA_BOX_AFTER",  "LUTETIA_OPTIMISE_AFTER",
                                        "LUTETIA_BACKGROUND", "LUTETIA_FLUSH_AFTER"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unsetenv(names[i]);
    return 0;
}

int main(void)
{
    const struct CMUnitTest first[] = {
        cmocka_unit_test_setup(before_there_is_a_machine, as_usual),
    };
    const int failed = cmocka_run_group_tests_name("first", first, NULL, NULL);
#ifdef __SANITIZE_ADDRESS__
    /* AddressSanitizer's memory has no part in fork(): what a thread of the parent's allocates
     * just then leaves a lock that the child waits for, and what such threads hold is lost to a
     * child. */
    return failed;
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(between_calls, by_kernels, as_usual),
        cmocka_unit_test_setup_teardown(while_much_goes_on, by_kernels, as_usual),
        cmocka_unit_test_setup_teardown(children_begin_anew, by_kernels, as_usual),
        cmocka_unit_test_setup_teardown(in_another_thread, by_kernels, as_usual),
        cmocka_unit_test(between_calls),
        cmocka_unit_test(children_begin_anew),
        cmocka_unit_test_setup_teardown(while_much_goes_on, with_better_kernels, as_usual),
        cmocka_unit_test_setup_teardown(between_calls, by_the_device, as_usual),
    };
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
