/* buffers.c - device memory.
 *
 * Every step makes new versions of values and drops old ones, so released buffers are kept
 * in a pool by size. The queue is in order, so a buffer can be reused as soon as its last
 * reference is gone. Arrays that begin at the same offset from a page compete for the same
 * cache sets (sweeps over large sheets are 1.5 to 2 times slower). So each array is a
 * sub-buffer that begins at another multiple of 128 bytes.
 */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/errors.h"
#include "base/parts.h"
#include "device/device.h"

void device_pool_empty(struct device *d)
{
    for (int i = 0; i < d->pool_count; i++) {
        clReleaseMemObject(d->pool[i]->mem);
        free(d->pool[i]);
    }
    d->pool_count = 0;
    d->pool_bytes = 0;
}

static void CL_CALLBACK memory_free(cl_mem memory, void *address)
{
    (void)memory;
    free(address);
}

enum { WASTE_LEAST_PART = 8 };

/* A CPU reads and writes many rows of many arrays at the same time, each in a page of its own: large ones are in
 * large pages where the system has them, or looking for pages takes as long as computing. */
static cl_mem memory_get(const struct device *d, struct rows rows, void **host, cl_int *error)
{
    void *address;
    *host = NULL;
    size_t bytes = rows.bytes, skipped = -rows.first % LINE_BYTES;
    size_t page = d->shape.large_page_bytes;
    bool large = bytes >= page;
    if (!d->is_cpu || (!d->is_pocl && !large && !skipped))
        return clCreateBuffer(d->context, CL_MEM_READ_WRITE, bytes, NULL, error);
    *error = CL_OUT_OF_HOST_MEMORY;
    size_t whole = skipped + bytes, up = (whole + page - 1) / page * page;
    if (large && up - whole <= whole / WASTE_LEAST_PART) /* it ends where a large page does */
        whole = up;
    if (posix_memalign(&address, large ? page : DEVICE_GUARD_BYTES, whole))
        return NULL;
#ifdef MADV_HUGEPAGE
    if (large)
        madvise(address, whole / page * page, MADV_HUGEPAGE);
#endif
    cl_mem memory = clCreateBuffer(d->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                                   (char *)address + skipped, error);
    if (!*error)
        *error = clSetMemObjectDestructorCallback(memory, memory_free, address);
    if (!*error && d->is_pocl) /* it computes where the memory is */
        *host = (char *)address + skipped;
    if (!*error)
        return memory;
    if (memory)
        clReleaseMemObject(memory);
    free(address);
    return NULL;
}

/* ---- chunks ---- */

/* A page that the system gives when it is first written costs more than all that is computed there, and a large one some times as much as a
 * small one. So arrays up to half a large page are parts of chunks: the smallest of one that is written when the machine is made, others
 * of large pages. A chunk is freed with its last part, when the device takes no more of it. */
struct chunk {
    char *memory;
    size_t bytes, used;
    _Atomic int parts; /* and the device, while it takes parts of it */
};

enum {
    SMALL_CHUNK_BYTES = 512 << 10,
    SMALL_MOST = 32 << 10,    /* of an array */
    MIDDLE_LEAST = 128 << 10, /* ... in large pages */
    PAGE_BYTES = 4096
};

static struct chunk *chunk_create(size_t bytes, size_t page)
{
    struct chunk *c = calloc(1, sizeof *c);
    void *memory;
    if (!c || posix_memalign(&memory, page, bytes)) {
        free(c);
        return NULL;
    }
    *c = (struct chunk){
        .memory = memory, .bytes = bytes, .used = DEVICE_GUARD_BYTES, .parts = 1};
#ifdef MADV_HUGEPAGE
    if (page > PAGE_BYTES)
        madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return c;
}

static void chunk_leave(struct chunk *c)
{
    if (!c || atomic_fetch_sub(&c->parts, 1) > 1)
        return;
    free(c->memory);
    free(c);
}

static void CL_CALLBACK part_leave(cl_mem part, void *chunk)
{
    (void)part;
    chunk_leave(chunk);
}

void device_chunks_begin(struct device *d)
{
#ifndef LUTETIA_FUZZ /* ASan should see where each array ends */
    if (d->is_pocl)
        d->small = chunk_create(SMALL_CHUNK_BYTES, PAGE_BYTES);
    if (d->small)
        memset(d->small->memory, 0, SMALL_CHUNK_BYTES);
#else
    (void)d;
#endif
}

void device_chunks_finish(struct device *d)
{
    chunk_leave(d->small);
    chunk_leave(d->middle);
    d->small = d->middle = NULL;
}

/* Where the next part would begin: as far from the beginning of its page as arrays with memory of their own (see skew_room()), and so that the first
 * column begins a line. 0: there is no room. */
static size_t chunk_place(const struct device *d, const struct chunk *c, struct rows rows)
{
    const size_t page = d->shape.skew_page_bytes,
                 offset = d->shape.skew_bytes * d->skew % page + -rows.first % LINE_BYTES,
                 at = c->used + (offset - c->used) % page;
    return at + rows.bytes <= c->bytes - DEVICE_GUARD_BYTES ? at : 0;
}

