/* test_type.c - `lutetia type` and `lutetia font`: pictures, and one clear line for each
 * error. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "../fontpipe/made_font.h"
#include "child.h"

#include <display.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *lutetia;

/* Runs the command, which must print one line where it fails or reports something, and none
 * otherwise. */
static void run(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    if (!child_says(child, status, says, *says != 0))
        fail_msg("exit %d for %d, and it said: %s", child->status, status, child->errors);
}

/* The number after these words, which occur once in the text. */
static double number_after(const char *text, const char *words)
{
    const char *at = strstr(text, words);
    if (!at || strstr(at + 1, words))
        fail_msg("'%s' stands %s in: %s", words, at ? "more than once" : "nowhere", text);
    char *end;
    double number = strtod(at + strlen(words), &end);
    if (end == at + strlen(words))
        fail_msg("no number after '%s' in: %s", words, text);
    return number;
}

/* The amount of ink on a picture; white has none. */
static double ink_of(const char *path, int *width, int *height)
{
    struct display_image image;
    double ink = 0;
    if (display_png_read_gray(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    for (int i = 0; i < image.width_px * image.height_px; i++)
        ink += 255 - image.pixels[i];
    *width = image.width_px;
    *height = image.height_px;
    display_image_destroy(&image);
    return ink / 255;
}

static void type_is_set(void **state)
{
    (void)state;
    const char *path = scratch_path("type.png");
    struct child plain = {.arguments = {"", "type", "Paris", "--size", "24.5", "-o", path}};
    int width, height;
    run(&plain, 0, "");
    double upright = ink_of(path, &width, &height);
    assert_true(upright > 100 && width > 60 && width < 100 && height > 30 && height < 60);
    int gl_width, gl_height;
    struct child by_gl = {
        .arguments = {"", "type", "Paris", "--size", "24.5", "--gl", "-o", path}};
    run(&by_gl, 0, "");
    assert_true(fabs(ink_of(path, &gl_width, &gl_height) / upright - 1) < 0.01);
    assert_true(gl_width == width && gl_height == height);
    struct child turned = {.arguments = {"", "type", "Paris", "--size", "24.5", "--rotate",
                                         "90", "--gamma", "1", "-o", path}};
    run(&turned, 0, "");
    double rotated = ink_of(path, &width, &height);
    assert_true(height > width);
    struct child level = {
        .arguments = {"", "type", "Paris", "--size", "24.5", "--gamma", "1", "-o", path}};
    run(&level, 0, "");
    assert_true(fabs(ink_of(path, &width, &height) / rotated - 1) <
                0.005); /* turned, not changed */
    static char arabic[] = "\xd8\xb3\xd9\x84\xd8\xa7\xd9\x85";
    struct child others = {.arguments = {"", "type", arabic, "--corners",
                                         "0,0,200,20,190,90,10,80", "--warp", "bilinear",
                                         "--stripes", "--darken", "0.3", "--filter", "auto",
                                         "--statistics", "-o", path}};
    run(&others, 0, "");
    assert_non_null(strstr(others.output, "filter: "));
    assert_true(ink_of(path, &width, &height) > 100);
    /* Turned text stays between the corners, by both kinds of map, and OpenGL draws the
     * same. */
    static char *const kinds[] = {"projective", "bilinear"};
    for (int k = 0; k < 2; k++) {
        struct child bent = {.arguments = {"", "type", "HIH", "--rotate", "40", "--corners",
                                           "20,12,200,20,190,90,30,80", "--warp", kinds[k],
                                           "-o", path}};
        run(&bent, 0, "");
        double ink = ink_of(path, &width, &height);
        assert_true(ink > 100 && width > 150 && width <= 210 && height > 70 && height <= 101);
        struct child same = bent;
        same.arguments[11] = "--gl";
        run(&same, 0, "");
        assert_true(fabs(ink_of(path, &width, &height) / ink - 1) < 0.01);
    }
    unlink(path);
}

/* Half a cover is half of the darkness; a gradient and a picture are drawn by OpenGL as by the
 * painter, and in drawings. */
static void ink_is_more_than_a_colour(void **state)
{
    (void)state;
    int width, height;
    char path[] = "lutetia-type-ink.png", tile[] = "lutetia-type-tile.png";
    static char *const others[] = {"lutetia-type-ink.svg", "lutetia-type-ink.pdf"};
    struct child dot = {.arguments = {"", "type", "Wq", "--size", "20", "-o", tile}};
    run(&dot, 0, "");
    struct child whole = {
        .arguments = {"", "type", "Wet", "--gamma", "1", "--mix-numbers", "-o", path}};
    run(&whole, 0, "");
    double ink = ink_of(path, &width, &height);
    struct child half = {.arguments = {"", "type", "Wet", "--gamma", "1", "--mix-numbers", "-o",
                                       path, "--cover", "0.5"}};
    run(&half, 0, "");
    assert_true(fabs(ink_of(path, &width, &height) / ink - 0.5) < 0.01);
    for (int k = 0; k < 2; k++) {
        struct child by[] = {
            {.arguments = {"", "type", "Wet", "-o", path, "--gradient", "0,0,90,0", "--stop",
                           "0,1,0,0,1", "--stop", "1,0,0,0.6,0.4"}},
            {.arguments = {"", "type", "Wet", "-o", path, "--texture", tile}}};
        run(&by[k], 0, "");
        double painted = ink_of(path, &width, &height);
        struct child same = by[k];
        same.arguments[k ? 7 : 11] = "--gl";
        run(&same, 0, "");
        assert_true(fabs(ink_of(path, &width, &height) / painted - 1) < 0.01);
        for (int i = 0; i < 2; i++) {
            struct child drawing = by[k];
            drawing.arguments[4] = others[i];
            run(&drawing, 0, "");
            assert_true(unlink(others[i]) == 0);
        }
    }
    unlink(path);
    unlink(tile);
}

static void lines_are_broken_to_fit(void **state)
{
    (void)state;
    const char *path = scratch_path("lines.png");
    static const char text[] = "a town in a marsh, in ink on wet paper";
    struct child child = {.arguments = {"", "type", text, "--size", "20", "--width", "150",
                                        "--align", "justify", "--statistics", "--margin", "0",
                                        "-o", path}};
    int width, height;
    run(&child, 0, "");
    assert_non_null(strstr(child.output, " 3 lines, 150.00 pixels wide"));
    assert_true(ink_of(path, &width, &height) > 300 && width < 160 && height > 55);
    unlink(path);
}

static void comparisons_are_shown(void **state)
{
    (void)state;
    const char *path = scratch_path("compare.png");
    struct child child = {
        .arguments = {"", "type", "Ag", "--size", "12.25", "--compare", "-o", path}};
    int width, height;
    run(&child, 0, "");
    double ours = number_after(child.output, "lutetia - exact: at most "),
           freetype = number_after(child.output, "FreeType - exact box: at most ");
    assert_true(ours >= 0 && ours <= 1);
    assert_true(freetype > 3 && freetype <= 255);
    assert_true(ink_of(path, &width, &height) > 100 && width > 400);
    unlink(path);
}

/* A formula as pixels and as files whose bar is there; what goes without it is said. */
static void formulas_are_set(void **state)
{
    (void)state;
    const char *path = scratch_path("formula.png");
    static const char fraction[] = "\\frac{a}{b}", line[] = "a\\,b";
    int width, height, flat_height;
    struct child stacked = {
        .arguments = {"", "type", fraction, "--math", "display", "-o", path}};
    run(&stacked, 0, "");
    double ink = ink_of(path, &width, &height);
    struct child flat = {.arguments = {"", "type", line, "--math", "text", "-o", path}};
    run(&flat, 0, "");
    assert_true(ink > ink_of(path, &width, &flat_height));
    assert_true(height > 1.6 * flat_height);
    struct child unknown = {
        .arguments = {"", "type", "\\foo+\\bar x+\\qux", "--math", "text", "-o", path}};
    run(&unknown, 0, "'\\foo' and 1 more are no commands");
    struct child none = {.arguments = {"", "type", "x", "--math", "text", "--font",
                                       "DejaVuSansMono", "-o", path}};
    run(&none, 1, "no MATH table");
    struct child word = {.arguments = {"", "type", "x", "--math", "big", "-o", path}};
    run(&word, 2, "--math must be display or text");
    struct child broken = {
        .arguments = {"", "type", "x", "--math", "text", "--width", "30", "-o", path}};
    run(&broken, 2, "--math sets one formula");
    unlink(path);
    const char *files[] = {scratch_path("formula.svg"), scratch_path("formula.pdf")};
    for (size_t i = 0; i < 2; i++) {
        struct child written = {
            .arguments = {"", "type", fraction, "--math", "display", "-o", files[i]}};
        run(&written, 0, "");
        assert_int_equal(unlink(files[i]), 0);
    }
}

/* Markdown as one PDF, as a picture, several files as one document; without cmark-gfm a line
 * says what to install. */
static void markdown_is_read(void **state)
{
    (void)state;
    const char *one = scratch_path("one.md"), *two = scratch_path("two.md"),
               *pdf = scratch_path("read.pdf"), *png = scratch_path("read.png");
    FILE *out = fopen(one, "w");
    assert_non_null(out);
    fputs("# One\n\nIt is *very* $x^2$ deep[^1].\n\n[^1]: By night.\n", out);
    fclose(out);
    out = fopen(two, "w");
    assert_non_null(out);
    fputs("# Two\n\n$\\foo$ [#](#one) [#](#none)\n", out);
    fclose(out);
    struct child book = {.arguments = {"", "read", one, two, "--statistics", "-o", pdf}};
    book.arguments[0] = lutetia;
    child_run(&book);
    if (book.status == 1 && strstr(book.errors, "libcmark-gfm-dev")) {
        unlink(one);
        unlink(two);
        return;
    }
    assert_int_equal(book.status, 0);
    assert_non_null(strstr(book.output, "1 pages"));
    assert_non_null(strstr(book.errors, "'\\foo' is no command"));
    assert_non_null(strstr(book.errors, "two.md:3: there is no label #none: it stands as"));
    assert_null(strstr(book.errors, "#one"));
    int width, height;
    struct child page = {.arguments = {"", "read", one, "--paper", "300x200", "--margin", "20",
                                       "--size", "12", "-o", png}};
    run(&page, 0, "");
    assert_true(ink_of(png, &width, &height) > 100 && width == 300 && height == 200);
    struct child small = {.arguments = {"", "read", one, "--paper", "60x60", "-o", png}};
    run(&small, 1, "are too small");
    struct child nothing = {.arguments = {"", "read", "/nowhere.md", "-o", png}};
    run(&nothing, 1, "/nowhere.md: ");
    struct child kind = {.arguments = {"", "read", one, "-o", "read.jpg"}};
    run(&kind, 2, "-o names FILE.html, .pdf, .svg or .png");
    unlink(one);
    unlink(two);
    unlink(pdf);
    unlink(png);
}

static void fonts_and_filters_are_shown(void **state)
{
    (void)state;
    const char *path = scratch_path("font.png");
    int width, height;
    struct child specimen = {.arguments = {"", "font", "EBGaramond12-Italic", "-o", path}};
    run(&specimen, 0, "");
    assert_non_null(strstr(specimen.output, "EB Garamond"));
    assert_true(ink_of(path, &width, &height) > 5000 && width == 1100);
    struct child levels = {
        .arguments = {"", "font", "DejaVuSans", "--glyph", "U+0042", "-o", path}};
    run(&levels, 0, "");
    assert_non_null(strstr(levels.output, "rectangles: "));
    assert_true(ink_of(path, &width, &height) > 5000);
    /* A master that is written and read again gives the same picture; filters are read from
     * files. */
    const char *master = scratch_path("master.png"), *words = scratch_path("filter.txt");
    struct child out = {.arguments = {"", "font", "DejaVuSans", "--glyph", "B", "--em", "300",
                                      "--master-out", master, "-o", path}};
    run(&out, 0, "");
    struct child in = {.arguments = {"", "font", "DejaVuSans", "--glyph", "B", "--em", "300",
                                     "--master", master, "--merge", "2", "-o", path}};
    run(&in, 0, "");
    assert_non_null(strstr(in.output, "retouched: 0 pixels\nmerged: "));
    struct child other = {.arguments = {"", "font", "DejaVuSans", "--glyph", "B", "--em", "310",
                                        "--master", master, "-o", path}};
    run(&other, 1, "with the same --em");
    FILE *file = fopen(words, "w");
    assert_non_null(file);
    fputs("samples: 1.5\n1 0.9,\n0.3 0\n", file);
    fclose(file);
    char at[600];
    snprintf(at, sizeof at, "@%s", words);
    struct child from_file = {
        .arguments = {"", "font", "--show-filter", "--filter", at, "-o", path}};
    run(&from_file, 0, "");
    assert_non_null(strstr(from_file.output, "samples:1.5,1,0.9,0.3,0: radius 1.5 pixels"));
    unlink(words);
    unlink(master);
    struct child filter = {
        .arguments = {"", "font", "--show-filter", "--filter", "cone:1.5", "-o", path}};
    run(&filter, 0, "");
    assert_non_null(strstr(filter.output, "cone:1.5: radius 1.5 pixels"));
    assert_true(ink_of(path, &width, &height) > 1000);
    unlink(path);
}

/* DejaVu Sans with an axis wdth, in a file. */
static void wide_write(const char *path, const char *picture)
{
    struct child found = {.arguments = {"", "font", "DejaVuSans", "-o", picture}};
    char name[600];
    size_t count = 0, made_count;
    uint8_t *bytes = calloc(1, 1 << 21);
    run(&found, 0, "");
    const char *line = strchr(found.output, '\n');
    assert_true(bytes && line && sscanf(line + 1, "%599[^\n]", name) == 1);
    FILE *f = fopen(name, "rb");
    assert_non_null(f);
    count = fread(bytes, 1, 1 << 21, f);
    fclose(f);
    uint8_t *made = made_wide(bytes, count, &made_count);
    f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(made, 1, made_count, f), made_count);
    assert_int_equal(fclose(f), 0);
    free(made);
    free(bytes);
}

static void proofs_and_versions_are_shown(void **state)
{
    (void)state;
    const char *path = scratch_path("font.png"), *wide = scratch_path("wide.ttf");
    int width, height;
    struct child proof = {.arguments = {"", "font", "DejaVuSans", "--proof", "wet", "--filter",
                                        "cone:2", "--display", "crt", "-o", path}};
    run(&proof, 0, "");
    assert_non_null(strstr(proof.output, "  suits the display\n"));
    assert_non_null(strstr(proof.output, "\ncone:2 "));
    assert_true(ink_of(path, &width, &height) > 3000);
    wide_write(wide, path);
    struct child fall = {.arguments = {"", "font", wide, "--waterfall", "wdth", "-o", path}};
    run(&fall, 0, "");
    assert_non_null(strstr(fall.output, "axis wdth"));
    assert_non_null(strstr(fall.output, "\nscripts: DFLT"));
    assert_non_null(strstr(fall.output, " liga"));
    assert_true(ink_of(path, &width, &height) > 5000);
    /* Along the axis all but the composite glyphs are wider; where it is as usual nothing has
     * changed. */
    struct child same = {
        .arguments = {"", "font", "DejaVuSans", "--against", wide, "--text", "HH", "-o", path}};
    run(&same, 0, "");
    assert_non_null(strstr(same.output, "changed: none\n"));
    assert_non_null(strstr(same.output, "\n0 of "));
    struct child other = {.arguments = {"", "font", "DejaVuSans", "--against",
                                        "DejaVuSans-Bold", "--text", "H", "-o", path}};
    run(&other, 0, "");
    assert_non_null(strstr(other.output, "changed: space"));
    unlink(wide);
    unlink(path);
}

/* The picture and its table, read by hand: the letter H is where the table says. */
static void typeface_has_a_table(void **state)
{
    (void)state;
    const char *path = scratch_path("face.png"), *table = scratch_path("face.csv");
    struct child child = {
        .arguments = {"", "font", "DejaVuSansMono", "--typeface", "24", "-o", path}};
    char line[300];
    int x = 0, y = 0, width = 0, height = 0, left, top, rows = 0, inked = 0;
    double advance = 0;
    run(&child, 0, "wrote ");
    assert_non_null(strstr(child.output, " glyphs with ink at 24 pixels"));
    FILE *file = fopen(table, "rb");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "glyph,name,character,x,y,width,height,left,top,advance\r\n");
    while (fgets(line, sizeof line, file)) {
        const char *at = strstr(line, ",\"H\",U+0048,");
        rows++;
        if (at)
            assert_int_equal(sscanf(at + 12, "%d,%d,%d,%d,%d,%d,%lf", &x, &y, &width, &height,
                                    &left, &top, &advance),
                             7);
    }
    fclose(file);
    assert_true(rows > 3000 && width > 8 && height > 15 && advance > 14 && advance < 15);
    struct display_image image;
    assert_int_equal(display_png_read_gray(path, &image), DISPLAY_OK);
    for (int row = 0; row < height; row++)
        inked += image.pixels[(y + row) * image.width_px + x + width / 2] > 127;
    assert_true(inked >= 1 && inked <= 4); /* the bar of the H alone */
    display_image_destroy(&image);
    unlink(table);
    unlink(path);
}

