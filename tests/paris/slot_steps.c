/* slot_steps.c - what the steps of slot_programs.h do, in plain bits. */
#include <string.h>

#include "oracle_scan.h"
#include "slot_programs.h"

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
    case SLOT_FMAX:
        r.bits = oracle_float("max", n, a, b).bits;
        break;
    case SLOT_ADDRESS:
        r.bits = (number)vp;
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

/* What of the old content and a message is there afterwards. */
static number met(enum slot_kind kind, int n, number old, number x)
{
    switch ((int)kind) {
    case SLOT_SEND:
        return x;
    case SLOT_SEND_ADD:
        return old + x;
    case SLOT_SEND_FADD:
        return oracle_float("add", n, old, x).bits;
    case SLOT_SEND_MAX:
        return oracle_integer("max", true, old, n, x, n, n).bits;
    default:
        return old ^ x;
    }
}

/* Whether two active processors send to the same one. */
static bool collide(const struct slot_memory *m, const struct slot_step *s, const int *to)
{
    bool met_before[SLOT_VPS] = {false};
    for (int vp = 0; vp < slot_vps(m->of, s->set); vp++) {
        if (!m->context[s->set][vp])
            continue;
        if (met_before[to[vp]])
            return true;
        met_before[to[vp]] = true;
    }
    return false;
}

static void send(struct slot_memory *m, const struct slot_step *s)
{
    number x[SLOT_VPS];
    int to[SLOT_VPS];
    enum slot_kind kind = s->kind;
    const int count = slot_vps(m->of, s->set), there = m->of->set[s->to.field];
    for (int vp = 0; vp < count; vp++) {
        x[vp] = part(m, s->a, vp, s->length);
        to[vp] = (int)part(m, s->b, vp, slot_address_bits(m->of, there));
    }
    m->collides = collide(m, s, to);
    if (m->collides && (kind == SLOT_SEND || kind == SLOT_SEND_FADD))
        kind = SLOT_SEND_XOR;
    for (int vp = 0; vp < count; vp++)
        if (m->context[s->set][vp])
            bits_put(m, s->to, to[vp], s->length,
                     met(kind, s->length, part(m, s->to, to[vp], s->length), x[vp]));
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

/* Ranks, sums and counts along the set's only axis, and what is spread over it. */
static void along(struct slot_memory *m, const struct slot_step *s)
{
    number source[SLOT_VPS], context[SLOT_VPS], bit[SLOT_VPS], out[SLOT_VPS];
    const int count = slot_vps(m->of, s->set);
    const bool ranks = s->kind == SLOT_RANK || s->kind == SLOT_FRANK;
    const struct scan_grid line = {.rank = 1, .dimensions = {count}, .count = count};
    const struct scan_case c = {.letter = s->kind == SLOT_FRANK      ? 'f'
                                          : s->kind == SLOT_SCAN_MAX ? 's'
                                                                     : 'u',
                                .op = s->kind == SLOT_SCAN_COPY || s->kind == SLOT_SPREAD
                                          ? "copy"
                                      : s->kind == SLOT_SCAN_MAX ? "max"
                                                                 : "add",
                                .width = ranks ? s->shorter : s->length,
                                .direction = !s->upward,
                                .inclusion = s->inclusive,
                                .smode = s->smode,
                                .source = source,
                                .context = context,
                                .sbit = bit};
    for (int vp = 0; vp < count; vp++) {
        source[vp] = s->kind == SLOT_ENUMERATE ? 1 : part(m, s->a, vp, s->shorter);
        context[vp] = m->context[s->set][vp];
        bit[vp] = part(m, s->bit, vp, 1);
        out[vp] = part(m, s->to, vp, s->length);
    }
    if (ranks)
        oracle_rank(&line, &c, out);
    else if (s->kind == SLOT_SPREAD || s->kind == SLOT_SPREAD_ADD)
        oracle_spread(&line, &c, 1, -1, s->vp, out);
    else
        oracle_scan(&line, &c, out);
    for (int vp = 0; vp < count; vp++)
        bits_put(m, s->to, vp, s->length, out[vp]);
}

/* What the front end sees of all active processors: the sum, or the greatest. */
static void see(struct slot_memory *m, const struct slot_step *s)
{
    m->seen = 0;
    for (int vp = 0; vp < slot_vps(m->of, s->set); vp++) {
        uint64_t x = (uint64_t)part(m, s->a, vp, s->length);
        if (m->context[s->set][vp])
            m->seen = s->kind == SLOT_SUM ? m->seen + x : x > m->seen ? x : m->seen;
    }
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
        case SLOT_FLESS:
            if (context[vp])
                test[vp] = oracle_float_compare("lt", s->length, part(m, s->a, vp, s->length),
                                                part(m, s->b, vp, s->length));
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
    case SLOT_FLESS:
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
    case SLOT_SEND:
    case SLOT_SEND_FADD:
        send(m, s);
        break;
    case SLOT_RANK:
    case SLOT_FRANK:
    case SLOT_SCAN:
    case SLOT_SCAN_COPY:
    case SLOT_SCAN_MAX:
    case SLOT_SPREAD:
    case SLOT_SPREAD_ADD:
    case SLOT_ENUMERATE:
        along(m, s);
        break;
    case SLOT_SUM:
    case SLOT_GREATEST:
        see(m, s);
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
    case SLOT_FMAX:
    case SLOT_FMOVE:
    case SLOT_ADDRESS:
    case SLOT_AIM: /* the only axis is in send order */
        each_active(m, s);
        break;
    case SLOT_KINDS:
        break;
    }
}
