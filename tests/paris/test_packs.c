/* test_packs.c - sends that are recognised: by addresses made of an enumeration, and by the
 * same addresses again and again. Random programs mix them with what must not be taken for
 * them: other contexts, ranks and addresses changed in between, numbers that come twice. Plain
 * C says what each comes to; the front end alone, its threads together, and kernels give
 * that. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../sample.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { PROGRAMS = 24, STEPS = 40, MOST = 5000, FIELDS = 3, WORD = 32 };

static uint64_t state;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

/* What fields hold; of addresses: whose. */
static struct model {
    unsigned int count;
    uint32_t x[FIELDS][MOST], rank[MOST], to[MOST], same[MOST];
    bool active[MOST];
} model;

static CM_geometry_id_t geometry;
static CM_field_id_t x[FIELDS], rank, to, same;
static unsigned int address_bits;

static CM_sendaddr_t address_of(unsigned int p)
{
    return CM_fe_make_news_coordinate(geometry, 0, p);
}

/* ---- steps ---- */

static void context_load(void)
{
    const unsigned int i = below(FIELDS), bit = below(4);
    if (below(6) == 0) {
        CM_set_context();
        memset(model.active, 1, sizeof model.active);
        return;
    }
    CM_load_context(x[i] + bit);
    for (unsigned int p = 0; p < model.count; p++)
        model.active[p] = model.x[i][p] >> bit & 1;
}

static void enumerate(bool usual)
{
    const bool up = usual || below(3), exclusive = usual || below(3);
    uint32_t before = 0;
    CM_enumerate_1L(rank, 0, WORD, up ? CM_upward : CM_downward,
                    exclusive ? CM_exclusive : CM_inclusive, CM_none, CM_no_field);
    for (unsigned int k = 0; k < model.count; k++) {
        const unsigned int p = up ? k : model.count - 1 - k;
        if (!model.active[p])
            continue;
        model.rank[p] = exclusive ? before : before + 1;
        before++;
    }
}

/* Ranks that are nobody's coordinate are made one's. */
static void addresses_make(void)
{
    for (unsigned int p = 0; p < model.count; p++)
        if (model.active[p] && model.rank[p] >= model.count) {
            CM_u_move_zero_1L(rank, WORD);
            for (unsigned int q = 0; q < model.count; q++)
                model.rank[q] = model.active[q] ? 0 : model.rank[q];
            break;
        }
    CM_make_news_coordinate_1L(geometry, to, 0, rank, WORD);
    for (unsigned int p = 0; p < model.count; p++)
        model.to[p] = model.active[p] ? model.rank[p] : model.to[p];
}

static void send_by(CM_field_id_t address, const uint32_t *index)
{
    static uint32_t sent[MOST];
    const unsigned int from = below(FIELDS), at = below(FIELDS);
    const bool adds = below(4) == 0;
    if (below(4) == 0) { /* to what is one number everywhere */
        bool all = true;
        for (unsigned int p = 0; p < model.count; p++)
            all = all && model.active[p];
        CM_u_move_zero_1L(x[at], WORD);
        for (unsigned int p = 0; p < model.count; p++)
            model.x[at][p] = all || model.active[p] ? 0 : model.x[at][p];
    }
    memcpy(sent, model.x[from], sizeof sent);
    if (adds)
        CM_send_with_u_add_1L(x[at], address, x[from], WORD, CM_no_field);
    else
        CM_send_1L(x[at], address, x[from], WORD, CM_no_field);
    for (unsigned int p = 0; p < model.count; p++)
        if (model.active[p])
            model.x[at][index[p]] = sent[p] + (adds ? model.x[at][index[p]] : 0);
}

static void write_one(void)
{
    const unsigned int p = below(model.count), i = below(FIELDS), other = below(model.count);
    switch (below(4)) {
    case 0:
        CM_u_write_to_processor_1L(address_of(p), rank, other, WORD);
        model.rank[p] = other;
        return;
    case 1:
        CM_u_write_to_processor_1L(address_of(p), to, address_of(other), address_bits);
        model.to[p] = other;
        return;
    case 2:
        CM_u_write_to_processor_1L(address_of(p), same, address_of(other), address_bits);
        model.same[p] = other;
        return;
    default:
        CM_u_write_to_processor_1L(address_of(p), x[i], other, WORD);
        model.x[i][p] = other;
    }
}

static void change(void)
{
    const unsigned int i = below(FIELDS), k = below(FIELDS);
    CM_u_add_2_1L(x[i], x[k], WORD);
    CM_u_add_constant_2_1L(x[i], 7, WORD);
    for (unsigned int p = 0; p < model.count; p++)
        if (model.active[p])
            model.x[i][p] += model.x[k][p] + 7;
}

static void pack(void)
{
    context_load();
    enumerate(true);
    if (below(8) == 0)
        context_load();
    if (below(8) == 0)
        write_one();
    addresses_make();
    if (below(8) == 0)
        write_one();
    if (below(8) == 0)
        context_load();
    send_by(to, model.to);
    if (below(2))
        send_by(to, model.to);
}

