/* lines.c - a paragraph broken into lines: see page_internal.h.
 *
 * In passes, as TeX does it: without dividing words; with them divided; with ever more
 * looseness; and with any, where a line that nothing fits is too long. At most three lines in a
 * row end in hyphens, but for the last pass; a last line that is short costs, and one that is
 * the rest of a word is no line at all if there is another way. Paragraphs with tabs are filled
 * line by line, since what a tab takes depends on what stands before it. */
#include "page_internal.h"

#include <linebreak.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HYPHEN_PENALTY = 50, LETTER_PENALTY = 3000, SOFT_HYPHEN = 0xad };

static const double first_tolerance = 100, ragged_ems = 2;
static const double runt_ems = 2.5; /* a last line that is shorter looks lost */

/* The passes: what stretch each line has besides its spaces', in ems. It makes a line less bad,
 * and a hyphen costs what it did: with much of it at once words would hardly be divided, and
 * lines be loose. So there is as little of it as there can be. */
static const double loose_ems[] = {0, 0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 3};
enum { PASSES = sizeof loose_ems / sizeof *loose_ems, LADDER_MAX = 3 };

struct filling {
    struct page_text *t;
    struct paragraph *p;
    struct break_place *places;
    int *letters; /* behind which each place is: the number of the letter after it */
    bool *hyphens;
    int count, capacity_places, capacity_letters, capacity_hyphens;
    double least;    /* the narrowest line */
    int kept, begin; /* lines that stay, and the letter behind them */
    bool ragged;
    bool hyphens_too; /* words may be divided by their patterns */
};

static void filling_finish(struct filling *f)
{
    free(f->places);
    free(f->letters);
    free(f->hyphens);
}

static bool is_white(const struct paragraph *p, int i)
{
    return font_text_white(p->characters[i]) && p->characters[i] != '\t';
}

static bool place_add(struct filling *f, struct break_place place, int letter, bool hyphen)
{
    int n = f->count + 1;
    if (!array_reserve(&f->places, &f->capacity_places, n, sizeof *f->places) ||
        !array_reserve(&f->letters, &f->capacity_letters, n, sizeof *f->letters) ||
        !array_reserve(&f->hyphens, &f->capacity_hyphens, n, sizeof *f->hyphens))
        return false;
    f->places[f->count] = place;
    f->letters[f->count] = letter;
    f->hyphens[f->count++] = hyphen;
    return true;
}

static void sum_add(const struct filling *f, struct break_sum *sum, const struct letter *l)
{
    double expand = f->p->manner.expand * (double)l->advance_px;
    sum->px += (double)l->advance_px;
    if (f->ragged)
        return;
    sum->stretch += (double)l->stretch_px + expand;
    sum->shrink += (double)l->shrink_px + expand;
}

/* Letter i's cluster may stand so far in the margin. */
static double hang(const struct filling *f, int i, bool at_end)
{
    const struct paragraph *p = f->p;
    while (i > 0 && !p->letters[i].cluster)
        i--;
    return p->manner.protrude * signs_protrusion(p->characters[i], at_end) *
           (double)p->letters[i].advance_px;
}

/* What a line may end with behind letter i: 0 nothing, else 1 plus the penalty; *hyphen: one is
 * seen there that is not in the text. */
static int end_penalty(const struct filling *f, int i, bool letters_too, bool *hyphen)
{
    const struct paragraph *p = f->p;
    const struct letter *l = &p->letters[i];
    *hyphen = false;
    if (i + 1 < p->count && !p->letters[i + 1].cluster)
        return 0;
    if (l->brk == LINEBREAK_MUSTBREAK)
        return 1;
    if (l->brk == LINEBREAK_ALLOWBREAK) {
        *hyphen = l->character == SOFT_HYPHEN;
        bool seen = l->character == '-' || l->character == 0x2010 || *hyphen;
        return 1 + (seen ? HYPHEN_PENALTY : 0);
    }
    if (l->hyphen && f->hyphens_too) {
        *hyphen = true;
        return 1 + HYPHEN_PENALTY;
    }
    return letters_too && !is_white(p, i) ? 1 + LETTER_PENALTY : 0;
}

