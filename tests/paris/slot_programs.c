/* slot_programs.c - see slot_programs.h. */
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
                                              "swap"};

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

/* A part with that many bits of a field of the set; the alias stays apart. */
static struct slot_part part_of(const struct slot_program *p, uint64_t *state, int set,
                                int length)
{
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
    case SLOT_ENUMERATE:
        return 32;
    case SLOT_FADD:
    case SLOT_FMULTIPLY:
        return 64;
    case SLOT_LOAD_CONTEXT:
    case SLOT_STORE_TEST:
        return 1;
    default:
        return 100;
    }
}

/* Whether a part of n bits overlaps one of k bits without being the same: Paris refuses that of dest and a source. */
static bool parts_clash(struct slot_part a, int n, struct slot_part b, int k)
{
    return a.field == b.field && a.at < b.at + k && b.at < a.at + n && (a.at != b.at || n != k);
}

/* False: the set has no field for it. */
static bool step_make(const struct slot_program *p, uint64_t *state, struct slot_step *s)
{
    *s = (struct slot_step){.kind = (enum slot_kind)sample_below(state, SLOT_KINDS),
                            .set = (int)sample_below(state, SLOT_SETS),
                            .upward = (int)sample_below(state, 2),
                            .inclusive = (int)sample_below(state, 2),
                            .number = sample_word(state),
                            .to = nowhere,
                            .a = nowhere,
                            .b = nowhere};
    int other = (int)sample_below(state, SLOT_SETS);
    s->length = length_of(state, most_of(s->kind));
    if (s->length < 2 && (s->kind == SLOT_SUBTRACT || s->kind == SLOT_MAX_SIGNED ||
                          s->kind == SLOT_MOVE_SIGNED || s->kind == SLOT_SEND_MAX))
        s->length = 2;
    s->shorter = s->length;
    s->vp = (int)(sample_word(state) % (uint64_t)slot_vps(p, s->set));
    if (s->kind == SLOT_FADD || s->kind == SLOT_FMULTIPLY)
        s->length = s->shorter = sample_below(state, 2) ? 32 : 64;
    if (s->kind == SLOT_MOVE || s->kind == SLOT_MOVE_SIGNED)
        s->shorter = 1 + (int)sample_below(state, (uint32_t)s->length);
    if (s->kind == SLOT_MOVE_SIGNED && s->shorter < 2)
        s->shorter = 2;
    if (s->kind == SLOT_RANK)
        s->shorter = length_of(state, 100);
    if (s->kind == SLOT_STORE_FLAGS)
        s->length = s->shorter = 3;
    bool sends = s->kind >= SLOT_SEND_MAX && s->kind <= SLOT_SEND_XOR;
    s->to = part_of(p, state, sends ? other : s->set, s->length);
    s->a = part_of(p, state, s->kind == SLOT_GET ? other : s->set, s->shorter);
    s->b = sends || s->kind == SLOT_GET ? part_of(p, state, s->set, slot_address_bits(p, other))
                                        : part_of(p, state, s->set, s->length);
    const int b_length = sends || s->kind == SLOT_GET ? slot_address_bits(p, other) : s->length;
    return s->to.field >= 0 && s->a.field >= 0 && s->b.field >= 0 &&
           !parts_clash(s->to, s->length, s->a, s->shorter) &&
           !parts_clash(s->to, s->length, s->b, b_length);
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
    p->steps_count = 2 + (int)sample_below(&state, SLOT_STEPS - 2);
    for (int i = 0; i < p->steps_count;)
        i += step_make(p, &state, &p->steps[i]);
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

/* ---- memory ---- */

static unsigned char *bit_at(struct slot_memory *m, int field, int vp, int at)
{
    const struct slot_program *p = m->of;
    const int root = field == SLOT_ALIAS ? p->aliased : field, ratio = p->ratio[p->set[field]];
    return &m->bits[root][vp / ratio][vp % ratio * p->bits[field] + at];
}

number slot_bits(const struct slot_memory *m, int field, int vp, int at, int length)
{
    number x = 0;
    for (int i = length; i--;)
        x = x << 1 | *bit_at((struct slot_memory *)(uintptr_t)m, field, vp, at + i);
    return x;
}

static void bits_put(struct slot_memory *m, struct slot_part to, int vp, int length, number x)
{
    for (int i = 0; i < length; i++)
        *bit_at(m, to.field, vp, to.at + i) = (unsigned char)(x >> i & 1);
}

void slot_memory_init(struct slot_memory *m, const struct slot_program *p)
{
    *m = (struct slot_memory){.of = p};
    memset(m->context, 1, sizeof m->context);
}

/* ---- steps ---- */

static number part(const struct slot_memory *m, struct slot_part from, int vp, int length)
{
    return slot_bits(m, from.field, vp, from.at, length);
}

/* What an operation of each processor gives. */
static struct oracle_result result_of(const struct slot_memory *m, const struct slot_step *s,
                                      int vp)
{
    const int n = s->length;
    const number a = part(m, s->a, vp, s->shorter), b = part(m, s->b, vp, n);
    struct oracle_result r = {.bits = a};
    switch ((int)s->kind) {
    case SLOT_MOVE_SIGNED:
        r.bits = oracle_extend(a, s->shorter, true);
        break;
    case SLOT_XOR:
        r.bits = a ^ b;
        break;
    case SLOT_NOT:
        r.bits = ~a;
        break;
    case SLOT_ADD:
        r = oracle_integer("add", false, a, n, b, n, n);
        break;
    case SLOT_SUBTRACT:
        r = oracle_integer("subtract", true, a, n, b, n, n);
        break;
    case SLOT_MAX_SIGNED:
        r = oracle_integer("max", true, a, n, b, n, n);
        break;
    case SLOT_MIN:
        r = oracle_integer("min", false, a, n, b, n, n);
        break;
    case SLOT_FADD:
        r = oracle_float("add", n, a, b);
        break;
    case SLOT_FMULTIPLY:
        r = oracle_float("multiply", n, a, b);
        break;
    }
    r.bits &= oracle_mask(n);
    return r;
}

static bool sets_overflow(enum slot_kind kind)
{
    return kind == SLOT_ADD || kind == SLOT_SUBTRACT || kind == SLOT_FADD ||
           kind == SLOT_FMULTIPLY;
}

static void each_active(struct slot_memory *m, const struct slot_step *s)
{
    struct oracle_result r[SLOT_VPS];
    const int count = slot_vps(m->of, s->set);
    for (int vp = 0; vp < count; vp++)
        r[vp] = result_of(m, s, vp);
    for (int vp = 0; vp < count; vp++)
        if (m->context[s->set][vp]) {
            bits_put(m, s->to, vp, s->length, r[vp].bits);
            if (sets_overflow(s->kind))
                m->overflow[s->set][vp] = r[vp].overflow;
        }
}

static void send(struct slot_memory *m, const struct slot_step *s)
{
    number x[SLOT_VPS];
    int to[SLOT_VPS];
    const int count = slot_vps(m->of, s->set), there = m->of->set[s->to.field];
    for (int vp = 0; vp < count; vp++) {
        x[vp] = part(m, s->a, vp, s->length);
        to[vp] = (int)part(m, s->b, vp, slot_address_bits(m->of, there));
    }
    for (int vp = 0; vp < count; vp++) {
        number old = part(m, s->to, to[vp], s->length);
        if (!m->context[s->set][vp])
            continue;
        number new =
            s->kind == SLOT_SEND_ADD ? old + x[vp]
            : s->kind == SLOT_SEND_XOR
                ? old ^ x[vp]
                : oracle_integer("max", true, old, s->length, x[vp], s->length, s->length).bits;
        bits_put(m, s->to, to[vp], s->length, new);
    }
}

static void get(struct slot_memory *m, const struct slot_step *s)
{
    number x[SLOT_VPS];
    const int count = slot_vps(m->of, s->set), there = m->of->set[s->a.field];
    for (int vp = 0; vp < count; vp++)
        x[vp] =
            part(m, s->a,
                 s->kind == SLOT_GET ? (int)part(m, s->b, vp, slot_address_bits(m->of, there))
                 : s->upward         ? (vp + 1) % count
                                     : (vp + count - 1) % count,
                 s->length);
    for (int vp = 0; vp < count; vp++)
        if (m->context[s->set][vp])
            bits_put(m, s->to, vp, s->length, x[vp]);
}

/* Ranks, sums and counts along the set's only axis. */
static void along(struct slot_memory *m, const struct slot_step *s)
{
    number x[SLOT_VPS], sum = 0, out[SLOT_VPS];
    const int count = slot_vps(m->of, s->set);
    const unsigned char *on = m->context[s->set];
    for (int vp = 0; vp < count; vp++)
        x[vp] = s->kind == SLOT_ENUMERATE ? 1 : part(m, s->a, vp, s->shorter);
    for (int k = 0; k < count; k++) {
        int vp = s->upward || s->kind == SLOT_RANK ? k : count - 1 - k;
        if (!on[vp])
            continue;
        number before = sum;
        sum += x[vp];
        out[vp] = s->inclusive ? sum : before;
        if (s->kind != SLOT_RANK)
            continue;
        out[vp] = 0;
        for (int other = 0; other < count; other++)
            if (on[other] && other != vp)
                out[vp] += s->upward ? x[other] < x[vp] || (x[other] == x[vp] && other < vp)
                                     : x[other] > x[vp] || (x[other] == x[vp] && other < vp);
    }
    for (int vp = 0; vp < count; vp++)
        if (on[vp])
            bits_put(m, s->to, vp, s->length, out[vp]);
}

static void sum(struct slot_memory *m, const struct slot_step *s)
{
    m->sum = 0;
    for (int vp = 0; vp < slot_vps(m->of, s->set); vp++)
        if (m->context[s->set][vp])
            m->sum += (uint64_t)part(m, s->a, vp, s->length);
}

static void swap(struct slot_memory *m, const struct slot_step *s)
{
    for (int vp = 0; vp < slot_vps(m->of, s->set); vp++) {
        number x = part(m, s->to, vp, s->length), y = part(m, s->a, vp, s->length);
        if (!m->context[s->set][vp])
            continue;
        bits_put(m, s->to, vp, s->length, y);
        bits_put(m, s->a, vp, s->length, x);
    }
}

static void flags(struct slot_memory *m, const struct slot_step *s)
{
    unsigned char *context = m->context[s->set], *test = m->test[s->set],
                  *overflow = m->overflow[s->set];
    for (int vp = 0; vp < slot_vps(m->of, s->set); vp++)
        switch ((int)s->kind) {
        case SLOT_LESS:
            if (context[vp])
                test[vp] = part(m, s->a, vp, s->length) < part(m, s->b, vp, s->length);
            break;
        case SLOT_STORE_TEST:
            if (context[vp])
                bits_put(m, s->to, vp, 1, test[vp]);
            break;
        case SLOT_STORE_FLAGS:
            bits_put(m, s->to, vp, 3,
                     (number)(context[vp] | test[vp] << 1 | overflow[vp] << 2));
            break;
        case SLOT_LOAD_CONTEXT:
            context[vp] = (unsigned char)part(m, s->a, vp, 1);
            break;
        case SLOT_AND_TEST:
            context[vp] &= test[vp];
            break;
        case SLOT_AND_OVERFLOW:
            context[vp] &= overflow[vp];
            break;
        case SLOT_ALL:
            context[vp] = 1;
            break;
        }
}

void slot_step_perform(struct slot_memory *m, const struct slot_step *s)
{
    switch (s->kind) {
    case SLOT_LESS:
    case SLOT_STORE_TEST:
    case SLOT_STORE_FLAGS:
    case SLOT_LOAD_CONTEXT:
    case SLOT_AND_TEST:
    case SLOT_AND_OVERFLOW:
    case SLOT_ALL:
        flags(m, s);
        break;
    case SLOT_NEWS:
    case SLOT_GET:
        get(m, s);
        break;
    case SLOT_SEND_MAX:
    case SLOT_SEND_ADD:
    case SLOT_SEND_XOR:
        send(m, s);
        break;
    case SLOT_RANK:
    case SLOT_SCAN:
    case SLOT_ENUMERATE:
        along(m, s);
        break;
    case SLOT_SUM:
        sum(m, s);
        break;
    case SLOT_WRITE:
        bits_put(m, s->to, s->vp, s->length, slot_number(s->number, s->vp, s->length));
        break;
    case SLOT_WRITE_ALL:
        for (int vp = 0; vp < slot_vps(m->of, s->set); vp++)
            bits_put(m, s->to, vp, s->length, slot_number(s->number, vp, s->length));
        break;
    case SLOT_SWAP:
        swap(m, s);
        break;
    case SLOT_MOVE:
    case SLOT_MOVE_SIGNED:
    case SLOT_XOR:
    case SLOT_NOT:
    case SLOT_ADD:
    case SLOT_SUBTRACT:
    case SLOT_MAX_SIGNED:
    case SLOT_MIN:
    case SLOT_FADD:
    case SLOT_FMULTIPLY:
        each_active(m, s);
        break;
    case SLOT_KINDS:
        break;
    }
}
