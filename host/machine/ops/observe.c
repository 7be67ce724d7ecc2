/* observe.c - what the front end reads and writes: whole fields, single processors. */
#include <stdlib.h>
#include <string.h>

#include "access/beyond.h"
#include "access/settle.h"
#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "device/far.h"
#include "machine_rows.h"
#include "memory/memory.h"
#include "ops/gather.h"
#include "ops/near.h"
#include "ops/observe.h"
#include "run/materialise.h"
#include "run/notes.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "watch/watch.h"

struct field *observe_field(struct machine *m, uint32_t id, struct machine_type type,
                            uint32_t *offset)
{
    settle(m);
    int bits = machine_type_bits(type);
    struct field *beyond = beyond_field(m, id, (uint32_t)bits);
    if (beyond) {
        *offset = id - beyond->base;
        return beyond;
    }
    struct field *f = field_find(m, id, offset);
    if (f && *offset + (uint32_t)bits > f->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "%d bits from bit %u on run over the end of a field of %u bits", bits,
                     *offset, f->bits);
        return NULL;
    }
    return f;
}

/* An element again and again: what there is already is copied, twice as much each time. */
static void repeat_put(unsigned char *out, size_t bytes, struct machine_scalar x,
                       size_t element)
{
    materialise_put(out, x, element);
    for (size_t done = element; done < bytes; done += done < bytes - done ? done : bytes - done)
        memcpy(out + done, out, done < bytes - done ? done : bytes - done);
}

/* Where rows of an array begin, in elements. */
struct rows_at {
    const struct device_buffer *b;
    const struct vpset *set; /* of so many rows */
    size_t at;
};

/* Dense, to the front end, which has waited where it looks itself. */
static enum machine_status rows_out(struct machine *m, struct rows_at rows, size_t element,
                                    unsigned char *out, const char *what)
{
    const struct vpset *s = rows.set;
    const size_t width = (size_t)s->width * element, pitch = s->pitch * element,
                 at = rows.at * element;
    if (rows.b->host && m->settings.near) {
        const unsigned char *from = (const unsigned char *)rows.b->host + at;
        for (uint64_t row = 0; row < s->rows; row++)
            memcpy(out + row * width, from + row * pitch, width);
        return MACHINE_OK;
    }
    size_t from[3] = {at % pitch, at / pitch, 0}, to[3] = {0, 0, 0};
    size_t region[3] = {width, s->rows, 1};
    double start = device_wait_begin(m);
    cl_int error =
        pitch == width
            ? clEnqueueReadBuffer(m->device->queue, device_mem(rows.b), CL_TRUE, at,
                                  s->count * element, out, 0, NULL, NULL)
            : clEnqueueReadBufferRect(m->device->queue, device_mem(rows.b), CL_TRUE, from, to,
                                      region, pitch, 0, region[0], 0, out, 0, NULL, NULL);
    if (m->watch)
        watch_bytes(m, s->count * element);
    return device_wait_end(m, error, start, what);
}

/* Each block's own rows, one block after the other. */
static enum machine_status blocks_out(struct machine *m, int set, const struct array_blocks *a,
                                      unsigned char *out, const char *what)
{
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < a->count && !status; i++) {
        const struct band band = sequencers_band(m, set, i);
        const struct far_rows rows = {band.at * a->element, (size_t)band.set.width * a->element,
                                      band.set.pitch * a->element, band.set.rows};
        if (band.set.count && a->of[i]->rank)
            status = device_rows_read(m, a->of[i], rows, out + band.index * a->element,
                                      rows.bytes, what);
        else if (band.set.count)
            status = rows_out(m, (struct rows_at){a->of[i], &band.set, band.at}, a->element,
                              out + band.index * a->element, what);
    }
    return status;
}

enum machine_status observe_out(struct machine *m, int set, struct machine_value *v, void *out,
                                const char *what)
{
    const struct vpset *s = &m->values->sets[set];
    size_t element = type_bytes(v->type);
    if (v->op == NODE_CONSTANT && !v->buffer) {
        repeat_put(out, s->count * element, v->imm, element);
        return MACHINE_OK;
    }
    /* Bits of floats are in the field's own array: another one would leave the field
     * waiting. */
    v = materialise_in_blocks(m, set, graph_same_bits(m, v));
    if (!v)
        return m->status;
    const bool in_blocks = sequencers_has(m, v);
    if (m->settings.near && (in_blocks ? m->device->is_pocl : v->buffer->host != NULL)) {
        if (m->watch)
            watch_bytes(m, s->count * element);
        if (device_settle_for(m, what))
            return m->status;
    }
    return in_blocks ? blocks_out(m, set, v->buffer->blocks, out, what)
                     : rows_out(m, (struct rows_at){v->buffer, s, (size_t)s->halo}, element,
                                out, what);
}