/* A script that has the command's table as a text, and says where its own is another; it writes
 * its mask as a layer. */
static void typeface_script_write(const char *path, const char *table)
{
    FILE *script = fopen(path, "wb"), *rows = fopen(table, "rb");
    char line[300];
    assert_true(script && rows);
    fputs("local wanted = [[\n", script);
    while (fgets(line, sizeof line, rows))
        fprintf(script, "%.*s\n", (int)strcspn(line, "\r\n"), line);
    fputs("]]\n"
          "local m, glyphs = typeface('DejaVuSansMono', {size = 11.5, filter = 'cone'})\n"
          "local i, same = 0, 0\n"
          "for row in wanted:gmatch('[^\\n]+') do\n"
          "  local g = glyphs[i]\n"
          "  local c = g and g.character and ('U+%04X'):format(utf8.codepoint(g.character))\n"
          "  local is = g and ('%d,\"%s\",%s,%d,%d,%d,%d,%d,%d,%.4f'):format(g.glyph, "
          "g.name, c or '', g.x, g.y, g.width, g.height, g.left, g.top, g.advance)\n"
          "  if is == row then same = same + 1 elseif g then print(is, row) end\n"
          "  i = i + 1\n"
          "end\n"
          "print('same', same, i - 1, #glyphs)\n"
          "local x, y, w, h = m:bounds()\n"
          "print('at', x, y)\n"
          "local p = paper{width = w, height = h, pigments = {}, model = {'infused'}, "
          "history = false}\n"
          "p:layer('resist', m)\n"
          "p:frame('layer.png', {layer = 'resist', low = 0, high = 1, bits = 8})\n",
          script);
    assert_int_equal(fclose(script), 0);
    fclose(rows);
}

