/* test_drawing.c - text as drawings in SVG and PDF: all letters, their text, inks. */
#include "../skip.h"
#include "pdf_unpack.h"
#include "support.h"

#include <drawing.h>
#include <paint.h>

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char marsh[] =
    "The water of a marsh carries pigment through the sheets; what it leaves dries dark";

static char *drawn(const struct font_layout *l, bool pdf, size_t *bytes)
{
    const struct font_drawing d = {
        .width_px = 500, .height_px = 500, .text = marsh, .bytes = strlen(marsh)};
    char *out = NULL;
    FILE *file = open_memstream(&out, bytes);
    assert_non_null(file);
    assert_font(pdf ? font_drawing_pdf(&d, l, NULL, 0, 0, file)
                    : font_drawing_svg(&d, l, NULL, 0, 0, file));
    fclose(file);
    return out;
}

static int count_of(const char *in, const char *what)
{
    int n = 0;
    for (const char *at = in; (at = strstr(at, what)); at += strlen(what))
        n++;
    return n;
}

static void drawings_have_all_letters(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSerif");
    struct font_shaper *s = shaper_make(face);
    struct font_text_options options = {
        .features = "-liga,-dlig", .width_px = 190, .align = FONT_ALIGN_JUSTIFY};
    struct font_layout layout, *l = &layout;
    size_t bytes;
    assert_font(font_shaper_layout(s, marsh, strlen(marsh), 14, &options, &layout));
    char *svg = drawn(l, false, &bytes);
    assert_int_equal(count_of(svg, "<use "), l->glyphs_count);
    assert_int_equal(count_of(svg, "<text "), l->glyphs[l->glyphs_count - 1].line + 1);
    assert_true(count_of(svg, "<path ") < 40);
    free(svg);
    char *pdf = drawn(l, true, &bytes);
    assert_memory_equal(pdf, "%PDF-1.7", 8);
    /* Each object begins at its offset in the xref table. */
    const char *start = memmem(pdf, bytes, "startxref", 9);
    assert_non_null(start);
    const char *table = pdf + atol(start + 10);
    assert_memory_equal(table, "xref\n", 5);
    const char *row = strstr(table, "65535 f \n") + 9;
    for (int i = 1; row[11] == '0' && row[17] == 'n'; i++, row += 20) {
        char wanted[32];
        snprintf(wanted, sizeof wanted, "%d 0 obj", i);
        assert_memory_equal(pdf + atol(row), wanted, strlen(wanted));
    }
    free(pdf);
    font_layout_finish(&layout);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* Drawings define each gradient once, in the page's coordinates, and fill letters with it. */
static void drawings_have_gradients(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    const struct font_ink inks[] = {
        {.kind = FONT_INK_LINEAR,
         .x1 = 100,
         .stops_count = 3,
         .stops = {{0, {1, 0, 0, 1}}, {0.25, {0, 1, 0, 1}}, {1, {0, 0, 1, 1}}}},
        {.kind = FONT_INK_RADIAL,
         .x0 = 80,
         .x1 = 40,
         .stops_count = 2,
         .stops = {{0, {1, 1, 0, 1}}, {1, {0, 1, 1, 1}}}},
    };
    size_t bytes;
    assert_font(font_shaper_layout(s, "abcdef", 6, 30, NULL, &l));
    for (int i = 0; i < l.glyphs_count; i++) {
        if (i % 3 == 0)
            assert_true(font_layout_ink_add(&l, &inks[i / 3]) > 0);
        l.glyphs[i].ink = i / 3 + 1;
    }
    char *file = drawn(&l, true, &bytes), *pdf = pdf_unpacked(file, bytes);
    assert_int_equal(count_of(pdf, "/ShadingType 2 /Coords [0 0 100 0]"), 1);
    assert_int_equal(count_of(pdf, "/ShadingType 3 /Coords [80 0 0 80 0 40]"), 1);
    assert_int_equal(count_of(pdf, "/Bounds [ 0.0000010 0.2500000 0.9999990 ]"), 1);
    assert_int_equal(count_of(pdf, "/Pattern cs /P1 scn"), 1);
    assert_int_equal(count_of(pdf, "/Pattern cs /P2 scn"), 1);
    free(file);
    free(pdf);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

enum { SHOWN_WIDTH = 400, SHOWN_HEIGHT = 300 };

/* What another program makes of a drawing, over white. NULL: there is no such program. */
static uint8_t *shown(const struct font_layout *l, const char *text, bool pdf)
{
    const struct font_drawing d = {.width_px = SHOWN_WIDTH,
                                   .height_px = SHOWN_HEIGHT,
                                   .text = text,
                                   .bytes = strlen(text)};
    char folder[] = "/tmp/lutetia-drawing-XXXXXX", path[64], out[64], command[256];
    if (system(pdf ? "command -v pdftocairo >/dev/null" : "command -v rsvg-convert >/dev/null"))
        return NULL;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/drawing", folder);
    snprintf(out, sizeof out, "%s/shown.png", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_font(pdf ? font_drawing_pdf(&d, l, NULL, 20, 80, file)
                    : font_drawing_svg(&d, l, NULL, 20, 80, file));
    fclose(file);
    snprintf(command, sizeof command,
             pdf ? "pdftocairo -png -singlefile -r 96 %s %s/shown"
                 : "rsvg-convert %s -o %s/shown.png",
             path, folder);
    assert_int_equal(system(command), 0);
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, out));
    image.format = PNG_FORMAT_RGBA;
    assert_true(image.width == SHOWN_WIDTH && image.height == SHOWN_HEIGHT);
    uint8_t *pixels = malloc(PNG_IMAGE_SIZE(image));
    assert_non_null(pixels);
    assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
    for (int i = 0; i < SHOWN_WIDTH * SHOWN_HEIGHT; i++)
        for (int c = 0; c < 3; c++) /* over white, as numbers */
            pixels[3 * i + c] =
                (uint8_t)(255 + (pixels[4 * i + c] - 255) * pixels[4 * i + 3] / 255);
    unlink(path);
    unlink(out);
    rmdir(folder);
    return pixels;
}

static uint8_t *painted(const struct font_layout *l)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    uint8_t *pixels = malloc(3 * SHOWN_WIDTH * SHOWN_HEIGHT);
    assert_non_null(pixels);
    memset(pixels, 255, 3 * SHOWN_WIDTH * SHOWN_HEIGHT);
    def.filter = "box";
    def.darken_px = 0;
    assert_font(font_painter_create(&def, &painter));
    struct font_picture to = {SHOWN_WIDTH, SHOWN_HEIGHT, 3 * SHOWN_WIDTH, pixels};
    assert_font(font_painter_layout(painter, l, NULL, 20, 80, &to));
    font_painter_destroy(painter);
    return pixels;
}

