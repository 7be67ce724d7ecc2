/* test_script.c - the library of scripts as a program uses it: the calls that its host gets,
 * and the papers at the end. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <history.h>

#include <unistd.h>

#include "scripted.h"

#define SMALL "{width = 16, height = 12, pigments = {'cyan'}, model = {'infused'}}"

static void prints_and_errors_go_to_the_host(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(scripted_run(&s, "print('a', 1.5, nil) print()"), SCRIPT_OK);
    assert_string_equal(s.prints, "a\t1.5\tnil\n\n");
    assert_string_equal(s.errors, "");
    assert_int_equal(scripted_run(&s, "print(1)\nerror('no\\n\\27[2Jmore\\xc2\\x9b')"),
                     SCRIPT_FAILED);
    assert_string_equal(s.prints, "1\n");
    assert_non_null(strstr(s.errors, "script.lua:2: no ?[2Jmore??\n"));
    assert_int_equal(scripted_run(&s, "error({})"), SCRIPT_FAILED);
    assert_string_equal(s.errors, "error: (a table)\n");
}

static void a_host_without_functions_is_one(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    scripted_run(&s, "local p = paper" SMALL
                     " p:step(1) print(p:total('water')) p:film{} expect(3) "
                     "p:wash{water = 1} p:step(2) p:undo(2) p:total('water')");
    assert_string_equal(s.errors, "");
    const struct script_host nobody = {.print = NULL};
    assert_int_equal(script_run(&s.config, &nobody), SCRIPT_OK);
    s.config.path = "/no such script.lua";
    assert_int_equal(script_run(&s.config, &nobody), SCRIPT_FAILED);
}

static void words_are_read_and_must_be_asked_for(void **state)
{
    (void)state;
    const char *const words[] = {"a=1", "b=x", "a=2"};
    struct scripted s = {.config = scripted_config()};
    s.config.words = words;
    s.config.words_count = 3;
    assert_int_equal(scripted_run(&s, "print(param('a', 0) + 1, param('b'), param('c', 7))"),
                     SCRIPT_OK);
    assert_string_equal(s.prints, "3\tx\t7\n");
    assert_int_equal(scripted_run(&s, "print(param('a', 0))"), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "asked for no 'b'"));
    s.config.words_count = SCRIPT_WORDS_MAX + 1;
    assert_int_equal(scripted_run(&s, ""), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "up to 64"));
}

/* A word that is typed without options stands in the middle and is four fifths as wide as the
 * sheet. */
static void type_needs_no_options(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    scripted_run(
        &s, "local p = paper{width = 120, height = 90} p:type('oo')\n"
            "local left, right, top, bottom = 999, -1, 999, -1\n"
            "for y = 0, 89 do for x = 0, 119 do\n"
            "  if p:at('surface pigment', x, y, 'french ultramarine') > 0.5 then\n"
            "    left, right = math.min(left, x), math.max(right, x)\n"
            "    top, bottom = math.min(top, y), math.max(bottom, y)\n"
            "  end\n"
            "end end\n"
            "assert(math.abs(left + right - 119) <= 1 and math.abs(top + bottom - 89) <= 1)\n"
            "assert(math.abs(right - left + 1 - 96) <= 2, right - left)\n"
            "local most = p:at('surface water', left + 4, 45)\n"
            "assert(p:total('water') > 0 and most <= 0.9)\n"
            "p:step(2) assert(p:total('water') > 0)");
    assert_string_equal(s.errors, "");
    scripted_run(&s, "paper{width = 40, height = 30, pigments = {}}:type('o')");
    assert_non_null(strstr(s.errors, "without pigments needs amounts"));
}

