/* test_drivers.c - drivers other than the one at hand: what the machine does on a device that
 * says that it has no double precision, and with another log. This program answers the
 * questions before OpenCL's loader does; kernels are still the driver's. */
#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <CL/cl.h>

#include "paris_internal.h"
#include <cm/paris.h>

static struct {
    bool doubles; /* the device has double precision */
    size_t log;   /* programs do not compile, and the log has so many characters; 0: they do */
} driver = {.doubles = true};

#define NEXT(function) ((__typeof__(&(function)))(uintptr_t)dlsym(RTLD_NEXT, #function))

static cl_int answer(const void *what, size_t bytes, size_t room, void *to, size_t *size)
{
    if (to && room < bytes)
        return CL_INVALID_VALUE;
    if (to)
        memcpy(to, what, bytes);
    if (size)
        *size = bytes;
    return CL_SUCCESS;
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info question, size_t room, void *to,
                       size_t *size)
{
    static const cl_device_fp_config none = 0;
    if (!driver.doubles && question == CL_DEVICE_DOUBLE_FP_CONFIG)
        return answer(&none, sizeof none, room, to, size);
    return NEXT(clGetDeviceInfo)(device, question, room, to, size);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *told)(cl_program, void *),
                      void *with)
{
    if (driver.log)
        return CL_BUILD_PROGRAM_FAILURE;
    return NEXT(clBuildProgram)(program, count, devices, options, told, with);
}

cl_int clGetProgramBuildInfo(cl_program program, cl_device_id device,
                             cl_program_build_info question, size_t room, void *to,
                             size_t *size)
{
    if (!driver.log || question != CL_PROGRAM_BUILD_LOG)
        return NEXT(clGetProgramBuildInfo)(program, device, question, room, to, size);
    char *text = malloc(driver.log + 1);
    assert_non_null(text);
    for (size_t i = 0; i < driver.log; i++)
        text[i] = i % 40 == 39 ? '\n' : 'x';
    text[driver.log] = '\0';
    memcpy(text, "the reason", 10);
    cl_int error = answer(text, driver.log + 1, room, to, size);
    free(text);
    return error;
}

static void a_device_without_doubles_is_refused(void **unused)
{
    struct machine_config config = machine_config_default();
    struct machine *m = NULL;
    (void)unused;
    driver.doubles = false;
    assert_int_equal(machine_create(&config, &m), MACHINE_NO_DEVICE);
    driver.doubles = true;
    assert_non_null(strstr(machine_error(m), "has no double precision"));
    assert_null(strchr(machine_error(m), '\n'));
    machine_destroy(m);
}

/* ---- what a compiler says ---- */

static char said[1 << 16];

static void keep_said(const char *message)
{
    strncpy(said, message, sizeof said - 1);
}

/* The log is told, however long it is, as far as there is room. */
static void a_log_of_any_length_is_told(void **unused)
{
    static const size_t lengths[] = {11, 898, 899, 900, 901, 5000, 40000};
    (void)unused;
    setenv("LUTETIA_INTERPRET", "0", 1);
    setenv("LUTETIA_NEAR", "0", 1);
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        struct machine_config config = machine_config_default();
        struct machine *m = NULL;
        const int side[1] = {1000 + (int)i};
        assert_int_equal(machine_create(&config, &m), MACHINE_OK);
        assert_true(machine_vpset_select(m, machine_vpset_create(m, side, 1)) == MACHINE_OK);
        machine_begin(m);
        struct machine_value *v = machine_coordinate(m, 0, 32);
        struct machine_scalar out;
        driver.log = lengths[i];
        enum machine_status status =
            machine_reduce(m, MACHINE_REDUCE_ADD, machine_binary(m, MACHINE_MUL, v, v), &out);
        driver.log = 0;
        keep_said(machine_error(m));
        assert_int_equal(status, MACHINE_BUILD_FAILED);
        assert_non_null(strstr(said, "a kernel did not compile on "));
        assert_null(strchr(said, '\n'));
        if (!strstr(said, "the reason"))
            fail_msg("of a log of %d characters this is told: %s", (int)lengths[i], said);
        machine_destroy(m);
    }
}

int main(void)
{
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_device_without_doubles_is_refused),
                                       cmocka_unit_test(a_log_of_any_length_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
