/* Recordings of displays: screens and pictures out of pieces, and damaged ones. */
#include <display_recording.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "display_pieces.h"
#include "sample.h"

static uint64_t random_state = 3;
static struct pieces pieces;

static int counts[3]; /* changes: opened, seen, closed */

static int count_take(void *context, const struct display_change *change)
{
    (void)context;
    counts[0] += change->opened;
    counts[1] += change->seen;
    counts[2] += change->closed;
    return 1;
}

enum { WIDTH = 11, HEIGHT = 7, COLUMNS = 8, ROWS = 5 };

/* What must be seen at (X, Y) of a display of 8 bits, by its definition. */
static uint8_t value_seen(const uint8_t *pixels, int x_offset, int y_offset, const int *zoom,
                          const int *pan, int X, int Y, int *beyond)
{
    const int x = pan[0] + X / zoom[0], y = pan[1] + Y / zoom[1];
    *beyond = x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT;
    const int column = x - x_offset, row = y - y_offset;
    return *beyond || column < 0 || row < 0 || column >= COLUMNS || row >= ROWS
               ? 0
               : pixels[row * COLUMNS + column];
}

/* A room has the picture's colours, and nothing beyond its rows is written. */
static void painted_as_pictured(const struct display_screen *screen,
                                const struct display_image *image)
{
    const size_t width = (size_t)screen->width_px, stride = width + 3;
    uint32_t *pixels = malloc(stride * (size_t)screen->height_px * sizeof *pixels);
    assert_non_null(pixels);
    memset(pixels, 0x55, stride * (size_t)screen->height_px * sizeof *pixels);
    display_screen_paint(screen, &(struct display_room){pixels, stride});
    for (size_t y = 0; y < (size_t)screen->height_px; y++)
        for (size_t x = 0; x < stride; x++) {
            const uint8_t *is = image->pixels + 3 * (y * width + x);
            const uint32_t wanted = x < width ? UINT32_C(0xff000000) | (uint32_t)is[0] << 16 |
                                                    (uint32_t)is[1] << 8 | is[2]
                                              : UINT32_C(0x55555555);
            assert_int_equal(pixels[y * stride + x], wanted);
        }
    free(pixels);
}

static void pictures_are_by_offset_zoom_pan_and_map(void **unused)
{
    (void)unused;
    static const struct {
        int offset[2], zoom[2], pan[2];
    } cases[] = {{{0, 0}, {1, 1}, {0, 0}},   {{-3, -2}, {1, 1}, {0, 0}},
                 {{6, 5}, {1, 1}, {0, 0}},   {{2, 1}, {3, 2}, {1, 2}},
                 {{0, 0}, {1, 1}, {-4, 3}},  {{20, 0}, {1, 1}, {0, 0}},
                 {{0, -9}, {2, 7}, {-1, -1}}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        uint8_t pixels[COLUMNS * ROWS], map[256][3];
        for (size_t i = 0; i < sizeof pixels; i++)
            pixels[i] = (uint8_t)sample_word(&random_state);
        for (size_t i = 0; i < sizeof map; i++)
            (&map[0][0])[i] = (uint8_t)sample_word(&random_state);
        pieces.count = 0;
        pieces_line(&pieces);
        pieces_size(&pieces, 3, 1, WIDTH, HEIGHT, 0);
        pieces_pixels(&pieces, 3, 1, 1, COLUMNS, ROWS, cases[c].offset[0], cases[c].offset[1],
                      pixels, 5);
        pieces_map(&pieces, 3, map, 6);
        pieces_view(&pieces, 3, 1, cases[c].zoom[0], cases[c].zoom[1], cases[c].pan[0],
                    cases[c].pan[1], 7);
        for (size_t step = 1; step <= pieces.count; step = step * 3 + 1) {
            struct display_reader reader = {.take = count_take};
            struct display_image image = {0};
            memset(counts, 0, sizeof counts);
            for (size_t at = 0; at < pieces.count; at += step) {
                const size_t left = pieces.count - at;
                assert_int_equal(
                    display_reader_feed(&reader, pieces.bytes + at, left < step ? left : step),
                    DISPLAY_OK);
            }
            assert_int_equal(display_reader_end(&reader), DISPLAY_OK);
            assert_int_equal(counts[0], 1);
            assert_int_equal(counts[1], 2); /* the map, the view; not the hidden buffer */
            assert_string_equal(reader.screens[2].title, "tcit");
            assert_int_equal(display_screen_picture(&reader.screens[2], &image), DISPLAY_OK);
            for (int y = 0; y < HEIGHT; y++)
                for (int x = 0; x < WIDTH; x++) {
                    int beyond;
                    const uint8_t v = value_seen(pixels, cases[c].offset[0], cases[c].offset[1],
                                                 cases[c].zoom, cases[c].pan, x, y, &beyond);
                    const uint8_t black[3] = {0};
                    assert_memory_equal(image.pixels + 3 * (y * WIDTH + x),
                                        beyond ? black : map[v], 3);
                }
            painted_as_pictured(&reader.screens[2], &image);
            display_image_destroy(&image);
            display_reader_finish(&reader);
        }
    }
}

