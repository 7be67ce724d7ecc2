/* Random programs whose operands overlap, with several VP sets, aliases, loops and CM_init, in
 * all tiers: what all fields and flags hold is compared with plain bits, in most programs after
 * each call. What fails is a number of a program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "paris_internal.h"
#include "sample.h"
#include "slot_programs.h"
#include "tier.h"
#include <cm/paris.h>

static const struct tier tiers[] = {
    {"as usual", "1", "1", "1", false, 1, NULL, "1"},
    {"without replay", "1", "1", "1", false, 1, NULL, "0"},
    {"byte code", "1", "2", "0", false, 1, NULL, "1"},
    {"byte code, shared out", "2", "2", "0", false, 2, NULL, "1"},
    {"always at once", "1", "2", "2", false, 2, NULL, "1"},
    {"byte code, one instruction at a time", "1", "2", "0", true, 4, NULL, "1"},
    {"kernels", "0", "0", "0", false, 512, NULL, "1"},
    {"kernels, byte code on the device", "0", "3", "0", false, 64, NULL, "1"},
};
enum { TIERS = sizeof tiers / sizeof *tiers, CHUNK = 64 };

static int programs_count = 200, first_program = 401, only_tier = -1;
static struct slot_program program;
static struct slot_memory memory;
static CM_vp_set_id_t sets[SLOT_SETS];
static CM_field_id_t fields[SLOT_FIELDS + 1], flags[SLOT_SETS];

static int position[1] = {0}, axis_first[1] = {0};
static int seed_now;

/* Every call is a valid one. */
static void complain(const char *message)
{
    print_error("program %d: %s\n", seed_now, message);
    exit(1);
}

static void set_up(void)
{
    static struct CM_axis_descriptor axis;
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_init();
    CM_set_error_handler(complain);
    CM_set_safety_mode(program.safe);
    for (int i = 0; i < SLOT_SETS; i++) {
        axis = (struct CM_axis_descriptor){.length = (unsigned int)slot_vps(&program, i),
                                           .weight = 1,
                                           .ordering = CM_send_order};
        sets[i] = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
        CM_set_vp_set(sets[i]);
        flags[i] = CM_allocate_heap_field(3);
    }
    for (int i = 0; i < SLOT_FIELDS; i++) {
        CM_set_vp_set(sets[program.set[i]]);
        fields[i] = i % 2 ? CM_allocate_heap_field((unsigned int)program.bits[i])
                          : CM_allocate_stack_field((unsigned int)program.bits[i]);
    }
}

static CM_field_id_t at(struct slot_part part)
{
    return fields[part.field] + (unsigned int)part.at;
}

static void write_all(const struct slot_step *s)
{
    static uint64_t numbers[SLOT_VPS];
    int count[1] = {slot_vps(&program, s->set)};
    for (int vp = 0; vp < count[0]; vp++)
        numbers[vp] = slot_number(s->number, vp, s->length);
    CM_u_write_to_news_array_1L(
        numbers, (CM_vector_t){.ints = position}, (CM_vector_t){.ints = position},
        (CM_vector_t){.ints = count}, (CM_vector_t){.ints = axis_first}, at(s->to),
        (unsigned int)s->length, 1, (CM_vector_t){.ints = count}, CM_64_bit);
}

static void flags_store(CM_field_id_t to)
{
    CM_store_context(to);
    CM_store_test_always(to + 1);
    CM_store_overflow_always(to + 2);
}

