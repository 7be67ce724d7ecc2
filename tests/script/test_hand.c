/* test_hand.c - what a painter's hand expects of scripts: brushes that turn, a board that
 * leans; and files, of which the host is told. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <unistd.h>

#include "scripted.h"

/* A stroke along the tuft's depth is broad where the tuft turns with it, else thin. */
static void flat_brushes_turn_with_the_stroke(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    if (scripted_run(
            &s, "local function painted(o)\n"
                "  local p = paper{width = 56, height = 40, pigments = {'ultramarine'}}\n"
                "  o.width = 18\n"
                "  local b = p:brush(o)\n"
                "  b:dip{water = 0.5, ultramarine = 1}\n"
                "  p:stroke{brush = b, points = {{10, 20}, {46, 20}}, pressure = 0.7}\n"
                "  p:dry()\n"
                "  local m, n = p:mask('fixed pigment', 0.02, 0.021, 'ultramarine'), 0\n"
                "  p:layer('red', m)\n"
                "  for y = 0, 39 do n = n + p:at('red', 28, y) end\n"
                "  return n\n"
                "end\n"
                "for _, kind in ipairs{'flat', 'fan', 'bristle'} do\n"
                "  local usual = painted{kind = kind}\n"
                "  assert(usual == painted{kind = kind, follows = true}, kind)\n"
                "  assert(usual > 1.5 * painted{kind = kind, follows = false}, kind)\n"
                "  assert(painted{kind = kind, angle = 0} == painted{kind = kind, follows = "
                "false})\n"
                "  assert(usual == painted{kind = kind, angle = 0, follows = true}, kind)\n"
                "end\n"
                "assert(painted{kind = 'mop'} == painted{kind = 'mop', follows = false})\n") !=
        SCRIPT_OK)
        fail_msg("%s", s.errors);
}

/* A leaning board pulls water as gravity does, by the sine of its angle. */
static void a_board_leans(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    if (scripted_run(&s,
                     "local function low(lean)\n"
                     "  local p = paper{width = 32, height = 32, stock = 'glass'}\n"
                     "  lean(p)\n"
                     "  p:put(rect(12, 12, 8, 8), {water = 2})\n"
                     "  p:step(40)\n"
                     "  local x, y, all = 0, 0, 0\n"
                     "  for j = 0, 31 do for i = 0, 31 do\n"
                     "    local w = p:at('surface water', i, j)\n"
                     "    x, y, all = x + w * (i - 15.5), y + w * (j - 15.5), all + w\n"
                     "  end end\n"
                     "  return x / all, y / all\n"
                     "end\n"
                     "local x, y = low(function(p) p:tilt(30) end)\n"
                     "local u, v = low(function(p) p:air{gravity = {0, 0.5}} end)\n"
                     "assert(y > 0.5 and math.abs(y - v) < 1e-3 and math.abs(x - u) < 1e-3)\n"
                     "x, y = low(function(p) p:tilt(20, 0) end)\n"
                     "assert(x > 0.3 and math.abs(y) < x / 4)\n"
                     "x, y = low(function(p) p:tilt(40, 180) p:tilt(0) end)\n"
                     "u, v = low(function(p) end)\n"
                     "assert(x == u and y == v)\n") != SCRIPT_OK)
        fail_msg("%s", s.errors);
    assert_int_equal(scripted_run(&s, "paper{width = 8, height = 8}:tilt(91)"), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "tilt's degrees must be 0..90 (got 91)"));
    assert_int_equal(
        scripted_run(&s, "paper{width = 8, height = 8, model = 'thesis'}:tilt(10)"),
        SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "lies flat"));
}

/* The host is told of each file that the script names, once it is there. */
static void wrote(void *context, const char *path)
{
    struct scripted *s = context;
    if (access(path, R_OK) != 0)
        scripted_append(s->notes, "not there: ", 11);
    scripted_append(s->notes, strrchr(path, '/') + 1, strlen(strrchr(path, '/') + 1));
    scripted_append(s->notes, "\n", 1);
}

static void the_host_is_told_of_files(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config(), .host = {.wrote = wrote}};
    assert_int_equal(scripted_run(&s, "local p = paper{width = 8, height = 8}\n"
                                      "p:frame('told.png')\n"
                                      "p:save('told.h5')\n"
                                      "spring.network():save('told.springs')\n"
                                      "p:frame('no/told.png')\n"),
                     SCRIPT_FAILED);
    assert_string_equal(s.notes, "told.png\ntold.h5\ntold.springs\n");
}

static void noted(void *context, const char *line)
{
    struct scripted *s = context;
    scripted_append(s->notes, line, strlen(line));
    scripted_append(s->notes, "\n", 1);
}

/* A character that no font has stands as a sign among others, and is told once: in masks, in
 * pages and in words on springs. */
static void letters_that_no_font_has_are_told(void **state)
{
    (void)state;
    static const char *const made[] = {"text('Bon\\u{F0000}', {size = 20})",
                                       "page('Bon\\u{F0000}', {width = 200, height = 200})",
                                       "spring.word{text = 'Bon\\u{F0000}'}",
                                       "paper{width = 90, height = 40}:type('Bon\\u{F0000}')"};
    for (int i = 0; i < 4; i++) {
        struct scripted s = {.config = scripted_config(), .host = {.note = noted}};
        char twice[256];
        snprintf(twice, sizeof twice, "for i = 1, 2 do %s end", made[i]);
        if (scripted_run(&s, twice) != SCRIPT_OK)
            fail_msg("%s", s.errors);
        const char *told = strstr(s.notes, "no font has a glyph for U+F0000; ");
        if (!told || strstr(told + 1, "no font has"))
            fail_msg("%s: '%s'", made[i], s.notes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_brushes_turn_with_the_stroke),
        cmocka_unit_test(a_board_leans),
        cmocka_unit_test(the_host_is_told_of_files),
        cmocka_unit_test(letters_that_no_font_has_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
