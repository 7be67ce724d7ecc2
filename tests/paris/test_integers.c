/* Compares the rows of paris_compat/integers.c and bits.c, and arrays in each processor, with
 * the oracle.
 *
 * Thousands of processors hold pairs of numbers that are special at some width: range ends,
 * powers of two, divisors 0 and -1. Every case takes the low bits of the same two fields. So
 * cases that differ only in their form are one computation, and a kernel does dozens of them.
 * Each row is tested at one set of lengths; some rows at all widths, on VP ratios 1, 2 and 8,
 * whose kernels are the same. Grid rows of 13 processors give kernels of one lane; vectors have
 * a test of their own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "oracle_integers.h"
#include "paris_internal.h"
#include "sample.h"
#include <cm/paris.h>

struct integer_args {
    CM_field_id_t dest, source, source1, source2, count;
    unsigned int len, dlen, slen, slen1, slen2, clen;
    unsigned long value_u;
    long value_s;
};

struct integer_row {
    const char *name, *op;
    char type, type2;
    int operands, lengths, constant, always;
    void (*call)(const struct integer_args *);
};

#include "paris_integer_table.h"

enum {
    ROW_COUNT = sizeof integer_rows / sizeof integer_rows[0],
    COUNT = 157 * 13,
    BATCH = 140
};

/* ---- the machine and its fields ---- */

static int count; /* the number of processors in the current VP set */
static number first[COUNT], second[COUNT];
static number context[COUNT], test[COUNT], overflow[COUNT];
/* [0]: the numbers' low 64 bits, for narrow cases; [1]: all 128 bits. */
static CM_field_id_t first_field[2], second_field[2], context_field, test_field, overflow_field;

static uint64_t state = SAMPLE_SHIFTED_BEGIN;

static uint64_t any(void)
{
    return sample_shifted(&state);
}

static number any_number(void)
{
    number n = (number)any() << 64 | any();
    return n >> any() % 128;
}

static void numbers_fill(void)
{
    for (int i = 0; i < COUNT; i++) {
        number power = (number)1 << i / 8 % 128;
        first[i] = any() % 3 ? any_number() : any() % 2 ? -any_number() : power + any() % 3 - 1;
        second[i] = any() % 3 ? any_number() : any() % 2 ? -any_number() : any() % 7;
        if (i >= 1024)
            continue;
        const number minus_one = ~(number)0,
                     pairs[8][2] = {
                         {power, minus_one}, {power, 0},        {power - 1, minus_one},
                         {-power, 1},        {power, power},    {power + 1, power},
                         {power, 2},         {~any_number(), 3}};
        first[i] = pairs[i % 8][0];
        second[i] = pairs[i % 8][1];
    }
    for (int i = 0; i < COUNT; i++) {
        if (any() % 8 == 0) /* some small ones: counts, exponents */
            second[i] = (number)(any() % 300) - 150;
        context[i] = any() >> 20 & 1;
        test[i] = any() >> 20 & 1;
        overflow[i] = any() >> 20 & 1;
    }
}

static void machine_stop(const char *what)
{
    fail_msg("%s: %s", what, machine_error(paris_machine()));
}

static void put(CM_field_id_t field, int width, const number *numbers)
{
    static unsigned char dense[COUNT * sizeof(number)];
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    for (int i = 0; i < count; i++) {
        number n = numbers[i] & oracle_mask(width);
        memcpy(dense + (size_t)i * bytes, &n, bytes);
    }
    if (machine_field_upload(paris_machine(), field, MACHINE_UINT(width), dense) != MACHINE_OK)
        machine_stop("upload");
}

static void get(CM_field_id_t field, int width, number *numbers)
{
    static unsigned char dense[COUNT * sizeof(number)];
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    if (machine_field_download(paris_machine(), field, MACHINE_UINT(width), dense) !=
        MACHINE_OK)
        machine_stop("download");
    for (int i = 0; i < count; i++) {
        numbers[i] = 0;
        memcpy(&numbers[i], dense + (size_t)i * bytes, bytes);
    }
}

static CM_field_id_t field_with(int width, const number *numbers)
{
    CM_field_id_t field = CM_allocate_heap_field((unsigned int)width);
    put(field, width, numbers);
    return field;
}

static void arrange(int rows, int columns)
{
    int dimensions[2] = {rows, columns};
    count = rows * columns;
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = dimensions}, 2)));
    for (int k = 0; k < 2; k++) {
        first_field[k] = field_with(k ? 128 : 64, first);
        second_field[k] = field_with(k ? 128 : 64, second);
    }
    context_field = field_with(1, context);
    test_field = field_with(1, test);
    overflow_field = field_with(1, overflow);
}

