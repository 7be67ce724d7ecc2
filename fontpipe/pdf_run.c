/* pdf_run.c - letters in rows: see pdf_internal.h.
 *
 * A row begins where an em's map is told (Tm). Letters of the same font, under the same map and
 * on the same line follow each other by their widths; where one stands elsewhere than behind
 * the one before, the row says by how much (TJ, in thousandths of an em). */
#include "pdf_internal.h"

#include <math.h>
#include <string.h>

static void row_end(struct pdf_making *m)
{
    if (m->run.within)
        fputs(">] TJ\n", m->f);
    m->run.within = false;
}

void pdf_run_end(struct pdf_making *m)
{
    if (!m->run.open)
        return;
    row_end(m);
    if (m->run.hidden)
        fputs("0 Tr ", m->f);
    fputs("ET\n", m->f);
    m->run.open = false;
}

/* Where a map's origin is on the row, in its ems. False: it is on another, or the map is
 * another. */
static bool row_place(const struct pdf_run *run, const double em[6], double *along)
{
    const double near = 1e-6, off = 1e-4, far = 16;
    const double *a = run->m;
    double size = fabs(a[0]) + fabs(a[1]) + fabs(a[2]) + fabs(a[3]);
    for (int k = 0; k < 4; k++)
        if (!(fabs(a[k] - em[k]) <= near * size))
            return false;
    double det = a[0] * a[3] - a[1] * a[2], dx = em[4] - a[4], dy = em[5] - a[5];
    if (!(fabs(det) > near * size * size))
        return false;
    *along = (a[3] * dx - a[2] * dy) / det;
    double across = (a[0] * dy - a[1] * dx) / det;
    return fabs(across) < off && fabs(*along - run->pen) < far;
}

void pdf_run_letter(struct pdf_making *m, int letter, const double em[6], bool hidden)
{
    const struct pdf_letter *l = &m->p->letters[letter];
    struct pdf_run *run = &m->run;
    bool pictures = m->p->fonts[l->font].pictures;
    double along = 0;
    bool follows = run->open && run->within && run->font == l->font && run->hidden == hidden &&
                   row_place(run, em, &along);
    if (!follows) {
        if (!run->open)
            fputs("BT\n", m->f);
        else
            row_end(m);
        if (!run->open || run->font != l->font)
            fprintf(m->f, "/F%d 1 Tf ", l->font);
        if (run->open ? run->hidden != hidden : hidden)
            fprintf(m->f, "%d Tr ", hidden ? 3 : 0);
        fprintf(m->f, "%.7g %.7g %.7g %.7g %.7g %.7g Tm [<", pdf_plain(em[0]), pdf_plain(em[1]),
                pdf_plain(em[2]), pdf_plain(em[3]), pdf_plain(em[4]), pdf_plain(em[5]));
        *run =
            (struct pdf_run){.open = true, .within = true, .hidden = hidden, .font = l->font};
        memcpy(run->m, em, sizeof run->m);
    } else {
        double back = round(10000 * (run->pen - along)) / 10; /* tenths of a thousandth */
        if (back != 0) {
            fprintf(m->f, ">%.6g<", back);
            run->pen -= back / 1000;
        }
    }
    fprintf(m->f, pictures ? "%02x" : "%04x", (unsigned)l->code);
    run->pen += l->width;
}