static void deep_pixels_go_through_the_maps_columns(void **unused)
{
    (void)unused;
    const uint8_t pixels[] = {1, 2, 3, 0, 4, 5, 6, 0};
    uint8_t map[256][3];
    struct display_reader reader = {.take = count_take};
    struct display_image image = {0};
    for (int i = 0; i < 256; i++)
        for (int c = 0; c < 3; c++)
            map[i][c] = (uint8_t)(100 * c + i);
    pieces.count = 0;
    pieces_line(&pieces);
    pieces_size(&pieces, 1, 4, 2, 2, 0);
    pieces_head(&pieces, 3, 1, 0, 0, 0, 1, 0x030201, 0); /* clear */
    pieces_pixels(&pieces, 1, 0, 4, 2, 1, 0, 1, pixels, 2);
    pieces_map(&pieces, 1, map, 6);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(display_screen_picture(&reader.screens[0], &image), DISPLAY_OK);
    const uint8_t wanted[] = {1, 102, 203, 1, 102, 203, 1, 102, 203, 4, 105, 206};
    assert_memory_equal(image.pixels, wanted, sizeof wanted);
    painted_as_pictured(&reader.screens[0], &image);
    /* The map that changes nothing; zoom, pan and a buffer that nothing was written to. */
    for (int i = 0; i < 256; i++)
        memset(map[i], i, 3);
    pieces.count = 0;
    pieces_map(&pieces, 1, map, 6);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(display_screen_picture(&reader.screens[0], &image), DISPLAY_OK);
    const uint8_t plain[] = {1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6};
    assert_memory_equal(image.pixels, plain, sizeof plain);
    painted_as_pictured(&reader.screens[0], &image);
    for (int zoom = 1; zoom <= 3; zoom++)
        for (int pan = -3; pan <= 3; pan++)
            for (int buffer = 0; buffer < 2; buffer++) {
                pieces.count = 0;
                pieces_view(&pieces, 1, buffer, zoom, 4 - zoom, pan, -pan, 8);
                assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count),
                                 DISPLAY_OK);
                assert_int_equal(display_screen_picture(&reader.screens[0], &image),
                                 DISPLAY_OK);
                painted_as_pictured(&reader.screens[0], &image);
            }
    pieces.count = 0;
    pieces_view(&pieces, 1, 0, 256, 256, INT32_MIN, INT32_MAX, 8);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(display_screen_picture(&reader.screens[0], &image), DISPLAY_OK);
    painted_as_pictured(&reader.screens[0], &image);
    /* A display that goes, and one in its place. */
    pieces.count = 0;
    pieces_head(&pieces, 6, 1, 0, 0, 0, 9, 0, 0);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_false(reader.screens[0].there);
    display_image_destroy(&image);
    display_reader_finish(&reader);
}

static struct picture_room shared;

static void room_pixels(int display, int buffer, int columns, int slot, int bytes, int x, int y)
{
    pieces_head(&pieces, 7, display, buffer, 1, 12, 3, x, y);
    pieces_number(&pieces, (uint64_t)columns, 4);
    pieces_number(&pieces, (uint64_t)slot, 4);
    pieces_number(&pieces, (uint64_t)bytes, 4);
}

static int slots_free(void)
{
    int taken[PICTURE_ROOM_SLOTS], count = 0;
    while (count < PICTURE_ROOM_SLOTS && (taken[count] = picture_room_take(&shared)) >= 0)
        count++;
    for (int i = 0; i < count; i++)
        picture_room_give(&shared, taken[i]);
    return count;
}

/* Pictures in shared memory: whole ones stay there until the next, parts are copied, and each
 * slot is given back. */
