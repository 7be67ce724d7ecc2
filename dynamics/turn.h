/* turn.h - transposes states and forces, which are stored mass by mass, to lanes and back: for
 * step_kernel.h.
 *
 *     memory      x0 y0 vx0 vy0   x1 y1 vx1 vy1   ...          fx0 fy0   fx1 fy1   ...
 *     lanes       x0 x1 ...   y0 y1 ...   vx0 vx1 ...   vy0 vy1 ...        fx0 fx1 ...   fy0
 *                 fy1
 * ... */
#ifndef LUTETIA_DYN_TURN_H
#define LUTETIA_DYN_TURN_H

#include "lanes.h"

struct lanes_state {
    lanes x, y, vx, vy;
};

struct lanes_force {
    lanes x, y;
};

/* The state of the mass whose force is there: struct dyn_packed. */
INLINE const struct dyn_state *state_at(const struct dyn_state *first, int32_t at)
{
    return (const void *)((const char *)first + 2 * (ptrdiff_t)at);
}

INLINE struct dyn_force *force_at(struct dyn_force *first, int32_t at)
{
    return (void *)((char *)first + at);
}

#if LANES == 8

/* Two states, as one vector. */
INLINE __m512d two(__m256d first, __m256d second)
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1);
}

INLINE __m256d difference(const struct dyn_state *state, int32_t a, int32_t b)
{
    return _mm256_sub_pd(_mm256_load_pd(&state_at(state, b)->x),
                         _mm256_load_pd(&state_at(state, a)->x));
}

INLINE struct lanes_state states_difference(const struct dyn_state *state, const int32_t *a,
                                            const int32_t *b)
{
    __m512d r0 = two(difference(state, a[0], b[0]), difference(state, a[2], b[2]));
    __m512d r1 = two(difference(state, a[1], b[1]), difference(state, a[3], b[3]));
    __m512d r2 = two(difference(state, a[4], b[4]), difference(state, a[6], b[6]));
    __m512d r3 = two(difference(state, a[5], b[5]), difference(state, a[7], b[7]));
    __m512d x03 = _mm512_unpacklo_pd(r0, r1), y03 = _mm512_unpackhi_pd(r0, r1);
    __m512d x47 = _mm512_unpacklo_pd(r2, r3), y47 = _mm512_unpackhi_pd(r2, r3);
    return (struct lanes_state){
        _mm512_shuffle_f64x2(x03, x47, 0x88), _mm512_shuffle_f64x2(y03, y47, 0x88),
        _mm512_shuffle_f64x2(x03, x47, 0xdd), _mm512_shuffle_f64x2(y03, y47, 0xdd)};
}

INLINE struct lanes_state states_load(const struct dyn_state *state)
{
    const __m512i places = _mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13);
    const __m512i speeds = _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15);
    __m512d m0 = _mm512_load_pd(&state[0].x), m2 = _mm512_load_pd(&state[2].x);
    __m512d m4 = _mm512_load_pd(&state[4].x), m6 = _mm512_load_pd(&state[6].x);
    __m512d p0 = _mm512_permutex2var_pd(m0, places, m2),
            p4 = _mm512_permutex2var_pd(m4, places, m6);
    __m512d v0 = _mm512_permutex2var_pd(m0, speeds, m2),
            v4 = _mm512_permutex2var_pd(m4, speeds, m6);
    return (struct lanes_state){
        _mm512_shuffle_f64x2(p0, p4, 0x44), _mm512_shuffle_f64x2(p0, p4, 0xee),
        _mm512_shuffle_f64x2(v0, v4, 0x44), _mm512_shuffle_f64x2(v0, v4, 0xee)};
}

INLINE void states_store(struct dyn_state *state, struct lanes_state s)
{
    const __m512i first = _mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13);
    const __m512i second = _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15);
    __m512d p0 = _mm512_shuffle_f64x2(s.x, s.y, 0x44),
            v0 = _mm512_shuffle_f64x2(s.vx, s.vy, 0x44);
    __m512d p4 = _mm512_shuffle_f64x2(s.x, s.y, 0xee),
            v4 = _mm512_shuffle_f64x2(s.vx, s.vy, 0xee);
    _mm512_store_pd(&state[0].x, _mm512_permutex2var_pd(p0, first, v0));
    _mm512_store_pd(&state[2].x, _mm512_permutex2var_pd(p0, second, v0));
    _mm512_store_pd(&state[4].x, _mm512_permutex2var_pd(p4, first, v4));
    _mm512_store_pd(&state[6].x, _mm512_permutex2var_pd(p4, second, v4));
}

