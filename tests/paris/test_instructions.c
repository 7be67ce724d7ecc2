/* Compares every instruction of the table on the device with the oracle, over widths, values
 * and context masks.
 *
 * A case is one instruction with its own operands, flags and context. Cases run in batches, so
 * that the machine compiles one kernel for many of them. Each case stores dest, the context,
 * test and overflow in fields of its own, which are compared after the batch. A row is tested
 * at every eighth width, and different rows begin at different widths, so that all rows and all
 * widths occur. PARIS_TEST_FULL=1 tests each row at each width with each mask (an hour of
 * compiling). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

enum paris_test_shape {
    PARIS_TEST_BINARY,
    PARIS_TEST_UNARY,
    PARIS_TEST_COMPARE,
    PARIS_TEST_MOVE,
    PARIS_TEST_CONVERT,
    PARIS_TEST_LOGICAL,
    PARIS_TEST_FLAG,
    PARIS_TEST_NEWS,
    PARIS_TEST_OWN,
    PARIS_TEST_GLOBAL,
    PARIS_TEST_GLOBALFLAG
};

struct paris_test_args {
    CM_field_id_t dest, source, source1, source2;
    unsigned int len, dlen, slen, slen1, slen2, s, e, ds, de, ss, se, axis, direction;
    unsigned long value_u;
    long value_s;
    double value_f;
    uint64_t result_u;
    double result_f;
};

struct paris_test_row {
    const char *name;
    enum paris_test_shape shape;
    char type, source_type;
    const char *op;
    int operands, lengths, constant, zero, always;
    char other; /* the second flag, of an operation on two flags */
    void (*call)(struct paris_test_args *);
};

#include "paris_test_table.h"

enum { ROW_COUNT = sizeof paris_test_rows / sizeof paris_test_rows[0], BATCH = 24 };

static const int widths[] = {1,  2,  3,  7,  8,  13, 16,  24,  31,
                             32, 33, 48, 63, 64, 65, 100, 127, 128};
enum { WIDTHS_COUNT = sizeof widths / sizeof widths[0] };

/* The processors' dest and flags, before or after an instruction. */
struct state {
    number dest[COUNT], context[COUNT], test[COUNT], overflow[COUNT];
};

struct trial {
    const struct paris_test_row *row;
    int dlen, alen, blen;
    struct paris_test_args args;
    struct state before, wanted;
    number a[COUNT], b[COUNT];
    CM_field_id_t first, dest, context, test, overflow; /* the state afterwards */
};

static struct trial batch[BATCH];
static int batch_count;
static int failures;
static long cases_count;

/* ---- what is wanted ---- */

static number constant_of(const struct trial *t, int len)
{
    if (t->row->zero)
        return 0;
    if (t->row->type == 'f')
        return oracle_float_bits(len, t->args.value_f);
    if (t->row->type == 's')
        return (number)(__int128)t->args.value_s & oracle_mask(len);
    return (number)t->args.value_u & oracle_mask(len);
}

static bool is_scalar(const struct trial *t)
{
    return t->row->constant || t->row->zero;
}

/* The neighbour that processor i reads. */
static int neighbour(int i, unsigned int axis, int distance)
{
    int row = i / COLUMNS, column = i % COLUMNS;
    if (axis == 0)
        row = (row + distance + ROWS) % ROWS;
    else
        column = (column + distance + COLUMNS) % COLUMNS;
    return row * COLUMNS + column;
}

static void want_binary(const struct trial *t, int i, struct oracle_result *r)
{
    bool two = t->row->operands == 2, floats = t->row->type == 'f';
    number a = two ? t->before.dest[i] : t->a[i];
    int alen = two ? t->dlen : t->alen;
    int blen = is_scalar(t) ? alen : two ? t->alen : t->blen;
    number b = is_scalar(t) ? constant_of(t, blen) : two ? t->a[i] : t->b[i];
    *r = floats ? oracle_float(t->row->op, t->dlen, a, b)
                : oracle_integer(t->row->op, t->row->type == 's', a, alen, b, blen, t->dlen);
}

