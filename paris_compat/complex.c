/* Complex numbers: the instructions.
 *
 * Sums, differences and products are computed part by part in the format itself (a product
 * is (ac - bd, ad + bc), each operation rounded). All other functions are computed in
 * doubles, and rounded to the format at the end. Overflow is 1 if a part of the result is
 * infinite or a NaN, and no part of the operands is. A NaN that the formulas give for
 * infinite operands is not corrected to infinity.
 */
#include <stdlib.h>

#include "paris_state.h"

static const struct paris_cvalue nothing = {NULL, NULL};

static bool type_of(struct paris_complex a, const char *role, struct machine_type *type)
{
    return paris_type(a.re, role, type);
}

/* In either mode, checks that both parts exist: an instruction stores both or none. */
static bool check(struct paris_complex a, const char *role)
{
    struct machine_field_info info;
    unsigned int bits = 2 * paris_operand_bits(a.re);
    if (a.re.is_constant)
        return true;
    if (!paris_check_field(a.re.field, bits, role))
        return false;
    if (machine_field_lookup(paris_the.machine, a.re.field, &info) &&
        bits > info.bits - info.offset) {
        paris_fail(
            "%s: a complex number of %u bits reaches beyond its field, which has %u from "
            "here: allocate a longer one",
            role, bits, info.bits - info.offset);
        return false;
    }
    return true;
}

static bool check_overlap(struct paris_complex dest, struct paris_complex source)
{
    return source.re.is_constant ||
           paris_check_overlap(paris_b(dest.re.field, 2 * paris_operand_bits(dest.re)),
                               paris_b(source.re.field, 2 * paris_operand_bits(source.re)));
}

static struct paris_cvalue load(struct machine *m, struct paris_complex a, const char *role,
                                enum machine_scope scope)
{
    struct paris_cvalue z = nothing;
    if (!check(a, role))
        return z;
    z.re = paris_load(m, a.re, role, scope);
    z.im = z.re ? paris_load(m, a.im, role, scope) : NULL;
    return z;
}

static bool good(struct paris_cvalue z)
{
    return z.re && z.im;
}

static struct paris_cvalue converted(struct machine *m, struct paris_cvalue z,
                                     struct machine_type type)
{
    return (struct paris_cvalue){machine_to_float(m, z.re, type, false),
                                 machine_to_float(m, z.im, type, false)};
}

static struct paris_cvalue doubles(struct machine *m, struct paris_cvalue z)
{
    return converted(m, z, MACHINE_F64);
}

/* Whether the square of every number of the format is in a double's range. */
static bool is_narrow(struct paris_operand a)
{
    return a.e <= 9 && a.len <= 32;
}

static bool store(struct machine *m, struct paris_complex dest, struct paris_cvalue z,
                  enum machine_scope scope)
{
    struct machine_type type;
    if (!check(dest, "dest") || !type_of(dest, "dest", &type))
        return false;
    if (good(z))
        z = converted(m, z, type);
    if (!good(z)) {
        paris_fail_machine();
        return false;
    }
    return paris_store(m, dest.re, z.re, scope) && paris_store(m, dest.im, z.im, scope);
}

/* ---- overflow ---- */

/* 1 where both parts are finite */
static struct machine_value *is_finite(struct machine *m, struct paris_cvalue z)
{
    struct machine_value *re = machine_binary(m, MACHINE_FSUB, z.re, z.re);
    struct machine_value *im = machine_binary(m, MACHINE_FSUB, z.im, z.im);
    return machine_binary(m, MACHINE_FEQ, re, im);
}

/* a.re NULL: there is one operand. */
static bool overflow(struct machine *m, const struct paris_instruction *self,
                     struct paris_complex dest, struct paris_cvalue r, struct paris_cvalue a,
                     struct paris_cvalue b)
{
    struct machine_type type;
    if (!self->overflow)
        return true;
    if (!type_of(dest, "dest", &type))
        return false;
    struct machine_value *before = is_finite(m, b);
    if (good(a))
        before = machine_binary(m, MACHINE_AND, before, is_finite(m, a));
    struct machine_value *after = is_finite(m, converted(m, r, type));
    after = machine_unary(m, MACHINE_NOT, after);
    return paris_flag_put(m, MACHINE_OVERFLOW, machine_binary(m, MACHINE_AND, before, after),
                          MACHINE_WHERE_ACTIVE);
}

/* ---- the families ---- */

