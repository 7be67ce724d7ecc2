/* test_word_list.c - words with blanks between them are counted and found. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <word_list.h>

#include <string.h>

static void word_is(const char *list, int index, const char *word)
{
    size_t length;
    const char *found = word_list_at(list, index, &length);
    assert_int_equal(length, strlen(word));
    assert_memory_equal(found, word, length);
}

static void words_are_counted_and_found(void **state)
{
    static const char list[] = "  wet  dry on-paper ";
    (void)state;
    assert_int_equal(word_list_count(list), 3);
    word_is(list, 0, "wet");
    word_is(list, 1, "dry");
    word_is(list, 2, "on-paper");
    word_is(list, 3, "");
    word_is(list, 9, "");
    assert_int_equal(word_list_find(list, "wet"), 0);
    assert_int_equal(word_list_find(list, "on-paper"), 2);
    assert_int_equal(word_list_find(list, "on"), -1);
    assert_int_equal(word_list_find(list, "dry on-paper"), -1);
    assert_int_equal(word_list_find(list, ""), -1);
    assert_int_equal(word_list_find("", "wet"), -1);
    assert_int_equal(word_list_count("one"), 1);
    word_is("one", 0, "one");
    assert_int_equal(word_list_count(""), 0);
    assert_int_equal(word_list_count("   "), 0);
    word_is("   ", 0, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(words_are_counted_and_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