/* Adds the place behind letter i, up to which the sums are. */
static bool end_add(struct filling *f, int i, int penalty, bool hyphen, struct break_sum ink,
                    int ink_end, struct break_sum sum, bool forced)
{
    const struct paragraph *p = f->p;
    struct break_place place = {.end = ink, .next = sum, .penalty = penalty};
    uint32_t glyph;
    place.flagged = hyphen || penalty == HYPHEN_PENALTY;
    if (hyphen) {
        double width = signs_hyphen(f->t, &p->letters[i], &glyph);
        place.end.px += width * (1 - p->manner.protrude * signs_protrusion('-', true));
        if (!glyph)
            return true; /* none that could be seen */
    } else if (ink_end > 0 && p->manner.protrude > 0) {
        place.end.px -= hang(f, ink_end - 1, true);
    }
    int next = i + 1;
    for (; !forced && next < p->count && is_white(p, next); next++)
        sum_add(f, &place.next, &p->letters[next]);
    if (next < p->count && p->manner.protrude > 0)
        place.next.px += hang(f, next, false);
    if (forced)
        place.penalty = -BREAK_INFINITE;
    return place_add(f, place, next, hyphen);
}

/* All legal ends, with the sums up to them; anywhere: each letter is one, at a high price. */
static bool places_make(struct filling *f, bool anywhere)
{
    const struct paragraph *p = f->p;
    struct break_sum sum = {0}, ink = {0};
    int ink_end = 0;
    f->count = 0;
    struct break_place start = {.penalty = 0};
    if (f->begin < p->count && p->manner.protrude > 0)
        start.next.px += hang(f, f->begin, false);
    bool ok = place_add(f, start, f->begin, false);
    for (int i = f->begin; ok && i < p->count; i++) {
        const struct letter *l = &p->letters[i];
        bool hyphen, last = i + 1 == p->count;
        sum_add(f, &sum, l);
        if (!is_white(p, i) && !font_text_ends_line(l->character)) {
            ink = sum;
            ink.stretch -= f->ragged ? 0 : (double)l->stretch_px;
            ink_end = i + 1;
        }
        int penalty = end_penalty(f, i, anywhere, &hyphen);
        bool forced =
            last || (l->brk == LINEBREAK_MUSTBREAK && font_text_ends_line(l->character));
        if (forced)
            ok = end_add(f, i, 0, hyphen && last && l->character == SOFT_HYPHEN, ink, ink_end,
                         sum, true);
        else if (penalty && !(i + 1 < p->count && is_white(p, i + 1)))
            ok = end_add(f, i, penalty - 1, hyphen, ink, ink_end, sum, false);
    }
    return ok;
}

/* Whether a piece between two places is wider than the narrowest line. */
static bool too_long(const struct filling *f)
{
    for (int i = 0; i + 1 < f->count; i++)
        if (f->places[i + 1].end.px - f->places[i].next.px > f->least)
            return true;
    return false;
}

static bool line_add(struct paragraph *p, struct line line)
{
    if (!array_reserve(&p->lines, &p->lines_capacity, p->lines_count + 1, sizeof *p->lines))
        return false;
    line.ink_end = line.end;
    while (line.ink_end > line.begin && (is_white(p, line.ink_end - 1) ||
                                         font_text_ends_line(p->characters[line.ink_end - 1])))
        line.ink_end--;
    p->lines[p->lines_count++] = line;
    return true;
}

static bool lines_take(struct filling *f, const int *chosen, int count, const double *widths,
                       int widths_count, const struct break_rules *rules)
{
    struct paragraph *p = f->p;
    int from = 0;
    for (int i = 0; i < count; i++) {
        const struct break_place *a = &f->places[from], *b = &f->places[chosen[i]];
        double width = widths[i < widths_count ? i : widths_count - 1];
        bool forced = b->penalty <= -BREAK_INFINITE;
        struct line line = {.begin = f->letters[from],
                            .end = f->letters[chosen[i]],
                            .width_px = width,
                            .hyphen = f->hyphens[chosen[i]],
                            .last = forced,
                            .ratio = breaks_ratio(a, b, width, rules, forced)};
        p->overfull += line.ratio < -1 - 1e-9;
        if (!line_add(p, line))
            return false;
        from = chosen[i];
    }
    return true;
}

