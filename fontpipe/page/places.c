/* places.c - where a paragraph's lines may end: see lines_internal.h.
 *
 * Each place has the sums of all before it, of which the search uses differences. They are
 * whole parts of a pixel (breaks_exact()), so that none is rounded: then a place behind an edit
 * is moved by what the text there is longer, and is what it would be if it were found anew. */
#include "lines_internal.h"

#include <linebreak.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HYPHEN_PENALTY = 50, LETTER_PENALTY = 3000, SOFT_HYPHEN = 0xad };
static const double exact_most = 1 << 26;

void places_finish(struct places *places)
{
    free(places->items);
    free(places->letters);
    free(places->hyphens);
    *places = (struct places){0};
}

bool line_white(const struct paragraph *p, int i)
{
    return font_text_white(p->characters[i]) && p->characters[i] != '\t';
}

static bool places_reserve(struct places *to, int count)
{
    return array_reserve(&to->items, &to->capacity_items, count, sizeof *to->items) &&
           array_reserve(&to->letters, &to->capacity_letters, count, sizeof *to->letters) &&
           array_reserve(&to->hyphens, &to->capacity_hyphens, count, sizeof *to->hyphens);
}

static bool place_add(struct places *to, struct break_place place, int letter, bool hyphen)
{
    if (!places_reserve(to, to->count + 1))
        return false;
    to->exact = to->exact && fabs(place.next.px) < exact_most &&
                fabs(place.next.stretch) < exact_most && fabs(place.next.shrink) < exact_most;
    to->items[to->count] = place;
    to->letters[to->count] = letter;
    to->hyphens[to->count++] = hyphen;
    return true;
}

/* Adds a letter, or (by -1) takes it out. */
static void sum_add(const struct filling *f, struct break_sum *sum, const struct letter *l,
                    double by)
{
    double expand = f->p->manner.expand * (double)l->advance_px;
    sum->px += by * breaks_exact((double)l->advance_px);
    if (f->ragged)
        return;
    sum->stretch += by * breaks_exact((double)l->stretch_px + expand);
    sum->shrink += by * breaks_exact((double)l->shrink_px + expand);
}

/* Letter i's cluster may stand so far in the margin. */
static double hang(const struct filling *f, int i, bool at_end)
{
    const struct paragraph *p = f->p;
    while (i > 0 && !p->letters[i].cluster)
        i--;
    return breaks_exact(p->manner.protrude * signs_protrusion(p->characters[i], at_end) *
                        (double)p->letters[i].advance_px);
}

int line_end_penalty(const struct filling *f, int i, bool letters_too, bool *hyphen)
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
    return letters_too && !line_white(p, i) ? 1 + LETTER_PENALTY : 0;
}

/* Where a place would be: the sums up to it, and up to its ink. */
struct pen {
    struct break_sum sum, ink;
    int ink_end;
};

/* Adds the place behind letter i. */
static bool end_add(struct filling *f, struct places *to, int i, int penalty, bool hyphen,
                    const struct pen *pen, bool forced)
{
    const struct paragraph *p = f->p;
    struct break_place place = {.end = pen->ink, .next = pen->sum, .penalty = penalty};
    uint32_t glyph;
    place.flagged = hyphen || penalty == HYPHEN_PENALTY;
    if (hyphen) {
        double width = signs_hyphen(f->t, &p->letters[i], &glyph);
        place.end.px +=
            breaks_exact(width * (1 - p->manner.protrude * signs_protrusion('-', true)));
        if (!glyph)
            return true; /* none that could be seen */
    } else if (pen->ink_end > 0 && p->manner.protrude > 0) {
        place.end.px -= hang(f, pen->ink_end - 1, true);
    }
    int next = i + 1;
    for (; !forced && next < p->count && line_white(p, next); next++)
        sum_add(f, &place.next, &p->letters[next], 1);
    if (next < p->count && p->manner.protrude > 0)
        place.next.px += hang(f, next, false);
    if (forced)
        place.penalty = -BREAK_INFINITE;
    return place_add(to, place, next, hyphen);
}

