/* test_router.c - sends, gets and combinations against plain loops, over random geometries of
 * both orders, addresses that collide or lead nowhere, and contexts. */
#include "support.h"

#include "sample.h"

enum { PROCESSORS = 16, ROUNDS = 8 };

static struct machine *machine;
static uint64_t state;

static uint64_t next(uint64_t below)
{
    return sample_linear(&state) % below;
}

/* ---- geometries ---- */

struct set {
    int id;
    uint64_t count, ratio;
    enum machine_order order;
};

static struct set set_make(int rank, enum machine_order order)
{
    static const int most[] = {150, 12, 6, 4, 3};
    int lengths[5];
    struct set s = {.count = 1, .order = order};
    bool powers = next(2);

    for (int axis = 0; axis < rank; axis++) {
        lengths[axis] = 1 + (int)next((uint64_t)most[rank - 1]);
        if (powers) /* then processors have subgrids */
            lengths[axis] = 1 << (31 - __builtin_clz((unsigned int)lengths[axis]));
        s.count *= (uint64_t)lengths[axis];
    }
    s.ratio = (s.count + PROCESSORS - 1) / PROCESSORS;
    s.id = machine_vpset_create_ordered(machine, lengths, rank, order);
    assert_true(s.id > 0);
    return s;
}

static uint64_t address_of(const struct set *s, uint64_t n)
{
    return machine_send_address(machine, s->id, n); /* test_subgrids.c checks these addresses */
}

static void arrange(int set, const int *lengths, int rank, enum machine_order order)
{
    struct machine_layout l;
    const uint8_t o = (uint8_t)order, orders[3] = {o, o, o};
    machine_layout_make(&l, lengths, NULL, orders, rank, PROCESSORS);
    assert_ok(machine_vpset_arrange(machine, set, lengths, rank, &l), machine);
}

/* UINT64_MAX: the address has no VP. */
static uint64_t index_of(const struct set *s, uint64_t address)
{
    for (uint64_t n = 0; n < s->count; n++)
        if (address_of(s, n) == address)
            return n;
    return UINT64_MAX;
}

/* ---- what combinations are ---- */

static wide combined(enum machine_combiner c, struct machine_type type, wide a, wide b)
{
    static const enum op ops[] = {
        [MACHINE_COMBINE_AND] = OP_AND,  [MACHINE_COMBINE_OR] = OP_IOR,
        [MACHINE_COMBINE_XOR] = OP_XOR,  [MACHINE_COMBINE_ADD] = OP_ADD,
        [MACHINE_COMBINE_UMIN] = OP_MIN, [MACHINE_COMBINE_UMAX] = OP_MAX,
        [MACHINE_COMBINE_SMIN] = OP_MIN, [MACHINE_COMBINE_SMAX] = OP_MAX,
        [MACHINE_COMBINE_FADD] = OP_ADD, [MACHINE_COMBINE_FMIN] = OP_MIN,
        [MACHINE_COMBINE_FMAX] = OP_MAX};
    bool is_signed = c == MACHINE_COMBINE_SMIN || c == MACHINE_COMBINE_SMAX, overflows;

    if (c == MACHINE_COMBINE_OVERWRITE)
        return b;
    if (type.kind == MACHINE_FLOAT)
        return number_float(ops[c], type.width, (uint64_t)a, (uint64_t)b, &overflows);
    if (is_signed) {
        a = (wide)wide_signed(a, type.width);
        b = (wide)wide_signed(b, type.width);
    }
    return number_integer(ops[c], is_signed, a, b, type.width, &overflows);
}

