/* test_control.c - a table of controls: they are found, read, written and refused, and
 * converted to a slider's place and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <control_table.h>
#include <spring_controls.h>
#include <word.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double value_read(void *actor, int index)
{
    return ((double *)actor)[index];
}

static unsigned value_write(void *actor, int index, double value)
{
    if (value == 13)
        return stage_fail(STAGE_FAILED, "thirteen is not wanted");
    ((double *)actor)[index] = value;
    return STAGE_OK;
}

#define ACCESS .read = value_read, .write = value_write
static const struct control rows[] = {
    {"gravity", "em/s2", -100, 100, 9.81, CONTROL_LINEAR, NULL, "", ACCESS, .at = 0},
    {"stiffness", "kg/s2", 0, 1e6, 500, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 1},
    {"mass", "kg", 1e-3, 1e3, 1, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 2},
    {"floor", "", 0, 1, 1, CONTROL_SWITCH, NULL, "", ACCESS, .at = 3},
    {"step", "", 0, 2, 0, CONTROL_CHOICE, "symplectic verlet thesis", "", ACCESS, .at = 4}};
enum { ROWS = sizeof rows / sizeof *rows };

static void names_are_found(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++)
        assert_ptr_equal(stage_control_find(rows, ROWS, rows[i].name), &rows[i]);
    assert_null(stage_control_find(rows, ROWS, "gravita"));
    assert_string_equal(stage_error(), "there is no control 'gravita'; there are gravity, "
                                       "stiffness, mass, floor, step");
}

static void values_are_within_their_range(void **state)
{
    (void)state;
    double values[ROWS] = {0};
    assert_int_equal(stage_control_write(&rows[0], values, 3.5), STAGE_OK);
    assert_true(control_read(&rows[0], values) == 3.5);
    const double wrong[] = {-100.1, 101, NAN, INFINITY};
    for (int i = 0; i < 4; i++)
        assert_int_equal(stage_control_write(&rows[0], values, wrong[i]), STAGE_BAD_ARGUMENT);
    assert_string_equal(stage_error(), "gravity must be -100..100 em/s2 (got inf)");
    assert_int_equal(stage_control_write(&rows[3], values, 0.5), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_control_write(&rows[4], values, 3), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_control_write(&rows[0], values, 13), STAGE_FAILED);
    assert_true(values[0] == 3.5 && values[3] == 0 && values[4] == 0);
}

static void texts_are_values_and_back(void **state)
{
    (void)state;
    static const struct {
        int row;
        const char *text;
        double value;
        const char *written;
    } good[] = {{0, "9.81", 9.81, "9.81"},
                {0, "-1e1", -10, "-10"},
                {3, "on", 1, "on"},
                {3, "off", 0, "off"},
                {3, "1", 1, "on"},
                {4, "verlet", 1, "verlet"},
                {4, "1", 1, "verlet"},
                {4, "thesis", 2, "thesis"},
                {1, "123456", 123456, "1.235e+05"}};
    static const struct {
        int row;
        const char *text;
    } bad[] = {{0, ""},        {0, "1x"}, {0, "nan"}, {0, "inf"}, {3, "yes"}, {4, "ver"},
               {4, "thesis2"}, {4, " "},  {4, "3"},   {4, "0.5"}, {0, "1000"}};
    double value;
    char text[32];
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        assert_int_equal(stage_control_parse(&rows[good[i].row], good[i].text, &value),
                         STAGE_OK);
        assert_true(value == good[i].value);
        control_text(&rows[good[i].row], value, text, sizeof text);
        assert_string_equal(text, good[i].written);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (stage_control_parse(&rows[bad[i].row], bad[i].text, &value) != STAGE_BAD_ARGUMENT)
            fail_msg("'%s' is %g", bad[i].text, value);
}

/* A number that is typed has the decimals that it needs, and no others. */
static void numbers_have_their_decimals(void **state)
{
    (void)state;
    static const struct {
        double least, most, value;
        const char *text;
    } numbers[] = {{0, 4, 1.5, "1.5"},
                   {0, 4, 1.0625, "1.0625"},
                   {0, 4, 0, "0"},
                   {-4, 4, -0.0, "0"},
                   {0, 1000, 440.5, "440.5"},
                   {0, 1000, 1000, "1000"},
                   {0, 1e6, 123456, "123456"},
                   {0, 0.01, 0.00125, "0.00125"},
                   {0, 4, 1.0 / 3, "0.33333"},
                   {-1, 1, -0.125, "-0.125"},
                   {0, 1, 1e-12, "0"},
                   {0, 1e300, 1e300, NULL}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const struct control row = {
            .name = "a", .unit = "", .least = numbers[i].least, .most = numbers[i].most};
        char text[400], few[4];
        control_number(&row, numbers[i].value, text, sizeof text);
        if (numbers[i].text)
            assert_string_equal(text, numbers[i].text);
        assert_true(fabs(strtod(text, NULL) - numbers[i].value) <=
                    fmax(1e-9, 1e-4 * fabs(numbers[i].value)));
        control_number(&row, numbers[i].value, few, sizeof few);
        assert_true(strlen(few) < sizeof few);
    }
}

