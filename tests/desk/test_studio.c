/* test_studio.c - the parts of a studio that need neither a window nor a machine: the view, the
 * tables, recorded input, messages and pictures between threads, masks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <studio_input.h>
#include <studio_mask.h>
#include <studio_messages.h>
#include <studio_palette.h>
#include <studio_pictures.h>
#include <studio_settings.h>
#include <studio_swatch.h>
#include <studio_view.h>

/* ---- the view ---- */

/* At any zoom, turned and mirrored, a place of the canvas is the place of the sheet that is
 * drawn there. */
static void view_back_and_forth(void **state)
{
    (void)state;
    static const double zooms[] = {0.1, 0.37, 1, 2, 8};
    for (int i = 0; i < 5 * 8 * 2; i++) {
        const struct studio_view view = {.width = 801,
                                         .height = 600,
                                         .x0 = 321.5,
                                         .y0 = 77.25,
                                         .zoom = zooms[i % 5],
                                         .turn = i / 5 % 8 * 0.7,
                                         .mirrored = i >= 40};
        for (int k = 0; k < 9; k++) {
            const double x = 100 * (k % 3) - 3.7, y = 90 * (k / 3) + 1.2;
            const struct studio_place at = studio_view_to_sheet(&view, x, y),
                                      back = studio_view_to_canvas(&view, at.x, at.y);
            assert_true(fabs(back.x - x) < 1e-9 && fabs(back.y - y) < 1e-9);
        }
        /* a fiber to the right is a zoom's length away, in the direction that it is turned
         * to */
        const struct studio_place a = studio_view_to_canvas(&view, 10, 10),
                                  b = studio_view_to_canvas(&view, 11, 10);
        const double side = view.mirrored ? -1 : 1;
        assert_true(fabs(b.x - a.x - side * view.zoom * cos(view.turn)) < 1e-9);
        assert_true(fabs(b.y - a.y - side * view.zoom * sin(view.turn)) < 1e-9);
    }
}

static void view_changes_hold_their_place(void **state)
{
    (void)state;
    struct studio_view view = {.width = 800, .height = 600};
    studio_view_fit(&view, 400, 300);
    assert_true(view.zoom == 1 && view.x0 == 200 && view.y0 == 150);
    studio_view_fit(&view, 4000, 3000);
    assert_true(fabs(view.zoom - 0.192) < 1e-12);
    const struct studio_place place = studio_view_to_sheet(&view, 123, 456);
    for (int i = 0; i < 20; i++) {
        studio_view_zoom(&view, i < 10 ? 1.7 : 0.6, 123, 456);
        studio_view_turn(&view, 0.3, 123, 456);
        const struct studio_place now = studio_view_to_sheet(&view, 123, 456);
        assert_true(fabs(now.x - place.x) < 1e-6 && fabs(now.y - place.y) < 1e-6);
        assert_true(view.zoom >= STUDIO_ZOOM_MIN && view.zoom <= STUDIO_ZOOM_MAX);
    }
    studio_view_pan(&view, 10, -20);
    const struct studio_place now = studio_view_to_sheet(&view, 133, 436);
    assert_true(fabs(now.x - place.x) < 1e-6 && fabs(now.y - place.y) < 1e-6);
    const struct studio_place middle = studio_view_to_sheet(&view, 400, 300),
                              right = studio_view_to_sheet(&view, 500, 330);
    studio_view_mirror(&view);
    const struct studio_place left = studio_view_to_sheet(&view, 300, 330),
                              still = studio_view_to_sheet(&view, 400, 300);
    assert_true(fabs(left.x - right.x) < 1e-6 && fabs(left.y - right.y) < 1e-6);
    assert_true(fabs(still.x - middle.x) < 1e-6 && fabs(still.y - middle.y) < 1e-6);
}

/* ---- tables ---- */