enum machine_status machine_field_download(struct machine *m, uint32_t field,
                                           struct machine_type type, void *out)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    struct machine_value *v =
        f ? machine_field_value(m, field, type, MACHINE_EVERYWHERE) : NULL;
    return v ? observe_out(m, f->vpset, v, out, "reading a field") : m->status;
}

/* The fields' values, and the set that they are all of. False: error set. */
static bool looked_values(struct machine *m, const uint32_t *fields, int count,
                          struct machine_type type, struct machine_value **values, int *set)
{
    if (count < 1 || count > MACHINE_LOOK_MAX) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "1 to %d fields are looked at (got %d)",
                     MACHINE_LOOK_MAX, count);
        return false;
    }
    for (int i = 0; i < count; i++) {
        uint32_t offset;
        const struct field *f = observe_field(m, fields[i], type, &offset);
        if (f && i && f->vpset != *set) {
            machine_fail(m, MACHINE_BAD_ARGUMENT,
                         "fields %u and %u are looked at together, and are of two VP sets",
                         fields[0], fields[i]);
            return false;
        }
        values[i] = f ? machine_field_value(m, fields[i], type, MACHINE_EVERYWHERE) : NULL;
        if (!values[i])
            return false;
        *set = f->vpset;
    }
    return true;
}

/* Those that are numbers have no rows. */
static bool looked_materialised(struct machine *m, int set, struct machine_value **values,
                                int count)
{
    struct machine_value *arrays[MACHINE_LOOK_MAX];
    int at[MACHINE_LOOK_MAX], arrays_count = 0;
    for (int i = 0; i < count; i++)
        if (values[i]->op != NODE_CONSTANT || values[i]->buffer) {
            arrays[arrays_count] = graph_same_bits(m, values[i]);
            at[arrays_count++] = i;
        }
    if (arrays_count && !materialise_all_in_blocks(m, set, arrays, arrays_count))
        return false;
    for (int i = 0; i < arrays_count; i++)
        values[at[i]] = arrays[i];
    return true;
}

enum machine_status machine_fields_look(struct machine *m, const uint32_t *fields, int count,
                                        struct machine_type type, struct machine_rows *rows)
{
    struct machine_value *values[MACHINE_LOOK_MAX];
    int set = 0;
    for (int i = 0; i < count; i++)
        rows[i] = (struct machine_rows){NULL, 0};
    if (!looked_values(m, fields, count, type, values, &set))
        return m->status;
    if (!m->settings.near)
        return MACHINE_OK;
    if (!looked_materialised(m, set, values, count) ||
        device_settle_for(m, "looking at a field"))
        return m->status;
    const struct vpset *s = &m->values->sets[set];
    for (int i = 0; i < count; i++) {
        const struct machine_value *v = values[i];
        const size_t element = type_bytes(v->type);
        if (!v->buffer || sequencers_has(m, v) || !v->buffer->host)
            continue;
        if (m->watch)
            watch_bytes(m, s->count * element);
        rows[i] = (struct machine_rows){(const unsigned char *)v->buffer->host +
                                            (size_t)s->halo * element,
                                        s->pitch * element};
    }
    return MACHINE_OK;
}

struct rows_shared {
    size_t rows;
    int parts;
    machine_rows_work *work;
    void *context;
};

static void rows_part(void *of, int part, int worker)
{
    const struct rows_shared *r = of;
    (void)worker;
    r->work(r->context, r->rows * (size_t)part / (size_t)r->parts,
            r->rows * (size_t)(part + 1) / (size_t)r->parts);
}

void machine_rows_share(struct machine *m, size_t rows, size_t row_bytes,
                        machine_rows_work *work, void *context)
{
    const double seconds = 1e-9 * m->device->shape.move_ns * (double)rows * (double)row_bytes;
    struct rows_shared r = {rows, device_parts(m, seconds), work, context};
    crew_run(m->device->crew, r.parts, rows_part, &r);
}

/* Whether an element in memory has bits that the type has not. */
static bool is_masked(struct machine_type type)
{
    return type.kind != MACHINE_FLOAT && (size_t)type.width != 8 * type_bytes(type);
}

void observe_mask(unsigned char *data, uint64_t count, struct machine_type type)
{
    size_t element = type_bytes(type);
    if (!is_masked(type))
        return;
    for (uint64_t i = 0; i < count; i++) {
        struct machine_scalar x = {0, 0};
        unsigned char *at = data + i * element;
        memcpy(&x.lo, at, element < 8 ? element : 8);
        if (element > 8)
            memcpy(&x.hi, at + 8, 8);
        materialise_put(at, scalar_cut(x, type.width), element);
    }
}

