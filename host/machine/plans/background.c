/* background.c - has a separate process compile better kernels while the present ones run.
 *
 *     machine                                       lutetia-compiler, a process (compiler.c)
 *     want, want, begin
 *     ... kernels run ...
 *     take: it is still wanted; start ------------>
 *     take: ask <---------------------------------- ready
 *     ... kernels run ...                           builds one, starts it: it is in PoCL's
 *                                                   cache on disk
 *     take: load it <------------------------------ done, and the next
 *     take: load that, and use them <-------------- done
 *
 * Building a program in PoCL makes only LLVM's bitcode. The longer part, compiling it, happens
 * when a kernel is first started, under a lock of the process that every start needs; separate
 * queues, contexts or threads do not help. A kernel that another process left in PoCL's cache
 * is loaded in some 20 milliseconds.
 *
 * Nothing here blocks, and the program can end at any time. What the process has compiled is
 * loaded between two evaluations, or by a thread (loading.h). The process is not a child of the
 * program, because a program may wait for all of its children. It ends when the program does.
 * If the process fails, the machine compiles from then on, while the program waits.
 */
#include "plans/background.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arrays.h"
#include "base/process.h"
#include "device/disk_cache.h"
#include "plans/compiler.h"
#include "plans/loading.h"
#include "plans/plans.h"
#include "program.h"
#include "sequencers/sequencers.h"

/* START_AFTER_S: a program that ends sooner after its first request starts no process.
 * HANGS_S: a process that is silent for so long is given up. */
static const double START_AFTER_S = 0.2, HANGS_S = 120, LOOK_EVERY_S = 1e-3;

extern char **environ;

struct item {
    char *text, *options, *name, *arguments;
    char *mark; /* NULL: whether the driver has the kernel is not kept on disk */
    const char *parts[DEVICE_PARTS];
    uint32_t dimensions, group;
    uint64_t widest;
    bool compiled;                /* the driver has it */
    struct device_kernel *kernel; /* held; NULL: not loaded yet */
};

struct background {
    struct item *items;
    int count, capacity;
    int asked;  /* the first request that is not compiled */
    bool begun; /* this batch */
    bool lost;  /* for good */
    pid_t owner;
    char path[PATH_MAX]; /* of the compiler */

    struct loading loading;
    double loading_s; /* when that began */

    int socket;     /* -1: there is no process */
    pid_t child;    /* the child that starts the process; 0: it has ended */
    bool ready;     /* the process can be asked */
    bool idled;     /* ... nothing of this batch is done, and it may have ended before */
    bool warming;   /* the next answer is not of this batch */
    char *requests; /* requests still to be sent */
    size_t requests_bytes, requests_sent;
    double wanted_s, looked_s, heard_s; /* times: of the first request, of the last check, of
                                         * the last answer */
};

/* ---- the process ---- */

static bool compiler_find(char path[PATH_MAX])
{
    const char *said = secure_getenv("LUTETIA_COMPILER");
    if (said) {
        snprintf(path, PATH_MAX, "%s", said);
        return *said != '\0'; /* the user's own choice */
    }
    return program_find(path, (program_code *)background_finish,
                        LUTETIA_LIBEXECDIR "/lutetia/lutetia-compiler",
                        "host/machine/lutetia-compiler");
}

