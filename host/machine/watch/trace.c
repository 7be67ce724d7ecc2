/* trace.c - writes the file of trace.h.
 *
 * Events are collected in a buffer and written in pieces; each piece takes the place of the
 * closing bracket that was behind the one before, and has another behind it. So the file can be
 * loaded whenever the program ends.
 */
#include "watch/trace.h"
#include <visible_text.h>

#include <exit_status.h>
#include <growing_file.h>

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

enum { BUFFER_BYTES = 1 << 16, EVENT_BYTES = 2048, NAME_BYTES = 512 };

static struct {
    pthread_mutex_t lock;
    struct growing_file file;
    char *path, *refused; /* refused: the last path that could not be opened, which has been
                           * reported */
    pid_t owner;          /* the process that opened the file: forked children must not write */
    bool failed, full;
    char buffer[BUFFER_BYTES];
    size_t length;
    double began_s;
    int machines, open_count;
    long events;
} trace = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void complain(const char *path, const char *what)
{
    visible_say("LUTETIA_TRACE: cannot %s %s: %s", what, path, trace.file.why);
    exit_status_fail();
}

static bool bytes_write(const char *bytes, size_t count)
{
    static const char bracket[] = "\n]\n";
    if (growing_file_append(&trace.file, bytes, count, bracket, sizeof bracket - 1))
        return true;
    if (!trace.failed)
        complain(trace.path, "write to");
    trace.failed = true;
    return false;
}

static bool ours(void)
{
    return trace.file.is_open && !trace.failed && trace.owner == getpid();
}

static void flush(void)
{
    if (trace.length && ours())
        bytes_write(trace.buffer, trace.length);
    trace.length = 0;
}

/* Quotes a string for JSON; other than plain characters become question marks. Cut to size. */
static const char *quoted(char *out, size_t size, const char *text)
{
    size_t length = 0;
    for (; *text && length + 3 < size; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            out[length++] = '\\';
        out[length++] = c < 0x20 || c >= 0x7f ? '?' : (char)c;
    }
    out[length] = '\0';
    return out;
}

__attribute__((format(printf, 1, 2))) static void event_write(const char *format, ...)
{
    if (!ours() || trace.full)
        return;
    if (trace.events == TRACE_EVENTS_MOST) {
        trace.full = true;
        visible_say("LUTETIA_TRACE: %s has %ld events, and gets no more", trace.path,
                    trace.events);
        return;
    }
    if (trace.length + EVENT_BYTES > BUFFER_BYTES)
        flush();
    char *at = trace.buffer + trace.length;
    size_t begun = trace.events ? 2 : 0;
    memcpy(at, ",\n", begun);
    va_list arguments;
    va_start(arguments, format);
    int count = vsnprintf(at + begun, EVENT_BYTES - begun, format, arguments);
    va_end(arguments);
    if (count < 0 || (size_t)count >= EVENT_BYTES - begun)
        return; /* the event is too long: left out */
    trace.length += begun + (size_t)count;
    trace.events++;
}

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* When the program ends. */
static void file_close(void)
{
    pthread_mutex_lock(&trace.lock);
    flush();
    if (!growing_file_close(&trace.file))
        complain(trace.path, "write to");
    pthread_mutex_unlock(&trace.lock);
}

static bool file_open(const char *path)
{
    static bool registered;
    if (!growing_file_close(&trace.file))
        complain(trace.path, "write to");
    free(trace.path);
    trace.path = NULL;
    if (!growing_file_open(&trace.file, path)) {
        if (!trace.refused || strcmp(trace.refused, path) != 0)
            complain(path, "open");
        free(trace.refused);
        trace.refused = strdup(path);
        return false;
    }
    if (!registered)
        registered = atexit(file_close) == 0;
    trace.path = strdup(path);
    trace.owner = getpid();
    trace.failed = trace.full = false;
    trace.length = 0;
    trace.machines = 0;
    trace.events = 0;
    trace.began_s = now_s();
    return trace.path && bytes_write("[\n", 2);
}

int trace_open(const char *path)
{
    pthread_mutex_lock(&trace.lock);
    bool same = trace.path && strcmp(trace.path, path) == 0;
    int machine = 0;
    if (!same && trace.open_count > 0)
        visible_say("LUTETIA_TRACE: %s: this process already writes %s", path, trace.path);
    else if (same ? !trace.failed : file_open(path))
        machine = ++trace.machines;
    trace.open_count += machine != 0;
    pthread_mutex_unlock(&trace.lock);
    return machine;
}

static void track_title(int machine, enum trace_track track, const char *title)
{
    event_write("{\"ph\":\"M\",\"pid\":%d,\"tid\":%d,\"name\":\"thread_name\","
                "\"args\":{\"name\":\"%s\"}}",
                machine, track, title);
}

void trace_title(int machine, const char *title)
{
    char text[NAME_BYTES];
    pthread_mutex_lock(&trace.lock);
    event_write("{\"ph\":\"M\",\"pid\":%d,\"name\":\"process_name\","
                "\"args\":{\"name\":\"machine %d: %s\"}}",
                machine, machine, quoted(text, sizeof text, title));
    track_title(machine, TRACE_FRONT_END, "front end");
    track_title(machine, TRACE_DEVICE, "device");
    flush();
    pthread_mutex_unlock(&trace.lock);
}

void trace_background(int machine)
{
    pthread_mutex_lock(&trace.lock);
    track_title(machine, TRACE_BACKGROUND, "background");
    pthread_mutex_unlock(&trace.lock);
}

void trace_event(int machine, enum trace_track track, const char *name, const char *category,
                 double start_s, double end_s, const char *details)
{
    char text[NAME_BYTES], length[40];
    bool moment = end_s < start_s;
    pthread_mutex_lock(&trace.lock);
    /* Both ends are rounded, so that events that end together also do in the file. */
    long long start_ns = (long long)((start_s - trace.began_s) * 1e9),
              end_ns = (long long)((end_s - trace.began_s) * 1e9);
    start_ns = start_ns < 0 ? 0 : start_ns;
    end_ns = end_ns < start_ns ? start_ns : end_ns;
    if (moment)
        snprintf(length, sizeof length, "\"s\":\"t\"");
    else
        snprintf(length, sizeof length, "\"dur\":%lld.%03d", (end_ns - start_ns) / 1000,
                 (int)((end_ns - start_ns) % 1000));
    event_write("{\"ph\":\"%s\",\"pid\":%d,\"tid\":%d,\"name\":\"%s\",\"cat\":\"%s\","
                "\"ts\":%lld.%03d,%s,\"args\":{%s}}",
                moment ? "i" : "X", machine, track, quoted(text, sizeof text, name), category,
                start_ns / 1000, (int)(start_ns % 1000), length, details ? details : "");
    pthread_mutex_unlock(&trace.lock);
}

void trace_flush(void)
{
    pthread_mutex_lock(&trace.lock);
    flush();
    pthread_mutex_unlock(&trace.lock);
}

void trace_leave(void)
{
    trace_flush();
}

void trace_close(int machine)
{
    if (!machine)
        return;
    pthread_mutex_lock(&trace.lock);
    flush(); /* the file stays open: another machine's events may follow */
    trace.open_count--;
    pthread_mutex_unlock(&trace.lock);
}
