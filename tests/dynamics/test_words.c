/* test_words.c - springy words: boxes, springs, presets, paths; letters that break apart and
 * push each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <collide.h>
#include <energy.h>
#include <events.h>
#include <hand.h>
#include <math.h>
#include <quad.h>
#include <step.h>
#include <word.h>

#include "scenes.h"

struct fixture {
    struct font_face *face;
    struct font_shaper *shaper;
    double em;
};

static int begin(void **state)
{
    static struct fixture f;
    if (font_face_open("DejaVuSans", 0, &f.face) != FONT_OK ||
        font_shaper_create(f.face, &f.shaper) != FONT_OK)
        return -1;
    struct font_face_info info;
    font_face_describe(f.face, &info);
    f.em = info.units_per_em;
    *state = &f;
    return 0;
}

static int finish(void **state)
{
    struct fixture *f = *state;
    font_shaper_destroy(f->shaper);
    font_face_close(f->face);
    return 0;
}

static struct dyn_word_def def_of(const struct fixture *f, const char *text)
{
    struct dyn_word_def def = dyn_word_def_usual();
    def.text = text;
    def.shaper = f->shaper;
    return def;
}

static struct dyn_word *word_make(struct dyn_network **n, const struct dyn_word_def *def)
{
    struct dyn_word *word;
    scene_must(dyn_network_create(n));
    scene_must(dyn_word_create(*n, def, &word));
    return word;
}

/* The x of a letter's origin, computed from its box. */
static double origin_x(const struct dyn_word *word, const struct dyn_network *n, int i)
{
    const struct dyn_letter *l = dyn_word_letter(word, i);
    return dyn_network_states(n)[l->mass[0]].x - l->x0;
}