static const struct {
    struct machine_type type;
    enum machine_combiner combiner;
} cases[] = {
    {MACHINE_UINT(1), MACHINE_COMBINE_OVERWRITE},

    {MACHINE_UINT(32), MACHINE_COMBINE_OVERWRITE},

    {MACHINE_UINT(80), MACHINE_COMBINE_OVERWRITE}, {MACHINE_F32, MACHINE_COMBINE_OVERWRITE},
    {MACHINE_UINT(32), MACHINE_COMBINE_AND},       {MACHINE_UINT(32), MACHINE_COMBINE_OR},
    {MACHINE_UINT(32), MACHINE_COMBINE_XOR},       {MACHINE_UINT(32), MACHINE_COMBINE_ADD},
    {MACHINE_UINT(27), MACHINE_COMBINE_ADD},       {MACHINE_UINT(32), MACHINE_COMBINE_UMIN},
    {MACHINE_UINT(19), MACHINE_COMBINE_UMAX},      {MACHINE_UINT(27), MACHINE_COMBINE_SMIN},
    {MACHINE_UINT(32), MACHINE_COMBINE_SMAX},      {MACHINE_UINT(1), MACHINE_COMBINE_OR},
    {MACHINE_UINT(1), MACHINE_COMBINE_ADD},        {MACHINE_UINT(61), MACHINE_COMBINE_ADD},
    {MACHINE_UINT(64), MACHINE_COMBINE_SMIN},      {MACHINE_UINT(100), MACHINE_COMBINE_ADD},
    {MACHINE_UINT(128), MACHINE_COMBINE_SMAX},     {MACHINE_UINT(90), MACHINE_COMBINE_UMIN},
    {MACHINE_F32, MACHINE_COMBINE_FADD},           {MACHINE_F64, MACHINE_COMBINE_FADD},
    {MACHINE_F32, MACHINE_COMBINE_FMIN},           {MACHINE_F64, MACHINE_COMBINE_FMAX},
};
enum { CASES = sizeof cases / sizeof *cases };

/* ---- fields ---- */

static uint32_t field_of(const struct set *s, struct machine_type type, const wide *x)
{
    uint32_t f = machine_field_allocate(machine, s->id, type.width, MACHINE_STACK);
    unsigned char *dense = malloc(s->count * machine_element_bytes(type));

    for (uint64_t n = 0; n < s->count; n++)
        support_element_set(dense, type, n, x[n]);
    assert_ok(machine_field_upload(machine, f, type, dense), machine);
    free(dense);
    return f;
}

static void field_is(const struct set *s, uint32_t f, struct machine_type type, const wide *x,
                     const bool *where, const char *what, int which)
{
    unsigned char *dense = malloc(s->count * machine_element_bytes(type));

    assert_ok(machine_field_download(machine, f, type, dense), machine);
    for (uint64_t n = 0; n < s->count; n++) {
        wide got = support_element(dense, type, n);
        if ((!where || where[n]) && got != x[n])
            fail_msg("%s, case %d, width %d: processor %d of %d has %llx, not %llx", what,
                     which, type.width, (int)n, (int)s->count, (unsigned long long)got,
                     (unsigned long long)x[n]);
    }
    free(dense);
}

static void numbers(wide *x, uint64_t count, struct machine_type type)
{
    uint64_t seed = next(1000000);

    for (uint64_t n = 0; n < count; n++)
        x[n] = support_word(type, seed, n);
}

struct scene {
    struct set from, to;
    wide address[1024];
    uint64_t where[1024]; /* indices that the addresses mean */
    bool active[1024];
    uint32_t address_field;
    int width;
};

/* One of at least and at most so many processors. */
static struct set set_between(int rank, enum machine_order order, uint64_t least, uint64_t most)
{
    for (;;) {
        struct set s = set_make(rank, order);
        if (s.count >= least && s.count <= most)
            return s;
        assert_ok(machine_vpset_destroy(machine, s.id), machine);
    }
}

/* few_get: many send to few. */
static void scene_make(struct scene *c, int round, bool few_get)
{
    wide context[1024];

    machine_begin(machine);
    c->from = set_between(1 + round % 5, round & 1, few_get ? 60 : 1, 1024);
    c->to = few_get ? set_between(1 + (round + 2) % 3, round >> 1 & 1, 1, c->from.count / 16)
            : round % 3 ? set_make(1 + (round + 2) % 5, round >> 1 & 1)
                        : c->from;
    c->width = machine_address_bits(machine, c->to.id);
    for (uint64_t n = 0; n < c->from.count; n++) {
        uint64_t some = next(c->to.count), few = next(3) * c->to.count / 3;
        c->address[n] = next(12) == 0 ? next(UINT64_C(1) << c->width)
                                      : address_of(&c->to, next(3) ? some : few);
        if (round % 2)
            c->address[n] |= (wide)next(8) << c->width; /* bits above the address's width */
        c->where[n] =
            index_of(&c->to, (uint64_t)c->address[n] & ((UINT64_C(1) << c->width) - 1));
        c->active[n] = round % 4 == 3 || next(3) > 0;
        context[n] = c->active[n];
    }
    assert_ok(machine_vpset_select(machine, c->from.id), machine);
    c->address_field = field_of(&c->from, MACHINE_UINT(32), c->address);
    uint32_t bit = field_of(&c->from, MACHINE_BIT, context);
    struct machine_value *v =
        machine_field_value(machine, bit, MACHINE_BIT, MACHINE_EVERYWHERE);
    if (round % 4 != 3)
        assert_ok(machine_flag_store(machine, MACHINE_CONTEXT, v, MACHINE_EVERYWHERE), machine);
}

