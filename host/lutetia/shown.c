/* shown.c - see shown.h. */
#include "shown.h"
#include "lutetia.h"

#include <input_file.h>
#include <streams.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define TURN_S 0.02 /* the longest wait for keys or pieces, when both are polled */

void shown_name(struct shown *s, const char *word)
{
    char variable[64];
    snprintf(variable, sizeof variable, "%s_PROGRAM", s->variable);
    const char *program = getenv(variable), *name = word;
    if (strcmp(word, "-") == 0) {
        char *rest = NULL;
        long pid = program ? strtol(program, &rest, 10) : 0;
        name = "standard input";
        if (pid > 1 && *rest == ' ') {
            s->watched = (pid_t)pid;
            name = rest + 1;
        }
    }
    const char *base = strrchr(name, '/');
    snprintf(s->name, sizeof s->name, "%s", base && base[1] ? base + 1 : name);
}

/* A window gives way to the program that it shows: it draws where the program waits, which
 * costs the program less than to be interrupted. */
static void give_way(void)
{
    enum { BY = 10 };
    const int now = nice(BY);
    (void)now; /* it may be refused */
}

bool shown_ready(const struct shown *s)
{
    if (s->watched)
        give_way();
    return !s->watched || write(STDOUT_FILENO, "\n", 1) == 1;
}

void shown_interrupt(const struct shown *s)
{
    if (s->watched && getppid() == s->watched)
        kill(s->watched, SIGINT);
}

/* ---- times ---- */

uint64_t shown_time_us(struct shown *s, uint64_t time_us)
{
    if (s->base_us + time_us < s->last_us) /* the next recording begins */
        s->base_us = s->last_us;
    s->last_us = s->base_us + time_us;
    return s->last_us;
}

bool shown_times_good(const struct shown *s, uint64_t until_us, double fps, int most,
                      uint64_t taken, const char *kind)
{
    const double until_s = (double)until_us * 1e-6, wanted = ceil(until_s * fps),
                 allowed = most ? most : SHOWN_ANY + SHOWN_EACH * (double)taken;
    char option[40] = "";
    if (s->seen || wanted <= allowed)
        return true;
    if (wanted <= SHOWN_PICTURES_MOST)
        snprintf(option, sizeof option, ", or --pictures %.0f", wanted);
    fail(s->verb,
         "the recording says that %s %llu came after %.4g s: %.0f pictures (%.0f are the "
         "most); take a lower --fps%s",
         kind, (unsigned long long)taken, until_s, wanted, allowed, option);
    return false;
}

/* ---- the bytes ---- */

static int go_on(struct shown *s)
{
    pthread_mutex_lock(&s->lock);
    const bool on = s->go_on(s->context);
    pthread_mutex_unlock(&s->lock);
    return on;
}

/* Feeds what was read, or the end (count 0). Returns an exit status. */
static int bytes_take(struct shown *s, const char *what, bool may_break, const uint8_t *bytes,
                      ssize_t count)
{
    if (count < 0)
        return fail(s->verb, "%s: cannot read: %s", what, strerror(errno));
    pthread_mutex_lock(&s->lock);
    const enum display_status status =
        count ? s->feed(s->context, bytes, (size_t)count) : s->end(s->context);
    pthread_mutex_unlock(&s->lock);
    if (status != DISPLAY_OK && (count || !may_break))
        return fail(s->verb, "%s: %s", what, display_error());
    return EXIT_SUCCESS;
}

/* One source, by whoever reads it. */
struct reading {
    struct shown *shown;
    int descriptor, status;
    const char *what; /* the name for messages */
    bool may_break;
    int over[2]; /* a pipe that the thread closes at its end */
    bool stop;   /* the thread is to end; under the lock */
};

static bool stopped(struct reading *r)
{
    pthread_mutex_lock(&r->shown->lock);
    const bool stop = r->stop || !r->shown->go_on(r->shown->context);
    pthread_mutex_unlock(&r->shown->lock);
    return stop;
}

static void *read_apart(void *context)
{
    struct reading *r = context;
    static uint8_t bytes[1 << 18];
    ssize_t count = 1;
    while (count && r->status == EXIT_SUCCESS && !stopped(r)) {
        struct pollfd ready = {.fd = r->descriptor, .events = POLLIN};
        if (poll(&ready, 1, 50) == 0)
            continue;
        count = read(r->descriptor, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR)
            continue;
        r->status = bytes_take(r->shown, r->what, r->may_break, bytes, count);
    }
    close(r->over[1]);
    if (r->shown->wake)
        r->shown->wake();
    return NULL;
}

static int from_thread(struct reading *r)
{
    pthread_t thread;
    if (pipe2(r->over, O_CLOEXEC) != 0)
        return fail(r->shown->verb, "no pipe: %s", strerror(errno));
    const int error = pthread_create(&thread, NULL, read_apart, r);
    if (error)
        return fail(r->shown->verb, "no thread: %s", strerror(error));
    struct pollfd over = {.fd = r->over[0], .events = POLLIN};
    while (go_on(r->shown) && poll(&over, 1, 0) == 0)
        r->shown->turn(r->shown->context, r->shown->wake ? 0.05 : 0.004);
    pthread_mutex_lock(&r->shown->lock);
    r->stop = !r->shown->go_on(r->shown->context);
    pthread_mutex_unlock(&r->shown->lock);
    pthread_join(thread, NULL);
    close(r->over[0]);
    return r->status;
}

