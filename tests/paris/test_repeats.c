/* Programs whose calls repeat, so that the machine enters states that it knows while
 * instructions are under way. They once computed with values that nobody held any more, and
 * crashed or came to other numbers. What the front end sees must be the same however they are
 * performed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "../sample.h"
#include "paris_internal.h"
#include "tier.h"
#include <cm/paris.h>

enum { SEEN_MOST = 64, VPS = 64 };

static struct {
    uint64_t hash[SEEN_MOST];
    int count;
} seen;
static int position[1] = {0}, axis_first[1] = {0};

static CM_vp_set_id_t set_of(unsigned int vps)
{
    static struct CM_axis_descriptor axis;
    CM_axis_descriptor_t axes[1] = {&axis};
    axis = (struct CM_axis_descriptor){.length = vps, .weight = 1, .ordering = CM_send_order};
    CM_vp_set_id_t set = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
    CM_set_vp_set(set);
    return set;
}

static void write(CM_field_id_t f, int vps, unsigned int bits, uint64_t seed)
{
    uint64_t numbers[VPS];
    for (int i = 0; i < vps; i++)
        numbers[i] = sample_mixed(seed + (uint64_t)i * SAMPLE_GOLDEN) >> (64 - bits);
    CM_u_write_to_news_array_1L(numbers, (CM_vector_t){.ints = position},
                                (CM_vector_t){.ints = position}, (CM_vector_t){.ints = &vps},
                                (CM_vector_t){.ints = axis_first}, f, bits, 1,
                                (CM_vector_t){.ints = &vps}, CM_64_bit);
}

/* What the front end sees of a part of a field. */
static void look(CM_field_id_t f, int vps, unsigned int bits)
{
    uint64_t numbers[VPS], hash = 0;
    CM_u_read_from_news_array_1L(numbers, (CM_vector_t){.ints = position},
                                 (CM_vector_t){.ints = position}, (CM_vector_t){.ints = &vps},
                                 (CM_vector_t){.ints = axis_first}, f, bits, 1,
                                 (CM_vector_t){.ints = &vps}, CM_64_bit);
    for (int i = 0; i < vps; i++)
        hash = sample_mixed(hash ^ numbers[i]);
    assert_true(seen.count < SEEN_MOST);
    seen.hash[seen.count++] = hash;
}

static void flags_store(CM_field_id_t to)
{
    CM_store_context(to);
    CM_store_test_always(to + 1);
    CM_store_overflow_always(to + 2);
}

/* Ranks of parts that overlap what is shifted, in a small set; then messages that combine
 * floats in parts of integers, in another. */
static void ranks_then_messages(uint64_t seed)
{
    set_of(16);
    const CM_field_id_t flags = CM_allocate_heap_field(3), x = CM_allocate_heap_field(100);
    write(x, 16, 64, seed);
    const CM_field_id_t bit = CM_allocate_stack_field(4), y = CM_allocate_stack_field(100);
    CM_f_rank_2L(y + 37, x, 0, 8, 52, 11, CM_upward, CM_segment_bit, bit + 3);
    CM_store_context(flags);
    CM_u_s_shift_3_3L(x + 20, y, x, 80, 7, 8);
    CM_store_test_always(flags + 1);
    CM_store_overflow_always(flags + 2);
    look(flags, 16, 3);
    CM_f_max_3_1L(x, y + 32, x, 40, 11);
    look(x + 64, 16, 36);
    CM_u_s_shift_3_3L(x + 20, y, x, 80, 7, 8);
    look(x, 16, 64);
    look(x + 64, 16, 36);
    flags_store(flags);
    look(flags, 16, 3);
    CM_u_s_shift_3_3L(x + 20, y, x, 80, 7, 8);
    CM_f_rank_2L(y + 37, x, 0, 8, 52, 11, CM_upward, CM_segment_bit, bit + 3);
    look(x + 64, 16, 36);
    flags_store(flags);

    CM_set_safety_mode(1);
    set_of(64);
    const CM_geometry_id_t here = CM_vp_set_geometry(CM_current_vp_set);
    int few[1] = {25};
    const CM_geometry_id_t other = CM_create_geometry(few, 1);
    const CM_field_id_t a = CM_allocate_stack_field(40);
    write(a, 64, 40, seed + 1);
    const CM_field_id_t b = CM_allocate_heap_field(96);
    CM_make_news_coordinate_1L(here, b, 0, a + 8, 32);
    CM_logand_context_with_overflow();
    const CM_field_id_t c = CM_allocate_heap_field(100);
    CM_extract_news_coordinate_1L(other, b + 49, 0, c, 16);
    CM_u_mod_constant_2_1L(b, 64, 32);
    CM_make_news_coordinate_1L(here, a, 0, b, 32);
    CM_send_with_s_max_1L(c, a, b + 56, 40, CM_no_field);
    CM_logandc2_2_1L(c, b + 17, 64);
    look(b, 64, 64);
    CM_f_rank_2L(c + 41, b + 32, 0, 8, 52, 11, CM_upward, CM_none, CM_no_field);
    look(b, 64, 64);
    CM_u_mod_constant_2_1L(b + 19, 64, 32);
    CM_make_news_coordinate_1L(here, c, 0, b + 19, 32);
    CM_send_with_f_add_1L(a, c, a, 23, 8, CM_no_field);
    look(a, 64, 40);
    look(b, 64, 64);
    CM_make_news_coordinate_1L(here, a, 0, b + 64, 32);
    CM_send_with_f_add_1L(b, a, a, 23, 8, CM_no_field);
    CM_send_with_s_max_1L(c, a, b + 56, 40, CM_no_field);
    look(c, 64, 64);
}

static const struct tier ways[] = {
    {"one instruction at a time", "1", "1", "1", true, 1, NULL, "0"},
    {"as usual", "1", "1", "1", false, 1, NULL, "1"},
    {"without replay", "1", "1", "1", false, 1, NULL, "0"},
    {"byte code", "1", "2", "0", false, 1, NULL, "1"},
    {"always at once", "1", "2", "2", false, 1, NULL, "1"},
};

static void see_the_same_in_all_ways(void (*program)(uint64_t seed))
{
    for (uint64_t seed = 1; seed <= 8; seed++) {
        uint64_t right[SEEN_MOST];
        int count = 0;
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
            tier_begin(&ways[w], 0);
            seen.count = 0;
            program(seed);
            if (w == 0) /* the slow way, which has no states */
                count = seen.count;
            assert_int_equal(seen.count, count);
            for (int i = 0; i < count; i++) {
                right[i] = w == 0 ? seen.hash[i] : right[i];
                if (seen.hash[i] != right[i])
                    fail_msg("seed %d, %s: look %d sees other numbers", (int)seed, ways[w].name,
                             i);
            }
        }
    }
}

static void ranks_then_messages_are_right(void **unused)
{
    (void)unused;
    see_the_same_in_all_ways(ranks_then_messages);
}

int main(void)
{
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {cmocka_unit_test(ranks_then_messages_are_right)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