/* Adds all places behind letters begin..end. */
static bool ends_add(struct filling *f, struct places *to, int begin, int end, struct pen *pen,
                     bool anywhere)
{
    const struct paragraph *p = f->p;
    bool ok = true;
    for (int i = begin; ok && i < end; i++) {
        const struct letter *l = &p->letters[i];
        bool hyphen, last = i + 1 == p->count;
        sum_add(f, &pen->sum, l, 1);
        if (!line_white(p, i) && !font_text_ends_line(l->character)) {
            pen->ink = pen->sum;
            pen->ink.stretch -= f->ragged ? 0 : breaks_exact((double)l->stretch_px);
            pen->ink_end = i + 1;
        }
        int penalty = line_end_penalty(f, i, anywhere, &hyphen);
        bool forced =
            last || (l->brk == LINEBREAK_MUSTBREAK && font_text_ends_line(l->character));
        if (forced)
            ok = end_add(f, to, i, 0, hyphen && last && l->character == SOFT_HYPHEN, pen, true);
        else if (penalty && !(i + 1 < p->count && line_white(p, i + 1)))
            ok = end_add(f, to, i, penalty - 1, hyphen, pen, false);
    }
    return ok;
}

/* How many pieces of from..to are wider than the narrowest line. */
static int too_long(const struct filling *f, const struct places *places, int from, int to)
{
    int n = 0;
    for (int i = from > 0 ? from : 0; i < to && i + 1 < places->count; i++)
        n += places->items[i + 1].end.px - places->items[i].next.px > f->least;
    return n;
}

bool places_make(struct filling *f, struct places *to, bool anywhere)
{
    const struct paragraph *p = f->p;
    struct break_place start = {.penalty = 0};
    struct pen pen = {0};
    to->count = 0;
    to->again = false;
    to->exact = to->made = to->ready = true;
    if (f->begin < p->count && p->manner.protrude > 0)
        start.next.px += hang(f, f->begin, false);
    const bool ok = place_add(to, start, f->begin, false) &&
                    ends_add(f, to, f->begin, p->count, &pen, anywhere);
    to->too_long = too_long(f, to, 0, to->count);
    return ok;
}

/* ---- places again ---- */

