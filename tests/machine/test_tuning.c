/* test_tuning.c - the numbers that `lutetia tune` keeps: their file, which source overrides
 * which, and their use in kernels. */
#include "support.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

static struct machine *opened(const struct machine_tuning *tuning)
{
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;
    config.tuning = tuning;
    config.eager = 0;
    assert_ok(machine_create(&config, &m), m);
    return m;
}

static struct machine_tuning some(void)
{
    return (struct machine_tuning){.of = {[MACHINE_VECTOR] = 8,
                                          [MACHINE_RUN] = 32,
                                          [MACHINE_STREAMS] = 0,
                                          [MACHINE_TURNS] = 3,
                                          [MACHINE_COLUMNS] = 48,
                                          [MACHINE_STRIPS_EACH] = 5},
                                   .cost_ns = {[MACHINE_COST_OP] = 0.125,
                                               [MACHINE_COST_BYTE] = 0.03125,
                                               [MACHINE_COST_NEAR_BYTE] = 0.015625,
                                               [MACHINE_COST_LAUNCH] = 12345}};
}

static void assert_tuned(const struct machine_tuning *tuning, struct machine_tuning wanted)
{
    struct machine *m = opened(tuning);
    struct machine_tuning is = machine_tuning_get(m);
    assert_memory_equal(&is, &wanted, sizeof is);
    machine_destroy(m);
}

/* Finds the one file whose name begins with tuning-; removes it where path is NULL. False:
 * there is none. */
static bool kept_file(char *path, size_t size)
{
    char where[300];
    bool found = false;
    snprintf(where, sizeof where, "%s/lutetia", support_cache);
    DIR *d = opendir(where);
    if (!d)
        return false;
    for (struct dirent *e; (e = readdir(d));) {
        if (strncmp(e->d_name, "tuning-", 7) != 0)
            continue;
        assert_false(found);
        assert_null(strchr(e->d_name, '.')); /* no temporary one is left */
        found = true;
        if (path)
            snprintf(path, size, "%s/%s", where, e->d_name);
    }
    closedir(d);
    return found;
}

static void a_tuning_is_kept_and_read_again(void **state)
{
    char path[600], text[800];
    struct machine *m = opened(NULL);
    struct machine_tuning usual = machine_tuning_get(m), wanted = some();

    (void)state;
    assert_false(kept_file(NULL, 0));
    assert_int_equal(machine_tuning_describe(m, text, sizeof text), MACHINE_UNTUNED);
    assert_ok(machine_tuning_keep(m, &wanted), m);
    assert_true(kept_file(path, sizeof path));
    assert_int_equal(machine_tuning_describe(m, text, sizeof text), MACHINE_TUNED);
    assert_non_null(strstr(text, path));
    assert_tuned(NULL, wanted);
    /* A configuration overrides the file, the environment overrides both. */
    struct machine_tuning none = machine_tuning_usual();
    assert_tuned(&none, usual);
    setenv("LUTETIA_COLUMNS", "64", 1);
    wanted.of[MACHINE_COLUMNS] = 64;
    assert_tuned(NULL, wanted);
    unsetenv("LUTETIA_COLUMNS");
    setenv("LUTETIA_TUNED", "0", 1);
    assert_tuned(NULL, usual);
    unsetenv("LUTETIA_TUNED");
    /* A number out of range is not kept. */
    wanted.of[MACHINE_VECTOR] = 2;
    assert_int_equal(machine_tuning_keep(m, &wanted), MACHINE_BAD_ARGUMENT);
    support_failed(m, MACHINE_BAD_ARGUMENT, "vector");
    wanted = some();
    wanted.cost_ns[MACHINE_COST_LAUNCH] = -1;
    assert_int_equal(machine_tuning_keep(m, &wanted), MACHINE_BAD_ARGUMENT);
    support_failed(m, MACHINE_BAD_ARGUMENT, "launch");
    wanted = some();
    assert_tuned(NULL, wanted);
    /* A cost that was not measured is taken from the table. */
    wanted.cost_ns[MACHINE_COST_BYTE] = 0;
    assert_ok(machine_tuning_keep(m, &wanted), m);
    wanted.cost_ns[MACHINE_COST_BYTE] = usual.cost_ns[MACHINE_COST_BYTE];
    assert_tuned(NULL, wanted);
    machine_destroy(m);
}