static int start(void **unused)
{
    struct machine_config config = machine_config_default();
    (void)unused;
    config.processors_count = 256;
    if (!paris_reset(&config)) {
        fprintf(stderr, "skipped: %s\n", paris_error());
        exit(77);
    }
    CM_set_safety_mode(0); /* safety mode refuses signed numbers of one bit */
    numbers_fill();
    return 0;
}

/* ---- cases ---- */

struct trial {
    const struct integer_row *row;
    int dlen, alen, blen;
    struct integer_args args;
    CM_field_id_t overflow; /* CM_no_field: nobody looks */
};

static struct trial batch[BATCH];
static int batch_count, failures;
static long cases;

static void report(const struct trial *t, int i, const char *what, number got, number wanted)
{
    if (failures++ > 30)
        return;
    const number all[] = {got, wanted, first[i], second[i]};
    fprintf(stderr, "%s (dest %d, sources %d, %d bits) processor %d: %s", t->row->name, t->dlen,
            t->alen, t->blen, i, what);
    for (int k = 0; k < 4; k++)
        fprintf(stderr, "%s%llx:%016llx",
                k == 0   ? " is "
                : k == 1 ? ", wanted "
                         : " of ",
                (unsigned long long)(all[k] >> 64), (unsigned long long)all[k]);
    fprintf(stderr, ", constant %ld\n", t->args.value_s);
}

static void check(const struct trial *t)
{
    static number dest[COUNT], flag[COUNT];
    bool two = t->row->operands == (t->row->type2 == '-' ? 1 : 2);
    get(t->args.dest, t->dlen, dest);
    if (t->overflow != CM_no_field)
        get(t->overflow, 1, flag);
    for (int i = 0; i < count; i++) {
        bool active = context[i] != 0;
        number old = (two ? first[i] : second[i]) & oracle_mask(t->dlen), b = second[i];
        if (t->row->constant)
            b = t->row->type2 == 's' ? (number)(__int128)t->args.value_s : t->args.value_u;
        struct oracle_result r =
            oracle_integer_row(t->row->op, t->row->type == 's', t->row->type2 == 's', first[i],
                               t->alen, b, t->blen, t->dlen);
        number wanted = active || t->row->always ? r.bits : old;
        bool overflows =
            active && oracle_integer_overflows(t->row->op) ? r.overflow : overflow[i] != 0;
        if (dest[i] != wanted) {
            report(t, i, "dest", dest[i], wanted);
            return;
        }
        if (t->overflow != CM_no_field && flag[i] != overflows) {
            report(t, i, "overflow", flag[i], overflows);
            return;
        }
    }
}

static void batch_finish(void)
{
    static number flag[COUNT];
    if (!batch_count)
        return;
    if (machine_finish(paris_machine()) != MACHINE_OK)
        machine_stop(batch[0].row->name);
    for (int i = 0; i < batch_count; i++)
        check(&batch[i]);
    get(context_field, 1, flag);
    assert_memory_equal(flag, context, (size_t)count * sizeof *flag);
    CM_deallocate_stack_through(batch[0].args.dest);
    batch_count = 0;
}

static bool is_unary(const struct integer_row *row)
{
    return row->type2 == '-';
}

/* constant: any number; the row uses the bits that fit. */
static void trial(const struct integer_row *row, int dlen, int alen, int blen, number constant,
                  bool looks)
{
    struct trial *t = &batch[batch_count++];
    bool shift = strstr(row->op, "shift") != NULL, rotate = strstr(row->op, "rotate") != NULL;
    bool two = row->operands == (is_unary(row) ? 1 : 2);
    bool one_length = row->lengths == 1;
    if (one_length)
        alen = blen = dlen;
    if (two || rotate || (shift && row->lengths == 2 && !row->constant))
        alen = dlen;
    if (row->constant)
        blen = row->type2 == 's' && (shift || rotate) ? 64 : alen;
    *t = (struct trial){.row = row, .dlen = dlen, .alen = alen, .blen = blen};
    int wide = dlen > 64 || alen > 64 || blen > 64;
    struct integer_args *args = &t->args;
    args->dest = CM_allocate_stack_field((unsigned int)dlen);
    t->overflow = looks ? CM_allocate_stack_field(1) : CM_no_field;
    args->source = args->source1 = first_field[wide];
    args->source2 = args->count = second_field[wide];
    if (two) {
        if (!is_unary(row))
            args->source = second_field[wide];
        CM_u_move_always_1L(args->dest, first_field[wide], (unsigned int)dlen);
    } else {
        CM_u_move_always_1L(args->dest, second_field[wide], (unsigned int)dlen);
    }
    args->len = args->dlen = (unsigned int)dlen;
    args->slen = args->slen1 =
        (unsigned int)(two && !row->constant && !is_unary(row) ? blen : alen);
    args->slen2 = args->clen = (unsigned int)blen;
    int clen = dlen < alen ? dlen : alen;
    clen = shift || rotate || clen > 64 ? 64 : clen;
    args->value_u = (unsigned long)(constant & oracle_mask(clen));
    args->value_s = (long)oracle_extend(constant, clen, true);
    CM_load_overflow_always(overflow_field);
    row->call(args);
    if (looks)
        CM_store_overflow_always(t->overflow);
    cases++;
    if (batch_count == BATCH)
        batch_finish();
}

