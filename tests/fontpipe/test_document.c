/* test_document.c - PDF as other programs see it: sound, its fonts embedded and named, its
 * letters where the painter has them, its pages, its title, its outline and its tags. */
#include "../skip.h"
#include "support.h"

#include <document.h>
#include <page.h>
#include <paint.h>
#include <setup.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool has_program(const char *name)
{
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null", name);
    return system(command) == 0;
}

/* What a program prints of a file. Owns: the caller frees it. */
static char *printed(const char *program, const char *path, const char *more, int *rc)
{
    char command[512], *out = calloc(1, 1 << 20);
    snprintf(command, sizeof command, "%s %s %s", program, path, more);
    FILE *pipe = popen(command, "r");
    assert_non_null(out);
    assert_non_null(pipe);
    (void)!fread(out, 1, (1 << 20) - 1, pipe);
    *rc = pclose(pipe);
    return out;
}

static void sound(const char *path)
{
    int rc;
    if (!has_program("qpdf"))
        return;
    char *said = printed("qpdf --check", path, "2>&1", &rc);
    if (rc)
        fail_msg("qpdf: %s", said);
    free(said);
}

/* ---- letters ---- */

enum { WIDTH = 330, HEIGHT = 56, FINER = 32 };

/* The page as another program draws it, 32 times as fine, and that made as small again: how
 * dark each pixel is. It covers each fine pixel that an outline touches: an edge is half of one
 * too far out, 4 of 255. */
static double *shown(const char *path)
{
    char command[256], gray[80];
    snprintf(gray, sizeof gray, "%s.gray", path);
    snprintf(command, sizeof command,
             "pdftoppm -gray -singlefile -aa no -aaVector no -r %d %s %s.gray", 96 * FINER,
             path, path);
    assert_int_equal(system(command), 0);
    snprintf(gray, sizeof gray, "%s.gray.pgm", path);
    FILE *f = fopen(gray, "r");
    int width = 0, height = 0;
    assert_non_null(f);
    assert_int_equal(fscanf(f, "P5 %d %d 255", &width, &height), 2);
    fgetc(f);
    assert_true(width == WIDTH * FINER && height == HEIGHT * FINER);
    double *dark = calloc(WIDTH * HEIGHT, sizeof *dark);
    uint8_t *row = malloc(WIDTH * FINER);
    assert_non_null(dark);
    assert_non_null(row);
    for (int y = 0; y < HEIGHT * FINER; y++) {
        assert_int_equal(fread(row, 1, WIDTH * FINER, f), WIDTH * FINER);
        for (int x = 0; x < WIDTH * FINER; x++)
            dark[y / FINER * WIDTH + x / FINER] += (255.0 - row[x]) / (FINER * FINER);
    }
    fclose(f);
    unlink(gray);
    free(row);
    return dark;
}

static uint8_t *painted(const struct font_layout *l, double x, double y)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    uint8_t *pixels = malloc(3 * WIDTH * HEIGHT);
    assert_non_null(pixels);
    memset(pixels, 255, 3 * WIDTH * HEIGHT);
    def.filter = "box";
    def.darken_px = 0;
    assert_font(font_painter_create(&def, &painter));
    struct font_picture to = {WIDTH, HEIGHT, 3 * WIDTH, pixels};
    assert_font(font_painter_layout(painter, l, NULL, x, y, &to));
    font_painter_destroy(painter);
    return pixels;
}

/* Faces of each kind, and how `pdffonts` calls what is embedded. A variable one at its axes'
 * places comes by `axes`. */
static const struct {
    const char *font, *kind, *name;
} faces[] = {
    {"DejaVuSerif", "CID TrueType", "+DejaVuSerif"},
    {"EBGaramond12-Regular", "CID Type 0C", "+EBGaramond12-Regular"},
    {"EBGaramond12-Italic", "CID Type 0C", "+EBGaramond12-Italic"},
    {"C059-Italic.otf", "CID Type 0C", "+C059-Italic"},
    {"/usr/share/fonts/X11/Type1/C059-Bold.pfb", "CID Type 0C", "+C059-Bold"},
};

