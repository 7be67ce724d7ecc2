/* Reading and writing one processor, and reductions: numbers that go between the machine and
 * the front end. */
#include <string.h>

#include "paris_state.h"

static double float_of(struct machine_type type, struct machine_scalar bits)
{
    float single;
    double number;
    uint32_t low = (uint32_t)bits.lo;
    if (type.width == 32) {
        memcpy(&single, &low, sizeof single);
        return single;
    }
    memcpy(&number, &bits.lo, sizeof number);
    return number;
}

static long sign_extend(uint64_t bits, unsigned int len)
{
    unsigned int unused = len < 64 ? 64 - len : 0;
    return (long)(bits << unused) >> unused;
}

/* Programs of 1990 keep results in 32 bits. */
static bool result_fits(const struct paris_instruction *self, bool fits)
{
    if (!paris_the.safety || strstr(self->name, "_long") || fits)
        return true;
    paris_fail("the result does not fit in 32 bits: use the _long_1L form");
    return false;
}

/* ---- one processor ---- */

/* The processor's place depends on the field's own VP set. */
static bool processor_index(struct machine *m, CM_sendaddr_t send_address,
                            struct paris_operand field, const char *role,
                            struct machine_type *type, uint64_t *index)
{
    if (!paris_type(field, role, type) ||
        (paris_the.safety && !paris_check_operand(field, role)))
        return false;
    paris_runs_over(field.field, paris_operand_bits(field), role);
    int set = machine_field_vpset(m, field.field);
    if (!set) {
        paris_fail("%s: %u is not a field: it was never allocated, has been deallocated, or an "
                   "offset led out of it",
                   role, field.field);
        return false;
    }
    const struct paris_geometry *g = &paris_the.geometries[paris_the.set_geometry[set] - 1];
    *index = paris_index_let_pass(g, send_address);
    if (*index == UINT64_MAX) {
        paris_fail("send_address: there is no processor %u in this VP set of %llu",
                   send_address, (unsigned long long)g->count);
        return false;
    }
    return true;
}

void paris_processor_write(const struct paris_instruction *self, CM_sendaddr_t send_address,
                           struct paris_operand dest, struct paris_operand value)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    uint64_t index;
    if (!processor_index(m, send_address, dest, "dest", &type, &index) ||
        !paris_check_operand(value, "value"))
        return;
    struct machine_scalar bits = value.letter == 'f'
                                     ? machine_float_bits(type, value.value.number)
                                     : paris_constant_bits(value);
    if (machine_field_write(m, dest.field, type, index, bits) != MACHINE_OK)
        paris_fail_machine();
}

static struct machine_scalar processor_read(const struct paris_instruction *self,
                                            CM_sendaddr_t send_address,
                                            struct paris_operand source,
                                            struct machine_type *type)
{
    struct machine *m = paris_begin(self->name);
    struct machine_scalar bits = {0, 0};
    uint64_t index;
    if (processor_index(m, send_address, source, "source", type, &index) &&
        machine_field_read(m, source.field, *type, index, &bits) != MACHINE_OK)
        paris_fail_machine();
    return bits;
}

unsigned long paris_processor_read_u(const struct paris_instruction *self,
                                     CM_sendaddr_t send_address, struct paris_operand source)
{
    struct machine_type type;
    uint64_t bits = processor_read(self, send_address, source, &type).lo;
    return result_fits(self, bits <= UINT32_MAX) ? bits : 0;
}

long paris_processor_read_s(const struct paris_instruction *self, CM_sendaddr_t send_address,
                            struct paris_operand source)
{
    struct machine_type type;
    long number = sign_extend(processor_read(self, send_address, source, &type).lo, source.len);
    return result_fits(self, number >= INT32_MIN && number <= INT32_MAX) ? number : 0;
}

double paris_processor_read_f(const struct paris_instruction *self, CM_sendaddr_t send_address,
                              struct paris_operand source)
{
    struct machine_type type = MACHINE_F64;
    struct machine_scalar bits = processor_read(self, send_address, source, &type);
    return float_of(type, bits);
}

/* ---- reductions ---- */

/* The sum of integers is not truncated to their length: the sum of 8-bit pixels has 64 bits. */
static bool reduce(const struct paris_instruction *self, struct paris_operand source,
                   struct machine_type *type, struct machine_scalar *out)
{
    struct machine *m = paris_begin(self->name);
    out->lo = out->hi = 0;
    struct machine_value *v = paris_load(m, source, "source", MACHINE_WHERE_ACTIVE);
    if (!v)
        return false;
    if (self->op == MACHINE_REDUCE_ADD && source.len < 64)
        v = machine_resize(m, v, 64, source.letter == 's');
    if (!v || machine_reduce(m, self->op, v, out) != MACHINE_OK) {
        paris_fail_machine();
        return false;
    }
    *type = machine_value_type(v);
    return true;
}

