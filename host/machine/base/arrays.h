/* arrays.h - arrays that grow, and hashes of them. */
#ifndef LUTETIA_MACHINE_ARRAYS_H
#define LUTETIA_MACHINE_ARRAYS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Memory for what is small beside the fields: it is not expected to run out, and when it does there is no
 * state to return to. grown: twice as much room in an array; allocated: zeros. */
void *array_grown(void *old, int *capacity, size_t element);
/* As grown, where there is such a state: then *failed, and the array is as it was. */
void *array_more(void *old, int *capacity, size_t element, bool *failed);
void *array_zeroed(size_t count, size_t element);
/* A hash of so many words, the same on every machine. */
uint64_t words_hash(const uint32_t *words, size_t count);

#endif