/* A line of each face, in PDF, is what the painter draws, and its font is embedded as a
 * font. */
static void letters_are_where_they_are_painted(void **state)
{
    (void)state;
    if (!has_program("pdftoppm") || !has_program("pdffonts"))
        skip_because("poppler-utils is not installed");
    static const char text[] = "Quay, fjord & Æg \xe2\x80\x93 35%";
    int tried = 0;
    for (size_t n = 0; n < sizeof faces / sizeof *faces; n++) {
        struct font_face *face;
        struct font_layout l;
        char path[] = "/tmp/lutetia-document-XXXXXX";
        int rc;
        if (font_face_open(faces[n].font, 0, &face) != FONT_OK)
            continue;
        struct font_shaper *s = shaper_make(face);
        assert_font(font_shaper_layout(s, text, strlen(text), 30.3, NULL, &l));
        const struct font_ink ink = {
            .kind = FONT_INK_PLAIN, .rgba = {0, 0, 0, 1}, .numbers = true};
        assert_int_equal(font_layout_ink_add(&l, &ink), 1);
        for (int i = 0; i < l.glyphs_count; i++)
            l.glyphs[i].ink = 1;
        const struct font_drawing d = {
            .width_px = WIDTH, .height_px = HEIGHT, .text = text, .bytes = strlen(text)};
        int file = mkstemp(path);
        FILE *f = fdopen(file, "w");
        assert_non_null(f);
        assert_font(font_drawing_pdf(&d, &l, NULL, 8.4, 36.7, f));
        fclose(f);
        sound(path);
        char *fonts = printed("pdffonts", path, "", &rc);
        if (!strstr(fonts, faces[n].kind) || !strstr(fonts, faces[n].name) ||
            !strstr(fonts, "yes yes yes"))
            fail_msg("%s is embedded as\n%s", faces[n].font, fonts);
        double *got = shown(path), sum = 0, most = 0;
        uint8_t *wanted = painted(&l, 8.4, 36.7);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            double difference = got[i] - (255.0 - wanted[3 * i]);
            difference = difference < 0 ? -difference : difference;
            most = difference > most ? difference : most;
            sum += difference;
        }
        print_message("%s: at most %.1f of 255, %.3f in the mean\n", faces[n].font, most,
                      sum / (WIDTH * HEIGHT));
        assert_true(most < 24 && sum / (WIDTH * HEIGHT) < 0.5);
        tried++;
        unlink(path);
        free(fonts);
        free(got);
        free(wanted);
        font_layout_finish(&l);
        font_shaper_destroy(s);
        font_face_close(face);
    }
    assert_true(tried >= 3);
}

/* ---- beside letters ---- */

/* A box under the letter, and a stroke over it that crosses itself: it is as dark there as
 * elsewhere, and numbers beyond all pages do no harm. */
