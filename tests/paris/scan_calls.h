/* scan_calls.h - the calls of each operation along axes, as rows of one table. */
#ifndef PARIS_TESTS_SCAN_CALLS_H
#define PARIS_TESTS_SCAN_CALLS_H

#include "device.h"

struct call {
    CM_field_id_t dest, source, sbit;
    unsigned int axis, len, s, e, direction, inclusion, smode, to, from, mask;
};

struct row {
    char letter;
    const char *op;
    void (*scan)(const struct call *), (*spread)(const struct call *),
        (*multispread)(const struct call *), (*reduce)(const struct call *);
};

#define LEN_u c->len
#define LEN_s c->len
#define LEN_b c->len
#define LEN_f c->s, c->e
#define SCAN_CALL(name, ...)                                                                   \
    static void scan_##name(const struct call *c)                                              \
    {                                                                                          \
        CM_scan_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__, c->direction,       \
                                 c->inclusion, c->smode, c->sbit);                             \
    }
#define CALLS(name, ...)                                                                       \
    SCAN_CALL(name, __VA_ARGS__)                                                               \
    static void spread_##name(const struct call *c)                                            \
    {                                                                                          \
        CM_spread_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__);                  \
    }                                                                                          \
    static void multispread_##name(const struct call *c)                                       \
    {                                                                                          \
        CM_multispread_with_##name##_1L(c->dest, c->source, c->mask, __VA_ARGS__);             \
    }                                                                                          \
    static void reduce_##name(const struct call *c)                                            \
    {                                                                                          \
        CM_reduce_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__, c->to);           \
    }
CALLS(u_add, LEN_u)
CALLS(u_min, LEN_u)
CALLS(u_max, LEN_u)
CALLS(s_add, LEN_s)
CALLS(s_min, LEN_s)
CALLS(s_max, LEN_s)
CALLS(logand, LEN_b)
CALLS(logior, LEN_b)
CALLS(logxor, LEN_b)
CALLS(f_add, LEN_f)
CALLS(f_multiply, LEN_f)
CALLS(f_min, LEN_f)
CALLS(f_max, LEN_f)
SCAN_CALL(copy, LEN_b)
static void spread_copy(const struct call *c)
{
    CM_spread_with_copy_1L(c->dest, c->source, c->axis, c->len, c->from);
}
static void reduce_copy(const struct call *c)
{
    CM_reduce_with_copy_1L(c->dest, c->source, c->axis, c->len, c->to, c->from);
}

#define ROW(letter, op, name)                                                                  \
    {                                                                                          \
        letter, op, scan_##name, spread_##name, multispread_##name, reduce_##name              \
    }
static const struct row rows[] = {
    ROW('u', "add", u_add),           ROW('u', "min", u_min),
    ROW('u', "max", u_max),           ROW('s', "add", s_add),
    ROW('s', "min", s_min),           ROW('s', "max", s_max),
    ROW('b', "logand", logand),       ROW('b', "logior", logior),
    ROW('b', "logxor", logxor),       ROW('f', "add", f_add),
    ROW('f', "multiply", f_multiply), ROW('f', "min", f_min),
    ROW('f', "max", f_max),           {'b', "copy", scan_copy, spread_copy, NULL, reduce_copy},
};
enum { ROWS_COUNT = sizeof rows / sizeof *rows };

#endif