static void finish(void)
{
    batch_finish();
    static number flag[COUNT];
    CM_field_id_t now = CM_allocate_stack_field(1);
    CM_store_test_always(now);
    get(now, 1, flag);
    assert_memory_equal(flag, test, (size_t)count * sizeof *flag);
    CM_deallocate_stack_through(now);
    printf("%ld cases\n", cases);
    cases = 0;
    assert_int_equal(failures, 0);
}

static void begin(void)
{
    failures = 0;
    CM_load_test_always(test_field);
    CM_load_context(context_field);
}

/* ---- tests ---- */

static bool is_number(const struct integer_row *row)
{
    return row->type != 'b';
}

static void every_row_is_the_oracles(void **unused)
{
    static const int lengths[][3] = {{32, 32, 32}, {8, 13, 5},  {16, 7, 20}, {33, 64, 9},
                                     {1, 1, 1},    {24, 32, 3}, {64, 40, 8}, {100, 128, 70}};
    (void)unused;
    arrange(157, 13);
    begin();
    int k = 0;
    const char *last = "";
    number constant = 0;
    for (int r = 0; r < ROW_COUNT; r++) {
        const struct integer_row *row = &integer_rows[r];
        if (!is_number(row))
            continue;
        if (strcmp(row->op, last)) { /* all forms get the same operands */
            k++;
            constant = k % 2 ? second[any() % COUNT] : (number)(any() % 100) - 50;
        }
        last = row->op;
        const int *l = lengths[k % (int)(sizeof lengths / sizeof *lengths)];
        bool is_signed = row->type == 's' || row->type2 == 's';
        trial(row, l[0] + (is_signed && l[0] == 1), l[1] + (is_signed && l[1] == 1),
              l[2] + (is_signed && l[2] == 1), constant, !row->constant || row->lengths == 2);
    }
    finish();
}

static const struct integer_row *row_named(const char *name)
{
    for (int r = 0; r < ROW_COUNT; r++)
        if (strcmp(integer_rows[r].name, name) == 0)
            return &integer_rows[r];
    fail_msg("there is no %s", name);
    return NULL;
}

/* Operations on one number, of one bit: these are made in another way than those of wider
 * numbers. */
static void single_bits_are_the_oracles(void **unused)
{
    (void)unused;
    arrange(157, 13);
    begin();
    for (int r = 0; r < ROW_COUNT; r++) {
        const struct integer_row *row = &integer_rows[r];
        if (is_number(row) && is_unary(row) && row->type == 'u' && !row->always)
            trial(row, row->lengths == 2 ? 3 : 1, 1, 1, 0, true);
    }
    finish();
}

/* Tests every operation's form with all lengths, at several sets of lengths; PARIS_TEST_FULL=1:
 * at hundreds. */
static void lengths_are_the_oracles(void **unused)
{
    static const int lengths[][3] = {{13, 30, 9}, {128, 100, 66}};
    int turns = getenv("PARIS_TEST_FULL") ? 200 : 2;
    (void)unused;
    arrange(157, 13);
    begin();
    for (int turn = 0; turn < turns; turn++)
        for (int r = 0; r < ROW_COUNT; r++) {
            const struct integer_row *row = &integer_rows[r];
            if (!is_number(row) || row->constant || row->always ||
                row->lengths != (is_unary(row) ? 2 : 3))
                continue;
            int l[3];
            for (int k = 0; k < 3; k++)
                l[k] = turns > 2 ? 2 + (int)(any() % (turn % 4 ? 63 : 127)) : lengths[turn][k];
            trial(row, l[0], l[1], l[2], 0, true);
        }
    finish();
}

