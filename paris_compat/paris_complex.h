/* paris_complex.h - complex numbers: a float for the real part and, after it in memory, one for
 * the imaginary part, both of the lengths s, e. Included by paris_state.h. */
#ifndef PARIS_COMPLEX_H
#define PARIS_COMPLEX_H

struct paris_complex {
    struct paris_operand re, im;
};

static inline struct paris_complex paris_c(CM_field_id_t field, unsigned int s, unsigned int e)
{
    return (struct paris_complex){paris_f(field, s, e), paris_f(field + s + e + 1, s, e)};
}

static inline struct paris_complex paris_c_constant(double real, double imag, unsigned int s,
                                                    unsigned int e)
{
    return (struct paris_complex){paris_f_constant(real, s, e), paris_f_constant(imag, s, e)};
}

/* The operations of instructions on complex numbers, for each function that performs some. */
enum paris_complex_binary_op {
    PARIS_C_ADD,
    PARIS_C_SUBTRACT,
    PARIS_C_MULTIPLY,
    PARIS_C_DIVIDE,
    PARIS_C_POWER
};
enum paris_complex_compare_op { PARIS_C_EQ, PARIS_C_NE };
enum paris_complex_move_op { PARIS_C_MOVE };
/* paris_complex_unary() performs these two itself, and asks paris_complex_function() for the
 * others. */
enum paris_complex_sign_op { PARIS_C_NEGATE, PARIS_C_CONJUGATE, PARIS_C_SIGN_OPS };
enum paris_complex_function_op {
    PARIS_C_RECIPROCAL = PARIS_C_SIGN_OPS,
    PARIS_C_SIGNUM,
    PARIS_C_SQRT,
    PARIS_C_EXP,
    PARIS_C_LN,
    PARIS_C_SIN,
    PARIS_C_COS,
    PARIS_C_TAN,
    PARIS_C_ASIN,
    PARIS_C_ACOS,
    PARIS_C_ATAN,
    PARIS_C_SINH,
    PARIS_C_COSH,
    PARIS_C_TANH,
    PARIS_C_ASINH,
    PARIS_C_ACOSH,
    PARIS_C_ATANH
};
enum paris_complex_part_op { PARIS_C_ABS, PARIS_C_PHASE, PARIS_C_REAL, PARIS_C_IMAG };

/* ---- complex_functions.c: of values ---- */

struct paris_cvalue {
    struct machine_value *re, *im; /* if either is NULL, there was an error, which the
                                    * machine has recorded */
};
/* On doubles; narrow: exponents have 9 bits at most, so that no square overflows. */
struct paris_cvalue paris_complex_function(enum paris_complex_function_op op,
                                           struct paris_cvalue z, bool narrow);
/* The absolute value, and the angle (phase), of a complex number. */
struct machine_value *paris_complex_abs(struct paris_cvalue z, bool narrow);
struct machine_value *paris_complex_phase(struct paris_cvalue z);
struct paris_cvalue paris_complex_divide(struct paris_cvalue a, struct paris_cvalue b);
struct paris_cvalue paris_complex_power(struct paris_cvalue z, struct paris_cvalue w);
/* y: a double; n: integers. */
struct paris_cvalue paris_complex_power_real(struct paris_cvalue z, struct machine_value *y);
struct paris_cvalue paris_complex_power_whole(struct paris_cvalue z, struct machine_value *n,
                                              bool is_signed);
/* In the operands' type. */
struct paris_cvalue paris_complex_multiply(struct paris_cvalue a, struct paris_cvalue b);
/* cos and sin of x, a double. */
struct paris_cvalue paris_complex_cis(struct machine_value *x);

/* ---- complex.c: the families ---- */

void paris_complex_binary(const struct paris_instruction *self, struct paris_complex dest,
                          struct paris_complex a, struct paris_complex b);
void paris_complex_unary(const struct paris_instruction *self, struct paris_complex dest,
                         struct paris_complex a);
void paris_complex_compare(const struct paris_instruction *self, struct paris_complex a,
                           struct paris_complex b);
void paris_complex_move(const struct paris_instruction *self, struct paris_complex dest,
                        struct paris_complex a);
/* dest = a ^ b with b float, signed or unsigned. */
void paris_complex_raise(const struct paris_instruction *self, struct paris_complex dest,
                         struct paris_complex a, struct paris_operand b);
void paris_complex_to_float(const struct paris_instruction *self, struct paris_operand dest,
                            struct paris_complex a);
void paris_complex_of_angle(const struct paris_instruction *self, struct paris_complex dest,
                            struct paris_operand a);
void paris_complex_write(const struct paris_instruction *self, CM_sendaddr_t send_address,
                         struct paris_complex dest, struct paris_complex value);
CM_complex_t paris_complex_read(const struct paris_instruction *self,
                                CM_sendaddr_t send_address, struct paris_complex source);
CM_complex_t paris_complex_global_add(const struct paris_instruction *self,
                                      struct paris_complex source);
void paris_complex_array_write(const struct paris_instruction *self, const void *array,
                               struct paris_block block, struct paris_complex dest);
void paris_complex_array_read(const struct paris_instruction *self, void *array,
                              struct paris_block block, struct paris_complex source);

#endif