/* ---- paragraphs with tabs ---- */

static bool lines_fill(struct filling *f, const double *widths, int widths_count)
{
    struct paragraph *p = f->p;
    for (int begin = f->begin; begin < p->count;) {
        int line = p->lines_count - f->kept;
        double width = widths[line < widths_count ? line : widths_count - 1];
        double pen = 0;
        int end = p->count, allowed = begin, cluster = begin;
        bool forced = true;
        for (int i = begin; i < p->count; i++) {
            bool hyphen;
            if (p->letters[i].cluster && i > begin)
                cluster = i;
            if (p->characters[i] == '\t')
                pen = signs_tab(f->t, p, i, p->count, pen);
            pen += (double)p->letters[i].advance_px;
            if (pen > width + 1e-6 && !is_white(p, i) && (allowed > begin || cluster > begin)) {
                end = allowed > begin ? allowed : cluster;
                forced = false;
                break;
            }
            if (font_text_ends_line(p->characters[i]) &&
                p->letters[i].brk == LINEBREAK_MUSTBREAK) {
                end = i + 1;
                break;
            }
            if (end_penalty(f, i, false, &hyphen) && !hyphen)
                allowed = i + 1;
        }
        if (!line_add(p, (struct line){
                             .begin = begin, .end = end, .width_px = width, .last = forced}))
            return false;
        begin = end;
    }
    return true;
}

/* ---- */

static bool has_tab(const struct paragraph *p)
{
    return memchr(p->text, '\t', (size_t)p->bytes) != NULL;
}

static struct break_rules pass_rules(const struct filling *f, int pass)
{
    const struct paragraph *p = f->p;
    const double em = f->t->styles[p->style]->look.size_px;
    const bool last = pass + 1 == PASSES;
    return (struct break_rules){.tolerance = pass == 0
                                                 ? fmin(first_tolerance, p->manner.tolerance)
                                             : last ? BREAK_INFINITE
                                                    : p->manner.tolerance,
                                .emergency_px = (f->ragged ? ragged_ems : loose_ems[pass]) * em,
                                .last_fills = true,
                                .ladder_max = last ? 0 : LADDER_MAX,
                                .runt_px = fmax(runt_ems * em, p->manner.indent_px + em),
                                .whole_word = true,
                                .must = last};
}

/* What a pass finds; count 0: nothing. */
struct found {
    int *chosen, count, pass;
    double demerits;
};

static bool pass_try(struct filling *f, int pass, const double *widths, int widths_count,
                     struct found *out)
{
    struct paragraph *p = f->p;
    const bool last = pass + 1 == PASSES;
    const struct break_rules rules = pass_rules(f, pass);
    bool ok = true;
    *out = (struct found){.pass = pass};
    f->hyphens_too = pass > 0;
    if (pass == 1)
        words_hyphenate(f->t, p);
    if (pass == 1 && !p->manner.hyphenate && p->manner.tolerance <= first_tolerance)
        return true;
    if (pass > 1 && !last && (f->ragged || too_long(f)))
        return true; /* looser lines are no help */
    if (pass < 2 || last)
        ok = places_make(f, false);
    if (ok && last && too_long(f)) /* such words may be broken at any letter */
        ok = places_make(f, true);
    out->chosen = calloc((size_t)f->count, sizeof *out->chosen);
    return ok && out->chosen &&
           breaks_find(f->places, f->count, widths, widths_count, &rules, out->chosen,
                       &out->count, &out->demerits);
}

