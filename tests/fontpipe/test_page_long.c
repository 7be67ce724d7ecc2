/* test_page_long.c - a long paragraph is edited, and set anew where that changes it: letters,
 * runs, glyphs and lines are bit for bit those of all of it set anew. */
#include "page_texts.h"

#include <page_internal.h>

#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 24 };

struct kind {
    const char *name;
    bool justified, hyphenated;
    int right_to_left;
    const char *words[WORDS_MAX]; /* with what stands behind each */
};

static const struct kind kinds[] = {
    {"Latin",
     true,
     true,
     0,
     {"typesetting ", "of ", "a ", "considerable ", "hyphenation ", "co-operation ", "(in ",
      "it) ", "office, ", "AVATAR. ", "soft\u00adhyphen\u00ad ", "na\u00efve ", "12,345.6 ",
      "\u201cquoted\u201d ", "f", "i", "fi"}},
    {"Latin, ragged",
     false,
     false,
     0,
     {"typesetting ", "of ", "a ", "waffle ", "end.\n", "To ", "e\u0301tude ", "x", "- ", "-"}},
    {"Hebrew and Latin",
     true,
     true,
     0,
     {"\u05e9\u05dc\u05d5\u05dd ", "\u05e2\u05d5\u05dc\u05dd", "word ", "and ", "12 ", "3",
      ", ", "(\u05d0\u05d1) ", "(a) ", "\u05d1\u05b8\u05bc ", "latin", " ", "$5 ", ". ", "["}},
    {"Arabic",
     true,
     false,
     1,
     {"\u0627\u0644\u0633\u0644\u0627\u0645 ", "\u0639\u0644\u064a\u0643\u0645 ",
      "\u0644\u0627", "\u0661\u0662 ", "12 ", "word ", "\u0645\u064e\u0631\u0652\u062d ",
      "\u060c ", "\u200d", "\u200c", "\u0628"}},
    {"turned by signs",
     true,
     false,
     0,
     {"word ", "\u05e9\u05dc\u05d5\u05dd ", "and ", "letters ", "of ", "it ", "some ", "more ",
      "\u202b", "\u202c", "\u2067", "\u2069", "\u200f"}},
    {"Chinese and Japanese",
     true,
     false,
     0,
     {"\u4e2d\u6587\u5b57", "\u65e5\u672c\u8a9e", "\u3068\u3044\u3046", "\u3001", "\u3002",
      "\u300c\u5f15\u300d", "\u30c6\u30ad\u30b9\u30c8", "word ", "12", "\u4e00"}},
    {"Devanagari",
     true,
     false,
     0,
     {"\u0939\u093f\u0928\u094d\u0926\u0940 ",
      "\u0915\u094d\u0937\u0924\u094d\u0930\u093f\u092f ", "\u0964 ", "\u0915", "\u094d",
      "\u093f", "word ", "\u0930\u094d\u0915 ", "\u200d"}},
    {"Thai",
     true,
     false,
     0,
     {"\u0e20\u0e32\u0e29\u0e32\u0e44\u0e17\u0e22", "\u0e01\u0e33", "word ", "a ", " ", "of ",
      "letters ", "it "}},
    {"pictures",
     true,
     true,
     0,
     {"word ", "\U0001f469\u200d\U0001f4bb", "\U0001f1e9\U0001f1ea", "\U0001f1eb",
      "1\ufe0f\u20e3", "#", "\u2764\ufe0f ", "\U0001f44d\U0001f3fd ", "of ", "letters ",
      "\u200d", "\ufe0f"}},
    {"long words",
     true,
     true,
     0,
     {"hyphenation", "typesetting", "considerable", "international", "paragraphs", "of", " ",
      "a"}},
    {"no letters", false, false, 0, {"12 ", "- ", "? ", "\u2026", "(", ")", "3", "\n"}},
    {"tabs", true, true, 0, {"word\t", "of ", "\t", "letters ", "hyphenation ", "end\n"}}};
enum { KINDS = sizeof kinds / sizeof *kinds, BYTES = 6000, BYTES_MOST = 9000 };

