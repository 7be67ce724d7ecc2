/* confine.c - see confine.h. */
#include "confine.h"

#include "input_file.h"

#include <errno.h>
#include <limits.h>
#include <seccomp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

void confine_resources(pid_t parent, unsigned cpu_seconds, unsigned long long memory_bytes)
{
    struct rlimit seconds = {cpu_seconds, cpu_seconds}, none = {0, 0};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) /* the parent died before prctl() */
        _exit(1);
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(LUTETIA_FUZZ)
    long pages = 0;
    FILE *sizes = memory_bytes ? input_file_open("/proc/self/statm", NULL) : NULL;
    if (sizes && fscanf(sizes, "%ld", &pages) == 1) {
        rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + memory_bytes;
        setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
    }
    if (sizes)
        fclose(sizes);
#else
    (void)memory_bytes;
#endif
}

static void descriptors_close(unsigned first, unsigned last)
{
    if (first > last || close_range(first, last, 0) == 0)
        return;
    const long most = sysconf(_SC_OPEN_MAX); /* a kernel before 5.9 */
    for (unsigned i = first; i <= last && i < (unsigned)most; i++)
        close((int)i);
}

void confine_descriptors(const int *kept, int count)
{
    unsigned first = STDERR_FILENO + 1;
    for (;;) { /* from each one that is kept to the next */
        unsigned next = UINT_MAX;
        for (int i = 0; i < count; i++)
            if (kept[i] >= 0 && (unsigned)kept[i] >= first && (unsigned)kept[i] < next)
                next = (unsigned)kept[i];
        if (next == UINT_MAX)
            break;
        descriptors_close(first, next - 1);
        first = next + 1;
    }
    descriptors_close(first, UINT_MAX);
}

/* The system calls, in glibc, for reading open files, allocating memory and exiting
 * normally. */
static const int allowed[] = {
    SCMP_SYS(read),
    SCMP_SYS(pread64),
    SCMP_SYS(readv),
    SCMP_SYS(lseek),
    SCMP_SYS(_llseek),
    SCMP_SYS(write),
    SCMP_SYS(writev),
    SCMP_SYS(close),
    SCMP_SYS(fstat),
    SCMP_SYS(fstat64),
    SCMP_SYS(newfstatat),
    SCMP_SYS(fstatat64),
    SCMP_SYS(statx),
    SCMP_SYS(flock),
    SCMP_SYS(fcntl),
    SCMP_SYS(fcntl64),
    SCMP_SYS(mmap),
    SCMP_SYS(mmap2),
    SCMP_SYS(munmap),
    SCMP_SYS(mremap),
    SCMP_SYS(madvise),
    SCMP_SYS(mprotect),
    SCMP_SYS(brk),
    SCMP_SYS(futex),
    SCMP_SYS(getpid),
    SCMP_SYS(gettid),
    SCMP_SYS(clock_gettime),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(time),
    SCMP_SYS(clock_gettime64),
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(sigaltstack),
    SCMP_SYS(sched_yield),
    SCMP_SYS(getrandom),
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
    SCMP_SYS(restart_syscall),
};

bool confine_calls(void)
{
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    bool done = filter != NULL;
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed && done; i++) {
        int added = seccomp_rule_add(filter, SCMP_ACT_ALLOW, allowed[i], 0);
        done = added == 0 ||
               added == -EDOM; /* EDOM: this processor's system does not have the call */
    }
    done = done && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return done;
}