/* The child that starts the process exits at once; the program may have reaped it itself. */
static void child_reap(struct background *b, bool kill_it)
{
    if (!b->child || b->owner != process_now())
        return;
    pid_t ended = waitpid(b->child, NULL, WNOHANG);
    if (!ended && kill_it) { /* the child exists, and is ours */
        kill(b->child, SIGKILL);
        while (waitpid(b->child, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    if (ended || kill_it)
        b->child = 0;
}

static void compiler_end(struct background *b)
{
    if (b->socket >= 0) {
        if (b->owner == process_now()) /* a child of a fork may have it, too */
            shutdown(b->socket, SHUT_RDWR);
        close(b->socket);
    }
    child_reap(b, true);
    b->socket = -1;
    b->ready = b->idled = b->warming = false;
    b->requests_sent = 0;
}

static pid_t compiler_spawn(const char *path, int end)
{
    char owner[24], *arguments[3] = {(char *)(uintptr_t)path, owner, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, usual;
    pid_t process = 0;
    snprintf(owner, sizeof owner, "%d", (int)process_now());
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGCHLD); /* the process has children of its own: linkers */
    sigaddset(&usual, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&how);
    int error = posix_spawn_file_actions_adddup2(&files, end, STDIN_FILENO);
    error |= posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    error |= posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    error |= posix_spawnattr_setsigmask(&how, &none);
    error |= posix_spawnattr_setsigdefault(&how, &usual);
    error |= posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                POSIX_SPAWN_SETSID);
    if (error || posix_spawn(&process, path, &files, &how, arguments, environ))
        process = 0;
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return process;
}

static bool compiler_start(struct background *b)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
        return false;
    b->child = compiler_spawn(b->path, ends[1]);
    close(ends[1]);
    b->socket = fcntl(ends[0], F_DUPFD_CLOEXEC, STDERR_FILENO + 1); /* no standard stream */
    close(ends[0]);
    b->heard_s = clock_s();
    return b->child > 0 && b->socket >= 0;
}

/* Sends as much as the socket takes now. False: the process has ended. */
static bool requests_send(struct background *b)
{
    while (b->requests_sent < b->requests_bytes) {
        ssize_t n = send(b->socket, b->requests + b->requests_sent,
                         b->requests_bytes - b->requests_sent, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n < 0)
            return errno == EAGAIN || errno == EINTR;
        b->requests_sent += (size_t)n;
    }
    return true;
}

static void item_is_compiled(struct machine *m, struct background *b, double now)
{
    struct item *item = &b->items[b->asked];
    item->compiled = true;
    if (item->mark)
        cache_mark_write(m->device, item->mark);
    if (m->watch)
        watch_background(m, "build", b->heard_s, now, item->options);
    while (b->asked < b->count && b->items[b->asked].compiled)
        b->asked++;
    b->heard_s = now;
    b->idled = false;
}

/* Reads the answers. False: the process has ended, or its answer is malformed. */
static bool answers_take(struct machine *m, struct background *b, double now)
{
    char answers[16];
    ssize_t n = recv(b->socket, answers, sizeof answers, MSG_DONTWAIT);
    if (n < 0)
        return errno == EAGAIN || errno == EINTR;
    for (ssize_t i = 0; i < n; i++)
        if (!b->ready && answers[i] == COMPILER_READY) {
            b->ready = true;
            b->heard_s = now;
        } else if (b->ready && b->warming) {
            b->warming = false;
            b->heard_s = now;
        } else if (b->ready && answers[i] == COMPILER_DONE && b->asked < b->count) {
            item_is_compiled(m, b, now);
        } else {
            return false;
        }
    return n > 0;
}

/* False: there is no process that does its work. */
static bool compiler_attend(struct machine *m, struct background *b, double now)
{
    child_reap(b, false);
    if (b->asked == b->count)
        return true;
    if (b->socket < 0)
        return now - b->wanted_s < START_AFTER_S || compiler_start(b);
    if (answers_take(m, b, now) && (!b->ready || requests_send(b)))
        return now - b->heard_s < HANGS_S;
    /* a process that was idle for a while ends by itself */
    bool idled = b->idled;
    compiler_end(b);
    return idled && compiler_start(b);
}

/* ---- the decision ---- */

static bool driver_keeps(const struct device *d)
{
    const char *cache = getenv("POCL_KERNEL_CACHE");
    return d->is_pocl && !d->keeps_programs && !(cache && !strcmp(cache, "0"));
}

static struct background *background_of(struct machine *m)
{
    struct background *b = m->plans->background;
    if (!b && (b = m->plans->background = calloc(1, sizeof *b))) {
        b->owner = process_now();
        b->socket = -1;
        b->lost = !driver_keeps(m->device) || !compiler_find(b->path);
    }
    return b;
}

bool background_on(struct machine *m)
{
    if (!m->settings.background || !m->settings.box_after || m->settings.eager ||
        !device_is_ours(m->device))
        return false;
    struct background *b = background_of(m);
    return b && !b->lost && b->owner == process_now();
}

bool background_busy(const struct machine *m)
{
    bool busy = m->plans->background && m->plans->background->begun;
    for (int i = 0; m->sequencers && i < m->sequencers->machines_count && !busy; i++)
        busy = background_busy(m->sequencers->machines[i]);
    return busy;
}

/* ---- batches ---- */

static void item_free(struct item *item)
{
    free(item->text);
    free(item->options);
    free(item->name);
    free(item->arguments);
    free(item->mark);
    device_kernel_let_go(item->kernel);
}

void background_drop(struct machine *m)
{
    struct background *b = m->plans->background;
    if (!b)
        return;
    if (b->begun && b->asked < b->count)
        compiler_end(b); /* it is compiling a kernel that is no longer wanted */
    b->idled = b->socket >= 0;
    for (int i = 0; i < b->count; i++)
        item_free(&b->items[i]);
    free(b->requests);
    b->requests = NULL;
    b->requests_bytes = b->requests_sent = 0;
    b->count = b->asked = 0;
    b->begun = false;
}

/* PoCL compiles a kernel once for starts that have fewer work-items along each dimension, and
 * once for all others. */
enum { WIDE_FROM = UINT16_MAX };

/* The name of a mark, by the driver's cache and for which starts the kernel is. */
static char *mark_of(const struct machine *m, const struct background_wish *wish)
{
    const char *folder = getenv("POCL_CACHE_DIR");
    char *key = cache_key(m->device, wish->parts, wish->options, wish->name);
    size_t size = key ? strlen(key) + strlen(folder ? folder : "") + 40 : 0;
    char *mark = key ? malloc(size) : NULL;
    if (mark)
        snprintf(mark, size, "%s\n%s\n%u\n%s", folder ? folder : "",
                 wish->widest < WIDE_FROM ? "narrow" : "wide", wish->group, key);
    free(key);
    return mark;
}

int background_want(struct machine *m, const struct background_wish *wish)
{
    struct background *b = background_of(m);
    bool failed = !b;
    if (!failed && b->count == b->capacity)
        b->items = array_more(b->items, &b->capacity, sizeof *b->items, &failed);
    if (failed)
        return -1;
    struct item *item = &b->items[b->count];
    *item = (struct item){.text = strdup(wish->parts[DEVICE_PARTS - 1]),
                          .options = strdup(wish->options),
                          .name = strdup(wish->name),
                          .arguments = strdup(wish->arguments),
                          .dimensions = wish->dimensions,
                          .group = wish->group ? wish->group : 1,
                          .widest = wish->widest};
    memcpy(item->parts, wish->parts, sizeof item->parts);
    item->parts[DEVICE_PARTS - 1] = item->text;
    if (!item->text || !item->options || !item->name || !item->arguments) {
        item_free(item);
        return -1;
    }
    if (device_kernel_at_hand(m, wish->parts, wish->options, wish->name))
        item->kernel = device_kernel(m, wish->parts, wish->options, wish->name);
    else if (m->settings.keep)
        item->mark = mark_of(m, wish);
    device_kernel_hold(item->kernel);
    item->compiled = item->kernel || (item->mark && cache_mark_is_there(m->device, item->mark));
    return b->count++;
}

/* With text NULL, returns only the length. */
static size_t request_write(char *out, const struct device *d, const struct item *item,
                            const char *text)
{
    char options[DEVICE_OPTIONS_BYTES];
    device_options(d, item->options, false, options);
    const char *strings[COMPILER_STRINGS] = {
        [COMPILER_PLATFORM] = d->platform_name, [COMPILER_DEVICE] = d->name,
        [COMPILER_OPTIONS] = options,           [COMPILER_NAME] = item->name,
        [COMPILER_ARGUMENTS] = item->arguments, [COMPILER_TEXT] = text};
    struct compiler_request request = {
        .dimensions = item->dimensions, .group = item->group, .widest = item->widest};
    size_t bytes = sizeof request;
    for (int i = 0; i < COMPILER_STRINGS; i++) {
        request.bytes[i] = (uint32_t)strlen(strings[i]) + 1;
        if (out)
            memcpy(out + bytes, strings[i], request.bytes[i]);
        bytes += request.bytes[i];
    }
    if (out)
        memcpy(out, &request, sizeof request);
    return bytes;
}

static bool requests_add(struct background *b, const struct device *d, const struct item *item)
{
    char *text = device_text_without_header(item->parts), *more = NULL;
    if (text)
        more = realloc(b->requests, b->requests_bytes + request_write(NULL, d, item, text));
    if (more) {
        b->requests = more;
        b->requests_bytes += request_write(more + b->requests_bytes, d, item, text);
    }
    free(text);
    return more != NULL;
}

void background_foresee(struct machine *m, const struct background_wish *wish)
{
    if (!background_on(m) || !m->settings.keep ||
        (m->front ? m->front : m)->device->units < 2) /* there is no processor to spare */
        return;
    struct background *b = m->plans->background;
    child_reap(b, false);
    if (b->begun || b->socket >= 0)
        return;
    char *mark = mark_of(m, wish), text[100], *request = NULL;
    if (!mark || cache_mark_is_there(m->device, mark))
        goto done;
    cache_mark_write(m->device, mark);
    /* a kernel that PoCL does not have in its cache */
    snprintf(text, sizeof text, "kernel void k(global int *a) {} /* %016llx */",
             (unsigned long long)cache_hash(CACHE_HASH_BEGIN, mark));
    const struct item item = {
        .options = "", .name = "k", .arguments = "m", .dimensions = 2, .widest = 1};
    size_t bytes = request_write(NULL, m->device, &item, text);
    if ((request = malloc(bytes)) && compiler_start(b)) {
        request_write(request, m->device, &item, text);
        b->warming = send(b->socket, request, bytes, MSG_NOSIGNAL | MSG_DONTWAIT) ==
                     (ssize_t)bytes; /* it is little, and the first */
        b->idled = true;
        b->lost = !b->warming;
    }
done:
    free(request);
    free(mark);
}

bool background_has_all(const struct machine *m)
{
    const struct background *b = m->plans->background;
    bool all = b != NULL;
    for (int i = 0; all && i < b->count; i++)
        all = b->items[i].compiled;
    return all;
}

bool background_begin(struct machine *m)
{
    struct background *b = m->plans->background;
    bool good = b != NULL;
    for (int i = 0; good && i < b->count; i++)
        good = b->items[i].compiled || requests_add(b, m->device, &b->items[i]);
    if (!good) {
        background_drop(m);
        return false;
    }
    b->begun = true;
    while (b->asked < b->count && b->items[b->asked].compiled)
        b->asked++;
    b->heard_s = clock_s();
    if (b->asked < b->count && b->wanted_s <= 0)
        b->wanted_s = b->heard_s;
    return true;
}

static enum background_state background_lose(struct background *b)
{
    compiler_end(b);
    b->lost = true;
    return BACKGROUND_LOST;
}

/* One kernel that the driver has. False: that is impossible. */
static bool item_load(struct machine *m, struct background *b, struct item *item)
{
    struct loading *l = &b->loading;
    const char *const *parts = item->parts;
    uint64_t built = m->device->kernels_built;
    cl_program program = NULL;
    if (loading_is_on(l) && !loading_is_done(l))
        return true;
    if (loading_is_of(l, item->text, item->options)) {
        program = loading_take(l);
        if (m->watch)
            watch_background(m, "load", b->loading_s, clock_s(), item->options);
    } else {
        loading_drop(l); /* of a batch before */
        b->loading_s = clock_s();
        if (strlen(item->text) >= m->device->shape.load_aside_bytes &&
            !device_kernel_at_hand(m, parts, item->options, item->name) &&
            loading_begin(l, m->device, parts, item->options))
            return true;
    }
    item->kernel = program ? device_program_take(m, program, parts, item->options, item->name)
                           : device_kernel(m, parts, item->options, item->name);
    device_kernel_hold(item->kernel);
    m->device->kernels_built_background += m->device->kernels_built - built;
    return item->kernel != NULL;
}

enum background_state background_take(struct machine *m)
{
    struct background *b = m->plans->background;
    double now = clock_s();
    bool waits = false, loaded = false;
    if (now - b->looked_s < LOOK_EVERY_S)
        return BACKGROUND_WAITS;
    if (b->lost || b->owner != process_now() || !compiler_attend(m, b, now))
        return background_lose(b);
    for (int i = 0; i < b->count; i++) {
        struct item *item = &b->items[i];
        if (item->kernel)
            continue;
        waits |= !item->compiled || loaded;
        if (!item->compiled || loaded)
            continue;
        if (!item_load(m, b, item))
            return background_lose(b);
        loaded = true;
        waits |= !item->kernel;
    }
    b->looked_s = clock_s();
    return waits ? BACKGROUND_WAITS : BACKGROUND_LOADED;
}

struct device_kernel *background_kernel(const struct machine *m, int number)
{
    return m->plans->background->items[number].kernel;
}

void background_rest(struct machine *m)
{
    if (m->plans->background)
        loading_wait(&m->plans->background->loading);
}

void background_leave(struct machine *m)
{
    if (m->plans->background)
        loading_drop(&m->plans->background->loading);
}

void background_finish(struct machine *m)
{
    struct background *b = m->plans->background;
    if (!b)
        return;
    background_drop(m);
    loading_drop(&b->loading);
    compiler_end(b);
    free(b->items);
    free(b);
    m->plans->background = NULL;
}
