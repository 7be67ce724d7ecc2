/* fuzz_face_seeds.c - writes small fonts as first inputs of a fuzzer: a few letters of each
 * installed font, one with colours.
 *
 *     fuzz_face_seeds FOLDER */
#include "made_font.h"

#include <fontconfig/fontconfig.h>
#include <hb-subset.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const uint32_t letters[] = {'A', 'V',  'f',   'i',   'g',   '&',   'l',
                                   ' ', 0xe9, 0x5d0, 0x627, 0x628, 0x644, 0x1f438};

static bool bytes_write(const char *folder, int number, const void *bytes, size_t count)
{
    char name[4096];
    snprintf(name, sizeof name, "%s/font-%03d", folder, number);
    FILE *f = count ? fopen(name, "wb") : NULL;
    bool good = f && fwrite(bytes, 1, count, f) == count;
    return (f && fclose(f) == 0) && good;
}

/* Makes paints of all kinds, for glyphs 1 to 4. */
static struct made_paints *paints_make(void)
{
    enum { ONE = 0x4000 };
    struct made_paints *p = made_paints_begin();
    size_t a = made_layer(p), b = made_layer(p);
    made_paint(p, made_base(p, 1), 1, "14", 2, 0);
    size_t glyph = made_paint(p, a, 10, "32", 0, 2);
    made_paint(p, glyph + 1, 3, "224", 0, ONE, 0);
    glyph = made_paint(p, b, 10, "32", 0, 3);
    size_t turn = made_paint(p, glyph + 1, 26, "3222", 0, ONE / 5, 300, 200);
    size_t line = made_paint(p, turn + 1, 6, "3222222", 0, 600, 600, 100, 600, 500, 900);
    made_put(p->paints + line + 1, (unsigned)(p->paints_count - line), 3);
    static const uint8_t stops[] = {1, 0, 2, 0x10, 0, 0, 0, 0x40, 0, 0x30, 0, 0, 1, 0x40, 0};
    memcpy(p->paints + p->paints_count, stops, sizeof stops);
    p->paints_count += sizeof stops;
    size_t mix = made_paint(p, made_base(p, 2), 32, "313", 0, 14, 0);
    made_paint(p, mix + 1, 11, "2", 1);
    size_t slant = made_paint(p, mix + 5, 29, "3224", 0, ONE / 9, ONE / 20, 0);
    size_t scale = made_paint(p, slant + 1, 18, "32222", 0, ONE / 2, ONE, 100, 100);
    made_paint(p, scale + 1, 11, "2", 1);
    made_clip(p, 2, 0, -300, 1400, 1500);
    return p;
}

/* Writes the font with colours of each kind. */
static int coloured_make(const char *folder, int number, hb_blob_t *plain)
{
    static const uint8_t palette[][4] = {{0, 0, 255, 255}, {0, 255, 0, 128}};
    static const uint8_t layers[] = {0, 0, 0, 1, 0, 0, 0, 14, 0, 0, 0, 20, 0, 2,
                                     0, 1, 0, 0, 0, 2, 0, 2,  0, 0, 0, 3,  0, 1};
    uint8_t cpal[64], svg[512];
    size_t count, cpal_count = made_cpal(palette, 2, cpal);
    struct made_paints *paints = paints_make();
    uint8_t *colr = made_colr(paints, &count);
    size_t svg_count = made_svg("<svg xmlns=\"http://www.w3.org/2000/svg\"><g id=\"glyph1\">"
                                "<rect y=\"-900\" width=\"900\" height=\"900\"/></g></svg>",
                                1, 3, svg);
    const struct made_table kinds[][2] = {
        {{"COLR", colr, count}, {"CPAL", cpal, cpal_count}},
        {{"COLR", layers, sizeof layers}, {"CPAL", cpal, cpal_count}},
        {{"SVG ", svg, svg_count}, {"CPAL", cpal, cpal_count}}};
    int made = 0;
    for (int i = 0; i < 3; i++) {
        unsigned bytes_count;
        size_t font_count;
        const char *bytes = hb_blob_get_data(plain, &bytes_count);
        uint8_t *font =
            made_font((const uint8_t *)bytes, bytes_count, kinds[i], 2, &font_count);
        made += bytes_write(folder, number + i, font, font_count);
        free(font);
    }
    unsigned plain_count;
    size_t wide_count;
    const char *bytes = hb_blob_get_data(plain, &plain_count);
    uint8_t *wide = made_wide((const uint8_t *)bytes, plain_count, &wide_count);
    made += bytes_write(folder, number + 3, wide, wide_count);
    free(wide);
    free(colr);
    free(paints);
    return made;
}

/* Writes the font with a few letters only, or the whole font where it cannot be made
 * smaller. */
static int seed_make(const char *file, const char *folder, int number)
{
    enum { WHOLE_MAX = 100000, COLOURED = 900 };
    hb_blob_t *blob = hb_blob_create_from_file(file);
    hb_face_t *face = hb_face_create(blob, 0), *made = NULL;
    hb_subset_input_t *input = hb_subset_input_create_or_fail();
    for (size_t i = 0; input && i < sizeof letters / sizeof *letters; i++)
        hb_set_add(hb_subset_input_unicode_set(input), letters[i]);
    if (input && hb_face_get_glyph_count(face))
        made = hb_subset_or_fail(face, input);
    hb_blob_t *small = made ? hb_face_reference_blob(made) : hb_blob_reference(blob);
    unsigned count;
    const char *bytes = hb_blob_get_data(small, &count);
    int files = count && count < WHOLE_MAX && bytes_write(folder, number, bytes, count);
    if (files && made && strstr(file, "/DejaVuSans.ttf"))
        files += coloured_make(folder, COLOURED, small);
    hb_blob_destroy(small);
    hb_face_destroy(made);
    hb_subset_input_destroy(input);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
    return files;
}

int main(int argc, char **argv)
{
    if (argc != 2 || (mkdir(argv[1], 0777) != 0 && access(argv[1], W_OK) != 0)) {
        fprintf(stderr, "usage: fuzz_face_seeds FOLDER\n");
        return 2;
    }
    FcPattern *all = FcPatternCreate();
    FcObjectSet *file = FcObjectSetBuild(FC_FILE, NULL);
    FcFontSet *fonts = FcFontList(NULL, all, file);
    int made = 0;
    for (int i = 0; fonts && i < fonts->nfont; i++) {
        FcChar8 *name;
        if (FcPatternGetString(fonts->fonts[i], FC_FILE, 0, &name) == FcResultMatch)
            made += seed_make((const char *)name, argv[1], i);
    }
    printf("%d fonts\n", made);
    if (fonts)
        FcFontSetDestroy(fonts);
    FcObjectSetDestroy(file);
    FcPatternDestroy(all);
    return made ? 0 : 1;
}
