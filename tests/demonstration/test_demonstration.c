/* test_demonstration.c - live scripts, each in a process: what they draw and hear, that no
 * picture is torn, and what becomes of those that do not end, fail, take memory, want files,
 * hang or die (security.md 36). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../skip.h"
#include "shown.h"

enum { WIDTH = 48, HEIGHT = 32 };

static struct demonstration *start(const char *script)
{
    return shown_start(script, WIDTH, HEIGHT);
}

static void runs(struct demonstration *d, long pictures)
{
    if (!shown_wait(d, pictures))
        fail_msg("it has ended: %s", demonstration_ended(d));
}

/* ---- drawing and hearing ---- */

static void draws(void **state)
{
    (void)state;
    struct demonstration *d = start("function draw() return '#102030', rect(8, 4, 10, 10), "
                                    "{1, 0, 0.2}, circle(30, 16, 6) end");
    assert_null(demonstration_picture(d));
    runs(d, 1);
    shown_is(d, WIDTH, 0, 0, 16, 32, 48);
    shown_is(d, WIDTH, WIDTH - 1, HEIGHT - 1, 16, 32, 48);
    shown_is(d, WIDTH, 12, 8, 255, 0, 51);
    shown_is(d, WIDTH, 30, 16, 24, 28, 38); /* the usual ink */
    demonstration_stop(d);
}

/* Half of a white mask on black is half of the light. */
static void mixes_light(void **state)
{
    (void)state;
    struct demonstration *d =
        start("function draw() return '#000000', rect(0, 0, 48, 32) * 0.5, '#ffffff' end");
    runs(d, 1);
    const int half = shown_pixel(d, WIDTH, 20, 20)[0];
    assert_true(half >= 187 && half <= 189); /* 255 (1.055 0.5^(1/2.4) - 0.055) = 187.5 */
    demonstration_stop(d);
}

