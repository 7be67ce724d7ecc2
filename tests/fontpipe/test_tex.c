/* test_tex.c - paragraphs of the same words and widths get TeX's line breaks, each line's
 * badness, and the paragraph's demerits.
 *
 *     test_tex                  compares with TeX's answers (tex_answers.h)
 *     test_tex --tex            prints the paragraphs as a file for INITEX; tex_answers.py
 *                               makes tex_answers.h from its log
 *
 * A table gives the letters' widths in 64ths of a point, which both programs add without
 * rounding. */
#include "support.h"

#include <breaks.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PARAGRAPHS = 120, LINES_MAX = 40, PLACES_MAX = 400, UNITS = 64 };
enum { SPACE = 213, SPACE_STRETCH = 107, SPACE_SHRINK = 71, HYPHEN = 213 };

struct tex_answer {
    double demerits;                            /* 0: TeX found no way within the tolerance */
    int count, ends[LINES_MAX], bad[LINES_MAX]; /* of each line: its last piece, its badness */
};
#include "tex_answers.h"

static const char text[] =
    "in the north of the city there was once a marsh and the people who lived beside it set "
    "their houses on piles of oak which the water turned to stone in winter when the ground "
    "froze they carried timber over it and in summer the river took back whatever had been "
    "left too near its side nobody remembers who first wrote down the names of the streets but "
    "the oldest paper we possess a narrow sheet of linen fibre mentions an avenue of elders a "
    "fountain and seven bakers of whom one it says was a woman and a master of her company the "
    "ink has turned brown the letters lean against each other as tired travellers do and "
    "wherever the writer paused a small round blot remains that has bled into the fibres";

static const int letters[26] = {282, 317, 269, 327, 276, 199, 304, 333, 166,
                                163, 320, 166, 506, 336, 314, 323, 320, 243,
                                234, 211, 330, 304, 454, 301, 298, 266};

/* A word or a part of one. The flags tell what follows it. */
struct piece {
    int width;
    bool space, hyphen; /* else it is the last */
};

struct paragraph {
    struct piece pieces[PLACES_MAX];
    int count, widths[2], widths_count, tolerance;
};

static bool vowel(char c)
{
    return strchr("aeiouy", c) != NULL;
}

/* Takes words of the text from a random one on. A word may be divided before a consonant
 * between vowels. */
static void paragraph_make(struct paragraph *p, uint32_t *seed)
{
    int wanted = 40 + (int)(random_next(seed) % 90);
    const char *at = text + random_next(seed) % 300;
    while (*at != ' ')
        at++;
    memset(p, 0, sizeof *p);
    for (int words = 0; words < wanted; words++) {
        const char *word = *at ? ++at : (at = text);
        int length = (int)strcspn(word, " ");
        for (int i = 0; i < length; i++) {
            p->pieces[p->count].width += letters[word[i] - 'a'];
            bool divides = i > 0 && i + 3 < length && vowel(word[i]) && !vowel(word[i + 1]) &&
                           vowel(word[i + 2]);
            if (divides)
                p->pieces[p->count++].hyphen = true;
        }
        p->pieces[p->count++].space = true;
        at = word + length;
    }
    p->pieces[p->count - 1].space = false;
    p->widths_count = 1 + (int)(random_next(seed) % 2);
    for (int i = 0; i < 2; i++)
        p->widths[i] = UNITS * (110 + (int)(random_next(seed) % 200));
    p->tolerance = random_next(seed) % 2 ? 200 : 1500;
}

/* ---- ours ---- */

static int places_make(const struct paragraph *p, struct break_place *places)
{
    struct break_sum sum = {0};
    memset(places, 0, sizeof *places);
    for (int i = 0; i < p->count; i++) {
        const struct piece *piece = &p->pieces[i];
        struct break_place *place = &places[i + 1];
        sum.px += (double)piece->width / UNITS;
        *place = (struct break_place){.end = sum, .next = sum};
        if (piece->hyphen) {
            place->penalty = 50;
            place->flagged = true;
            place->end.px += (double)HYPHEN / UNITS;
        } else if (piece->space) {
            sum.px += (double)SPACE / UNITS;
            sum.stretch += (double)SPACE_STRETCH / UNITS;
            sum.shrink += (double)SPACE_SHRINK / UNITS;
            place->next = sum;
        }
    }
    return p->count + 1;
}

