/* Scans, spreads, reductions, enumerations and ranks against the oracle: over geometries of 1 to
 * 5 axes, directions, inclusions, segments, contexts, lengths.
 *
 * Kernels take most of the time, and a VP set of another rank has other ones; so all operations
 * are tried with three axes (which may have a length of 1), and with other ranks some. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "oracle_scan.h"

struct call {
    CM_field_id_t dest, source, sbit;
    unsigned int axis, len, s, e, direction, inclusion, smode, to, from, mask;
};

struct row {
    char letter;
    const char *op;
    void (*scan)(const struct call *), (*spread)(const struct call *),
        (*multispread)(const struct call *), (*reduce)(const struct call *);
};

#define LEN_u c->len
#define LEN_s c->len
#define LEN_b c->len
#define LEN_f c->s, c->e
#define SCAN_CALL(name, ...)                                                                   \
    static void scan_##name(const struct call *c)                                              \
    {                                                                                          \
        CM_scan_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__, c->direction,       \
                                 c->inclusion, c->smode, c->sbit);                             \
    }
#define CALLS(name, ...)                                                                       \
    SCAN_CALL(name, __VA_ARGS__)                                                               \
    static void spread_##name(const struct call *c)                                            \
    {                                                                                          \
        CM_spread_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__);                  \
    }                                                                                          \
    static void multispread_##name(const struct call *c)                                       \
    {                                                                                          \
        CM_multispread_with_##name##_1L(c->dest, c->source, c->mask, __VA_ARGS__);             \
    }                                                                                          \
    static void reduce_##name(const struct call *c)                                            \
    {                                                                                          \
        CM_reduce_with_##name##_1L(c->dest, c->source, c->axis, __VA_ARGS__, c->to);           \
    }
CALLS(u_add, LEN_u)
CALLS(u_min, LEN_u)
CALLS(u_max, LEN_u)
CALLS(s_add, LEN_s)
CALLS(s_min, LEN_s)
CALLS(s_max, LEN_s)
CALLS(logand, LEN_b)
CALLS(logior, LEN_b)
CALLS(logxor, LEN_b)
CALLS(f_add, LEN_f)
CALLS(f_multiply, LEN_f)
CALLS(f_min, LEN_f)
CALLS(f_max, LEN_f)
SCAN_CALL(copy, LEN_b)
static void spread_copy(const struct call *c)
{
    CM_spread_with_copy_1L(c->dest, c->source, c->axis, c->len, c->from);
}
static void reduce_copy(const struct call *c)
{
    CM_reduce_with_copy_1L(c->dest, c->source, c->axis, c->len, c->to, c->from);
}

#define ROW(letter, op, name)                                                                  \
    {                                                                                          \
        letter, op, scan_##name, spread_##name, multispread_##name, reduce_##name              \
    }
static const struct row rows[] = {
    ROW('u', "add", u_add),           ROW('u', "min", u_min),
    ROW('u', "max", u_max),           ROW('s', "add", s_add),
    ROW('s', "min", s_min),           ROW('s', "max", s_max),
    ROW('b', "logand", logand),       ROW('b', "logior", logior),
    ROW('b', "logxor", logxor),       ROW('f', "add", f_add),
    ROW('f', "multiply", f_multiply), ROW('f', "min", f_min),
    ROW('f', "max", f_max),           {'b', "copy", scan_copy, spread_copy, NULL, reduce_copy},
};
enum { ROWS_COUNT = sizeof rows / sizeof *rows };

/* ---- a VP set with numbers ---- */

struct set {
    struct scan_grid grid;
    CM_vp_set_id_t id;
    CM_field_id_t context, sbit, source, dest;
    number *context_bits, *sbits, *numbers, *old, *got;
};

static number *numbers_new(int count)
{
    number *n = calloc((size_t)count, sizeof *n);
    assert_non_null(n);
    return n;
}

