/* test_unicode.c - directions and line ends against Unicode's own test files (Debian's unicode-data), and shaping against hb-shape
 * (libharfbuzz-bin). Where they are not installed the cases are skipped. */
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

/* The numbers up to a semicolon; an x is -1. */
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

/* Levels, and the order in which letters are seen, of all lines of the file. */
static void directions_are_unicodes(void **state)
{
    (void)state;
    FILE *file = fopen(bidi_file, "r");
    char line[LINE_MAX_BYTES];
    long cases = 0, wrong = 0;
    if (!file)
        skip();
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

/* libunibreak's tables are of its own version of Unicode, and Debian's file of another: most lines agree, not all. */
static void line_ends_are_unicodes(void **state)
{
    (void)state;
    FILE *file = fopen(breaks_file, "r");
    char line[LINE_MAX_BYTES];
    long cases = 0, wrong = 0;
    if (!file)
        skip();
    while (fgets(line, sizeof line, file)) {
        uint32_t text[CHARACTERS];
        char breaks[CHARACTERS];
        bool wanted[CHARACTERS];
        int n = 0;
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
        bool same = true;
        for (int i = 0; i + 1 < n; i++)
            same = same && wanted[i] == (breaks[i] <= LINEBREAK_ALLOWBREAK);
        cases++;
        wrong += !same;
    }
    fclose(file);
    print_message("%ld of %ld cases of line ends differ\n", wrong, cases);
    assert_true(cases > 7000);
    assert_true((double)wrong < 0.1 * (double)cases);
}

/* One run each: glyphs, and how far apart they are. */
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
            skip();
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
        cmocka_unit_test(glyphs_are_hb_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
