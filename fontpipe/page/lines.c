/* lines.c - a paragraph broken into lines: see page_internal.h.
 *
 * In passes, as TeX does it: without dividing words; with them divided; with ever more
 * looseness; and with any, where a line that nothing fits is too long. At most three lines in a
 * row end in hyphens, but for the last pass; a last line that is short costs, and one that is
 * the rest of a word is no line at all if there is another way. Paragraphs with tabs are filled
 * line by line, since what a tab takes depends on what stands before it. */
#include "lines_internal.h"

#include <linebreak.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double first_tolerance = 100, ragged_ems = 2;
static const double runt_ems = 2.5; /* a last line that is shorter looks lost */

/* The passes: what stretch each line has besides its spaces', in ems. It makes a line less bad,
 * and a hyphen costs what it did: with much of it at once words would hardly be divided, and
 * lines be loose. So there is as little of it as there can be. */
static const double loose_ems[] = {0, 0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 3};
enum { LADDER_MAX = 3 };
_Static_assert(sizeof loose_ems / sizeof *loose_ems == BREAK_PASSES, "a search for each pass");

static bool line_add(struct paragraph *p, struct line line)
{
    if (!array_reserve(&p->lines, &p->lines_capacity, p->lines_count + 1, sizeof *p->lines))
        return false;
    line.ink_end = line.end;
    while (line.ink_end > line.begin && (line_white(p, line.ink_end - 1) ||
                                         font_text_ends_line(p->characters[line.ink_end - 1])))
        line.ink_end--;
    p->lines[p->lines_count++] = line;
    return true;
}

