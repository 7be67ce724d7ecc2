/* Compares the router, aliases and coordinates of C/Paris with plain loops: each instruction in
 * each form, between VP sets of both orders. tests/machine/test_router.c and test_aliases.c
 * test the machine's part. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "words.h"

enum { PHYSICAL = 16, FROM = 90, TO = 128, MOST = WORDS_MOST }; /* ROWS * COLUMNS is 65 */

#define V(v) ((CM_vector_t){.ints = v})

static CM_vp_set_id_t news, line; /* news: 9 x 10 in NEWS order; line: 128 in send order */
static CM_geometry_id_t news_geometry, line_geometry;
static CM_field_id_t address, context_bit;
static unsigned int where[FROM];
static bool active[FROM];

/* ---- sends ---- */

static double value_of(uint64_t bits, unsigned int len)
{
    float f;
    double d;
    uint32_t low = (uint32_t)bits;
    memcpy(&f, &low, sizeof f);
    memcpy(&d, &bits, sizeof d);
    return len == 32 ? f : d;
}

static uint64_t bits_of(double x, unsigned int len)
{
    float f = (float)x;
    uint32_t low;
    uint64_t bits;
    memcpy(&low, &f, sizeof low);
    memcpy(&bits, &x, sizeof bits);
    return len == 32 ? low : bits;
}

static int64_t extended(uint64_t x, unsigned int len)
{
    return (int64_t)(x << (64 - len)) >> (64 - len);
}

/* Combines a and b. op: + < > (add, min, max) & | ^ =; letter: the operands' type. */
static uint64_t joined(char op, char letter, unsigned int len, uint64_t a, uint64_t b)
{
    double x = value_of(a, len), y = value_of(b, len);
    bool less = letter == 'f'   ? x < y
                : letter == 's' ? extended(a, len) < extended(b, len)
                                : a < b;
    switch (op) {
    case '+':
        if (letter == 'f' && len == 32)
            return bits_of((double)((float)x + (float)y), 32);
        return letter == 'f' ? bits_of(x + y, 64) : cut(a + b, len);
    case '<':
        return less ? a : b;
    case '>':
        return less || a == b ? b : a;
    case '&':
        return a & b;
    case '|':
        return a | b;
    case '^':
        return a ^ b;
    default:
        return b;
    }
}

typedef void (*send_1)(CM_field_id_t, CM_field_id_t, CM_field_id_t, unsigned int,
                       CM_field_id_t);
typedef void (*send_f)(CM_field_id_t, CM_field_id_t, CM_field_id_t, unsigned int, unsigned int,
                       CM_field_id_t);

#define BOTH(name) CM_##name##_1L, CM_##name
static const struct {
    char op, letter;
    unsigned int len;
    send_1 call[2];
} sends[] = {
    {'=', 'u', 32, {BOTH(send)}},
    {'=', 'u', 17, {BOTH(send_with_overwrite)}},
    {'&', 'u', 32, {BOTH(send_with_logand)}},
    {'|', 'u', 32, {BOTH(send_with_logior)}},
    {'^', 'u', 32, {BOTH(send_with_logxor)}},
    {'+', 'u', 32, {BOTH(send_with_u_add)}},
    {'+', 's', 30, {BOTH(send_with_s_add)}},
    {'<', 'u', 32, {BOTH(send_with_u_min)}},
    {'<', 's', 25, {BOTH(send_with_s_min)}},
    {'>', 'u', 32, {BOTH(send_with_u_max)}},
    {'>', 's', 32, {BOTH(send_with_s_max)}},
};
static const struct {
    char op;
    unsigned int s, e;
    send_f call[2];
} float_sends[] = {
    {'+', 23, 8, {BOTH(send_with_f_add)}},
    {'<', 23, 8, {BOTH(send_with_f_min)}},
    {'>', 52, 11, {BOTH(send_with_f_max)}},
};

