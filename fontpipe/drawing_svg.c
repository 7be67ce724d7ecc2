/* drawing_svg.c - a layout as SVG: see drawing.h. */
#include "colour.h"
#include "drawing_internal.h"

#include <math.h>
#include <stdlib.h>

static int byte_of(double number)
{
    return (int)lrint(255 * fmin(1, fmax(0, number)));
}

/* XML has neither C0's characters nor U+FFFE and U+FFFF, by whatever name. */
static void text_put(const char *text, size_t begin, size_t end, FILE *f)
{
    for (size_t i = begin; i < end; i++) {
        unsigned char c = (unsigned char)text[i];
        if (c == 0xef && end - i >= 3 && (unsigned char)text[i + 1] == 0xbf &&
            (unsigned char)text[i + 2] >= 0xbe) {
            fputc(' ', f);
            i += 2;
        } else if (c == '<' || c == '>' || c == '&' || c == '"')
            fprintf(f, "&#%d;", c);
        else
            fputc(c < ' ' ? ' ' : c, f);
    }
}

/* A picture as ink: repeated from its place on, its pixels as they are. */
static enum font_status pattern_put(const struct font_ink *ink, int number, double x, double y,
                                    FILE *f)
{
    struct font_tile tile;
    enum font_status status = drawn_ink_tile(ink, &tile);
    if (status != FONT_OK)
        return status;
    fprintf(f,
            "<pattern id=\"i%d\" patternUnits=\"userSpaceOnUse\" x=\"%.7g\" y=\"%.7g\" "
            "width=\"%d\" height=\"%d\"><image width=\"%d\" height=\"%d\" "
            "image-rendering=\"optimizeSpeed\" href=\"data:image/png;base64,",
            number, x + ink->x0, y + ink->y0, ink->width_px, ink->height_px, ink->width_px,
            ink->height_px);
    status = drawn_png(&tile, f);
    fputs("\"/></pattern>\n", f);
    free(tile.rgba);
    return status;
}

static void gradient_put(const struct font_ink *ink, int number, double x, double y, FILE *f)
{
    bool round = ink->kind == FONT_INK_RADIAL;
    if (round)
        fprintf(f,
                "<radialGradient id=\"i%d\" gradientUnits=\"userSpaceOnUse\" cx=\"%.7g\" "
                "cy=\"%.7g\" "
                "r=\"%.7g\">",
                number, x + ink->x0, y + ink->y0, ink->x1);
    else
        fprintf(f,
                "<linearGradient id=\"i%d\" gradientUnits=\"userSpaceOnUse\" x1=\"%.7g\" "
                "y1=\"%.7g\" "
                "x2=\"%.7g\" y2=\"%.7g\">",
                number, x + ink->x0, y + ink->y0, x + ink->x1, y + ink->y1);
    for (int i = 0; i < ink->stops_count; i++) {
        const double *c = ink->stops[i].rgba;
        fprintf(f, "<stop offset=\"%.6g\" stop-color=\"rgb(%d,%d,%d)\" stop-opacity=\"%.6g\"/>",
                ink->stops[i].at, byte_of(c[0]), byte_of(c[1]), byte_of(c[2]), c[3]);
    }
    fputs(round ? "</radialGradient>\n" : "</linearGradient>\n", f);
}

static void fill_put(const struct font_drawing *d, const struct font_layout *layout, int i,
                     FILE *f)
{
    struct font_ink own;
    const struct font_ink *ink = drawn_ink(d, layout, i, &own);
    double c[4];
    if (!drawn_flat(ink, c))
        fprintf(f, " fill=\"url(#i%d)\" fill-opacity=\"%.6g\"", layout->glyphs[i].ink,
                ink->kind == FONT_INK_PICTURE ? ink->rgba[3] : 1);
    else if (ink != &own)
        fprintf(f, " fill=\"rgb(%d,%d,%d)\" fill-opacity=\"%.6g\"", byte_of(c[0]),
                byte_of(c[1]), byte_of(c[2]), c[3]);
}

static enum font_status picture_put(const struct font_drawing *d,
                                    const struct font_layout *layout, struct drawn *drawn,
                                    int i, const struct font_map *map, double x, double y,
                                    FILE *f)
{
    struct font_tile tile;
    enum font_status status = drawn_tile(drawn, d, layout, i, map, x, y, &tile);
    if (status != FONT_OK || !tile.width_px)
        return status;
    const double part = 1.0 / DRAWN_FINER;
    fprintf(f,
            "<image x=\"%.7g\" y=\"%.7g\" width=\"%.7g\" height=\"%.7g\" "
            "href=\"data:image/png;base64,",
            tile.left_px * part, tile.top_px * part, tile.width_px * part,
            tile.height_px * part);
    status = drawn_png(&tile, f);
    fputs("\"/>\n", f);
    free(tile.rgba);
    return status;
}

