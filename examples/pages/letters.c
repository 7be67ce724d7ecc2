/* letters.c - draws each letter of a word in its own quadrangle, and words in translucent inks.
 *
 *     examples/example_letters out.png */
#include <display.h>
#include <edges.h>
#include <paint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 600, HEIGHT = 420 };

static int fail(void)
{
    fprintf(stderr, "letters: %s\n", font_error());
    return EXIT_FAILURE;
}

/* Moves the corners of a letter's box as if the word hung on a wave. */
static bool letter_bend(struct font_layout *l, int i, double left, double right)
{
    struct font_point to[4];
    const double top = -l->ascent_px, foot = l->descent_px;
    const double from[4][2] = {{left, top}, {right, top}, {right, foot}, {left, foot}};
    struct font_map map;
    for (int k = 0; k < 4; k++) {
        double at = (l->glyphs[i].x_px + from[k][0]) / 90;
        to[k].x = from[k][0] + 9 * cos(2.1 * at) * (from[k][1] < 0);
        to[k].y = from[k][1] * (0.75 + 0.35 * sin(at)) + 22 * sin(1.3 * at);
    }
    if (font_map_corners(FONT_SMOOTH, left, top, right, foot, to, &map) != FONT_OK)
        return false;
    l->glyphs[i].map = font_layout_map_add(l, &map);
    return l->glyphs[i].map > 0;
}

static bool word_bent(struct font_shaper *s, struct font_painter *p, struct font_picture *to)
{
    static const char word[] = "quadrangles";
    struct font_layout l;
    if (font_shaper_layout(s, word, strlen(word), 78, NULL, &l) != FONT_OK)
        return false;
    const struct font_ink sky = {.kind = FONT_INK_LINEAR,
                                 .y0 = -80,
                                 .y1 = 60,
                                 .stops = {{0, {0.05, 0.15, 0.5, 1}},
                                           {0.6, {0.1, 0.5, 0.6, 1}},
                                           {1, {0.8, 0.5, 0.1, 1}}},
                                 .stops_count = 3};
    int ink = font_layout_ink_add(&l, &sky);
    bool good = ink > 0;
    for (int i = 0; good && i < l.glyphs_count; i++) {
        double next = i + 1 < l.glyphs_count ? l.glyphs[i + 1].x_px : l.width_px;
        l.glyphs[i].ink = ink;
        good = letter_bend(&l, i, 0, next - l.glyphs[i].x_px);
    }
    good = good && font_painter_layout(p, &l, NULL, 24, 120, to) == FONT_OK;
    font_layout_finish(&l);
    return good;
}

/* Draws translucent words: to the left inks are mixed as light, to the right as numbers. */
static bool words_over(struct font_shaper *s, struct font_painter *p, struct font_picture *to)
{
    static const char *const words[] = {"cyan", "rose", "gold"};
    static const double colours[3][3] = {{0, 0.6, 0.8}, {0.9, 0.1, 0.4}, {0.95, 0.7, 0}};
    for (int k = 0; k < 6; k++) {
        struct font_layout l;
        const double *c = colours[k % 3];
        struct font_ink ink = font_ink_plain(c[0], c[1], c[2], 0.6);
        ink.numbers = k >= 3;
        if (font_shaper_layout(s, words[k % 3], strlen(words[k % 3]), 92, NULL, &l) != FONT_OK)
            return false;
        int number = font_layout_ink_add(&l, &ink);
        for (int i = 0; i < l.glyphs_count; i++)
            l.glyphs[i].ink = number;
        bool good =
            number > 0 && font_painter_layout(p, &l, NULL, 30 + (k >= 3) * 290 + k % 3 * 14,
                                              270 + k % 3 * 48, to) == FONT_OK;
        font_layout_finish(&l);
        if (!good)
            return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    struct display_image image = {.width_px = WIDTH, .height_px = HEIGHT, .channels = 3};
    struct font_face *face = NULL;
    struct font_shaper *shaper = NULL;
    struct font_painter *painter = NULL;
    struct font_painter_def def = font_painter_def_default();
    if (argc != 2) {
        fputs("usage: letters out.png\n", stderr);
        return 2;
    }
    if (font_face_open("DejaVuSans-Bold", 0, &face) != FONT_OK ||
        font_shaper_create(face, &shaper) != FONT_OK ||
        font_painter_create(&def, &painter) != FONT_OK)
        return fail();
    if (display_image_create(&image) != DISPLAY_OK)
        return EXIT_FAILURE;
    memset(image.pixels, 255, (size_t)3 * WIDTH * HEIGHT);
    struct font_picture picture = {WIDTH, HEIGHT, 3 * WIDTH, image.pixels};
    if (!word_bent(shaper, painter, &picture) || !words_over(shaper, painter, &picture))
        return fail();
    bool written = display_png_write(argv[1], &image) == DISPLAY_OK;
    if (!written)
        fprintf(stderr, "letters: %s\n", display_error());
    display_image_destroy(&image);
    font_painter_destroy(painter);
    font_shaper_destroy(shaper);
    font_face_close(face);
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
