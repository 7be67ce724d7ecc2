/* test_edits.c - edits of a font at the levels of the pipeline: what was edited is what is
 * drawn, and what is damaged is refused by name.
 *
 * The oracles count: a master's pixels within a pixel of the picture are its gray, and a ray
 * through a pixel's middle tells whether an outline covers it. */
#include "edits_support.h"

#include <display.h>
#include <edits.h>
#include <levels.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- oracles ---- */

/* Whether an outline of lines covers a point: how often a ray to the left meets it. */
static bool covers(const struct font_outline *o, double x, double y)
{
    int winding = 0;
    for (int i = 0; i < o->segments_count; i++) {
        struct font_point a = o->segments[i].p[0], b = o->segments[i].p[1];
        assert_int_equal(o->segments[i].degree, 1);
        if ((a.y <= y) == (b.y <= y))
            continue;
        if (a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y) < x)
            winding += b.y > a.y ? 1 : -1;
    }
    return winding != 0;
}

static void a_masters_outline_covers_its_pixels(void **state)
{
    (void)state;
    enum { SIDE = 37, EM = 50, UNITS = 1000 };
    uint32_t seed = 37;
    for (int trial = 0; trial < 60; trial++) {
        uint8_t picture[SIDE * SIDE];
        int width = 1 + (int)random_below(&seed, SIDE),
            height = 1 + (int)random_below(&seed, SIDE);
        struct font_master m = {0};
        struct font_outline exact, rough;
        for (int i = 0; i < width * height; i++)
            picture[i] = (int)random_below(&seed, 4) <= trial % 4 ? 0 : 255;
        assert_font(font_master_from_picture(
            &m, &(struct font_master_frame){EM, -5, -20, width, height, 30}, picture));
        assert_font(font_master_outline(&m, UNITS, false, &exact));
        assert_font(font_master_outline(&m, UNITS, true, &rough));
        assert_true(exact.prepared && exact.advance == 600 && rough.advance == 600);
        for (int r = -1; r <= height; r++)
            for (int c = -1; c <= width; c++) {
                bool inside = r >= 0 && c >= 0 && r < height && c < width;
                double x = (c - 5 + 0.5) * UNITS / EM, y = -(r - 20 + 0.5) * UNITS / EM;
                bool black = inside && picture[r * width + c] < 128;
                assert_int_equal(covers(&exact, x, y), black);
                assert_int_equal(covers(&rough, x + 0.01, y + 0.003), black);
            }
        font_outline_finish(&exact);
        font_outline_finish(&rough);
        font_master_finish(&m);
    }
}

