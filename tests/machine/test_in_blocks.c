/* test_in_blocks.c - whole instructions on VP sets in blocks (LUTETIA_BLOCKS): reading and
 * writing, reductions, scans, spreads, ranks, sends and gets have the bits of one piece, and
 * put no array together.
 *
 * Programs are random. A program's numbers follow from its seed alone, so all machines run the
 * same one, and each step leaves a sum of what it found. The twin is the machine with one
 * block. */
#include "machine_inside.h"
#include "machine_told.h"
#include "support.h"

static uint64_t samples = 6; /* programs for each form: the argument */

enum { FOUND = 4, STEPS = 90, TYPES = 9, FIELDS = 2, MOST = 4096, OTHERS = 2 };

static const struct form {
    int rank, lengths[3];
    const char *ghosts;
} forms[] = {
    {2, {56, 40}, "16"},                       /* blocks lower than their ghosts in seven */
    {2, {37, 67}, "3"},    {2, {5, 300}, "8"}, /* empty blocks */
    {2, {64, 1}, "2"},     {2, {2, 33}, "8"},  {3, {21, 6, 19}, "2"},
    {3, {9, 1, 128}, "4"}, {1, {997}, "16"},
};
enum { FORMS = sizeof forms / sizeof *forms };

/* That messages go to, and come from: one in blocks, and one that is never cut. */
static const struct form other_forms[OTHERS] = {{2, {23, 31}, NULL}, {2, {1, 40}, NULL}};

/* A VP set, and its fields of each type. */
struct other {
    int set;
    uint64_t count;
    uint32_t fields[TYPES];
};

struct trial {
    struct machine *m;
    const struct form *form;
    uint64_t random, count;
    int set;
    uint32_t fields[TYPES][FIELDS], addresses;
    struct other others[OTHERS];
    uint64_t found[STEPS + 1];
    const char *what[STEPS + 1];
    struct machine_blocks blocks;
    unsigned char in[MOST * 16], out[MOST * 16];
};

static struct machine_type type_of(int t)
{
    const struct machine_type types[TYPES] = {
        MACHINE_BIT,       MACHINE_UINT(5),  MACHINE_UINT(16),
        MACHINE_UINT(32),  MACHINE_UINT(33), MACHINE_UINT(64),
        MACHINE_UINT(100), MACHINE_F32,      MACHINE_F64};
    return types[t];
}

static uint64_t draw(struct trial *p, uint64_t limit)
{
    p->random = p->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (p->random >> 33) % limit;
}

static uint64_t sum_of(const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    uint64_t sum = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < count; i++)
        sum = (sum ^ at[i]) * UINT64_C(0x100000001b3);
    return sum;
}

static struct machine_value *of_field(struct trial *p, int t)
{
    return support_value(p->m, p->fields[t][draw(p, FIELDS)], type_of(t));
}

static struct machine_value *bit_of(struct trial *p)
{
    return of_field(p, 0);
}

static void store(struct trial *p, int t, struct machine_value *v)
{
    if (!v)
        fail_msg("%s", machine_error(p->m));
    assert_ok(machine_field_store(p->m, p->fields[t][draw(p, FIELDS)], v, MACHINE_WHERE_ACTIVE),
              p->m);
}

/* ---- steps: each returns a sum of what it found ---- */

static uint64_t upload(struct trial *p, int t)
{
    const struct machine_type type = type_of(t);
    const uint64_t seed = draw(p, 1000);
    for (uint64_t n = 0; n < p->count; n++)
        support_element_set(p->in, type, n, support_word(type, seed, n));
    assert_ok(machine_field_upload(p->m, p->fields[t][draw(p, FIELDS)], type, p->in), p->m);
    return 0;
}

static uint64_t found_in(struct trial *p, int t, uint64_t field)
{
    assert_ok(machine_field_download(p->m, p->fields[t][field], type_of(t), p->out), p->m);
    return sum_of(p->out, p->count * machine_element_bytes(type_of(t)));
}

static uint64_t download(struct trial *p, int t)
{
    return found_in(p, t, draw(p, FIELDS));
}

