/* oracle.c - each function below is one Paris instruction as a double loop over the fibers. */
#include "oracle.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Indices of real[], in page.h's order of fields. */
enum {
    WATER,
    ABSORBENCY,
    CYAN,
    MAGENTA,
    YELLOW,
    TEMP1,
    TEMP2,
    INWARD,
    OUTWARD,
    INFLOW,
    OUTFLOW
};
enum axis { AXIS_Y, AXIS_X };
enum direction { UPWARD, DOWNWARD };

static void *planes(size_t count, size_t size)
{
    void *p = calloc(count, size);

    if (!p)
        abort();
    return p;
}

void oracle_init(struct oracle *o, int width, int height)
{
    size_t count = (size_t)width * (size_t)height;

    memset(o, 0, sizeof *o);
    o->width = width;
    o->height = height;
    for (int n = 0; n < 11; n++)
        o->real[n] = planes(count, sizeof(float));
    o->image = planes(count, sizeof(uint32_t));
    o->saved = planes(count, 1);
    o->old_context = planes(count, 1);
    o->context = planes(count, 1);
    o->test = planes(count, 1);
    o->overflow = planes(count, 1);
    memset(o->context, 1, count);
}

void oracle_finish(struct oracle *o)
{
    for (int n = 0; n < 11; n++)
        free(o->real[n]);
    free(o->image);
    free(o->saved);
    free(o->old_context);
    free(o->context);
    free(o->test);
    free(o->overflow);
}

#define EACH_FIBER(o, n)                                                                       \
    for (int y_ = 0; y_ < (o)->height; y_++)                                                   \
        for (int x_ = 0, n = y_ * (o)->width; x_ < (o)->width; x_++, n++)

/* ---- context and test ---- */

static void store_context(struct oracle *o, uint8_t *bit)
{
    EACH_FIBER(o, n) bit[n] = o->context[n];
}

static void load_context(struct oracle *o, const uint8_t *bit)
{
    EACH_FIBER(o, n) o->context[n] = bit[n];
}

static void logand_context_with_test(struct oracle *o)
{
    EACH_FIBER(o, n) o->context[n] &= o->test[n];
}

static void gt_zero(struct oracle *o, const float *a)
{
    EACH_FIBER(o, n)
    {
        if (o->context[n])
            o->test[n] = a[n] > 0.0f;
    }
}

static void lt_zero(struct oracle *o, const float *a)
{
    EACH_FIBER(o, n)
    {
        if (o->context[n])
            o->test[n] = a[n] < 0.0f;
    }
}

static void coordinate_test(struct oracle *o, enum axis axis, bool at_least, int limit)
{
    EACH_FIBER(o, n)
    {
        int coordinate = axis == AXIS_X ? x_ : y_;

        if (o->context[n])
            o->test[n] = at_least ? coordinate >= limit : coordinate <= limit;
    }
}

static void turn_on_context(struct oracle *o, uint8_t *saved, int x1, int y1, int x2, int y2)
{
    store_context(o, saved);
    coordinate_test(o, AXIS_X, true, x1);
    logand_context_with_test(o);
    coordinate_test(o, AXIS_X, false, x2);
    logand_context_with_test(o);
    coordinate_test(o, AXIS_Y, true, y1);
    logand_context_with_test(o);
    coordinate_test(o, AXIS_Y, false, y2);
    logand_context_with_test(o);
}

/* ---- float instructions; the four that can overflow set the overflow flag ---- */

static void keep(struct oracle *o, int n, float *dest, float result, float a, float b)
{
    dest[n] = result;
    o->overflow[n] = isinf(result) && isfinite(a) && isfinite(b);
}

#define ARITHMETIC(name, expression)                                                           \
    static void name(struct oracle *o, float *dest, const float *pa, const float *pb)          \
    {                                                                                          \
        EACH_FIBER(o, n)                                                                       \
        {                                                                                      \
            float a = pa[n], b = pb[n];                                                        \
                                                                                               \
            if (o->context[n])                                                                 \
                keep(o, n, dest, expression, a, b);                                            \
        }                                                                                      \
    }

#define ARITHMETIC_CONSTANT(name, expression)                                                  \
    static void name(struct oracle *o, float *dest, const float *pa, float b)                  \
    {                                                                                          \
        EACH_FIBER(o, n)                                                                       \
        {                                                                                      \
            float a = pa[n];                                                                   \
                                                                                               \
            if (o->context[n])                                                                 \
                keep(o, n, dest, expression, a, b);                                            \
        }                                                                                      \
    }

ARITHMETIC(add, a + b)
ARITHMETIC(subtract, a - b)
ARITHMETIC(multiply, a *b)
ARITHMETIC_CONSTANT(multiply_constant, a *b)
ARITHMETIC_CONSTANT(divide_constant, a / b)