static struct machine_type type_of(char letter, int width)
{
    return letter != 'f' ? MACHINE_UINT(width) : width == 32 ? MACHINE_F32 : MACHINE_F64;
}

static void put(const struct set *s, CM_field_id_t field, char letter, int width,
                const number *n)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char *dense = calloc((size_t)s->grid.count, bytes);
    for (int i = 0; i < s->grid.count; i++)
        memcpy(dense + (size_t)i * bytes, &n[i], bytes);
    assert_int_equal(
        machine_field_upload(paris_machine(), field, type_of(letter, width), dense),
        MACHINE_OK);
    free(dense);
}

static void get(const struct set *s, CM_field_id_t field, char letter, int width, number *n)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char *dense = calloc((size_t)s->grid.count, bytes);
    if (machine_field_download(paris_machine(), field, type_of(letter, width), dense) !=
        MACHINE_OK)
        fail_msg("%s", machine_error(paris_machine()));
    memset(n, 0, (size_t)s->grid.count * sizeof *n);
    for (int i = 0; i < s->grid.count; i++)
        memcpy(&n[i], dense + (size_t)i * bytes, bytes);
    free(dense);
}

static struct set set_new(int rank, const int *dimensions)
{
    struct set s = {.grid = {.rank = rank, .count = 1}};
    for (int i = 0; i < rank; i++) {
        s.grid.dimensions[i] = dimensions[i];
        s.grid.count *= dimensions[i];
    }
    s.id = CM_allocate_vp_set(
        CM_create_geometry((CM_vector_t){.ints = dimensions}, (unsigned int)rank));
    CM_set_vp_set(s.id);
    s.context = CM_allocate_heap_field(1);
    s.sbit = CM_allocate_heap_field(1);
    s.context_bits = numbers_new(s.grid.count);
    s.sbits = numbers_new(s.grid.count);
    s.numbers = numbers_new(s.grid.count);
    s.old = numbers_new(s.grid.count);
    s.got = numbers_new(s.grid.count);
    return s;
}

/* For numbers of that width and nothing else: a field that held others before would be cut up. */
static void fields_new(struct set *s, int width)
{
    if (s->source)
        CM_deallocate_stack_through(s->source);
    s->source = CM_allocate_stack_field((unsigned)width);
    s->dest = CM_allocate_stack_field((unsigned)width);
}

static void set_free(struct set *s)
{
    if (s->source)
        CM_deallocate_stack_through(s->source);
    CM_set_context();
    CM_deallocate_vp_set(s->id);
    free(s->context_bits);
    free(s->sbits);
    free(s->numbers);
    free(s->old);
    free(s->got);
}

/* COUNT numbers at a time. */
static void numbers_random(number *n, int count, int width, bool floats)
{
    number some[COUNT];
    for (int i = 0; i < count; i++) {
        if (i % COUNT == 0 && floats)
            device_floats(some, width);
        else if (i % COUNT == 0)
            device_integers(some, width);
        n[i] = some[i % COUNT];
        /* sums of which the first NaN or infinity leaves nothing to see */
        if (floats && device_random() % 8)
            n[i] = oracle_float_bits(width, (double)(int64_t)device_random() / 3e18);
    }
}

/* Who takes part (0 few, 1 all, 2 most) and where segments begin (one in `length`). */
static void set_masks(struct set *s, int who, int length)
{
    for (int i = 0; i < s->grid.count; i++) {
        s->context_bits[i] = who == 1 || (device_random() >> 20) % 4 < (who ? 3u : 1u);
        s->sbits[i] = (device_random() >> 20) % (unsigned)length == 0;
    }
    put(s, s->sbit, 'b', 1, s->sbits);
    put(s, s->context, 'b', 1, s->context_bits);
    CM_set_context();
    if (who != 1)
        CM_load_context(s->context);
}

