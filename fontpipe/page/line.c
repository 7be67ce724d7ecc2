/* line.c - a line of a paragraph as glyphs in their places: see page_internal.h.
 *
 * Its runs are put in the order in which they are seen, and each gives its clusters from the
 * left to the right. What the line lacks or has too much is then shared out among spaces and,
 * where letters may be expanded, letters. */
#include "page_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void set_line_finish(struct set_line *l)
{
    free(l->glyphs);
    free(l->clusters);
    free(l->work);
    free(l->runs);
    free(l->order);
    *l = (struct set_line){0};
}

/* The parts of runs that are in the line, in the order in which they are seen: as numbers of
 * runs, and letters. */
static bool pieces_order(const struct paragraph *p, const struct line *line,
                         struct set_line *out, int *count)
{
    *count = 0;
    int first = 0, last = p->runs_count; /* the run that the line begins in, by halves */
    while (last - first > 1) {
        int half = (first + last) / 2;
        if (p->runs[half].begin <= line->begin)
            first = half;
        else
            last = half;
    }
    for (int r = first; r < p->runs_count && p->runs[r].begin < line->ink_end; r++) {
        const struct set_run *run = &p->runs[r];
        int begin = run->begin > line->begin ? run->begin : line->begin;
        int end = run->end < line->ink_end ? run->end : line->ink_end;
        if (begin >= end)
            continue;
        if (!array_reserve(&out->order, &out->order_capacity, *count + 1, sizeof *out->order) ||
            !array_reserve(&out->runs, &out->runs_capacity, *count + 1, sizeof *out->runs))
            return false;
        out->runs[*count] = *run;
        out->runs[*count].begin = begin;
        out->runs[*count].end = end;
        out->runs[*count].glyphs_begin = r;
        out->order[*count] = (struct font_run){*count, *count + 1, run->level};
        ++*count;
    }
    font_runs_order(out->order, *count);
    return true;
}

/* Glyphs of a piece of run r: cut out of all of the run, or shaped by themselves. */
static enum font_status piece_glyphs(struct page_text *t, const struct paragraph *p,
                                     const struct set_run *piece, struct set_line *out)
{
    const struct set_run *run = &p->runs[piece->glyphs_begin];
    bool safe = (piece->begin == run->begin || p->letters[piece->begin].safe) &&
                (piece->end == run->end || p->letters[piece->end].safe);
    out->work_count = 0;
    if (!safe)
        return set_shape(t, p, run, piece->begin, piece->end, &out->work, &out->work_count,
                         &out->work_capacity);
    int begin, end;
    set_glyphs_of(p->glyphs, run->glyphs_begin, run->glyphs_end, piece->begin, piece->end,
                  &begin, &end);
    if (!array_reserve(&out->work, &out->work_capacity, end - begin + 1, sizeof *out->work))
        return font_fail(FONT_NO_MEMORY, "no memory for a line");
    if (end > begin)
        memcpy(out->work, p->glyphs + begin, (size_t)(end - begin) * sizeof *out->work);
    out->work_count = end - begin;
    return FONT_OK;
}

/* The end of the cluster that begins at a letter, in glyphs just set: the next letter of those
 * that begin one, or the piece's end. */
static int cluster_end(const struct set_line *l, int letter, int piece_end)
{
    int end = piece_end;
    for (int i = 0; i < l->work_count; i++)
        if (l->work[i].letter > letter && l->work[i].letter < end)
            end = l->work[i].letter;
    return end;
}

static bool cluster_add(struct set_line *l, struct set_cluster cluster)
{
    if (!array_reserve(&l->clusters, &l->clusters_capacity, l->clusters_count + 1,
                       sizeof *l->clusters))
        return false;
    l->clusters[l->clusters_count++] = cluster;
    return true;
}

static bool glyph_add(struct set_line *l, struct set_glyph glyph)
{
    if (!array_reserve(&l->glyphs, &l->glyphs_capacity, l->glyphs_count + 1, sizeof *l->glyphs))
        return false;
    l->glyphs[l->glyphs_count++] = glyph;
    return true;
}

