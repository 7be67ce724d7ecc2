/* test_picks.c - chains of choices that the interpreter performs as one step: the element of an
 * array that an index names, and a choice within a choice. The loops give what the chain gives;
 * chains are found where they are, and nowhere else; and programs of random chains come to the
 * same bits on every tier. */
#include "support.h"

#include "hand_graph.h"
#include "interpret/picks.h"
#include "tables.h"

/* ---- loops ---- */

enum { LANES = 131 };

static uint32_t chance = 1;

static uint32_t below(uint32_t n)
{
    chance = chance * 1664525u + 1013904223u;
    return (chance >> 8) % n;
}

/* Near one another, with holes and twice the same; near the greatest there are; or anywhere. */
static uint32_t key_by_chance(int kind, int bits)
{
    const uint32_t most = bits == 32 ? UINT32_MAX : (1u << bits) - 1;
    const uint32_t key = kind == 0   ? below(20)
                         : kind == 1 ? most - below(70)
                         : kind == 2 ? below(2) * most
                                     : below(1 << 24) * 977;
    return key & most;
}

/* index: its lanes are held in so many bytes by the key's place, and as words by what a pick
 * takes. */
static void a_pick_is_the_chain(const struct lanes_table *t, int c, int n, int kind, int bits)
{
    static _Alignas(64) unsigned char values[PICK_MOST + 2][16 * LANES], keys[PICK_MOST][4];
    static uint32_t index[LANES];
    const size_t bytes = lanes_bytes((enum lanes_class)c);
    const int count = 1 + (int)below(PICK_MOST);
    void *at[2 * PICK_MOST + 3] = {index, values[PICK_MOST + 1]};
    uint16_t list[2 * PICK_MOST + 1];
    uint32_t key[PICK_MOST];
    for (int k = 0; k <= count; k++) {
        for (size_t i = 0; i < sizeof values[0]; i++)
            values[k][i] = (unsigned char)below(256);
        at[2 + 2 * k] = values[k];
        list[k < count ? 2 * k + 1 : 2 * k] = (uint16_t)(2 + 2 * k);
        if (k == count)
            break;
        key[k] = key_by_chance(kind, bits);
        memcpy(keys[k], &key[k], 4); /* the lowest bytes come first */
        at[3 + 2 * k] = keys[k];
        list[2 * k] = (uint16_t)(3 + 2 * k);
    }
    for (int i = 0; i < LANES; i++)
        index[i] = below(4) ? key[below((uint32_t)count)] : key_by_chance(kind, bits);
    const struct lanes_step s = {
        .op = LANES_PICK, .to = 1, .from = MACHINE_UINT(bits), .detail = count, .list = list};
    memset(values[PICK_MOST + 1], 0x55, sizeof values[0]);
    t->of[LANES_PICK][c](&s, at, n);
    for (int i = 0; i < n; i++) {
        int k = 0;
        while (k < count && key[k] != index[i])
            k++;
        assert_memory_equal(values[PICK_MOST + 1] + (size_t)i * bytes,
                            values[k] + (size_t)i * bytes, bytes);
    }
    for (size_t i = (size_t)n * bytes; i < sizeof values[0]; i++)
        assert_int_equal(values[PICK_MOST + 1][i], 0x55);
}

static void each_pick_is_the_chain_of_choices(void **state)
{
    static const int bits[] = {3, 8, 13, 16, 29, 32};
    const struct tables t = tables_here();
    (void)state;
    for (int i = 0; i < t.count; i++)
        for (int c = 0; c < LANES_INTEGERS; c++)
            for (int turn = 0; turn < 400; turn++)
                a_pick_is_the_chain(t.of[i], c, (int)below(LANES + 1), turn % 4,
                                    bits[turn % 6]);
}

/* ---- where they are ---- */

static struct hand_graph hand;

/* A chain of so many, by this index; its last node. */
static int chain_add(int index, int count, int rest, int nodes[])
{
    const struct machine_type type = hand.nodes[index].type;
    for (int k = 0; k < count; k++) {
        int key = hand_number(&hand, type),
            bit = k % 2 ? hand_node(&hand, MACHINE_EQ, MACHINE_BIT, key, index, 0)
                        : hand_node(&hand, MACHINE_EQ, MACHINE_BIT, index, key, 0);
        rest = hand_node(&hand, NODE_SELECT, MACHINE_UINT(20), bit,
                         hand_leaf(&hand, MACHINE_UINT(20)), rest);
        if (nodes)
            nodes[k] = rest;
    }
    return rest;
}

static int chain_begin(int index_bits)
{
    hand_begin(&hand, 1);
    return hand_leaf(&hand, MACHINE_UINT(index_bits));
}

