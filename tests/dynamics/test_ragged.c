/* test_ragged.c - paragraphs with short lines: what their letters hang from. */
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

static struct font_face *face;
static struct font_shaper *shaper;

static struct dyn_word_def def_of(const char *text)
{
    struct dyn_word_def def = dyn_word_def_usual();
    def.text = text;
    def.shaper = shaper;
    return def;
}

/* The line of the letter that a mass is a corner of. */
static int line_of_mass(const struct dyn_word *word, int mass)
{
    for (int i = 0; i < dyn_word_letters_count(word); i++)
        for (int k = 0; k < 4; k++)
            if (dyn_word_letter(word, i)->mass[k] == mass)
                return dyn_word_letter(word, i)->line;
    return -1;
}

/* Below a short line letters hang from what is over them, straight, turned, and round
 * a circle; a line that is longer than all above has an end that
 * hangs from the nearest. */
static void ragged_lines_hang_straight(void **state)
{
    (void)state;
    double circle[721][2];
    const double turned[2][2] = {{0, 4}, {7071, 7075}};
    dyn_path_circle(0, 0, 40, 90, circle, 721);
    for (int way = 0; way < 3; way++) {
        struct dyn_word_def def = def_of("nobody left the town\nand\nthe river rose");
        struct dyn_network *n;
        def.y = 8;
        def.path = way == 1 ? turned : way ? (const double(*)[2])circle : NULL;
        def.path_count = way == 0 ? 0 : way == 1 ? 2 : 721;
        struct dyn_word *word;
        scene_must(dyn_network_create(&n));
        scene_must(dyn_word_create(n, &def, &word));
        const struct dyn_word_range range = dyn_word_range(word);
        int from_first = 0, from_short = 0;
        for (int i = 0; i < range.springs_count; i++) {
            const struct dyn_spring s = dyn_spring_get(n, range.first_spring + i);
            if (dyn_word_part(word, i) != DYN_HANG || line_of_mass(word, s.end[1]) != 2)
                continue;
            from_first += line_of_mass(word, s.end[0]) == 0;
            from_short += line_of_mass(word, s.end[0]) == 1;
            assert_true(s.rest_length < 2.6); /* two lines and some of a letter's width */
        }
        assert_int_equal(from_first + from_short, 2 * 12);
        assert_in_range(from_short, 6, 10); /* "the" */
        dyn_word_destroy(word);
        dyn_network_destroy(n);
    }
}

/* It hangs, and hardly an end of a line goes to the side. */
static void ragged_paragraph_keeps_its_edge(void **state)
{
    (void)state;
    struct dyn_word_def def = def_of("nobody left the town\nand\nthe river rose\nand\nfell");
    struct dyn_world world = dyn_world_usual();
    struct dyn_network *n;
    def.y = 9;
    scene_must(dyn_preset_apply("curtain", &def.style, &world));
    struct dyn_word *word;
    scene_must(dyn_network_create(&n));
    scene_must(dyn_word_create(n, &def, &word));
    world.wind_x = 0;
    world.drag = 1;
    scene_must(dyn_network_world_set(n, &world));
    const int count = dyn_masses_count(n);
    struct dyn_state *before = malloc((size_t)count * sizeof *before);
    memcpy(before, dyn_network_states(n), (size_t)count * sizeof *before);
    scene_must(dyn_network_step(n, 1.0 / 240, 8 * 240));
    double most = 0;
    for (int i = 0; i < count; i++)
        most = fmax(most, fabs(dyn_network_states(n)[i].x - before[i].x));
    print_message("hung for 8 s, masses are %.2f ems beside where they were\n", most);
    assert_true(most < 0.5);
    free(before);
    dyn_word_destroy(word);
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ragged_lines_hang_straight),
        cmocka_unit_test(ragged_paragraph_keeps_its_edge),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK ||
        font_shaper_create(face, &shaper) != FONT_OK)
        return 1;
    const int failed = cmocka_run_group_tests_name("ragged", tests, NULL, NULL);
    font_shaper_destroy(shaper);
    font_face_close(face);
    return failed;
}