/* Each script ends with an error that contains its text. */
static void wrong_names_and_numbers_are_answered(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"rect(1, 1, 4, 4):turn(3)",
         "mask has no 'turn'; it has bounds, move, rotate, scale, soften"},
        {"p:paint()", "paper has no 'paint'; it has again, air, at, blot, brush, close"},
        {"p:put(rect(1, 1, 4, 4), {blue = 1})",
         "no pigment 'blue'; it takes water, cyan, yellow"},
        {"paper{stock = 'canvas'}", "no paper stock 'canvas'; there are cold press, hot press"},
        {"paper{pigments = {'blue'}}", "no pigment 'blue'; there are quinacridone rose, "},
        {"p:frame('a.png', {size = 2})", "frame has no 'size'; it has show, layer"},
        {"p:frame('a.png', {scale = 3})", "frame scale must be 1, 2 or 4 pixels a fiber"},
        {"p:air{gravity = 1}", "air gravity must be {right, down}, or 0 for none (got 1)"},
        {"p:put(rect(1, 1, 4, 4) * -1, {cyan = 1})", "a mask's factor must be 0..255"},
        {"p:put(2 - rect(1, 1, 4, 4), {cyan = 1})", "what a mask is shifted by must be -1..1"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[256];
        struct scripted s = {.config = scripted_config()};
        snprintf(text, sizeof text,
                 "local p = paper{width = 16, height = 16, pigments = {'cyan', 'yellow'}}\n%s",
                 wrong[i][0]);
        assert_int_equal(scripted_run(&s, text), SCRIPT_FAILED);
        if (!strstr(s.errors, wrong[i][1]))
            fail_msg("%s: %s", wrong[i][0], s.errors);
    }
}

static void values_and_type_beyond_are_said(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(scripted_run(&s, "local p = paper{width = 40, height = 30}\n"
                                      "p:type('o', {size = 20, x = 5, y = 20}, {water = 0.5})\n"
                                      "mask(2, 2, function(x, y) return x end)"),
                     SCRIPT_OK);
    assert_string_equal(s.notes, "");
    assert_int_equal(scripted_run(&s,
                                  "local p = paper{width = 40, height = 30}\n"
                                  "p:type('o', {size = 20, x = 50, y = 20}, {water = 0.5})\n"
                                  "p:type('o', {size = 20, x = 36, y = 20}, {water = 0.5})\n"
                                  "mask(4, 4, function(x, y) return x end)"),
                     SCRIPT_OK);
    assert_non_null(strstr(s.notes, "script.lua:2: type: all of it is off the paper"));
    assert_non_null(strstr(s.notes, "script.lua:3: type: some of it is off the paper"));
    assert_non_null(
        strstr(s.notes, "script.lua:4: mask: 8 of its 16 values were not within 0..1"));
}

/* Paint that goes nowhere is said once, and only then. */
static void paint_that_goes_nowhere_is_said(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(scripted_run(&s, "local p = paper{width = 40, height = 30}\n"
                                      "p:put(rect(35, 25, 20, 20), {water = 1})\n"
                                      "p:put(ellipse(0, 0, 5), {water = 1})\n"
                                      "local b = p:brush{width = 5}\n"
                                      "b:dip{water = 1}\n"
                                      "p:stroke{brush = b, points = {{10, 10}, {20, 20}}}\n"
                                      "local c = p:brush{width = 5}\n"
                                      "c:rinse()\n"
                                      "p:stroke{brush = c, points = {{10, 10}, {20, 20}}}\n"),
                     SCRIPT_OK);
    assert_string_equal(s.notes, "");
    assert_int_equal(scripted_run(&s, "local p = paper{width = 40, height = 30}\n"
                                      "p:put(rect(40, 0, 20, 20), {water = 1})\n"
                                      "local b = p:brush{width = 5}\n"
                                      "p:stroke{brush = b, points = {{10, 10}, {20, 20}}}\n"
                                      "b:dip{water = 0}\n"
                                      "p:blot(ellipse(100, 100, 5), 1)\n"),
                     SCRIPT_OK);
    assert_non_null(strstr(s.notes, "script.lua:2: this mask lies off the paper"));
    assert_non_null(strstr(s.notes, "script.lua:4: stroke: this brush is dry"));
    assert_non_null(strstr(s.notes, "script.lua:5: dip: the brush takes nothing"));
    assert_null(strstr(s.notes, "script.lua:6"));
}

