/* lanes_lines.h - lines and messages as vectors: a part of lanes_kernel.h. The slow twins are
 * the loops of ops/near_loops.c, and the tables without vectors of 16 numbers. */

/* ---- places and numbers ---- */

static void count(u32 *to, u32 first, int n)
{
    for (int i = 0; i < n; i++)
        to[i] = first + (u32)i;
}

static void fill(void *to, const void *element, size_t bytes, size_t n)
{
    fill_elements(to, element, bytes, n);
}

/* ---- messages ---- */

#define AIM(T)                                                                                 \
    {                                                                                          \
        const T *in = a->address;                                                              \
        for (int i = 0; i < n; i++) {                                                          \
            const u32 x = (u32)in[i] & mask;                                                   \
            index[i] = x < nobody ? x : nobody;                                                \
        }                                                                                      \
        break;                                                                                 \
    }

static void aim(const struct lanes_aim *a, int n, u32 *restrict index)
{
    const u32 mask = a->mask, nobody = a->nobody;
    const u8 *context = a->context;
    switch (a->bytes) {
    case 1:
        AIM(u8)
    case 2:
        AIM(u16)
    case 4:
        AIM(u32)
    case 8:
        AIM(u64)
    default:
        AIM(u128)
    }
    for (int i = 0; context && i < n; i++)
        index[i] = context[i] ? index[i] : nobody;
}

#if defined(__AVX2__) && !defined(__AVX512F__)

/* Of four bits: which are 1, a byte for each, the lowest first; how many. */
static const u32 four_picked[16] = {0,     0,       1,       0x100,    2,     0x200,
                                    0x201, 0x20100, 3,       0x300,    0x301, 0x30100,
                                    0x302, 0x30200, 0x30201, 0x3020100};