static void step(void)
{
    switch (below(8)) {
    case 0:
        enumerate(false);
        return;
    case 1:
        addresses_make();
        return;
    case 2:
        change();
        return;
    case 3:
        write_one();
        return;
    case 4:
        for (unsigned int k = 3 + below(6); k; k--) {
            send_by(same, model.same);
            if (below(4) == 0) /* what the next one writes over is not computed yet */
                change();
            if (below(6) == 0)
                context_load();
            if (below(9) == 0)
                write_one();
        }
        return;
    default:
        pack();
    }
}

/* ---- programs ---- */

/* A permutation, or numbers of which some come twice. */
static void same_make(void)
{
    static uint32_t words[MOST];
    const bool distinct = below(2);
    for (unsigned int p = 0; p < model.count; p++)
        model.same[p] = distinct ? p : below(model.count);
    for (unsigned int p = model.count - 1; distinct && p; p--) {
        const unsigned int k = below(p + 1);
        const uint32_t kept = model.same[p];
        model.same[p] = model.same[k];
        model.same[k] = kept;
    }
    for (unsigned int p = 0; p < model.count; p++)
        words[p] = model.same[p];
    assert_int_equal(machine_field_upload(paris_machine(), rank, MACHINE_UINT(WORD), words),
                     MACHINE_OK);
    CM_make_news_coordinate_1L(geometry, same, 0, rank, WORD);
    CM_make_news_coordinate_1L(geometry, to, 0, rank, WORD);
    memcpy(model.rank, model.same, sizeof model.rank);
    memcpy(model.to, model.same, sizeof model.to);
}

static void fields_make(void)
{
    for (int i = 0; i < FIELDS; i++) {
        x[i] = CM_allocate_heap_field(WORD);
        for (unsigned int p = 0; p < model.count; p++)
            model.x[i][p] = below(1u << 31);
        assert_int_equal(
            machine_field_upload(paris_machine(), x[i], MACHINE_UINT(WORD), model.x[i]),
            MACHINE_OK);
    }
    rank = CM_allocate_heap_field(WORD);
    to = CM_allocate_heap_field(address_bits);
    same = CM_allocate_heap_field(address_bits);
    same_make();
}

static void field_is(CM_field_id_t field, const uint32_t *expected, const char *what,
                     int program, int at)
{
    static uint32_t got[MOST];
    assert_int_equal(machine_field_download(paris_machine(), field, MACHINE_UINT(WORD), got),
                     MACHINE_OK);
    for (unsigned int p = 0; p < model.count; p++)
        if (got[p] != expected[p])
            fail_msg("program %d, step %d, %s: processor %u of %u has %x, not %x", program, at,
                     what, p, model.count, got[p], expected[p]);
}

static void program_run(int program, const char *near, const char *interpret)
{
    static const unsigned int counts[] = {1, 37, 64, 100, 700, 1024, 4500, MOST};
    struct machine_config config = machine_config_default();
    state = 88172645463325252u + (uint64_t)program * 7919;
    setenv("LUTETIA_NEAR", near, 1);
    setenv("LUTETIA_INTERPRET", interpret, 1);
    config.processors_count = 16;
    assert_true(paris_reset(&config));
    model.count = counts[program % (int)(sizeof counts / sizeof *counts)];
    geometry = CM_create_geometry((unsigned int[]){model.count}, 1);
    CM_set_vp_set(CM_allocate_vp_set(geometry));
    CM_set_context();
    memset(model.active, 1, sizeof model.active);
    address_bits = CM_geometry_send_address_length(geometry);
    fields_make();
    for (int at = 0; at < STEPS; at++) {
        step();
        const unsigned int i = below(FIELDS);
        if (below(2))
            field_is(x[i], model.x[i], "a field", program, at);
    }
    for (int i = 0; i < FIELDS; i++)
        field_is(x[i], model.x[i], "a field", program, STEPS);
    field_is(rank, model.rank, "the ranks", program, STEPS);
}

static void by_the_front_end(void **unused)
{
    (void)unused;
    for (int i = 0; i < PROGRAMS; i++)
        program_run(i, "1", "1");
}

static void as_byte_code(void **unused)
{
    (void)unused;
    for (int i = 0; i < PROGRAMS; i++)
        program_run(i, "1", "2");
}

static void by_all_threads(void **unused)
{
    (void)unused;
    for (int i = 0; i < PROGRAMS; i++)
        program_run(i, "2", "2");
}

static void by_kernels(void **unused)
{
    (void)unused;
    for (int i = 0; i < PROGRAMS; i += 5)
        program_run(i, "0", "2");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_the_front_end),
        cmocka_unit_test(as_byte_code),
        cmocka_unit_test(by_all_threads),
        cmocka_unit_test(by_kernels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
