/* test_ring.c - passes messages between threads: all arrive, whole and in order. Those that do
 * not fit are refused and counted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <message_ring.h>

#include "../sample.h"

#include <pthread.h>
#include <sched.h>

enum { MESSAGES = 100000, LONGEST = 300 };

static size_t message_of(uint64_t i, uint8_t *bytes)
{
    const size_t count = 1 + sample_of(i) % (i % 50 ? 3 : LONGEST);
    for (size_t k = 0; k < count; k++)
        bytes[k] = (uint8_t)sample_of(i + k);
    return count;
}

static void *putter(void *context)
{
    struct message_ring *r = context;
    uint8_t bytes[LONGEST];
    for (uint64_t i = 0; i < MESSAGES; i++) {
        const size_t count = message_of(i, bytes);
        while (!ring_put(r, i * 7, bytes, count))
            sched_yield();
    }
    return NULL;
}

static void threads_hand_all_over(void **unused)
{
    (void)unused;
    static struct message_ring ring;
    uint8_t bytes[LONGEST], expected[LONGEST];
    uint64_t time_ns;
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, putter, &ring), 0);
    for (uint64_t i = 0; i < MESSAGES;) {
        const size_t count = ring_take(&ring, &time_ns, bytes, sizeof bytes);
        if (!count) {
            sched_yield();
            continue;
        }
        if (count != message_of(i, expected) || memcmp(bytes, expected, count) != 0 ||
            time_ns != i * 7)
            fail_msg("message %d is another one", (int)i);
        i++;
    }
    pthread_join(thread, NULL);
    assert_int_equal(ring_take(&ring, &time_ns, bytes, sizeof bytes), 0);
}

static void what_does_not_fit_is_refused(void **unused)
{
    (void)unused;
    static struct message_ring ring;
    uint8_t bytes[3] = {1, 2, 3}, back[3];
    uint64_t time_ns;
    uint32_t put = 0, taken = 0;
    assert_false(ring_put(&ring, 0, bytes, 0));
    assert_false(ring_put(&ring, 0, bytes, 70000));
    while (ring_put(&ring, put, bytes, 3))
        put++;
    assert_int_equal(put, RING_BYTES / 13);
    assert_int_equal(ring.refused, 3);
    for (; ring_take(&ring, &time_ns, back, 3) == 3; taken++)
        assert_int_equal(time_ns, taken);
    assert_int_equal(taken, put);
    assert_memory_equal(bytes, back, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_hand_all_over),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests_name("ring", tests, NULL, NULL);
}
