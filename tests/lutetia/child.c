/* child.c - forks, runs the command and waits. Both outputs go to files, so that neither can
 * block. */
#include "child.h"

#include <assert.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static int file_open(void)
{
    char name[] = "/tmp/lutetia-child-XXXXXX";
    int descriptor = mkstemp(name);
    assert(descriptor >= 0);
    unlink(name);
    return descriptor;
}

static void file_take(int descriptor, char *text)
{
    ssize_t count = pread(descriptor, text, CHILD_TEXT_MAX - 1, 0);
    text[count > 0 ? count : 0] = '\0';
    close(descriptor);
}

static void become(const struct child *child, int output, int errors)
{
    int full = child->output_full ? open("/dev/full", O_WRONLY) : output;
    dup2(full, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    for (int i = 0; i < 4 && child->variables[i]; i++)
        putenv(strdup(child->variables[i]));
    if (child->file_bytes_max) {
        struct rlimit limit = {(rlim_t)child->file_bytes_max, (rlim_t)child->file_bytes_max};
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    char *arguments[CHILD_ARGUMENTS_MAX + 1] = {NULL};
    for (int i = 0; i < CHILD_ARGUMENTS_MAX && child->arguments[i]; i++)
        arguments[i] = strdup(child->arguments[i]);
    execv(arguments[0], arguments);
    _exit(127);
}

void child_run(struct child *child)
{
    int output = file_open(), errors = file_open(), status;
    pid_t pid = fork();
    assert(pid >= 0);
    if (pid == 0)
        become(child, output, errors);
    if (child->interrupt_after_ms) {
        usleep((useconds_t)child->interrupt_after_ms * 1000);
        kill(pid, SIGINT);
    }
    while (waitpid(pid, &status, 0) != pid)
        ;
    child->status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    file_take(output, child->output);
    file_take(errors, child->errors);
}

bool child_says(struct child *child, int status, const char *says, int lines)
{
    child_run(child);
    for (const char *c = child->errors; *c; c++)
        lines -= *c == '\n';
    return child->status == status && strstr(child->errors, says) && lines == 0;
}
