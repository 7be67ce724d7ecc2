/* array.c - see array.h. */
#include "array.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool array_reserve(void *array, int *capacity, int count, size_t element_bytes)
{
    if (count <= *capacity)
        return true;
    int64_t wanted = *capacity ? 2 * (int64_t)*capacity : 16;
    while (wanted < count)
        wanted *= 2;
    if (wanted > INT_MAX)
        wanted = INT_MAX;
    size_t bytes;
    if (__builtin_mul_overflow((size_t)wanted, element_bytes, &bytes))
        return false;
    void *old, *grown;
    memcpy(&old, array, sizeof old); /* whatever it points to */
    grown = realloc(old, bytes);
    if (!grown)
        return false;
    memcpy(array, &grown, sizeof grown);
    *capacity = (int)wanted;
    return true;
}