/* A master at 8 pixels to one of the picture's: its gray is how many of 64 are black. */
static void a_retouched_master_is_what_is_drawn(void **state)
{
    (void)state;
    enum { FINE = 8, SIZE = 24, EM = FINE * SIZE, PAGE = 64, ORIGIN = 24 };
    char file[FONT_EDITS_FILE_BYTES], path[600];
    const char *folder = folder_with("master", "&", FONT_EDITS_MASTER, NULL, EM, file);
    assert_string_equal(file, "ampersand.png");
    int em, left, top;
    char list[2048];
    const char *row = strstr(text_of(folder, "edits.txt", list, sizeof list), "ampersand.png");
    assert_int_equal(sscanf(row, "ampersand.png %*s %d %d %d", &em, &left, &top), 3);
    assert_int_equal(em, EM);
    struct display_image image = {0};
    snprintf(path, sizeof path, "%s/%s", folder, file);
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    /* As it was written it is no edit. */
    struct font_face *face;
    assert_font(font_edits_open(folder, 0, false, &face));
    uint32_t glyph = font_face_glyph(face, '&');
    assert_false(font_face_is_replaced(face, glyph));
    font_face_close(face);
    for (int r = 0; r < 30; r++) /* a stroke by hand, aslant */
        for (int c = 0; c < 9; c++)
            image.pixels[(r + 40) * image.width_px + 20 + r + c] = r % 7 == 3 ? 255 : 0;
    assert_int_equal(display_png_write(path, &image), DISPLAY_OK);
    assert_font(font_edits_open(folder, 0, false, &face));
    assert_null(font_edits_said());
    assert_true(font_face_is_replaced(face, glyph));

    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_shaper *shaper = shaper_make(face);
    struct font_layout layout;
    static uint8_t gray[PAGE * PAGE];
    memset(gray, 0, sizeof gray);
    struct font_cover cover = {PAGE, PAGE, PAGE, gray};
    def.filter = "box";
    def.darken_px = 0;
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_shaper_layout(shaper, "&", 1, SIZE, NULL, &layout));
    assert_font(font_painter_cover(painter, &layout, NULL, ORIGIN, ORIGIN + 8, &cover));
    long ink = 0;
    for (int y = 0; y < PAGE; y++)
        for (int x = 0; x < PAGE; x++) {
            int black = 0;
            for (int i = 0; i < FINE * FINE; i++) {
                int c = (x - ORIGIN) * FINE + i % FINE - left;
                int r = (y - ORIGIN - 8) * FINE + i / FINE - top;
                if (c >= 0 && r >= 0 && c < image.width_px && r < image.height_px)
                    black += image.pixels[r * image.width_px + c] < 128;
            }
            ink += black;
            double wanted = 255.0 * black / (FINE * FINE);
            if (fabs(wanted - gray[y * PAGE + x]) > 1)
                fail_msg("(%d, %d): %d for %.2f", x, y, gray[y * PAGE + x], wanted);
        }
    assert_true(ink > 5000);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    font_painter_destroy(painter);
    font_face_close(face);
    display_image_destroy(&image);
}

/* ---- outlines ---- */

static struct font_outline outline_of(const char *folder, const char *glyph)
{
    struct font_face *face;
    struct font_outline o;
    uint32_t index;
    assert_font(font_edits_open(folder, 0, false, &face));
    assert_font(font_face_glyph_named(face, glyph, &index));
    assert_true(font_face_is_replaced(face, index));
    assert_font(font_face_outline_raw(face, index, &o));
    font_face_close(face);
    return o;
}

/* Written out and taken in again with another advance, an outline is the same but for that. */
static void outlines_come_back(void **state)
{
    (void)state;
    static const char *const fonts[] = {".svg", ".glif"};
    struct font_face *face = face_open("DejaVuSans");
    for (int k = 0; k < 2; k++) {
        char file[FONT_EDITS_FILE_BYTES], text[1 << 15];
        const char *folder =
            folder_with(fonts[k] + 1, "ampersand", FONT_EDITS_OUTLINE, fonts[k], 100, file);
        text_of(folder, file, text, sizeof text);
        char *width = strstr(text, k ? "width=\"1597\"" : " 1597 ");
        assert_non_null(width);
        memcpy(width + (k ? 7 : 1), "1600", 4);
        put_text(folder, file, text);
        struct font_outline own, read = outline_of(folder, "&");
        assert_font(font_face_outline_raw(face, font_face_glyph(face, '&'), &own));
        assert_true(own.advance == 1597 && read.advance == 1600);
        assert_int_equal(own.segments_count, read.segments_count);
        /* A contour may begin elsewhere: each segment is one of the others. */
        for (int i = 0; i < own.segments_count; i++) {
            const struct font_segment *s = &own.segments[i];
            bool found = false;
            for (int n = 0; n < read.segments_count && !found; n++) {
                found = read.segments[n].degree == s->degree;
                for (int p = 0; found && p <= s->degree; p++)
                    found = fabs(read.segments[n].p[p].x - s->p[p].x) < 1e-4 &&
                            fabs(read.segments[n].p[p].y - s->p[p].y) < 1e-4;
            }
            assert_true(found);
        }
        font_outline_finish(&own);
        font_outline_finish(&read);
    }
    font_face_close(face);
}

