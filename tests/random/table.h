/* table.h - the instructions that random programs are made of: one row each.
 *
 *     X(name, shape, number, op, always)
 *
 * name    the C/Paris call
 * shape   its arguments: how it is called (paris_executor.c), printed (print.c), drawn (generate.c)
 * number  U unsigned, S signed, F float, B bits
 * op      what it computes (oracle_number.c)
 * always  1: ignores the context
 *
 * A new row is the whole change, if the shape and the op are there.
 */
#ifndef LUTETIA_TESTS_RANDOM_TABLE_H
#define LUTETIA_TESTS_RANDOM_TABLE_H

#define RANDOM_INTEGER_ROWS(X, t, N)                                                           \
    X(CM_##t##_add_2_1L, INT_2, N, ADD, 0)                                                     \
    X(CM_##t##_add_3_1L, INT_3, N, ADD, 0)                                                     \
    X(CM_##t##_add_3_3L, INT_3_3L, N, ADD, 0)                                                  \
    X(CM_##t##_add_constant_2_1L, INT_CONSTANT_2, N, ADD, 0)                                   \
    X(CM_##t##_add_constant_3_1L, INT_CONSTANT_3, N, ADD, 0)                                   \
    X(CM_##t##_subtract_2_1L, INT_2, N, SUBTRACT, 0)                                           \
    X(CM_##t##_subtract_3_1L, INT_3, N, SUBTRACT, 0)                                           \
    X(CM_##t##_subtract_3_3L, INT_3_3L, N, SUBTRACT, 0)                                        \
    X(CM_##t##_subtract_constant_2_1L, INT_CONSTANT_2, N, SUBTRACT, 0)                         \
    X(CM_##t##_multiply_2_1L, INT_2, N, MULTIPLY, 0)                                           \
    X(CM_##t##_multiply_3_1L, INT_3, N, MULTIPLY, 0)                                           \
    X(CM_##t##_multiply_constant_3_1L, INT_CONSTANT_3, N, MULTIPLY, 0)                         \
    X(CM_##t##_min_2_1L, INT_2, N, MIN, 0)                                                     \
    X(CM_##t##_min_3_1L, INT_3, N, MIN, 0)                                                     \
    X(CM_##t##_max_2_1L, INT_2, N, MAX, 0)                                                     \
    X(CM_##t##_max_constant_2_1L, INT_CONSTANT_2, N, MAX, 0)                                   \
    X(CM_##t##_move_1L, INT_MOVE, N, MOVE, 0)                                                  \
    X(CM_##t##_move_always_1L, INT_MOVE, N, MOVE, 1)                                           \
    X(CM_##t##_move_2L, INT_MOVE_2L, N, MOVE, 0)                                               \
    X(CM_##t##_move_constant_1L, INT_MOVE_CONSTANT, N, MOVE, 0)                                \
    X(CM_##t##_move_zero_1L, INT_1, N, ZERO, 0)                                                \
    X(CM_##t##_move_zero_always_1L, INT_1, N, ZERO, 1)                                         \
    X(CM_##t##_eq_1L, INT_COMPARE, N, EQ, 0)                                                   \
    X(CM_##t##_ne_1L, INT_COMPARE, N, NE, 0)                                                   \
    X(CM_##t##_lt_1L, INT_COMPARE, N, LT, 0)                                                   \
    X(CM_##t##_le_1L, INT_COMPARE, N, LE, 0)                                                   \
    X(CM_##t##_gt_1L, INT_COMPARE, N, GT, 0)                                                   \
    X(CM_##t##_ge_1L, INT_COMPARE, N, GE, 0)                                                   \
    X(CM_##t##_lt_2L, INT_COMPARE_2L, N, LT, 0)                                                \
    X(CM_##t##_eq_2L, INT_COMPARE_2L, N, EQ, 0)                                                \
    X(CM_##t##_lt_constant_1L, INT_COMPARE_CONSTANT, N, LT, 0)                                 \
    X(CM_##t##_gt_constant_1L, INT_COMPARE_CONSTANT, N, GT, 0)                                 \
    X(CM_##t##_eq_constant_1L, INT_COMPARE_CONSTANT, N, EQ, 0)                                 \
    X(CM_##t##_eq_zero_1L, INT_COMPARE_ZERO, N, EQ, 0)                                         \
    X(CM_##t##_gt_zero_1L, INT_COMPARE_ZERO, N, GT, 0)                                         \
    X(CM_##t##_lt_zero_1L, INT_COMPARE_ZERO, N, LT, 0)                                         \
    X(CM_##t##_truncate_2_1L, INT_2, N, TRUNCATE, 0)                                           \
    X(CM_##t##_truncate_3_3L, INT_3_3L, N, TRUNCATE, 0)                                        \
    X(CM_##t##_mod_3_1L, INT_3, N, MOD, 0)                                                     \
    X(CM_##t##_mod_constant_2_1L, INT_CONSTANT_2, N, MOD, 0)                                   \
    X(CM_f_##t##_float_2_2L, INT_TO_FLOAT, N, CONVERT, 0)                                      \
    X(CM_##t##_f_truncate_2_2L, FLOAT_TO_INT, N, TRUNCATE, 0)                                  \
    X(CM_##t##_f_floor_2_2L, FLOAT_TO_INT, N, FLOOR, 0)                                        \
    X(CM_##t##_f_ceiling_2_2L, FLOAT_TO_INT, N, CEILING, 0)                                    \
    X(CM_##t##_f_round_2_2L, FLOAT_TO_INT, N, ROUND, 0)                                        \
    X(CM_global_##t##_add_1L, INT_GLOBAL, N, ADD, 0)                                           \
    X(CM_global_##t##_min_1L, INT_GLOBAL, N, MIN, 0)                                           \
    X(CM_global_##t##_max_1L, INT_GLOBAL, N, MAX, 0)

#define RANDOM_ROWS(X)                                                                         \
    /* first, because the generator tells these rows from the others by their numbers */       \
    X(CM_allocate_stack_field, ALLOCATE, B, STACK, 1)                                          \
    X(CM_allocate_heap_field, ALLOCATE, B, HEAP, 1)                                            \
    X(CM_deallocate_stack_through, DEALLOCATE, B, STACK, 1)                                    \
    X(CM_deallocate_heap_field, DEALLOCATE, B, HEAP, 1)                                        \
    X(CM_set_vp_set, SELECT_SET, B, NONE, 1)                                                   \
    X(CM_u_read_from_news_array_1L, OBSERVE, U, NONE, 1)                                       \
    X(CM_u_write_to_news_array_1L, WRITE_ARRAY, U, NONE, 1)                                    \
    X(CM_f_write_to_news_array_1L, WRITE_FLOATS, F, NONE, 1)                                   \
    X(CM_u_write_to_processor_1L, WRITE_PROCESSOR, U, NONE, 1)                                 \
    X(CM_u_read_from_processor_1L, READ_PROCESSOR, U, NONE, 1)                                 \
    X(CM_f_write_to_processor_1L, WRITE_PROCESSOR_FLOAT, F, NONE, 1)                           \
    X(CM_u_random_1L, RANDOM, U, NONE, 0)                                                      \
    RANDOM_INTEGER_ROWS(X, u, U)                                                               \
    RANDOM_INTEGER_ROWS(X, s, S)                                                               \
    X(CM_s_negate_1_1L, INT_1, S, NEGATE, 0)                                                   \
    X(CM_s_negate_2_1L, INT_MOVE, S, NEGATE, 0)                                                \
    X(CM_s_s_shift_2_1L, INT_2, S, SHIFT, 0)                                                   \
    X(CM_s_abs_2_1L, INT_MOVE, S, ABS, 0)                                                      \
    X(CM_logand_2_1L, INT_2, B, AND, 0)                                                        \
    X(CM_logand_3_1L, INT_3, B, AND, 0)                                                        \
    X(CM_logior_2_1L, INT_2, B, IOR, 0)                                                        \
    X(CM_logior_3_1L, INT_3, B, IOR, 0)                                                        \
    X(CM_logxor_2_1L, INT_2, B, XOR, 0)                                                        \
    X(CM_logxor_3_1L, INT_3, B, XOR, 0)                                                        \
    X(CM_lognot_1_1L, INT_1, B, NOT, 0)                                                        \
    X(CM_lognot_2_1L, INT_MOVE, B, NOT, 0)                                                     \
    X(CM_global_logand_1L, INT_GLOBAL, B, AND, 0)                                              \
    X(CM_global_logior_1L, INT_GLOBAL, B, IOR, 0)                                              \
    X(CM_global_logxor_1L, INT_GLOBAL, B, XOR, 0)                                              \
    /* floats */                                                                               \
    X(CM_f_add_2_1L, FLOAT_2, F, ADD, 0)                                                       \
    X(CM_f_add_3_1L, FLOAT_3, F, ADD, 0)                                                       \
    X(CM_f_add_constant_2_1L, FLOAT_CONSTANT_2, F, ADD, 0)                                     \
    X(CM_f_add_constant_3_1L, FLOAT_CONSTANT_3, F, ADD, 0)                                     \
    X(CM_f_subtract_2_1L, FLOAT_2, F, SUBTRACT, 0)                                             \
    X(CM_f_subtract_3_1L, FLOAT_3, F, SUBTRACT, 0)                                             \
    X(CM_f_subtract_constant_2_1L, FLOAT_CONSTANT_2, F, SUBTRACT, 0)                           \
    X(CM_f_multiply_2_1L, FLOAT_2, F, MULTIPLY, 0)                                             \
    X(CM_f_multiply_3_1L, FLOAT_3, F, MULTIPLY, 0)                                             \
    X(CM_f_multiply_constant_2_1L, FLOAT_CONSTANT_2, F, MULTIPLY, 0)                           \
    X(CM_f_multiply_constant_3_1L, FLOAT_CONSTANT_3, F, MULTIPLY, 0)                           \
    X(CM_f_divide_2_1L, FLOAT_2, F, DIVIDE, 0)                                                 \
    X(CM_f_divide_3_1L, FLOAT_3, F, DIVIDE, 0)                                                 \
    X(CM_f_divide_constant_2_1L, FLOAT_CONSTANT_2, F, DIVIDE, 0)                               \
    X(CM_f_min_2_1L, FLOAT_2, F, MIN, 0)                                                       \
    X(CM_f_min_3_1L, FLOAT_3, F, MIN, 0)                                                       \
    X(CM_f_max_2_1L, FLOAT_2, F, MAX, 0)                                                       \
    X(CM_f_min_constant_2_1L, FLOAT_CONSTANT_2, F, MIN, 0)                                     \
    X(CM_f_max_constant_2_1L, FLOAT_CONSTANT_2, F, MAX, 0)                                     \
    X(CM_f_negate_1_1L, FLOAT_1, F, NEGATE, 0)                                                 \
    X(CM_f_negate_2_1L, FLOAT_MOVE, F, NEGATE, 0)                                              \
    X(CM_f_abs_1_1L, FLOAT_1, F, ABS, 0)                                                       \
    X(CM_f_abs_2_1L, FLOAT_MOVE, F, ABS, 0)                                                    \
    X(CM_f_sqrt_1_1L, FLOAT_1, F, SQRT, 0)                                                     \
    X(CM_f_sqrt_2_1L, FLOAT_MOVE, F, SQRT, 0)                                                  \
    X(CM_f_move_1L, FLOAT_MOVE, F, MOVE, 0)                                                    \
    X(CM_f_move_always_1L, FLOAT_MOVE, F, MOVE, 1)                                             \
    X(CM_f_move_2L, FLOAT_MOVE_2L, F, MOVE, 0)                                                 \
    X(CM_f_move_constant_1L, FLOAT_MOVE_CONSTANT, F, MOVE, 0)                                  \
    X(CM_f_move_zero_1L, FLOAT_1, F, ZERO, 0)                                                  \
    X(CM_f_eq_1L, FLOAT_COMPARE, F, EQ, 0)                                                     \
    X(CM_f_ne_1L, FLOAT_COMPARE, F, NE, 0)                                                     \
    X(CM_f_lt_1L, FLOAT_COMPARE, F, LT, 0)                                                     \
    X(CM_f_le_1L, FLOAT_COMPARE, F, LE, 0)                                                     \
    X(CM_f_gt_1L, FLOAT_COMPARE, F, GT, 0)                                                     \
    X(CM_f_ge_1L, FLOAT_COMPARE, F, GE, 0)                                                     \
    X(CM_f_lt_constant_1L, FLOAT_COMPARE_CONSTANT, F, LT, 0)                                   \
    X(CM_f_ge_constant_1L, FLOAT_COMPARE_CONSTANT, F, GE, 0)                                   \
    X(CM_f_eq_zero_1L, FLOAT_COMPARE_ZERO, F, EQ, 0)                                           \
    X(CM_f_gt_zero_1L, FLOAT_COMPARE_ZERO, F, GT, 0)                                           \
    X(CM_f_lt_zero_1L, FLOAT_COMPARE_ZERO, F, LT, 0)                                           \
    X(CM_global_f_add_1L, FLOAT_GLOBAL, F, ADD, 0)                                             \
    X(CM_global_f_min_1L, FLOAT_GLOBAL, F, MIN, 0)                                             \
    X(CM_global_f_max_1L, FLOAT_GLOBAL, F, MAX, 0)                                             \
    /* flags; the field of a BIT_ row is a store's destination, or a load's source */          \
    X(CM_set_context, FLAG, B, SET_CONTEXT, 1)                                                 \
    X(CM_clear_context, FLAG, B, CLEAR_CONTEXT, 1)                                             \
    X(CM_invert_context, FLAG, B, INVERT_CONTEXT, 1)                                           \
    X(CM_logand_context_with_test, FLAG, B, AND_CONTEXT_TEST, 1)                               \
    X(CM_load_context, BIT_LOAD, B, LOAD_CONTEXT, 1)                                           \
    X(CM_store_context, BIT_STORE, B, STORE_CONTEXT, 1)                                        \
    X(CM_logand_context, BIT_LOAD, B, AND_CONTEXT, 1)                                          \
    X(CM_load_test, BIT_LOAD, B, LOAD_TEST, 0)                                                 \
    X(CM_store_test, BIT_STORE, B, STORE_TEST, 0)                                              \
    X(CM_store_test_always, BIT_STORE, B, STORE_TEST, 1)                                       \
    X(CM_load_overflow, BIT_LOAD, B, LOAD_OVERFLOW, 0)                                         \
    X(CM_store_overflow, BIT_STORE, B, STORE_OVERFLOW, 0)                                      \
    X(CM_store_overflow_always, BIT_STORE, B, STORE_OVERFLOW, 1)                               \
    X(CM_set_bit, BIT_STORE, B, SET_BIT, 0)                                                    \
    X(CM_set_bit_always, BIT_STORE, B, SET_BIT, 1)                                             \
    X(CM_clear_bit, BIT_STORE, B, CLEAR_BIT, 0)                                                \
    X(CM_clear_bit_always, BIT_STORE, B, CLEAR_BIT, 1)                                         \
    /* the grid */                                                                             \
    X(CM_get_from_news_1L, NEWS, B, GET_NEWS, 0)                                               \
    X(CM_send_to_news_1L, NEWS, B, SEND_NEWS, 0)                                               \
    X(CM_my_news_coordinate_1L, COORDINATE, U, NONE, 0)

#endif