static CM_field_id_t field_in(CM_vp_set_id_t set, unsigned int len, const uint64_t *x)
{
    CM_vp_set_id_t here = CM_current_vp_set;
    CM_set_vp_set(set);
    CM_field_id_t f = CM_allocate_stack_field(len);
    if (x)
        put(f, len, x);
    CM_set_vp_set(here);
    return f;
}

static void is_in(const char *what, CM_vp_set_id_t set, CM_field_id_t f, unsigned int len,
                  const uint64_t *wanted)
{
    uint64_t got[MOST];
    CM_vp_set_id_t here = CM_current_vp_set;
    CM_set_vp_set(set);
    get(f, len, got);
    expect(what, got, wanted, (int)CM_geometry_total_processors(CM_current_geometry));
    CM_set_vp_set(here);
}

static void send_arrives(int i, bool is_float, int spelling)
{
    unsigned int len = is_float ? float_sends[i].s + float_sends[i].e + 1 : sends[i].len;
    char op = is_float ? float_sends[i].op : sends[i].op;
    char letter = is_float ? 'f' : sends[i].letter;
    uint64_t source[FROM], dest[TO], told[TO] = {0};
    random_words(source, FROM, len);
    random_words(dest, TO, len);
    for (int n = 0; is_float && n < FROM; n++)
        source[n] = bits_of((double)(int64_t)device_random() / 1e17, len);
    for (int n = 0; is_float && n < TO; n++)
        dest[n] = bits_of((double)(int64_t)device_random() / 1e18, len);
    CM_field_id_t s = field_in(news, len, source), d = field_in(line, len, dest),
                  bit = field_in(line, 1, NULL), notify = spelling ? CM_no_field : bit;
    if (is_float)
        float_sends[i].call[spelling](d, address, s, float_sends[i].s, float_sends[i].e,
                                      notify);
    else
        sends[i].call[spelling](d, address, s, len, notify);
    for (int n = 0; n < FROM; n++)
        if (active[n]) {
            dest[where[n]] = joined(op, letter, len, dest[where[n]], source[n]);
            told[where[n]] = spelling == 0;
        }
    char what[32];
    snprintf(what, sizeof what, "send %c, %c, spelling %d", op, letter, spelling);
    is_in(what, line, d, len, dest);
    is_in("notify", line, bit, 1, told);
    CM_deallocate_stack_through(s);
}

static void sends_combine(void **unused)
{
    (void)unused;
    for (int spelling = 0; spelling < 2; spelling++) {
        for (int i = 0; i < (int)(sizeof sends / sizeof *sends); i++)
            send_arrives(i, false, spelling);
        for (int i = 0; i < (int)(sizeof float_sends / sizeof *float_sends); i++)
            send_arrives(i, true, spelling);
    }
    assert_string_equal(device_message, "");
}

static void complex_sums_arrive(void **unused)
{
    (void)unused;
    uint64_t re[FROM], im[FROM], a[TO] = {0}, b[TO] = {0};
    for (int n = 0; n < FROM; n++) {
        re[n] = bits_of(n * 0.1, 32);
        im[n] = bits_of(-n * 0.7, 32);
    }
    CM_field_id_t s = field_in(news, 64, NULL), d = field_in(line, 64, NULL);
    put(s, 32, re);
    put(s + 32, 32, im);
    CM_send_with_c_add_1L(d, address, s, 23, 8, CM_no_field);
    for (int n = 0; n < FROM; n++)
        if (active[n]) {
            a[where[n]] = joined('+', 'f', 32, a[where[n]], re[n]);
            b[where[n]] = joined('+', 'f', 32, b[where[n]], im[n]);
        }
    is_in("real parts", line, d, 32, a);
    is_in("imaginary parts", line, d + 32, 32, b);
    CM_deallocate_stack_through(s);
}

