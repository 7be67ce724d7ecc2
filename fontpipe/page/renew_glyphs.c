/* renew_glyphs.c - a long paragraph's glyphs after an edit: see renew.c.
 *
 * Letters from..to are shaped anew with some on both sides, so many that glyphs of a few there
 * come out as they were, and that the shaper calls the places between these and what is changed
 * safe to break at:
 *
 *     kept | the same again | changed and near it | the same again | kept
 *        begin            proof                 proof            end */
#include "renew.h"

#include <stdlib.h>
#include <string.h>

enum { MARGIN = 8, MARGIN_MOST = 8 * 8 * 8 * 8, COPIED_MOST = 256 };

/* Glyphs that were, moved, or that are new: what a run's glyphs are made of. */
struct part {
    bool fresh;
    int from, count, letters_by, to;
};

struct reshaping {
    struct renewal *r;
    int begin, proof_begin, proof_end, end; /* letters */
    struct shaped *glyphs;                  /* fresh */
    int glyphs_count, glyphs_capacity;
    struct part *parts;
    int parts_count, parts_capacity;
    int first, last; /* runs that have some of the letters: first..last - 1 */
};

static bool is_safe(const struct paragraph *p, int i)
{
    return p->letters[i].safe && p->letters[i].cluster;
}

/* A place that is safe, so many letters before another. */
static int safe_before(const struct paragraph *p, int i, int margin)
{
    i = i > margin ? i - margin : 0;
    while (i > 0 && !is_safe(p, i))
        i--;
    return i;
}

static int safe_behind(const struct paragraph *p, int i, int margin)
{
    i = p->count - i > margin ? i + margin : p->count;
    while (i < p->count && !is_safe(p, i))
        i++;
    return i;
}

int renew_run_at(const struct set_run *runs, int count, int letter)
{
    int low = 0, high = count;
    while (high - low > 1) {
        int half = low + (high - low) / 2;
        if (runs[half].begin <= letter)
            low = half;
        else
            high = half;
    }
    return low;
}

/* The glyphs that letters begin..end of one run had, by the letters' numbers of then. */
static void glyphs_before(const struct renewal *r, int begin, int end, int *from, int *to)
{
    const struct set_run *run =
        &r->runs_before[renew_run_at(r->runs_before, r->runs_before_count, begin)];
    set_glyphs_of(r->p->glyphs, run->glyphs_begin, run->glyphs_end, begin, end, from, to);
}

static bool part_add(struct reshaping *s, struct part part)
{
    if (!array_reserve(&s->parts, &s->parts_capacity, s->parts_count + 1, sizeof *s->parts))
        return false;
    s->parts[s->parts_count++] = part;
    return true;
}

/* What a run keeps of its glyphs: of letters begin..end, which had other numbers. A few are
 * copied, so that they may come in any order. */
static bool kept_add(struct reshaping *s, int begin, int end, int by)
{
    int from, to;
    if (begin >= end)
        return true;
    glyphs_before(s->r, begin - by, end - by, &from, &to);
    const int n = to - from;
    if (n > COPIED_MOST)
        return part_add(s, (struct part){.from = from, .count = n, .letters_by = by});
    if (!array_reserve(&s->glyphs, &s->glyphs_capacity, s->glyphs_count + n, sizeof *s->glyphs))
        return false;
    for (int i = 0; i < n; i++) {
        struct shaped *g = &s->glyphs[s->glyphs_count + i];
        *g = s->r->p->glyphs[from + i];
        g->letter += by;
    }
    s->glyphs_count += n;
    return part_add(s, (struct part){true, s->glyphs_count - n, n, 0, 0});
}

/* Whether letters begin..end of those just shaped have the glyphs that they had. */
static bool same_again(const struct reshaping *s, const struct part *fresh, int begin, int end,
                       int by)
{
    int from, to, now, now_end;
    if (begin >= end)
        return true;
    glyphs_before(s->r, begin - by, end - by, &from, &to);
    set_glyphs_of(s->glyphs, fresh->from, fresh->from + fresh->count, begin, end, &now,
                  &now_end);
    bool same = to - from == now_end - now;
    for (; same && from < to; from++, now++) {
        const struct shaped *a = &s->r->p->glyphs[from], *b = &s->glyphs[now];
        same = a->glyph == b->glyph && a->letter + by == b->letter &&
               a->advance_px == b->advance_px && a->x_px == b->x_px && a->y_px == b->y_px;
    }
    return same;
}

/* A run's letters that are shaped anew, as parts of its glyphs. False in *same: what should
 * have come out as it was has not. */
static bool run_reshape(struct reshaping *s, const struct set_run *run, bool *same)
{
    struct renewal *r = s->r;
    struct paragraph *p = r->p;
    const int by = r->end - r->end_before;
    const int begin = run->begin > s->begin ? run->begin : s->begin;
    const int end = run->end < s->end ? run->end : s->end;
    const bool falls = run->level & 1;
    struct set_run piece = *run;
    piece.begin = begin;
    piece.end = end;
    for (int i = begin; i < end; i++) {
        p->letters[i].cluster = p->letters[i].safe = false;
        p->letters[i].advance_px = 0;
    }
    if (!(falls ? kept_add(s, end, run->end, by) : kept_add(s, run->begin, begin, 0)))
        return false;
    const int from = s->glyphs_count;
    if (set_shape(r->t, p, &piece, begin, end, &s->glyphs, &s->glyphs_count,
                  &s->glyphs_capacity) != FONT_OK)
        return false;
    const struct part fresh = {true, from, s->glyphs_count - from, 0, 0};
    p->letters[begin].cluster = p->letters[begin].safe = true;
    set_clusters(p, s->glyphs + from, fresh.count);
    *same = same_again(s, &fresh, begin, end < s->proof_begin ? end : s->proof_begin, 0) &&
            same_again(s, &fresh, begin > s->proof_end ? begin : s->proof_end, end, by);
    return part_add(s, fresh) &&
           (falls ? kept_add(s, run->begin, begin, 0) : kept_add(s, end, run->end, by));
}

