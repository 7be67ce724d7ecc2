/* test_run.c - `lutetia run` as a user runs it: the files that scripts make, and one clear line
 * for what they may not or cannot do. (security.md 1, 3, 4) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "../display/scratch.h"
#include "child.h"

static const char *lutetia;

/* Wrong scripts and the text of their one line; it contains the script's line number where that
 * is not 0. */
static const struct {
    const char *script, *says;
    int line;
    const char *option, *value;
} wrongs[] = {
    {"paper{width=-3}", "paper width must be 8..16384 (got -3)", 1, NULL, NULL},
    {"\n\npaper{width=1e300}", "paper width must be 8..16384 (got 1e+300)", 3, NULL, NULL},
    {"paper{width=20.5}", "got 20.5", 1, NULL, NULL},
    {"paper{widht=20}", "paper has no 'widht'", 1, NULL, NULL},
    {"paper{height='tall'}", "got 'tall'", 1, NULL, NULL},
    {"paper{stock='papyrus'}", "papyrus", 1, NULL, NULL},
    {"paper{pigments={'soot'}}", "no pigment 'soot'", 1, NULL, NULL},
    {"paper{pigments={'cyan','cyan'}}", "two pigments", 1, NULL, NULL},
    {"paper{pigments={{white='#ffffff', black='#000000'}}}", "over black", 1, NULL, NULL},
    {"paper{pigments={{weight=7}}}", "pigment weight must be 0..1 (got 7)", 1, NULL, NULL},
    {"paper{color='red'}", "#rrggbb", 1, NULL, NULL},
    {"paper{model={'steam'}}", "one of infused, surface, fixing, edge", 1, NULL, NULL},
    {"paper{rule=3}", "must be a text", 1, NULL, NULL},
    {"paper{pigments={'cyan'}, seed=0/0}", "seed", 1, NULL, NULL},
    {"rect(0, 0, 0/0, 1)", "rect's width must be 0..100000", 1, NULL, NULL},
    {"polygon{{1, 2}, {3, 4}}", "3..20000 corners (got 2)", 1, NULL, NULL},
    {"polygon{{1, 2}, {3, 4}, 5}", "corner 3", 1, NULL, NULL},
    {"text('a', {size=0})", "text size must be 1..8192 (got 0)", 1, NULL, NULL},
    {"text('a', {font='/etc/passwd'})", "font's name", 1, NULL, NULL},
    {"text('\\xff')", "UTF-8", 1, NULL, NULL},
    {"text('a', {font='no such font at all'})", "no such font", 1, NULL, NULL},
    {"text('a', {filter='soft'})", "there is no filter", 1, NULL, NULL},
    {"text('a', {width=-5})", "text width must be", 1, NULL, NULL},
    {"text('a', {align='middle'})", "justify", 1, NULL, NULL},
    {"text('a', {features='='})", "there is no feature", 1, NULL, NULL},
    {"typeface()", "string expected", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {size=0})", "typeface size must be 0.5..400 (got 0)", 1, NULL,
     NULL},
    {"typeface('DejaVuSansMono', {size=0/0})", "typeface size must be 0.5..400", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {size=1e9})", "(got 1e+09)", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {sise=9})", "typeface has no 'sise'", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {filter='soft'})", "there is no filter", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {axes='wght=700'})", "has no axis", 1, NULL, NULL},
    {"typeface('no such font at all')", "no such font", 1, NULL, NULL},
    {"typeface('/etc/passwd')", "font's name", 1, NULL, NULL},
    {"typeface('DejaVuSansMono', {size=400})", "not enough memory", 1, "--memory", "150"},
    {"paper{}:type('a', {size=12}, {soot=1})", "no pigment 'soot'", 1, NULL, NULL},
    {"paper{}:type('a', {sise=12}, {water=1})", "text has no 'sise'", 1, NULL, NULL},
    {"paper{width=8, height=8}:step(1.5)",
     "step's count must be a whole number in 0..1000000 (got 1.5)", 1, NULL, NULL},
    {"paper{width=8, height=8}:undo(-1)", "undo's count", 1, NULL, NULL},
    {"paper{width=8, height=8}:to(0/0)", "a time must be a whole number", 1, NULL, NULL},
    {"image('/etc/passwd')", "folder given", 1, NULL, NULL},
    {"image('../x.png')", "folder given", 1, NULL, NULL},
    {"image('none.png')", "none.png", 1, NULL, NULL},
    {"image('a\\0b')", "", 1, NULL, NULL},
    {"mask(10, 10, 5)", "function", 1, NULL, NULL},
    {"mask(100000, 100000, print)", "memory", 1, NULL, NULL},
    {"local x = nil + 1", "arithmetic", 1, NULL, NULL},
    {"error({})", "a table", 0, NULL, NULL},
    {"local = 3", "<name> expected", 1, NULL, NULL},
    {"\x1bLua", "attempt to load a binary chunk", 0, NULL, NULL},
    {"print(io.open('/etc/passwd'))", "'io'", 1, NULL, NULL},
    {"os.execute('true')", "'os'", 1, NULL, NULL},
    {"require('io')", "'require'", 1, NULL, NULL},
    {"load('return 1')()", "'load'", 1, NULL, NULL},
    {"debug.getregistry()", "'debug'", 1, NULL, NULL},
    {"getmetatable(rect(0, 0, 1, 1)).__gc()", "boolean", 1, NULL, NULL},
    {"local f = string.dump(print)", "'dump'", 1, NULL, NULL},
    {"while true do end", "stopped after 0.3 seconds", 1, "--timeout", "0.3"},
    {"while true do pcall(function() while true do end end) end", "stopped after", 1,
     "--timeout", "0.3"},
    {"local co = coroutine.wrap(function() while true do end end) co()", "stopped after", 1,
     "--timeout", "0.3"},
    {"mask(5000, 5000, function() return 1 end)", "stopped after", 1, "--timeout", "0.3"},
    {"local s = string.rep('x', 1 << 26)", "not enough memory", 0, "--memory", "30"},
    {"local t = {} while true do t[#t + 1] = string.rep('x', 9999) .. #t end",
     "not enough memory", 0, "--memory", "30"},
    {"local t = {} while true do t[#t + 1] = mask(900, 900, function() return 1 end) end",
     "memory", 1, "--memory", "3"},
    {"paper{width=16384, height=16384}", "memory", 1, "--memory", "100"},
    {"local function f() return f() + 1 end f()", "stack overflow", 1, NULL, NULL},
    {"string.rep('a', 99):find(string.rep('a-', 99) .. 'b')", "did not stop", 0, "--timeout",
     "0.1"},
};