static void pictures_and_type(void **state)
{
    (void)state;
    struct demonstration *d = start(
        "local q = picture(8, 8, function(x, y) return x / 7, y / 7, 0 end)\n"
        "local w = spring.word{text = 'II', font = 'DejaVuSans', preset = 'stiff', y = 0.2}\n"
        "function step(s) w:step(1, s) end\n"
        "function draw() return q, w:mask{scale = 40, x = 12, y = 32}, '#ff0000' end\n");
    runs(d, 4);
    shown_is(d, WIDTH, 7, 0, 255, 0, 0);
    shown_is(d, WIDTH, 0, 7, 0, 255, 0);
    shown_is(d, WIDTH, 8, 0, 254, 252, 248); /* beside the picture */
    int red = 0;
    for (int y = 8; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            red += shown_pixel(d, WIDTH, x, y)[1] < 60;
    assert_true(red > 40 && red < 600);
    demonstration_stop(d);
}

static void steps_and_hears(void **state)
{
    (void)state;
    struct demonstration *d =
        start("local t, n, last = 0, 0, ''\n"
              "function step(s) t = t + s n = n + 1 print('one\\ntwo', n, t, last) end\n"
              "function pointer(what, x, y, pressure)\n"
              "  last = last .. what .. x .. ',' .. y .. ',' .. pressure .. ' ' end\n"
              "function key(name) last = last .. name .. ' ' end\n"
              "function release(name) last = last .. name .. ' up ' end\n"
              "function draw() return '#ffffff' end\n");
    runs(d, 4);
    assert_string_equal(demonstration_said(d), "two 4 0.0625 ");
    demonstration_pointer(d, DEMONSTRATION_DOWN, 3, 4.5, 1);
    demonstration_pointer(d, DEMONSTRATION_MOVE, 5, 4.5, 0.5);
    demonstration_pointer(d, DEMONSTRATION_UP, 5, 1e300, 7);
    demonstration_key(d, true, "Left");
    demonstration_key(d, false, "Left");
    runs(d, 1);
    assert_string_equal(demonstration_said(d),
                        "two 5 0.078125 down3.0,4.5,1.0 move5.0,4.5,0.5 up5.0,100000.0,1.0 "
                        "Left Left up ");
    demonstration_stop(d);
}

static void control_is(const struct demonstration *d, int number, const char *name,
                       enum control_curve curve, double least, double most, double usual)
{
    const struct demonstration_control *c = demonstration_control(d, number);
    assert_non_null(c);
    assert_string_equal(c->name, name);
    assert_int_equal(c->curve, curve);
    assert_true(c->least == least && c->most == most && c->usual == usual);
    assert_true(c->value == usual);
}

/* What a script declares is known before its first picture; what is set is heard in its order,
 * and within its range. A network's control is a row of the library's table. */
static void controls_are_declared_and_set(void **state)
{
    (void)state;
    struct demonstration *d = start(
        "local a = control{name = 'speed', unit = '1/s', least = 0, most = 4, usual = 1.5,\n"
        "                  curve = 'centred', does = 'how \\27 fast'}\n"
        "local b = control{name = 'wet', curve = 'switch', usual = true}\n"
        "local c = control{name = 'ink', choices = 'blue red green', usual = 'red'}\n"
        "local w = spring.word{text = 'I', font = 'DejaVuSans', preset = 'stiff', gravity = "
        "3}\n"
        "local g, last = control{name = 'gravity', of = w}, ''\n"
        "function changed(name, value) last = last .. name .. '=' .. tostring(value) .. ' ' "
        "end\n"
        "function draw() print(a(), b(), c(), g(), w:get('gravity'), last) return '#ffffff' "
        "end");
    runs(d, 1);
    control_is(d, 0, "speed", CONTROL_CENTRED, 0, 4, 1.5);
    assert_string_equal(demonstration_control(d, 0)->unit, "1/s");
    assert_string_equal(demonstration_control(d, 0)->does, "how \\x1b fast");
    control_is(d, 1, "wet", CONTROL_SWITCH, 0, 1, 1);
    control_is(d, 2, "ink", CONTROL_CHOICE, 0, 2, 1);
    assert_string_equal(demonstration_control(d, 2)->choices, "blue red green");
    const struct demonstration_control *gravity = demonstration_control(d, 3);
    assert_true(gravity && gravity->value == 3 && gravity->least < 0 && gravity->most > 9.81);
    assert_string_equal(gravity->name, "gravity");
    assert_true(gravity->does[0] && gravity->unit[0]);
    assert_null(demonstration_control(d, 4));
    assert_null(demonstration_control(d, -1));
    assert_string_equal(demonstration_said(d), "1.5 true red 3.0 3.0 ");
    demonstration_set(d, 0, 2.25);
    demonstration_set(d, 1, 0);
    demonstration_set(d, 2, 2);
    demonstration_set(d, 3, 0.5);
    demonstration_set(d, 0, 99);
    demonstration_set(d, 4, 1);
    demonstration_set(d, -1, 1);
    assert_true(demonstration_control(d, 0)->value == 4);
    runs(d, 1);
    assert_string_equal(demonstration_said(d),
                        "4.0 false green 0.5 0.5 speed=2.25 wet=false ink=green gravity=0.5 "
                        "speed=4.0 ");
    demonstration_stop(d);
}

/* Every picture is of one number, which follows the one before: none is torn, lost or old. */
static void no_picture_is_torn(void **state)
{
    (void)state;
    enum { PICTURES = 300 };
    struct demonstration *d = start("local n = 0\nfunction step() n = n + 1 end\n"
                                    "function draw() return {n % 256 / 255, n // 256 / 255, 0} "
                                    "end");
    for (int i = 1; i <= PICTURES; i++) {
        runs(d, 1);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                shown_is(d, WIDTH, x, y, i % 256, i / 256, 0);
    }
    assert_int_equal(demonstration_pictures(d), PICTURES);
    demonstration_stop(d);
}

/* Moves are merged while it is busy, presses are not. */
static void a_busy_one_hears_presses(void **state)
{
    (void)state;
    struct demonstration *d = start(
        "local downs, x0 = 0, 0\n"
        "function pointer(what, x) if what == 'down' then downs = downs + 1 end x0 = x end\n"
        "function draw() print(downs, x0) return '#ffffff' end\n");
    runs(d, 1);
    demonstration_frame(d, 0);
    for (int i = 0; i < 5; i++) {
        demonstration_pointer(d, DEMONSTRATION_DOWN, i, 0, 1);
        for (int k = 0; k < 1000; k++)
            demonstration_pointer(d, DEMONSTRATION_MOVE, k, 0, 1);
    }
    runs(d, 2);
    assert_string_equal(demonstration_said(d), "5 999.0");
    demonstration_stop(d);
}

/* ---- what is wrong ---- */

static void ends_with(const char *script, const char *says)
{
    struct demonstration *d = start(script);
    shown_ends(d, says);
    demonstration_frame(d, 1); /* it does not run again */
    assert_false(demonstration_take(d));
    demonstration_stop(d);
}

static void mistakes_are_told(void **state)
{
    (void)state;
    ends_with("x = 1", "live: a live script has a function draw()");
    ends_with("function draw()\n  return 1 +\nend", "live:3:");
    ends_with("function draw() return nothing.x end", "live:1:");
    ends_with("function draw() return 7 end", "draw must return masks, colours");
    ends_with("function draw() return 'blue' end", "must be a colour");
    ends_with("function draw() draw = nil return '#000000' end", "has gone");
    ends_with("function draw() error({}) end", "a table");
    ends_with("function draw() error('two\\nlines\\27[2J') end", "two lines");
    ends_with("local function f(n) return '#000000', n and f(n - 1) end "
              "function draw() return table.unpack({}, 1, 100) end",
              "up to 64 values");
    ends_with("\x1b"
              "Lua",
              "binary chunk"); /* no bytecode */
    ends_with("", "a live script has a function draw()");
}

static void controls_mistaken_are_told(void **state)
{
    (void)state;
    ends_with("control{}", "control name must be a text");
    ends_with("control{name = 7}", "must be a text");
    ends_with("control{name = ('x'):rep(41)}", "up to 40 bytes");
    ends_with("control{name = 'a', colour = 1}", "control has no");
    ends_with("control{name = 'a', least = 2, most = 1}", "least is below most");
    ends_with("control{name = 'a', least = 0/0}", "least");
    ends_with("control{name = 'a', most = 4, usual = 5}", "a must be");
    ends_with("control{name = 'a', curve = 'bent'}", "control curve");
    ends_with("control{name = 'a', curve = 'choice'}", "choices");
    ends_with("control{name = 'a', choices = 'one'}", "two or more");
    ends_with("control{name = 'a', choices = 'one two', usual = 'three'}", "one two");
    ends_with("control{name = 'a'} control{name = 'a'}", "already");
    ends_with("for i = 1, 13 do control{name = 'a' .. i} end", "up to 12 controls");
    ends_with("function draw() control{name = 'a'} end", "while the script begins");
    ends_with("control{name = 'a', of = 7}", "network");
    ends_with("control{name = 'weight', of = spring.network()}", "weight");
    ends_with("control{name = 'gravity', least = 1, of = spring.network()}", "'least'");
}

static void wants_files(void **state)
{
    (void)state;
    ends_with("picture('/etc/passwd')", "this script has no files");
    ends_with("image('x.png')", "this script has no files");
    ends_with("song('x.mid')", "this script has no files");
    ends_with("spring.network('x.springs')", "this script has no files");
    ends_with("io.open('/etc/passwd')", "'io'");
    ends_with("os.execute('true')", "'os'");
    ends_with("require('x')", "'require'");
    ends_with("text('x', {font = '/etc/passwd'})", "a font's name, not a file");
}

static struct demonstration *start_within(const char *script, double answer_s, int memory_mb)
{
    struct demonstration_def def =
        demonstration_def_default(script, strlen(script), WIDTH, HEIGHT);
    struct demonstration *d;
    def.answer_s = answer_s;
    def.memory_mb = memory_mb;
    if (!demonstration_start(&def, &d))
        fail_msg("%s", demonstration_error());
    return d;
}

static void never_ends(void **state)
{
    static const char *const scripts[] = {
        "while true do end", "function draw() while true do end end",
        "function draw() while true do pcall(function() while true do end end) end end",
        "function draw() return '#000000' end function step() repeat until false end"};
    (void)state;
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; i++) {
        struct demonstration *d = start_within(scripts[i], 0.2, 256);
        shown_ends(d, "stopped after 0");
        demonstration_stop(d);
    }
    /* in one of Lua's own functions, where no hook is called */
    struct demonstration *d = start_within(
        "function draw() string.find(('a'):rep(30), ('a*'):rep(30) .. 'b') end", 0.2, 256);
    shown_ends(d, "did not stop when its time was up");
    demonstration_stop(d);
}

