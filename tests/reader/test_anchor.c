/* test_anchor.c - anchors after changes that nobody told them, beside an oracle whose letters
 * know where they come from; and after changes that they were told. READER_TEST_EDITS changes
 * the number of random edits. */
#include <reader_anchor.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LETTERS_MAX = 1 << 15, ANCHORS = 50, SIDE = 32 };

/* ---- the oracle: a text whose letters have numbers, which copies keep ---- */

struct text {
    char letters[LETTERS_MAX + 1];
    int numbers[LETTERS_MAX];
    size_t count;
    int next;
};

static uint32_t random_state = 2463534242u;

static size_t below(size_t bound)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return bound ? (random_state >> 8) % bound : 0;
}

static const char *const sentences[] = {"The water rises by night. ",
                                        "The water rises by day. ",
                                        "Nobody knows how deep it is. ",
                                        "In the marsh there is an island, and a town on it. ",
                                        "In the marsh there is an island, and a tower on it. ",
                                        "Rain. ",
                                        "It is said again and again that the walls are old. ",
                                        "\n\n## A chapter\n\n",
                                        "\n\n"};

static void replace(struct text *t, size_t at, size_t removed, const char *with, size_t n,
                    const int *numbers)
{
    if (t->count - removed + n > LETTERS_MAX)
        return;
    memmove(t->letters + at + n, t->letters + at + removed, t->count - at - removed);
    memmove(t->numbers + at + n, t->numbers + at + removed,
            (t->count - at - removed) * sizeof *t->numbers);
    for (size_t i = 0; i < n; i++) {
        t->letters[at + i] = with[i];
        t->numbers[at + i] = numbers ? numbers[i] : t->next++;
    }
    t->count = t->count - removed + n;
}

static void sentence_add(struct text *t, size_t at)
{
    const char *s = sentences[below(sizeof sentences / sizeof *sentences)];
    replace(t, at, 0, s, strlen(s), NULL);
}

static void text_make(struct text *t, int count)
{
    *t = (struct text){.next = 1};
    for (int i = 0; i < count; i++) {
        sentence_add(t, t->count);
        if (below(3) == 0) { /* a word that may tell it apart */
            char word[16];
            int n = snprintf(word, sizeof word, "%zu ", below(1000));
            replace(t, t->count, 0, word, (size_t)n, NULL);
        }
    }
}

/* A letter typed, letters erased, a sentence put in, a passage moved, one written twice. */
static void text_edit(struct text *t)
{
    char part[300];
    int numbers[300];
    size_t at = below(t->count), n = below(80);
    n = n < t->count - at ? n : t->count - at;
    switch (below(6)) {
    case 0:
        replace(t, at, 0, "x", 1, NULL);
        break;
    case 1:
        replace(t, at, n / 8, "", 0, NULL);
        break;
    case 2:
        replace(t, at, n, "", 0, NULL);
        break;
    case 3:
        sentence_add(t, at);
        break;
    default: /* moved, or copied */
        n = below(sizeof part);
        n = n < t->count - at ? n : t->count - at;
        memcpy(part, t->letters + at, n);
        memcpy(numbers, t->numbers + at, n * sizeof *numbers);
        if (below(3))
            replace(t, at, n, "", 0, NULL);
        replace(t, below(t->count), 0, part, n, numbers);
    }
    while (t->count < 3000)
        sentence_add(t, below(t->count));
}

/* ---- anchors beside it ---- */

struct tried {
    struct reader_anchor *anchor;
    char text[2 * SIDE + 200]; /* with its neighbours */
    int numbers[200];
    size_t left, count, right;
};

static void tried_make(struct tried *a, const struct text *t)
{
    size_t count = 1 + below(120), begin = below(t->count - count);
    a->count = count;
    a->left = begin < SIDE ? begin : SIDE;
    a->right = t->count - begin - count < SIDE ? t->count - begin - count : SIDE;
    memcpy(a->text, t->letters + begin - a->left, a->left + count + a->right);
    memcpy(a->numbers, t->numbers + begin, count * sizeof *a->numbers);
    assert_int_equal(reader_anchor_make(t->letters, t->count, begin, begin + count, &a->anchor),
                     READER_OK);
}

/* Whether more than half of its own letters stand at a place, each where it was: one that was
 * erased may have been written again. */