static void a_circle_is_a_round_ellipse(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(
        scripted_run(
            &s, "local p, q = paper{width = 24, height = 20}, paper{width = 24, height = 20}\n"
                "p:layer('resist', circle(11.3, 9.2, 6.5))\n"
                "q:layer('resist', ellipse(11.3, 9.2, 6.5, 6.5))\n"
                "local inside = 0\n"
                "for y = 0, 19 do for x = 0, 23 do\n"
                "  local v = p:at('resist', x, y)\n"
                "  assert(v == q:at('resist', x, y))\n"
                "  inside = inside + v\n"
                "end end\n"
                "assert(math.abs(inside - math.pi * 6.5 ^ 2) < 2)\n"),
        SCRIPT_OK);
    assert_int_equal(scripted_run(&s, "circle(3, 4)"), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "circle's radius"));
}

/* A layer reads back the values of masks, which are n / 255. */
static void masks_are_scaled_and_shifted_in_value(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(
        scripted_run(
            &s, "local p = paper{width = 40, height = 40}\n"
                "local function tell(m)\n"
                "  p:layer('red', m)\n"
                "  print(string.format('%.0f %.0f', 255 * p:at('red', 15, 15),"
                " 255 * p:at('red', 35, 35)))\n"
                "end\n"
                "local m = rect(10, 10, 10, 10)\n"
                "tell(m * 0.5) tell(0.5 * m) tell(1 - m) tell(m + 0.2) tell(0.2 + m)\n"
                "tell(m - 0.4) tell(m * 2) tell(1 - rect(0, 0, 0, 0))\n"
                "tell((1 - m) * rect(30, 30, 10, 10)) tell((1 - m) + m) tell(m - (1 - m))\n"
                "tell((1 - m):move(20, 20)) tell((1 - m):soften(2)) tell((1 - m):rotate(30))"),
        SCRIPT_OK);
    assert_string_equal(s.prints, "128 0\n128 0\n0 255\n255 51\n255 51\n"
                                  "153 0\n255 0\n255 255\n"
                                  "0 255\n255 255\n255 0\n"
                                  "255 0\n0 255\n255 255\n");
}

static void the_history_tells_what_was_put(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    assert_int_equal(
        scripted_run(&s, "local p = paper{width = 24, height = 16, pigments = {'cyan'}}\n"
                         "p:put(rect(2, 3, 4, 5), {water = 0.5, cyan = 0.25})\n"
                         "p:wash{cyan = 1}\n"
                         "p:dry()\n"
                         "for _, m in ipairs(p:moments()) do\n"
                         "  print(m.what, m.put and m.put.water, m.put and m.put.cyan, m.x,"
                         " m.y, m.width, m.height)\n"
                         "end"),
        SCRIPT_OK);
    assert_string_equal(s.prints, "put\t0.5\t0.25\t2\t3\t4\t5\n"
                                  "put\tnil\t1.0\t0\t0\t24\t16\n"
                                  "dry\tnil\tnil\tnil\tnil\tnil\tnil\n");
}

static void what_the_state_takes_is_limited(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    s.config.memory_bytes = 100;
    assert_int_equal(scripted_run(&s, "print(1)"), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "no memory for Lua"));
    for (s.config.memory_bytes = 1000; s.config.memory_bytes < 100000;
         s.config.memory_bytes += 977) {
        s.errors[0] = '\0';
        if (scripted_run(&s, "print(1)") == SCRIPT_OK)
            break;
        if (!strstr(s.errors, "memory"))
            fail_msg("with %zu bytes it said: %s", s.config.memory_bytes, s.errors);
    }
    assert_string_equal(s.prints, "1\n");
    s.config.memory_bytes = 1 << 20;
    assert_int_equal(scripted_run(&s, "string.rep('x', 1 << 21)"), SCRIPT_FAILED);
    assert_int_equal(scripted_run(&s, "mask(1025, 1025, print)"), SCRIPT_FAILED);
    assert_non_null(strstr(s.errors, "not enough memory: 1 MB for a mask"));
    /* masks that are no longer referenced are freed: one after the other they need far more
     * than the limit */
    assert_int_equal(scripted_run(&s, "for i = 1, 200 do rect(0, 0, 300, 300):soften(1) end"),
                     SCRIPT_OK);
}

