/* Tests the table of operations: every row keeps the promises of base/node_ops.h, and codegen
 * has text for every row in each type that it takes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/node_ops.h"
#include "codegen/narrow_spell.h"
#include "codegen/spell.h"
#include "kernels.h"
#include "plan/lanes.h"

/* ---- rows ---- */

static void each_operation_is_a_row(void **state)
{
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++) {
        const struct node_op_info *row = &node_ops[op];
        if (!row->name)
            fail_msg("operation %d has no row", op);
        for (int other = 0; other < op; other++)
            assert_string_not_equal(row->name, node_ops[other].name);
        assert_in_range(row->inputs, 0, 3);
    }
}

static bool needs_second_word(int op)
{
    switch (node_ops[op].spell) {
    case SPELL_BITS_ONE:
        return true;
    case SPELL_BITS:
        return op_has(op, OP_CUTS);
    case SPELL_FLOAT_OPERATOR:
        return true;
    default:
        return false;
    }
}

static void callers_operations_have_words(void **state)
{
    (void)state;
    for (int op = 0; op < MACHINE_OP_COUNT_PUBLIC; op++) {
        const struct node_op_info *row = &node_ops[op];
        bool good = (row->inputs == 1 || row->inputs == 2) && row->takes != TAKES_ANY &&
                    row->gives != GIVES_SAID && row->cost > 0 && row->fold != FOLD_MAKER &&
                    op_has(op, OP_ALONE) && node_words[op].word &&
                    (node_words[op].second || !needs_second_word(op));
        if (!good)
            fail_msg("the row of %s lacks something", row->name);
    }
}

static void columns_agree(void **state)
{
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++) {
        const struct node_op_info *row = &node_ops[op];
        bool counts = row->fold == FOLD_QUOTIENT || row->fold == FOLD_POWER ||
                      row->fold == FOLD_SHIFT || row->fold == FOLD_COUNT;
        bool good =
            counts == (row->spell == SPELL_INTEGER) &&
            (row->fold == FOLD_MATH) == (row->spell == SPELL_MATH) &&
            (row->spell == SPELL_PLACE) == !op_has(op, OP_ALONE) &&
            (!op_has(op, OP_NARROW_BITS) || op_has(op, OP_NARROW)) &&
            (!op_has(op, OP_ORDERS) || (row->spell == SPELL_BITS && row->gives == GIVES_BIT)) &&
            (row->nan == NAN_NEVER || row->gives != GIVES_BIT) &&
            (row->nan != NAN_SECOND || row->inputs == 2);
        if (!good)
            fail_msg("columns of %s contradict each other", row->name);
    }
}

static void unknown_operations_suit_nobody(void **state)
{
    (void)state;
    assert_false(op_suits((enum machine_op)NODE_SELECT, 1, MACHINE_UINT(8)));
    assert_false(op_suits((enum machine_op)1000, 1, MACHINE_UINT(8)));
    assert_false(op_suits(MACHINE_AND, 1, MACHINE_UINT(8)));
    assert_false(op_suits(MACHINE_FADD, 2, MACHINE_UINT(32)));
    assert_false(op_suits(MACHINE_ADD, 2, MACHINE_F32));
    assert_true(op_suits(MACHINE_FADD, 2, MACHINE_F64));
    assert_false(machine_op_is_function(MACHINE_FADD));
    assert_false(machine_op_is_function(NODE_OP_COUNT + 5));
    assert_true(machine_op_is_function(MACHINE_FSCALE));
}

/* ---- words ---- */

static void seems_spelt(const char *text, int op, int width)
{
    if (!*text || strstr(text, "(null)") || (node_ops[op].inputs && !strstr(text, "aa")) ||
        strlen(text) > 1000)
        fail_msg("%s of %d bits is spelt '%s'", node_ops[op].name, width, text);
}

static void spell(char *out, size_t size, int op, struct machine_type type)
{
    switch ((enum op_spell)node_ops[op].spell) {
    case SPELL_BITS:
        spell_bits_binary(out, size, op, type, "aa", "bb");
        break;
    case SPELL_INTEGER:
        spell_integer(out, size, op, type, "aa", "bb");
        break;
    case SPELL_FLOAT_FUNCTION:
    case SPELL_FLOAT_OPERATOR:
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
        spell_float(out, size, op, type, "aa", "bb");
        break;
    case SPELL_MATH:
        spell_math(out, size, op, type, "aa", "bb");
        break;
    case SPELL_BITS_ONE:
    case SPELL_PLACE:
    case SPELL_SELECT:
    case SPELL_CONCAT:
    case SPELL_CONVERSION:
    case SPELL_OVERFLOW:
        snprintf(out, size, "aa");
        break;
    }
}

