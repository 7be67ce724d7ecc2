/* arrays.c - arrays in one piece, in blocks, or both: see sequencers.h.
 *
 * What is in both ways is only read: who writes over an array looks whether it is in blocks. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/types.h"
#include "device/far.h"
#include "sequencers/sequencers.h"

static struct array_blocks *blocks_new(struct machine *m, int set, struct machine_type type)
{
    const int count = m->sequencers->count;
    struct array_blocks *a = calloc(1, sizeof *a + (size_t)count * sizeof *a->of);
    if (!a) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an array in blocks");
        return NULL;
    }
    *a = (struct array_blocks){
        .element = type_bytes(type), .set = set, .count = count, .type = type};
    return a;
}

struct device_buffer *sequencers_array(struct machine *m, int set, struct machine_type type)
{
    const struct rows rows = geometry_rows(&m->values->sets[set], type);
    struct device_buffer *b = calloc(1, sizeof *b);
    if (!b || !(b->blocks = blocks_new(m, set, type))) {
        free(b);
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an array in blocks");
        return NULL;
    }
    b->blocks->only = true;
    b->bytes = rows.bytes;
    b->first = rows.first % LINE_BYTES;
    b->refs = 1;
    return b;
}

void sequencers_array_gets(struct device_buffer *b, int block, struct device_buffer *memory)
{
    INVARIANT(!b->blocks->of[block]);
    b->blocks->of[block] = memory;
}

struct device_buffer *sequencers_block_get(struct machine *m, int set, int block,
                                           struct machine_type type)
{
    const struct rows rows = geometry_rows(sequencers_set(m, set), type);
    return m->sequencers->far && block ? device_far_get(m, block, rows)
                                       : device_rows_get(m, rows);
}

/* ---- planes ---- */

/* An array, and the set that it is of in its machine. */
struct side {
    const struct device_buffer *b;
    const struct vpset *s;
};

/* Where a plane is, in bytes, or how many that many planes have. */
static size_t plane_at(const struct vpset *s, size_t element, uint64_t plane)
{
    if (s->rank == 1)
        return ((size_t)s->halo + plane) * element;
    return s->rows / (uint64_t)s->dimensions[0] * plane * s->pitch * element;
}

static enum machine_status bytes_move(struct machine *m, const struct device_buffer *from,
                                      size_t from_at, const struct device_buffer *to,
                                      size_t to_at, size_t bytes)
{
    if (!bytes) /* a block without planes of its own, which OpenCL refuses to copy */
        return MACHINE_OK;
    if (from->rank || to->rank)
        return device_move_far(m, from, from_at, to, to_at, bytes);
    if (m->settings.near && from->host && to->host) {
        enum machine_status status = device_settle(m);
        if (!status)
            device_move(m, (char *)to->host + to_at, (const char *)from->host + from_at, bytes);
        return status;
    }
    void *between = malloc(bytes);
    if (!between)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to move a block");
    enum machine_status status =
        device_read(m, from, from_at, between, bytes, "reading a block");
    status = status ? status : device_write(m, to, to_at, between, bytes, "writing a block");
    free(between);
    return status;
}

/* count planes from plane p on to plane q and so on. Both have the same rows. */
static enum machine_status planes_move(struct machine *m, struct side from, uint64_t p,
                                       struct side to, uint64_t q, uint64_t count,
                                       size_t element)
{
    const size_t at = plane_at(from.s, element, p);
    return bytes_move(m, from.b, at, to.b, plane_at(to.s, element, q),
                      plane_at(from.s, element, p + count) - at);
}

/* The other end of the only row, on both sides. */
static enum machine_status halos_make(struct machine *m, struct side whole, size_t element)
{
    const size_t halo = (size_t)whole.s->halo, width = (size_t)whole.s->width;
    if (whole.s->rank > 1 || !halo)
        return MACHINE_OK;
    enum machine_status status =
        bytes_move(m, whole.b, width * element, whole.b, 0, halo * element);
    return status ? status
                  : bytes_move(m, whole.b, halo * element, whole.b, (halo + width) * element,
                               halo * element);
}

static struct side block_of(struct machine *m, const struct array_blocks *a, int block)
{
    return (struct side){a->of[block], sequencers_set(m, a->set)};
}

/* ---- ghosts ---- */

/* Planes of a block's array, from that one on, which are other blocks' (or its own, once more
 * round the torus). */
