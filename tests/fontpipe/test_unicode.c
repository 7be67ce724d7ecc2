/* test_unicode.c - compares directions and line breaks with Unicode's test files (Debian's
 * unicode-data), and shaping with hb-shape (libharfbuzz-bin). Skips the cases where these are
 * not installed. */
#include "../skip.h"
#include "support.h"

#include <text.h>
#include <text_internal.h>

#include <linebreak.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 4096, CHARACTERS = 256 };

static const char bidi_file[] = "/usr/share/unicode/BidiCharacterTest.txt";
static const char breaks_file[] = "/usr/share/unicode/auxiliary/LineBreakTest.txt";

/* Reads the numbers up to a semicolon; an x is -1. */
static int numbers_read(char **at, int base, int *out)
{
    int n = 0;
    while (**at && **at != ';' && **at != '\n' && n < CHARACTERS) {
        if (**at == ' ') {
            ++*at;
        } else if (**at == 'x') {
            out[n++] = -1;
            ++*at;
        } else {
            out[n++] = (int)strtol(*at, at, base);
        }
    }
    *at += **at == ';';
    return n;
}

/* Compares levels and visual order for all lines of the file. */
static void directions_are_unicodes(void **state)
{
    (void)state;
    FILE *file = fopen(bidi_file, "r");
    char line[LINE_MAX_BYTES];
    long cases = 0, wrong = 0;
    if (!file)
        skip_because("unicode-data is not installed");
    while (fgets(line, sizeof line, file)) {
        int characters[CHARACTERS], direction[2], wanted_base[2], levels[CHARACTERS],
            order[CHARACTERS], base;
        uint32_t text[CHARACTERS];
        int8_t got[CHARACTERS];
        struct font_run runs[CHARACTERS];
        char *at = line;
        if (line[0] == '#' || line[0] == '\n')
            continue;
        int n = numbers_read(&at, 16, characters);
        numbers_read(&at, 10, direction);
        numbers_read(&at, 10, wanted_base);
        assert_int_equal(numbers_read(&at, 10, levels), n);
        int seen = numbers_read(&at, 10, order), count = 0;
        for (int i = 0; i < n; i++)
            text[i] = (uint32_t)characters[i];
        assert_true(font_levels_find(text, n,
                                     direction[0] == 2 ? 0
                                     : direction[0]    ? 1
                                                       : -1,
                                     got, &base));
        bool same = base == wanted_base[0];
        for (int i = 0; i < n; i++) {
            if (levels[i] < 0)
                continue;
            same = same && levels[i] == got[i];
            runs[count++] = (struct font_run){i, i + 1, got[i]};
        }
        font_runs_order(runs, count);
        same = same && count == seen;
        for (int i = 0; same && i < count; i++)
            same = runs[i].begin == order[i];
        cases++;
        wrong += !same;
    }
    fclose(file);
    print_message("%ld of %ld cases of directions differ\n", wrong, cases);
    assert_true(cases > 90000);
    assert_int_equal(wrong, 0);
}

/* The rules of UAX 14, and a class, by which ICU differs from the file of Unicode 15 or 15.1;
 * NOT_A_RULE: any other difference. The file uses another rule for numbers than the standard
 * (its example 7). */
enum rule { LB15C, LB20A, LB21A, LB25, BALINESE, RULES_COUNT, NOT_A_RULE = RULES_COUNT };
static const char *const rule_names[] = {
    "LB15c (Unicode 16): a line may end before \" .3\"",
    "LB20a (15.1): a hyphen at a word's beginning stays with it",
    "LB21a (16): a line may end between a hyphen and a Hebrew letter, after another",
    "LB25: a point or comma stays with the digit after it",
    "the class of Balinese digits (16)"};

static bool digit(uint32_t c)
{
    return c >= '0' && c <= '9';
}

static bool hebrew(uint32_t c)
{
    return c >= 0x5d0 && c <= 0x5ea;
}

static enum rule rule_of(const uint32_t *text, int n, int place, bool wanted)
{
    const uint32_t next = text[place + 1], balinese = 0x1b50;
    int base = place; /* what marks belong to */
    while (base > 0 && text[base] == 0x308)
        base--;
    if (text[base] == balinese || next == balinese)
        return BALINESE;
    if (!wanted && text[place] == ' ' && next == '.' && place + 2 < n && digit(text[place + 2]))
        return LB15C;
    if (!wanted && text[place] == '-' && place > 0 && hebrew(text[place - 1]) && hebrew(next))
        return LB21A;
    if (!wanted)
        return NOT_A_RULE;
    if ((text[base] == '.' || text[base] == ',') && digit(next))
        return LB25;
    return text[base] == '-' && base == 0 && !digit(next) ? LB20A : NOT_A_RULE;
}

