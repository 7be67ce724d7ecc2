/* breaks_again.c - a way that is found again after a change: see breaks.h.
 *
 *     places   ... | check .... changed .... check | ...
 *     nodes    kept | made anew                    | kept, moved
 *
 * The search goes on from the last check before the change. Behind it, where the nodes that are
 * active at a check are those that were, each with as many demerits more as the others, all
 * that follows is as it was. */
#include "breaks_internal.h"

#include <array.h>
#include <stdlib.h>
#include <string.h>

void break_search_finish(struct break_search *s)
{
    free(s->nodes);
    free(s->checks);
    *s = (struct break_search){0};
}

struct again {
    struct search s;
    struct break_search *kept;
    struct break_change change;
    int moved;                   /* places behind the change */
    int first;                   /* the check that the search went on from */
    int *origins, origins_count; /* the numbers of the nodes that it began with */
    int same;                    /* the check at which all is as it was; -1: none */
    int *same_before; /* numbers of nodes that were active there, as the search's are */
    int same_capacity;
    double demerits_by;
};

static void again_finish(struct again *a)
{
    free(a->s.nodes);
    free(a->s.active);
    free(a->s.checks);
    free(a->origins);
    free(a->same_before);
}

/* The last check at or before a place. */
static int check_before(const struct break_search *kept, int place)
{
    int low = 0, high = kept->checks_count;
    while (high - low > 1) {
        int half = low + (high - low) / 2;
        if (kept->checks[half].place <= place)
            low = half;
        else
            high = half;
    }
    return low;
}

/* Begins with the nodes that were active at the check. */
static bool begin_at(struct again *a, int check)
{
    const struct break_check *c = &a->kept->checks[check];
    a->first = check;
    a->s.place = c->place;
    int capacity = 0;
    for (int i = c->oldest; i < c->nodes; i++) {
        struct break_node node = a->kept->nodes[i];
        if (node.gone < c->place)
            continue;
        node.gone = BREAK_ACTIVE;
        if (!array_reserve(&a->origins, &capacity, a->origins_count + 1, sizeof *a->origins) ||
            !search_node_add(&a->s, node))
            return false;
        a->origins[a->origins_count++] = i;
    }
    return true;
}

static bool same_place(const struct again *a, int before, int now)
{
    return before < a->change.begin
               ? now == before
               : before >= a->change.end_before && now == before + a->moved;
}

/* Whether the nodes that are active are those that were at that check. */
static bool as_it_was(struct again *a, int check)
{
    const struct break_check *c = &a->kept->checks[check];
    int n = 0;
    if (!array_reserve(&a->same_before, &a->same_capacity, a->s.active_count + 1,
                       sizeof *a->same_before))
        return false;
    for (int i = c->oldest; i < c->nodes; i++) {
        const struct break_node *b = &a->kept->nodes[i];
        if (b->gone < c->place)
            continue;
        if (n == a->s.active_count)
            return false;
        const struct break_node *o = &a->s.nodes[a->s.active[n]];
        if (!same_place(a, b->place, o->place) || b->fitness != o->fitness ||
            b->ladder != o->ladder || b->line != o->line)
            return false;
        if (n && o->demerits - b->demerits != a->demerits_by)
            return false;
        a->demerits_by = o->demerits - b->demerits;
        a->same_before[n++] = i;
    }
    return n == a->s.active_count;
}

/* Goes on until all is as it was, or to the end. */
static bool run_on(struct again *a)
{
    const struct break_search *kept = a->kept;
    int check = a->first;
    a->same = -1;
    /* What the last line costs is a matter of where the last word begins. */
    const bool may = a->s.last_word >= a->change.end;
    while (may && check < kept->checks_count &&
           kept->checks[check].place < a->change.end_before)
        check++;
    for (; may && check < kept->checks_count; check++) {
        if (!search_run(&a->s, kept->checks[check].place + a->moved))
            return false;
        if (!a->s.active_count)
            return true;
        if (as_it_was(a, check)) {
            a->same = check;
            return true;
        }
    }
    return search_run(&a->s, a->s.last + 1);
}

