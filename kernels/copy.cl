/* copy.cl - copies bytes as fast as the device can: the reference for other kernels' times.
 * -DELEMENT=float16, or a type that suits the device; -DSTREAMS=1: stores that bypass the
 * caches. */
#if STREAMS && __has_builtin(__builtin_nontemporal_store)
#define PUT(to, v) __builtin_nontemporal_store(v, to)
#else
#define PUT(to, v) (*(to) = (v))
#endif

__kernel void copy(ulong count, uint run, const __global ELEMENT *restrict from,
                   __global ELEMENT *restrict to)
{
    const ulong begin = get_global_id(0) * run, end = min(begin + run, count);
    for (ulong i = begin; i < end; i++)
        PUT(to + i, from[i]);
}