static void shared_pixels_are_seen_and_slots_given(void **unused)
{
    (void)unused;
    struct display_reader reader = {.take = count_take, .shared = &shared};
    struct display_image image = {0};
    if (!picture_room_make(&shared))
        skip();
    for (int round = 0; round < 40; round++) {
        const int slot = picture_room_take(&shared), part = round % 3 == 2;
        assert_true(slot >= 0 && slot < 4);
        uint8_t *at = picture_room_slot(&shared, slot);
        for (int i = 0; i < 12; i++)
            at[i] = (uint8_t)(10 * round + i);
        pieces.count = 0;
        if (!round)
            pieces_line(&pieces);
        if (round % 8 == 0) /* again, while pixels lie in a slot */
            pieces_size(&pieces, 1, 1, 4, 3, 0);
        if (part)
            room_pixels(1, round & 1, 2, slot, 4, 1, 1);
        else
            room_pixels(1, round & 1, 4, slot, 12, 0, 0);
        pieces_view(&pieces, 1, round & 1, 1, 1, 0, 0, 5);
        assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
        assert_int_equal(display_screen_picture(&reader.screens[0], &image), DISPLAY_OK);
        for (int i = 0; i < 12; i++)
            if (!part)
                assert_int_equal(image.pixels[3 * i], (uint8_t)(10 * round + i));
            else if (i == 5 || i == 6 || i == 9 || i == 10)
                assert_int_equal(image.pixels[3 * i],
                                 (uint8_t)(10 * round + (i & 1 ? 0 : 1) + (i > 8 ? 2 : 0)));
        painted_as_pictured(&reader.screens[0], &image);
        assert_true(slots_free() >= PICTURE_ROOM_SLOTS - 2);
    }
    static const int wrong[][3] = {/* columns, slot, bytes */
                                   {4, PICTURE_ROOM_SLOTS, 12},
                                   {4, -1, 12},
                                   {4, 7, PICTURE_ROOM_SLOT_BYTES + 1},
                                   {0, 7, 12},
                                   {5, 7, 12}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        pieces.count = 0;
        room_pixels(1, 0, wrong[i][0], wrong[i][1], wrong[i][2], 0, 0);
        assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count),
                         DISPLAY_BAD_FILE);
        reader.held = 0;
    }
    /* A slot twice. */
    const int twice = picture_room_take(&shared);
    pieces.count = 0;
    room_pixels(1, 0, 4, twice, 12, 0, 0);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count),
                     DISPLAY_BAD_FILE);
    display_reader_finish(&reader);
    assert_int_equal(slots_free(), PICTURE_ROOM_SLOTS);
    picture_room_end(&shared);
    display_image_destroy(&image);
}

/* Pixels that are shown from their slot keep it, until others are shown. */
static void slots_that_are_shown_are_kept(void **unused)
{
    (void)unused;
    struct display_reader reader = {.take = count_take, .shared = &shared};
    struct display_image image = {0};
    if (!picture_room_make(&shared))
        skip();
    int slots[2] = {picture_room_take(&shared), picture_room_take(&shared)};
    for (int i = 0; i < 2; i++)
        memcpy(picture_room_slot(&shared, slots[i]), (uint8_t[]){3, 2, 1, 0, 6, 5, 4, 99}, 8);
    pieces.count = 0;
    pieces_line(&pieces);
    pieces_size(&pieces, 1, 4, 2, 1, 0);
    room_pixels(1, 0, 2, slots[0], 8, 0, 0);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    const struct display_screen *s = &reader.screens[0];
    assert_ptr_equal(display_screen_as_is(s), picture_room_slot(&shared, slots[0]));
    assert_int_equal(display_screen_picture(s, &image), DISPLAY_OK);
    assert_memory_equal(image.pixels, ((uint8_t[]){1, 2, 3, 4, 5, 6}), 6);
    painted_as_pictured(s, &image);
    display_reader_keep(&reader, 1, true);
    pieces.count = 0;
    room_pixels(1, 0, 2, slots[1], 8, 0, 0);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(slots_free(), PICTURE_ROOM_SLOTS - 2); /* it is shown */
    display_reader_keep(&reader, 1, true);
    assert_int_equal(slots_free(), PICTURE_ROOM_SLOTS - 1); /* the other one is */
    /* A part through the pipe is written there; zoomed it is no picture that lies as it is. */
    const uint8_t red[] = {255, 0, 0, 0};
    pieces.count = 0;
    pieces_pixels(&pieces, 1, 0, 4, 1, 1, 1, 0, red, 3);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(display_screen_picture(s, &image), DISPLAY_OK);
    assert_memory_equal(image.pixels, ((uint8_t[]){1, 2, 3, 255, 0, 0}), 6);
    assert_non_null(display_screen_as_is(s));
    pieces.count = 0;
    pieces_view(&pieces, 1, 0, 2, 1, 0, 0, 4);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_null(display_screen_as_is(s));
    /* A new size, while it is shown. */
    pieces.count = 0;
    pieces_size(&pieces, 1, 4, 3, 3, 5);
    assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count), DISPLAY_OK);
    assert_int_equal(slots_free(), PICTURE_ROOM_SLOTS - 1);
    display_reader_keep(&reader, 1, false);
    assert_int_equal(slots_free(), PICTURE_ROOM_SLOTS);
    display_reader_finish(&reader);
    picture_room_end(&shared);
    display_image_destroy(&image);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    static const struct {
        int kind, display, buffer, pixel_bytes;
        size_t more;
        int x, y;
        const char *says;
    } wrongs[] = {
        {7, 1, 0, 1, 0, 9, 9, "no such piece"},      {1, 9, 0, 1, 0, 9, 9, "no such display"},
        {1, 1, 2, 1, 0, 9, 9, "no such display"},    {1, 1, 0, 2, 0, 9, 9, "such a size"},
        {1, 1, 0, 1, 0, 0, 9, "such a size"},        {1, 1, 0, 1, 0, 9, 8193, "such a size"},
        {1, 1, 0, 1, 65, 9, 9, "not so many bytes"}, {5, 2, 0, 1, 8, 0, 0, "has no size"},
    };
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        struct display_reader reader = {.take = count_take};
        pieces.count = 0;
        pieces_line(&pieces);
        pieces_head(&pieces, wrongs[i].kind, wrongs[i].display, wrongs[i].buffer,
                    wrongs[i].pixel_bytes, wrongs[i].more, 0, wrongs[i].x, wrongs[i].y);
        assert_int_equal(display_reader_feed(&reader, pieces.bytes, pieces.count),
                         DISPLAY_BAD_FILE);
        if (!strstr(display_error(), wrongs[i].says))
            fail_msg("%zu: %s", i, display_error());
        display_reader_finish(&reader);
    }
    struct display_reader reader = {.take = count_take};
    assert_int_equal(display_reader_end(&reader), DISPLAY_BAD_FILE);
    assert_int_equal(display_reader_feed(&reader, (const uint8_t *)"lutetia leds", 12),
                     DISPLAY_BAD_FILE);
    display_reader_finish(&reader);
}

