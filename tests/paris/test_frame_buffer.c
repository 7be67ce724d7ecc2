/* The frame buffer: what a program's writes record, in whatever order, size and shape, and what
 * is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "device.h"
#include <cm/cmfb.h>

#define V(v) ((CM_vector_t){.ints = v})

enum { LINE = 18, HEAD = 24, MOST = 1 << 16 };

static FILE *recording; /* read behind the library */

static uint32_t number_at(const uint8_t *at, int bytes)
{
    uint32_t n = 0;
    for (int i = 0; i < bytes; i++)
        n |= (uint32_t)at[i] << 8 * i;
    return n;
}

struct piece {
    int kind, display, buffer, pixel_bytes;
    uint32_t bytes;
    int x, y;
    uint8_t more[MOST];
};

/* The next piece of the recording. False: there is none. */
static bool piece_next(struct piece *p)
{
    uint8_t head[HEAD];
    if (!recording) {
        char line[LINE + 1] = "";
        recording = fopen(getenv("LUTETIA_DISPLAY"), "rb");
        assert_non_null(recording);
        assert_int_equal(fread(line, 1, LINE, recording), LINE);
        assert_string_equal(line, "lutetia display 1\n");
    }
    clearerr(recording);
    if (fread(head, 1, HEAD, recording) == 0)
        return false;
    p->kind = head[0];
    p->display = head[1];
    p->buffer = head[2];
    p->pixel_bytes = head[3];
    p->bytes = number_at(head + 4, 4);
    p->x = (int)number_at(head + 16, 4);
    p->y = (int)number_at(head + 20, 4);
    assert_true(p->bytes <= MOST);
    assert_int_equal(fread(p->more, 1, p->bytes, recording), p->bytes);
    return true;
}

static void no_more(void)
{
    static struct piece p;
    assert_false(piece_next(&p));
}

static CMFB_display_id_t display_make(unsigned int bits, unsigned int width,
                                      unsigned int height)
{
    static struct piece p;
    CMFB_display_id_t display = CMFB_attach_display("screen");
    assert_true(display >= 1);
    CMFB_initialize_display(display, bits, width, height);
    assert_true(piece_next(&p));
    assert_int_equal(p.kind, 1);
    assert_int_equal(p.display, display);
    assert_int_equal(p.x, width);
    assert_int_equal(p.y, height);
    assert_int_equal(p.pixel_bytes, bits == 8 ? 1 : 4);
    assert_int_equal(p.bytes, 6);
    assert_memory_equal(p.more, "screen", 6);
    return display;
}

static void display_drop(CMFB_display_id_t display)
{
    static struct piece p;
    CMFB_detach_display(display);
    assert_true(piece_next(&p));
    assert_int_equal(p.kind, 6);
    assert_false(CMFB_attached(display));
}

/* A field of random numbers in a new VP set of that shape, which becomes the current one. */
static CM_field_id_t field_make(const int *dimensions, unsigned int rank, unsigned int bits,
                                uint32_t *numbers, int count)
{
    static uint8_t bytes[4 * MOST];
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(V(dimensions), rank)));
    CM_field_id_t field = CM_allocate_heap_field(bits);
    for (int i = 0; i < count; i++) {
        numbers[i] = (uint32_t)device_random() & ((1u << bits) - 1);
        if (bits == 8)
            bytes[i] = (uint8_t)numbers[i];
        else
            memcpy(bytes + 4 * i, &numbers[i], 4);
    }
    assert_int_equal(machine_field_upload(paris_machine(), field, MACHINE_UINT(bits), bytes),
                     MACHINE_OK);
    return field;
}

/* The piece holds these numbers, `step` apart in a row and `row` from row to row. */
static void pixels_are(int width, int height, const uint32_t *numbers, int step, int row)
{
    static struct piece p;
    assert_true(piece_next(&p));
    assert_int_equal(p.kind, 2);
    assert_int_equal(number_at(p.more, 4), width);
    assert_int_equal(p.bytes, 4 + width * height * p.pixel_bytes);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint32_t pixel =
                number_at(p.more + 4 + (y * width + x) * p.pixel_bytes, p.pixel_bytes);
            if (pixel != numbers[y * row + x * step])
                fail_msg("pixel %d, %d of %d x %d: %u for %u", x, y, width, height, pixel,
                         numbers[y * row + x * step]);
        }
}

static const int shapes[][2] = {{64, 64}, {5, 13}, {32, 16}, {1, 40}, {7, 1}};