/* Lines of a heading, each about as long: the narrowest column in which there are as many. */
static bool balance(struct filling *f, const double *widths, int widths_count,
                    struct found *found)
{
    enum { HALVINGS = 8 };
    const struct break_rules rules = pass_rules(f, found->pass);
    double low = 0.2, high = 1, *narrow = calloc((size_t)widths_count, sizeof *narrow);
    int *chosen = calloc((size_t)f->count, sizeof *chosen), count;
    bool ok = narrow && chosen;
    for (int k = 0; ok && k < HALVINGS; k++) {
        double half = (low + high) / 2;
        for (int i = 0; i < widths_count; i++)
            narrow[i] = half * widths[i];
        ok = breaks_find(f->places, f->count, narrow, widths_count, &rules, chosen, &count,
                         NULL);
        if (ok && count == found->count) {
            memcpy(found->chosen, chosen, (size_t)count * sizeof *chosen);
            high = half;
        } else {
            low = half;
        }
    }
    free(narrow);
    free(chosen);
    return ok;
}

/* The first pass that finds a way; where its last line is the rest of a word, the first looser
 * one in which it is not, if there is one. */
static bool passes_run(struct filling *f, const double *widths, int widths_count)
{
    struct found best = {0};
    bool ok = true;
    for (int pass = 0; ok && pass < PASSES && !(best.count && pass + 1 == PASSES); pass++) {
        struct found next;
        ok = pass_try(f, pass, widths, widths_count, &next);
        bool better = ok && next.count && (!best.count || next.demerits < BREAK_REST_DEMERITS);
        if (better) {
            free(best.chosen);
            best = next;
        } else {
            free(next.chosen);
        }
        if (best.count && best.demerits < BREAK_REST_DEMERITS)
            break;
    }
    if (ok && best.count && best.pass == 0 &&
        f->hyphens_too) { /* its places, not those of the passes behind it */
        f->hyphens_too = false;
        ok = places_make(f, false);
    }
    if (ok && best.count > 1 && f->p->manner.balance)
        ok = balance(f, widths, widths_count, &best);
    if (ok && best.count) {
        const struct break_rules rules = pass_rules(f, best.pass);
        ok = lines_take(f, best.chosen, best.count, widths, widths_count, &rules);
    }
    free(best.chosen);
    return ok;
}

static bool widths_same(const struct paragraph *p, const double *widths, int count)
{
    if (!p->broken || !p->widths_count)
        return false;
    for (int i = 0; i < p->widths_count || i < count; i++)
        if (p->widths[i < p->widths_count ? i : p->widths_count - 1] !=
            widths[i < count ? i : count - 1])
            return false;
    return true;
}

/* Breaks what follows the first `kept` lines. */
static enum font_status rest_break(struct page_text *t, struct paragraph *p, int kept,
                                   const double *widths, int count)
{
    struct filling f = {.t = t, .p = p, .least = widths[0], .kept = kept};
    bool ok = true;
    f.begin = kept ? p->lines[kept].begin : 0;
    f.ragged = p->manner.align != FONT_ALIGN_JUSTIFY;
    for (int i = 0; i < count; i++)
        f.least = fmin(f.least, widths[i]);
    t->stats.lines_overfull -= p->overfull;
    p->overfull = 0;
    for (int i = 0; i < kept; i++)
        p->overfull += p->lines[i].ratio < -1 - 1e-9;
    p->lines_count = kept;
    if (!p->count)
        ok = line_add(p, (struct line){.width_px = widths[0], .last = true});
    else if (has_tab(p))
        ok = lines_fill(&f, widths, count);
    else
        ok = passes_run(&f, widths, count);
    t->stats.lines_overfull += p->overfull;
    t->stats.paragraphs_broken++;
    p->breakings++;
    filling_finish(&f);
    p->broken = ok;
    return ok ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
}

enum font_status lines_break(struct page_text *t, struct paragraph *p, const double *widths,
                             int count)
{
    enum font_status status = set_analyse(t, p);
    if (status != FONT_OK || widths_same(p, widths, count))
        return status;
    if (!array_reserve(&p->widths, &p->widths_capacity, count, sizeof *p->widths))
        return font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    memcpy(p->widths, widths, (size_t)count * sizeof *widths);
    p->widths_count = count;
    return rest_break(t, p, 0, widths, count);
}

enum font_status lines_break_rest(struct page_text *t, struct paragraph *p, int kept,
                                  const double *widths, int count)
{
    p->widths_count = 0; /* the whole is no longer as it was broken for them */
    return rest_break(t, p, kept, widths, count);
}