static void want_unary(const struct trial *t, int i, struct oracle_result *r)
{
    bool one = t->row->operands == 1;
    number a = one ? t->before.dest[i] : t->a[i];
    *r = t->row->type == 'f' ? oracle_float(t->row->op, t->dlen, a, 0)
                             : oracle_integer(t->row->op, t->row->type == 's', a,
                                              one ? t->dlen : t->alen, 0, 1, t->dlen);
}

static bool want_test(const struct trial *t, int i)
{
    number b = is_scalar(t) ? constant_of(t, t->alen) : t->b[i];
    if (t->row->type == 'f')
        return oracle_float_compare(t->row->op, t->dlen, t->a[i], b);
    return oracle_integer_compare(t->row->op, t->row->type == 's', t->a[i], t->alen, b,
                                  is_scalar(t) ? t->alen : t->blen);
}

static number want_move(const struct trial *t, int i)
{
    number a = is_scalar(t) ? constant_of(t, t->dlen) : t->a[i];
    if (t->row->type == 'f')
        return is_scalar(t) ? a : oracle_float_move(t->dlen, a, t->alen);
    return oracle_extend(a, is_scalar(t) ? t->dlen : t->alen, t->row->type == 's') &
           oracle_mask(t->dlen);
}

static number want_logical(const struct trial *t, int i)
{
    bool complement = strcmp(t->row->op, "lognot") == 0;
    bool in_place = t->row->operands == (complement ? 1 : 2);
    number a = in_place ? t->before.dest[i] : t->a[i];
    number b = is_scalar(t) ? constant_of(t, t->dlen) : in_place ? t->a[i] : t->b[i];
    return oracle_logical(t->row->op, a, b) & oracle_mask(t->dlen);
}

static number *flag_of(struct state *s, char flag)
{
    return flag == 'c' ? s->context : flag == 't' ? s->test : s->overflow;
}

static void want_flag(struct trial *t, int i)
{
    const char *op = t->row->op;
    number *flag = &flag_of(&t->wanted, t->row->type)[i];
    number other = t->row->other == '-' ? t->a[i] & 1 : flag_of(&t->before, t->row->other)[i];
    if (strcmp(op, "store") == 0)
        t->wanted.dest[i] = *flag;
    else if (strcmp(op, "load") == 0)
        *flag = t->a[i] & 1;
    else if (strcmp(op, "set") == 0)
        *flag = 1;
    else if (strcmp(op, "clear") == 0)
        *flag = 0;
    else if (strcmp(op, "invert") == 0)
        *flag ^= 1;
    else
        *flag = oracle_logical(op, *flag, other) & 1;
}

static void want_news(struct trial *t, int i)
{
    bool send = strcmp(t->row->op, "send_to_news") == 0;
    int from = neighbour(i, t->args.axis, (t->args.direction == CM_upward) != send ? 1 : -1);
    bool arrives = t->row->always || t->before.context[send ? from : i];
    if (arrives)
        t->wanted.dest[i] = t->a[from];
}

static void want(struct trial *t)
{
    t->wanted = t->before;
    for (int i = 0; i < COUNT; i++) {
        struct oracle_result r = {0, false};
        bool active = t->before.context[i] != 0, stores = active || t->row->always;
        bool overflows = false;
        switch (t->row->shape) {
        case PARIS_TEST_BINARY:
            want_binary(t, i, &r);
            overflows = strcmp(t->row->op, "min") && strcmp(t->row->op, "max");
            break;
        case PARIS_TEST_UNARY:
            want_unary(t, i, &r);
            overflows = t->row->type != 'f';
            break;
        case PARIS_TEST_CONVERT:
            if (t->row->type == 'f')
                r.bits = oracle_to_float(t->dlen, t->a[i], t->alen, t->row->source_type == 's');
            else
                r = oracle_to_integer(t->row->op, t->alen, t->a[i], t->dlen,
                                      t->row->type == 's');
            overflows = t->row->type != 'f';
            break;
        case PARIS_TEST_MOVE:
            r.bits = want_move(t, i);
            break;
        case PARIS_TEST_LOGICAL:
            r.bits = want_logical(t, i);
            break;
        case PARIS_TEST_OWN:
            r.bits = (number)(t->args.axis ? i % COLUMNS : i / COLUMNS) & oracle_mask(t->dlen);
            break;
        case PARIS_TEST_COMPARE:
            if (active)
                t->wanted.test[i] = want_test(t, i);
            continue;
        case PARIS_TEST_FLAG:
            if (stores)
                want_flag(t, i);
            continue;
        case PARIS_TEST_NEWS:
            want_news(t, i);
            continue;
        case PARIS_TEST_GLOBAL:
        case PARIS_TEST_GLOBALFLAG:
            continue;
        }
        if (stores)
            t->wanted.dest[i] = r.bits;
        if (active && overflows)
            t->wanted.overflow[i] = r.overflow;
    }
}

