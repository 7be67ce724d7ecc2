/* test_narrow.c - a kernel that computes with short integers only has lanes of 8 or 16 bits
 * (plan/lanes.c). It gives the numbers of plain C with vectors of every width, in rows and in
 * strips, also where a row ends with part of a vector. */
#include "support.h"

#include <dirent.h>
#include <unistd.h>

enum { ROWS = 12, COLUMNS = 150, COUNT = ROWS * COLUMNS, CASES_MOST = 200 };

struct test_case {
    enum machine_op op;
    int width, dy, dx; /* dy and dx: the neighbour whose result is compared */
};

static const enum machine_op ops[] = {
    MACHINE_NOT, MACHINE_NEG,  MACHINE_AND,  MACHINE_OR,   MACHINE_XOR,  MACHINE_ADD,
    MACHINE_SUB, MACHINE_UMIN, MACHINE_UMAX, MACHINE_SMIN, MACHINE_SMAX, MACHINE_EQ,
    MACHINE_NE,  MACHINE_ULT,  MACHINE_ULE,  MACHINE_SLT,  MACHINE_SLE};
enum { OPS = sizeof ops / sizeof ops[0] };

static wide word(int width, int which, uint64_t n)
{
    const struct machine_type type = MACHINE_UINT(width);

    return support_word(type, which == 0 || n % 5 == 0 ? 1 : 2, n);
}

static uint64_t moved(uint64_t n, int dy, int dx)
{
    const int y = (int)(n / COLUMNS), x = (int)(n % COLUMNS);

    return (uint64_t)((y + dy + ROWS) % ROWS * COLUMNS + (x + dx + COLUMNS) % COLUMNS);
}

static bool is_compare(enum machine_op op)
{
    return op >= MACHINE_EQ && op <= MACHINE_SLE;
}

static wide of_neighbour(const struct test_case *c, uint64_t n)
{
    n = moved(n, c->dy, c->dx);
    return support_integer(c->op, c->width, word(c->width, 0, n), word(c->width, 1, n));
}

/* How the result is used: as it is, in a select, extended, in part, as half of a pair, and in a
 * sum of neighbours on both sides along both axes. */
enum made { PLAIN, CHOSEN, EXTENDED, PART, PAIR, SUM, MADE };

static wide made_of(const struct test_case *c, enum made made, int most, uint64_t n)
{
    const wide r = of_neighbour(c, n), a = word(c->width, 0, n);

    switch (made) {
    case CHOSEN:
        return a < 3 ? r : 1;
    case EXTENDED:
        return (wide)wide_signed(r, is_compare(c->op) ? 1 : c->width) & wide_mask(most);
    case PART:
        return r >> (c->width - 1);
    case PAIR:
        return (r & 7) | (a & 7) << 3;
    case SUM: {
        wide sum = 0;
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++)
                sum += of_neighbour(c, moved(n, dy, dx));
        return sum & wide_mask(most);
    }
    case PLAIN:
    case MADE:
        break;
    }
    return r;
}

static struct machine *machine;

static struct machine_value *number(int width, uint64_t x)
{
    return machine_constant(machine, MACHINE_UINT(width), (struct machine_scalar){x, 0});
}

static struct machine_value *three(struct machine_value *v, int axis)
{
    return machine_binary(
        machine, MACHINE_ADD,
        machine_binary(machine, MACHINE_ADD, machine_shift(machine, v, axis, 1), v),
        machine_shift(machine, v, axis, -1));
}

static struct machine_value *make(enum made made, struct machine_value *r,
                                  struct machine_value *a, int most)
{
    const int w = machine_value_type(a).width;

    switch (made) {
    case CHOSEN:
        return machine_select(machine, machine_binary(machine, MACHINE_ULT, a, number(w, 3)), r,
                              number(machine_value_type(r).width, 1));
    case EXTENDED:
        return machine_resize(machine, r, most, true);
    case PART:
        return machine_extract(machine, r, w - 1, 1);
    case PAIR:
        return machine_concat(machine, machine_extract(machine, r, 0, 3),
                              machine_extract(machine, a, 0, 3));
    case SUM:
        return three(three(machine_resize(machine, r, most, false), 0), 1);
    case PLAIN:
    case MADE:
        break;
    }
    return r;
}

