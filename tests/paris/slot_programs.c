/* slot_programs.c - random programs: see slot_programs.h; what their steps do is in
 * slot_steps.c. */
#include "slot_programs.h"

#include <string.h>

#include "sample.h"

static const char *const names[SLOT_KINDS] = {"u_move",
                                              "s_move",
                                              "logxor",
                                              "lognot",
                                              "u_add",
                                              "s_subtract",
                                              "s_max",
                                              "u_min",
                                              "f_add",
                                              "f_multiply",
                                              "u_lt",
                                              "store_test",
                                              "store_flags",
                                              "load_context",
                                              "logand_context_with_test",
                                              "logand_context_with_overflow",
                                              "set_context",
                                              "get_from_news",
                                              "send_with_s_max",
                                              "send_with_u_add",
                                              "send_with_logxor",
                                              "get",
                                              "u_rank",
                                              "scan_with_u_add",
                                              "enumerate",
                                              "global_u_add",
                                              "write_to_processor",
                                              "write_to_news_array",
                                              "swap",
                                              "f_max",
                                              "f_move",
                                              "f_lt",
                                              "my_news_coordinate",
                                              "send",
                                              "send_with_f_add",
                                              "f_rank",
                                              "scan_with_copy",
                                              "scan_with_s_max",
                                              "spread_with_copy",
                                              "spread_with_u_add",
                                              "global_u_max",
                                              "make_news_coordinate"};

const char *slot_kind_name(enum slot_kind kind)
{
    return names[kind];
}

int slot_vps(const struct slot_program *p, int set)
{
    return p->ratio[set] * SLOT_PROCESSORS;
}

int slot_address_bits(const struct slot_program *p, int set)
{
    int bits = 0;
    while (1 << bits < slot_vps(p, set))
        bits++;
    return bits;
}

uint64_t slot_number(uint64_t seed, int vp, int length)
{
    uint64_t x = sample_mixed(seed + (uint64_t)vp * SAMPLE_GOLDEN);
    x = seed % 3 == 0 ? x & 7 : x; /* few of them differ */
    return length < 64 ? x & ((UINT64_C(1) << length) - 1) : x;
}

/* ---- programs ---- */

static const struct slot_part nowhere = {-1, 0};

/* A part that an earlier step has used, if it has room for that many bits and is of the set. */
static struct slot_part part_again(const struct slot_program *p, uint64_t *state, int set,
                                   int length)
{
    for (int tries = 0; p->steps_count && tries < 8; tries++) {
        const struct slot_step *s = &p->steps[sample_below(state, (uint32_t)p->steps_count)];
        const struct slot_part parts[] = {s->to, s->to, s->a, s->b},
                               part = parts[sample_below(state, 4)];
        if (p->set[part.field] == set && part.at + length <= p->bits[part.field])
            return part;
    }
    return nowhere;
}

/* A part with that many bits of a field of the set; the alias stays apart. */
static struct slot_part part_of(const struct slot_program *p, uint64_t *state, int set,
                                int length)
{
    const struct slot_part again =
        p->parts_again && sample_below(state, 3) ? part_again(p, state, set, length) : nowhere;
    if (again.field >= 0)
        return again;
    for (int tries = 0; tries < 40; tries++) {
        int field = (int)sample_below(state, SLOT_FIELDS);
        if (p->set[field] != set || p->bits[field] < length)
            continue;
        int room = p->bits[field] - length;
        int at = (int)sample_below(state, 3) ? (int)sample_below(state, (uint32_t)room + 1) : 0;
        return (struct slot_part){field, at};
    }
    return nowhere;
}

static int length_of(uint64_t *state, int most)
{
    static const int usual[] = {1,  3,  8,  12, 16, 24, 31,  32, 33,
                                40, 52, 63, 64, 80, 96, 100, 127};
    int length = sample_below(state, 4) ? usual[sample_below(state, 17)]
                                        : 1 + (int)sample_below(state, 128);
    return length > most ? 1 + length % most : length;
}

