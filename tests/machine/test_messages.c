/* test_messages.c - messages on the front end's own thread: loops that go through them come to
 * the same under every instruction set, and an array is written over only where nobody else
 * looks at it. */
#include "support.h"

#include "tables.h"

/* ---- loops ---- */

static void messages_are_picked_alike(void **state)
{
    enum { MOST = 512 };
    static uint32_t index[MOST], place[MOST + 16];
    static uint16_t lane[MOST + 16];
    static uint8_t context[MOST];
    const struct lanes_filter p = {index, 70, 9000, 3};
    const struct lanes_rows rows = {37, 16, 91};
    struct tables t = tables_here();
    (void)state;
    for (int n = 0; n <= MOST; n += n < 40 ? 1 : 59)
        for (int k = 0; k < 2 * t.count; k++) {
            const bool masked = k % 2;
            size_t expected = 0;
            for (int i = 0; i < n; i++) {
                const uint32_t x =
                    (uint32_t)support_word(MACHINE_UINT(32), (uint64_t)n, (uint64_t)i);
                index[i] = x % 9 ? x % 10000 : x;
                context[i] = x >> 20 & 1;
            }
            size_t picked = t.of[k / 2]->filter(&p, masked ? context : NULL, n, place, lane);
            for (size_t i = 0; i < picked; i++)
                place[i] -= 3;
            t.of[k / 2]->places(place, picked, &rows);
            for (int i = 0; i < n; i++) {
                const uint32_t x = index[i];
                if (x < 70 || x - 70 >= 9000 || (masked && !context[i]))
                    continue;
                assert_true(expected < picked);
                assert_int_equal(lane[expected], i);
                assert_int_equal(place[expected++], x / 37 * (37 + 91) + x % 37 + 16);
            }
            assert_int_equal(picked, expected);
        }
}

static void the_greatest_is_found_alike(void **state)
{
    enum { MOST = 300 };
    static uint32_t x[MOST];
    static uint8_t context[MOST];
    struct tables t = tables_here();
    (void)state;
    for (int n = 0; n <= MOST; n++) {
        uint32_t most = 0, most_active = 0;
        for (int i = 0; i < n; i++) {
            x[i] = (uint32_t)support_word(MACHINE_UINT(32), (uint64_t)n, (uint64_t)i);
            context[i] = x[i] % 5 == 1;
            most = x[i] > most ? x[i] : most;
            most_active = context[i] && x[i] > most_active ? x[i] : most_active;
        }
        for (int k = 0; k < t.count; k++) {
            assert_int_equal(t.of[k]->greatest(x, NULL, n), most);
            assert_int_equal(t.of[k]->greatest(x, context, n), most_active);
        }
    }
}

static void addresses_become_indices_alike(void **state)
{
    enum { MOST = 300, NOBODY = 900 };
    static _Alignas(16) unsigned char address[MOST * 16];
    static uint8_t context[MOST];
    uint32_t index[MOST];
    struct tables t = tables_here();
    (void)state;
    for (int n = 0; n <= MOST; n += n < 40 ? 1 : 37)
        for (int k = 0; k < 2 * 5 * t.count; k++) {
            const int bytes = 1 << k / 2 % 5;
            const struct machine_type type = MACHINE_UINT(8 * bytes);
            const struct lanes_aim a = {address, k % 2 ? context : NULL, (size_t)bytes, 0x3ff,
                                        NOBODY};
            for (int i = 0; i < n; i++) {
                support_element_set(address, type, (uint64_t)i,
                                    support_word(type, (uint64_t)n, (uint64_t)i));
                context[i] = i * 7 % 3 != 0;
            }
            t.of[k / 10]->aim(&a, n, index);
            for (int i = 0; i < n; i++) {
                const uint32_t x =
                    (uint32_t)support_element(address, type, (uint64_t)i) & 0x3ff;
                assert_int_equal(index[i], x >= NOBODY || (k % 2 && !context[i]) ? NOBODY : x);
            }
        }
}