static void compare(const struct set *s, const char *what, const struct scan_case *c)
{
    get(s, s->dest, c->letter, c->width, s->got);
    for (int i = 0; i < s->grid.count; i++)
        if (s->got[i] != s->old[i])
            fail_msg("%s_%c_%s, %d bits, axis %d of %d (%d %d %d), direction %d, inclusion %d, "
                     "smode %d: processor %d: got %016llx%016llx, wanted %016llx%016llx",
                     what, c->letter, c->op, c->width, c->axis, s->grid.rank,
                     s->grid.dimensions[0], s->grid.dimensions[1], s->grid.dimensions[2],
                     c->direction, c->inclusion, c->smode, i,
                     (unsigned long long)(s->got[i] >> 64), (unsigned long long)s->got[i],
                     (unsigned long long)(s->old[i] >> 64), (unsigned long long)s->old[i]);
}

static unsigned int below(unsigned int n)
{
    return (unsigned int)(device_random() >> 20) % n;
}

enum { SCAN, SPREAD, MULTISPREAD, REDUCE };

static void try_row(struct set *s, const struct row *row, int form, int width)
{
    bool floats = row->letter == 'f', in_place = below(4) == 0;
    struct call call = {.sbit = s->sbit,
                        .axis = below((unsigned)s->grid.rank),
                        .len = (unsigned)width,
                        .s = width == 32 ? 23 : 52,
                        .e = width == 32 ? 8 : 11,
                        .direction = below(2),
                        .inclusion = below(2),
                        .smode = below(3),
                        .mask = below(1u << s->grid.rank)};
    unsigned int length = (unsigned)s->grid.dimensions[call.axis];
    fields_new(s, width);
    call.dest = s->dest;
    call.source = in_place ? s->dest : s->source;
    call.to = below(length);
    call.from = below(length);
    struct scan_case c = {.letter = row->letter,
                          .op = row->op,
                          .width = width,
                          .axis = (int)call.axis,
                          .direction = (int)call.direction,
                          .inclusion = (int)call.inclusion,
                          .smode = (int)call.smode,
                          .context = s->context_bits,
                          .sbit = s->sbits};
    numbers_random(s->numbers, s->grid.count, width, floats);
    numbers_random(s->old, s->grid.count, width, floats);
    if (in_place)
        memcpy(s->numbers, s->old, (size_t)s->grid.count * sizeof *s->old);
    put(s, s->source, row->letter, width, s->numbers);
    put(s, s->dest, row->letter, width, s->old);
    c.source = s->numbers;
    if (call.smode == CM_none)
        call.sbit = CM_no_field;
    switch (form) {
    case SCAN:
        row->scan(&call);
        oracle_scan(&s->grid, &c, s->old);
        compare(s, "scan_with", &c);
        break;
    case SPREAD:
        row->spread(&call);
        oracle_spread(&s->grid, &c, 1u << call.axis, -1, (int)call.from, s->old);
        compare(s, "spread_with", &c);
        break;
    case MULTISPREAD:
        if (!row->multispread)
            break;
        row->multispread(&call);
        oracle_spread(&s->grid, &c, call.mask, -1, 0, s->old);
        compare(s, "multispread_with", &c);
        break;
    default:
        row->reduce(&call);
        oracle_spread(&s->grid, &c, 1u << call.axis, (int)call.to, (int)call.from, s->old);
        compare(s, "reduce_with", &c);
    }
}

/* Two widths for each row, of all kinds of elements taken together. */
static const int widths[ROWS_COUNT][2] = {{33, 7},  {32, 128}, {64, 16},  {65, 32}, {8, 50},
                                          {31, 90}, {1, 48},   {24, 128}, {64, 3},  {32, 64},
                                          {64, 32}, {32, 64},  {64, 32},  {1, 64}};

