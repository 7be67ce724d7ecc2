/* fuzz_options.c - random command lines. Each is accepted, with values in range, or refused in
 * one line. */
#include <options.h>

#include "lutetia.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sample.h"

enum { LINES = 40000, ARGUMENTS_MAX = 9 };

static int complaints;
static char complaint[2048];

/* Replaces the command's function, which prints: counts the message and keeps it. */
int fail_usage(const char *verb, const char *format, ...)
{
    va_list arguments;
    (void)verb;
    va_start(arguments, format);
    vsnprintf(complaint, sizeof complaint, format, arguments);
    va_end(arguments);
    complaints++;
    return EXIT_USAGE;
}

static uint64_t random_state = 3;

static const char *const pieces[] = {
    "--steps",     "--gravity", "--ink",
    "--paper",     "--pool",    "--out",
    "--loud",      "-o",        "--",
    "-",           "---",       "=",
    ",",           "x",         "1",
    "0",           "-1",        "0.5",
    "2",           "10",        "1e3",
    "1e999",       "nan",       "-inf",
    "0x10",        " 3",        "1,2",
    "0,0.5,1",     "1,,2",      "64x48",
    "64x",         "x48",       "9999999999999999999",
    "\xff\xfe",    "%s%n",      "",
    "Wet Fonts",   "--steps=5", "--gravity=",
    "--ink=0,0,0", "-ofile",    "--nothing",
    "--set",       "--set=a=1", "-sb=2",
    "-z",          "+7",        "1_000",
    "٣",           "\n",
};

enum { PIECES = sizeof pieces / sizeof *pieces };

static char *argument_make(char *buffer, size_t size)
{
    uint32_t joined = sample_below(&random_state, 4) ? 1 : 1 + sample_below(&random_state, 4);
    buffer[0] = '\0';
    for (uint32_t i = 0; i < joined; i++)
        strncat(buffer, pieces[sample_below(&random_state, PIECES)], size - strlen(buffer) - 1);
    if (sample_below(&random_state, 16) == 0 && buffer[0])
        buffer[sample_below(&random_state, (uint32_t)strlen(buffer))] =
            (char)(1 + sample_below(&random_state, 255));
    return buffer;
}

static void random_lines_are_taken_or_refused(void **state)
{
    (void)state;
    int taken = 0, refused = 0;
    for (int line = 0; line < LINES; line++) {
        int steps = 3, size[2] = {8, 8};
        double gravity = 1, ink[3] = {0};
        const char *out = "out";
        bool loud = false;
        static struct option_list pools;
        static struct option_texts sets;
        pools.count = sets.count = 0;
        const struct option_row rows[] = {
            {"steps", 0, OPTION_INTEGER, "N", "", &steps, 0, 1e6, 0},
            {"gravity", 'g', OPTION_NUMBER, "G", "", &gravity, 0.5, 2, 0},
            {"ink", 0, OPTION_NUMBERS, "C,M,Y", "", ink, 0, 1, 3},
            {"paper", 0, OPTION_SIZE, "WxH", "", size, 8, 16384, 0},
            {"pool", 0, OPTION_LIST, "A,B", "", &pools, -10, 10, 2},
            {"set", 's', OPTION_TEXTS, "NAME=VALUE", "", &sets, 0, 0, 0},
            {"out", 'o', OPTION_TEXT, "FILE", "", &out, 0, 0, 0},
            {"loud", 0, OPTION_FLAG, NULL, "", &loud, 0, 0, 0},
            {0}};
        char buffers[ARGUMENTS_MAX][256], *arguments[ARGUMENTS_MAX + 1] = {NULL};
        static char verb[] = "paint";
        int count = 1 + (int)sample_below(&random_state, ARGUMENTS_MAX - 1);
        arguments[0] = verb;
        for (int i = 1; i < count; i++)
            arguments[i] = argument_make(buffers[i], sizeof buffers[i]);
        struct option_words words;
        complaints = 0;
        bool fine = options_parse("paint", rows, count, arguments, &words);
        assert_int_equal(complaints, fine ? 0 : 1);
        if (fine)
            taken++;
        else
            refused++;
        assert_true(steps >= 0 && steps <= 1000000);
        assert_true(gravity >= 0.5 && gravity <= 2);
        assert_true(size[0] >= 8 && size[0] <= 16384 && size[1] >= 8 && size[1] <= 16384);
        assert_true(pools.count >= 0 && pools.count <= OPTION_LIST_MAX);
        for (int i = 0; i < 3; i++)
            assert_true(ink[i] >= 0 && ink[i] <= 1);
        for (int i = 0; i < pools.count; i++)
            assert_true(fabs(pools.numbers[i][0]) <= 10 && fabs(pools.numbers[i][1]) <= 10);
        assert_true(!fine || (out && *out));
        assert_true(words.count >= 0 && words.count <= OPTION_WORDS_MAX);
    }
    assert_true(taken > LINES / 100 && refused > LINES / 100);
}

static void lists_and_words_have_an_end(void **state)
{
    (void)state;
    static struct option_list pools;
    const struct option_row rows[] = {{"pool", 0, OPTION_LIST, "A,B", "", &pools, -10, 10, 2},
                                      {0}};
    static char verb[] = "paint", pool[] = "--pool=1,2", word[] = "w";
    char *arguments[OPTION_LIST_MAX + 3];
    struct option_words words;
    for (int i = 0; i < OPTION_LIST_MAX + 2; i++)
        arguments[i] = i ? pool : verb;
    complaints = 0;
    assert_false(options_parse("paint", rows, OPTION_LIST_MAX + 2, arguments, &words));
    assert_int_equal(complaints, 1);
    for (int i = 1; i < OPTION_LIST_MAX + 2; i++)
        arguments[i] = word;
    assert_false(options_parse("paint", rows, OPTION_WORDS_MAX + 2, arguments, &words));
    assert_int_equal(complaints, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_lines_are_taken_or_refused),
                                       cmocka_unit_test(lists_and_words_have_an_end)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