static const u8 four_count[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/* Of eight. Bytes beyond are any below 8. */
static inline u64 eight_picked(u32 bits)
{
    const u32 low = bits & 15, high = bits >> 4;
    return four_picked[low] | (u64)(four_picked[high] + 0x04040404u) << 8 * four_count[low];
}

#endif

static size_t filter(const struct lanes_filter *p, const u8 *context, int n, u32 *place,
                     u16 *lane)
{
    const u32 *index = p->index, first = p->first, count = p->count, further = p->further;
    size_t picked = 0;
    int i = 0;
#ifdef __AVX512F__
    __m512i lanes = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    for (; i + 16 <= n; i += 16) {
        const __m512i x = _mm512_loadu_si512(index + i);
        __mmask16 on = _mm512_cmplt_epu32_mask(
            _mm512_sub_epi32(x, _mm512_set1_epi32((i32)first)), _mm512_set1_epi32((i32)count));
        if (context) {
            const __m128i c = _mm_loadu_si128((const __m128i *)(const void *)(context + i));
            on &= _mm_test_epi8_mask(c, c);
        }
        _mm512_storeu_si512(place + picked, _mm512_add_epi32(_mm512_maskz_compress_epi32(on, x),
                                                             _mm512_set1_epi32((i32)further)));
        _mm256_storeu_si256((__m256i *)(void *)(lane + picked),
                            _mm512_cvtepi32_epi16(_mm512_maskz_compress_epi32(on, lanes)));
        lanes = _mm512_add_epi32(lanes, _mm512_set1_epi32(16));
        picked += (size_t)__builtin_popcount(on);
    }
#elif defined(__AVX2__)
    const __m256i from = _mm256_set1_epi32((i32)first),
                  last = _mm256_set1_epi32((i32)count - 1),
                  by = _mm256_set1_epi32((i32)further);
    for (; count && i + 8 <= n; i += 8) {
        const __m256i x = _mm256_loadu_si256((const __m256i *)(const void *)(index + i)),
                      in = _mm256_sub_epi32(x, from);
        __m256i on = _mm256_cmpeq_epi32(_mm256_min_epu32(in, last), in);
        if (context)
            on = _mm256_and_si256(
                on, _mm256_cmpgt_epi32(_mm256_cvtepu8_epi32(_mm_loadl_epi64(
                                           (const __m128i *)(const void *)(context + i))),
                                       _mm256_setzero_si256()));
        const u32 m = (u32)_mm256_movemask_ps(_mm256_castsi256_ps(on));
        const __m128i which = _mm_cvtsi64_si128((i64)eight_picked(m));
        _mm256_storeu_si256(
            (__m256i *)(void *)(place + picked),
            _mm256_add_epi32(by, _mm256_permutevar8x32_epi32(x, _mm256_cvtepu8_epi32(which))));
        _mm_storeu_si128((__m128i *)(void *)(lane + picked),
                         _mm_add_epi16(_mm_cvtepu8_epi16(which), _mm_set1_epi16((i16)i)));
        picked += four_count[m & 15] + four_count[m >> 4];
    }
#endif
    for (; i < n; i++) {
        const bool on = !context || context[i];
        place[picked] = index[i] + further;
        lane[picked] = (u16)i;
        picked += on & (index[i] - first < count);
    }
    return picked;
}

static u32 greatest(const u32 *x, const u8 *context, int n)
{
    u32 most = 0;
    if (!context)
        for (int i = 0; i < n; i++)
            most = x[i] > most ? x[i] : most;
    else
        for (int i = 0; i < n; i++) {
            const u32 there = x[i] & (0u - (context[i] != 0));
            most = there > most ? there : most;
        }
    return most;
}

/* Each element is written, and the next one over it if it is not wanted. */
#define PACK(T)                                                                                \
    {                                                                                          \
        const T *in = from;                                                                    \
        T *out = to;                                                                           \
        for (; i < n && packed < room; i++) {                                                  \
            out[packed] = in[i];                                                               \
            packed += context[i] != 0;                                                         \
        }                                                                                      \
        return packed;                                                                         \
    }

static size_t pack(const void *from, const u8 *context, size_t n, size_t bytes, void *to,
                   size_t room)
{
    size_t i = 0, packed = 0;
#ifdef __AVX512F__
    for (; bytes == 4 && i + 16 <= n && packed + 16 <= room; i += 16) {
        const __m128i c = _mm_loadu_si128((const __m128i *)(const void *)(context + i));
        const __mmask16 on = _mm_test_epi8_mask(c, c);
        _mm512_storeu_si512(
            (u32 *)to + packed,
            _mm512_maskz_compress_epi32(on, _mm512_loadu_si512((const u32 *)from + i)));
        packed += (size_t)__builtin_popcount(on);
    }
#endif
    switch (bytes) {
    case 1:
        PACK(u8)
    case 2:
        PACK(u16)
    case 4:
        PACK(u32)
    case 8:
        PACK(u64)
    default:
        PACK(u128)
    }
}

static void ranks(const struct lanes_ranks *r, size_t n, u32 rank)
{
    size_t i = 0;
#ifdef __AVX512F__
    const __m512i mask = _mm512_set1_epi32((i32)r->mask),
                  number = _mm512_set1_epi32((i32)r->number),
                  up = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    for (; i + 16 <= n; i += 16) {
        const __m128i c = _mm_loadu_si128((const __m128i *)(const void *)(r->context + i));
        const __mmask16 on = _mm_test_epi8_mask(c, c);
        const __m512i next = _mm512_and_si512(
                          _mm512_add_epi32(up, _mm512_set1_epi32((i32)rank)), mask),
                      old = r->old ? _mm512_loadu_si512(r->old + i) : number;
        _mm512_storeu_si512(r->to + i, _mm512_mask_expand_epi32(old, on, next));
        rank += (u32)__builtin_popcount(on);
    }
#elif defined(__AVX2__)
    const __m256i mask = _mm256_set1_epi32((i32)r->mask),
                  number = _mm256_set1_epi32((i32)r->number);
    for (; i + 8 <= n; i += 8) {
        const __m128i c = _mm_min_epu8(
            _mm_loadl_epi64((const __m128i *)(const void *)(r->context + i)), _mm_set1_epi8(1));
        const u64 bits = (u64)_mm_cvtsi128_si64(c),
                  sums = bits * UINT64_C(0x0101010101010101); /* a byte: up to this one */
        const __m256i before = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((i64)(sums - bits))),
                      next = _mm256_and_si256(
                          _mm256_add_epi32(before, _mm256_set1_epi32((i32)rank)), mask),
                      on = _mm256_cmpgt_epi32(_mm256_cvtepu8_epi32(c), _mm256_setzero_si256()),
                      old =
                          r->old
                              ? _mm256_loadu_si256((const __m256i *)(const void *)(r->old + i))
                              : number;
        _mm256_storeu_si256((__m256i *)(void *)(r->to + i), _mm256_blendv_epi8(old, next, on));
        rank += (u32)(sums >> 56);
    }
#endif
    for (; i < n; i++) {
        const u32 on = r->context[i] != 0, old = r->old ? r->old[i] : r->number;
        r->to[i] = on ? rank & r->mask : old;
        rank += on;
    }
}

