/* members.h - describes the members of a struct of arguments, once. A row for each member gives
 * its name, unit and range, how it is stored, and how it scales. Checking (here), bytes
 * (stream.h), scaling (scale.h), the fields of scripts and the tables of the documentation all
 * use the same rows.
 *
 *     static const struct member wind_rows[] = {
 *         MEMBER(wind, speed, DOUBLE, 1, PACE, "speed", 0, 40, .unit = "m/s"),
 *         MEMBER(wind, from, DOUBLE, 1, NOT, "direction", -7, 7, .unit = "rad"),
 *         KEPT(wind, gusts, FLAG, 1),
 *     };
 *     static const struct members wind_members = MEMBERS_OF(wind_rows);
 *
 * Files depend on the order and the kinds of rows, so these never change.
 */
#ifndef LUTETIA_EVENTS_MEMBERS_H
#define LUTETIA_EVENTS_MEMBERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum member_kind {
    MEMBER_DOUBLE,
    MEMBER_INT,
    MEMBER_WORD, /* uint64_t */
    MEMBER_FLAG, /* bool */
    MEMBER_TEXT, /* char[count], the last 0 */
    MEMBER_FORM  /* stored and scaled by the module's own functions: see struct member_form */
};

/* How a number changes when lengths are multiplied by s and the number of steps by t. */
enum member_scaling {
    SCALE_NOT,
    SCALE_LENGTH, /* s */
    SCALE_RATE,   /* 1/t: a rate of something that happens at each place in each step */
    SCALE_SPREAD, /* s * s / t: the part of a gradient that flows in a step */
    SCALE_PULL,   /* s / t: the part of an amount that moves on by one place in a step */
    SCALE_PACE    /* t: steps in a second */
};

struct event_stream;  /* stream.h */
struct event_scaling; /* scale.h */

/* Functions for members that are not plain numbers. `start` points to the member, `of` to
 * the whole struct. */
struct member_form {
    /* Writes the member's bytes, or reads it from them. Before reading, the member is zero
     * bytes; afterwards the struct owns what was read. */
    void (*pass)(struct event_stream *s, void *start, void *of);
    /* NULL: the member does not scale. False: no memory. */
    bool (*scale)(void *start, void *of, const struct event_scaling *scaling);
    void (*free)(void *start, void *of); /* frees what the member owns; NULL: nothing */
};

struct member {
    const char *name; /* in messages; NULL: its range is checked elsewhere */
    enum member_kind kind;
    enum member_scaling scaling;
    size_t offset;
    int count;
    double least, most; /* the range, to which scaled values are clamped; 0, 0: any value */
    const char *unit;   /* NULL: a plain number */
    const struct member_form *form;
    /* For scripts and the documentation. */
    const char *field; /* the field's name there; NULL: scripts cannot set it */
    int element; /* index in that field's list, from 1 (rows of one field follow each other);
                  * 0: the field is the member itself */
    double per_unit;   /* the script's units in one of ours, 180/pi for degrees; 0: 1 */
    const char *usual; /* the default, in words */
    const char *help;  /* in a field's first row */
};

struct members {
    const struct member *first;
    size_t count;
};

#define MEMBER(type, at, form_, number, becomes, called, low, high, ...)                       \
    {                                                                                          \
        .name = called, .kind = MEMBER_##form_, .scaling = SCALE_##becomes,                    \
        .offset = offsetof(struct type, at), .count = number, .least = low, .most = high,      \
        __VA_ARGS__                                                                            \
    }
/* A member that is only stored: no name, unit or range. */
#define KEPT(type, at, form_, number, ...)                                                     \
    MEMBER(type, at, form_, number, NOT, NULL, 0, 0, __VA_ARGS__)
/* A member stored by the module's own functions. */
#define FORM(type, at, functions)                                                              \
    MEMBER(type, at, FORM, 1, NOT, NULL, 0, 0, .form = &(functions))
#define MEMBERS_OF(rows)                                                                       \
    {                                                                                          \
        rows, sizeof(rows) / sizeof *(rows)                                                    \
    }

/* Checks that all numbers are within their ranges. If not, `text` gets "WHOSE NAME must be
 * LEAST..MOST (got X WHERE)". `whose` ends in a space or is empty, `where` begins with one
 * or is empty. A NaN is outside every range. */
bool members_check(const struct members *members, const void *of, const char *whose,
                   const char *where, char *text, size_t room);

/* Frees what the members own, but not the struct. */
void members_free(const struct members *members, void *of);

/* The owner of arguments may change what they point to; operations may only read it. */
static inline void *members_owned(const void *pointer)
{
    return (void *)(uintptr_t)pointer;
}

#endif
