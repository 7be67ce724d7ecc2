/* lanes_cross.h - the loop of a near cross, included by fast_loops.h: each lane takes the one
 * whose number differs in these bits, all in an aligned run of CROSS_NEAR lanes. n: a multiple
 * of CROSS_NEAR.
 *
 *     bits 18, vectors of 16 lanes:   vector i takes vector i ^ 1, and of it lane k takes lane
 *                                     k ^ 2 */

#define CROSS_BITS ((int)(*(const u32 *)at[s->in[1]] % CROSS_NEAR))

/* Each by itself. */
#define CROSS_EACH(T)                                                                          \
    LOOP(cross, T)                                                                             \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const int bits = CROSS_BITS;                                                           \
        EACH d[i] = a[i ^ bits];                                                               \
    }
/* So many lanes at once: EXPRESSION is the vector v's, its lanes crossed by `low`, for which
 * index is made before. */
#define CROSS_VECTORS(T, VECTOR, LANES, LOAD, STORE, INDEX, EXPRESSION)                        \
    LOOP(cross, T)                                                                             \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(T, 0, a);                                                                           \
        const int bits = CROSS_BITS, low = bits % (LANES), high = bits - low;                  \
        const VECTOR index = INDEX;                                                            \
        for (int i = 0; i < n; i += (LANES)) {                                                 \
            const VECTOR v = LOAD((const void *)(a + (i ^ high)));                             \
            STORE((void *)(d + i), EXPRESSION);                                                \
        }                                                                                      \
    }

#if defined(__AVX512BW__)
#define CROSS_512(T, LANES, INDEX, EXPRESSION)                                                 \
    CROSS_VECTORS(T, __m512i, LANES, _mm512_loadu_si512, _mm512_storeu_si512, INDEX, EXPRESSION)

/* Bytes: whole quarters of the vector, and within each its bytes. */
static inline __m512i quarters_crossed(__m512i v, int low)
{
    const __m512i up = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0);
    return _mm512_permutexvar_epi64(_mm512_xor_si512(up, _mm512_set1_epi64(low / 16 * 2)), v);
}
static inline __m512i bytes_index(int low)
{
    const __m128i up = _mm_set_epi8(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    return _mm512_broadcast_i32x4(_mm_xor_si128(up, _mm_set1_epi8((char)(low % 16))));
}
static inline __m512i words_index(int low)
{
    const __m256i up = _mm256_set_epi8(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 15,
                                       14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    const __m512i bytes = _mm512_cvtepu8_epi16(up),
                  upper = _mm512_set_epi64(0x0010001000100010, 0x0010001000100010,
                                           0x0010001000100010, 0x0010001000100010, 0, 0, 0, 0);
    return _mm512_xor_si512(_mm512_or_si512(bytes, upper), _mm512_set1_epi16((short)low));
}
CROSS_512(u8, 64, bytes_index(low), _mm512_shuffle_epi8(quarters_crossed(v, low), index))
CROSS_512(u16, 32, words_index(low), _mm512_permutexvar_epi16(index, v))
CROSS_512(u32, 16,
          _mm512_xor_si512(_mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1,
                                            0),
                           _mm512_set1_epi32(low)),
          _mm512_permutexvar_epi32(index, v))
CROSS_512(u64, 8,
          _mm512_xor_si512(_mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0), _mm512_set1_epi64(low)),
          _mm512_permutexvar_epi64(index, v))
CROSS_EACH(u128)
#elif defined(__AVX2__)
static inline __m256i load_256(const void *from)
{
    return _mm256_loadu_si256(from);
}
static inline void store_256(void *to, __m256i v)
{
    _mm256_storeu_si256(to, v);
}
CROSS_EACH(u8)
CROSS_EACH(u16)
CROSS_VECTORS(u32, __m256i, 8, load_256, store_256,
              _mm256_xor_si256(_mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0),
                               _mm256_set1_epi32(low)),
              _mm256_permutevar8x32_epi32(v, index))
CROSS_EACH(u64)
CROSS_EACH(u128)
#else
CROSS_EACH(u8)
CROSS_EACH(u16)
CROSS_EACH(u32)
CROSS_EACH(u64)
CROSS_EACH(u128)
#endif