static void a_script_has_the_same_typeface(void **state)
{
    (void)state;
    const char *path = scratch_path("face.png"), *table = scratch_path("face.csv"),
               *script = scratch_path("face.lua"), *layer = scratch_path("layer.png");
    struct display_image a, b;
    struct child made = {.arguments = {"", "font", "DejaVuSansMono", "--typeface", "11.5",
                                       "--filter", "cone", "-o", path}},
                 child = {.arguments = {"", "run", script, "-q", "-o", scratch_dir}};
    int glyphs = 0, same = 0, rows = 0;
    run(&made, 0, "wrote ");
    typeface_script_write(script, table);
    run(&child, 0, "");
    if (sscanf(child.output, "same %d %d %d\nat 0 0\n", &same, &rows, &glyphs) != 3)
        fail_msg("the tables differ: %.600s", child.output);
    assert_true(same > 3000 && same == rows && rows == glyphs);
    assert_int_equal(display_png_read_gray(path, &a), DISPLAY_OK);
    assert_int_equal(display_png_read_gray(layer, &b), DISPLAY_OK);
    assert_int_equal(a.width_px, b.width_px);
    assert_int_equal(a.height_px, b.height_px);
    assert_memory_equal(a.pixels, b.pixels, (size_t)a.width_px * (size_t)a.height_px);
    display_image_destroy(&a);
    display_image_destroy(&b);
    unlink(table);
    unlink(path);
    unlink(script);
}

