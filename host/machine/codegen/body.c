/* body.c - the text of what a kernel computes.
 *
 * Comparing a coordinate with a number says that a processor is on one side of a line, and a
 * context made of such comparisons is a box. They are written BOX(...), and the body stands
 * there twice: for vectors that are inside on all lines at every offset, where BOX(...) is true
 * and the compiler drops what only the outside needs, and for the others. */
#include "codegen/body.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/node_ops.h"
#include "codegen/narrow_spell.h"
#include "codegen/numbers.h"
#include "codegen/spell.h"
#include "plan/lanes.h"

/* ---- rows and pointers ---- */

static int row_moved(struct emitter *e, int from, int axis, int distance)
{
    struct row_offset wanted = e->row_offsets[from];
    int length = e->set->dimensions[axis];
    wanted.d[axis] = (wanted.d[axis] + distance) % length;
    for (int i = 0; i < e->rows_count; i++)
        if (!memcmp(&e->row_offsets[i], &wanted, sizeof wanted))
            return i;
    if (e->rows_count == e->rows_capacity)
        e->row_offsets =
            array_more(e->row_offsets, &e->rows_capacity, sizeof *e->row_offsets, &e->failed);
    if (e->failed)
        return 0;
    e->row_offsets[e->rows_count] = wanted;
    for (int a = 0; a < e->set->rank - 1; a++)
        if (wanted.d[a])
            text_put(&e->rows, "    const int y%d_%d = wrap(c%d + (" NUMBER_INT "), D%d);\n", a,
                     e->rows_count, a, wanted.d[a], a);
    text_put(&e->rows, "    const int r%d = row", e->rows_count);
    for (int a = 0; a < e->set->rank - 1; a++)
        if (wanted.d[a])
            text_put(&e->rows, " + (y%d_%d - c%d) * S%d", a, e->rows_count, a, a);
    text_put(&e->rows, ";\n");
    e->axes_used = true;
    return e->rows_count++;
}

/* Where a row is along an axis. */
static void row_place(struct emitter *e, char *out, size_t size, int row, int axis)
{
    e->axes_used = true;
    if (e->row_offsets[row].d[axis])
        snprintf(out, size, "y%d_%d", axis, row);
    else
        snprintf(out, size, "c%d", axis);
}

int emit_row(struct emitter *e, int axis, int distance)
{
    return distance ? row_moved(e, 0, axis, distance) : 0;
}

static int input_of(struct emitter *e, int node)
{
    if (!e->input_number[node]) {
        emit_argument(&e->arguments, ARGUMENT_INPUT, node, 0, &e->failed);
        e->input_number[node] = ++e->inputs;
    }
    return e->input_number[node] - 1;
}

static int pointer_of(struct emitter *e, int node, int row)
{
    for (int i = 0; i < e->pointers_count; i++)
        if (e->seen_pointers[i].node == node && e->seen_pointers[i].row == row)
            return i;
    if (e->pointers_count == e->pointers_capacity)
        e->seen_pointers = array_more(e->seen_pointers, &e->pointers_capacity,
                                      sizeof *e->seen_pointers, &e->failed);
    if (e->failed)
        return 0;
    struct machine_type type = e->g->nodes[node].type;
    e->seen_pointers[e->pointers_count] = (struct access){.node = node, .row = row};
    if (e->bare)
        return e->pointers_count++;
    text_put(&e->pointers,
             "    const __global %s *p%d = b%d + ((size_t)r%d * PITCH + HALO)%s;\n",
             memory_type(type), e->pointers_count, input_of(e, node), row,
             type.width > 64 ? " * 2" : "");
    return e->pointers_count++;
}

/* ---- variables ---- */

static uint32_t chain_of(int node, int row, int dx)
{
    uint32_t h =
        (uint32_t)node * 0x9e3779b1u ^ (uint32_t)row * 0x85ebca6bu ^ (uint32_t)dx * 0xc2b2ae35u;
    return h >> 22;
}

