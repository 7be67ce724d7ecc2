/* copy.cl - so many bytes copied, as fast as the device does it: what other kernels' times are held against.
 * -DELEMENT=float16, or what the device likes; -DSTREAMS=1: by stores that pass the caches by. */
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