static void fields_are_written_in_news_order(void **unused)
{
    (void)unused;
    static uint32_t numbers[MOST];
    for (unsigned int bits = 8; bits <= 24; bits += 16) {
        CMFB_display_id_t display = display_make(bits, 100, 80);
        for (size_t c = 0; c < sizeof shapes / sizeof *shapes; c++) {
            const int rows = shapes[c][0], columns = shapes[c][1];
            CM_field_id_t field = field_make(shapes[c], 2, bits, numbers, rows * columns);
            CM_clear_context(); /* does not matter */
            CMFB_write_news_always(display, c & 1, field, -3, 7);
            pixels_are(columns, rows, numbers, 1, columns);
            CM_set_context();
            /* the axes the other way round */
            CMFB_set_axes(display, 0, 1);
            CMFB_write_news_always(display, 0, field, 0, 0);
            pixels_are(rows, columns, numbers, columns, 1);
            CMFB_set_axes(display, 1, 0);
        }
        display_drop(display);
    }
    /* one axis is a row */
    CMFB_display_id_t display = display_make(8, 9, 9);
    static const int line[] = {9};
    CMFB_write_news_always(display, 0, field_make(line, 1, 8, numbers, 9), 0, 3);
    pixels_are(9, 1, numbers, 1, 9);
    display_drop(display);
    no_more();
}

/* The shuffle puts the picture's pixels at the send addresses, in order; and then the raw write
 * shows the picture. */
static void the_shuffle_is_by_send_addresses(void **unused)
{
    (void)unused;
    static uint32_t numbers[MOST];
    CMFB_display_id_t display = display_make(24, 100, 80);
    for (size_t c = 0; c < sizeof shapes / sizeof *shapes; c++) {
        const int rows = shapes[c][0], columns = shapes[c][1], count = rows * columns;
        CM_field_id_t field = field_make(shapes[c], 2, 24, numbers, count);
        CM_field_id_t shuffled = CM_allocate_heap_field(24);
        CMFB_shuffle_from_news_always(display, shuffled, field, 24);
        CMFB_write_always(display, 0, shuffled, 0, 0);
        pixels_are(columns, rows, numbers, 1, columns);
        if (columns % 2 || rows % 2)
            continue;
        for (int k = 0; k < count; k++) /* all addresses from 0 on have a processor */
            assert_int_equal(CM_u_read_from_processor_1L((CM_sendaddr_t)k, shuffled, 24),
                             numbers[k]);
    }
    CMFB_shuffle_from_news_always(display, 0, 0, 24);
    device_said("CMFB_shuffle_from_news_always", "CM_no_field");
    display_drop(display);
    no_more();
}

static void channels_may_be_fields(void **unused)
{
    (void)unused;
    static uint32_t numbers[3][MOST], all[MOST];
    CMFB_display_id_t display = display_make(24, 16, 16);
    CM_field_id_t field = field_make(shapes[1], 2, 24, all, 65);
    for (int i = 0; i < 65; i++)
        for (int c = 0; c < 3; c++)
            numbers[c][i] = all[i] >> 8 * c & 255;
    CMFB_write_rgb_news_always(display, 1, field, field + 8, field + 16, 0, 0);
    pixels_are(13, 5, all, 1, 13);
    CMFB_write_rgb_news_always(display, 1, field + 16, field + 16, field + 16, 0, 0);
    for (int i = 0; i < 65; i++)
        all[i] = numbers[2][i] * 0x10101;
    pixels_are(13, 5, all, 1, 13);
    display_drop(display);
}

static void views_and_maps_are_told(void **unused)
{
    (void)unused;
    static struct piece p;
    unsigned char in[3][256], out[3][256];
    CMFB_display_id_t display = display_make(8, 10, 20);
    assert_int_equal(CMFB_display_bits(display), 8);
    assert_int_equal(CMFB_display_width(display), 10);
    assert_int_equal(CMFB_display_height(display), 20);
    CMFB_set_zoom(display, 3, 4);
    assert_true(piece_next(&p) && p.kind == 5);
    assert_int_equal(number_at(p.more, 4), 3);
    assert_int_equal(number_at(p.more + 4, 4), 4);
    CMFB_set_pan(display, -5, 6);
    assert_true(piece_next(&p) && p.kind == 5 && p.x == -5 && p.y == 6 && p.buffer == 0);
    CMFB_spin(display);
    assert_true(piece_next(&p) && p.kind == 5 && p.buffer == 1);
    assert_int_equal(CMFB_buffer_seen(display), 1);
    CMFB_switch_buffer(display, 0);
    assert_true(piece_next(&p) && p.kind == 5 && p.buffer == 0);
    CMFB_clear(display, 1, 9);
    assert_true(piece_next(&p) && p.kind == 3 && p.buffer == 1 && p.x == 9);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 256; i++)
            in[c][i] = (unsigned char)device_random();
    CMFB_write_color_map(display, 0, 256, in[0], in[1], in[2]);
    assert_true(piece_next(&p) && p.kind == 4);
    CMFB_cycle_color_map(display, 10, 7, -2);
    assert_true(piece_next(&p) && p.kind == 4);
    CMFB_read_color_map(display, 5, 250, out[0], out[1], out[2]);
    for (int i = 5; i < 255; i++)
        for (int c = 0; c < 3; c++) {
            const int from = i < 10 || i >= 17 ? i : 10 + (i - 10 + 2) % 7;
            assert_int_equal(out[c][i - 5], in[c][from]);
            assert_int_equal(p.more[3 * i + c], in[c][from]);
        }
    display_drop(display);
    no_more();
}