/* ---- progress, steps, films ---- */

struct seen {
    struct scripted s;
    struct script_progress last;
    int begun, ended, again, papers[8], papers_count, stop_after;
    struct script_camera camera;
    int asked;
};

static void progress(void *context, const struct script_progress *p)
{
    struct seen *seen = context;
    if (!p) {
        seen->ended++;
        return;
    }
    seen->begun += p->done == 1;
    seen->again += p->again;
    seen->last = *p;
}

static const char *step(void *context, int paper, struct paper_sheet *sheet)
{
    struct seen *seen = context;
    if (paper_sheet_get_config(sheet)->width != 16)
        return "another sheet";
    if (seen->papers_count < 8)
        seen->papers[seen->papers_count] = paper;
    return ++seen->papers_count == seen->stop_after ? "enough of it" : NULL;
}

static void film(void *context, const struct script_camera *camera)
{
    ((struct seen *)context)->camera = *camera;
}

static bool end_asked(void *context)
{
    return ((struct seen *)context)->asked++ > 20;
}

static void the_host_sees_each_step(void **state)
{
    (void)state;
    struct seen seen = {.s = {.config = scripted_config(),
                              .host = {.progress = progress, .step = step, .film = film}}};
    assert_int_equal(
        scripted_run(&seen.s, "expect(5) local p, q = paper" SMALL ", paper" SMALL
                              " q:step(2) p:step(3) q:film{show = 'wet', x = 2, width = 9}"),
        SCRIPT_OK);
    const int papers[] = {1, 2, 2, 2, 1, 1, 1};
    assert_int_equal(seen.papers_count, 7);
    assert_memory_equal(seen.papers, papers, sizeof papers);
    assert_int_equal(seen.last.done, 5);
    assert_int_equal(seen.last.total, 5);
    assert_int_equal(seen.ended, 2);
    assert_int_equal(seen.camera.paper, 2);
    assert_int_equal(seen.camera.show, PAPER_SHOW_WET);
    assert_true(seen.camera.x == 2 && seen.camera.y == 0 && seen.camera.width == 9 &&
                seen.camera.height == 12);
    /* the host's error stops the script at that line */
    seen.papers_count = 0;
    seen.stop_after = 3;
    assert_int_equal(scripted_run(&seen.s, "local p = paper" SMALL "\np:step(9)"),
                     SCRIPT_FAILED);
    assert_non_null(strstr(seen.s.errors, "script.lua:2: enough of it"));
    assert_int_equal(seen.papers_count, 3);
}

static void what_is_computed_again_is_told_apart(void **state)
{
    (void)state;
    struct seen seen = {.s = {.config = scripted_config(), .host = {.progress = progress}}};
    assert_int_equal(scripted_run(&seen.s, "local p = paper" SMALL
                                           " p:wash{water = 0.5} p:step(4) p:to(2) "
                                           "p:total('water')"),
                     SCRIPT_OK);
    assert_true(seen.again > 0);
    assert_true(seen.last.again);
}