/* The first place behind which a letter comes that is at or behind that one. */
static int place_from(const struct places *places, int letter)
{
    int low = 0, high = places->count;
    while (low < high) {
        int half = low + (high - low) / 2;
        if (places->letters[half] < letter)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

/* The sums before the letter that follows place k. */
static struct pen pen_at(const struct filling *f, const struct places *places, int k)
{
    const struct paragraph *p = f->p;
    int i = places->letters[k];
    struct pen pen = {.sum = places->items[k].next};
    if (i < p->count && p->manner.protrude > 0)
        pen.sum.px -= hang(f, i, false);
    struct break_sum sum = pen.sum;
    while (i > f->begin && (line_white(p, i - 1) || font_text_ends_line(p->characters[i - 1])))
        sum_add(f, &sum, &p->letters[--i], -1);
    if (i > f->begin) {
        pen.ink = sum;
        pen.ink.stretch -= f->ragged ? 0 : breaks_exact((double)p->letters[i - 1].stretch_px);
        pen.ink_end = i;
    }
    return pen;
}

static void sum_move(struct break_sum *sum, const struct break_sum *by)
{
    sum->px += by->px;
    sum->stretch += by->stretch;
    sum->shrink += by->shrink;
}

static bool sums_same(const struct break_sum *a, const struct break_sum *b)
{
    return a->px == b->px && a->stretch == b->stretch && a->shrink == b->shrink;
}

/* Whether a place is what another one is, moved. */
static bool moved_same(struct break_place before, const struct break_place *now,
                       const struct break_sum *by)
{
    sum_move(&before.end, by);
    sum_move(&before.next, by);
    return sums_same(&before.end, &now->end) && sums_same(&before.next, &now->next) &&
           before.penalty == now->penalty && before.flagged == now->flagged;
}

/* Puts what was found in the place of places begin..end_before, and moves those behind. */
static bool places_put(struct places *to, const struct places *found, int begin, int end_before,
                       int letters_by, const struct break_sum *by)
{
    const int end = begin + found->count, tail = to->count - end_before;
    if (!places_reserve(to, end + tail))
        return false;
    memmove(to->items + end, to->items + end_before, (size_t)tail * sizeof *to->items);
    memmove(to->letters + end, to->letters + end_before, (size_t)tail * sizeof *to->letters);
    memmove(to->hyphens + end, to->hyphens + end_before, (size_t)tail * sizeof *to->hyphens);
    to->count = end + tail;
    for (int i = end; letters_by && i < to->count; i++)
        to->letters[i] += letters_by;
    const struct break_sum none = {0};
    for (int i = end; !sums_same(by, &none) && i < to->count; i++) {
        sum_move(&to->items[i].end, by);
        sum_move(&to->items[i].next, by);
    }
    if (found->count) {
        const size_t n = (size_t)found->count;
        memcpy(to->items + begin, found->items, n * sizeof *to->items);
        memcpy(to->letters + begin, found->letters, n * sizeof *to->letters);
        memcpy(to->hyphens + begin, found->hyphens, n * sizeof *to->hyphens);
    }
    return true;
}

/* Finds places anew from before the change to a few behind it, of which the last two must come
 * out as they were, moved. *right: they have. */
static bool places_again(struct filling *f, struct places *to, bool *right)
{
    enum { BEHIND = 4 };
    const struct break_change c = f->p->change;
    const int letters_by = c.end - c.end_before, begin = place_from(to, c.begin);
    int end_before = place_from(to, c.end_before + 1) + BEHIND;
    const bool to_end = end_before >= to->count;
    end_before = to_end ? to->count : end_before;
    struct places found = {.exact = true};
    struct break_sum by = {0};
    *right = begin > 0;
    if (!*right)
        return true;
    const int last = to->count - 1;
    struct pen pen = pen_at(f, to, begin - 1);
    const int stop = to_end ? f->p->count : to->letters[end_before - 1] + letters_by;
    bool ok = ends_add(f, &found, to->letters[begin - 1], stop, &pen, false);
    if (ok && !to_end) {
        const int n = found.count;
        *right = n >= 2 && found.letters[n - 1] == stop;
        if (*right) {
            const struct break_place *a = &to->items[end_before - 1], *b = &found.items[n - 1];
            by = (struct break_sum){b->next.px - a->next.px, b->next.stretch - a->next.stretch,
                                    b->next.shrink - a->next.shrink};
            *right = moved_same(*a, b, &by) && moved_same(a[-1], b - 1, &by) &&
                     fabs(to->items[last].next.px + by.px) < exact_most &&
                     fabs(to->items[last].next.stretch + by.stretch) < exact_most &&
                     fabs(to->items[last].next.shrink + by.shrink) < exact_most;
        }
    }
    if (ok && *right) {
        to->too_long -= too_long(f, to, begin - 1, end_before);
        ok = places_put(to, &found, begin, end_before, letters_by, &by);
        to->change = (struct break_change){begin, end_before, begin + found.count};
        to->too_long += too_long(f, to, begin - 1, begin + found.count);
        to->exact = to->exact && found.exact;
    }
    places_finish(&found);
    return ok;
}

bool places_ready(struct filling *f, struct places *places)
{
    struct paragraph *p = f->p;
    bool right = false;
    if (places->ready)
        return true;
    if (places->made && p->change_known) {
        if (p->change.begin < 0) { /* nothing has changed */
            places->change = (struct break_change){places->count, places->count, places->count};
            right = true;
        } else if (!places_again(f, places, &right)) {
            return false;
        }
    }
    if (!right)
        return places_make(f, places, false);
    places->ready = places->again = true;
    return true;
}