/* Messages of 200 bits: of two that collide one arrives whole. */
static void long_messages_arrive_whole(void **unused)
{
    (void)unused;
    uint64_t part[4][FROM], wanted[4][TO] = {{0}}, back[4][FROM];
    static const unsigned int lens[4] = {64, 64, 64, 8};
    CM_field_id_t s = field_in(news, 200, NULL), d = field_in(line, 200, NULL),
                  g = field_in(news, 200, NULL), bit = field_in(line, 1, NULL);
    for (unsigned int k = 0; k < 4; k++) {
        random_words(part[k], FROM, lens[k]);
        put(s + 64 * k, lens[k], part[k]);
    }
    CM_send_1L(d, address, s, 200, bit);
    CM_send_1L(d, address, s, 0, bit);
    CM_get_1L(g, address, d, 200);
    for (int n = 0; n < FROM; n++)
        for (int k = 0; k < 4; k++)
            if (active[n])
                wanted[k][where[n]] = part[k][n];
    for (unsigned int k = 0; k < 4; k++) {
        for (int n = 0; n < FROM; n++)
            back[k][n] = active[n] ? wanted[k][where[n]] : 0;
        is_in("200 bits there", line, d + 64 * k, lens[k], wanted[k]);
        is_in("200 bits back", news, g + 64 * k, lens[k], back[k]);
    }
    CM_deallocate_stack_through(s);
}

static void gets_fetch(void **unused)
{
    (void)unused;
    uint64_t x[TO], old[FROM], wanted[FROM];
    random_words(x, TO, 32);
    random_words(old, FROM, 32);
    CM_field_id_t s = field_in(line, 32, x), d = field_in(news, 32, old),
                  e = field_in(news, 32, old);
    CM_get_1L(d, address, s, 32);
    CM_get(e, address, s, 32);
    for (int n = 0; n < FROM; n++)
        wanted[n] = active[n] ? x[where[n]] : old[n];
    is_in("get", news, d, 32, wanted);
    is_in("get, older spelling", news, e, 32, wanted);
    CM_deallocate_stack_through(s);
}

/* ---- fixed patterns ---- */

static void powers_of_two_are_far(void **unused)
{
    (void)unused;
    uint64_t x[FROM], got[FROM], always[FROM], old[FROM];
    random_words(x, FROM, 32);
    random_words(old, FROM, 32);
    CM_field_id_t s = field_in(news, 32, x), d = field_in(news, 32, old);
    for (unsigned int log = 0; log < 4; log += 3)
        for (unsigned int direction = 0; direction < 2; direction++) {
            put(d, 32, old);
            CM_get_from_power_two_1L(d, s, 1, log, direction, 32);
            get(d, 32, got);
            CM_get_from_power_two_always(d, s, 0, log, direction, 32);
            get(d, 32, always);
            for (int n = 0; n < FROM; n++) {
                int far = direction == CM_upward ? 1 << log : -(1 << log);
                int column = (n % 10 + far + 100) % 10, row = (n / 10 + far + 90) % 9;
                assert_int_equal(got[n], active[n] ? x[n / 10 * 10 + column] : old[n]);
                assert_int_equal(always[n], x[row * 10 + n % 10]);
            }
        }
    CM_deallocate_stack_through(s);
}

