/* test_spring.c - `lutetia spring` as a user runs it: pictures in each way of drawing, and its
 * messages. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../display/scratch.h"
#include "../stage/likeness.h"
#include "child.h"

static const char *lutetia, *collision;

static struct child run(const char *const *arguments, int status)
{
    static struct child child;
    child = (struct child){.arguments = {lutetia, "spring"},
                           .variables = {"DISPLAY=", "WAYLAND_DISPLAY="}};
    for (int i = 0; arguments[i]; i++)
        child.arguments[2 + i] = arguments[i];
    child_run(&child);
    if (child.status != status)
        fail_msg("%s ended with %d and said: %s", arguments[0], child.status, child.errors);
    if (status == 0)
        assert_string_equal(child.errors, "");
    return child;
}

#define RUN(status, ...) run((const char *const[]){__VA_ARGS__, NULL}, status)

static void one_line(const struct child *child, const char *part)
{
    const char *end = strchr(child->errors, '\n');
    if (!end || end[1] || !strstr(child->errors, part))
        fail_msg("no single line with \"%s\": %s", part, child->errors);
}

static struct display_image picture(const char *path)
{
    struct display_image image;
    if (display_png_read_rgb(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    return image;
}

/* Without a display the exact picture and those by EGL and OSMesa show the same moment. */
static void stills_agree(void **state)
{
    (void)state;
    static const char *const ways[] = {"exact", "egl", "osmesa"};
    static const uint8_t background[3] = {0xf6, 0xf4, 0xef};
    struct display_image images[3];
    for (int i = 0; i < 3; i++) {
        const char *path = scratch_path("still.png");
        RUN(0, "breakdown", "--preset", "breakdown", "--still", path, "--seconds", "1.3",
            "--size", "400x300", "--set", "shadow=on", "--set", "grid=on", "--way", ways[i]);
        images[i] = picture(path);
        assert_true(images[i].width_px == 400 && images[i].height_px == 300);
    }
    for (int i = 1; i < 3; i++) {
        double alike = likeness(&images[i], &images[0]);
        double weight = ink_weight(&images[i], background) / ink_weight(&images[0], background);
        if (alike < 0.98 || fabs(weight - 1) > 0.02)
            fail_msg("%s: likeness %.4f, weight %.4f", ways[i], alike, weight);
    }
    for (int i = 0; i < 3; i++)
        display_image_destroy(&images[i]);
}

static double moment_weight(const char *set, const char *turn)
{
    static const uint8_t background[3] = {0xf6, 0xf4, 0xef};
    const char *path = scratch_path("moment.png");
    RUN(0, "Jelly", "--preset", "jelly", "--still", path, "--seconds", "0.8", "--size",
        "300x200", "--view", "-1,-0.5,4,3.5", "--turn", turn, "--set", set, "--set",
        "show_springs=off", "--set", "show_masses=off", "--set", "floor_on=off", "--set",
        "gravity=0");
    struct display_image image = picture(path);
    double weight = ink_weight(&image, background);
    display_image_destroy(&image);
    return weight;
}

/* --set reaches the style, which is used to make the word, and the controls of world and stage.
 * A turned word has the same amount of ink. */
static void sets_reach_style_world_and_stage(void **state)
{
    (void)state;
    double plain = moment_weight("collide=on", "0");
    assert_true(plain > 100);
    double turned = moment_weight("box=ink", "20");
    if (fabs(turned / plain - 1) > 0.02)
        fail_msg("%.1f turned for %.1f", turned, plain);
    assert_true(moment_weight("show_letters=off", "0") == 0);
    struct child child = RUN(0, "a", "--preset", "jelly", "--set", "side=77", "--controls");
    assert_non_null(strstr(child.output, "\nside          77 "));
    assert_non_null(strstr(child.output, "\nlink          160 "));
    assert_non_null(strstr(child.output, "\nfriction      0.6 "));
    assert_null(strstr(child.output, "\nbox "));
}