/* Files that other programs could have written, and the points that are in them. */
static void outlines_of_other_programs_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int segments;
        double advance, area; /* in font units; positive where it turns counterclockwise */
    } files[] = {
        {"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 -800 500 1000'>"
         "<path d='M0,0h100v-200H0z'/></svg>",
         4, 500, 20000},
        {"<svg viewBox='0 0 500 1'><g transform='translate(10 20) "
         "scale(2)'><defs><rect/></defs>"
         "<path transform='rotate(90)' d='m 0 0 100 0 0 -200 -100 0 z m 5 5 l 1 0 l 0 "
         "1'/></g></svg>",
         7, 500, 80000 - 2},
        {"<svg><path d='M0 0C0 -100 100 -100 100 0S200 100 200 0zM.5.5-1-1 1e1-1z'/></svg>", 6,
         -1, 0},
        {"<svg><path d='M0 0Q50 -100 100 0T200 0'/></svg>", 3, -1, 0},
        {"<glyph name='a' format='2'><advance width='321'/><outline><contour>"
         "<point x='0' y='0' type='line'/><point x='100' y='0' type='line'/>"
         "<point x='100' y='200' type='line'/><point x='0' y='200' type='line'/></contour>"
         "<contour><point x='5' y='5' name='anchor' type='move'/></contour></outline></glyph>",
         4, 321, 20000},
        /* A circle of TrueType's: no point is on it. */
        {"<glyph name='o'><outline><contour><point x='100' y='100'/><point x='-100' y='100'/>"
         "<point x='-100' y='-100'/><point x='100' y='-100'/></contour></outline></glyph>",
         4, -1, 100000 / 3.0},
        {"<glyph name='o'><outline><contour><point x='0' y='0' type='curve'/>"
         "<point x='100' y='0' type='line'/><point x='100' y='100'/><point x='0' y='100'/>"
         "</contour></outline></glyph>",
         2, -1, 6000},
    };
    char file[FONT_EDITS_FILE_BYTES];
    const char *folder = folder_with("others", "A", FONT_EDITS_OUTLINE, NULL, 100, file);
    struct font_face *face = face_open("DejaVuSans");
    double own;
    assert_font(font_face_advance(face, font_face_glyph(face, 'A'), &own));
    font_face_close(face);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        put_text(folder, file, files[i].text);
        struct font_outline o = outline_of(folder, "A");
        double area = 0;
        for (int k = 0; k < o.segments_count; k++)
            for (int t = 0; t < 2000; t++) {
                struct font_point a = font_segment_at(&o.segments[k], t / 2000.0, NULL),
                                  b = font_segment_at(&o.segments[k], (t + 1) / 2000.0, NULL);
                area += (a.x * b.y - b.x * a.y) / 2;
            }
        if (o.segments_count != files[i].segments ||
            (files[i].area != 0 && fabs(area - files[i].area) > 0.1) ||
            o.advance != (files[i].advance < 0 ? own : files[i].advance))
            fail_msg("%s: %d segments, advance %g, area %.3f", files[i].text, o.segments_count,
                     o.advance, area);
        font_outline_finish(&o);
    }
}