static void moves_cross_vp_sets(void **unused)
{
    (void)unused;
    uint64_t x[FROM], old[FROM], wanted[2][FROM];
    int length = FROM;
    struct CM_axis_descriptor axis = {.length = FROM, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_vp_set_id_t other = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
    (void)length;
    random_words(x, FROM, 32);
    random_words(old, FROM, 32);
    CM_field_id_t s = field_in(news, 32, x), d = field_in(other, 32, old),
                  e = field_in(other, 32, old);
    CM_cross_vp_move_1L(d, s, 32);
    CM_cross_vp_move_always(e, s, 32);
    memcpy(wanted[0], old, sizeof old);
    memcpy(wanted[1], old, sizeof old);
    for (int n = 0; n < FROM; n++) {
        unsigned int at = (unsigned int)n % PHYSICAL * 6 + (unsigned int)n / PHYSICAL;
        if (at < FROM && active[n])
            wanted[0][at] = x[n];
        if (at < FROM)
            wanted[1][at] = x[n];
    }
    is_in("across", other, d, 32, wanted[0]);
    is_in("all across", other, e, 32, wanted[1]);
    CM_deallocate_stack_through(s);
    CM_deallocate_vp_set(other);
}

/* ---- coordinates ---- */

static void coordinates_and_addresses_agree(void **unused)
{
    (void)unused;
    int dimensions[3] = {5, 3, 6}; /* 90 VPs, a VP ratio of 6 */
    CM_geometry_id_t g = CM_create_geometry(V(dimensions), 3);
    unsigned int bits = CM_geometry_send_address_length(g);
    uint64_t c[FROM], of[FROM], got[8][FROM], old[FROM], r[FROM];
    CM_field_id_t a = field_in(news, bits, NULL), coordinate = field_in(news, 8, NULL), f[8];
    for (int n = 0; n < FROM; n++) {
        of[n] = CM_fe_deposit_news_coordinate(
            g,
            CM_fe_deposit_news_coordinate(g,
                                          CM_fe_make_news_coordinate(g, 0, (unsigned int)n % 5),
                                          1, (unsigned int)n / 5 % 3),
            2, (unsigned int)n / 15);
        c[n] = (uint64_t)n % 3;
    }
    random_words(old, FROM, bits);
    put(coordinate, 8, c);
    for (int i = 0; i < 8; i++) {
        f[i] = field_in(news, 32, NULL);
        put(f[i], bits, i == 2 || i == 3 || i == 4 ? of : old);
    }
    put(a, bits, of);
    CM_make_news_coordinate_1L(g, f[0], 1, coordinate, 8);
    CM_make_news_coordinate_always_1L(g, f[1], 2, coordinate, 8);
    CM_deposit_news_coordinate_1L(g, f[2], 1, coordinate, 8);
    CM_deposit_news_coordinate_always_1L(g, f[3], 0, coordinate, 8);
    CM_deposit_news_constant_1L(g, f[4], 2, 4, 8);
    CM_extract_news_coordinate_1L(g, f[5], 2, a, bits);
    CM_extract_news_coordinate_always_1L(g, f[6], 0, a, bits);
    CM_extract_multi_coordinate_1L(g, f[7], 5, a, bits);
    for (int i = 0; i < 8; i++)
        get(f[i], bits, got[i]);
    for (int n = 0; n < FROM; n++) {
        unsigned int at = (unsigned int)of[n], v = (unsigned int)c[n];
        bool on = active[n];
        assert_int_equal(got[0][n], on ? CM_fe_make_news_coordinate(g, 1, v) : old[n]);
        assert_int_equal(got[1][n], CM_fe_make_news_coordinate(g, 2, v));
        assert_int_equal(got[2][n], on ? CM_fe_deposit_news_coordinate(g, at, 1, v) : at);
        assert_int_equal(got[3][n], CM_fe_deposit_news_coordinate(g, at, 0, v));
        assert_int_equal(got[4][n], on ? CM_fe_deposit_news_coordinate(g, at, 2, 4) : at);
        assert_int_equal(got[5][n], on ? n / 15 : (int)old[n]);
        assert_int_equal(got[6][n], n % 5);
        r[n] = (uint64_t)(n % 5 * 6 + n / 15);
        assert_int_equal(CM_fe_extract_multi_coordinate(g, 5, at), r[n]);
        assert_int_equal(got[7][n], on ? r[n] : old[n]);
    }
    CM_deallocate_stack_through(a);
    CM_deallocate_geometry(g);
}

static void geometries_say_what_they_are(void **unused)
{
    (void)unused;
    struct CM_axis_descriptor a = {.length = 8, .weight = 3, .ordering = CM_send_order},
                              b = {.length = 16, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[2] = {&a, &b};
    CM_geometry_id_t g = CM_intern_detailed_geometry(axes, 2), h;
    b.ordering = CM_news_order;
    h = CM_create_detailed_geometry(axes, 2);
    assert_int_equal(CM_geometry_axis_weight(g, 0), 3);
    assert_int_equal(CM_geometry_axis_on_chip_bits(g, 0), 0);
    assert_int_equal(CM_geometry_axis_on_chip_pos(g, 0), 0);
    assert_int_equal(CM_geometry_total_vp_ratio(g), 8);
    /* In send order addresses are row-major: 8 VPs of a row share one processor. */
    assert_int_equal(CM_geometry_axis_vp_ratio(g, 0), 1);
    assert_int_equal(CM_geometry_axis_vp_ratio(g, 1), 8);
    assert_int_equal(CM_geometry_axis_off_chip_bits(g, 0), 3);
    assert_int_equal(CM_geometry_axis_off_chip_bits(g, 1), 1);
    assert_int_equal(CM_geometry_axis_off_chip_pos(g, 0), 1);
    assert_int_equal(CM_geometry_axis_off_chip_pos(g, 1), 0);
    assert_true(CM_geometry_serial_number(g) != CM_geometry_serial_number(h));
    /* The weights 3 and 1 make subgrids of 4 by 2. */
    assert_int_equal(CM_geometry_axis_vp_ratio(h, 0), 4);
    assert_int_equal(CM_geometry_axis_vp_ratio(h, 1), 2);
    assert_int_equal(CM_fe_make_news_coordinate(g, 0, 1), 16);
    assert_int_equal(CM_fe_make_news_coordinate(g, 1, 1), 1);
    assert_int_equal(CM_fe_make_news_coordinate(h, 1, 1), 1);
    assert_int_equal(CM_fe_make_news_coordinate(h, 0, 1), 2);
    assert_int_equal(CM_fe_make_news_coordinate(h, 1, 2), 8);
    /* The same processors in another geometry. */
    CM_vp_set_id_t set = CM_allocate_vp_set(g);
    uint64_t x[TO], wanted[TO];
    random_words(x, TO, 32);
    CM_field_id_t f = field_in(set, 32, x);
    CM_set_vp_set_geometry(set, h);
    assert_int_equal(CM_vp_set_geometry(set), h);
    for (int n = 0; n < TO; n++)
        wanted[n] = x[CM_fe_deposit_news_coordinate(
            h, CM_fe_make_news_coordinate(h, 0, (unsigned int)n / 16), 1,
            (unsigned int)n % 16)];
    is_in("another geometry", set, f, 32, wanted);
    assert_int_equal(CM_u_read_from_processor_1L(77, f, 32), (unsigned int)x[77]);
    CM_deallocate_geometry(g);
    CM_deallocate_vp_set(set);
}

/* ---- aliases ---- */

static void aliases_are_the_same_memory(void **unused)
{
    (void)unused;
    CM_vp_set_id_t before = CM_current_vp_set;
    struct CM_axis_descriptor axis = {
        .length = PHYSICAL, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_vp_set_id_t one = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
    uint64_t x[TO], got[PHYSICAL];
    random_words(x, TO, 32);
    CM_set_vp_set(one);
    CM_field_id_t whole = CM_allocate_stack_field(8 * 32), none = CM_allocate_stack_field(0);
    CM_set_vp_set(line);
    CM_field_id_t alias = CM_make_field_alias(whole), nothing = CM_make_field_alias(none);
    assert_true(CM_is_field_an_alias(alias) && !CM_is_field_an_alias(whole));
    assert_int_equal(CM_field_vp_set(alias), line);
    assert_int_equal(CM_field_length(alias), 32);
    put(alias, 32, x);
    CM_u_write_to_processor_1L(19, alias, 77777, 32);
    x[19] = 77777;
    assert_int_equal(CM_u_read_from_processor_1L(127, alias, 32), (unsigned int)x[127]);
    CM_set_vp_set(one);
    for (unsigned int i = 0; i < 8; i++) {
        get(CM_add_offset_to_field_id(whole, 32 * (int)i), 32, got);
        for (unsigned int p = 0; p < PHYSICAL; p++)
            assert_int_equal(got[p], x[p * 8 + i]);
    }
    CM_u_write_to_processor_1L(3, whole + 96, 4242, 32);
    CM_set_vp_set(line);
    assert_int_equal(CM_u_read_from_processor_1L(27, alias, 32), 4242);
    CM_remove_field_alias(nothing);
    CM_change_field_alias(alias, whole + 128);
    assert_int_equal(CM_field_length(alias), 16);
    assert_int_equal(CM_u_read_from_processor_1L(5, alias, 16), (unsigned int)x[6] >> 16);
    CM_deallocate_stack_through(whole);
    assert_false(CM_is_field_valid(alias));
    CM_set_vp_set(before);
    CM_deallocate_vp_set(one);
    assert_string_equal(device_message, "");
}

/* ---- arrays in send order ---- */

static void arrays_in_send_order_are_addresses(void **unused)
{
    (void)unused;
    struct CM_axis_descriptor a = {.length = 6, .weight = 1, .ordering = CM_send_order},
                              b = {.length = 7, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[2] = {&a, &b};
    CM_vp_set_id_t before = CM_current_vp_set,
                   set = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 2));
    static unsigned short array[10][20], back[10][20];
    int offset[2] = {3, 5}, start[2] = {1, 2}, end[2] = {5, 7}, axis[2] = {0, 1},
        dimensions[2] = {10, 20}, zero[2] = {0, 0}, none[2] = {0, 0}, swapped[2] = {1, 0};
    CM_set_vp_set(set);
    CM_field_id_t f = CM_allocate_stack_field(16);
    for (int y = 0; y < 10; y++)
        for (int x = 0; x < 20; x++)
            array[y][x] = (unsigned short)(1000 * y + x);
    CM_u_write_to_news_array_1L(array, V(offset), V(start), V(end), V(axis), f, 16, 2,
                                V(dimensions), CM_16_bit);
    /* An empty block transfers nothing, whatever the other arguments are. */
    CM_u_write_to_news_array_1L(array, V(zero), V(start), V(start), V(axis), f, 16, 2, V(none),
                                CM_16_bit);
    CM_u_read_from_news_array_1L(NULL, V(zero), V(zero), V(zero), V(axis), f, 16, 2, V(none),
                                 CM_16_bit);
    assert_string_equal(device_message, "");
    for (int y = 0; y < 6; y++)
        for (int x = 0; x < 7; x++) {
            bool in = y >= 1 && y < 5 && x >= 2;
            assert_int_equal(CM_u_read_from_processor_1L((unsigned int)(y * 7 + x), f, 16),
                             in ? 1000 * (y - 1 + 3) + x - 2 + 5 : 0);
        }
    int start2[2] = {2, 1}, end2[2] = {7, 5};
    CM_u_read_from_news_array_1L(back, V(offset), V(start2), V(end2), V(swapped), f, 16, 2,
                                 V(dimensions), CM_16_bit);
    for (int x = 0; x < 5; x++)
        for (int y = 0; y < 4; y++)
            assert_int_equal(back[x + 3][y + 5], array[y + 3][x + 5]);
    CM_deallocate_stack_through(f);
    CM_set_vp_set(before);
    CM_deallocate_vp_set(set);
}

/* ---- wrong calls ---- */

static void wrong_calls_are_told(void **unused)
{
    (void)unused;
    uint64_t far[FROM];
    CM_field_id_t d = field_in(line, 32, NULL), s = field_in(news, 32, NULL),
                  nowhere = field_in(news, 32, NULL), dead = field_in(news, 8, NULL);
    CM_deallocate_stack_through(dead);
    for (int n = 0; n < FROM; n++)
        far[n] = 95; /* an address among the 96 places of 90 VPs, where there is no VP */
    put(nowhere, 32, far);
    for (unsigned int safety = 0; safety < 2; safety++) {
        safety ? CM_set_safety_mode(1) : paris_safety_usual();
        device_message[0] = '\0';
        CM_send_1L(dead, address, s, 32, CM_no_field);
        device_said("CM_send_1L", "dest");
        CM_send_1L(d, dead, s, 32, CM_no_field);
        device_said("CM_send_1L", "send_address");
        CM_send_1L(d, address, CM_no_field, 32, CM_no_field);
        device_said("CM_send_1L", "source");
        CM_send_1L(d, address, s, 33, CM_no_field);
        device_said("CM_send_1L", "bits");
        CM_send_with_u_add_1L(d, address, s, 32, s);
        device_said("CM_send_with_u_add_1L", "notify");
        CM_send_with_u_add_1L(d, address, s, 200, CM_no_field);
        device_said("CM_send_with_u_add_1L", "length");
        CM_get_1L(s, address, dead, 32);
        device_said("CM_get_1L", "source");
        CM_get_1L(d, address, s, 32);
        device_said("CM_get_1L", "VP set");
        CM_remove_field_alias(s);
        device_said("CM_remove_field_alias", "alias");
        CM_make_field_alias(dead);
        device_said("CM_make_field_alias", "field");
        CM_change_field_alias(s, d);
        device_said("CM_change_field_alias", "alias");
        CM_set_vp_set_geometry(line, news_geometry);
        device_said("CM_set_vp_set_geometry", "geometry");
        CM_get_from_power_two_1L(s, s, 2, 0, 0, 32);
        device_said("CM_get_from_power_two_1L", "axis");
        CM_make_news_coordinate_1L(news_geometry, s, 2, s, 8);
        device_said("CM_make_news_coordinate_1L", "axis");
        CM_deposit_news_constant_1L(news_geometry, s, 1, 10, 8);
        device_said("CM_deposit_news_constant_1L", "value");
        CM_send_1L(s, nowhere, s, 32, CM_no_field);
        if (safety)
            device_said("CM_send_1L", "send_address");
        else
            assert_string_equal(device_message, "");
    }
    paris_safety_usual();
    CM_deallocate_stack_through(d);
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    int dimensions[2] = {9, 10};
    struct CM_axis_descriptor axis = {.length = TO, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    news_geometry = CM_create_geometry(V(dimensions), 2);
    line_geometry = CM_create_detailed_geometry(axes, 1);
    news = CM_allocate_vp_set(news_geometry);
    line = CM_allocate_vp_set(line_geometry);
    CM_set_vp_set(news);
    uint64_t x[FROM], bit[FROM];
    for (int n = 0; n < FROM; n++) {
        where[n] =
            (unsigned int)(device_random() % 3 ? device_random() % TO : device_random() % 4);
        x[n] = where[n];
        bit[n] = active[n] = device_random() % 4 != 0;
    }
    address = CM_allocate_heap_field(32);
    context_bit = CM_allocate_heap_field(1);
    put(address, 32, x);
    put(context_bit, 1, bit);
    CM_load_context(context_bit);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sends_combine),
        cmocka_unit_test(complex_sums_arrive),
        cmocka_unit_test(long_messages_arrive_whole),
        cmocka_unit_test(gets_fetch),
        cmocka_unit_test(powers_of_two_are_far),
        cmocka_unit_test(moves_cross_vp_sets),
        cmocka_unit_test(coordinates_and_addresses_agree),
        cmocka_unit_test(geometries_say_what_they_are),
        cmocka_unit_test(aliases_are_the_same_memory),
        cmocka_unit_test(arrays_in_send_order_are_addresses),
        cmocka_unit_test(wrong_calls_are_told),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