static struct machine_block block_of(struct trial *p)
{
    const struct form *f = p->form;
    const int width = f->lengths[f->rank - 1];
    const uint64_t rows = p->count / (uint64_t)width;
    struct machine_block b = {.row = draw(p, rows), .column = (int)draw(p, (uint64_t)width)};
    b.rows = 1 + draw(p, rows - b.row);
    b.columns = 1 + (int)draw(p, (uint64_t)(width - b.column));
    return b;
}

static uint64_t block_upload(struct trial *p, int t)
{
    const struct machine_block b = block_of(p);
    const size_t pitch = ((size_t)b.columns + 2) * machine_element_bytes(type_of(t));
    for (uint64_t n = 0; n < b.rows * ((uint64_t)b.columns + 2); n++)
        support_element_set(p->in, type_of(t), n, support_word(type_of(t), 77, n));
    assert_ok(
        machine_block_upload(p->m, p->fields[t][draw(p, FIELDS)], type_of(t), &b, p->in, pitch),
        p->m);
    return 0;
}

static uint64_t block_download(struct trial *p, int t)
{
    const struct machine_block b = block_of(p);
    const size_t pitch = (size_t)b.columns * machine_element_bytes(type_of(t));
    assert_ok(machine_block_download(p->m, p->fields[t][draw(p, FIELDS)], type_of(t), &b,
                                     p->out, pitch),
              p->m);
    return sum_of(p->out, b.rows * pitch);
}

static uint64_t read_one(struct trial *p, int t)
{
    struct machine_scalar x;
    assert_ok(machine_field_read(p->m, p->fields[t][draw(p, FIELDS)], type_of(t),
                                 draw(p, p->count), &x),
              p->m);
    return sum_of(&x, sizeof x);
}

static uint64_t write_one(struct trial *p, int t)
{
    const uint64_t index = draw(p, p->count);
    const struct machine_scalar x = support_scalar(support_word(type_of(t), 5, index));
    assert_ok(machine_field_write(p->m, p->fields[t][draw(p, FIELDS)], type_of(t), index, x),
              p->m);
    return 0;
}

/* From neighbours: ghosts are looked at. */
static uint64_t compute(struct trial *p, int t)
{
    const int axis = (int)draw(p, (uint64_t)p->form->rank), step = draw(p, 2) ? 1 : -1;
    struct machine_value *a = machine_shift(p->m, of_field(p, t), axis, step),
                         *b = of_field(p, t);
    store(p, t,
          machine_binary(p->m, type_of(t).kind == MACHINE_FLOAT ? MACHINE_FADD : MACHINE_ADD, a,
                         b));
    assert_ok(machine_flush(p->m), p->m);
    return 0;
}

static uint64_t put(struct trial *p, int t)
{
    const struct machine_scalar x = support_scalar(support_word(type_of(t), 9, draw(p, 99)));
    store(p, t, machine_constant(p->m, type_of(t), x));
    return 0;
}

static uint64_t context(struct trial *p, int t)
{
    (void)t;
    struct machine_value *one =
        machine_constant(p->m, MACHINE_BIT, (struct machine_scalar){1, 0});
    assert_ok(machine_flag_store(p->m, MACHINE_CONTEXT, draw(p, 3) ? bit_of(p) : one,
                                 MACHINE_EVERYWHERE),
              p->m);
    return 0;
}

static uint64_t reduce(struct trial *p, int t)
{
    struct machine_scalar x;
    const bool is_float = type_of(t).kind == MACHINE_FLOAT;
    const int op =
        is_float ? MACHINE_REDUCE_FADD + (int)draw(p, 3) : (int)draw(p, MACHINE_REDUCE_FADD);
    struct machine_value *v = of_field(p, t);
    if (t == 1 || t == 2) /* short ones, made longer */
        v = machine_resize(p->m, v, 32, op == MACHINE_REDUCE_SMIN || op == MACHINE_REDUCE_ADD);
    assert_ok(machine_reduce(p->m, (enum machine_reduction)op, v, &x), p->m);
    return sum_of(&x, sizeof x);
}

