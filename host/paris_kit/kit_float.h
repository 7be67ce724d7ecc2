/* kit_float.h - the Paris calls on single floats under short names: d is where the result goes,
 * a and b are fields, n is a number.
 *
 *     kit_f_times(t, absorbency, 0.5);
 *     kit_f_add(water, water, t);
 *
 * Context: as Paris's own; inactive processors keep what d holds. */
#ifndef LUTETIA_PARIS_KIT_FLOAT_H
#define LUTETIA_PARIS_KIT_FLOAT_H

#include <cm/paris.h>

enum { KIT_S = 23, KIT_E = 8, KIT_FLOAT_BITS = KIT_S + KIT_E + 1 };
#define KIT_F KIT_S, KIT_E

static inline void kit_f_add(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_add_3_1L(d, a, b, KIT_F);
}

/* d = a - b */
static inline void kit_f_sub(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_subtract_3_1L(d, a, b, KIT_F);
}

static inline void kit_f_mul(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_multiply_3_1L(d, a, b, KIT_F);
}

/* d = a / b */
static inline void kit_f_div(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_divide_3_1L(d, a, b, KIT_F);
}

static inline void kit_f_min(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_min_3_1L(d, a, b, KIT_F);
}

static inline void kit_f_max(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_max_3_1L(d, a, b, KIT_F);
}

static inline void kit_f_plus(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_add_constant_3_1L(d, a, n, KIT_F);
}

static inline void kit_f_times(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_multiply_constant_3_1L(d, a, n, KIT_F);
}

/* d = n - a */
static inline void kit_f_from(CM_field_id_t d, double n, CM_field_id_t a)
{
    CM_f_subfrom_constant_3_1L(d, a, n, KIT_F);
}

/* d = min(a, n) */
static inline void kit_f_most(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_min_constant_3_1L(d, a, n, KIT_F);
}

/* d = max(a, n) */
static inline void kit_f_least(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_max_constant_3_1L(d, a, n, KIT_F);
}

/* Rounds d to a whole number: adding 3 * 2^22 leaves no place for a fraction. Numbers up to
 * 2^22 are rounded to the nearest whole number, numbers up to 2^24 to a near even one.
 * Larger numbers are whole already. */
#define KIT_WHOLE 12582912.0
static inline void kit_f_whole(CM_field_id_t d)
{
    CM_f_add_constant_2_1L(d, KIT_WHOLE, KIT_F);
    CM_f_subtract_constant_2_1L(d, KIT_WHOLE, KIT_F);
}

static inline void kit_f_copy(CM_field_id_t d, CM_field_id_t a)
{
    CM_f_move_1L(d, a, KIT_F);
}

static inline void kit_f_set(CM_field_id_t d, double n)
{
    CM_f_move_constant_1L(d, n, KIT_F);
}

/* d = a of the neighbour whose coordinate along the axis is one greater; the last
 * processor's neighbour is the first. */
static inline void kit_f_next(CM_field_id_t d, CM_field_id_t a, unsigned axis)
{
    CM_get_from_news_1L(d, a, axis, CM_upward, KIT_FLOAT_BITS);
}

/* d = a of the neighbour whose coordinate is one less; the first processor's neighbour is
 * the last. */
static inline void kit_f_previous(CM_field_id_t d, CM_field_id_t a, unsigned axis)
{
    CM_get_from_news_1L(d, a, axis, CM_downward, KIT_FLOAT_BITS);
}

#endif