enum machine_status machine_field_upload(struct machine *m, uint32_t field,
                                         struct machine_type type, const void *in)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    uint64_t count = m->values->sets[f->vpset].count;
    size_t bytes = count * type_bytes(type);
    unsigned char *masked = is_masked(type) ? malloc(bytes) : NULL;
    if (!masked && is_masked(type))
        return machine_fail(m, MACHINE_NO_MEMORY,
                            "not enough memory to write a field of %zu bytes", bytes);
    if (masked) {
        memcpy(masked, in, bytes);
        observe_mask(masked, count, type);
    }
    struct machine_value *v = materialise_upload(m, f->vpset, type, masked ? masked : in);
    free(masked);
    return v ? machine_field_store(m, field, v, MACHINE_EVERYWHERE) : m->status;
}

enum machine_status machine_field_read(struct machine *m, uint32_t field,
                                       struct machine_type type, uint64_t index,
                                       struct machine_scalar *out)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    if (index >= m->values->sets[f->vpset].count)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no processor %llu",
                            (unsigned long long)index);
    struct machine_value *v = machine_field_value(m, field, type, MACHINE_EVERYWHERE);
    *out = (struct machine_scalar){0, 0};
    if (!v)
        return m->status;
    if (near_read(m, f->vpset, v, index, out))
        return MACHINE_OK;
    v = materialise_in_blocks(m, f->vpset, v);
    if (!v)
        return m->status;
    size_t element = type_bytes(type);
    unsigned char raw[16] = {0};
    enum machine_status status =
        sequencers_has(m, v)
            ? sequencers_read(m, v->buffer, index, raw)
            : device_read(m, v->buffer,
                          geometry_place(&m->values->sets[f->vpset], index) * element, raw,
                          element, "reading a processor");
    memcpy(&out->lo, raw, 8);
    memcpy(&out->hi, raw + 8, 8);
    return status;
}

/* Copies the content to a buffer with no other reference. */
static struct machine_value *own_copy(struct machine *m, int set, struct machine_value *v)
{
    struct rows rows = geometry_rows(&m->values->sets[set], v->type);
    const bool in_blocks = sequencers_has(m, v);
    struct device_buffer *b =
        in_blocks ? sequencers_copy(m, v->buffer) : device_rows_get(m, rows);
    if (!b)
        return NULL;
    if (!in_blocks && device_copy(m, v->buffer, b, rows.bytes, "copying a field")) {
        device_buffer_unref(m, b);
        return NULL;
    }
    return graph_buffer_node(m, v->type, set, b);
}

struct machine_value *observe_own(struct machine *m, const struct field *f, uint32_t offset,
                                  struct machine_value *v)
{
    values_before_change(m);
    if (v->op == NODE_BUFFER)
        known_addresses_changed(m, v->buffer);
    /* The slot's reference, and those of this call. An evaluation within an instruction may
     * have entered a state, so what the instruction made before and what the field holds are
     * two values with one array. */
    if (v->op != NODE_BUFFER || v->own_address || v->buffer->refs > 1 ||
        (v->buffer->blocks && v->buffer->memory) || v->refs > graph_borrowed(m, v) + 1 ||
        !field_holds(f, offset, v))
        return own_copy(m, f->vpset, v);
    return v;
}

enum machine_status machine_field_write(struct machine *m, uint32_t field,
                                        struct machine_type type, uint64_t index,
                                        struct machine_scalar value)
{
    uint32_t offset;
    if (type.s && type_good(type)) {
        value = (struct machine_scalar){type_packed_bits(value.lo, type), 0};
        type = MACHINE_UINT(machine_type_bits(type));
    }
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    const struct vpset *s = &m->values->sets[f->vpset];
    if (index >= s->count)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no processor %llu",
                            (unsigned long long)index);
    struct machine_value *v = machine_field_value(m, field, type, MACHINE_EVERYWHERE);
    enum machine_status status;
    if (v && f->base + offset == field && !beyond_field(m, field, (uint32_t)type.width) &&
        gather_write(m, f, offset, v, index, value, &status))
        return status;
    v = v ? materialise_in_blocks(m, f->vpset, v) : NULL;
    if (!v)
        return m->status;
    bool strange = v->strange_nan || materialise_has_strange_nan(type, &value.lo, 1);
    v = observe_own(m, f, offset, v);
    if (!v)
        return m->status;
    v->strange_nan = strange;
    size_t element = type_bytes(type), places[3];
    unsigned char raw[16];
    materialise_put(raw, scalar_cut(value, type.width), element);
    if (sequencers_has(m, v)) {
        if (sequencers_write(m, v->buffer, index, raw))
            return m->status;
        return machine_field_store(m, field, v, MACHINE_EVERYWHERE);
    }
    int count = geometry_places(s, index, places);
    for (int i = 0; i < count; i++)
        if (device_write(m, v->buffer, places[i] * element, raw, element,
                         "writing a processor"))
            return m->status;
    return machine_field_store(m, field, v, MACHINE_EVERYWHERE);
}
