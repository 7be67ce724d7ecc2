/* test_jail.c - a process in a jail reads what it was given, and can do nothing else; a
 * compiler in one writes into its folder alone. (security.md 39) */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../skip.h"

#include <jail.h>

/* Ends the child with the line number of a claim that does not hold as its status. */
#define HOLDS(claim)                                                                           \
    do {                                                                                       \
        if (!(claim))                                                                          \
            _exit(__LINE__ % 120 + 1);                                                         \
    } while (0)

static char folder[] = "/tmp/lutetia-test-jail-XXXXXX", inside[100], outside[100];

static void file_make(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("text\n", file);
    fclose(file);
}

static bool reads(const char *path)
{
    char byte;
    const int file = open(path, O_RDONLY);
    return file >= 0 && read(file, &byte, 1) == 1;
}

static void child_reads(void)
{
    const char *const given[] = {"/usr", inside, "/nowhere/at/all", NULL};
    const struct jail jail = {.reads = given, .cpu_seconds = 20, .files = 32};
    HOLDS(jail_enter(&jail));
    HOLDS(reads(inside) && !reads(outside) && errno == EACCES);
    HOLDS(!reads("/etc/passwd") && !reads("/proc/self/status"));
    HOLDS(open(inside, O_WRONLY) < 0 && open(inside, O_RDONLY | O_TRUNC) < 0);
    HOLDS(open(inside, O_RDWR | O_APPEND) < 0 && truncate(inside, 0) < 0);
    HOLDS(open(folder, O_RDONLY | O_DIRECTORY) < 0);
    HOLDS(chmod(inside, 0) < 0 && unlink(inside) < 0 && rename(inside, outside) < 0);
    HOLDS(link(inside, "/tmp/lutetia-test-jail-link") < 0 && mkdir("/tmp/x", 0700) < 0);
    HOLDS(socket(AF_UNIX, SOCK_STREAM, 0) < 0 && socket(AF_INET, SOCK_DGRAM, 0) < 0);
    HOLDS(kill(getppid(), 0) < 0 && fork() < 0 && setsid() < 0);
    HOLDS(ioctl(0, TIOCSTI, "x") < 0 && errno == EPERM);
    HOLDS(setpriority(PRIO_PROCESS, (id_t)getppid(), 5) < 0);
    HOLDS(access(inside, F_OK) == 0); /* its name is no secret */
    _exit(0);
}

static void child_writes(void)
{
    const char *const given[] = {"/usr", "/lib", "/lib64", "/bin", NULL};
    const struct jail jail = {.reads = given,
                              .writes = folder,
                              .starts = true,
                              .cpu_seconds = 20,
                              .file_bytes = 1000,
                              .files = 32};
    HOLDS(chdir(folder) == 0 && jail_enter(&jail));
    HOLDS(open("new", O_CREAT | O_RDWR | O_EXCL, 0600) >= 0 && rename("new", "newer") == 0);
    HOLDS(system("/bin/echo text > echoed; read x < echoed; test \"$x\" = text") == 0);
    HOLDS(!reads(outside) && open(outside, O_WRONLY) < 0);
    HOLDS(rename("newer", outside) < 0 && link(outside, "linked") < 0);
    HOLDS(open("/tmp/lutetia-test-jail-new", O_CREAT | O_RDWR, 0600) < 0);
    HOLDS(system("exec /bin/cat /etc/passwd > copied 2>&1") != 0);
    HOLDS(socket(AF_UNIX, SOCK_STREAM, 0) < 0 && kill(getppid(), 0) < 0);
    HOLDS(signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
    const int file = open("newer", O_RDWR);
    HOLDS(lseek(file, 1000, SEEK_SET) == 1000 && write(file, "x", 1) < 0 && errno == EFBIG);
    HOLDS(unlink("newer") == 0 && unlink("echoed") == 0);
    _exit(0);
}

static void run(void (*child)(void))
{
    int status;
    const pid_t process = fork();
    if (process == 0)
        child();
    assert_int_equal(waitpid(process, &status, 0), process);
    if (!WIFEXITED(status) || WEXITSTATUS(status))
        fail_msg("the claim of line %d (mod 120) does not hold (status %x)",
                 WEXITSTATUS(status) - 1, status);
}

static void it_reads_what_it_was_given(void **state)
{
    (void)state;
    run(child_reads);
}

static void it_writes_into_its_folder(void **state)
{
    (void)state;
    run(child_writes);
}

static int begin(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(inside, sizeof inside, "%s/inside", folder);
    snprintf(outside, sizeof outside, "%s-outside", folder);
    file_make(inside);
    file_make(outside);
    return 0;
}

static int end(void **state)
{
    char copied[100];
    (void)state;
    snprintf(copied, sizeof copied, "%s/copied", folder);
    unlink(copied);
    unlink(inside);
    unlink(outside);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_reads_what_it_was_given),
        cmocka_unit_test(it_writes_into_its_folder),
    };
    if (!jail_possible()) {
        print_message("this kernel has no Landlock\n");
        return 77;
    }
    return cmocka_run_group_tests(tests, begin, end);
}
