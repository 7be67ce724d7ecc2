/* jail.c - see jail.h. */
#include "jail.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* ---- files: Landlock ---- */

/* As <linux/landlock.h> has them since Linux 5.13; later headers have more. */
enum {
    ACCESS_EXECUTE = 1 << 0,
    ACCESS_WRITE = 1 << 1,
    ACCESS_READ = 1 << 2,
    ACCESS_READ_FOLDER = 1 << 3,
    ACCESS_FIRST = (1 << 13) - 1, /* those of version 1 */
    ACCESS_REFER = 1 << 13,       /* version 2 */
    ACCESS_TRUNCATE = 1 << 14,    /* version 3 */
    ACCESS_DEVICE = 1 << 15,      /* version 5 */
    RULE_PATH = 1,
    ASKS_VERSION = 1
};
/* What may be done to a file: the rest is about folders. */
#define ACCESS_OF_FILES                                                                        \
    (ACCESS_EXECUTE | ACCESS_WRITE | ACCESS_READ | ACCESS_TRUNCATE | ACCESS_DEVICE)
struct ruleset {
    uint64_t files, network, scope;
};
struct path_rule {
    uint64_t allowed;
    int32_t descriptor;
} __attribute__((packed));

#if defined(__NR_landlock_create_ruleset)
static long ruleset_make(const struct ruleset *r, size_t bytes, unsigned flags)
{
    return syscall(__NR_landlock_create_ruleset, r, bytes, flags);
}

static long rule_add(int ruleset, const struct path_rule *rule)
{
    return syscall(__NR_landlock_add_rule, ruleset, RULE_PATH, rule, 0);
}

static long ruleset_apply(int ruleset)
{
    return syscall(__NR_landlock_restrict_self, ruleset, 0);
}
#else
static long ruleset_make(const struct ruleset *r, size_t bytes, unsigned flags)
{
    (void)r;
    (void)bytes;
    (void)flags;
    errno = ENOSYS;
    return -1;
}

static long rule_add(int ruleset, const struct path_rule *rule)
{
    (void)ruleset;
    (void)rule;
    return -1;
}

static long ruleset_apply(int ruleset)
{
    (void)ruleset;
    return -1;
}
#endif

static int version_of(void)
{
    return (int)ruleset_make(NULL, 0, ASKS_VERSION);
}

bool jail_possible(void)
{
    return version_of() >= 1 && prctl(PR_GET_SECCOMP, 0, 0, 0, 0) >= 0;
}

/* Of the rights that this system knows. */
static bool path_allow(int ruleset, const char *path, uint64_t rights)
{
    struct stat status;
    struct path_rule rule = {.allowed = rights, .descriptor = open(path, O_PATH | O_CLOEXEC)};
    if (rule.descriptor < 0)
        return errno == ENOENT || errno == EACCES || errno == ENOTDIR;
    if (fstat(rule.descriptor, &status) == 0 && !S_ISDIR(status.st_mode))
        rule.allowed &= ACCESS_OF_FILES;
    const bool added = rule_add(ruleset, &rule) == 0;
    close(rule.descriptor);
    return added;
}

static bool files_bound(const struct jail *jail)
{
    const uint64_t reads = ACCESS_EXECUTE | ACCESS_READ | ACCESS_READ_FOLDER;
    const int version = version_of();
    struct ruleset r = {.files = ACCESS_FIRST};
    r.files |= version >= 2 ? ACCESS_REFER : 0;
    r.files |= version >= 3 ? ACCESS_TRUNCATE : 0;
    r.files |= version >= 5 ? ACCESS_DEVICE : 0;
    r.network = version >= 4 ? 3 : 0; /* TCP; seccomp allows no sockets at all */
    r.scope = version >= 6 ? 3 : 0;   /* sockets without a file, signals */
    const size_t bytes = version >= 6   ? sizeof r
                         : version >= 4 ? offsetof(struct ruleset, scope)
                                        : offsetof(struct ruleset, network);
    const int ruleset = version >= 1 ? (int)ruleset_make(&r, bytes, 0) : -1;
    bool good = ruleset >= 0;
    for (int i = 0; good && jail->reads[i]; i++)
        good = path_allow(ruleset, jail->reads[i], reads);
    if (good && jail->writes)
        good = path_allow(ruleset, jail->writes, r.files);
    if (good) /* what is written there is nowhere */
        good = path_allow(ruleset, "/dev/null", ACCESS_READ | ACCESS_WRITE);
    good = good && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ruleset_apply(ruleset) == 0;
    if (ruleset >= 0)
        close(ruleset);
    return good;
}

/* ---- calls: seccomp ---- */

