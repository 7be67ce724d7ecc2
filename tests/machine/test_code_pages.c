/* test_code_pages.c - the machine's code and constants are found, and fetched: to read them
 * afterwards takes no page fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdbool.h>
#include <sys/resource.h>

#include "../skip.h"
#include "device/code_pages.h"

enum { PAGE_BYTES = 4096 };

static void it_has_this_function_and_no_more_than_wanted(void **unused)
{
    (void)unused;
    const uintptr_t function = (uintptr_t)code_pages_find;
    for (size_t most = 1; most < (size_t)64 << 20; most *= 8) {
        struct code_range r[CODE_RANGES_MOST];
        assert_true(code_pages_find(most, r) >= 2);
        const uintptr_t begin = (uintptr_t)r[0].begin, end = (uintptr_t)r[0].end;
        assert_true(begin % PAGE_BYTES == 0 && begin <= function && function < end);
        assert_true(function - begin < most + PAGE_BYTES && end - function <= most);
    }
}

static const char constant[] = "a constant";
static const char *const with_address[] = {constant, constant};
static int variable = 1;

static bool is_in(const void *at, const struct code_range *r, int count)
{
    for (int i = 0; i < count; i++)
        if ((const char *)at >= r[i].begin && (const char *)at < r[i].end)
            return true;
    return false;
}

static void it_has_constants(void **unused)
{
    (void)unused;
    struct code_range r[CODE_RANGES_MOST];
    const int count = code_pages_find(64 << 20, r);
    assert_true(is_in(constant, r, count));
    assert_true(is_in(with_address, r, count));
    assert_false(is_in(&variable, r, count)); /* somebody may write it meanwhile */
    assert_false(is_in(r, r, count));
}

static long faults(void)
{
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    return usage.ru_minflt + usage.ru_majflt;
}

/* Reads a byte of each page. Sanitizers are not asked: it may lie between two constants. */
__attribute__((no_sanitize("address"))) static unsigned pages_sum(const struct code_range *r,
                                                                  int count)
{
    unsigned sum = 0;
    for (int i = 0; i < count; i++)
        for (const volatile char *page = r[i].begin; page < r[i].end; page += PAGE_BYTES)
            sum += (unsigned char)*page;
    return sum;
}

static void fetched_pages_are_there(void **unused)
{
    (void)unused;
    struct aside fetching = {0};
    struct code_range r[CODE_RANGES_MOST];
    code_pages_begin(&fetching);
    if (!fetching.begun)
        skip_because("there is one processor only");
    aside_end(&fetching);
    const int count = code_pages_find(64 << 10, r);
    const long before = faults();
    assert_true(pages_sum(r, count) != 0);
    assert_true(faults() - before <= 1); /* getrusage()'s own, maybe */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_has_this_function_and_no_more_than_wanted),
        cmocka_unit_test(it_has_constants),
        cmocka_unit_test(fetched_pages_are_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