/* How many choices of a graph's last node are one step. */
static int picked(bool wanted)
{
    hand.nodes[hand.g.count - 1].stored = hand.nodes[hand.g.count - 1].target = true;
    struct picks *p = picks_create(&hand.g, 0, wanted);
    assert_non_null(p);
    const struct pick *pick = picks_find(p, hand.g.count - 1);
    const int count = pick ? pick->count : 0;
    assert_true(picks_at(p, hand.g.count - 1) == pick);
    picks_free(p);
    return count;
}

static void a_chain_by_one_index_is_found(void **state)
{
    int nodes[100];
    (void)state;
    for (int count = 0; count <= PICK_MOST + 3; count++) {
        int index = chain_begin(9);
        chain_add(index, count, hand_leaf(&hand, MACHINE_UINT(20)), NULL);
        assert_int_equal(picked(false), 0);
        assert_int_equal(picked(true), count < PICK_LEAST  ? 0
                                       : count > PICK_MOST ? PICK_MOST
                                                           : count);
    }
    int index = chain_begin(33); /* too long to be a place in a table */
    chain_add(index, 10, index, NULL);
    assert_int_equal(picked(true), 0);

    index = chain_begin(9); /* by another index from the eighth choice on */
    int other = hand_leaf(&hand, MACHINE_UINT(9));
    chain_add(index, 7, chain_add(other, 10, hand_leaf(&hand, MACHINE_UINT(20)), NULL), NULL);
    assert_int_equal(picked(true), 7);

    index = chain_begin(
        9); /* somebody else takes the third choice from the end, so it is computed anyway */
    int last = chain_add(index, 12, hand_leaf(&hand, MACHINE_UINT(20)), nodes);
    hand_node(&hand, MACHINE_ADD, MACHINE_UINT(20), nodes[2], last, 0);
    struct picks *p = picks_create(&hand.g, 0, true);
    assert_int_equal(picks_find(p, last)->count, 9);
    assert_int_equal(picks_find(p, last)->rest, nodes[2]);
    picks_free(p);

    index = chain_begin(9); /* likewise, if it is stored */
    chain_add(index, 12, hand_leaf(&hand, MACHINE_UINT(20)), nodes);
    hand.nodes[nodes[2]].stored = true;
    assert_int_equal(picked(true), 9);
}

static void a_choice_within_a_choice_is_found(void **state)
{
    (void)state;
    for (int kind = 0; kind < 5; kind++) {
        const struct machine_type type = MACHINE_UINT(20);
        hand_begin(&hand, 2);
        int a = hand_leaf(&hand, type), b = hand_leaf(&hand, type), c = hand_leaf(&hand, type),
            one = hand_leaf(&hand, MACHINE_BIT), two = hand_leaf(&hand, MACHINE_BIT),
            inner = hand_node(&hand, NODE_SELECT, type, two, a, kind == 1 ? c : b),
            outer = hand_node(&hand, NODE_SELECT, type, one, kind == 2 ? b : inner,
                              kind == 2 ? inner : b);
        if (kind == 3)
            hand_node(&hand, MACHINE_ADD, type, outer, inner, 0);
        if (kind == 4)
            hand.nodes[inner].stored = true;
        struct picks *p = picks_create(&hand.g, 0, true);
        assert_int_equal(picks_inner(p, outer), kind ? -1 : inner);
        assert_int_equal(picks_inner(p, inner), -1);
        assert_int_equal(picks_inner(p, a), -1);
        picks_free(p);
    }
}

/* ---- programs ---- */

enum { FIELDS = 6, KEYS_MOST = 70 };

/* Fields are words of seed 0, 1, ...; `index` is of its own seed, below `limit` mostly. */
struct chain {
    struct machine_type type, index;
    /* index and values are results, which are taken again afterwards; of bits only */
    bool computed;
    int count, inner; /* inner: this choice is one within one; -1: none is */
    uint64_t limit;
    uint64_t keys[KEYS_MOST];
    uint8_t values[KEYS_MOST]; /* fields */
};

static wide index_of(const struct chain *p, uint64_t n)
{
    wide x = support_word(p->index, 99, n);
    return n % 5 ? x % p->limit : x;
}

static wide ones(struct machine_type type)
{
    return type.width < 128 ? ((wide)1 << type.width) - 1 : ~(wide)0;
}

static wide value_of(const struct chain *p, int field, uint64_t n)
{
    const wide x = support_word(p->type, (uint64_t)field, n);
    return p->computed ? ~x & ones(p->type) : x;
}

static wide program_is(const void *data, uint64_t n)
{
    const struct chain *p = *(const struct chain *const *)data;
    const wide index = (index_of(p, n) + p->computed) & ones(p->index);
    wide x = support_word(p->type, FIELDS, n), after = p->computed ? value_of(p, 0, n) : 0;
    for (int k = 0; k < p->count; k++)
        if (p->keys[k] == index && (k != p->inner || support_word(MACHINE_BIT, 98, n)))
            x = value_of(p, p->values[k], n);
    return x ^ after;
}

