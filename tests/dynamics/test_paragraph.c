/* test_paragraph.c - texts by chance that fall on the floor, stiff and as jelly: what is left
 * of their shape when they lie there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <step.h>
#include <word.h>

#include "scenes.h"

enum { FACES = 4, TEXT_BYTES = 4096, LETTERS_MOST = 1024 };
static const char *const face_names[FACES] = {"DejaVuSans", "DejaVuSerif", "DejaVuSansMono",
                                              "EBGaramond12-Regular"};
#define HIGH 80.0  /* where the lowest of those that hang are, which do not reach the floor */
#define HEIGHT 2.0 /* ems, from which texts fall */
static struct font_face *faces[FACES];
static struct font_shaper *shapers[FACES];

/* Letters of scripts that the first face has, from left to right and from right to left. */
static const char *const alphabets[] = {
    "abcdefghijklmnopqrstuvwxyz", "iiilljtf.,'",           "MWmwABDGOQ",
    "אבגדהוזחטיכלמנסעפצקרשת",     "ابتثجحدرسشعغفقكلمنهوي", "абвгдежзийклмнопрстуфхцчшщ"};
enum { ALPHABETS = sizeof alphabets / sizeof *alphabets };

/* A text of so many lines, some short and some empty. Returns how many letters it has. */
static int text_draw(uint64_t *chance, const char *alphabet, int lines, double width,
                     char text[TEXT_BYTES])
{
    int starts[64], count = 0, letters = 0;
    size_t used = 0;
    for (const char *c = alphabet; *c; c++)
        if ((*c & 0xc0) != 0x80)
            starts[count++] = (int)(c - alphabet);
    starts[count] = (int)strlen(alphabet);
    for (int line = 0; line < lines; line++) {
        const double part = scene_chance(chance, 0, 1) < 0.3 ? scene_chance(chance, 0, 1) : 1;
        const int most = (int)fmax(1, width * part * scene_chance(chance, 0.8, 1));
        for (int i = 0, word = 0; i < most && used + 8 < TEXT_BYTES; i++, letters++) {
            const int k = (int)scene_chance(chance, 0, count - 1e-9);
            const size_t bytes = (size_t)(starts[k + 1] - starts[k]);
            if (word > 1 && i + 1 < most && scene_chance(chance, 0, 1) < 0.2)
                text[used++] = ' ', word = 0;
            memcpy(text + used, alphabet + starts[k], bytes);
            used += bytes, word++;
        }
        if (line + 1 < lines)
            text[used++] = '\n';
        if (line + 2 < lines && scene_chance(chance, 0, 1) < 0.1)
            text[used++] = '\n';
    }
    text[used] = 0;
    return letters;
}

struct place {
    double x, y;
};

static void middles_take(const struct dyn_word *word, const struct dyn_network *n,
                         struct place *middles, double *areas)
{
    for (int i = 0; i < dyn_word_letters_count(word); i++) {
        double q[4][2];
        dyn_word_quad(word, n, i, q);
        middles[i] = (struct place){0, 0};
        areas[i] = 0;
        for (int k = 0; k < 4; k++) {
            const double *a = q[k], *b = q[(k + 1) % 4];
            middles[i].x += a[0] / 4, middles[i].y += a[1] / 4;
            areas[i] += (a[0] * b[1] - a[1] * b[0]) / 2;
        }
    }
}

/* Turns and moves places so that they are as near as can be to where they were. */
static void turn_back(const struct place *was, struct place *is, int count)
{
    struct place from = {0, 0}, to = {0, 0};
    double along = 0, across = 0;
    for (int i = 0; i < count; i++) {
        from.x += was[i].x / count, from.y += was[i].y / count;
        to.x += is[i].x / count, to.y += is[i].y / count;
    }
    for (int i = 0; i < count; i++) {
        const double ax = was[i].x - from.x, ay = was[i].y - from.y, bx = is[i].x - to.x,
                     by = is[i].y - to.y;
        along += ax * bx + ay * by, across += ay * bx - ax * by;
    }
    const double length = hypot(along, across), c = length > 0 ? along / length : 1,
                 s = length > 0 ? across / length : 0;
    for (int i = 0; i < count; i++) {
        const double x = is[i].x - to.x, y = is[i].y - to.y;
        is[i].x = from.x + c * x - s * y, is[i].y = from.y + s * x + c * y;
    }
}

