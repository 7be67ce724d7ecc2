/* Lenient mode: an access beyond a field's end reaches the bits after the field. A model in
 * plain C keeps each VP set's stack and heap as one row of bits, with fields in the order of
 * their allocation. Random programs store and read across the ends of fields, and must leave
 * the model's bits. Further tests: which calls pass, which stay errors, and their messages. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "../lutetia/child.h"
#include "paris_internal.h"
#include <cm/paris.h>

#define V(...) ((CM_vector_t){.ints = (const int[]){__VA_ARGS__}})

enum { SETS = 2, REGIONS = 2, FIELDS = 12, BITS = 40 * FIELDS, PROGRAMS = 40, STEPS = 60 };

static uint64_t state = 88172645463325252u;

static unsigned int below(unsigned int n)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (unsigned int)(state >> 33) % n;
}

/* ---- the model ---- */

/* All processors of a set hold the same bits, so that constants suffice and no kernels are
 * needed. */
struct memory {
    CM_field_id_t fields[FIELDS];
    unsigned int starts[FIELDS + 1]; /* bit of the row where each begins */
    int count;
    unsigned char bits[BITS + 64];
};

static CM_vp_set_id_t sets[SETS];
static struct memory memories[SETS][REGIONS];

static uint64_t model_read(const struct memory *m, unsigned int at, unsigned int bits)
{
    uint64_t v = 0;
    for (unsigned int i = 0; i < bits; i++)
        if (at + i < m->starts[m->count])
            v |= (uint64_t)m->bits[at + i] << i;
    return v;
}

static void model_write(struct memory *m, unsigned int at, unsigned int bits, uint64_t v)
{
    for (unsigned int i = 0; i < bits; i++)
        if (at + i < m->starts[m->count])
            m->bits[at + i] = v >> i & 1;
}

static void allocate(int set, int region)
{
    struct memory *m = &memories[set][region];
    unsigned int bits = 1 + below(40);
    if (m->count == FIELDS)
        return;
    m->fields[m->count] = region ? CM_allocate_heap_field_vp_set(bits, sets[set])
                                 : CM_allocate_stack_field_vp_set(bits, sets[set]);
    memset(m->bits + m->starts[m->count], 0, bits);
    m->starts[m->count + 1] = m->starts[m->count] + bits;
    m->count++;
}

static void deallocate(int set)
{
    struct memory *m = &memories[set][0];
    if (!m->count)
        return;
    /* All sets share one stack: deallocating would also free newer fields of the other set. So
     * only the newest field is freed. */
    CM_field_id_t last = m->fields[m->count - 1];
    for (int other = 0; other < SETS; other++) {
        const struct memory *o = &memories[other][0];
        if (other != set && o->count && CM_is_stack_field_newer(o->fields[o->count - 1], last))
            return;
    }
    CM_deallocate_stack_through(last);
    m->count--;
}

static void check_all(int program)
{
    for (int set = 0; set < SETS; set++)
        for (int region = 0; region < REGIONS; region++) {
            const struct memory *m = &memories[set][region];
            CM_set_vp_set(sets[set]);
            for (int i = 0; i < m->count; i++) {
                unsigned int bits = m->starts[i + 1] - m->starts[i];
                uint64_t is = CM_u_read_from_processor_long_1L(3, m->fields[i], bits);
                if (is != model_read(m, m->starts[i], bits))
                    fail_msg("program %d: field %d of set %d, region %d: %llx, not %llx",
                             program, i, set, region, (unsigned long long)is,
                             (unsigned long long)model_read(m, m->starts[i], bits));
            }
        }
}

static void step(int program)
{
    int set = (int)below(SETS), region = (int)below(REGIONS);
    struct memory *m = &memories[set][region];
    unsigned int what = below(8);
    if (what == 0)
        allocate(set, region);
    else if (what == 1)
        deallocate(set);
    if (what < 2 || !m->count)
        return;
    CM_set_vp_set(sets[set]);
    int i = (int)below((unsigned int)m->count);
    unsigned int offset = below(m->starts[i + 1] - m->starts[i] + 30), bits = 1 + below(64);
    unsigned int at = m->starts[i] + offset;
    uint64_t v =
        (uint64_t)below(1u << 30) << 34 ^ (uint64_t)below(1u << 30) << 10 ^ below(1024);
    if (bits < 64)
        v &= (UINT64_C(1) << bits) - 1;
    if (what < 5) {
        CM_u_move_constant_1L(m->fields[i] + offset, v, bits);
        model_write(m, at, bits, v);
        return;
    }
    uint64_t is = CM_u_read_from_processor_long_1L(below(8), m->fields[i] + offset, bits);
    if (is != model_read(m, at, bits))
        fail_msg("program %d: %u bits from %u of field %d on: %llx, not %llx", program, bits,
                 offset, i, (unsigned long long)is,
                 (unsigned long long)model_read(m, at, bits));
}

