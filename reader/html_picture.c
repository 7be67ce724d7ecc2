/* html_picture.c - formulas and pictures within a file of HTML: see html_internal.h. */
#include "html_internal.h"

#include <drawing.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE_PX 20.0 /* of the formulas' em; browsers scale them */
#define SCALE 0.88   /* so that their small letters are about as high as the text's */

enum { FORMULAS_BYTES = 64 << 20 }; /* of their pictures: formulas behind stand as written */

/* Bytes in a data: address. */
static void base64_put(struct html *h, const unsigned char *bytes, size_t count)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        const size_t n = count - i < 3 ? count - i : 3;
        const unsigned word = (unsigned)bytes[i] << 16 |
                              (n > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                              (n > 2 ? bytes[i + 2] : 0u);
        const char four[4] = {letters[word >> 18], letters[word >> 12 & 63],
                              n > 1 ? letters[word >> 6 & 63] : '=',
                              n > 2 ? letters[word & 63] : '='};
        fwrite(four, 1, sizeof four, h->f);
    }
}

/* ---- formulas ---- */

static bool math_open(struct html *h)
{
    const char *asked = h->setup->math;
    if (h->math || h->math_missing)
        return h->math != NULL;
    if (font_face_open(asked ? asked : font_face_first(font_math_fonts), 0, &h->math_face) ==
            FONT_OK &&
        font_math_create(h->math_face, &h->math) == FONT_OK)
        return true;
    h->math_missing = true;
    if (h->setup->lacks)
        h->setup->lacks->math = true;
    if (asked)
        h->status = reader_fail(READER_FAILED, "%s", font_error());
    return false;
}

/* The formula as a drawing of SVG. Owns: the caller frees it; NULL: it could not be made. */
static char *formula_draw(struct html *h, const struct font_layout *layout, double pad,
                          size_t *bytes)
{
    char *svg = NULL;
    FILE *f = open_memstream(&svg, bytes);
    const struct font_drawing drawing = {.width_px = layout->width_px + 2 * pad,
                                         .height_px =
                                             layout->ascent_px + layout->descent_px + 2 * pad};
    if (!f)
        return NULL;
    const bool drawn =
        font_drawing_svg(&drawing, layout, NULL, pad, pad + layout->ascent_px, f) == FONT_OK;
    if (fclose(f) != 0 || !drawn || h->pictured_bytes + *bytes > FORMULAS_BYTES) {
        free(svg);
        return NULL;
    }
    h->pictured_bytes += *bytes;
    return svg;
}

/* Notes what the formula that was set last lacks. */
static void formula_lacks(const struct html *h, const struct font_layout *layout)
{
    struct reader_html_lacks *lacks = h->setup->lacks;
    int unknown;
    const char *first = font_math_unknown(h->math, &unknown);
    if (!lacks)
        return;
    if (unknown && !lacks->unknown_count)
        snprintf(lacks->unknown, sizeof lacks->unknown, "%s", first);
    lacks->unknown_count += unknown;
    for (int i = 0; i < layout->missing_count && i < FONT_MISSING_MAX; i++)
        font_layout_missing_add(&lacks->letters, layout->missing[i]);
}

bool html_formula_put(struct html *h, const char *tex, int bytes, bool display)
{
    const struct font_math_options options = {.size_px = SIZE_PX, .display = display};
    const double pad = 1, em = SCALE / SIZE_PX;
    struct font_layout layout;
    size_t count = 0;
    if (bytes >= 2 && tex[0] == '$' && tex[bytes - 1] == '$') {
        tex++;
        bytes -= 2;
    }
    if (!math_open(h) ||
        font_math_layout(h->math, tex, (size_t)bytes, &options, &layout) != FONT_OK)
        return false;
    formula_lacks(h, &layout);
    char *svg = formula_draw(h, &layout, pad, &count);
    if (svg) {
        fprintf(
            h->f,
            "<img class=\"formula\" style=\"width:%.3fem;height:%.3fem;vertical-align:%.3fem\" "
            "alt=\"",
            em * (layout.width_px + 2 * pad),
            em * (layout.ascent_px + layout.descent_px + 2 * pad),
            -em * (layout.descent_px + pad));
        html_put(h, tex, (size_t)bytes);
        fputs("\" src=\"data:image/svg+xml;base64,", h->f);
        base64_put(h, (const unsigned char *)svg, count);
        fputs("\">", h->f);
    }
    font_layout_finish(&layout);
    free(svg);
    return svg != NULL;
}

