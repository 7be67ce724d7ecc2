/* check.c - converts OpenCL's errors to the machine's. */
#include "base/errors.h"
#include "base/parts.h"
#include "device/device.h"

static const struct {
    cl_int code;
    const char *name;
} error_names[] = {
    {CL_DEVICE_NOT_FOUND, "no such device"},
    {CL_DEVICE_NOT_AVAILABLE, "the device is not available"},
    {CL_COMPILER_NOT_AVAILABLE, "there is no compiler"},
    {CL_MEM_OBJECT_ALLOCATION_FAILURE, "not enough device memory"},
    {CL_OUT_OF_RESOURCES, "out of resources"},
    {CL_OUT_OF_HOST_MEMORY, "not enough memory"},
    {CL_BUILD_PROGRAM_FAILURE, "a kernel did not compile"},
    {CL_INVALID_VALUE, "invalid value"},
    {CL_INVALID_BUFFER_SIZE, "the buffer is too large"},
    {CL_INVALID_KERNEL_ARGS, "invalid kernel arguments"},
    {CL_INVALID_WORK_GROUP_SIZE, "invalid work-group size"},
    {-1001, "no OpenCL platform is installed (Debian: apt-get install pocl-opencl-icd)"},
};

static const char *error_name(cl_int error)
{
    for (size_t i = 0; i < sizeof error_names / sizeof *error_names; i++)
        if (error_names[i].code == error)
            return error_names[i].name;
    return "error";
}

enum machine_status device_is_not_ours(struct machine *m)
{
    return machine_fail(
        m, MACHINE_DEVICE_FAILED,
        m->device->queued
            ? "this is a child of fork(), and the machine was at work in another thread: "
              "fork in the thread that uses the machine, or exec another program"
            : "this is a child of fork(), where %s has no threads, and what is wanted needs a "
              "kernel: fork before the first instruction, or exec another program",
        m->device->name);
}

enum machine_status device_check(struct machine *m, cl_int error, const char *what)
{
    if (error == CL_SUCCESS)
        return MACHINE_OK;
    bool memory = error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_HOST_MEMORY ||
                  error == CL_INVALID_BUFFER_SIZE;
    return machine_fail(m, memory ? MACHINE_NO_MEMORY : MACHINE_DEVICE_FAILED,
                        "%s: %s (OpenCL error %d on %s)", what, error_name(error), error,
                        m->device->name);
}
