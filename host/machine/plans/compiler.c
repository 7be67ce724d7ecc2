/* compiler.c - lutetia-compiler: has PoCL compile kernels, and keep them on disk, for a machine
 * in another process.
 *
 * background.c starts the process and sends requests; its head explains why. The process
 * ends at once when the machine closes the socket or the machine's process has ended, and
 * when it has been idle for a while.
 */
#include "plans/compiler.h"

#include <CL/cl.h>
#include <poll.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

#include "pocl_cache.h"

enum { IDLE_MS = 30000, MOST = 64, TEXT_MOST = 16 << 20, MEMORY_BYTES = 1 << 16 };

static cl_device_id device;

static cl_context context;

static cl_command_queue queue;

static cl_mem memory;

/* The machine's process, to notice its end: its forked children may keep the socket open.
 * -1: not supported. */
static int process;

static void *leave_with_machine(void *nothing)
{
    struct pollfd machine[2] = {{.fd = STDIN_FILENO, .events = POLLRDHUP},
                                {.fd = process, .events = POLLIN}};
    while (poll(machine, 2, -1) <= 0)
        ;
    _exit(EXIT_SUCCESS);
    return nothing;
}

/* PoCL's cache, while the first kernel is compiled. A program that was removed in part is
 * compiled again. */
static void *trim(void *nothing)
{
    const char *cache = getenv("POCL_CACHE_DIR");
    if (cache)
        pocl_cache_trim(cache, POCL_CACHE_MOST, 3600);
    return nothing;
}

static bool asked(void)
{
    struct pollfd machine = {.fd = STDIN_FILENO, .events = POLLIN};
    return poll(&machine, 1, IDLE_MS) > 0;
}

static bool take(void *out, size_t bytes)
{
    return recv(STDIN_FILENO, out, bytes, MSG_WAITALL) == (ssize_t)bytes;
}

static bool strings_take(const struct compiler_request *r, char *strings[COMPILER_STRINGS])
{
    for (int i = 0; i < COMPILER_STRINGS; i++) {
        uint32_t bytes = r->bytes[i];
        strings[i] = bytes && bytes <= TEXT_MOST ? malloc(bytes) : NULL;
        if (!strings[i] || !take(strings[i], bytes) || strings[i][bytes - 1])
            return false;
    }
    return true;
}

static bool is_called(cl_platform_id p, cl_device_id d, char *const strings[COMPILER_STRINGS])
{
    char platform[128] = "", name[256] = "";
    clGetPlatformInfo(p, CL_PLATFORM_NAME, sizeof platform - 1, platform, NULL);
    clGetDeviceInfo(d, CL_DEVICE_NAME, sizeof name - 1, name, NULL);
    return !strcmp(platform, strings[COMPILER_PLATFORM]) &&
           !strcmp(name, strings[COMPILER_DEVICE]);
}

static bool device_find(char *const strings[COMPILER_STRINGS])
{
    cl_platform_id platforms[MOST];
    cl_device_id devices[MOST];
    cl_uint platforms_count = 0, count;
    if (clGetPlatformIDs(MOST, platforms, &platforms_count))
        return false;
    for (cl_uint p = 0; p < platforms_count && p < MOST; p++) {
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, MOST, devices, &count))
            continue;
        for (cl_uint i = 0; i < count && i < MOST; i++)
            if (is_called(platforms[p], devices[i], strings)) {
                device = devices[i];
                return true;
            }
    }
    return false;
}

static bool device_open(char *const strings[COMPILER_STRINGS])
{
    cl_int error;
    if (memory)
        return true;
    if (!device_find(strings))
        return false;
    context = clCreateContext(NULL, 1, &device, NULL, NULL, &error);
    if (!error)
        queue = clCreateCommandQueueWithProperties(context, device, NULL, &error);
    if (!error)
        memory = clCreateBuffer(context, CL_MEM_READ_WRITE, MEMORY_BYTES, NULL, &error);
    return error == CL_SUCCESS;
}