static void random_programs_go_on_past_ends(void **unused)
{
    (void)unused;
    for (int program = 0; program < PROGRAMS; program++) {
        CM_init();
        CM_set_safety_mode(0);
        memset(memories, 0, sizeof memories);
        for (int set = 0; set < SETS; set++)
            sets[set] = CM_allocate_vp_set(CM_create_geometry(V(16 >> set), 1));
        for (int i = 0; i < STEPS; i++)
            step(program);
        check_all(program);
    }
    paris_safety_usual();
}

/* Overruns with values that differ between processors, under a context, and of fields longer
 * than a number. */
static void processors_differ_and_long_fields_go_on(void **unused)
{
    (void)unused;
    CM_init();
    CM_set_safety_mode(0);
    CM_field_id_t a = CM_allocate_stack_field(8), b = CM_allocate_stack_field(100),
                  c = CM_allocate_stack_field(100), far = CM_allocate_heap_field(208);
    CM_my_send_address(a);
    CM_u_move_constant_1L(b, 5, 8);
    CM_u_move_constant_1L(CM_add_offset_to_field_id(b, 92), 0x77, 8);
    CM_u_move_constant_1L(c, 0x99, 8);
    CM_u_lt_constant_1L(a, 8, 8);
    CM_logand_context_with_test();
    CM_u_move_always_1L(far, a, 208);
    CM_u_add_constant_2_1L(a, 256, 16); /* into b, where active */
    for (unsigned int p = 0; p < 16; p++) {
        assert_int_equal(CM_u_read_from_processor_1L(p, far, 8), p);
        assert_int_equal(CM_u_read_from_processor_1L(p, far + 8, 8), 5);
        assert_int_equal(CM_u_read_from_processor_1L(p, far + 100, 8), 0x77);
        assert_int_equal(CM_u_read_from_processor_1L(p, far + 108, 8), 0x99);
        assert_int_equal(CM_u_read_from_processor_1L(p, b, 8), p < 8 ? 6 : 5);
        assert_int_equal(CM_u_read_from_processor_1L(p, a, 8), p);
    }
    CM_u_write_to_processor_1L(9, a, 0x1234, 16);
    assert_int_equal(CM_u_read_from_processor_1L(9, b, 8), 0x12);
    assert_int_equal(CM_u_read_from_processor_1L(8, b, 8), 5);
    paris_safety_usual();
}

static void numbers_of_processors_are_taken_modulo(void **unused)
{
    (void)unused;
    CM_init();
    CM_set_safety_mode(0);
    CM_field_id_t f = CM_allocate_heap_field(32);
    CM_my_send_address(f);
    for (unsigned int p = 16; p < 100; p += 7)
        assert_int_equal(CM_u_read_from_processor_1L(p, f, 32), p % 16);
    CM_u_write_to_processor_1L(35, f, 77, 32);
    assert_int_equal(CM_u_read_from_processor_1L(3, f, 32), 77);
    assert_int_equal(CM_fe_make_news_coordinate(CM_current_geometry, 1, 6),
                     CM_fe_make_news_coordinate(CM_current_geometry, 1, 2));
    assert_int_equal(CM_allocate_heap_field(0) != CM_no_field, 1);
    CM_s_negate_1_1L(f, 1);
    paris_safety_usual();
}

/* ---- what is said, in a child ---- */

static int child_main(const char *what)
{
    CM_init();
    if (*what == 'l')
        CM_set_safety_mode(0);
    CM_field_id_t f = CM_allocate_stack_field(8);
    CM_allocate_stack_field(8);
    CM_u_move_constant_1L(f, 1, 12);
    CM_u_move_constant_1L(f, 1, 13);
    return CM_u_read_from_processor_1L(99, f, 13) != 1;
}

static void run_child(char *what, char *variable, int status, const char *word)
{
    char self[4096];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    assert_true(length > 0);
    self[length] = '\0';
    struct child child = {.arguments = {self, what}, .variables = {variable}};
    child_run(&child);
    char *end = strchr(child.errors, '\n');
    if (child.status != status || !end || end[1] || !strstr(child.errors, word) ||
        strncmp(child.errors, "CM_u_move_constant_1L: ", 23) != 0)
        fail_msg("%s: status %d and \"%s\"", what, child.status, child.errors);
}

