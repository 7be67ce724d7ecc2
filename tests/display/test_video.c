/* test_video.c - videos: their contents, and encoders that fail, are killed or are missing. A
 * script of the test plays ffmpeg. (security.md 14) */
#include "scratch.h"

#include <display.h>
#include <video.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "../skip.h"

enum { WIDTH = 6, HEIGHT = 4, COUNT = WIDTH * HEIGHT, FRAME = 6 + 3 * COUNT };

static void check(enum display_status status)
{
    if (status != DISPLAY_OK)
        fail_msg("status %d: %s", (int)status, display_error());
}

/* What the script that plays ffmpeg does when the film is read back: a line for each
 * picture. */
static const char lines_all[] =
    "/bin/grep -ao FRAME /proc/self/fd/3 | /bin/sed 's/.*/0, 0/'; echo '1, 0'";
static const char *read_back = lines_all;

/* Sets a PATH that holds only this script as ffmpeg (NULL: nothing). Its last argument is the
 * file. */
static void encoder_put(const char *script)
{
    static char folder[600];
    char path[700];
    snprintf(folder, sizeof folder, "%s", scratch_path("bin"));
    mkdir(folder, 0700);
    snprintf(path, sizeof path, "%s/ffmpeg", folder);
    unlink(path);
    if (script) {
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "#!/bin/sh\ncase \"$*\" in *framecrc*) %s; exit ;; esac\n"
                "for file; do :; done\n%s\n",
                read_back, script);
        fclose(file);
        chmod(path, 0700);
    }
    setenv("PATH", folder, 1);
}

static uint8_t *file_read(const char *path, size_t *count)
{
    static uint8_t bytes[1 << 16];
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    *count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return bytes;
}

static void pictures_are_in_it(void **state)
{
    (void)state;
    static const char header[] = "YUV4MPEG2 W6 H4 F25:1 Ip A1:1 C444\n";
    char path[512];
    struct video *video;
    uint8_t rgb[3 * COUNT];
    size_t count;
    snprintf(path, sizeof path, "%s", scratch_path("film.y4m"));
    check(video_create(path, WIDTH, HEIGHT, 25, &video));
    for (int frame = 0; frame < 3; frame++) {
        for (int i = 0; i < COUNT; i++)
            for (int c = 0; c < 3; c++)
                rgb[3 * i + c] = frame == 0 ? 255 : frame == 1 ? 0 : c == 0 ? 255 : 0;
        check(video_add(video, rgb));
    }
    assert_int_equal(access(path, F_OK), -1); /* not before it is whole */
    assert_int_equal(video_frames(video), 3);
    check(video_finish(video));
    const uint8_t *bytes = file_read(path, &count);
    assert_non_null(bytes);
    assert_int_equal(count, strlen(header) + 3 * FRAME);
    assert_memory_equal(bytes, header, strlen(header));
    /* white, black, red by BT.709 */
    static const uint8_t colors[3][3] = {{235, 128, 128}, {16, 128, 128}, {63, 102, 240}};
    for (int frame = 0; frame < 3; frame++) {
        const uint8_t *at = bytes + strlen(header) + frame * FRAME;
        assert_memory_equal(at, "FRAME\n", 6);
        for (int plane = 0; plane < 3; plane++)
            for (int i = 0; i < COUNT; i++)
                assert_int_equal(at[6 + plane * COUNT + i], colors[frame][plane]);
    }
}

static void without_an_encoder_it_is_a_y4m(void **state)
{
    (void)state;
    char path[512];
    struct video *video;
    uint8_t rgb[3 * COUNT] = {0};
    encoder_put(NULL);
    snprintf(path, sizeof path, "%s", scratch_path("other.mp4"));
    check(video_create(path, WIDTH, HEIGHT, 25, &video));
    assert_non_null(strstr(video_path(video), "/other.y4m"));
    check(video_add(video, rgb));
    check(video_finish(video));
    assert_int_equal(access(scratch_path("other.y4m"), F_OK), 0);
    assert_int_equal(access(scratch_path("other.mp4"), F_OK), -1);
    /* an abandoned or empty video leaves no file */
    check(video_create(path, WIDTH, HEIGHT, 25, &video));
    check(video_finish(video));
    int files = scratch_count();
    check(video_create(path, WIDTH, HEIGHT, 25, &video));
    check(video_add(video, rgb));
    video_abandon(video);
    assert_int_equal(scratch_count(), files);
}

