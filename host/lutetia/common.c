/* common.c - what verbs share: failures, Ctrl-C, the progress line, sheets to files. */
#include "lutetia.h"

#include <display.h>
#include <output_file.h>
#include <paris_internal.h>
#include <part_files.h>
#include <visible_text.h>

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

void tell_line(const char *text)
{
    visible_say("%s", text);
}

__attribute__((format(printf, 3, 0))) static int fail_as(int status, const char *verb,
                                                         const char *format, va_list arguments)
{
    char text[1200];
    int begin = snprintf(text, sizeof text, "lutetia%s%s: ", verb ? " " : "", verb ? verb : "");
    vsnprintf(text + begin, sizeof text - (size_t)begin, format, arguments);
    tell_line(text);
    return status;
}

void tell(const char *verb, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail_as(EXIT_SUCCESS, verb, format, arguments);
    va_end(arguments);
}

int fail(const char *verb, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int status = fail_as(EXIT_FAILED, verb, format, arguments);
    va_end(arguments);
    return status;
}

int fail_usage(const char *verb, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int status = fail_as(EXIT_USAGE, verb, format, arguments);
    va_end(arguments);
    return status;
}

static volatile sig_atomic_t interrupt_flag;

/* The second one ends the program at once. */
static void interrupt_take(int signal_number)
{
    if (interrupt_flag)
        part_files_die(signal_number);
    interrupt_flag = 1;
}

/* SIGINT is blocked and polled, not handled. The terminal also sends it to the linker that
 * PoCL runs as a child, and PoCL aborts if the linker dies; children inherit the blocked
 * signal. */
void interrupt_catch(void)
{
    /* SA_RESTART: compilers fail if a system call is interrupted */
    struct sigaction action = {.sa_handler = interrupt_take, .sa_flags = SA_RESTART};
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    sigprocmask(SIG_BLOCK, &interrupt, NULL);
    sigaction(SIGTERM, &action, NULL);
    struct sigaction hangup;
    if (sigaction(SIGHUP, NULL, &hangup) == 0 && hangup.sa_handler != SIG_IGN) /* nohup */
        sigaction(SIGHUP, &action, NULL);
}

bool interrupted(void)
{
    sigset_t pending;
    if (interrupt_flag == 0 && sigpending(&pending) == 0 &&
        sigismember(&pending, SIGINT) == 1) {
        const struct timespec now = {0};
        sigset_t interrupt;
        sigemptyset(&interrupt);
        sigaddset(&interrupt, SIGINT);
        /* this thread or another that polls takes the signal; the next one ends the program */
        sigtimedwait(&interrupt, NULL, &now);
        sigprocmask(SIG_UNBLOCK, &interrupt, NULL);
        interrupt_flag = 1;
    }
    return interrupt_flag != 0;
}

void interrupt_forget(void)
{
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    sigprocmask(SIG_BLOCK, &interrupt, NULL);
    interrupt_flag = 0;
}

int interrupt_report(const char *verb, int status, const char *untouched)
{
    if (status == EXIT_SUCCESS || !interrupted())
        return status;
    fail(verb, "interrupted; %s as before", untouched);
    return EXIT_INTERRUPTED;
}

int fail_paper(const char *verb)
{
    return interrupted() ? EXIT_FAILED : fail(verb, "%s", paper_error());
}

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void time_left_text(char *text, size_t room, double seconds)
{
    if (seconds < 100)
        snprintf(text, room, "%.0f s left", seconds);
    else if (seconds < 6000)
        snprintf(text, room, "about %.0f min left", seconds / 60);
    else
        snprintf(text, room, "about %.1f hours left", seconds / 3600);
}

struct progress progress_begin(const char *what, int total)
{
    double now = seconds_now();
    return (struct progress){
        .what = what, .total = total, .shown = isatty(STDERR_FILENO) != 0, .began_s = now};
}

#define MARKED_FROM 0.5 /* seconds */
#define PACE_SPAN 1.0   /* seconds over which it is taken at least */

