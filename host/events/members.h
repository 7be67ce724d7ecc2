/* members.h - of what a struct of arguments consists, described once. A row for each member says its name, unit and range, how it is
 * kept, and what becomes of it at another scale.  Checking (here), bytes (stream.h), scaling (scale.h), the fields of scripts and
 * the tables of the documentation walk the same rows.
 *
 *     static const struct member wind_rows[] = {
 *         MEMBER(wind, speed, DOUBLE, 1, PACE, "speed", 0, 40, .unit = "m/s"),
 *         MEMBER(wind, from, DOUBLE, 1, NOT, "direction", -7, 7, .unit = "rad"),
 *         KEPT(wind, gusts, FLAG, 1),
 *     };
 *     static const struct members wind_members = MEMBERS_OF(wind_rows);
 *
 * In files the order and the kinds of rows never change. */
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
    MEMBER_FORM  /* what the module's own functions keep and scale: see struct member_form */
};

/* What becomes of a number where lengths are s times as long and times t times as many steps. */
enum member_scaling {
    SCALE_NOT,
    SCALE_LENGTH, /* s */
    SCALE_RATE,   /* 1/t: what happens in each place in a step */
    SCALE_SPREAD, /* s * s / t: part of a gradient that flows in a step */
    SCALE_PULL,   /* s / t: part of an amount that goes on by a place in a step */
    SCALE_PACE    /* t: steps in a second */
};

struct event_stream;  /* stream.h */
struct event_scaling; /* scale.h */

/* Functions for members that are no plain numbers. `start` is the member, `of` the whole struct. */
struct member_form {
    /* Puts the member's bytes, or gets it from them. What is gotten is zero bytes before, and owned by the struct after. */
    void (*pass)(struct event_stream *s, void *start, void *of);
    /* NULL: it stays as it is. False: no memory. */
    bool (*scale)(void *start, void *of, const struct event_scaling *scaling);
    void (*free)(void *start, void *of); /* what it owns; NULL: nothing */
};

struct member {
    const char *name; /* in messages; NULL: its range is checked by others */
    enum member_kind kind;
    enum member_scaling scaling;
    size_t offset;
    int count;
    double least, most; /* what is scaled stays within them; 0, 0: any */
    const char *unit;   /* NULL: a plain number */
    const struct member_form *form;
    /* What scripts and the documentation say of it. */
    const char *field; /* its name there; NULL: no script sets it so */
    int element; /* of that field's list, from 1: rows of one field follow each other; 0: the field is the member */
    double per_unit;   /* the script's numbers for one of ours, 180/pi for degrees; 0: 1 */
    const char *usual; /* its default, in words */
    const char *help;  /* of a field's first row */
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
/* Of which nothing is said but how it is kept. */
#define KEPT(type, at, form_, number, ...)                                                     \
    MEMBER(type, at, form_, number, NOT, NULL, 0, 0, __VA_ARGS__)
/* What the module's own functions keep. */
#define FORM(type, at, functions)                                                              \
    MEMBER(type, at, FORM, 1, NOT, NULL, 0, 0, .form = &(functions))
#define MEMBERS_OF(rows)                                                                       \
    {                                                                                          \
        rows, sizeof(rows) / sizeof *(rows)                                                    \
    }

/* Whether all numbers are within their ranges. If not, `text` gets "WHOSE NAME must be LEAST..MOST (got X WHERE)". `whose` ends in a
 * space or is empty, `where` begins with one or is empty. A NaN is in no range. */
bool members_check(const struct members *members, const void *of, const char *whose,
                   const char *where, char *text, size_t room);

/* Frees what the struct's forms own, not the struct. */
void members_free(const struct members *members, void *of);

/* What arguments point to is their owner's to change, though operations may only read it. */
static inline void *members_owned(const void *pointer)
{
    return (void *)(uintptr_t)pointer;
}

#endif
