/* test_library.c - a library that is loaded fills its table; one that is missing, or lacks a function, leaves it as it was. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(functions_are_found),
                                       cmocka_unit_test(what_is_missing_is_named)};
    return cmocka_run_group_tests_name("library", tests, NULL, NULL);
}