/* An advance that was edited moves what follows, at any axes and after kerning. */
static void an_edited_advance_moves_what_follows(void **state)
{
    (void)state;
    char file[FONT_EDITS_FILE_BYTES];
    const char *folder = folder_with("advance", "n", FONT_EDITS_OUTLINE, NULL, 100, file);
    put_text(folder, file,
             "<svg viewBox='0 0 3000 10'><path d='M0 0h2000v-1000h-2000z'/></svg>");
    struct font_face *own = face_open("DejaVuSans"), *face;
    assert_font(font_edits_open(folder, 0, false, &face));
    struct font_layout a, b;
    struct font_shaper *before = shaper_make(own), *after = shaper_make(face);
    double advance;
    assert_font(font_face_advance(own, font_face_glyph(own, 'n'), &advance));
    assert_font(font_shaper_layout(before, "ann", 3, 2048, NULL, &a));
    assert_font(font_shaper_layout(after, "ann", 3, 2048, NULL, &b));
    assert_true(fabs(b.width_px - a.width_px - 2 * (3000 - advance)) < 0.01);
    /* A shaper that was there before sees what is replaced later. */
    struct font_edits *edits;
    assert_font(font_edits_read(folder, own, &edits));
    assert_font(font_edits_apply(edits, own));
    font_edits_destroy(edits);
    font_layout_finish(&a);
    assert_font(font_shaper_layout(before, "ann", 3, 2048, NULL, &a));
    assert_true(fabs(b.width_px - a.width_px) < 0.01);
    font_layout_finish(&a);
    font_layout_finish(&b);
    font_shaper_destroy(before);
    font_shaper_destroy(after);
    font_face_close(own);
    font_face_close(face);
}

/* ---- the lowest level counts ---- */

static void what_lies_below_an_edit_is_made_of_it(void **state)
{
    (void)state;
    char outline[FONT_EDITS_FILE_BYTES], parts[FONT_EDITS_FILE_BYTES],
        master[FONT_EDITS_FILE_BYTES];
    folder_with("levels", "A", FONT_EDITS_OUTLINE, ".glif", 64, outline);
    folder_with("levels", "A", FONT_EDITS_RECTANGLES, NULL, 64, parts);
    const char *folder = folder_with("levels", "A", FONT_EDITS_MASTER, NULL, 64, master);
    struct font_face *face = face_open("DejaVuSans");
    struct font_edits *edits;
    struct font_levels *levels;
    const struct font_master *m;
    const struct font_rectangles *r;
    uint32_t glyph = font_face_glyph(face, 'A');
    put_text(folder, outline,
             "<glyph name='A'><advance width='2048'/><outline><contour><point x='0' y='0' "
             "type='line'/><point x='1024' y='0' type='line'/><point x='1024' y='1024' "
             "type='line'/><point x='0' y='1024' type='line'/></contour></outline></glyph>");
    /* The outline alone was edited: master and rectangles are a square's, half an em wide. */
    assert_font(font_edits_read(folder, face, &edits));
    assert_int_equal(font_edits_count(edits), 3);
    assert_font(font_edits_levels(edits, face, glyph, 64, 12, "box", &levels));
    assert_font(font_levels_master(levels, &m));
    assert_font(font_levels_rectangles(levels, &r));
    assert_true(font_master_ink(m) == 32 * 32 && r->count == 1);
    font_levels_destroy(levels);
    font_edits_destroy(edits);
    /* Rectangles were edited, too: they count, and the advance is still the outline's. */
    put_text(folder, parts, "em 64\n0 -10 8 0\n4 -5 16 0\n");
    assert_font(font_edits_read(folder, face, &edits));
    assert_font(font_edits_levels(edits, face, glyph, 64, 12, "box", &levels));
    assert_font(font_levels_master(levels, &m));
    assert_font(font_levels_rectangles(levels, &r));
    long covered = 0;
    for (int i = 0; i < r->count; i++)
        covered += (r->items[i].x1 - r->items[i].x0) * (r->items[i].y1 - r->items[i].y0);
    assert_true(font_master_ink(m) == 32 * 32 && covered == 80 + 60 - 20);
    font_levels_destroy(levels);
    assert_font(font_edits_apply(edits, face));
    struct font_outline o;
    assert_font(font_face_outline(face, glyph, &o));
    assert_true(o.advance == 2048);
    double area = 0;
    for (int i = 0; i < o.segments_count; i++)
        area += o.segments[i].p[0].x * o.segments[i].p[1].y -
                o.segments[i].p[1].x * o.segments[i].p[0].y;
    assert_true(fabs(fabs(area) / 2 - 120 * 32.0 * 32) < 1e-6);
    font_outline_finish(&o);
    font_edits_destroy(edits);
    font_face_close(face);
}

