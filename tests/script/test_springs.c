/* test_springs.c - networks and springy words in scripts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <unistd.h>

#include "scripted.h"

static void prints(const char *text, const char *want)
{
    struct scripted s = {.config = scripted_config()};
    enum script_status status = scripted_run(&s, text);
    if (status != SCRIPT_OK)
        fail_msg("%s", s.errors);
    assert_string_equal(s.prints, want);
}

static void fails(const char *text, const char *want)
{
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(scripted_run(&s, text), SCRIPT_FAILED);
    if (!strstr(s.errors, want))
        fail_msg("\"%s\" instead of \"%s\"", s.errors, want);
}

static void masses_fall_and_springs_hold(void **state)
{
    (void)state;
    prints("local n = spring.network() n:set('drag', 0) n:set('floor_on', false)\n"
           "local a, b = n:mass{y = 2, stuck = true}, n:mass{y = 1, mass = 2}\n"
           "local s = n:spring(a, b, {constant = 1000, damping = 50})\n"
           "n:step(240 * 20) local x, y = n:place(b)\n"
           "print(a, b, s, n:masses(), n:springs(), ('%.2f %.3f'):format(n:time(), 2 - "
           "math.sqrt(x^2 + (y - 2)^2)))\n"
           "n:cut(s) n:step(24) print(select(3, n:ends(s)), select(2, n:place(b)) < y)",
           "1\t2\t1\t2\t1\t20.00 0.980\nfalse\ttrue\n");
}

static void events_are_told_and_listed(void **state)
{
    (void)state;
    prints(
        "local n = spring.network() local m, heard = n:mass{y = 1}, {}\n"
        "n:on(function(e) heard[#heard + 1] = ('%s %d %d'):format(e.kind, e.mass, e.velocity) "
        "end)\n"
        "n:step(240) print(#heard > 0, heard[1]) n:on(nil) n:tack(m)\n"
        "local e = n:events() print(#e, e[1].kind, e[1].mass) print(#n:events())",
        "true\tclank 1 52\n1\tclick\t1\n0\n");
    fails(
        "local n = spring.network() n:mass{y = 0.01, vy = -5} n:on(function() error('no') end) "
        "n:step(9)",
        "no");
}

static void words_are_made_of_letters(void **state)
{
    (void)state;
    prints("local w = spring.word{text = 'wet ink', preset = 'stiff', side = 1234, gravity = "
           "3, y = "
           "2}\n"
           "print(w:letters(), w:masses(), w:springs(), w:letter(2))\n"
           "print(w:get('gravity'), w:word{text = 'on', x = 9, y = 2}, w:letters())\n"
           "local m = w:mask{scale = 20, x = 5, y = 60} local x, y, wide, high = m:bounds()\n"
           "print(x >= 0 and x < 12, wide > 180 and wide < 250, high > 10 and high < 30)\n"
           "w:step(240) local _, y2 = w:mask{scale = 20, x = 5, y = 60}:bounds() print(y2 > y)",
           "6\t24\t56\t5\t6\t7\t8\n3.0\t2\t8\ntrue\ttrue\ttrue\ntrue\n");
}

/* As those of `lutetia spring`: short words have weaker links, unless a script says its own. */
static void short_words_break(void **state)
{
    (void)state;
    prints(
        "for _, text in ipairs{'cry', 'iii', 'word', 'hello', 'breakdown'} do\n"
        "  for _, link in ipairs{0, 210} do\n"
        "    local w = spring.word{text = text, preset = 'breakdown', y = 2, link = link > 0 "
        "and link or nil}\n"
        "    local broken = 0 w:collide(true)\n"
        "    w:on(function(e) if e.kind == 'snap' then broken = broken + 1 end end)\n"
        "    w:step(1200) print(text, link, broken > 0)\n"
        "  end\nend",
        "cry\t0\ttrue\ncry\t210\tfalse\niii\t0\ttrue\niii\t210\tfalse\nword\t0\ttrue\n"
        "word\t210\tfalse\nhello\t0\ttrue\nhello\t210\tfalse\nbreakdown\t0\ttrue\n"
        "breakdown\t210\ttrue\n");
}

static void masses_are_led_along_keys(void **state)
{
    (void)state;
    prints("local n = spring.network() n:set('gravity', 0) n:set('drag', 0) local m = n:mass{y "
           "= 1}\n"
           "n:key(m, 0, 0, 1) n:key(m, 1, 2, 3) n:key(m, 2, 4, 5) n:free(m, 2.01)\n"
           "n:step(240) print(('%.9f %.9f'):format(n:place(m)))\n"
           "n:step(240 * 2) local x, y, vx = n:place(m) print(vx, x > 5.9)",
           "2.000000000 3.000000000\n2.0\ttrue\n");
    fails("spring.network():keys('none.clamps')", "cannot be read");
}

static void networks_are_saved_and_read(void **state)
{
    (void)state;
    prints("local w = spring.word{text = 'a', y = 2} w:step(30) w:save('a.springs')\n"
           "local n = spring.network('a.springs') w:step(60) n:step(60)\n"
           "local x, y = w:place(1) local x2, y2 = n:place(1) print(x == x2, y == y2)",
           "true\ttrue\n");
    fails("spring.network('../a.springs')", "network");
    fails("spring.word{text = 'a'}:save('a.txt')", ".springs");
}