/* Over the old numbers, over one number, and in place; the ranks go round at the mask. */
static void ranks_are_put_alike(void **state)
{
    enum { MOST = 300, OLD, NUMBER, IN_PLACE, KINDS = 3 };
    static uint32_t old[MOST], to[MOST];
    static uint8_t context[MOST];
    struct tables t = tables_here();
    (void)state;
    for (int n = 0; n <= MOST; n += n < 40 ? 1 : 37)
        for (int k = 0; k < KINDS * t.count; k++) {
            const int kind = OLD + k % KINDS;
            uint32_t rank = 0x1fff0;
            for (int i = 0; i < n; i++) {
                old[i] = (uint32_t)support_word(MACHINE_UINT(32), (uint64_t)n, (uint64_t)i);
                context[i] = (uint8_t)(old[i] >> 7 & 2);
            }
            memcpy(to, old, sizeof to);
            const struct lanes_ranks r = {context,
                                          kind == NUMBER ? NULL
                                          : kind == OLD  ? old
                                                         : to,
                                          to, 77, 0x1ffff};
            t.of[k / KINDS]->ranks(&r, (size_t)n, rank);
            for (int i = 0; i < n; i++)
                assert_int_equal(to[i], context[i]       ? rank++ & 0x1ffff
                                        : kind == NUMBER ? 77
                                                         : old[i]);
        }
}

/* Numbers of each length that are as great as can be, so that lanes would overflow which add
 * too many; with and without a context. */
static void sums_are_alike(void **state)
{
    enum { MOST = 66000, LENGTHS = 4 };
    static _Alignas(16) unsigned char x[MOST * 8];
    static uint8_t context[MOST];
    static const int counts[] = {0, 1, 7, 31, 255, 256, 257, 600, MOST};
    const struct tables t = tables_here();
    (void)state;
    memset(x, 0xff, sizeof x);
    for (int i = 0; i < MOST; i++) {
        context[i] = i % 7 != 3;
        if (i % 1000 == 5)
            memset(x + 8 * i, i & 0x7f, 8);
    }
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int k = 0; k < 2 * LENGTHS * t.count; k++) {
            const size_t bytes = (size_t)1 << k / 2 % LENGTHS;
            const struct lanes_sum s = {.op = REDUCE_ADD, .element = bytes, .plain = true};
            uint64_t sum = 0;
            for (int i = 0; i < counts[c]; i++) {
                uint64_t one = 0;
                for (size_t b = 0; b < bytes; b++)
                    one |= (uint64_t)x[(size_t)i * bytes + b] << 8 * b;
                sum += k % 2 && !context[i] ? 0 : one;
            }
            assert_int_equal(
                t.of[k / (2 * LENGTHS)]->sum(&s, x, k % 2 ? context : NULL, (size_t)counts[c]),
                sum);
        }
}

/* Copies of every class and length, at the beginning of a line and elsewhere; nothing beside
 * them changes. */
static void what_is_stored_past_the_caches_is_the_same(void **state)
{
    enum { FREE = 64, LANES = 67 };
    static _Alignas(64) unsigned char from[LANES * 16 + FREE], to[LANES * 16 + 3 * FREE];
    const struct tables t = tables_here();
    const struct lanes_step s = {.in = {0}, .to = 1};
    (void)state;
    for (uint64_t i = 0; i < sizeof from; i++)
        from[i] = (unsigned char)(i * 37 + 5);
    for (int c = 0; c < LANES_INTEGERS; c++)
        for (int n = 0; n <= LANES; n++)
            for (int k = 0; k < 2 * t.count; k++) {
                const size_t bytes = (size_t)n * lanes_bytes((enum lanes_class)c);
                unsigned char *begin = to + FREE + (k % 2 ? 16 : 0);
                void *at[] = {from + (k % 2 ? 16 : 0), begin};
                memset(to, 0xee, sizeof to);
                t.of[k / 2]->of[LANES_STREAM][c](&s, at, n);
                t.of[k / 2]->settle();
                assert_memory_equal(begin, at[0], bytes);
                for (unsigned char *p = to; p < to + sizeof to; p++)
                    assert_true(*p == 0xee || (p >= begin && p < begin + bytes));
            }
}

/* ---- sends ---- */

enum { COUNT = 300 };

static uint32_t field_of(struct machine *m, int set, const uint32_t *x)
{
    uint32_t f = machine_field_allocate(m, set, 32, MACHINE_STACK);
    assert_ok(machine_field_upload(m, f, MACHINE_UINT(32), x), m);
    return f;
}