static bool stands(const struct tried *a, const struct text *t, size_t at)
{
    size_t own = 0;
    for (size_t i = 0; i < a->count && at + a->count <= t->count; i++)
        own += t->numbers[at + i] == a->numbers[i];
    return 2 * own > a->count;
}

/* Of what stands before a place, and behind it, how many are what stood there: 32 bytes
 * each. */
static int neighbours(const struct tried *a, const struct text *t, size_t at)
{
    const char *behind = a->text + a->left + a->count;
    bool before = at >= a->left && memcmp(t->letters + at - a->left, a->text, a->left) == 0;
    bool after = at + a->count + a->right <= t->count &&
                 memcmp(t->letters + at + a->count, behind, a->right) == 0;
    return before + after;
}

struct tally {
    long found, orphans, moved_text;
};

static void tried_check(const struct tried *a, const struct text *t, struct tally *tally)
{
    size_t begin = 7, end = 9, own = 0;
    for (size_t at = 0; at + a->count <= t->count; at++)
        own += stands(a, t, at) && neighbours(a, t, at) > 0 &&
               memcmp(t->letters + at, a->text + a->left, a->count) == 0;
    enum reader_found found = reader_anchor_find(a->anchor, t->letters, t->count, &begin, &end);
    if (found == READER_ANCHOR_ORPHAN) {
        tally->orphans++;
        assert_true(begin == 7 && end == 9);
        return;
    }
    tally->found++;
    assert_int_equal(end - begin, a->count);
    assert_memory_equal(t->letters + begin, a->text + a->left, a->count);
    if (stands(a, t, begin))
        return;
    /* Not its own letters: only where the same stands between the same neighbours, or, its own
     * being gone or parted from all that stood beside them, beside one of these. */
    tally->moved_text++;
    if (neighbours(a, t, begin) < (own ? 2 : 1))
        fail_msg("'%.*s' was taken for that of '%.*s', which only looks alike", (int)a->count,
                 t->letters + begin, (int)(a->left + a->count + a->right), a->text);
}

static void random_edits_lead_to_no_look_alike(void **state)
{
    (void)state;
    static struct text t;
    static struct tried anchors[ANCHORS];
    struct tally tally = {0};
    const char *asked = getenv("READER_TEST_EDITS");
    long edits = asked ? strtol(asked, NULL, 10) : 100;
    for (long done = 0; done < edits;) {
        text_make(&t, 150);
        for (int i = 0; i < ANCHORS; i++)
            tried_make(&anchors[i], &t);
        for (int k = 0; k < 20; k++, done++) {
            text_edit(&t);
            if (k % 4 == 0)
                for (int i = 0; i < ANCHORS; i++)
                    tried_check(&anchors[i], &t, &tally);
        }
        for (int i = 0; i < ANCHORS; i++)
            reader_anchor_destroy(anchors[i].anchor);
    }
    printf("%ld edits: %ld found, %ld of them text that was written again, %ld orphans\n",
           edits, tally.found, tally.moved_text, tally.orphans);
    assert_true(tally.found > tally.orphans && tally.orphans > 0);
}

/* Which letters belong to the anchor: its own, and those that were put in between two of
 * them. */
static bool belongs[1 << 16];

static void told_replace(struct text *t, size_t at, size_t removed, const char *with)
{
    int from = t->next;
    replace(t, at, removed, with, strlen(with), NULL);
    size_t behind = at + (size_t)(t->next - from);
    bool inside = at > 0 && behind < t->count && belongs[t->numbers[at - 1]] &&
                  belongs[t->numbers[behind]];
    for (int i = from; i < t->next; i++)
        belongs[i] = inside;
}

/* Edits that it is told: it is where its letters are, or gone with the last of them. */
static void told_edits_keep_the_letters(void **state)
{
    (void)state;
    static struct text t;
    long kept = 0, gone = 0;
    for (int round = 0; round < 150; round++) {
        struct tried a;
        bool there = true;
        text_make(&t, 20);
        tried_make(&a, &t);
        memset(belongs, 0, sizeof belongs);
        for (size_t l = 0; l < a.count; l++)
            belongs[a.numbers[l]] = true;
        for (int k = 0; k < 12 && there; k++) {
            size_t at = below(t.count), removed = below(3) ? 0 : below(200), begin, end;
            removed = removed < t.count - at ? removed : t.count - at;
            const char *s = below(2) ? "new" : "";
            told_replace(&t, at, removed, s);
            there = reader_anchor_edit(a.anchor, at, removed, strlen(s));
            reader_anchor_place(a.anchor, &begin, &end);
            size_t first = t.count, last = 0;
            for (size_t i = 0; i < t.count; i++)
                if (belongs[t.numbers[i]]) {
                    first = i < first ? i : first;
                    last = i + 1;
                }
            assert_int_equal(there, first < last);
            if (there && (begin != first || end != last))
                fail_msg("it says %zu..%zu, its letters stand at %zu..%zu", begin, end, first,
                         last);
        }
        kept += there;
        gone += !there;
        size_t b = 0, e = 0;
        if (!there)
            assert_int_equal(reader_anchor_find(a.anchor, t.letters, t.count, &b, &e),
                             READER_ANCHOR_ORPHAN);
        reader_anchor_destroy(a.anchor);
    }
    assert_true(kept > 20 && gone > 20);
}

