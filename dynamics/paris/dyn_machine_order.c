/* dyn_machine_order.c - which processor has which spring: see dyn_machine_program.h.
 *
 * A get whose addresses go up by one from processor to processor is a load of a whole vector.
 * So the springs of a block of masses are dealt out in rounds: first one of each mass, then a
 * second one of each, and so on, always to the mass with the higher number, the nearest first.
 * In a network that has some order, neighbours' springs of the same round go to neighbours. A
 * block's masses stay in the caches for all rounds. */
#include "dyn_machine_program.h"

#include <stdlib.h>

enum { BLOCK = 4096 };

struct dealt {
    int32_t first, second, packed, round;
};

static int by_number(int32_t a, int32_t b)
{
    return (a > b) - (a < b);
}

static int by_ends(const void *a, const void *b)
{
    const struct dealt *p = a, *q = b;
    int of = by_number(p->first, q->first);
    if (!of)
        of = by_number(p->second, q->second);
    return of ? of : by_number(p->packed, q->packed);
}

static int by_rounds(const void *a, const void *b)
{
    const struct dealt *p = a, *q = b;
    int of = by_number(p->first / BLOCK, q->first / BLOCK);
    if (!of)
        of = by_number(p->round, q->round);
    return of ? of : by_number(p->first, q->first);
}

bool dyn_machine_deal(const struct dyn_packed *packed, int count, struct dyn_order *out)
{
    size_t size = (size_t)count;
    struct dealt *dealt = malloc(size * sizeof *dealt);
    *out = (struct dyn_order){.count = count, .packed = malloc(3 * size * sizeof *out->packed)};
    if (!dealt || !out->packed) {
        free(dealt);
        dyn_order_free(out);
        return false;
    }
    out->end[0] = out->packed + size;
    out->end[1] = out->end[0] + size;
    for (int i = 0; i < count; i++) {
        int32_t a = dyn_packed_end(packed, 0, i), b = dyn_packed_end(packed, 1, i);
        dealt[i] = (struct dealt){a < b ? a : b, a < b ? b : a, i, 0};
    }
    qsort(dealt, size, sizeof *dealt, by_ends);
    for (int i = 1; i < count; i++)
        dealt[i].round = dealt[i].first == dealt[i - 1].first ? dealt[i - 1].round + 1 : 0;
    qsort(dealt, size, sizeof *dealt, by_rounds);
    for (int i = 0; i < count; i++) {
        out->packed[i] = dealt[i].packed;
        out->end[0][i] = dealt[i].first;
        out->end[1][i] = dealt[i].second;
    }
    free(dealt);
    return true;
}

void dyn_order_free(struct dyn_order *order)
{
    free(order->packed); /* and the ends */
    *order = (struct dyn_order){0};
}