INLINE struct lanes_force forces_load(const struct dyn_force *force)
{
    const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
    const __m512i odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    __m512d f0 = _mm512_load_pd(&force[0].x), f4 = _mm512_load_pd(&force[4].x);
    return (struct lanes_force){_mm512_permutex2var_pd(f0, even, f4),
                                _mm512_permutex2var_pd(f0, odd, f4)};
}

INLINE void forces_clear(struct dyn_force *force)
{
    _mm512_store_pd(&force[0].x, _mm512_setzero_pd());
    _mm512_store_pd(&force[4].x, _mm512_setzero_pd());
}

#elif LANES == 4

INLINE struct lanes_state states_turn(__m256d m0, __m256d m1, __m256d m2, __m256d m3)
{
    __m256d x01 = _mm256_unpacklo_pd(m0, m1), y01 = _mm256_unpackhi_pd(m0, m1);
    __m256d x23 = _mm256_unpacklo_pd(m2, m3), y23 = _mm256_unpackhi_pd(m2, m3);
    return (struct lanes_state){
        _mm256_permute2f128_pd(x01, x23, 0x20), _mm256_permute2f128_pd(y01, y23, 0x20),
        _mm256_permute2f128_pd(x01, x23, 0x31), _mm256_permute2f128_pd(y01, y23, 0x31)};
}

INLINE __m256d difference(const struct dyn_state *state, int32_t a, int32_t b)
{
    return _mm256_sub_pd(_mm256_load_pd(&state_at(state, b)->x),
                         _mm256_load_pd(&state_at(state, a)->x));
}

INLINE struct lanes_state states_difference(const struct dyn_state *state, const int32_t *a,
                                            const int32_t *b)
{
    return states_turn(difference(state, a[0], b[0]), difference(state, a[1], b[1]),
                       difference(state, a[2], b[2]), difference(state, a[3], b[3]));
}

INLINE struct lanes_state states_load(const struct dyn_state *state)
{
    return states_turn(_mm256_load_pd(&state[0].x), _mm256_load_pd(&state[1].x),
                       _mm256_load_pd(&state[2].x), _mm256_load_pd(&state[3].x));
}

INLINE void states_store(struct dyn_state *state, struct lanes_state s)
{
    __m256d x01 = _mm256_permute2f128_pd(s.x, s.vx, 0x20),
            y01 = _mm256_permute2f128_pd(s.y, s.vy, 0x20);
    __m256d x23 = _mm256_permute2f128_pd(s.x, s.vx, 0x31),
            y23 = _mm256_permute2f128_pd(s.y, s.vy, 0x31);
    _mm256_store_pd(&state[0].x, _mm256_unpacklo_pd(x01, y01));
    _mm256_store_pd(&state[1].x, _mm256_unpackhi_pd(x01, y01));
    _mm256_store_pd(&state[2].x, _mm256_unpacklo_pd(x23, y23));
    _mm256_store_pd(&state[3].x, _mm256_unpackhi_pd(x23, y23));
}

INLINE struct lanes_force forces_load(const struct dyn_force *force)
{
    __m256d f0 = _mm256_load_pd(&force[0].x), f2 = _mm256_load_pd(&force[2].x);
    return (struct lanes_force){_mm256_permute4x64_pd(_mm256_unpacklo_pd(f0, f2), 0xd8),
                                _mm256_permute4x64_pd(_mm256_unpackhi_pd(f0, f2), 0xd8)};
}

INLINE void forces_clear(struct dyn_force *force)
{
    _mm256_store_pd(&force[0].x, _mm256_setzero_pd());
    _mm256_store_pd(&force[2].x, _mm256_setzero_pd());
}

#else

INLINE struct lanes_state states_difference(const struct dyn_state *state, const int32_t *a,
                                            const int32_t *b)
{
    const struct dyn_state *from = state_at(state, *a), *to = state_at(state, *b);
    return (struct lanes_state){to->x - from->x, to->y - from->y, to->vx - from->vx,
                                to->vy - from->vy};
}