static void tables_are_whole(void **state)
{
    (void)state;
    struct studio_settings settings;
    studio_settings_usual(&settings);
    for (int i = 0; i < STUDIO_SETTINGS; i++) {
        const struct control *row = &studio_controls[i];
        assert_non_null(row->name);
        assert_non_null(row->does);
        assert_int_equal(row->at, i);
        assert_true(row->least < row->most && row->usual >= row->least &&
                    row->usual <= row->most);
        assert_int_equal(stage_control_write(row, &settings, row->usual), STAGE_OK);
        assert_true(control_read(row, &settings) == row->usual);
        for (int k = 0; k < i; k++)
            assert_string_not_equal(row->name, studio_controls[k].name);
    }
    for (int i = 0; i < STUDIO_TOOLS; i++) {
        char name[64];
        assert_non_null(studio_tools[i].name);
        assert_int_equal(strlen(studio_tools[i].key), 1);
        control_text(&studio_controls[STUDIO_TOOL], i, name, sizeof name);
        assert_true(name[0] >= 'a' && name[0] <= 'z');
        for (int k = 0; k < i; k++)
            assert_string_not_equal(studio_tools[i].key, studio_tools[k].key);
    }
    for (int i = 0; paper_brush_kind(i); i++) { /* the choices are the kinds */
        char name[64];
        control_text(&studio_controls[STUDIO_BRUSH], i, name, sizeof name);
        assert_string_equal(name, paper_brush_kind(i));
        assert_true(i <= studio_controls[STUDIO_BRUSH].most);
        struct paper_brush kind = paper_brush_default();
        studio_settings_kind(&settings, i);
        kind.width = settings.value[STUDIO_WIDTH];
        assert_true(paper_brush_of_kind(&kind, paper_brush_kind(i)));
        const struct paper_brush made = studio_settings_brush(&settings);
        assert_true(made.depth == kind.depth && made.point == kind.point &&
                    fabs(made.reach - kind.reach) < 1e-9 && made.bristles == kind.bristles);
    }
    assert_false(paper_brush_of_kind(&(struct paper_brush){0}, "broom"));
}

/* ---- recorded input ---- */

static void input_lines(void **state)
{
    (void)state;
    struct studio_input in;
    char why[1000];
    assert_int_equal(studio_input_parse("0 jump", &in, why, sizeof why), -1);
    assert_non_null(strstr(why, "'jump'; there are down, move, "));
    assert_int_equal(studio_input_parse("0 set widht 3", &in, why, sizeof why), -1);
    assert_non_null(strstr(why, "'widht'; there are tool, brush, width, "));
    assert_int_equal(studio_input_parse("", &in, why, sizeof why), 0);
    assert_int_equal(studio_input_parse("  # a comment", &in, why, sizeof why), 0);
    assert_int_equal(
        studio_input_parse("0.25 down -12.5 40 0.5 0.1 -0.2", &in, why, sizeof why), 1);
    assert_int_equal(in.event.kind, INPUT_POINTER_DOWN);
    assert_true(in.event.time_s == 0.25 && in.event.x_px == -12.5 && in.event.y_px == 40);
    assert_true(in.event.pen && in.event.pressure == 0.5 && in.event.tilt_y == -0.2);
    assert_false(in.event.eraser);
    assert_int_equal(studio_input_parse("1 eraser-down 1 2 0.5", &in, why, sizeof why), 1);
    assert_true(in.event.eraser && in.event.pen && in.event.kind == INPUT_POINTER_DOWN);
    assert_int_equal(studio_input_parse("1 bookmark wet sky", &in, why, sizeof why), 1);
    assert_string_equal(in.text, "wet sky");
    assert_int_equal(studio_input_parse("1 bookmark", &in, why, sizeof why), -1);
    assert_int_equal(studio_input_parse("1 move 1 2", &in, why, sizeof why), 1);
    assert_false(in.event.pen);
    assert_int_equal(studio_input_parse("1 set tool wash", &in, why, sizeof why), 1);
    assert_int_equal(in.setting, STUDIO_TOOL);
    assert_true(in.value == STUDIO_TOOL_WASH);
    assert_int_equal(studio_input_parse("1 type 20 30 two\\nlines", &in, why, sizeof why), 1);
    assert_string_equal(in.text, "two\nlines");
    assert_true(in.x == 20 && in.y == 30);
    assert_int_equal(studio_input_parse("1 view 2 100 50 30 1", &in, why, sizeof why), 1);
    assert_true(in.zoom == 2 && in.x == 100 && in.y == 50 && in.degrees == 30 && in.mirrored);
    assert_int_equal(studio_input_parse("1 moment 12", &in, why, sizeof why), 1);
    assert_int_equal(in.kind, STUDIO_INPUT_MOMENT);
    assert_true(in.value == 12);
    assert_int_equal(studio_input_parse("1 moment -1", &in, why, sizeof why), -1);
    assert_int_equal(studio_input_parse("1 measure hand", &in, why, sizeof why), 1);
    assert_string_equal(in.name, "hand");
    assert_int_equal(studio_input_parse("1 undo", &in, why, sizeof why), 1);
    assert_string_equal(in.name, "undo");
    static const char *const wrong[] = {"x down 1 2",
                                        "1 fly",
                                        "1 down 1",
                                        "1 set width 0",
                                        "1 set wide 3",
                                        "1 set width",
                                        "-1 down 1 2",
                                        "nan down 1 2",
                                        "1 down 1 2 x",
                                        "1 step 0",
                                        "1 view 0 1 1 0 0",
                                        "1 undo all",
                                        "1 down 1 2 .5 0 0 0",
                                        "1 type 3 4",
                                        "1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        why[0] = '\0';
        assert_int_equal(studio_input_parse(wrong[i], &in, why, sizeof why), -1);
        assert_true(why[0]);
    }
}

