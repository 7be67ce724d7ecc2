/* support.h - a machine for a test, and fields with known contents.
 *
 *     struct machine *m = support_machine(0);
 *     int set = support_set(m, 2, 3, 41);
 *     // element n holds support_word(f's width, n)
 *     uint32_t f = support_field(m, MACHINE_UINT(17));
 *     support_expect(m, value, expected_of, context);
 *
 * Each test program includes it after cmocka's own headers.
 */
#ifndef LUTETIA_TESTS_MACHINE_SUPPORT_H
#define LUTETIA_TESTS_MACHINE_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "machine.h"
#include "oracle_number.h"

#define assert_ok(status, m)                                                                   \
    do {                                                                                       \
        if ((status) != MACHINE_OK)                                                            \
            fail_msg("%s:%d: %s", __FILE__, __LINE__, machine_error(m));                       \
    } while (0)

/* Checks that the machine's last call failed with this status and that its message is one line
 * with this word. Clears the error. */
void support_failed(struct machine *m, enum machine_status status, const char *word);

/* 16 processors, so that VP ratios above 1 occur. eager: 0 or 1. */
struct machine *support_machine(int eager);
/* Where LUTETIA_TEST_STATS is set, prints the machine's kernels first. */
void support_machine_destroy(struct machine *m);
/* Makes and selects a VP set of the given axes. */
int support_set(struct machine *m, int rank, ...);

/* The result of an operation on bits or integers a and b of that width, in plain C. */
wide support_integer(enum machine_op op, int width, wide a, wide b);

/* Word n of a sequence of ordinary and awkward numbers: ends of the range, zeros, NaN. */
wide support_word(struct machine_type type, uint64_t seed, uint64_t n);
/* A heap field of the current set with support_word(type, seed, n) in element n. */
uint32_t support_field(struct machine *m, struct machine_type type, uint64_t seed);
struct machine_value *support_value(struct machine *m, uint32_t field,
                                    struct machine_type type);

/* One element of a dense array as machine.h lays it out. */
wide support_element(const void *array, struct machine_type type, uint64_t n);
void support_element_set(void *array, struct machine_type type, uint64_t n, wide value);

/* Stores the value everywhere into a new field, downloads that and compares element n with
 * expected(data, n). */
typedef wide (*support_expected)(const void *data, uint64_t n);
void support_expect(struct machine *m, struct machine_value *value, support_expected expected,
                    const void *data, const char *what);
/* As support_expect(), but compares at the next support_check(). All values are then one
 * evaluation with few kernels to compile. Copies data_bytes of data, at most 64. */
void support_later(struct machine *m, struct machine_value *value, support_expected expected,
                   const void *data, size_t data_bytes, const char *what);
void support_check(struct machine *m);
/* As support_expect(), for a field. */
void support_expect_field(struct machine *m, uint32_t field, struct machine_type type,
                          support_expected expected, const void *data, const char *what);

/* A folder for caches that only this program uses: a group's set-up and tear-down.
 * support_cache_make() sets XDG_CACHE_HOME to it, and support_cache_leave() restores the old
 * XDG_CACHE_HOME. */
extern char support_cache[];
int support_cache_make(void **state);
void support_cache_leave(void);
int support_cache_remove(void **state);

static inline struct machine_scalar support_scalar(wide x)
{
    return (struct machine_scalar){(uint64_t)x, (uint64_t)(x >> 64)};
}

#endif