unsigned long paris_global_u(const struct paris_instruction *self, struct paris_operand source)
{
    struct machine_type type;
    struct machine_scalar out;
    return reduce(self, source, &type, &out) && result_fits(self, out.lo <= UINT32_MAX) ? out.lo
                                                                                        : 0;
}

unsigned long paris_global_b(const struct paris_instruction *self, struct paris_operand source)
{
    return paris_global_u(self, source);
}

long paris_global_s(const struct paris_instruction *self, struct paris_operand source)
{
    struct machine_type type;
    struct machine_scalar out;
    if (!reduce(self, source, &type, &out))
        return 0;
    long number = sign_extend(out.lo, type.width);
    return result_fits(self, number >= INT32_MIN && number <= INT32_MAX) ? number : 0;
}

double paris_global_f(const struct paris_instruction *self, struct paris_operand source)
{
    struct machine_type type;
    struct machine_scalar out;
    return reduce(self, source, &type, &out) ? float_of(type, out) : 0;
}

/* ---- counting bits ---- */

/* The number of active processors with a 1 in v. */
static uint64_t count_ones(struct machine *m, struct machine_value *v)
{
    struct machine_scalar out = {0, 0};
    struct machine_value *wide = v ? machine_resize(m, v, 64, false) : NULL;
    if (!wide || machine_reduce(m, MACHINE_REDUCE_ADD, wide, &out) != MACHINE_OK)
        paris_fail_machine();
    return out.lo;
}

static uint64_t count_active(struct machine *m)
{
    return count_ones(m, machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE));
}

static uint64_t count_flag(struct machine *m, enum machine_flag flag)
{
    return flag == MACHINE_CONTEXT
               ? count_active(m)
               : count_ones(m, machine_flag_value(m, flag, MACHINE_WHERE_ACTIVE));
}

unsigned int paris_global_count(const struct paris_instruction *self, enum machine_flag flag)
{
    return (unsigned int)count_flag(paris_begin(self->name), flag);
}

int paris_global_any(const struct paris_instruction *self, enum machine_flag flag)
{
    return count_flag(paris_begin(self->name), flag) > 0;
}

int paris_global_all(const struct paris_instruction *self, enum machine_flag flag)
{
    struct machine *m = paris_begin(self->name);
    uint64_t among =
        flag == MACHINE_CONTEXT ? paris_geometry_current()->count : count_active(m);
    return count_flag(m, flag) == among;
}

static uint64_t count_bit(const char *name, CM_field_id_t source, uint64_t *among)
{
    struct machine *m = paris_begin(name);
    struct machine_value *v = paris_load_bit(m, source, "source", MACHINE_WHERE_ACTIVE);
    if (!v)
        return 0;
    uint64_t count = count_ones(m, v);
    if (among)
        *among = count_active(m);
    return count;
}

/* The machine reduces over active processors, so the context is set temporarily. */
static uint64_t count_bit_always(const char *name, CM_field_id_t source)
{
    struct machine *m = paris_begin(name);
    struct machine_value *v = paris_load_bit(m, source, "source", MACHINE_EVERYWHERE);
    struct machine_value *context = machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE);
    struct machine_value *all = machine_constant(m, MACHINE_BIT, (struct machine_scalar){1, 0});
    if (!v || !paris_flag_put(m, MACHINE_CONTEXT, all, MACHINE_EVERYWHERE))
        return 0;
    uint64_t count = count_ones(m, v);
    paris_flag_put(m, MACHINE_CONTEXT, context, MACHINE_EVERYWHERE);
    return count;
}

unsigned int CM_global_count_bit(CM_field_id_t source)
{
    return (unsigned int)count_bit("CM_global_count_bit", source, NULL);
}

unsigned int CM_global_count_bit_always(CM_field_id_t source)
{
    return (unsigned int)count_bit_always("CM_global_count_bit_always", source);
}

int CM_global_logior_bit(CM_field_id_t source)
{
    return count_bit("CM_global_logior_bit", source, NULL) > 0;
}

int CM_global_logior_bit_always(CM_field_id_t source)
{
    return count_bit_always("CM_global_logior_bit_always", source) > 0;
}

int CM_global_logand_bit(CM_field_id_t source)
{
    uint64_t among = 0;
    return count_bit("CM_global_logand_bit", source, &among) == among;
}

int CM_global_logand_bit_always(CM_field_id_t source)
{
    return count_bit_always("CM_global_logand_bit_always", source) ==
           paris_geometry_current()->count;
}