static void line_ends_are_unicodes(void **state)
{
    (void)state;
    FILE *file = fopen(breaks_file, "r");
    char line[LINE_MAX_BYTES], breaks[CHARACTERS] = "";
    long cases = 0, wrong = 0, by[RULES_COUNT] = {0};
    if (!file || !font_breaks_by_icu(NULL, 0, "en", breaks)) {
        if (file)
            fclose(file);
        skip_because("unicode-data or ICU is not installed");
    }
    while (fgets(line, sizeof line, file)) {
        uint32_t text[CHARACTERS];
        bool wanted[CHARACTERS];
        enum rule rule = RULES_COUNT; /* the first that is followed */
        int n = 0;
        bool ruled = true;
        char *end = strchr(line, '#');
        if (!end || end == line)
            continue;
        *end = '\0';
        for (char *word = strtok(line, " \t\n"); word; word = strtok(NULL, " \t\n")) {
            if (strcmp(word, "\xc3\xb7") == 0 || strcmp(word, "\xc3\x97") == 0) {
                if (n)
                    wanted[n - 1] = word[1] == '\xb7';
            } else {
                text[n++] = (uint32_t)strtol(word, NULL, 16);
            }
        }
        assert_true(font_breaks_find(text, n, "en", breaks));
        for (int i = 0; i + 1 < n; i++)
            if (wanted[i] != (breaks[i] <= LINEBREAK_ALLOWBREAK)) {
                enum rule one = rule_of(text, n, i, wanted[i]);
                rule = rule == RULES_COUNT ? one : rule;
                ruled = ruled && one != NOT_A_RULE;
            }
        cases++;
        wrong += !ruled;
        if (ruled && rule != RULES_COUNT)
            by[rule]++;
    }
    fclose(file);
    print_message("%ld of %ld cases of line ends differ\n", wrong, cases);
    for (int i = 0; i < RULES_COUNT; i++)
        print_message("  and %ld by %s\n", by[i], rule_names[i]);
    assert_true(cases > 7000);
    assert_int_equal(wrong, 0);
    assert_true(by[LB15C] <= 2 && by[LB20A] <= 10 && by[LB21A] <= 2 && by[LB25] <= 20 &&
                by[BALINESE] <= 12);
}

/* libunibreak breaks plain text, so that ICU need not be loaded; it must agree with ICU. */
static void plain_text_needs_no_icu(void **state)
{
    (void)state;
    static const char signs[] = "aZ ,.();:!?' be";
    uint32_t seed = 14, text[16];
    char plain[16], icu[16];
    if (!font_breaks_by_icu(NULL, 0, "en", icu))
        skip_because("ICU is not installed");
    for (int n = 0; n < 300000; n++) {
        int count = 1 + (int)(random_next(&seed) % 12);
        for (int i = 0; i < count; i++) {
            uint32_t r = random_next(&seed) % 20;
            text[i] = r < sizeof signs - 1 ? (uint32_t)signs[r] : r < 18 ? 0xad : 0x160;
        }
        if (text[0] == ' ')
            continue;
        assert_true(font_breaks_find(text, count, "en", plain));
        assert_true(font_breaks_by_icu(text, count, "en", icu));
        for (int i = 0; i + 1 < count; i++)
            if (plain[i] != icu[i] &&
                (plain[i] <= LINEBREAK_ALLOWBREAK) != (icu[i] <= LINEBREAK_ALLOWBREAK)) {
                for (int k = 0; k < count; k++)
                    print_message("%x%s ", text[k], k == i ? " |" : "");
                fail_msg("place %d: %d, ICU says %d", i, plain[i], icu[i]);
            }
    }
}

