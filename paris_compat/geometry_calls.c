/* geometry_calls.c - the calls that create, find and query geometries. */
#include <string.h>

#include "paris_state.h"

/* ---- made and given back ---- */

const struct paris_geometry *paris_geometry_of(CM_geometry_id_t id)
{
    paris_machine();
    const struct paris_geometry *g = paris_geometry_find(id);
    if (!g)
        paris_fail("geometry: %d is not a geometry (any more): make it with CM_create_geometry",
                   id);
    return g;
}

static const struct paris_geometry *geometry_axis(CM_geometry_id_t id, unsigned int axis)
{
    const struct paris_geometry *g = paris_geometry_of(id);
    if (g && axis >= (unsigned int)g->rank) {
        paris_fail("axis: must be 0..%d in this geometry (got %d)", g->rank - 1, (int)axis);
        return NULL;
    }
    return g;
}

static bool rank_good(unsigned int rank)
{
    if (rank >= 1 && rank <= MACHINE_AXES_MAX)
        return true;
    paris_fail("rank: must be 1..%d (got %d)", MACHINE_AXES_MAX, (int)rank);
    return false;
}

static bool geometry_from_dimensions(struct paris_geometry *g, CM_vector_t dimensions,
                                     unsigned int rank)
{
    paris_machine();
    memset(g, 0, sizeof *g);
    if (!rank_good(rank))
        return false;
    if (!dimensions.ints) {
        paris_fail("dimensions: is NULL");
        return false;
    }
    g->rank = (int)rank;
    for (int axis = 0; axis < g->rank; axis++) {
        g->dimensions[axis] = dimensions.ints[axis];
        g->weight[axis] = 1;
        g->ordering[axis] = CM_news_order;
    }
    return paris_geometry_complete(g);
}

static bool geometry_from_axes(struct paris_geometry *g, CM_axis_descriptor_t *axes,
                               unsigned int rank)
{
    paris_machine();
    memset(g, 0, sizeof *g);
    if (!rank_good(rank))
        return false;
    g->rank = (int)rank;
    for (int axis = 0; axis < g->rank; axis++) {
        if (!axes || !axes[axis]) {
            paris_fail("axis_descriptors: the descriptor of axis %d is NULL", axis);
            return false;
        }
        if (axes[axis]->ordering != CM_news_order && axes[axis]->ordering != CM_send_order) {
            paris_fail("axis_descriptors: ordering of axis %d must be CM_news_order or "
                       "CM_send_order (got %d)",
                       axis, axes[axis]->ordering);
            return false;
        }
        g->dimensions[axis] = axes[axis]->length > INT32_MAX ? -1 : (int)axes[axis]->length;
        g->weight[axis] = (int)axes[axis]->weight;
        g->ordering[axis] = (uint8_t)axes[axis]->ordering;
    }
    return paris_geometry_complete(g);
}

static CM_geometry_id_t geometry_intern(const struct paris_geometry *g)
{
    for (int i = 0; i < paris_the.geometries_count; i++) {
        const struct paris_geometry *h = &paris_the.geometries[i];
        if (h->rank == g->rank && !memcmp(h->dimensions, g->dimensions, sizeof g->dimensions) &&
            !memcmp(h->weight, g->weight, sizeof g->weight) &&
            !memcmp(h->ordering, g->ordering, sizeof g->ordering))
            return i + 1;
    }
    return paris_geometry_add(g);
}

CM_geometry_id_t CM_create_geometry(CM_vector_t dimensions, unsigned int rank)
{
    struct paris_geometry g;
    paris_the.call = "CM_create_geometry";
    return geometry_from_dimensions(&g, dimensions, rank) ? paris_geometry_add(&g) : 0;
}

CM_geometry_id_t CM_intern_geometry(CM_vector_t dimensions, unsigned int rank)
{
    struct paris_geometry g;
    paris_the.call = "CM_intern_geometry";
    return geometry_from_dimensions(&g, dimensions, rank) ? geometry_intern(&g) : 0;
}

