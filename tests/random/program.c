/* program.c - the instruction table, the checks whether an instruction can run, and the data
 * that programs write. */
#include "program.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sample.h"

#define PROGRAM_INFO(name, shape, number, op, always)                                          \
    {#name, shape, NUMBER_##number, OP_##op, always},
const struct row_info row_table[ROW_COUNT] = {RANDOM_ROWS(PROGRAM_INFO)};

uint64_t geometry_count(const struct geometry *g)
{
    uint64_t count = 1;

    for (int k = 0; k < g->rank; k++)
        count *= (uint64_t)g->lengths[k];
    return count;
}

/* ---- data ---- */

uint64_t data_word(uint32_t stream, uint64_t index)
{
    return sample_mixed((stream + 1) * SAMPLE_GOLDEN + index * 0xd1342543de82ef95u);
}

/* -NAN has the bits of the operations' NaN. */
double data_real(uint32_t stream, uint64_t index)
{
    static const double awkward[] = {0.0,    -0.0,    1.0,     -1.0,         0.5,
                                     2.5,    -3.5,    1e-45,   1e-310,       -1e-39,
                                     3.4e38, -3.4e38, 1.7e308, HUGE_VAL,     -HUGE_VAL,
                                     -NAN,   255.0,   65535.5, 2147483648.0, -129.0};
    uint64_t word = data_word(stream, index);

    if (word % 3 == 0)
        return awkward[(word >> 8) % (sizeof awkward / sizeof awkward[0])];
    return ((double)(word >> 40) * 0x1p-24 - 0.5) * (word % 3 == 1 ? 4.0 : 400.0);
}

/* ---- traces ---- */

void trace_add(struct trace *t, uint64_t word)
{
    if (t->count == t->size) {
        t->size = t->size ? 2 * t->size : 256;
        t->words = realloc(t->words, t->size * sizeof *t->words);
        t->steps = realloc(t->steps, t->size * sizeof *t->steps);
        if (!t->words || !t->steps)
            abort();
    }
    t->steps[t->count] = (uint32_t)t->step;
    t->words[t->count++] = word;
}

void trace_real(struct trace *t, double x)
{
    uint64_t word;

    memcpy(&word, &x, sizeof word);
    trace_add(t, isnan(x) ? 0xfff8000000000000u : word);
}

void trace_finish(struct trace *t)
{
    free(t->words);
    free(t->steps);
    memset(t, 0, sizeof *t);
}

bool trace_differ(const struct trace *a, const struct trace *b, size_t *where)
{
    size_t shorter = a->count < b->count ? a->count : b->count;

    for (size_t n = 0; n < shorter; n++)
        if (a->words[n] != b->words[n]) {
            *where = n;
            return true;
        }
    *where = shorter;
    return a->count != b->count;
}

/* ---- normalising ---- */

struct slot_state {
    int bits; /* 0: no field */
    int set;
    int order; /* of allocation */
    bool heap;
};

struct static_state {
    struct slot_state slots[PROGRAM_SLOTS];
    int set;
    int allocations;
};

enum { USE_D = 1, USE_A = 2, USE_B = 4 };

static int shape_uses(enum shape shape)
{
    switch (shape) {
    case ALLOCATE:
    case DEALLOCATE:
    case SELECT_SET:
    case FLAG:
        return 0;
    case OBSERVE:
    case READ_PROCESSOR:
    case INT_COMPARE_CONSTANT:
    case INT_COMPARE_ZERO:
    case INT_GLOBAL:
    case FLOAT_COMPARE_CONSTANT:
    case FLOAT_COMPARE_ZERO:
    case FLOAT_GLOBAL:
    case BIT_LOAD:
        return USE_A;
    case WRITE_ARRAY:
    case WRITE_FLOATS:
    case WRITE_PROCESSOR:
    case WRITE_PROCESSOR_FLOAT:
    case RANDOM:
    case INT_1:
    case INT_CONSTANT_2:
    case INT_MOVE_CONSTANT:
    case FLOAT_1:
    case FLOAT_CONSTANT_2:
    case FLOAT_MOVE_CONSTANT:
    case BIT_STORE:
    case COORDINATE:
        return USE_D;
    case INT_MOVE:
    case INT_2:
    case INT_CONSTANT_3:
    case INT_MOVE_2L:
    case INT_TO_FLOAT:
    case FLOAT_TO_INT:
    case FLOAT_MOVE:
    case FLOAT_2:
    case FLOAT_CONSTANT_3:
    case FLOAT_MOVE_2L:
    case NEWS:
        return USE_D | USE_A;
    case INT_3:
    case INT_3_3L:
    case FLOAT_3:
        return USE_D | USE_A | USE_B;
    case INT_COMPARE:
    case INT_COMPARE_2L:
    case FLOAT_COMPARE:
        return USE_A | USE_B;
    }
    abort();
}

static bool lengths_are_free(enum shape shape)
{
    return shape == INT_3_3L || shape == INT_MOVE_2L || shape == INT_COMPARE_2L ||
           shape == INT_TO_FLOAT || shape == FLOAT_TO_INT || shape == FLOAT_MOVE_2L;
}

/* Bit mask of the operands that are floats (number F), of 32 or 64 bits. */
static int float_operands(const struct row_info *info)
{
    if (info->shape == INT_TO_FLOAT)
        return USE_D;
    if (info->shape == FLOAT_TO_INT)
        return USE_A;
    return info->number == NUMBER_F ? USE_D | USE_A | USE_B : 0;
}

/* The widest integer that a front-end call writes or reads. */
static int widest(const struct row_info *info)
{
    switch ((int)info->shape) {
    case OBSERVE:
    case WRITE_ARRAY:
    case WRITE_PROCESSOR:
    case READ_PROCESSOR:
    case RANDOM:
    case INT_GLOBAL:
        return 32;
    case BIT_LOAD:
    case BIT_STORE:
        return 1;
    default:
        return 128;
    }
}

static bool operand_fits(const struct static_state *st, const struct row_info *info,
                         const struct operand *x, bool is_float)
{
    const struct slot_state *slot = &st->slots[x->slot % PROGRAM_SLOTS];
    int least = info->number == NUMBER_S && !is_float ? 2 : 1;

    if (x->slot >= PROGRAM_SLOTS || !slot->bits || slot->set != st->set)
        return false;
    if (is_float && x->bits != 32 && x->bits != 64)
        return false;
    return x->bits >= least && x->bits <= (is_float ? 64 : widest(info)) &&
           x->offset + x->bits <= slot->bits;
}

static int64_t constant_within(int64_t value, int bits, bool is_signed)
{
    int usable = bits > 31 ? 31 : bits;
    int64_t mask = ((int64_t)1 << usable) - 1;

    value &= mask;
    if (is_signed && bits <= 31 && value >> (usable - 1))
        value -= (int64_t)1 << usable;
    return value;
}

static bool instruction_possible(const struct program *p, struct static_state *st,
                                 struct instruction *in)
{
    const struct row_info *info = &row_table[in->row];
    const struct geometry *g = &p->sets[st->set];
    int uses = shape_uses((enum shape)info->shape), floats = float_operands(info);
    const struct operand *length;

    if (info->shape == ALLOCATE) {
        struct slot_state *slot = &st->slots[in->d.slot % PROGRAM_SLOTS];

        if (slot->bits || in->d.bits == 0 || in->d.bits > PROGRAM_FIELD_BITS_MAX)
            return false;
        *slot =
            (struct slot_state){in->d.bits, st->set, st->allocations++, info->op == OP_HEAP};
        return true;
    }
    if (info->shape == DEALLOCATE) {
        struct slot_state *slot = &st->slots[in->d.slot % PROGRAM_SLOTS];
        int order = slot->order;

        if (!slot->bits || slot->heap != (info->op == OP_HEAP))
            return false;
        if (slot->heap)
            slot->bits = 0;
        else
            for (int k = 0; k < PROGRAM_SLOTS; k++)
                if (!st->slots[k].heap && st->slots[k].order >= order)
                    st->slots[k].bits = 0;
        return true;
    }
    if (info->shape == SELECT_SET) {
        if (in->set >= p->sets_count)
            return false;
        st->set = in->set;
        return true;
    }
    if (!lengths_are_free((enum shape)info->shape)) {
        length = uses & USE_D ? &in->d : &in->a;
        in->a.bits = in->b.bits = length->bits;
    }
    if ((uses & USE_D && !operand_fits(st, info, &in->d, floats & USE_D)) ||
        (uses & USE_A && !operand_fits(st, info, &in->a, floats & USE_A)) ||
        (uses & USE_B && !operand_fits(st, info, &in->b, floats & USE_B)))
        return false;
    length = uses & USE_D ? &in->d : &in->a;
    in->constant = constant_within(in->constant, length->bits, info->number == NUMBER_S);
    in->axis = (uint8_t)(in->axis % g->rank);
    in->direction &= 1;
    in->where = (uint32_t)(in->where % geometry_count(g));
    return true;
}

void program_normalise(struct program *p)
{
    struct static_state st = {0};
    int kept = 0;

    for (int n = 0; n < p->count; n++)
        if (instruction_possible(p, &st, &p->code[n]))
            p->code[kept++] = p->code[n];
    p->count = kept;
}