/* Of each processor by itself. */
static void operate(const struct slot_step *s, CM_field_id_t to, CM_field_id_t a,
                    CM_field_id_t b)
{
    const unsigned int n = (unsigned int)s->length, k = (unsigned int)s->shorter;
    const unsigned int sig = n == 32 ? 23 : 52, exp = n == 32 ? 8 : 11;
    switch ((int)s->kind) {
    case SLOT_MOVE:
        CM_u_move_2L(to, a, n, k);
        break;
    case SLOT_MOVE_SIGNED:
        CM_s_move_2L(to, a, n, k);
        break;
    case SLOT_XOR:
        CM_logxor_3_1L(to, a, b, n);
        break;
    case SLOT_NOT:
        CM_lognot_2_1L(to, a, n);
        break;
    case SLOT_ADD:
        CM_u_add_3_1L(to, a, b, n);
        break;
    case SLOT_SUBTRACT:
        CM_s_subtract_3_1L(to, a, b, n);
        break;
    case SLOT_MAX_SIGNED:
        CM_s_max_3_1L(to, a, b, n);
        break;
    case SLOT_MIN:
        CM_u_min_3_1L(to, a, b, n);
        break;
    case SLOT_FADD:
        CM_f_add_3_1L(to, a, b, sig, exp);
        break;
    case SLOT_FMULTIPLY:
        CM_f_multiply_3_1L(to, a, b, sig, exp);
        break;
    case SLOT_SWAP:
        CM_swap_2_1L(to, a, n);
        break;
    case SLOT_FMAX:
        CM_f_max_3_1L(to, a, b, sig, exp);
        break;
    case SLOT_FMOVE:
        CM_f_move_1L(to, a, sig, exp);
        break;
    case SLOT_ADDRESS:
        CM_my_news_coordinate_1L(to, 0, n);
        break;
    case SLOT_AIM:
        CM_make_news_coordinate_1L(CM_vp_set_geometry(sets[s->set]), to, 0, a, n);
        break;
    }
}

static void set_flags(const struct slot_step *s, CM_field_id_t to, CM_field_id_t a,
                      CM_field_id_t b)
{
    const unsigned int n = (unsigned int)s->length;
    switch ((int)s->kind) {
    case SLOT_LESS:
        CM_u_lt_1L(a, b, n);
        break;
    case SLOT_FLESS:
        CM_f_lt_1L(a, b, n == 32 ? 23 : 52, n == 32 ? 8 : 11);
        break;
    case SLOT_STORE_TEST:
        CM_store_test(to);
        break;
    case SLOT_STORE_FLAGS:
        flags_store(to);
        break;
    case SLOT_LOAD_CONTEXT:
        CM_load_context(a);
        break;
    case SLOT_AND_TEST:
        CM_logand_context_with_test();
        break;
    case SLOT_AND_OVERFLOW:
        CM_logand_context_with_overflow();
        break;
    case SLOT_ALL:
        CM_set_context();
        break;
    }
}

/* Messages. */
static void send(const struct slot_step *s, CM_field_id_t to, CM_field_id_t a, CM_field_id_t b)
{
    const unsigned int n = (unsigned int)s->length;
    const bool one_by_one = s->kind == SLOT_SEND || s->kind == SLOT_SEND_FADD;
    switch ((int)(one_by_one && memory.collides ? SLOT_SEND_XOR : s->kind)) {
    case SLOT_SEND:
        CM_send_1L(to, b, a, n, CM_no_field);
        break;
    case SLOT_SEND_FADD:
        CM_send_with_f_add_1L(to, b, a, n == 32 ? 23 : 52, n == 32 ? 8 : 11, CM_no_field);
        break;
    case SLOT_SEND_MAX:
        CM_send_with_s_max_1L(to, b, a, n, CM_no_field);
        break;
    case SLOT_SEND_ADD:
        CM_send_with_u_add_1L(to, b, a, n, CM_no_field);
        break;
    case SLOT_SEND_XOR:
        CM_send_with_logxor_1L(to, b, a, n, CM_no_field);
        break;
    }
}

/* Along the axis. */
static void scan(const struct slot_step *s, CM_field_id_t to, CM_field_id_t a)
{
    const unsigned int n = (unsigned int)s->length, k = (unsigned int)s->shorter;
    const unsigned int direction = s->upward ? CM_upward : CM_downward,
                       inclusion = s->inclusive ? CM_inclusive : CM_exclusive,
                       smode = (unsigned int)s->smode;
    const CM_field_id_t bit = s->smode ? at(s->bit) : CM_no_field;
    switch ((int)s->kind) {
    case SLOT_RANK:
        CM_u_rank_2L(to, a, 0, n, k, direction, smode, bit);
        break;
    case SLOT_FRANK:
        CM_f_rank_2L(to, a, 0, n, k == 32 ? 23 : 52, k == 32 ? 8 : 11, direction, smode, bit);
        break;
    case SLOT_SCAN:
        CM_scan_with_u_add_1L(to, a, 0, n, direction, inclusion, smode, bit);
        break;
    case SLOT_SCAN_COPY:
        CM_scan_with_copy_1L(to, a, 0, n, direction, inclusion, smode, bit);
        break;
    case SLOT_SCAN_MAX:
        CM_scan_with_s_max_1L(to, a, 0, n, direction, inclusion, smode, bit);
        break;
    case SLOT_ENUMERATE:
        CM_enumerate_1L(to, 0, n, direction, inclusion, smode, bit);
        break;
    case SLOT_SPREAD:
        CM_spread_with_copy_1L(to, a, 0, n, (unsigned int)s->vp);
        break;
    case SLOT_SPREAD_ADD:
        CM_spread_with_u_add_1L(to, a, 0, n);
        break;
    }
}