static int variable_find(const struct emitter *e, int node, int row, int dx, bool canonical)
{
    for (uint32_t i = e->chains[chain_of(node, row, dx)]; i; i = e->variables[i - 1].next) {
        const struct variable *v = &e->variables[i - 1];
        if (v->node == node && v->row == row && v->dx == dx && v->canonical == canonical)
            return v->name;
    }
    return -1;
}

static int variable_add(struct emitter *e, int node, int row, int dx, bool canonical)
{
    if (e->variables_count == e->variables_capacity) {
        int capacity = (int)e->variables_capacity;
        e->variables = array_more(e->variables, &capacity, sizeof *e->variables, &e->failed);
        e->variables_capacity = (uint32_t)capacity;
    }
    if (e->failed)
        return 0;
    uint32_t h = chain_of(node, row, dx);
    e->variables[e->variables_count] =
        (struct variable){node, row, dx, canonical, e->names, e->chains[h]};
    e->chains[h] = ++e->variables_count;
    return e->names++;
}

/* A number: an argument, made a vector once, before the loop. */
static int constant_of(struct emitter *e, int node)
{
    if (e->constant_number[node])
        return e->constant_number[node] - 1;
    struct machine_type t = e->g->nodes[node].type;
    int k = e->constants_count++;
    switch (spell_letter(t)) {
    case 'I':
    case 'U':
    case 'F':
        emit_argument(&e->arguments, ARGUMENT_CONSTANT, node, 4, &e->failed);
        break;
    default:
        emit_argument(&e->arguments, ARGUMENT_CONSTANT, node, 8, &e->failed);
        break;
    }
    if (spell_letter(t) == 'Q') {
        emit_argument(&e->arguments, ARGUMENT_SECOND, node, 8, &e->failed);
        text_put(&e->constants, "    const VQ k%d = q_of((VL)(a%d), (VL)(h%d));\n", k, k, k);
        e->wide = true;
    } else {
        text_put(&e->constants, "    const %s k%d = (%s)(a%d);\n", spell_container(t), k,
                 spell_container(t), k);
    }
    e->constant_number[node] = k + 1;
    return k;
}

bool emit_is_box(const struct plan_graph *g, const struct plan_node *n)
{
    if (n->leaf || !op_has(n->op, OP_ORDERS))
        return false;
    const struct plan_node *a = &g->nodes[n->in[0]], *b = &g->nodes[n->in[1]];
    const struct plan_node *place = a->constant ? b : a;
    return a->constant != b->constant && place->op == NODE_COORDINATE && !place->leaf &&
           place->type.width <= 32;
}

/* Writes the scalar test that it holds for a whole vector, which, since it holds on one side of
 * a line, is that it holds at both ends. */
static bool note_box(struct emitter *e, const struct plan_node *n, int row, int dx)
{
    const char *symbol = node_words[n->op].word;
    if (!emit_is_box(e->g, n))
        return false;
    const struct plan_node *a = &e->g->nodes[n->in[0]], *b = &e->g->nodes[n->in[1]];
    const struct plan_node *place = a->constant ? b : a;
    int width = place->type.width;
    bool is_signed = n->op == MACHINE_SLT || n->op == MACHINE_SLE;
    int k = constant_of(e, a->constant ? n->in[0] : n->in[1]),
        bits = is_signed ? width - 1 : width;
    char number[64], ends[2][64];
    if (is_signed)
        snprintf(number, sizeof number, "((int)(a%d << %d) >> %d)", k, 32 - width, 32 - width);
    else
        snprintf(number, sizeof number, "a%d", k);
    bool column = place->axis == e->set->rank - 1;
    struct text *t = column ? &e->column_tests : &e->row_tests;
    if (column) {
        snprintf(ends[0], sizeof ends[0], "(x + (%d))", dx);
        text_put(t, " && %s >= 0 && %s + VECTOR <= W", ends[0], ends[0]);
        snprintf(ends[1], sizeof ends[1], "(x + (%d) + VECTOR - 1)", dx);
    } else {
        for (int i = 0; i < 2; i++)
            row_place(e, ends[i], sizeof ends[i], row, place->axis);
    }
    if (bits < 31)
        text_put(t, " && %s >> %d == 0", ends[1], bits);
    for (int i = 0; i < (column ? 2 : 1); i++) {
        const char *sign = is_signed ? "" : "(uint)";
        if (a->constant)
            text_put(t, " && %s %s %s%s", number, symbol, sign, ends[i]);
        else
            text_put(t, " && %s%s %s %s", sign, ends[i], symbol, number);
    }
    return true;
}