static struct paris_cvalue by_parts(struct machine *m, enum machine_op op,
                                    struct paris_cvalue a, struct paris_cvalue b)
{
    return (struct paris_cvalue){machine_binary(m, op, a.re, b.re),
                                 machine_binary(m, op, a.im, b.im)};
}

static struct paris_cvalue arithmetic(struct machine *m, enum paris_complex_binary_op op,
                                      struct paris_cvalue a, struct paris_cvalue b)
{
    switch (op) {
    case PARIS_C_ADD:
        return by_parts(m, MACHINE_FADD, a, b);
    case PARIS_C_SUBTRACT:
        return by_parts(m, MACHINE_FSUB, a, b);
    case PARIS_C_MULTIPLY:
        return paris_complex_multiply(a, b);
    case PARIS_C_DIVIDE:
        return paris_complex_divide(doubles(m, a), doubles(m, b));
    case PARIS_C_POWER:
        return paris_complex_power(doubles(m, a), doubles(m, b));
    }
    abort(); /* the table of instructions has no other */
}

void paris_complex_binary(const struct paris_instruction *self, struct paris_complex dest,
                          struct paris_complex a, struct paris_complex b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!type_of(dest, "dest", &type) || !check(dest, "dest") || !check_overlap(dest, a) ||
        !check_overlap(dest, b))
        return;
    struct paris_cvalue x =
        load(m, a, a.re.field == dest.re.field ? "dest" : "source1", self->scope);
    struct paris_cvalue y =
        good(x) ? load(m, b, b.re.is_constant ? "value" : "source2", self->scope) : nothing;
    if (!good(y))
        return;
    struct paris_cvalue r =
        self->swap ? arithmetic(m, self->op, y, x) : arithmetic(m, self->op, x, y);
    if (overflow(m, self, dest, r, x, y))
        store(m, dest, r, self->scope);
}

void paris_complex_unary(const struct paris_instruction *self, struct paris_complex dest,
                         struct paris_complex a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!type_of(dest, "dest", &type) || !check(dest, "dest") || !check_overlap(dest, a))
        return;
    struct paris_cvalue z = load(m, a, "source", self->scope), r;
    if (!good(z))
        return;
    if (self->op == PARIS_C_NEGATE || self->op == PARIS_C_CONJUGATE) {
        r.re = self->op == PARIS_C_NEGATE ? machine_unary(m, MACHINE_FNEG, z.re) : z.re;
        r.im = machine_unary(m, MACHINE_FNEG, z.im);
    } else {
        r = paris_complex_function(self->op, doubles(m, z), is_narrow(a.re));
    }
    if (overflow(m, self, dest, r, nothing, z))
        store(m, dest, r, self->scope);
}

void paris_complex_compare(const struct paris_instruction *self, struct paris_complex a,
                           struct paris_complex b)
{
    struct machine *m = paris_begin(self->name);
    struct paris_cvalue x = load(m, a, "source1", MACHINE_WHERE_ACTIVE);
    struct paris_cvalue y =
        good(x) ? load(m, b, b.re.is_constant ? "value" : "source2", MACHINE_WHERE_ACTIVE)
                : nothing;
    if (!good(y))
        return;
    bool same = self->op == PARIS_C_EQ;
    struct paris_cvalue r = by_parts(m, same ? MACHINE_FEQ : MACHINE_FNE, x, y);
    paris_flag_put(m, MACHINE_TEST,
                   machine_binary(m, same ? MACHINE_AND : MACHINE_OR, r.re, r.im),
                   MACHINE_WHERE_ACTIVE);
}

void paris_complex_move(const struct paris_instruction *self, struct paris_complex dest,
                        struct paris_complex a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!type_of(dest, "dest", &type) || !check(dest, "dest") || !check_overlap(dest, a))
        return;
    struct paris_cvalue z = load(m, a, a.re.is_constant ? "value" : "source", self->scope);
    if (good(z))
        store(m, dest, z, self->scope);
}

void paris_complex_raise(const struct paris_instruction *self, struct paris_complex dest,
                         struct paris_complex a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!type_of(dest, "dest", &type) || !check(dest, "dest") || !check_overlap(dest, a) ||
        !paris_check_overlap(paris_b(dest.re.field, 2 * paris_operand_bits(dest.re)), b))
        return;
    struct paris_cvalue z = load(m, a, "source1", self->scope), r, w = nothing;
    struct machine_value *n =
        good(z) ? paris_load(m, b, b.is_constant ? "value" : "source2", self->scope) : NULL;
    if (!n)
        return;
    /* A small constant exponent is cut to its low bits, so that few products are computed. */
    if (b.is_constant && (b.letter == 's'   ? b.value.bits + 512 < 1024
                          : b.letter == 'u' ? b.value.bits < 1024
                                            : false))
        n = machine_extract(m, n, 0, 10);
    if (b.letter == 'f') {
        w.re = w.im = n;
        r = paris_complex_power_real(doubles(m, z), machine_to_float(m, n, MACHINE_F64, false));
    } else {
        r = paris_complex_power_whole(doubles(m, z), n, b.letter == 's');
    }
    if (overflow(m, self, dest, r, w, z))
        store(m, dest, r, self->scope);
}

