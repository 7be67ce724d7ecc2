/* far_table.c - a rank's arrays: see far.h. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "device/far.h"

struct device_buffer *far_table_of(const struct far_table *t, uint64_t number)
{
    return number < t->count ? t->arrays[number] : NULL;
}

void far_table_put(struct far_table *t, uint64_t number, struct device_buffer *b)
{
    if (number >= t->count) {
        const uint64_t count = 2 * number + 16;
        t->arrays = realloc(t->arrays, count * sizeof *t->arrays);
        NEEDS_MEMORY(t->arrays);
        memset(t->arrays + t->count, 0, (count - t->count) * sizeof *t->arrays);
        t->count = count;
    }
    t->arrays[number] = b;
}

void far_table_drop(struct machine *m, struct far_table *t, uint64_t number)
{
    struct device_buffer *b = far_table_of(t, number);
    if (b)
        device_buffer_unref(m, b);
    if (b)
        t->arrays[number] = NULL;
}

void far_table_empty(struct machine *m, struct far_table *t)
{
    for (uint64_t i = 0; i < t->count; i++)
        far_table_drop(m, t, i);
    free(t->arrays);
    *t = (struct far_table){.count = 0};
}
