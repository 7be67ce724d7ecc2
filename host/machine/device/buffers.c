/* buffers.c - device memory.
 *
 * Every step makes new versions of values and drops old ones, so released buffers are kept
 * in a pool by size. The queue is in order, so a buffer can be reused as soon as its last
 * reference is gone. Arrays that begin at the same offset from a page compete for the same
 * cache sets (sweeps over large sheets are 1.5 to 2 times slower). So each array is a
 * sub-buffer that begins at another multiple of 128 bytes.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/errors.h"
#include "base/parts.h"
#include "device/chunks.h"
#include "device/far.h"

static void buffer_free(struct device_buffer *b)
{
    if (b->memory->mem)
        clReleaseMemObject(b->memory->mem);
    else if (b->memory->chunk)
        chunk_leave(b->memory->chunk);
    free(b);
}

void device_pool_empty(struct device *d)
{
    for (int i = 0; i < d->pool_count; i++)
        buffer_free(d->pool[i]);
    d->pool_count = 0;
    d->pool_bytes = 0;
}

static void CL_CALLBACK memory_free(cl_mem memory, void *address)
{
    (void)memory;
    free(address);
}

enum { WASTE_LEAST_PART = 8 };

/* A CPU reads and writes many rows of many arrays at the same time, each in a page of its own:
 * large ones are in large pages where the system has them, or looking for pages takes as long
 * as computing. */
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

/* ---- arrays ---- */

/* The range of offsets from a page at which arrays begin. The offsets of any nine arrays in a
 * row differ by 384 bytes or more (sub-buffers begin at multiples of 128). The offsets also
 * spread the rows of many large arrays over the sets of a cache. */
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
    b->home = d;
    b->follows = false;
    d->held_bytes += rows.bytes;
    if (d->held_bytes > d->peak_bytes)
        d->peak_bytes = d->held_bytes;
    if (rows.bytes > d->largest_bytes)
        d->largest_bytes = rows.bytes;
    return b;
}

/* Memory of its own, for an array that is no part of a chunk. */
static cl_int own_memory_get(struct machine *m, struct device_buffer *b, struct rows rows,
                             size_t whole)
{
    struct device *d = m->device;
    cl_int error;
    void *host = NULL;
    cl_mem parent = memory_get(d, (struct rows){whole, rows.first}, &host, &error);
    if (error && d->pool_count) {
        m->inside++;
        if (device_is_ours(d))
            clFinish(d->queue);
        m->inside--;
        device_pool_empty(d);
        parent = memory_get(d, (struct rows){whole, rows.first}, &host, &error);
    }
    if (error)
        return error;
    cl_buffer_region region = {.origin =
                                   DEVICE_GUARD_BYTES + d->shape.skew_bytes * d->skew++ %
                                                            skew_room(&d->shape, rows.bytes),
                               .size = rows.bytes};
    b->memory->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                       &region, &error);
    if (error) { /* the device rejects this alignment */
        region.origin = DEVICE_GUARD_BYTES;
        b->memory->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE,
                                           CL_BUFFER_CREATE_TYPE_REGION, &region, &error);
    }
    b->host = host && !error ? (char *)host + region.origin : NULL;
    clReleaseMemObject(parent); /* lives as long as the part of it does */
    return error;
}

static struct device_buffer *pool_take(struct device *d, struct rows rows)
{
    for (int i = d->pool_count - 1; i >= 0; i--)
        if (device_rows_fit(d->pool[i], rows)) {
            struct device_buffer *b = d->pool[i];
            d->pool[i] = d->pool[--d->pool_count];
            d->pool_bytes -= rows.bytes;
            return b;
        }
    return NULL;
}

/* In one piece. */
struct buffer_whole {
    struct device_buffer buffer;
    struct device_memory memory;
};

static bool fits(const struct device *d, size_t bytes)
{
    return d->held_bytes + bytes <= d->memory_bytes;
}

/* The error that so many bytes more do not fit: what holds the others, and what to do. */
static void no_room(struct machine *m, size_t bytes)
{
    struct device *d = m->device;
    char holders[512] = "";
    device_pool_empty(d);
    if (d->name_holders)
        d->name_holders(m->front ? m->front : m, holders, sizeof holders);
    machine_fail(
        m, MACHINE_NO_MEMORY,
        "%.1f MB more for one field do not fit in the memory of %s%s (%.1f MB, %.1f in "
        "use%s%s): deallocate fields, or take smaller VP sets or shorter fields",
        1e-6 * (double)bytes, m->front && m->front->device != d ? "a block's share of " : "",
        d->name, 1e-6 * (double)d->memory_bytes, 1e-6 * (double)d->held_bytes,
        *holders ? ", by " : "", holders);
}

struct device_buffer *device_rows_get(struct machine *m, struct rows rows)
{
    struct device *d = m->device;
    rows.first %= LINE_BYTES;
    struct device_buffer *b = pool_take(d, rows);
    if (b)
        return buffer_begin(d, b, rows);
    size_t whole = rows.bytes + skew_room(&d->shape, rows.bytes) + 2 * DEVICE_GUARD_BYTES;
    if (!fits(d, rows.bytes) && d->make_room && d->make_room(m->front ? m->front : m) &&
        (b = pool_take(d, rows)))
        return buffer_begin(d, b, rows);
    if (d->held_bytes + d->pool_bytes + rows.bytes > d->memory_bytes)
        device_pool_empty(d);
    if (whole > d->memory_max_alloc_bytes || !fits(d, rows.bytes)) {
        no_room(m, rows.bytes);
        return NULL;
    }
    struct buffer_whole *w = calloc(1, sizeof *w);
    cl_int error = w ? CL_SUCCESS : CL_OUT_OF_HOST_MEMORY;
    if (w) {
        b = &w->buffer;
        b->memory = &w->memory;
        b->fresh = true;
        if (!chunk_take(d, rows, b))
            error = own_memory_get(m, b, rows, whole);
    }
    if (error) {
        free(w);
        device_check(m, error, "memory for a field");
        return NULL;
    }
    return buffer_begin(d, b, rows);
}

cl_mem device_mem(const struct device_buffer *b)
{
    INVARIANT(
        b->memory); /* else somebody has not asked for it in one piece: sequencers_whole() */
    if (!b->memory->mem && b->memory->chunk)
        b->memory->mem = chunk_mem(b);
    return b->memory->mem;
}

cl_int device_argument(cl_kernel kernel, cl_uint at, const struct device_buffer *b)
{
    cl_mem mem = device_mem(b);
    return mem ? clSetKernelArg(kernel, at, sizeof mem, &mem)
               : CL_MEM_OBJECT_ALLOCATION_FAILURE;
}

void device_buffer_ref(struct device_buffer *b)
{
    b->refs++;
}

/* The blocks go; and the array with them, if it has no other memory. */
static bool ends_with_blocks(struct machine *m, struct device_buffer *b)
{
    struct array_blocks *a = b->blocks;
    const bool only = a->only;
    b->blocks = NULL;
    for (int i = 0; i < a->count; i++)
        if (a->of[i])
            device_buffer_unref(m, a->of[i]);
    if (a->whole)
        device_buffer_unref(m, a->whole);
    free(a);
    if (only)
        free(b);
    return only;
}

void device_buffer_end(struct machine *m, struct device_buffer *b)
{
    if (b->rank) {
        device_far_end(b);
        return;
    }
    if (b->blocks && ends_with_blocks(m, b))
        return;
    struct device *d = b->home;
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
        buffer_free(b);
        return;
    }
    d->pool[d->pool_count++] = b;
    d->pool_bytes += b->bytes;
}