static void script_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void wrong_scripts_get_one_line(void **state)
{
    (void)state;
    static struct child child;
    char path[512], folder[512], place[600];
    snprintf(path, sizeof path, "%s", scratch_path("wrong.lua"));
    snprintf(folder, sizeof folder, "%s", scratch_path("out"));
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        script_write(path, wrongs[i].script);
        memset(&child, 0, sizeof child);
        const char *arguments[] = {lutetia,          "run",          path, "-o", folder,
                                   wrongs[i].option, wrongs[i].value};
        memcpy(child.arguments, arguments, sizeof arguments);
        child_run(&child);
        if (child.status != 1)
            fail_msg("%s: status %d: %s", wrongs[i].script, child.status, child.errors);
        if (!strstr(child.errors, wrongs[i].says))
            fail_msg("%s: it said: %s", wrongs[i].script, child.errors);
        char *end = strchr(child.errors, '\n');
        if (!end || end[1])
            fail_msg("%s: not one line: %s", wrongs[i].script, child.errors);
        snprintf(place, sizeof place, "%s:%d: ", path, wrongs[i].line);
        if (wrongs[i].line && strncmp(child.errors, place, strlen(place)) != 0)
            fail_msg("%s: line %d is not named: %s", wrongs[i].script, wrongs[i].line,
                     child.errors);
    }
}

