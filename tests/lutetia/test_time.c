/* test_time.c - scripts and the command edit time: a moment has the same bits however one gets
 * there. Tests also films, sweeps, and their errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../display/scratch.h"
#include "child.h"

static const char *lutetia;
static struct child child;

/* A paper with few kernels. */
#define PAPER                                                                                  \
    "local p = paper{width = 24, height = 16, model = {'infused'}, pigments = {'cyan'}}\n"     \
    "p:put(ellipse(12, 8, 6), {water = 0.7, cyan = 0.5})\n"

static const char *in_scratch(const char *name)
{
    static char paths[8][600];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s", scratch_path(name));
    return path;
}

static void script_write(const char *name, const char *text)
{
    FILE *file = fopen(in_scratch(name), "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Runs a script with up to eight more arguments, ended by NULL. */
static void run(const char *script, const char *const *more, int status)
{
    int interrupt = child.interrupt_after_ms;
    const char *variable = child.variables[0];
    memset(&child, 0, sizeof child);
    child.interrupt_after_ms = interrupt;
    child.variables[0] = variable;
    int count = 0;
    child.arguments[count++] = lutetia;
    child.arguments[count++] = "run";
    child.arguments[count++] = in_scratch(script);
    for (int i = 0; more[i]; i++)
        child.arguments[count++] = more[i];
    child_run(&child);
    child.interrupt_after_ms = 0;
    child.variables[0] = NULL;
    if (child.status != status)
        fail_msg("status %d: %s%s", child.status, child.output, child.errors);
}
#define RUN(script, status, ...) run(script, (const char *[]){__VA_ARGS__, NULL}, status)

static void says(const char *text)
{
    if (!strstr(child.errors, text))
        fail_msg("it said: %s", child.errors);
}

static void one_line(const char *text)
{
    says(text);
    const char *end = strchr(child.errors, '\n');
    if (!end || end[1])
        fail_msg("not one line: %s", child.errors);
}

static bool same(const char *first, const char *second)
{
    char command[1400];
    snprintf(command, sizeof command, "cmp -s '%s' '%s'", in_scratch(first),
             in_scratch(second));
    return system(command) == 0;
}

static bool there(const char *name)
{
    return access(in_scratch(name), F_OK) == 0;
}

static void scripts_go_back_and_forth(void **state)
{
    (void)state;
    script_write(
        "back.lua", PAPER
        "p:step(6) p:frame('six.png') p:step(4) p:frame('ten.png')\n"
        "local dried = p:total('dried')\n"
        "assert(p:undo() == 1 and p.steps == 6) p:frame('six2.png')\n"
        "assert(p:redo(5) == 1 and p.steps == 10) p:frame('ten2.png')\n"
        "p:to(6) p:frame('six3.png') p:to(10)\n"
        "p:at(6, function(q) q:blot(rect(8, 4, 4, 4)) end)\n"
        "p:frame('at.png') assert(p:total('dried') < dried)\n"
        "local m = p:moments()\n"
        "assert(#m == 4 and m[3].what == 'blot' and m[3].time == 6 and m[4].steps == 4)\n"
        "assert(not pcall(p.at, p, 3, function(q) q:blot(rect(0, 0, 9, 9)) error('no') end))\n"
        "p:frame('at2.png')\n"
        "p:save('p.h5') local r = paper.load('p.h5') r:frame('loaded.png')\n"
        "r:undo(2) p:undo(2) assert(r.steps == 6 and r:total('cyan') == p:total('cyan'))\n"
        "local same = p:render(1) same:frame('same.png') p:frame('same2.png')\n"
        "");
    RUN("back.lua", 0, "-o", in_scratch("back"));
    assert_true(same("back/six.png", "back/six2.png") && same("back/six.png", "back/six3.png"));
    assert_true(same("back/ten.png", "back/ten2.png"));
    assert_false(same("back/ten.png", "back/at.png"));
    assert_true(same("back/at.png", "back/at2.png") && same("back/at.png", "back/loaded.png"));
    assert_true(same("back/same.png", "back/same2.png"));
}

static void saved_runs_go_on(void **state)
{
    (void)state;
    script_write("long.lua",
                 PAPER "p:step(5) p:frame('five.png')\n"
                       "p:put(rect(2, 2, 6, 3), {water = 0.3, cyan = param('c', 0.2)})\n"
                       "p:step(3) if param('stop', false) then error('here') end\n"
                       "p:step(4) p:frame('end.png')\n");
    char saved[600];
    snprintf(saved, sizeof saved, "%s", in_scratch("long.h5"));
    RUN("long.lua", 0, "-o", in_scratch("whole"));
    RUN("long.lua", 1, "-o", in_scratch("parts"), "--save", saved, "stop=true");
    says("--resume");
    RUN("long.lua", 0, "-o", in_scratch("parts"), "--resume", saved);
    assert_true(same("whole/end.png", "parts/end.png"));
    child.variables[0] = "LUTETIA_EAGER=1";
    RUN("long.lua", 0, "-o", in_scratch("again"), "--resume", saved, "--save", saved);
    assert_true(same("whole/end.png", "again/end.png"));
    assert_true(same("whole/five.png", "again/five.png"));
    /* a script that has changed */
    RUN("long.lua", 0, "-o", in_scratch("other"), "c=0.3");
    RUN("long.lua", 0, "-o", in_scratch("other2"), "--resume", saved, "c=0.3");
    says("another way");
    assert_true(same("other/end.png", "other2/end.png"));
    RUN("long.lua", 1, "--resume", in_scratch("long.lua"), "-q");
    one_line("not a saved state");
    RUN("long.lua", 1, "--save", "/proc/x.h5", "-q", "-o", in_scratch("whole"));
    one_line("/proc/x.h5: cannot write");
}

/* Reads a file's bytes; the caller frees them. */
static char *read_all(const char *name, size_t *count)
{
    FILE *file = fopen(in_scratch(name), "rb");
    char *bytes = malloc(1 << 20);
    if (!file || !bytes)
        fail_msg("%s: cannot read", name);
    *count = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    return bytes;
}

/* A run that is stopped and continued makes its film in two parts. It uses undo and redo in
 * both halves. */
static void films_go_on(void **state)
{
    (void)state;
    char saved[600], video[600];
    size_t count[3], header = 0;
    char *film[3];
    script_write("parts.lua",
                 PAPER "p:air{gravity = {0.02, 0}} p:step(6) p:undo()\n"
                       "p:air{humidity = 0.01} p:step(4)\n"
                       "p:at(2, function(q) q:put(rect(12, 2, 5, 9), {water = 0.5}) end)\n"
                       "if param('stop', false) then error('here') end\n"
                       "p:step(3) p:undo(2) p:step(5) p:frame('parts.png')\n");
    snprintf(saved, sizeof saved, "%s", in_scratch("parts.h5"));
    static const char *const names[3] = {"film-all.y4m", "film-1.y4m", "film-2.y4m"};
    for (int i = 0; i < 3; i++) {
        snprintf(video, sizeof video, "%s", in_scratch(names[i]));
        if (i == 0)
            RUN("parts.lua", 0, "-o", in_scratch("all"), "--video", video, "--every", "2");
        if (i == 1)
            RUN("parts.lua", 1, "-o", in_scratch("two"), "--video", video, "--every", "2",
                "--save", saved, "stop=true");
        if (i == 2)
            RUN("parts.lua", 0, "-o", in_scratch("two"), "--video", video, "--every", "2",
                "--resume", saved);
        film[i] = read_all(names[i], &count[i]);
        assert_null(strstr(child.errors, "another way"));
    }
    assert_true(same("all/parts.png", "two/parts.png"));
    while (film[0][header++] != '\n')
        ;
    assert_true(count[1] > header && count[2] > header);
    assert_int_equal(count[0], count[1] + count[2] - header);
    assert_memory_equal(film[0], film[1], count[1]);
    assert_memory_equal(film[0] + count[1], film[2] + header, count[2] - header);
    for (int i = 0; i < 3; i++)
        free(film[i]);
}

static void films_are_made(void **state)
{
    (void)state;
    char bin[600], path[700], video[600];
    struct stat status;
    script_write("film.lua", PAPER
                 "p:step(10) if param('loop', false) then while true do p:step(1) end end\n");
    RUN("film.lua", 0, "--video", in_scratch("film.y4m"), "--frames", in_scratch("frames"),
        "--every", "5", "--camera", "2,2,9,8");
    assert_int_equal(stat(in_scratch("film.y4m"), &status), 0);
    assert_int_equal(status.st_size, 35 + 3 * (6 + 3 * 8 * 8)); /* steps 0, 5, 10 */
    assert_true(there("frames/color-000002.png") && there("frames/water-000000.png") &&
                there("frames/mask-000001.png") && !there("frames/color-000003.png"));
    /* an encoder that is killed */
    snprintf(bin, sizeof bin, "%s", in_scratch("bin"));
    mkdir(bin, 0700);
    snprintf(path, sizeof path, "%s/ffmpeg", bin);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("#!/bin/sh\nkill -9 $$\n", file);
    fclose(file);
    chmod(path, 0700);
    snprintf(path, sizeof path, "PATH=%s:%s", bin, getenv("PATH"));
    snprintf(video, sizeof video, "%s", in_scratch("film.mp4"));
    child.variables[0] = path;
    RUN("film.lua", 1, "--video", video, "-q", "--every", "1");
    one_line("signal 9");
    assert_false(there("film.mp4"));
    /* Ctrl-C completes it */
    unlink(in_scratch("film.y4m"));
    child.interrupt_after_ms = 1500;
    RUN("film.lua", 130, "--video", in_scratch("film.y4m"), "-q", "loop=true", "--save",
        in_scratch("film.h5"));
    one_line("interrupted");
    assert_int_equal(stat(in_scratch("film.y4m"), &status), 0);
    assert_true(status.st_size > 500 && (status.st_size - 37) % (6 + 3 * 24 * 16) == 0);
    assert_true(there("film.h5"));
}

static void sweeps_run_side_by_side(void **state)
{
    (void)state;
    script_write("sweep.lua", "local n = param('n', 1)\n"
                              "if n == 0.5 then error('no half') end\n"
                              "for i = 1, 3000000 * (1 - n) do end\n"
                              "print('n is', n)\n"
                              "while param('loop', false) do end\n");
    RUN("sweep.lua", 1, "-o", in_scratch("sweep"), "--sweep", "n=0..1/5", "--jobs", "3");
    assert_string_equal(child.output, "n is\t0\nn is\t0.25\nn is\t0.75\nn is\t1\n");
    says("n-0.5: ");
    says("no half");
    says("1 of 5 runs failed");
    assert_true(there("sweep/n-0.25"));
    RUN("sweep.lua", 1, "-o", in_scratch("sweep"), "--sweep", "n=0,0.5,1", "-q");
    assert_string_equal(child.output, "n is\t0\nn is\t1\n");
    says("1 of 3 runs failed");
    child.interrupt_after_ms = 700;
    RUN("sweep.lua", 130, "-o", in_scratch("sweep"), "--sweep", "n=1..6", "--jobs", "2",
        "loop=true");
    static const char *const wrong[] = {"n=1..0/5", "n=0..1/1", "n=a..b/3", "n=0..1/99999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        RUN("sweep.lua", 2, "--sweep", wrong[i]);
        one_line("--sweep must be");
    }
    RUN("sweep.lua", 2, "--jobs", "2");
    RUN("sweep.lua", 2, "--sweep", "n=1", "--save", "x.h5");
}

static void what_cannot_be_gets_one_line(void **state)
{
    (void)state;
    static const struct {
        const char *script, *says;
    } rows[] = {
        {PAPER "p:step(4) p:to(5)", "a time must be 0..4 steps (got 5)"},
        {PAPER "p:at(1, print)", "a time must be 0..0 steps (got 1)"},
        {PAPER "p:at(0, function() p:at(0, print) end)", "inserted already"},
        {PAPER "p:at(0, 3)", "function expected"},
        {PAPER "p:render(0)", "render's scale must be 0.015625..64 (got 0)"},
        {PAPER "p:render(0.1)", "paper width must be"},
        {PAPER "p:save('../x.h5')", "folder given"},
        {PAPER "p:save('x.lua')", "must end in .h5"},
        {PAPER "p:save('.h5')", "must end in .h5"},
        {PAPER "p:save('.x.h5')", "must not be hidden"},
        {PAPER "p:frame('./.x.png')", "must not be hidden"},
        {PAPER "p:frame('.x/../y.png')", "must not be hidden"},
        {PAPER "p:save('a/x.h5')", "no such folder"},
        {"paper.load('none.h5')", "No such file"},
        {"paper.load('../x.h5')", "folder given"},
        {"paper{width = 24, height = 16, history = false}:undo()", "history = false"},
        {"paper{width = 16384, height = 16384}", "not enough memory"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        script_write("wrong.lua", rows[i].script);
        RUN("wrong.lua", 1, "-o", in_scratch("wrong"), "-q");
        one_line(rows[i].says);
        says("wrong.lua:");
    }
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    if (!lutetia)
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scripts_go_back_and_forth),
        cmocka_unit_test(saved_runs_go_on),
        cmocka_unit_test(films_are_made),
        cmocka_unit_test(films_go_on),
        cmocka_unit_test(sweeps_run_side_by_side),
        cmocka_unit_test(what_cannot_be_gets_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
