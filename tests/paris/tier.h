/* tier.h - the ways in which a machine may execute a program, for tests that run the same
 * program in several. Include after cmocka's headers. */
#ifndef LUTETIA_TESTS_PARIS_TIER_H
#define LUTETIA_TESTS_PARIS_TIER_H

#include "paris_internal.h"

#include <stdlib.h>

/* The values of LUTETIA_NEAR, _INTERPRET, _AT_ONCE, _GATHER and _REPLAY; NULL: that stays as it
 * is. */
struct tier {
    const char *name, *near, *interpret, *at_once;
    bool eager;
    int every; /* of so many programs one is run in it */
    const char *gather, *replay;
};

/* Begins a machine anew, in that way; processors 0: as many as there are usually. */
static inline void tier_begin(const struct tier *t, int processors)
{
    struct machine_config config = machine_config_default();
    setenv("LUTETIA_NEAR", t->near, 1);
    setenv("LUTETIA_INTERPRET", t->interpret, 1);
    setenv("LUTETIA_AT_ONCE", t->at_once, 1);
    if (t->gather)
        setenv("LUTETIA_GATHER", t->gather, 1);
    if (t->replay)
        setenv("LUTETIA_REPLAY", t->replay, 1);
    config.eager = t->eager;
    if (processors)
        config.processors_count = processors;
    assert_true(paris_reset(&config));
}

#endif