/* A script of clamps moves a word's mass; without it the mass is elsewhere. */
static void scripts_lead_masses(void **state)
{
    (void)state;
    const char *script = scratch_path("lead.clamps"), *end = scratch_path("end.springs");
    const char *still = scratch_path("led.png");
    FILE *file = fopen(script, "w");
    fputs("clamps 1\nkey 3 0 0 3\nkey 3 0.5 2.5 3.75\nend\n", file);
    fclose(file);
    RUN(0, "led", "--script", script, "--still", still, "--save", end, "--seconds", "0.75",
        "--size", "64x64");
    char text[8192] = "";
    file = fopen(end, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    if (!strstr(text, "mass x=2.5 y=3.75 "))
        fail_msg("%s", text);
}

/* A session that moves and tacks a mass and changes gravity is replayed into a film. Saved
 * again it is the same text, but for what it began with. */
static void sessions_are_replayed(void **state)
{
    (void)state;
    const char *session = scratch_path("play.session"), *end = scratch_path("played.springs");
    const char *still = scratch_path("played.png"), *again = scratch_path("again.session");
    static const char played[] =
        "session 1\n4 mark\n4 hand down 0 3.5 0.25 0 0 1\n"
        "9 hand move -1.5 3 0.25 0 0 1\n20 hand up -1.5 3.25 0.25 0 0 1\n"
        "30 set gravity 2.5\nend 120\n";
    char text[8192] = "";
    FILE *file = fopen(session, "w");
    fputs(played, file);
    fclose(file);
    RUN(0, "--network", collision, "--replay", session, "--session", again, "--save", end,
        "--still", still, "--seconds", "0.5", "--size", "64x64");
    file = fopen(end, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    if (!strstr(text, "mass x=-1.5 y=3.25 ") || !strstr(text, " stuck") ||
        !strstr(text, "control gravity 2.5"))
        fail_msg("%s", text);
    memset(text, 0, sizeof text);
    file = fopen(again, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    char *begin = strstr(text, "begin "), *rest = begin ? strchr(begin, '\n') : NULL;
    assert_non_null(rest);
    memmove(begin, rest + 1, strlen(rest + 1) + 1);
    assert_string_equal(text, played);
}

static void text_put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* 30 steps at the usual rate and 90 at half of it are 0.875 s, and a second more is filmed. */
static void films_end_with_their_session(void **state)
{
    (void)state;
    char last[320], after[320], folder[300];
    const char *session = scratch_path("slow.session");
    text_put(session, "session 1\n30 set rate 0.5\nend 120\n");
    snprintf(folder, sizeof folder, "%s", scratch_path("slow"));
    RUN(0, "--network", collision, "--replay", session, "--frames", folder, "--fps", "8",
        "--size", "32x32");
    snprintf(last, sizeof last, "%s/frame-000015.png", folder);
    snprintf(after, sizeof after, "%s/frame-000016.png", folder);
    assert_int_equal(access(last, F_OK), 0);
    assert_int_equal(access(after, F_OK), -1);
    text_put(session, "session 1\nend 1000000\n");
    const struct child child = RUN(1, "--network", collision, "--replay", session, "--still",
                                   scratch_path("never.png"), "--size", "32x32");
    one_line(&child, "--seconds S");
}

/* Pixels of dots that are drawn alone, as a part of the picture's. */
static double dots_part(bool word, const char *size)
{
    const char *still = scratch_path("dots.png");
    RUN(0, word ? "--theme" : "--network", word ? "light" : collision, "--seconds", "0",
        "--still", still, "--size", size, "--set", "show_springs=off", "--set",
        "show_letters=off", "--set", "show_masses=on", "--set", "floor_on=off",
        word ? "a paragraph" : NULL);
    struct display_image image = picture(still);
    double dots = 0;
    const int pixels = image.width_px * image.height_px;
    for (int i = 0; i < pixels; i++)
        dots += (0xf6 - image.pixels[3 * i]) / 177.0;
    display_image_destroy(&image);
    return dots / pixels;
}

/* Dots keep their size beside a picture that is larger than usual, and beside letters that are
 * smaller. */
static void dots_grow_with_pictures(void **state)
{
    (void)state;
    static const char *const sizes[2][2] = {{"720x720", "1440x1440"}, {"96x96", "192x192"}};
    for (int k = 0; k < 2; k++) {
        const double part[2] = {dots_part(k, sizes[k][0]), dots_part(k, sizes[k][1])};
        if (!(part[0] > 1e-4 && fabs(part[1] / part[0] - 1) < 0.2)) /* edges are no light */
            fail_msg("%s: %g and %g of the picture", sizes[k][0], part[0], part[1]);
    }
}

/* Without a background a picture over white is the picture on white; one that is half there is
 * half seen. */
static void backgrounds_may_be_clear(void **state)
{
    (void)state;
    const char *theme = scratch_path("clear.theme");
    char stills[3][300];
    struct display_image images[3];
    static const char *const backgrounds[3] = {
        "background = #ffffff\n", "background = #00000000\n", "background = #0000ff80\n"};
    for (int i = 0; i < 3; i++) {
        uint8_t head[26];
        char name[30];
        snprintf(name, sizeof name, "clear%d.png", i);
        snprintf(stills[i], sizeof stills[i], "%s", scratch_path(name));
        text_put(theme, backgrounds[i]);
        RUN(0, "ab", "--theme", theme, "--still", stills[i], "--seconds", "0.3", "--size",
            "240x160");
        FILE *file = fopen(stills[i], "rb");
        assert_non_null(file);
        assert_int_equal(fread(head, 1, sizeof head, file), sizeof head);
        fclose(file);
        assert_int_equal(head[25], i ? 6 : 2); /* PNG's types: with alpha, without */
        images[i] = picture(stills[i]);
    }
    const double alike = likeness(&images[0], &images[1]);
    if (alike < 0.98)
        fail_msg("likeness %.4f", alike);
    const uint8_t *corner = images[2].pixels;
    assert_true(corner[2] == 255 && corner[0] > 110 && corner[0] < 200);
    for (int i = 0; i < 3; i++)
        display_image_destroy(&images[i]);
}

/* The lowest mass of a file of springs. */
static double lowest(const char *path)
{
    double least = INFINITY, y;
    char line[4096];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        const char *at = strncmp(line, "mass ", 5) == 0 ? strstr(line, " y=") : NULL;
        if (at && sscanf(at, " y=%lf", &y) == 1)
            least = fmin(least, y);
    }
    fclose(file);
    return least;
}

/* Whatever its length, what hangs does not reach the floor, nor the picture's left and
 * right. */
static void presets_are_for_any_word(void **state)
{
    (void)state;
    static const char *const presets[] = {"pendulum", "heavy", "curtain"};
    static const char *const words[] = {"a", "long", "a longer word",
                                        "Longer still than all others"};
    static const char *const moments[] = {"0.8", "2.1"};
    for (int p = 0; p < 3; p++)
        for (int w = 0; w < 4; w++)
            for (int m = 0; m < 2; m++) {
                const char *save = scratch_path("hangs.springs"),
                           *still = scratch_path("hangs.png");
                RUN(0, words[w], "--preset", presets[p], "--seconds", moments[m], "--save",
                    save, "--still", still, "--size", "160x120");
                if (!(lowest(save) > 0.3))
                    fail_msg("%s, %s: %g above the floor", presets[p], words[w], lowest(save));
                struct display_image image = picture(still);
                int dark = 0;
                for (int y = 0; y < image.height_px; y++)
                    for (int x = 0; x < image.width_px; x += image.width_px - 1)
                        dark += image.pixels[3 * (y * image.width_px + x)] < 0xe0;
                display_image_destroy(&image);
                if (dark > 6) /* the floor's line */
                    fail_msg("%s, %s: %d pixels at the edges", presets[p], words[w], dark);
            }
    const struct child on = RUN(0, "word", "--preset", "breakdown", "--controls");
    const char *row = strstr(on.output, "\ncollide ");
    assert_non_null(row);
    assert_int_equal(strcspn(row + 9, "n") - strcspn(row + 9, "o"), 1); /* "on" */
}

/* Counts the blue pixels, ink on paper, in rows y0 to y1. */
static int blue_count(const struct display_image *image, int y0, int y1)
{
    int count = 0;
    for (int y = y0; y < y1; y++)
        for (int x = 0; x < image->width_px; x++) {
            const uint8_t *p = image->pixels + 3 * (y * image->width_px + x);
            count += p[2] > p[0] + 12;
        }
    return count;
}

/* A word that has fallen lies on the sheet in black and has left wet tracks. Another pigment
 * gives them another colour. */
static void letters_leave_wet_tracks(void **state)
{
    (void)state;
    const char *path = scratch_path("wet.png");
    struct display_image images[2];
    for (int i = 0; i < 2; i++) {
        RUN(0, "wet", "--wet", "--still", path, "--at", "0,2", "--seconds", "0.9", "--fps",
            "10", "--size", "128x128", "--view", "-0.5,-0.3,2.7,2.9", "--pigment",
            i ? "cadmium red" : "french ultramarine");
        images[i] = picture(path);
    }
    int black = 0;
    for (int i = 0; i < 3 * 128 * 128; i += 3)
        black += images[0].pixels[i] + images[0].pixels[i + 1] + images[0].pixels[i + 2] < 60;
    assert_true(black > 200);
    assert_true(blue_count(&images[0], 0, 50) > 100); /* the tracks' beginning */
    assert_int_equal(blue_count(&images[1], 0, 50), 0);
    for (int i = 0; i < 2; i++)
        display_image_destroy(&images[i]);
    struct child wrong = RUN(2, "wet", "--wet", "--still", path, "--pigment", "octarine");
    one_line(&wrong, "octarine");
    wrong = RUN(2, "wet", "--wet");
    one_line(&wrong, "--wet goes with --still");
}

/* Without gravity a word prints again and again in the same place; that saturates the paper and
 * does not flood it. */
static void still_letters_do_not_flood(void **state)
{
    (void)state;
    static const char *const seconds[] = {"1", "3"};
    const char *path = scratch_path("still.png");
    long blue[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        RUN(0, "wet", "--wet", "--still", path, "--at", "0,1", "--seconds", seconds[i], "--fps",
            "10", "--size", "128x128", "--view", "-0.5,-0.3,2.7,2.9", "--set", "gravity=0");
        struct display_image image = picture(path);
        for (int k = 0; k < 3 * 128 * 128; k += 3)
            blue[i] += image.pixels[k + 2] > image.pixels[k] + 12
                           ? image.pixels[k + 2] - image.pixels[k]
                           : 0;
        display_image_destroy(&image);
    }
    assert_true(blue[0] > 5000);
    assert_true(blue[1] < 2 * blue[0]); /* what is there spreads */
}

static void lacking_glyphs_are_named(void **state)
{
    (void)state;
    struct child child = {.arguments = {lutetia, "spring", "a\xf3\xb0\x80\x80", "--still",
                                        scratch_path("lacking.png"), "--seconds", "0.1",
                                        "--size", "64x64"},
                          .variables = {"DISPLAY=", "WAYLAND_DISPLAY="}};
    child_run(&child);
    assert_int_equal(child.status, 0);
    one_line(&child, "no font has a glyph for U+F0000");
}

/* One run gives a folder, a film, a strip and a still. The still is the last picture of all of
 * them. */
static void films_stills_and_strips_are_of_one_run(void **state)
{
    (void)state;
    const char *folder = scratch_path("frames"), *still = scratch_path("last.png");
    const char *strip = scratch_path("strip.png"), *video = scratch_path("film.y4m");
    char path[600];
    RUN(0, "--network", collision, "--frames", folder, "--still", still, "--video", video,
        "--seconds", "0.5", "--fps", "10", "--size", "120x90");
    RUN(0, "--network", collision, "--still", strip, "--strip", "3x2", "--seconds", "0.5",
        "--fps", "10", "--size", "360x180");
    struct display_image last = picture(still), all = picture(strip);
    assert_true(all.width_px == 360 && all.height_px == 180);
    for (int i = 0; i < 6; i++) {
        snprintf(path, sizeof path, "%s/frame-%06d.png", folder, i);
        struct display_image frame = picture(path);
        for (int y = 0; y < 90; y++)
            assert_memory_equal(frame.pixels + 3 * 120 * y,
                                all.pixels + 3 * (360 * (y + 90 * (i / 3)) + 120 * (i % 3)),
                                3 * 120);
        if (i == 5)
            assert_memory_equal(frame.pixels, last.pixels, 3 * 120 * 90);
        display_image_destroy(&frame);
    }
    snprintf(path, sizeof path, "%s/frame-000006.png", folder);
    assert_int_not_equal(access(path, F_OK), 0);
    FILE *film = fopen(video, "rb");
    assert_non_null(film);
    fseek(film, 0, SEEK_END);
    assert_true(ftell(film) > 6 * 120 * 90 * 3 / 2);
    fclose(film);
    display_image_destroy(&last);
    display_image_destroy(&all);
}

/* A saved run that is continued gives the bits of one long run. */
static void runs_are_saved_and_gone_on_with(void **state)
{
    (void)state;
    const char *half = scratch_path("half.springs"), *whole = scratch_path("whole.springs");
    const char *both = scratch_path("both.springs"), *still = scratch_path("still.png");
    RUN(0, "--network", collision, "--still", still, "--save", half, "--seconds", "0.5",
        "--size", "32x32");
    RUN(0, "--network", half, "--still", still, "--save", both, "--seconds", "0.5", "--size",
        "32x32");
    RUN(0, "--network", collision, "--still", still, "--save", whole, "--seconds", "1",
        "--size", "32x32");
    char texts[2][8192] = {"", ""};
    const char *paths[2] = {both, whole};
    for (int i = 0; i < 2; i++) {
        FILE *file = fopen(paths[i], "rb");
        assert_non_null(file);
        size_t count = fread(texts[i], 1, sizeof texts[i] - 1, file);
        assert_true(count > 100);
        fclose(file);
    }
    assert_string_equal(texts[0], texts[1]);
}

static void controls_are_listed(void **state)
{
    (void)state;
    struct child child = RUN(0, "--network", collision, "--set", "gravity=3.25", "-s",
                             "integrator=verlet", "--controls");
    assert_non_null(strstr(child.output, "\ngravity       3.25        -100..100 units/s2"));
    assert_non_null(
        strstr(child.output, "\nintegrator    verlet      symplectic verlet thesis"));
    RUN(0, "--help");
}

static void what_is_wrong_is_said_in_a_line(void **state)
{
    (void)state;
    const char *bad = scratch_path("bad.springs"), *still = scratch_path("none.png"),
               *others = scratch_path("others.clamps");
    FILE *file = fopen(bad, "w");
    fputs("springs 1\nmass x=0 y=1\nspring 0 0\nend\n", file);
    fclose(file);
    file = fopen(others, "w");
    fputs("clamps 1\nkey 7 100 0 0\nend\n",
          file); /* a mass there is not, long after the film */
    fclose(file);
    const struct {
        const char *arguments[8];
        int status;
        const char *said;
    } wrong[] = {
        {{"--still", still}, 2, "a word, or --network FILE"},
        {{"a", "b"}, 2, "in quotes"},
        {{"--network", collision},
         1,
         "no display: neither DISPLAY nor WAYLAND_DISPLAY is set; run it"},
        {{"--network", "/no/such", "--still", still}, 1, "/no/such: "},
        {{"--network", bad, "--still", still}, 1, "bad.springs:3: "},
        {{"--network", collision, "--still", still, "--set", "gravita=3"},
         2,
         "there is no control 'gravita'; there are rate,"},
        {{"--network", collision, "--still", still, "--set", "gravity=1e9"},
         2,
         "gravity must be -100..100"},
        {{"--network", collision, "--still", still, "--theme", "/no/theme"}, 1, "/no/theme: "},
        {{"--network", collision, "--still", still, "--way", "cuda"},
         2,
         "--way must be exact, egl or osmesa"},
        {{"--network", collision, "--still", "/no/folder/a.png"}, 1, "/no/folder/a.png"},
        {{"--network", collision, "--video", still, "--size", "33x32"}, 2, "even sides"},
        {{"--network", collision, "--still", still, "--view", "1,0,0,1"}, 2, "X0 < X1"},
        {{"--network", collision, "--still", still, "--view", "0,0,0,0"}, 2, "X0 < X1"},
        {{"a", "--still", still, "--script", others},
         1,
         "others.clamps: there is no mass 7 (of 4)"},
        {{"a", "--still", still, "--param", "a=b"}, 2, "--param is for a --map"},
        {{"a", "--still", still, "--every", "1"}, 2, "are for --wet"},
        {{"--network", collision, "--strip", "2x2"}, 2, "--strip is for a --still"},
        {{"--network", collision, "--still", still, "--filter", "soft"}, 1, "soft"},
        {{"a", "--network", collision, "--still", still}, 2, "not both"},
        {{"a", "--still", still, "--font", "NoSuchFont-Ever.ttf"}, 1, "NoSuchFont-Ever"},
        {{"a", "--still", still, "--preset", "marble"},
         2,
         "there is no preset 'marble'; there are"},
        {{"--network", collision, "--still", still, "--preset", "jelly"},
         2,
         "--preset is for a word"},
        {{" ", "--still", still}, 2, "ink"},
        {{"a", "--still", still, "--set", "box=round"}, 2, "box"},
        {{"a", "--still", still, "--script", bad}, 1, "bad.springs:1: "},
        {{"a", "--still", still, "--replay", bad}, 1, "bad.springs:1: must be `session 1`"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct child child = run(wrong[i].arguments, wrong[i].status);
        one_line(&child, wrong[i].said);
        assert_int_not_equal(access(still, F_OK), 0);
    }
}

/* Where EGL finds no driver there is a message, and OSMesa draws without one. */
static void without_egl_osmesa_draws(void **state)
{
    (void)state;
    for (int osmesa = 0; osmesa < 2; osmesa++) {
        static struct child child;
        const char *still = scratch_path("alone.png");
        child = (struct child){.arguments = {lutetia, "spring", "--network", collision,
                                             "--still", still, "--seconds", "0.1", "--size",
                                             "64x48", "--way", osmesa ? "osmesa" : "egl"},
                               .variables = {"DISPLAY=", "__EGL_VENDOR_LIBRARY_DIRS=/no/folder",
                                             "LIBGL_DRIVERS_PATH=/no/folder"}};
        child_run(&child);
        assert_int_equal(child.status, osmesa ? 0 : 1);
        if (!osmesa)
            one_line(&child, "no OpenGL");
    }
}

/* After Ctrl-C there is a whole film up to that moment, and no other file. */
static void films_are_interrupted(void **state)
{
    (void)state;
    static struct child child;
    const char *film = scratch_path("long.y4m");
    child = (struct child){.arguments = {lutetia, "spring", "--network", collision, "--video",
                                         film, "--seconds", "3000", "--size", "64x48"},
                           .interrupt_after_ms = 300};
    child_run(&child);
    assert_int_equal(child.status, 130);
    one_line(&child, "interrupted");
    assert_int_equal(access(film, F_OK), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stills_agree),
        cmocka_unit_test(films_stills_and_strips_are_of_one_run),
        cmocka_unit_test(runs_are_saved_and_gone_on_with),
        cmocka_unit_test(sets_reach_style_world_and_stage),
        cmocka_unit_test(scripts_lead_masses),
        cmocka_unit_test(sessions_are_replayed),
        cmocka_unit_test(films_end_with_their_session),
        cmocka_unit_test(presets_are_for_any_word),
        cmocka_unit_test(dots_grow_with_pictures),
        cmocka_unit_test(backgrounds_may_be_clear),
        cmocka_unit_test(controls_are_listed),
        cmocka_unit_test(letters_leave_wet_tracks),
        cmocka_unit_test(still_letters_do_not_flood),
        cmocka_unit_test(lacking_glyphs_are_named),
        cmocka_unit_test(what_is_wrong_is_said_in_a_line),
        cmocka_unit_test(without_egl_osmesa_draws),
        cmocka_unit_test(films_are_interrupted),
    };
    lutetia = getenv("LUTETIA");
    collision = getenv("SPRINGS_NETWORK");
    if (!lutetia || !collision)
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
