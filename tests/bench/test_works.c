/* test_works.c - the programs of `lutetia bench families` give the same results in Paris,
 * interpreted and not, and in plain C. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "harness.h"
#include "works.h"
#include <cm/paris.h>

static void all_same(const char *interpret, int step)
{
    setenv("LUTETIA_INTERPRET", interpret, 1);
    CM_detach();
    CM_init();
    for (int w = 0; w < WORKS_COUNT; w += step)
        if (!works_same((enum work)w, work_size((enum work)w, true), 2))
            fail_msg("%s", bench_error());
}

static void works_come_to_the_same(void **state)
{
    (void)state;
    all_same("2", 1);
}

static void so_do_those_that_are_compiled(void **state)
{
    (void)state;
    all_same("0", 4); /* a compiler takes its time */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(works_come_to_the_same),
        cmocka_unit_test(so_do_those_that_are_compiled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
