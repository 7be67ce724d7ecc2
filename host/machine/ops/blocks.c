/* blocks.c - blocks of fields, in and out. Where the front end can look into the device's memory it touches nothing but the block. */
#include <stdlib.h>
#include <string.h>

#include "access/settle.h"
#include "base/errors.h"
#include "base/types.h"
#include "ops/observe.h"
#include "run/materialise.h"
#include "values/graph.h"
#include "watch/watch.h"

struct block {
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

/* Between an array as machine_field_download() has it and the caller's rows. */
static void dense_copy(const struct block *b, unsigned char *dense, unsigned char *rows,
                       size_t pitch, bool out)
{
    const size_t bytes = (size_t)b->of->columns * b->element,
                 row_bytes = (size_t)b->set->width * b->element;
    for (uint64_t i = 0; i < b->of->rows; i++) {
        unsigned char *at =
            dense + (b->of->row + i) * row_bytes + (size_t)b->of->column * b->element;
        memcpy(out ? rows + i * pitch : at, out ? at : rows + i * pitch, bytes);
    }
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

/* ---- out ---- */

enum machine_status machine_block_download(struct machine *m, uint32_t field,
                                           struct machine_type type,
                                           const struct machine_block *of, void *out,
                                           size_t pitch)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    struct machine_value *v =
        f ? machine_field_value(m, field, type, MACHINE_EVERYWHERE) : NULL;
    if (!v)
        return m->status;
    const struct block b = {&m->values->sets[f->vpset], of, type_bytes(type)};
    if (!is_within(m, &b))
        return m->status;
    if (v->op != NODE_CONSTANT)
        v = materialise(m, f->vpset, v);
    if (!v)
        return m->status;
    if (!m->settings.near || !v->buffer || !v->buffer->host) {
        unsigned char *dense = dense_get(m, field, type, &b);
        if (dense)
            dense_copy(&b, dense, out, pitch, true);
        free(dense);
        return m->status;
    }
    const size_t bytes = (size_t)of->columns * b.element;
    if (m->watch)
        watch_bytes(m, of->rows * bytes);
    if (device_settle_for(m, "reading a field"))
        return m->status;
    const unsigned char *from = v->buffer->host;
    from += (of->row * b.set->pitch + (size_t)(b.set->halo + of->column)) * b.element;
    for (uint64_t i = 0; i < of->rows; i++)
        memcpy((unsigned char *)out + i * pitch, from + i * b.set->pitch * b.element, bytes);
    return MACHINE_OK;
}

/* ---- in ---- */

/* Rows with their halos. */
static void rows_write(const struct block *b, unsigned char *to, const unsigned char *in,
                       size_t pitch, struct machine_type type)
{
    const size_t width = (size_t)b->set->width * b->element,
                 halo = (size_t)b->set->halo * b->element,
                 from = (size_t)b->of->column * b->element,
                 bytes = (size_t)b->of->columns * b->element;
    for (uint64_t i = 0; i < b->of->rows; i++) {
        unsigned char *row = to + (b->of->row + i) * b->set->pitch * b->element + halo;
        memcpy(row + from, in + i * pitch, bytes);
        observe_mask(row + from, (uint64_t)b->of->columns, type);
        if (from < halo || from + bytes > width - halo) {
            memcpy(row - halo, row + width - halo, halo);
            memcpy(row + width, row, halo);
        }
    }
}

static enum machine_status dense_upload(struct machine *m, uint32_t field,
                                        struct machine_type type, const struct block *b,
                                        const void *in, size_t pitch)
{
    unsigned char *dense = dense_get(m, field, type, b);
    union {
        const void *in;
        unsigned char *rows; /* dense_copy() only reads them */
    } source = {.in = in};
    if (!dense)
        return m->status;
    dense_copy(b, dense, source.rows, pitch, false);
    enum machine_status status = machine_field_upload(m, field, type, dense);
    free(dense);
    return status;
}

enum machine_status machine_block_upload(struct machine *m, uint32_t field,
                                         struct machine_type type,
                                         const struct machine_block *of, const void *in,
                                         size_t pitch)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    struct machine_value *v =
        f ? machine_field_value(m, field, type, MACHINE_EVERYWHERE) : NULL;
    if (!v)
        return m->status;
    const struct block b = {&m->values->sets[f->vpset], of, type_bytes(type)};
    if (!is_within(m, &b))
        return m->status;
    v = type.s ? v : materialise(m, f->vpset, v);
    if (!v)
        return m->status;
    if (type.s || !m->settings.near || !v->buffer || !v->buffer->host)
        return dense_upload(m, field, type, &b, in, pitch);
    bool strange = v->strange_nan;
    for (uint64_t i = 0; i < of->rows && !strange; i++)
        strange = materialise_has_strange_nan(type, (const unsigned char *)in + i * pitch,
                                              (uint64_t)of->columns);
    v = observe_own(m, f, offset, v);
    if (!v)
        return m->status;
    if (m->watch)
        watch_bytes(m, of->rows * (size_t)of->columns * b.element);
    if (device_settle_for(m, "writing a field"))
        return m->status;
    v->strange_nan = strange;
    rows_write(&b, v->buffer->host, in, pitch, type);
    return machine_field_store(m, field, v, MACHINE_EVERYWHERE);
}
