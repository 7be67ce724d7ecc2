/* fuzz_face.c - see fuzz_face.h. With libFuzzer it is the target; fuzz_face_seeds.c makes small
 * fonts as its first inputs. */
#include "fuzz_face.h"

#include <drawing.h>
#include <paint.h>

#include "../must.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GLYPHS = 8, SIDE = 96 };

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* Sets each axis to a random place, which may be an end or beyond. */
static void axes_set(struct font_face *face, int count, uint32_t *seed)
{
    for (int i = 0; i < count && i < 4; i++) {
        struct font_axis axis;
        must(font_face_axis(face, i, &axis) == FONT_OK);
        double part = next(seed) % 13 / 10.0 - 0.1;
        (void)font_face_axis_set(face, axis.tag, axis.least + part * (axis.most - axis.least));
    }
}

/* Makes a glyph's outline, edges and gray. Returns whether there is ink. */
static bool glyph_use(struct font_face *face, uint32_t glyph, double em,
                      struct font_painter *painter)
{
    struct font_outline o;
    const struct font_gray *gray;
    double advance;
    (void)font_face_advance(face, glyph, &advance);
    (void)font_face_kerning(face, glyph, glyph / 2);
    if (font_face_outline(face, glyph, &o) != FONT_OK)
        return false;
    must(o.prepared && o.units_per_em == em);
    struct font_box box = font_outline_box(&o);
    double most = 40 * em;
    bool small = box.x0 > -most && box.x1 < most && box.y0 > -most && box.y1 < most;
    font_outline_finish(&o);
    return small &&
           font_painter_glyph(painter, face, glyph, 12.25, NULL, 0.5, 0.25, &gray) == FONT_OK &&
           gray->pixels;
}

static void layout_use(const struct font_layout *l, struct font_painter *painter)
{
    static uint8_t rgb[SIDE * SIDE * 3];
    struct font_picture to = {
        .rgb = rgb, .width_px = SIDE, .height_px = SIDE, .pitch = 3 * SIDE};
    struct font_map turned = font_map_rotation(20);
    struct font_drawing d = {.width_px = SIDE, .height_px = SIDE};
    struct font_box box;
    char *bytes = NULL;
    size_t count;
    if (font_painter_measure(painter, l, NULL, 4, 40, &box) == FONT_OK &&
        box.x1 - box.x0 < 4000 && box.y1 - box.y0 < 4000) {
        (void)font_painter_layout(painter, l, NULL, 4, 40, &to);
        (void)font_painter_layout(painter, l, &turned, 4, 40, &to);
    }
    for (int pdf = 0; pdf < 2; pdf++) {
        FILE *f = open_memstream(&bytes, &count);
        must(f);
        (void)(pdf ? font_drawing_pdf : font_drawing_svg)(&d, l, NULL, 4, 40, f);
        fclose(f);
        free(bytes);
    }
}

static void text_use(struct font_face *face, struct font_painter *painter)
{
    static const char text[] = "AVfig& \xc3\xa9 \xd7\x90\xd8\xa8\xd8\xa7 \xf0\x9f\x90\xb8";
    struct font_shaper *shaper;
    struct font_layout layout;
    struct font_text_options alone = {.no_fallback = true, .width_px = 60};
    must(font_shaper_create(face, &shaper) == FONT_OK);
    font_shaper_colour(shaper);
    if (font_shaper_layout(shaper, text, sizeof text - 1, 12, &alone, &layout) == FONT_OK) {
        must(layout.glyphs_count >= 1);
        layout_use(&layout, painter);
    }
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
}

int fuzz_face(const uint8_t *bytes, size_t count)
{
    struct font_face *face;
    struct font_face_info info;
    static struct font_painter *painter; /* a filter takes long to make */
    const struct font_painter_def def = font_painter_def_default();
    uint32_t seed = (uint32_t)count;
    int inked = 0;
    for (size_t i = 0; i < count; i += 1 + count / 61)
        seed = seed * 31 + bytes[i];
    if (font_face_open_memory_coloured(bytes, count, 0, &face) != FONT_OK) {
        must(*font_error() && !strchr(font_error(), '\n'));
        return -1;
    }
    font_face_describe(face, &info);
    must(info.units_per_em > 0 && info.line_height > 0 && info.ascender > info.descender);
    must(painter || font_painter_create(&def, &painter) == FONT_OK);
    (void)font_face_stem(face);
    for (int turn = 0; turn < (info.axes_count ? 2 : 1); turn++) {
        if (turn)
            axes_set(face, info.axes_count, &seed);
        for (int i = 0; i < GLYPHS; i++) {
            uint32_t glyph = i < 4 ? font_face_glyph(face, (uint32_t) "Ag&\xe9"[i] & 0xff)
                                   : next(&seed) % ((uint32_t)info.glyphs_count + 2);
            inked += glyph_use(face, glyph, info.units_per_em, painter);
        }
        text_use(face, painter);
    }
    font_face_close(face);
    return inked;
}

#ifdef LUTETIA_FUZZ_TARGET
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    (void)fuzz_face(bytes, count);
    return 0;
}
#endif