/* Translucent gradients and a picture as ink look as the painter draws them, by programs that
 * show SVG and PDF. Those mix numbers, and cover edges less exactly. */
static void drawings_look_as_painted(void **state)
{
    (void)state;
    static const char text[] = "Ag&Bo\nQuay%\npicture";
    static uint8_t tile[24 * 16 * 3];
    for (int i = 0; i < 24 * 16; i++) {
        tile[3 * i] = (uint8_t)(i % 24 * 10);
        tile[3 * i + 1] = (uint8_t)(i / 24 * 15);
        tile[3 * i + 2] = (i % 24 / 4 + i / 24 / 4) % 2 ? 220 : 40;
    }
    const struct font_ink inks[] = {
        {.kind = FONT_INK_LINEAR,
         .x1 = 300,
         .y1 = 40,
         .stops_count = 3,
         .stops = {{0, {1, 0, 0, 1}}, {0.4, {0, 0.7, 0, 0.2}}, {1, {0, 0, 1, 1}}},
         .numbers = true},
        {.kind = FONT_INK_RADIAL,
         .x0 = 150,
         .y0 = 90,
         .x1 = 120,
         .stops_count = 2,
         .stops = {{0, {1, 0.8, 0, 1}}, {1, {0.4, 0, 0.6, 0.5}}},
         .numbers = true},
        {.kind = FONT_INK_PICTURE,
         .x0 = 5,
         .y0 = 3,
         .rgb = tile,
         .width_px = 24,
         .height_px = 16,
         .pitch = 72,
         .rgba = {0, 0, 0, 0.8},
         .numbers = true}};
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    assert_font(font_shaper_layout(s, text, strlen(text), 80, NULL, &l));
    for (int k = 0; k < 3; k++)
        assert_int_equal(font_layout_ink_add(&l, &inks[k]), k + 1);
    for (int i = 0; i < l.glyphs_count; i++)
        l.glyphs[i].ink = l.glyphs[i].line + 1;
    uint8_t *wanted = painted(&l);
    int looked = 0;
    for (int pdf = 0; pdf < 2; pdf++) {
        uint8_t *got = shown(&l, text, pdf);
        double sum = 0;
        int most = 0;
        for (int i = 0; got && i < 3 * SHOWN_WIDTH * SHOWN_HEIGHT; i++) {
            int difference = abs(got[i] - wanted[i]);
            most = difference > most ? difference : most;
            sum += difference;
        }
        sum /= 3 * SHOWN_WIDTH * SHOWN_HEIGHT;
        if (got)
            print_message("%s: at most %d of 255, %.3f in the mean\n", pdf ? "PDF" : "SVG",
                          most, sum);
        assert_true(most <= 30 && sum < 0.5);
        looked += got != NULL;
        free(got);
    }
    free(wanted);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
    if (!looked)
        skip_because("no font here has such drawings");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawings_have_all_letters),
        cmocka_unit_test(drawings_have_gradients),
        cmocka_unit_test(drawings_look_as_painted),
    };
    return cmocka_run_group_tests_name("drawings", tests, NULL, NULL);
}
