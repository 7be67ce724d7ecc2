/* complex_samples.h - sample complex numbers of a format, and the largest error that each
 * instruction may have against C. */
#ifndef PARIS_TESTS_COMPLEX_SAMPLES_H
#define PARIS_TESTS_COMPLEX_SAMPLES_H

#include <complex.h>
#include <float.h>
#include <math.h>
#include <stdint.h>

#include "device.h"
#include "oracle_soft.h"

typedef long double complex number_c;

/* Keeps the signs of zeros; re + im * I would not. */
static number_c complex_of(long double re, long double im)
{
    union {
        long double parts[2];
        number_c whole;
    } z = {{re, im}};
    return z.whole;
}

typedef void (*unary_call)(CM_field_id_t, CM_field_id_t, unsigned int, unsigned int);

/* Rows shorter than a vector give kernels of one lane, which compile faster. */
enum { HIGH = 192, ACROSS = 12, MANY = HIGH * ACROSS, SPECIALS = 16 };

struct format {
    unsigned int s, e;
};

/* ---- samples: pairs of doubles that the format has ---- */

static double samples[3][2 * MANY]; /* z, w, what dest held */

static double part_of(struct format f, bool other)
{
    static const double plain[] = {0, 1, 0.5, 2, 1.5, 3, 0.75, 1.0009765625, 0.9990234375, 4};
    uint64_t r = device_random();
    int span = f.e >= 11 ? 1000 : f.e >= 8 ? 100 : 10;
    double x = (double)(device_random() % 1024 + 1) / 1024;
    switch (r % 8) {
    case 0:
    case 1:
        x = plain[(r >> 8) % (sizeof plain / sizeof *plain)];
        break;
    case 2:
        x = ldexp(x, (int)(r >> 8) % span);
        break;
    case 3:
        x = ldexp(x, -((int)(r >> 8 & 0xffff) % span));
        break;
    default:
        x = ldexp(x, (int)(r >> 8 & 7) - 3);
        break;
    }
    if (other && fabs(x) > 1e3)
        x = 2;
    return r >> 40 & 1 ? -x : x;
}

static void samples_make(struct format f)
{
    device_seed(11 + f.s);
    for (int i = 0; i < 2 * MANY; i++) {
        samples[0][i] = part_of(f, false);
        samples[1][i] = part_of(f, true);
        samples[2][i] = part_of(f, false);
    }
    static const double special[][2] = {
        {INFINITY, 1},    {-INFINITY, 1}, {-INFINITY, -2},
        {0, INFINITY},    {3, -INFINITY}, {INFINITY, -INFINITY},
        {-INFINITY, 0.0}, {NAN, 1},       {INFINITY, NAN},
        {-0.0, -0.0},     {-1, -0.0},     {-1, 0.0},
        {2, -0.0},        {2, 0.0},       {-0.0, 2},
        {-0.0, -2},
    };
    for (int i = 0; i < SPECIALS; i++) {
        samples[0][2 * i] = special[i][0];
        samples[0][2 * i + 1] = special[i][1];
    }
}

static number_c of_parts(const double *p, int n)
{
    return complex_of(p[2 * n], p[2 * n + 1]);
}

/* ---- fields ---- */

static CM_field_id_t field_of(struct format f, const double *parts)
{
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_field_id_t field = CM_allocate_stack_field(2 * (f.s + f.e + 1));
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    CM_c_write_to_news_array_1L(parts, none, none, all, both, field, f.s, f.e, 2, all,
                                CM_complex_double);
    return field;
}

static void parts_of(struct format f, CM_field_id_t field, double *parts)
{
    int zero[2] = {0, 0}, side[2] = {HIGH, ACROSS}, axes[2] = {0, 1};
    CM_vector_t none = {.ints = zero}, all = {.ints = side}, both = {.ints = axes};
    CM_c_read_from_news_array_1L(parts, none, none, all, both, field, f.s, f.e, 2, all,
                                 CM_complex_double);
}

static void start(void)
{
    device_start(0);
    int side[2] = {HIGH, ACROSS};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = side}, 2)));
    CM_set_error_handler(device_error_catch);
    device_message[0] = 0;
}

/* ---- comparing ---- */

struct tolerance {
    double part;  /* largest error of each part, in units in the last place */
    double whole; /* where a part nearly cancels: in those of the magnitude; 0: never */
    bool endless; /* infinite parts are as in Annex G */
};

struct worst {
    double part, whole;
};

static double unit_of(struct format f, long double x)
{
    int exponent, least = 2 - (1 << (f.e - 1));
    frexpl(x, &exponent);
    exponent--;
    return ldexp(1, (exponent < least ? least : exponent) - (int)f.s);
}

static long double greatest_of(struct format f)
{
    return ldexpl(2 - ldexpl(1, -(int)f.s), (1 << (f.e - 1)) - 1);
}

/* The error in units in the last place, at most 1e9; 0 where wanted is a NaN. */
static double error_of(struct format f, double got, long double wanted, long double scale)
{
    long double most = greatest_of(f);
    if (isnan(wanted))
        return 0;
    if (fabsl(wanted) > most * 1.000001L)
        return isinf(got) && (got > 0) == (wanted > 0) ? 0 : 1e9;
    if (isinf(got) && fabsl(wanted) > most * 0.999999L)
        return 0;
    if (isnan(got) || isinf(got))
        return 1e9;
    long double by = unit_of(f, scale);
    return (double)(fabsl(got - wanted) / by);
}

static void compare(struct format f, const char *what, struct tolerance t, int n, double got,
                    long double wanted, long double whole, struct worst *w)
{
    if (!isfinite(samples[0][2 * n]) || !isfinite(samples[0][2 * n + 1])) {
        if (t.endless && !isnan(wanted) && (float)got != (float)wanted)
            fail_msg("%s of %g %+g i: a part is %g, not %Lg", what, samples[0][2 * n],
                     samples[0][2 * n + 1], got, wanted);
        return;
    }
    double part = error_of(f, got, wanted, wanted);
    if (part <= t.part || part == 0) {
        w->part = fmax(w->part, part);
        return;
    }
    double relative = error_of(f, got, wanted, whole);
    w->whole = fmax(w->whole, relative);
    if (!(relative <= t.whole))
        fail_msg("%u, %u: %s of %.17g %+.17g i, %.17g %+.17g i: a part is %.17g, not %.17Lg "
                 "(off by %g, %g units)",
                 f.s, f.e, what, samples[0][2 * n], samples[0][2 * n + 1], samples[1][2 * n],
                 samples[1][2 * n + 1], got, wanted, part, relative);
}

#endif
