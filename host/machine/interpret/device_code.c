/* device_code.c - byte code as the words that kernels/interpret.cl performs: see there how they
 * are laid out. */
#include "interpret/device_code.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "codegen/spell.h"
#include "device/call.h"
#include "kernels.h"
#include "values/values.h"

/* As in interpret.cl. */
enum { STEP_WORDS = 10, ARRAYS_MOST = 48, NUMBERS_MOST = 32, REGISTERS_MOST = 64 };
enum operand { OPERAND_NONE, OPERAND_ARRAY, OPERAND_MOVED, OPERAND_REGISTER, OPERAND_NUMBER };

struct device_code {
    struct device_kernel *kernel; /* held by device_kernels */
    struct device_buffer *words;  /* in its memory */
    int steps;
    int arrays[ARRAYS_MOST], numbers[NUMBERS_MOST]; /* nodes */
    int arrays_count, numbers_count;
};

struct encoding {
    struct device_code *code;
    const struct byte_code *p;
    const struct vpset *set;
    int32_t *words;
    int words_count, words_capacity;
    int *at; /* by place: its operand */
    int registers;
    bool failed; /* too much of something, or no memory */
};

/* ---- the kernel ---- */

/* Names that the kernel's text knows, and their numbers. */
#define NAMED(name)                                                                            \
    {                                                                                          \
#name, name                                                                            \
    }
static const struct {
    const char *name;
    int number;
} names[] = {
#define OPERATION(op, ...) NAMED(op),
#define NODE(op, ...) NAMED(op),
#include "machine_op.tab"
#undef OPERATION
#undef NODE
    NAMED(LANES_COPY),
    NAMED(LANES_JOIN),
    NAMED(LANES_CANONICAL),
    NAMED(LANES_FIT),
    NAMED(LANES_FETCH),
    NAMED(LANES_PLACE),
    NAMED(LANES_DRAW),
    NAMED(SPELL_PLACE),
    NAMED(SPELL_BITS_ONE),
    NAMED(SPELL_BITS),
    NAMED(SPELL_INTEGER),
    NAMED(SPELL_FLOAT_FUNCTION),
    NAMED(SPELL_FLOAT_OPERATOR),
    NAMED(SPELL_FLOAT_CHOICE),
    NAMED(SPELL_FLOAT_COMPARISON),
    NAMED(SPELL_MATH),
    NAMED(SPELL_SELECT),
    NAMED(SPELL_OVERFLOW),
    NAMED(SPELL_CONVERSION),
};
#undef NAMED

/* Appends the case of an operation whose row says all of it; as lane.cl names operands. */
static char *case_write(char *end, size_t most, int op)
{
    const bool shifts = node_ops[op].fold == FOLD_SHIFT; /* by a count of 32 bits */
    char small[120], large[120];
    if (node_ops[op].spell == SPELL_MATH)
        return end + snprintf(end, most, " case %d: return math_%s(x%s);", op,
                              node_words[op].word, node_ops[op].inputs == 2 ? ", y" : "");
    spell_integer_call(small, sizeof small, op, 'L', "a.lo", shifts ? "n" : "b.lo", "w");
    spell_integer_call(large, sizeof large, op, 'Q', "a", shifts ? "n" : "b", "w");
    return end + snprintf(end, most,
                          node_ops[op].gives == GIVES_BIT
                              ? " case %d: return q_of((w > 64 ? %s : %s) & 1, 0);"
                              : " case %d: return w > 64 ? %s : q_of(%s, 0);",
                          op, large, small);
}

/* Appends a macro with the cases of a family. */
static char *cases_write(char *end, size_t most, const char *macro, enum op_spell family)
{
    end += sprintf(end, "#define %s", macro);
    for (int op = 0; op < NODE_OP_COUNT; op++)
        if (node_ops[op].spell == family)
            end = case_write(end, most, op);
    *end++ = '\n';
    *end = '\0';
    return end;
}

