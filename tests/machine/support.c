/* support.c - see support.h. */
#include "support.h"
#include "machine_rows.h"

#include "sample.h"

void support_failed(struct machine *m, enum machine_status status, const char *word)
{
    const char *text = machine_error(m);

    assert_int_equal(machine_status_last(m), status);
    if (strlen(text) <= 8 || strchr(text, '\n') || !strstr(text, word))
        fail_msg("\"%s\" instead of \"%s\"", text, word);
    machine_error_clear(m);
    assert_int_equal(machine_status_last(m), MACHINE_OK);
    assert_string_equal(machine_error(m), "");
}

wide support_integer(enum machine_op op, int w, wide a, wide b)
{
    signed_wide sa = wide_signed(a, w), sb = wide_signed(b, w);

    switch ((int)op) {
    case MACHINE_NOT:
        return ~a & wide_mask(w);
    case MACHINE_NEG:
        return (0 - a) & wide_mask(w);
    case MACHINE_AND:
        return a & b;
    case MACHINE_OR:
        return a | b;
    case MACHINE_XOR:
        return a ^ b;
    case MACHINE_ADD:
        return (a + b) & wide_mask(w);
    case MACHINE_SUB:
        return (a - b) & wide_mask(w);
    case MACHINE_MUL:
        return a * b & wide_mask(w);
    case MACHINE_UMIN:
        return a < b ? a : b;
    case MACHINE_UMAX:
        return a > b ? a : b;
    case MACHINE_SMIN:
        return sa < sb ? a : b;
    case MACHINE_SMAX:
        return sa > sb ? a : b;
    case MACHINE_EQ:
        return a == b;
    case MACHINE_NE:
        return a != b;
    case MACHINE_ULT:
        return a < b;
    case MACHINE_ULE:
        return a <= b;
    case MACHINE_SLT:
        return sa < sb;
    case MACHINE_SLE:
        return sa <= sb;
    default:
        fail_msg("no oracle for operation %d", (int)op);
        return 0;
    }
}

void support_machine_destroy(struct machine *m)
{
    if (getenv("LUTETIA_TEST_STATS")) {
        struct machine_stats stats;
        machine_stats_get(m, &stats);
        fprintf(stderr, "%d kernels built, %d run\n", (int)stats.kernels_built,
                (int)stats.kernels_run);
    }
    machine_destroy(m);
}

struct machine *support_machine(int eager)
{
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;

    config.processors_count = 16;
    config.eager = eager;
    assert_ok(machine_create(&config, &m), m);
    return m;
}

int support_set(struct machine *m, int rank, ...)
{
    int dimensions[MACHINE_AXES_MAX], set;
    va_list axes;

    va_start(axes, rank);
    for (int k = 0; k < rank; k++)
        dimensions[k] = va_arg(axes, int);
    va_end(axes);
    set = machine_vpset_create(m, dimensions, rank);
    if (set == 0)
        fail_msg("%s", machine_error(m));
    assert_ok(machine_vpset_select(m, set), m);
    return set;
}

static wide awkward_bits(int width, uint64_t which)
{
    wide top = (wide)1 << (width - 1);
    const wide awkward[] = {0,       1,       wide_mask(width),     top,
                            top - 1, top + 1, wide_mask(width) - 1, 3};

    return awkward[which % 8] & wide_mask(width);
}

static uint64_t awkward_float(int bits, uint64_t which)
{
    static const double awkward[] = {0.0,     -0.0,         1.0,   -1.0,   0.5,  1.5,
                                     2.5,     -2.5,         1e-45, 1e-310, 3e38, -3e38,
                                     1.7e308, 4294967296.0, 1e300, -0.75,  255.0};
    uint64_t count = sizeof awkward / sizeof awkward[0];

    which %= count + 3;
    if (which == count)
        return number_nan(bits);
    if (which > count)
        return number_real(which == count + 1 ? __builtin_inf() : -__builtin_inf(), bits);
    return number_real(awkward[which], bits);
}

wide support_word(struct machine_type type, uint64_t seed, uint64_t n)
{
    uint64_t z = sample_of(seed * 1000003 + n);

    if (type.kind == MACHINE_FLOAT) {
        if (z % 3 == 0)
            return awkward_float(type.width, z >> 8);
        return number_real(((double)(z >> 40) * 0x1p-24 - 0.5) * (z % 3 == 1 ? 4 : 1e5),
                           type.width);
    }
    if (z % 3 == 0)
        return awkward_bits(type.width, z >> 8);
    return ((wide)sample_of(z) << 64 | z) &
           wide_mask(z % 3 == 1 || type.width < 8 ? type.width : 8);
}

wide support_element(const void *array, struct machine_type type, uint64_t n)
{
    size_t bytes = machine_element_bytes(type);
    wide value = 0;

    memcpy(&value, (const char *)array + n * bytes, bytes); /* little-endian hosts */
    return value;
}

void support_element_set(void *array, struct machine_type type, uint64_t n, wide value)
{
    size_t bytes = machine_element_bytes(type);

    memcpy((char *)array + n * bytes, &value, bytes);
}

static uint64_t count_of(struct machine *m)
{
    return machine_vpset_count(m, machine_vpset_current(m));
}

