/* blocks.c - blocks of fields, in and out. Where the front end can look into the device's
 * memory it touches nothing but the block. Of an array that the sequencers have (sequencers/),
 * each one's own rows of it are looked for. */
#include <stdlib.h>
#include <string.h>

#include "access/settle.h"
#include "base/errors.h"
#include "base/types.h"
#include "ops/observe.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "watch/watch.h"

struct block {
    struct field *field;
    uint32_t offset; /* of the bits in it */
    const struct vpset *set;
    const struct machine_block *of;
    size_t element;
};

static bool is_within(struct machine *m, const struct block *b)
{
    const struct machine_block *of = b->of;
    if (of->row + of->rows <= b->set->rows && of->column >= 0 && of->columns >= 0 &&
        of->column + of->columns <= b->set->width)
        return true;
    machine_fail(
        m, MACHINE_BAD_ARGUMENT,
        "a block of %llu rows from row %llu, %d columns from column %d, reaches beyond "
        "%llu rows of %d",
        (unsigned long long)of->rows, (unsigned long long)of->row, of->columns, of->column,
        (unsigned long long)b->set->rows, b->set->width);
    return false;
}

/* Where row i of the block begins in an array as machine_field_download() has it. */
static size_t dense_at(const struct block *b, uint64_t i)
{
    return ((b->of->row + i) * (uint64_t)b->set->width + (uint64_t)b->of->column) * b->element;
}

static size_t row_bytes(const struct block *b)
{
    return (size_t)b->of->columns * b->element;
}

static unsigned char *dense_get(struct machine *m, uint32_t field, struct machine_type type,
                                const struct block *b)
{
    unsigned char *dense = malloc(b->set->count * b->element);
    if (!dense) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for a block of a field");
        return NULL;
    }
    if (machine_field_download(m, field, type, dense) == MACHINE_OK)
        return dense;
    free(dense);
    return NULL;
}

/* The block, and what the bits hold that it is a part of. NULL: error set. */
static struct machine_value *block_find(struct machine *m, uint32_t field,
                                        struct machine_type type,
                                        const struct machine_block *of, struct block *b)
{
    b->field = observe_field(m, field, type, &b->offset);
    struct machine_value *v =
        b->field ? machine_field_value(m, field, type, MACHINE_EVERYWHERE) : NULL;
    if (!v)
        return NULL;
    b->set = &m->values->sets[b->field->vpset];
    b->of = of;
    b->element = type_bytes(type);
    return is_within(m, b) ? v : NULL;
}

static bool is_near(const struct machine *m, const struct machine_value *v)
{
    return m->settings.near && v->buffer &&
           (sequencers_has(m, v) ? m->device->is_pocl && sequencers_are_near(m)
                                 : v->buffer->host != NULL);
}

/* A part of the block, in one array: whole rows of it, or (of a set with one axis) columns. */
struct part {
    char *at; /* its first row */
    size_t pitch, bytes;
    uint64_t rows;
    size_t outside; /* where it begins among the front end's numbers */
};

/* What there is of first .. first + count in from .. from + all. */
static uint64_t common(uint64_t first, uint64_t count, uint64_t from, uint64_t all,
                       uint64_t *begin)
{
    const uint64_t end = first + count < from + all ? first + count : from + all;
    *begin = first > from ? first : from;
    return end > *begin ? end - *begin : 0;
}

static struct part part_of(const struct block *b, const struct device_buffer *array,
                           const struct band *band, size_t pitch)
{
    const struct machine_block *of = b->of;
    uint64_t row, column;
    struct part p = {.pitch = band->set.pitch * b->element};
    p.rows = common(of->row, of->rows, band->row, band->set.rows, &row);
    p.bytes = common((uint64_t)of->column, (uint64_t)of->columns, band->column,
                     (uint64_t)band->set.width, &column) *
              b->element;
    if (!p.rows || !p.bytes)
        return (struct part){.rows = 0};
    p.at = (char *)array->host + (row - band->row) * p.pitch +
           (band->at + (size_t)(column - band->column)) * b->element;
    p.outside = (row - of->row) * pitch + (column - (uint64_t)of->column) * b->element;
    return p;
}

/* ---- out ---- */

static void parts_out(struct machine *m, const struct block *b, const struct array_blocks *a,
                      unsigned char *out, size_t pitch)
{
    for (int i = 0; i < a->count; i++) {
        const struct band band = sequencers_band(m, a->set, i);
        const struct part p = part_of(b, a->of[i], &band, pitch);
        for (uint64_t row = 0; row < p.rows; row++)
            memcpy(out + p.outside + row * pitch, p.at + row * p.pitch, p.bytes);
    }
}

