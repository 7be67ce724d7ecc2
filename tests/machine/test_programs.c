/* test_programs.c - compiled programs on disk are kept once, loaded by the next machine, and
 * compiled again where they are damaged. Programs that call a function which functions.cl does
 * not declare get the whole header. (security.md 16) */
#include "machine_explained.h"
#include "support.h"

#include "device/disk_cache.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { COMPILED = 1, LOADED = 2 };

/* Counts the programs on disk. LEAVE leaves their files alone, REMOVE removes them, a length
 * cuts each to that many bytes. */
enum { LEAVE = -1, REMOVE = -2 };

static int kept(long length)
{
    char path[800];
    int count = 0;
    snprintf(path, sizeof path, "%s/lutetia", support_cache);
    DIR *d = opendir(path);
    if (!d)
        return 0;
    for (struct dirent *e; (e = readdir(d));) {
        if (*e->d_name == '.')
            continue;
        assert_non_null(strstr(e->d_name, ".bin")); /* no temporary one is left */
        assert_null(strstr(e->d_name, ".bin."));
        snprintf(path, sizeof path, "%s/lutetia/%s", support_cache, e->d_name);
        count++;
        if (length == REMOVE)
            assert_int_equal(unlink(path), 0);
        else if (length >= 0)
            assert_int_equal(truncate(path, length), 0);
    }
    closedir(d);
    return count;
}

static wide expected_root(const void *data, uint64_t n)
{
    (void)data;
    return number_real(__builtin_sqrt((double)(n % 41)), 64);
}

/* Runs a new machine and tells how it got its programs: COMPILED, LOADED or both. */
static int programs_come(const char *keep)
{
    int how = 0;
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;
    config.processors_count = 16;
    config.eager = 0;
    config.explain = 1;
    setenv("LUTETIA_KEEP", keep, 1);
    assert_ok(machine_create(&config, &m), m);
    support_set(m, 2, 3, 41);
    struct machine_value *v =
        machine_to_float(m, machine_coordinate(m, 1, 32), MACHINE_F64, false);
    support_expect(m, machine_unary(m, MACHINE_FSQRT, v), expected_root, NULL, "a root");
    const struct machine_explained *x = machine_explain(m, false);
    assert_non_null(x);
    for (int i = 0; i < x->phases_count; i++) {
        if (strcmp(x->phases[i].name, "build: compile") == 0)
            how |= COMPILED;
        if (strcmp(x->phases[i].name, "build: from the disk cache") == 0)
            how |= LOADED;
    }
    machine_destroy(m);
    unsetenv("LUTETIA_KEEP");
    return how;
}

static void programs_are_kept_and_loaded(void **state)
{
    (void)state;
    assert_int_equal(programs_come("1"), COMPILED);
    int count = kept(LEAVE);
    assert_true(count > 0);
    assert_int_equal(programs_come("1"), LOADED);
    assert_int_equal(kept(LEAVE), count);
    assert_int_equal(programs_come("0"), COMPILED); /* nobody looks */
    assert_int_equal(kept(LEAVE), count);
}

static void damaged_programs_are_compiled_again(void **state)
{
    static const long lengths[] = {0, 100, 2000};
    (void)state;
    assert_int_equal(programs_come("1"), LOADED);
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        int count = kept(lengths[i]);
        assert_int_equal(programs_come("1"), COMPILED);
        assert_int_equal(kept(LEAVE), count);
        assert_int_equal(programs_come("1"), LOADED); /* they are whole again */
    }
}

static void nothing_is_kept_where_nobody_wants_it(void **state)
{
    (void)state;
    assert_true(kept(REMOVE) > 0);
    assert_int_equal(programs_come("0"), COMPILED);
    assert_int_equal(kept(LEAVE), 0);
}

/* A kernel with a function that no kernel has used before is compiled with the whole header. */
static void program_that_needs_the_header_gets_it(void **state)
{
    static const char declared[] =
        "kernel void k(global float *a) { a[0] = fma(a[0], a[1], 1); }",
                      not_declared[] = "kernel void k(global float *a) { a[0] = cbrt(a[1]); }",
                      nowhere[] = "kernel void k(global float *a) { a[0] = no_such(a[1]); }";
    struct machine *m = support_machine(0);

    (void)state;
    assert_non_null(device_library_kernel(m, declared, "", "k"));
    assert_non_null(device_library_kernel(m, not_declared, "", "k"));
    assert_null(device_library_kernel(m, nowhere, "", "k"));
    support_failed(m, MACHINE_BUILD_FAILED, "no_such");
    machine_destroy(m);
}

/* Files of programs and marks, and one that is neither. */
static void the_oldest_files_go(void **state)
{
    enum { FILES = 50 };
    char path[400], name[60];
    (void)state;
    snprintf(path, sizeof path, "%s/many", support_cache);
    assert_int_equal(mkdir(path, 0700), 0);
    for (int i = 0; i <= FILES; i++) {
        struct timespec times[2];
        clock_gettime(CLOCK_REALTIME, times);
        times[0].tv_sec -= 60 * (i * 7 % FILES);
        times[1] = times[0];
        snprintf(name, sizeof name, i < FILES ? "/many/%032x%s" : "/many/tuned-%x%s", i * 77,
                 i % 2 ? ".bin" : ".has");
        snprintf(path, sizeof path, "%s%s", support_cache, name);
        int file = open(path, O_WRONLY | O_CREAT, 0600);
        assert_true(file >= 0);
        close(file);
        assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    }
    assert_int_equal(access(path, F_OK), 0);
    snprintf(path, sizeof path, "%s/many", support_cache);
    assert_int_equal(cache_trim(path, FILES, 0), 0);
    assert_int_equal(cache_trim(path, 20, 0), FILES - 20);
    assert_int_equal(cache_trim(path, 20, 0), 0);
    assert_int_equal(cache_trim(path, 0, 60 * 10 - 30), 10);
    snprintf(name, sizeof name, "/many/tuned-%x%s", FILES * 77, FILES % 2 ? ".bin" : ".has");
    snprintf(path, sizeof path, "%s%s", support_cache, name);
    assert_int_equal(access(path, F_OK), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_are_kept_and_loaded),
        cmocka_unit_test(damaged_programs_are_compiled_again),
        cmocka_unit_test(nothing_is_kept_where_nobody_wants_it),
        cmocka_unit_test(program_that_needs_the_header_gets_it),
        cmocka_unit_test(the_oldest_files_go),
    };
    return cmocka_run_group_tests(tests, support_cache_make, support_cache_remove);
}