static void program_make(struct chain *p, int turn)
{
    static const int widths[] = {1, 4, 8, 11, 16, 23, 32, 40},
                     lengths[] = {2, 8, 12, 32, 33, 90};
    *p = (struct chain){.type =
                            turn % 7 == 6 ? MACHINE_F32 : MACHINE_UINT(lengths[turn % 7 % 6]),
                        .index = MACHINE_UINT(widths[turn % 8]),
                        .count = 1 + (int)below(KEYS_MOST),
                        .inner = -1,
                        .limit = 1 + below(turn % 3 ? 20 : 200)};
    const uint64_t most = (UINT64_C(1) << p->index.width) - 1;
    for (int k = 0; k < p->count; k++) {
        p->keys[k] =
            (turn % 4 == 3 ? below(1 << 20) * 4093 : below((uint32_t)p->limit + 3)) & most;
        p->values[k] = (uint8_t)below(FIELDS);
    }
    p->computed = turn % 3 == 1 && p->type.kind == MACHINE_BITS;
    if (turn % 2)
        p->inner = (int)below((uint32_t)p->count);
}

static struct machine_value *program_value(struct machine *m, const struct chain *p,
                                           const uint32_t *fields, uint32_t index, uint32_t bit)
{
    struct machine_value *x = support_value(m, fields[FIELDS], p->type), *values[FIELDS],
                         *at = support_value(m, index, p->index);
    if (p->computed)
        at = machine_binary(m, MACHINE_ADD, at,
                            machine_constant(m, p->index, support_scalar(1)));
    for (int i = 0; i < FIELDS; i++) {
        values[i] = support_value(m, fields[i], p->type);
        if (p->computed)
            values[i] = machine_unary(m, MACHINE_NOT, values[i]);
    }
    for (int k = 0; k < p->count; k++) {
        struct machine_value *key = machine_constant(m, p->index, support_scalar(p->keys[k])),
                             *hit = k % 3 ? machine_binary(m, MACHINE_EQ, at, key)
                                          : machine_binary(m, MACHINE_EQ, key, at),
                             *value = values[p->values[k]];
        if (k == p->inner)
            value = machine_select(m, support_value(m, bit, MACHINE_BIT), value, x);
        x = machine_select(m, hit, value, x);
    }
    return p->computed ? machine_binary(m, MACHINE_XOR, x, values[0]) : x;
}

static void programs_run(const char *how, int processors, int turns)
{
    static struct chain chains[64];
    setenv("LUTETIA_INTERPRET", how, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_INTERPRET");
    assert_true(support_set(m, 1, processors) > 0);
    for (int turn = 0; turn < turns; turn++) {
        struct chain *p = &chains[turn];
        const void *data = p;
        uint32_t fields[FIELDS + 1], bit = support_field(m, MACHINE_BIT, 98);
        program_make(p, turn);
        for (int i = 0; i <= FIELDS; i++)
            fields[i] = support_field(m, p->type, (uint64_t)i);
        uint32_t index =
            machine_field_allocate(m, machine_vpset_current(m), p->index.width, MACHINE_HEAP);
        unsigned char *words = calloc((size_t)processors, 16);
        assert_non_null(words);
        for (int n = 0; n < processors; n++)
            support_element_set(words, p->index, (uint64_t)n, index_of(p, (uint64_t)n));
        assert_ok(machine_field_upload(m, index, p->index, words), m);
        free(words);
        support_later(m, program_value(m, p, fields, index, bit), program_is, &data,
                      sizeof data, "a chain");
        support_check(m);
        for (int i = 0; i <= FIELDS; i++)
            assert_ok(machine_field_deallocate(m, fields[i]), m);
        assert_ok(machine_field_deallocate(m, bit), m);
        assert_ok(machine_field_deallocate(m, index), m);
    }
    struct machine_stats now;
    machine_stats_get(m, &now);
    assert_true((now.interpreted > 0) == (*how != '0'));
    support_machine_destroy(m);
}

static void chains_come_to_the_same_on_every_tier(void **state)
{
    (void)state;
    chance = 7;
    programs_run("2", 1, 8);
    programs_run("2", 700, 64);
    programs_run("2", 3001, 64);
    programs_run("3", 90, 16);
    programs_run("0", 90, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pick_is_the_chain_of_choices),
        cmocka_unit_test(a_chain_by_one_index_is_found),
        cmocka_unit_test(a_choice_within_a_choice_is_found),
        cmocka_unit_test(chains_come_to_the_same_on_every_tier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