static void send_case(const struct scene *c, int which)
{
    struct machine_type type = cases[which].type;
    wide source[1024], dest[1024], told[1024] = {0};
    machine_begin(machine);
    numbers(source, c->from.count, type);
    numbers(dest, c->to.count, type);
    uint32_t s = field_of(&c->from, type, source), d = field_of(&c->to, type, dest);
    uint32_t notify = machine_field_allocate(machine, c->to.id, 1, MACHINE_STACK);
    struct machine_value *address =
        machine_field_value(machine, c->address_field, MACHINE_UINT(32), MACHINE_WHERE_ACTIVE);
    struct machine_value *v = machine_field_value(machine, s, type, MACHINE_WHERE_ACTIVE);

    assert_ok(machine_send(machine, d, address, v, cases[which].combiner,
                           which % 2 ? notify : MACHINE_NO_FIELD),
              machine);
    for (uint64_t n = 0; n < c->from.count; n++)
        if (c->active[n] && c->where[n] != UINT64_MAX) {
            uint64_t at = c->where[n];
            dest[at] = combined(cases[which].combiner, type, dest[at], source[n]);
            told[at] = 1;
        }
    field_is(&c->to, d, type, dest, NULL, "send", which);
    if (which % 2)
        field_is(&c->to, notify, MACHINE_BIT, told, NULL, "notification", which);
}

static void get_case(const struct scene *c, int which)
{
    struct machine_type type = cases[which].type;
    wide source[1024], got[1024];
    machine_begin(machine);
    numbers(source, c->to.count, type);
    uint32_t s = field_of(&c->to, type, source);
    uint32_t d = machine_field_allocate(machine, c->from.id, type.width, MACHINE_STACK);
    struct machine_value *address =
        machine_field_value(machine, c->address_field, MACHINE_UINT(32), MACHINE_WHERE_ACTIVE);
    struct machine_value *v = machine_get(machine, address, s, type);

    if (!v)
        fail_msg("get: %s", machine_error(machine));
    assert_ok(machine_field_store(machine, d, v, MACHINE_EVERYWHERE), machine);
    for (uint64_t n = 0; n < c->from.count; n++)
        got[n] = c->where[n] == UINT64_MAX ? 0 : source[c->where[n]];
    field_is(&c->from, d, type, got, c->active, "get", which);
}

static void messages_arrive(bool few_get, int rounds)
{
    for (int round = 0; round < rounds; round++) {
        struct scene *c = calloc(1, sizeof *c);
        uint64_t wrong, expected = 0;

        scene_make(c, round, few_get);
        for (int which = 0; which < CASES; which++) {
            send_case(c, which);
            if (cases[which].combiner == MACHINE_COMBINE_OVERWRITE)
                get_case(c, which);
        }
        for (uint64_t n = 0; n < c->from.count; n++)
            expected += c->active[n] && c->where[n] == UINT64_MAX;
        machine_begin(machine);
        assert_ok(
            machine_addresses_check(machine,
                                    machine_field_value(machine, c->address_field,
                                                        MACHINE_UINT(32), MACHINE_WHERE_ACTIVE),
                                    c->to.id, &wrong),
            machine);
        assert_int_equal(wrong, expected);
        machine_begin(machine);
        if (c->to.id != c->from.id)
            assert_ok(machine_vpset_destroy(machine, c->to.id), machine);
        assert_ok(machine_vpset_destroy(machine, c->from.id), machine);
        free(c);
    }
}

static void messages_arrive_as_in_a_loop(void **unused)
{
    (void)unused;
    state = 7;
    messages_arrive(false, ROUNDS);
    messages_arrive(true, 2 * ROUNDS);
}

/* Gets that are recorded and not yet evaluated: their results are fetched again and shifted,
 * and their sources are changed or destroyed before the evaluation. */
