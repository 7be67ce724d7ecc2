/* pdf_text.c - what glyphs say, in PDF's words: see pdf_internal.h. */
#include "pdf_internal.h"
#include "text_internal.h"

#include <fribidi.h>
#include <hb-ot.h>

enum { LETTERS_MOST = 256 };

void pdf_utf16_put(const char *text, size_t begin, size_t end, FILE *f)
{
    const char *at = text + begin, *last = text + end;
    while (at < last) {
        uint32_t c;
        font_utf8_next(&at, last, &c);
        if (c > 0xffff)
            fprintf(f, "%04X%04X", (unsigned)(0xd800 + ((c - 0x10000) >> 10)),
                    (unsigned)(0xdc00 + ((c - 0x10000) & 0x3ff)));
        else
            fprintf(f, "%04X", (unsigned)c);
    }
}

/* A hyphen of the text itself where a line ends. Programs take such a hyphen for one that was
 * put in, and leave it out. */
static bool is_hard_hyphen(const struct font_drawing *d, const struct drawn_text *t)
{
    return t->line_ends && t->end > t->begin && d->text[t->end - 1] == '-';
}

/* How many letters it has; whether any goes to the left. One of more than LETTERS_MOST, such as
 * a letter under thousands of accents, is told as a whole: as though none did. */
static int letters_see(const struct font_drawing *d, const struct drawn_text *t, bool *left)
{
    const char *at = d->text + t->begin, *end = d->text + t->end;
    int count = 0;
    *left = false;
    if (t->end - t->begin > 4 * LETTERS_MOST)
        return 0;
    for (; at < end; count++) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        *left = *left || FRIBIDI_IS_RTL(fribidi_get_bidi_type(c));
    }
    return count;
}

bool pdf_is_leftward(const struct font_drawing *d, const struct drawn_text *t)
{
    bool left;
    letters_see(d, t, &left);
    return left;
}

int pdf_leftward(const struct font_drawing *d, const struct drawn_text *t)
{
    bool left;
    int count = letters_see(d, t, &left);
    return left && count > 1 ? count : 0;
}

/* A glyph that stands on another and takes no place of its own. */
static bool is_mark(const struct font_placed *g)
{
    double advance = 0;
    hb_face_t *face = font_face_harfbuzz(g->face);
    if (hb_ot_layout_has_glyph_classes(face))
        return hb_ot_layout_get_glyph_class(face, g->glyph) == HB_OT_LAYOUT_GLYPH_CLASS_MARK;
    (void)font_face_advance(g->face, g->glyph, &advance);
    return advance <= 0;
}

bool pdf_is_unseen(const struct font_drawing *d, const struct drawn_text *t,
                   const struct font_placed *g)
{
    const char *at = d->text + t->begin, *end = d->text + t->end;
    /* No letter of ASCII is; glyph 0 is that of a sign that is missing. */
    bool unseen = d->text && at < end && (unsigned char)*at >= 0x80 && g->glyph != 0;
    while (unseen && at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        unseen = font_text_invisible(c);
    }
    return unseen;
}

/* The joiner of glyph i goes with the cluster before it in the text, that of glyph i + 1. */
static void joiner_give(const struct font_drawing *d, const struct font_layout *layout,
                        struct drawn_text *texts, int i)
{
    const struct font_placed *g = layout->glyphs;
    struct drawn_text *t = &texts[i], *before = t + 1;
    if (!t->begins || !t->ends || i + 1 >= layout->glyphs_count || g[i + 1].line != g[i].line ||
        before->end != t->begin || !pdf_is_leftward(d, before) || !pdf_is_unseen(d, t, &g[i]))
        return;
    for (int k = 0; k < before->of && i + 1 + k < layout->glyphs_count; k++)
        before[k].end = t->end;
    t->begin = before->begin;
    t->at = pdf_leftward(d, before);
}

void pdf_marks_tell_nothing(const struct font_drawing *d, const struct font_layout *layout,
                            struct drawn *drawn)
{
    for (int i = 0, n = 1; d->text && i < layout->glyphs_count; i += n) {
        struct drawn_text *t = &drawn->texts[i];
        int letters = 0, bases = 0, last = -1;
        n = t->of > 0 ? t->of : 1;
        joiner_give(d, layout, drawn->texts, i);
        if (n > 1)
            letters = pdf_leftward(d, t);
        for (int k = 0; letters && k < n; k++)
            bases += !is_mark(&layout->glyphs[i + k]);
        if (!bases || bases == n)
            continue;
        for (int k = 0; k < n; k++) {
            bool mark = is_mark(&layout->glyphs[i + k]);
            last += !mark;
            t[k].at = mark ? letters : last;
            t[k].of = bases;
        }
    }
}

static size_t letter_before(const struct font_drawing *d, size_t end)
{
    do
        end--;
    while (((unsigned char)d->text[end] & 0xc0) == 0x80);
    return end;
}

void pdf_share(const struct font_drawing *d, const struct drawn_text *t, size_t *end,
               int *letters)
{
    int count = pdf_leftward(d, t);
    *end = t->end;
    for (int k = 0; k < t->at && k < count; k++)
        *end = letter_before(d, *end);
    *letters = t->at >= count ? 0 : t->at + 1 == t->of ? count - t->at : 1;
}

/* Whether the glyphs of a cluster are told as a whole what they say: where there are several of
 * them, in whatever order; where they are a sign that is not in the text (a hyphen); and where
 * a line ends in a hyphen that is. */
static bool is_said(const struct font_drawing *d, const struct drawn_text *t)
{
    return d->text && (!t->begins || !t->ends || t->begin == t->end || is_hard_hyphen(d, t));
}

/* The others of a cluster's glyphs that go to the left have all of its text. */
static bool is_over(const struct font_drawing *d, const struct drawn_text *t, int leftward)
{
    return d->text && leftward && t->at >= leftward;
}

bool pdf_said_begins(const struct font_drawing *d, const struct drawn_text *t)
{
    int leftward = d->text ? pdf_leftward(d, t) : 0;
    return leftward ? is_over(d, t, leftward) : is_said(d, t) && t->begins;
}

bool pdf_said_ends(const struct font_drawing *d, const struct drawn_text *t)
{
    int leftward = d->text ? pdf_leftward(d, t) : 0;
    return leftward ? is_over(d, t, leftward) : is_said(d, t) && t->ends;
}

void pdf_said_begin(const struct font_drawing *d, const struct drawn_text *t, FILE *f)
{
    fputs("/Span << /ActualText <FEFF", f);
    if (!pdf_leftward(d, t)) {
        if (t->begin == t->end)
            fputs("002D", f);
        pdf_utf16_put(d->text, t->begin, t->end, f);
        if (is_hard_hyphen(d, t))
            fputs("2060", f); /* a word joiner behind it */
    }
    fputs("> >> BDC\n", f);
}