struct kept {
    double away_mean, away_most; /* how far letters are from their places, ems */
    double far_mean, far_most;   /* by what part distances of letters near each other differ */
    double area_least;           /* of a letter's box, as a part of what it was */
    int pairs, letters_swapped, lines_swapped;
};

static struct kept compare(const struct dyn_word *word, const struct place *was,
                           const struct place *is, const double *area_was,
                           const double *area_is)
{
    const int count = dyn_word_letters_count(word);
    struct kept kept = {.area_least = INFINITY};
    for (int i = 0; i < count; i++) {
        const double away = hypot(is[i].x - was[i].x, is[i].y - was[i].y);
        kept.away_mean += away / count;
        kept.away_most = fmax(kept.away_most, away);
        kept.area_least = fmin(kept.area_least, area_is[i] / area_was[i]);
        for (int k = i + 1; k < count; k++) {
            const int line_i = dyn_word_letter(word, i)->line,
                      line_k = dyn_word_letter(word, k)->line;
            const double far = hypot(was[k].x - was[i].x, was[k].y - was[i].y),
                         now = hypot(is[k].x - is[i].x, is[k].y - is[i].y);
            if (line_i == line_k && k == i + 1)
                kept.letters_swapped += (is[k].x - is[i].x) * (was[k].x - was[i].x) <= 0;
            if (line_i != line_k && fabs(was[k].x - was[i].x) < 0.5)
                kept.lines_swapped += is[k].y >= is[i].y;
            if (far < 3) {
                kept.far_mean += fabs(now - far) / far;
                kept.far_most = fmax(kept.far_most, fabs(now - far) / far);
                kept.pairs++;
            }
        }
    }
    kept.far_mean /= fmax(1, kept.pairs);
    return kept;
}

/* Puts all masses so high that the lowest one is there. */
static void raise_above(struct dyn_network *n, double height)
{
    double least = INFINITY;
    for (int i = 0; i < dyn_masses_count(n); i++)
        least = fmin(least, dyn_network_states(n)[i].y);
    for (int i = 0; i < dyn_masses_count(n); i++) {
        struct dyn_mass mass = dyn_mass_get(n, i);
        mass.y += height - least;
        scene_must(dyn_mass_set(n, i, &mass));
    }
}

/* Lets a text fall, from where `lutetia spring` puts it, until it rests. */
static struct kept fall(const char *preset, const char *text, int face, double turn)
{
    static struct place was[LETTERS_MOST], is[LETTERS_MOST];
    static double area_was[LETTERS_MOST], area_is[LETTERS_MOST];
    struct dyn_word_def def = dyn_word_def_usual();
    struct dyn_world world = dyn_world_usual();
    struct dyn_network *n;
    struct dyn_word *word;
    def.text = text;
    def.shaper = shapers[face];
    const double path[2][2] = {{0, 0}, {200 * cos(turn), 200 * sin(turn)}};
    def.path = turn != 0 ? path : NULL;
    def.path_count = turn != 0 ? 2 : 0;
    if (strcmp(preset, "usual") != 0)
        scene_must(dyn_preset_apply(preset, &def.style, &world));
    scene_must(dyn_network_create(&n));
    scene_must(dyn_network_world_set(n, &world));
    scene_must(dyn_word_create(n, &def, &word));
    const int count = dyn_word_letters_count(word);
    assert_in_range(count, 1, LETTERS_MOST);
    raise_above(n, def.style.tack == DYN_TACK_NONE ? HEIGHT : HIGH);
    middles_take(word, n, was, area_was);
    scene_must(dyn_network_step(n, 1.0 / 240, 5 * 240));
    middles_take(word, n, is, area_is);
    turn_back(was, is, count);
    const struct kept kept = compare(word, was, is, area_was, area_is);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
    return kept;
}

enum { TEXTS = 24, FEWER = 12 };

/* Draws texts of 1 to 12 lines, every third of them turned, and counts those that have lost
 * their order. */
