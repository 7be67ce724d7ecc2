/* array.h - arrays that grow by doubling.
 *
 *     if (!array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items))
 *         return no_memory();
 *     list->items[list->count++] = item; */
#ifndef LUTETIA_ARRAY_H
#define LUTETIA_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* Makes room for count elements. `array` points to the pointer to the first one, which malloc()
 * made or which is NULL with a capacity of 0; elements keep their values, new ones have none.
 * False: there is no memory, or the array's bytes cannot be counted; array and capacity are as
 * they were. */
bool array_reserve(void *array, int *capacity, int count, size_t element_bytes);

#endif