/* Replaces one line of the file. */
static void line_change(const char *path, const char *begins, const char *with)
{
    char bytes[4096], out[8192] = "";
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    while (fgets(bytes, sizeof bytes, f))
        strcat(out, strncmp(bytes, begins, strlen(begins)) == 0 ? with : bytes);
    fclose(f);
    f = fopen(path, "w");
    assert_non_null(f);
    fputs(out, f);
    fclose(f);
}

static void a_file_that_is_wrong_is_as_if_it_were_not_there(void **state)
{
    static const char *const changes[][3] = {{"lutetia", "lutetia tuning 1\n", "line 1"},
                                             {"driver", "driver 0.1\n", "driver"},
                                             {"device", "device another\n", "device"},
                                             {"vector", "vector 3\n", "1, 4, 8 or 16"},
                                             {"turns", "turns\n", "turns"},
                                             {"columns", "", "columns"},
                                             {"op_fs", "op_fs much\n", "op_fs"},
                                             {"byte_fs", "byte_fs -1\n", "0 to 10^15"},
                                             {"near", "byte_fs 3\n", "near_byte_fs"},
                                             {"launch", "", "launch_fs"},
                                             {"end", "", "too early"},
                                             {"end", "end\nend\n", "the last"}};
    struct machine *m = opened(&(struct machine_tuning){.of = {-1, -1, -1, -1, -1, -1}});
    struct machine_tuning usual = machine_tuning_get(m), tuning = some();
    char path[600], text[800];

    (void)state;
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        assert_ok(machine_tuning_keep(m, &tuning), m);
        assert_true(kept_file(path, sizeof path));
        line_change(path, changes[i][0], changes[i][1]);
        assert_int_equal(machine_tuning_describe(m, text, sizeof text), MACHINE_TUNED_BADLY);
        if (!strstr(text, changes[i][2]) || strchr(text, '\n'))
            fail_msg("\"%s\" instead of \"%s\"", text, changes[i][2]);
        assert_tuned(NULL, usual);
    }
    assert_int_equal(truncate(path, 100000), 0);
    assert_int_equal(machine_tuning_describe(m, text, sizeof text), MACHINE_TUNED_BADLY);
    assert_tuned(NULL, usual);
    unlink(path);
    machine_destroy(m);
}

static void a_folder_that_cannot_be_is_said(void **state)
{
    struct machine *m = opened(NULL);
    struct machine_tuning tuning = some();

    (void)state;
    setenv("XDG_CACHE_HOME", "/dev/null", 1);
    assert_int_equal(machine_tuning_keep(m, &tuning), MACHINE_BAD_ARGUMENT);
    support_failed(m, MACHINE_BAD_ARGUMENT, "/dev/null");
    setenv("XDG_CACHE_HOME", support_cache, 1);
    machine_destroy(m);
}

