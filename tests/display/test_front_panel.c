/* test_front_panel.c - pictures of the machine's lights, and recordings of lights. */
#include <front_panel.h>
#include <light_recording.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "sample.h"

static uint64_t random_state = 2;

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static struct front_panel *panel_make(int width, int height, enum front_panel_view view)
{
    struct front_panel_config config = front_panel_config_default();
    config.width_px = width;
    config.height_px = height;
    config.view = view;
    struct front_panel *panel;
    assert_int_equal(front_panel_create(&config, &panel), DISPLAY_OK);
    return panel;
}

static bool on(const uint8_t *lights, int l)
{
    return lights[l / 8] >> l % 8 & 1;
}

/* ---- pictures ---- */

/* Each light's centre is bright where its bit is 1 and dark where it is 0, in every view. */
static void lights_are_those_of_the_bits(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        enum front_panel_view view;
        int seen;
    } cases[] = {{480, 480, FRONT_PANEL_CUBE, 4096},
                 {320, 300, FRONT_PANEL_FRONT, 4096},
                 {150, 200, FRONT_PANEL_DOOR, 1024}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct front_panel *panel = panel_make(cases[c].width, cases[c].height, cases[c].view);
        struct display_image image = {0};
        uint8_t lights[FRONT_PANEL_BYTES];
        for (int i = 0; i < FRONT_PANEL_BYTES; i++)
            lights[i] = (uint8_t)sample_below(&random_state, 256);
        assert_int_equal(front_panel_draw(panel, lights, &image), DISPLAY_OK);
        int seen = 0, bright_least = 255, dark_most = 0;
        for (int l = 0; l < FRONT_PANEL_LIGHTS; l++) {
            int x, y;
            if (!front_panel_light_at(panel, l, &x, &y) ||
                (cases[c].view == FRONT_PANEL_DOOR && (l / 64 >= 32 || l % 64 >= 32)))
                continue;
            seen++;
            int r = image.pixels[3 * (y * image.width_px + x)];
            if (on(lights, l) && r < bright_least)
                bright_least = r;
            if (!on(lights, l) && r > dark_most)
                dark_most = r;
        }
        if (seen != cases[c].seen || bright_least < 170 || dark_most > bright_least - 25)
            fail_msg("case %zu: %d lights, on from %d, off up to %d", c, seen, bright_least,
                     dark_most);
        display_image_destroy(&image);
        front_panel_destroy(panel);
    }
}

static void places_are_all_different(void **state)
{
    (void)state;
    bool taken[64][64] = {{false}};
    for (int l = 0; l < FRONT_PANEL_LIGHTS; l++) {
        int column, row;
        front_panel_place(l, &column, &row);
        assert_in_range(column, 0, 63);
        assert_in_range(row, 0, 63);
        assert_false(taken[row][column]);
        taken[row][column] = true;
    }
    int column, row;
    front_panel_place(64 + 5, &column, &row);
    assert_int_equal(column, 5);
    assert_int_equal(row, 1);
    front_panel_place(4095, &column, &row);
    assert_int_equal(column, 63);
    assert_int_equal(row, 63);
}

/* A light only adds red to the picture, in every view. Without lights there is no red. */
static void light_is_added(void **state)
{
    (void)state;
    struct front_panel *panel = panel_make(320, 320, FRONT_PANEL_CUBE);
    struct display_image dark = {0}, lit = {0};
    uint8_t lights[FRONT_PANEL_BYTES] = {0};
    assert_int_equal(front_panel_draw(panel, lights, &dark), DISPLAY_OK);
    memset(lights, 0xff, sizeof lights);
    assert_int_equal(front_panel_draw(panel, lights, &lit), DISPLAY_OK);
    long more = 0, floor_more = 0;
    int brightest = 0;
    for (int i = 0; i < 3 * 320 * 320; i++) {
        assert_true(lit.pixels[i] >= dark.pixels[i]);
        more += lit.pixels[i] - dark.pixels[i];
        if (i >= 3 * 320 * 290)
            floor_more += lit.pixels[i] - dark.pixels[i];
        if (dark.pixels[i] > brightest)
            brightest = dark.pixels[i];
    }
    assert_true(brightest > 60 && brightest < 200); /* a black cube, and one sees it */
    assert_true(more > 320L * 320 * 10);
    assert_true(floor_more > 320 * 20); /* the floor is polished */

    /* The same lights give the same picture. */
    struct display_image again = {0};
    assert_int_equal(front_panel_draw(panel, lights, &again), DISPLAY_OK);
    assert_memory_equal(again.pixels, lit.pixels, 3 * 320 * 320);
    display_image_destroy(&again);
    display_image_destroy(&dark);
    display_image_destroy(&lit);
    front_panel_destroy(panel);
}