/* ---- from thread to thread ---- */

enum { SENT = 50000 };
static struct studio_messages ring;

static void *taker(void *context)
{
    unsigned long *bad = context, expected = 1;
    while (expected <= SENT) {
        struct studio_message m;
        if (!studio_messages_take(&ring, &m)) {
            studio_messages_wait(&ring, 0.01);
            continue;
        }
        if (m.number != expected || m.point.x != (double)expected)
            (*bad)++;
        expected++;
        studio_message_free(&m);
    }
    return NULL;
}

/* Ten times as many as the ring has places, without a pause: each comes, once, in its order. */
static void messages_all_come_in_order(void **state)
{
    (void)state;
    unsigned long bad = 0;
    pthread_t thread;
    studio_messages_begin(&ring);
    for (int i = 1; i <= SENT; i++) {
        const unsigned long number = studio_messages_put(
            &ring, (struct studio_message){.kind = STUDIO_MESSAGE_POINT, .point = {.x = i}});
        assert_true(number == (unsigned long)i);
        if (i == STUDIO_MESSAGES_MAX + 100) /* from here on somebody takes them */
            assert_int_equal(pthread_create(&thread, NULL, taker, &bad), 0);
    }
    for (int i = 0; i < 100000 && ring.waiting_count > 0; i++) {
        studio_messages_flush(&ring);
        sched_yield();
    }
    while (ring.waiting_count > 0)
        studio_messages_flush(&ring);
    pthread_join(thread, NULL);
    assert_int_equal(bad, 0);
    studio_messages_finish(&ring);
}

enum { SIDE = 40, PICTURES = 3000 };
static struct studio_pictures pictures;

static void *painter(void *context)
{
    (void)context;
    for (int n = 1; n <= PICTURES; n++) { /* a square of number n, somewhere */
        const int x = n * 7 % (SIDE - 5), y = n * 11 % (SIDE - 5);
        for (int i = 0; i < 25; i++)
            memset(pictures.canvas + STUDIO_PIXEL * ((y + i / 5) * SIDE + x + i % 5), n & 255,
                   STUDIO_PIXEL);
        studio_pictures_publish(&pictures, &(struct studio_rectangle){x, y, x + 5, y + 5},
                                (unsigned long)n);
    }
    return NULL;
}

/* What is taken is a whole picture of one moment, and only within its rectangle is it another
 * than what was taken before. */