static int most_of(enum slot_kind kind)
{
    switch ((int)kind) {
    case SLOT_SUM:
        return 58;
    case SLOT_WRITE:
    case SLOT_WRITE_ALL:
        return 64;
    case SLOT_RANK:
    case SLOT_FRANK:
    case SLOT_ADDRESS:
    case SLOT_ENUMERATE:
        return 32;
    case SLOT_FADD:
    case SLOT_FMULTIPLY:
    case SLOT_FMAX:
    case SLOT_FMOVE:
    case SLOT_FLESS:
    case SLOT_SEND_FADD:
    case SLOT_GREATEST:
        return 64;
    case SLOT_LOAD_CONTEXT:
    case SLOT_STORE_TEST:
        return 1;
    default:
        return 100;
    }
}

/* Whether a part of n bits overlaps one of k bits without being the same: Paris refuses that of
 * dest and a source. */
static bool parts_clash(struct slot_part a, int n, struct slot_part b, int k)
{
    return a.field == b.field && a.at < b.at + k && b.at < a.at + n && (a.at != b.at || n != k);
}

static bool is_of_floats(enum slot_kind kind)
{
    return kind == SLOT_FADD || kind == SLOT_FMULTIPLY || kind == SLOT_FMAX ||
           kind == SLOT_FMOVE || kind == SLOT_FLESS || kind == SLOT_SEND_FADD;
}

static bool is_signed(enum slot_kind kind)
{
    return kind == SLOT_SUBTRACT || kind == SLOT_MAX_SIGNED || kind == SLOT_MOVE_SIGNED ||
           kind == SLOT_SEND_MAX || kind == SLOT_SCAN_MAX;
}

bool slot_sends(enum slot_kind kind)
{
    return (kind >= SLOT_SEND_MAX && kind <= SLOT_SEND_XOR) || kind == SLOT_SEND ||
           kind == SLOT_SEND_FADD;
}

/* Whether its operand b are addresses. */
static bool is_far(enum slot_kind kind)
{
    return slot_sends(kind) || kind == SLOT_GET;
}

/* Whether messages may well go where it says. */
static bool is_address(enum slot_kind kind)
{
    return kind == SLOT_ADDRESS || kind == SLOT_AIM || kind == SLOT_MOVE;
}

/* The set that its messages go to, or come from. */
static int far_set(const struct slot_program *p, const struct slot_step *s)
{
    return p->set[slot_sends(s->kind) ? s->to.field : s->a.field];
}

static void lengths_choose(const struct slot_program *p, uint64_t *state, struct slot_step *s)
{
    s->length = length_of(state, most_of(s->kind));
    if (s->length < 2 && is_signed(s->kind))
        s->length = 2;
    if (s->kind == SLOT_ADDRESS && sample_below(state, 2))
        s->length = slot_address_bits(p, s->set);
    if (is_of_floats(s->kind))
        s->length = sample_below(state, 2) ? 32 : 64;
    if (s->kind == SLOT_STORE_FLAGS)
        s->length = 3;
    if (s->kind == SLOT_AIM)
        s->length = slot_address_bits(p, s->set);
    s->shorter = s->length;
    if (s->kind == SLOT_MOVE || s->kind == SLOT_MOVE_SIGNED)
        s->shorter = 1 + (int)sample_below(state, (uint32_t)s->length);
    if (s->kind == SLOT_MOVE && s->length > slot_address_bits(p, s->set) &&
        sample_below(state, 2))
        s->shorter = slot_address_bits(p, s->set);
    if (s->kind == SLOT_MOVE_SIGNED && s->shorter < 2)
        s->shorter = 2;
    if (s->kind == SLOT_RANK)
        s->shorter = length_of(state, 100);
    if (s->kind == SLOT_FRANK)
        s->shorter = sample_below(state, 2) ? 32 : 64;
}

/* Messages often go where the step before has sent or fetched, or whose addresses it has
 * computed. `before`: that step, or NULL. */
static bool goes_there(const struct slot_program *p, uint64_t *state,
                       const struct slot_step *before, struct slot_step *s)
{
    static const enum slot_kind kinds[] = {SLOT_SEND,     SLOT_SEND_FADD, SLOT_GET,
                                           SLOT_SEND_MAX, SLOT_SEND_ADD,  SLOT_SEND_XOR};
    const bool computed = before && is_address(before->kind) &&
                          before->length >= slot_address_bits(p, before->set),
               went = before && p->parts_again && is_far(before->kind);
    if (!(computed || went) || sample_below(state, 4) == 0)
        return false;
    s->kind = kinds[sample_below(state, 6)];
    s->set = before->set;
    return true;
}