static void takes_memory(void **state)
{
    (void)state;
    struct demonstration *d = start_within(
        "local t = {} while true do t[#t + 1] = ('x'):rep(1 << 20) .. #t end", 60, 64);
    shown_ends(d, "not enough memory");
    demonstration_stop(d);
    d = start_within("local t = {} function draw() for i = 1, 40 do t[#t + 1] = rect(0, 0, "
                     "4000, 4000):soften(1) end end",
                     60, 64);
    shown_ends(d, "not enough memory");
    demonstration_stop(d);
}

static void sides_and_texts_are_checked(void **state)
{
    static const int sides[][2] = {{15, 100}, {100, 15}, {1601, 100}, {100, 1601}, {-1, 0}};
    (void)state;
    struct demonstration *d;
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        const struct demonstration_def def =
            demonstration_def_default("", 0, sides[i][0], sides[i][1]);
        assert_false(demonstration_start(&def, &d));
        assert_null(d);
        assert_non_null(strstr(demonstration_error(), "16..1600"));
    }
    const struct demonstration_def def =
        demonstration_def_default("", DEMONSTRATION_SCRIPT_MAX + 1, 100, 100);
    assert_false(demonstration_start(&def, &d));
    assert_non_null(strstr(demonstration_error(), "KB"));
    demonstration_stop(NULL);
}

/* ---- processes ---- */