static void every_operation_is_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{3, 5, 21}, {2, 3, 70}, {7, 1, 17}, {1, 9, 40}};
    for (int k = 0; k < 4; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 4; turn++) {
            set_masks(&s, k % 2 == 0 && turn == 3 ? 1 : 2 * (turn / 2), 3 + (int)below(9));
            for (int r = 0; r < ROWS_COUNT; r++) {
                int form = (r + turn) % 4;
                try_row(&s, &rows[r], SCAN, widths[r][turn % 2]);
                try_row(&s, &rows[r], SCAN, widths[r][turn % 2]);
                try_row(&s, &rows[r], form == REDUCE ? SPREAD : form, widths[r][turn % 2]);
            }
        }
        for (int r = 0; r < ROWS_COUNT; r++) /* all in the same elements */
            if (rows[r].letter != 'f')
                try_row(&s, &rows[r], REDUCE, 17 + r);
        try_row(&s, &rows[9], REDUCE, 64);
        set_free(&s);
    }
}

/* Narrow rows too, which have no repeated columns. */
static void any_rank_of_geometry_is_the_oracles(void **unused)
{
    (void)unused;
    static const struct {
        int rank, dimensions[SCAN_AXES_MAX];
    } shapes[] = {
        {1, {301}}, {2, {19, 33}}, {4, {3, 4, 2, 18}}, {5, {2, 3, 1, 5, 20}}, {3, {5, 30, 3}}};
    static const int some[] = {3, 13}; /* s_add, copy */
    for (int k = 0; k < 5; k++) {
        struct set s = set_new(shapes[k].rank, shapes[k].dimensions);
        for (int turn = 0; turn < 6; turn++) {
            set_masks(&s, turn % 2 ? 2 : 0, 5);
            for (int i = 0; i < 2; i++)
                try_row(&s, &rows[some[i]], turn % 3 == 2 ? SPREAD : SCAN, 32);
        }
        set_free(&s);
    }
}

/* More than one run in each line: along rows, across them, one and sixteen columns at a time. */
static void long_lines_are_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{1, 2, 1300}, {1, 1030, 19}};
    for (int k = 0; k < 2; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 2; turn++) {
            set_masks(&s, turn ? 2 : 1, turn ? 400 : 9);
            for (int r = 0; r < ROWS_COUNT; r++)
                if (rows[r].letter == 'f')
                    try_row(&s, &rows[r], turn ? SCAN : 1 + r % 3, r % 2 ? 32 : 64);
                else if (rows[r].letter == 'b' && strcmp(rows[r].op, "logand") == 0)
                    try_row(&s, &rows[r], SCAN, 32);
        }
        set_free(&s);
    }
}

/* Whole numbers, one line: what goes from run to run, and many chunks of keys. */
static void a_very_long_line_is_right(void **unused)
{
    (void)unused;
    int length = 70001;
    struct set s = set_new(1, &length);
    uint64_t sum = 0, seed = 0;
    for (int turn = 0; turn < 3; turn++) {
        int width = turn == 2 ? 64 : 32;
        uint64_t mask = (uint64_t)oracle_mask(width);
        set_masks(&s, turn == 1 ? 2 : 1, 9000);
        for (int i = 0; i < length; i++)
            s.numbers[i] = device_random() & mask;
        fields_new(&s, width);
        put(&s, s.source, 'u', width, s.numbers);
        CM_scan_with_u_add_1L(s.dest, s.source, 0, (unsigned)width, CM_upward, CM_inclusive,
                              turn ? CM_segment_bit : CM_none, turn ? s.sbit : CM_no_field);
        get(&s, s.dest, 'u', width, s.got);
        sum = 0;
        for (int i = 0; i < length; i++) {
            if (turn && s.sbits[i])
                sum = 0;
            if (!s.context_bits[i])
                continue;
            sum += (uint64_t)s.numbers[i];
            if ((sum & mask) != (uint64_t)s.got[i])
                fail_msg("turn %d, processor %d: got %llx, wanted %llx", turn, i,
                         (unsigned long long)s.got[i], (unsigned long long)(sum & mask));
        }
        CM_scan_with_copy_1L(s.dest, s.source, 0, (unsigned)width, CM_downward, CM_inclusive,
                             CM_segment_bit, s.sbit);
        get(&s, s.dest, 'u', width, s.got);
        bool has = false;
        for (int i = length - 1; i >= 0; i--) {
            if (s.context_bits[i] && !has) {
                seed = (uint64_t)s.numbers[i];
                has = true;
            }
            if (s.context_bits[i] && seed != (uint64_t)s.got[i])
                fail_msg("turn %d, processor %d: copied %llx, wanted %llx", turn, i,
                         (unsigned long long)s.got[i], (unsigned long long)seed);
            if (s.sbits[i])
                has = false;
        }
    }
    set_free(&s);
}