static void child_script(struct child *child, const char *path, const char *const *more)
{
    memset(child, 0, sizeof *child);
    int count = 0;
    child->arguments[count++] = lutetia;
    child->arguments[count++] = "run";
    child->arguments[count++] = path;
    for (int i = 0; more[i]; i++)
        child->arguments[count++] = more[i];
}

static void a_script_makes_its_pictures(void **state)
{
    (void)state;
    static struct child child;
    char path[512], folder[512], first[600], second[600];
    snprintf(path, sizeof path, "%s", scratch_path("good.lua"));
    snprintf(folder, sizeof folder, "%s", scratch_path("pictures"));
    script_write(
        path,
        "local n = param('size', 24)\n"
        "local p = paper{width = n, height = 16, torus = true, model = {'surface', 'fixing'},\n"
        "                pigments = {'cyan', {name = 'spot', white = '#c04020', black = "
        "'#301008'}}}\n"
        "assert(p.width == n and p.steps == 0)\n"
        "p:resist(rect(2, 2, 3, 3))\n"
        "p:put(ellipse(12, 8, 9, 6) + line({{1, 1}, {20, 14, 3}}, 2), {water = 1, cyan = "
        "0.5})\n"
        "p:put((rect(4, 4, 8, 8) * ellipse(8, 8, 5) - rect(7, 7, 1, 1)):soften(2), {spot = "
        "1})\n"
        "assert(p:at('surface pigment', 3, 3, 'cyan') == 0)\n"
        "local before = {p:total('water'), p:total('cyan'), p:total('spot')}\n"
        "p:step(3)\n"
        "assert(p.steps == 3)\n"
        "assert(p:total('water') + p:total('dried') == before[1])\n"
        "assert(p:total('cyan') == before[2] and p:total('spot') == before[3])\n"
        "local long, high = p:type('a b', {size = 9.5, x = 4.25, y = 12.5, width = 8, angle = "
        "3, "
        "filter = 'cone'}, {cyan = 0.3})\n"
        "assert(long >= 8 and high > 9.5 and p:total('cyan') > before[2])\n"
        "p:frame('a.png') p:frame('b.png', {layer = 'fixed pigment', pigment = 'cyan', bits = "
        "16})\n"
        "p:seal() assert(p:total('cyan') == 0)\n"
        "p:blot(nil or text('x', {size = 12, y = 12}):rotate(20, 8, 8), 0.5)\n"
        "print(n, math.random(1000))\n");
    child_script(&child, path, (const char *[]){"size=30", "-o", folder, NULL});
    child_run(&child);
    if (child.status != 0)
        fail_msg("%d: %s", child.status, child.errors);
    assert_memory_equal(child.output, "30\t", 3);
    snprintf(first, sizeof first, "%s/a.png", folder);
    snprintf(second, sizeof second, "%s/b.png", folder);
    struct stat status;
    assert_int_equal(stat(first, &status), 0);
    assert_int_equal(stat(second, &status), 0);

    /* a second run gives the same bits, and so does each folder of a sweep */
    char said[64], swept[640], command[1600];
    snprintf(said, sizeof said, "%.60s", child.output);
    child_script(&child, path,
                 (const char *[]){"-o", folder, "--sweep", "size=30,24", "-q", NULL});
    child_run(&child);
    if (child.status != 0)
        fail_msg("%d: %s", child.status, child.errors);
    assert_memory_equal(child.output, said, strlen(said));
    snprintf(swept, sizeof swept, "%s/size-30/a.png", folder);
    snprintf(command, sizeof command, "cmp -s '%s' '%s'", first, swept);
    assert_int_equal(system(command), 0);

    child_script(&child, path, (const char *[]){"sice=30", "-o", folder, NULL});
    child_run(&child);
    assert_int_equal(child.status, 1);
    assert_non_null(strstr(child.errors, "good.lua:10: the script asks for no 'sice'"));
    script_write(path, "local p = paper{width = 8, height = 8, model = 'thesis'}\n"
                       "if p.steps > 0 then param('late') end\n");
    child_script(&child, path, (const char *[]){"late=1", "-o", folder, NULL});
    child_run(&child);
    assert_int_equal(child.status, 1);
    assert_non_null(strstr(child.errors, "asked for no 'late'"));
}

