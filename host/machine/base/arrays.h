/* arrays.h - arrays that grow, and hashes of them. */
#ifndef LUTETIA_MACHINE_ARRAYS_H
#define LUTETIA_MACHINE_ARRAYS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Memory for small objects, compared with fields. Failure is not expected, and ends the
 * program, since there is no state to return to. array_grown: doubles an array;
 * array_zeroed: zeros. */
void *array_grown(void *old, int *capacity, size_t element);
/* As array_grown, for callers that can go back: on failure *failed is set, and the array is
 * unchanged. */
void *array_more(void *old, int *capacity, size_t element, bool *failed);
void *array_zeroed(size_t count, size_t element);
/* A hash of the words, the same on every machine. */
uint64_t words_hash(const uint32_t *words, size_t count);

/* So many elements, each these 1, 2, 4, 8 or 16 bytes. */
void array_fill(void *to, const void *element, size_t bytes, size_t count);

#endif