static int scan_op(struct trial *p, int t, int from)
{
    return type_of(t).kind == MACHINE_FLOAT
               ? MACHINE_SCAN_FADD + (int)draw(p, 4)
               : from + (int)draw(p, (uint64_t)(MACHINE_SCAN_FADD - from));
}

static struct machine_scan scan_of(struct trial *p, int t)
{
    struct machine_scan how = {.op = (enum machine_scan_op)scan_op(p, t, MACHINE_SCAN_COPY),
                               .axis = (int)draw(p, (uint64_t)p->form->rank),
                               .downward = draw(p, 2),
                               .exclusive = draw(p, 2),
                               .segments = (enum machine_segments)draw(p, 3)};
    how.bits = how.segments == MACHINE_UNSEGMENTED ? NULL : bit_of(p);
    return how;
}

static uint64_t scan(struct trial *p, int t)
{
    const struct machine_scan how = scan_of(p, t);
    store(p, t, machine_scan(p->m, &how, of_field(p, t)));
    return 0;
}

static uint64_t spread(struct trial *p, int t)
{
    const uint32_t axes = 1 + (uint32_t)draw(p, (UINT64_C(1) << p->form->rank) - 1);
    const enum machine_scan_op op = (enum machine_scan_op)scan_op(p, t, MACHINE_SCAN_AND);
    store(p, t, machine_spread(p->m, op, axes, of_field(p, t)));
    return 0;
}

static uint64_t spread_coordinate(struct trial *p, int t)
{
    const int axis = (int)draw(p, (uint64_t)p->form->rank),
              at = (int)draw(p, (uint64_t)p->form->lengths[axis]);
    store(p, t, machine_spread_coordinate(p->m, axis, at, of_field(p, t)));
    return 0;
}

static uint64_t spread_index(struct trial *p, int t)
{
    const uint64_t index = draw(p, p->count);
    store(p, t, machine_spread_index(p->m, index, of_field(p, t)));
    return 0;
}

static uint64_t rank(struct trial *p, int t)
{
    const struct machine_scan how = scan_of(p, t);
    store(p, 3,
          machine_rank(p->m, how.axis, how.downward,
                       draw(p, 2) && type_of(t).kind != MACHINE_FLOAT, how.segments, how.bits,
                       of_field(p, t)));
    return 0;
}

static uint64_t enumerate(struct trial *p, int t)
{
    struct machine_scan how = scan_of(p, t);
    how.op = MACHINE_SCAN_ADD;
    assert_ok(machine_enumerate(p->m, &how, p->fields[3][0], 32), p->m);
    return 0;
}

/* ---- messages ---- */

/* A field of some set, and whose it is: its own set's, or another's. */
static struct other partner(struct trial *p, int t)
{
    const uint64_t k = draw(p, OTHERS + 2);
    struct other own = {p->set, p->count, {0}};
    own.fields[t] = p->fields[t][draw(p, FIELDS)];
    return k < OTHERS ? p->others[k] : own;
}

/* Of processors of that set, many of them of few; some of none. */
static struct machine_value *addresses_of(struct trial *p, const struct other *o)
{
    const uint64_t few = 1 + draw(p, o->count), beyond = draw(p, 2) ? draw(p, 5) : 0,
                   turn = draw(p, 2);
    for (uint64_t n = 0; n < p->count; n++) {
        const bool nowhere = draw(p, 50) < beyond;
        support_element_set(p->in, MACHINE_UINT(32), n,
                            nowhere ? UINT32_MAX - draw(p, 9)
                                    : machine_send_address(p->m, o->set, draw(p, few)) ^ turn);
    }
    assert_ok(machine_field_upload(p->m, p->addresses, MACHINE_UINT(32), p->in), p->m);
    struct machine_value *address = support_value(p->m, p->addresses, MACHINE_UINT(32)),
                         *one = machine_constant(p->m, MACHINE_UINT(32),
                                                 (struct machine_scalar){1, 0});
    return turn ? machine_binary(p->m, MACHINE_XOR, address, one) : address;
}

static uint64_t found_there(struct trial *p, const struct other *o, int t)
{
    assert_ok(machine_field_download(p->m, o->fields[t], type_of(t), p->out), p->m);
    return sum_of(p->out, o->count * machine_element_bytes(type_of(t)));
}