static void wrong_sizes_are_refused(void **state)
{
    (void)state;
    static const int sizes[][2] = {{63, 100}, {100, 0}, {-5, 100}, {100, 9000}};
    struct front_panel_config config = front_panel_config_default();
    struct front_panel *panel;
    for (int i = 0; i < 4; i++) {
        config.width_px = sizes[i][0];
        config.height_px = sizes[i][1];
        assert_int_equal(front_panel_create(&config, &panel), DISPLAY_BAD_ARGUMENT);
        assert_null(panel);
        assert_null(strchr(display_error(), '\n'));
    }
    front_panel_destroy(NULL);
    panel = panel_make(64, 64, FRONT_PANEL_DOOR);
    struct display_image image = {.width_px = 65, .height_px = 64, .channels = 3};
    uint8_t lights[FRONT_PANEL_BYTES] = {0};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_int_equal(front_panel_draw(panel, lights, &image), DISPLAY_BAD_ARGUMENT);
    display_image_destroy(&image);
    front_panel_destroy(panel);
}

/* A picture of 960x960 takes less than a tenth of a second of one processor: the least of
 * several times, because other programs may be running. */
static void pictures_are_quick(void **state)
{
    (void)state;
    struct front_panel *panel = panel_make(960, 960, FRONT_PANEL_CUBE);
    struct display_image image = {0};
    uint8_t lights[FRONT_PANEL_BYTES];
    memset(lights, 0xff, sizeof lights);
    double best = 1e9;
    for (int i = 0; i < 5 && best >= 0.1; i++) {
        double began = clock_s();
        assert_int_equal(front_panel_draw(panel, lights, &image), DISPLAY_OK);
        double took = clock_s() - began;
        best = took < best ? took : best;
    }
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
    if (best >= 0.1)
        fail_msg("a picture takes %.3f s", best);
#endif
    display_image_destroy(&image);
    front_panel_destroy(panel);
}

/* ---- recordings ---- */

enum { FRAMES = 20 };

struct taken {
    int count, most;
    struct light_frame frames[FRAMES + 1];
};

static int take(void *context, const struct light_frame *frame)
{
    struct taken *t = context;
    assert_int_equal(frame->number, t->count);
    if (t->count < FRAMES + 1)
        t->frames[t->count] = *frame;
    return ++t->count != t->most;
}

/* Makes a recording of FRAMES, with its first line repeated in the middle; returns its length
 * in bytes. */
static size_t recording_make(uint8_t *out)
{
    uint8_t *at = out;
    for (int i = 0; i < FRAMES; i++) {
        if (i == 0 || i == FRAMES / 2) {
            memcpy(at, LIGHT_RECORDING_LINE, LIGHT_RECORDING_LINE_BYTES);
            at += LIGHT_RECORDING_LINE_BYTES;
        }
        memset(at, 0, 8);
        at[0] = (uint8_t)(i == 3 ? 'l' : i); /* begins as the line does */
        at[1] = i == 3 ? 'u' : 0;
        for (int k = 8; k < LIGHT_RECORDING_FRAME_BYTES; k++)
            at[k] = (uint8_t)sample_below(&random_state, 256);
        at += LIGHT_RECORDING_FRAME_BYTES;
    }
    return (size_t)(at - out);
}

