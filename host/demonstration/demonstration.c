/* demonstration.c - starts the process of a demonstration, asks it for pictures, checks what
 * comes: see demonstration.h. */
#include "demonstration.h"

#include <program.h>

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { HEARD_MAX = 64 };

struct demonstration {
    struct demonstration_def def;
    pid_t process; /* 0: none, or it was waited for */
    int socket;
    struct demonstration_memory *memory;
    size_t memory_bytes;
    uint8_t *picture;
    long pictures;
    uint32_t asked; /* the number of the picture that is asked for */
    bool waits;
    double asked_s, later_s; /* later_s: what is to be added */
    struct demonstration_message heard[HEARD_MAX];
    int heard_count;
    struct demonstration_control controls[DEMONSTRATION_CONTROLS_MAX];
    int controls_count;
    char printed[DEMONSTRATION_LINES][DEMONSTRATION_TEXT_MAX + 1];
    long lines; /* that have come */
    char said[DEMONSTRATION_TEXT_MAX + 1], ended[DEMONSTRATION_TEXT_MAX + 100];
};

static _Thread_local char error[400];

const char *demonstration_error(void)
{
    return error;
}

__attribute__((format(printf, 1, 2))) static bool fail(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(error, sizeof error, format, list);
    va_end(list);
    return false;
}

struct demonstration_def demonstration_def_default(const char *text, size_t bytes, int width_px,
                                                   int height_px)
{
    return (struct demonstration_def){.text = text,
                                      .bytes = bytes,
                                      .width_px = width_px,
                                      .height_px = height_px,
                                      .memory_mb = 512,
                                      .answer_s = 5,
                                      .patience_s = 120};
}

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- starting ---- */

/* The descriptors that the process gets, and ours. -1: none. */
struct ends {
    int ours, theirs, script, memory;
};

static void ends_close(const struct ends *ends)
{
    const int all[] = {ends->theirs, ends->script, ends->memory};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] >= 0)
            close(all[i]);
}

/* A descriptor that is none of those that the process has them at. */
static int moved(int descriptor)
{
    enum { BEYOND = 10 };
    const int to = descriptor < 0 ? -1 : fcntl(descriptor, F_DUPFD_CLOEXEC, BEYOND);
    if (descriptor >= 0)
        close(descriptor);
    return to;
}

/* The script's text. */
static int script_make(const struct demonstration_def *def)
{
    const int file = moved(memfd_create("demonstration", MFD_CLOEXEC));
    size_t at = 0;
    while (file >= 0 && at < def->bytes) {
        const ssize_t written = write(file, def->text + at, def->bytes - at);
        if (written <= 0)
            break;
        at += (size_t)written;
    }
    if (file >= 0 && (at < def->bytes || lseek(file, 0, SEEK_SET) != 0)) {
        close(file);
        return -1;
    }
    return file;
}