/* ---- ranks ---- */

static void rank_call(const struct set *s, const struct scan_case *c, unsigned int dlen)
{
    unsigned int width = (unsigned)c->width, axis = (unsigned)c->axis,
                 direction = (unsigned)c->direction, smode = (unsigned)c->smode;
    CM_field_id_t sbit = c->smode ? s->sbit : CM_no_field;
    if (c->letter == 'u')
        CM_u_rank_2L(s->dest, s->source, axis, dlen, width, direction, smode, sbit);
    else if (c->letter == 's')
        CM_s_rank_2L(s->dest, s->source, axis, dlen, width, direction, smode, sbit);
    else
        CM_f_rank_2L(s->dest, s->source, axis, dlen, width == 32 ? 23 : 52,
                     width == 32 ? 8 : 11, direction, smode, sbit);
}

static void try_rank(struct set *s, struct scan_case c)
{
    c.op = "rank";
    c.axis = (int)below((unsigned)s->grid.rank);
    c.source = s->numbers;
    c.context = s->context_bits;
    c.sbit = s->sbits;
    numbers_random(s->numbers, s->grid.count, c.width, c.letter == 'f');
    for (int i = 0; i < s->grid.count; i++)
        if (device_random() % 4 == 0) /* equal ones */
            s->numbers[i] = s->numbers[below((unsigned)s->grid.count)];
    fields_new(s, c.width);
    s->dest = CM_allocate_stack_field(20);
    put(s, s->source, c.letter, c.width, s->numbers);
    numbers_random(s->old, s->grid.count, 20, false);
    put(s, s->dest, 'u', 20, s->old);
    rank_call(s, &c, 20);
    oracle_rank(&s->grid, &c, s->old);
    c.letter = 'u';
    c.width = 20;
    compare(s, "rank", &c);
}

static void ranks_are_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{3, 5, 21}, {9, 1, 70}, {1, 80, 17}};
    static const struct scan_case cases[] = {
        {.letter = 'u', .width = 32, .direction = CM_upward, .smode = CM_none},
        {.letter = 'u', .width = 9, .direction = CM_downward, .smode = CM_segment_bit},
        {.letter = 'u', .width = 1, .direction = CM_downward, .smode = CM_none},
        {.letter = 's', .width = 50, .direction = CM_upward, .smode = CM_start_bit},
        {.letter = 's', .width = 128, .direction = CM_downward, .smode = CM_none},
        {.letter = 'f', .width = 32, .direction = CM_upward, .smode = CM_segment_bit},
        {.letter = 'f', .width = 64, .direction = CM_downward, .smode = CM_none},
    };
    for (int k = 0; k < 3; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 3; turn++) {
            set_masks(&s, turn, 4 + (int)below(20));
            for (int i = 0; i < (turn == 1 ? 3 : 7); i++)
                try_rank(&s, cases[i]);
        }
        set_free(&s);
    }
}

static const number *sorted_by;
static int by_number(const void *a, const void *b)
{
    int i = *(const int *)a, j = *(const int *)b;
    if (sorted_by[i] != sorted_by[j])
        return sorted_by[i] < sorted_by[j] ? -1 : 1;
    return i - j;
}

