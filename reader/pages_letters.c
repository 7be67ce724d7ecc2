/* pages_letters.c - how letters of a paragraph are shown: in their styles, as formulas, as
 * pictures. See pages_internal.h. */
#include "pages_internal.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Before the first formula. Without a font that anybody asked for formulas stand as they are
 * written. */
static enum reader_status math_open(struct reader_pages *p)
{
    const char *name = p->setup.math ? p->setup.math : font_face_first(font_math_fonts);
    if (p->math || p->math_missing)
        return READER_OK;
    if (font_face_open(name, 0, &p->math_face) == FONT_OK &&
        font_math_create(p->math_face, &p->math) == FONT_OK) {
        p->math_scale = pages_x_height(p->faces[0]) / pages_x_height(p->math_face);
        return READER_OK;
    }
    p->math_missing = true;
    return p->setup.math ? pages_failed() : READER_OK;
}

/* A formula's layout; one that is too large is none, and *set is false. Owns: the caller
 * finishes *out. */
static enum reader_status formula_layout(struct reader_pages *p, const struct paragraph_text *t,
                                         const struct line_span *s, enum context context,
                                         bool display, double most_px, bool *set,
                                         struct font_layout *out)
{
    const char *tex = t->text + s->begin;
    int bytes = s->end - s->begin, unknown;
    enum reader_status opened = math_open(p);
    *set = false;
    if (opened != READER_OK || !p->math)
        return opened;
    struct font_math_options options = {.size_px = pages_size(p, context) * p->math_scale,
                                        .display = display};
    if (bytes >= 2 && tex[0] == '$' && tex[bytes - 1] == '$') {
        tex++;
        bytes -= 2;
    }
    enum font_status status = font_math_layout(p->math, tex, (size_t)bytes, &options, out);
    if (status == FONT_OK && display && out->width_px > most_px) {
        options.size_px *= fmax(0.3, most_px / out->width_px);
        font_layout_finish(out);
        status = font_math_layout(p->math, tex, (size_t)bytes, &options, out);
    }
    *set = status == FONT_OK;
    if (status != FONT_OK)
        return status == FONT_TOO_LARGE ? READER_OK : pages_failed();
    const char *first = font_math_unknown(p->math, &unknown);
    if (unknown && !p->unknown_count)
        snprintf(p->unknown, sizeof p->unknown, "%s", first);
    p->unknown_count += unknown;
    return READER_OK;
}

static enum reader_status formula_style(struct reader_pages *p, const struct paragraph_text *t,
                                        const struct line_span *s, enum context context,
                                        bool display, double most_px, int *style)
{
    struct font_layout shown = {0};
    struct page_style look = page_style_default();
    bool set;
    enum reader_status status =
        formula_layout(p, t, s, context, display, most_px, &set, &shown);
    if (status != READER_OK)
        return status;
    if (!set)
        return pages_style(p, context, READER_CODE, style);
    look.font = p->fonts[0];
    look.size_px = pages_size(p, context);
    enum font_status made = page_inset_add(p->text, &look, &shown, style);
    p->insets++;
    font_layout_finish(&shown);
    return made == FONT_OK ? READER_OK : pages_failed();
}

enum reader_status pages_image(struct reader_pages *p, const struct line_span *s,
                               enum context context, double most_px,
                               const struct pictured **out)
{
    const double note_em = 10; /* a note's are low, so that it has room under the text */
    *out = NULL;
    if (!s->image)
        return READER_OK;
    struct reader_asked asked = s->asked;
    const short low = (short)fmin(SHRT_MAX, note_em * p->setup.size_px);
    if (context == CONTEXT_NOTE && (!asked.height_px || asked.height_px > low))
        asked.height_px = low;
    return pages_pictured(p, s->source, s->image, asked, fmax(1, most_px), out);
}

enum reader_status pages_width(struct reader_pages *p, const struct paragraph_text *t,
                               enum context context, double *width)
{
    enum reader_status status = READER_OK;
    *width = 0;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++) {
        const struct line_span *s = &t->spans[i];
        const int face = (int)pages_face_of(s->look);
        struct font_layout l = {0};
        const struct pictured *image;
        bool set = true;
        status = pages_image(p, s, context, pages_column(p), &image);
        if (image) {
            *width += image->width;
            continue;
        }
        if (status != READER_OK)
            break;
        if (s->look & READER_FORMULA)
            status = formula_layout(p, t, s, context, false, 0, &set, &l);
        else
            status = pages_face(p, face);
        if (status == READER_OK && !(s->look & READER_FORMULA) &&
            font_shaper_layout(p->shapers[face], t->text + s->begin,
                               (size_t)(s->end - s->begin), pages_size_of(p, context, s->look),
                               NULL, &l) != FONT_OK)
            status = pages_failed();
        if (status == READER_OK)
            *width += l.width_px;
        font_layout_finish(&l);
    }
    return status;
}

enum reader_status pages_styles_apply(struct reader_pages *p, int id,
                                      const struct paragraph_text *t, enum context context,
                                      bool display, double most_px)
{
    enum reader_status status = READER_OK;
    int style;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++) {
        const struct line_span *s = &t->spans[i];
        const struct pictured *image;
        status = pages_image(p, s, context, most_px, &image);
        if (status != READER_OK)
            break;
        if (image) {
            style = image->style;
            p->insets++;
        } else
            status = s->look & READER_FORMULA
                         ? formula_style(p, t, s, context, display, most_px, &style)
                         : pages_style(p, context, s->look, &style);
        if (status == READER_OK &&
            page_paragraph_style(p->text, id, s->begin, s->end, style) != FONT_OK)
            status = pages_failed();
    }
    return status;
}