static uint32_t upload(int width, int which)
{
    const struct machine_type type = MACHINE_UINT(width);
    char *array = calloc(COUNT, 16);
    uint32_t field = machine_field_allocate(machine, machine_vpset_current(machine),
                                            (uint32_t)width, MACHINE_HEAP);

    assert_non_null(array);
    for (uint64_t n = 0; n < COUNT; n++)
        support_element_set(array, type, n, word(width, which, n));
    assert_ok(machine_field_upload(machine, field, type, array), machine);
    free(array);
    return field;
}

/* Checks all operations on numbers of those widths, and all uses of their results, in one
 * evaluation. */
static void check(const int *widths, int widths_count, int most)
{
    static struct {
        struct test_case c;
        enum made made;
        uint32_t field;
        struct machine_type type;
    } cases[CASES_MOST];
    int count = 0;

    for (int i = 0; i < widths_count; i++) {
        const int w = widths[i];
        const uint32_t a = upload(w, 0), b = upload(w, 1);

        for (int k = i % 2; k < OPS; k += 2) { /* each operation on some of them */
            struct test_case c = {ops[k], w, k % 3 - 1, (k + i) % 5 - 2};
            const enum made all = (enum made)((k / 2 + i) % MADE);
            const bool of_bits = is_compare(ops[k]) || w < 4;
            const enum made made = of_bits && all != SUM && all != EXTENDED ? PLAIN : all;
            struct machine_value *x, *r;

            machine_begin(machine);
            x = support_value(machine, a, MACHINE_UINT(w));
            r = ops[k] <= MACHINE_NEG
                    ? machine_unary(machine, ops[k], x)
                    : machine_binary(machine, ops[k], x,
                                     support_value(machine, b, MACHINE_UINT(w)));
            r = machine_shift(machine, machine_shift(machine, r, 0, c.dy), 1, c.dx);
            r = make(made, r, x, most);
            if (!r)
                fail_msg("%d of %d bits: %s", (int)ops[k], w, machine_error(machine));
            cases[count].c = c;
            cases[count].made = made;
            cases[count].type = machine_value_type(r);
            cases[count].field = machine_field_allocate(machine, machine_vpset_current(machine),
                                                        cases[count].type.width, MACHINE_HEAP);
            assert_ok(machine_field_store(machine, cases[count].field, r, MACHINE_EVERYWHERE),
                      machine);
            count++;
        }
    }
    assert_ok(machine_finish(machine), machine);
    for (int k = 0; k < count; k++) {
        char array[COUNT * 16];

        assert_ok(machine_field_download(machine, cases[k].field, cases[k].type, array),
                  machine);
        for (uint64_t n = 0; n < COUNT; n++) {
            const wide is = support_element(array, cases[k].type, n),
                       wanted = made_of(&cases[k].c, cases[k].made, most, n);
            if (is != wanted)
                fail_msg("operation %d of %d bits, made %d, element %d: %#x, expected %#x",
                         (int)cases[k].c.op, cases[k].c.width, (int)cases[k].made, (int)n,
                         (unsigned int)is, (unsigned int)wanted);
        }
        assert_ok(machine_field_deallocate(machine, cases[k].field), machine);
    }
}

/* Counts the folder's kernels that have lanes of this width, and removes all kernels. */
static int kernels_of(const char *folder, const char *lane)
{
    DIR *d = opendir(folder);
    int count = 0;

    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) {
        char path[600], line[200];
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        FILE *f = e->d_name[0] == '.' ? NULL : fopen(path, "r");
        if (!f)
            continue;
        count += fgets(line, sizeof line, f) && strstr(line, lane);
        fclose(f);
        unlink(path);
    }
    closedir(d);
    return count;
}