static void what_cannot_be_is_one_line(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"spring.word{text = '  '}", "has ink"},
        {"spring.word{}", "word text must be a text"},
        {"spring.word{text = 'a', sise = 2}", "word has no 'sise'"},
        {"spring.word{text = 'a', side = -1}", "side must be 0..1e+06 kg/s2 (got -1)"},
        {"spring.word{text = 'a', preset = 'soup'}",
         "there is no preset 'soup'; there are stiff"},
        {"spring.word{text = 'a', tack = 'all'}", "one of none first ends top bottom"},
        {"spring.word{text = 'a', font = '/etc/passwd'}", "must be a font's name"},
        {"spring.word{text = 'a', path = {{1, 2}}}", "word path must be 2..10000 points"},
        {"spring.network():set('gravy', 1)", "there is no control 'gravy'; there are gravity"},
        {"spring.network():place(1)", "a mass's number must be given, and there is none yet"},
        {"local n = spring.network() n:mass{} n:place()",
         "a mass's number must be given: 1..1"},
        {"local n = spring.network() n:mass{} n:tack()", "a mass's number must be given: 1..1"},
        {"local n = spring.network() n:ends()",
         "a spring's number must be given, and there is none"},
        {"spring.word{text = 'ab'}:letter()", "a letter's number must be given: 1..2"},
        {"spring.word{text = 'ab'}:letter(3)",
         "a letter's number must be a whole number in 1..2"},
        {"spring.word{text = 'ab'}:hang(1)", "a word's number must be given: 1..1"},
        {"spring.network():step(-1)", "the count of steps must be a whole number"},
        {"local n = spring.network() n:mass{mass = 0}", "mass must be 1e-06..1e+06 kg (got 0)"},
        {"local n = spring.network() local a = n:mass{} n:spring(a, a)",
         "a spring cannot go from mass 1 to itself"},
        {"local n = spring.network() for i = 1, 1e9 do n:mass{} end", "memory"},
        {"spring.network():machine()", "needs masses and springs"},
        {"spring.word{text = 'ab'}:machine(-1)", "the count of steps must be a whole number"},
        {"spring.word{text = 'ab'}:machine(1, 0 / 0)", "a step's seconds must be"},
        {"local w = spring.word{text = 'ab'} w:collide(true) w:machine()", "n:step() does"},
        {"local w = spring.word{text = 'ab'} w:key(1, 1, 0, 0) w:machine()", "n:step() does"},
        {"local w = spring.word{text = 'ab'} w:pull(1, 1, 1) w:machine()",
         "no hands that pull"},
        {"local w = spring.word{text = 'ab'} w:set('integrator', 'thesis') w:machine()",
         "symplectic steps only"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        fails(bad[i][0], bad[i][1]);
}

/* A word's letters, as they are placed, are screened into a sheet: there is ink where the mask
 * is. */
static void words_wet_a_paper(void **state)
{
    (void)state;
    prints(
        "local w = spring.word{text = 'II', y = 0, box = 'ink'}\n"
        "local p = paper{width = 64, height = 48, pigments = {'cyan'}, model = {'infused'}}\n"
        "p:put(w:mask{scale = 40, x = 8, y = 40}, {water = 0.5}) print(p:total('water') > 20)\n"
        "w:set_mass(nil, 'vx', 1000) w:step(240)\n"
        "p:put(w:mask{scale = 40, x = 8, y = 40}, {water = 0.5}) print(p:total('water') < 200)",
        "true\ntrue\n");
}

/* A cloth, stepped by both; the paper between is what it is without the machine's steps. */
static void the_machine_steps_as_c_does(void **state)
{
    (void)state;
    prints(
        "local side = 12\n"
        "local function cloth()\n"
        "  local n = spring.network() n:set('floor_on', true) n:set('floor', -2)\n"
        "  for y = 1, side do for x = 1, side do\n"
        "    n:mass{x = x + 0.1 * math.sin(7 * y), y = y, stuck = y == side} end end\n"
        "  for i = 1, side * side do\n"
        "    if i % side ~= 0 then n:spring(i, i + 1, {constant = 300 + i}) end\n"
        "    if i <= side * (side - 1) then n:spring(i, i + side, {constant = 400}) end end\n"
        "  return n end\n"
        "local function sheet()\n"
        "  local p = paper{width = 24, height = 16, pigments = {'cyan'}, seed = 3}\n"
        "  p:put(circle(9, 8, 5), {water = 0.8, cyan = 0.5}) p:step(3) return p end\n"
        "local a, b, moved, worst = cloth(), cloth(), 0, 0\n"
        "local p, q = sheet(), sheet()\n"
        "a:step(90) p:step(4) q:step(2) b:machine(50) q:step(2) b:machine(40, 1 / 240)\n"
        "for i = 1, side * side do\n"
        "  local x, y = a:place(i) local u, v = b:place(i) local s, t = cloth():place(i)\n"
        "  worst = math.max(worst, math.abs(x - u), math.abs(y - v))\n"
        "  moved = math.max(moved, math.abs(y - t)) end\n"
        "local same = true\n"
        "for y = 0, 15 do for x = 0, 23 do\n"
        "  same = same and p:at('infused water', x, y) == q:at('infused water', x, y) end end\n"
        "print(worst < 1e-9, moved > 0.1, a:time() == b:time(), same)",
        "true\ttrue\ttrue\ttrue\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masses_fall_and_springs_hold),
        cmocka_unit_test(events_are_told_and_listed),
        cmocka_unit_test(words_are_made_of_letters),
        cmocka_unit_test(short_words_break),
        cmocka_unit_test(masses_are_led_along_keys),
        cmocka_unit_test(networks_are_saved_and_read),
        cmocka_unit_test(what_cannot_be_is_one_line),
        cmocka_unit_test(words_wet_a_paper),
        cmocka_unit_test(the_machine_steps_as_c_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