static void gets_wait(void **unused)
{
    (void)unused;
    state = 11;
    for (int round = 0; round < 2 * ROUNDS; round++) {
        machine_begin(machine);
        struct set from = set_make(1 + round % 3, round & 1),
                   to = set_make(1 + (round + 1) % 3, round >> 1 & 1);
        int bits = machine_address_bits(machine, to.id), lengths[1] = {(int)to.count};
        static const int widths[] = {1, 5, 8, 13, 16, 27, 32, 47, 64};
        struct machine_type type = MACHINE_UINT(widths[round % 9]);
        wide address[1024], x[1024], last[1024], sum[1024];
        for (uint64_t n = 0; n < from.count; n++)
            address[n] = next(9) ? address_of(&to, next(to.count)) : next(UINT64_C(1) << bits);
        numbers(x, to.count, type);
        assert_ok(machine_vpset_select(machine, from.id), machine);
        uint32_t a = field_of(&from, MACHINE_UINT(32), address), s = field_of(&to, type, x),
                 d = machine_field_allocate(machine, from.id, type.width, MACHINE_STACK),
                 e = machine_field_allocate(machine, from.id, type.width, MACHINE_STACK);
        struct machine_value *where =
            machine_field_value(machine, a, MACHINE_UINT(32), MACHINE_EVERYWHERE);
        struct machine_value *v = machine_get(machine, where, s, type);
        assert_non_null(v);
        assert_ok(machine_field_store(machine, d, v, MACHINE_EVERYWHERE), machine);
        /* each processor combines its own result with its neighbour's along the last axis */
        machine_begin(machine);
        v = machine_field_value(machine, d, type, MACHINE_EVERYWHERE);
        struct machine_value *shifted =
            machine_shift(machine, v, machine_vpset_rank(machine, from.id) - 1, 1);
        assert_ok(machine_field_store(machine, e,
                                      machine_binary(machine, MACHINE_XOR, v, shifted),
                                      MACHINE_EVERYWHERE),
                  machine);
        for (uint64_t n = 0; n < from.count; n++) {
            uint64_t at = index_of(&to, (uint64_t)address[n]);
            last[n] = at == UINT64_MAX ? 0 : x[at];
        }
        machine_begin(machine);
        if (round % 3 == 0)
            assert_ok(machine_vpset_destroy(machine, to.id), machine);
        else if (round % 3 == 1)
            arrange(to.id, lengths, 1, !(round >> 1 & 1));
        int axis = machine_vpset_rank(machine, from.id) - 1;
        uint64_t width = (uint64_t)machine_vpset_length(machine, from.id, axis);
        for (uint64_t n = 0; n < from.count; n++)
            sum[n] = last[n] ^ last[n - n % width + (n + 1) % width];
        field_is(&from, e, type, sum, NULL, "a neighbour's get", round);
        field_is(&from, d, type, last, NULL, "a get that waited", round);
        machine_begin(machine);
        if (round % 3)
            assert_ok(machine_vpset_destroy(machine, to.id), machine);
        assert_ok(machine_vpset_destroy(machine, from.id), machine);
    }
}

/* Addresses that go up by one, for a while or throughout, up to the last processor and beyond:
 * a whole vector is loaded at once there. */
static void gets_along_rows(void **unused)
{
    (void)unused;
    static const int widths[] = {1, 7, 16, 32, 50, 64};
    enum { LENGTH = 500, WIDTHS = sizeof widths / sizeof *widths };
    state = 12;
    for (int round = 0; round < 6 * WIDTHS; round++) {
        int length = LENGTH, shorter = LENGTH - (int)next(40), breaks = round % 3;
        machine_begin(machine);
        struct set from = {.count = LENGTH}, to = {.count = (uint64_t)shorter};
        from.id = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);
        to.id = machine_vpset_create_ordered(machine, &shorter, 1, MACHINE_SEND_ORDER);
        struct machine_type type = MACHINE_UINT(widths[round % WIDTHS]);
        wide address[LENGTH], x[LENGTH], got[LENGTH];
        uint32_t at = (uint32_t)next(60) - 30,
                 last = 511; /* which no processor has; after it comes the first */
        for (int n = 0; n < LENGTH; n++, at++) {
            if (breaks && !next(breaks == 1 ? 100 : 20))
                at = (uint32_t)next(LENGTH);
            address[n] = at & last;
        }
        numbers(x, to.count, type);
        for (int n = 0; n < LENGTH; n++)
            got[n] = address[n] < to.count ? x[address[n]] : 0;
        assert_ok(machine_vpset_select(machine, from.id), machine);
        uint32_t a = field_of(&from, MACHINE_UINT(32), address), s = field_of(&to, type, x),
                 d = machine_field_allocate(machine, from.id, type.width, MACHINE_STACK);
        struct machine_value *where =
            machine_field_value(machine, a, MACHINE_UINT(32), MACHINE_EVERYWHERE);
        struct machine_value *v = machine_get(machine, where, s, type);
        assert_non_null(v);
        assert_ok(machine_field_store(machine, d, v, MACHINE_EVERYWHERE), machine);
        field_is(&from, d, type, got, NULL, "along rows", round);
        machine_begin(machine);
        assert_ok(machine_vpset_destroy(machine, to.id), machine);
        assert_ok(machine_vpset_destroy(machine, from.id), machine);
    }
}

