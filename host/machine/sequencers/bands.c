/* bands.c - arrays in blocks, looked at and written without being put together: see
 * sequencers.h.
 *
 *     a set        0 1 2 3 4 5 6 7 8 9
 *     bands        0 1 2 3 4 | 5 6 7 8 9      own planes: who reads a field takes them one after the other
 *     writing      whole arrays with all ghosts; a single number into each block that has its plane */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/types.h"
#include "sequencers/sequencers.h"
#include "watch/watch.h"

struct band sequencers_band(struct machine *m, int set, int block)
{
    const struct cut *c = sequencers_cut(m, set);
    const uint64_t own = c->first[block + 1] - c->first[block];
    struct band b = {.set = *sequencers_set(m, set)};
    const uint64_t plane = b.set.count / c->height, rows = b.set.rows / c->height;
    b.index = c->first[block] * plane;
    b.set.dimensions[0] = (int)own;
    b.set.count = own * plane;
    if (b.set.rank == 1) {
        b.column = c->first[block];
        b.set.width = (int)own;
        b.at = (size_t)b.set.halo + (size_t)c->ghosts;
    } else {
        b.row = c->first[block] * rows;
        b.set.rows = own * rows;
        b.at = (uint64_t)c->ghosts * rows * b.set.pitch + (size_t)b.set.halo;
    }
    return b;
}

/* ---- whole arrays ---- */

/* Rows with their halos. */
static void rows_put(const struct vpset *s, unsigned char *to, const unsigned char *in,
                     uint64_t rows, size_t element)
{
    const size_t width = (size_t)s->width * element, halo = (size_t)s->halo * element;
    for (uint64_t i = 0; i < rows; i++) {
        unsigned char *row = to + i * s->pitch * element + halo;
        memcpy(row, in + i * width, width);
        memcpy(row - halo, row + width - halo, halo);
        memcpy(row + width, row, halo);
    }
}

/* A block's planes and ghosts, of dense numbers. */
static void image_make(const struct cut *c, const struct vpset *local, int block,
                       unsigned char *image, const unsigned char *in, size_t element)
{
    const size_t plane = local->count / c->height * element,
                 rows = local->rank == 1 ? 0 : local->rows / c->height;
    for (uint64_t done = 0, count; done < c->height; done += count) {
        const uint64_t from = (cut_first(c, block) + done) % c->length;
        count = c->length - from < c->height - done ? c->length - from : c->height - done;
        if (local->rank == 1)
            memcpy(image + ((size_t)local->halo + done) * element, in + from * element,
                   count * element);
        else
            rows_put(local, image + done * rows * local->pitch * element, in + from * plane,
                     count * rows, element);
    }
}

static enum machine_status block_upload(struct machine *m, const struct cut *c,
                                        const struct vpset *local, int block,
                                        const struct device_buffer *b, const void *in,
                                        size_t element)
{
    if (m->settings.near && b->host) {
        image_make(c, local, block, b->host, in, element);
        return MACHINE_OK;
    }
    unsigned char *image = calloc(1, b->bytes);
    if (!image)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to write a block");
    image_make(c, local, block, image, in, element);
    enum machine_status status = device_write(m, b, 0, image, b->bytes, "writing a field");
    free(image);
    return status;
}

struct device_buffer *sequencers_array_full(struct machine *m, int set,
                                            struct machine_type type)
{
    const struct cut *c = sequencers_cut(m, set);
    struct device_buffer *b = sequencers_array(m, set, type);
    if (!b)
        return NULL;
    b->blocks->valid = c->ghosts;
    for (int i = 0; i < m->sequencers->count; i++) {
        struct device_buffer *memory = sequencers_block_get(m, set, i, type);
        if (!memory) {
            device_buffer_unref(m, b);
            return NULL;
        }
        sequencers_array_gets(b, i, memory);
    }
    return b;
}

/* The array, unless something went wrong. */
static struct device_buffer *good(struct machine *m, struct device_buffer *b,
                                  enum machine_status status)
{
    if (!status)
        return b;
    device_buffer_unref(m, b);
    return NULL;
}

struct device_buffer *sequencers_upload(struct machine *m, int set, struct machine_type type,
                                        const void *in)
{
    struct device_buffer *b = sequencers_array_full(m, set, type);
    if (!b)
        return NULL;
    if (m->watch)
        watch_bytes(m, m->values->sets[set].count * type_bytes(type));
    enum machine_status status = device_settle_for(m, "writing a field");
    for (int i = 0; i < b->blocks->count && !status; i++)
        status = block_upload(m, sequencers_cut(m, set), sequencers_set(m, set), i,
                              b->blocks->of[i], in, type_bytes(type));
    return good(m, b, status);
}

struct device_buffer *sequencers_fill(struct machine *m, int set, struct machine_type type,
                                      const void *pattern)
{
    struct device_buffer *b = sequencers_array_full(m, set, type);
    enum machine_status status = MACHINE_OK;
    for (int i = 0; b && i < b->blocks->count && !status; i++)
        status = device_fill(m, b->blocks->of[i], pattern, type_bytes(type), "filling a field");
    return b ? good(m, b, status) : NULL;
}

struct device_buffer *sequencers_copy(struct machine *m, const struct device_buffer *b)
{
    const struct array_blocks *a = b->blocks;
    struct device_buffer *copy = sequencers_array_full(m, a->set, a->type);
    enum machine_status status = MACHINE_OK;
    if (!copy)
        return NULL;
    copy->blocks->valid = a->valid;
    for (int i = 0; i < a->count && !status; i++)
        status =
            device_copy(m, a->of[i], copy->blocks->of[i], a->of[i]->bytes, "copying a field");
    return good(m, copy, status);
}

/* ---- single processors ---- */

struct owned sequencers_owner(struct machine *m, const struct device_buffer *b, uint64_t index)
{
    const struct array_blocks *a = b->blocks;
    const struct vpset *local = sequencers_set(m, a->set);
    const struct cut *c = sequencers_cut(m, a->set);
    const uint64_t plane = local->count / c->height;
    uint64_t at;
    const int owner = cut_owner(c, a->count, index / plane, &at);
    return (struct owned){a->of[owner], at, geometry_place(local, at * plane + index % plane)};
}

enum machine_status sequencers_read(struct machine *m, const struct device_buffer *b,
                                    uint64_t index, void *out)
{
    const struct owned owned = sequencers_owner(m, b, index);
    const size_t element = b->blocks->element;
    return device_read(m, owned.b, owned.place * element, out, element, "reading a processor");
}

enum machine_status sequencers_write(struct machine *m, const struct device_buffer *b,
                                     uint64_t index, const void *number)
{
    const struct array_blocks *a = b->blocks;
    const struct vpset *local = sequencers_set(m, a->set);
    const struct cut *c = sequencers_cut(m, a->set);
    const uint64_t plane = local->count / c->height;
    enum machine_status status = MACHINE_OK;
    for (int i = 0; i < a->count; i++)
        for (uint64_t at = (index / plane + c->length - cut_first(c, i)) % c->length;
             at < c->height; at += c->length) {
            size_t places[3];
            const int count = geometry_places(local, at * plane + index % plane, places);
            for (int k = 0; k < count && !status; k++)
                status = device_write(m, a->of[i], places[k] * a->element, number, a->element,
                                      "writing a processor");
        }
    return status;
}
