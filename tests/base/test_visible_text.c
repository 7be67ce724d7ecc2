/* test_visible_text.c - untrusted text has no effect on a terminal. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <visible_text.h>

#include "sample.h"

static void what_does_something_is_shown(void **state)
{
    (void)state;
    static const struct {
        const char *text, *shown;
    } rows[] = {
        {"marsh.lua:12: paper", "marsh.lua:12: paper"},
        {"Größe Ωmega 漢字 🎨", "Größe Ωmega 漢字 🎨"},
        {"a\nb\tc\rd", "a b c d"},
        {"\x1b]0;owned\x07", "\\x1b]0;owned\\x07"},
        {"\x1b[31mred\x7f", "\\x1b[31mred\\x7f"},
        {"\xc2\x9b"
         "2J",
         "\\u{009b}2J"}, /* the same as one character */
        {"\x9b"
         "2J",
         "\\x9b2J"},                                 /* and as a byte */
        {"txt.\xe2\x80\xaegnp", "txt.\\u{202e}gnp"}, /* what follows from right to left */
        {"a\xe2\x80\x8b"
         "b",
         "a\\u{200b}b"},
        {"\xe2\x80\xa8", "\\u{2028}"},
        {"\xef\xbb\xbf", "\\u{feff}"},
        {"\xff\xfe", "\\xff\\xfe"},
        {"\xc0\x9b", "\\xc0\\x9b"}, /* an escape in overlong UTF-8 */
        {"\xe0\x80\x9b", "\\xe0\\x80\\x9b"},
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"}, /* half a character */
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
        {"cut \xe6\xbc", "cut \\xe6\\xbc"},
        {"", ""},
    };
    char out[200];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal(visible_text(out, sizeof out, rows[i].text), strlen(rows[i].shown));
        assert_string_equal(out, rows[i].shown);
    }
}

static void lines_keep_their_ends(void **state)
{
    (void)state;
    char out[100];
    visible_text_lines(out, sizeof out, "a\tb\nc\0\x1b[2J\rx\n", 13);
    assert_string_equal(out, "a\tb\nc\\x00\\x1b[2J\\x0dx\n");
}

static void what_has_no_room_is_left_out(void **state)
{
    (void)state;
    char out[8];
    assert_int_equal(visible_text(out, 0, "abc"), 0);
    visible_text(out, 1, "abc");
    assert_string_equal(out, "");
    visible_text(out, 6, "abc\x1b");
    assert_string_equal(out, "abc");
    visible_text(out, 3, "a漢");
    assert_string_equal(out, "a");
}

/* Random bytes: no control character passes, nothing is written beyond the buffer, and visible
 * characters stay unchanged. */
static void any_bytes_are_harmless(void **state)
{
    (void)state;
    uint64_t chance = 5;
    for (int i = 0; i < 20000; i++) {
        char text[40], out[121], again[500];
        size_t length = sample_below(&chance, sizeof text - 1),
               size = sample_below(&chance, 120);
        for (size_t j = 0; j < length; j++)
            text[j] = (char)(1 + sample_below(&chance, 255));
        text[length] = '\0';
        memset(out, 'x', sizeof out);
        size_t used = visible_text(out, size, text);
        assert_true(size == 0 || (used < size && strlen(out) == used));
        for (size_t j = size; j < sizeof out; j++)
            assert_int_equal(out[j], 'x');
        for (size_t j = 0; j < used && size; j++)
            assert_true((unsigned char)out[j] >= ' ' && out[j] != 127);
        if (size) {
            visible_text(again, sizeof again, out);
            assert_string_equal(again, out);
        }
    }
}

/* The way out for errors: one line, whatever the text holds; too long a text is cut off. */
static void what_is_said_is_one_line(void **state)
{
    (void)state;
    static char said[8192], longer[6000];
    int ends[2], before = dup(STDERR_FILENO);
    memset(longer, '\x1b', sizeof longer - 1);
    assert_int_equal(pipe(ends), 0);
    dup2(ends[1], STDERR_FILENO);
    visible_say("%s: %d\x1b]0;%s\x07\r", "a\nb", 3, "\xe2\x80\xae");
    visible_say("%s", longer);
    dup2(before, STDERR_FILENO);
    close(before);
    close(ends[1]);
    size_t count = 0;
    for (ssize_t got; (got = read(ends[0], said + count, sizeof said - 1 - count)) > 0;)
        count += (size_t)got;
    close(ends[0]);
    const char *first = "a b: 3\\x1b]0;\\u{202e}\\x07 \n";
    assert_memory_equal(said, first, strlen(first));
    size_t lines = 0;
    for (size_t i = 0; i < count; i++) {
        lines += said[i] == '\n';
        assert_true(said[i] == '\n' || (unsigned char)said[i] >= ' ');
    }
    assert_int_equal(lines, 2);
    assert_int_equal(said[count - 1], '\n');
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_does_something_is_shown),
        cmocka_unit_test(lines_keep_their_ends),
        cmocka_unit_test(what_has_no_room_is_left_out),
        cmocka_unit_test(any_bytes_are_harmless),
        cmocka_unit_test(what_is_said_is_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