/* The pictures. Nobody can make them smaller, so that looking at them is safe. */
static int memory_make(struct demonstration *d)
{
    const int file = moved(memfd_create("pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    d->memory_bytes = demonstration_memory_bytes(d->def.width_px, d->def.height_px);
    if (file < 0 || ftruncate(file, (off_t)d->memory_bytes) != 0 ||
        fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
        if (file >= 0)
            close(file);
        return -1;
    }
    void *memory = mmap(NULL, d->memory_bytes, PROT_READ, MAP_SHARED, file, 0);
    d->memory = memory == MAP_FAILED ? NULL : memory;
    return file;
}

static bool ends_make(struct demonstration *d, struct ends *ends)
{
    int pair[2] = {-1, -1};
    *ends = (struct ends){-1, -1, -1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) == 0) {
        d->socket = moved(pair[0]);
        ends->theirs = moved(pair[1]);
    }
    ends->script = script_make(&d->def);
    ends->memory = memory_make(d);
    d->picture = malloc(demonstration_picture_bytes(d->def.width_px, d->def.height_px));
    return d->socket >= 0 && ends->theirs >= 0 && ends->script >= 0 && ends->memory >= 0 &&
           d->memory && d->picture;
}

/* The process in a session of its own, so that it ends with all that it has started. */
static bool process_start(struct demonstration *d, const char *path, const struct ends *ends)
{
    char words[5][24];
    char *arguments[7] = {(char *)(uintptr_t)path};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, usual;
    const int numbers[4] = {(int)getpid(), d->def.width_px, d->def.height_px, d->def.memory_mb};
    for (int i = 0; i < 4; i++)
        snprintf(words[i], sizeof words[0], "%d", numbers[i]);
    snprintf(words[4], sizeof words[0], "%.17g", d->def.answer_s);
    for (int i = 0; i < 5; i++)
        arguments[i + 1] = words[i];
    sigemptyset(&none);
    sigfillset(&usual);
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&how);
    int wrong = posix_spawn_file_actions_adddup2(&files, ends->script, STDIN_FILENO);
    wrong |= posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    wrong |= posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    wrong |= posix_spawn_file_actions_adddup2(&files, ends->theirs, DEMONSTRATION_SOCKET);
    wrong |= posix_spawn_file_actions_adddup2(&files, ends->memory, DEMONSTRATION_PICTURES);
    wrong |= posix_spawnattr_setsigmask(&how, &none);
    wrong |= posix_spawnattr_setsigdefault(&how, &usual);
    wrong |= posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                POSIX_SPAWN_SETSID);
    if (!wrong)
        wrong = posix_spawn(&d->process, path, &files, &how, arguments, environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    if (!wrong)
        return true;
    d->process = 0;
    return fail("the demonstration's process cannot be started: %s", strerror(wrong));
}

static void here(void)
{
}

static bool process_find(char path[PATH_MAX], bool program)
{
    return program
               ? program_find(path, here,
                              LUTETIA_LIBEXECDIR "/lutetia/lutetia-demonstration-paris",
                              "host/demonstration/paris/lutetia-demonstration-paris")
               : program_find(path, here, LUTETIA_LIBEXECDIR "/lutetia/lutetia-demonstration",
                              "host/demonstration/lutetia-demonstration");
}

bool demonstration_start(const struct demonstration_def *def, struct demonstration **out)
{
    char path[PATH_MAX];
    struct ends ends;
    const int least = DEMONSTRATION_SIDE_MIN, most = DEMONSTRATION_SIDE_MAX;
    *out = NULL;
    if (def->width_px < least || def->width_px > most || def->height_px < least ||
        def->height_px > most)
        return fail("a demonstration's sides are %d..%d pixels (got %dx%d)", least, most,
                    def->width_px, def->height_px);
    if (def->bytes > DEMONSTRATION_SCRIPT_MAX)
        return fail("a demonstration has up to %d KB (this one has %zu)",
                    DEMONSTRATION_SCRIPT_MAX >> 10, def->bytes >> 10);
    if (!process_find(path, def->program))
        return fail("%s is not installed",
                    def->program ? "lutetia-demonstration-paris" : "lutetia-demonstration");
    struct demonstration *d = calloc(1, sizeof *d);
    if (!d)
        return fail("no memory for a demonstration");
    d->def = *def;
    d->socket = -1;
    bool good = ends_make(d, &ends);
    if (!good)
        fail("no memory for a demonstration's pictures: %s", strerror(errno));
    good = good && process_start(d, path, &ends);
    ends_close(&ends);
    d->def.text = NULL;
    if (good)
        *out = d;
    else
        demonstration_stop(d);
    return good;
}

/* ---- ending ---- */

/* Its status; it was closed on our side or by itself, so it ends by itself, or is ended. */
static int process_reap(struct demonstration *d, bool at_once)
{
    enum { LOOKS = 100 };
    const struct timespec short_while = {0, 10000000};
    int status = 0;
    for (int i = 0; i < LOOKS && !at_once; i++) {
        const pid_t ended = waitpid(d->process, &status, WNOHANG);
        if (ended == d->process) {
            d->process = 0;
            return status;
        }
        nanosleep(&short_while, NULL);
    }
    kill(-d->process, SIGKILL); /* and what it has started; if it has no session yet: */
    kill(d->process, SIGKILL);
    while (waitpid(d->process, &status, 0) < 0 && errno == EINTR)
        ;
    d->process = 0;
    return status;
}