uint32_t support_field(struct machine *m, struct machine_type type, uint64_t seed)
{
    uint32_t field =
        machine_field_allocate(m, machine_vpset_current(m), type.width, MACHINE_HEAP);
    void *array = calloc(count_of(m), 16);

    assert_non_null(array);
    if (field == MACHINE_NO_FIELD)
        fail_msg("%s", machine_error(m));
    for (uint64_t n = 0; n < count_of(m); n++)
        support_element_set(array, type, n, support_word(type, seed, n));
    assert_ok(machine_field_upload(m, field, type, array), m);
    free(array);
    return field;
}

struct machine_value *support_value(struct machine *m, uint32_t field, struct machine_type type)
{
    struct machine_value *v = machine_field_value(m, field, type, MACHINE_EVERYWHERE);

    if (!v)
        fail_msg("%s", machine_error(m));
    return v;
}

/* Where the field lies in this computer's memory, its rows are those of the array. */
static void expect_look(struct machine *m, uint32_t field, struct machine_type type,
                        const unsigned char *array)
{
    const int set = machine_field_vpset(m, field);
    const size_t bytes = (size_t)machine_vpset_length(m, set, machine_vpset_rank(m, set) - 1) *
                         machine_element_bytes(type);
    const uint64_t rows = machine_vpset_count(m, set) * machine_element_bytes(type) / bytes;
    struct machine_rows look;

    assert_ok(machine_fields_look(m, &field, 1, type, &look), m);
    for (uint64_t row = 0; look.at && row < rows; row++)
        assert_memory_equal(look.at + row * look.pitch, array + row * bytes, bytes);
}

void support_expect_field(struct machine *m, uint32_t field, struct machine_type type,
                          support_expected expected, const void *data, const char *what)
{
    void *array = calloc(count_of(m), 16);

    assert_non_null(array);
    assert_ok(machine_field_download(m, field, type, array), m);
    expect_look(m, field, type, array);
    for (uint64_t n = 0; n < count_of(m); n++) {
        wide got = support_element(array, type, n), wanted = expected(data, n);

        if (got != wanted)
            fail_msg("%s, element %llu: %016llx%016llx, expected %016llx%016llx", what,
                     (unsigned long long)n, (unsigned long long)(got >> 64),
                     (unsigned long long)got, (unsigned long long)(wanted >> 64),
                     (unsigned long long)wanted);
    }
    free(array);
}

enum { LATER_MAX = 64 };

static struct {
    uint32_t field;
    struct machine_type type;
    support_expected expected;
    _Alignas(16) char data[64];
    char what[64];
} later[LATER_MAX];
static int later_count;

void support_later(struct machine *m, struct machine_value *value, support_expected expected,
                   const void *data, size_t data_bytes, const char *what)
{
    uint32_t field;

    assert_true(data_bytes <= sizeof later[0].data && later_count < LATER_MAX);
    if (!value)
        fail_msg("%s: %s", what, machine_error(m));
    later[later_count].type = machine_value_type(value);
    field = machine_field_allocate(m, machine_vpset_current(m), later[later_count].type.width,
                                   MACHINE_HEAP);
    assert_ok(machine_field_store(m, field, value, MACHINE_EVERYWHERE), m);
    later[later_count].field = field;
    later[later_count].expected = expected;
    if (data_bytes)
        memcpy(later[later_count].data, data, data_bytes);
    snprintf(later[later_count++].what, sizeof later[0].what, "%s", what);
}

void support_check(struct machine *m)
{
    int count = later_count;

    later_count = 0; /* after a failure below no check is left over for the next test */
    assert_ok(machine_finish(m), m);
    for (int k = 0; k < count; k++) {
        support_expect_field(m, later[k].field, later[k].type, later[k].expected, later[k].data,
                             later[k].what);
        assert_ok(machine_field_deallocate(m, later[k].field), m);
    }
}

void support_expect(struct machine *m, struct machine_value *value, support_expected expected,
                    const void *data, const char *what)
{
    struct machine_type type;
    uint32_t field;

    if (!value)
        fail_msg("%s: %s", what, machine_error(m));
    type = machine_value_type(value);
    field = machine_field_allocate(m, machine_vpset_current(m), type.width, MACHINE_HEAP);
    assert_ok(machine_field_store(m, field, value, MACHINE_EVERYWHERE), m);
    support_expect_field(m, field, type, expected, data, what);
    assert_ok(machine_field_deallocate(m, field), m);
}

char support_cache[] = "/tmp/lutetia-test-cache-XXXXXX";
static char cache_before[400];

int support_cache_make(void **state)
{
    const char *before = getenv("XDG_CACHE_HOME");
    (void)state;
    snprintf(cache_before, sizeof cache_before, "%s", before ? before : "");
    return mkdtemp(support_cache) && setenv("XDG_CACHE_HOME", support_cache, 1) == 0 ? 0 : -1;
}

void support_cache_leave(void)
{
    if (*cache_before)
        setenv("XDG_CACHE_HOME", cache_before, 1);
    else
        unsetenv("XDG_CACHE_HOME");
}

/* Removes the folder with all that is in it, the driver's files too. */
int support_cache_remove(void **state)
{
    char command[400];
    (void)state;
    support_cache_leave();
    snprintf(command, sizeof command, "rm -rf %s", support_cache);
    return system(command);
}