static void ranks_of_a_very_long_line_are_right(void **unused)
{
    (void)unused;
    int length = 100003, *order = malloc((size_t)length * sizeof *order);
    struct set s = set_new(1, &length);
    assert_non_null(order);
    for (int turn = 0; turn < 3; turn++) {
        int width = turn == 1 ? 9 : 32, active = 0;
        set_masks(&s, turn == 2 ? 2 : 1, 1000);
        for (int i = 0; i < length; i++)
            s.numbers[i] = device_random() & (uint64_t)oracle_mask(width);
        fields_new(&s, width);
        s.dest = CM_allocate_stack_field(32);
        put(&s, s.source, 'u', width, s.numbers);
        CM_u_rank_2L(s.dest, s.source, 0, 32, (unsigned)width, CM_upward, CM_none, CM_no_field);
        get(&s, s.dest, 'u', 32, s.got);
        for (int i = 0; i < length; i++)
            if (s.context_bits[i])
                order[active++] = i;
        sorted_by = s.numbers;
        qsort(order, (size_t)active, sizeof *order, by_number);
        for (int i = 0; i < active; i++)
            if (s.got[order[i]] != (number)i)
                fail_msg("turn %d: processor %d has rank %d, wanted %d", turn, order[i],
                         (int)s.got[order[i]], i);
    }
    free(order);
    set_free(&s);
}

/* ---- the others ---- */

static void enumeration_counts_the_active(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    for (int turn = 0; turn < 6; turn++) {
        set_masks(&s, turn % 3, 6);
        struct scan_case c = {.letter = 'u',
                              .op = "add",
                              .width = 17,
                              .axis = turn % 3,
                              .direction = (int)below(2),
                              .inclusion = (int)below(2),
                              .smode = (int)below(3),
                              .source = s.numbers,
                              .context = s.context_bits,
                              .sbit = s.sbits};
        for (int i = 0; i < s.grid.count; i++)
            s.numbers[i] = 1;
        numbers_random(s.old, s.grid.count, 17, false);
        fields_new(&s, 17);
        put(&s, s.dest, 'u', 17, s.old);
        (turn % 2 ? CM_enumerate_1L
                  : CM_enumerate)(s.dest, (unsigned)c.axis, 17, (unsigned)c.direction,
                                  (unsigned)c.inclusion, (unsigned)c.smode, s.sbit);
        oracle_scan(&s.grid, &c, s.old);
        compare(&s, "enumerate", &c);
    }
    set_free(&s);
}

