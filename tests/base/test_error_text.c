/* test_error_text.c - the text of a module's last failure; each thread has its own. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <error_text.h>

static _Thread_local struct error_text last;

static void fail_keeps_the_words_and_returns_the_status(void **state)
{
    (void)state;
    assert_int_equal(error_text_fail(&last, 7, "%s %d", "width", -3), 7);
    assert_string_equal(last.text, "width -3");
    assert_int_equal(error_text_fail(&last, 0, "again"), 0);
    assert_string_equal(last.text, "again");
    assert_false(error_text_false(&last, "%s of %d", "row", 2));
    assert_string_equal(last.text, "row of 2");
}

static void fail_may_quote_the_words_before(void **state)
{
    (void)state;
    error_text_fail(&last, 1, "no device");
    error_text_fail(&last, 1, "%s: %s (%s)", "page 3", last.text, last.text);
    assert_string_equal(last.text, "page 3: no device (no device)");
}

static void long_words_are_cut(void **state)
{
    (void)state;
    char words[3 * ERROR_TEXT_BYTES];
    memset(words, 'w', sizeof words - 1);
    words[sizeof words - 1] = '\0';
    error_text_fail(&last, 1, "%s", words);
    assert_int_equal(strlen(last.text), ERROR_TEXT_BYTES - 1);
    assert_memory_equal(last.text, words, ERROR_TEXT_BYTES - 1);
}

static void *fail_elsewhere(void *before)
{
    memcpy(before, last.text, sizeof last.text);
    error_text_fail(&last, 1, "elsewhere");
    return NULL;
}

static void threads_have_words_of_their_own(void **state)
{
    (void)state;
    char before[ERROR_TEXT_BYTES] = "unset";
    pthread_t other;
    error_text_fail(&last, 1, "here");
    assert_int_equal(pthread_create(&other, NULL, fail_elsewhere, before), 0);
    assert_int_equal(pthread_join(other, NULL), 0);
    assert_string_equal(before, "");
    assert_string_equal(last.text, "here");
}

static void lists_have_whole_words_only(void **state)
{
    (void)state;
    struct {
        char text[12], after[4];
    } list = {"", "end"};
    static const char *const words[] = {"rest", "mass", "strain", "at", "to", "x"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        error_text_list(list.text, sizeof list.text, " ", words[i]);
    assert_string_equal(list.text, "rest mass x"); /* "at" and "to" would need one byte more */
    assert_string_equal(list.after, "end");
    list.text[0] = '\0';
    error_text_list(list.text, sizeof list.text, ", ", "eleven byte");
    assert_string_equal(list.text, "eleven byte"); /* nothing stands before the first */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fail_keeps_the_words_and_returns_the_status),
        cmocka_unit_test(fail_may_quote_the_words_before),
        cmocka_unit_test(long_words_are_cut),
        cmocka_unit_test(threads_have_words_of_their_own),
        cmocka_unit_test(lists_have_whole_words_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
