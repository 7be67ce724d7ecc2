#include "oracle_scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RUN = 512 }; /* floats in one run, counted from the end where the scan begins */

static int stride_of(const struct scan_grid *g, int axis)
{
    int stride = 1;
    for (int a = g->rank - 1; a > axis; a--)
        stride *= g->dimensions[a];
    return stride;
}

/* Not strcmp(): it is asked for each number, and sanitizers check each call. */
static bool is(const char *a, const char *b)
{
    while (*a && *a == *b)
        a++, b++;
    return *a == *b;
}

/* ---- two numbers ---- */

static number infinity(int width, bool negative)
{
    return oracle_float_bits(width, negative ? -(double)INFINITY : (double)INFINITY);
}

static number identity_of(const struct scan_case *c)
{
    number all = oracle_mask(c->width), sign = (number)1 << (c->width - 1);
    if (c->letter == 'f')
        return is(c->op, "multiply") ? oracle_float_bits(c->width, 1)
               : is(c->op, "min")    ? infinity(c->width, false)
               : is(c->op, "max")    ? infinity(c->width, true)
                                     : 0;
    if (is(c->op, "logand"))
        return all;
    if (is(c->op, "min"))
        return c->letter == 's' ? all ^ sign : all;
    if (is(c->op, "max"))
        return c->letter == 's' ? sign : 0;
    return 0;
}

static number join_floats(const struct scan_case *c, number a, number b)
{
    double x = oracle_float_value(c->width, a), y = oracle_float_value(c->width, b);
    if (is(c->op, "add") || is(c->op, "multiply"))
        return oracle_float(c->op, c->width, a, b).bits;
    if (isnan(y))
        return a;
    bool less = x < y || (x == y && signbit(x) && !signbit(y));
    return less == is(c->op, "min") ? a : b;
}

static number join(const struct scan_case *c, number a, number b)
{
    if (c->letter == 'f')
        return join_floats(c, a, b);
    if (is(c->op, "logand"))
        return a & b;
    if (is(c->op, "logior"))
        return a | b;
    if (is(c->op, "logxor"))
        return a ^ b;
    return oracle_integer(c->op, c->letter == 's', a, c->width, b, c->width, c->width).bits;
}

/* ---- a line ---- */

struct line {
    const struct scan_case *c;
    int first, step, length; /* processors, in the scan's direction */
};

static int at(const struct line *l, int k)
{
    return l->first + k * l->step;
}

static struct line line_of(const struct scan_grid *g, const struct scan_case *c, int processor,
                           bool downward, int *k)
{
    int stride = stride_of(g, c->axis), length = g->dimensions[c->axis];
    int coordinate = processor / stride % length, lowest = processor - coordinate * stride;
    *k = downward ? length - 1 - coordinate : coordinate;
    return (struct line){c, downward ? lowest + (length - 1) * stride : lowest,
                         downward ? -stride : stride, length};
}

static bool begins(const struct line *l, int k)
{
    const struct scan_case *c = l->c;
    if (k == 0)
        return true;
    if (c->smode == 0)
        return false;
    if (c->smode == 1)
        return c->sbit[at(l, k)] && c->context[at(l, k)];
    /* the first in upward order */
    return l->step > 0 ? c->sbit[at(l, k)] != 0 : c->sbit[at(l, k - 1)] != 0;
}

/* Combines elements p to q - 1, one after the other. */
static number combination(const struct line *l, int p, int q)
{
    number sum = identity_of(l->c);
    for (int k = p; k < q; k++)
        if (l->c->context[at(l, k)])
            sum = join(l->c, sum, l->c->source[at(l, k)]);
    return sum;
}

/* Combines floats in the order that machine_scan() defines. */
static number in_runs(const struct line *l, int start, int stop, int self)
{
    int run = self / RUN * RUN;
    if (l->c->letter != 'f' || start >= run)
        return combination(l, start, stop);
    int end = start / RUN * RUN + RUN;
    number before = combination(l, start, end);
    for (; end < run; end += RUN)
        before = join(l->c, before, combination(l, end, end + RUN));
    return join(l->c, before, combination(l, run, stop));
}

