/* test_theme.c - themes: the built-in ones define everything; good files, and random ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <theme.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"

static void built_in_themes_name_everything(void **state)
{
    (void)state;
    static const char *const names[] = {"light", "dark"};
    for (int i = 0; i < 2; i++) {
        struct stage_theme theme;
        if (stage_theme_open(names[i], &theme) != STAGE_OK)
            fail_msg("%s", stage_error());
        for (int c = 0; c < STAGE_COLORS_COUNT; c++)
            if (!(theme.colors[c].a > 0))
                fail_msg("%s: colour %d", names[i], c);
        for (int s = 0; s < STAGE_SIZES_COUNT; s++)
            if (!(theme.sizes[s] > 0))
                fail_msg("%s: size %d", names[i], s);
    }
}

static void files_say_what_they_change(void **state)
{
    (void)state;
    struct stage_theme light, theme;
    const char *path = scratch_path("my.theme");
    FILE *file = fopen(path, "w");
    fputs("# mine\n\n letter\t= #ff0080 \r\nskin=#01020380\n  mass_radius = 4.5", file);
    fclose(file);
    assert_int_equal(stage_theme_open("light", &light), STAGE_OK);
    if (stage_theme_open(path, &theme) != STAGE_OK)
        fail_msg("%s", stage_error());
    const struct stage_color *c = &theme.colors[STAGE_COLOR_LETTER];
    assert_true(c->r == 1 && c->g == 0 && c->a == 1);
    assert_int_equal(lroundf(theme.colors[STAGE_COLOR_SKIN].a * 255), 0x80);
    assert_true(theme.sizes[STAGE_SIZE_MASS_RADIUS] == 4.5);
    theme.colors[STAGE_COLOR_LETTER] = light.colors[STAGE_COLOR_LETTER];
    theme.colors[STAGE_COLOR_SKIN] = light.colors[STAGE_COLOR_SKIN];
    theme.sizes[STAGE_SIZE_MASS_RADIUS] = light.sizes[STAGE_SIZE_MASS_RADIUS];
    assert_memory_equal(&theme, &light, sizeof theme);
}

static void wrong_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *said;
    } wrong[] = {
        {"letter = #12345\n", "t:1: letter must be a colour"},
        {"\nletter = #12345g\n", "t:2: letter must be a colour"},
        {"letter #123456\n", "t:1: a line must be"},
        {"leter = #123456\n", "t:1: a theme has no 'leter'; it has background, grid"},
        {"mass_radius = 3px\n", "t:1: mass_radius must be a number"},
        {"mass_radius = nan\n", "t:1: mass_radius must be"},
        {"mass_radius = 1e9\n", "t:1: mass_radius must be"},
        {"mass_radius =\n", "t:1: mass_radius must be"},
        {"= 3\n", "t:1: a theme has no ''"},
    };
    struct stage_theme theme, before;
    assert_int_equal(stage_theme_open("light", &theme), STAGE_OK);
    before = theme;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(stage_theme_read(wrong[i].text, strlen(wrong[i].text), "t", &theme),
                         STAGE_BAD_FILE);
        if (strncmp(stage_error(), wrong[i].said, strlen(wrong[i].said)) != 0)
            fail_msg("%s", stage_error());
        assert_memory_equal(&theme, &before, sizeof theme);
    }
    assert_int_equal(stage_theme_open("/no/such/theme", &theme), STAGE_BAD_FILE);
    assert_non_null(strstr(stage_error(), "/no/such/theme: cannot be read: No such file"));
    assert_int_equal(stage_theme_open("/", &theme), STAGE_BAD_FILE);
}

/* A good theme with random changes, and random bytes, are read or refused in one line. */
static void bytes_by_chance_are_read_or_refused(void **state)
{
    (void)state;
    static const char good[] = "letter = #aabbcc\n# c\nmass_radius = 3\nskin=#00112233\n";
    uint64_t chance = 5;
    struct stage_theme theme;
    assert_int_equal(stage_theme_open("light", &theme), STAGE_OK);
    int refused = 0, runs = 20000;
    for (int i = 0; i < runs; i++) {
        size_t length = sizeof good - 1;
        for (int k = 0; k < 3; k++) {
            chance = chance * 6364136223846793005u + 1442695040888963407u;
            length = k == 0 && chance >> 62 == 0 ? (size_t)(chance >> 33) % length : length;
        }
        char *text = malloc(length + 1); /* exact: finds reads beyond it */
        char *bytes = realloc(text, length ? length : 1);
        assert_non_null(bytes);
        memcpy(bytes, good, length);
        for (int k = 0; length && k < i % 5; k++) {
            chance = chance * 6364136223846793005u + 1442695040888963407u;
            bytes[(chance >> 20) % length] = (char)(chance >> 50);
        }
        enum stage_status status = stage_theme_read(bytes, length, "t", &theme);
        assert_true(status == STAGE_OK || status == STAGE_BAD_FILE);
        refused += status != STAGE_OK;
        assert_null(strchr(stage_error(), '\n'));
        free(bytes);
    }
    assert_in_range(refused, runs / 20, runs);
}

static void colours_mix_as_light(void **state)
{
    (void)state;
    struct stage_color black = {0, 0, 0, 0}, white = {1, 1, 1, 1};
    struct stage_color half = stage_color_mix(black, white, 0.5);
    assert_true(fabsf(half.r - 0.7354f) < 1e-3f && half.a == 0.5f);
    assert_true(stage_color_mix(black, white, 7).r > 0.999f);
    assert_true(stage_color_fade(white, 0.25).a == 0.25f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_themes_name_everything),
        cmocka_unit_test(files_say_what_they_change),
        cmocka_unit_test(wrong_files_are_refused),
        cmocka_unit_test(bytes_by_chance_are_read_or_refused),
        cmocka_unit_test(colours_mix_as_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