static void the_host_can_stop_it(void **state)
{
    (void)state;
    struct seen seen = {.s = {.config = scripted_config(), .host = {.interrupted = end_asked}}};
    assert_int_equal(scripted_run(&seen.s, "while true do end"), SCRIPT_INTERRUPTED);
    assert_non_null(strstr(seen.s.errors, "script.lua:1: interrupted"));
    seen.asked = 0;
    assert_int_equal(scripted_run(&seen.s, "paper" SMALL ":step(100000)"), SCRIPT_INTERRUPTED);
    seen.asked = 0;
    assert_int_equal(scripted_run(&seen.s, "while true do pcall(error) end"),
                     SCRIPT_INTERRUPTED);
}

/* ---- the end ---- */

struct ending {
    struct scripted s;
    int numbers[70], count;
    double water;
    enum script_status status, answer;
    bool answers;
};

static enum script_status finish(void *context, const struct paper_state_sheet *papers,
                                 int count, enum script_status status)
{
    struct ending *end = context;
    end->status = status;
    end->count = count;
    for (int i = 0; i < count && i < 70; i++)
        end->numbers[i] = papers[i].number;
    if (count > 0)
        assert_int_equal(paper_sheet_total(papers[0].sheet, 0, &end->water), PAPER_OK);
    if (count > 0 && paper_history_has(papers[0].sheet))
        assert_int_equal(paper_state_save(scratch_path("end.h5"), papers, count), PAPER_OK);
    return end->answers ? end->answer : status;
}

static void the_end_has_all_open_papers(void **state)
{
    (void)state;
    struct ending end = {.s = {.config = scripted_config(), .host = {.finish = finish}}};
    assert_int_equal(scripted_run(&end.s,
                                  "P, Q, R = paper" SMALL ", paper" SMALL ", paper" SMALL
                                  " P:wash{water = 0.5} Q:close() S = P:render(1)"),
                     SCRIPT_OK);
    const int numbers[] = {1, 3, 4};
    assert_int_equal(end.count, 3);
    assert_memory_equal(end.numbers, numbers, sizeof numbers);
    assert_int_equal(end.status, SCRIPT_OK);
    assert_true(end.water > 0);
    /* finish() is called after a failure, too, and its status is the run's */
    assert_int_equal(scripted_run(&end.s, "P = paper" SMALL " error('x')"), SCRIPT_FAILED);
    assert_int_equal(end.status, SCRIPT_FAILED);
    assert_int_equal(end.count, 1);
    end.answers = true;
    end.answer = SCRIPT_FAILED;
    assert_int_equal(scripted_run(&end.s, "P = paper" SMALL), SCRIPT_FAILED);
    assert_string_equal(end.s.errors, "");
}

/* The time limit stops an endless loop; the open papers are saved and can be resumed. */
static void papers_without_end_are_saved(void **state)
{
    (void)state;
    struct ending end = {.s = {.config = scripted_config(), .host = {.finish = finish}}};
    end.s.config.timeout_s = 1.5;
    end.s.config.papers_max = PAPER_STATE_SHEETS_MAX;
    assert_int_equal(scripted_run(&end.s,
                                  "local first = paper" SMALL " first:wash{water = 0.25}\n"
                                  "while true do paper" SMALL " end"),
                     SCRIPT_FAILED);
    assert_non_null(strstr(end.s.errors, "stopped after 1.5 seconds"));
    assert_in_range(end.count, 1, PAPER_STATE_SHEETS_MAX);
    assert_int_equal(end.numbers[0], 1);
    struct scripted next = {.config = scripted_config()};
    assert_int_equal(paper_state_open(scratch_path("end.h5"), &next.config.resumed), PAPER_OK);
    assert_int_equal(
        scripted_run(&next, "local p = paper" SMALL
                            " p:wash{water = 0.25} print(('%.17g'):format(p:total('water')))"),
        SCRIPT_OK);
    paper_state_close(next.config.resumed);
    assert_string_equal(next.notes, "");
    char water[40];
    snprintf(water, sizeof water, "%.17g\n", end.water);
    assert_string_equal(next.prints, water);
    /* a script cannot hold more papers than can be saved */
    end.s.config.timeout_s = 60;
    assert_int_equal(scripted_run(&end.s, "t = {} for i = 1, 65 do t[i] = paper" SMALL " end"),
                     SCRIPT_FAILED);
    assert_non_null(strstr(end.s.errors, "up to 64 papers"));
    assert_int_equal(end.count, 64);
}