static int words_put(uint32_t *seed, const struct kind *kind, char *out, int least)
{
    int words = 0, bytes = 0;
    while (words < WORDS_MAX && kind->words[words])
        words++;
    do {
        const char *word = kind->words[random_next(seed) % (uint32_t)words];
        memcpy(out + bytes, word, strlen(word));
        bytes += (int)strlen(word);
    } while (bytes < least);
    return bytes;
}

struct made {
    int count, runs_count, glyphs_count, lines_count, base;
    bool hyphenated; /* else no word has been looked at, for none had to be divided */
    double leading_px;
    struct letter *letters;
    struct set_run *runs;
    struct shaped *glyphs;
    struct line *lines;
};

static void *copied(const void *from, int count, size_t bytes)
{
    void *to = calloc((size_t)count + 1, bytes);
    assert_non_null(to);
    if (count)
        memcpy(to, from, (size_t)count * bytes);
    return to;
}

static struct made made_of(const struct paragraph *p)
{
    return (struct made){p->count,
                         p->runs_count,
                         p->glyphs_count,
                         p->lines_count,
                         p->base,
                         p->hyphenated,
                         p->leading_px,
                         copied(p->letters, p->count, sizeof *p->letters),
                         copied(p->runs, p->runs_count, sizeof *p->runs),
                         copied(p->glyphs, p->glyphs_count, sizeof *p->glyphs),
                         copied(p->lines, p->lines_count, sizeof *p->lines)};
}

static void made_free(struct made *m)
{
    free(m->letters);
    free(m->runs);
    free(m->glyphs);
    free(m->lines);
}

static void letters_compare(const struct made *a, const struct made *b, const char *name,
                            int turn)
{
    const bool words = a->hyphenated && b->hyphenated;
    assert_int_equal(a->count, b->count);
    for (int i = 0; i < a->count; i++) {
        const struct letter *x = &a->letters[i], *y = &b->letters[i];
        if (x->character != y->character || x->byte != y->byte || x->style != y->style ||
            x->face != y->face || x->level != y->level || x->cluster != y->cluster ||
            x->grapheme != y->grapheme || x->safe != y->safe ||
            (words && x->hyphen != y->hyphen) || x->brk != y->brk || x->script != y->script ||
            x->advance_px != y->advance_px || x->stretch_px != y->stretch_px ||
            x->shrink_px != y->shrink_px)
            fail_msg("%s, turn %d: letter %d (U+%04X): %d %d %d %d %d %d %d %d %g, anew %d %d "
                     "%d %d %d %d %d %d %g",
                     name, turn, i, x->character, x->byte, x->face, x->level, x->cluster,
                     x->grapheme, x->safe, x->hyphen, x->brk, (double)x->advance_px, y->byte,
                     y->face, y->level, y->cluster, y->grapheme, y->safe, y->hyphen, y->brk,
                     (double)y->advance_px);
    }
}

static void made_compare(const struct made *a, const struct made *b, const char *name, int turn)
{
    letters_compare(a, b, name, turn);
    assert_int_equal(a->base, b->base);
    assert_true(a->leading_px == b->leading_px);
    assert_int_equal(a->runs_count, b->runs_count);
    for (int i = 0; i < a->runs_count; i++) {
        const struct set_run *x = &a->runs[i], *y = &b->runs[i];
        if (x->begin != y->begin || x->end != y->end || x->glyphs_begin != y->glyphs_begin ||
            x->glyphs_end != y->glyphs_end || x->style != y->style || x->face != y->face ||
            x->level != y->level)
            fail_msg("%s, turn %d: run %d: %d..%d, anew %d..%d", name, turn, i, x->begin,
                     x->end, y->begin, y->end);
    }
    assert_int_equal(a->glyphs_count, b->glyphs_count);
    for (int i = 0; i < a->glyphs_count; i++) {
        const struct shaped *x = &a->glyphs[i], *y = &b->glyphs[i];
        if (x->glyph != y->glyph || x->letter != y->letter || x->advance_px != y->advance_px ||
            x->x_px != y->x_px || x->y_px != y->y_px)
            fail_msg("%s, turn %d: glyph %d: %u of %d, anew %u of %d", name, turn, i, x->glyph,
                     x->letter, y->glyph, y->letter);
    }
    assert_int_equal(a->lines_count, b->lines_count);
    for (int i = 0; i < a->lines_count; i++) {
        const struct line *x = &a->lines[i], *y = &b->lines[i];
        if (x->begin != y->begin || x->end != y->end || x->ink_end != y->ink_end ||
            x->ratio != y->ratio || x->width_px != y->width_px || x->hyphen != y->hyphen ||
            x->last != y->last)
            fail_msg("%s, turn %d: line %d: %d..%d by %.17g, anew %d..%d by %.17g", name, turn,
                     i, x->begin, x->end, x->ratio, y->begin, y->end, y->ratio);
    }
}

