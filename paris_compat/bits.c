/* Moves and logical operations on fields of any length: fields longer than an integer are
 * processed in pieces. */
#include "paris_state.h"

#include <stdlib.h>

/* By truth table: an operation of the machine, and what is inverted. */
static const struct boolean {
    uint8_t op, not_a, not_b, not_result;
} boolean_how[16] = {
    [0x1] = {MACHINE_AND, 0, 0, 0}, [0x2] = {MACHINE_AND, 0, 1, 0},
    [0x4] = {MACHINE_AND, 1, 0, 0}, [0x8] = {MACHINE_OR, 0, 0, 1},
    [0x7] = {MACHINE_OR, 0, 0, 0},  [0xb] = {MACHINE_OR, 0, 1, 0},
    [0xd] = {MACHINE_OR, 1, 0, 0},  [0xe] = {MACHINE_AND, 0, 0, 1},
    [0x6] = {MACHINE_XOR, 0, 0, 0}, [0x9] = {MACHINE_XOR, 0, 0, 1},
};

/* Whether that operation is all. */
static bool boolean_is_plain(unsigned int truth)
{
    return truth == 0x1 || truth == 0x7 || truth == 0x6;
}

struct machine_value *paris_boolean(struct machine *m, unsigned int truth,
                                    struct machine_value *a, struct machine_value *b)
{
    const struct boolean *how = boolean_how;
    if (!a || !b)
        return NULL;
    if (truth == 0xc)
        return machine_unary(m, MACHINE_NOT, a);
    if (how[truth].not_a)
        a = machine_unary(m, MACHINE_NOT, a);
    if (how[truth].not_b)
        b = machine_unary(m, MACHINE_NOT, b);
    struct machine_value *v = a && b ? machine_binary(m, how[truth].op, a, b) : NULL;
    return v && how[truth].not_result ? machine_unary(m, MACHINE_NOT, v) : v;
}

/* The piece of an operand that begins at bit `offset`; beyond the word of a constant, zeros
 * or its sign. */
static struct paris_operand piece(struct paris_operand a, unsigned int offset, unsigned int len)
{
    a.len = len;
    if (!a.is_constant)
        a.field += offset;
    else if (offset >= 64)
        a.value.bits = a.letter == 's' && (long)a.value.bits < 0 ? ~0ul : 0;
    else
        a.value.bits >>= offset; /* pieces begin at multiples of 64 */
    if (len == 1)
        a.letter = 'b';
    return a;
}

/* Returns the value to store in the piece of dest that begins at bit `at`. NULL: an error,
 * which has been reported. */
typedef struct machine_value *piece_value(struct machine *m,
                                          const struct paris_instruction *self,
                                          const struct paris_operand *sources,
                                          unsigned int dest_len, unsigned int at,
                                          unsigned int len);

static bool crosses(struct paris_operand dest, struct paris_operand source)
{
    return !source.is_constant && source.field != dest.field &&
           dest.field < source.field + source.len && source.field < dest.field + dest.len;
}

/* Stores a long field piece by piece. before: reads all pieces before storing one. */
static void store_pieces(struct machine *m, const struct paris_instruction *self,
                         struct paris_operand dest, const struct paris_operand *sources,
                         piece_value *value, bool before)
{
    unsigned int count = (dest.len - 1) / PARIS_PIECE + 1;
    struct machine_value **values =
        before ? malloc(count * sizeof(struct machine_value *)) : NULL;
    if (before && !values) {
        paris_fail_memory("not enough memory for a move of %u bits", dest.len);
        return;
    }
    for (int pass = before ? 0 : 1; pass < 2; pass++)
        for (unsigned int i = 0; i < count; i++) {
            unsigned int at = i * PARIS_PIECE;
            unsigned int len = dest.len - at < PARIS_PIECE ? dest.len - at : PARIS_PIECE;
            struct machine_value *v =
                pass && before ? values[i] : value(m, self, sources, dest.len, at, len);
            if (!v || (pass && !paris_store(m, piece(dest, at, len), v, self->scope))) {
                free(values);
                return;
            }
            if (!pass)
                values[i] = v;
        }
    free(values);
}

static struct machine_value *logical_piece(struct machine *m,
                                           const struct paris_instruction *self,
                                           const struct paris_operand *sources,
                                           unsigned int dest_len, unsigned int at,
                                           unsigned int len)
{
    (void)dest_len;
    struct paris_operand a = piece(sources[0], at, len), b = piece(sources[1], at, len);
    struct machine_value *x = paris_load(m, a, "source1", self->scope);
    struct machine_value *y =
        x ? paris_load(m, b, b.is_constant ? "value" : "source2", self->scope) : NULL;
    struct machine_value *v = y ? paris_boolean(m, self->op, x, y) : NULL;
    if (y && !v)
        paris_fail_machine();
    return v;
}