/* ---- running ---- */

static void print_number(FILE *out, number n)
{
    if (n >> 64)
        fprintf(out, "%llx:%016llx", (unsigned long long)(n >> 64), (unsigned long long)n);
    else
        fprintf(out, "%llx", (unsigned long long)n);
}

static void compare(const struct trial *t, const char *what, CM_field_id_t field, int width,
                    const number *wanted)
{
    number got[COUNT];
    device_get(field, width, got);
    for (int i = 0; i < COUNT; i++) {
        if (got[i] == wanted[i])
            continue;
        failures++;
        if (failures > 40)
            return;
        fprintf(stderr, "%s (dest %d, sources %d, %d bits) processor %d: %s is ", t->row->name,
                t->dlen, t->alen, t->blen, i, what);
        print_number(stderr, got[i]);
        fprintf(stderr, ", wanted ");
        print_number(stderr, wanted[i]);
        fprintf(stderr, " (context %d, dest ", (int)t->before.context[i]);
        print_number(stderr, t->before.dest[i]);
        fprintf(stderr, ", sources ");
        print_number(stderr, t->a[i]);
        fprintf(stderr, " ");
        print_number(stderr, t->b[i]);
        fprintf(stderr, ", constant %lx %a)\n", t->args.value_u, t->args.value_f);
        return; /* one processor a case */
    }
}

static void batch_finish(void)
{
    if (!batch_count)
        return;
    if (machine_finish(paris_machine()) != MACHINE_OK)
        fail_msg("%s: %s", batch[0].row->name, machine_error(paris_machine()));
    for (int i = 0; i < batch_count; i++) {
        const struct trial *t = &batch[i];
        compare(t, "dest", t->dest, t->dlen, t->wanted.dest);
        compare(t, "context", t->context, 1, t->wanted.context);
        compare(t, "test", t->test, 1, t->wanted.test);
        compare(t, "overflow", t->overflow, 1, t->wanted.overflow);
    }
    CM_deallocate_stack_through(batch[0].first);
    batch_count = 0;
}

static CM_field_id_t field_with(int width, const number *numbers)
{
    CM_field_id_t field = CM_allocate_stack_field((unsigned int)width);
    device_put(field, width, numbers);
    return field;
}

static void fill(number *numbers, char type, int width)
{
    if (type == 'f')
        device_floats(numbers, width);
    else
        device_integers(numbers, width);
}

static void float_lengths(int width, unsigned int *s, unsigned int *e)
{
    *s = width == 32 ? 23 : 52;
    *e = width == 32 ? 8 : 11;
}

