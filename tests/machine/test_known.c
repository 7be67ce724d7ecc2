/* test_known.c - plans whose kernels an earlier program had compiled in the background get them
 * when their runs have cost a millisecond, not a compiler's time. Where no earlier program had,
 * a plan is asked about once. */
#include "support.h"

#include "background_loops.h"
#include "plans/background.h"
#include "plans/known.h"
#include "plans/plans.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { TURNS = 400, CELLS = 60 * 100 };

/* background: "0" or "1". A program whose plans pay a compiler soon, or one whose do not. */
static void begin(struct sheet *s, const struct looped *loop, const char *background, bool soon)
{
    static float start[CELLS];
    struct machine_config config = machine_config_default();
    const int dimensions[2] = {loop->height, loop->width};
    setenv("LUTETIA_BACKGROUND", background, 1);
    config.processors_count = 16;
    config.eager = 0;
    *s = (struct sheet){.loop = loop};
    assert_ok(machine_create(&config, &s->m), s->m);
    struct device_shape *shape = &s->m->device->shape;
    shape->text_ns = 1e5; /* as if its runs took ten times as long */
    shape->wait_ns = 0;
    shape->compile_ns = soon ? 1e6 : 1e12;
    shape->compile_op_ns = 0;
    const int set = machine_vpset_create(s->m, dimensions, 2);
    machine_vpset_select(s->m, set);
    for (uint32_t i = 0; i < (uint32_t)(loop->height * loop->width); i++)
        start[i] = (float)((i * 2654435761u >> 7) % 1000) / 997;
    s->a = machine_field_allocate(s->m, set, 32, MACHINE_HEAP);
    s->b = machine_field_allocate(s->m, set, 32, MACHINE_HEAP);
    assert_ok(machine_field_upload(s->m, s->a, loop->type, start), s->m);
    assert_ok(machine_field_upload(s->m, s->b, loop->type, start), s->m);
}

/* The sheet after so many turns; how many kernels there were. */
static struct machine_stats run(struct sheet *s, int count, float out[CELLS])
{
    struct machine_stats stats;
    for (int i = 0; i < count; i++) {
        turns(s, 1);
        usleep(i % 8 ? 0 : 1000); /* the background is looked at once a millisecond */
        plans_see_to(s->m);
    }
    machine_begin(s->m);
    assert_ok(machine_field_download(s->m, s->a, s->loop->type, out), s->m);
    machine_stats_get(s->m, &stats);
    return stats;
}

/* Whether each plan that has cost enough has been asked about. */
static bool all_are_sought(const struct machine *m)
{
    int count = 0;
    for (int i = 0; i < m->plans->table_size; i++)
        for (const struct plan *p = m->plans->table[i]; p; p = p->next)
            if (p->quality == INTERPRETED && p->spent_s > 2e-9 * m->device->shape.text_ns) {
                if (!p->sought)
                    return false;
                count++;
            }
    return count > 0;
}

/* The files of the cache whose names end so. */
static int files(const char *suffix)
{
    char path[300];
    int count = 0;
    snprintf(path, sizeof path, "%s/lutetia", support_cache);
    DIR *all = opendir(path);
    for (const struct dirent *e; all && (e = readdir(all));)
        count += strlen(e->d_name) > strlen(suffix) &&
                 !strcmp(e->d_name + strlen(e->d_name) - strlen(suffix), suffix);
    if (all)
        closedir(all);
    return count;
}

static float first[CELLS], now[CELLS];

/* Nobody has compiled its kernels: it stays byte code, and is asked about once. */
static void unknown_plan_is_asked_about_once(void **state)
{
    struct sheet s;
    (void)state;
    begin(&s, &loops[0], "1", false);
    const struct machine_stats stats = run(&s, TURNS, first);
    assert_true(stats.interpreted > 0);
    assert_int_equal(stats.kernels_built, 0);
    assert_true(all_are_sought(s.m));
    assert_null(s.m->plans->improving);
    machine_destroy(s.m);
    assert_int_equal(files(".has"), 0);
}

/* Its kernels pay, and are compiled; then the plan's mark is there, and the kernel's. */
static void plan_that_gets_kernels_is_known(void **state)
{
    struct sheet s;
    (void)state;
    begin(&s, &loops[0], "1", true);
    turns(&s, TURNS);
    for (int i = 0; i < 60 && files(".has") < 2; i++) {
        turns(&s, TURNS);
        wait_for(&s);
    }
    assert_true(files(".has") >= 2);
    machine_destroy(s.m);
}

/* They are taken long before they would pay a compiler. */
static void known_plan_gets_its_kernels_soon(void **state)
{
    struct sheet s;
    (void)state;
    setenv("LUTETIA_COMPILER", "/bin/false", 1); /* nothing is compiled */
    begin(&s, &loops[0], "1", false);
    const struct machine_stats stats = run(&s, TURNS, now);
    assert_true(stats.kernels_built > 0);
    assert_int_equal(stats.kernels_built, stats.kernels_built_background);
    assert_true(background_on(s.m)); /* and /bin/false was not asked */
    machine_destroy(s.m);
    assert_memory_equal(now, first, sizeof now);
}

/* Without background compilation nothing is as it was with it, but for the bits. */
static void nobody_asks_without_the_background(void **state)
{
    struct sheet s;
    (void)state;
    begin(&s, &loops[0], "0", false);
    const struct machine_stats stats = run(&s, TURNS, now);
    assert_int_equal(stats.kernels_built, 0);
    assert_false(all_are_sought(s.m));
    machine_destroy(s.m);
    assert_memory_equal(now, first, sizeof now);
}

/* The plan is known, and its kernels, with other lanes, are not: nothing is requested. */
static void kernels_that_are_gone_are_not_compiled(void **state)
{
    struct sheet s;
    (void)state;
    setenv("LUTETIA_VECTOR", "1", 1);
    begin(&s, &loops[0], "1", false);
    const struct machine_stats stats = run(&s, TURNS, now);
    assert_int_equal(stats.kernels_built, 0);
    assert_true(all_are_sought(s.m));
    assert_null(s.m->plans->improving);
    assert_false(background_busy(s.m));
    assert_int_equal(machine_status_last(s.m), MACHINE_OK);
    machine_destroy(s.m);
    unsetenv("LUTETIA_VECTOR");
    assert_memory_equal(now, first, sizeof now);
}

static int folder_make(void **state)
{
    const int status = support_cache_make(state);
    setenv("POCL_CACHE_DIR", support_cache, 1);
    setenv("LUTETIA_INTERPRET", "1", 1);
    setenv("LUTETIA_TURNS", "1", 1);
    setenv("LUTETIA_FLUSH_AFTER", "48", 1);
    unsetenv("LUTETIA_KEEP");
    return status;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknown_plan_is_asked_about_once),
        cmocka_unit_test(plan_that_gets_kernels_is_known),
        cmocka_unit_test(known_plan_gets_its_kernels_soon),
        cmocka_unit_test(nobody_asks_without_the_background),
        cmocka_unit_test(kernels_that_are_gone_are_not_compiled),
    };
    struct machine *m = support_machine(0);
    const bool pocl = m->device->is_pocl;
    machine_destroy(m);
    if (!pocl) {
        puts("skipped: the device is not PoCL's");
        return 77;
    }
    return cmocka_run_group_tests(tests, folder_make, support_cache_remove);
}
