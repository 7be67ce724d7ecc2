/* paris_executor.c - runs a random program through C/Paris calls.
 *
 * Each row of table.h becomes one case of a switch: its call with the arguments of its shape.
 * The trace has the order of oracle.c. */
#include <stdlib.h>
#include <string.h>

#include "paris_internal.h"
#include "program.h"

#include <cm/paris.h>

/* So few that small geometries have VP ratios above 1. */
enum { PROCESSORS = 16 };

struct execution {
    const struct program *p;
    struct trace *out;
    CM_vp_set_id_t sets[PROGRAM_SETS];
    CM_field_id_t
        fields[PROGRAM_SLOTS]; /* CM_no_field: none; deallocated stack fields keep their ids */
    const struct instruction *in;
    int set;
    /* live fields, to dump at the end */
    struct {
        int bits, set, order;
        bool heap;
    } slots[PROGRAM_SLOTS];
    int allocations;
};

static CM_field_id_t part(const struct execution *x, const struct operand *o)
{
    CM_field_id_t field = x->fields[o->slot];

    return o->offset ? CM_add_offset_to_field_id(field, o->offset) : field;
}

static void *buffer(uint64_t count, size_t size)
{
    void *p = calloc(count ? count : 1, size);

    if (!p)
        abort();
    return p;
}

static const struct geometry *geometry(const struct execution *x)
{
    return &x->p->sets[x->set];
}

/* Whole arrays: the block is the whole geometry. */
struct block {
    int zero[PROGRAM_AXES], end[PROGRAM_AXES], axes[PROGRAM_AXES];
    unsigned int rank;
};

static struct block whole(const struct execution *x)
{
    const struct geometry *g = geometry(x);
    struct block b = {{0}, {0}, {0}, (unsigned int)g->rank};

    for (int k = 0; k < g->rank; k++) {
        b.end[k] = g->lengths[k];
        b.axes[k] = k;
    }
    return b;
}

static void observe(struct execution *x)
{
    uint64_t count = geometry_count(geometry(x));
    unsigned int *words = buffer(count, sizeof *words);
    struct block b = whole(x);

    CM_u_read_from_news_array_1L(words, b.zero, b.zero, b.end, b.axes, part(x, &x->in->a),
                                 x->in->a.bits, b.rank, b.end, CM_32_bit);
    for (uint64_t n = 0; n < count; n++)
        trace_add(x->out, words[n]);
    free(words);
}

static void write_array(struct execution *x)
{
    uint64_t count = geometry_count(geometry(x));
    unsigned int *words = buffer(count, sizeof *words);
    struct block b = whole(x);

    for (uint64_t n = 0; n < count; n++)
        words[n] =
            (unsigned int)(data_word(x->in->where, n) & (((uint64_t)1 << x->in->d.bits) - 1));
    CM_u_write_to_news_array_1L(words, b.zero, b.zero, b.end, b.axes, part(x, &x->in->d),
                                x->in->d.bits, b.rank, b.end, CM_32_bit);
    free(words);
}

static unsigned int significand_length(int bits)
{
    return bits == 32 ? 23 : 52;
}

static unsigned int exponent_length(int bits)
{
    return bits == 32 ? 8 : 11;
}

static void write_floats(struct execution *x)
{
    uint64_t count = geometry_count(geometry(x));
    double *numbers = buffer(count, sizeof *numbers);
    struct block b = whole(x);

    for (uint64_t n = 0; n < count; n++)
        numbers[n] = data_real(x->in->where, n);
    CM_f_write_to_news_array_1L(numbers, b.zero, b.zero, b.end, b.axes, part(x, &x->in->d),
                                significand_length(x->in->d.bits),
                                exponent_length(x->in->d.bits), b.rank, b.end, CM_float_double);
    free(numbers);
}

/* The send address of a row-major index. */
static unsigned int address(const struct execution *x)
{
    CM_geometry_id_t g = CM_vp_set_geometry(CM_current_vp_set);
    unsigned int a = 0, n = (unsigned int)x->in->where;

    for (unsigned int axis = (unsigned int)CM_geometry_rank(g); axis-- > 0;) {
        unsigned int length = CM_geometry_axis_length(g, axis);
        a = CM_fe_deposit_news_coordinate(g, a, axis, n % length);
        n /= length;
    }
    return a;
}

static void remember_field(struct execution *x, CM_field_id_t field, bool heap)
{
    int slot = x->in->d.slot;

    x->fields[slot] = field;
    x->slots[slot].bits = x->in->d.bits;
    x->slots[slot].set = x->set;
    x->slots[slot].order = x->allocations++;
    x->slots[slot].heap = heap;
}

static void forget_field(struct execution *x)
{
    int slot = x->in->d.slot, order = x->slots[slot].order;

    if (x->slots[slot].heap) {
        x->slots[slot].bits = 0;
        return;
    }
    for (int k = 0; k < PROGRAM_SLOTS; k++)
        if (!x->slots[k].heap && x->slots[k].order >= order)
            x->slots[k].bits = 0;
}