/* Rows of arithmetic.c at one width; out gets dest and test bits. */
static void common_rows_at(int width, CM_field_id_t out[3])
{
    int wide = width > 64;
    unsigned int len = (unsigned int)width;
    CM_field_id_t a = first_field[wide], b = second_field[wide];
    for (int i = 0; i < 3; i++)
        out[i] = CM_allocate_stack_field(i < 2 ? len : 1);
    CM_u_add_3_1L(out[0], a, b, len);
    CM_s_multiply_3_1L(out[1], a, b, len);
    CM_load_test_always(test_field);
    if (width % 2)
        CM_u_lt_1L(a, b, len);
    else
        CM_s_le_1L(a, b, len);
    CM_store_test_always(out[2]);
}

static void common_rows_check(int width, const CM_field_id_t out[3])
{
    static number got[3][COUNT];
    for (int k = 0; k < 3; k++)
        get(out[k], k < 2 ? width : 1, got[k]);
    for (int i = 0; i < count; i++) {
        number a = first[i], b = second[i], wanted[3] = {0, 0, test[i]};
        if (context[i]) {
            wanted[0] = oracle_integer("add", false, a, width, b, width, width).bits;
            wanted[1] = oracle_integer("multiply", true, a, width, b, width, width).bits;
            wanted[2] = width % 2 ? oracle_integer_compare("lt", false, a, width, b, width)
                                  : oracle_integer_compare("le", true, a, width, b, width);
        }
        for (int k = 0; k < 3; k++)
            if (got[k][i] != wanted[k])
                fail_msg("row %d at %d bits, processor %d", k, width, i);
    }
}

static void common_rows_run(int step)
{
    static CM_field_id_t out[129][3];
    for (int width = 1; width <= 128; width += step)
        common_rows_at(width, out[width]);
    for (int width = 1; width <= 128; width += step)
        common_rows_check(width, out[width]);
}

/* Grid rows of 64 processors give kernels of whole vectors. */
static void vectors_are_the_oracles(void **unused)
{
    static const int lengths[] = {32, 47, 47};
    (void)unused;
    arrange(30, 64);
    begin();
    for (int r = 0, k = 0; r < ROW_COUNT; r++) {
        const struct integer_row *row = &integer_rows[r];
        if (!is_number(row) || row->constant || row->always || row->lengths != 1 ||
            row->operands != (is_unary(row) ? 2 : 3))
            continue;
        int len = lengths[k++ % 3];
        trial(row, len, len, len, 0, k % 2);
    }
    finish();
}

static void widths_run(int step)
{
    static const char *const names[] = {"CM_u_truncate_3_1L", "CM_s_truncate_3_1L",
                                        "CM_u_s_shift_3_1L", "CM_s_s_shift_3_1L"};
    for (int width = 1; width <= 128; width += step)
        for (int i = 0; i < 4; i++)
            if (width <= 32 || (width + i) % 2)
                trial(row_named(names[i]), width, width, width, 0, width % 16 == 1);
    finish();
}

/* Arithmetic, comparisons, divisions and shifts at 1..128, on VP ratios 1, 2 and 8. */
static void all_widths_are_the_oracles(void **unused)
{
    static const int rows[] = {19, 39, 157}, ratios[] = {1, 2, 8};
    (void)unused;
    for (int k = 2; k >= 0; k--) {
        arrange(rows[k], 13);
        assert_int_equal(CM_virtual_to_physical_processor_ratio, ratios[k]);
        begin();
        widths_run(k < 2 ? 9 : 1);
        common_rows_run(k < 2 ? 9 : 1);
    }
}

/* The arguments "widths" and "forms" choose the two halves, which meson can run at the same
 * time. */
int main(int argc, char **argv)
{
    const struct CMUnitTest widths[] = {
        cmocka_unit_test(all_widths_are_the_oracles),
    };
    const struct CMUnitTest forms[] = {
        cmocka_unit_test(every_row_is_the_oracles),
        cmocka_unit_test(single_bits_are_the_oracles),
        cmocka_unit_test(lengths_are_the_oracles),
        cmocka_unit_test(vectors_are_the_oracles),
    };
    if (argc == 2 && strcmp(argv[1], "widths") == 0)
        return cmocka_run_group_tests(widths, start, NULL);
    return cmocka_run_group_tests(forms, start, NULL);
}
