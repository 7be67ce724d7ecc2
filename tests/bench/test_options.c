/* test_options.c - the benchmarks' options, and the diagram of their rows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "display.h"
#include "options.h"

static struct bench_options defaults(void)
{
    return (struct bench_options){.name = "test",
                                  .sizes = {{7, 7}},
                                  .sizes_count = 1,
                                  .size_least = 4,
                                  .size_most = 100,
                                  .repeat_least = 10,
                                  .repeat_count = 11};
}

static int parse(struct bench_options *o, int argc, const char *a, const char *b)
{
    char name[] = "test", first[64], second[64];
    char *argv[] = {name, first, second, NULL};

    snprintf(first, sizeof first, "%s", a);
    snprintf(second, sizeof second, "%s", b);
    return bench_options_parse(o, argc, argv);
}

static void sizes_are_read(void **state)
{
    struct bench_options o = defaults();

    (void)state;
    assert_int_equal(parse(&o, 3, "--sizes", "8,9x10,100"), -1);
    assert_int_equal(o.sizes_count, 3);
    assert_int_equal(o.sizes[0][1], 8);
    assert_int_equal(o.sizes[1][0], 9);
    assert_int_equal(o.sizes[1][1], 10);
    o = defaults();
    o.lines = true;
    assert_int_equal(parse(&o, 3, "--sizes", "8"), -1);
    assert_int_equal(o.sizes[0][1], 1);
}

static void thorough_is_a_word_alone(void **state)
{
    struct bench_options o = defaults();

    (void)state;
    assert_int_equal(parse(&o, 2, "--thorough", ""), 2); /* nothing to be thorough in */
    o.thorough_does = "all";
    assert_int_equal(parse(&o, 1, "", ""), -1);
    assert_false(o.thorough);
    assert_int_equal(parse(&o, 2, "--thorough", ""), -1);
    assert_true(o.thorough);
    o.thorough = false;
    char name[] = "test", first[] = "--repeat", value[] = "12", second[] = "--thorough",
         third[] = "--sizes", sides[] = "9";
    char *argv[] = {name, first, value, second, third, sides, NULL};
    assert_int_equal(bench_options_parse(&o, 6, argv), -1);
    assert_true(o.thorough && o.repeat_count == 12 && o.sizes[0][0] == 9);
}

static void bad_options_are_told(void **state)
{
    static const struct {
        int argc;
        const char *a, *b, *told;
    } bad[] = {
        {2, "--nothing", "", "no option \"--nothing\""},
        {2, "--json", "", "--json needs a value"},
        {3, "--json", "/proc/none/a.json", "/proc/none/a.json: cannot write"},
        {3, "--plot", "/none/a.png", "/none/a.png: cannot write"},
        {3, "--sizes", "3", "4..100 (got \"3\")"},
        {3, "--sizes", "8,", "(got \"8,\")"},
        {3, "--sizes", "8x101", "4..100"},
        {3, "--sizes", "8;9", "(got \"8;9\")"},
        {3, "--repeat", "9", "--repeat must be 10..10000 (got \"9\")"},
        {3, "--repeat", "12a", "(got \"12a\")"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct bench_options o = defaults();

        assert_int_equal(parse(&o, bad[i].argc, bad[i].a, bad[i].b), 2);
        if (!strstr(bench_error(), bad[i].told))
            fail_msg("%s %s: \"%s\" does not say \"%s\"", bad[i].a, bad[i].b, bench_error(),
                     bad[i].told);
    }
    struct bench_options o = defaults();
    o.sizes_count = 0;
    assert_int_equal(parse(&o, 3, "--sizes", "8"), 2);
}

/* The longest run of gray in a row of pixels. */
static int run_longest(const struct display_image *image, int y)
{
    const uint8_t *row = image->pixels + (size_t)y * (size_t)image->width_px;
    int longest = 0, run = 0;

    for (int x = 0; x < image->width_px; x++) {
        run = row[x] < 200 ? run + 1 : 0;
        longest = run > longest ? run : longest;
    }
    return longest;
}

static void bars_are_as_long_as_values(void **state)
{
    static struct bench_report r;
    char path[] = "/tmp/test_options_XXXXXX";
    struct display_image image;
    int lengths[2] = {0, 0}, count = 0;

    (void)state;
    bench_report_init(&r, "test", 1, "device");
    bench_report_add(&r, "a", "case", (struct bench_sample){3, 2}, 1, "s");
    bench_report_add(&r, "b", "case", (struct bench_sample){1, 1}, 1, "s");
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    if (!bench_plot(&r, path))
        fail_msg("%s", bench_error());
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    unlink(path);
    for (int y = 0; y < image.height_px; y++) {
        int run = run_longest(&image, y);

        if (run > 50 && (!count || run != lengths[count - 1])) {
            assert_in_range(count, 0, 1);
            lengths[count++] = run;
        }
    }
    display_image_destroy(&image);
    assert_int_equal(count, 2);
    assert_in_range(lengths[0], 3 * lengths[1] - 3, 3 * lengths[1] + 3);
}

static void plot_to_nowhere_says_so(void **state)
{
    static struct bench_report r;

    (void)state;
    bench_report_init(&r, "test", 1, "device");
    assert_false(bench_plot(&r, "/nonexistent/a.png"));
    assert_non_null(strstr(bench_error(), "/nonexistent/a.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_read),          cmocka_unit_test(thorough_is_a_word_alone),
        cmocka_unit_test(bad_options_are_told),    cmocka_unit_test(bars_are_as_long_as_values),
        cmocka_unit_test(plot_to_nowhere_says_so),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