static enum machine_combiner combiner_of(struct trial *p, int t)
{
    if (!draw(p, 3))
        return MACHINE_COMBINE_OVERWRITE;
    return (enum machine_combiner)(
        type_of(t).kind == MACHINE_FLOAT
            ? MACHINE_COMBINE_FADD + (int)draw(p, 3)
            : MACHINE_COMBINE_AND + (int)draw(p, MACHINE_COMBINE_FADD - MACHINE_COMBINE_AND));
}

static uint64_t send(struct trial *p, int t)
{
    const struct other to = partner(p, t);
    const enum machine_combiner combiner = combiner_of(p, t);
    struct machine_value *address = addresses_of(p, &to), *source = of_field(p, t);
    const uint32_t bits = to.set == p->set ? p->fields[0][0] : to.fields[0],
                   notify = draw(p, 2) && t ? bits : MACHINE_NO_FIELD;
    if (!draw(p, 4))
        source =
            machine_constant(p->m, type_of(t), support_scalar(support_word(type_of(t), 3, 3)));
    assert_ok(machine_send(p->m, to.fields[t], address, source, combiner, notify), p->m);
    return found_there(p, &to, t) + machine_sent_beyond(p->m);
}

static uint64_t get(struct trial *p, int t)
{
    const struct other from = partner(p, t);
    store(p, t, machine_get(p->m, addresses_of(p, &from), from.fields[t], type_of(t)));
    return 0;
}

static uint64_t check(struct trial *p, int t)
{
    const struct other to = partner(p, t);
    uint64_t wrong;
    assert_ok(machine_addresses_check(p->m, addresses_of(p, &to), to.set, &wrong), p->m);
    return wrong;
}

static const struct step {
    const char *name;
    uint64_t (*take)(struct trial *p, int t);
} steps[] = {
    {"upload", upload},
    {"upload of a block", block_upload},
    {"write", write_one},
    {"number", put},
    {"download", download},
    {"download of a block", block_download},
    {"read", read_one},
    {"neighbours", compute},
    {"neighbours", compute},
    {"context", context},
    {"reduction", reduce},
    {"reduction", reduce},
    {"scan", scan},
    {"scan", scan},
    {"spread", spread},
    {"spread of a coordinate", spread_coordinate},
    {"spread of a processor", spread_index},
    {"rank", rank},
    {"enumeration", enumerate},
    {"send", send},
    {"send", send},
    {"get", get},
    {"get", get},
    {"check of addresses", check},
};
enum { KINDS = sizeof steps / sizeof *steps };

/* ---- programs ---- */

