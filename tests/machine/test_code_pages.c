/* test_code_pages.c - the machine's code is found, and fetched: to read it afterwards takes no page fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <sys/resource.h>

#include "base/code_pages.h"

enum { PAGE_BYTES = 4096 };

static void it_has_this_function_and_no_more_than_wanted(void **unused)
{
    (void)unused;
    const uintptr_t function = (uintptr_t)code_pages_find;
    for (size_t most = 1; most < (size_t)64 << 20; most *= 8) {
        const struct code_pages c = code_pages_find(most);
        const uintptr_t begin = (uintptr_t)c.begin, end = (uintptr_t)c.end;
        assert_non_null(c.begin);
        assert_true(begin % PAGE_BYTES == 0 && begin <= function && function < end);
        assert_true(function - begin < most + PAGE_BYTES && end - function <= most);
    }
}

static long faults(void)
{
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    return usage.ru_minflt + usage.ru_majflt;
}

static void fetched_pages_are_there(void **unused)
{
    (void)unused;
    struct aside fetching = {0};
    code_pages_begin(&fetching);
    if (!fetching.begun)
        skip(); /* one processor */
    aside_end(&fetching);
    const struct code_pages c = code_pages_find(64 << 10);
    const long before = faults();
    unsigned sum = 0;
    for (const volatile char *page = c.begin; page < c.end; page += PAGE_BYTES)
        sum += (unsigned char)*page;
    assert_true(sum != 0);
    assert_true(faults() - before <= 1); /* getrusage()'s own, maybe */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_has_this_function_and_no_more_than_wanted),
        cmocka_unit_test(fetched_pages_are_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
