/* geometry.c - geometries as data, and the conversion between Paris's send addresses and the
 * machine's row-major indices.
 *
 * machine_layout.h tells where virtual processors live. A geometry that has axes of both orders
 * is in NEWS order; its axes in send order are numbered in binary.
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
    uint8_t orders[MACHINE_AXES_MAX];
    for (int axis = 0; axis < g->rank; axis++)
        orders[axis] =
            g->ordering[axis] == CM_send_order ? MACHINE_SEND_ORDER : MACHINE_NEWS_ORDER;
    machine_layout_make(&g->layout, g->dimensions, g->weight, orders, g->rank, physical);
    g->ratio = g->layout.ratio;
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

uint64_t paris_address_of_index(const struct paris_geometry *g, uint64_t index)
{
    return machine_layout_address(&g->layout, index);
}

uint64_t paris_index_of_address(const struct paris_geometry *g, uint64_t send_address)
{
    return machine_layout_index(&g->layout, send_address);
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