/* Pointer jumping: a field of addresses gets from itself, so each processor finds its
 * successor's successor. */
static void gets_of_gets(void **unused)
{
    (void)unused;
    enum { COUNT = 700, JUMPS = 6 };
    state = 13;
    for (int order = 0; order < 2; order++) {
        int length = COUNT;
        struct set s = {.count = COUNT,
                        .ratio = (COUNT + PROCESSORS - 1) / PROCESSORS,
                        .order = order ? MACHINE_SEND_ORDER : MACHINE_NEWS_ORDER};
        wide follows[1024];
        uint64_t at[COUNT];
        machine_begin(machine);
        s.id = machine_vpset_create_ordered(machine, &length, 1, s.order);
        for (uint64_t n = 0; n < COUNT; n++) {
            at[n] = next(COUNT);
            follows[n] = address_of(&s, at[n]);
        }
        assert_ok(machine_vpset_select(machine, s.id), machine);
        uint32_t f = field_of(&s, MACHINE_UINT(20), follows);
        for (int jump = 0; jump < JUMPS; jump++) {
            uint64_t old[COUNT];
            memcpy(old, at, sizeof old);
            machine_begin(machine);
            struct machine_value *v =
                machine_field_value(machine, f, MACHINE_UINT(20), MACHINE_EVERYWHERE);
            assert_ok(machine_field_store(machine, f,
                                          machine_get(machine, v, f, MACHINE_UINT(20)),
                                          MACHINE_EVERYWHERE),
                      machine);
            for (uint64_t n = 0; n < COUNT; n++)
                at[n] = old[old[n]];
        }
        for (uint64_t n = 0; n < COUNT; n++)
            follows[n] = address_of(&s, at[n]);
        field_is(&s, f, MACHINE_UINT(20), follows, NULL, "pointers", order);
        machine_begin(machine);
        assert_ok(machine_vpset_destroy(machine, s.id), machine);
    }
}

/* Sends of values that are recorded but not computed, and of constants. */
static void values_that_wait_are_sent(void **unused)
{
    (void)unused;
    int length = 64,
        set = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);
    uint32_t got[64];

    assert_ok(machine_vpset_select(machine, set), machine);
    machine_begin(machine);
    uint32_t d = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    struct machine_value *mine = machine_self_address(machine, 32);
    struct machine_value *one =
        machine_constant(machine, MACHINE_UINT(32), (struct machine_scalar){1, 0});
    struct machine_value *address = machine_binary(
        machine, MACHINE_XOR, mine,
        machine_constant(machine, MACHINE_UINT(32), (struct machine_scalar){63, 0}));
    assert_ok(machine_send(machine, d, address, mine, MACHINE_COMBINE_OVERWRITE, 0), machine);
    assert_ok(machine_send(machine, d, one, one, MACHINE_COMBINE_ADD, 0), machine);
    assert_ok(machine_field_download(machine, d, MACHINE_UINT(32), got), machine);
    for (uint32_t n = 0; n < 64; n++)
        assert_int_equal(got[n], (n ^ 63) + (n == 1 ? 64 : 0));
    machine_begin(machine);
    assert_ok(machine_vpset_destroy(machine, set), machine);
}

struct arrangement {
    int rank, lengths[3];
    enum machine_order order;
};