static void rules_are_those_of_the_header(void **state)
{
    (void)state;
    static const char *const lake =
        "The lake. The water rises by night and falls by day. The end.";
    static const struct {
        const char *made_of, *quotation, *changed;
        long at; /* -1: an orphan */
    } rows[] = {
        {"a b c", "b", "a b c", 2},
        {"a b c", "b", "zz a b c", 5},     /* moved, with both sides */
        {"a b c", "b", "a b c a b c", -1}, /* twice */
        {"a b c", "b", "a b d", -1},       /* one side, and short */
        {"a b c", "b", "a c", -1},
        {NULL, "The water rises by night", "The lake. The water rises by night, and falls.",
         10},
        {NULL, "The water rises by night",
         "A pond. The water rises by night and falls by day. The end.", 8},
        {NULL, "The water rises by night", "A pond. The water rises by night. No more.", -1},
        {NULL, "night", "The lake. The water rises by night. No more.", -1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *from = rows[i].made_of ? rows[i].made_of : lake;
        struct reader_anchor *a;
        size_t begin = (size_t)(strstr(from, rows[i].quotation) - from), end, bytes;
        assert_int_equal(reader_anchor_make(from, strlen(from), begin,
                                            begin + strlen(rows[i].quotation), &a),
                         READER_OK);
        const char *quotation = reader_anchor_quotation(a, &bytes);
        assert_int_equal(bytes, strlen(rows[i].quotation));
        assert_memory_equal(quotation, rows[i].quotation, bytes);
        begin = 0;
        enum reader_found found =
            reader_anchor_find(a, rows[i].changed, strlen(rows[i].changed), &begin, &end);
        if (found == READER_ANCHOR_ORPHAN ? rows[i].at >= 0 : rows[i].at != (long)begin)
            fail_msg("row %zu: %d at %zu, not %ld", i, (int)found, begin, rows[i].at);
        reader_anchor_destroy(a);
    }
    /* What nothing tells apart is at its place in the same source alone. */
    struct reader_anchor *a;
    char same[9000];
    size_t begin, end;
    memset(same, 'a', sizeof same);
    assert_int_equal(reader_anchor_make(same, sizeof same, 4500, 4510, &a), READER_OK);
    assert_int_equal(reader_anchor_find(a, same, sizeof same, &begin, &end),
                     READER_ANCHOR_SAME);
    assert_true(begin == 4500 && end == 4510);
    assert_int_equal(reader_anchor_find(a, same, sizeof same - 1, &begin, &end),
                     READER_ANCHOR_ORPHAN);
    reader_anchor_destroy(a);
}

static void headings_are_told(void **state)
{
    (void)state;
    static const char text[] =
        "# One #\n\n## Two\n\nx\n\n```\n# none\n```\n### Three\n\n## Four\n\nhere";
    struct reader_anchor *a;
    const size_t at = sizeof text - 5;
    assert_int_equal(reader_anchor_make(text, sizeof text - 1, at, at + 4, &a), READER_OK);
    assert_string_equal(reader_anchor_headings(a), "One / Four");
    reader_anchor_destroy(a);
    assert_int_equal(reader_anchor_make(text, sizeof text - 1, 0, 0, &a), READER_OK);
    assert_string_equal(reader_anchor_headings(a), "");
    reader_anchor_destroy(a);
    assert_int_equal(reader_anchor_make(text, 4, 2, 5, &a), READER_BAD_ARGUMENT);
    assert_null(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_are_those_of_the_header),
        cmocka_unit_test(random_edits_lead_to_no_look_alike),
        cmocka_unit_test(told_edits_keep_the_letters),
        cmocka_unit_test(headings_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