/* Finds words of Lao, Khmer and Burmese, which are written without spaces. */
static void words_of_south_east_asia_are_found(void **state)
{
    (void)state;
    static const struct {
        const char *text, *language;
        int ends[8]; /* of words, in characters */
    } cases[] = {
        /* "the Lao language", "I love", "I, Myanmar" */
        {"\xe0\xba\x9e\xe0\xba\xb2\xe0\xba\xaa\xe0\xba\xb2\xe0\xba\xa5\xe0\xba\xb2\xe0\xba\xa7",
         "lo",
         {4}},
        {"\xe1\x9e\x81\xe1\x9f\x92\xe1\x9e\x89\xe1\x9e\xbb\xe1\x9f\x86\xe1\x9e\x9f"
         "\xe1\x9f\x92\xe1\x9e\x9a\xe1\x9e\x9b\xe1\x9e\xb6\xe1\x9e\x89\xe1\x9f\x8b",
         "km",
         {5}},
        {"\xe1\x80\x80\xe1\x80\xbb\xe1\x80\xbd\xe1\x80\x94\xe1\x80\xba"
         "\xe1\x80\x90\xe1\x80\xb1\xe1\x80\xac\xe1\x80\xba\xe1\x80\x99"
         "\xe1\x80\xbc\xe1\x80\x94\xe1\x80\xba\xe1\x80\x99\xe1\x80\xac",
         "my",
         {9}},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        uint32_t text[64];
        char breaks[64];
        int n = 0;
        const char *at = cases[c].text, *end = at + strlen(at);
        while (at < end)
            assert_true(font_utf8_next(&at, end, &text[n++]));
        if (!font_breaks_by_icu(text, n, cases[c].language, breaks))
            skip_because("ICU is not installed");
        assert_true(font_breaks_find(text, n, cases[c].language, breaks));
        for (int i = 0; i + 1 < n; i++) {
            bool wanted = false;
            for (int k = 0; k < 8; k++)
                wanted = wanted || cases[c].ends[k] == i + 1;
            if (wanted != (breaks[i] <= LINEBREAK_ALLOWBREAK))
                fail_msg("%s: place %d", cases[c].language, i);
        }
    }
}

/* Compares the glyphs and advances of single runs with hb-shape's. */
static void glyphs_are_hb_shapes(void **state)
{
    (void)state;
    static const struct {
        const char *font, *text;
    } cases[] = {
        {"DejaVuSans", "AVATAR waffle To."},
        {"EBGaramond12-Italic", "office fjord Th ffi"},
        {"NimbusSans-Regular.otf", "Quay LTAV"},
        {"DejaVuSans", "\xd8\xa7\xd9\x84\xd8\xb3\xd9\x84\xd8\xa7\xd9\x85 "
                       "\xd8\xb9\xd9\x84\xd9\x8a\xd9\x83\xd9\x85"},
        {"DejaVuSans", "\xd7\xa9\xd7\x81\xd6\xb8\xd7\x9c\xd7\x95\xd6\xb9\xd7\x9d"},
        {"DejaVuSerif", "e\xcc\x81 o\xcc\x82\xcc\x81 \xd0\xb2\xd0\xbe\xd0\xb4\xd0\xb0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct font_face *face = face_open(cases[i].font);
        struct font_shaper *s = shaper_make(face);
        struct font_face_info info;
        struct font_layout l;
        char command[1024], answer[8192] = "";
        font_face_describe(face, &info);
        snprintf(command, sizeof command,
                 "hb-shape --no-glyph-names --no-clusters '%s' '%s' 2>/dev/null", info.path,
                 cases[i].text);
        FILE *pipe = popen(command, "r");
        assert_non_null(pipe);
        size_t bytes = fread(answer, 1, sizeof answer - 1, pipe);
        if (pclose(pipe) != 0 || !bytes) {
            font_shaper_destroy(s);
            font_face_close(face);
            skip_because("hb-shape is not installed");
        }
        assert_font(font_shaper_layout(s, cases[i].text, strlen(cases[i].text),
                                       info.units_per_em, NULL, &l));
        double pen = 0;
        int n = 0;
        /* [36@0,0+1401|57+1401] */
        for (char *at = answer + 1; *at && *at != ']' && *at != '\n'; n++) {
            long glyph = strtol(at, &at, 10);
            double dx = 0, dy = 0, advance = 0;
            if (*at == '@') {
                dx = strtod(at + 1, &at);
                dy = strtod(at + 1, &at);
            }
            if (*at == '+')
                advance = strtod(at + 1, &at);
            while (*at && *at != '|' && *at != ']')
                at++;
            at += *at == '|';
            assert_true(n < l.glyphs_count);
            assert_int_equal(l.glyphs[n].glyph, glyph);
            assert_true(fabs(l.glyphs[n].x_px - (pen + dx)) < 1e-3);
            assert_true(fabs(l.glyphs[n].y_px + dy) < 1e-3);
            pen += advance;
        }
        assert_int_equal(n, l.glyphs_count);
        font_layout_finish(&l);
        font_shaper_destroy(s);
        font_face_close(face);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_are_unicodes),
        cmocka_unit_test(line_ends_are_unicodes),
        cmocka_unit_test(plain_text_needs_no_icu),
        cmocka_unit_test(words_of_south_east_asia_are_found),
        cmocka_unit_test(glyphs_are_hb_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