/* Checks the overflow flags of sums and differences. */
static void check_overflows(int width)
{
    const uint32_t a = upload(width, 0), b = upload(width, 1);
    const uint32_t field =
        machine_field_allocate(machine, machine_vpset_current(machine), 1, MACHINE_HEAP);
    char array[COUNT];

    for (int k = 0; k < 4; k++) {
        const bool sum = k & 1, is_signed = k & 2;
        int differ = 0;
        machine_begin(machine);
        assert_ok(machine_overflow_record(machine, sum ? MACHINE_ADD : MACHINE_SUB, is_signed,
                                          support_value(machine, a, MACHINE_UINT(width)),
                                          support_value(machine, b, MACHINE_UINT(width))),
                  machine);
        assert_ok(machine_field_store(
                      machine, field,
                      machine_flag_value(machine, MACHINE_OVERFLOW, MACHINE_EVERYWHERE),
                      MACHINE_EVERYWHERE),
                  machine);
        assert_ok(machine_field_download(machine, field, MACHINE_BIT, array), machine);
        for (uint64_t n = 0; n < COUNT; n++) {
            const wide x = word(width, 0, n), y = word(width, 1, n);
            bool overflows;
            number_integer(sum ? OP_ADD : OP_SUBTRACT, is_signed,
                           is_signed ? (wide)wide_signed(x, width) : x,
                           is_signed ? (wide)wide_signed(y, width) : y, width, &overflows);
            if (array[n] != overflows)
                fail_msg("%s %s of %d bits, element %d: overflow %d, expected %d",
                         is_signed ? "signed" : "unsigned", sum ? "sum" : "difference", width,
                         (int)n, array[n], overflows);
            differ += overflows;
        }
        assert_in_range(differ, 1, COUNT - 1);
    }
    assert_ok(machine_field_deallocate(machine, field), machine);
    assert_ok(machine_field_deallocate(machine, a), machine);
    assert_ok(machine_field_deallocate(machine, b), machine);
}

/* Checks operations on 8 and (in rows) 16 bits, and their overflow flags, against the oracle:
 * in strips or in rows, with vectors of that many words. Checks also that a kernel with lanes
 * of that width was made. */
static void agree(const char *vector, bool strips)
{
    static const int bytes[] = {8, 5, 8, 1}, shorts[] = {16, 13};
    struct machine_config config = machine_config_default();
    char folder[] = "/tmp/test_narrow_XXXXXX";

    assert_non_null(mkdtemp(folder));
    setenv("LUTETIA_VECTOR", vector, 1);
    setenv("LUTETIA_STRIPS", strips ? "1" : "0", 1);
    config.dump_dir = folder;
    config.eager = 0;
    assert_ok(machine_create(&config, &machine), machine);
    support_set(machine, 2, ROWS, COLUMNS);
    check(bytes, 4, 8);
    assert_true(kernels_of(folder, strips ? "-DLANE=8, strips" : "-DLANE=8 ") > 0);
    for (int i = 0; i < 2; i++) {
        check_overflows(bytes[i]);
        assert_true(kernels_of(folder, "-DLANE=8 ") > 0);
    }
    if (!strips) {
        check_overflows(shorts[1]);
        check(shorts, 2, 16);
        assert_true(kernels_of(folder, "-DLANE=16 ") > 0);
    }
    machine_destroy(machine);
    rmdir(folder);
}

static void lanes_in_rows_agree_with_the_oracle(void **state)
{
    (void)state;
    agree("16", false);
}

static void lanes_in_strips_agree_with_the_oracle(void **state)
{
    (void)state;
    agree("16", true);
}

static void lanes_of_short_vectors_agree_with_the_oracle(void **state)
{
    (void)state;
    agree("4", true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lanes_in_rows_agree_with_the_oracle),
        cmocka_unit_test(lanes_in_strips_agree_with_the_oracle),
        cmocka_unit_test(lanes_of_short_vectors_agree_with_the_oracle),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