static void field_is(struct machine *m, uint32_t field, const uint32_t *x)
{
    uint32_t got[COUNT];
    assert_ok(machine_field_download(m, field, MACHINE_UINT(32), got), m);
    assert_memory_equal(got, x, sizeof got);
}

static struct machine_value *content(struct machine *m, uint32_t field)
{
    return machine_field_value(m, field, MACHINE_UINT(32), MACHINE_EVERYWHERE);
}

/* Not a copy, the messages, or the addresses. */
static void what_shares_the_destination_stays(void **state)
{
    enum { NOBODY, COPY, MESSAGES, ADDRESSES, KINDS };
    const int length[] = {COUNT};
    struct machine *m = support_machine(false);
    int set = machine_vpset_create_ordered(m, length, 1, MACHINE_SEND_ORDER);
    (void)state;
    assert_ok(machine_vpset_select(m, set), m);
    for (uint64_t i = 0; i < 8 * KINDS; i++) {
        const int shares = (int)i % KINDS;
        uint32_t address[COUNT], message[COUNT], old[COUNT], expected[COUNT];
        for (uint64_t n = 0; n < COUNT; n++) {
            expected[n] = old[n] = (uint32_t)support_word(MACHINE_UINT(32), 3 * i, n) % COUNT;
            message[n] = (uint32_t)support_word(MACHINE_UINT(32), 3 * i + 1, n);
            address[n] = (uint32_t)support_word(MACHINE_UINT(32), 3 * i + 2, n) % COUNT;
        }
        const uint32_t *sent = shares == MESSAGES ? old : message,
                       *where = shares == ADDRESSES ? old : address;
        for (int n = 0; n < COUNT; n++)
            expected[where[n]] = sent[n];
        machine_begin(m);
        const uint32_t to = field_of(m, set, old), copy = field_of(m, set, message),
                       from = shares == MESSAGES ? to : field_of(m, set, message),
                       at = shares == ADDRESSES ? to : field_of(m, set, address);
        if (shares == COPY)
            assert_ok(machine_field_store(m, copy, content(m, to), MACHINE_EVERYWHERE), m);
        machine_begin(m);
        assert_ok(
            machine_send(m, to, content(m, at), content(m, from), MACHINE_COMBINE_OVERWRITE, 0),
            m);
        field_is(m, to, expected);
        field_is(m, copy, shares == COPY ? old : message);
        if (at != to)
            field_is(m, at, address);
        if (from != to)
            field_is(m, from, message);
    }
    support_machine_destroy(m);
}

/* Places and numbers of every length; nothing beside them changes. */
static void places_and_numbers_fill_what_they_should(void **state)
{
    enum { FREE = 64, LANES = 67 };
    static _Alignas(64) unsigned char to[LANES * 16 + 2 * FREE], should[sizeof to];
    const struct tables t = tables_here();
    const unsigned char element[16] = {1, 2, 3, 250, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    (void)state;
    for (size_t n = 0; n <= LANES; n++)
        for (int k = 0; k < t.count; k++)
            for (size_t bytes = 1; bytes <= 32; bytes *= 2) {
                memset(to, 0xee, sizeof to);
                memset(should, 0xee, sizeof should);
                for (uint32_t i = 0; i < n; i++) {
                    const uint32_t place = UINT32_MAX - 100 + i;
                    if (bytes < 32)
                        memcpy(should + FREE + i * bytes, element, bytes);
                    else
                        memcpy(should + FREE + i * sizeof place, &place, sizeof place);
                }
                if (bytes < 32)
                    t.of[k]->fill(to + FREE, element, bytes, n);
                else
                    t.of[k]->count((uint32_t *)(void *)(to + FREE), UINT32_MAX - 100, (int)n);
                assert_memory_equal(to, should, sizeof to);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_are_picked_alike),
        cmocka_unit_test(the_greatest_is_found_alike),
        cmocka_unit_test(addresses_become_indices_alike),
        cmocka_unit_test(ranks_are_put_alike),
        cmocka_unit_test(sums_are_alike),
        cmocka_unit_test(what_is_stored_past_the_caches_is_the_same),
        cmocka_unit_test(places_and_numbers_fill_what_they_should),
        cmocka_unit_test(what_shares_the_destination_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
