/* geometry.c - geometries as data, and the conversion between Paris's send addresses and the
 * machine's row-major indices.
 *
 * With P physical processors and n virtual ones, R = ceil(n / P) to each, the processor of
 * row-major index i is virtual processor i div P of physical processor i mod P, and its send
 * address is (i mod P) * R + i div P. Where all axes are in send order the row-major index
 * is the send address; a geometry that has axes of both orders is in NEWS order.
 */
#include <stdlib.h>
#include <string.h>

#include "paris_state.h"

struct paris_geometry *paris_geometry_find(CM_geometry_id_t id)
{
    if (id < 1 || id > paris_the.geometries_count || !paris_the.geometries[id - 1].rank)
        return NULL;
    return &paris_the.geometries[id - 1];
}

const struct paris_geometry *paris_geometry_current(void)
{
    return &paris_the.geometries[CM_current_geometry - 1];
}

CM_geometry_id_t paris_geometry_add(const struct paris_geometry *g)
{
    int i = 0;
    while (i < paris_the.geometries_count && paris_the.geometries[i].rank)
        i++;
    if (i == paris_the.geometries_count) {
        int count = i ? 2 * i : 8;
        struct paris_geometry *grown =
            realloc(paris_the.geometries, (size_t)count * sizeof *paris_the.geometries);
        if (!grown) {
            paris_fail_memory("not enough memory for another geometry");
            return 0;
        }
        memset(grown + i, 0, (size_t)(count - i) * sizeof *grown);
        paris_the.geometries = grown;
        paris_the.geometries_count = count;
    }
    static unsigned int serial;
    paris_the.geometries[i] = *g;
    paris_the.geometries[i].serial = ++serial;
    paris_the.pristine = false;
    return i + 1;
}

bool paris_geometry_complete(struct paris_geometry *g)
{
    g->count = 1;
    for (int axis = 0; axis < g->rank; axis++) {
        if (g->dimensions[axis] < 1) {
            paris_fail("dimensions: axis %d must have a length of 1 or more (got %d)", axis,
                       g->dimensions[axis]);
            return false;
        }
        g->count *= (uint64_t)g->dimensions[axis];
        if (g->count > INT32_MAX) {
            paris_fail("dimensions: more than %d virtual processors", INT32_MAX);
            return false;
        }
    }
    uint64_t physical = CM_physical_processors_limit;
    g->ratio = (g->count + physical - 1) / physical;
    return true;
}

/* ---- addresses ---- */

unsigned int paris_count_bits(uint64_t count)
{
    unsigned int bits = 1;
    while (bits < 63 && (1ull << bits) < count)
        bits++;
    return bits;
}

unsigned int paris_address_bits(const struct paris_geometry *g)
{
    return paris_count_bits(CM_physical_processors_limit * g->ratio);
}

enum machine_order paris_geometry_order(const struct paris_geometry *g)
{
    for (int axis = 0; axis < g->rank; axis++)
        if (g->ordering[axis] != CM_send_order)
            return MACHINE_NEWS_ORDER;
    return MACHINE_SEND_ORDER;
}

static bool in_send_order(const struct paris_geometry *g)
{
    return paris_geometry_order(g) == MACHINE_SEND_ORDER;
}

uint64_t paris_address_of_index(const struct paris_geometry *g, uint64_t index)
{
    uint64_t physical = CM_physical_processors_limit;
    return in_send_order(g) ? index : index % physical * g->ratio + index / physical;
}

uint64_t paris_index_of_address(const struct paris_geometry *g, uint64_t send_address)
{
    uint64_t physical = CM_physical_processors_limit;
    uint64_t index = in_send_order(g)
                         ? send_address
                         : send_address % g->ratio * physical + send_address / g->ratio;
    return send_address < physical * g->ratio && index < g->count ? index : UINT64_MAX;
}

uint64_t paris_index_let_pass(const struct paris_geometry *g, uint64_t send_address)
{
    uint64_t index = paris_index_of_address(g, send_address);
    if (index != UINT64_MAX ||
        !paris_let_pass(
            "send_address: there is no processor %llu among %llu; it is taken modulo",
            (unsigned long long)send_address, (unsigned long long)g->count))
        return index;
    index = paris_index_of_address(g, send_address % (CM_physical_processors_limit * g->ratio));
    return index != UINT64_MAX ? index : send_address % g->count;
}
