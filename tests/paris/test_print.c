/* test_print.c - fields printed by a program itself: each number that is printed is one that
 * was written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <unistd.h>

#include "paris_internal.h"
#include <cm/paris.h>

enum { ROWS = 3, COLUMNS = 5 };

static char printed[1 << 16];

/* What the calls print. */
static void taken(void (*calls)(CM_field_id_t), CM_field_id_t field)
{
    FILE *into = tmpfile();
    assert_non_null(into);
    fflush(stdout);
    const int before = dup(STDOUT_FILENO);
    assert_true(dup2(fileno(into), STDOUT_FILENO) >= 0);
    calls(field);
    fflush(stdout);
    assert_true(dup2(before, STDOUT_FILENO) >= 0);
    close(before);
    rewind(into);
    printed[fread(printed, 1, sizeof printed - 1, into)] = '\0';
    fclose(into);
}

static void as_unsigned(CM_field_id_t f)
{
    CM_u_print_field_1L(f, 9);
}

static void as_signed(CM_field_id_t f)
{
    CM_s_print_field_1L(f, 9);
}

static void as_float(CM_field_id_t f)
{
    CM_f_print_field_1L(f, 23, 8);
}

static void context(CM_field_id_t f)
{
    (void)f;
    CM_print_context();
}

/* The cells of a row, in words. */
static int cells(int row, char words[8][24])
{
    const char *line = printed;
    for (int i = 0; i <= row; i++)
        line = strchr(line, '\n') + 1;
    line = strchr(line, '|') + 1;
    int count = 0;
    for (int length; sscanf(line, " %23[^ \n]%n", words[count], &length) == 1 && *line != '\n';
         line += length)
        count++;
    return count;
}

static void all_numbers(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    unsigned int sides[2] = {ROWS, COLUMNS};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sides, 2)));
    CM_set_context();
    CM_field_id_t row = CM_allocate_heap_field(9), column = CM_allocate_heap_field(9),
                  real = CM_allocate_heap_field(32);
    CM_my_news_coordinate_1L(row, 0, 9);
    CM_my_news_coordinate_1L(column, 1, 9);
    CM_u_multiply_constant_2_1L(row, 100, 9);
    CM_u_add_2_1L(row, column, 9); /* row * 100 + column: from 256 on negative */
    CM_u_add_constant_2_1L(row, 100, 9);
    CM_f_u_float_2_2L(real, row, 9, 23, 8);
    CM_f_multiply_constant_2_1L(real, 0.25, 23, 8);
    CM_u_gt_constant_1L(column, 1, 9);
    CM_logand_context_with_test();
    char words[8][24], wanted[24];
    for (int kind = 0; kind < 4; kind++) {
        void (*const calls[])(CM_field_id_t) = {as_unsigned, as_signed, as_float, context};
        taken(calls[kind], kind == 2 ? real : row);
        assert_non_null(strstr(printed, "3 x 5"));
        for (int r = 0; r < ROWS; r++) {
            assert_int_equal(cells(r, words), COLUMNS);
            for (int c = 0; c < COLUMNS; c++) {
                const int n = 100 * r + c + 100;
                const double x = kind == 3              ? c > 1
                                 : kind == 1 && n > 255 ? n - 512
                                 : kind == 2            ? n / 4.0
                                                        : n;
                const bool is_in = c > 1 || kind == 3;
                snprintf(wanted, sizeof wanted, "%s%g%s", is_in ? "" : "(", x,
                         is_in ? "" : ")");
                assert_string_equal(words[c], wanted);
            }
        }
    }
}

static char message[1000];

static void told(const char *text)
{
    snprintf(message, sizeof message, "%s", text);
}

static void too_long(CM_field_id_t f)
{
    CM_f_print_field_1L(f, 52, 11);
}

static void wrong_ones_are_refused(void **state)
{
    (void)state;
    assert_true(paris_reset(NULL));
    CM_set_error_handler(told);
    taken(too_long, CM_allocate_heap_field(32));
    assert_string_equal(printed, "");
    assert_non_null(strstr(message, "CM_f_print_field_1L"));
    CM_set_error_handler(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_numbers),
                                       cmocka_unit_test(wrong_ones_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