/* It does not run any more; the first reason counts. */
__attribute__((format(printf, 3, 4))) static void end(struct demonstration *d, bool at_once,
                                                      const char *format, ...)
{
    va_list list;
    if (!d->process)
        return;
    const int status = process_reap(d, at_once);
    d->waits = false;
    if (d->ended[0])
        return;
    if (format) {
        va_start(list, format);
        vsnprintf(d->ended, sizeof d->ended, format, list);
        va_end(list);
    } else if (WIFSIGNALED(status)) {
        snprintf(d->ended, sizeof d->ended, "its process was ended by a signal: %s",
                 strsignal(WTERMSIG(status)));
    } else {
        snprintf(d->ended, sizeof d->ended, "its process ended with status %d",
                 WEXITSTATUS(status));
    }
}

void demonstration_stop(struct demonstration *d)
{
    if (!d)
        return;
    if (d->socket >= 0)
        close(d->socket);
    if (d->process) /* a program's keeper removes its folder when the socket is closed */
        process_reap(d, !d->def.program);
    if (d->memory)
        munmap(d->memory, d->memory_bytes);
    free(d->picture);
    free(d);
}

const char *demonstration_ended(const struct demonstration *d)
{
    return d->process ? NULL : d->ended;
}

/* ---- asking ---- */

static bool message_send(struct demonstration *d, const struct demonstration_message *m)
{
    uint8_t packet[DEMONSTRATION_PACKET_MAX];
    const size_t bytes = demonstration_message_write(m, packet);
    return send(d->socket, packet, bytes, MSG_NOSIGNAL | MSG_DONTWAIT) == (ssize_t)bytes;
}

void demonstration_frame(struct demonstration *d, double seconds)
{
    const double least_s = 1e-4, most_s = 0.1;
    d->later_s += seconds > 0 ? seconds : 0;
    const bool steps = d->later_s >= least_s;
    if (!d->process)
        return;
    if (d->waits) {
        if (now_s() - d->asked_s > d->def.patience_s)
            end(d, true, "it has not answered for %g seconds", d->def.patience_s);
        return;
    }
    struct demonstration_message frame = {.kind = DEMONSTRATION_FRAME,
                                          .number = ++d->asked ? d->asked : ++d->asked,
                                          .seconds = steps ? fmin(d->later_s, most_s) : 0};
    if (steps)
        d->later_s = 0;
    d->asked_s = now_s();
    d->waits = true;
    /* What cannot be sent is seen by who reads: the process has ended. */
    for (int i = 0; i < d->heard_count; i++)
        message_send(d, &d->heard[i]);
    d->heard_count = 0;
    message_send(d, &frame);
}

static void hear(struct demonstration *d, const struct demonstration_message *m)
{
    struct demonstration_message *last = d->heard_count ? &d->heard[d->heard_count - 1] : NULL;
    const bool move = (m->kind == DEMONSTRATION_POINTER && m->which == DEMONSTRATION_MOVE) ||
                      m->kind == DEMONSTRATION_SET;
    if (last && move && last->kind == m->kind && last->which == m->which && d->waits)
        *last = *m;
    else if (d->heard_count < HEARD_MAX)
        d->heard[d->heard_count++] = *m;
    else if (move && last->kind == m->kind && last->which == m->which)
        *last = *m;
}

static double within(double value, double low, double high)
{
    return value >= low ? value <= high ? value : high : low;
}

void demonstration_pointer(struct demonstration *d, enum demonstration_pointer what, double x,
                           double y, double pressure)
{
    const double far = 1e5;
    hear(d, &(struct demonstration_message){.kind = DEMONSTRATION_POINTER,
                                            .which = (int)what,
                                            .x = within(x, -far, far),
                                            .y = within(y, -far, far),
                                            .pressure = within(pressure, 0, 1)});
}

