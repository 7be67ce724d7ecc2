/* words.h - writes and reads blocks of words in fields of the current VP set, for the tests of
 * the router. */
#ifndef PARIS_TESTS_WORDS_H
#define PARIS_TESTS_WORDS_H

#include <stdint.h>
#include <string.h>

#include "device.h"

enum { WORDS_MOST = 256 }; /* processors of a set */

static void put(CM_field_id_t field, unsigned int len, const uint64_t *x)
{
    struct machine_type type = MACHINE_UINT(len);
    int count = (int)CM_geometry_total_processors(CM_current_geometry);
    size_t bytes = machine_element_bytes(type);
    unsigned char dense[WORDS_MOST * 8];
    for (int i = 0; i < count; i++)
        memcpy(dense + (size_t)i * bytes, &x[i], bytes);
    if (machine_field_upload(paris_machine(), field, type, dense) != MACHINE_OK)
        fail_msg("%s", machine_error(paris_machine()));
}

static void get(CM_field_id_t field, unsigned int len, uint64_t *x)
{
    struct machine_type type = MACHINE_UINT(len);
    int count = (int)CM_geometry_total_processors(CM_current_geometry);
    size_t bytes = machine_element_bytes(type);
    unsigned char dense[WORDS_MOST * 8];
    if (machine_field_download(paris_machine(), field, type, dense) != MACHINE_OK)
        fail_msg("%s", machine_error(paris_machine()));
    for (int i = 0; i < count; i++) {
        x[i] = 0;
        memcpy(&x[i], dense + (size_t)i * bytes, bytes);
    }
}

static uint64_t cut(uint64_t x, unsigned int len)
{
    return len < 64 ? x & ((UINT64_C(1) << len) - 1) : x;
}

static void random_words(uint64_t *x, int count, unsigned int len)
{
    for (int i = 0; i < count; i++)
        x[i] = cut(device_random(), len);
}

static void expect(const char *what, const uint64_t *got, const uint64_t *wanted, int count)
{
    for (int i = 0; i < count; i++)
        if (got[i] != wanted[i])
            fail_msg("%s: processor %d has %llx, not %llx (%s)", what, i,
                     (unsigned long long)got[i], (unsigned long long)wanted[i], device_message);
}

#endif