/* A letter: its outline used at its place; or a path where it is distorted, or has an ink whose
 * places are the picture's. */
static enum font_status letter_put(const struct font_drawing *d,
                                   const struct font_layout *layout, struct drawn *drawn, int i,
                                   const struct font_map *map, double x, double y, FILE *f)
{
    struct font_map whole;
    if (drawn->glyphs[drawn->of[i]].picture)
        return picture_put(d, layout, drawn, i, map, x, y, f);
    struct font_outline outline;
    struct font_ink own;
    double flat[4];
    enum font_status status = drawn_map(layout, i, map, x, y, &whole);
    if (status != FONT_OK)
        return status;
    if (whole.kind == FONT_AFFINE && drawn_flat(drawn_ink(d, layout, i, &own), flat)) {
        const double *m = whole.m;
        fprintf(f, "<use href=\"#g%d\" transform=\"matrix(%.7g %.7g %.7g %.7g %.7g %.7g)\"",
                drawn->of[i], m[0], m[3], m[1], m[4], m[2], m[5]);
        fill_put(d, layout, i, f);
        fputs("/>\n", f);
        return FONT_OK;
    }
    status = font_face_outline_or_none(layout->glyphs[i].face, layout->glyphs[i].glyph, false,
                                       &outline);
    if (status != FONT_OK)
        return status;
    fputs("<path", f);
    fill_put(d, layout, i, f);
    fputs(" d=\"", f);
    status = drawn_path(&outline, &whole, false, f);
    fputs("\"/>\n", f);
    font_outline_finish(&outline);
    return status;
}

static enum font_status outlines_put(const struct drawn *drawn, FILE *f)
{
    for (int k = 0; k < drawn->count; k++) {
        struct font_outline outline;
        if (drawn->glyphs[k].picture)
            continue;
        enum font_status status = font_face_outline_or_none(
            drawn->glyphs[k].face, drawn->glyphs[k].glyph, false, &outline);
        if (status != FONT_OK)
            return status;
        fprintf(f, "<path id=\"g%d\" d=\"", k);
        status = drawn_path(&outline, NULL, false, f);
        fputs("\"/>\n", f);
        font_outline_finish(&outline);
        if (status != FONT_OK)
            return status;
    }
    return FONT_OK;
}

/* Where glyph i's origin is; false: beyond the horizon. */
static bool origin_of(const struct font_layout *layout, int i, const struct font_map *map,
                      double x, double y, struct font_point *out)
{
    struct font_map pixels;
    struct font_point at = {0, 0};
    double gx, gy, jacobian[4];
    if (font_placed_map(layout, i, map, x, y, &pixels, &gx, &gy) != FONT_OK ||
        !font_map_point(&pixels, at, &at, jacobian))
        return false;
    *out = (struct font_point){gx + at.x, gy + at.y};
    return true;
}

/* What glyphs first..end say, which are of one line: from its left end to its right one. */
static void line_put(const struct font_drawing *d, const struct font_layout *layout,
                     const struct drawn *drawn, int first, int end, const struct font_map *map,
                     double x, double y, FILE *f)
{
    size_t from = d->bytes, to = 0;
    struct font_point a = {0, 0}, b = {0, 0}, at;
    bool any = false;
    for (int i = first; i < end; i++) {
        const struct drawn_text *t = &drawn->texts[i];
        if (t->begin == t->end || !origin_of(layout, i, map, x, y, &at))
            continue;
        from = t->begin < from ? t->begin : from;
        to = t->end > to ? t->end : to;
        if (!any)
            a = b = at;
        a = at.x < a.x ? at : a;
        b = at.x > b.x ? at : b;
        any = true;
    }
    if (!any)
        return;
    fprintf(f, "<text x=\"%.7g\" y=\"%.7g\" font-size=\"%.6g\" xml:space=\"preserve\"", a.x,
            a.y, font_placed_size(layout, &layout->glyphs[first]));
    if (b.x > a.x && fabs(b.y - a.y) < 1e-3 * (b.x - a.x))
        fprintf(f, " textLength=\"%.7g\" lengthAdjust=\"spacingAndGlyphs\"",
                b.x - a.x + 0.5 * font_placed_size(layout, &layout->glyphs[first]));
    fputs(">", f);
    text_put(d->text, from, to, f);
    fputs("</text>\n", f);
}