static void an_encoder_gets_all_of_it(void **state)
{
    (void)state;
    char path[512];
    struct video *video;
    uint8_t rgb[3 * COUNT] = {0};
    size_t count;
    encoder_put("exec /bin/cat >\"$file\"");
    snprintf(path, sizeof path, "%s", scratch_path("film.mp4"));
    check(video_create(path, WIDTH, HEIGHT, 25, &video));
    for (int i = 0; i < 40; i++)
        check(video_add(video, rgb));
    check(video_finish(video));
    assert_non_null(file_read(path, &count));
    assert_int_equal(count, 35 + 40 * FRAME);
}

/* Adds pictures until the encoder fails, or finishes the film. Returns the error's message. */
static const char *film_fail(const char *script)
{
    char path[512];
    struct video *video;
    static uint8_t rgb[3 * 512 * 512];
    encoder_put(script);
    snprintf(path, sizeof path, "%s", scratch_path("fails.mp4"));
    int files = scratch_count();
    enum display_status status = video_create(path, 512, 512, 25, &video);
    if (status == DISPLAY_OK) {
        for (int i = 0; i < 20 && status == DISPLAY_OK; i++)
            status = video_add(video, rgb);
        if (status == DISPLAY_OK)
            status = video_finish(video);
        else
            video_abandon(video);
    }
    assert_int_equal(status, DISPLAY_IO_FAILED);
    assert_int_equal(scratch_count(), files); /* nothing is left */
    assert_null(strchr(display_error(), '\n'));
    return display_error();
}

static void encoders_that_fail_are_reported(void **state)
{
    (void)state;
    assert_non_null(
        strstr(film_fail("echo 'Unknown encoder: x' >&2; exit 1"), "Unknown encoder: x"));
    assert_non_null(strstr(film_fail("kill -9 $$"), "signal 9"));
    assert_non_null(strstr(film_fail("/bin/cat >/dev/null; echo late >&2; exit 3"), "late"));
    assert_non_null(strstr(film_fail("exit 4"), "status 4"));
    assert_non_null(strstr(film_fail("exec /no/such/program"), "ffmpeg"));
}

/* An encoder that ends well is no proof: a film without its end, its index or its pictures does
 * not take the old one's place. */
static void films_are_read_back(void **state)
{
    (void)state;
    static const char encodes[] = "exec /bin/cat >\"$file\"";
    static const struct {
        const char *read_back, *says;
    } rows[] = {{"echo '0, 0'", "1 pictures of 20"},
                {"exit 0", "0 pictures of 20"},
                {"echo '#tb 0: 1/25'; echo 'moov atom not found' >&2; exit 1", "moov atom"},
                {"/bin/seq -f '0, %g' 20; echo 'File ended prematurely' >&2", "prematurely"},
                {"/bin/seq -f '0, %g' 20; exit 3", "cannot be read back"},
                {"kill -9 $$", "cannot be read back"}};
    FILE *old = fopen(scratch_path("fails.mp4"), "w");
    assert_non_null(old);
    fputs("old", old);
    fclose(old);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        read_back = rows[i].read_back;
        const char *said = film_fail(encodes);
        if (!strstr(said, rows[i].says))
            fail_msg("%s: %s", rows[i].read_back, said);
        size_t count;
        const uint8_t *bytes = file_read(scratch_path("fails.mp4"), &count);
        assert_true(bytes && count == 3 && memcmp(bytes, "old", 3) == 0);
    }
    read_back = lines_all;
    unlink(scratch_path("fails.mp4"));
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    struct video *video;
    static const int wrong[][3] = {
        {3, 4, 25}, {4, 0, 25}, {4, 4, 0}, {4, 4, 241}, {20000, 4, 25}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(
            video_create(scratch_path("x.y4m"), wrong[i][0], wrong[i][1], wrong[i][2], &video),
            DISPLAY_BAD_ARGUMENT);
        assert_null(video);
    }
    assert_int_equal(video_create("/no/such/x.y4m", 4, 4, 25, &video), DISPLAY_IO_FAILED);
    assert_int_equal(video_create("/no/such/x.mp4", 4, 4, 25, &video), DISPLAY_IO_FAILED);
}

