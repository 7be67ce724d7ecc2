/* chunks.c - see chunks.h. */
#include "device/chunks.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

struct chunk {
    cl_context context;
    char *memory, *mapped;
    size_t bytes, mapped_bytes, used;
    _Atomic int parts; /* and the device, while it takes parts of it; and who writes it */
};

static struct chunk *chunk_create(const struct device *d, size_t bytes, size_t page)
{
    struct chunk *c = calloc(1, sizeof *c);
    const size_t mapped_bytes = bytes + page - PAGE_BYTES;
    char *mapped =
        c ? mmap(NULL, mapped_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
          : MAP_FAILED;
    if (mapped == MAP_FAILED) {
        free(c);
        return NULL;
    }
    *c = (struct chunk){.context = d->context,
                        .memory = mapped + -(uintptr_t)mapped % page,
                        .mapped = mapped,
                        .bytes = bytes,
                        .mapped_bytes = mapped_bytes,
                        .used = DEVICE_GUARD_BYTES,
                        .parts = 1};
#ifdef MADV_HUGEPAGE
    if (page > PAGE_BYTES)
        madvise(c->memory, bytes, MADV_HUGEPAGE);
#endif
    return c;
}

void chunk_leave(struct chunk *c)
{
    if (!c || atomic_fetch_sub(&c->parts, 1) > 1)
        return;
    munmap(c->mapped, c->mapped_bytes);
    free(c);
}

/* ---- made ready by the crew ---- */

/* The system gives all pages at once, as if they were written; the program may use them
 * meanwhile. False: it is too old for that. */
static bool pages_give(const struct chunk *c)
{
#ifdef MADV_POPULATE_WRITE
    return !madvise(c->memory, c->bytes, MADV_POPULATE_WRITE);
#else
    (void)c;
    return false;
#endif
}

static void chunk_errand(void *of, bool wanted)
{
    if (wanted)
        pages_give(of);
    chunk_leave(of);
}

static bool chunk_ready(struct device *d, struct chunk *c)
{
    atomic_fetch_add(&c->parts, 1);
    if (crew_errand(d->crew, chunk_errand, c))
        return true;
    chunk_leave(c);
    return false;
}

/* So many that nothing is a part of yet. */
static void next_make(struct device *d, int count)
{
    const size_t page = d->shape.large_page_bytes;
    while (d->crew && d->next_count < count && d->next_count < CHUNKS_AHEAD) {
        struct chunk *c = chunk_create(d, page, page);
        if (!c)
            return;
        d->next[d->next_count++] = c;
        if (!chunk_ready(d, c))
            return;
    }
}

static struct chunk *next_take(struct device *d)
{
    const size_t page = d->shape.large_page_bytes;
    d->expected_bytes -= d->expected_bytes < page ? d->expected_bytes : page;
    if (!d->next_count)
        return chunk_create(d, page, page);
    struct chunk *c = d->next[0];
    memmove(d->next, d->next + 1, (size_t)--d->next_count * sizeof *d->next);
    return c;
}

static bool is_middle(const struct device *d, struct rows rows)
{
    return d->small && rows.bytes <= d->shape.large_page_bytes / 2;
}

void device_expect(struct device *d, struct rows rows)
{
    if (!is_middle(d, rows) || rows.bytes <= SMALL_ARRAY_BYTES)
        return;
    d->expected_bytes += 2 * rows.bytes; /* what it holds, and what it is made of */
    next_make(d, (int)(d->expected_bytes / d->shape.large_page_bytes + 1));
}

/* ---- all of them ---- */

void chunks_begin(struct device *d)
{
#ifndef LUTETIA_FUZZ /* ASan should see where each array ends */
    if (d->is_pocl)
        d->small = chunk_create(d, SMALL_CHUNK_BYTES, PAGE_BYTES);
    if (d->small && !pages_give(d->small))
        memset(d->small->memory, 0, SMALL_CHUNK_BYTES);
#else
    (void)d;
#endif
}

void chunks_finish(struct device *d)
{
    chunk_leave(d->small);
    chunk_leave(d->middle);
    while (d->next_count)
        chunk_leave(d->next[--d->next_count]);
    d->small = d->middle = NULL;
}

/* ---- parts ---- */

/* Where the next part would begin: as far from the beginning of its page as arrays with memory
 * of their own (see skew_room()), and so that the first column begins a line. 0: there is no
 * room. */
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
    if (d->small && rows.bytes <= SMALL_ARRAY_BYTES && chunk_place(d, d->small, rows))
        return d->small;
    if (!is_middle(d, rows))
        return NULL;
    if (!d->middle || !chunk_place(d, d->middle, rows)) {
        chunk_leave(d->middle);
        d->middle = next_take(d);
        next_make(d, 1);
    }
    return d->middle && chunk_place(d, d->middle, rows) ? d->middle : NULL;
}

bool chunk_take(struct device *d, struct rows rows, struct device_buffer *b)
{
    struct chunk *c = chunk_of(d, rows);
    if (!c)
        return false;
    const size_t at = chunk_place(d, c, rows);
    atomic_fetch_add(&c->parts, 1);
    c->used = at + rows.bytes;
    d->skew++;
    b->memory->chunk = c;
    b->host = c->memory + at;
    return true;
}

static void CL_CALLBACK part_leave(cl_mem part, void *chunk)
{
    (void)part;
    chunk_leave(chunk);
}

cl_mem chunk_mem(const struct device_buffer *b)
{
    cl_int error;
    struct chunk *c = b->memory->chunk;
    cl_mem part = clCreateBuffer(c->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, b->bytes,
                                 b->host, &error);
    if (error)
        return NULL;
    if (!clSetMemObjectDestructorCallback(part, part_leave, c))
        return part;
    clReleaseMemObject(part);
    return NULL;
}