static void lines_are_texs(void **state)
{
    (void)state;
    static struct paragraph p;
    static struct break_place places[PLACES_MAX + 1];
    uint32_t seed = 1981;
    int found = 0, lines = 0;
    double farthest = 0;
    for (int n = 0; n < PARAGRAPHS; n++) {
        const struct tex_answer *tex = &tex_answers[n];
        int chosen[PLACES_MAX], count;
        double demerits, widths[2], allowed = 0;
        paragraph_make(&p, &seed);
        int places_count = places_make(&p, places);
        for (int i = 0; i < 2; i++)
            widths[i] = (double)p.widths[i] / UNITS;
        struct break_rules rules = {.tolerance = p.tolerance, .last_fills = true};
        assert_true(breaks_find(places, places_count, widths, p.widths_count, &rules, chosen,
                                &count, &demerits));
        assert_int_equal(count > 0, tex->demerits > 0);
        if (!count)
            continue;
        found++;
        assert_int_equal(count, tex->count);
        for (int i = 0, from = 0; i < count; from = chosen[i++]) {
            int line = i < p.widths_count ? i : p.widths_count - 1;
            double r = breaks_ratio(&places[from], &places[chosen[i]], widths[line], &rules,
                                    chosen[i] == places_count - 1);
            double bad = fmin(100 * fabs(r * r * r), BREAK_INFINITE);
            assert_int_equal(chosen[i] - 1, tex->ends[i]);
            /* TeX's badness is an integer that approximates 100 times the ratio cubed. */
            double rounding = 1 + 0.01 * bad;
            if (fabs(bad - tex->bad[i]) > rounding)
                fail_msg("paragraph %d, line %d: %g bad, TeX says %d", n, i, bad, tex->bad[i]);
            allowed += rounding * (2 * (10 + bad) + rounding);
            lines++;
        }
        double off = fabs(demerits - tex->demerits);
        farthest = fmax(farthest, off / tex->demerits);
        if (off > allowed)
            fail_msg("paragraph %d: %g demerits, TeX has %g", n, demerits, tex->demerits);
    }
    print_message("%d of %d paragraphs, %d lines: as TeX's; demerits at most %.2f%% off\n",
                  found, PARAGRAPHS, lines, 100 * farthest);
    assert_true(found > PARAGRAPHS / 2);
}

/* ---- for TeX ---- */

/* Prints each piece as a box of its width that holds its number; TeX's log then shows the
 * pieces of each line. */
static void tex_print(void)
{
    static struct paragraph p;
    uint32_t seed = 1981;
    const int sp = 65536 / UNITS;
    printf(
        "\\catcode`\\{=1 \\catcode`\\}=2 \\batchmode\n"
        "\\pretolerance=-1 \\linepenalty=10 \\hyphenpenalty=50 \\adjdemerits=10000\n"
        "\\doublehyphendemerits=10000 \\finalhyphendemerits=5000 \\parfillskip=0pt plus 1fil\n"
        "\\hbadness=10000 \\vbadness=10000 \\showboxbreadth=100000 \\showboxdepth=10\n"
        "\\maxdepth=100pt \\tracingparagraphs=1 \\hfuzz=16383pt\n");
    for (int n = 0; n < PARAGRAPHS; n++) {
        paragraph_make(&p, &seed);
        printf("\\message{PARAGRAPH %d}\\tolerance=%d\n\\setbox0=\\vbox{\\parshape=%d", n,
               p.tolerance, p.widths_count);
        for (int i = 0; i < p.widths_count; i++)
            printf(" 0pt %dsp", p.widths[i] * sp);
        printf("\n\\noindent");
        for (int i = 0; i < p.count; i++) {
            printf("\\hbox to %dsp{\\penalty%d }", p.pieces[i].width * sp, i);
            if (p.pieces[i].hyphen)
                printf("\\discretionary{\\hbox to %dsp{}}{}{}", HYPHEN * sp);
            else if (p.pieces[i].space)
                printf("\\hskip %dsp plus %dsp minus %dsp", SPACE * sp, SPACE_STRETCH * sp,
                       SPACE_SHRINK * sp);
            printf("%%\n");
        }
        printf("\\par}\\showbox0\n");
    }
    printf("\\end\n");
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lines_are_texs)};
    if (argc > 1 && strcmp(argv[1], "--tex") == 0) {
        tex_print();
        return 0;
    }
    return cmocka_run_group_tests_name("tex", tests, NULL, NULL);
}