void oracle_scan(const struct scan_grid *g, const struct scan_case *c, number *dest)
{
    number *result = malloc((size_t)g->count * sizeof *result);
    for (int n = 0; n < g->count; n++) {
        int k, start;
        struct line l = line_of(g, c, n, c->direction == 1, &k);
        if (!c->context[n])
            continue;
        for (start = k; !begins(&l, start); start--)
            ;
        int stop = c->inclusion ? k + 1 : k;
        result[n] = 0;
        if (is(c->op, "copy")) {
            for (int i = stop - 1; i >= start; i--)
                if (c->context[at(&l, i)])
                    result[n] = c->source[at(&l, i)];
        } else {
            result[n] = in_runs(&l, start, stop, k);
        }
    }
    for (int n = 0; n < g->count; n++)
        if (c->context[n])
            dest[n] = result[n];
    free(result);
}

/* ---- spreads ---- */

static number *duplicate(const number *from, int count)
{
    number *to = malloc((size_t)count * sizeof *to);
    memcpy(to, from, (size_t)count * sizeof *to);
    return to;
}

void oracle_spread(const struct scan_grid *g, const struct scan_case *c, unsigned int mask,
                   int to, int from, number *dest)
{
    number *source = duplicate(c->source, g->count), *context = duplicate(c->context, g->count);
    int stride = stride_of(g, c->axis), length = g->dimensions[c->axis];
    for (int axis = g->rank - 1; axis >= 0; axis--) {
        if (!(mask >> axis & 1))
            continue;
        number *next = malloc((size_t)g->count * sizeof *next);
        struct scan_case all = *c;
        all.axis = axis;
        all.smode = 0;
        all.source = source;
        all.context = context;
        for (int n = 0; n < g->count; n++) {
            int k;
            struct line l = line_of(g, &all, n, false, &k);
            next[n] = is(c->op, "copy") ? source[at(&l, from)]
                                        : in_runs(&l, 0, l.length, l.length - 1);
        }
        free(source);
        source = next;
        for (int n = 0; n < g->count; n++)
            context[n] = 1;
    }
    for (int n = 0; n < g->count; n++)
        if (c->context[n] && (to < 0 || n / stride % length == to))
            dest[n] = source[n];
    free(source);
    free(context);
}

/* ---- ranks ---- */

/* Whether a ranks before b by its value alone. */
static bool before(const struct scan_case *c, number a, number b)
{
    if (c->letter == 'f') {
        double x = oracle_float_value(c->width, a), y = oracle_float_value(c->width, b);
        if (isnan(x) || isnan(y))
            return isnan(y) && !isnan(x);
        return c->direction ? x > y : x < y;
    }
    number x = oracle_extend(a, c->width, c->letter == 's'),
           y = oracle_extend(b, c->width, c->letter == 's');
    bool less = c->letter == 's' ? (__int128)x < (__int128)y : x < y,
         more = c->letter == 's' ? (__int128)x > (__int128)y : x > y;
    return c->direction ? more : less;
}

void oracle_rank(const struct scan_grid *g, const struct scan_case *c, number *dest)
{
    number *result = malloc((size_t)g->count * sizeof *result);
    for (int n = 0; n < g->count; n++) {
        int k, start, stop;
        struct line l = line_of(g, c, n, false, &k);
        if (!c->context[n])
            continue;
        for (start = k; !begins(&l, start); start--)
            ;
        for (stop = k + 1; stop < l.length && !begins(&l, stop); stop++)
            ;
        int rank = start;
        for (int i = start; i < stop; i++) {
            int other = at(&l, i);
            if (i == k || !c->context[other])
                continue;
            bool first = before(c, c->source[other], c->source[n]),
                 equal = !first && !before(c, c->source[n], c->source[other]);
            rank += first || (equal && i < k);
        }
        result[n] = (number)rank;
    }
    for (int n = 0; n < g->count; n++)
        if (c->context[n])
            dest[n] = result[n];
    free(result);
}