static void emit_generated(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                           int node, int row, int dx)
{
    char index[96], raw[300];
    int last = e->set->rank - 1;
    if (n->op == NODE_COORDINATE && n->axis != last) {
        char place[32];
        row_place(e, place, sizeof place, row, n->axis);
        snprintf(index, sizeof index, "(VU)((uint)%s)", place);
    } else if (n->op == NODE_COORDINATE) {
        snprintf(index, sizeof index,
                 dx ? "column(x + (" NUMBER_INT "), W)" : "column(x + (%d), W)", dx);
    } else {
        snprintf(index, sizeof index, "(column(x + (%d), W) + (uint)(r%d * W))", dx, row);
    }
    int reach = abs(dx);
    e->reach = reach > e->reach ? reach : e->reach;
    if (n->op == NODE_RANDOM) {
        int k = e->constants_count++;
        emit_argument(&e->arguments, ARGUMENT_CONSTANT, node, 8, &e->failed);
        emit_argument(&e->arguments, ARGUMENT_SECOND, node, 8, &e->failed);
        text_put(&e->constants, "    /* draw: key a%d, limit h%d */\n", k, k);
        if (n->detail == 0)
            snprintf(raw, sizeof raw, "(random_bits(%s, a%d) >> %dUL)", index, k,
                     64 - n->type.width);
        else if (n->detail == 1)
            snprintf(raw, sizeof raw, "(((random_bits(%s, a%d) >> 32UL) * h%d) >> 32UL)", index,
                     k, k);
        else
            snprintf(raw, sizeof raw, "mul_hi(random_bits(%s, a%d), (VL)(h%d))", index, k, k);
        if (n->type.width == 1)
            snprintf(out, size, "CMP_L((%s & 1UL) != 0UL)", raw);
        else {
            char w[340];
            spell_widened(w, sizeof w, raw, MACHINE_UINT(64), spell_letter(n->type));
            spell_cut(out, size, w, n->type.width);
        }
        return;
    }
    if (n->op == NODE_SEND_ADDRESS)
        snprintf(raw, sizeof raw, "((%s & ((1u << PLOG2) - 1u)) * (uint)RATIO + (%s >> PLOG2))",
                 index, index);
    else
        snprintf(raw, sizeof raw, "%s", index);
    if (n->type.width == 1)
        snprintf(out, size, "CMP_U((%s & 1u) != 0u)", raw);
    else {
        char w[340];
        spell_widened(w, sizeof w, raw, MACHINE_UINT(32), spell_letter(n->type));
        if (n->type.width < 32)
            spell_cut(out, size, w, n->type.width);
        else
            snprintf(out, size, "%s", w);
    }
}

static struct operand named(int name)
{
    struct operand o;
    snprintf(o.text, sizeof o.text, "v%d", name);
    return o;
}

/* ---- what other stages have in variables ---- */

static bool in_variables(const struct emitter *e, int node, int row)
{
    const struct together *t = e->together;
    const struct plan_node *n = &e->g->nodes[node];
    return t && !n->leaf && n->stage >= t->first && e->row_offsets[row].d[0] == t->down[node];
}