static void boxes_and_strokes_lie_beside_letters(void **state)
{
    (void)state;
    static const struct font_drawing_point cross[] = {
        {200, 8, 8}, {240, 48, 8}, {240, 8, 8}, {200, 48, 8}};
    static const struct font_drawing_point far[] = {{1e9, 1e300, 2}, {-1e9, -1e300, 1e-9}};
    const struct font_drawing_stroke strokes[] = {{cross, 4, {0, 0, 0, 0.4}},
                                                  {far, 2, {0, 0, 0, 0}}};
    const struct font_drawing_box box = {10, 10, 100, 40, {0.6, 0.6, 0.6, 1}};
    const struct font_drawing d = {.width_px = WIDTH,
                                   .height_px = HEIGHT,
                                   .boxes = &box,
                                   .boxes_count = 1,
                                   .strokes = strokes,
                                   .strokes_count = 2};
    struct font_face *face = face_open("DejaVuSans");
    struct font_shaper *s = shaper_make(face);
    struct font_layout l;
    char path[] = "/tmp/lutetia-document-XXXXXX", *svg = NULL;
    size_t bytes;
    assert_font(font_shaper_layout(s, "\xe2\x96\x88", 3, 30, NULL, &l)); /* a full block */
    FILE *f = fdopen(mkstemp(path), "w"), *text = open_memstream(&svg, &bytes);
    assert_true(f && text);
    assert_font(font_drawing_pdf(&d, &l, NULL, 40, 36, f));
    assert_font(font_drawing_svg(&d, &l, NULL, 40, 36, text));
    fclose(f);
    fclose(text);
    sound(path);
    if (has_program("pdftoppm")) {
        double *dark = shown(path);
        assert_true(fabs(dark[30 * WIDTH + 20] - 102) < 2);  /* the box */
        assert_true(fabs(dark[30 * WIDTH + 50] - 255) < 2);  /* the letter over it */
        assert_true(fabs(dark[18 * WIDTH + 210] - 102) < 2); /* the stroke */
        assert_true(fabs(dark[28 * WIDTH + 220] - 102) < 2); /* where it crosses itself */
        assert_true(fabs(dark[18 * WIDTH + 240] - 102) < 2);
        assert_true(dark[30 * WIDTH + 300] < 1);
        free(dark);
    }
    const char *under = strstr(svg, "<rect x=\"10.000\""), *letter = strstr(svg, "<use "),
               *over = strstr(svg, "<g fill=\"none\"");
    assert_true(under && letter && over && under < letter && letter < over);
    assert_non_null(strstr(svg, "opacity=\"0.4\">\n<path stroke-width=\"8.000\" "
                                "d=\"M200.000,8.000L200.000,8.000L240.000,48.000"));
    unlink(path);
    free(svg);
    font_layout_finish(&l);
    font_shaper_destroy(s);
    font_face_close(face);
}

/* ---- books ---- */

static const char book[] =
    "## Before\n\nA preface.\n\n# The *first* part\n\nWater rises[^By night.]. It goes on and "
    "on, "
    "and on, until the page has come to its end and the paragraph goes over to the one behind "
    "it, which is short, as all of them here are, so that there be some.\n\n- one\n- two\n\n> "
    "said\n\n* * *\n\n## A part of it\n\nText.\n\n# The second part\n\nThe end.\n";

/* Sets the book, on pages so high. How many there are. */
static int book_write(const char *path, double height)
{
    struct page_setup setup = page_setup_default();
    struct page_text *t;
    int count;
    const struct font_document_def def = {.title = "A <book> & more", .language = "en"};
    struct font_document *document;
    setup.width_px = 260;
    setup.height_px = height;
    setup.margin_px = 20;
    assert_font(page_setup_make(&setup, book, strlen(book), &t));
    assert_font(page_count(t, &count));
    assert_font(font_document_create(&def, &document));
    for (int i = 0; i < count; i++) {
        struct font_layout l;
        struct page_said said;
        assert_font(page_layout_said(t, i, &l, &said));
        const struct font_drawing d = {.width_px = 260,
                                       .height_px = height,
                                       .text = said.utf8,
                                       .bytes = said.bytes,
                                       .passages = said.passages,
                                       .passages_count = said.passages_count};
        assert_font(font_document_page(document, &d, &l, NULL, 0, 0));
        font_layout_finish(&l);
        page_said_finish(&said);
    }
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_font(font_document_write(document, f));
    assert_int_equal(font_document_write(document, f), FONT_BAD_ARGUMENT);
    fclose(f);
    font_document_destroy(document);
    page_text_destroy(t);
    return count;
}

static int times(const char *in, const char *what)
{
    int n = 0;
    for (; (in = strstr(in, what)); in += strlen(what))
        n++;
    return n;
}