/* Draws the operands, flags and arguments of a case whose row and lengths are set. */
static void trial_fill(struct trial *t, int mask)
{
    const struct paris_test_row *row = t->row;
    char source_type = row->source_type == '-' ? row->type : row->source_type;
    number constant[COUNT];
    fill(t->before.dest, row->type, t->dlen);
    fill(t->a, source_type, t->alen);
    fill(t->b, row->type, t->blen);
    device_mask(t->before.context, mask);
    device_mask(t->before.test, 2);
    device_mask(t->before.overflow, 2);
    struct paris_test_args *args = &t->args;
    memset(args, 0, sizeof *args);
    args->len = args->dlen = (unsigned int)t->dlen;
    args->slen = args->slen1 = (unsigned int)t->alen;
    args->slen2 = (unsigned int)t->blen;
    float_lengths(row->shape == PARIS_TEST_CONVERT && row->type != 'f' ? t->alen : t->dlen,
                  &args->s, &args->e);
    float_lengths(t->dlen, &args->ds, &args->de);
    float_lengths(t->alen, &args->ss, &args->se);
    args->axis = device_random() % 2;
    args->direction = device_random() % 2;
    int clen = t->alen < t->dlen ? t->alen : t->dlen;
    if (row->type == 'f') {
        device_floats(constant, 64);
        args->value_f = oracle_float_value(64, constant[0]);
        if (isnan(args->value_f))
            args->value_f = (double)NAN; /* no payload: front ends differ */
        if (device_random() % 2)
            args->value_f = 0.1 * (double)(device_random() % 100);
    } else {
        device_integers(constant, clen < 64 ? clen : 64);
        args->value_u = (unsigned long)constant[0];
        args->value_s = (long)oracle_extend(constant[0], clen < 64 ? clen : 64, true);
    }
}

static void trial_run(const struct paris_test_row *row, int dlen, int alen, int blen, int mask)
{
    struct trial *t = &batch[batch_count++];
    t->row = row;
    t->dlen = dlen;
    t->alen = alen;
    t->blen = blen;
    trial_fill(t, mask);
    want(t);
    CM_field_id_t context = field_with(1, t->before.context),
                  test = field_with(1, t->before.test),
                  overflow = field_with(1, t->before.overflow);
    t->first = context;
    t->dest = t->args.dest = field_with(dlen, t->before.dest);
    t->args.source = t->args.source1 = field_with(alen, t->a);
    t->args.source2 = field_with(blen, t->b);
    t->context = CM_allocate_stack_field(1);
    t->test = CM_allocate_stack_field(1);
    t->overflow = CM_allocate_stack_field(1);
    CM_load_test_always(test);
    CM_load_overflow_always(overflow);
    CM_load_context(context);
    row->call(&t->args);
    CM_store_context(t->context);
    CM_store_test_always(t->test);
    CM_store_overflow_always(t->overflow);
    CM_set_context();
    cases_count++;
    if (batch_count == BATCH)
        batch_finish();
}

/* ---- which cases ---- */

/* A row with a second spelling gives the same kernels, so one width is enough for it. */
static bool is_full(void)
{
    return getenv("PARIS_TEST_FULL") != NULL;
}

static bool is_second_spelling(const struct paris_test_row *row)
{
    return strstr(row->name, "_const_") != NULL;
}

static void masks_run(const struct paris_test_row *row, int dlen, int alen, int blen)
{
    static int turn;
    if (is_full())
        for (int mask = 0; mask < 3; mask++)
            trial_run(row, dlen, alen, blen, mask);
    else
        trial_run(row, dlen, alen, blen, turn % 7 == 0 ? 0 : turn % 3 == 0 ? 1 : 2);
    turn++;
}

static int other_width(int k, bool is_signed)
{
    int width = widths[(k * 7 + 5) % WIDTHS_COUNT];
    return is_signed && width < 2 ? 9 : width;
}

static void row_at_width(const struct paris_test_row *row, int k)
{
    static int turn;
    int width = widths[k];
    bool is_signed = row->type == 's' || row->source_type == 's';
    if (is_signed && width < 2)
        return;
    turn++;
    if (row->shape == PARIS_TEST_CONVERT) {
        int floats = turn % 2 ? 32 : 64;
        if (row->type == 'f')
            masks_run(row, floats, width, 1);
        else
            masks_run(row, width, floats, 1);
    } else if (row->lengths == 1) {
        masks_run(row, width, width, width);
    } else {
        masks_run(row, width, other_width(k + turn, is_signed),
                  other_width(k + 3 * turn, is_signed));
    }
}