static struct machine *machine_of(const char *blocks, const char *ghosts)
{
    setenv("LUTETIA_BLOCKS", blocks, 1);
    setenv("LUTETIA_BLOCKS_FROM", "2", 1);
    setenv("LUTETIA_GHOSTS", ghosts, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_BLOCKS");
    unsetenv("LUTETIA_BLOCKS_FROM");
    unsetenv("LUTETIA_GHOSTS");
    return m;
}

static void begin(struct trial *p)
{
    p->count = 1;
    for (int axis = 0; axis < p->form->rank; axis++)
        p->count *= (uint64_t)p->form->lengths[axis];
    assert_true(p->count <= MOST);
    p->set = machine_vpset_create(p->m, p->form->lengths, p->form->rank);
    assert_ok(machine_vpset_select(p->m, p->set), p->m);
    for (int t = 0; t < TYPES; t++)
        for (int k = 0; k < FIELDS; k++)
            p->fields[t][k] = support_field(p->m, type_of(t), (uint64_t)(10 * t + k));
    p->addresses = machine_field_allocate(p->m, p->set, 32, MACHINE_HEAP);
    for (int k = 0; k < OTHERS; k++) {
        struct other *o = &p->others[k];
        o->set = machine_vpset_create(p->m, other_forms[k].lengths, other_forms[k].rank);
        o->count = machine_vpset_count(p->m, o->set);
        assert_ok(machine_vpset_select(p->m, o->set), p->m);
        for (int t = 0; t < TYPES; t++)
            o->fields[t] = support_field(p->m, type_of(t), (uint64_t)(10 * t + 7));
    }
    assert_ok(machine_vpset_select(p->m, p->set), p->m);
}

/* All steps, and at the end all fields. */
static void program_run(struct trial *p, const char *blocks, const struct form *form,
                        uint64_t seed)
{
    p->form = form;
    p->random = seed;
    p->found[STEPS] = 0;
    p->m = machine_of(blocks, form->ghosts);
    begin(p);
    for (int i = 0; i < STEPS; i++) {
        const struct step *s = &steps[draw(p, KINDS)];
        machine_begin(p->m);
        p->what[i] = s->name;
        p->found[i] = s->take(p, (int)draw(p, TYPES));
    }
    p->what[STEPS] = "all fields";
    for (int t = 0; t < TYPES; t++)
        for (uint64_t k = 0; k < FIELDS; k++)
            p->found[STEPS] = p->found[STEPS] * 31 + found_in(p, t, k);
    for (int t = 0; t < TYPES; t++)
        for (int k = 0; k < OTHERS; k++)
            p->found[STEPS] = p->found[STEPS] * 31 + found_there(p, &p->others[k], t);
    p->blocks = machine_blocks(p->m);
    machine_destroy(p->m);
}

/* The front end does not look into the device's memory. */
static bool is_far(void)
{
    const char *near = getenv("LUTETIA_NEAR");
    return near && *near == '0';
}

static void compare(const struct trial *one, const struct trial *p, const char *blocks,
                    int form, uint64_t seed)
{
    for (int i = 0; i <= STEPS; i++)
        if (p->found[i] != one->found[i])
            fail_msg("form %d, seed %llu, %s blocks: step %d (%s) found something else", form,
                     (unsigned long long)seed, blocks, i, p->what[i]);
    assert_true(p->blocks.run > 0);
    /* what waits to be computed must look no further than there are ghosts */
    if (p->form->rank > 1 && atoi(p->form->ghosts) >= 8 && p->blocks.gathered && !is_far())
        fail_msg("form %d, seed %llu, %s blocks: %llu arrays were put together", form,
                 (unsigned long long)seed, blocks, (unsigned long long)p->blocks.gathered);
}

static void whole_instructions_have_the_bits_of_one_piece(void **state)
{
    (void)state;
    static const char *const counts[] = {"2", "3", "4", "7"};
    struct trial *one = malloc(sizeof *one), *p = malloc(sizeof *p);
    assert_true(one && p);
    for (int form = 0; form < FORMS; form++)
        for (uint64_t seed = 1; seed <= samples; seed++) {
            program_run(one, "1", &forms[form], seed);
            assert_int_equal(one->blocks.run, 0);
            for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
                program_run(p, counts[k], &forms[form], seed);
                compare(one, p, counts[k], form, seed);
            }
        }
    free(one);
    free(p);
}

/* ---- long rows ---- */

static const char *const long_counts[] = {"1", "2", "3", "7"};

static void floats_upload(struct machine *m, uint32_t field, size_t count)
{
    float *x = malloc(count * sizeof *x);
    assert_non_null(x);
    for (size_t i = 0; i < count; i++)
        x[i] = (float)(i % 1013) * 0.3f + 1e5f / (float)(i + 1);
    assert_ok(machine_field_upload(m, field, MACHINE_F32, x), m);
    free(x);
}