/* Reads until the end, or until go_on() returns false. */
static int from_descriptor(struct shown *s, int descriptor, const char *what, bool may_break)
{
    struct reading r = {s, descriptor, EXIT_SUCCESS, what, may_break, {-1, -1}, false};
    uint8_t bytes[1 << 16];
    if (s->apart && s->has_window(s->context))
        return from_thread(&r);
    for (ssize_t count = 1; count && r.status == EXIT_SUCCESS && go_on(s);) {
        struct pollfd ready = {.fd = descriptor, .events = POLLIN};
        const bool window = s->has_window(s->context);
        const int found = poll(&ready, 1, window ? (int)(TURN_S * 1e3) : 50);
        if (window)
            s->turn(s->context, 0);
        if (found == 0)
            continue;
        count = read(descriptor, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR)
            continue;
        r.status = bytes_take(s, what, may_break, bytes, count);
    }
    return r.status;
}

/* ---- programs ---- */

/* The variable that names the room for pictures, and its value for who writes into `of`. */
static void room_tell(const struct shown *s, const char *of)
{
    char variable[64], text[PICTURE_ROOM_TEXT];
    snprintf(variable, sizeof variable, "%s_ROOM", s->variable);
    if (s->room.at && fcntl(s->room.descriptor, F_SETFD, 0) == 0)
        setenv(variable, picture_room_text(&s->room, of, text), 1);
    else
        unsetenv(variable);
}

_Noreturn static void become(const struct shown *s, int write_end, char **arguments)
{
    char name[64];
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    snprintf(name, sizeof name, "/dev/fd/%d", write_end);
    setenv(s->variable, name, 1);
    room_tell(s, name);
    /* A program in the current folder needs no ./ before its name. */
    char *here;
    if (!strchr(arguments[0], '/') && access(arguments[0], X_OK) == 0 &&
        asprintf(&here, "./%s", arguments[0]) > 0)
        execv(here, arguments);
    execvp(arguments[0], arguments);
    int error = errno;
    fail(s->verb, "%s: cannot run: %s; name a program (lutetia cc makes one) or a recording",
         arguments[0], strerror(error));
    _exit(126);
}

/* Waits for the child. Once it is to end, sends a stronger signal each second. */
static int child_wait(struct shown *s, pid_t child)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGKILL};
    size_t sent = 0;
    double sent_s = 0;
    int status;
    while (waitpid(child, &status, WNOHANG) != child) {
        bool wanted = go_on(s);
        if (!wanted && sent < sizeof signals / sizeof *signals && seconds_now() >= sent_s + 1) {
            kill(child, signals[sent++]);
            sent_s = seconds_now();
        }
        if (wanted)
            s->turn(s->context, 0.005);
        else
            usleep(5000);
    }
    return status;
}

static int child_end(struct shown *s, pid_t child, const char *name)
{
    int status = child_wait(s, child);
    if (!go_on(s))
        return EXIT_SUCCESS; /* the reason was printed, or is known */
    if (WIFSIGNALED(status))
        return fail(s->verb, "%s: ended by signal %d (%s)", name, WTERMSIG(status),
                    strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) == 126 && !s->taken(s->context))
        return EXIT_FAILED; /* the reason was printed */
    if (WEXITSTATUS(status) != 0)
        tell(s->verb, "%s: ended with status %d", name, WEXITSTATUS(status));
    return EXIT_SUCCESS;
}

static int from_program(struct shown *s, char **arguments)
{
    int ends[2];
    if (pipe(ends) != 0)
        return fail(s->verb, "no pipe: %s", strerror(errno));
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[0], F_SETPIPE_SZ, 1 << 20); /* a larger pipe, so that the program runs on
                                            * while a picture is drawn */
    if (s->room_wanted)
        picture_room_make(&s->room);
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        return fail(s->verb, "no process: %s", strerror(errno));
    if (child == 0)
        become(s, ends[1], arguments);
    close(ends[1]);
    s->seen = true;
    if (s->has_window(s->context))
        give_way();
    int status = from_descriptor(s, ends[0], arguments[0], true);
    close(ends[0]);
    int ended = child_end(s, child, arguments[0]);
    return status != EXIT_SUCCESS ? status : ended;
}

/* ---- recordings ---- */

bool shown_is_recording(const struct shown *s, const char *path)
{
    char begins[8] = "";
    int descriptor = input_file_descriptor(path, NULL);
    if (descriptor < 0)
        return false;
    const bool is = (read(descriptor, begins, sizeof begins) == (ssize_t)sizeof begins &&
                     memcmp(begins, s->line, sizeof begins) == 0) ||
                    access(path, X_OK) != 0;
    close(descriptor);
    return is;
}

static int from_file(struct shown *s, const char *path)
{
    const char *why;
    int descriptor = input_file_descriptor(path, &why);
    if (descriptor < 0)
        return fail(s->verb, "%s: cannot open: %s", path, why);
    int status = from_descriptor(s, descriptor, path, false);
    close(descriptor);
    return status;
}

/* A recording from the standard input, as it comes. */
static int from_input(struct shown *s)
{
    char variable[64];
    snprintf(variable, sizeof variable, "%s_ROOM", s->variable);
    if (s->room_wanted && s->watched)
        picture_room_find(&s->room, getenv(variable), "-");
    int status = from_descriptor(s, STDIN_FILENO, "the standard input", s->watched != 0);
    int nowhere = s->watched ? streams_nowhere(O_RDWR) : -1;
    if (nowhere >= 0) { /* close the output, so that a process waiting for its end goes on */
        dup2(nowhere, STDIN_FILENO);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        close(nowhere);
    }
    return status;
}

int shown_source(struct shown *s, int argc, char **argv)
{
    if (argc == 1 && strcmp(argv[0], "-") == 0)
        return from_input(s);
    if (argc == 1 && shown_is_recording(s, argv[0]))
        return from_file(s, argv[0]);
    return from_program(s, argv);
}
