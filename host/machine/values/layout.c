/* layout.c - see machine_layout.h.
 *
 * With subgrids, the bits of an address are those of the index in another order, and Gray code
 * is a sum of bits without carry. So the map is linear: the address of a ^ b is the address of
 * a ^ the address of b.
 */
#include <string.h>

#include "machine.h"

enum { WIDTH = 32 };

static int log2_of(uint64_t x)
{
    return 63 - __builtin_clzll(x);
}

/* ---- making ---- */

/* Whether a block's side had better double on axis i than on axis k. */
static bool longer_pays(const struct machine_layout *l, const int *weights, int i, int k)
{
    int64_t wi = weights && weights[i] > 0 ? weights[i] : !weights,
            wk = weights && weights[k] > 0 ? weights[k] : !weights;
    /* Sides are below 2^31 and weights, too. */
    int64_t gain = wi << l->subgrid[k], other = wk << l->subgrid[i];
    return gain != other ? gain > other : l->node[i] > l->node[k];
}

static void sides_choose(struct machine_layout *l, const int *weights, int rank, int doublings)
{
    for (; doublings > 0; doublings--) {
        int best = -1;
        for (int i = 0; i < rank; i++)
            if (l->node[i] && (best < 0 || longer_pays(l, weights, i, best)))
                best = i;
        l->subgrid[best]++;
        l->node[best]--;
    }
}

static void part_add(struct machine_layout *l, int in_index, int in_address, int bits,
                     bool gray)
{
    struct machine_layout_bits *last = l->parts_count ? &l->parts[l->parts_count - 1] : NULL;
    if (!bits)
        return;
    gray = gray && bits > 1;
    if (last && !gray && !last->gray && last->in_index + last->bits == in_index &&
        last->in_address + last->bits == in_address)
        last->bits = (uint8_t)(last->bits + bits);
    else
        l->parts[l->parts_count++] = (struct machine_layout_bits){
            (uint8_t)in_index, (uint8_t)in_address, (uint8_t)bits, gray};
}

static void parts_make(struct machine_layout *l, const uint8_t *orders, int rank)
{
    int address = 0;
    for (int node = 0; node < 2; node++) {
        int index = 0;
        for (int i = rank - 1; i >= 0; i--) {
            int bits = node ? l->node[i] : l->subgrid[i];
            part_add(l, index + (node ? l->subgrid[i] : 0), address, bits,
                     node && !(orders && orders[i] == MACHINE_SEND_ORDER));
            address += bits;
            index += l->subgrid[i] + l->node[i];
        }
    }
    /* Bits above, so that what is no index stays none. */
    part_add(l, address, address, WIDTH - address, false);
}

void machine_layout_make(struct machine_layout *l, const int *lengths, const int *weights,
                         const uint8_t *orders, int rank, uint64_t processors)
{
    bool powers = true;
    memset(l, 0, sizeof *l);
    l->processors = processors;
    l->count = 1;
    l->order = orders ? MACHINE_SEND_ORDER : MACHINE_NEWS_ORDER;
    for (int i = 0; i < rank; i++) {
        l->count *= (uint64_t)lengths[i];
        powers = powers && (lengths[i] & (lengths[i] - 1)) == 0;
        if (orders && orders[i] != MACHINE_SEND_ORDER)
            l->order = MACHINE_NEWS_ORDER;
    }
    l->ratio = (l->count + processors - 1) / processors;
    l->powers = powers;
    l->blocks = powers && l->order == MACHINE_NEWS_ORDER;
    if (!powers)
        return;
    for (int i = 0; i < rank; i++)
        l->node[i] = (uint8_t)log2_of((uint64_t)lengths[i]);
    if (l->blocks) {
        sides_choose(l, weights, rank, log2_of(l->ratio));
        parts_make(l, orders, rank);
        return;
    }
    for (int i = rank - 1, left = log2_of(l->ratio); i >= 0; i--) {
        l->subgrid[i] = (uint8_t)(left < l->node[i] ? left : l->node[i]);
        l->node[i] = (uint8_t)(l->node[i] - l->subgrid[i]);
        left -= l->subgrid[i];
    }
}