static enum machine_status ghosts_fetch(struct machine *m, const struct array_blocks *a,
                                        const struct cut *c, int block, uint64_t from,
                                        uint64_t count)
{
    enum machine_status status = MACHINE_OK;
    while (count && !status) {
        uint64_t plane = (cut_first(c, block) + from) % c->length, at;
        const int owner = cut_owner(c, a->count, plane, &at);
        uint64_t together = c->first[owner + 1] - plane;
        together = together < count ? together : count;
        status = planes_move(m, block_of(m, a, owner), at, block_of(m, a, block), from,
                             together, a->element);
        from += together;
        count -= together;
    }
    return status;
}

/* What went between ranks has arrived. */
static enum machine_status moved(struct machine *m, enum machine_status status)
{
    const enum machine_status at_end = m->sequencers->far ? device_moves_end(m) : MACHINE_OK;
    return status ? status : at_end;
}

static enum machine_status exchange(struct machine *m, struct array_blocks *a)
{
    const struct cut *c = sequencers_cut(m, a->set);
    const uint64_t all = (uint64_t)c->ghosts, fetched = all - (uint64_t)a->valid;
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < a->count && !status; i++) {
        const uint64_t own = c->first[i + 1] - c->first[i];
        status = ghosts_fetch(m, a, c, i, 0, fetched);
        status =
            status ? status : ghosts_fetch(m, a, c, i, all + own + (uint64_t)a->valid, fetched);
    }
    status = moved(m, status);
    if (!status) {
        a->valid = c->ghosts;
        m->sequencers->exchanged++;
    }
    return status;
}

/* ---- whole, and in blocks ---- */

/* A block's planes with all its ghosts, of an array in one piece. */
static enum machine_status block_fill(struct machine *m, struct side whole,
                                      const struct array_blocks *a, const struct cut *c,
                                      int block)
{
    enum machine_status status = MACHINE_OK;
    for (uint64_t done = 0; done < c->height && !status;) {
        const uint64_t plane = (cut_first(c, block) + done) % c->length;
        uint64_t count = c->length - plane;
        count = count < c->height - done ? count : c->height - done;
        status = planes_move(m, whole, plane, block_of(m, a, block), done, count, a->element);
        done += count;
    }
    return status;
}

static void blocks_free(struct machine *m, struct array_blocks *a)
{
    for (int i = 0; i < a->count; i++)
        if (a->of[i])
            device_buffer_unref(m, a->of[i]);
    free(a);
}

enum machine_status sequencers_divide(struct machine *m, struct device_buffer *b, int set,
                                      struct machine_type type, int ghosts)
{
    const struct cut *c = sequencers_cut(m, set);
    if (b->blocks)
        return b->blocks->valid >= ghosts ? MACHINE_OK : exchange(m, b->blocks);
    struct array_blocks *a = blocks_new(m, set, type);
    if (!a)
        return m->status;
    const struct side whole = {b, &m->values->sets[set]};
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < a->count && !status; i++) {
        a->of[i] = sequencers_block_get(m, set, i, type);
        status = a->of[i] ? block_fill(m, whole, a, c, i) : m->status;
    }
    status = moved(m, status);
    if (status) {
        blocks_free(m, a);
        return status;
    }
    a->valid = c->ghosts;
    b->blocks = a;
    m->sequencers->divided++;
    return MACHINE_OK;
}

enum machine_status sequencers_whole(struct machine *m, struct device_buffer *b)
{
    struct array_blocks *a = b ? b->blocks : NULL;
    if (!a || b->memory)
        return MACHINE_OK;
    const struct cut *c = sequencers_cut(m, a->set);
    const struct vpset *s = &m->values->sets[a->set];
    struct device_buffer *whole = device_rows_get(m, geometry_rows(s, a->type));
    if (!whole)
        return m->status;
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < a->count && !status; i++)
        status = planes_move(m, block_of(m, a, i), (uint64_t)c->ghosts, (struct side){whole, s},
                             c->first[i], c->first[i + 1] - c->first[i], a->element);
    status = moved(m, status);
    status = status ? status : halos_make(m, (struct side){whole, s}, a->element);
    if (status) {
        device_buffer_unref(m, whole);
        return status;
    }
    a->whole = whole;
    b->memory = whole->memory;
    b->host = whole->host;
    m->sequencers->gathered++;
    return MACHINE_OK;
}