/* The encoder reads the sound from its own file, from the beginning. A format without sound
 * gets none. */
static void sound_goes_to_the_encoder(void **state)
{
    (void)state;
    static const char wav[] = "RIFF as a whole";
    struct video *video;
    char path[600], script[700], got[32] = "";
    snprintf(path, sizeof path, "%s", scratch_path("sound.mkv"));
    const char *heard = scratch_path("heard");
    FILE *sound = tmpfile();
    assert_non_null(sound);
    fputs(wav, sound);
    fflush(sound); /* at its end, yet the encoder reads all of it */
    snprintf(script, sizeof script,
             "case \"$*\" in *\"-f wav -i /proc/self/fd/4\"*) cat /proc/self/fd/4 >%s ;; esac\n"
             "cat >\"$file\"",
             heard);
    for (int silent = 0; silent < 2; silent++) {
        unlink(heard);
        encoder_put(script);
        char *path_before = strdup(getenv("PATH"));
        char both[1400];
        snprintf(both, sizeof both, "%s:/usr/bin:/bin", path_before);
        setenv("PATH", both, 1);
        free(path_before);
        if (silent) {
            snprintf(path, sizeof path, "%s", scratch_path("sound.gif"));
            /* a .gif's pictures go as they are, without a word between them */
            read_back = "echo '0, 0'";
            encoder_put(script);
            setenv("PATH", both, 1);
        }
        check(video_create_with_sound(path, WIDTH, HEIGHT, 25, fileno(sound), &video));
        assert_int_equal(video_sounds(video), !silent);
        uint8_t rgb[3 * COUNT] = {0};
        check(video_add(video, rgb));
        check(video_finish(video));
        FILE *file = fopen(heard, "r");
        assert_int_equal(file != NULL, !silent);
        if (file) {
            assert_non_null(fgets(got, sizeof got, file));
            assert_string_equal(got, wav);
            fclose(file);
        }
    }
    read_back = lines_all;
    fclose(sound);
}

/* ---- with ffmpeg itself ---- */

enum { BROAD = 64, TALL = 48, PIXELS = BROAD * TALL, MOMENTS = 4 };

static struct video_def film_def(const char *path)
{
    return (struct video_def){
        .path = path, .width_px = BROAD, .height_px = TALL, .fps = 25, .sound = -1};
}

static char *path_usual;

/* Reads the film by ffmpeg's own decoder; the pictures have 3 or 4 channels. */
static void film_decode(const char *film, const char *decoder, int channels, uint8_t *pixels)
{
    char command[900];
    setenv("PATH", path_usual, 1);
    snprintf(command, sizeof command,
             "ffmpeg -v error %s -i '%s' -vf scale=in_color_matrix=bt709 -f rawvideo -pix_fmt "
             "%s - 2>&1",
             decoder, film, channels == 4 ? "rgba" : "rgb24");
    const size_t all = (size_t)(MOMENTS * PIXELS * channels);
    FILE *out = popen(command, "r");
    assert_non_null(out);
    const size_t count = fread(pixels, 1, all, out);
    const bool over = fgetc(out) == EOF;
    if (pclose(out) != 0 || count != all || !over)
        fail_msg("%s: %zu bytes of %zu: %.*s", film, count, all, count < 300 ? (int)count : 0,
                 (const char *)pixels);
}

