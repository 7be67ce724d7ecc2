/* test_checkpoint.c - the machine to a file and back: what a program computes after CM_resume
 * is what it would have computed; damaged and forged files are refused in one line.
 * CHECKPOINT_CASES: how many forged ones (60). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <sha256.h>
#include <unistd.h>

#include "paris_internal.h"
#include <cm/paris.h>

static char path[] = "/tmp/lutetia-checkpoint-XXXXXX", file[64];
static char said[2000];
static int complaints;

static void told(const char *message)
{
    snprintf(said, sizeof said, "%s", message);
    complaints++;
}

/* What the program keeps: as a program of users would. */
struct own {
    CM_vp_set_id_t grid, line, other;
    CM_field_id_t heat, near, image, wide, bit, top, alias, odd;
    int step;
};

static uint64_t mixed(uint64_t hash, uint64_t x)
{
    hash = (hash ^ x) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

/* Sets and geometries of all kinds, some given back again; fields of many lengths, in parts; an
 * alias; a context. */
static struct own begin(void)
{
    struct own w = {.step = 0};
    unsigned int sides[2] = {16, 32}, odd_sides[3] = {5, 7, 3}, length[1] = {2048};
    struct CM_axis_descriptor axes[2] = {
        {.length = 32, .weight = 3, .ordering = CM_news_order},
        {.length = 64, .weight = 1, .ordering = CM_send_order}};
    CM_axis_descriptor_t described[2] = {&axes[0], &axes[1]};
    CM_geometry_id_t gone = CM_create_geometry(sides, 2);
    CM_vp_set_id_t lost = CM_allocate_vp_set(CM_create_geometry(odd_sides, 3));
    w.grid = CM_allocate_vp_set(CM_create_geometry(sides, 2));
    w.line = CM_allocate_vp_set(CM_create_geometry(length, 1));
    w.other = CM_allocate_vp_set(CM_create_detailed_geometry(described, 2));
    CM_deallocate_vp_set(lost);
    CM_deallocate_geometry(gone);
    CM_set_vp_set(w.line);
    CM_set_context();
    w.odd = CM_allocate_heap_field(32);
    CM_my_send_address(w.odd);
    CM_set_vp_set(w.other);
    CM_set_context();
    w.wide = CM_allocate_heap_field(200);
    CM_u_random_1L(w.wide, 64, 0);
    CM_u_random_1L(w.wide + 70, 100, 0);
    CM_set_vp_set(w.grid);
    CM_set_context();
    w.heat = CM_allocate_heap_field(32);
    CM_deallocate_heap_field(CM_allocate_heap_field(9));
    w.near = CM_allocate_heap_field(32);
    w.image = CM_allocate_heap_field(24);
    w.bit = CM_allocate_stack_field(1);
    w.top = CM_allocate_stack_field(64);
    CM_initialize_random_generator(11);
    CM_f_random_1L(w.heat, 23, 8);
    CM_f_random_1L(w.top, 52, 11);
    CM_u_random_1L(w.image, 8, 200);
    CM_u_move_constant_1L(w.image + 8, 77, 8);
    CM_my_news_coordinate_1L(w.image + 16, 1, 8);
    CM_u_lt_constant_1L(w.image, 120, 8);
    CM_store_test(w.bit);
    CM_set_vp_set(w.line);
    w.alias = CM_make_field_alias(w.image); /* of another VP ratio */
    CM_set_vp_set(w.grid);
    return w;
}

static void steps(struct own *w, int count)
{
    for (int i = 0; i < count; i++, w->step++) {
        CM_get_from_news_1L(w->near, w->heat, 0, CM_upward, 32);
        CM_f_subtract_2_1L(w->near, w->heat, 23, 8);
        CM_f_multiply_constant_2_1L(w->near, 0.25, 23, 8);
        CM_f_add_2_1L(w->heat, w->near, 23, 8);
    }
}

/* All that a program can find out, and what comes next. */
static uint64_t future(struct own *w)
{
    uint64_t hash = 1;
    steps(w, 9);
    hash = mixed(hash, (uint64_t)CM_current_vp_set);
    hash = mixed(hash, CM_global_count_context());
    hash = mixed(hash, (uint64_t)CM_global_count_test() + 1000 * CM_global_count_overflow());
    hash = mixed(hash, CM_global_u_add_1L(w->heat, 32));
    CM_load_context(w->bit);
    hash = mixed(hash, CM_global_u_add_1L(w->image, 24));
    CM_u_random_1L(w->image, 8, 99);
    hash = mixed(hash, CM_global_u_add_1L(w->image, 24));
    CM_field_id_t made = CM_allocate_stack_field(16), heap = CM_allocate_heap_field(100);
    hash = mixed(mixed(hash, made), heap);
    hash = mixed(hash, CM_global_u_add_1L(w->top, 64));
    hash = mixed(hash, CM_global_u_add_1L(w->top, 32));
    CM_deallocate_stack_through(w->top);
    hash = mixed(hash,
                 (uint64_t)CM_is_field_valid(made) + 2 * (uint64_t)CM_is_field_valid(w->bit));
    CM_set_vp_set(w->line);
    hash = mixed(hash, CM_global_u_add_1L(w->alias, CM_field_length(w->alias)));
    hash = mixed(hash, CM_global_u_add_1L(w->odd, 32));
    CM_u_add_constant_2_1L(w->alias, 1, CM_field_length(w->alias));
    CM_set_vp_set(w->grid);
    hash = mixed(hash, CM_global_u_add_1L(w->image, 24));
    CM_set_vp_set(w->other);
    for (unsigned int at = 0; at < 200; at += 25)
        hash = mixed(hash, CM_global_u_add_1L(w->wide + at, 25));
    hash = mixed(hash, CM_u_read_from_processor_1L(100, w->wide, 32));
    CM_field_id_t address = CM_allocate_stack_field(32);
    CM_my_send_address(address);
    hash = mixed(hash, CM_u_read_from_processor_1L(3, address, 32));
    hash = mixed(hash, CM_global_u_max_1L(address, 32));
    const CM_geometry_id_t g = CM_vp_set_geometry(w->other);
    hash = mixed(hash, (uint64_t)g * 100 + (uint64_t)CM_geometry_axis_weight(g, 0));
    unsigned int sides[1] = {64};
    const CM_geometry_id_t new = CM_create_geometry(sides, 1);
    hash = mixed(hash, (uint64_t) new * 1000 + (uint64_t)CM_allocate_vp_set(new));
    return hash;
}

static void boot(unsigned int processors)
{
    struct machine_config config = machine_config_default();
    config.processors_count = (int)processors;
    assert_true(paris_reset(&config));
    CM_set_error_handler(told);
    complaints = 0;
}

/* Begins, and makes the file after so many steps. */
static struct own saved(int count)
{
    boot(256);
    struct own w = begin();
    steps(&w, count);
    CM_u_gt_constant_1L(w.image, 50, 8);
    CM_logand_context_with_test();
    assert_int_equal(CM_checkpoint(file, &w, sizeof w), 1);
    assert_int_equal(complaints, 0);
    return w;
}

static void what_comes_next_is_the_same(void **state)
{
    (void)state;
    for (int count = 0; count < 60; count += 29) {
        struct own w = saved(count), again;
        const uint64_t all = future(&w);
        for (unsigned int processors = 64; processors <= 4096; processors *= 8) {
            boot(processors);
            begin(); /* something else is there */
            memset(&again, 0, sizeof again);
            assert_int_equal(CM_resume(file, &again, sizeof again), 1);
            assert_int_equal(again.step, count);
            assert_true(future(&again) == all);
            assert_int_equal(complaints, 0);
        }
    }
}

static void saving_changes_nothing(void **state)
{
    (void)state;
    uint64_t all[2];
    for (int k = 0; k < 2; k++) {
        boot(256);
        struct own w = begin();
        for (int i = 0; i < 6; i++) {
            steps(&w, 17);
            if (k)
                assert_int_equal(CM_checkpoint(file, &w, sizeof w), 1);
        }
        all[k] = future(&w);
    }
    assert_true(all[0] == all[1]);
}

static void a_checkpoint_of_what_was_resumed_is_the_same_file(void **state)
{
    (void)state;
    char second[80];
    struct own w = saved(5);
    snprintf(second, sizeof second, "%s.2", file);
    assert_int_equal(CM_resume(file, &w, sizeof w), 1);
    assert_int_equal(CM_checkpoint(second, &w, sizeof w), 1);
    FILE *a = fopen(file, "rb"), *b = fopen(second, "rb");
    int x, y;
    do {
        x = fgetc(a);
        y = fgetc(b);
        assert_int_equal(x, y);
    } while (x != EOF);
    fclose(a);
    fclose(b);
    unlink(second);
}

/* ---- files that are none ---- */

static uint8_t bytes[1 << 20];
static size_t bytes_count;

static void file_get(void)
{
    FILE *f = fopen(file, "rb");
    assert_non_null(f);
    bytes_count = fread(bytes, 1, sizeof bytes, f);
    assert_true(bytes_count < sizeof bytes);
    fclose(f);
}

static void file_put(const uint8_t *from, size_t count)
{
    FILE *f = fopen(file, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(from, 1, count, f), count);
    fclose(f);
}

static void refused(void *own, size_t size, const char *part)
{
    complaints = 0;
    assert_int_equal(CM_resume(file, own, size), 0);
    assert_int_equal(complaints, 1);
    assert_non_null(strstr(said, part));
    assert_null(strchr(said, '\n'));
}

static void damaged_files_change_nothing(void **state)
{
    (void)state;
    struct own w = saved(3), none;
    file_get();
    const unsigned int heat = CM_u_read_from_processor_1L(9, w.heat, 32);
    unlink(file);
    assert_int_equal(CM_resume(file, &none, sizeof none), 0); /* a program begins anew */
    assert_int_equal(complaints, 0);
    static const size_t shorter[] = {0, 5, 17, 100, 1000};
    for (size_t i = 0; i < sizeof shorter / sizeof *shorter; i++) {
        file_put(bytes, shorter[i]);
        refused(&none, sizeof none, "cannot resume");
    }
    file_put(bytes, bytes_count - 1);
    refused(&none, sizeof none, "sum");
    bytes[bytes_count] = 0;
    file_put(bytes, bytes_count + 1);
    refused(&none, sizeof none, "sum");
    for (size_t at = 0; at < bytes_count; at += bytes_count / 37) {
        bytes[at] ^= 16;
        file_put(bytes, bytes_count);
        bytes[at] ^= 16;
        refused(&none, sizeof none, "cannot resume");
    }
    file_put(bytes, bytes_count);
    refused(&none, sizeof none - 1, "own");
    assert_int_equal(CM_u_read_from_processor_1L(9, w.heat, 32), heat);
    complaints = 0;
    assert_int_equal(CM_checkpoint("/no/such/folder/file", &w, sizeof w), 0);
    assert_int_equal(complaints, 1);
    assert_int_equal(CM_u_read_from_processor_1L(9, w.heat, 32), heat);
}

static uint64_t chance;

static uint64_t drawn(uint64_t most)
{
    chance = chance * 6364136223846793005u + 1442695040888963407u;
    return (chance >> 33) % most;
}

/* Files whose sum is right: numbers in them are others. Whatever comes is a machine, or one
 * line. */
static void forged_files_are_machines_or_refused(void **state)
{
    (void)state;
    static const uint64_t strange[] = {
        0,     1,          2,          3,          31,         63,  64,
        128,   129,        65535,      65536,      0x7fffffff, 192, 0xffffffff,
        ~0ull, 1ull << 63, 0x80000000, 1ull << 32, 17,         255, 32};
    const char *given = getenv("CHECKPOINT_CASES");
    const int cases = given ? atoi(given) : 60;
    int resumed = 0;
    boot(64);
    unsigned int sides[2] = {4, 6}, length[1] = {192};
    struct own w = {.grid = CM_allocate_vp_set(CM_create_geometry(sides, 2)),
                    .line = CM_allocate_vp_set(CM_create_geometry(length, 1))};
    CM_set_vp_set(w.grid);
    w.image = CM_allocate_heap_field(24);
    CM_u_random_1L(w.image, 8, 0);
    CM_u_move_constant_1L(w.image + 8, 3, 8);
    w.heat = CM_allocate_stack_field(32);
    CM_f_random_1L(w.heat, 23, 8);
    CM_set_vp_set(w.line);
    w.alias = CM_make_field_alias(w.image);
    assert_int_equal(CM_checkpoint(file, &w, sizeof w), 1);
    file_get();
    uint8_t *good = malloc(bytes_count);
    assert_non_null(good);
    memcpy(good, bytes, bytes_count);
    for (int i = 0; i < cases; i++) {
        chance = (uint64_t)i * 977 + 5;
        memcpy(bytes, good, bytes_count);
        const size_t after = 18 + drawn((bytes_count - 32 - 26) / 8) * 8;
        for (uint64_t n = 1 + drawn(2); n; n--) {
            /* numbers stand at any place behind the flags */
            const size_t at = n == 1 ? after : 18 + drawn(bytes_count - 32 - 26);
            const uint64_t x = drawn(3) ? strange[drawn(sizeof strange / sizeof *strange)]
                                        : good[at] + drawn(3) - 1;
            for (int k = 0; k < 8; k++)
                bytes[at + (size_t)k] = (uint8_t)(x >> 8 * k);
        }
        struct sha256 sum;
        sha256_begin(&sum);
        sha256_add(&sum, bytes, bytes_count - 32);
        sha256_end(&sum, bytes + bytes_count - 32);
        file_put(bytes, bytes_count);
        complaints = 0;
        if (!CM_resume(file, &w, sizeof w)) {
            assert_int_equal(complaints, 1);
            assert_null(strchr(said, '\n'));
            continue;
        }
        resumed++;
        for (CM_field_id_t f = 64; f < 2000;
             f += 64) { /* whatever there is can be read and written */
            if (!CM_is_field_valid(f) || !CM_field_length(f) || CM_field_length(f) > 64)
                continue;
            CM_set_vp_set(CM_field_vp_set(f));
            CM_global_u_add_1L(f, CM_field_length(f));
            CM_u_add_constant_2_1L(f, 1, CM_field_length(f));
            CM_global_u_add_1L(f, CM_field_length(f));
        }
    }
    print_message("%d of %d forged files are machines\n", resumed, cases);
    assert_true(resumed > 0 && resumed < cases);
    free(good);
}

static int folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(path))
        return 1;
    snprintf(file, sizeof file, "%s/machine", path);
    return 0;
}

static int folder_remove(void **state)
{
    (void)state;
    unlink(file);
    return rmdir(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_comes_next_is_the_same),
        cmocka_unit_test(saving_changes_nothing),
        cmocka_unit_test(a_checkpoint_of_what_was_resumed_is_the_same_file),
        cmocka_unit_test(damaged_files_change_nothing),
        cmocka_unit_test(forged_files_are_machines_or_refused),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
