/* drawing_pdf_ink.c - gradients as PDF has them: see drawing_internal.h. */
#include "drawing_internal.h"

#include <math.h>

/* A colour's numbers, or its cover. */
static void colour_put(const char *name, const double rgba[4], bool cover, FILE *f)
{
    if (cover)
        fprintf(f, " /%s [%.5g]", name, rgba[3]);
    else
        fprintf(f, " /%s [%.5g %.5g %.5g]", name, rgba[0], rgba[1], rgba[2]);
}

/* From one stop to the next, and the ends' colours beyond them, as one function over 0..1. */
static void stops_put(const struct font_ink *ink, bool cover, FILE *f)
{
    int n = ink->stops_count;
    fputs("<< /FunctionType 3 /Domain [0 1] /Functions [", f);
    for (int i = 0; i <= n; i++) {
        fputs(" << /FunctionType 2 /Domain [0 1] /N 1", f);
        colour_put("C0", ink->stops[i ? i - 1 : 0].rgba, cover, f);
        colour_put("C1", ink->stops[i < n ? i : n - 1].rgba, cover, f);
        fputs(" >>", f);
    }
    fputs(" ] /Bounds [", f);
    double before = 0;
    for (int i = 0; i < n; i++) { /* bounds rise, and are within 0..1 */
        before = fmin(fmax(ink->stops[i].at, before + 1e-6), 1 - 1e-6 * (n - i));
        fprintf(f, " %.7f", before); /* PDF has no exponents */
    }
    fputs(" ] /Encode [", f);
    for (int i = 0; i <= n; i++)
        fputs(" 0 1", f);
    fputs(" ] >>", f);
}

void drawn_pdf_shading(const struct font_ink *ink, bool cover, FILE *f)
{
    fprintf(f, "<< /ColorSpace /Device%s /Extend [true true] ", cover ? "Gray" : "RGB");
    if (ink->kind == FONT_INK_RADIAL)
        fprintf(f, "/ShadingType 3 /Coords [%.7g %.7g 0 %.7g %.7g %.7g]", ink->x0, ink->y0,
                ink->x0, ink->y0, ink->x1);
    else
        fprintf(f, "/ShadingType 2 /Coords [%.7g %.7g %.7g %.7g]", ink->x0, ink->y0, ink->x1,
                ink->y1);
    fputs("\n/Function ", f);
    stops_put(ink, cover, f);
    fputs(" >>", f);
}

bool drawn_translucent(const struct font_ink *ink)
{
    double flat[4];
    if (ink->kind == FONT_INK_PICTURE || drawn_flat(ink, flat))
        return false;
    for (int i = 0; i < ink->stops_count; i++)
        if (ink->stops[i].rgba[3] < 1)
            return true;
    return false;
}