/* Long bit fields, complex numbers, one processor's field, the longest integer. */
static void long_fields_and_complex_numbers_go_in_parts(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    set_masks(&s, 2, 5);
    struct scan_case c = {.letter = 'b',
                          .op = "copy",
                          .axis = 2,
                          .inclusion = CM_inclusive,
                          .smode = CM_segment_bit,
                          .context = s.context_bits,
                          .sbit = s.sbits};
    static const int parts[] = {64, 64, 17};
    number *halves[3], *olds[3];
    fields_new(&s, 145);
    for (int i = 0, offset = 0; i < 3; offset += parts[i++]) {
        halves[i] = numbers_new(s.grid.count);
        olds[i] = numbers_new(s.grid.count);
        numbers_random(halves[i], s.grid.count, parts[i], false);
        numbers_random(olds[i], s.grid.count, parts[i], false);
        put(&s, s.source + (unsigned)offset, 'b', parts[i], halves[i]);
        put(&s, s.dest + (unsigned)offset, 'b', parts[i], olds[i]);
    }
    CM_scan_with_copy_1L(s.dest, s.source, 2, 145, CM_upward, CM_inclusive, CM_segment_bit,
                         s.sbit);
    for (int round = 0; round < 2; round++) {
        for (int i = 0, offset = 0; i < 3; offset += parts[i++]) {
            struct set piece = s;
            c.width = parts[i];
            c.source = halves[i];
            if (round == 0)
                oracle_scan(&s.grid, &c, olds[i]);
            for (int n = 0; round == 1 && n < s.grid.count; n++)
                if (s.context_bits[n])
                    olds[i][n] = halves[i][37];
            piece.dest += (unsigned)offset;
            piece.old = olds[i];
            compare(&piece, "long", &c);
        }
        if (round == 0)
            CM_spread_from_processor_1L(
                s.dest, (unsigned)machine_send_address(paris_machine(), s.id, 37), s.source,
                145);
    }
    c = (struct scan_case){.letter = 'f',
                           .op = "add",
                           .width = 64,
                           .axis = 1,
                           .inclusion = CM_exclusive,
                           .context = s.context_bits,
                           .sbit = s.sbits};
    fields_new(&s, 128);
    for (int i = 0; i < 2; i++) {
        numbers_random(halves[i], s.grid.count, 64, true);
        numbers_random(olds[i], s.grid.count, 64, true);
        put(&s, s.source + 64u * (unsigned)i, 'f', 64, halves[i]);
        put(&s, s.dest + 64u * (unsigned)i, 'f', 64, olds[i]);
    }
    CM_scan_with_c_add_1L(s.dest, s.source, 1, 52, 11, CM_upward, CM_exclusive, CM_none,
                          CM_no_field);
    for (int i = 0; i < 2; i++) {
        struct set piece = s;
        c.source = halves[i];
        oracle_scan(&s.grid, &c, olds[i]);
        piece.dest += 64u * (unsigned)i;
        piece.old = olds[i];
        compare(&piece, "complex", &c);
    }
    unsigned int longest = 0, longest_signed = 0;
    numbers_random(s.numbers, s.grid.count, 70, false);
    fields_new(&s, 70);
    put(&s, s.source, 'u', 70, s.numbers);
    for (int n = 0; n < s.grid.count; n++) {
        number x = s.numbers[n], y = x >> 69 ? ~x & oracle_mask(70) : x;
        for (unsigned int b = 0; s.context_bits[n] && b < 70; b++) {
            longest = x >> b && longest < b + 1 ? b + 1 : longest;
            longest_signed = y >> b && longest_signed < b + 1 ? b + 1 : longest_signed;
        }
    }
    assert_int_equal(CM_global_u_max_u_intlen_1L(s.source, 70), longest);
    assert_int_equal(CM_global_u_max_s_intlen_1L(s.source, 70), longest_signed);
    CM_set_context();
    CM_u_move_zero_1L(s.source, 70);
    assert_int_equal(CM_global_u_max_u_intlen(s.source, 70), 0);
    assert_int_equal(CM_global_u_max_s_intlen(s.source, 70), 0);
    for (int i = 0; i < 3; i++) {
        free(halves[i]);
        free(olds[i]);
    }
    set_free(&s);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    fields_new(&s, 160);
    CM_set_error_handler(device_error_catch);
    for (unsigned int mode = 0; mode < 2; mode++) {
        CM_set_safety_mode(mode);
        CM_scan_with_u_add_1L(s.dest, s.source, 3, 32, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "axis: must be 0..2");
        CM_scan_with_u_add_1L(s.dest, s.source, 1, 32, 2, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "direction: must be");
        CM_scan_with_copy_1L(s.dest, s.source, 1, 32, 0, 2, 0, CM_no_field);
        device_said("CM_scan_with_copy_1L", "inclusion: must be");
        CM_u_rank_2L(s.dest, s.source, 1, 32, 32, 0, 3, s.sbit);
        device_said("CM_u_rank_2L", "smode: must be");
        CM_enumerate_1L(s.dest, 1, 32, 0, 0, 1, CM_no_field);
        device_said("CM_enumerate_1L", "");
        CM_scan_with_u_add_1L(s.dest, s.source, 1, 129, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "length must be");
        CM_u_rank_2L(s.dest, s.source, 1, 0, 32, 0, 0, CM_no_field);
        device_said("CM_u_rank_2L", "length must be");
        CM_spread_with_copy_1L(s.dest, s.source, 1, 8, 5);
        device_said("CM_spread_with_copy_1L", "coordinate: must be 0..4 on axis 1");
        CM_reduce_with_u_add_1L(s.dest, s.source, 2, 8, 21);
        device_said("CM_reduce_with_u_add_1L", "to_coordinate: must be 0..20");
        CM_multispread_with_u_add_1L(s.dest, s.source, 8, 8);
        device_said("CM_multispread_with_u_add_1L", "axis_mask: there are only 3 axes");
        CM_multispread_copy_1L(s.dest, s.source, 9, 8, 0);
        device_said("CM_multispread_copy_1L", "axis_mask: there are only 3 axes");
        CM_multispread_copy_1L(s.dest, s.source, 5, 8, 63);
        device_said("CM_multispread_copy_1L", "multi_coordinate: there is no position 63");
        CM_spread_from_processor_1L(s.dest, 100000, s.source, 8);
        device_said("CM_spread_from_processor_1L", "send_address: there is no processor");
        CM_scan_with_logior_1L(s.dest, s.source, 1, 161, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_logior_1L", "");
        CM_scan_with_logior_1L(s.dest, s.source, 1, 0, 0, 1, 0, CM_no_field); /* nothing */
        assert_true(device_message[0] == 0);
    }
    CM_set_safety_mode(0);
    CM_set_error_handler(NULL);
    set_free(&s);
}

static void multispread_copy_takes_one_position(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    enum { WIDTH = 40 };
    fields_new(&s, WIDTH);
    for (unsigned int mask = 0; mask < 8; mask++) {
        int at[3] = {0}, left, positions = 1;
        for (int axis = 0; axis < 3; axis++)
            positions *= mask >> axis & 1 ? shape[axis] : 1;
        left = (int)below((unsigned)positions);
        unsigned int position = (unsigned)left;
        for (int axis = 2; axis >= 0; axis--)
            if (mask >> axis & 1) {
                at[axis] = left % shape[axis];
                left /= shape[axis];
            }
        numbers_random(s.numbers, s.grid.count, WIDTH, false);
        numbers_random(s.old, s.grid.count, WIDTH, false);
        put(&s, s.source, 'b', WIDTH, s.numbers);
        put(&s, s.dest, 'b', WIDTH, s.old);
        set_masks(&s, 2, 5);
        (mask % 2 ? CM_multispread_copy_1L
                  : CM_multispread_with_copy_1L)(s.dest, s.source, mask, WIDTH, position);
        get(&s, s.dest, 'b', WIDTH, s.got);
        for (int i = 0; i < s.grid.count; i++) {
            int c[3] = {i / (5 * 21), i / 21 % 5, i % 21};
            for (int axis = 0; axis < 3; axis++)
                c[axis] = mask >> axis & 1 ? at[axis] : c[axis];
            number wanted =
                s.context_bits[i] ? s.numbers[(c[0] * 5 + c[1]) * 21 + c[2]] : s.old[i];
            if (s.got[i] != wanted)
                fail_msg("mask %u, position %u, processor %d: got %llx, wanted %llx", mask,
                         position, i, (unsigned long long)s.got[i], (unsigned long long)wanted);
        }
    }
    set_free(&s);
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    device_seed(3);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_is_the_oracles),
        cmocka_unit_test(any_rank_of_geometry_is_the_oracles),
        cmocka_unit_test(long_lines_are_the_oracles),
        cmocka_unit_test(a_very_long_line_is_right),
        cmocka_unit_test(ranks_are_the_oracles),
        cmocka_unit_test(ranks_of_a_very_long_line_are_right),
        cmocka_unit_test(enumeration_counts_the_active),
        cmocka_unit_test(multispread_copy_takes_one_position),
        cmocka_unit_test(long_fields_and_complex_numbers_go_in_parts),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