/* What a program needs to be loaded, to compute with threads, and to use what it has open. */
static const int always[] = {
    SCMP_SYS(access),
    SCMP_SYS(alarm),
    SCMP_SYS(arch_prctl),
    SCMP_SYS(brk),
    SCMP_SYS(chdir),
    SCMP_SYS(clock_getres),
    SCMP_SYS(clock_gettime),
    SCMP_SYS(clock_nanosleep),
    SCMP_SYS(close),
    SCMP_SYS(close_range),
    SCMP_SYS(dup),
    SCMP_SYS(dup2),
    SCMP_SYS(dup3),
    SCMP_SYS(execve),
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
    SCMP_SYS(faccessat),
    SCMP_SYS(faccessat2),
    SCMP_SYS(fadvise64),
    SCMP_SYS(fdatasync),
    SCMP_SYS(flock),
    SCMP_SYS(fstat),
    SCMP_SYS(fstatfs),
    SCMP_SYS(fsync),
    SCMP_SYS(futex),
    SCMP_SYS(getcwd),
    SCMP_SYS(getdents64),
    SCMP_SYS(getegid),
    SCMP_SYS(geteuid),
    SCMP_SYS(getgid),
    SCMP_SYS(getitimer),
    SCMP_SYS(getpgrp),
    SCMP_SYS(getpid),
    SCMP_SYS(getppid),
    SCMP_SYS(getrandom),
    SCMP_SYS(getrlimit),
    SCMP_SYS(getrusage),
    SCMP_SYS(gettid),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(getuid),
    SCMP_SYS(lseek),
    SCMP_SYS(lstat),
    SCMP_SYS(madvise),
    SCMP_SYS(membarrier),
    SCMP_SYS(mmap),
    SCMP_SYS(mprotect),
    SCMP_SYS(mremap),
    SCMP_SYS(msync),
    SCMP_SYS(munmap),
    SCMP_SYS(nanosleep),
    SCMP_SYS(newfstatat),
    SCMP_SYS(pause),
    SCMP_SYS(pipe),
    SCMP_SYS(pipe2),
    SCMP_SYS(poll),
    SCMP_SYS(ppoll),
    SCMP_SYS(pread64),
    SCMP_SYS(preadv),
    SCMP_SYS(pselect6),
    SCMP_SYS(pwrite64),
    SCMP_SYS(read),
    SCMP_SYS(readlink),
    SCMP_SYS(readlinkat),
    SCMP_SYS(readv),
    SCMP_SYS(restart_syscall),
    SCMP_SYS(riscv_flush_icache),
    SCMP_SYS(rseq),
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigpending),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(rt_sigsuspend),
    SCMP_SYS(rt_sigtimedwait),
    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(sched_yield),
    SCMP_SYS(select),
    SCMP_SYS(set_robust_list),
    SCMP_SYS(set_tid_address),
    SCMP_SYS(setitimer),
    SCMP_SYS(sigaltstack),
    SCMP_SYS(stat),
    SCMP_SYS(statfs),
    SCMP_SYS(statx),
    SCMP_SYS(sysinfo),
    SCMP_SYS(time),
    SCMP_SYS(times),
    SCMP_SYS(umask),
    SCMP_SYS(uname),
    SCMP_SYS(write),
    SCMP_SYS(writev),
};

/* What a compiler needs besides: it makes files, where Landlock lets it, and starts
 * processes. */
static const int of_compilers[] = {
    SCMP_SYS(copy_file_range), SCMP_SYS(creat),    SCMP_SYS(fallocate), SCMP_SYS(fork),
    SCMP_SYS(ftruncate),       SCMP_SYS(link),     SCMP_SYS(linkat),    SCMP_SYS(mkdir),
    SCMP_SYS(mkdirat),         SCMP_SYS(rename),   SCMP_SYS(renameat),  SCMP_SYS(renameat2),
    SCMP_SYS(rmdir),           SCMP_SYS(sendfile), SCMP_SYS(unlink),    SCMP_SYS(unlinkat),
    SCMP_SYS(vfork),           SCMP_SYS(wait4),    SCMP_SYS(waitid),    SCMP_SYS(fchmod),
};

/* Adds rows, as long as all is well. */
struct calls {
    scmp_filter_ctx filter;
    bool good;
};

static void call_add(struct calls *c, int call, unsigned count, struct scmp_arg_cmp argument)
{
    if (!c->good)
        return;
    const int added = seccomp_rule_add_array(c->filter, SCMP_ACT_ALLOW, call, count, &argument);
    c->good = added == 0 || added == -EDOM; /* EDOM: not a call of this processor's system */
}

static struct scmp_arg_cmp equal(unsigned argument, scmp_datum_t value)
{
    return (struct scmp_arg_cmp){argument, SCMP_CMP_EQ, value, 0};
}

static struct scmp_arg_cmp masked(unsigned argument, scmp_datum_t mask, scmp_datum_t value)
{
    return (struct scmp_arg_cmp){argument, SCMP_CMP_MASKED_EQ, mask, value};
}