/* ---- one macro a shape: f the call, K its integer constant ---- */

#define D part(x, &in->d)
#define A part(x, &in->a)
#define B part(x, &in->b)
#define FLOAT_LENGTH(o) significand_length((o).bits), exponent_length((o).bits)

#define CALL_ALLOCATE(f, K) remember_field(x, f(in->d.bits), row_table[in->row].op == OP_HEAP)
#define CALL_DEALLOCATE(f, K) f(x->fields[in->d.slot]), forget_field(x)
#define CALL_SELECT_SET(f, K) f(x->sets[in->set]), x->set = in->set
#define CALL_OBSERVE(f, K) observe(x)
#define CALL_WRITE_ARRAY(f, K) write_array(x)
#define CALL_WRITE_FLOATS(f, K) write_floats(x)
#define CALL_WRITE_PROCESSOR(f, K) f(address(x), D, (unsigned int)in->constant, in->d.bits)
#define CALL_READ_PROCESSOR(f, K) trace_add(x->out, f(address(x), A, in->a.bits))
#define CALL_WRITE_PROCESSOR_FLOAT(f, K) f(address(x), D, in->real, FLOAT_LENGTH(in->d))
#define CALL_RANDOM(f, K) f(D, in->d.bits, (unsigned int)in->constant)
#define CALL_INT_1(f, K) f(D, in->d.bits)
#define CALL_INT_MOVE(f, K) f(D, A, in->d.bits)
#define CALL_INT_2(f, K) f(D, A, in->d.bits)
#define CALL_INT_3(f, K) f(D, A, B, in->d.bits)
#define CALL_INT_3_3L(f, K) f(D, A, B, in->d.bits, in->a.bits, in->b.bits)
#define CALL_INT_CONSTANT_2(f, K) f(D, K, in->d.bits)
#define CALL_INT_CONSTANT_3(f, K) f(D, A, K, in->d.bits)
#define CALL_INT_MOVE_2L(f, K) f(D, A, in->d.bits, in->a.bits)
#define CALL_INT_MOVE_CONSTANT(f, K) f(D, K, in->d.bits)
#define CALL_INT_COMPARE(f, K) f(A, B, in->a.bits)
#define CALL_INT_COMPARE_2L(f, K) f(A, B, in->a.bits, in->b.bits)
#define CALL_INT_COMPARE_CONSTANT(f, K) f(A, K, in->a.bits)
#define CALL_INT_COMPARE_ZERO(f, K) f(A, in->a.bits)
#define CALL_INT_TO_FLOAT(f, K) f(D, A, in->a.bits, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_TO_INT(f, K) f(D, A, in->d.bits, FLOAT_LENGTH(in->a))
#define CALL_INT_GLOBAL(f, K)                                                                  \
    trace_add(x->out, (uint64_t)f(A, in->a.bits) & (((uint64_t)1 << in->a.bits) - 1))
#define CALL_FLOAT_1(f, K) f(D, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_MOVE(f, K) f(D, A, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_2(f, K) f(D, A, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_3(f, K) f(D, A, B, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_CONSTANT_2(f, K) f(D, in->real, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_CONSTANT_3(f, K) f(D, A, in->real, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_MOVE_2L(f, K) f(D, A, FLOAT_LENGTH(in->d), FLOAT_LENGTH(in->a))
#define CALL_FLOAT_MOVE_CONSTANT(f, K) f(D, in->real, FLOAT_LENGTH(in->d))
#define CALL_FLOAT_COMPARE(f, K) f(A, B, FLOAT_LENGTH(in->a))
#define CALL_FLOAT_COMPARE_CONSTANT(f, K) f(A, in->real, FLOAT_LENGTH(in->a))
#define CALL_FLOAT_COMPARE_ZERO(f, K) f(A, FLOAT_LENGTH(in->a))
#define CALL_FLOAT_GLOBAL(f, K) trace_real(x->out, f(A, FLOAT_LENGTH(in->a)))
#define CALL_FLAG(f, K) f()
#define CALL_BIT_LOAD(f, K) f(A)
#define CALL_BIT_STORE(f, K) f(D)
#define CALL_NEWS(f, K) f(D, A, in->axis, in->direction, in->d.bits)
#define CALL_COORDINATE(f, K) f(D, in->axis, in->d.bits)

#define CONSTANT_U (unsigned long)in->constant
#define CONSTANT_B CONSTANT_U
#define CONSTANT_F CONSTANT_U
#define CONSTANT_S (long)in->constant

#define EXECUTOR_CASE(name, shape, number, op, always)                                         \
    case ROW_##name:                                                                           \
        CALL_##shape(name, CONSTANT_##number);                                                 \
        break;

static void step(struct execution *x, const struct instruction *in)
{
    x->in = in;
    switch ((enum row)in->row) {
        RANDOM_ROWS(EXECUTOR_CASE)
    case ROW_COUNT:
        abort();
    }
}

