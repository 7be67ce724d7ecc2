/* test_gets.c - gets by the same addresses again and again: where their elements are is kept in
 * memory (memory/known_addresses.h), and forgotten when the addresses change, when a set is
 * destroyed or arranged anew, and when memory is short. Random programs of gets and changes
 * come to what plain C comes to. */
#include "sample.h"
#include "support.h"

#include "memory/memory.h"

enum { ROWS = 9, COLUMNS = 21, COUNT = ROWS * COLUMNS, OTHER = 8 * 16, FIELDS = 3 };
static const struct machine_type word = MACHINE_UINT(32);

/* Fields of addresses in one set, of numbers in both; and what they hold. Addresses of the
 * other set, or (theirs) of their own. */
struct gets {
    struct machine *m;
    int set, other;
    uint32_t numbers[2], addresses[FIELDS];
    uint32_t of_own[COUNT], of_other[OTHER],
        to[FIELDS][COUNT]; /* to: indices; COUNT and more: nobody's */
    bool theirs[FIELDS];
    uint64_t chance;
};

static uint32_t below(struct gets *g, uint64_t n)
{
    return (uint32_t)(sample_word(&g->chance) % n);
}

static uint64_t address_of(const struct gets *g, int k, uint32_t index)
{
    const int set = g->theirs[k] ? g->set : g->other;
    return index < machine_vpset_count(g->m, set)
               ? machine_send_address(g->m, set, index)
               : UINT64_C(1) << (machine_address_bits(g->m, set) - 1) | 3;
}

/* New indices for all, or about half. */
static void addresses_upload(struct gets *g, int k, bool all)
{
    uint32_t raw[COUNT];
    const uint32_t most = g->theirs[k] ? COUNT : OTHER;
    for (int i = 0; i < COUNT; i++) {
        if (all || below(g, 2))
            g->to[k][i] = below(g, most);
        raw[i] = (uint32_t)address_of(g, k, g->to[k][i]);
    }
    machine_begin(g->m);
    assert_ok(machine_field_upload(g->m, g->addresses[k], word, raw), g->m);
}

/* The address of one row further, in the upper rows: by instructions, under a context. */
static void addresses_rotate(struct gets *g, int k)
{
    uint32_t was[COUNT];
    memcpy(was, g->to[k], sizeof was);
    machine_begin(g->m);
    struct machine_value *upper =
        machine_binary(g->m, MACHINE_ULT, machine_coordinate(g->m, 0, 32),
                       machine_constant(g->m, word, (struct machine_scalar){ROWS / 2, 0}));
    assert_ok(machine_flag_store(g->m, MACHINE_CONTEXT, upper, MACHINE_EVERYWHERE), g->m);
    machine_begin(g->m);
    assert_ok(machine_field_store(
                  g->m, g->addresses[k],
                  machine_shift(g->m, support_value(g->m, g->addresses[k], word), 0, 1),
                  MACHINE_WHERE_ACTIVE),
              g->m);
    machine_begin(g->m);
    assert_ok(
        machine_flag_store(g->m, MACHINE_CONTEXT,
                           machine_constant(g->m, MACHINE_BIT, (struct machine_scalar){1, 0}),
                           MACHINE_EVERYWHERE),
        g->m);
    for (int i = 0; i < ROWS / 2 * COLUMNS; i++)
        g->to[k][i] = was[i + COLUMNS];
}

static void address_write(struct gets *g, int k)
{
    const uint32_t i = below(g, COUNT);
    g->to[k][i] = below(g, g->theirs[k] ? COUNT : OTHER);
    machine_begin(g->m);
    assert_ok(machine_field_write(g->m, g->addresses[k], word, i,
                                  (struct machine_scalar){address_of(g, k, g->to[k][i]), 0}),
              g->m);
}