/* What else looks at other processors, or is seen by the front end. False: it sees another
 * number. */
static bool communicate(const struct slot_step *s, CM_field_id_t to, CM_field_id_t a,
                        CM_field_id_t b)
{
    const unsigned int n = (unsigned int)s->length;
    switch ((int)s->kind) {
    case SLOT_NEWS:
        CM_get_from_news_1L(to, a, 0, s->upward ? CM_upward : CM_downward, n);
        break;
    case SLOT_GET:
        CM_get_1L(to, b, a, n);
        break;
    case SLOT_WRITE:
        CM_u_write_to_processor_1L((CM_sendaddr_t)s->vp, to,
                                   slot_number(s->number, s->vp, s->length), n);
        break;
    case SLOT_WRITE_ALL:
        write_all(s);
        break;
    case SLOT_SUM:
        return CM_global_u_add_long_1L(a, n) == memory.seen;
    case SLOT_GREATEST:
        return CM_global_u_max_long_1L(a, n) == memory.seen;
    }
    return true;
}

/* False: the front end sees another number. */
static bool perform(const struct slot_step *s)
{
    const CM_field_id_t to = at(s->to), a = at(s->a), b = at(s->b);
    CM_set_vp_set(sets[s->set]);
    operate(s, to, a, b);
    set_flags(s, to, a, b);
    if (slot_sends(s->kind))
        send(s, to, a, b);
    scan(s, to, a);
    return communicate(s, to, a, b);
}

/* ---- looks ---- */

/* Whether a field's bits [from, from + length) hold what they should. */
static bool bits_agree(int field, int from, int length, CM_field_id_t id)
{
    static uint64_t numbers[SLOT_VPS];
    int count[1] = {slot_vps(&program, program.set[field])};
    CM_u_read_from_news_array_1L(numbers, (CM_vector_t){.ints = position},
                                 (CM_vector_t){.ints = position}, (CM_vector_t){.ints = count},
                                 (CM_vector_t){.ints = axis_first}, id + (unsigned int)from,
                                 (unsigned int)length, 1, (CM_vector_t){.ints = count},
                                 CM_64_bit);
    for (int vp = 0; vp < count[0]; vp++)
        if (numbers[vp] != (uint64_t)slot_bits(&memory, field, vp, from, length))
            return false;
    return true;
}

static bool field_agrees(int field)
{
    CM_set_vp_set(sets[program.set[field]]);
    for (int from = 0; from < program.bits[field]; from += CHUNK) {
        int length = program.bits[field] - from < CHUNK ? program.bits[field] - from : CHUNK;
        if (!bits_agree(field, from, length, fields[field]))
            return false;
    }
    return true;
}

static bool flags_agree(int set)
{
    static uint64_t numbers[SLOT_VPS];
    int count[1] = {slot_vps(&program, set)};
    CM_set_vp_set(sets[set]);
    flags_store(flags[set]);
    CM_u_read_from_news_array_1L(numbers, (CM_vector_t){.ints = position},
                                 (CM_vector_t){.ints = position}, (CM_vector_t){.ints = count},
                                 (CM_vector_t){.ints = axis_first}, flags[set], 3, 1,
                                 (CM_vector_t){.ints = count}, CM_64_bit);
    for (int vp = 0; vp < count[0]; vp++)
        if (numbers[vp] != (uint64_t)(memory.context[set][vp] | memory.test[set][vp] << 1 |
                                      memory.overflow[set][vp] << 2))
            return false;
    return true;
}