static void calls_add(struct calls *c, const int *calls, size_t count)
{
    for (size_t i = 0; i < count; i++)
        call_add(c, calls[i], 0, (struct scmp_arg_cmp){0});
}

/* A new process, or a thread: never with namespaces of its own. clone3() hides its flags; where
 * it is told to be missing, libraries take clone(). */
static void clones_add(struct calls *c, bool starts)
{
    const scmp_datum_t spaces = CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC |
                                CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET;
    const scmp_datum_t mask = starts ? spaces : spaces | CLONE_THREAD;
    call_add(c, SCMP_SYS(clone), 1, masked(0, mask, starts ? 0 : (scmp_datum_t)CLONE_THREAD));
    if (c->good)
        c->good = seccomp_rule_add(c->filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) == 0;
    if (c->good && !starts) /* fork() says what happens */
        c->good = seccomp_rule_add(c->filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(fork), 0) <= 0;
}

/* Opening: without O_TRUNC, which Landlock before version 3 does not see, but where files may
 * be made. */
static void opens_add(struct calls *c, bool writes)
{
    const scmp_datum_t mask = writes ? 0 : O_TRUNC | O_CREAT;
    call_add(c, SCMP_SYS(openat), 1, masked(2, mask, 0));
    call_add(c, SCMP_SYS(open), 1, masked(1, mask, 0));
}

/* What is allowed with some arguments alone: of open files what they are, not what they do, and
 * signals and limits of this process. */
static void some_add(struct calls *c)
{
    static const int controls[] = {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD,      F_SETFD,
                                   F_GETFL, F_SETFL,         F_GETPIPE_SZ, F_GETLK,
                                   F_SETLK, F_SETLKW,        F_GET_SEALS,  F_OFD_SETLK};
    static const int names[] = {PR_SET_NAME, PR_GET_NAME, PR_SET_VMA};
    const scmp_datum_t own = (scmp_datum_t)getpid();
    for (size_t i = 0; i < sizeof controls / sizeof *controls; i++)
        call_add(c, SCMP_SYS(fcntl), 1, equal(1, (scmp_datum_t)controls[i]));
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        call_add(c, SCMP_SYS(prctl), 1, equal(0, (scmp_datum_t)names[i]));
    call_add(c, SCMP_SYS(ioctl), 1, equal(1, TCGETS));
    call_add(c, SCMP_SYS(ioctl), 1, equal(1, FIONREAD));
    call_add(c, SCMP_SYS(tgkill), 1, equal(0, own));
    call_add(c, SCMP_SYS(kill), 1, equal(0, own));
    call_add(c, SCMP_SYS(prlimit64), 1, equal(0, 0));
    call_add(c, SCMP_SYS(sched_setaffinity), 1, equal(0, 0));
}

static bool calls_bound(const struct jail *jail)
{
    struct calls c = {seccomp_init(SCMP_ACT_ERRNO(EPERM)), true};
    c.good = c.filter != NULL;
    if (!c.good)
        return false;
    calls_add(&c, always, sizeof always / sizeof *always);
    if (jail->starts)
        calls_add(&c, of_compilers, sizeof of_compilers / sizeof *of_compilers);
    else if (c.good) /* folders are there: who makes its own again, as PoCL does, goes on */
        c.good = seccomp_rule_add(c.filter, SCMP_ACT_ERRNO(EEXIST), SCMP_SYS(mkdir), 0) <= 0;
    clones_add(&c, jail->starts);
    opens_add(&c, jail->writes != NULL);
    some_add(&c);
    c.good = c.good && seccomp_load(c.filter) == 0;
    seccomp_release(c.filter);
    return c.good;
}

/* ---- both ---- */

static bool bound(int what, rlim_t most)
{
    struct rlimit now;
    if (getrlimit((__rlimit_resource_t)what, &now) != 0)
        return false;
    if (now.rlim_max != RLIM_INFINITY && now.rlim_max < most)
        most = now.rlim_max;
    return setrlimit((__rlimit_resource_t)what, &(struct rlimit){most, most}) == 0;
}

bool jail_enter(const struct jail *jail)
{
    bool good = bound(RLIMIT_CORE, 0) && bound(RLIMIT_NOFILE, jail->files);
    if (good && jail->cpu_seconds)
        good = bound(RLIMIT_CPU, jail->cpu_seconds);
#if !defined(__SANITIZE_ADDRESS__)
    if (good && jail->memory_bytes)
        good = bound(RLIMIT_AS, jail->memory_bytes);
#endif
    if (good && jail->file_bytes)
        good = bound(RLIMIT_FSIZE, jail->file_bytes);
    return good && files_bound(jail) && calls_bound(jail);
}