/* ---- names, changes, damage ---- */

static void glyphs_have_many_names(void **state)
{
    (void)state;
    struct font_face *face = face_open("EBGaramond12-Regular");
    static const char *const same[][3] = {{"&", "U+0026", "ampersand"}, {"A", "u+41", "A"}};
    uint32_t glyph, other;
    char name[FONT_GLYPH_NAME_BYTES], number[16];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            assert_font(font_face_glyph_named(face, same[i][k], &other));
            glyph = k ? glyph : other;
            assert_int_equal(glyph, other);
        }
    assert_font(font_face_glyph_named(face, "f_f_i", &glyph));
    snprintf(number, sizeof number, "#%u", (unsigned)glyph);
    assert_font(font_face_glyph_named(face, number, &other));
    assert_int_equal(glyph, other);
    assert_string_equal(font_face_glyph_name(face, glyph, name), "f_f_i");
    /* Every glyph is found again by its name. */
    struct font_face_info info;
    font_face_describe(face, &info);
    for (uint32_t g = 0; g < (uint32_t)info.glyphs_count; g++) {
        assert_font(font_face_glyph_named(face, font_face_glyph_name(face, g, name), &other));
        assert_int_equal(g, other);
    }
    static const char *const none[] = {"",         "#99999999", "#-1",    "#1x",
                                       "U+110000", "U+",        "no such"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_not_equal(font_face_glyph_named(face, none[i], &glyph), FONT_OK);
    font_face_close(face);
}

static void a_font_that_changed_is_told(void **state)
{
    (void)state;
    char file[FONT_EDITS_FILE_BYTES];
    const char *folder = folder_with("changed", "A", FONT_EDITS_OUTLINE, NULL, 100, file);
    char text[4096];
    text_of(folder, "edits.txt", text, sizeof text);
    char *sum = strstr(text, "sha256 ") + 7;
    *sum = *sum == '0' ? '1' : '0';
    put_text(folder, "edits.txt", text);
    struct font_face *face;
    assert_font(font_edits_open(folder, 0, false, &face));
    const char *said = font_edits_said();
    assert_non_null(said);
    assert_non_null(strstr(said, "has changed since"));
    assert_null(font_edits_said());
    font_face_close(face);
}

static void damage_is_refused_by_name(void **state)
{
    (void)state;
    static const struct {
        const char *file, *text, *says;
    } rows[] = {
        {"edits.txt", "", "ends before its line 'lutetia edits 1'"},
        {"edits.txt", "lutetia edits 2\n", "edits.txt:1:"},
        {"edits.txt", "lutetia edits 1\nfont ../../etc/x.ttf\n", "edits.txt:2:"},
        {"edits.txt", "lutetia edits 1\nfont DejaVuSans.ttf\nface 0\nsha256 12\n",
         "edits.txt:4:"},
        {"A.svg", "<svg><path d='M0 0A1 1 0 0 0 5 5z'/></svg>", "has an arc"},
        {"A.svg", "<svg><path d='M0 0L1'/></svg>", "lacks a number"},
        {"A.svg", "<svg><path d='L1 1'/></svg>", "M first"},
        {"A.svg", "<svg><path d='M0 0L1e9 1'/></svg>", "beyond 1e7"},
        {"A.svg", "<svg><path d='M0 0L0x10 1'/></svg>", "lacks a number"},
        {"A.svg", "<svg>\n<circle r='5'/></svg>", "A.svg:2: only paths are read"},
        {"A.svg", "<svg><g transform='skewX(5)'/></svg>", "transform"},
        {"A.svg", "<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>", "DOCTYPE"},
        {"A.svg", "<html/>", "not html"},
        {"A.svg", "<svg><path", "A.svg:1: "},
        {"A.svg", "<glyph><outline><component base='B'/></outline></glyph>", "components"},
        {"A.svg",
         "<glyph><outline><contour><point x='0' y='q' "
         "type='line'/></contour></outline></glyph>",
         "no number in y"},
        {"A.txt", "em 0\n", "A.txt:1:"},
        {"A.txt", "em 64\n5 5 4 9\n", "A.txt:2:"},
        {"A.txt", "em 64\n0 0 30000 30000\n0 0 30000 30000\n0 0 30000 30000\n0 0 30000 30000\n",
         "too many"},
        {"A.png", "no picture", "A.png"},
    };
    struct font_face *face;
    char file[FONT_EDITS_FILE_BYTES];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char name[16];
        snprintf(name, sizeof name, "bad%zu", i);
        folder_with(name, "A", FONT_EDITS_OUTLINE, NULL, 64, file);
        folder_with(name, "A", FONT_EDITS_MASTER, NULL, 64, file);
        const char *folder = folder_with(name, "A", FONT_EDITS_RECTANGLES, NULL, 64, file);
        put_text(folder, rows[i].file, rows[i].text);
        if (font_edits_open(folder, 0, false, &face) == FONT_OK ||
            !strstr(font_error(), rows[i].says) || strchr(font_error(), '\n') || face)
            fail_msg("%s = %s: %s", rows[i].file, rows[i].text, font_error());
    }
}