static void each_operation_is_spelt(void **state)
{
    (void)state;
    char text[1200], other[1200];
    for (int op = 0; op < MACHINE_OP_COUNT_PUBLIC; op++)
        if (node_ops[op].takes == TAKES_BITS) {
            for (int width = 2; width <= 128; width++) {
                spell(text, sizeof text, op, MACHINE_UINT(width));
                seems_spelt(text, op, width);
            }
        } else {
            spell(text, sizeof text, op, MACHINE_F32);
            spell(other, sizeof other, op, MACHINE_F64);
            seems_spelt(text, op, 32);
            seems_spelt(other, op, 64);
        }
}

/* Two different operations never have the same text. */
static void no_two_are_spelt_alike(void **state)
{
    (void)state;
    char text[1200], other[1200];
    for (int width = 5; width <= 125; width += 40)
        for (int op = 0; op < MACHINE_OP_COUNT_PUBLIC; op++)
            for (int k = 0; k < op; k++) {
                enum op_spell how = (enum op_spell)node_ops[op].spell;
                if (node_ops[op].takes != node_ops[k].takes || how == SPELL_BITS_ONE ||
                    node_ops[k].spell == SPELL_BITS_ONE)
                    continue;
                bool bits = node_ops[op].takes == TAKES_BITS;
                spell(text, sizeof text, op, bits ? MACHINE_UINT(width) : MACHINE_F64);
                spell(other, sizeof other, k, bits ? MACHINE_UINT(width) : MACHINE_F64);
                assert_string_not_equal(text, other);
            }
}

/* An operation that its row calls narrow has text in lanes of 8 and 16 bits. */
static void narrow_operations_are_spelt(void **state)
{
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++)
        for (int width = 1; width <= 16; width++) {
            const struct node_op_info *row = &node_ops[op];
            struct plan_node nodes[4] = {{.leaf = true, .type = MACHINE_UINT(width)}};
            nodes[1] = nodes[2] = nodes[0];
            nodes[3] = (struct plan_node){.op = (uint8_t)op,
                                          .type = row->gives == GIVES_BIT ? MACHINE_BIT
                                                                          : nodes[0].type,
                                          .in = {0, 1, 2},
                                          .instead = {-1, -1, -1}};
            struct plan_graph g = {.nodes = nodes, .count = 4};
            int lane = lanes_of_node(&g, 3, false);
            char text[600];
            if (row->spell == SPELL_PLACE)
                continue;
            bool narrow = op_has(op, width == 1 ? OP_NARROW_BITS : OP_NARROW);
            if (op == NODE_ZERO_EXTEND && width == 1)
                narrow = false; /* a bit to a bit is no extension */
            assert_int_equal(lane < LANE_WIDE, narrow);
            if (lane < LANE_WIDE) {
                narrow_spell(text, sizeof text, &g, &nodes[3], lane, "aa", "bb", "cc");
                if (op != NODE_OVERFLOW_UADD)
                    seems_spelt(text, op, width);
            }
        }
}

/* The names of operations as kernels/lane.cl writes them. */
static const char *const constants[NODE_OP_COUNT] = {
#define OPERATION(op, ...) [op] = #op,
#define NODE(op, ...) [op] = #op,
#include "machine_op.tab"
#undef OPERATION
#undef NODE
};

static bool is_performed(const char *name)
{
    size_t length = strlen(name);
    for (const char *at = kernel_lane_cl; (at = strstr(at, name)); at++)
        if (!strncmp(at - 5, "case ", 5) && at[length] == ':')
            return true;
    return false;
}

static void devices_perform_each_operation(void **state)
{
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++) {
        int spell = node_ops[op].spell;
        if (spell == SPELL_PLACE || spell == SPELL_CONCAT || spell == SPELL_SELECT ||
            op == NODE_REINTERPRET) /* by their families, or as steps of their own */
            continue;
        if (spell == SPELL_INTEGER || spell == SPELL_MATH) /* cases made of their rows */
            continue;
        if (!is_performed(constants[op]))
            fail_msg("kernels/lane.cl does not perform %s", constants[op]);
    }
    assert_non_null(strstr(kernel_lane_cl, " INTEGER_CASES\n"));
    assert_non_null(strstr(kernel_lane_cl, " MATH_CASES\n"));
    assert_null(strstr(kernel_lane_cl, "default:")); /* it would perform what has no case */
    assert_false(is_performed("MACHINE_NOTHING"));
    assert_false(is_performed("MACHINE_S"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_operation_is_a_row),
        cmocka_unit_test(callers_operations_have_words),
        cmocka_unit_test(columns_agree),
        cmocka_unit_test(unknown_operations_suit_nobody),
        cmocka_unit_test(each_operation_is_spelt),
        cmocka_unit_test(no_two_are_spelt_alike),
        cmocka_unit_test(narrow_operations_are_spelt),
        cmocka_unit_test(devices_perform_each_operation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