/* Looks at everything; returns what is wrong, or NULL. */
static const char *all_agrees(bool aliased)
{
    static char what[64];
    for (int i = 0; i < SLOT_FIELDS + aliased; i++)
        if (!field_agrees(i)) {
            snprintf(what, sizeof what, "field %d of %d bits", i, program.bits[i]);
            return what;
        }
    for (int i = 0; i < SLOT_SETS; i++)
        if (!flags_agree(i)) {
            snprintf(what, sizeof what, "the flags of set %d", i);
            return what;
        }
    return NULL;
}

/* ---- programs ---- */

/* Whether up to 64 bits of a field agree, others after each step. */
static bool part_agrees(int turn, int step)
{
    const uint64_t any = sample_mixed((uint64_t)turn * SLOT_STEPS + (uint64_t)step);
    const int field = (int)(any % SLOT_FIELDS), from = (int)(any / SLOT_FIELDS % 3) * 24;
    const int rest = program.bits[field] - from;
    CM_set_vp_set(sets[program.set[field]]);
    return rest <= 0 || bits_agree(field, from, rest < CHUNK ? rest : CHUNK, fields[field]);
}

static const char *look(const struct slot_step *s, int turn, int step, bool aliased)
{
    const bool last = step == program.steps_count - 1;
    if (program.look == SLOT_LOOK_ALWAYS || (program.look == SLOT_LOOK_TURNS && last))
        return all_agrees(aliased);
    if (program.look == SLOT_LOOK_PARTS)
        return part_agrees(turn, step) ? NULL : "a part of a field";
    return program.look == SLOT_LOOK_SOME && step % 3 == 1 && !field_agrees(s->to.field)
               ? "a field"
               : NULL;
}

static void alias_see_to(int turn, bool *aliased)
{
    if (program.aliased >= 0 && turn == program.alias_from) {
        CM_set_vp_set(sets[program.set[SLOT_ALIAS]]);
        fields[SLOT_ALIAS] = CM_make_field_alias(fields[program.aliased]);
        *aliased = true;
    }
    if (*aliased && turn > program.alias_to) {
        CM_remove_field_alias(fields[SLOT_ALIAS]);
        *aliased = false;
    }
}

static bool program_run(int seed, const struct tier *t)
{
    const char *wrong = NULL;
    bool aliased = false;
    seed_now = seed;
    slot_program_make(&program, (uint64_t)seed);
    slot_memory_init(&memory, &program);
    set_up();
    for (int turn = 0; turn < program.turns; turn++) {
        alias_see_to(turn, &aliased);
        for (int i = 0; i < program.steps_count; i++) {
            const struct slot_step *s = &program.steps[i];
            slot_step_perform(&memory, s);
            wrong = perform(s) ? look(s, turn, i, aliased) : "what the front end sees";
            if (wrong) {
                print_error("program %d, %s, turn %d, after step %d (%s): %s is wrong\n", seed,
                            t->name, turn, i, slot_kind_name(s->kind), wrong);
                return false;
            }
        }
    }
    wrong = all_agrees(aliased);
    if (wrong)
        print_error("program %d, %s, at its end: %s is wrong\n", seed, t->name, wrong);
    return !wrong;
}

static void all_fields_and_flags_are_as_in_plain_bits(void **unused)
{
    int wrong = 0;
    (void)unused;
    for (int i = 0; i < TIERS; i++) {
        if (only_tier >= 0 && i != only_tier)
            continue;
        int run = 0;
        tier_begin(&tiers[i], SLOT_PROCESSORS);
        for (int seed = first_program; seed < first_program + programs_count; seed++)
            if (seed % tiers[i].every == 0) {
                wrong += !program_run(seed, &tiers[i]);
                run++;
            }
        print_message("%s: %d programs\n", tiers[i].name, run);
    }
    assert_int_equal(wrong, 0);
}

/* [programs [the first [the only tier]]]; SLOT_PROGRAMS: how many, too */
int main(int argc, char **argv)
{
    if (getenv("SLOT_PROGRAMS"))
        programs_count = atoi(getenv("SLOT_PROGRAMS"));
    if (argc > 1)
        programs_count = atoi(argv[1]);
    if (argc > 2)
        first_program = atoi(argv[2]);
    if (argc > 3)
        only_tier = atoi(argv[3]);
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_fields_and_flags_are_as_in_plain_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