/* A field of no bits occurs in empty loops: nothing is done. */
void paris_logical(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    const enum machine_op op = boolean_how[self->op].op;
    if (boolean_is_plain(self->op) && paris_direct(m, op, false, dest, a, b))
        return;
    if (dest.len == 0 || !paris_check_operand(dest, "dest") ||
        !paris_check_operand(a, "source1") || !paris_check_operand(b, "source2") ||
        !paris_check_overlap(dest, a) || !paris_check_overlap(dest, b))
        return;
    const struct paris_operand sources[2] = {a, b};
    if (dest.len > PARIS_INTEGER_MAX) {
        store_pieces(m, self, dest, sources, logical_piece,
                     crosses(dest, a) || crosses(dest, b));
        return;
    }
    struct machine_value *v = logical_piece(m, self, sources, dest.len, 0, dest.len);
    if (v)
        paris_store(m, dest, v, self->scope);
}

/* ---- moves ---- */

static void move_float(struct machine *m, const struct paris_instruction *self,
                       struct paris_operand dest, struct paris_operand a)
{
    struct machine_type type;
    if (!paris_type(dest, "dest", &type) || !paris_check_overlap(dest, a))
        return;
    struct machine_value *v = paris_load(m, a, a.is_constant ? "value" : "source", self->scope);
    if (!v)
        return;
    v = machine_to_float(m, v, type, false);
    paris_store(m, dest, v, self->scope);
}

static void move_short(struct machine *m, const struct paris_instruction *self,
                       struct paris_operand dest, struct paris_operand a)
{
    if (a.len == 1) /* one bit, though there is no signed number of one bit */
        a.letter = 'b';
    struct machine_value *v = paris_load(m, a, a.is_constant ? "value" : "source", self->scope);
    if (!v)
        return;
    if (a.len != dest.len)
        v = machine_resize(m, v, (int)dest.len, dest.letter == 's');
    paris_store(m, dest, v, self->scope);
}

/* Fills dest's bits beyond the source's: with zeros, or with the source's last bit. */
static struct machine_value *filling(struct machine *m, const struct paris_instruction *self,
                                     struct paris_operand a, unsigned int len)
{
    if (a.letter != 's')
        return machine_constant(m, MACHINE_UINT(len), (struct machine_scalar){0, 0});
    struct machine_value *sign =
        paris_load(m, paris_b(a.field + a.len - 1, 1), "source", self->scope);
    return sign ? machine_resize(m, sign, (int)len, true) : NULL;
}

static struct machine_value *move_piece(struct machine *m, const struct paris_instruction *self,
                                        const struct paris_operand *sources,
                                        unsigned int dest_len, unsigned int at,
                                        unsigned int len)
{
    (void)dest_len;
    struct paris_operand a = sources[0];
    if (a.is_constant || at + len <= a.len)
        return paris_load(m, piece(a, at, len), "source", self->scope);
    if (at >= a.len)
        return filling(m, self, a, len);
    struct machine_value *v = paris_load(m, piece(a, at, a.len - at), "source", self->scope);
    return v ? machine_resize(m, v, (int)len, a.letter == 's') : NULL;
}

void paris_move(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    if (dest.letter == 'f') {
        move_float(m, self, dest, a);
        return;
    }
    if (dest.len == 0)
        return;
    if (!paris_check_operand(dest, "dest") ||
        !paris_check_operand(a, a.is_constant ? "value" : "source") ||
        !paris_check_overlap(dest, a))
        return;
    if (a.len == 0) {
        paris_fail("source: length must be 1 or more bits (got 0)");
        return;
    }
    if (dest.len <= PARIS_INTEGER_MAX && a.len <= PARIS_INTEGER_MAX)
        move_short(m, self, dest, a);
    else
        store_pieces(m, self, dest, &a, move_piece, crosses(dest, a));
}

/* ---- two fields ---- */

static struct machine_value *reversed_piece(struct machine *m,
                                            const struct paris_instruction *self,
                                            const struct paris_operand *sources,
                                            unsigned int dest_len, unsigned int at,
                                            unsigned int len)
{
    struct paris_operand a = piece(sources[0], dest_len - at - len, len);
    struct machine_value *v = paris_load(m, a, "source", self->scope);
    return v ? machine_unary(m, MACHINE_REVERSE, v) : NULL;
}

void paris_move_reversed(const struct paris_instruction *self, struct paris_operand dest,
                         struct paris_operand source)
{
    struct machine *m = paris_begin(self->name);
    if (dest.len && paris_check_operand(dest, "dest") &&
        paris_check_operand(source, "source") && paris_check_overlap(dest, source))
        store_pieces(m, self, dest, &source, reversed_piece,
                     crosses(dest, source) || source.field == dest.field);
}

void paris_swap(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand source)
{
    struct machine *m = paris_begin(self->name);
    if (!paris_check_operand(dest, "dest") || !paris_check_operand(source, "source") ||
        !paris_check_overlap(dest, source))
        return;
    if (crosses(dest, source)) {
        paris_fail("fields that overlap in part cannot change places");
        return;
    }
    for (unsigned int at = 0; at < dest.len; at += PARIS_PIECE) {
        unsigned int len = dest.len - at < PARIS_PIECE ? dest.len - at : PARIS_PIECE;
        struct paris_operand a = piece(dest, at, len), b = piece(source, at, len);
        struct machine_value *x = paris_load(m, a, "dest", self->scope);
        struct machine_value *y = x ? paris_load(m, b, "source", self->scope) : NULL;
        if (!y || !paris_store(m, a, y, self->scope) || !paris_store(m, b, x, self->scope))
            return;
    }
}
