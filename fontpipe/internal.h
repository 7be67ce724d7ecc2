/* internal.h - what the pipeline's files share. */
#ifndef LUTETIA_FONT_INTERNAL_H
#define LUTETIA_FONT_INTERNAL_H

#include "status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Keeps the text for font_error() and returns the status. */
enum font_status font_fail(enum font_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Makes room for count elements of an array that grows by doubling; false: no memory, and the array is as it
 * was. */
bool font_array_reserve(void **array, int *capacity, int count, size_t element_bytes);

/* Of the bytes of a key. */
uint32_t font_hash(const void *key, size_t bytes_count);

/* outline.c: of a prepared outline. */
struct font_outline;
enum font_status font_outline_polynomials(struct font_outline *o);

#endif
