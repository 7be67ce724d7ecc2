/* edges_reserve.c - room for edges: see edges_internal.h. */
#include "edges_internal.h"
#include "internal.h"

#include <stdlib.h>
#include <string.h>

/* Three arrays in one block, each `capacity` long and a little. */
static bool three_grow(float **a, float **b, float **c, int count, int *capacity, int wanted)
{
    int grown = *capacity ? *capacity : 64;
    while (grown < wanted)
        grown = grown > FONT_EDGES_MAX ? wanted : 2 * grown;
    size_t stride = (size_t)grown + FONT_EDGES_PAD;
    float *block = aligned_alloc(64, (3 * stride * sizeof(float) + 63) / 64 * 64);
    if (!block)
        return false;
    if (count) {
        memcpy(block, *a, (size_t)count * sizeof(float));
        memcpy(block + stride, *b, (size_t)count * sizeof(float));
        memcpy(block + 2 * stride, *c, (size_t)count * sizeof(float));
    }
    free(*a);
    *a = block;
    *b = block + stride;
    *c = block + 2 * stride;
    *capacity = grown;
    return true;
}

enum font_status font_nodes_reserve(struct font_edges *e, int more)
{
    if (e->nodes_count + more <= e->nodes_capacity)
        return FONT_OK;
    if (e->nodes_count + more > FONT_EDGES_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline has too many edges at this size");
    bool grown = three_grow(&e->node_x, &e->node_y, &e->node_weight, e->nodes_count,
                            &e->nodes_capacity, e->nodes_count + more);
    e->memory = e->node_x;
    return grown ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for edges");
}

enum font_status font_lines_reserve(struct font_edges *e, int more)
{
    if (e->lines_count + more <= e->lines_capacity)
        return FONT_OK;
    if (e->lines_count + more > FONT_EDGES_MAX)
        return font_fail(FONT_TOO_LARGE, "an outline has too many edges at this size");
    return three_grow(&e->line_x0, &e->line_x1, &e->line_y, e->lines_count, &e->lines_capacity,
                      e->lines_count + more)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for edges");
}