static void letters_have_their_advances_and_kerning(void **state)
{
    const struct fixture *f = *state;
    struct dyn_word_def def = def_of(f, "AVATAR to");
    def.size = 2;
    def.x = 5;
    def.y = 1;
    struct dyn_network *n;
    struct dyn_word *word = word_make(&n, &def);
    struct font_layout layout;
    assert_int_equal(
        font_shaper_layout(f->shaper, def.text, strlen(def.text), 200, NULL, &layout), FONT_OK);
    assert_int_equal(dyn_word_letters_count(word), 8); /* the space is none */
    double kerned = 0;
    for (int i = 0, glyph = 0; i < 8; i++, glyph++) {
        glyph += layout.glyphs[glyph].cluster == 6;
        assert_near(origin_x(word, n, i), 5 + layout.glyphs[glyph].x_px / 100, 1e-9);
        double advance;
        assert_int_equal(font_face_advance(f->face, layout.glyphs[glyph].glyph, &advance),
                         FONT_OK);
        if (glyph + 1 < layout.glyphs_count)
            kerned += fabs(layout.glyphs[glyph + 1].x_px - layout.glyphs[glyph].x_px -
                           advance / f->em * 200);
    }
    assert_true(kerned > 10); /* of 200 px: AV, VA, AT, TA */
    font_layout_finish(&layout);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

/* Accents have their letter's masses, no springs, and are where the text has them: from left to
 * right, from right to left, and alone. */
static void marks_stand_on_their_letters(void **state)
{
    const struct fixture *f = *state;
    static const struct {
        const char *text;
        int letters, marks;
    } cases[] = {{"ag\xcc\x88x\xcc\x82\xcc\x84z", 4,
                  3}, /* a, g and diaeresis, x, circumflex, macron, z */
                 {"\xd7\x91\xd6\xb8\xd7\x9d", 2, 1}, /* bet and qamats, final mem */
                 {"\xcc\x88", 1, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct dyn_word_def def = def_of(f, cases[k].text);
        struct dyn_network *n;
        struct dyn_word *word = word_make(&n, &def);
        struct font_layout layout;
        assert_int_equal(
            font_shaper_layout(f->shaper, def.text, strlen(def.text), 100, NULL, &layout),
            FONT_OK);
        int letters = dyn_word_letters_count(word), found = 0;
        assert_int_equal(letters, cases[k].letters);
        assert_int_equal(dyn_word_glyphs_count(word), letters + cases[k].marks);
        assert_int_equal(dyn_masses_count(n), 4 * letters);
        assert_int_equal(dyn_springs_count(n), 6 * letters + 2 * (letters - 1));
        for (int i = letters; i < dyn_word_glyphs_count(word); i++) {
            const struct dyn_letter *mark = dyn_word_letter(word, i), *letter = NULL;
            for (int j = 0; j < letters; j++)
                if (dyn_word_letter(word, j)->cluster == mark->cluster)
                    letter = dyn_word_letter(word, j);
            assert_non_null(letter);
            assert_memory_equal(mark->mass, letter->mass, sizeof mark->mass);
            for (int g = 0; g < layout.glyphs_count; g++)
                if (layout.glyphs[g].glyph == mark->glyph) {
                    const struct dyn_state *corner = &dyn_network_states(n)[mark->mass[0]];
                    assert_near(corner->x - mark->x0, layout.glyphs[g].x_px / 100, 1e-9);
                    assert_near(corner->y - mark->y0, -layout.glyphs[g].y_px / 100, 1e-9);
                    found++;
                }
        }
        assert_int_equal(found, cases[k].marks);
        font_layout_finish(&layout);
        dyn_word_destroy(word);
        dyn_network_destroy(n);
    }
}

static void boxes_are_the_capital_ms_or_the_inks(void **state)
{
    const struct fixture *f = *state;
    for (int ink = 0; ink < 2; ink++) {
        struct dyn_word_def def = def_of(f, "Mgil.");
        def.style.box = ink;
        struct dyn_network *n;
        struct dyn_word *word = word_make(&n, &def);
        struct font_outline m;
        assert_int_equal(font_face_outline(f->face, font_face_glyph(f->face, 'M'), &m),
                         FONT_OK);
        for (int i = 0; i < dyn_word_letters_count(word); i++) {
            const struct dyn_letter *l = dyn_word_letter(word, i);
            struct font_outline outline;
            assert_int_equal(font_face_outline(f->face, l->glyph, &outline), FONT_OK);
            assert_true(l->x1 - l->x0 >= 0.0599 && l->y1 - l->y0 >= 0.0599);
            if (ink) {
                assert_true(l->x0 <= outline.box.x0 / f->em + 1e-12);
                assert_true(l->y0 <= outline.box.y0 / f->em + 1e-12);
                assert_true(l->x1 >= outline.box.x1 / f->em - 1e-12);
                assert_true(l->y1 >= outline.box.y1 / f->em - 1e-12);
            } else {
                assert_near(l->y0, m.box.y0 / f->em, 1e-12);
                assert_near(l->y1, m.box.y1 / f->em, 1e-12);
                assert_near(l->x0, outline.advance / f->em - l->x1, 1e-12);
            }
            font_outline_finish(&outline);
        }
        font_outline_finish(&m);
        dyn_word_destroy(word);
        dyn_network_destroy(n);
    }
}

static void paragraph_is_boxes_links_and_what_lines_hang_from(void **state)
{
    const struct fixture *f = *state;
    struct dyn_word_def def = def_of(f, "wet paper\n\nand springs");
    struct dyn_network *n;
    struct dyn_word *word = word_make(&n, &def);
    int of_part[DYN_PARTS_COUNT] = {0};
    struct dyn_word_range range = dyn_word_range(word);
    for (int i = 0; i < range.springs_count; i++) {
        of_part[dyn_word_part(word, i)]++;
        assert_near(dyn_spring_strain(n, range.first_spring + i), 0, 1e-12);
    }
    assert_int_equal(range.masses_count, 4 * 18);
    assert_int_equal(of_part[DYN_SIDE], 4 * 18);
    assert_int_equal(of_part[DYN_DIAGONAL], 2 * 18);
    assert_int_equal(of_part[DYN_LINK], 2 * (7 + 9));
    assert_int_equal(of_part[DYN_HANG], 2 * 10 - 1); /* the last corner juts out */
    for (int i = 0; i < 18; i++) {
        double corners[4][2];
        dyn_word_quad(word, n, i, corners);
        assert_near(dyn_quad_condition(corners), 1, 1e-9);
        const struct dyn_letter *l = dyn_word_letter(word, i);
        assert_int_equal(l->link[0] < 0, i == 7 || i == 17);
    }
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

/* On a circle all letters stand upright on its line, and the springs are at rest. */
static void word_goes_round_a_circle(void **state)
{
    const struct fixture *f = *state;
    double circle[721][2];
    dyn_path_circle(2, 3, 2, 90, circle, 721);
    struct dyn_word_def def = def_of(f, "round and round");
    def.path = (const double(*)[2])circle;
    def.path_count = 721;
    struct dyn_network *n;
    struct dyn_word *word = word_make(&n, &def);
    struct dyn_word_range range = dyn_word_range(word);
    for (int i = 0; i < dyn_word_letters_count(word); i++) {
        double q[4][2];
        const struct dyn_letter *l = dyn_word_letter(word, i);
        dyn_word_quad(word, n, i, q);
        for (int k = 0; k < 4; k++) {
            double want = 2 + (k < 2 ? l->y0 : l->y1);
            assert_near(hypot(q[k][0] - 2, q[k][1] - 3), want, 0.01);
        }
        assert_true(dyn_quad_condition(q) > 0.5);
    }
    for (int i = 0; i < range.springs_count; i++)
        assert_near(dyn_spring_strain(n, range.first_spring + i), 0, 1e-12);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

static void letter_under_a_point_is_found(void **state)
{
    const struct fixture *f = *state;
    struct dyn_word_def def = def_of(f, "spring");
    def.y = 2;
    struct dyn_network *n;
    struct dyn_word *word = word_make(&n, &def);
    scene_must(dyn_network_step(n, 1.0 / 240, 200)); /* it has fallen, and is bent */
    for (int i = 0; i < dyn_word_letters_count(word); i++) {
        double q[4][2], x, y, uv[2];
        struct dyn_quad_map map;
        dyn_word_quad(word, n, i, q);
        assert_true(dyn_quad_make(&map, DYN_QUAD_SMOOTH, q));
        assert_true(dyn_quad_point(&map, 0.4, 0.6, &x, &y, NULL));
        assert_int_equal(dyn_word_letter_at(word, n, x, y, uv), i);
        assert_near(uv[0], 0.4, 1e-9);
        assert_near(uv[1], 0.6, 1e-9);
    }
    assert_int_equal(dyn_word_letter_at(word, n, -5, 0, NULL), -1);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

/* ---- presets ---- */

struct fall {
    int snaps, letter_snaps, clanks, broken_links;
    double lowest;
};

static struct fall fall(const struct fixture *f, const char *preset, double y, double seconds)
{
    struct dyn_word_def def = def_of(f, "breakdown");
    struct dyn_world world = dyn_world_usual();
    struct dyn_network *n;
    struct dyn_word *word;
    struct fall seen = {.lowest = INFINITY};
    def.y = y;
    scene_must(dyn_preset_apply(preset, &def.style, &world));
    scene_must(dyn_network_create(&n));
    scene_must(dyn_network_world_set(n, &world));
    scene_must(dyn_word_create(n, &def, &word));
    struct dyn_event event;
    for (int step = 0; step < (int)(seconds * 240); step++) {
        scene_must(dyn_network_step(n, 1.0 / 240, 1));
        while (dyn_events_take(n, &event, 1)) {
            seen.clanks += event.kind == DYN_CLANK;
            seen.snaps += event.kind == DYN_SNAP;
            seen.letter_snaps +=
                event.kind == DYN_SNAP && dyn_word_part(word, event.spring) <= DYN_DIAGONAL;
        }
    }
    for (int i = 0; i < dyn_masses_count(n); i++) {
        const struct dyn_state *s = &dyn_network_states(n)[i];
        assert_true(fabs(s->x) < 50 && fabs(s->y) < 50);
        seen.lowest = fmin(seen.lowest, s->y);
    }
    for (int i = 0; i < dyn_word_letters_count(word); i++)
        for (int k = 0; k < 2; k++) {
            int link = dyn_word_letter(word, i)->link[k];
            seen.broken_links += link >= 0 && dyn_spring_get(n, link).broken;
        }
    dyn_word_destroy(word);
    dyn_network_destroy(n);
    return seen;
}

/* A dropped word breaks between some of its letters, and never within a letter; other words
 * fall or hang in one piece. */
static void breakdown_breaks_and_others_do_not(void **state)
{
    const struct fixture *f = *state;
    for (int i = 0; i < dyn_presets_count; i++) {
        const char *name = dyn_presets[i].name;
        bool breaks = strcmp(name, "breakdown") == 0;
        bool falls = breaks || strcmp(name, "stiff") == 0 || strcmp(name, "jelly") == 0;
        struct fall seen = fall(f, name, 8, 6);
        print_message("%s: %d snaps (%d of letters), %d clanks, lowest %.3f\n", name,
                      seen.snaps, seen.letter_snaps, seen.clanks, seen.lowest);
        assert_int_equal(seen.snaps > 0, breaks);
        assert_int_equal(seen.snaps, seen.broken_links);
        assert_int_equal(seen.letter_snaps, 0);
        assert_true(!breaks || seen.snaps < 14); /* pieces of several letters */
        assert_int_equal(seen.clanks > 0, falls);
        assert_int_equal(fabs(seen.lowest) < 0.01, falls);
    }
}

static void presets_and_styles_are_looked_up_and_checked(void **state)
{
    (void)state;
    struct dyn_word_style style = dyn_word_style_usual();
    struct dyn_world world = dyn_world_usual();
    for (int i = 0; i < dyn_presets_count; i++) {
        char sets[300], *rest = sets;
        snprintf(sets, sizeof sets, "%s", dyn_presets[i].sets);
        int words = 0;
        while (strtok_r(rest, " ", &rest))
            words++;
        struct dyn_word_style usual = dyn_word_style_usual();
        struct dyn_world before = dyn_world_usual();
        world = dyn_world_usual();
        scene_must(dyn_preset_apply(dyn_presets[i].name, &style, &world));
        int changed = 0;
        for (int k = 0; k < dyn_word_controls_count; k++)
            changed += control_read(&dyn_word_controls[k], &style) !=
                       control_read(&dyn_word_controls[k], &usual);
        for (int k = 0; k < dyn_controls_count; k++)
            changed += control_read(&dyn_controls[k], &world) !=
                       control_read(&dyn_controls[k], &before);
        assert_int_equal(changed, words); /* each is set, to what is not usual */
    }
    assert_int_equal(dyn_preset_apply("soup", &style, &world), DYN_BAD_ARGUMENT);
    assert_string_equal(dyn_error(),
                        "there is no preset 'soup'; there are stiff jelly pendulum "
                        "heavy curtain breakdown");
    assert_int_equal(sizeof style, (size_t)dyn_word_controls_count * sizeof(double));
}

static void style_is_changed_while_it_moves(void **state)
{
    const struct fixture *f = *state;
    struct dyn_word_def def = def_of(f, "soft");
    struct dyn_network *n;
    def.y = 1;
    struct dyn_word *word = word_make(&n, &def);
    scene_must(dyn_spring_cut(n, 3));
    struct dyn_word_style style = def.style;
    double rest = dyn_spring_get(n, 2).rest_length;
    style.side = 123;
    style.letter_mass = 4;
    style.link_breaking = 0.5;
    scene_must(dyn_word_style_set(word, n, &style));
    assert_true(dyn_spring_get(n, 0).constant == 123 && dyn_spring_get(n, 3).broken);
    assert_true(dyn_spring_get(n, 2).rest_length == rest);
    assert_true(dyn_spring_get(n, 4).constant == style.diagonal);
    assert_true(dyn_spring_get(n, dyn_word_letter(word, 0)->link[0]).breaking_strain == 0.5);
    assert_true(isinf(dyn_spring_get(n, 0).breaking_strain));
    assert_true(dyn_mass_get(n, 5).mass == 1);
    style.side = -1;
    assert_int_equal(dyn_word_style_set(word, n, &style), DYN_BAD_ARGUMENT);
    assert_true(dyn_spring_get(n, 0).constant == 123);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

/* ---- words with words ---- */

static void words_hang_from_words(void **state)
{
    const struct fixture *f = *state;
    struct dyn_word_def def = def_of(f, "upper");
    struct dyn_network *n;
    def.y = 8;
    def.style.tack = DYN_TACK_TOP;
    struct dyn_word *upper = word_make(&n, &def), *lower;
    def = def_of(f, "low");
    def.y = 6.5;
    scene_must(dyn_word_create(n, &def, &lower));
    int first, count;
    scene_must(dyn_words_hang(n, upper, lower, &first, &count));
    assert_int_equal(count, 6);
    assert_int_equal(first + count, dyn_springs_count(n));
    scene_must(dyn_network_step(n, 1.0 / 240, 240 * 10));
    for (int i = 0; i < dyn_masses_count(n); i++)
        assert_true(dyn_network_states(n)[i].y > 4); /* none fell down */
    dyn_word_destroy(upper);
    dyn_word_destroy(lower);
    dyn_network_destroy(n);
}

static double momentum(const struct dyn_network *n, bool y)
{
    double sum = 0;
    for (int i = 0; i < dyn_masses_count(n); i++) {
        struct dyn_mass m = dyn_mass_get(n, i);
        sum += m.mass * (y ? m.vy : m.vx);
    }
    return sum;
}

/* Two words fly towards each other. Without collisions they pass through each other; with
 * collisions they bounce and keep their momentum. */
static void words_thrown_at_each_other_bounce(void **state)
{
    const struct fixture *f = *state;
    for (int collide = 0; collide < 2; collide++) {
        struct dyn_word_def def = def_of(f, "left");
        struct dyn_network *n;
        struct dyn_word *words[2];
        words[0] = word_make(&n, &def);
        def.text = "right";
        def.x = 4;
        def.y = 0.2;
        def.style.letter_mass = 2;
        scene_must(dyn_word_create(n, &def, &words[1]));
        struct dyn_world w = *dyn_network_world(n);
        w.gravity = w.drag = w.floor_on = 0;
        scene_must(dyn_network_world_set(n, &w));
        for (int k = 0; k < 2; k++) {
            struct dyn_word_range range = dyn_word_range(words[k]);
            for (int i = 0; i < range.masses_count; i++) {
                struct dyn_mass m = dyn_mass_get(n, range.first_mass + i);
                m.vx = k ? -1 : 2;
                scene_must(dyn_mass_set(n, range.first_mass + i, &m));
            }
        }
        double before[2] = {momentum(n, false), momentum(n, true)};
        int contacts, touched = 0;
        for (int step = 0; step < 720; step++) {
            scene_must(dyn_network_step(n, 1.0 / 240, 1));
            if (collide)
                scene_must(
                    dyn_words_collide(n, (const struct dyn_word *const *)words, 2, &contacts));
            touched += collide && contacts > 0;
        }
        double left = dyn_network_states(n)[dyn_word_range(words[0]).first_mass].x;
        double right = dyn_network_states(n)[dyn_word_range(words[1]).first_mass].x;
        assert_int_equal(left < right, collide);
        assert_int_equal(touched > 0, collide);
        assert_near(momentum(n, false), before[0], 1e-9);
        assert_near(momentum(n, true), before[1], 1e-9);
        for (int k = 0; k < 2; k++)
            dyn_word_destroy(words[k]);
        dyn_network_destroy(n);
    }
}

/* The overlap of letters' boxes: the share of their sample points that lie well within another
 * box. */
static double overlap(const struct dyn_word *word, const struct dyn_network *n)
{
    int in = 0, all = 0;
    for (int i = 0; i < dyn_word_letters_count(word); i++) {
        double q[4][2], x, y, u, v;
        struct dyn_quad_map map, other;
        dyn_word_quad(word, n, i, q);
        assert_true(dyn_quad_make(&map, DYN_QUAD_SMOOTH, q));
        for (int k = 0; k < 25; k++, all++) {
            dyn_quad_point(&map, k % 5 / 4.0, k / 5 / 4.0, &x, &y, NULL);
            for (int j = 0; j < dyn_word_letters_count(word); j++) {
                dyn_word_quad(word, n, j, q);
                if (j != i && dyn_quad_make(&other, DYN_QUAD_SMOOTH, q) &&
                    dyn_quad_inverse(&other, x, y, &u, &v) && u > 0.1 && u < 0.9 && v > 0.1 &&
                    v < 0.9)
                    in++;
            }
        }
    }
    return (double)in / all;
}

/* A word's separate letters fall into a cup. They come to rest on each other, not in each
 * other. */
static void letters_poured_into_a_cup_lie_on_each_other(void **state)
{
    const struct fixture *f = *state;
    double in_each_other[2];
    for (int collide = 0; collide < 2; collide++) {
        struct dyn_word_def def = def_of(f, "poured into a cup");
        struct dyn_network *n;
        def.y = 3;
        def.width = 4.5;
        def.style.damping_ratio = 0.4;
        def.style.side = def.style.diagonal = 5000;
        struct dyn_word *word = word_make(&n, &def);
        struct dyn_world w = *dyn_network_world(n);
        w.left_on = w.right_on = 1;
        w.left = 0.4;
        w.right = 2.6;
        w.restitution = 0.1;
        w.drag = 0.3;
        scene_must(dyn_network_world_set(n, &w));
        struct dyn_word_range range = dyn_word_range(word);
        for (int i = 0; i < range.springs_count; i++)
            if (dyn_word_part(word, i) >= DYN_LINK)
                scene_must(dyn_spring_cut(n, range.first_spring + i));
        for (int step = 0; step < 240 * 12; step++) {
            scene_must(dyn_network_step(n, 1.0 / 240, 1));
            const struct dyn_word *one = word;
            if (collide)
                scene_must(dyn_words_collide(n, &one, 1, NULL));
        }
        in_each_other[collide] = overlap(word, n);
        for (int i = 0; i < dyn_masses_count(n); i++)
            assert_true(fabs(dyn_network_states(n)[i].x) < 10 &&
                        dyn_network_states(n)[i].y < 10);
        dyn_word_destroy(word);
        dyn_network_destroy(n);
    }
    print_message("of boxes' points in another box: %.2f, with collisions %.3f\n",
                  in_each_other[0], in_each_other[1]);
    assert_true(in_each_other[0] > 0.5 && in_each_other[1] < 0.05);
}

/* ---- what cannot be ---- */

static void bad_words_leave_the_network_as_it_was(void **state)
{
    const struct fixture *f = *state;
    struct dyn_network *n = scene_letter(0, 0, 10, 0);
    struct dyn_word *word;
    static const double still[3][2] = {{1, 1}, {1, 1}, {1, 1}};
    struct dyn_word_def bad[6];
    for (int i = 0; i < 6; i++)
        bad[i] = def_of(f, "word");
    bad[0].text = "  \n";
    bad[1].size = NAN;
    bad[2].style.side = 1e9;
    bad[3].path = still;
    bad[3].path_count = 3;
    bad[4].x = 1e7;
    bad[5].features = "???";
    static const char *const errors[6] = {
        "nothing of '  \n' has ink",
        "a word's size must be 0.01..1000 units (got nan)",
        "side must be 0..1e+06 kg/s2 (got 1e+09)",
        "a path cannot be 0 units long",
        "a word cannot be at (1e+07, 0)",
        NULL,
    };
    for (int i = 0; i < 6; i++) {
        assert_int_equal(dyn_word_create(n, &bad[i], &word), DYN_BAD_ARGUMENT);
        assert_null(word);
        if (errors[i] && i > 0)
            assert_string_equal(dyn_error(), errors[i]);
        assert_int_equal(dyn_masses_count(n), 4);
        assert_int_equal(dyn_springs_count(n), 6);
    }
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_have_their_advances_and_kerning),
        cmocka_unit_test(marks_stand_on_their_letters),
        cmocka_unit_test(boxes_are_the_capital_ms_or_the_inks),
        cmocka_unit_test(paragraph_is_boxes_links_and_what_lines_hang_from),
        cmocka_unit_test(word_goes_round_a_circle),
        cmocka_unit_test(letter_under_a_point_is_found),
        cmocka_unit_test(breakdown_breaks_and_others_do_not),
        cmocka_unit_test(presets_and_styles_are_looked_up_and_checked),
        cmocka_unit_test(style_is_changed_while_it_moves),
        cmocka_unit_test(words_hang_from_words),
        cmocka_unit_test(words_thrown_at_each_other_bounce),
        cmocka_unit_test(letters_poured_into_a_cup_lie_on_each_other),
        cmocka_unit_test(bad_words_leave_the_network_as_it_was),
    };
    return cmocka_run_group_tests(tests, begin, finish);
}
