/* breaks_find.c - nodes from place to place, of which the way is made: see breaks.h. */
#include "breaks_cost.h"
#include "breaks_internal.h"

#include <array.h>
#include <patience.h>

#include <math.h>
#include <stdlib.h>

/* Ours: of a short last line, as much as a line at TeX's usual limit of badness costs; of a
 * word's rest more than any others together. */
static const double runt_demerits = 44100;
/* Of a line that is too long. */
static const double overfull_demerits = 1e12;

enum { LINES_ASK = 4096 };    /* lines that are tried between two questions of patience.h */
enum { PLACES_A_CHECK = 64 }; /* between two of break_search's */

bool search_node_add(struct search *s, struct break_node node)
{
    if (!array_reserve(&s->nodes, &s->capacity, s->count + 1, sizeof *s->nodes) ||
        !array_reserve(&s->active, &s->active_capacity, s->active_count + 1, sizeof *s->active))
        return false;
    s->nodes[s->count] = node;
    s->active[s->active_count++] = s->count++;
    return true;
}

/* The best new node of those at this place that have the line and the fitness. */
static bool candidate_keep(struct search *s, int first_new, struct break_node node)
{
    for (int i = first_new; i < s->count; i++) {
        struct break_node *o = &s->nodes[i];
        if (o->line != node.line || o->fitness != node.fitness || o->ladder != node.ladder)
            continue;
        if (node.demerits < o->demerits)
            *o = node;
        return true;
    }
    return search_node_add(s, node);
}

/* What a last line from place a costs besides. */
static double last_demerits(const struct search *s, int a)
{
    const struct break_place *from = &s->places[a], *to = &s->places[s->last];
    bool rest = s->rules->whole_word && from->flagged && a > s->last_word;
    bool runt = a > 0 && to->end.px - from->next.px < s->rules->runt_px;
    return (rest ? BREAK_REST_DEMERITS : 0) + (runt ? runt_demerits : 0);
}

/* The line that follows a node. */
static int line_behind(const struct search *s, const struct break_node *a)
{
    return a->line < s->widths_count ? a->line + 1 : a->line;
}

static double width_of(const struct search *s, int line)
{
    return s->widths[line < s->widths_count ? line : s->widths_count - 1];
}

/* A line from node `number` to place b, not too long, if it is good enough. */
static inline bool line_try(struct search *s, int number, int b, int first_new, double r)
{
    if (!(cost_badness(r) <= s->rules->tolerance))
        return true;
    const struct break_node a = s->nodes[number];
    const struct break_place *from = &s->places[a.place], *to = &s->places[b];
    const bool last = b == s->last;
    const int ladder = s->rules->ladder_max && to->flagged ? a.ladder + 1 : 0;
    if (ladder > s->rules->ladder_max)
        return true;
    int fitness;
    const double demerits = a.demerits + cost_demerits(from, to, r, a.fitness, &fitness, last) +
                            (last ? last_demerits(s, a.place) : 0);
    return candidate_keep(s, first_new,
                          (struct break_node){.place = b,
                                              .before = number,
                                              .gone = BREAK_ACTIVE,
                                              .line = line_behind(s, &a),
                                              .fitness = (int8_t)fitness,
                                              .ladder = (int8_t)ladder,
                                              .demerits = demerits});
}

/* Tries a line from each active node to place b. */
static bool place_try(struct search *s, int b)
{
    const struct break_place *const places = s->places, *to = &places[b];
    const struct break_rules rules = *s->rules;
    bool last = b == s->last, ends = last || to->penalty <= -BREAK_INFINITE;
    int first_new = s->count, olds = s->active_count, kept = 0;
    int rescue = -1; /* of those that go, the one to make a line too long from */
    for (int k = 0; k < olds; k++) {
        int number = s->active[k];
        const struct break_node *a = &s->nodes[number];
        double r = cost_ratio(&places[a->place], to, width_of(s, a->line), &rules, last);
        if (r >= -1 && !line_try(s, number, b, first_new, r))
            return false;
        a = &s->nodes[number];
        if (!(r < -1 || ends)) {
            s->active[kept++] = number;
            continue;
        }
        s->nodes[number].gone = b;
        if (rescue < 0 || a->demerits < s->nodes[rescue].demerits)
            rescue = number;
    }
    int news = s->active_count - olds;
    for (int k = 0; k < news; k++)
        s->active[kept + k] = s->active[olds + k];
    s->active_count = kept + news;
    if (s->active_count || rescue < 0 || !s->rules->must)
        return true;
    return search_node_add(
        s, (struct break_node){.place = b,
                               .before = rescue,
                               .gone = BREAK_ACTIVE,
                               .line = line_behind(s, &s->nodes[rescue]),
                               .fitness = BREAK_TIGHT,
                               .demerits = s->nodes[rescue].demerits + overfull_demerits});
}

static bool check_add(struct search *s, int place)
{
    const int n = s->checks_count;
    if (n && place - s->checks[n - 1].place < PLACES_A_CHECK)
        return true;
    if (!array_reserve(&s->checks, &s->checks_capacity, n + 1, sizeof *s->checks))
        return false;
    s->checks[s->checks_count++] = (struct break_check){place, s->count, s->active[0]};
    return true;
}

bool search_run(struct search *s, int until)
{
    bool ok = true;
    long tried = 0;
    for (; ok && s->place < until && s->active_count; s->place++) {
        if (s->places[s->place].penalty >= BREAK_INFINITE && s->place != s->last)
            continue;
        ok = check_add(s, s->place) && place_try(s, s->place);
        tried += s->active_count;
        if (tried > LINES_ASK) {
            ok = ok && !patience_over();
            tried = 0;
        }
    }
    return ok;
}
