/* test_claims.c - kernels/claims.cl, compiled as C: threads that run work-groups in any order
 * claim each place once, kernel after kernel, and a thread finds the places again that it had
 * before. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef unsigned long ulong;

static int min(int a, int b)
{
    return a < b ? a : b;
}

#define __global
#include "../../kernels/claims.cl"
#undef inline

enum {
    WORDS = CLAIMS_OF + 2 * CLAIMS_MOST * CLAIMS_APART,
    PLACES_MOST = 3000,
    THREADS_MOST = 6
};

static volatile int claims[WORDS];
static unsigned turn;

static int claim_for(int places, int lots)
{
    return (places + lots - 1) / lots << 1 | (int)turn;
}

/* A kernel: its work-groups are run by threads in turn, as the driver hands them out. */
struct kernel {
    int places, claim;
    _Atomic int left;
    _Atomic int claimed[PLACES_MOST];
    pthread_barrier_t *begin;
};

static void *thread_runs(void *of)
{
    struct kernel *k = of;
    pthread_barrier_wait(k->begin);
    while (atomic_fetch_sub(&k->left, 1) > 0)
        atomic_fetch_add(&k->claimed[claim_place(claims, k->claim, k->places)], 1);
    return NULL;
}

static void claims_begin(int lots)
{
    memset((void *)(uintptr_t)claims, 0, sizeof claims);
    claims[0] = lots;
    turn = 0;
}

static void each_place_is_claimed_once(void **state)
{
    static struct kernel k;
    unsigned int seed = 1;
    (void)state;
    for (int round = 0; round < 150; round++) {
        const int threads = 1 + rand_r(&seed) % THREADS_MOST, lots = 1 + rand_r(&seed) % 9;
        pthread_barrier_t begin;
        claims_begin(lots);
        pthread_barrier_init(&begin, NULL, (unsigned)threads);
        for (int kernel = 0; kernel < 5; kernel++) {
            pthread_t of[THREADS_MOST];
            const int places = 2 + rand_r(&seed) % (round % 2 ? 12 : PLACES_MOST - 2);
            memset(&k, 0, sizeof k);
            k.places = places;
            k.claim = claim_for(places, lots);
            k.begin = &begin;
            atomic_store(&k.left, places);
            for (int i = 0; i < threads; i++)
                assert_int_equal(pthread_create(&of[i], NULL, thread_runs, &k), 0);
            for (int i = 0; i < threads; i++)
                pthread_join(of[i], NULL);
            for (int i = 0; i < places; i++)
                assert_int_equal(atomic_load(&k.claimed[i]), 1);
            turn ^= 1;
        }
        pthread_barrier_destroy(&begin);
    }
}

/* One thread by itself: its lot from the front, then the others' from the end. Where the
 * numbers were left by others they do not matter. */
static void a_thread_begins_with_its_own(void **state)
{
    static const int wanted[] = {0, 1, 2, 5, 4, 3, 8, 7, 6};
    (void)state;
    claims_begin(3);
    for (int kernel = 0; kernel < 4; kernel++) {
        for (int i = 0; i < 9; i++)
            assert_int_equal(claim_place(claims, claim_for(9, 3), 9), wanted[i]);
        turn ^= 1;
    }
    claims_begin(3);
    claims[CLAIMS_THREADS] = 12345; /* another thread's, as are all that are taken before */
    for (int kernel = 0; kernel < 4; kernel++) {
        assert_int_equal(claim_place(claims, claim_for(9, 3), 9), 3);
        for (int i = 0; i < 8; i++)
            claim_place(claims, claim_for(9, 3), 9);
        turn ^= 1;
    }
    assert_true(claims[CLAIMS_THREADS + 1] == thread_is() && !claims[CLAIMS_THREADS + 2]);
}

/* More threads than lots: who has none takes those of the first. */
static void a_thread_without_a_lot_helps_the_first(void **state)
{
    (void)state;
    claims_begin(2);
    claims[CLAIMS_THREADS] = 12345;
    claims[CLAIMS_THREADS + 1] = 54321;
    assert_int_equal(claim_place(claims, claim_for(4, 2), 4), 0);
    assert_int_equal(claim_place(claims, claim_for(4, 2), 4), 1);
    assert_int_equal(claim_place(claims, claim_for(4, 2), 4), 3);
    assert_int_equal(claim_place(claims, claim_for(4, 2), 4), 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_place_is_claimed_once),
        cmocka_unit_test(a_thread_begins_with_its_own),
        cmocka_unit_test(a_thread_without_a_lot_helps_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