static void min_constant(struct oracle *o, float *dest, float b)
{
    EACH_FIBER(o, n)
    {
        if (o->context[n])
            dest[n] = dest[n] < b ? dest[n] : b;
    }
}

static void max_constant(struct oracle *o, float *dest, float b)
{
    EACH_FIBER(o, n)
    {
        if (o->context[n])
            dest[n] = dest[n] > b ? dest[n] : b;
    }
}

/* upward fetches from the next greater coordinate, downward from the next smaller; both wrap
 * round */
static void get_from_news(struct oracle *o, float *dest, const float *source, enum axis axis,
                          enum direction direction)
{
    int step = direction == UPWARD ? 1 : -1;

    EACH_FIBER(o, n)
    {
        int x = axis == AXIS_X ? (x_ + step + o->width) % o->width : x_;
        int y = axis == AXIS_Y ? (y_ + step + o->height) % o->height : y_;

        if (o->context[n])
            dest[n] = source[y * o->width + x];
    }
}

/* ---- appendix 7.4 ---- */

static void adjust_for_gravity(struct oracle *o)
{
    float *inward = o->real[INWARD];

    store_context(o, o->old_context);
    gt_zero(o, inward);
    logand_context_with_test(o);
    multiply_constant(o, inward, inward, o->gravity);
    load_context(o, o->old_context);

    store_context(o, o->old_context);
    lt_zero(o, inward);
    logand_context_with_test(o);
    divide_constant(o, inward, inward, o->gravity);
    load_context(o, o->old_context);
}

static void move_along(struct oracle *o, float *what, enum axis axis)
{
    get_from_news(o, o->real[OUTWARD], o->real[INWARD], axis, UPWARD);
    add(o, what, what, o->real[INWARD]);
    subtract(o, what, what, o->real[OUTWARD]);
    min_constant(o, what, 1.0f);
    max_constant(o, what, 0.0f);
}

static void disperse_to_neighbor(struct oracle *o, enum axis axis)
{
    float *inward = o->real[INWARD], *inflow = o->real[INFLOW], *water = o->real[WATER];

    turn_on_context(o, o->saved, 2, 2, o->width - 2, o->height - 2);

    get_from_news(o, inflow, water, axis, DOWNWARD);
    subtract(o, inward, inflow, water);
    multiply(o, inward, inward, o->real[ABSORBENCY]);
    adjust_for_gravity(o);
    move_along(o, water, axis);

    for (int i = 0; i < 3; i++) {
        float *pigment = o->real[CYAN + i];

        get_from_news(o, inflow, pigment, axis, DOWNWARD);
        subtract(o, inward, inflow, pigment);
        multiply(o, inward, inward, o->real[ABSORBENCY]);
        multiply(o, inward, inward, water);
        multiply_constant(o, inward, inward, o->molecular_weight[i]);
        adjust_for_gravity(o);
        move_along(o, pigment, axis);
    }
    load_context(o, o->saved);
}

void oracle_disperse(struct oracle *o)
{
    disperse_to_neighbor(o, AXIS_X);
    disperse_to_neighbor(o, AXIS_Y);
}

/* ---- appendix 7.5 ---- */

void oracle_screen(struct oracle *o, const uint8_t *gray, int width, int height, int x_off,
                   int y_off, float cyan, float magenta, float yellow, float water)
{
    const int inks[4] = {CYAN, MAGENTA, YELLOW, WATER};
    const float amounts[4] = {cyan, magenta, yellow, water};

    EACH_FIBER(o, n)
    {
        if (o->context[n])
            o->image[n] = 0;
    }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            o->image[(y + y_off) * o->width + x + x_off] = gray[y * width + x];

    turn_on_context(o, o->saved, x_off, y_off, x_off + width - 1, y_off + height - 1);
    EACH_FIBER(o, n)
    {
        if (o->context[n])
            o->real[TEMP1][n] = (float)(o->image[n] & 0xff);
    }
    divide_constant(o, o->real[TEMP1], o->real[TEMP1], 255.0f);
    for (int k = 0; k < 4; k++) {
        float *ink = o->real[inks[k]];

        multiply_constant(o, o->real[TEMP2], o->real[TEMP1], amounts[k]);
        add(o, ink, ink, o->real[TEMP2]);
        min_constant(o, ink, 1.0f);
        max_constant(o, ink, 0.0f);
    }
    load_context(o, o->saved);
}

uint32_t oracle_word(const struct oracle *o, int page_field, int n)
{
    const uint8_t *bits[5] = {o->saved, o->old_context, o->context, o->test, o->overflow};
    uint32_t word;

    if (page_field < 11) {
        memcpy(&word, &o->real[page_field][n], sizeof word);
        return word;
    }
    if (page_field == 11)
        return o->image[n];
    return bits[page_field - 12][n];
}