static bool lines_take(struct filling *f, const struct places *places, const int *chosen,
                       int count, const double *widths, int widths_count,
                       const struct break_rules *rules)
{
    struct paragraph *p = f->p;
    int from = 0;
    for (int i = 0; i < count; i++) {
        const struct break_place *a = &places->items[from], *b = &places->items[chosen[i]];
        double width = widths[i < widths_count ? i : widths_count - 1];
        bool forced = b->penalty <= -BREAK_INFINITE;
        struct line line = {.begin = places->letters[from],
                            .end = places->letters[chosen[i]],
                            .width_px = width,
                            .hyphen = places->hyphens[chosen[i]],
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
            if (pen > width + 1e-6 && !line_white(p, i) &&
                (allowed > begin || cluster > begin)) {
                end = allowed > begin ? allowed : cluster;
                forced = false;
                break;
            }
            if (font_text_ends_line(p->characters[i]) &&
                p->letters[i].brk == LINEBREAK_MUSTBREAK) {
                end = i + 1;
                break;
            }
            if (line_end_penalty(f, i, false, &hyphen) && !hyphen)
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
    const bool last = pass + 1 == BREAK_PASSES;
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
    const struct places *places;
    double demerits;
};

/* The places of a pass. */
static bool pass_places(struct filling *f, int pass, struct places **out)
{
    struct paragraph *p = f->p;
    const bool last = pass + 1 == BREAK_PASSES;
    f->hyphens_too = pass > 0;
    if (pass == 1)
        words_hyphenate(f->t, p);
    *out = &f->ways->places[pass > 0 && p->manner.hyphenate];
    if (!places_ready(f, *out))
        return false;
    if (last && (*out)->too_long) { /* such words may be broken at any letter */
        *out = &f->anywhere;
        return places_make(f, *out, true);
    }
    return true;
}

static bool pass_try(struct filling *f, int pass, const double *widths, int widths_count,
                     struct found *out)
{
    const struct paragraph *p = f->p;
    const bool last = pass + 1 == BREAK_PASSES;
    const struct break_rules rules = pass_rules(f, pass);
    struct places *places;
    *out = (struct found){.pass = pass};
    if (pass == 1 && !p->manner.hyphenate && p->manner.tolerance <= first_tolerance)
        return true;
    if (pass > 1 && !last && f->ragged)
        return true;
    if (!pass_places(f, pass, &places))
        return false;
    if (pass > 1 && !last && places->too_long)
        return true; /* looser lines are no help */
    out->places = places;
    const bool again = places != &f->anywhere;
    struct break_search *search = again ? &f->ways->searches[pass] : NULL;
    f->searched[pass] = again;
    return breaks_find_again(places->items, places->count, widths, widths_count, &rules, search,
                             again && places->again ? &places->change : NULL, &out->chosen,
                             &out->count, &out->demerits);
}

/* Lines of a heading, each about as long: the narrowest column in which there are as many. */
static bool balance(struct filling *f, const double *widths, int widths_count,
                    struct found *found)
{
    enum { HALVINGS = 8 };
    const struct break_rules rules = pass_rules(f, found->pass);
    const struct places *places = found->places;
    double low = 0.2, high = 1, *narrow = calloc((size_t)widths_count, sizeof *narrow);
    bool ok = narrow != NULL;
    for (int k = 0; ok && k < HALVINGS; k++) {
        double half = (low + high) / 2;
        int *chosen, count;
        for (int i = 0; i < widths_count; i++)
            narrow[i] = half * widths[i];
        ok = breaks_find_again(places->items, places->count, narrow, widths_count, &rules, NULL,
                               NULL, &chosen, &count, NULL);
        if (ok && count == found->count) {
            memcpy(found->chosen, chosen, (size_t)count * sizeof *chosen);
            high = half;
        } else {
            low = half;
        }
        free(chosen);
    }
    free(narrow);
    return ok;
}

/* The first pass that finds a way; where its last line is the rest of a word, the first looser
 * one in which it is not, if there is one. */
static bool passes_run(struct filling *f, const double *widths, int widths_count)
{
    struct found best = {0};
    bool ok = true;
    for (int pass = 0; ok && pass < BREAK_PASSES && !(best.count && pass + 1 == BREAK_PASSES);
         pass++) {
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
    if (ok && best.count > 1 && f->p->manner.balance)
        ok = balance(f, widths, widths_count, &best);
    if (ok && best.count) {
        const struct break_rules rules = pass_rules(f, best.pass);
        ok = lines_take(f, best.places, best.chosen, best.count, widths, widths_count, &rules);
    }
    free(best.chosen);
    return ok;
}

/* What was not looked at this time is not right any more. */
static void ways_tidy(struct filling *f)
{
    bool exact = true;
    for (int pass = 0; pass < BREAK_PASSES; pass++)
        if (!f->searched[pass])
            break_search_finish(&f->ways->searches[pass]);
    for (int i = 0; i < 2; i++) {
        struct places *places = &f->ways->places[i];
        exact = exact && (!places->ready || places->exact);
        if (!places->ready)
            places_finish(places);
        places->ready = false;
    }
    f->p->change_known = true;
    f->p->change.begin = -1;
    if (!exact)
        lines_forget(f->p);
}

/* The passes, by what is kept of a long paragraph's breaking if that was for these widths. */
static bool ways_run(struct filling *f, bool same_widths, const double *widths, int count)
{
    struct paragraph *p = f->p;
    struct ways own = {0};
    const bool keeps = !f->kept && p->count >= WAYS_LEAST;
    if (!keeps || !same_widths)
        lines_forget(p);
    if (keeps && !p->ways && !(p->ways = calloc(1, sizeof *p->ways)))
        return false;
    f->ways = keeps ? p->ways : &own;
    const bool ok = passes_run(f, widths, count);
    if (ok && keeps)
        ways_tidy(f);
    else
        lines_forget(p);
    ways_finish(&own);
    places_finish(&f->anywhere);
    return ok;
}

static bool widths_same(const struct paragraph *p, const double *widths, int count)
{
    if (!p->widths_count)
        return false;
    for (int i = 0; i < p->widths_count || i < count; i++)
        if (p->widths[i < p->widths_count ? i : p->widths_count - 1] !=
            widths[i < count ? i : count - 1])
            return false;
    return true;
}

/* Breaks what follows the first `kept` lines. */
static enum font_status rest_break(struct page_text *t, struct paragraph *p, int kept,
                                   const double *widths, int count, bool same_widths)
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
        ok = ways_run(&f, same_widths, widths, count);
    t->stats.lines_overfull += p->overfull;
    t->stats.paragraphs_broken++;
    p->breakings++;
    p->broken = ok;
    return ok ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
}

enum font_status lines_break(struct page_text *t, struct paragraph *p, const double *widths,
                             int count)
{
    enum font_status status = set_analyse(t, p);
    const bool same = widths_same(p, widths, count);
    if (status != FONT_OK || (same && p->broken))
        return status;
    if (!array_reserve(&p->widths, &p->widths_capacity, count, sizeof *p->widths))
        return font_fail(FONT_NO_MEMORY, "no memory for a paragraph");
    memcpy(p->widths, widths, (size_t)count * sizeof *widths);
    p->widths_count = count;
    return rest_break(t, p, 0, widths, count, same);
}

enum font_status lines_break_rest(struct page_text *t, struct paragraph *p, int kept,
                                  const double *widths, int count)
{
    p->widths_count = 0; /* the whole is no longer as it was broken for them */
    return rest_break(t, p, kept, widths, count, false);
}