/* Damaged recordings are read or refused, and whatever is there can be drawn. */
static void damaged_recordings_are_refused_or_read(void **unused)
{
    (void)unused;
    static struct pieces damaged;
    uint8_t pixels[64];
    int refused = 0;
    for (int n = 0; n < 20000; n++) {
        pieces.count = 0;
        pieces_line(&pieces);
        for (int i = 0; i < 64; i++)
            pixels[i] = (uint8_t)sample_word(&random_state);
        pieces_size(&pieces, 1, 1, 9, 5, 0);
        pieces_size(&pieces, 2, 4, 6, 6, 0);
        pieces_pixels(&pieces, 1, 0, 1, 8, 8, -2, 1, pixels, 1);
        pieces_pixels(&pieces, 2, 1, 4, 4, 4, 3, 3, pixels, 2);
        pieces_head(&pieces, 3, 2, 0, 0, 0, 3, 77, 0);
        pieces_view(&pieces, 1, 1, 2, 3, 1, -1, 4);
        pieces_pixels(&pieces, 1, 1, 1, 8, 8, 0, 0, pixels, 5);
        pieces_head(&pieces, 6, 2, 0, 0, 0, 6, 0, 0);
        damaged = pieces;
        for (uint64_t k = 1 + sample_word(&random_state) % 4; k > 0; k--) {
            const size_t at = sample_word(&random_state) % damaged.count;
            const uint64_t die = sample_word(&random_state) % 8;
            if (die == 0)
                damaged.count = at + 1;
            else
                damaged.bytes[at] =
                    die < 4 ? (uint8_t)sample_word(&random_state) : damaged.bytes[at] ^ 1;
        }
        struct display_reader reader = {.take = count_take};
        enum display_status status = display_reader_feed(&reader, damaged.bytes, damaged.count);
        if (status == DISPLAY_OK)
            status = display_reader_end(&reader);
        refused += status != DISPLAY_OK;
        for (int i = 0; i < DISPLAY_SCREENS; i++) {
            const struct display_screen *s = &reader.screens[i];
            struct display_image image = {0};
            if (!s->there || (long)s->width_px * s->height_px > 10000)
                continue;
            assert_int_equal(display_screen_picture(s, &image), DISPLAY_OK);
            display_image_destroy(&image);
        }
        display_reader_finish(&reader);
    }
    assert_in_range(refused, 5000, 19000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_by_offset_zoom_pan_and_map),
        cmocka_unit_test(deep_pixels_go_through_the_maps_columns),
        cmocka_unit_test(shared_pixels_are_seen_and_slots_given),
        cmocka_unit_test(slots_that_are_shown_are_kept),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(damaged_recordings_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