static void pictures_are_whole(void **state)
{
    (void)state;
    static uint8_t twin[STUDIO_PIXEL * SIDE * SIDE], shown[STUDIO_PIXEL * SIDE * SIDE];
    unsigned long done = 0;
    pthread_t thread;
    assert_true(studio_pictures_begin(&pictures, SIDE, SIDE));
    assert_null(studio_pictures_take(&pictures));
    assert_int_equal(pthread_create(&thread, NULL, painter, NULL), 0);
    while (done < PICTURES) {
        const struct studio_picture *p = studio_pictures_take(&pictures);
        if (!p) {
            sched_yield();
            continue;
        }
        assert_true(p->heard > done);
        for (unsigned long n = done + 1; n <= p->heard; n++) /* the same squares, here */
            for (int i = 0; i < 25; i++)
                memset(twin + STUDIO_PIXEL * (((int)n * 11 % (SIDE - 5) + i / 5) * SIDE +
                                              (int)n * 7 % (SIDE - 5) + i % 5),
                       (int)(n & 255), STUDIO_PIXEL);
        done = p->heard;
        for (int y = p->changed.top; y < p->changed.bottom; y++)
            memcpy(shown + STUDIO_PIXEL * (y * SIDE + p->changed.left),
                   p->pixels + STUDIO_PIXEL * (y * SIDE + p->changed.left),
                   (size_t)(STUDIO_PIXEL * (p->changed.right - p->changed.left)));
        assert_memory_equal(p->pixels, twin, sizeof twin);
        assert_memory_equal(shown, twin, sizeof twin);
    }
    pthread_join(thread, NULL);
    assert_true(studio_pictures_taken(&pictures));
    studio_pictures_finish(&pictures);
}

/* ---- masks and swatches ---- */

static void mask_is_where_the_hand_went(void **state)
{
    (void)state;
    const struct studio_disc discs[] = {{10, 20, 4}, {40, 20, 4}};
    struct paper_screen screen;
    int x, y;
    assert_int_equal(studio_mask_sweep(discs, 2, 100, 100, &screen, &x, &y), PAPER_OK);
    double sum = 0;
    for (int i = 0; i < screen.width_px * screen.height_px; i++)
        sum += screen.gray[i] / 255.0;
    assert_true(fabs(sum - (30 * 8 + 3.14159 * 16)) < 1.5); /* a bar with round ends */
    assert_int_equal(screen.gray[(19 - y) * screen.width_px + 25 - x], 255);
    assert_true(x >= 4 && x <= 6 && y >= 14 && y <= 16);
    paper_screen_destroy(&screen);
    const struct studio_disc away[] = {{-50, -50, 10}};
    assert_int_equal(studio_mask_sweep(away, 1, 100, 100, &screen, &x, &y), PAPER_OK);
    assert_null(screen.gray);
    const struct studio_disc edge[] = {{0, 99, 10}, {1e7, 99, 10}}; /* clipped, and quick */
    assert_int_equal(studio_mask_sweep(edge, 2, 100, 100, &screen, &x, &y), PAPER_OK);
    assert_true(screen.gray && x == 0 && x + screen.width_px == 100 &&
                y + screen.height_px == 100);
    paper_screen_destroy(&screen);
}

static void swatches_are_colours(void **state)
{
    (void)state;
    struct paper_sheet_config config = paper_sheet_config_default();
    config.stock = *paper_stock_find("cold press");
    config.pigments[config.pigments_count++] = *paper_pigment_find("french ultramarine");
    double none[1 + PAPER_PIGMENTS_MAX] = {1}, rgb[3], darker[3];
    studio_swatch(&config, none, rgb);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(rgb[i] - config.stock.color[i]) < 1e-9);
    none[1] = 0.5;
    studio_swatch(&config, none, rgb);
    none[1] = 1.5;
    studio_swatch(&config, none, darker);
    assert_true(rgb[2] > rgb[0] && rgb[2] > rgb[1]); /* blue */
    for (int i = 0; i < 3; i++)
        assert_true(darker[i] < rgb[i] && darker[i] > 0);
}

