/* test_library.c - a library that is loaded fills its table; one that is missing, or lacks a
 * function, leaves it as it was; any version that has the functions will do. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <library.h>

struct table {
    double (*cos)(double x);
    double (*sin)(double x);
};

static void functions_are_found(void **unused)
{
    (void)unused;
    static const struct library_function functions[] = {LIBRARY_FUNCTION(struct table, cos),
                                                        LIBRARY_FUNCTION(struct table, sin)};
    struct table table = {NULL, NULL};
    const char *missing;
    assert_true(library_load("libm.so.6", functions, 2, &table, &missing));
    assert_null(missing);
    assert_true(table.cos(0) == 1 && table.sin(0) == 0);
}

static void what_is_missing_is_named(void **unused)
{
    (void)unused;
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(struct table, cos), {"cos_of_nothing", offsetof(struct table, sin)}};
    struct table table = {NULL, NULL};
    const char *missing;
    assert_false(library_load("libm.so.6", functions, 2, &table, &missing));
    assert_string_equal(missing, "cos_of_nothing");
    assert_true(!table.cos && !table.sin);
    assert_false(library_load("libnothing.so.99", functions, 2, &table, &missing));
    assert_null(missing);
    assert_true(!table.cos && !table.sin);
}

/* A number that is not installed: the version that is there does as well, unless no other
 * may. */
static void another_version_will_do(void **unused)
{
    (void)unused;
    static const struct library_function functions[] = {LIBRARY_FUNCTION(struct table, cos),
                                                        LIBRARY_FUNCTION(struct table, sin)};
    struct table table = {NULL, NULL};
    const char *missing;
    assert_false(library_load_exactly("libm.so.5", functions, 2, &table, &missing));
    assert_true(!missing && !table.cos && !table.sin);
    assert_true(library_load("libm.so.5", functions, 2, &table, &missing));
    assert_null(missing);
    assert_true(table.cos(0) == 1 && table.sin(0) == 0);
}

static void file_make(const char *folder, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
}

/* In a folder that the loader was told of as it began: see main(). Files that are no library
 * are versions, too, but never loaded. */
static void versions_are_listed(void **unused)
{
    (void)unused;
    static const char *const names[] = {"libthing.so",
                                        "libthing.so.",
                                        "libthing.so.3",
                                        "libthing.so.12",
                                        "libthing.so.7",
                                        "libthing.so.7.1",
                                        "libthing.so.99z",
                                        "libthin.so.40",
                                        "libthing2.so.50",
                                        "libthing.so.-8",
                                        "libthing.so.100000000000000000000"};
    const char *folder = getenv("LD_LIBRARY_PATH");
    int versions[4] = {-1, -1, -1, -1};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        file_make(folder, names[i]);
    assert_int_equal(library_versions("libthing.so.", versions, 4), 3);
    assert_true(versions[0] == 12 && versions[1] == 7 && versions[2] == 3 && versions[3] == -1);
    assert_int_equal(library_versions("libthing.so.", versions, 2), 2);
    assert_true(versions[0] == 12 && versions[1] == 7);
    assert_int_equal(library_versions("libnothing.so.", versions, 4), 0);

    static const struct library_function functions[] = {LIBRARY_FUNCTION(struct table, cos)};
    struct table table = {NULL, NULL};
    const char *missing;
    assert_false(library_load("libthing.so.4", functions, 1, &table, &missing));
    assert_true(!missing && !table.cos);
    assert_non_null(dlerror());
    char command[256];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(system(command), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_are_found), cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(another_version_will_do), cmocka_unit_test(versions_are_listed)};
    if (argc == 1) {
        char folder[] = "/tmp/library.XXXXXX";
        if (!mkdtemp(folder) || setenv("LD_LIBRARY_PATH", folder, 1) != 0)
            return 1;
        execl("/proc/self/exe", argv[0], "told", (char *)NULL);
        return 1;
    }
    return cmocka_run_group_tests_name("library", tests, NULL, NULL);
}
