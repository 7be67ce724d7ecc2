/* members.h - of what the arguments of operations consist, described once. A row for each member says its name and range, how it
 * is kept, and what becomes of it at another resolution; checking (arguments/members.c), bytes (event/bytes.c) and scaling
 * (event/scale.c) walk the same rows.
 *
 *     static const struct member lift_rows[] = {
 *         HELD(paper_lift, place, PLACE, 1),
 *         MEMBER(paper_lift, part, DOUBLE, 1, NOT, "part", 0, 1),
 *     };
 */
#ifndef LUTETIA_PAPER_EVENT_MEMBERS_H
#define LUTETIA_PAPER_EVENT_MEMBERS_H

#include "paper.h"

#include <stddef.h>

enum member_kind {
    MEMBER_DOUBLE,
    MEMBER_INT,
    MEMBER_WORD, /* uint64_t */
    MEMBER_FLAG,
    MEMBER_TEXT,    /* count characters, the last 0 */
    MEMBER_PLACE,   /* struct paper_place */
    MEMBER_PLANE,   /* const float *: one for each fiber */
    MEMBER_SAMPLES, /* samples and their count in struct paper_stroke, which is at offset 0 */
    MEMBER_AMOUNTS  /* the arrays of struct paper_print, which is at offset 0 */
};

/* What becomes of a number at another resolution: s fibers for one and t steps for one. */
enum member_scaling {
    SCALE_NOT,
    SCALE_LENGTH, /* s */
    SCALE_RATE,   /* 1/t: what happens in each fiber in a step */
    SCALE_SPREAD, /* s * s / t: part of a gradient that flows in a step */
    SCALE_PULL,   /* s / t: part of an amount that goes on by a fiber in a step */
    SCALE_PACE,   /* t: steps in a second */
};

struct member {
    const char *name; /* for messages; NULL: its range is not checked here */
    enum member_kind kind;
    enum member_scaling scaling;
    size_t offset;
    int count;
    double least, most; /* what is scaled stays within them; 0, 0: any */
};

struct members {
    const struct member *first;
    size_t count;
};

#define MEMBER(type, member, kind, count, scaling, name, least, most)                          \
    {                                                                                          \
        name, MEMBER_##kind, SCALE_##scaling, offsetof(struct type, member), count, least,     \
            most                                                                               \
    }
/* Of which nothing is said but how it is kept. */
#define HELD(type, member, kind, count) MEMBER(type, member, kind, count, NOT, NULL, 0, 0)
#define MEMBERS_OF(rows)                                                                       \
    {                                                                                          \
        rows, sizeof(rows) / sizeof *(rows)                                                    \
    }

/* In files: their order and kinds never change. */
extern const struct members event_air_members, event_stock_members, event_pigment_members,
    event_put_members, event_blot_members, event_resist_members, event_layer_members,
    event_brush_members, event_dip_members, event_stroke_members, event_sample_members,
    event_salt_members, event_wash_members, event_print_members, event_lift_members,
    event_varnish_members;

/* Whether all numbers are within their ranges: "WHOSE NAME must be LEAST..MOST (got X WHERE)". `whose` ends in a space or is empty,
 * `where` begins with one or is empty. Errors: BAD_ARGUMENT. */
enum paper_status event_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where);

/* What an operation's arguments point to is their owner's to change, though operations may only read it. */
static inline void *event_owned(const void *pointer)
{
    return (void *)(uintptr_t)pointer;
}

#endif
