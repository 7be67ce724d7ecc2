/* fuzz_math.c - takes random bytes and random pieces of TeX's notation as formulas. Each is
 * set, with numbers that are numbers, or refused for its size. The seeds are the same in every
 * run, or libFuzzer's with -DLUTETIA_FUZZ_TARGET. */
#include <font_math.h>

#include "../must.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static struct font_math *math_get(void)
{
    static struct font_face *face;
    static struct font_math *math;
    if (!face && (font_face_open(font_face_first(font_math_fonts), 0, &face) != FONT_OK ||
                  font_math_create(face, &math) != FONT_OK)) {
        printf("skipped: there is no font with a MATH table (package fonts-dejavu-extra)\n");
        exit(77);
    }
    return math;
}

/* The first byte is the size and the style. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct font_math *math = math_get();
    struct font_layout layout;
    int unknown;
    if (count < 1)
        return 0;
    const struct font_math_options options = {.size_px = 1 + (bytes[0] >> 1),
                                              .display = bytes[0] & 1};
    enum font_status status =
        font_math_layout(math, (const char *)bytes + 1, count - 1, &options, &layout);
    must(status == FONT_OK || status == FONT_TOO_LARGE);
    must(strlen(font_math_unknown(math, &unknown)) < 48);
    must(isfinite(layout.width_px) && isfinite(layout.ascent_px) &&
         isfinite(layout.descent_px));
    for (int i = 0; i < layout.glyphs_count; i++) {
        const struct font_placed *g = &layout.glyphs[i];
        must(isfinite(g->x_px) && isfinite(g->y_px) && g->size_px > 0);
        must(g->cluster >= 0 && (size_t)g->cluster < count + 16);
    }
    font_layout_finish(&layout);
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
#include "../fuzz_pieces.h"

static const char *const pieces[] = {"x",
                                     "1",
                                     "+",
                                     "=",
                                     "(",
                                     "{",
                                     "}",
                                     "^",
                                     "_",
                                     "'",
                                     "&",
                                     "\\\\",
                                     "\\frac",
                                     "\\sqrt",
                                     "\\sqrt[3]",
                                     "\\left(",
                                     "\\right)",
                                     "\\middle|",
                                     "\\sum",
                                     "\\int",
                                     "\\limits",
                                     "\\hat",
                                     "\\widehat",
                                     "\\overbrace",
                                     "\\mathbf",
                                     "\\text{a b}",
                                     "\\begin{matrix}",
                                     "\\end{matrix}",
                                     "\\begin{aligned}",
                                     "\\over",
                                     "\\choose",
                                     "\\big",
                                     "\\foo",
                                     "\\,",
                                     "\\displaystyle",
                                     "\\not",
                                     "\\xrightarrow[",
                                     "]",
                                     "\\overset",
                                     "\\phantom",
                                     "\\substack{",
                                     "%",
                                     "\n",
                                     "\\pmod",
                                     "\\operatorname*",
                                     "\xe2\x88\x91",
                                     "\\begin{array}{l|r",
                                     "\\mathop",
                                     "\\Biggl",
                                     "\\overline",
                                     "\\",
                                     "\xff"};

int main(int argc, char **argv)
{
    long count = argc > 1 ? strtol(argv[1], NULL, 10) : 3000;
    fuzz_pieces(pieces, sizeof pieces / sizeof *pieces, count, 60);
    printf("%ld formulas\n", count);
    return 0;
}
#endif