/* The kernel's whole text. The caller frees it; NULL: no memory. */
static char *kernel_text(bool math)
{
    enum { NAMES = sizeof names / sizeof *names, LINE_MOST = 64, CASE_MOST = 320 };
    const char *const parts[] = {kernel_prelude_cl,
                                 kernel_wide_cl,
                                 kernel_soft_cl,
                                 kernel_integers_cl,
                                 math ? kernel_math_tables_cl : "",
                                 math ? kernel_math_cl : "",
                                 math ? kernel_math_others_cl : "",
                                 kernel_lane_cl,
                                 kernel_interpret_cl};
    size_t bytes = NAMES * LINE_MOST + (NODE_OP_COUNT + 2) * CASE_MOST + 1;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        bytes += strlen(parts[i]);
    char *text = malloc(bytes), *end = text;
    for (int i = 0; text && i < NAMES; i++)
        end += snprintf(end, LINE_MOST, "#define %s %d\n", names[i].name, names[i].number);
    if (text) {
        end = cases_write(end, CASE_MOST, "INTEGER_CASES", SPELL_INTEGER);
        end = cases_write(end, CASE_MOST, "MATH_CASES", SPELL_MATH);
    }
    for (size_t i = 0; text && i < sizeof parts / sizeof *parts; i++)
        end = stpcpy(end, parts[i]);
    return text;
}

static struct device_kernel *kernel_get(struct machine *m, struct device_kernels *kernels,
                                        bool math)
{
    if (kernels->of[math].asked)
        return kernels->of[math].kernel;
    char *text = kernel_text(math);
    kernels->of[math].asked = true;
    if (text)
        kernels->of[math].kernel =
            device_library_kernel(m, text,
                                  math ? "-DVECTOR=1 -DHALO=0 -DWRAPS=1 -DSTREAMS=0 -DMATH=1"
                                       : "-DVECTOR=1 -DHALO=0 -DWRAPS=1 -DSTREAMS=0 -DMATH=0",
                                  "interpret");
    free(text);
    machine_error_clear(m);
    device_kernel_hold(kernels->of[math].kernel);
    return kernels->of[math].kernel;
}

/* ---- words ---- */

static void word_add(struct encoding *e, int32_t word)
{
    if (e->words_count == e->words_capacity)
        e->words = array_more(e->words, &e->words_capacity, sizeof *e->words, &e->failed);
    if (!e->failed)
        e->words[e->words_count++] = word;
}

/* The number of a node among those of its kind. */
static int node_add(struct encoding *e, int *nodes, int *count, int most, int node)
{
    for (int i = 0; i < *count; i++)
        if (nodes[i] == node)
            return i;
    if (*count == most) {
        e->failed = true;
        return 0;
    }
    nodes[*count] = node;
    return (*count)++;
}

static int array_add(struct encoding *e, int node)
{
    return node_add(e, e->code->arrays, &e->code->arrays_count, ARRAYS_MOST, node);
}

static int operand(enum operand kind, int bytes, int number)
{
    int log2 = 0;
    while (1 << log2 < bytes)
        log2++;
    return (int)kind << 28 | log2 << 24 | number;
}

static int register_add(struct encoding *e, int bytes)
{
    int at = e->registers;
    e->registers += bytes > 8 ? 2 : 1;
    e->failed = e->failed || e->registers > REGISTERS_MOST;
    return at;
}

/* Neighbours' places stand behind the steps: `moved` says where. */
static int place_operand(struct encoding *e, const struct place *place, int *moved)
{
    struct device_code *c = e->code;
    switch (place->kind) {
    case PLACE_ARRAY:
    case PLACE_WHOLE:
        return operand(OPERAND_ARRAY, place->bytes, array_add(e, place->node));
    case PLACE_MOVED:
        *moved += 1 + e->set->rank;
        return operand(OPERAND_MOVED, place->bytes, *moved - 1 - e->set->rank);
    case PLACE_REGISTER:
        return operand(OPERAND_REGISTER, place->bytes, register_add(e, place->bytes));
    default: /* NUMBER, DRAW */
        return operand(OPERAND_NUMBER, place->bytes,
                       node_add(e, c->numbers, &c->numbers_count, NUMBERS_MOST, place->node));
    }
}

static int width_of_mask(const struct lanes_step *s)
{
    if (s->op == LANES_PLACE)
        return 32;
    return s->mask == ~(lanes_wide)0 ? 128 : s->type.width;
}

/* Which function of lane.cl performs it. */
static int family_of(const struct lanes_step *s)
{
    if (s->op == LANES_PLACE || s->op == LANES_DRAW)
        return SPELL_PLACE;
    return s->op < NODE_OP_COUNT ? node_ops[s->op].spell : SPELL_CONVERSION;
}