static void ffmpeg_wanted(void)
{
    setenv("PATH", path_usual, 1);
    if (system("ffmpeg -version >/dev/null 2>&1") != 0)
        skip_because("ffmpeg is not installed");
}

/* Each picture has 200 colours of its own, which 256 for all films do not have. */
static void palettes_are_those_of_pictures(void **state)
{
    (void)state;
    static uint8_t rgb[MOMENTS][3 * PIXELS], got[sizeof rgb];
    char path[512];
    struct video *video;
    ffmpeg_wanted();
    snprintf(path, sizeof path, "%s", scratch_path("colours.gif"));
    check(video_create(path, BROAD, TALL, 25, &video));
    for (int m = 0; m < MOMENTS; m++) {
        for (int i = 0; i < PIXELS; i++) {
            const unsigned any = (unsigned)(i % 200 + 200 * m) * 2654435761u;
            for (int c = 0; c < 3; c++)
                rgb[m][3 * i + c] = (uint8_t)(any >> (8 * c + 5));
        }
        check(video_add(video, rgb[m]));
    }
    check(video_finish(video));
    film_decode(path, "", 3, got);
    int most = 0;
    for (size_t i = 0; i < sizeof rgb; i++) {
        const int off = abs(got[i] - ((const uint8_t *)rgb)[i]);
        most = off > most ? off : most;
    }
    assert_in_range(most, 0, 4);
}

/* Films by the formats that have it keep alpha: bands of a colour, clear, half and opaque. */
static void alpha_is_kept(void **state)
{
    (void)state;
    static const struct {
        const char *ending, *decoder;
        int alpha_off, color_off; /* at most, beside the bands' edges */
        bool clear_or_not;
    } films[] = {{"mkv", "", 0, 0, false},
                 {"mov", "", 2, 6, false},
                 {"webm", "-c:v libvpx-vp9", 4, 10, false},
                 {"gif", "", 0, 4, true}};
    static const uint8_t alphas[4] = {0, 200, 255, 90};
    static const uint8_t colors[4][3] = {
        {255, 40, 30}, {20, 60, 200}, {250, 250, 240}, {30, 160, 70}};
    static uint8_t rgba[4 * PIXELS], got[MOMENTS][4 * PIXELS];
    ffmpeg_wanted();
    assert_false(video_alpha("x.mp4") || video_alpha("x.y4m") || video_alpha("x.avi"));
    for (int i = 0; i < PIXELS; i++) {
        memcpy(rgba + 4 * i, colors[i / BROAD / 12], 3);
        rgba[4 * i + 3] = alphas[i % BROAD / 16];
    }
    for (size_t f = 0; f < sizeof films / sizeof *films; f++) {
        char path[512], name[32];
        struct video *video;
        snprintf(name, sizeof name, "clear.%s", films[f].ending);
        snprintf(path, sizeof path, "%s", scratch_path(name));
        assert_true(video_alpha(path));
        struct video_def def = film_def(path);
        def.alpha = true;
        check(video_create_as(&def, &video));
        for (int m = 0; m < MOMENTS; m++)
            check(video_add(video, rgba));
        check(video_finish(video));
        film_decode(path, films[f].decoder, 4, (uint8_t *)got);
        for (int i = 0; i < PIXELS; i++) {
            const int x = i % BROAD % 16, y = i / BROAD % 12, given = rgba[4 * i + 3];
            if (x < 4 || x > 11 || y < 4 || y > 7)
                continue;
            const uint8_t *at = got[MOMENTS - 1] + 4 * i;
            const int wanted = films[f].clear_or_not ? (given >= 128) * 255 : given;
            bool wrong = abs(at[3] - wanted) > films[f].alpha_off;
            for (int c = 0; c < 3; c++)
                wrong |= given == 255 && abs(at[c] - rgba[4 * i + c]) > films[f].color_off;
            if (wrong)
                fail_msg("%s at %d: %d %d %d %d for %d %d %d %d", films[f].ending, i, at[0],
                         at[1], at[2], at[3], rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2],
                         given);
        }
    }
}

