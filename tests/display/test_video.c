/* test_video.c - videos: their contents, and encoders that fail, are killed or are missing. A script of the test plays ffmpeg.
 * (security.md 14) */
#include "scratch.h"

#include <display.h>
#include <video.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { WIDTH = 6, HEIGHT = 4, COUNT = WIDTH * HEIGHT, FRAME = 6 + 3 * COUNT };

static void check(enum display_status status)
{
    if (status != DISPLAY_OK)
        fail_msg("status %d: %s", (int)status, display_error());
}

/* What the script that plays ffmpeg does when the film is read back: a line for each picture. */
static const char lines_all[] =
    "/bin/grep -ao FRAME /proc/self/fd/3 | /bin/sed 's/.*/0, 0/'; echo '1, 0'";
static const char *read_back = lines_all;

/* Sets a PATH that holds only this script as ffmpeg (NULL: nothing). Its last argument is the file. */
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

/* An encoder that ends well is no proof: a film without its end, its index or its pictures does not take the old one's place. */
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

/* The encoder reads the sound from its own file, from the beginning. A format without sound gets none. */
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
        if (silent)
            snprintf(path, sizeof path, "%s", scratch_path("sound.gif"));
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
    fclose(sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
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