/* ---- numbers ---- */

bool machine_layouts_equal(const struct machine_layout *a, const struct machine_layout *b)
{
    if (a->order != b->order || a->blocks != b->blocks || a->count != b->count ||
        a->processors != b->processors || a->parts_count != b->parts_count)
        return false;
    for (int i = 0; i < a->parts_count; i++)
        if (a->parts[i].in_index != b->parts[i].in_index ||
            a->parts[i].in_address != b->parts[i].in_address ||
            a->parts[i].bits != b->parts[i].bits || a->parts[i].gray != b->parts[i].gray)
            return false;
    return true;
}

static uint64_t from_gray(uint64_t code)
{
    for (int shift = 1; shift < WIDTH; shift *= 2)
        code ^= code >> shift;
    return code;
}

uint64_t machine_layout_address(const struct machine_layout *l, uint64_t index)
{
    uint64_t address = 0;
    if (l->order == MACHINE_SEND_ORDER)
        return index;
    if (!l->blocks)
        return index % l->processors * l->ratio + index / l->processors;
    for (int i = 0; i < l->parts_count; i++) {
        const struct machine_layout_bits *p = &l->parts[i];
        uint64_t x = index >> p->in_index & ((UINT64_C(1) << p->bits) - 1);
        address |= (p->gray ? x ^ x >> 1 : x) << p->in_address;
    }
    return address;
}

uint64_t machine_layout_index(const struct machine_layout *l, uint64_t address)
{
    uint64_t index = l->blocks ? 0 : address;
    if (address >= l->processors * l->ratio)
        return UINT64_MAX;
    if (!l->blocks && l->order == MACHINE_NEWS_ORDER)
        index = address % l->ratio * l->processors + address / l->ratio;
    for (int i = 0; l->blocks && i < l->parts_count; i++) {
        const struct machine_layout_bits *p = &l->parts[i];
        uint64_t x = address >> p->in_address & ((UINT64_C(1) << p->bits) - 1);
        index |= (p->gray ? from_gray(x) : x) << p->in_index;
    }
    return index < l->count ? index : UINT64_MAX;
}

/* ---- values ---- */

static struct machine_value *down(struct machine *m, struct machine_value *x, int by, int bits)
{
    return machine_resize(m, machine_extract(m, x, by, bits), WIDTH, false);
}

static struct machine_value *up(struct machine *m, struct machine_value *x, int by)
{
    struct machine_scalar factor = {UINT64_C(1) << by, 0};
    return by ? machine_binary(m, MACHINE_MUL, x,
                               machine_constant(m, MACHINE_UINT(WIDTH), factor))
              : x;
}

static struct machine_value *moved(struct machine *m, const struct machine_layout *l,
                                   struct machine_value *from, bool to_index)
{
    struct machine_value *sum = NULL;
    for (int i = 0; from && i < l->parts_count; i++) {
        const struct machine_layout_bits *p = &l->parts[i];
        struct machine_value *x =
            down(m, from, to_index ? p->in_address : p->in_index, p->bits);
        for (int by = 1; p->gray && by < (to_index ? p->bits : 2); by *= 2)
            x = machine_binary(m, MACHINE_XOR, x, down(m, x, by, WIDTH - by));
        x = up(m, x, to_index ? p->in_index : p->in_address);
        sum = sum ? machine_binary(m, MACHINE_OR, sum, x) : x;
    }
    return sum;
}

struct machine_value *machine_layout_address_value(struct machine *m,
                                                   const struct machine_layout *l,
                                                   struct machine_value *index)
{
    return moved(m, l, index, false);
}

struct machine_value *machine_layout_index_value(struct machine *m,
                                                 const struct machine_layout *l,
                                                 struct machine_value *address)
{
    return moved(m, l, address, true);
}