/* A place between two characters, mostly near to the one before. */
static int place(uint32_t *seed, const char *text, int bytes, int near)
{
    int at = (int)(random_unit(seed) * (bytes + 1));
    if (random_next(seed) % 4)
        at = near + (int)(random_next(seed) % 40) - 20;
    at = at < 0 ? 0 : at > bytes ? bytes : at;
    while (at < bytes && ((unsigned char)text[at] & 0xc0) == 0x80)
        at++;
    return at;
}

static void edit(struct page_text *t, int id, uint32_t *seed, const struct kind *kind,
                 int *near)
{
    char put[400];
    size_t bytes;
    const char *text = page_paragraph_text(t, id, &bytes);
    int a = place(seed, text, (int)bytes, *near), b = a, fresh = 0;
    if (random_next(seed) % 3 == 0 || bytes > BYTES_MOST) {
        b = a + (int)(random_next(seed) % (bytes > BYTES_MOST ? 2000 : 30));
        b = b > (int)bytes ? (int)bytes : b;
        while (b < (int)bytes && ((unsigned char)text[b] & 0xc0) == 0x80)
            b++;
    }
    if (a == b || random_next(seed) % 2)
        fresh = words_put(seed, kind, put, 1 + (int)(random_next(seed) % 12));
    assert_font(page_text_replace(t, id, a, b - a, put, (size_t)fresh));
    *near = a + fresh;
    if (random_next(seed) % 16 == 0)
        assert_font(
            page_paragraph_style(t, id, a, a + fresh, (int)(random_next(seed) % PAGE_STYLES)));
}

static void kind_run(const struct kind *kind, uint32_t seed, int turns)
{
    char *text = malloc(BYTES + 100);
    int id, pages, near = 0;
    struct page_text *t = page_text_begin();
    struct page_manner manner = page_manner_default();
    const struct page_template page = {
        .width_px = 400,
        .height_px = 400,
        .frames_count = 1,
        .frames = {{.x = 20, .y = 20, .width = 240, .height = 360}}};
    manner.align = kind->justified ? FONT_ALIGN_JUSTIFY : FONT_ALIGN_START;
    manner.hyphenate = kind->hyphenated;
    manner.right_to_left = kind->right_to_left;
    manner.protrude = seed % 2;
    manner.expand = seed % 4 < 2 ? 0 : 0.02;
    assert_font(page_templates_set(t, &page, 1));
    int bytes = words_put(&seed, kind, text, BYTES);
    assert_font(page_paragraph_add(t, 0, -1, text, (size_t)bytes, 0, &manner, &id));
    assert_font(page_count(t, &pages));
    for (int turn = 0; turn < turns; turn++) {
        for (int n = (int)(random_next(&seed) % 3); n >= 0; n--)
            edit(t, id, &seed, kind, &near);
        assert_font(page_count(t, &pages));
        struct paragraph *p = story_paragraph(t, id);
        struct made once = made_of(p);
        set_forget(p);
        flow_changed(t, p);
        assert_font(page_count(t, &pages));
        struct made anew = made_of(p);
        made_compare(&once, &anew, kind->name, turn);
        made_free(&once);
        made_free(&anew);
    }
    page_text_destroy(t);
    free(text);
}

static void long_paragraph_is_set_anew_where_it_changed(void **state)
{
    (void)state;
    const char *asked = getenv("LUTETIA_LONG_PAGE_RUNS");
    const int runs = asked ? atoi(asked) : 1;
    for (int run = 0; run < runs; run++)
        for (int k = 0; k < KINDS; k++)
            kind_run(&kinds[k], 7u + (uint32_t)run * 1001u + (uint32_t)k, 25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_paragraph_is_set_anew_where_it_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