static void step_encode(struct encoding *e, const struct lanes_step *s)
{
    int inputs = s->run ? lanes_inputs(s->op) : 0; /* none: a coordinate or an index */
    INVARIANT(s->op != LANES_PICK);
    word_add(e, s->op);
    word_add(e, e->at[s->to]);
    for (int k = 0; k < 3; k++) {
        bool whole = s->op == LANES_FETCH && k == 1;
        word_add(e, k < inputs && !whole ? e->at[s->in[k]] : OPERAND_NONE);
    }
    word_add(e, s->from.width | s->type.width << 8 | (s->from.kind == MACHINE_FLOAT) << 16);
    word_add(e, s->from.s | s->from.e << 8 | s->type.s << 16 | s->type.e << 24);
    word_add(e, !s->run ? s->axis : s->op == LANES_FETCH ? e->at[s->in[1]] : s->detail);
    word_add(e, family_of(s));
    word_add(e, s->run ? width_of_mask(s) : 32);
}

static bool uses_math(const struct byte_code *p)
{
    for (int i = 0; i < p->steps_count; i++)
        if (p->steps[i].run && p->steps[i].op < NODE_OP_COUNT && op_is_math(p->steps[i].op))
            return true;
    return false;
}

static void program_encode(struct encoding *e)
{
    const struct byte_code *p = e->p;
    const struct vpset *set = e->set;
    int moved = 1 + set->rank + p->steps_count * STEP_WORDS;
    word_add(e, set->rank);
    for (int a = 0; a < set->rank; a++)
        word_add(e, set->dimensions[a]);
    for (int i = 0; i < p->places_count; i++)
        e->at[i] = place_operand(e, &p->places[i], &moved);
    for (int i = 0; i < p->steps_count; i++)
        step_encode(e, &p->steps[i]);
    for (int i = 0; i < p->places_count; i++) {
        if (p->places[i].kind != PLACE_MOVED)
            continue;
        word_add(e, array_add(e, p->places[i].node));
        for (int a = 0; a < set->rank; a++)
            word_add(e, p->places[i].further[a]);
    }
    e->failed = e->failed || moved >= 1 << 24;
}

struct device_code *device_code_make(struct machine *m, struct device_kernels *kernels,
                                     const struct byte_code *p, const struct vpset *set)
{
    struct device_code *c = calloc(1, sizeof *c);
    struct encoding e = {
        .code = c, .p = p, .set = set, .at = calloc((size_t)p->places_count + 1, sizeof *e.at)};
    bool good = c && e.at && set->rows <= INT32_MAX;
    if (good) {
        program_encode(&e);
        c->steps = p->steps_count;
        good = !e.failed && (c->kernel = kernel_get(m, kernels, uses_math(p)));
    }
    size_t bytes = (size_t)e.words_count * sizeof *e.words;
    if (good) {
        c->words = device_buffer_get(m, bytes);
        good = c->words &&
               device_write(m, c->words, 0, e.words, bytes, "a plan's byte code") == MACHINE_OK;
        machine_error_clear(m);
    }
    free(e.at);
    free(e.words);
    if (good)
        return c;
    device_code_free(m, c);
    return NULL;
}

const struct device_kernel *device_code_kernel(const struct device_code *c)
{
    return c->kernel;
}

void device_code_free(struct machine *m, struct device_code *c)
{
    if (c && c->words)
        device_buffer_unref(m, c->words);
    free(c);
}

/* ---- a run ---- */

enum machine_status device_code_run(struct machine *m, const struct device_code *c,
                                    const struct vpset *set,
                                    struct device_buffer *const *buffers,
                                    struct machine_value *const *nodes)
{
    struct kernel_call call = {.kernel = c->kernel};
    cl_ulong numbers[2 * NUMBERS_MOST] = {0};
    for (int i = 0; i < c->numbers_count; i++) {
        numbers[2 * i] = nodes[c->numbers[i]]->imm.lo;
        numbers[2 * i + 1] = nodes[c->numbers[i]]->imm.hi;
    }
    call_buffer(&call, c->words);
    call_int(&call, c->steps);
    call_int(&call, (int)set->pitch);
    call_int(&call, set->halo);
    call_int(&call, (int)set->ratio);
    for (int i = 0; i < 2 * NUMBERS_MOST; i += 16)
        call_argument(&call, 16 * sizeof *numbers, numbers + i);
    for (int i = 0; i < ARRAYS_MOST; i++)
        call_buffer(&call, i < c->arrays_count ? buffers[c->arrays[i]] : c->words);
    size_t global[2] = {(size_t)set->width, (size_t)set->rows};
    return device_launch(m, c->kernel, call.error, 2, global, NULL, "interpreting a plan");
}

double device_code_time_s(const struct machine *m, const struct device_code *c,
                          const struct vpset *set)
{
    const struct device_shape *shape = &m->device->shape;
    return 1e-9 * (shape->launch_ns + shape->step_ns * c->steps * (double)set->count);
}