/* Rows, and a single row, longer than a run of a reduction (4,096) and of a scan (512). */
static void long_runs_of_floats_are_added_in_one_order(void **state)
{
    (void)state;
    static const struct form longs[] = {
        {2, {1100, 9}, "4"}, {2, {11, 9000}, "2"}, {1, {65536}, "16"}};
    for (int form = 0; form < 3; form++) {
        uint64_t found[4][3];
        for (int k = 0; k < 4; k++) {
            struct machine *m = machine_of(long_counts[k], longs[form].ghosts);
            const int set = machine_vpset_create(m, longs[form].lengths, longs[form].rank);
            struct machine_scalar sum, below;
            const struct machine_scan how = {.op = MACHINE_SCAN_FADD, .downward = form == 2};
            assert_ok(machine_vpset_select(m, set), m);
            const uint32_t a = support_field(m, MACHINE_F32, 3),
                           b = machine_field_allocate(m, set, 32, MACHINE_HEAP);
            const size_t count = machine_vpset_count(m, set);
            float *out = malloc(count * sizeof *out);
            assert_non_null(out);
            floats_upload(m, a, count);
            machine_begin(m);
            assert_ok(
                machine_reduce(m, MACHINE_REDUCE_FADD, support_value(m, a, MACHINE_F32), &sum),
                m);
            machine_begin(m);
            assert_ok(machine_field_store(
                          m, b, machine_scan(m, &how, support_value(m, a, MACHINE_F32)),
                          MACHINE_EVERYWHERE),
                      m);
            assert_ok(machine_reduce(m, MACHINE_REDUCE_FADD, support_value(m, b, MACHINE_F32),
                                     &below),
                      m);
            assert_ok(machine_field_download(m, b, MACHINE_F32, out), m);
            found[k][0] = sum.lo;
            found[k][1] = below.lo;
            found[k][2] = sum_of(out, count * sizeof *out);
            assert_true(machine_blocks(m).gathered == 0 || is_far());
            free(out);
            machine_destroy(m);
            assert_memory_equal(found[k], found[0], sizeof found[0]);
        }
    }
}

/* Rows of several of the router's blocks; hundreds of floats to one processor. */
static void many_messages_have_one_order(void **state)
{
    (void)state;
    static const struct form longs[] = {{2, {11, 9000}, "2"}, {1, {65536}, "16"}};
    for (int form = 0; form < 2; form++) {
        uint64_t found[4][FOUND];
        for (int k = 0; k < 4; k++) {
            struct machine *m = machine_of(long_counts[k], longs[form].ghosts);
            const int set = machine_vpset_create(m, longs[form].lengths, longs[form].rank);
            assert_ok(machine_vpset_select(m, set), m);
            const uint32_t source = support_field(m, MACHINE_F32, 3),
                           to[FOUND - 1] = {support_field(m, MACHINE_F32, 4),
                                            support_field(m, MACHINE_F32, 5),
                                            support_field(m, MACHINE_F32, 6)},
                           at = machine_field_allocate(m, set, 32, MACHINE_HEAP);
            const uint64_t count = machine_vpset_count(m, set);
            uint32_t *out = malloc(count * sizeof *out);
            assert_non_null(out);
            floats_upload(m, source, count);
            for (uint64_t n = 0; n < count; n++)
                out[n] = (uint32_t)machine_send_address(
                    m, set, n * UINT64_C(2654435761) % 100003 * 977 % (count / 300) * 299);
            assert_ok(machine_field_upload(m, at, MACHINE_UINT(32), out), m);
            for (int i = 0; i < FOUND - 1; i++) {
                machine_begin(m);
                struct machine_value *a = support_value(m, at, MACHINE_UINT(32));
                assert_ok(
                    i == 2
                        ? machine_field_store(m, to[2], machine_get(m, a, to[0], MACHINE_F32),
                                              MACHINE_EVERYWHERE)
                        : machine_send(m, to[i], a, support_value(m, source, MACHINE_F32),
                                       i ? MACHINE_COMBINE_OVERWRITE : MACHINE_COMBINE_FADD,
                                       MACHINE_NO_FIELD),
                    m);
                assert_ok(machine_field_download(m, to[i], MACHINE_F32, out), m);
                found[k][i] = sum_of(out, count * sizeof *out);
            }
            found[k][FOUND - 1] =
                machine_sent_beyond(m) + machine_blocks(m).gathered * !is_far();
            assert_true((machine_blocks(m).run > 0) == (k > 0) || is_far());
            free(out);
            machine_destroy(m);
            assert_memory_equal(found[k], found[0], sizeof found[0]);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1)
        samples = (uint64_t)atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_instructions_have_the_bits_of_one_piece),
        cmocka_unit_test(long_runs_of_floats_are_added_in_one_order),
        cmocka_unit_test(many_messages_have_one_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
