/* Random numbers. */
#include "paris_state.h"

void CM_initialize_random_generator(unsigned int seed)
{
    machine_random_seed(paris_begin("CM_initialize_random_generator"), seed);
}

static void random_bits(const char *name, CM_field_id_t dest, unsigned int len,
                        unsigned long limit)
{
    struct machine *m = paris_begin(name);
    struct machine_type type;
    if (!paris_type(paris_u(dest, len), "dest", &type))
        return;
    if (len < 64 && limit > 1ul << len) {
        if (paris_the.safety) {
            paris_fail("limit: %lu is more than 2^%u: numbers of %u bits do not reach it",
                       limit, len, len);
            return;
        }
        limit = 0;
    }
    paris_store(m, paris_u(dest, len), machine_random(m, (int)len, limit),
                MACHINE_WHERE_ACTIVE);
}

void CM_u_random_1L(CM_field_id_t dest, unsigned int len, unsigned long limit)
{
    random_bits("CM_u_random_1L", dest, len, limit);
}

void CM_u_random(CM_field_id_t dest, unsigned int len, unsigned long limit)
{
    random_bits("CM_u_random", dest, len, limit);
}

/* A multiple of 2^-(s + 1) below 1: each is a float of the format. */
static void random_float(const char *name, CM_field_id_t dest, unsigned int s, unsigned int e)
{
    struct machine *m = paris_begin(name);
    struct machine_type type;
    if (!paris_type(paris_f(dest, s, e), "dest", &type))
        return;
    /* other formats by way of double, exactly; with an exponent of 2 bits the least float is
     * 2^-s */
    unsigned int bits = e == 2 ? s : s + 1;
    struct machine_type in = type.s ? MACHINE_F64 : type;
    struct machine_value *whole = machine_random(m, (int)bits, 0);
    struct machine_value *x = whole ? machine_to_float(m, whole, in, false) : NULL;
    struct machine_value *unit = machine_constant_float(m, in, 1.0 / (double)(1ull << bits));
    x = x && unit ? machine_binary(m, MACHINE_FMUL, x, unit) : NULL;
    paris_store(m, paris_f(dest, s, e), machine_to_float(m, x, type, false),
                MACHINE_WHERE_ACTIVE);
}

void CM_f_random_1L(CM_field_id_t dest, unsigned int s, unsigned int e)
{
    random_float("CM_f_random_1L", dest, s, e);
}

void CM_f_random(CM_field_id_t dest, unsigned int s, unsigned int e)
{
    random_float("CM_f_random", dest, s, e);
}