/* ---- what was found, put with what was kept ---- */

static int number_of(const struct again *a, int first_node, int i)
{
    return i < a->origins_count ? a->origins[i] : first_node + i - a->origins_count;
}

/* Nodes from the check at which all is as it was: moved by so many numbers. */
static void nodes_move(struct again *a, int first_node, int by)
{
    struct break_search *kept = a->kept;
    const struct break_check c = kept->checks[a->same];
    const int n = kept->count - c.nodes;
    memmove(kept->nodes + c.nodes + by, kept->nodes + c.nodes, (size_t)n * sizeof *kept->nodes);
    for (int i = c.nodes + by; i < c.nodes + by + n; i++) {
        struct break_node *node = &kept->nodes[i];
        node->place += a->moved;
        node->gone += node->gone == BREAK_ACTIVE ? 0 : a->moved;
        node->demerits += a->demerits_by;
        if (node->before >= c.nodes) {
            node->before += by;
            continue;
        }
        for (int k = 0; k < a->s.active_count; k++)
            if (a->same_before[k] == node->before) {
                node->before = number_of(a, first_node, a->s.active[k]);
                break;
            }
    }
}

static bool checks_put(struct again *a, int first_node, int by)
{
    struct break_search *kept = a->kept;
    const int from = a->first, news = a->s.checks_count;
    const int tail = a->same < 0 ? 0 : kept->checks_count - a->same;
    const int tail_nodes = a->same < 0 ? 0 : kept->checks[a->same].nodes;
    if (!array_reserve(&kept->checks, &kept->checks_capacity, from + news + tail,
                       sizeof *kept->checks))
        return false;
    if (tail)
        memmove(kept->checks + from + news, kept->checks + a->same,
                (size_t)tail * sizeof *kept->checks);
    for (int i = 0; i < news; i++) {
        const struct break_check *c = &a->s.checks[i];
        kept->checks[from + i] =
            (struct break_check){c->place, first_node + c->nodes - a->origins_count,
                                 number_of(a, first_node, c->oldest)};
    }
    for (int i = from + news; i < from + news + tail; i++) {
        struct break_check *c = &kept->checks[i];
        c->place += a->moved;
        c->nodes += by;
        if (c->oldest >= tail_nodes) {
            c->oldest += by;
            continue;
        }
        for (int k = 0; k < a->s.active_count; k++)
            if (a->same_before[k] == c->oldest) {
                c->oldest = number_of(a, first_node, a->s.active[k]);
                break;
            }
    }
    kept->checks_count = from + news + tail;
    return true;
}

/* Makes of what was kept what a search from the beginning would have made. */
static bool search_put(struct again *a)
{
    struct break_search *kept = a->kept;
    const int first_node = kept->checks[a->first].nodes;
    const int news = a->s.count - a->origins_count;
    const int behind = a->same < 0 ? 0 : kept->count - kept->checks[a->same].nodes;
    const int by = a->same < 0 ? 0 : first_node + news - kept->checks[a->same].nodes;
    const int count = first_node + news + behind;
    if (!array_reserve(&kept->nodes, &kept->capacity, count, sizeof *kept->nodes))
        return false;
    for (int k = 0; a->same >= 0 && k < a->s.active_count; k++) {
        const int gone = kept->nodes[a->same_before[k]].gone;
        a->s.nodes[a->s.active[k]].gone = gone == BREAK_ACTIVE ? gone : gone + a->moved;
    }
    if (a->same >= 0)
        nodes_move(a, first_node, by);
    for (int i = 0; i < a->origins_count; i++)
        kept->nodes[a->origins[i]].gone = a->s.nodes[i].gone;
    for (int i = 0; i < news; i++) {
        struct break_node *node = &kept->nodes[first_node + i];
        *node = a->s.nodes[a->origins_count + i];
        node->before = node->before < 0 ? -1 : number_of(a, first_node, node->before);
    }
    kept->count = count;
    kept->stopped = a->same < 0 ? a->s.place : kept->stopped + a->moved;
    return checks_put(a, first_node, by);
}

