/* test_chunks.c - arrays that are parts of chunks, beside those that have memory of their own:
 * none overlaps another, each begins where it should, and commands see what the front end has
 * written. */
#include "../skip.h"
#include "support.h"

#include "base/parts.h"
#include "device/device.h"

enum { ARRAYS = 300, ROUNDS = 6000, KINDS = 12 };

/* Sizes below and above each bound: small chunks, middle ones, memory of its own. */
static const size_t sizes[KINDS] = {64,     1000,   4096,   32 << 10, (32 << 10) + 64, 100000,
                                    131072, 400000, 524288, 1 << 20,  (1 << 20) + 64,  3 << 20};

struct array {
    struct device_buffer *buffer;
    unsigned char pattern;
};

static bool holds(const struct array *a)
{
    const unsigned char *bytes = a->buffer->host;
    for (size_t i = 0; i < a->buffer->bytes; i += i + 64 < a->buffer->bytes ? 61 : 1)
        if (bytes[i] != a->pattern)
            return false;
    return true;
}

static void drop(struct machine *m, struct array *a)
{
    assert_true(holds(a));
    device_buffer_unref(m, a->buffer);
    a->buffer = NULL;
}

static void arrays_overlap_nowhere(void **unused)
{
    (void)unused;
    struct machine *m = support_machine(0);
    struct array arrays[ARRAYS] = {{0}};
    if (!m->device->is_pocl)
        skip_because("the device is not PoCL's");
    srand(5);
    for (int round = 0; round < ROUNDS; round++) {
        struct array *a = &arrays[rand() % ARRAYS];
        if (a->buffer) {
            drop(m, a);
            continue;
        }
        /* Large ones seldom. */
        const size_t bytes = sizes[rand() % (round % 50 ? KINDS - 5 : KINDS)],
                     first = (size_t)(rand() % 4) * 16;
        a->buffer = device_rows_get(m, (struct rows){bytes, first});
        assert_non_null(a->buffer);
        assert_int_equal(a->buffer->bytes, bytes);
        assert_int_equal(((uintptr_t)a->buffer->host + first) % LINE_BYTES, 0);
        a->pattern = (unsigned char)rand();
        memset(a->buffer->host, a->pattern, bytes);
        if (round % 7 == 0)
            device_expect(m->device, (struct rows){bytes, first});
    }
    for (int i = 0; i < ARRAYS; i++)
        if (arrays[i].buffer)
            drop(m, &arrays[i]);
    support_machine_destroy(m);
}

/* A field's array has no memory object until a command needs one; then it is the same
 * memory. */
static void commands_see_the_same_memory(void **unused)
{
    (void)unused;
    struct machine *m = support_machine(0);
    if (!m->device->is_pocl)
        skip_because("the device is not PoCL's");
    for (int i = 0; i < KINDS; i++) {
        const struct rows rows = {sizes[i], 0};
        struct device_buffer *from = device_rows_get(m, rows), *to = device_rows_get(m, rows);
        assert_true(from && to);
        memset(from->host, 40 + i, rows.bytes);
        memset(to->host, 0, rows.bytes);
        assert_int_equal(clEnqueueCopyBuffer(m->device->queue, device_mem(from), device_mem(to),
                                             0, 0, rows.bytes, 0, NULL, NULL),
                         CL_SUCCESS);
        /* What the queue still works with may be let go of. */
        device_buffer_unref(m, from);
        assert_int_equal(clFinish(m->device->queue), CL_SUCCESS);
        struct array a = {to, (unsigned char)(40 + i)};
        drop(m, &a);
    }
    support_machine_destroy(m);
}

/* Fields that are expected and never come, pools that are emptied, machines that end at once:
 * memory is given back (leaks are found by sanitizers). */
static void what_is_expected_need_not_come(void **unused)
{
    (void)unused;
    for (int i = 0; i < 20; i++) {
        struct machine *m = support_machine(0);
        for (int k = 0; k < i; k++)
            device_expect(m->device, (struct rows){sizes[k % KINDS], 0});
        struct device_buffer *b = device_rows_get(m, (struct rows){400000, 0});
        assert_non_null(b);
        device_buffer_unref(m, b);
        if (i % 2)
            device_pool_empty(m->device);
        support_machine_destroy(m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_overlap_nowhere),
        cmocka_unit_test(commands_see_the_same_memory),
        cmocka_unit_test(what_is_expected_need_not_come),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