static struct operand earlier_vector(struct emitter *e, int node, int back)
{
    struct together *t = e->together;
    struct operand o;
    int i = 0;
    while (i < t->carried_count && t->carried[i].node != node)
        i++;
    if (i == t->carried_count) {
        if (i == t->carried_capacity)
            t->carried =
                array_more(t->carried, &t->carried_capacity, sizeof *t->carried, &e->failed);
        if (e->failed)
            return named(0);
        t->carried[t->carried_count++] = (struct carried){.node = node};
    }
    t->carried[i].back = back > t->carried[i].back ? back : t->carried[i].back;
    snprintf(o.text, sizeof o.text, "c%d_%d", i, back);
    return o;
}

/* The node's vector number `at` from x, of the row that it is computed in. */
static struct operand vector_at(struct emitter *e, int node, int row, int at)
{
    const struct plan_node *n = &e->g->nodes[node];
    int ahead = e->together->ahead[node];
    int back = (ahead - at) * e->together->direction;
    if (back > 0)
        return earlier_vector(e, node, back);
    int name = variable_find(e, node, row, ahead * e->together->vector,
                             n->maybe_nan && e->together->bits_matter[node]);
    e->failed = e->failed || back < 0 || name < 0;
    return named(name);
}

/* Lanes of two vectors side by side, from that one of the first on. */
static void spell_between(char *out, size_t size, const char *type, int lanes, int from,
                          const char *a, const char *b)
{
    static const char digits[] = "0123456789abcdef";
    bool named = lanes <= 16; /* lanes have names */
    size_t at = named ? (size_t)snprintf(out, size, "(%s)(", type)
                      : (size_t)snprintf(out, size, "__builtin_shufflevector(%s, %s, ", a, b);
    for (int i = 0; i < lanes; i++) {
        int lane = from + i;
        if (named)
            at += (size_t)snprintf(out + at, size - at, "%s%s.s%c", i ? ", " : "",
                                   lane < lanes ? a : b, digits[lane % lanes]);
        else
            at += (size_t)snprintf(out + at, size - at, "%s%d", i ? ", " : "", lane);
    }
    snprintf(out + at, size - at, ")");
}

/* true: the value is another's variable as it is, else an expression. */
static bool emit_between(struct emitter *e, int node, int row, int dx, struct operand *whole,
                         char *expression, size_t size)
{
    int lanes = e->together->vector, at = dx >= 0 ? dx / lanes : -((lanes - 1 - dx) / lanes);
    struct operand a = vector_at(e, node, row, at);
    if (at * lanes == dx) {
        *whole = a;
        return true;
    }
    struct operand b = vector_at(e, node, row, at + 1);
    spell_between(expression, size, spell_container(e->g->nodes[node].type), lanes,
                  dx - at * lanes, a.text, b.text);
    e->cost++;
    return false;
}

/* Bits side by side. */
static void spell_concat(char *out, size_t size, const char *type, const char *a,
                         struct machine_type from, const char *b, struct machine_type to)
{
    char low[120], high[120], shifted[160];
    spell_widened(low, sizeof low, a, from, type[1]);
    spell_widened(high, sizeof high, b, to, type[1]);
    if (type[1] == 'Q')
        snprintf(out, size, "q_or(%s, q_shl(%s, " NUMBER_INT "))", low, high, from.width);
    else {
        spell_shifted(shifted, sizeof shifted, high, "<<", from.width, type[1]);
        snprintf(out, size, "%s | %s", low, shifted);
    }
}

/* NOT or NEG of bits. */
static void spell_bits_unary(char *out, size_t size, const struct plan_node *n,
                             const char *type, const char *a)
{
    char raw[100];
    if (type[1] == 'Q')
        snprintf(raw, sizeof raw, "%s(%s)", node_words[n->op].second, a);
    else
        snprintf(raw, sizeof raw, "%s%s", node_words[n->op].word, a);
    if (type[1] == 'I')
        snprintf(out, size, "%s", raw);
    else
        spell_cut(out, size, raw, n->type.width);
}

