/* test_awake.c - when the server asks for processors that do not sleep, with a usual file in
 * place of the kernel's. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <server_awake.h>

#include "../display/scratch.h"

#include <fcntl.h>

static const uint64_t SECOND_NS = 1000000000;

static void awake_while_messages_come(void **unused)
{
    (void)unused;
    const char *path = scratch_path("latency");
    struct server_awake a;
    uint8_t bytes[8] = {0};
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fclose(file);
    assert_true(awake_begin(&a, path));
    awake_look(&a, 0, 1 * SECOND_NS);
    assert_int_equal(a.file, -1); /* nobody has played */
    awake_look(&a, 3, 2 * SECOND_NS);
    assert_true(a.file >= 0);
    assert_true(fcntl(a.file, F_GETFD) & FD_CLOEXEC);
    file = fopen(path, "rb");
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), 4); /* as the kernel wants it */
    fclose(file);
    awake_look(&a, 4, 9 * SECOND_NS);
    awake_look(&a, 4, 18 * SECOND_NS);
    assert_true(a.file >= 0);
    const int was = a.file;
    awake_look(&a, 4, 19 * SECOND_NS); /* ten seconds after the last one */
    assert_int_equal(a.file, -1);
    assert_int_equal(fcntl(was, F_GETFD), -1);
    awake_look(&a, 5, 40 * SECOND_NS);
    assert_true(a.file >= 0);
    awake_end(&a);
    assert_int_equal(a.file, -1);
}

static void not_wanted_or_not_allowed(void **unused)
{
    (void)unused;
    struct server_awake a;
    assert_true(awake_begin(&a, NULL));
    awake_look(&a, 1, SECOND_NS);
    assert_int_equal(a.file, -1);
    awake_end(&a);
    assert_false(awake_begin(&a, scratch_path("not there")));
    awake_look(&a, 1, SECOND_NS);
    assert_int_equal(a.file, -1);
    assert_true(awake_begin(&a, "/dev/full")); /* can be opened, refuses what is written */
    awake_look(&a, 1, SECOND_NS);
    awake_look(&a, 2, 2 * SECOND_NS);
    assert_int_equal(a.file, -1);
    awake_end(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(awake_while_messages_come),
        cmocka_unit_test(not_wanted_or_not_allowed),
    };
    return cmocka_run_group_tests_name("awake", tests, NULL, NULL);
}
