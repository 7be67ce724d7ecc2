/* test_number_text.c - numbers are read back as they were, from texts without digits that they
 * do not need, with points wherever the program is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <number_text.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void numbers_are_read_back(void **state)
{
    uint64_t seed = 1990;
    char text[NUMBER_TEXT_BYTES];
    (void)state;
    for (int i = 0; i < 200000; i++) {
        double value, back;
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        memcpy(&value, &seed, sizeof value);
        if (isnan(value))
            continue;
        assert_ptr_equal(number_text(value, text), text);
        back = strtod(text, NULL);
        assert_memory_equal(&back, &value, sizeof value);
    }
}

static void no_digit_is_too_many(void **state)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},
                 {-0.0, "-0"},
                 {0.1, "0.1"},
                 {0.1 + 0.2, "0.30000000000000004"},
                 {1e16 / 3, "3333333333333333.5"},
                 {20, "20"},
                 {1e300, "1e+300"},
                 {-DBL_MAX, "-1.7976931348623157e+308"},
                 {INFINITY, "inf"},
                 {NAN, "nan"}};
    char text[NUMBER_TEXT_BYTES];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(number_text(cases[i].value, text), cases[i].text);
}

/* Where there is no locale with a comma, this says only that a point stays one. */
static void points_are_points(void **state)
{
    static const char *const commas[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"};
    struct number_text_locale plain;
    char text[NUMBER_TEXT_BYTES], before[NUMBER_TEXT_BYTES];
    (void)state;
    for (size_t i = 0; i < sizeof commas / sizeof *commas; i++)
        if (setlocale(LC_NUMERIC, commas[i]))
            break;
    number_text(0.5, before);
    assert_true(number_text_begin(&plain));
    assert_string_equal(number_text(0.5, text), "0.5");
    number_text_end(&plain);
    assert_string_equal(number_text(0.5, text), before);
    setlocale(LC_NUMERIC, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_read_back),
        cmocka_unit_test(no_digit_is_too_many),
        cmocka_unit_test(points_are_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