/* ---- what is left at the end ----
 *
 * All fields are first copied into fields of at most 64 bits, then computed in one evaluation,
 * then downloaded. That needs a few kernels instead of one for each field. */

enum { COPIES_MAX = PROGRAM_SETS * 3 + PROGRAM_SLOTS * 3 };

struct copies {
    struct {
        uint32_t field;
        struct machine_type type;
        uint64_t count;
    } of[COPIES_MAX];
    int count;
};

static void copy(struct copies *c, struct machine_value *value, uint64_t count)
{
    struct machine *m = paris_machine();
    uint32_t field = MACHINE_NO_FIELD;

    if (value)
        field = machine_field_allocate(m, machine_vpset_current(m),
                                       machine_value_type(value).width, MACHINE_HEAP);
    if (!field || machine_field_store(m, field, value, MACHINE_EVERYWHERE)) {
        fprintf(stderr, "copying what is left: %s\n", machine_error(m));
        exit(2);
    }
    c->of[c->count].field = field;
    c->of[c->count].type = machine_value_type(value);
    c->of[c->count++].count = count;
    machine_begin(m);
}

static void copy_set(struct execution *x, struct copies *c)
{
    static const enum machine_flag flags[] = {MACHINE_CONTEXT, MACHINE_TEST, MACHINE_OVERFLOW};
    struct machine *m = paris_machine();
    uint64_t count = geometry_count(geometry(x));

    machine_begin(m);
    for (int k = 0; k < 3; k++)
        copy(c, machine_flag_value(m, flags[k], MACHINE_EVERYWHERE), count);
    for (int k = 0; k < PROGRAM_SLOTS; k++)
        for (int at = 0; x->slots[k].set == x->set && at < x->slots[k].bits; at += 64) {
            int left = x->slots[k].bits - at;

            copy(c,
                 machine_field_value(m, x->fields[k] + (uint32_t)at,
                                     MACHINE_UINT(left < 64 ? left : 64), MACHINE_EVERYWHERE),
                 count);
        }
}

static void show_copies(struct trace *out, const struct copies *c)
{
    struct machine *m = paris_machine();

    if (machine_finish(m)) {
        fprintf(stderr, "computing what is left: %s\n", machine_error(m));
        exit(2);
    }
    for (int k = 0; k < c->count; k++) {
        size_t size = machine_element_bytes(c->of[k].type);
        uint8_t *bytes = buffer(c->of[k].count, size);

        if (machine_field_download(m, c->of[k].field, c->of[k].type, bytes)) {
            fprintf(stderr, "looking at what is left: %s\n", machine_error(m));
            exit(2);
        }
        for (uint64_t n = 0; n < c->of[k].count; n++) {
            uint64_t word = 0;

            memcpy(&word, bytes + n * size, size);
            trace_add(out, word);
        }
        free(bytes);
    }
}

static int present = -1; /* the present machine: 1 eager, 0 lazy; -1: none that may be used */
static struct paris_counts counts;

/* Adds the machine's counts so far to the totals (sign 1), or subtracts them (-1). */
static void count(int sign)
{
    struct machine_stats now;

    machine_stats_get(paris_machine(), &now);
    counts.kernels_built += sign * (long)now.kernels_built;
    counts.kernels_of_stages += sign * (long)(now.kernels_in_strips + now.kernels_in_tiles);
    counts.calls_foreseen += sign * (long)now.calls_foreseen;
}

void paris_force(const char *const *variables)
{
    static const char *const *before;
    char name[64];

    for (int i = 0; before && before[i]; i++) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(before[i], "="), before[i]);
        unsetenv(name);
    }
    for (int i = 0; variables[i]; i++) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(variables[i], "="), variables[i]);
        setenv(name, strchr(variables[i], '=') + 1, 1);
    }
    before = variables;
    present = -1;
}

void paris_run(const struct program *p, struct trace *out, bool eager)
{
    struct execution x = {.p = p, .out = out};
    struct copies left = {.count = 0};

    if (present != eager) {
        struct machine_config config = machine_config_default();

        config.eager = eager;
        config.processors_count = PROCESSORS;
        if (!paris_reset(&config)) {
            fprintf(stderr, "%s\n", paris_error());
            exit(2);
        }
        present = eager;
    }
    if (!eager)
        count(-1);
    CM_init();
    CM_initialize_random_generator((unsigned int)p->seed);
    for (int k = 0; k < p->sets_count; k++)
        x.sets[k] = CM_allocate_vp_set(
            CM_create_geometry(p->sets[k].lengths, (unsigned int)p->sets[k].rank));
    CM_set_vp_set(x.sets[0]);
    for (int n = 0; n < p->count; n++) {
        out->step = n;
        step(&x, &p->code[n]);
    }
    out->step = p->count;
    for (x.set = 0; x.set < p->sets_count; x.set++) {
        CM_set_vp_set(x.sets[x.set]);
        copy_set(&x, &left);
    }
    show_copies(out, &left);
    if (!eager)
        count(1);
}

struct paris_counts paris_counts(void)
{
    return counts;
}