static void it_is_said_once_and_strict_is_usual(void **unused)
{
    (void)unused;
    run_child("lenient", "LUTETIA_LENIENT=0", 0, "said once");
    run_child("usual", "LUTETIA_LENIENT=1", 0, "said once");
    run_child("usual", "LUTETIA_LENIENT=0", 1, "over the end");
}

/* ---- messages to nobody ---- */

enum { SENDERS = 3000 };
static const struct lost {
    char *name;
    unsigned int dest_count;
    bool combines, context,
        wrong; /* context: some do not send; wrong: some who send have the address of nobody */
} losses[] = {
    {"overwritten", 1500, false, false, true},
    {"overwritten under a context", 1500, false, true, true},
    {"combined", 1500, true, true, true},
    {"combined in few", 5, true, false, true},
    {"combined in few under a context", 5, true, true, true},
    {"right", 1500, false, false, false},
    {"right where they send", 1500, true, true, false},
    {"right in few where they send", 5, true, true, false},
};
enum { LOSSES = sizeof losses / sizeof *losses };

static int lose(const struct lost *l)
{
    unsigned int senders[1] = {SENDERS}, dests[1] = {l->dest_count};
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dests, 1)));
    const CM_geometry_id_t there = CM_current_geometry;
    const CM_field_id_t dest = CM_allocate_heap_field(32);
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(senders, 1)));
    const CM_field_id_t address = CM_allocate_heap_field(32),
                        coordinate = CM_allocate_heap_field(32);
    CM_my_news_coordinate_1L(coordinate, 0, 32);
    CM_u_mod_constant_2_1L(coordinate, l->dest_count, 32);
    CM_make_news_coordinate_1L(there, address, 0, coordinate, 32);
    CM_my_news_coordinate_1L(coordinate, 0, 32);
    CM_u_ge_constant_1L(coordinate, SENDERS - 7, 32); /* these have wrong ones */
    CM_logand_context_with_test();
    if (l->wrong || l->context)
        CM_u_move_constant_1L(address, l->dest_count == 5 ? 7 : 2047, 32);
    CM_set_context();
    CM_u_lt_constant_1L(coordinate, l->wrong ? SENDERS - 2 : SENDERS - 7, 32);
    if (l->context)
        CM_logand_context_with_test();
    for (int i = 0; i < 6; i++)
        if (l->combines)
            CM_send_with_u_add_1L(dest, address, coordinate, 32, CM_no_field);
        else
            CM_send_1L(dest, address, coordinate, 32, CM_no_field);
    return 0;
}

/* In all ways to send. */
static void messages_to_nobody_are_said_once(void **unused)
{
    static char *const ways[] = {"LUTETIA_NEAR=1", "LUTETIA_NEAR=2", "LUTETIA_NEAR=0"};
    char self[4096];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    (void)unused;
    assert_true(length > 0);
    self[length] = '\0';
    for (int i = 0; i < LOSSES; i++)
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
            if (w && i % 2 == (int)w - 1) /* each of these ways has half of them */
                continue;
            struct child child = {.arguments = {self, losses[i].name}, .variables = {ways[w]}};
            child_run(&child);
            const char *end = strchr(child.errors, '\n');
            if (child.status ||
                (losses[i].wrong
                     ? !end || end[1] || strncmp(child.errors, "CM_send_", 8) ||
                           !strstr(child.errors, "of no processor") ||
                           !strstr(child.errors, losses[i].context ? "in 5 " : "in 7 ")
                     : child.errors[0] != '\0'))
                fail_msg("%s, %s: status %d and \"%s\"", losses[i].name, ways[w], child.status,
                         child.errors);
        }
}

int main(int argc, char **argv)
{
    setenv("LUTETIA_PROCESSORS", "16", 1);
    unsetenv("LUTETIA_LEDS");
    if (argc == 2)
        for (int i = 0; i < LOSSES; i++)
            if (!strcmp(argv[1], losses[i].name))
                return lose(&losses[i]);
    if (argc == 2)
        return child_main(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_programs_go_on_past_ends),
        cmocka_unit_test(processors_differ_and_long_fields_go_on),
        cmocka_unit_test(numbers_of_processors_are_taken_modulo),
        cmocka_unit_test(it_is_said_once_and_strict_is_usual),
        cmocka_unit_test(messages_to_nobody_are_said_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