/* An index becomes a place: a row's halos lie between it and the next row. */
static void places(u32 *place, size_t n, const struct lanes_rows *r)
{
    const u32 halo = r->halo, further = r->further, width = r->width;
    const f64 by = 1.0 / (f64)width;
    for (size_t i = 0; i < n; i++) {
        const u32 x = place[i];
        u32 row =
            (u32)(i32)((f64)(i32)x * by); /* too little by one, or right, or too great by one */
        const i32 rest = (i32)(x - row * width);
        row += (u32)(rest >= (i32)width) - (u32)(rest < 0);
        place[i] = x + halo + row * further;
    }
}

/* ---- gets ---- */

#ifdef __AVX512F__

/* The places of a large array are in memory: they are fetched ahead, and sixteen loads wait
 * together. In the caches one load after the other is as fast, and faster where places lie side
 * by side. */
static inline void fetch_ahead(const u32 *place, const void *array, u32 count, size_t bytes)
{
    for (int k = 0; k < 16; k++)
        __builtin_prefetch((const char *)array + (place[k] < count ? place[k] : 0) * bytes, 0,
                           3);
}

/* Sixteen at a time; the lanes that are left as ever. A vector's places have a sign. */
#define FETCH_SIXTEEN(T, GATHER)                                                               \
    LOOP(fetch_sixteen, T)                                                                     \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(u32, 0, place);                                                                     \
        IN(T, 1, array);                                                                       \
        const u32 count = *(const u32 *)at[s->in[2]];                                          \
        const __m512i most = _mm512_set1_epi32((i32)count);                                    \
        const int whole = n / 16 * 16;                                                         \
        if (s->in_a_row || count < GATHER_FAR_BYTES / sizeof(T) || count > INT32_MAX) {        \
            fetch_##T(s, at, n);                                                               \
            return;                                                                            \
        }                                                                                      \
        for (int i = 0; i < whole; i += 16) {                                                  \
            if (i + GATHER_AHEAD_LANES + 16 <= n)                                              \
                fetch_ahead(place + i + GATHER_AHEAD_LANES, array, count, sizeof(T));          \
            const __m512i x = _mm512_loadu_si512(place + i);                                   \
            const __mmask16 there = _mm512_cmplt_epu32_mask(x, most);                          \
            GATHER                                                                             \
        }                                                                                      \
        for (int i = whole; i < n; i++)                                                        \
            d[i] = place[i] < count ? array[place[i]] : 0;                                     \
    }

FETCH_SIXTEEN(u32,
              _mm512_storeu_si512(d + i, _mm512_mask_i32gather_epi32(_mm512_setzero_si512(),
                                                                     there, x, array, 4));)
FETCH_SIXTEEN(u64, {
    const __m512i none = _mm512_setzero_si512();
    _mm512_storeu_si512(d + i, _mm512_mask_i32gather_epi64(
                                   none, (__mmask8)there, _mm512_castsi512_si256(x), array, 8));
    _mm512_storeu_si512(d + i + 8,
                        _mm512_mask_i32gather_epi64(none, (__mmask8)(there >> 8),
                                                    _mm512_extracti64x4_epi64(x, 1), array, 8));
})

#define FETCHES                                                                                \
    {                                                                                          \
        fetch_u8, fetch_u16, fetch_sixteen_u32, fetch_sixteen_u64, fetch_u128                  \
    }
#else
#define FETCHES OF_INTEGERS(fetch)
#endif

/* ---- scans ---- */

#ifdef __AVX512F__

#define SCANNED static inline __attribute__((always_inline))

SCANNED __m512i scan_join(const enum reduction_op op, __m512i a, __m512i b)
{
    return op == REDUCE_ADD     ? _mm512_add_epi32(a, b)
           : op == REDUCE_LEAST ? _mm512_min_epu32(a, b)
           : op == REDUCE_OR    ? _mm512_or_si512(a, b)
                                : _mm512_xor_si512(a, b);
}

/* v joined with what is k lanes before, but not across a lane where a segment begins; begins:
 * such lanes, or lanes that are joined with all since one. */
#define SCAN_JOIN_BEFORE(k)                                                                    \
    joined = scan_join(op, v, _mm512_alignr_epi32(v, none, 16 - (k)));                         \
    v = segmented ? _mm512_mask_mov_epi32(joined, (__mmask16)begins, v) : joined;              \
    begins = segmented ? begins | begins << (k) : 0