/* Rows that name what is not there, or is no plain file of the folder. (security.md 33) */
static void bad_rows_are_refused(void **state)
{
    (void)state;
    struct font_face *face;
    char file[FONT_EDITS_FILE_BYTES];
    static const char *const bad[][2] = {
        {"A outline ../A.svg -\n", "plain name"},
        {"A outline .A.svg -\n", "plain name"},
        {"A outline A.svg 12\n", "edits.txt:5:"},
        {"A painting A.svg -\n", "edits.txt:5:"},
        {"A master A.png - 64 0\n", "edits.txt:5:"},
        {"A master A.png - 64 0 999999\n", ":5:"},
        {"nothing outline A.svg -\n", "no glyph"},
        {"A outline none.svg -\n", "none.svg"},
        {"A outline link.svg -\n", "link.svg"},
        {"A outline A.svg - more\n", "edits.txt:5:"},
        {"A outline\n", "edits.txt:5:"},
        {"A outline A.svg -\nU+0041 outline A.svg -\n", "two rows"},
    };
    const char *folder = folder_with("rows", "A", FONT_EDITS_OUTLINE, NULL, 64, file);
    char link[600];
    snprintf(link, sizeof link, "%s/link.svg", folder);
    assert_int_equal(symlink("A.svg", link), 0);
    char head[2048], text[4096];
    text_of(folder, "edits.txt", head, sizeof head);
    *(strstr(strstr(head, "sha256 "), "\n") + 1) = '\0';
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        snprintf(text, sizeof text, "%s%s", head, bad[i][0]);
        put_text(folder, "edits.txt", text);
        if (font_edits_open(folder, 0, false, &face) == FONT_OK ||
            !strstr(font_error(), bad[i][1]))
            fail_msg("%s: %s", bad[i][0], font_error());
    }
}

/* A small folder cannot take much memory: rows may share a file. (security.md 33) */
static void all_rows_together_are_bounded(void **state)
{
    (void)state;
    enum { POINTS = 90000, ROWS = 60, ROOM = 1 << 20 };
    static char text[ROOM];
    struct font_face *face;
    const char *folder = folder_with("all", "A", FONT_EDITS_OUTLINE, NULL, 64, text);
    size_t at = (size_t)snprintf(text, ROOM, "<svg><path d='M0 0");
    for (int i = 0; i < POINTS; i++)
        at += (size_t)snprintf(text + at, ROOM - at, "l1 %d", i % 2);
    snprintf(text + at, ROOM - at, "'/></svg>");
    put_text(folder, "A.svg", text);
    text_of(folder, "edits.txt", text, ROOM);
    at = (size_t)(strstr(strstr(text, "sha256 "), "\n") + 1 - text);
    for (int i = 0; i < ROWS; i++)
        at += (size_t)snprintf(text + at, ROOM - at, "#%d outline A.svg -\n", 40 + i);
    put_text(folder, "edits.txt", text);
    assert_int_equal(font_edits_open(folder, 0, false, &face), FONT_TOO_LARGE);
    assert_non_null(strstr(font_error(), "all edits together"));
}