static struct machine_value *part(struct machine *m, enum paris_complex_part_op op,
                                  struct paris_cvalue z, struct machine_type type, bool narrow)
{
    switch (op) {
    case PARIS_C_REAL:
        return z.re;
    case PARIS_C_IMAG:
        return z.im;
    case PARIS_C_ABS:
        return machine_to_float(m, paris_complex_abs(doubles(m, z), narrow), type, false);
    case PARIS_C_PHASE:
        return machine_to_float(m, paris_complex_phase(doubles(m, z)), type, false);
    }
    abort(); /* the table of instructions has no other */
}

void paris_complex_to_float(const struct paris_instruction *self, struct paris_operand dest,
                            struct paris_complex a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_type(dest, "dest", &type) || !paris_check_operand(dest, "dest"))
        return;
    /* dest may be either part of the source */
    if (dest.field != a.re.field && dest.field != a.im.field &&
        !paris_check_overlap(dest, paris_b(a.re.field, 2 * paris_operand_bits(a.re))))
        return;
    struct paris_cvalue z = load(m, a, "source", self->scope);
    if (!good(z))
        return;
    struct machine_value *r =
        part(m, (enum paris_complex_part_op)self->op, z, type, is_narrow(a.re));
    if (self->overflow) {
        struct paris_cvalue both = {r, r};
        if (!r || !overflow(m, self, (struct paris_complex){dest, dest}, both, nothing, z))
            return;
    }
    paris_store(m, dest, r, self->scope);
}

void paris_complex_of_angle(const struct paris_instruction *self, struct paris_complex dest,
                            struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!type_of(dest, "dest", &type) || !check(dest, "dest"))
        return;
    if (a.field != dest.re.field && a.field != dest.im.field &&
        !paris_check_overlap(paris_b(dest.re.field, 2 * paris_operand_bits(dest.re)), a))
        return;
    struct machine_value *x = paris_load(m, a, "source", self->scope);
    if (x)
        store(m, dest, paris_complex_cis(machine_to_float(m, x, MACHINE_F64, false)),
              self->scope);
}

/* ---- the front end's side ---- */

void paris_complex_write(const struct paris_instruction *self, CM_sendaddr_t send_address,
                         struct paris_complex dest, struct paris_complex value)
{
    paris_begin(self->name);
    if (!check(dest, "dest"))
        return;
    paris_processor_write(self, send_address, dest.re, value.re);
    paris_processor_write(self, send_address, dest.im, value.im);
}

CM_complex_t paris_complex_read(const struct paris_instruction *self,
                                CM_sendaddr_t send_address, struct paris_complex source)
{
    CM_complex_t r = {0, 0};
    paris_begin(self->name);
    if (!check(source, "source"))
        return r;
    r.real = paris_processor_read_f(self, send_address, source.re);
    r.imag = paris_processor_read_f(self, send_address, source.im);
    return r;
}

CM_complex_t paris_complex_global_add(const struct paris_instruction *self,
                                      struct paris_complex source)
{
    CM_complex_t r = {0, 0};
    paris_begin(self->name);
    if (!check(source, "source"))
        return r;
    r.real = paris_global_f(self, source.re);
    r.imag = paris_global_f(self, source.im);
    return r;
}

/* The array's elements are pairs. */
void paris_complex_array_write(const struct paris_instruction *self, const void *array,
                               struct paris_block block, struct paris_complex dest)
{
    paris_begin(self->name);
    if (!check(dest, "dest"))
        return;
    block.pairs = true;
    paris_array_write(self, array, block, dest.re);
    block.second = true;
    paris_array_write(self, array, block, dest.im);
}

void paris_complex_array_read(const struct paris_instruction *self, void *array,
                              struct paris_block block, struct paris_complex source)
{
    paris_begin(self->name);
    if (!check(source, "source"))
        return;
    block.pairs = true;
    paris_array_read(self, array, block, source.re);
    block.second = true;
    paris_array_read(self, array, block, source.im);
}