/* The tuned numbers are in the options of the plan's kernels. */
static void knobs_reach_the_kernels(void **state)
{
    struct machine_tuning tuning = some();
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;
    char path[300], line[400] = "";

    (void)state;
    support_cache_leave();
    snprintf(path, sizeof path, "%s/dump", support_cache);
    config.dump_dir = path;
    config.tuning = &tuning;
    config.eager = 0;
    setenv("LUTETIA_STRIPS", "1", 1);
    assert_ok(machine_create(&config, &m), m);
    unsetenv("LUTETIA_STRIPS");
    int set = support_set(m, 2, 8, 192);
    uint32_t field = machine_field_allocate(m, set, 32, MACHINE_HEAP);
    struct machine_value *v = machine_coordinate(m, 1, 32);
    v = machine_to_float(m, v, MACHINE_F32, false);
    assert_ok(
        machine_field_store(m, field, machine_unary(m, MACHINE_FSQRT, v), MACHINE_EVERYWHERE),
        m);
    assert_ok(machine_flush(m), m);
    machine_begin(m);
    v = machine_field_value(m, field, MACHINE_F32, MACHINE_EVERYWHERE);
    for (int i = 0; i < 3; i++) { /* costly enough to be stored for the neighbours */
        v = machine_unary(m, MACHINE_FSQRT, machine_unary(m, MACHINE_FSQRT, v));
        v = machine_binary(m, MACHINE_FDIV, machine_shift(m, v, 0, 1),
                           machine_shift(m, v, 0, -1));
    }
    assert_ok(machine_field_store(m, field, v, MACHINE_EVERYWHERE), m);
    assert_ok(machine_finish(m), m);
    machine_destroy(m);
    bool in_strips = false;
    for (int i = 0; i < 8; i++) {
        snprintf(path, sizeof path, "%s/dump/%04d.cl", support_cache, i);
        FILE *f = fopen(path, "r");
        if (!f)
            continue;
        assert_non_null(fgets(line, sizeof line, f));
        fclose(f);
        assert_non_null(strstr(line, "-DVECTOR=8 "));
        assert_non_null(strstr(line, "-DHALO=8 "));
        in_strips = in_strips || strstr(line, "strips of 48 columns");
    }
    if (!in_strips)
        fail_msg("no kernel of strips of 48 columns: %s", line);
}

/* The costs decide whether values are computed again or stored: launches that cost a second
 * make one kernel, and launches that cost nothing, with operations that cost a microsecond,
 * make two. */
static uint64_t kernels_where(double op_ns, double launch_ns)
{
    struct machine_tuning tuning = machine_tuning_usual();
    struct machine_stats before, after;
    tuning.cost_ns[MACHINE_COST_OP] = op_ns;
    tuning.cost_ns[MACHINE_COST_LAUNCH] = launch_ns;
    setenv("LUTETIA_STRIPS", "0", 1);
    struct machine *m = opened(&tuning);
    unsetenv("LUTETIA_STRIPS");
    int set = support_set(m, 2, 64, 192);
    uint32_t field = machine_field_allocate(m, set, 32, MACHINE_HEAP);
    struct machine_value *v =
        machine_to_float(m, machine_coordinate(m, 1, 32), MACHINE_F32, false);
    assert_ok(machine_field_store(m, field, v, MACHINE_EVERYWHERE), m);
    assert_ok(machine_finish(m), m);
    machine_stats_get(m, &before);
    machine_begin(m);
    v = machine_field_value(m, field, MACHINE_F32, MACHINE_EVERYWHERE);
    for (int i = 0; i < 4; i++)
        v = machine_binary(m, MACHINE_FADD, machine_binary(m, MACHINE_FMUL, v, v), v);
    v = machine_binary(m, MACHINE_FADD, machine_shift(m, v, 0, 1), v);
    assert_ok(machine_field_store(m, field, v, MACHINE_EVERYWHERE), m);
    assert_ok(machine_finish(m), m);
    machine_stats_get(m, &after);
    machine_destroy(m);
    return after.kernels_run - before.kernels_run;
}

static void costs_reach_the_plans(void **state)
{
    (void)state;
    assert_int_equal(kernels_where(1e-5, 1e9), 1);
    assert_int_equal(kernels_where(1000, 1), 2);
}

static int begin(void **state)
{
    unsetenv("LUTETIA_TUNED");
    return support_cache_make(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tuning_is_kept_and_read_again),
        cmocka_unit_test(a_file_that_is_wrong_is_as_if_it_were_not_there),
        cmocka_unit_test(a_folder_that_cannot_be_is_said),
        cmocka_unit_test(knobs_reach_the_kernels),
        cmocka_unit_test(costs_reach_the_plans),
    };
    return cmocka_run_group_tests(tests, begin, support_cache_remove);
}