/* Sets arguments with which the kernel computes nothing. */
static cl_int arguments_set(cl_kernel kernel, const char *arguments)
{
    cl_int error = CL_SUCCESS;
    cl_uint numbers = 0;
    for (cl_uint i = 0; arguments[i] && !error; i++) {
        cl_int number = ++numbers == 3 ? COMPILER_NOTHING : 1;
        cl_ulong zero = 0;
        error = arguments[i] == 'm'   ? clSetKernelArg(kernel, i, sizeof memory, &memory)
                : arguments[i] == '8' ? clSetKernelArg(kernel, i, sizeof zero, &zero)
                                      : clSetKernelArg(kernel, i, sizeof number, &number);
    }
    return error;
}

/* Starts the kernel, which makes the driver compile it. */
static cl_int start(cl_kernel kernel, const struct compiler_request *r)
{
    const size_t local[3] = {r->group, 1, 1};
    size_t widest = r->widest < COMPILER_WIDEST ? (size_t)r->widest : COMPILER_WIDEST,
           global[3] = {r->group, widest, 1};
    cl_int error = clEnqueueNDRangeKernel(queue, kernel, r->dimensions, NULL, global, local, 0,
                                          NULL, NULL);
    return error ? error : clFinish(queue);
}

static bool compile(const struct compiler_request *r, char *const strings[COMPILER_STRINGS])
{
    const char *text = strings[COMPILER_TEXT];
    cl_kernel kernel = NULL;
    cl_int error;
    if (!device_open(strings) || r->dimensions < 2 || r->dimensions > 3 || !r->widest ||
        !r->group)
        return false;
    cl_program program = clCreateProgramWithSource(context, 1, &text, NULL, &error);
    if (error)
        return false;
    error = clBuildProgram(program, 1, &device, strings[COMPILER_OPTIONS], NULL, NULL);
    if (!error)
        kernel = clCreateKernel(program, strings[COMPILER_NAME], &error);
    if (!error)
        error = arguments_set(kernel, strings[COMPILER_ARGUMENTS]);
    if (!error)
        error = start(kernel, r);
    if (kernel)
        clReleaseKernel(kernel);
    clReleaseProgram(program);
    return error == CL_SUCCESS;
}

static void answer(char what)
{
    if (send(STDIN_FILENO, &what, 1, MSG_NOSIGNAL) != 1)
        _exit(EXIT_FAILURE);
}

/* Detaches the process: it is nobody's child, leaves no core file, and may run on all
 * processors. POCL_AFFINITY, which tying threads sets, would tie it to the first one. */
static void settle(pid_t machine)
{
    const struct rlimit none = {0, 0};
    close_range(STDERR_FILENO + 1, ~0U, 0); /* descriptors of the program, whose end others
                                             * may wait for */
    process = pidfd_open(machine, 0);
    if (getppid() != machine) /* the machine's process has ended; this may be another one */
        _exit(EXIT_FAILURE);
    pid_t child = fork();
    if (child)
        _exit(child > 0 ? EXIT_SUCCESS : EXIT_FAILURE);
    setrlimit(RLIMIT_CORE, &none);
    setenv("POCL_AFFINITY", "0", 1);
    setenv("POCL_MAX_PTHREAD_COUNT", "1", 1);
}

int main(int argc, char **argv)
{
    struct compiler_request request;
    pthread_t thread;
    if (argc != 2 || send(STDIN_FILENO, "", 0, MSG_NOSIGNAL) < 0) { /* not a socket: started by
                                                                     * hand */
        fprintf(stderr, "lutetia-compiler: it is run by programs that use Lutetia's machine, "
                        "and is of no use by itself\n");
        return EXIT_FAILURE;
    }
    settle(atoi(argv[1]));
    if (pthread_create(&thread, NULL, leave_with_machine, NULL))
        return EXIT_FAILURE;
    if (!pthread_create(&thread, NULL, trim, NULL))
        pthread_detach(thread);
    answer(COMPILER_READY);
    while (asked() && take(&request, sizeof request)) {
        char *strings[COMPILER_STRINGS] = {NULL};
        if (!strings_take(&request, strings))
            break;
        answer(compile(&request, strings) ? COMPILER_DONE : COMPILER_FAILED);
        for (int i = 0; i < COMPILER_STRINGS; i++)
            free(strings[i]);
    }
    _exit(EXIT_SUCCESS); /* exits at once, without the driver's exit handlers */
}
