/* claims.cl - which work-group computes what: a part of kernels in rows and strips for CPUs of
 * several threads, before them.
 *
 * What a thread has stored is in the caches of its processor, and the next kernel reads it at
 * the same place. So a thread computes the same places in each kernel. A place is a run of
 * columns of a row, or a strip. The places are shared out in lots, one for each thread. A
 * work-group does not know beforehand which thread runs it, so it claims a place when it
 * begins: the next of its thread's lot, or the last of another lot where that is empty. There
 * are two sets of claims, which kernels take in turn. The work-group that gets the first place
 * clears the other set: the kernel before has used it, and the next one will.
 *
 *     claims      lots | ... | the threads of the lots | of each lot: claimed from the front, and from the end << 16 | likewise
 *     claim       places of a lot << 1 | which set
 *
 * device/claims.c has the same numbers. Clang's atomics compile faster than OpenCL's, which are
 * functions of the driver's library. */
enum { CLAIMS_THREADS = 16, CLAIMS_MOST = 64, CLAIMS_APART = 16, CLAIMS_OF = 80 };

/* Another number for each thread; where none is known, one for all. */
static inline int thread_is(void)
{
#if defined(__x86_64__)
    ulong at; /* the thread's own block of the C library */
    __asm__("movq %%fs:0, %0" : "=r"(at));
    return (int)(at >> 6) | 1;
#else
    return 1;
#endif
}

static inline int claims_lot(volatile __global int *threads, int lots)
{
    const int me = thread_is();
    for (int own = 0; own < lots; own++) {
        int seen = threads[own];
        if (!seen)
            seen = __sync_val_compare_and_swap(&threads[own], 0, me);
        if (!seen || seen == me)
            return own;
    }
    return 0;
}

static inline int claim_place(volatile __global int *claims, int claim, int places)
{
    const int lots = claims[0], length = claim >> 1,
              set = CLAIMS_OF + (claim & 1) * CLAIMS_MOST * CLAIMS_APART,
              other = CLAIMS_OF + (~claim & 1) * CLAIMS_MOST * CLAIMS_APART;
    int lot = claims_lot(claims + CLAIMS_THREADS, lots), place = 0;
    for (int i = 0; i < lots; i++) { /* there are as many places as work-groups */
        const int first = lot * length, end = min(first + length, places),
                  claimed =
                      __sync_fetch_and_add(&claims[set + CLAIMS_APART * lot], i ? 1 << 16 : 1),
                  front = claimed & 0xffff, back = claimed >> 16;
        if (front + back < end - first) {
            place = i ? end - 1 - back : first + front;
            break;
        }
        lot = lot + 1 < lots ? lot + 1 : 0;
    }
    for (int i = 0; i < lots && place == 0; i++)
        __sync_lock_test_and_set(&claims[other + CLAIMS_APART * i], 0);
    return place;
}
