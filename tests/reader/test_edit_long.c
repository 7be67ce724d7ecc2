/* test_edit_long.c - a long paragraph is cut into several, elsewhere after each edit. All of it
 * can be typed into, and what is typed is all that changes. */
#include <reader_edit.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>
#include <string.h>

enum { WORDS = 15000, TYPED = 16, ROOM = 16 };

static char source[WORDS * ROOM];

static struct reader_document *read_text(struct reader_files *files, const char *text)
{
    struct reader_document *d;
    *files = (struct reader_files){.keep = true};
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_files_add(files, d, "one.md", text, strlen(text)), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK);
    assert_int_equal(reader_document_plain(d), READER_OK);
    return d;
}

static void as_from_scratch(const struct reader_document *d, const char *text)
{
    struct reader_files files;
    struct reader_document *again = read_text(&files, text);
    assert_string_equal(d->plain, again->plain);
    assert_int_equal(d->blocks_count, again->blocks_count);
    for (int i = 0; i < d->blocks_count; i++)
        assert_int_equal(d->blocks[i].at, again->blocks[i].at);
    reader_document_destroy(again);
    reader_files_finish(&files);
}

/* Types before these letters, one by one. */
static void type_before(const char *word)
{
    static const char typed[] = "xy, another";
    static char wanted[WORDS * ROOM + TYPED];
    struct reader_files files;
    struct reader_document *d = read_text(&files, source);
    struct reader_edit *edit;
    struct reader_edit_change change;
    assert_true(d->blocks_count >= 2);
    assert_int_equal(reader_edit_create(&d, &files, NULL, &edit), READER_OK);
    const char *in_source = strstr(source, word);
    size_t caret = (size_t)(strstr(d->plain, word) - d->plain);
    for (const char *c = typed; *c; c++) {
        if (reader_edit_insert(edit, caret, caret, c, 1, &change) != READER_OK)
            fail_msg("'%c' before %s: %s", *c, word, reader_error());
        caret = change.caret;
        reader_edit_change_finish(&change);
    }
    snprintf(wanted, sizeof wanted, "%.*s%s%s", (int)(in_source - source), source, typed,
             in_source);
    assert_string_equal(files.texts[0].text, wanted);
    as_from_scratch(d, wanted);
    while (reader_edit_can(edit, false)) {
        assert_int_equal(reader_edit_undo(edit, false, &change), READER_OK);
        reader_edit_change_finish(&change);
    }
    assert_string_equal(files.texts[0].text, source);
    reader_edit_destroy(edit);
    reader_document_destroy(d);
    reader_files_finish(&files);
}

static void long_paragraphs_are_typed_into(void **state)
{
    static const int words[] = {0, 1, 3000, 5644, 5645, 5646, 5647, 5648, 9000, 14990};
    size_t bytes = 0;
    (void)state;
    for (int i = 0; i < WORDS; i++)
        bytes += (size_t)snprintf(source + bytes, ROOM, "w%d ", i);
    source[bytes - 1] = '\n';
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        char word[ROOM];
        snprintf(word, sizeof word, "w%d ", words[k]);
        type_before(word);
    }
}

enum { HAN = 0x4e00, HAN_COUNT = 14000, HAN_BYTES = 3 };

static void han_put(char *to, int number)
{
    const unsigned c = HAN + (unsigned)number;
    snprintf(to, HAN_BYTES + 1, "%c%c%c", (char)(0xe0 | c >> 12),
             (char)(0x80 | (c >> 6 & 0x3f)), (char)(0x80 | (c & 0x3f)));
}

/* Where no blanks are between letters, there is none where the paragraph is cut. */
static void paragraphs_without_blanks_are_typed_into(void **state)
{
    static const int letters[] = {0, 1, 9000, 11263, 11264, 11265, 11266, 13999};
    (void)state;
    for (int i = 0; i < HAN_COUNT; i++)
        han_put(source + HAN_BYTES * i, i);
    strcpy(source + HAN_BYTES * HAN_COUNT, "\n");
    for (size_t k = 0; k < sizeof letters / sizeof *letters; k++) {
        char letter[HAN_BYTES + 1];
        han_put(letter, letters[k]);
        type_before(letter);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_paragraphs_are_typed_into),
        cmocka_unit_test(paragraphs_without_blanks_are_typed_into)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