static enum display_status feed(struct light_reader *reader, const uint8_t *bytes, size_t count)
{
    while (count > 0) { /* each piece has its own memory, so that ASan sees its end */
        size_t piece =
            1 + sample_below(&random_state, sample_below(&random_state, 2) ? 5 : 700);
        piece = piece < count ? piece : count;
        uint8_t *copy = malloc(piece);
        assert_non_null(copy);
        memcpy(copy, bytes, piece);
        enum display_status status = light_reader_feed(reader, copy, piece);
        free(copy);
        if (status != DISPLAY_OK)
            return status;
        bytes += piece;
        count -= piece;
    }
    return light_reader_end(reader);
}

static uint8_t recording[FRAMES * LIGHT_RECORDING_FRAME_BYTES + 2 * LIGHT_RECORDING_LINE_BYTES];

static void recordings_are_read_in_any_pieces(void **state)
{
    (void)state;
    static struct taken t;
    size_t bytes = recording_make(recording);
    assert_int_equal(bytes, sizeof recording);
    for (int i = 0; i < 50; i++) {
        t = (struct taken){0};
        struct light_reader reader = {.take = take, .context = &t};
        assert_int_equal(feed(&reader, recording, bytes), DISPLAY_OK);
        assert_int_equal(t.count, FRAMES);
        const uint8_t *at = recording + LIGHT_RECORDING_LINE_BYTES;
        for (int f = 0; f < FRAMES; f++, at += LIGHT_RECORDING_FRAME_BYTES) {
            at += f == FRAMES / 2 ? LIGHT_RECORDING_LINE_BYTES : 0;
            assert_int_equal(t.frames[f].time_us, f == 3 ? 'l' + 256 * 'u' : f);
            assert_memory_equal(t.frames[f].lights, at + 8, LIGHT_RECORDING_LIGHTS_BYTES);
        }
    }
    t = (struct taken){.most = 3};
    struct light_reader reader = {.take = take, .context = &t};
    assert_int_equal(feed(&reader, recording, bytes), DISPLAY_OK);
    assert_int_equal(t.count, 3);
}

/* Damaged recordings are read, or refused with a reason. */
static void damaged_recordings_are_read_or_refused(void **state)
{
    (void)state;
    static struct taken t;
    static uint8_t damaged[sizeof recording];
    size_t bytes = recording_make(recording);
    int read = 0, refused = 0;
    for (int i = 0; i < 3000; i++) {
        memcpy(damaged, recording, bytes);
        size_t count = bytes;
        for (uint32_t k = sample_below(&random_state, 4); k > 0; k--) {
            size_t at = sample_below(&random_state,
                                     sample_below(&random_state, 2) ? 60 : (uint32_t)count);
            size_t run = 1 + sample_below(&random_state, 60);
            if (sample_below(&random_state, 3) == 0 && at + run < count) {
                memmove(damaged + at, damaged + at + run, count - at - run);
                count -= run;
            } else {
                damaged[at] = (uint8_t)sample_below(&random_state, 256);
            }
        }
        if (sample_below(&random_state, 3) == 0)
            count = sample_below(&random_state, (uint32_t)count + 1);
        t = (struct taken){0};
        struct light_reader reader = {.take = take, .context = &t};
        if (feed(&reader, damaged, count) == DISPLAY_OK) {
            read++;
        } else {
            refused++;
            assert_true(display_error()[0] && !strchr(display_error(), '\n'));
        }
        assert_true(t.count <= FRAMES);
    }
    assert_true(read > 300 && refused > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_are_those_of_the_bits),
        cmocka_unit_test(places_are_all_different),
        cmocka_unit_test(light_is_added),
        cmocka_unit_test(wrong_sizes_are_refused),
        cmocka_unit_test(pictures_are_quick),
        cmocka_unit_test(recordings_are_read_in_any_pieces),
        cmocka_unit_test(damaged_recordings_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