/* An operation of a native type, or of doubles, on operands that have been spelt. */
static void spell_operation(struct emitter *e, char *out, size_t size,
                            const struct plan_node *n, const struct operand in[3])
{
    struct machine_type from = e->g->nodes[n->in[0]].type;
    const char *a = in[0].text, *b = in[1].text, *type = spell_container(n->type);
    switch ((enum op_spell)node_ops[n->op].spell) {
    case SPELL_SELECT:
        snprintf(out, size, "SEL_%c(%s, %s, %s)", type[1], a, b, in[2].text);
        break;
    case SPELL_BITS_ONE:
        spell_bits_unary(out, size, n, type, a);
        break;
    case SPELL_BITS:
        spell_bits_binary(out, size, n->op, from, a, b);
        break;
    case SPELL_INTEGER:
        e->integers = true;
        spell_integer(out, size, n->op, from, a, b);
        break;
    case SPELL_FLOAT_FUNCTION:
    case SPELL_FLOAT_OPERATOR:
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
        spell_float(out, size, n->op, from, a, b);
        break;
    case SPELL_MATH:
        spell_math(out, size, n->op, from, a, b);
        e->math = true;
        break;
    case SPELL_OVERFLOW:
        spell_overflow(out, size, n->op, from, a, b);
        e->wide = e->wide || (from.kind == MACHINE_BITS && from.width > 32);
        break;
    case SPELL_CONCAT:
        spell_concat(out, size, type, a, from, b, e->g->nodes[n->in[1]].type);
        break;
    case SPELL_CONVERSION:
        spell_conversion(out, size, n, from, a);
        break;
    case SPELL_PLACE:
        INVARIANT(node_ops[n->op].spell != SPELL_PLACE); /* it is loaded, or emit_generated() */
    }
}

/* What is in an array at each lane's place; 0 where that is not below count. */
static void emit_fetched(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                         int array, const char *place, const char *count)
{
    text_put(&e->body,
             "        const VU i%d = %s, j%d = INSIDE(i%d, %s);\n"
             "        const int w%d = IN_A_ROW(i%d, %s);\n",
             e->names, place, e->names, e->names, count, e->names, e->names, count);
    snprintf(out, size, "GATHER(%c, %s, %s, b%d, i%d, %s, j%d, w%d)", spell_letter(n->type),
             memory_kind(n->type), memory_type(n->type), input_of(e, array), e->names, count,
             e->names, e->names);
    e->ops++;
    e->loads++;
    e->cost += node_cost(n->op, n->type);
}

static void emit_gather(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                        int row, int dx)
{
    struct operand place = emit_value(e, plan_input(e->g, n, 0, e->stage), row, dx, false),
                   count = emit_value(e, n->in[2], row, dx, false);
    emit_fetched(e, out, size, n, n->in[1], place.text, count.text);
}

/* Of the processor whose index differs in a number's bits, which is in the row. */
static void emit_cross(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                       int row, int dx)
{
    char place[120];
    const int reach = abs(dx);
    const struct operand bits = emit_value(e, n->in[1], row, dx, false);
    e->reach = reach > e->reach ? reach : e->reach;
    snprintf(place, sizeof place,
             "(column(x + (%d), W) ^ %s) + (VU)((uint)(r%d * PITCH + HALO))", dx, bits.text,
             row);
    emit_fetched(e, out, size, n, plan_input(e->g, n, 0, e->stage), place, "(VU)(UINT_MAX)");
}

/* What a node computes of its operands. */
static void emit_operation(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                           int row, int dx, bool canonical)
{
    struct operand in[3] = {{""}, {""}, {""}};
    for (int i = 0; i < node_ops[n->op].inputs; i++) {
        bool want = n->op == NODE_SELECT ? canonical : node_reads_bits(n->op);
        in[i] = emit_value(e, plan_input(e->g, n, i, e->stage), row, dx, want);
    }
    struct machine_type from = e->g->nodes[n->in[0]].type;
    e->ops++;
    e->cost += node_cost(n->op, n->type);
    e->wide = e->wide || spell_letter(from) == 'Q';
    enum op_soft soft = op_soft(n->op, n->type, from);
    bool spelt = spell_soft(out, size, n, from, in[0].text, in[1].text);
    if (e->lane < LANE_WIDE) {
        narrow_spell(out, size, e->g, n, e->lane, in[0].text, in[1].text, in[2].text);
        spelt = true;
    } else if (!spelt) {
        spell_operation(e, out, size, n, in);
    }
    if (!spelt && soft != OP_SOFT_NOT)
        spell_soft_rounding(out, size, n->type);
    e->soft = e->soft || soft == OP_SOFT_LANES;
    e->formats = e->formats || soft == OP_SOFT_VECTORS;
}

