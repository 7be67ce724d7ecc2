/* slot_programs.h - random programs whose operands overlap, and what they do, in plain bits.
 * Knows nothing of the machine.
 *
 * A program has VP sets of one, two and four processors to each of 16 physical ones, in send
 * order, and fields of odd lengths. Its steps take parts of fields that overlap each other. Its
 * body is performed several times, as loops are. In some programs a field is also seen from
 * another set, by an alias.
 *
 *     slot_program_make (&p, seed);
 *     slot_memory_init (&memory, &p);
 *     slot_step_perform (&memory, &p.steps[i]);
 *     number x = slot_bits (&memory, field, vp, 0, 32) */
#ifndef PARIS_TESTS_SLOT_PROGRAMS_H
#define PARIS_TESTS_SLOT_PROGRAMS_H

#include <stdint.h>

#include "oracle.h"

enum {
    SLOT_PROCESSORS = 16,
    SLOT_SETS = 3,
    SLOT_FIELDS = 9, /* three in each set */
    SLOT_ALIAS = SLOT_FIELDS,
    SLOT_STEPS = 24,
    SLOT_BITS = 133,
    SLOT_VPS = 4 * SLOT_PROCESSORS
};

enum slot_kind {
    SLOT_MOVE,
    SLOT_MOVE_SIGNED,
    SLOT_XOR,
    SLOT_NOT,
    SLOT_ADD,
    SLOT_SUBTRACT,
    SLOT_MAX_SIGNED,
    SLOT_MIN,
    SLOT_FADD,
    SLOT_FMULTIPLY,
    SLOT_LESS,
    SLOT_STORE_TEST,
    SLOT_STORE_FLAGS, /* context, test, overflow: three bits */
    SLOT_LOAD_CONTEXT,
    SLOT_AND_TEST,
    SLOT_AND_OVERFLOW,
    SLOT_ALL,
    SLOT_NEWS,
    SLOT_SEND_MAX,
    SLOT_SEND_ADD,
    SLOT_SEND_XOR,
    SLOT_GET,
    SLOT_RANK,
    SLOT_SCAN,
    SLOT_ENUMERATE,
    SLOT_SUM,       /* to the front end */
    SLOT_WRITE,     /* one processor */
    SLOT_WRITE_ALL, /* whatever the context */
    SLOT_SWAP,
    SLOT_FMAX,
    SLOT_FMOVE,
    SLOT_FLESS,
    SLOT_ADDRESS, /* my_news_coordinate */
    SLOT_SEND,    /* these two combine with logxor where two messages meet */
    SLOT_SEND_FADD,
    SLOT_FRANK,
    SLOT_SCAN_COPY,
    SLOT_SCAN_MAX,
    SLOT_SPREAD,
    SLOT_SPREAD_ADD,
    SLOT_GREATEST, /* to the front end */
    SLOT_AIM,      /* make_news_coordinate: the address of a processor of the set */
    SLOT_KINDS
};

/* A part of a field. */
struct slot_part {
    int field, at;
};

struct slot_step {
    enum slot_kind kind;
    int set; /* the current one */
    struct slot_part to, a, b;
    int length, shorter; /* of `to`; of the source where that is another */
    int upward, inclusive, vp;
    int smode; /* of ranks and scans, as in <cm/paris.h> */
    struct slot_part bit;
    uint64_t number; /* of SLOT_WRITE; the seed of SLOT_WRITE_ALL */
};

/* How much is looked at. */
enum slot_look {
    SLOT_LOOK_ALWAYS, /* at everything after each step */
    SLOT_LOOK_TURNS,
    SLOT_LOOK_SOME,  /* at a field after every third step */
    SLOT_LOOK_PARTS, /* at up to 64 bits of a field after each step */
    SLOT_LOOK_END
};

struct slot_program {
    int ratio[SLOT_SETS], bits[SLOT_FIELDS + 1], set[SLOT_FIELDS + 1];
    struct slot_step steps[SLOT_STEPS];
    int steps_count, turns;
    enum slot_kind kinds[SLOT_KINDS]; /* those that it is made of, in these sets */
    int kinds_count, sets_used;
    enum slot_look look;
    /* A field that is seen from another set from a turn on, for as long as another turn; none:
     * -1. */
    int aliased, alias_from, alias_to;
    bool safe;        /* in safety mode */
    bool parts_again; /* parts are often those of earlier steps */
};

struct slot_memory {
    unsigned char bits[SLOT_FIELDS][SLOT_PROCESSORS]
                      [4 * SLOT_BITS]; /* of physical processors */
    unsigned char context[SLOT_SETS][SLOT_VPS], test[SLOT_SETS][SLOT_VPS],
        overflow[SLOT_SETS][SLOT_VPS];
    const struct slot_program *of;
    uint64_t seen; /* by the front end, of the last SLOT_SUM or SLOT_GREATEST */
    bool collides; /* two messages of the last send have met */
};

void slot_program_make(struct slot_program *p, uint64_t seed);
void slot_memory_init(struct slot_memory *m, const struct slot_program *p);
void slot_step_perform(struct slot_memory *m, const struct slot_step *s);
number slot_bits(const struct slot_memory *m, int field, int vp, int at, int length);
int slot_vps(const struct slot_program *p, int set);
int slot_address_bits(const struct slot_program *p, int set);
/* What SLOT_WRITE_ALL writes into that processor. */
uint64_t slot_number(uint64_t seed, int vp, int length);
bool slot_sends(enum slot_kind kind);
const char *slot_kind_name(enum slot_kind kind);

#endif
