/* test_confine.c - a confined process reads and writes its open files, and can do nothing else.
 * (security.md 8) */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../skip.h"

#include <confine.h>

enum { SKIPPED = 77 };

/* Ends the child with the line number of a claim that does not hold as its status. */
#define HOLDS(claim)                                                                           \
    do {                                                                                       \
        if (!(claim))                                                                          \
            _exit(__LINE__ % 70 + 1);                                                          \
    } while (0)

static void child_confined(pid_t parent)
{
    char byte, *memory;
    int file = open("/proc/self/exe", O_RDONLY);
    confine_resources(parent, 10, 1 << 30);
    HOLDS(file >= 0);
    if (!confine_calls())
        _exit(SKIPPED);
    HOLDS(read(file, &byte, 1) == 1 && pread(file, &byte, 1, 1) == 1 && byte == 'E');
    HOLDS(lseek(file, 0, SEEK_END) > 0);
    memory = malloc(1 << 24);
    HOLDS(memory != NULL);
    memset(memory, 1, 1 << 24);
    free(memory);
    HOLDS(open("/etc/passwd", O_RDONLY) < 0 && errno == EPERM);
    HOLDS(open("/tmp/confined", O_WRONLY | O_CREAT, 0600) < 0 && errno == EPERM);
    HOLDS(socket(AF_UNIX, SOCK_STREAM, 0) < 0 && errno == EPERM);
    HOLDS(kill(parent, 0) < 0 && errno == EPERM);
    HOLDS(unlink("/tmp/confined") < 0 && errno == EPERM);
    execl("/bin/true", "true", (char *)NULL);
    HOLDS(errno == EPERM);
    HOLDS(fork() < 0 && errno == EPERM);
    _exit(0);
}

static void confined_process_can_only_read_and_write_what_is_open(void **state)
{
    (void)state;
    int status;
    pid_t parent = getpid(), child = fork();
    if (child == 0)
        child_confined(parent);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == SKIPPED)
        skip_because("this kernel has no seccomp filters");
    assert_int_equal(WEXITSTATUS(status), 0);
}

static bool is_open(int file)
{
    return fcntl(file, F_GETFD) >= 0;
}

static void other_descriptors_are_closed(void **state)
{
    (void)state;
    int status, files[8];
    for (int i = 0; i < 8; i++)
        files[i] = fcntl(open("/dev/null", O_RDONLY), F_DUPFD, 20 + 7 * i);
    const int far = fcntl(files[0], F_DUPFD, 900);
    const pid_t child = fork();
    if (child == 0) {
        confine_descriptors((int[]){files[5], files[2], -1}, 3);
        for (int i = 0; i < 8; i++)
            HOLDS(is_open(files[i]) == (i == 2 || i == 5));
        HOLDS(!is_open(far) && is_open(STDIN_FILENO) && is_open(STDERR_FILENO));
        DIR *names = opendir("/proc/self/fd");
        int count = 0;
        for (const struct dirent *e; names && (e = readdir(names));)
            count += e->d_name[0] != '.';
        HOLDS(!names || count == 6); /* with the folder's own */
        confine_descriptors(NULL, 0);
        HOLDS(!is_open(files[2]) && !is_open(files[5]) && is_open(STDOUT_FILENO));
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    for (int i = 0; i < 8; i++)
        close(files[i]);
    close(far);
}

#if !defined(__SANITIZE_ADDRESS__)
static void memory_is_limited(void **state)
{
    (void)state;
    int status;
    pid_t parent = getpid(), child = fork();
    if (child == 0) {
        confine_resources(parent, 10, 64 << 20);
        void *volatile some =
            malloc(32 << 20); /* volatile: compilers may remove unused memory */
        void *volatile more = malloc(128 << 20);
        _exit(some && !more ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}
#endif

/* A child ends when its parent is killed, and its end of a pipe closes. */
static void it_ends_with_its_parent(void **state)
{
    (void)state;
    int ends[2], ready[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(pipe(ready), 0);
    pid_t parent = fork();
    if (parent == 0) {
        pid_t self = getpid();
        if (fork() == 0) {
            confine_resources(self, 10, 0);
            (void)!write(ready[1], "x", 1);
        }
        for (;;)
            pause();
    }
    close(ends[1]);
    assert_int_equal(read(ready[0], &byte, 1), 1);
    kill(parent, SIGKILL);
    assert_int_equal(waitpid(parent, NULL, 0), parent);
    assert_int_equal(read(ends[0], &byte, 1), 0); /* waits for ever if the child lives */
    close(ends[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(confined_process_can_only_read_and_write_what_is_open),
        cmocka_unit_test(other_descriptors_are_closed),
#if !defined(__SANITIZE_ADDRESS__)
        cmocka_unit_test(memory_is_limited),
#endif
        cmocka_unit_test(it_ends_with_its_parent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