static void what_is_no_typeface_is_said(void **state)
{
    (void)state;
    static const struct {
        const char *more[5];
        int status;
        const char *says;
    } cases[] = {
        {{"0"}, 2, "--typeface must be"},
        {{"12", "--glyph", "a"}, 2, "one of --proof"},
        {{"12", "-o", "/nowhere/a.png"}, 1, "/nowhere"},
        {{"12", "--filter", "soft"}, 1, "there is no filter"},
        {{"400"}, 1, "too much at this size"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct child child = {.arguments = {"", "font", "DejaVuSans", "--typeface"}};
        for (int k = 0; cases[i].more[k]; k++)
            child.arguments[4 + k] = cases[i].more[k];
        run(&child, cases[i].status, cases[i].says);
    }
}

static void wrong_lines_are_said(void **state)
{
    (void)state;
    static const struct {
        const char *arguments[8];
        int status;
        const char *says;
    } cases[] = {
        {{"type"}, 2, "give a text"},
        {{"type", ""}, 2, "the text is empty"},
        {{"type", "a", "b"}, 2, "put it in quotes"},
        {{"type", "a", "--size", "0"}, 2, "--size must be"},
        {{"type", "a", "--size", "-12"}, 2, "--size must be"},
        {{"type", "a", "--size", "nan"}, 2, "--size must be"},
        {{"type", "a", "--font", "nobody's"}, 1, "there is no font"},
        {{"type", "a", "--font", "/dev/null"}, 1, "not a regular file"},
        {{"type", "a", "--face", "9"}, 1, "has no face 9"},
        {{"type", "a", "--axes", "wght"}, 2, "axes must be like"},
        {{"type", "a", "--axes", "wght=700"}, 2, "has no axis"},
        {{"type", "a", "--filter", "soft"}, 1, "there is no filter"},
        {{"type", "a", "--warp", "round"}, 2, "--warp must be"},
        {{"type", "a", "--gl", "--stripes"}, 2, "--gl goes without"},
        {{"type", "a", "--compare", "--stripes"}, 2, "--compare goes without --stripes"},
        {{"type", "a", "-o", "a.jpg"}, 2, "-o names a picture"},
        {{"type", "a", "-o", "a.svg", "--gl"}, 2, "make pixels"},
        {{"set"}, 2, "give a file with the text"},
        {{"set", "/nowhere"}, 1, "/nowhere: "},
        {{"set", "/dev/null", "--leading", "11"}, 2, "--leading must be 0..10"},
        {{"set", "/dev/null", "--align", "middle"}, 2, "left, right, center or justify"},
        {{"set", "/dev/null", "-o", "a.jpg"}, 2, "-o names a picture"},
        {{"type", "a", "--corners", "0,0,9,9,9,0,0,9"}, 1, "without a dent"},
        {{"type", "a", "--gradient", "0,0,9,9"}, 2, "come with --stop"},
        {{"type", "a", "--stop", "0,0,0,0,1"}, 2, "a colour of --gradient"},
        {{"type", "a", "--texture", "no-such.png"}, 1, "no-such.png"},
        {{"type", "a", "--texture", "x.png", "--radial", "0,0,9"}, 2, "given once"},
        {{"type", "a", "--corners", "0,0,9"}, 2, "must be 8 numbers X,Y"},
        {{"type", "a", "--features", "="}, 1, "there is no feature"},
        {{"type", "a", "-o", "/nowhere/a.png"}, 1, "/nowhere"},
        {{"type", "a", "--filter", "@/nowhere"}, 1, "/nowhere: "},
        {{"type", "a", "--width", "-3"}, 2, "--width must be"},
        {{"type", "a", "--align", "middle"}, 2, "--align must be"},
        {{"font", "DejaVuSans", "--merge", "3"}, 2, "want a --glyph"},
        {{"font", "DejaVuSans", "--glyph", "a", "--master", "/nowhere"}, 1, "/nowhere"},
        {{"font"}, 2, "give a font file"},
        {{"font", "DejaVuSans", "--glyph", "ab"}, 2, "no glyph 'ab'"},
        {{"font", "DejaVuSans", "--glyph", "#99999"}, 1, "no #99999"},
        {{"font", "DejaVuSans", "--proof", "a", "--waterfall", "wght"}, 2, "one of --proof"},
        {{"font", "DejaVuSans", "--proof", "a", "--display", "tv"}, 2, "--display must be"},
        {{"font", "DejaVuSans", "--proof", " "}, 1, "no ink"},
        {{"font", "DejaVuSans", "--waterfall", "wght"}, 2, "no axes"},
        {{"font", "DejaVuSans", "--against", "/nowhere.ttf"}, 1, "/nowhere.ttf"},
        {{"font", "DejaVuSans", "--write", "filter", "--sizes", "9,8", "--edits", "x"},
         2,
         "--sizes are"},
        {{"font", "DejaVuSans", "--write", "master"}, 2, "wants a --glyph"},
        {{"font", "DejaVuSans", "--glyph", "a", "--edits", "x", "--write", "paint"},
         2,
         "--write must be"},
        {{"font", "DejaVuSans", "--edits", "/nowhere"}, 1, "/nowhere/edits.txt"},
        {{"type", "a", "--edits", "/nowhere"}, 1, "/nowhere/edits.txt"},
        {{"font", "DejaVuSans", "--glyph", "U+F0000"}, 1, "no glyph for U+F0000"},
        {{"font", "DejaVuSans", "--glyph", " "}, 1, "has no ink"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static struct child child;
        memset(&child, 0, sizeof child);
        memcpy(child.arguments + 1, cases[i].arguments, sizeof cases[i].arguments);
        run(&child, cases[i].status, cases[i].says);
    }
}

/* Damaged text and missing glyphs are reported; the rest is set. */
static void what_is_missing_is_said(void **state)
{
    (void)state;
    const char *path = scratch_path("said.png");
    struct child damaged = {.arguments = {"", "type", "a\xff\xc3(", "-o", path}};
    run(&damaged, 0, "not UTF-8 in 2 places");
    struct child missing = {.arguments = {"", "type", "\xf3\xb0\x80\x80", "-o", path}};
    run(&missing, 0, "no font has a glyph for U+F0000");
    const char *text = scratch_path("said.txt");
    FILE *page = fopen(text, "w");
    assert_non_null(page);
    fputs("A word, \xf3\xb0\x80\x80\n\nand \xf3\xb0\x80\x81 \xf3\xb0\x80\x80.\n", page);
    fclose(page);
    struct child pages = {.arguments = {"", "set", text, "-o", path}};
    run(&pages, 0, "no font has a glyph for U+F0000 U+F0001; ");
    unlink(text);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(type_is_set),
        cmocka_unit_test(ink_is_more_than_a_colour),
        cmocka_unit_test(lines_are_broken_to_fit),
        cmocka_unit_test(comparisons_are_shown),
        cmocka_unit_test(formulas_are_set),
        cmocka_unit_test(markdown_is_read),
        cmocka_unit_test(fonts_and_filters_are_shown),
        cmocka_unit_test(proofs_and_versions_are_shown),
        cmocka_unit_test(typeface_has_a_table),
        cmocka_unit_test(a_script_has_the_same_typeface),
        cmocka_unit_test(what_is_no_typeface_is_said),
        cmocka_unit_test(wrong_lines_are_said),
        cmocka_unit_test(what_is_missing_is_said),
    };
    lutetia = getenv("LUTETIA");
    if (!lutetia) {
        fputs("set LUTETIA to the command\n", stderr);
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
