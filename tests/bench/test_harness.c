/* test_harness.c - medians, ratios and the JSON of the benchmarks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "harness.h"

static bool equal(double a, double b)
{
    return a - b < 1e-9 && b - a < 1e-9;
}

static void sample_of_odd_and_even_counts(void **state)
{
    double odd[] = {5, 1, 3}, even[] = {4, 8, 2, 6};
    struct bench_sample s = bench_sample_of(odd, 3);

    (void)state;
    assert_true(equal(s.median, 3) && equal(s.min, 1));
    s = bench_sample_of(even, 4);
    assert_true(equal(s.median, 5) && equal(s.min, 2));
}

static bool work_count(void *context)
{
    ++*(int *)context;
    return true;
}

static bool work_fails(void *context)
{
    (void)context;
    return bench_fail("it broke at %d", 7);
}

static void measure_warms_up_once(void **state)
{
    int runs = 0;
    struct bench_sample s;

    (void)state;
    assert_true(bench_measure(work_count, &runs, 10, &s));
    assert_int_equal(runs, 11);
    assert_true(s.min >= 0 && s.min <= s.median);
}

static void measure_stops_at_failure(void **state)
{
    struct bench_sample s;

    (void)state;
    assert_false(bench_measure(work_fails, NULL, 10, &s));
    assert_string_equal(bench_error(), "it broke at 7");
}

static void write_gives_one_object(void **state)
{
    static struct bench_report r;
    char directory[] = "/tmp/test_harness_XXXXXX", path[64], text[2048];

    (void)state;
    assert_non_null(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/b.json", directory);
    bench_report_init(&r, "diffusion", 2, "a \"device\"");
    bench_report_add(&r, "listing", "4x4", (struct bench_sample){3e-9, 2e-9}, 1e9, "ns");
    bench_report_add(&r, "hand", "4x4", (struct bench_sample){1.5e-9, 1e-9}, 1e9, "ns");
    assert_true(bench_report_write(&r, path));

    FILE *f = fopen(path, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = 0;
    fclose(f);
    assert_non_null(strstr(text, "{\"bench\": \"diffusion\", \"commit\": \""));
    assert_non_null(strstr(text, "\"device\": \"a \\\"device\\\"\", \"threads\": 2,"));
    assert_non_null(strstr(text, "{\"what\": \"listing\", \"case\": \"4x4\", \"value\": 3, "
                                 "\"min\": 2, \"unit\": \"ns\"}"));
    assert_true(equal(bench_report_find(&r, "hand", "4x4")->value, 1.5));
    assert_null(bench_report_find(&r, "hand", "5x5"));
    unlink(path);
    assert_int_equal(rmdir(directory), 0); /* nothing else was left there */
}

static void write_to_nowhere_says_so(void **state)
{
    static struct bench_report r;

    (void)state;
    bench_report_init(&r, "diffusion", 2, "");
    assert_false(bench_report_write(&r, "/nonexistent/b.json"));
    assert_non_null(strstr(bench_error(), "/nonexistent/b.json cannot be written"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sample_of_odd_and_even_counts),
        cmocka_unit_test(measure_warms_up_once),
        cmocka_unit_test(measure_stops_at_failure),
        cmocka_unit_test(write_gives_one_object),
        cmocka_unit_test(write_to_nowhere_says_so),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
