/* Devices: a number or part of a name chooses one. Each of PoCL's threads is bound to a
 * processor unless the environment says otherwise. (security.md 15) */
#include "../skip.h"
#include "devices.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void one_is_chosen_by_number_or_name(void **state)
{
    static const struct opencl_device all[] = {
        {.platform_name = "Portable Computing Language", .name = "pthread-AMD EPYC"},
        {.platform_name = "Somebody's CUDA", .name = "Accelerator 7"},
        {.platform_name = "Somebody's CUDA", .name = "Accelerator 9"}};
    static const struct {
        const char *wanted;
        int chosen;
    } cases[] = {{NULL, 0},
                 {"", 0},
                 {"0", 0},
                 {"2", 2},
                 {"3", -1},
                 {"-1", -1},
                 {"epyc", 0},
                 {"cuda", 1},
                 {"rator 9", 2},
                 {"GPU", -1},
                 {"99999999999999999999", -1}};
    (void)state;
    unsetenv("LUTETIA_DEVICE");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *said = "unset";
        assert_int_equal(cases[i].chosen, opencl_device_choose(all, 3, cases[i].wanted, &said));
        if (cases[i].wanted && *cases[i].wanted)
            assert_string_equal(said, cases[i].wanted);
        else
            assert_null(said);
    }
    assert_int_equal(-1, opencl_device_choose(all, 0, NULL, NULL));
    setenv("LUTETIA_DEVICE", "7", 1);
    assert_int_equal(-1, opencl_device_choose(all, 3, NULL, NULL));
    assert_int_equal(1, opencl_device_choose(all, 3, "accelerator", NULL));
    setenv("LUTETIA_DEVICE", "accelerator 9", 1);
    assert_int_equal(2, opencl_device_choose(all, 3, "", NULL));
    unsetenv("LUTETIA_DEVICE");
}

/* Counts this process's threads, except the first, that may run on one processor only. */
static int threads_tied(void)
{
    DIR *tasks = opendir("/proc/self/task");
    int tied = 0;
    if (!tasks)
        return 0;
    for (struct dirent *d; (d = readdir(tasks));) {
        cpu_set_t set;
        int id = atoi(d->d_name);
        if (id && id != getpid() && sched_getaffinity(id, sizeof set, &set) == 0)
            tied += CPU_COUNT(&set) == 1;
    }
    closedir(tasks);
    return tied;
}

static cl_uint units_of(cl_device_id device)
{
    cl_uint units = 0;
    clGetDeviceInfo(device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    return units;
}

/* Opens a device in a child process. Returns 1 where its threads are bound to processors, else
 * 0; 2 where a process of one processor has several of them. Threads bind themselves when they
 * begin. */
static int tied_in_child(const char *name, const char *value, bool one_processor)
{
    pid_t pid = fork();
    if (pid == 0) {
        static struct opencl_device all[OPENCL_DEVICES_MAX];
        cpu_set_t last;
        long processors = sysconf(_SC_NPROCESSORS_CONF);
        unsetenv("POCL_AFFINITY");
        unsetenv("POCL_MAX_PTHREAD_COUNT");
        if (name)
            setenv(name, value, 1);
        CPU_ZERO(&last);
        CPU_SET((size_t)processors - 1, &last);
        if (one_processor && sched_setaffinity(0, sizeof last, &last))
            _exit(77);
        int count = opencl_devices(all, NULL), tied = 0;
        if (count <= 0)
            _exit(77);
        cl_int error;
        cl_context context = clCreateContext(NULL, 1, &all[0].id, NULL, NULL, &error);
        if (error)
            _exit(77);
        for (int i = 0; i < 50 && !tied; i++, usleep(10000))
            tied = threads_tied();
        (void)context;
        /* all threads are on the one processor: checks that none was moved off it */
        if (one_processor)
            _exit(getenv("POCL_AFFINITY") != NULL ? 1 : units_of(all[0].id) != 1 ? 2 : 0);
        _exit(tied > 0);
    }
    int status = 0;
    assert_int_equal(pid, waitpid(pid, &status, 0));
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void threads_have_a_processor_each_unless_told(void **state)
{
    (void)state;
    cpu_set_t ours;
    assert_int_equal(0, sched_getaffinity(0, sizeof ours, &ours));
    long processors = sysconf(_SC_NPROCESSORS_CONF);
    if (processors < 2 || CPU_COUNT(&ours) != processors) {
        skip_because("one processor, or not all are ours");
    }
    assert_int_equal(1, tied_in_child(NULL, NULL, false));
    assert_int_equal(0, tied_in_child("POCL_AFFINITY", "0", false));
    assert_int_equal(0, tied_in_child("POCL_MAX_PTHREAD_COUNT", "1", false));
    assert_int_equal(0, tied_in_child(NULL, NULL, true));
}

/* Finds, in a child, the cache folder that PoCL gets where the environment says `said` (NULL:
 * nothing). path: "" if the child ended by a signal. */
static void pocl_cache_of(const char *home, const char *said, char path[static 512],
                          mode_t *mode)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        struct opencl_device all[OPENCL_DEVICES_MAX];
        char told[512] = "";
        struct stat status = {0};
        unsetenv("XDG_CACHE_HOME");
        unsetenv("POCL_CACHE_DIR");
        unsetenv("HOME");
        if (home)
            setenv("HOME", home, 1);
        if (said)
            setenv("POCL_CACHE_DIR", said, 1);
        opencl_devices(all, NULL);
        snprintf(told, sizeof told, "%s", getenv("POCL_CACHE_DIR"));
        stat(told, &status);
        (void)!write(ends[1], told, sizeof told);
        (void)!write(ends[1], &status.st_mode, sizeof status.st_mode);
        exit(0);
    }
    close(ends[1]);
    if (read(ends[0], path, 512) != 512 || read(ends[0], mode, sizeof *mode) != sizeof *mode)
        path[0] = '\0';
    close(ends[0]);
    assert_int_equal(waitpid(child, NULL, 0), child);
}

/* Files in the cache are loaded as code, so it is never in a folder where another user can put
 * a file. */
static void pocl_keeps_its_programs_where_only_we_can_write(void **state)
{
    (void)state;
    char home[] = "/tmp/test-devices-XXXXXX", open_to_all[64], path[512], wanted[64];
    mode_t mode = 0;
    assert_non_null(mkdtemp(home));
    snprintf(wanted, sizeof wanted, "%s/.cache/pocl/kcache", home);
    snprintf(open_to_all, sizeof open_to_all, "%s/all", home);
    assert_int_equal(mkdir(open_to_all, 0700), 0);
    assert_int_equal(chmod(open_to_all, 0777), 0);

    pocl_cache_of(home, NULL, path, &mode);
    assert_string_equal(path, wanted);
    assert_int_equal(mode & 0777, 0700);
    pocl_cache_of(home, "", path, &mode); /* an empty name would make PoCL abort */
    assert_string_equal(path, wanted);
    pocl_cache_of(home, open_to_all, path, &mode);
    assert_string_equal(path, wanted);
    pocl_cache_of(NULL, NULL, path, &mode); /* a private one, gone with the child */
    assert_non_null(strstr(path, "/lutetia-cache-"));
    assert_int_equal(mode & 0777, 0700);
    assert_int_equal(access(path, F_OK), -1);

    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", home);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_is_chosen_by_number_or_name),
        cmocka_unit_test(pocl_keeps_its_programs_where_only_we_can_write),
        cmocka_unit_test(threads_have_a_processor_each_unless_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