/* The text itself, unseen, each line where it stands: programs find it and copy it. */
static void words_put(const struct font_drawing *d, const struct font_layout *layout,
                      const struct drawn *drawn, const struct font_map *map, double x, double y,
                      FILE *f)
{
    fputs("<g opacity=\"0\" font-family=\"sans-serif\">\n", f);
    for (int first = 0, i = 1; i <= layout->glyphs_count; i++)
        if (i == layout->glyphs_count || layout->glyphs[i].line != layout->glyphs[first].line) {
            line_put(d, layout, drawn, first, i, map, x, y, f);
            first = i;
        }
    fputs("</g>\n", f);
}

/* ---- beside the letters ---- */

static void boxes_put(const struct font_drawing *d, FILE *f)
{
    for (int i = 0; i < d->boxes_count; i++) {
        const struct font_drawing_box *b = &d->boxes[i];
        fprintf(f,
                "<rect x=\"%.3f\" y=\"%.3f\" width=\"%.3f\" height=\"%.3f\" "
                "fill=\"rgb(%d,%d,%d)\" fill-opacity=\"%.4g\"/>\n",
                drawn_near(b->x), drawn_near(b->y), drawn_near(b->width), drawn_near(b->height),
                byte_of(b->rgba[0]), byte_of(b->rgba[1]), byte_of(b->rgba[2]), b->rgba[3]);
    }
}

static void strokes_put(const struct font_drawing *d, FILE *f)
{
    for (int i = 0; i < d->strokes_count; i++) {
        const struct font_drawing_stroke *s = &d->strokes[i];
        fprintf(f,
                "<g fill=\"none\" stroke=\"rgb(%d,%d,%d)\" stroke-linecap=\"round\" "
                "stroke-linejoin=\"round\" opacity=\"%.4g\">\n",
                byte_of(s->rgba[0]), byte_of(s->rgba[1]), byte_of(s->rgba[2]), s->rgba[3]);
        for (int k = 0; k < s->points_count;) {
            const int end = drawn_run(s, k);
            const struct font_drawing_point *from = &s->points[k > 0 ? k - 1 : 0];
            fprintf(f, "<path stroke-width=\"%.3f\" d=\"M%.3f,%.3f",
                    drawn_near(s->points[k].width_px), drawn_near(from->x),
                    drawn_near(from->y));
            for (; k < end; k++)
                fprintf(f, "L%.3f,%.3f", drawn_near(s->points[k].x),
                        drawn_near(s->points[k].y));
            fputs("\"/>\n", f);
        }
        fputs("</g>\n", f);
    }
}

static enum font_status spread_put(const struct font_drawing *d,
                                   const struct font_layout *layout, const struct font_map *map,
                                   double x, double y, FILE *f)
{
    struct drawn drawn = {0};
    enum font_status status = drawn_find(d, layout, &drawn);
    if (status != FONT_OK)
        return status;
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.7g\" height=\"%.7g\" "
            "viewBox=\"0 0 %.7g %.7g\">\n<defs>\n",
            d->width_px, d->height_px, d->width_px, d->height_px);
    for (int i = 0; i < layout->inks_count && status == FONT_OK; i++) {
        const struct font_ink *ink = &layout->inks[i];
        double flat[4];
        if (ink->kind == FONT_INK_PICTURE)
            status = pattern_put(ink, i + 1, x, y, f);
        else if (!drawn_flat(ink, flat))
            gradient_put(ink, i + 1, x, y, f);
    }
    if (status == FONT_OK)
        status = outlines_put(&drawn, f);
    fputs("</defs>\n", f);
    boxes_put(d, f);
    fprintf(f, "<g fill=\"rgb(%d,%d,%d)\">\n", byte_of(d->ink[0]), byte_of(d->ink[1]),
            byte_of(d->ink[2]));
    for (int i = 0; i < layout->glyphs_count && status == FONT_OK; i++)
        status = letter_put(d, layout, &drawn, i, map, x, y, f);
    fputs("</g>\n", f);
    strokes_put(d, f);
    if (d->text)
        words_put(d, layout, &drawn, map, x, y, f);
    fputs("</svg>\n", f);
    drawn_finish(&drawn);
    return status == FONT_OK && ferror(f)
               ? font_fail(FONT_BAD_FILE, "the drawing cannot be written")
               : status;
}

enum font_status font_drawing_svg(const struct font_drawing *d,
                                  const struct font_layout *layout, const struct font_map *map,
                                  double x, double y, FILE *f)
{
    return drawn_spread(d, layout, map, x, y, f, spread_put);
}
