/* pdf_ink.c - what letters are filled with, as PDF has it: gradients, pictures, what lets
 * something through. See pdf_internal.h. */
#include "pdf_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A colour's numbers, or its cover. */
static void colour_put(const char *name, const double rgba[4], bool cover, FILE *f)
{
    if (cover)
        fprintf(f, " /%s [%.5g]", name, pdf_plain(rgba[3]));
    else
        fprintf(f, " /%s [%.5g %.5g %.5g]", name, pdf_plain(rgba[0]), pdf_plain(rgba[1]),
                pdf_plain(rgba[2]));
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

static void shading_put(const struct font_ink *ink, bool cover, FILE *f)
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

/* ---- pictures ---- */

void pdf_picture_finish(struct pdf_picture *picture)
{
    for (int k = 0; k < 2; k++)
        free(picture->packed[k]);
}

/* Without cover if all of it covers. */
bool pdf_picture_pack(const struct font_tile *tile, struct pdf_picture *out)
{
    size_t count = (size_t)tile->width_px * (size_t)tile->height_px;
    uint8_t *apart = calloc(4, count);
    bool opaque = true;
    *out = (struct pdf_picture){.width_px = tile->width_px, .height_px = tile->height_px};
    for (size_t i = 0; apart && i < count; i++) {
        memcpy(apart + 3 * i, tile->rgba + 4 * i, 3);
        apart[3 * count + i] = tile->rgba[4 * i + 3];
        opaque = opaque && tile->rgba[4 * i + 3] == 255;
    }
    for (int k = 0; apart && k < 2 - opaque; k++)
        out->packed[k] =
            drawn_deflated(apart + (k ? 3 * count : 0), k ? count : 3 * count, &out->counts[k]);
    free(apart);
    return out->packed[0] && (out->packed[1] || opaque);
}

/* Its cover, then itself. */
void pdf_picture_put(struct font_document *p, struct pdf_picture *picture)
{
    int cover = 0;
    for (int k = picture->packed[1] ? 1 : 0; k >= 0; k--) {
        picture->number = pdf_object(p);
        pdf_object_begin(p, picture->number);
        fprintf(p->f,
                "<< /Type /XObject /Subtype /Image /Width %d /Height %d /ColorSpace /Device%s "
                "/BitsPerComponent 8 /Filter /FlateDecode /Length %zu",
                picture->width_px, picture->height_px, k ? "Gray" : "RGB", picture->counts[k]);
        if (cover)
            fprintf(p->f, " /SMask %d 0 R", cover);
        fputs(" >>\nstream\n", p->f);
        fwrite(picture->packed[k], 1, picture->counts[k], p->f);
        fputs("\nendstream\nendobj\n", p->f);
        cover = picture->number;
    }
}

/* ---- inks ---- */

/* From the layout's pixels to the page's points. */
static void matrix_put(const struct pdf_making *m, double x, double y, FILE *f)
{
    fprintf(f, "%g 0 0 %g %.7g %.7g", pdf_point_px, -pdf_point_px,
            pdf_plain((m->x + x) * pdf_point_px),
            pdf_plain((m->d->height_px - m->y - y) * pdf_point_px));
}

/* A picture as ink: a pattern of its own. Its number. */
static int pattern_put(const struct pdf_making *m, int ink, const struct pdf_picture *picture)
{
    struct font_document *p = m->p;
    const struct font_ink *of = &m->layout->inks[ink];
    char content[64];
    int count = snprintf(content, sizeof content, "%d 0 0 %d 0 %d cm /I Do", of->width_px,
                         -of->height_px, of->height_px);
    int number = pdf_object(p);
    pdf_object_begin(p, number);
    fprintf(p->f,
            "<< /Type /Pattern /PatternType 1 /PaintType 1 /TilingType 1 /BBox [0 0 %d %d]\n"
            "/XStep %d /YStep %d /Matrix [",
            of->width_px, of->height_px, of->width_px, of->height_px);
    matrix_put(m, of->x0, of->y0, p->f);
    fprintf(p->f, "]\n/Resources << /XObject << /I %d 0 R >> >> /Length %d >>\nstream\n",
            picture->number, count);
    fputs(content, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    return number;
}

/* How much a gradient covers, as the light of a group of its own. Its number. */
static int mask_put(const struct pdf_making *m, int ink)
{
    struct font_document *p = m->p;
    char *content = NULL;
    size_t count = 0;
    FILE *f = open_memstream(&content, &count);
    int number = pdf_object(p);
    p->failed = p->failed || !f;
    if (!f)
        return number;
    matrix_put(m, 0, 0, f);
    fputs(" cm /S sh", f);
    p->failed = fclose(f) != 0 || p->failed;
    pdf_object_begin(p, number);
    fprintf(p->f,
            "<< /Type /XObject /Subtype /Form /BBox [0 0 %.7g %.7g] /Group << /S /Transparency "
            "/CS /DeviceGray >>\n/Resources << /Shading << /S ",
            m->d->width_px * pdf_point_px, m->d->height_px * pdf_point_px);
    shading_put(&m->layout->inks[ink], true, p->f);
    fprintf(p->f, " >> >> /Length %zu >>\nstream\n", count);
    fwrite(content, 1, content ? count : 0, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    free(content);
    return number;
}

enum font_status pdf_inks_make(struct pdf_making *m, int *numbers)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < m->layout->inks_count && status == FONT_OK; i++) {
        const struct font_ink *ink = &m->layout->inks[i];
        struct font_tile tile;
        struct pdf_picture picture;
        if (ink->kind == FONT_INK_PICTURE) {
            status = drawn_ink_tile(ink, &tile);
            if (status != FONT_OK)
                break;
            if (pdf_picture_pack(&tile, &picture)) {
                pdf_picture_put(m->p, &picture);
                numbers[i] = pattern_put(m, i, &picture);
            } else {
                status = pdf_no_memory();
            }
            pdf_picture_finish(&picture);
            free(tile.rgba);
        } else if (drawn_translucent(ink)) {
            numbers[i] = mask_put(m, i);
        }
    }
    return status;
}

/* In the page's resources: what letters are filled with, and how much that covers. */
void pdf_inks_put(const struct pdf_making *m, const int *numbers)
{
    const struct font_document *p = m->p;
    bool masks = false;
    for (int i = 0; i < m->layout->inks_count; i++)
        masks = masks || drawn_translucent(&m->layout->inks[i]);
    fputs(" /ExtGState <<", p->f);
    for (int i = 0; i < 256; i++)
        if (m->covers[i])
            fprintf(p->f, " /A%d << /ca %.5g%s >>", i, i / 255.0, masks ? " /SMask /None" : "");
    for (int i = 0; i < m->layout->inks_count; i++)
        if (numbers[i] && m->layout->inks[i].kind != FONT_INK_PICTURE)
            fprintf(p->f,
                    "\n/M%d << /ca 1 /SMask << /Type /Mask /S /Luminosity /G %d 0 R >> >>",
                    i + 1, numbers[i]);
    fputs(" >> /Pattern <<", p->f);
    for (int i = 0; i < m->layout->inks_count; i++) {
        const struct font_ink *ink = &m->layout->inks[i];
        double flat[4];
        if (ink->kind == FONT_INK_PICTURE) {
            fprintf(p->f, "\n/P%d %d 0 R", i + 1, numbers[i]);
        } else if (!drawn_flat(ink, flat)) {
            fprintf(p->f, "\n/P%d << /PatternType 2 /Matrix [", i + 1);
            matrix_put(m, 0, 0, p->f);
            fputs("]\n/Shading ", p->f);
            shading_put(ink, false, p->f);
            fputs(" >>", p->f);
        }
    }
    fputs(" >>", p->f);
}

void pdf_ink_use(struct pdf_making *m, int i)
{
    FILE *f = m->f;
    struct font_ink own;
    const struct font_ink *ink = drawn_ink(m->d, m->layout, i, &own);
    int number = m->layout->glyphs[i].ink;
    double c[4];
    bool flat = drawn_flat(ink, c);
    int cover = (int)lrint(255 * (flat                            ? c[3]
                                  : ink->kind == FONT_INK_PICTURE ? ink->rgba[3]
                                                                  : 1));
    m->covers[cover] = true;
    if (flat)
        fprintf(f, "%.5g %.5g %.5g rg /A%d gs\n", pdf_plain(c[0]), pdf_plain(c[1]),
                pdf_plain(c[2]), cover);
    else if (drawn_translucent(ink))
        fprintf(f, "/Pattern cs /P%d scn /M%d gs\n", number, number);
    else
        fprintf(f, "/Pattern cs /P%d scn /A%d gs\n", number, cover);
}
