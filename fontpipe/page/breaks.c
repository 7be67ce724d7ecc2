/* breaks.c - see breaks.h.
 *
 * A node is a way to break the text up to a place: the best one of those that end there after
 * so many lines with a last line of that fitness. Nodes are active while a line from them can
 * still end at the place that is looked at. */
#include "breaks.h"

#include <array.h>
#include <patience.h>

#include <math.h>
#include <stdlib.h>

/* TeX's usual numbers. */
static const double line_penalty = 10, adjacent_demerits = 10000, hyphens_demerits = 10000,
                    last_hyphen_demerits = 5000;
/* Ours: of a short last line, as much as a line at TeX's usual limit of badness costs; of a
 * word's rest more than any others together. */
static const double runt_demerits = 44100;

enum fitness { VERY_LOOSE, LOOSE, DECENT, TIGHT, FITNESSES };

enum { LINES_ASK = 4096 }; /* lines that are tried between two questions of patience.h */

struct node {
    int place, line, fitness, before; /* before: a node's number */
    int ladder;                       /* flagged ends in a row, up to this one */
    double demerits;
    bool active;
};

struct nodes {
    struct node *items;
    int count, capacity;
    int *active, active_count, active_capacity;
};

double breaks_ratio(const struct break_place *from, const struct break_place *to, double width,
                    const struct break_rules *rules, bool last)
{
    double lacks = width - (to->end.px - from->next.px);
    if (lacks >= 0) {
        double stretch = to->end.stretch - from->next.stretch + rules->emergency_px;
        if (last && rules->last_fills)
            return 0;
        return lacks < 1e-9 ? 0 : stretch > 0 ? lacks / stretch : BREAK_OVERFULL;
    }
    double shrink = to->end.shrink - from->next.shrink;
    return lacks > -1e-9 ? 0 : shrink > 0 ? lacks / shrink : -BREAK_OVERFULL;
}

static double badness_of(double ratio)
{
    double bad = 100 * fabs(ratio * ratio * ratio);
    return bad < BREAK_INFINITE ? bad : BREAK_INFINITE;
}

/* TeX's badness: a whole number, of which the fitness is a matter; about 100 |ratio|^3. */
static double badness_whole(double ratio)
{
    double r = floor(297 * fabs(ratio));
    return r > 1290 ? BREAK_INFINITE : floor((r * r * r + 131072) / 262144);
}

static enum fitness fitness_of(double ratio)
{
    double badness = badness_whole(ratio);
    if (ratio < 0)
        return badness > 12 ? TIGHT : DECENT;
    return badness > 99 ? VERY_LOOSE : badness > 12 ? LOOSE : DECENT;
}

double breaks_demerits(const struct break_place *from, const struct break_place *to,
                       double ratio, int fitness_before, int *fitness, bool last)
{
    double bad = badness_of(ratio), line = line_penalty + bad, p = to->penalty;
    double demerits = line * line;
    *fitness = (int)fitness_of(ratio);
    demerits += p > 0 ? p * p : p > -BREAK_INFINITE ? -p * p : 0;
    if (from->flagged && (to->flagged || last))
        demerits += last ? last_hyphen_demerits : hyphens_demerits;
    if (abs(*fitness - fitness_before) > 1)
        demerits += adjacent_demerits;
    return demerits;
}

static int node_add(struct nodes *n, struct node node)
{
    if (!array_reserve(&n->items, &n->capacity, n->count + 1, sizeof *n->items) ||
        !array_reserve(&n->active, &n->active_capacity, n->active_count + 1, sizeof *n->active))
        return -1;
    n->items[n->count] = node;
    n->active[n->active_count++] = n->count;
    return n->count++;
}

static double width_of(const double *widths, int count, int line)
{
    return widths[line < count ? line : count - 1];
}

/* The best new node of those at this place that have the line and the fitness; lines beyond the
 * last width are alike. */
static bool candidate_keep(struct nodes *n, int first_new, struct node node, int widths_count)
{
    for (int i = first_new; i < n->count; i++) {
        struct node *o = &n->items[i];
        bool alike =
            o->line == node.line || (o->line >= widths_count && node.line >= widths_count);
        if (!alike || o->fitness != node.fitness || o->ladder != node.ladder)
            continue;
        if (node.demerits < o->demerits) {
            node.active = true;
            *o = node;
        }
        return true;
    }
    return node_add(n, node) >= 0;
}

