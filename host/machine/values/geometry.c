/* geometry.c - see geometry.h.
 *
 * Rows run along the last axis, with columns of padding on both sides where vectors are
 * used. */
#include <string.h>

#include "base/errors.h"
#include "base/parts.h"
#include "base/types.h"
#include "values/values.h"

struct vpset *vpset_missing(struct machine *m, int vpset)
{
    machine_fail(m, MACHINE_BAD_ARGUMENT,
                 vpset ? "there is no VP set %d" : "there is no current VP set (%d)", vpset);
    return NULL;
}

void geometry_layout(const struct machine *m, struct machine_layout *l, const int *dimensions,
                     int rank, enum machine_order order)
{
    uint8_t orders[MACHINE_AXES_MAX];
    memset(orders, (int)order, sizeof orders);
    machine_layout_make(l, dimensions, NULL, orders, rank,
                        (uint64_t)m->values->processors_count);
}

void geometry_make(const struct machine *m, struct vpset *s, const int *dimensions, int rank,
                   const struct machine_layout *layout)
{
    s->layout = *layout;
    s->rank = rank;
    memcpy(s->dimensions, dimensions, (size_t)rank * sizeof *dimensions);
    s->count = 1;
    for (int i = 0; i < rank; i++)
        s->count *= (uint64_t)dimensions[i];
    s->width = dimensions[rank - 1];
    s->rows = s->count / (uint64_t)s->width;
    s->ratio = layout->ratio;
    const uint64_t addresses = (uint64_t)m->values->processors_count * s->ratio;
    for (s->address_bits = 1;
         s->address_bits < 63 && UINT64_C(1) << s->address_bits < addresses;)
        s->address_bits++;
    const struct device_shape *shape = &m->device->shape;
    s->halo = s->width >= shape->vector ? shape->halo : 0;
    s->pitch = (size_t)s->width + 2 * (size_t)s->halo;
    size_t whole =
        s->width < LINE_BYTES ? 16 : LINE_BYTES; /* of bytes, too, rows begin lines */
    if (s->halo)
        s->pitch = (s->pitch + whole - 1) / whole * whole;
}

size_t geometry_bytes(const struct vpset *s, struct machine_type type)
{
    return (s->pitch * s->rows + (s->halo ? 16 : 0)) * type_bytes(type);
}

struct rows geometry_rows(const struct vpset *s, struct machine_type type)
{
    return (struct rows){geometry_bytes(s, type), (size_t)s->halo * type_bytes(type)};
}

size_t geometry_place(const struct vpset *s, uint64_t index)
{
    return index / (uint64_t)s->width * s->pitch + (size_t)s->halo + index % (uint64_t)s->width;
}

uint64_t geometry_coordinate(const struct vpset *s, int axis, uint64_t index)
{
    for (int i = s->rank - 1; i > axis; i--)
        index /= (uint64_t)s->dimensions[i];
    return index % (uint64_t)s->dimensions[axis];
}

int geometry_places(const struct vpset *s, uint64_t index, size_t places[3])
{
    size_t at = geometry_place(s, index), column = index % (uint64_t)s->width,
           width = (size_t)s->width;
    int count = 0;
    places[count++] = at;
    if (column < (size_t)s->halo)
        places[count++] = at + width;
    if (column >= width - (size_t)s->halo)
        places[count++] = at - width;
    return count;
}

int machine_vpset_current(const struct machine *m)
{
    return m->values->set_current;
}

static const struct vpset *peek(const struct machine *m, int vpset)
{
    return vpset > 0 && vpset < m->values->sets_count && m->values->sets[vpset].used
               ? &m->values->sets[vpset]
               : NULL;
}

int machine_vpset_rank(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->rank : 0;
}

int machine_vpset_length(const struct machine *m, int vpset, int axis)
{
    const struct vpset *s = peek(m, vpset);
    return s && axis >= 0 && axis < s->rank ? s->dimensions[axis] : 0;
}

uint64_t machine_vpset_count(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->count : 0;
}

uint64_t machine_vpset_ratio(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->ratio : 0;
}

int machine_address_bits(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->address_bits : 1;
}

uint64_t machine_send_address(const struct machine *m, int vpset, uint64_t index)
{
    const struct vpset *s = peek(m, vpset);
    return s ? machine_layout_address(&s->layout, index) : 0;
}

uint64_t machine_index(const struct machine *m, int vpset, uint64_t send_address)
{
    const struct vpset *s = peek(m, vpset);
    return s ? machine_layout_index(&s->layout, send_address) : UINT64_MAX;
}

int machine_processors_count(const struct machine *m)
{
    return m->values->processors_count;
}