static void set_changes(int count, const struct arrangement *shapes)
{
    wide x[256];
    struct set s = {.count = (uint64_t)count, .ratio = (uint64_t)count / PROCESSORS};

    s.id = machine_vpset_create(machine, shapes[0].lengths, shapes[0].rank);
    assert_ok(machine_vpset_select(machine, s.id), machine);
    machine_begin(machine);
    for (uint64_t n = 0; n < s.count; n++)
        x[n] = address_of(&s, n);
    uint32_t f = field_of(&s, MACHINE_UINT(32), x);
    uint32_t g = machine_field_allocate(machine, s.id, 32, MACHINE_HEAP);
    assert_ok(
        machine_field_store(machine, g, machine_self_address(machine, 32), MACHINE_EVERYWHERE),
        machine);
    for (int i = 1; i <= 4; i++) {
        arrange(s.id, shapes[i % 4].lengths, shapes[i % 4].rank, shapes[i % 4].order);
        s.order = shapes[i % 4].order;
        for (uint64_t n = 0; n < s.count; n++)
            x[n] = address_of(&s, n);
        field_is(&s, f, MACHINE_UINT(32), x, NULL, "after another geometry", i);
        field_is(&s, g, MACHINE_UINT(32), x, NULL, "what was a number of its own", i);
        assert_int_equal(machine_vpset_rank(machine, s.id), shapes[i % 4].rank);
    }
    struct machine_layout seven;
    machine_layout_make(&seven, (int[]){7}, NULL, NULL, 1, PROCESSORS);
    assert_int_equal(machine_vpset_arrange(machine, s.id, (int[]){7}, 1, &seven),
                     MACHINE_BAD_ARGUMENT);
    machine_error_clear(machine);
    machine_begin(machine);
    assert_ok(machine_vpset_destroy(machine, s.id), machine);
}

static void geometry_of_a_set_changes(void **unused)
{
    (void)unused;
    static const struct arrangement dealt[] = {{2, {6, 40}, MACHINE_NEWS_ORDER},
                                               {1, {240}, MACHINE_SEND_ORDER},
                                               {3, {20, 3, 4}, MACHINE_NEWS_ORDER},
                                               {2, {12, 20}, MACHINE_SEND_ORDER}},
                                    subgrids[] = {{2, {16, 16}, MACHINE_NEWS_ORDER},
                                                  {1, {256}, MACHINE_SEND_ORDER},
                                                  {3, {4, 32, 2}, MACHINE_NEWS_ORDER},
                                                  {1, {256}, MACHINE_NEWS_ORDER}};
    set_changes(240, dealt);
    set_changes(256, subgrids);
}

static void wrong_messages_are_refused(void **unused)
{
    (void)unused;
    int length = 8, a = machine_vpset_create(machine, &length, 1),
        b = machine_vpset_create(machine, &length, 1);

    assert_ok(machine_vpset_select(machine, a), machine);
    machine_begin(machine);
    uint32_t f = machine_field_allocate(machine, a, 32, MACHINE_HEAP),
             g = machine_field_allocate(machine, b, 32, MACHINE_HEAP);
    struct machine_value *v =
        machine_field_value(machine, f, MACHINE_UINT(32), MACHINE_WHERE_ACTIVE);
    struct machine_value *w = machine_self_address(machine, 3);
    assert_int_equal(machine_send(machine, g, w, v, MACHINE_COMBINE_FADD, 0),
                     MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_send(machine, g + 1, w, v, MACHINE_COMBINE_ADD, 0),
                     MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_send(machine, g, w, v, MACHINE_COMBINE_ADD, f),
                     MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_send(machine, 12345, w, v, MACHINE_COMBINE_ADD, 0),
                     MACHINE_BAD_ARGUMENT);
    assert_null(machine_get(machine, w, 12345, MACHINE_UINT(32)));
    machine_error_clear(machine);
    machine_begin(machine);
    assert_ok(machine_vpset_destroy(machine, a), machine);
    assert_ok(machine_vpset_destroy(machine, b), machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_arrive_as_in_a_loop),
        cmocka_unit_test(gets_wait),
        cmocka_unit_test(gets_along_rows),
        cmocka_unit_test(gets_of_gets),
        cmocka_unit_test(values_that_wait_are_sent),
        cmocka_unit_test(geometry_of_a_set_changes),
        cmocka_unit_test(wrong_messages_are_refused),
    };
    int failed = 0;

    /* Both ways of sending. Gets within kernels, and as kernels of their own; eager machines
     * have only the latter. */
    for (int way = 0; way < 3; way++) {
        bool eager = way == 1;
        setenv("LUTETIA_SCATTER", eager ? "0" : "1", 1);
        setenv("LUTETIA_GATHER", way == 2 ? "0" : "1", 1);
        machine = support_machine(eager);
        failed += cmocka_run_group_tests_name(eager      ? "eager"
                                              : way == 2 ? "lazy, gets apart"
                                                         : "lazy",
                                              tests, NULL, NULL);
        support_machine_destroy(machine);
    }
    return failed;
}
