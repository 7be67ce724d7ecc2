/* test_errors.c - a wrong call gives a status and one clear line, and changes nothing in the
 * machine. */
#include <sys/wait.h>
#include <unistd.h>

#include "../skip.h"
#include "base/arrays.h"
#include "machine_rows.h"
#include "support.h"

static struct machine *machine;
static int set;
static uint32_t field;

static int setup(void **state)
{
    (void)state;
    machine = support_machine(0);
    set = support_set(machine, 2, 3, 41);
    field = support_field(machine, MACHINE_UINT(32), 1);
    return 0;
}

static wide expected_untouched(const void *data, uint64_t n)
{
    (void)data;
    return support_word(MACHINE_UINT(32), 1, n);
}

/* After the failed calls the field holds its old contents and the machine still computes. */
static int teardown(void **state)
{
    (void)state;
    machine_error_clear(machine);
    assert_ok(machine_vpset_select(machine, set), machine);
    support_expect_field(machine, field, MACHINE_UINT(32), expected_untouched, NULL,
                         "after a failed call");
    machine_destroy(machine);
    return 0;
}

static void device_that_is_not_there_is_refused(void **state)
{
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;

    (void)state;
    config.device = "no such device";
    assert_int_equal(machine_create(&config, &m), MACHINE_NO_DEVICE);
    assert_non_null(strstr(machine_error(m), "no such device"));
    machine_destroy(m);
    config.device = "999";
    assert_int_equal(machine_create(&config, &m), MACHINE_NO_DEVICE);
    machine_destroy(m);
    config = machine_config_default();
    config.processors_count = 100; /* not a power of two */
    assert_int_equal(machine_create(&config, &m), MACHINE_BAD_ARGUMENT);
    machine_destroy(m);
    machine_destroy(NULL);
}

static void settings_that_are_nonsense_are_refused(void **state)
{
    static const char *const wrong[][2] = {{"LUTETIA_TURNS", "0"},
                                           {"LUTETIA_TURNS", "many"},
                                           {"LUTETIA_VECTOR", "2"},
                                           {"LUTETIA_VECTOR", "16x"},
                                           {"LUTETIA_COLUMNS", "40"},
                                           {"LUTETIA_COLUMNS", "-16"},
                                           {"LUTETIA_TILE", "64"},
                                           {"LUTETIA_TILE", "0x8"},
                                           {"LUTETIA_TILE", "8x1025"},
                                           {"LUTETIA_TILE", "8x8x8"},
                                           {"LUTETIA_TILE", "1234567890x8"},
                                           {"LUTETIA_STRIPS", "yes"},
                                           {"LUTETIA_EAGER", "2"},
                                           {"LUTETIA_FLUSH_AFTER", "1e3"},
                                           {"LUTETIA_BOX_AFTER", "99999999999999999999"},
                                           {"LUTETIA_BACKGROUND", "2"},
                                           {"LUTETIA_PROCESSORS", "48"},
                                           {"LUTETIA_SCATTER", " 1"},
                                           {"LUTETIA_KEEP", "-1"}};
    struct machine_config config = machine_config_default();

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct machine *m = NULL;
        setenv(wrong[i][0], wrong[i][1], 1);
        assert_int_equal(machine_create(&config, &m), MACHINE_BAD_ARGUMENT);
        assert_non_null(strstr(machine_error(m), wrong[i][0]));
        assert_non_null(strstr(machine_error(m), wrong[i][1]));
        machine_destroy(m);
        unsetenv(wrong[i][0]);
    }
}

static void count_device(void *context, int index, const char *platform, const char *device,
                         const char *version, int compute_units, uint64_t memory_bytes)
{
    int *count = context;

    assert_int_equal(index, *count);
    assert_true(*platform && *device && *version && compute_units > 0 && memory_bytes > 0);
    (*count)++;
}

static void devices_are_listed_in_order(void **state)
{
    int count = 0, listed = machine_devices_list(count_device, &count);

    (void)state;
    assert_int_equal(listed, count);
    assert_true(count > 0);
    assert_true(*machine_device_name(machine));
}

static void vpset_of_bad_shape_is_refused(void **state)
{
    int many[40];

    (void)state;
    for (int k = 0; k < 40; k++)
        many[k] = 1;
    assert_int_equal(machine_vpset_create(machine, (int[]){3, 0}, 2), 0);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_vpset_create(machine, (int[]){-4}, 1), 0);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_vpset_create(machine, many, 0), 0);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_vpset_create(machine, many, MACHINE_AXES_MAX + 1), 0);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_true(machine_vpset_create(machine, many, MACHINE_AXES_MAX) > 0);
    assert_int_equal(machine_vpset_create(machine, (int[]){100000, 100000, 100000}, 3), 0);
    assert_int_not_equal(machine_status_last(machine), MACHINE_OK);
    machine_error_clear(machine);
    assert_int_equal(machine_vpset_select(machine, 12345), MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_vpset_destroy(machine, -1), MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

static void field_that_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_int_equal(machine_field_allocate(machine, set, UINT32_MAX, MACHINE_HEAP),
                     MACHINE_NO_FIELD);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_allocate(machine, 777, 8, MACHINE_HEAP), MACHINE_NO_FIELD);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

