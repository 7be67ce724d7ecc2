/* arrays.c - see arrays.h. */
#include "base/arrays.h"

#include <stdlib.h>

#include "base/errors.h"
#include "base/fill.h"

void *array_more(void *old, int *capacity, size_t element, bool *failed)
{
    int wanted = *capacity ? *capacity * 2 : 64;
    void *new = realloc(old, (size_t)wanted * element);
    if (!new) {
        *failed = true;
        return old;
    }
    *capacity = wanted;
    return new;
}

void *array_grown(void *old, int *capacity, size_t element)
{
    bool failed = false;
    void *new = array_more(old, capacity, element, &failed);
    NEEDS_MEMORY(!failed);
    return new;
}

void *array_zeroed(size_t count, size_t element)
{
    void *new = calloc(count ? count : 1, element);
    NEEDS_MEMORY(new);
    return new;
}

uint64_t words_hash(const uint32_t *words, size_t count)
{
    uint64_t hash = 0xcbf29ce484222325u + count;
    for (size_t i = 0; i < count; i += 2) { /* two at a time: each waits for the one before */
        const uint64_t both = words[i] | (i + 1 < count ? (uint64_t)words[i + 1] << 32 : 0);
        hash = (hash ^ both) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

void array_fill(void *to, const void *element, size_t bytes, size_t count)
{
    fill_elements(to, element, bytes, count);
}