/* The chunk for an array; NULL: it has memory of its own. */
static struct chunk *chunk_of(struct device *d, struct rows rows)
{
    const size_t page = d->shape.large_page_bytes;
    if (d->small && rows.bytes <= SMALL_MOST && chunk_place(d, d->small, rows))
        return d->small;
    if (!d->small || rows.bytes < MIDDLE_LEAST || rows.bytes > page / 2)
        return NULL;
    if (!d->middle || !chunk_place(d, d->middle, rows)) {
        chunk_leave(d->middle);
        d->middle = chunk_create(page, page);
    }
    return d->middle && chunk_place(d, d->middle, rows) ? d->middle : NULL;
}

static cl_mem part_get(struct device *d, struct rows rows, void **host)
{
    struct chunk *c = chunk_of(d, rows);
    if (!c)
        return NULL;
    const size_t at = chunk_place(d, c, rows);
    cl_int error;
    cl_mem part = clCreateBuffer(d->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                                 rows.bytes, c->memory + at, &error);
    if (error)
        return NULL;
    atomic_fetch_add(&c->parts, 1);
    if (clSetMemObjectDestructorCallback(part, part_leave, c)) {
        clReleaseMemObject(part);
        chunk_leave(c);
        return NULL;
    }
    c->used = at + rows.bytes;
    d->skew++;
    *host = c->memory + at;
    return part;
}

/* ---- arrays ---- */

/* The range of offsets from a page at which arrays begin. The offsets of any nine arrays in a row differ by 384 bytes
 * or more (sub-buffers begin at multiples of 128). The offsets also spread the rows of many
 * large arrays over the sets of a cache. */
static size_t skew_room(const struct device_shape *shape, size_t bytes)
{
    return bytes < shape->large_page_bytes ? shape->skew_page_bytes : shape->skew_large_bytes;
}

struct device_buffer *device_buffer_get(struct machine *m, size_t bytes)
{
    return device_rows_get(m, (struct rows){bytes, 0});
}

bool device_rows_fit(const struct device_buffer *b, struct rows rows)
{
    return b->bytes == rows.bytes && b->first == rows.first % LINE_BYTES;
}

static struct device_buffer *buffer_begin(struct device *d, struct device_buffer *b,
                                          struct rows rows)
{
    b->bytes = rows.bytes;
    b->first = rows.first;
    b->refs = 1;
    d->held_bytes += rows.bytes;
    return b;
}

struct device_buffer *device_rows_get(struct machine *m, struct rows rows)
{
    struct device *d = m->device;
    size_t bytes = rows.bytes;
    rows.first %= LINE_BYTES;
    for (int i = d->pool_count - 1; i >= 0; i--)
        if (device_rows_fit(d->pool[i], rows)) {
            struct device_buffer *b = d->pool[i];
            d->pool[i] = d->pool[--d->pool_count];
            d->pool_bytes -= bytes;
            d->held_bytes += bytes;
            b->refs = 1;
            return b;
        }
    size_t whole = bytes + skew_room(&d->shape, bytes) + 2 * DEVICE_GUARD_BYTES;
    if (whole > d->memory_max_alloc_bytes || d->held_bytes + whole > d->memory_bytes) {
        device_pool_empty(d);
        machine_fail(
            m, MACHINE_NO_MEMORY,
            "%.1f MB more for one field do not fit in the memory of %s (%.0f MB, %.0f in use)",
            1e-6 * (double)whole, d->name, 1e-6 * (double)d->memory_bytes,
            1e-6 * (double)d->held_bytes);
        return NULL;
    }
    struct device_buffer *b = calloc(1, sizeof *b);
    cl_int error = CL_OUT_OF_HOST_MEMORY;
    void *host = NULL;
    if (b && (b->mem = part_get(d, rows, &b->host)))
        return buffer_begin(d, b, rows);
    cl_mem parent = b ? memory_get(d, (struct rows){whole, rows.first}, &host, &error) : NULL;
    if (error && d->pool_count) {
        m->inside++;
        clFinish(d->queue);
        m->inside--;
        device_pool_empty(d);
        parent = b ? memory_get(d, (struct rows){whole, rows.first}, &host, &error) : NULL;
    }
    if (!error) {
        cl_buffer_region region = {.origin =
                                       DEVICE_GUARD_BYTES + d->shape.skew_bytes * d->skew++ %
                                                                skew_room(&d->shape, bytes),
                                   .size = bytes};
        b->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                   &region, &error);
        if (error) { /* the device rejects this alignment */
            region.origin = DEVICE_GUARD_BYTES;
            b->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                       &region, &error);
        }
        b->host = host && !error ? (char *)host + region.origin : NULL;
        clReleaseMemObject(parent); /* lives as long as the part of it does */
    }
    if (error) {
        free(b);
        device_check(m, error, "memory for a field");
        return NULL;
    }
    return buffer_begin(d, b, rows);
}

void device_buffer_ref(struct device_buffer *b)
{
    b->refs++;
}

void device_buffer_unref(struct machine *m, struct device_buffer *b)
{
    struct device *d = m->device;
    if (--b->refs)
        return;
    d->held_bytes -= b->bytes;
    if (d->pool_count == d->pool_capacity) {
        int capacity = d->pool_capacity ? 2 * d->pool_capacity : 64;
        struct device_buffer **pool = realloc(d->pool, (size_t)capacity * sizeof *pool);
        if (pool) {
            d->pool = pool;
            d->pool_capacity = capacity;
        }
    }
    if (d->pool_count == d->pool_capacity || d->pool_bytes + b->bytes > d->shape.pool_bytes) {
        clReleaseMemObject(b->mem);
        free(b);
        return;
    }
    d->pool[d->pool_count++] = b;
    d->pool_bytes += b->bytes;
}
