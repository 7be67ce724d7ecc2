/* test_leds.c - `lutetia leds`: programs, recordings, patterns, and its errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "child.h"

static const char *lutetia;

enum { FRAMES = 5 };

/* Writes a recording of FRAMES, a tenth of a second apart. */
static const char *recording(const char *name, size_t cut)
{
    static const char line[] = "lutetia leds 1 4096\n";
    const char *path = scratch_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(line, 1, sizeof line - 1, file);
    for (unsigned int i = 0; i < FRAMES; i++) {
        uint8_t frame[520] = {0};
        uint32_t us = i * 100000;
        for (int k = 0; k < 4; k++)
            frame[k] = (uint8_t)(us >> 8 * k);
        memset(frame + 8, (int)(0x11 * i), 512);
        fwrite(frame, 1, i + 1 == FRAMES ? sizeof frame - cut : sizeof frame, file);
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

static int pictures_in(const char *folder)
{
    char path[1024];
    int count = 0;
    do
        snprintf(path, sizeof path, "%s/frame-%06d.png", folder, count);
    while (unlink(path) == 0 && ++count);
    rmdir(folder);
    return count;
}

static void run(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    child->arguments[1] = "leds";
    if (!child_says(child, status, says, status != 0))
        fail_msg("exit %d for %d, and it said: %s", child->status, status, child->errors);
}

#define LEDS(...)                                                                              \
    {                                                                                          \
        NULL, NULL, "--size", "64x64", "-o", out, __VA_ARGS__                                  \
    }

static void recordings_become_pictures(void **unused)
{
    (void)unused;
    static const struct {
        const char *option, *value;
        int pictures;
    } cases[] = {{"--every", "1", 5}, {"--every", "2", 3}, {"--every", "9", 1},
                 {"--fps", "20", 9},  {"--fps", "5", 3},   {"--view", "front", 5}};
    const char *out = scratch_path("out.png"), *path = recording("leds", 0);
    const char *folder = scratch_path("frames");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct child child = {
            .arguments = LEDS("--frames", folder, cases[i].option, cases[i].value, path)};
        run(&child, 0, "");
        assert_int_equal(unlink(out), 0);
        int pictures = pictures_in(folder);
        if (pictures != cases[i].pictures)
            fail_msg("%s %s: %d pictures", cases[i].option, cases[i].value, pictures);
    }
}

static void patterns_become_pictures(void **unused)
{
    (void)unused;
    const char *out = scratch_path("out.png"), *folder = scratch_path("frames");
    struct child child = {.arguments =
                              LEDS("--pattern", "random", "--count", "3", "--frames", folder)};
    run(&child, 0, "");
    assert_int_equal(pictures_in(folder), 3);
    assert_int_equal(unlink(out), 0);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    const char *out = scratch_path("out.png"), *cut = recording("cut", 100);
    const char *junk = scratch_path("junk");
    FILE *file = fopen(junk, "w");
    assert_non_null(file);
    fputs("no lights at all", file);
    fclose(file);
    static struct {
        struct child child;
        int status;
        const char *says;
    } wrongs[16];
    int count = 0;
#define WRONG(code, text, ...)                                                                 \
    wrongs[count].child = (struct child){.arguments = LEDS(__VA_ARGS__)};                      \
    wrongs[count].status = code;                                                               \
    wrongs[count++].says = text
    WRONG(2, "--pattern random", NULL);
    WRONG(2, "one of them", "--pattern", "on", "prog");
    WRONG(2, "--pattern", "--pattern", "stars");
    WRONG(2, "--view", "--view", "back", "--pattern", "on");
    WRONG(2, "--every", "--every", "0", "--pattern", "on");
    WRONG(2, "--fps", "--fps", "nan", cut);
    WRONG(2, "--size", "--size", "9x9", "--pattern", "on");
    WRONG(2, "before the recording", recording("whole", 0), "--every", "2");
    WRONG(1, "no-such-program", "no-such-program", "-h");
    WRONG(1, "recording of lights", junk);
    WRONG(1, "within frame 4", cut);
    WRONG(1, "CM_latch_leds", "true");
    WRONG(1, "signal", "sh", "-c", "kill -9 $$");
    WRONG(1, "not a folder", "--frames", junk, "--pattern", "on");
    WRONG(1, "the folder must exist", "-o", "/proc/no/x.png", "--pattern", "on");
    for (int i = 0; i < count; i++) {
        run(&wrongs[i].child, wrongs[i].status, wrongs[i].says);
        assert_int_not_equal(access(out, F_OK), 0);
    }
    struct child again = {.arguments = LEDS("sleep", "20"), .interrupt_after_ms = 600};
    run(&again, 130, "interrupted");
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    if (!lutetia)
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recordings_become_pictures),
        cmocka_unit_test(patterns_become_pictures),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