static int texts_fall(const char *preset, int texts, double far_most, double area_least)
{
    uint64_t chance = 11;
    int lost = 0;
    for (int i = 0; i < texts; i++) {
        char text[TEXT_BYTES];
        const int face = i % 2 ? i / 2 % FACES : 0, lines = 1 + i % 12,
                  width = (int)scene_chance(&chance, 1, 40);
        const double turn = i % 3 == 2 ? scene_chance(&chance, -0.3, 0.3) : 0;
        const int letters =
            text_draw(&chance, alphabets[face ? i % 3 : i % ALPHABETS], lines, width, text);
        const struct kept k = fall(preset, text, face, turn);
        print_message("%s %2d: %3d letters in %2d lines, turned %5.2f: distances %.3f, most "
                      "%.3f; %.3f ems away, area %.3f; %d letters, %d lines changed places\n",
                      preset, i, letters, lines, turn, k.far_mean, k.far_most, k.away_most,
                      k.area_least, k.letters_swapped, k.lines_swapped);
        assert_true(k.far_mean < far_most);
        lost += k.letters_swapped + k.lines_swapped > 0 || k.area_least < area_least;
    }
    return lost;
}

static void stiff_texts_stay_blocks(void **state)
{
    (void)state;
    assert_int_equal(texts_fall("stiff", TEXTS, 0.02, 0.9), 0);
}

/* A letter as narrow as a comma may be turned over in the fall: one in ten of the texts, of
 * which half are drawn from such letters or are towers of them, may have one. */
static void jelly_texts_keep_their_shape(void **state)
{
    (void)state;
    assert_in_range(texts_fall("jelly", TEXTS, 0.08, 0.3), 0, TEXTS / 10);
}

static void usual_texts_keep_their_shape(void **state)
{
    (void)state;
    assert_in_range(texts_fall("usual", FEWER, 0.08, 0.3), 0, FEWER / 10);
}

/* They swing and sag, but nothing in them folds. */
static void hanging_texts_keep_their_order(void **state)
{
    (void)state;
    assert_in_range(texts_fall("pendulum", FEWER, 0.08, 0.3), 0, FEWER / 10);
    assert_in_range(texts_fall("heavy", FEWER, 0.3, 0.3), 0, FEWER / 10);
    assert_in_range(texts_fall("curtain", FEWER, 0.3, 0.3), 0, FEWER / 10);
}

/* Crossed springs join the letters of a line both ways, and each upper corner to two corners
 * above; carry makes all as many times stronger as there are lines. */
static void crossed_paragraph_has_springs_across(void **state)
{
    (void)state;
    struct dyn_word_def def = dyn_word_def_usual();
    struct dyn_network *n;
    struct dyn_word *word;
    def.text = "wet papers\n\nand springs\ni";
    def.shaper = shapers[0];
    def.style.brace = DYN_BRACE_CROSSED;
    def.style.carry = 2;
    scene_must(dyn_network_create(&n));
    scene_must(dyn_word_create(n, &def, &word));
    const struct dyn_word_range range = dyn_word_range(word);
    int of_part[DYN_PARTS_COUNT] = {0};
    for (int i = 0; i < range.springs_count; i++) {
        const struct dyn_spring s = dyn_spring_get(n, range.first_spring + i);
        const enum dyn_part part = dyn_word_part(word, i);
        of_part[part]++;
        assert_near(dyn_spring_strain(n, range.first_spring + i), 0, 1e-12);
        if (part == DYN_HANG_BRACE) {
            const struct dyn_spring hang = dyn_spring_get(n, range.first_spring + i - 1);
            assert_int_equal(hang.end[1], s.end[1]);
            assert_int_not_equal(hang.end[0], s.end[0]);
        }
        if (part >= DYN_LINK_BRACE)
            assert_near(s.constant,
                        5 * (part == DYN_LINK_BRACE ? def.style.link : def.style.hang), 1e-9);
    }
    assert_int_equal(of_part[DYN_LINK], 2 * (8 + 9));
    assert_int_equal(of_part[DYN_LINK_BRACE], 2 * (8 + 9));
    assert_int_equal(of_part[DYN_HANG], 2 * (10 + 1));
    assert_int_equal(of_part[DYN_HANG_BRACE], 2 * (10 + 1));
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

/* Where a line juts out beyond all lines above it, its own links hold it: nothing spreads from
 * the end of a line above like a fan. A line that has nothing over it hangs all the same. */
static void long_lines_hang_from_what_is_over_them(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double most; /* of what a line hangs from, ems */
        int least, all;
    } cases[] = {{"a word\nthen one line that is much longer than all above", 2, 10, 80},
                 {"I\nam\na paragraph whose third line is longer\nend", 2, 10, 90},
                 {"ab\n\nabcdefghijklmnopqrstuvw", 3, 4, 46},
                 {"a\n                    abc", 11, 6, 6}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int brace = DYN_BRACE_NONE; brace <= DYN_BRACE_LINES; brace++) {
            struct dyn_word_def def = dyn_word_def_usual();
            struct dyn_network *n;
            struct dyn_word *word;
            int hang = 0;
            def.text = cases[c].text;
            def.shaper = shapers[0];
            def.style.brace = brace;
            scene_must(dyn_network_create(&n));
            scene_must(dyn_word_create(n, &def, &word));
            const struct dyn_word_range range = dyn_word_range(word);
            for (int i = 0; i < range.springs_count; i++) {
                const enum dyn_part part = dyn_word_part(word, i);
                const struct dyn_spring s = dyn_spring_get(n, range.first_spring + i);
                hang += part == DYN_HANG;
                if (part == DYN_HANG || part == DYN_HANG_BRACE)
                    assert_true(s.rest_length < cases[c].most);
            }
            assert_in_range(hang, cases[c].least, cases[c].all - (cases[c].all > 6));
            dyn_word_destroy(word);
            dyn_network_destroy(n);
        }
}