/* Parts that were before others are still. */
static bool in_order(const struct reshaping *s)
{
    int behind = 0;
    for (int i = 0; i < s->parts_count; i++) {
        const struct part *part = &s->parts[i];
        if (part->fresh || !part->count)
            continue;
        if (part->from < behind)
            return false;
        behind = part->from + part->count;
    }
    return true;
}

static void part_move(struct shaped *glyphs, const struct part *part)
{
    if (part->from != part->to)
        memmove(glyphs + part->to, glyphs + part->from, (size_t)part->count * sizeof *glyphs);
    for (int i = part->to; part->letters_by && i < part->to + part->count; i++)
        glyphs[i].letter += part->letters_by;
}

/* Puts all parts where they are now. */
static bool parts_put(struct reshaping *s, int count)
{
    struct paragraph *p = s->r->p;
    if (!array_reserve(&p->glyphs, &p->glyphs_capacity, count, sizeof *p->glyphs))
        return false;
    for (int i = 0; i < s->parts_count; i++)
        if (!s->parts[i].fresh && s->parts[i].to <= s->parts[i].from)
            part_move(p->glyphs, &s->parts[i]);
    for (int i = s->parts_count - 1; i >= 0; i--)
        if (!s->parts[i].fresh && s->parts[i].to > s->parts[i].from)
            part_move(p->glyphs, &s->parts[i]);
    for (int i = 0; i < s->parts_count; i++)
        if (s->parts[i].fresh && s->parts[i].count)
            memcpy(p->glyphs + s->parts[i].to, s->glyphs + s->parts[i].from,
                   (size_t)s->parts[i].count * sizeof *p->glyphs);
    p->glyphs_count = count;
    return true;
}

/* Runs that keep all of their glyphs, before and behind; and the parts between them. */
static bool glyphs_put(struct reshaping *s, const int *parts_of)
{
    struct paragraph *p = s->r->p;
    const struct renewal *r = s->r;
    const int behind = p->runs_count - s->last;
    const int behind_before = r->runs_before_count - behind;
    const int first = s->first ? p->runs[s->first - 1].glyphs_end : 0;
    int at = first;
    for (int i = 0; i < s->parts_count; i++) {
        s->parts[i].to = at;
        at += s->parts[i].count;
    }
    for (int k = s->first, i = 0; k < s->last; k++) {
        p->runs[k].glyphs_begin = k > s->first ? p->runs[k - 1].glyphs_end : first;
        p->runs[k].glyphs_end = p->runs[k].glyphs_begin;
        for (; i < parts_of[k - s->first]; i++)
            p->runs[k].glyphs_end += s->parts[i].count;
    }
    if (behind) {
        const int from = r->runs_before[behind_before].glyphs_begin;
        const int by = at - from, n = p->glyphs_count - from;
        if (!part_add(s, (struct part){.from = from,
                                       .count = n,
                                       .letters_by = r->end - r->end_before,
                                       .to = at}))
            return false;
        at += n;
        for (int k = 0; k < behind; k++) {
            const struct set_run *before = &r->runs_before[behind_before + k];
            p->runs[s->last + k].glyphs_begin = before->glyphs_begin + by;
            p->runs[s->last + k].glyphs_end = before->glyphs_end + by;
        }
    }
    return in_order(s) && parts_put(s, at);
}

/* Tries with so many letters on each side. *same: that was enough. */
static bool reshape(struct reshaping *s, int margin, bool *same)
{
    struct renewal *r = s->r;
    struct paragraph *p = r->p;
    s->glyphs_count = s->parts_count = 0;
    s->proof_begin = safe_before(p, r->from, margin);
    s->begin = safe_before(p, s->proof_begin, margin);
    s->proof_end = safe_behind(p, r->to, margin);
    s->end = safe_behind(p, s->proof_end, margin);
    s->first = renew_run_at(p->runs, p->runs_count, s->begin);
    s->last = renew_run_at(p->runs, p->runs_count, s->end - 1) + 1;
    int *parts_of = calloc((size_t)(s->last - s->first), sizeof *parts_of);
    bool good = parts_of != NULL;
    *same = true;
    for (int k = s->first; good && *same && k < s->last; k++) {
        good = font_patience_ask(k) == FONT_OK && run_reshape(s, &p->runs[k], same);
        parts_of[k - s->first] = s->parts_count;
    }
    *same = *same && (s->proof_begin == 0 || is_safe(p, s->proof_begin)) &&
            (s->proof_end == p->count || is_safe(p, s->proof_end));
    if (good && *same)
        good = glyphs_put(s, parts_of);
    free(parts_of);
    return good;
}

bool renew_glyphs(struct renewal *r)
{
    struct reshaping s = {.r = r};
    bool good = true, same = false;
    for (int margin = MARGIN; good && !same && margin <= MARGIN_MOST; margin *= 8) {
        good = reshape(&s, margin, &same);
        r->from = s.begin; /* what was shaped already is no proof any more */
        r->to = s.end;
    }
    good = good && same;
    if (good) {
        set_spaces(r->t, r->p, s.begin, s.end);
        words_hyphenate_again(r->t, r->p, &s.begin, &s.end);
        lines_changed(r->p, s.begin, s.end - r->end + r->end_before, s.end);
    }
    free(s.glyphs);
    free(s.parts);
    return good;
}