void demonstration_key(struct demonstration *d, bool down, const char *name)
{
    struct demonstration_message m = {.kind = down ? DEMONSTRATION_KEY : DEMONSTRATION_RELEASE};
    snprintf(m.text, DEMONSTRATION_KEY_MAX + 1, "%s", name);
    hear(d, &m);
}

void demonstration_set(struct demonstration *d, int control, double value)
{
    if (control < 0 || control >= d->controls_count)
        return;
    struct demonstration_control *c = &d->controls[control];
    c->value = within(value, c->least, c->most);
    hear(d, &(struct demonstration_message){
                .kind = DEMONSTRATION_SET, .which = control, .value = c->value});
}

/* ---- taking ---- */

/* Copies a picture. False: it was written meanwhile. */
static bool picture_copy(struct demonstration *d, int which)
{
    const size_t bytes = demonstration_picture_bytes(d->def.width_px, d->def.height_px);
    const uint8_t *from = (const uint8_t *)(d->memory + 1) + (size_t)which * bytes;
    if (atomic_load(&d->memory->number[which]) != d->asked)
        return false;
    memcpy(d->picture, from, bytes);
    atomic_thread_fence(memory_order_acquire);
    return atomic_load(&d->memory->number[which]) == d->asked;
}

/* True: there is another picture. */
static bool message_take(struct demonstration *d, const struct demonstration_message *m)
{
    if (m->kind == DEMONSTRATION_SAID) {
        strcpy(d->said, m->text);
    } else if (m->kind == DEMONSTRATION_FAILED) {
        snprintf(d->ended, sizeof d->ended, "%s", m->text[0] ? m->text : "it failed");
    } else if (m->kind == DEMONSTRATION_LINE) {
        strcpy(d->printed[d->lines++ % DEMONSTRATION_LINES], m->text);
    } else if (m->kind == DEMONSTRATION_CONTROL) {
        d->controls[d->controls_count++] = m->control;
    } else if (m->kind == DEMONSTRATION_SHOWN && d->waits && m->number == d->asked) {
        d->waits = false;
        if (picture_copy(d, m->which)) {
            d->pictures++;
            return true;
        }
    }
    return false;
}

bool demonstration_take(struct demonstration *d)
{
    enum { MESSAGES_AT_ONCE = 64 };
    uint8_t packet[DEMONSTRATION_PACKET_MAX + 1];
    struct demonstration_message m;
    bool another = false;
    for (int i = 0; i < MESSAGES_AT_ONCE && d->process; i++) {
        const ssize_t bytes = recv(d->socket, packet, sizeof packet, MSG_DONTWAIT);
        if (bytes < 0 && errno == ECONNRESET) /* it has ended and left what it was sent; what it
                                               * has said comes behind this */
            continue;
        if (bytes < 0 && (errno == EAGAIN || errno == EINTR))
            break;
        if (bytes <= 0)
            end(d, false, NULL);
        else if (!demonstration_message_read(packet, (size_t)bytes, false, &m) ||
                 (m.kind == DEMONSTRATION_CONTROL && m.which != d->controls_count))
            end(d, true, "its process has said what is no message");
        else
            another = message_take(d, &m) || another;
    }
    return another;
}

bool demonstration_waits(const struct demonstration *d)
{
    return d->waits;
}

const uint8_t *demonstration_picture(const struct demonstration *d)
{
    return d->pictures ? d->picture : NULL;
}

long demonstration_pictures(const struct demonstration *d)
{
    return d->pictures;
}

const char *demonstration_said(const struct demonstration *d)
{
    return d->said;
}

const char *demonstration_line(const struct demonstration *d, int line)
{
    const long first = d->lines > DEMONSTRATION_LINES ? d->lines - DEMONSTRATION_LINES : 0;
    return line >= 0 && first + line < d->lines
               ? d->printed[(first + line) % DEMONSTRATION_LINES]
               : NULL;
}

long demonstration_lines(const struct demonstration *d)
{
    return d->lines;
}

const struct demonstration_control *demonstration_control(const struct demonstration *d,
                                                          int control)
{
    return control >= 0 && control < d->controls_count ? &d->controls[control] : NULL;
}