/* Own numbers += what the get brings. Its source is in memory, or waits. */
static void get(struct gets *g, int k)
{
    struct machine_value *v;
    uint32_t sum[COUNT];
    machine_begin(g->m);
    v = machine_get(g->m, support_value(g->m, g->addresses[k], word),
                    g->numbers[g->theirs[k] ? 0 : 1], word);
    assert_non_null(v);
    assert_ok(machine_field_store(g->m, g->numbers[0],
                                  machine_binary(g->m, MACHINE_ADD,
                                                 support_value(g->m, g->numbers[0], word), v),
                                  MACHINE_WHERE_ACTIVE),
              g->m);
    for (int i = 0; i < COUNT; i++)
        sum[i] = g->of_own[i] + (g->theirs[k] ? g->of_own : g->of_other)[g->to[k][i]];
    memcpy(g->of_own, sum, sizeof sum);
}

static void look(struct gets *g)
{
    uint32_t got[COUNT];
    machine_begin(g->m);
    assert_ok(machine_field_download(g->m, g->numbers[0], word, got), g->m);
    assert_memory_equal(got, g->of_own, sizeof got);
}

static void other_create(struct gets *g)
{
    g->other = support_set(g->m, 2, 8, 16);
    g->numbers[1] = machine_field_allocate(g->m, g->other, 32, MACHINE_HEAP);
    for (int i = 0; i < OTHER; i++)
        g->of_other[i] = below(g, 1000);
    assert_ok(machine_field_upload(g->m, g->numbers[1], word, g->of_other), g->m);
    assert_ok(machine_vpset_select(g->m, g->set), g->m);
}

static void gets_open(struct gets *g, uint64_t chance)
{
    *g = (struct gets){.m = support_machine(0), .chance = chance};
    g->set = support_set(g->m, 2, ROWS, COLUMNS);
    g->numbers[0] = machine_field_allocate(g->m, g->set, 32, MACHINE_HEAP);
    other_create(g);
    for (int k = 0; k < FIELDS; k++) {
        g->theirs[k] = k == 2;
        g->addresses[k] = machine_field_allocate(g->m, g->set, 32, MACHINE_HEAP);
        addresses_upload(g, k, true);
    }
}

/* In blocks gets are messages, which need no places. */
static bool has_blocks(const struct gets *g)
{
    return g->m->sequencers != NULL;
}

/* How many places are kept. */
static int kept(const struct gets *g)
{
    int count = 0;
    for (int i = 0; i < KNOWN_PLACES; i++)
        count += g->m->memory->places.of[i].place != NULL;
    return count;
}

static void places_are_kept_while_the_addresses_are_the_same(void **state)
{
    static struct gets g;
    (void)state;
    gets_open(&g, 1);
    for (int n = 0; n < 2 * KNOWN_PLACES_FROM; n++) {
        assert_int_equal(kept(&g), n < KNOWN_PLACES_FROM || has_blocks(&g) ? 0 : 2);
        get(&g, 0);
        get(&g, 2);
        look(&g);
    }
    addresses_upload(&g, 2, true); /* another array: the old one's are of no use, but true */
    get(&g, 2);
    look(&g);
    assert_ok(machine_vpset_destroy(g.m, g.other), g.m);
    assert_int_equal(kept(&g), 0);
    other_create(&g);
    addresses_upload(&g, 0, true);
    get(&g, 0);
    look(&g);
    machine_destroy(g.m);
}

static int programs = 100;

static void random_programs_come_to_the_same(void **state)
{
    static struct gets g;
    int most = 0;
    bool in_blocks = false;
    (void)state;
    for (int seed = 0; seed < programs; seed++) {
        gets_open(&g, (uint64_t)seed);
        for (int n = 0; n < 80; n++) {
            const int k = (int)below(&g, FIELDS), what = (int)below(&g, 60);
            if (what < 2)
                addresses_upload(&g, k, what);
            else if (what == 2)
                addresses_rotate(&g, k);
            else if (what == 3)
                address_write(&g, k);
            else
                get(&g, k);
            if (what % 3 == 0)
                look(&g);
            most = kept(&g) > most ? kept(&g) : most;
        }
        look(&g);
        in_blocks = has_blocks(&g);
        machine_destroy(g.m);
    }
    assert_true(in_blocks ? most == 0 : most > 1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_kept_while_the_addresses_are_the_same),
        cmocka_unit_test(random_programs_come_to_the_same),
    };
    setenv("LUTETIA_INTERPRET", "2", 1); /* no compiler for each program */
    if (argc > 1)                        /* so many of them */
        programs = atoi(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
