/* test_display.c - `lutetia display`: programs, recordings, and its errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <png.h>

#include "../display/display_pieces.h"
#include "../display/scratch.h"
#include "child.h"

static const char *lutetia, *painter;

static void run(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    child->arguments[1] = "display";
    child->variables[0] = "DISPLAY=";
    child->variables[1] = "WAYLAND_DISPLAY=";
    if (!child_says(child, status, says, status != 0))
        fail_msg("exit %d for %d, and it said: %s", child->status, status, child->errors);
}

/* Reads a PNG of that size, and removes it. */
static void png_take(const char *path, int width, int height, uint8_t *rgb)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path))
        fail_msg("%s: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    assert_int_equal(png.width, width);
    assert_int_equal(png.height, height);
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
    assert_int_equal(unlink(path), 0);
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

/* A display of 5x3, with a picture each tenth of a second: picture i is 40 i. */
static const char *recording(const char *name, int pictures, size_t cut)
{
    static struct pieces p;
    const char *path = scratch_path(name);
    uint8_t pixels[15];
    p.count = 0;
    pieces_line(&p);
    pieces_size(&p, 1, 1, 5, 3, 0);
    for (int i = 0; i < pictures; i++) {
        memset(pixels, 40 * i, sizeof pixels);
        pieces_pixels(&p, 1, 0, 1, 5, 3, 0, 0, pixels, (uint64_t)i * 100000);
    }
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(p.bytes, 1, p.count - cut, file), p.count - cut);
    assert_int_equal(fclose(file), 0);
    return path;
}

static void recordings_become_pictures(void **unused)
{
    (void)unused;
    static const struct {
        const char *option, *value;
        int pictures;
    } cases[] = {
        {"--every", "1", 5}, {"--every", "2", 3}, {"--fps", "20", 9}, {"--fps", "5", 3}};
    const char *out = scratch_path("out.png"), *path = recording("five", 5, 0);
    const char *folder = scratch_path("frames");
    uint8_t rgb[45], wanted[45];
    memset(wanted, 160, sizeof wanted);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct child child = {.arguments = {NULL, NULL, "-o", out, "--frames", folder,
                                            cases[i].option, cases[i].value, path}};
        run(&child, 0, "");
        png_take(out, 5, 3, rgb);
        assert_memory_equal(rgb, wanted, sizeof rgb);
        assert_int_equal(pictures_in(folder), cases[i].pictures);
    }
}

/* A film without ffmpeg: even sides, a frame for each picture. */
static void recordings_become_films(void **unused)
{
    (void)unused;
    const char *film = scratch_path("film.y4m"), *path = recording("five", 5, 0);
    struct child child = {.arguments = {NULL, NULL, "--film", film, path}};
    run(&child, 0, "");
    FILE *file = fopen(film, "rb");
    char line[64] = "";
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_memory_equal(line, "YUV4MPEG2 W6 H4 F30:1", 21);
    int frames = 0;
    for (int c, k = 0; (c = fgetc(file)) != EOF;) {
        k = c == "FRAME"[k] ? k + 1 : c == 'F';
        frames += k == 5;
        k = k == 5 ? 0 : k;
    }
    fclose(file);
    assert_int_equal(frames, 5);
}

static void programs_become_pictures(void **unused)
{
    (void)unused;
    static uint8_t rgb[3 * 40 * 30];
    const char *out = scratch_path("out.png"), *folder = scratch_path("frames");
    struct child child = {.arguments = {NULL, NULL, "-o", out, "--frames", folder, painter,
                                        scratch_path("pid"), "end", "two"}};
    run(&child, 0, "");
    png_take(out, 40, 30, rgb);
    for (int i = 0; i < 40 * 30; i++)
        assert_int_equal(rgb[3 * i], i % 40 * 6 & 255);
    png_take(scratch_path("out-2.png"), 21, 17, rgb);
    for (int i = 0; i < 21 * 17; i++) {
        const int value = i % 21 * 6 * 1111;
        for (int c = 0; c < 3; c++)
            assert_int_equal(rgb[3 * i + c], value >> 8 * c & 255);
    }
    char path[1024];
    snprintf(path, sizeof path, "%s/frame-2-000000.png", folder);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(pictures_in(folder), 5);
    /* Where there can be no window, the last picture is written. */
    struct child alone = {.arguments = {NULL, NULL, painter, scratch_path("pid"), "end"}};
    run(&alone, 0, "");
    png_take("display.png", 40, 30, rgb);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    const char *out = scratch_path("out.png"), *cut = recording("cut", 2, 5);
    const char *junk = scratch_path("junk"), *late = scratch_path("late");
    static struct pieces p;
    pieces_line(&p);
    pieces_size(&p, 1, 1, 5, 3, 0);
    pieces_head(&p, 3, 1, 0, 0, 0, 1, 1, 0);
    pieces_head(&p, 3, 1, 0, 0, 0, UINT64_MAX / 4, 2, 0); /* in nine thousand years */
    FILE *file = fopen(late, "wb");
    assert_non_null(file);
    fwrite(p.bytes, 1, p.count, file);
    fclose(file);
    file = fopen(junk, "w");
    assert_non_null(file);
    fputs("no display at all, but long enough", file);
    fclose(file);
    static struct {
        struct child child;
        int status;
        const char *says;
    } wrongs[16];
    int count = 0;
#define WRONG(code, text, ...)                                                                 \
    wrongs[count].child = (struct child){.arguments = {NULL, NULL, "-o", out, __VA_ARGS__}};   \
    wrongs[count].status = code;                                                               \
    wrongs[count++].says = text
    WRONG(2, "a program or a recording", NULL);
    WRONG(2, "--every is for", "--every", "2", cut);
    WRONG(2, "--pictures is for", "--pictures", "2", cut);
    WRONG(2, "a film has 240", "--film", "x.y4m", "--fps", "500", cut);
    WRONG(2, "before the recording", recording("whole", 2, 0), "--every", "2");
    WRONG(1, "no-such-program", "no-such-program", "-h");
    WRONG(1, "recording of displays", junk);
    WRONG(1, "within piece 2", cut);
    WRONG(1, "take a lower --fps", "--frames", scratch_path("frames"), "--fps", "1", late);
    WRONG(1, "CMFB_initialize_display", "true");
    WRONG(1, "signal", "sh", "-c", "kill -9 $$");
    WRONG(1, "not a folder", "--frames", junk, cut);
    WRONG(1, "--window: no display", "--window", cut);
    for (int i = 0; i < count; i++) {
        run(&wrongs[i].child, wrongs[i].status, wrongs[i].says);
        assert_int_not_equal(access(out, F_OK), 0);
    }
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    painter = getenv("PAINTER");
    unsetenv("LUTETIA_DISPLAY");
    if (chdir((scratch_path("."), scratch_dir)) != 0)
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recordings_become_pictures),
        cmocka_unit_test(recordings_become_films),
        cmocka_unit_test(programs_become_pictures),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