static bool said_so(void *context)
{
    return ((struct ending *)context)->s.prints[0] != '\0';
}

/* A stroke asks between its steps whether to stop, but not when it is computed for the end. */
static void what_was_stopped_is_computed_for_the_end(void **state)
{
    (void)state;
    struct ending end = {
        .s = {.config = scripted_config(), .host = {.finish = finish, .interrupted = said_so}}};
    assert_int_equal(
        scripted_run(
            &end.s,
            "P = paper" SMALL " local b = P:brush{width = 4, bristles = 8} b:dip{water = 1} "
            "P:stroke{brush = b, pace = 20, points = {{2, 2}, {14, 9}}, seconds = 0.2} "
            "P:at(0, function() P:wash{water = 0.5} end) print('stop') while true do end"),
        SCRIPT_INTERRUPTED);
    assert_int_equal(end.count, 1);
    assert_true(end.water > 0.5 * 16 * 12);
}

/* ---- a script within a script ---- */

static void nested(void *context, const char *text, size_t length)
{
    struct scripted *outer = context, inner = {.config = scripted_config()};
    (void)text;
    (void)length;
    inner.config.memory_bytes = 8 << 20;
    assert_int_equal(scripted_run(&inner, "local p = paper" SMALL " p:wash{water = 1} "
                                          "print(p:total('water')) error('inner')"),
                     SCRIPT_FAILED);
    scripted_append(outer->prints, inner.prints, strlen(inner.prints));
    inner.config.timeout_s = 0.05;
    assert_int_equal(scripted_run(&inner, "while true do end"), SCRIPT_FAILED);
    assert_non_null(strstr(inner.errors, "stopped after 0.05"));
}

/* Two runs share nothing: not the clock, not memory, not papers. */
static void nothing_is_shared_between_runs(void **state)
{
    (void)state;
    struct scripted s = {.config = scripted_config()};
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_path("outer.lua"));
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("local p = paper" SMALL " p:put(rect(0, 0, 4, 4), {water = 1}) print() p:dry() "
          "p:put(rect(0, 0, 2, 2), {water = 1}) if p:total('water') > 4.1 then error() end",
          file);
    assert_int_equal(fclose(file), 0);
    s.config.path = path;
    s.host = (struct script_host){.context = &s, .print = nested, .error = scripted_error};
    int status = (int)script_run(&s.config, &s.host);
    assert_string_equal(s.errors, "");
    assert_int_equal(status, SCRIPT_OK);
    assert_string_equal(s.prints, "192.0\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prints_and_errors_go_to_the_host),
        cmocka_unit_test(a_host_without_functions_is_one),
        cmocka_unit_test(words_are_read_and_must_be_asked_for),
        cmocka_unit_test(type_needs_no_options),
        cmocka_unit_test(wrong_names_and_numbers_are_answered),
        cmocka_unit_test(values_and_type_beyond_are_said),
        cmocka_unit_test(paint_that_goes_nowhere_is_said),
        cmocka_unit_test(a_circle_is_a_round_ellipse),
        cmocka_unit_test(masks_are_scaled_and_shifted_in_value),
        cmocka_unit_test(the_history_tells_what_was_put),
        cmocka_unit_test(what_the_state_takes_is_limited),
        cmocka_unit_test(the_host_sees_each_step),
        cmocka_unit_test(what_is_computed_again_is_told_apart),
        cmocka_unit_test(the_host_can_stop_it),
        cmocka_unit_test(the_end_has_all_open_papers),
        cmocka_unit_test(what_was_stopped_is_computed_for_the_end),
        cmocka_unit_test(papers_without_end_are_saved),
        cmocka_unit_test(nothing_is_shared_between_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
