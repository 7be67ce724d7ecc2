/* test_voice.c - `lutetia voice`: pictures and films of a voice, and one clear line for each
 * error. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "child.h"

#include <display.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *lutetia;
static bool reads; /* the build has libsndfile */

static void run(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    child->arguments[1] = "voice";
    if (!child_says(child, status, says, *says != 0))
        fail_msg("exit %d for %d, and it said: %s", child->status, status, child->errors);
}

static void ink_is_in(const char *path, int width, int height)
{
    struct display_image image;
    long dark = 0;
    if (display_png_read_gray(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    for (int i = 0; i < image.width_px * image.height_px; i++)
        dark += image.pixels[i] < 128;
    assert_true(dark > 200);
    if (width)
        assert_true(image.width_px == width && image.height_px == height);
    display_image_destroy(&image);
}

/* The table of a cry, read by hand: its times ascend evenly, it is loud and has a pitch where
 * it cries, and is silent at its end. No picture and no text is wanted. */
static void features_are_a_table(void **state)
{
    (void)state;
    const char *table = scratch_path("cry.csv");
    struct child child = {.arguments = {"", "", "--cry", "--features", table}};
    char line[400];
    double before = -1, step = 0, loudest = 0, pitch = 0;
    int lines = 0, attacks = 0;
    unlink("out.png"); /* another test's, or an earlier run's */
    run(&child, 0, "");
    assert_int_equal(access("out.png", F_OK), -1);
    FILE *file = fopen(table, "rb");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line,
                        "time_s,level,envelope,attack,pitch_hz,clarity,bright,formant_1_hz,"
                        "formant_2_hz\r\n");
    while (fgets(line, sizeof line, file)) {
        double at, level, envelope;
        int attack, used, commas = 0;
        for (const char *c = line; *c; c++)
            commas += *c == ',';
        assert_int_equal(commas, 8);
        assert_int_equal(
            sscanf(line, "%lf,%lf,%lf,%d,%n", &at, &level, &envelope, &attack, &used), 4);
        if (lines > 1)
            assert_true(at - before > 0.98 * step && at - before < 1.02 * step);
        step = at - before;
        before = at;
        lines++;
        attacks += attack;
        if (level > loudest && line[used] != ',') {
            loudest = level;
            pitch = strtod(line + used, NULL);
        }
    }
    fclose(file);
    assert_true(lines > 50 && attacks > 0 && loudest > 0.05 && pitch > 40 && pitch < 2000);
    child =
        (struct child){.arguments = {"", "", "--cry", "Ah", "--features", "/nowhere/x.csv"}};
    run(&child, 1, "/nowhere/x.csv");
    child =
        (struct child){.arguments = {"", "", "--cry", "--features", table, "--still", "s.png"}};
    run(&child, 2, "give a text");
}

static void cry_is_pictures(void **state)
{
    (void)state;
    const char *poster = scratch_path("poster.png"), *sheet = scratch_path("sheet.png"),
               *envelope = scratch_path("envelope.png"), *still = scratch_path("still.png");
    struct child child = {.arguments = {"", "", "--cry", "Aagh!", "-o", poster, "--sheet",
                                        sheet, "--envelope", envelope, "--still", still,
                                        "--picture", "320x180", "--map",
                                        "baseline=pitch,ink=vowel"}};
    run(&child, 0, "");
    ink_is_in(poster, 0, 0);
    ink_is_in(sheet, 0, 0);
    ink_is_in(envelope, 1200, 320);
    ink_is_in(still, 320, 180);
}

static long bytes_of(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? (long)status.st_size : -1;
}

/* Without ffmpeg the film is silent, and a file beside it holds its sound, which is as long as
 * the film. */
static void film_and_its_sound(void **state)
{
    (void)state;
    enum { RATE = 44100, SECONDS_10 = 42, FPS = 10, FRAMES = SECONDS_10 + 1 };
    const char *film = scratch_path("film.y4m"), *sound = scratch_path("film.wav"),
               *again = scratch_path("again.png");
    /* with nothing on the PATH the program writes the film itself */
    struct child child = {.arguments = {"", "", "--cry", "Aagh", "--video", film, "--fps", "10",
                                        "--picture", "64x36"},
                          .variables = {"PATH=/nowhere"}};
    run(&child, 0, "has no sound in it; that is");
    assert_int_equal(bytes_of(sound), 44 + 2 * RATE * SECONDS_10 / 10);
    long frame = 6 + 3 * 64 * 36, bytes = bytes_of(film);
    assert_true(bytes > FRAMES * frame && bytes < FRAMES * frame + 100);
    /* the written sound can be read again and shows the same cry */
    struct child second = {
        .arguments = {"", "", sound, "Aagh", "--still", again, "--picture", "320x180"}};
    run(&second, reads ? 0 : 1, reads ? "" : "this build reads no sounds");
    if (reads)
        ink_is_in(again, 320, 180);
}

/* A transcript's words, and as many pages as their lines need. */
static void transcript_is_pages(void **state)
{
    (void)state;
    const char *film = scratch_path("pages.y4m"), *sound = scratch_path("pages.wav"),
               *cues = scratch_path("pages.srt"), *poster = scratch_path("pages.png"),
               *second = scratch_path("pages-2.png");
    FILE *file = fopen(cues, "w");
    assert_non_null(file);
    fputs("1\n00:00:00,500 --> 00:00:02,000\none two\n\n2\n00:00:02,000 --> "
          "00:00:04,000\nthree\n",
          file);
    fclose(file);
    struct child child = {.arguments = {"", "", "--cry", "Aagh", "--video", film, "--fps", "10",
                                        "--picture", "64x36"},
                          .variables = {"PATH=/nowhere"}};
    run(&child, 0, "has no sound in it; that is");
    unlink(second);
    struct child pages = {.arguments = {"", "", sound, "--transcript", cues, "-o", poster,
                                        "--line", "4000", "--second", "4000", "--size",
                                        "1200,1200", "--map", "size=nothing"}};
    run(&pages, reads ? 0 : 1, reads ? "has " : "this build reads no sounds");
    if (!reads)
        return;
    ink_is_in(poster, 0, 0);
    ink_is_in(second, 0, 0);
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    const char *fifo = scratch_path("fifo"), *text = scratch_path("text.wav"),
               *out = scratch_path("x.png");
    mkfifo(fifo, 0600);
    FILE *file = fopen(text, "w");
    assert_non_null(file);
    fputs("this is no sound", file);
    fclose(file);
    struct {
        const char *words[5];
        int status;
        const char *says;
    } wrong[] = {
        {{"--cry"}, 2, "give a text"},
        {{"only.wav"}, 2, "give a sound and a text"},
        {{"/no/such.wav", "x"}, 1, "No such file"},
        {{fifo, "x"}, 1, "must be a regular file"},
        {{"/dev/null", "x"}, 1, "must be a regular file"},
        {{text, "x"}, 1, "not a sound"},
        {{"--cry", " "}, 2, "the text is empty"},
        {{"--cry", "x", "--map", "size=loud"}, 2, "there are nothing, envelope"},
        {{"--cry", "x", "--map", "weight=pitch"}, 2, "no axis of weight"},
        {{"--cry", "x", "--picture", "33x20"}, 2, "must be even"},
        {{"--cry", "x", "--transcript", text}, 2, "a transcript is of a sound"},
        {{text, "x", "--transcript", text}, 2, "its text is in the transcript"},
        {{text, "--transcript", "/no/such.srt"}, 1, "/no/such.srt: cannot read"},
        {{text, "--transcript", text}, 1, "no cue"},
        {{"--cry", "x", "--size", "9,3"}, 2, "the least and the most"},
        {{"--cry", "x", "--font", "no-such-font"}, 1, "no-such-font"},
        {{"--cry", "x", "--video", "/no/such/film.mp4"}, 1, "/no/such/film"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        bool named = wrong[i].words[1] && wrong[i].words[0][0] == '/';
        if (!reads && (named || wrong[i].words[0] == fifo || wrong[i].words[0] == text))
            continue;
        struct child child = {.arguments = {"", ""}};
        int count = 2;
        for (int k = 0; k < 5 && wrong[i].words[k]; k++)
            child.arguments[count++] = wrong[i].words[k];
        if (count < 8) {
            child.arguments[count++] = "-o";
            child.arguments[count++] = out;
        }
        unlink(out);
        run(&child, wrong[i].status, wrong[i].says);
    }
}

int main(int argc, char **argv)
{
    reads = argc > 1 && strcmp(argv[1], "reads") == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(features_are_a_table), cmocka_unit_test(cry_is_pictures),
        cmocka_unit_test(film_and_its_sound), cmocka_unit_test(transcript_is_pages),
        cmocka_unit_test(what_is_wrong_is_said)};
    lutetia = getenv("LUTETIA");
    if (!lutetia) {
        fputs("set LUTETIA to the command\n", stderr);
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