/* ---- pictures ---- */

/* As the block says itself, or the template. */
static struct reader_beside beside_of(const struct html *h, const struct reader_block *block)
{
    const struct reader_template *t = h->setup->template;
    return block->beside.side != READER_SIDE_USUAL || !t ? block->beside : t->beside;
}

bool html_beside_put(struct html *h, const struct reader_block *block)
{
    enum { USUAL = 40 };
    const struct reader_beside own = beside_of(h, block);
    const bool left = own.side == READER_SIDE_LEFT;
    if ((!left && own.side != READER_SIDE_RIGHT) || block->items || block->quotes ||
        block->marker)
        return false;
    fprintf(h->f, "<figure class=\"%s\" style=\"--w:%d%%\"", left ? "left" : "right",
            own.percent ? own.percent : USUAL);
    return true;
}

/* What lines follow, of a picture that text flows around. */
static void shape_put(struct html *h, const struct reader_block *block, const char *png,
                      size_t bytes)
{
    const struct reader_beside own = beside_of(h, block);
    if (own.side != READER_SIDE_LEFT && own.side != READER_SIDE_RIGHT)
        return;
    if (own.round)
        fputs(" style=\"shape-outside:ellipse(50% 50%);shape-margin:1em\"", h->f);
    if (!own.shape)
        return;
    fputs(" style=\"shape-margin:1em;shape-outside:url(data:image/png;base64,", h->f);
    base64_put(h, (const unsigned char *)png, bytes);
    fputs(")\"", h->f);
}

/* How large it is meant to be; browsers show no picture larger than it is. */
static void asked_put(struct html *h, struct reader_asked asked)
{
    if (!asked.width_px && !asked.percent && !asked.height_px)
        return;
    fputs(" style=\"", h->f);
    if (asked.width_px)
        fprintf(h->f, "width:%dpx;", asked.width_px);
    else if (asked.percent)
        fprintf(h->f, "max-width:%d%%;", asked.percent);
    if (asked.height_px)
        fprintf(h->f, "max-height:%dpx;", asked.height_px);
    fputs("\"", h->f);
}

/* The file of a picture. Owns: the caller frees it; NULL: it is not found. */
static char *png_read(struct html *h, int source, const char *target, size_t *bytes)
{
    char *png = NULL;
    *bytes = 0;
    FILE *f = h->setup->picture && target ? open_memstream(&png, bytes) : NULL;
    if (!f)
        return NULL;
    const bool found = h->setup->picture(h->setup->picture_user, source, target, f);
    if (fclose(f) == 0 && found)
        return png;
    free(png);
    return NULL;
}

static void png_put(struct html *h, const char *png, size_t bytes, const char *says,
                    size_t says_bytes)
{
    fputs(" alt=\"", h->f);
    html_put(h, says, says_bytes);
    fputs("\" src=\"data:image/png;base64,", h->f);
    base64_put(h, (const unsigned char *)png, bytes);
    fputs("\">", h->f);
}

bool html_picture_put(struct html *h, const struct reader_block *block)
{
    size_t bytes;
    char *png = png_read(h, block->source, block->target, &bytes);
    if (!png)
        return false;
    fputs("<img", h->f);
    shape_put(h, block, png, bytes);
    if (!block->beside.round && !block->beside.shape)
        asked_put(h, block->asked);
    png_put(h, png, bytes, block->text, (size_t)block->bytes);
    free(png);
    return true;
}

bool html_image_put(struct html *h, const struct reader_block *block,
                    const struct reader_span *span)
{
    size_t bytes;
    char *png = png_read(h, block->source, span->target, &bytes);
    if (!png)
        return false;
    fputs("<img class=\"among\"", h->f);
    asked_put(h, span->asked);
    png_put(h, png, bytes, block->text + span->begin, (size_t)(span->end - span->begin));
    free(png);
    return true;
}

void html_picture_finish(struct html *h)
{
    font_math_destroy(h->math);
    font_face_close(h->math_face);
}