/* Appends a piece from *pen on, unstretched; the pen moves. */
static bool piece_add(const struct page_text *t, const struct paragraph *p, struct set_line *l,
                      const struct set_run *piece, const struct line *line, double *pen)
{
    if (!l->work_count) { /* a tab, or nothing that is seen */
        double from = *pen;
        if (p->characters[piece->begin] == '\t')
            *pen = signs_tab(t, p, piece->begin, line->end, *pen);
        return cluster_add(l, (struct set_cluster){piece->begin, piece->end, (float)from,
                                                   (float)*pen, piece->level});
    }
    bool sorted = !(piece->level & 1);
    for (int i = 0; i < l->work_count;) {
        int letter = l->work[i].letter, next = i;
        double begin = *pen;
        for (; next < l->work_count && l->work[next].letter == letter; next++) {
            const struct shaped *g = &l->work[next];
            if (!glyph_add(l, (struct set_glyph){.glyph = g->glyph,
                                                 .letter = letter,
                                                 .run = piece->glyphs_begin,
                                                 .u = (float)*pen + g->x_px,
                                                 .v = g->y_px,
                                                 .scale = 1}))
                return false;
            *pen += (double)g->advance_px;
        }
        int end = sorted ? (next < l->work_count ? l->work[next].letter : piece->end)
                         : (i > 0 ? l->work[i - 1].letter : piece->end);
        if (end <= letter) /* glyphs that are not in the text's order: some scripts' vowels */
            end = cluster_end(l, letter, piece->end);
        if (!cluster_add(
                l, (struct set_cluster){letter, end, (float)begin, (float)*pen, piece->level}))
            return false;
        i = next;
    }
    return true;
}

struct shares {
    double stretch, shrink, letters; /* of spaces; of all letters' widths */
    double spaces;                   /* what each of them then gets, of its own */
    double scale;                    /* of letters */
};

static void cluster_spaces(const struct paragraph *p, const struct set_cluster *c,
                           double *stretch, double *shrink)
{
    *stretch = *shrink = 0;
    for (int i = c->begin; i < c->end; i++) {
        *stretch += (double)p->letters[i].stretch_px;
        *shrink += (double)p->letters[i].shrink_px;
    }
}

/* Shares out what a line lacks (or has too much: less than 0). The space behind the line's last
 * letter takes no part. */
static void shares_find(const struct paragraph *p, const struct set_line *l, int last_letter,
                        double lacks, struct shares *s)
{
    *s = (struct shares){.scale = 1};
    for (int i = 0; i < l->clusters_count; i++) {
        const struct set_cluster *c = &l->clusters[i];
        double stretch, shrink;
        cluster_spaces(p, c, &stretch, &shrink);
        s->letters += (double)(c->u1 - c->u0);
        if (last_letter >= c->begin && last_letter < c->end)
            continue;
        s->stretch += stretch;
        s->shrink += shrink;
    }
    double expand = p->manner.expand * s->letters;
    double spaces = lacks > 0 ? s->stretch : s->shrink, all = spaces + expand;
    if (all <= 0)
        return;
    double ratio = lacks / all, letters = fmin(1, fmax(-1, ratio)) * p->manner.expand;
    double rest = lacks - letters * s->letters;
    s->scale = 1 + letters;
    s->spaces = spaces > 0 ? rest / spaces : 0;
    if (lacks < 0) /* a space is never shrunk by more than it can be */
        s->spaces = fmax(-1, s->spaces);
}

static void shares_apply(const struct paragraph *p, struct set_line *l, int last_letter,
                         const struct shares *s)
{
    double pen = 0;
    int g = 0;
    for (int i = 0; i < l->clusters_count; i++) {
        struct set_cluster *c = &l->clusters[i];
        double stretch, shrink, from = (double)c->u0,
                                width = (double)(c->u1 - c->u0) * s->scale;
        cluster_spaces(p, c, &stretch, &shrink);
        bool last = last_letter >= c->begin && last_letter < c->end;
        double more = last ? 0 : s->spaces * (s->spaces > 0 ? stretch : shrink);
        double before = c->level & 1 ? more : 0;
        for (; g < l->glyphs_count && l->glyphs[g].letter == c->begin; g++) {
            l->glyphs[g].u = (float)(pen + before + ((double)l->glyphs[g].u - from) * s->scale);
            l->glyphs[g].scale = (float)s->scale;
        }
        c->u0 = (float)pen;
        pen += width + more;
        c->u1 = (float)pen;
    }
}