/* A file that no row has is somebody's, unless it is what would be written. */
static void strangers_files_stay(void **state)
{
    (void)state;
    char file[FONT_EDITS_FILE_BYTES];
    static const enum font_edits_level levels[] = {FONT_EDITS_OUTLINE, FONT_EDITS_MASTER};
    for (int i = 0; i < 2; i++) {
        const char *folder = folder_with("stray", "A", levels[i], NULL, 64, file);
        char list[600];
        snprintf(list, sizeof list, "%s/edits.txt", folder);
        assert_int_equal(remove(list), 0);
        folder_with("stray", "A", levels[i], NULL, 64, file); /* the same again */
        assert_int_equal(remove(list), 0);
        put_text(folder, file, "mine");
        struct font_face *face = face_open("DejaVuSans");
        struct font_levels *made;
        uint32_t glyph = font_face_glyph(face, 'A');
        assert_font(font_edits_levels(NULL, face, glyph, 64, 12, "box", &made));
        assert_int_equal(
            font_edits_write(folder, NULL, face,
                             &(struct font_edits_out){.glyph = glyph, .level = levels[i]}, made,
                             file),
            FONT_BAD_ARGUMENT);
        assert_non_null(strstr(font_error(), "is there already"));
        char text[16];
        assert_string_equal(text_of(folder, file, text, sizeof text), "mine");
        font_levels_destroy(made);
        font_face_close(face);
        scratch_empty();
    }
}

static void what_was_edited_is_not_written_over(void **state)
{
    (void)state;
    char file[FONT_EDITS_FILE_BYTES];
    const char *folder = folder_with("over", "A", FONT_EDITS_OUTLINE, NULL, 64, file);
    folder_with("over", "A", FONT_EDITS_OUTLINE, NULL, 64, file); /* as it was written: anew */
    put_text(folder, file, "<svg><path d='M0 0h5v5z'/></svg>");
    struct font_levels *levels;
    struct font_edits *edits;
    struct font_face *face = face_open("DejaVuSans");
    assert_font(font_edits_read(folder, face, &edits));
    assert_font(
        font_edits_levels(edits, face, font_face_glyph(face, 'A'), 64, 12, "box", &levels));
    assert_int_equal(
        font_edits_write(folder, edits, face,
                         &(struct font_edits_out){.glyph = font_face_glyph(face, 'A')}, levels,
                         file),
        FONT_BAD_ARGUMENT);
    assert_non_null(strstr(font_error(), "was edited"));
    font_levels_destroy(levels);
    font_edits_destroy(edits);
    font_face_close(face);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_masters_outline_covers_its_pixels),
        cmocka_unit_test(a_retouched_master_is_what_is_drawn),
        cmocka_unit_test(outlines_come_back),
        cmocka_unit_test(outlines_of_other_programs_are_read),
        cmocka_unit_test(an_edited_advance_moves_what_follows),
        cmocka_unit_test(what_lies_below_an_edit_is_made_of_it),
        cmocka_unit_test(glyphs_have_many_names),
        cmocka_unit_test(a_font_that_changed_is_told),
        cmocka_unit_test(damage_is_refused_by_name),
        cmocka_unit_test(all_rows_together_are_bounded),
        cmocka_unit_test(bad_rows_are_refused),
        cmocka_unit_test(strangers_files_stay),
        cmocka_unit_test(what_was_edited_is_not_written_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
