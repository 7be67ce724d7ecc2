/* wind.h - a kind of event with a member of every kind, for the tests of events. */
#ifndef LUTETIA_TESTS_EVENTS_WIND_H
#define LUTETIA_TESTS_EVENTS_WIND_H

#include <kinds.h>
#include <scale.h>
#include <stream.h>

#include <stdlib.h>

enum { WIND_LEAVES_MAX = 1000 };

struct wind {
    double speed, from[2];
    int height;
    uint64_t seed;
    bool gusts;
    char name[16];
    int leaves_count;
    const double *leaves;
};

static void leaves_pass(struct event_stream *s, void *start, void *of)
{
    (void)start;
    struct wind *wind = of;
    uint64_t count = event_pass_number(s, (uint64_t)wind->leaves_count, 4);
    event_stream_expect(s, count <= WIND_LEAVES_MAX);
    if (!event_stream_good(s))
        return;
    void *leaves = event_pass_array(s, wind->leaves, (size_t)count * sizeof *wind->leaves);
    if (s->in && leaves) {
        wind->leaves_count = (int)count;
        wind->leaves = leaves;
    }
}

static bool leaves_scale(void *start, void *of, const struct event_scaling *scaling)
{
    (void)start;
    struct wind *wind = of;
    double *leaves = members_owned(wind->leaves);
    for (int i = 0; i < wind->leaves_count; i++)
        leaves[i] *= scaling->length * *(const double *)scaling->context;
    return true;
}

static void leaves_free(void *start, void *of)
{
    (void)start;
    free(members_owned(((const struct wind *)of)->leaves));
}

static const struct member_form leaves_form = {leaves_pass, leaves_scale, leaves_free};

static const struct member wind_rows[] = {
    MEMBER(wind, speed, DOUBLE, 1, PACE, "speed", 0, 40, .unit = "m/s"),
    MEMBER(wind, from, DOUBLE, 2, PULL, "direction", -1, 1),
    MEMBER(wind, height, INT, 1, LENGTH, "height", 1, 500, .unit = "m"),
    KEPT(wind, seed, WORD, 1),
    KEPT(wind, gusts, FLAG, 1),
    KEPT(wind, name, TEXT, 16),
    FORM(wind, leaves, leaves_form),
};
static const struct members wind_members = MEMBERS_OF(wind_rows);
static const struct event_kind wind_kind = {"wind", "the wind's ", sizeof(struct wind),
                                            &wind_members};

#endif