static void books_have_tags_and_a_title(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-document-XXXXXX", pages[32];
    int rc;
    if (!has_program("pdfinfo"))
        skip_because("poppler-utils is not installed");
    close(mkstemp(path));
    int count = book_write(path, 200);
    assert_true(count >= 3);
    sound(path);
    char *info = printed("pdfinfo", path, "", &rc),
         *tree = printed("pdfinfo -struct-text", path, "2>&1", &rc);
    snprintf(pages, sizeof pages, "Pages:           %d\n", count);
    assert_non_null(strstr(info, "A <book> & more"));
    assert_non_null(strstr(info, "Tagged:          yes"));
    assert_non_null(strstr(info, pages));
    /* A heading that begins one level too deep is brought up; the paragraph on two pages is
     * one. */
    assert_int_equal(times(tree, "H1 (block)"), 3);
    assert_int_equal(times(tree, "H2 (block)"), 1);
    assert_int_equal(times(tree, "P (block)"), 5);
    assert_int_equal(times(tree, "L (block)"), 1);
    assert_int_equal(times(tree, "LI (block)"), 2);
    assert_int_equal(times(tree, "BlockQuote"), 1);
    assert_int_equal(times(tree, "Note <"), 1);
    assert_int_equal(times(tree, "* * *"), 0);
    assert_non_null(strstr(tree, "over to the one"));
    /* A note has a name, by which it is found. */
    char *names = printed("grep -a -A 1 '/Names \\['", path, "", &rc);
    assert_int_equal(times(names, "(note-"), 1);
    free(names);
    names = printed("grep -a -c /IDTree", path, "", &rc);
    assert_string_equal(names, "1\n");
    free(names);
    free(info);
    free(tree);
    unlink(path);
}

static void books_have_an_outline(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-document-XXXXXX";
    int rc;
    if (!has_program("qpdf"))
        skip_because("qpdf is not installed");
    close(mkstemp(path));
    book_write(path, 200);
    char *json = printed("qpdf --json --json-key=outlines", path, "", &rc);
    assert_int_equal(rc, 0);
    assert_int_equal(times(json, "\"title\": \"Before\""), 1);
    assert_int_equal(times(json, "\"title\": \"The first part\""), 1);
    assert_int_equal(times(json, "\"title\": \"A part of it\""), 1);
    /* "A part of it" is within the first part: an entry's title comes behind those that it
     * has. */
    const char *part = strstr(json, "\"A part of it\""),
               *first = strstr(json, "\"The first part\"");
    assert_true(strstr(json, "\"Before\"") < part && part < first &&
                first < strstr(json, "\"The second part\""));
    assert_int_equal(times(json, "\"kids\": []"), 3);
    free(json);
    unlink(path);
}

/* A paragraph that goes on in another column or page loses no letter there. */
static void words_go_on_behind_pages(void **state)
{
    (void)state;
    char path[] = "/tmp/lutetia-document-XXXXXX";
    int rc;
    if (!has_program("pdftotext"))
        skip_because("poppler-utils is not installed");
    for (double height = 120; height < 240; height += 17) {
        close(mkstemp(path));
        book_write(path, height);
        char *text = printed("pdftotext -enc UTF-8", path, "-", &rc);
        int letters = 0, wanted = 0;
        for (const char *at = text; *at; at++)
            letters += *at >= 'a' && *at <= 'z';
        for (const char *at = book; *at; at++)
            wanted += *at >= 'a' && *at <= 'z';
        if (letters != wanted)
            fail_msg("pages of %g: %d letters of %d in\n%s", height, letters, wanted, text);
        free(text);
        unlink(path);
        memcpy(path + sizeof path - 7, "XXXXXX", 6);
    }
}

static void documents_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const struct font_document_def def = {NULL, NULL};
    struct font_document *document;
    assert_font(font_document_create(&def, &document));
    FILE *f = tmpfile();
    assert_non_null(f);
    assert_int_equal(font_document_write(document, f), FONT_BAD_ARGUMENT);
    font_document_destroy(document);
    font_document_destroy(NULL);
    fclose(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_where_they_are_painted),
        cmocka_unit_test(boxes_and_strokes_lie_beside_letters),
        cmocka_unit_test(books_have_tags_and_a_title),
        cmocka_unit_test(books_have_an_outline),
        cmocka_unit_test(words_go_on_behind_pages),
        cmocka_unit_test(documents_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests_name("documents", tests, NULL, NULL);
}