CM_geometry_id_t CM_create_detailed_geometry(CM_axis_descriptor_t *axis_descriptors,
                                             unsigned int rank)
{
    struct paris_geometry g;
    paris_the.call = "CM_create_detailed_geometry";
    return geometry_from_axes(&g, axis_descriptors, rank) ? paris_geometry_add(&g) : 0;
}

CM_geometry_id_t CM_intern_detailed_geometry(CM_axis_descriptor_t *axis_descriptors,
                                             unsigned int rank)
{
    struct paris_geometry g;
    paris_the.call = "CM_intern_detailed_geometry";
    return geometry_from_axes(&g, axis_descriptors, rank) ? geometry_intern(&g) : 0;
}

void CM_deallocate_geometry(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_deallocate_geometry";
    if (!paris_geometry_of(geometry))
        return;
    struct paris_geometry *g = paris_geometry_find(geometry);
    if (g->sets)
        paris_fail("geometry: %d VP sets still have it: call CM_deallocate_vp_set first",
                   g->sets);
    else
        memset(g, 0, sizeof *g);
}

/* ---- inquiries ---- */

int CM_geometry_rank(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_geometry_rank";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    return g ? g->rank : 0;
}

unsigned int CM_geometry_axis_length(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_length";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    return g ? (unsigned int)g->dimensions[axis] : 0;
}

unsigned int CM_geometry_coordinate_length(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_coordinate_length";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    return g ? paris_count_bits((uint64_t)g->dimensions[axis]) : 0;
}

int CM_geometry_axis_ordering(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_ordering";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    return g ? g->ordering[axis] : CM_news_order;
}

/* Where processors are dealt out (machine_layout.h), a processor's virtual ones are along the
 * first axis as far as that suffices, then along the next; in send order from the last axis
 * on. */
unsigned int CM_geometry_axis_vp_ratio(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_vp_ratio";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    if (!g)
        return 0;
    if (g->layout.powers)
        return 1u << g->layout.subgrid[axis];
    uint64_t left = g->ratio, taken = 1;
    bool last_first = g->layout.order == MACHINE_SEND_ORDER;
    for (int i = 0; i < g->rank; i++) {
        int a = last_first ? g->rank - 1 - i : i;
        taken = left < (uint64_t)g->dimensions[a] ? left : (uint64_t)g->dimensions[a];
        left = (left + taken - 1) / taken;
        if (a == (int)axis)
            break;
    }
    return (unsigned int)taken;
}

unsigned int CM_geometry_axis_weight(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_weight";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    return g ? (unsigned int)g->weight[axis] : 0;
}

unsigned int CM_geometry_axis_on_chip_bits(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_on_chip_bits";
    geometry_axis(geometry, axis);
    return 0;
}

unsigned int CM_geometry_axis_on_chip_pos(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_on_chip_pos";
    geometry_axis(geometry, axis);
    return 0;
}

/* Where a length is no power of two, no bits of the processor's number are an axis's. */
static unsigned int off_chip_bits(const struct paris_geometry *g, unsigned int axis)
{
    return g->layout.powers ? g->layout.node[axis] : 0;
}

unsigned int CM_geometry_axis_off_chip_bits(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_off_chip_bits";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    return g ? off_chip_bits(g, axis) : 0;
}

unsigned int CM_geometry_axis_off_chip_pos(CM_geometry_id_t geometry, unsigned int axis)
{
    paris_the.call = "CM_geometry_axis_off_chip_pos";
    const struct paris_geometry *g = geometry_axis(geometry, axis);
    unsigned int position = 0;
    for (unsigned int i = axis + 1; g && i < (unsigned int)g->rank; i++)
        position += off_chip_bits(g, i);
    return position;
}

unsigned int CM_geometry_serial_number(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_geometry_serial_number";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    return g ? g->serial : 0;
}

unsigned int CM_geometry_send_address_length(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_geometry_send_address_length";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    return g ? paris_address_bits(g) : 0;
}

unsigned int CM_geometry_total_processors(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_geometry_total_processors";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    return g ? (unsigned int)g->count : 0;
}

unsigned int CM_geometry_total_vp_ratio(CM_geometry_id_t geometry)
{
    paris_the.call = "CM_geometry_total_vp_ratio";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    return g ? (unsigned int)g->ratio : 0;
}