static void line_shift(struct set_line *l, double by)
{
    for (int i = 0; i < l->glyphs_count; i++)
        l->glyphs[i].u += (float)by;
    for (int i = 0; i < l->clusters_count; i++) {
        l->clusters[i].u0 += (float)by;
        l->clusters[i].u1 += (float)by;
    }
    l->u0 += by;
    l->u1 += by;
}

/* The hyphen behind the last letter, where that is not in the text. */
static bool hyphen_add(const struct page_text *t, const struct paragraph *p,
                       const struct line *line, struct set_line *l, double pen)
{
    const struct letter *letter = &p->letters[line->ink_end - 1];
    uint32_t glyph;
    signs_hyphen(t, letter, &glyph);
    int run = 0;
    while (p->runs[run].end <= line->ink_end - 1)
        run++;
    return !glyph ||
           glyph_add(l, (struct set_glyph){.glyph = glyph,
                                           .letter = -1,
                                           .run = run,
                                           .u = (float)pen,
                                           .v = (float)t->styles[letter->style]->look.raise_px,
                                           .scale = 1});
}

/* Moves the line to its side, its ends' signs into the margins. */
static void line_align(const struct paragraph *p, const struct line *line, double width_px,
                       double hyphen_px, struct set_line *l)
{
    const struct page_manner *m = &p->manner;
    bool whole = m->align == FONT_ALIGN_JUSTIFY && !line->last;
    double ink = l->u1 + hyphen_px, begin_hang = 0, end_hang = 0;
    if (line->ink_end > line->begin && m->protrude > 0) {
        const struct letter *a = &p->letters[line->begin], *b = &p->letters[line->ink_end - 1];
        begin_hang =
            m->protrude * signs_protrusion(a->character, false) * (double)a->advance_px;
        end_hang = hyphen_px > 0 ? m->protrude * signs_protrusion('-', true) * hyphen_px
                                 : m->protrude * signs_protrusion(b->character, true) *
                                       (double)b->advance_px;
    }
    double left_hang = p->base ? end_hang : begin_hang,
           right_hang = p->base ? begin_hang : end_hang;
    double target = width_px + left_hang + right_hang, lacks = target - ink;
    bool tabs = memchr(p->text, '\t', (size_t)p->bytes) != NULL;
    int last_letter = line->ink_end - 1;
    if (!tabs && ((whole && line->ink_end > line->begin) ||
                  (lacks < 0 && m->align == FONT_ALIGN_JUSTIFY))) {
        struct shares s;
        shares_find(p, l, last_letter, lacks, &s);
        shares_apply(p, l, last_letter, &s);
        l->u1 = l->clusters_count ? (double)l->clusters[l->clusters_count - 1].u1 : 0;
        ink = l->u1 + hyphen_px;
    }
    double part = m->align == FONT_ALIGN_LEFT     ? 0
                  : m->align == FONT_ALIGN_RIGHT  ? 1
                  : m->align == FONT_ALIGN_CENTER ? 0.5
                                                  : p->base;
    line_shift(l, part * (target - ink) - left_hang);
}

enum font_status line_set(struct page_text *t, const struct paragraph *p,
                          const struct line *line, double width_px, struct set_line *out)
{
    int pieces;
    double pen = 0, hyphen_px = 0;
    out->glyphs_count = out->clusters_count = 0;
    out->u0 = out->u1 = 0;
    if (!pieces_order(p, line, out, &pieces))
        return font_fail(FONT_NO_MEMORY, "no memory for a line");
    for (int i = 0; i < pieces; i++) {
        const struct set_run piece = out->runs[out->order[i].begin];
        enum font_status status = piece_glyphs(t, p, &piece, out);
        if (status != FONT_OK)
            return status;
        if (!piece_add(t, p, out, &piece, line, &pen))
            return font_fail(FONT_NO_MEMORY, "no memory for a line");
    }
    out->u1 = pen;
    if (line->hyphen && line->ink_end > line->begin) {
        uint32_t glyph;
        hyphen_px = signs_hyphen(t, &p->letters[line->ink_end - 1], &glyph);
    }
    line_align(p, line, width_px, hyphen_px, out);
    if (hyphen_px > 0 && !hyphen_add(t, p, line, out, out->u1))
        return font_fail(FONT_NO_MEMORY, "no memory for a line");
    return FONT_OK;
}
