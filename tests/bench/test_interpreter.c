/* test_interpreter.c - the programs of `lutetia bench interpreter` give the same results in
 * Paris, interpreted and not, and in plain C. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "harness.h"
#include "interpreter.h"
#include <cm/paris.h>

static void same(uint64_t seed, int n, int turns)
{
    if (!interpreter_same(seed, n, turns))
        fail_msg("seed %d: %s", (int)seed, bench_error());
}

static void programs_have_every_operation(void **state)
{
    bool seen[STACK_OPS_COUNT] = {false};
    (void)state;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        struct stack_program p;
        stack_program_make(&p, seed, 100);
        for (int i = 0; i < STACK_OPERATIONS; i++) {
            assert_true(p.steps[i].to != p.steps[i].a && p.steps[i].to != p.steps[i].b);
            seen[p.steps[i].op] = true;
        }
    }
    for (int op = 0; op < STACK_OPS_COUNT; op++)
        assert_true(seen[op]);
}

/* Sizes on both sides of the one up to which operations are computed as they are called. */
static void all_come_to_the_same(const char *interpret)
{
    static const int sizes[] = {1, 10, 63, 1000, 4000, 4096, 5001};
    setenv("LUTETIA_INTERPRET", interpret, 1);
    CM_detach();
    CM_init();
    for (uint64_t seed = 1; seed <= 8; seed++)
        for (int i = 0; i < (int)(sizeof sizes / sizeof *sizes); i++)
            same(seed, sizes[i], 3);
}

static void interpreted_programs_come_to_the_same(void **state)
{
    (void)state;
    all_come_to_the_same("2");
}

static void so_do_those_that_run_as_usual(void **state)
{
    (void)state;
    all_come_to_the_same("1");
}

static void so_do_those_that_are_compiled(void **state)
{
    (void)state;
    setenv("LUTETIA_INTERPRET", "0", 1);
    CM_detach();
    CM_init();
    same(20, 1000, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_have_every_operation),
        cmocka_unit_test(interpreted_programs_come_to_the_same),
        cmocka_unit_test(so_do_those_that_run_as_usual),
        cmocka_unit_test(so_do_those_that_are_compiled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