/* ---- */

/* The best node at the last place; -1: there is none. */
static int best_of(const struct break_node *nodes, int count, int last)
{
    int best = -1, from = count;
    while (from > 0 && nodes[from - 1].place == last)
        from--;
    for (int i = from; i < count; i++)
        if (best < 0 || nodes[i].demerits < nodes[best].demerits)
            best = i;
    return best;
}

static bool way_tell(const struct break_node *nodes, int best, int **chosen, int *count)
{
    int n = 0;
    for (int at = best; nodes[at].before >= 0; at = nodes[at].before)
        n++;
    if (!(*chosen = malloc(((size_t)n + 1) * sizeof **chosen)))
        return false;
    *count = n;
    for (int at = best; nodes[at].before >= 0; at = nodes[at].before)
        (*chosen)[--n] = nodes[at].place;
    return true;
}

/* From the beginning; what was found is *kept. */
static bool find_all(struct search *s, struct break_search *kept)
{
    s->place = 1;
    const bool ok = search_node_add(s, (struct break_node){.before = -1,
                                                           .gone = BREAK_ACTIVE,
                                                           .fitness = BREAK_DECENT}) &&
                    search_run(s, s->last + 1);
    *kept = (struct break_search){.nodes = s->nodes,
                                  .count = s->count,
                                  .capacity = s->capacity,
                                  .checks = s->checks,
                                  .checks_count = s->checks_count,
                                  .checks_capacity = s->checks_capacity,
                                  .stopped = s->place,
                                  .made = ok};
    free(s->active);
    return ok;
}

static bool find_again(struct again *a)
{
    const int begin = a->change.begin;
    if (a->kept->stopped <= begin) /* it never came so far */
        return true;
    return begin_at(a, check_before(a->kept, begin)) && run_on(a) && search_put(a);
}

bool breaks_find_again(const struct break_place *places, int places_count, const double *widths,
                       int widths_count, const struct break_rules *rules,
                       struct break_search *search, const struct break_change *change,
                       int **chosen, int *count, double *demerits)
{
    static const double exact_most = (double)(1ll << 38);
    struct break_search own = {0}, *kept = search ? search : &own;
    struct search s = {.places = places,
                       .widths = widths,
                       .widths_count = widths_count,
                       .last = places_count - 1,
                       .rules = rules};
    for (s.last_word = s.last - 1; s.last_word > 0 && places[s.last_word].flagged;)
        s.last_word--;
    *count = 0;
    *chosen = NULL;
    bool ok;
    if (kept->made && change && kept->checks_count) {
        struct again a = {
            .s = s, .kept = kept, .change = *change, .moved = change->end - change->end_before};
        ok = find_again(&a);
        again_finish(&a);
    } else {
        break_search_finish(kept);
        ok = find_all(&s, kept);
    }
    const int best = ok ? best_of(kept->nodes, kept->count, s.last) : -1;
    if (best >= 0) {
        ok = way_tell(kept->nodes, best, chosen, count);
        if (demerits)
            *demerits = kept->nodes[best].demerits;
    }
    if (!ok || !search || (kept->count && kept->nodes[kept->count - 1].demerits > exact_most))
        break_search_finish(kept);
    return ok;
}

bool breaks_find(const struct break_place *places, int places_count, const double *widths,
                 int widths_count, const struct break_rules *rules, int *chosen, int *count,
                 double *demerits)
{
    int *found;
    const bool ok = breaks_find_again(places, places_count, widths, widths_count, rules, NULL,
                                      NULL, &found, count, demerits);
    for (int i = 0; i < *count; i++)
        chosen[i] = found[i];
    free(found);
    return ok;
}