static void field_that_is_gone_is_refused(void **state)
{
    uint32_t gone = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    struct machine_scalar ignored;
    uint32_t words[123];

    (void)state;
    assert_ok(machine_field_deallocate(machine, gone), machine);
    assert_int_equal(machine_field_deallocate(machine, gone), MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    machine_begin(machine);
    assert_null(machine_field_value(machine, gone, MACHINE_UINT(32), MACHINE_EVERYWHERE));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_store(machine, gone,
                                         support_value(machine, field, MACHINE_UINT(32)),
                                         MACHINE_WHERE_ACTIVE),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_download(machine, gone, MACHINE_UINT(32), words),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_upload(machine, gone, MACHINE_UINT(32), words),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_read(machine, gone, MACHINE_UINT(32), 0, &ignored),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    /* a part of a field is not deallocated as the whole, nor a heap field as a stack field */
    assert_int_equal(machine_field_deallocate(machine, field + 8), MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_deallocate_through(machine, field), MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

static void access_beyond_the_field_is_refused(void **state)
{
    struct machine_scalar ignored;

    (void)state;
    machine_begin(machine);
    assert_null(machine_field_value(machine, field + 1, MACHINE_UINT(32), MACHINE_EVERYWHERE));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_field_value(machine, field, MACHINE_UINT(129), MACHINE_EVERYWHERE));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_field_value(machine, field, MACHINE_UINT(0), MACHINE_EVERYWHERE));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_store(machine, field + 1,
                                         support_value(machine, field, MACHINE_UINT(32)),
                                         MACHINE_EVERYWHERE),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_read(machine, field, MACHINE_UINT(32), 123, &ignored),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

static void looking_at_fields_of_two_sets_or_at_none_is_refused(void **state)
{
    const int other = machine_vpset_create(machine, (int[]){4, 5}, 2);
    const uint32_t fields[] = {field, machine_field_allocate(machine, other, 32, MACHINE_HEAP)};
    struct machine_rows rows[2];

    (void)state;
    assert_int_equal(machine_fields_look(machine, fields, 2, MACHINE_UINT(32), rows),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "two VP sets");
    assert_null(rows[0].at);
    assert_int_equal(machine_fields_look(machine, fields, 0, MACHINE_UINT(32), rows),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "got 0");
    assert_ok(machine_vpset_destroy(machine, other), machine);
}

static void operation_on_wrong_types_is_refused(void **state)
{
    struct machine_value *word, *byte, *real;

    (void)state;
    machine_begin(machine);
    word = support_value(machine, field, MACHINE_UINT(32));
    byte = support_value(machine, field, MACHINE_UINT(8));
    real = support_value(machine, field, MACHINE_F32);
    assert_null(machine_binary(machine, MACHINE_ADD, word, byte));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_binary(machine, MACHINE_FADD, real, word));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_binary(machine, MACHINE_ADD, real, real));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_unary(machine, MACHINE_FNEG, word));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_select(machine, byte, word, word));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_extract(machine, byte, 4, 5));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_resize(machine, word, 0, false));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_reinterpret(machine, byte, MACHINE_F32));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_shift(machine, word, 2, 1));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_null(machine_coordinate(machine, -1, 8));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

static void values_of_two_sets_do_not_mix(void **state)
{
    struct machine_value *here, *there;
    uint32_t other_field;

    (void)state;
    machine_begin(machine);
    here = support_value(machine, field, MACHINE_UINT(32));
    support_set(machine, 1, 123);
    other_field = support_field(machine, MACHINE_UINT(32), 2);
    there = support_value(machine, other_field, MACHINE_UINT(32));
    assert_null(machine_binary(machine, MACHINE_ADD, here, there));
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
    assert_int_equal(machine_field_store(machine, other_field, here, MACHINE_EVERYWHERE),
                     MACHINE_BAD_ARGUMENT);
    support_failed(machine, MACHINE_BAD_ARGUMENT, "");
}

/* What the program printed comes out, and then the line. */
static void no_memory_for_tables_ends_with_a_line(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip_because("a sanitizer reports by itself what cannot be allocated");
#endif
    char said[200] = "";
    int ends[2], status;
    assert_int_equal(pipe(ends), 0);
    fflush(stdout);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (!child) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        close(ends[1]);
        printf("printed before; ");
        array_zeroed(SIZE_MAX / 4, 2);
        _exit(0);
    }
    close(ends[1]);
    FILE *from = fdopen(ends[0], "r");
    assert_non_null(from);
    assert_non_null(fgets(said, sizeof said, from));
    assert_non_null(strstr(said, "printed before; lutetia: not enough memory"));
    assert_null(fgets(said, sizeof said, from));
    fclose(from);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), EXIT_FAILURE);
}

int main(void)
{
#define CASE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_memory_for_tables_ends_with_a_line),
        CASE(device_that_is_not_there_is_refused),
        CASE(settings_that_are_nonsense_are_refused),
        CASE(devices_are_listed_in_order),
        CASE(vpset_of_bad_shape_is_refused),
        CASE(field_that_cannot_be_is_refused),
        CASE(field_that_is_gone_is_refused),
        CASE(access_beyond_the_field_is_refused),
        CASE(looking_at_fields_of_two_sets_or_at_none_is_refused),
        CASE(operation_on_wrong_types_is_refused),
        CASE(values_of_two_sets_do_not_mix),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