static void finish_and_check(void)
{
    batch_finish();
    printf("%ld cases\n", cases_count);
    cases_count = 0;
    assert_int_equal(failures, 0);
}

/* Tests the integer rows of these shapes whose names begin with prefix, at every width. */
static void shapes_run(const char *prefix, unsigned int shapes)
{
    failures = 0;
    for (int k = 0; k < WIDTHS_COUNT; k++)
        for (int r = 0, turn = 0; r < ROW_COUNT; r++) {
            const struct paris_test_row *row = &paris_test_rows[r];
            if (!(shapes >> row->shape & 1) || strncmp(row->name, prefix, strlen(prefix)))
                continue;
            bool takes =
                is_second_spelling(row) ? k == r % WIDTHS_COUNT : (turn++ + k) % 8 == 0;
            if (takes || is_full())
                row_at_width(row, k);
        }
    finish_and_check();
}

#define SHAPE(x) (1u << PARIS_TEST_##x)

static void unsigned_arithmetic_is_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_u_", SHAPE(BINARY) | SHAPE(UNARY));
}

static void signed_arithmetic_is_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_s_", SHAPE(BINARY) | SHAPE(UNARY));
}

static void comparisons_are_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_u_", SHAPE(COMPARE));
    shapes_run("CM_s_", SHAPE(COMPARE));
}

static void moves_are_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_u_", SHAPE(MOVE));
    shapes_run("CM_s_", SHAPE(MOVE));
}

static void conversions_are_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_", SHAPE(CONVERT));
}

static void logical_operations_are_the_oracles(void **unused)
{
    (void)unused;
    shapes_run("CM_", SHAPE(LOGICAL));
}

static void float_operations_are_the_oracles(void **unused)
{
    (void)unused;
    failures = 0;
    for (int turn = 0; turn < 2 + 2 * is_full(); turn++)
        for (int r = 0; r < ROW_COUNT; r++) {
            const struct paris_test_row *row = &paris_test_rows[r];
            int width = turn % 2 ? 64 : 32;
            if (row->type != 'f' || row->shape > PARIS_TEST_MOVE ||
                (turn != 1 && is_second_spelling(row)))
                continue;
            masks_run(row, width, row->lengths == 2 ? 96 - width : width, width);
        }
    finish_and_check();
}

static void flags_are_the_oracles(void **unused)
{
    (void)unused;
    failures = 0;
    for (int r = 0; r < ROW_COUNT; r++)
        if (paris_test_rows[r].shape == PARIS_TEST_FLAG)
            masks_run(&paris_test_rows[r], 1, 1, 1);
    finish_and_check();
}

static void news_is_the_oracles(void **unused)
{
    (void)unused;
    failures = 0;
    for (int k = 0; k < WIDTHS_COUNT; k++)
        for (int r = 0; r < ROW_COUNT; r++) {
            enum paris_test_shape shape = paris_test_rows[r].shape;
            if ((shape == PARIS_TEST_NEWS || shape == PARIS_TEST_OWN) &&
                ((k + r) % 5 == 0 || is_full()))
                masks_run(&paris_test_rows[r], widths[k], widths[k], 1);
        }
    finish_and_check();
}

static void every_instruction_is_there(void **unused)
{
    (void)unused;
    int count = sizeof paris_test_functions / sizeof paris_test_functions[0];
    printf("%d instructions\n", count);
    for (int i = 0; i < count; i++)
        assert_non_null(paris_test_functions[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_is_there),
        cmocka_unit_test(flags_are_the_oracles),
        cmocka_unit_test(news_is_the_oracles),
        cmocka_unit_test(float_operations_are_the_oracles),
        cmocka_unit_test(moves_are_the_oracles),
        cmocka_unit_test(logical_operations_are_the_oracles),
        cmocka_unit_test(comparisons_are_the_oracles),
        cmocka_unit_test(conversions_are_the_oracles),
        cmocka_unit_test(unsigned_arithmetic_is_the_oracles),
        cmocka_unit_test(signed_arithmetic_is_the_oracles),
    };
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