static void pictures_stay_in_their_folder(void **state)
{
    (void)state;
    static struct child child;
    char path[512], folder[512], link[600], script[900];
    snprintf(path, sizeof path, "%s", scratch_path("escape.lua"));
    snprintf(folder, sizeof folder, "%s", scratch_path("jail"));
    mkdir(folder, 0777);
    snprintf(link, sizeof link, "%s/out.png", folder);
    assert_int_equal(symlink("/tmp/lutetia-escaped.png", link), 0);
    snprintf(link, sizeof link, "%s/up", folder);
    assert_int_equal(symlink("/tmp", link), 0);
    static const char *const names[] = {"../x.png", "/tmp/x.png", "up/x.png", "a/../../x.png",
                                        "x.txt",    "",           ".png",     "no/x.png"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(script, sizeof script,
                 "paper{width=8, height=8, model='thesis'}:frame('%s')\n", names[i]);
        script_write(path, script);
        child_script(&child, path, (const char *[]){"-o", folder, NULL});
        child_run(&child);
        if (child.status != 1)
            fail_msg("%s: status %d, %s", names[i], child.status, child.errors);
        assert_non_null(strstr(child.errors, "escape.lua:1: "));
    }
    assert_int_not_equal(access("/tmp/lutetia-escaped.png", F_OK), 0);
}

static void ctrl_c_ends_a_script(void **state)
{
    (void)state;
    static struct child child;
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_path("long.lua"));
    script_write(path, "while true do end\n");
    child_script(&child, path, (const char *[]){NULL});
    child.interrupt_after_ms = 500;
    child_run(&child);
    assert_int_equal(child.status, 130);
    assert_non_null(strstr(child.errors, "long.lua:1: interrupted\n"));
}

static void wrong_command_lines_are_refused(void **state)
{
    (void)state;
    static struct child child;
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_path("empty.lua"));
    script_write(path, "");
    static const struct {
        const char *more[4];
        int status;
        const char *says;
    } rows[] = {{{"seven"}, 2, "key=value"},
                {{"=3"}, 2, "key=value"},
                {{"--sweep", "a"}, 2, "--sweep"},
                {{"--sweep", "a=3..1"}, 2, "--sweep"},
                {{"--sweep", "a=/x"}, 2, "--sweep"},
                {{"--memory", "0"}, 2, "--memory"},
                {{"--sweep", "a=0.1.."}, 2, "--sweep"},
                {{"--timeout", "-1"}, 2, "--timeout"},
                {{"-o", "/proc/no"}, 1, "/proc/no"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        child_script(&child, path, rows[i].more);
        child_run(&child);
        if (child.status != rows[i].status || !strstr(child.errors, rows[i].says))
            fail_msg("%s: %d, %s", rows[i].more[0], child.status, child.errors);
    }
    child_script(&child, "/no/such.lua", (const char *[]){NULL});
    child_run(&child);
    assert_int_equal(child.status, 1);
    assert_non_null(strstr(child.errors, "/no/such.lua"));
    child_script(&child, "/tmp", (const char *[]){NULL});
    child_run(&child);
    assert_int_equal(child.status, 1);
    assert_string_equal(child.errors,
                        "lutetia run: /tmp: cannot read: Is a directory; name a file in it\n");
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    if (!lutetia)
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_scripts_get_one_line),
        cmocka_unit_test(a_script_makes_its_pictures),
        cmocka_unit_test(pictures_stay_in_their_folder),
        cmocka_unit_test(ctrl_c_ends_a_script),
        cmocka_unit_test(wrong_command_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