double progress_left(struct progress *p, int done, double now)
{
    const double passed = now - p->began_s;
    if (p->mark[0].s == 0) {
        if (passed >= MARKED_FROM && done > 0) {
            p->mark[0].s = p->mark[1].s = now;
            p->mark[0].done = p->mark[1].done = done;
        }
        return -1;
    }
    if (now - p->mark[1].s >= fmax(PACE_SPAN, passed / 3)) {
        p->mark[0] = p->mark[1];
        p->mark[1].s = now;
        p->mark[1].done = done;
    }
    const double span = now - p->mark[0].s;
    const int steps = done - p->mark[0].done;
    return span < PACE_SPAN || steps <= 0 ? -1 : span / steps * (p->total - done);
}

void progress_show(struct progress *p, int done)
{
    enum { BAR = 32 };
    double now = seconds_now();
    if (!p->shown || (now - p->drawn_s < 0.1 && done < p->total))
        return;
    p->drawn_s = now;
    char bar[BAR + 1];
    int filled = p->total > 0 ? (int)((long)BAR * done / p->total) : BAR;
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)filled);
    bar[BAR] = '\0';
    double passed = now - p->began_s;
    char left[40] = "";
    const double seconds = progress_left(p, done, now);
    if (seconds >= 0 && done < p->total)
        time_left_text(left, sizeof left, seconds);
    char what[400];
    visible_text(what, sizeof what, p->what);
    fprintf(stderr, "\r%s [%s] %d/%d  %.1f steps/s  %s\033[K", what, bar, done, p->total,
            passed > 0 ? done / passed : 0, left);
    fflush(stderr);
}

void progress_end(struct progress *p)
{
    if (p->shown) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
    }
}

/* Finds the memory of the device that the machine chose. */
struct device_memory {
    const char *device;
    uint64_t bytes;
};

static void device_memory_take(void *context, int index, const char *platform,
                               const char *device, const char *version, int compute_units,
                               uint64_t memory_bytes)
{
    (void)index;
    (void)platform;
    (void)version;
    (void)compute_units;
    struct device_memory *memory = context;
    if (memory->bytes == 0 && strstr(memory->device, device))
        memory->bytes = memory_bytes;
}

/* The machine holds old and new values at once; the picture is read as 4 bytes a fiber and
 * written as 3. */
double page_bytes(int width, int height)
{
    return (2.0 * paper_bits_per_fiber(width, height) + 56) / 8 * width * height;
}

int machine_prepare(const char *verb, int width, int height, double bytes)
{
    if (!paris_reset(NULL))
        return fail(verb, "%s", paris_error());
    struct device_memory memory = {.device = machine_device_name(paris_machine())};
    machine_devices_list(device_memory_take, &memory);
    if (memory.bytes && bytes > (double)memory.bytes)
        return fail(
            verb, "paper of %dx%d fibers needs %.1f GB and %s has %.1f GB; take smaller paper",
            width, height, bytes * 1e-9, memory.device, (double)memory.bytes * 1e-9);
    return EXIT_SUCCESS;
}

int picture_finish(const char *verb, int status, const char *path, struct display_image *image)
{
    if (interrupted())
        status = EXIT_INTERRUPTED;
    else if (status == EXIT_SUCCESS && display_png_write(path, image) != DISPLAY_OK)
        status = fail(verb, "%s", display_error());
    display_image_destroy(image);
    return status;
}

int sheet_write(const char *verb, struct paper *sheet, enum paper_view view, const char *path)
{
    struct display_image image = {
        .width_px = paper_width(sheet), .height_px = paper_height(sheet), .channels = 3};
    if (display_image_create(&image) != DISPLAY_OK)
        return fail(verb, "%s", display_error());
    const bool read = paper_view_read(sheet, view, image.pixels) == PAPER_OK;
    return picture_finish(verb, read ? EXIT_SUCCESS : fail_paper(verb), path, &image);
}

int folder_make(const char *verb, const char *path)
{
    struct stat status;
    if (mkdir(path, 0777) == 0)
        return EXIT_SUCCESS;
    if (errno != EEXIST)
        return fail(verb, "%s: cannot make the folder: %s", path, strerror(errno));
    if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode))
        return fail(verb, "%s: not a folder; name another", path);
    if (access(path, W_OK) != 0)
        return fail(verb, "%s: cannot write there: %s", path, strerror(errno));
    return EXIT_SUCCESS;
}

int output_check(const char *verb, const char *path)
{
    struct output_file out;
    if (!path)
        return EXIT_SUCCESS;
    if (!output_file_open(&out, path))
        return fail(verb, "%s: cannot write: %s", path, out.why);
    output_file_abandon(&out);
    return EXIT_SUCCESS;
}