/* False: the set has no field for it. */
static bool step_make(const struct slot_program *p, uint64_t *state,
                      const struct slot_step *before, struct slot_step *s)
{
    *s = (struct slot_step){.kind = p->kinds[sample_below(state, (uint32_t)p->kinds_count)],
                            .set = (int)sample_below(state, (uint32_t)p->sets_used),
                            .upward = (int)sample_below(state, 2),
                            .inclusive = (int)sample_below(state, 2),
                            .smode = (int)sample_below(state, 3),
                            .number = sample_word(state),
                            .to = nowhere,
                            .a = nowhere,
                            .b = nowhere};
    const bool there = goes_there(p, state, before, s);
    const bool far = is_far(s->kind), sends = far && s->kind != SLOT_GET;
    const int other = !there                  ? (int)sample_below(state, SLOT_SETS)
                      : !is_far(before->kind) ? s->set
                                              : far_set(p, before);
    lengths_choose(p, state, s);
    s->vp = (int)(sample_word(state) % (uint64_t)slot_vps(p, s->set));
    const int b_length = far ? slot_address_bits(p, other) : s->length;
    s->to = part_of(p, state, sends ? other : s->set, s->length);
    s->a = part_of(p, state, s->kind == SLOT_GET ? other : s->set, s->shorter);
    s->b = !there                 ? part_of(p, state, s->set, b_length)
           : is_far(before->kind) ? before->b
                                  : before->to;
    s->bit = part_of(p, state, s->set, 1);
    return s->to.field >= 0 && s->a.field >= 0 && s->b.field >= 0 && s->bit.field >= 0 &&
           !parts_clash(s->to, s->length, s->a, s->shorter) &&
           !parts_clash(s->to, s->length, s->b, b_length) &&
           !parts_clash(s->to, s->length, s->bit, 1);
}

/* Half of the programs use few kinds of steps, often, and in few sets: what needs several of
 * one kind is met sooner. */
static void kinds_choose(struct slot_program *p, uint64_t *state)
{
    const bool few = sample_below(state, 2);
    p->kinds_count = few ? 4 + (int)sample_below(state, 8) : SLOT_KINDS;
    p->sets_used = few ? 1 + (int)sample_below(state, SLOT_SETS) : SLOT_SETS;
    for (int i = 0; i < p->kinds_count; i++)
        p->kinds[i] = (enum slot_kind)(few ? (int)sample_below(state, SLOT_KINDS) : i);
}

void slot_program_make(struct slot_program *p, uint64_t seed)
{
    static const int widths[] = {40, 64, 65, 96, 100, 127, 128, 133};
    uint64_t state = seed * SAMPLE_GOLDEN + 1;
    *p = (struct slot_program){.aliased = -1};
    for (int i = 0; i < SLOT_SETS; i++)
        p->ratio[i] = 1 << sample_below(&state, 3);
    for (int i = 0; i < SLOT_FIELDS; i++) {
        p->set[i] = i % SLOT_SETS;
        p->bits[i] = i < SLOT_SETS ? 100 + (int)sample_below(&state, 34)
                                   : widths[sample_below(&state, 8)];
    }
    p->parts_again = sample_below(&state, 2);
    kinds_choose(p, &state);
    const int steps_count = 2 + (int)sample_below(&state, SLOT_STEPS - 2);
    while (p->steps_count < steps_count) {
        struct slot_step *s = &p->steps[p->steps_count];
        p->steps_count += step_make(p, &state, p->steps_count ? s - 1 : NULL, s);
    }
    p->turns = sample_below(&state, 4) ? 2 + (int)sample_below(&state, 6) : 1;
    p->look = (enum slot_look)sample_below(&state, SLOT_LOOK_END + 1);
    p->safe = sample_below(&state, 3) == 0;
    if (sample_below(&state, 4) == 0) {
        int field = (int)sample_below(&state, SLOT_FIELDS), set = (int)sample_below(&state, 3);
        int bits = p->bits[field] * p->ratio[p->set[field]];
        if (bits % p->ratio[set] == 0 && bits / p->ratio[set] <= 4 * SLOT_BITS) {
            p->aliased = field;
            p->alias_from = (int)sample_below(&state, (uint32_t)p->turns);
            p->alias_to = p->alias_from + (int)sample_below(&state, 3);
            p->set[SLOT_ALIAS] = set;
            p->bits[SLOT_ALIAS] = bits / p->ratio[set];
        }
    }
}