struct search {
    const struct break_place *places;
    const double *widths;
    int widths_count, last;
    int last_word; /* the place that the last word begins behind */
    const struct break_rules *rules;
};

/* What a last line from place a costs besides. */
static double last_demerits(const struct search *s, int a)
{
    const struct break_place *from = &s->places[a], *to = &s->places[s->last];
    bool rest = s->rules->whole_word && from->flagged && a > s->last_word;
    bool runt = a > 0 && to->end.px - from->next.px < s->rules->runt_px;
    return (rest ? BREAK_REST_DEMERITS : 0) + (runt ? runt_demerits : 0);
}

/* Tries a line from each active node to place b. */
static bool place_try(const struct search *s, struct nodes *n, int b)
{
    const struct break_place *to = &s->places[b];
    bool last = b == s->last, ends = last || to->penalty <= -BREAK_INFINITE;
    int first_new = n->count, olds = n->active_count, kept = 0;
    int rescue = -1; /* of those that go, the one to make a line too long from */
    for (int k = 0; k < olds; k++) {
        int number = n->active[k];
        struct node a = n->items[number];
        const struct break_place *from = &s->places[a.place];
        double width = width_of(s->widths, s->widths_count, a.line);
        double r = breaks_ratio(from, to, width, s->rules, last);
        bool gone = r < -1 || ends;
        int ladder = s->rules->ladder_max && to->flagged ? a.ladder + 1 : 0;
        if (r >= -1 && badness_of(r) <= s->rules->tolerance && ladder <= s->rules->ladder_max) {
            struct node next = {.place = b,
                                .line = a.line + 1,
                                .before = number,
                                .ladder = ladder,
                                .active = true};
            next.demerits = a.demerits +
                            breaks_demerits(from, to, r, a.fitness, &next.fitness, last) +
                            (last ? last_demerits(s, a.place) : 0);
            if (!candidate_keep(n, first_new, next, s->widths_count))
                return false;
        }
        if (!gone)
            n->active[kept++] = number;
        else if (rescue < 0 || a.demerits < n->items[rescue].demerits)
            rescue = number;
    }
    int news = n->active_count - olds;
    for (int k = 0; k < news; k++)
        n->active[kept + k] = n->active[olds + k];
    n->active_count = kept + news;
    if (n->active_count || rescue < 0 || !s->rules->must)
        return true;
    struct node next = {.place = b,
                        .line = n->items[rescue].line + 1,
                        .fitness = TIGHT,
                        .before = rescue,
                        .demerits = n->items[rescue].demerits + 1e12,
                        .active = true};
    return node_add(n, next) >= 0;
}

bool breaks_find(const struct break_place *places, int places_count, const double *widths,
                 int widths_count, const struct break_rules *rules, int *chosen, int *count,
                 double *demerits)
{
    struct search s = {places, widths, widths_count, places_count - 1, 0, rules};
    for (s.last_word = s.last - 1; s.last_word > 0 && places[s.last_word].flagged;)
        s.last_word--;
    struct nodes n = {0};
    *count = 0;
    bool ok = node_add(&n, (struct node){.fitness = DECENT, .before = -1, .active = true}) >= 0;
    long tried = 0;
    for (int b = 1; ok && b < places_count && n.active_count; b++) {
        if (places[b].penalty >= BREAK_INFINITE && b != s.last)
            continue;
        ok = place_try(&s, &n, b);
        tried += n.active_count;
        if (tried > LINES_ASK) {
            ok = ok && !patience_over();
            tried = 0;
        }
    }
    int best = -1;
    for (int k = 0; ok && k < n.active_count; k++) {
        const struct node *a = &n.items[n.active[k]];
        if (a->place == s.last && (best < 0 || a->demerits < n.items[best].demerits))
            best = n.active[k];
    }
    if (best >= 0) {
        *count = n.items[best].line;
        for (int at = best, k = *count; k > 0; at = n.items[at].before)
            chosen[--k] = n.items[at].place;
        if (demerits)
            *demerits = n.items[best].demerits;
    }
    free(n.items);
    free(n.active);
    return ok;
}