INLINE struct lanes_state states_load(const struct dyn_state *state)
{
    return (struct lanes_state){state->x, state->y, state->vx, state->vy};
}

INLINE void states_store(struct dyn_state *state, struct lanes_state s)
{
    *state = (struct dyn_state){s.x, s.y, s.vx, s.vy};
}

INLINE struct lanes_force forces_load(const struct dyn_force *force)
{
    return (struct lanes_force){force->x, force->y};
}

INLINE void forces_clear(struct dyn_force *force)
{
    *force = (struct dyn_force){0, 0};
}

#endif

/* Adds forces to the first ends and subtracts them from the second, one spring after the other,
 * so that the order of a mass's forces does not depend on LANES. Where springs often have the
 * first end of the one before, its sum is carried in a register: a load of what was just stored
 * is slow. c: NULL where they do not. */
#if LANES > 1

struct carried {
    int32_t at; /* -1: none */
    __m128d sum;
};

INLINE struct carried carried_none(void)
{
    return (struct carried){-1, _mm_setzero_pd()};
}

INLINE void carried_store(struct dyn_force *force, struct carried c)
{
    if (c.at >= 0)
        _mm_store_pd(&force_at(force, c.at)->x, c.sum);
}

INLINE void force_pass(struct dyn_force *force, int32_t a, int32_t b, __m128d f,
                       struct carried *c)
{
    double *first = &force_at(force, a)->x, *second = &force_at(force, b)->x;
    if (!c) {
        _mm_store_pd(first, _mm_add_pd(_mm_load_pd(first), f));
    } else {
        if (a != c->at) {
            carried_store(force, *c);
            *c = (struct carried){a, _mm_load_pd(first)};
        }
        c->sum = _mm_add_pd(c->sum, f);
    }
    _mm_store_pd(second, _mm_sub_pd(_mm_load_pd(second), f));
}

INLINE void forces_add(struct dyn_force *force, const int32_t *a, const int32_t *b,
                       struct lanes_force f, struct carried *c)
{
#if LANES == 8
    __m512d even = _mm512_unpacklo_pd(f.x, f.y), odd = _mm512_unpackhi_pd(f.x, f.y);
    force_pass(force, a[0], b[0], _mm512_castpd512_pd128(even), c);
    force_pass(force, a[1], b[1], _mm512_castpd512_pd128(odd), c);
    force_pass(force, a[2], b[2], _mm512_extractf64x2_pd(even, 1), c);
    force_pass(force, a[3], b[3], _mm512_extractf64x2_pd(odd, 1), c);
    force_pass(force, a[4], b[4], _mm512_extractf64x2_pd(even, 2), c);
    force_pass(force, a[5], b[5], _mm512_extractf64x2_pd(odd, 2), c);
    force_pass(force, a[6], b[6], _mm512_extractf64x2_pd(even, 3), c);
    force_pass(force, a[7], b[7], _mm512_extractf64x2_pd(odd, 3), c);
#else
    __m256d even = _mm256_unpacklo_pd(f.x, f.y), odd = _mm256_unpackhi_pd(f.x, f.y);
    force_pass(force, a[0], b[0], _mm256_castpd256_pd128(even), c);
    force_pass(force, a[1], b[1], _mm256_castpd256_pd128(odd), c);
    force_pass(force, a[2], b[2], _mm256_extractf128_pd(even, 1), c);
    force_pass(force, a[3], b[3], _mm256_extractf128_pd(odd, 1), c);
#endif
}

#else

struct carried {
    int32_t at;
};

INLINE struct carried carried_none(void)
{
    return (struct carried){-1};
}

INLINE void carried_store(struct dyn_force *force, struct carried c)
{
    (void)force, (void)c;
}

INLINE void forces_add(struct dyn_force *force, const int32_t *a, const int32_t *b,
                       struct lanes_force f, struct carried *c)
{
    (void)c;
    struct dyn_force *first = force_at(force, *a), *second = force_at(force, *b);
    first->x += f.x;
    first->y += f.y;
    second->x -= f.x;
    second->y -= f.y;
}

#endif
#endif