/* ---- palettes ---- */

static const char *palette_text(const char *text, struct studio_palette *out, bool good)
{
    static char why[300];
    struct paper_sheet_config config = paper_sheet_config_default();
    config.pigments[config.pigments_count++] = *paper_pigment_find("french ultramarine");
    config.pigments[config.pigments_count++] = *paper_pigment_find("quinacridone rose");
    why[0] = '\0';
    assert_int_equal(studio_palette_parse(text, &config, out, why, sizeof why), good);
    return why;
}

static void palettes_are_read(void **state)
{
    (void)state;
    struct studio_palette p;
    palette_text("# mine\n\n2: water 0.75, quinacridone rose 0.5\r\n 8 : \n", &p, false);
    palette_text("2: water 0.75, quinacridone rose 0.5,  french ultramarine 2\r\n8:", &p, true);
    assert_true(p.filled[1] && p.filled[7] && !p.filled[0]);
    assert_true(p.amount[1][0] == 0.75 && p.amount[1][1] == 2 && p.amount[1][2] == 0.5);
    assert_true(p.amount[7][0] == 0 && !p.missing[0]);
    palette_text("1: indian red 1, burnt umber 0.5\n2: indian red 0.5, water 1", &p, true);
    assert_string_equal(p.missing, "indian red, burnt umber");
    palette_text("1: indian red 1, red 0.5\n2: dian 1, red 0.5, indian red 1", &p, true);
    assert_string_equal(p.missing, "indian red, red, dian"); /* none is in another's name */
    static const struct {
        const char *text, *says;
    } wrong[] = {{"", "no well"},
                 {"1: water 1\n9: water 1", "line 2: a well is 1..8"},
                 {"1: water 1\n\n1: water 1", "line 3: well 1 is there twice"},
                 {"1: water", "line 1: a name and an amount, not 'water'"},
                 {"1: water 2.5", "line 1: an amount is 0..2, not '2.5'"},
                 {"1: water nan", "0..2, not 'nan'"},
                 {"1:  0.5", "a name and an amount"},
                 {"1: water 1 x", "0..2, not 'x'"},
                 {"water 1", "line 1: a well is"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_non_null(strstr(palette_text(wrong[i].text, &p, false), wrong[i].says));
}

static void palettes_are_written(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-palette-XXXXXX", why[300] = "";
    struct paper_sheet_config config = paper_sheet_config_default();
    struct studio_palette p = {0}, again;
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    config.pigments[config.pigments_count++] = *paper_pigment_find("french ultramarine");
    for (int i = 0; i < STUDIO_WELLS; i++) {
        p.amount[i][0] = i / 3.0 / 2;
        p.amount[i][1] = i % 2 ? 0 : nextafter(0.1 * i, 2);
    }
    assert_true(studio_palette_write(path, &config, &p, why, sizeof why));
    assert_true(studio_palette_read(path, &config, &again, why, sizeof why));
    assert_memory_equal(again.amount, p.amount, sizeof p.amount);
    unlink(path);
    assert_false(studio_palette_read(path, &config, &again, why, sizeof why));
    assert_non_null(strstr(why, path));
    assert_false(studio_palette_write("/proc/none/a", &config, &p, why, sizeof why));
    assert_non_null(strstr(why, "/proc/none/a: cannot write"));
    assert_false(studio_palette_read("/bin/sh", &config, &again, why, sizeof why));
    assert_non_null(strstr(why, "/bin/sh: it is no palette"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(view_back_and_forth),
        cmocka_unit_test(view_changes_hold_their_place),
        cmocka_unit_test(tables_are_whole),
        cmocka_unit_test(input_lines),
        cmocka_unit_test(messages_all_come_in_order),
        cmocka_unit_test(pictures_are_whole),
        cmocka_unit_test(mask_is_where_the_hand_went),
        cmocka_unit_test(swatches_are_colours),
        cmocka_unit_test(palettes_are_read),
        cmocka_unit_test(palettes_are_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