enum machine_status machine_block_download(struct machine *m, uint32_t field,
                                           struct machine_type type,
                                           const struct machine_block *of, void *out,
                                           size_t pitch)
{
    struct block b;
    struct machine_value *v = block_find(m, field, type, of, &b);
    if (!v)
        return m->status;
    if (v->op != NODE_CONSTANT)
        v = materialise_in_blocks(m, b.field->vpset, v);
    if (!v)
        return m->status;
    const size_t bytes = row_bytes(&b);
    if (!is_near(m, v)) {
        unsigned char *dense = dense_get(m, field, type, &b);
        for (uint64_t i = 0; dense && i < of->rows; i++)
            memcpy((unsigned char *)out + i * pitch, dense + dense_at(&b, i), bytes);
        free(dense);
        return m->status;
    }
    if (m->watch)
        watch_bytes(m, of->rows * bytes);
    if (device_settle_for(m, "reading a field"))
        return m->status;
    if (sequencers_has(m, v)) {
        parts_out(m, &b, v->buffer->blocks, out, pitch);
        return MACHINE_OK;
    }
    const unsigned char *from = v->buffer->host;
    from += (of->row * b.set->pitch + (size_t)(b.set->halo + of->column)) * b.element;
    for (uint64_t i = 0; i < of->rows; i++)
        memcpy((unsigned char *)out + i * pitch, from + i * b.set->pitch * b.element, bytes);
    return MACHINE_OK;
}

/* ---- in ---- */

/* The other end of a row, into its halos, where something from column `from` on was written. */
static void halos_write(const struct vpset *s, unsigned char *row, size_t element, size_t from,
                        size_t bytes)
{
    const size_t width = (size_t)s->width * element, halo = (size_t)s->halo * element;
    if (from < halo || from + bytes > width - halo) {
        memcpy(row - halo, row + width - halo, halo);
        memcpy(row + width, row, halo);
    }
}

/* Into each block's own rows. Ghosts are fetched when they are looked at. */
static void parts_in(struct machine *m, const struct block *b, struct array_blocks *a,
                     const unsigned char *in, size_t pitch, struct machine_type type)
{
    for (int i = 0; i < a->count; i++) {
        const struct band band = sequencers_band(m, a->set, i);
        const struct part p = part_of(b, a->of[i], &band, pitch);
        const size_t from = (size_t)b->of->column * b->element;
        for (uint64_t k = 0; k < p.rows; k++) {
            unsigned char *at = (unsigned char *)p.at + k * p.pitch;
            memcpy(at, in + p.outside + k * pitch, p.bytes);
            observe_mask(at, p.bytes / b->element, type);
            if (band.set.rank > 1)
                halos_write(&band.set, at - from, b->element, from, p.bytes);
        }
    }
    a->valid = 0;
}

/* Rows with their halos. */
static void rows_write(const struct block *b, unsigned char *to, const unsigned char *in,
                       size_t pitch, struct machine_type type)
{
    const size_t halo = (size_t)b->set->halo * b->element,
                 from = (size_t)b->of->column * b->element, bytes = row_bytes(b);
    for (uint64_t i = 0; i < b->of->rows; i++) {
        unsigned char *row = to + (b->of->row + i) * b->set->pitch * b->element + halo;
        memcpy(row + from, in + i * pitch, bytes);
        observe_mask(row + from, (uint64_t)b->of->columns, type);
        halos_write(b->set, row, b->element, from, bytes);
    }
}

static enum machine_status dense_upload(struct machine *m, uint32_t field,
                                        struct machine_type type, const struct block *b,
                                        const void *in, size_t pitch)
{
    unsigned char *dense = dense_get(m, field, type, b);
    if (!dense)
        return m->status;
    for (uint64_t i = 0; i < b->of->rows; i++)
        memcpy(dense + dense_at(b, i), (const unsigned char *)in + i * pitch, row_bytes(b));
    enum machine_status status = machine_field_upload(m, field, type, dense);
    free(dense);
    return status;
}

enum machine_status machine_block_upload(struct machine *m, uint32_t field,
                                         struct machine_type type,
                                         const struct machine_block *of, const void *in,
                                         size_t pitch)
{
    struct block b;
    struct machine_value *v = block_find(m, field, type, of, &b);
    if (!v)
        return m->status;
    v = type.s ? v : materialise_in_blocks(m, b.field->vpset, v);
    if (!v)
        return m->status;
    if (type.s || !is_near(m, v))
        return dense_upload(m, field, type, &b, in, pitch);
    bool strange = v->strange_nan;
    for (uint64_t i = 0; i < of->rows && !strange; i++)
        strange = materialise_has_strange_nan(type, (const unsigned char *)in + i * pitch,
                                              (uint64_t)of->columns);
    v = observe_own(m, b.field, b.offset, v);
    if (!v)
        return m->status;
    if (m->watch)
        watch_bytes(m, of->rows * row_bytes(&b));
    if (device_settle_for(m, "writing a field"))
        return m->status;
    v->strange_nan = strange;
    if (sequencers_has(m, v))
        parts_in(m, &b, v->buffer->blocks, in, pitch, type);
    else
        rows_write(&b, v->buffer->host, in, pitch, type);
    return machine_field_store(m, field, v, MACHINE_EVERYWHERE);
}