static void wrong_calls_are_said_and_record_nothing(void **unused)
{
    (void)unused;
    static uint32_t numbers[MOST];
    static const int cube[] = {2, 3, 4};
    CMFB_display_id_t bare = CMFB_attach_display(NULL), display = display_make(8, 10, 10);
    CMFB_display_id_t deep = display_make(24, 10, 10);
    CM_field_id_t field = field_make(shapes[1], 2, 8, numbers, 65);
    unsigned char map[256];
#define WRONG(call, text, function)                                                            \
    call;                                                                                      \
    device_said(function, text)
    WRONG(CMFB_write_news_always(8, 0, field, 0, 0), "not attached", "CMFB_write_news_always");
    WRONG(CMFB_write_news_always(bare, 0, field, 0, 0), "no size", "CMFB_write_news_always");
    WRONG(CMFB_write_news_always(display, 2, field, 0, 0), "buffer", "CMFB_write_news_always");
    WRONG(CMFB_write_news_always(deep, 0, field, 0, 0), "24 bits", "CMFB_write_news_always");
    WRONG(CMFB_write_always(display, 0, field + 999, 0, 0), "source", "CMFB_write_always");
    WRONG(CMFB_write_rgb_news_always(display, 0, field, field, field, 0, 0), "has 8 bits",
          "CMFB_write_rgb_news_always");
    WRONG(CMFB_write_rgb_news_always(deep, 0, field, 0, field, 0, 0), "green",
          "CMFB_write_rgb_news_always");
    WRONG(CMFB_initialize_display(display, 16, 10, 10), "bits", "CMFB_initialize_display");
    WRONG(CMFB_initialize_display(display, 8, 0, 10), "width", "CMFB_initialize_display");
    WRONG(CMFB_set_zoom(display, 0, 1), "x_zoom", "CMFB_set_zoom");
    WRONG(CMFB_set_axes(display, 1, 1), "x_axis", "CMFB_set_axes");
    WRONG(CMFB_clear(display, 0, 256), "value", "CMFB_clear");
    WRONG(CMFB_switch_buffer(display, 2), "buffer", "CMFB_switch_buffer");
    WRONG(CMFB_write_color_map(display, 200, 57, map, map, map), "first",
          "CMFB_write_color_map");
    WRONG(CMFB_read_color_map(display, 0, 1, map, NULL, map), "green", "CMFB_read_color_map");
    WRONG(CMFB_shuffle_from_news_always(display, field, field, 65), "len",
          "CMFB_shuffle_from_news_always");
    CM_field_id_t solid = field_make(cube, 3, 8, numbers, 24);
    WRONG(CMFB_write_news_always(display, 0, solid, 0, 0), "third", "CMFB_write_news_always");
    WRONG(CMFB_write_news_always(display, 0, field, 0, 0), "VP set", "CMFB_write_news_always");
    CMFB_detach_display(bare);
    assert_int_equal(CMFB_attach_display(""), bare);
    for (int i = 0; i < CMFB_displays_most - 3; i++)
        assert_true(CMFB_attach_display("more") > 0);
    WRONG(assert_int_equal(CMFB_attach_display("more"), CMFB_no_display), "all there are",
          "CMFB_attach_display");
    no_more();
    /* Where nobody looks on, nothing is recorded, and the checks remain. */
    setenv("LUTETIA_DISPLAY", "", 1);
    assert_false(CMFB_watched());
    CMFB_write_news_always(display, 0, solid, 0, 0);
    device_said("CMFB_write_news_always", "third");
    CMFB_spin(display);
    no_more();
}

static int start(void **unused)
{
    (void)unused;
    setenv("LUTETIA_DISPLAY", scratch_path("display"), 1);
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_are_written_in_news_order),
        cmocka_unit_test(the_shuffle_is_by_send_addresses),
        cmocka_unit_test(channels_may_be_fields),
        cmocka_unit_test(views_and_maps_are_told),
        cmocka_unit_test(wrong_calls_are_said_and_record_nothing),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