/* How many springs across the gaps between letters, and between lines, a text has. */
static void across_count(const char *text, enum dyn_brace brace, int *of_letters, int *of_lines)
{
    struct dyn_word_def def = dyn_word_def_usual();
    struct dyn_network *n;
    struct dyn_word *word;
    def.text = text;
    def.shaper = shapers[0];
    def.style.brace = brace;
    scene_must(dyn_network_create(&n));
    scene_must(dyn_word_create(n, &def, &word));
    *of_letters = *of_lines = 0;
    for (int i = 0; i < dyn_word_range(word).springs_count; i++) {
        *of_letters += dyn_word_part(word, i) == DYN_LINK_BRACE;
        *of_lines += dyn_word_part(word, i) == DYN_HANG_BRACE;
    }
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

static void words_alone_are_chains(void **state)
{
    (void)state;
    static const struct {
        enum dyn_brace brace;
        int word[2], lines[2];
    } wanted[] = {{DYN_BRACE_NONE, {0, 0}, {0, 0}},
                  {DYN_BRACE_CROSSED, {8, 0}, {8, 6}},
                  {DYN_BRACE_PARAGRAPH, {0, 0}, {8, 6}},
                  {DYN_BRACE_LINES, {0, 0}, {8, 0}}};
    for (int i = 0; i < 4; i++) {
        int letters, lines;
        across_count("abcde", wanted[i].brace, &letters, &lines);
        assert_int_equal(letters, wanted[i].word[0]);
        assert_int_equal(lines, wanted[i].word[1]);
        across_count("abc\nabc", wanted[i].brace, &letters, &lines);
        assert_int_equal(letters, wanted[i].lines[0]);
        assert_int_equal(lines, wanted[i].lines[1]);
    }
    assert_int_equal((int)dyn_word_style_usual().brace, DYN_BRACE_PARAGRAPH);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossed_paragraph_has_springs_across),
        cmocka_unit_test(long_lines_hang_from_what_is_over_them),
        cmocka_unit_test(words_alone_are_chains),
        cmocka_unit_test(stiff_texts_stay_blocks),
        cmocka_unit_test(jelly_texts_keep_their_shape),
        cmocka_unit_test(usual_texts_keep_their_shape),
        cmocka_unit_test(hanging_texts_keep_their_order),
    };
    for (int i = 0; i < FACES; i++)
        if (font_face_open(face_names[i], 0, &faces[i]) != FONT_OK ||
            font_shaper_create(faces[i], &shapers[i]) != FONT_OK)
            return 1;
    const int failed = cmocka_run_group_tests_name("paragraph", tests, NULL, NULL);
    for (int i = 0; i < FACES; i++) {
        font_shaper_destroy(shapers[i]);
        font_face_close(faces[i]);
    }
    return failed;
}