/* The number of this process's only child; 0: the system does not tell. */
static pid_t child_find(void)
{
    char path[64];
    int child = 0;
    snprintf(path, sizeof path, "/proc/self/task/%d/children", (int)getpid());
    FILE *file = fopen(path, "r");
    if (!file)
        return 0;
    if (fscanf(file, "%d", &child) != 1)
        child = 0;
    fclose(file);
    return child;
}

static int descriptors_open(void)
{
    int count = 0;
    DIR *folder = opendir("/proc/self/fd");
    assert_non_null(folder);
    while (readdir(folder))
        count++;
    closedir(folder);
    return count;
}

static void dies(void **state)
{
    (void)state;
    struct demonstration *d = start("function draw() return '#00ff00' end");
    runs(d, 2);
    const pid_t child = child_find();
    if (!child) {
        demonstration_stop(d);
        skip_because("/proc does not tell children here");
    }
    kill(child, SIGKILL); /* a sanitizer would answer others */
    shown_ends(d, "ended by a signal: Killed");
    shown_is(d, WIDTH, 3, 3, 0, 255, 0); /* what was seen last is still there */
    demonstration_stop(d);
}

static void hangs(void **state)
{
    (void)state;
    const char script[] = "function draw() return '#00ff00' end";
    struct demonstration_def def =
        demonstration_def_default(script, strlen(script), WIDTH, HEIGHT);
    struct demonstration *d;
    assert_true(demonstration_start(&def, &d));
    runs(d, 1);
    const pid_t child = child_find();
    demonstration_stop(d);
    if (!child)
        skip_because("/proc does not tell children here");
    def.patience_s = 0.2; /* which a stopped process does not keep, however fast it is */
    assert_true(demonstration_start(&def, &d));
    kill(child_find(), SIGSTOP);
    shown_ends(d, "not answered for 0.2 seconds");
    demonstration_stop(d);
}

static void nothing_is_left(void **state)
{
    (void)state;
    const int before = descriptors_open();
    struct demonstration *all[3];
    for (int i = 0; i < 3; i++)
        all[i] = start("function draw() return '#00ff00' end");
    for (int i = 0; i < 3; i++)
        runs(all[i], 1);
    struct demonstration *wrong = start("nonsense");
    shown_ends(wrong, "live:1:");
    demonstration_stop(wrong);
    for (int i = 0; i < 3; i++)
        demonstration_stop(all[i]);
    assert_int_equal(descriptors_open(), before);
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD);
}

/* Who looks is killed: the demonstration ends, too. */
static void ends_with_who_looks(void **state)
{
    (void)state;
    int ends[2];
    pid_t demonstration = 0;
    assert_int_equal(pipe(ends), 0);
    const pid_t looks = fork();
    assert_true(looks >= 0);
    if (looks == 0) {
        struct demonstration *d = start("function draw() return '#00ff00' end");
        shown_wait(d, 1);
        const pid_t child = child_find();
        if (write(ends[1], &child, sizeof child) != sizeof child)
            _exit(1);
        for (;;)
            pause();
    }
    assert_int_equal(read(ends[0], &demonstration, sizeof demonstration), sizeof demonstration);
    kill(looks, SIGKILL);
    assert_int_equal(waitpid(looks, NULL, 0), looks);
    close(ends[0]);
    close(ends[1]);
    if (!demonstration)
        skip_because("/proc does not tell children here");
    /* its number is free, or what has it waits for its end to be seen */
    for (int i = 0; i < 60000; i++) {
        char path[64], text[512] = "";
        snprintf(path, sizeof path, "/proc/%d/stat", (int)demonstration);
        FILE *file = fopen(path, "r");
        if (!file)
            return;
        const char *state_letter = fgets(text, sizeof text, file) ? strrchr(text, ')') : NULL;
        fclose(file);
        if (!state_letter || state_letter[2] == 'Z' || state_letter[2] == 'X')
            return;
        usleep(1000);
    }
    fail_msg("it lives on");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws),
        cmocka_unit_test(mixes_light),
        cmocka_unit_test(pictures_and_type),
        cmocka_unit_test(steps_and_hears),
        cmocka_unit_test(controls_are_declared_and_set),
        cmocka_unit_test(controls_mistaken_are_told),
        cmocka_unit_test(no_picture_is_torn),
        cmocka_unit_test(a_busy_one_hears_presses),
        cmocka_unit_test(mistakes_are_told),
        cmocka_unit_test(wants_files),
        cmocka_unit_test(never_ends),
        cmocka_unit_test(takes_memory),
        cmocka_unit_test(sides_and_texts_are_checked),
        cmocka_unit_test(dies),
        cmocka_unit_test(hangs),
        cmocka_unit_test(nothing_is_left),
        cmocka_unit_test(ends_with_who_looks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