/* A second of a tone, as FluidSynth would write it. */
static FILE *tone_make(void)
{
    enum { RATE = 8000 };
    static const uint8_t head[44] =
        "RIFF\x24\x7d\0\0WAVEfmt "
        "\x10\0\0\0\1\0\2\0\x40\x1f\0\0\0\x7d\0\0\4\0\x10\0data\0\x7d\0";
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite(head, 1, sizeof head, file), sizeof head);
    for (int i = 0; i < 2 * RATE; i++) {
        const int16_t sample = (int16_t)(i / 2 % 20 < 10 ? 8000 : -8000);
        assert_int_equal(fwrite(&sample, 2, 1, file), 1);
    }
    fflush(file);
    return file;
}

/* Whether the film has a second of sound that is no silence. */
static bool film_sounds(const char *film)
{
    char command[900];
    static int16_t samples[20000];
    snprintf(command, sizeof command,
             "ffmpeg -v quiet -i '%s' -map 0:a -ac 1 -ar 8000 -f s16le - 2>/dev/null", film);
    FILE *out = popen(command, "r");
    assert_non_null(out);
    const size_t count = fread(samples, 2, sizeof samples / 2, out);
    pclose(out);
    double power = 0;
    for (size_t i = 0; i < count; i++)
        power += (double)samples[i] * samples[i];
    return count > 7500 && count < 9500 && power / (double)count > 1e6;
}

/* Sound that is known at the end is put to pictures that were encoded before. */
static void sound_may_come_later(void **state)
{
    (void)state;
    static const char *const names[] = {"later.mp4", "later.mkv", "later.webm", "later.gif"};
    static uint8_t rgb[3 * PIXELS];
    FILE *tone = tone_make();
    ffmpeg_wanted();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (int silent = 0; silent < 2; silent++) {
            char path[512];
            struct video *video;
            snprintf(path, sizeof path, "%s", scratch_path(names[i]));
            const int files = scratch_count() - (access(path, F_OK) == 0);
            struct video_def def = film_def(path);
            def.sounds_later = true;
            check(video_create_as(&def, &video));
            for (int m = 0; m < 25; m++) {
                memset(rgb, 10 * m, sizeof rgb);
                check(video_add(video, rgb));
            }
            check(video_finish_with_sound(video, silent ? -1 : fileno(tone)));
            assert_int_equal(scratch_count(), files + 1);
            if (film_sounds(path) != (!silent && i != 3))
                fail_msg("%s %s", names[i], silent ? "sounds" : "is silent");
        }
    fclose(tone);
}

/* Alpha that a film does not hold is refused. */
static void alpha_needs_a_format(void **state)
{
    (void)state;
    struct video *video;
    encoder_put("exec /bin/cat >\"$file\"");
    assert_true(video_alpha("x.mov"));
    struct video_def def = film_def(scratch_path("no.mp4"));
    def.alpha = true;
    assert_int_equal(video_create_as(&def, &video), DISPLAY_BAD_ARGUMENT);
    assert_non_null(strstr(display_error(), ".webm"));
    encoder_put(NULL);
    assert_false(video_alpha("x.mov"));
}

int main(void)
{
    path_usual = strdup(getenv("PATH") ? getenv("PATH") : "/usr/bin:/bin");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(palettes_are_those_of_pictures),
        cmocka_unit_test(alpha_is_kept),
        cmocka_unit_test(sound_may_come_later),
        cmocka_unit_test(alpha_needs_a_format),
        cmocka_unit_test(sound_goes_to_the_encoder),
        cmocka_unit_test(pictures_are_in_it),
        cmocka_unit_test(without_an_encoder_it_is_a_y4m),
        cmocka_unit_test(an_encoder_gets_all_of_it),
        cmocka_unit_test(encoders_that_fail_are_reported),
        cmocka_unit_test(films_are_read_back),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
