/* server_workers.c - see server_workers.h. */
#include "server_workers.h"
#include "server_awake.h"

#include <input_file.h>

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

enum { LOOK_MS = 250, CHILDREN_BYTES = 1 << 20, PATH_BYTES = 512 };

struct server_workers {
    char proc[PATH_BYTES / 2];
    uint64_t messages, until_ns;
    _Atomic bool first, ends;
    int told; /* an eventfd: first or ends has changed */
    pthread_t thread;
    /* the thread's */
    pid_t raised[WORKERS_MAX];
    int raised_count;
};

/* The name of a process is that, or begins with it. */
static bool is_named(const char *proc, long process, const char *name, bool whole)
{
    char path[PATH_BYTES], *text;
    size_t bytes;
    snprintf(path, sizeof path, "%s/%ld/comm", proc, process);
    text = input_file_read(path, sizeof path, &bytes, NULL);
    const size_t length = strlen(name);
    const bool is = text && bytes >= length && !strncmp(text, name, length) &&
                    (!whole || (bytes == length + 1 && text[length] == '\n'));
    free(text);
    return is;
}

int workers_find(const char *proc, pid_t found[WORKERS_MAX])
{
    enum { KTHREADD = 2 }; /* the parent of all that is the kernel's */
    char path[PATH_BYTES];
    size_t bytes;
    int count = 0;
    if (!is_named(proc, KTHREADD, "kthreadd", true)) {
        errno = ENOENT;
        return -1;
    }
    snprintf(path, sizeof path, "%s/%d/task/%d/children", proc, KTHREADD, KTHREADD);
    char *text = input_file_read(path, CHILDREN_BYTES, &bytes, NULL);
    if (!text)
        return -1;
    char *at = text, *end;
    for (long child = strtol(at, &end, 10); end != at && count < WORKERS_MAX;
         child = strtol(at, &end, 10)) {
        at = end;
        if (is_named(proc, child, "kworker/u", false))
            found[count++] = (pid_t)child;
    }
    free(text);
    return count;
}

/* Those that are still workers: a process's number is used again. */
static void workers_lower(struct server_workers *w)
{
    const struct sched_param usual = {.sched_priority = 0};
    for (int i = 0; i < w->raised_count; i++)
        if (is_named(w->proc, w->raised[i], "kworker/u", false))
            sched_setscheduler(w->raised[i], SCHED_OTHER, &usual); /* keeps its niceness */
    w->raised_count = 0;
}

static void raised_keep(struct server_workers *w, pid_t worker)
{
    int kept = 0;
    for (int i = 0; i < w->raised_count; i++)
        if (w->raised[i] == worker)
            return;                       /* another one of the same number */
    if (w->raised_count == WORKERS_MAX) { /* what has ended makes room */
        for (int i = 0; i < w->raised_count; i++)
            if (is_named(w->proc, w->raised[i], "kworker/u", false))
                w->raised[kept++] = w->raised[i];
        w->raised_count = kept;
    }
    if (w->raised_count < WORKERS_MAX)
        w->raised[w->raised_count++] = worker;
}

/* False: there are none, or it is not allowed (errno). */
static bool workers_raise(struct server_workers *w)
{
    const struct sched_param first = {.sched_priority = WORKERS_PRIORITY};
    pid_t found[WORKERS_MAX];
    const int count = workers_find(w->proc, found);
    bool any = false;
    errno = count == 0 ? ENOENT : errno;
    for (int i = 0; i < count; i++) {
        const int policy = sched_getscheduler(found[i]);
        any = any || policy >= 0;
        if (policy != SCHED_OTHER)
            continue; /* it has just ended, or somebody has given it what it has */
        if (sched_setscheduler(found[i], SCHED_FIFO, &first) == 0)
            raised_keep(w, found[i]);
        else if (errno != ESRCH)
            return false;
    }
    return any;
}

static void *workers_run(void *context)
{
    struct server_workers *w = context;
    struct pollfd told = {w->told, POLLIN, 0};
    while (!w->ends) {
        uint64_t count;
        if (w->first)
            (void)workers_raise(w); /* new ones come, as work does */
        else
            workers_lower(w);
        if (poll(&told, 1, w->first ? LOOK_MS : -1) > 0 &&
            read(w->told, &count, sizeof count) < 0)
            break;
    }
    workers_lower(w);
    return NULL;
}

static void workers_tell(struct server_workers *w)
{
    const uint64_t one = 1;
    const ssize_t written = write(w->told, &one, sizeof one);
    (void)written;
}

struct server_workers *workers_create(const char *proc, const char **why)
{
    struct server_workers *w = calloc(1, sizeof *w);
    *why = "no memory";
    if (!w)
        return NULL;
    snprintf(w->proc, sizeof w->proc, "%s", proc);
    w->told = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    const bool may = w->told >= 0 && workers_raise(w);
    const int number = errno;
    workers_lower(w);
    if (may && pthread_create(&w->thread, NULL, workers_run, w) == 0)
        return w;
    *why = may                ? "no thread"
           : number == ENOENT ? "the system's workers are not seen from here"
                              : strerror(number);
    if (w->told >= 0)
        close(w->told);
    free(w);
    return NULL;
}

void workers_look(struct server_workers *w, uint64_t messages, uint64_t now_ns)
{
    if (!w)
        return;
    if (messages != w->messages) {
        w->messages = messages;
        w->until_ns = now_ns + AWAKE_MS * UINT64_C(1000000);
    }
    const bool first = now_ns < w->until_ns;
    if (first != w->first) {
        w->first = first;
        workers_tell(w);
    }
}

bool workers_first(const struct server_workers *w)
{
    return w && w->first;
}

void workers_destroy(struct server_workers *w)
{
    if (!w)
        return;
    w->ends = true;
    workers_tell(w);
    pthread_join(w->thread, NULL);
    close(w->told);
    free(w);
}