/* Sixteen of them; carry: all lanes the number before. */
SCANNED __m512i scan_sixteen(const struct lanes_scan *s, const enum reduction_op op,
                             const bool masked, const bool segmented, size_t at,
                             __mmask16 there, __m512i *carry)
{
    const __m512i none = _mm512_set1_epi32((i32)s->none),
                  flip = _mm512_set1_epi32((i32)s->flip), cut = _mm512_set1_epi32((i32)s->cut),
                  last = _mm512_set1_epi32(15), before = *carry;
    __m512i joined;
    __mmask16 active = there;
    u32 begins = 0;
    if (masked) {
        const __m128i c = _mm_maskz_loadu_epi8(there, s->context + at);
        active = _mm_test_epi8_mask(c, c);
    }
    if (segmented) {
        const __m128i c = _mm_maskz_loadu_epi8(there, s->bits + at);
        begins = _mm_test_epi8_mask(c, c) & (s->starts ? active : (__mmask16)~0);
    }
    const __mmask16 first = (__mmask16)begins;
    __m512i v = _mm512_xor_si512(_mm512_maskz_loadu_epi32(there, s->in + at), flip);
    v = _mm512_mask_mov_epi32(none, active, v);
    SCAN_JOIN_BEFORE(1);
    SCAN_JOIN_BEFORE(2);
    SCAN_JOIN_BEFORE(4);
    SCAN_JOIN_BEFORE(8);
    joined = scan_join(op, v, before);
    if (segmented) {
        v = _mm512_mask_mov_epi32(joined, (__mmask16)begins, v);
        *carry = _mm512_permutexvar_epi32(last, v);
    } else { /* the next sixteen wait for one operation only */
        *carry = scan_join(op, before, _mm512_permutexvar_epi32(last, v));
        v = joined;
    }
    if (s->exclusive) {
        v = _mm512_alignr_epi32(v, before, 15);
        v = _mm512_mask_mov_epi32(v, first, none);
    }
    return _mm512_xor_si512(_mm512_and_si512(v, cut), flip);
}

/* Fewer than sixteen, from there on. */
SCANNED void scan_few(const struct lanes_scan *s, const enum reduction_op op, const bool masked,
                      const bool segmented, size_t at, size_t n, __m512i *carry)
{
    const __mmask16 there = (__mmask16)((1u << n) - 1);
    _mm512_mask_storeu_epi32(s->out + at, there,
                             scan_sixteen(s, op, masked, segmented, at, there, carry));
}

SCANNED u32 scan_by(const struct lanes_scan *s, const enum reduction_op op, const bool masked,
                    const bool segmented, size_t n, u32 before)
{
    const size_t line = 64 / sizeof *s->out, into = (uintptr_t)s->out / sizeof *s->out % line;
    __m512i carry = _mm512_set1_epi32((i32)before);
    size_t i = s->streams && into && n >= line ? line - into : 0;
    if (i)
        scan_few(s, op, masked, segmented, 0, i, &carry);
    for (; s->streams && i + 16 <= n; i += 16)
        _mm512_stream_si512((__m512i *)(void *)(s->out + i),
                            scan_sixteen(s, op, masked, segmented, i, (__mmask16)~0, &carry));
    for (; i + 16 <= n; i += 16)
        _mm512_storeu_si512(s->out + i,
                            scan_sixteen(s, op, masked, segmented, i, (__mmask16)~0, &carry));
    if (i < n)
        scan_few(s, op, masked, segmented, i, n - i, &carry);
    return (u32)_mm512_cvtsi512_si32(carry);
}

#define SCAN_BY_FLAGS(op)                                                                      \
    return s->context ? s->bits ? scan_by(s, op, true, true, n, before)                        \
                                : scan_by(s, op, true, false, n, before)                       \
           : s->bits ? scan_by(s, op, false, true, n, before)                                  \
                      : scan_by(s, op, false, false, n, before)

static u32 scan(const struct lanes_scan *s, size_t n, u32 before)
{
    switch (s->op) {
    case REDUCE_ADD:
        SCAN_BY_FLAGS(REDUCE_ADD);
    case REDUCE_LEAST:
        SCAN_BY_FLAGS(REDUCE_LEAST);
    case REDUCE_OR:
        SCAN_BY_FLAGS(REDUCE_OR);
    case REDUCE_XOR:
        SCAN_BY_FLAGS(REDUCE_XOR);
    case REDUCE_AND: /* turned over they are OR and LEAST */
    case REDUCE_GREATEST:
        break;
    }
    INVARIANT(false);
}

#define SCAN scan
#else
#define SCAN NULL
#endif