/* A slider's value rises from least to most, and converting a value to its place and back
 * returns the value. */
static void sliders_are_curves(void **state)
{
    (void)state;
    for (int r = 0; r < 3; r++) {
        double before = -INFINITY;
        assert_true(control_at(&rows[r], 0) == rows[r].least);
        assert_true(fabs(control_at(&rows[r], 1) / rows[r].most - 1) < 1e-12);
        for (int i = 0; i <= 1000; i++) {
            double along = i / 1000.0, value = control_at(&rows[r], along);
            assert_true(value > before);
            assert_true(fabs(control_along(&rows[r], value) - along) < 1e-9);
            before = value;
        }
    }
    assert_true(control_at(&rows[4], 0.4) == 1);
    assert_true(control_at(&rows[3], 0.4) == 0);
    assert_true(control_along(&rows[0], 1e9) == 1);
}

/* What is usual is in the middle, what is useful around it; what MIDI plays goes the same way
 * (live_player.c). */
static void useful_values_are_in_the_middle(void **state)
{
    (void)state;
    static const struct {
        struct control row;
        double low, high, share; /* these values have at least this share of the way */
    } ways[] = {
        {{"side", "", 0, 1e6, 900, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 0},
         100,
         3000,
         0.3},
        {{"mass", "", 1e-3, 1e3, 1, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 0},
         0.1,
         10,
         0.4},
        {{"gravity", "", -100, 100, 9.81, CONTROL_CENTRED, NULL, "", ACCESS, .at = 0},
         -10,
         30,
         0.3},
        {{"wind", "", -100, 100, 0, CONTROL_CENTRED, NULL, "", ACCESS, .at = 0}, -10, 10, 0.17},
        {{"drag", "", 0, 1000, 0.02, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 0},
         0.002,
         0.2,
         0.35},
        {{"breaking", "", 0, 100, 0, CONTROL_LOGARITHMIC, NULL, "", ACCESS, .at = 0},
         0.1,
         10,
         0.4}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        const struct control *row = &ways[i].row;
        const double low = control_along(row, ways[i].low),
                     high = control_along(row, ways[i].high);
        if (row->usual > row->least)
            assert_true(fabs(control_along(row, row->usual) - 0.5) < 1e-12);
        if (!(low > 0.15 && high < 0.85 && high - low >= ways[i].share))
            fail_msg("%s: %g is at %g, %g at %g", row->name, ways[i].low, low, ways[i].high,
                     high);
        assert_true(control_at(row, 0) == row->least);
        assert_true(control_at(row, 1) == row->most);
        double before = -INFINITY;
        for (int k = 0; k <= 1000; k++) {
            const double value = control_at(row, k / 1000.0);
            assert_true(value > before);
            assert_true(fabs(control_along(row, value) - k / 1000.0) < 1e-9);
            before = value;
        }
    }
}

/* Of all that springs and words have; places that are far away have no sliders. */
static void springs_sliders_begin_in_the_middle(void **state)
{
    (void)state;
    const double sliders_most = 1e5, beside = 0.11;
    for (int i = 0; i < dyn_controls_count + dyn_word_controls_count; i++) {
        const struct control *row = i < dyn_controls_count
                                        ? &dyn_controls[i]
                                        : &dyn_word_controls[i - dyn_controls_count];
        const bool has_slider =
            row->curve != CONTROL_SWITCH && row->curve != CONTROL_CHOICE &&
            (row->curve == CONTROL_LOGARITHMIC || row->most - row->least < sliders_most);
        const double along = control_along(row, row->usual);
        if (has_slider && row->usual > row->least && fabs(along - 0.5) > beside)
            fail_msg("%s: what is usual is at %.2f of its way", row->name, along);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_found),
        cmocka_unit_test(values_are_within_their_range),
        cmocka_unit_test(texts_are_values_and_back),
        cmocka_unit_test(numbers_have_their_decimals),
        cmocka_unit_test(sliders_are_curves),
        cmocka_unit_test(useful_values_are_in_the_middle),
        cmocka_unit_test(springs_sliders_begin_in_the_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
