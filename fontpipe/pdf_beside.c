/* pdf_beside.c - boxes under the letters of a page and strokes over them: see pdf_internal.h.
 *
 * What lets something through is one group: a stroke that crosses itself is no darker there. */
#include "pdf_internal.h"

#include <math.h>
#include <stdlib.h>

/* From a page's pixels to its points. */
static double point_x(double x_px)
{
    return drawn_near(x_px) * pdf_point_px;
}

static double point_y(const struct pdf_making *m, double y_px)
{
    return drawn_near(m->d->height_px - y_px) * pdf_point_px;
}

static int cover_of(struct pdf_making *m, const double rgba[4])
{
    const int cover = (int)lrint(255 * fmin(fmax(rgba[3], 0), 1));
    m->covers[cover] = true;
    return cover;
}

void pdf_boxes_show(struct pdf_making *m)
{
    const struct font_drawing *d = m->d;
    if (d->boxes_count)
        fputs("/Artifact BMC\n", m->f);
    for (int i = 0; i < d->boxes_count; i++) {
        const struct font_drawing_box *b = &d->boxes[i];
        fprintf(m->f, "q %.4f %.4f %.4f rg /A%d gs %.3f %.3f %.3f %.3f re f Q\n", b->rgba[0],
                b->rgba[1], b->rgba[2], cover_of(m, b->rgba), point_x(b->x),
                point_y(m, b->y + b->height), point_x(b->width), point_x(b->height));
    }
    if (d->boxes_count)
        fputs("EMC\n", m->f);
}

void pdf_strokes_show(struct pdf_making *m)
{
    const struct font_drawing *d = m->d;
    if (d->strokes_count)
        fputs("/Artifact BMC\n", m->f);
    for (int i = 0; i < d->strokes_count; i++)
        fprintf(m->f, "q /A%d gs /S%d Do Q\n", cover_of(m, d->strokes[i].rgba), i);
    if (d->strokes_count)
        fputs("EMC\n", m->f);
}

static void stroke_put(const struct pdf_making *m, const struct font_drawing_stroke *s, FILE *f)
{
    fprintf(f, "1 J 1 j %.4f %.4f %.4f RG\n", s->rgba[0], s->rgba[1], s->rgba[2]);
    for (int i = 0; i < s->points_count;) {
        const int end = drawn_run(s, i);
        const struct font_drawing_point *p = &s->points[i > 0 ? i - 1 : 0];
        fprintf(f, "%.3f w %.3f %.3f m\n", point_x(s->points[i].width_px), point_x(p->x),
                point_y(m, p->y));
        for (; i < end; i++)
            fprintf(f, "%.3f %.3f l\n", point_x(s->points[i].x), point_y(m, s->points[i].y));
        fputs("S\n", f);
    }
}

enum font_status pdf_strokes_make(const struct pdf_making *m, int *numbers)
{
    const struct font_drawing *d = m->d;
    char more[160];
    snprintf(
        more, sizeof more,
        "/Type /XObject /Subtype /Form /BBox [0 0 %.3f %.3f] /Group << /S /Transparency >>",
        d->width_px * pdf_point_px, d->height_px * pdf_point_px);
    for (int i = 0; i < d->strokes_count; i++) {
        char *content = NULL;
        size_t count = 0;
        FILE *f = open_memstream(&content, &count);
        if (!f)
            return pdf_no_memory();
        stroke_put(m, &d->strokes[i], f);
        const bool good = fclose(f) == 0;
        if (good)
            pdf_stream(m->p, &numbers[i], more, content, count);
        free(content);
        if (!good)
            return pdf_no_memory();
    }
    return FONT_OK;
}