/* What an array, or a row of a ring, has there. */
static void emit_load(struct emitter *e, char *out, size_t size, const struct plan_node *n,
                      int node, int row, int dx)
{
    int p = pointer_of(e, node, row);
    if (e->failed)
        return;
    struct access *seen = &e->seen_pointers[p];
    seen->low = dx < seen->low ? dx : seen->low;
    seen->high = dx > seen->high ? dx : seen->high;
    e->reach = abs(dx) > e->reach ? abs(dx) : e->reach;
    snprintf(out, size, dx ? "LOAD_%s(p%d, %s(" NUMBER_INT "))" : "LOAD_%s(p%d, %s(%d))",
             memory_kind(n->type), p, e->near && !n->leaf ? "NEAR" : "AT", dx);
    e->loads++;
}

struct operand emit_value(struct emitter *e, int node, int row, int dx, bool canonical)
{
    const struct plan_node *n = &e->g->nodes[node];
    struct operand result;
    if (e->failed)
        return named(0);
    if (n->constant) {
        snprintf(result.text, sizeof result.text, "k%d", constant_of(e, node));
        return result;
    }
    /* Where another stage already has this value in a variable, that is reused as it was stored
     * (NaNs canonical or not, as bits_matter says): never a second copy that was made canonical
     * in another way. */
    bool loads = plan_loads(n, e->stage), kept = loads && in_variables(e, node, row),
         stored = loads || n->op == NODE_CROSS; /* what a cross looks at is in memory */
    canonical = n->maybe_nan && (kept ? e->together->bits_matter[node] : canonical && !stored);
    int known = variable_find(e, node, row, dx, canonical);
    if (known >= 0)
        return named(known);
    char expression[1200];
    const char *type = spell_container(n->type);
    e->wide = e->wide || type[1] == 'Q';
    if (kept) {
        if (emit_between(e, node, row, dx, &result, expression, sizeof expression))
            return result;
    } else if (loads) {
        emit_load(e, expression, sizeof expression, n, node, row, dx);
        if (e->failed)
            return named(0);
    } else if (n->op == NODE_SHIFT) {
        bool along_row = n->axis == e->set->rank - 1;
        int moved_row = along_row ? row : row_moved(e, row, n->axis, n->detail);
        return emit_value(e, n->in[0], moved_row, along_row ? dx + n->detail : dx, canonical);
    } else if (canonical && !(n->op == NODE_SELECT && accesses_holds_bits(e->g, node))) {
        struct operand a = emit_value(e, node, row, dx, false);
        snprintf(expression, sizeof expression, "CANON_%c(%s)", type[1], a.text);
    } else if (n->op == NODE_GATHER) {
        emit_gather(e, expression, sizeof expression, n, row, dx);
    } else if (n->op == NODE_CROSS) {
        emit_cross(e, expression, sizeof expression, n, row, dx);
    } else if (node_ops[n->op].inputs == 0) {
        emit_generated(e, expression, sizeof expression, n, node, row, dx);
        e->cost += node_cost(n->op, n->type);
    } else {
        emit_operation(e, expression, sizeof expression, n, row, dx, canonical);
    }
    int name = variable_add(e, node, row, dx, canonical);
    bool box = !loads && note_box(e, n, row, dx);
    /* Not const: clang looks through constants' initial values, and through both arms of each
     * choice, in a time that doubles with each value of a chain. */
    text_put(&e->body, box ? "        %s v%d = BOX(%s);\n" : "        %s v%d = %s;\n", type,
             name, expression);
    return named(name);
}
