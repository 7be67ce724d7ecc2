/* test_studio_film.c - films of the making: as long as what is told, what was undone is not in
 * them, they end with the sheet as it is, and the sheet stays as it is; stopped and closed
 * folders leave nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "studio_film.h"
#include "studio_scene.h"

enum {
    NUMBERS = 3 * SCENE_WIDTH * SCENE_HEIGHT,
    HIGH = SCENE_HEIGHT + 28,      /* with the line below */
    FRAME = SCENE_WIDTH * HIGH * 3 /* of YUV 4:4:4 */
};
static uint16_t before[NUMBERS], after[NUMBERS];
static char path[] = "/tmp/lutetia-film-XXXXXX.y4m";

#define good(call) assert_int_equal(call, PAPER_OK)

struct filmed {
    size_t count;
    uint8_t *bytes;
    int frames;
    const uint8_t *last; /* luma of the last frame */
};

static void film_read(struct filmed *f)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    f->count = (size_t)ftell(file);
    rewind(file);
    f->bytes = malloc(f->count);
    assert_non_null(f->bytes);
    assert_int_equal(fread(f->bytes, 1, f->count, file), f->count);
    fclose(file);
    char size[40];
    snprintf(size, sizeof size, "YUV4MPEG2 W%d H%d F30", SCENE_WIDTH, HIGH);
    assert_memory_equal(f->bytes, size, strlen(size));
    const uint8_t *at = memchr(f->bytes, '\n', f->count);
    assert_non_null(at);
    at++;
    f->frames = (int)((f->count - (size_t)(at - f->bytes)) / (6 + FRAME));
    assert_int_equal(f->count, (size_t)(at - f->bytes) + (size_t)f->frames * (6 + FRAME));
    f->last = f->bytes + f->count - FRAME;
}

static void look(struct studio_session *s, uint16_t *rgb)
{
    const struct paper_sheet_config config = scene_config();
    const struct paper_sheet_view view = paper_sheet_view_default(&config);
    good(paper_sheet_view(studio_session_sheet(s), &view, rgb));
}

static enum paper_status film_write(struct studio_session *s, double seconds_most,
                                    bool (*watch)(void *, long, long), void *context)
{
    const struct paper_sheet_config config = scene_config();
    const struct paper_sheet_view view = paper_sheet_view_default(&config);
    char written[200];
    return studio_film_write(studio_session_sheet(s),
                             &(struct studio_film_def){.path = path,
                                                       .view = &view,
                                                       .seconds_most = seconds_most,
                                                       .watch = watch,
                                                       .context = context},
                             written, sizeof written);
}

static struct studio_session *begin(void)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    good(studio_session_create(&config, 64e6, &s));
    good(studio_session_set(s, STUDIO_PAUSED, 1));
    good(studio_session_set(s, STUDIO_WIDTH, 14));
    return s;
}

/* A stroke of 0.15 s, 30 steps, a wash. */
static void paint(struct studio_session *s, bool undone)
{
    good(scene_sweep(s, 30, 3, true));
    good(studio_session_steps(s, 30, NULL));
    if (undone) {
        good(scene_sweep(s, 10, 3, true));
        assert_true(studio_session_undo(s));
    }
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_WASH));
    good(scene_sweep(s, 40, 8, true));
}

static void films_tell_what_stays(void **state)
{
    (void)state;
    struct filmed plain, undone;
    struct studio_session *s = begin();
    paint(s, false);
    look(s, before);
    const int operations = paper_history_done(studio_session_sheet(s));
    good(film_write(s, 60, NULL, NULL));
    look(s, after);
    assert_memory_equal(before, after, sizeof before);
    assert_int_equal(paper_history_done(studio_session_sheet(s)), operations);
    film_read(&plain);
    /* 0.15 + 0.5 + 0.4 + 2 seconds, and the film begins with the first moment after 0 */
    assert_in_range(plain.frames, (int)(3.05 * STUDIO_FILM_FPS) - 1,
                    (int)(3.05 * STUDIO_FILM_FPS) + 1);
    /* the last frame is the sheet: luma by ITU-R BT.601 or 709, which differ by little here */
    double sum = 0;
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
        const double luma = 16 + 219 / 65535.0 *
                                     (0.26 * before[3 * i] + 0.64 * before[3 * i + 1] +
                                      0.10 * before[3 * i + 2]);
        sum += fabs(luma - plain.last[i]);
    }
    if (sum / (SCENE_WIDTH * SCENE_HEIGHT) > 6)
        fail_msg("the last frame is off by %g", sum / (SCENE_WIDTH * SCENE_HEIGHT));
    studio_session_destroy(s);
    /* with a stroke that was undone it is the same film, byte for byte */
    s = begin();
    paint(s, true);
    good(film_write(s, 60, NULL, NULL));
    film_read(&undone);
    assert_int_equal(plain.count, undone.count);
    assert_memory_equal(plain.bytes, undone.bytes, plain.count);
    free(undone.bytes);
    /* no longer than it may be: all of it is quicker, but for the end */
    good(film_write(s, 0.5, NULL, NULL));
    film_read(&undone);
    assert_in_range(undone.frames, (int)(2.5 * STUDIO_FILM_FPS) - 1,
                    (int)(2.5 * STUDIO_FILM_FPS) + 1);
    free(undone.bytes);
    free(plain.bytes);
    studio_session_destroy(s);
    unlink(path);
}

struct watching {
    long last, calls;
};

static bool stop_in_the_middle(void *context, long done, long total)
{
    struct watching *w = context;
    assert_true(done >= w->last && done <= total + 2001);
    w->last = done;
    return ++w->calls < 10;
}

static void what_fails_leaves_nothing(void **state)
{
    (void)state;
    struct watching watching = {0};
    struct studio_session *s = begin();
    assert_int_equal(film_write(s, 60, NULL, NULL), PAPER_BAD_ARGUMENT); /* nothing to tell */
    assert_non_null(strstr(studio_session_error(), "nothing has been painted"));
    unlink(path);
    paint(s, false);
    assert_int_equal(film_write(s, 60, stop_in_the_middle, &watching), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(studio_session_error(), "stopped"));
    assert_int_equal(watching.calls, 10);
    assert_int_not_equal(access(path, F_OK), 0);
    look(s, after); /* the sheet can be gone on with */
    good(scene_sweep(s, 20, 3, true));
    studio_session_destroy(s);
}

static int make(void **state)
{
    (void)state;
    const int file = mkstemps(path, 4);
    return file < 0 ? -1 : close(file);
}

static int end(void **state)
{
    (void)state;
    unlink(path);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_tell_what_stays),
        cmocka_unit_test(what_fails_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, make, end);
}
