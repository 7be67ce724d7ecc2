/* watch.c - takes what the hooks say to the trace's file and to the explanations' sums.
 *
 * Commands' times. An event is asked for with each command, and read when it has ended, in the order of the queue.
 * The device's clock is its own. That it put a command down as queued happened while we queued it:
 *
 *     our clock       before ...... after          before <= queued + offset <= after
 *     its clock              queued
 *
 * so each command bounds the offset from both sides, as does that it had ended when we found that it had. The offset
 * moves only as far as the newest command's bounds ask, which follows clocks that run apart, too. */
#include "watch/watch.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "watch/trace.h"

/* Commands whose times are not known yet, beyond which they are waited for. */
enum { COMMANDS_MOST = 4096, DETAILS_BYTES = 600 };

struct command {
    cl_event done;
    struct kernel_note *note;
    double before, after; /* our clock, around the call that queued it */
    uint64_t bytes;       /* by hand, fills and copies: of all arrays; generated: 0 */
};

struct watch {
    int machine; /* in the trace; 0: none is written */
    struct explain *explain;
    bool explains;   /* asked for; a trace wants the kernels' names alone */
    bool background; /* it has that track */

    int depth;        /* calls being performed, one in another */
    const char *call; /* the outermost */
    double call_start, noted_start;

    struct kernel_note *next; /* the next launch's; NULL: by hand */
    size_t next_bytes;
    struct command *commands; /* a ring */
    int commands_first, commands_count;
    double offset, device_end; /* of the clocks; where the last command ended, ours */
    bool offset_known;

    uint64_t waited_bytes;
};

const char *const watch_phase_names[WATCH_PHASES_COUNT] = {
    [WATCH_RECORD] = "record",
    [WATCH_ROLL] = "roll up loops",
    [WATCH_EVALUATE] = "evaluate",
    [WATCH_TARGETS] = "targets",
    [WATCH_SIGNATURE] = "signature",
    [WATCH_LOOKUP] = "plan look-up",
    [WATCH_PLAN] = "plan",
    [WATCH_GENERATE] = "generate",
    [WATCH_BUILD] = "build: compile",
    [WATCH_BUILD_LOAD] = "build: from the disk cache",
    [WATCH_BUILD_FIRST] = "build: first start",
    [WATCH_LAUNCH] = "launch",
    [WATCH_NOTE] = "note calls",
    [WATCH_REPLAY] = "replay",
    [WATCH_WAIT] = "wait",
};
static const char *const categories[WATCH_PHASES_COUNT] = {
    [WATCH_RECORD] = "record",    [WATCH_ROLL] = "simplify",      [WATCH_EVALUATE] = "evaluate",
    [WATCH_TARGETS] = "evaluate", [WATCH_SIGNATURE] = "evaluate", [WATCH_LOOKUP] = "evaluate",
    [WATCH_PLAN] = "plan",        [WATCH_GENERATE] = "generate",  [WATCH_BUILD] = "build",
    [WATCH_BUILD_LOAD] = "build", [WATCH_BUILD_FIRST] = "build",  [WATCH_LAUNCH] = "run",
    [WATCH_NOTE] = "replay",      [WATCH_REPLAY] = "replay",      [WATCH_WAIT] = "wait",
};

bool watch_open(struct machine *m, const struct machine_config *config)
{
    const char *path = config->trace ? config->trace : getenv("LUTETIA_TRACE");
    int machine = path && *path ? trace_open(path) : 0;
    if (!machine && !config->explain)
        return true;
    m->watch = calloc(1, sizeof *m->watch);
    if (m->watch) {
        m->watch->machine = machine;
        m->watch->explains = config->explain;
        m->watch->explain = explain_create();
        m->watch->commands = calloc(COMMANDS_MOST, sizeof *m->watch->commands);
    }
    if (m->watch && m->watch->explain && m->watch->commands)
        return true;
    trace_close(machine);
    watch_close(m);
    return false;
}

void watch_close(struct machine *m)
{
    struct watch *w = m->watch;
    if (!w)
        return;
    trace_close(w->machine);
    explain_destroy(w->explain);
    free(w->commands);
    free(w);
    m->watch = NULL;
}

struct explain *watch_sums(const struct machine *m)
{
    return m->watch->explain;
}

struct explain *watch_explain(const struct machine *m)
{
    return m->watch && m->watch->explains ? m->watch->explain : NULL;
}

/* ---- spans ---- */

static void span(struct machine *m, enum watch_phase phase, const char *name, double start,
                 double end, const char *details)
{
    struct watch *w = m->watch;
    struct machine_explained_row *row = &w->explain->phases[phase];
    row->count++;
    row->time_s += end - start;
    if (w->machine)
        trace_event(w->machine, TRACE_FRONT_END, name, categories[phase], start, end, details);
}

void watch_span(struct machine *m, enum watch_phase phase, double start, const char *details,
                ...)
{
    char text[DETAILS_BYTES] = "";
    double end = machine_clock_s();
    if (details) {
        va_list arguments;
        va_start(arguments, details);
        vsnprintf(text, sizeof text, details, arguments);
        va_end(arguments);
    }
    span(m, phase, watch_phase_names[phase], start, end, text);
}

/* It is no time of the front end's. */
void watch_background(struct machine *m, double start, double end, const char *options)
{
    struct watch *w = m->watch;
    char text[DETAILS_BYTES];
    if (!w->machine)
        return;
    if (!w->background)
        trace_background(w->machine);
    w->background = true;
    snprintf(text, sizeof text, "\"options\":\"%s\"", options);
    trace_event(w->machine, TRACE_BACKGROUND, "build", "build", start, end, text);
}

/* ---- calls ---- */

void watch_call(struct machine *m, const char *name, bool foreseen)
{
    struct watch *w = m->watch;
    if (m->plans->silent)
        return;
    if (!w->depth && w->explain->between)
        w->explain->between();
    if (foreseen) {
        if (m->run->calls_noted == 1)
            w->noted_start = machine_clock_s();
        return;
    }
    if (w->depth++)
        return;
    w->noted_start = 0;
    w->call = name ? name : "a call without a name";
    w->call_start = machine_clock_s();
}

void watch_performed(struct machine *m)
{
    struct watch *w = m->watch;
    if (!w->depth || --w->depth)
        return;
    double end = machine_clock_s();
    explain_call(w->explain, w->call, 0, end - w->call_start);
    span(m, WATCH_RECORD, w->call, w->call_start, end, NULL);
}

void watch_call_failed(struct machine *m)
{
    m->watch->depth = 0;
}

/* One that no call goes before: it looks at something, or makes something. */
void machine_instruction(struct machine *m, const char *name)
{
    machine_begin(m);
    struct watch *w = m->watch;
    if (!w)
        return;
    if (!w->depth) {
        explain_call(w->explain, name, 0, 0);
        if (w->machine)
            trace_event(w->machine, TRACE_FRONT_END, name, "record", machine_clock_s(), 0,
                        NULL);
    }
    if (w->explain->between)
        w->explain->between();
}

void machine_explain_between(struct machine *m, void (*between)(void))
{
    struct explain *e = watch_explain(m);
    if (e)
        e->between = between;
}

static void settle(struct machine *m, bool wait);

void watch_replayed(struct machine *m, double start, const struct machine_call *calls,
                    int count, int turns, bool alone)
{
    struct watch *w = m->watch;
    char text[60];
    for (int i = 0; i < count && w->explains; i++)
        explain_call(w->explain, calls[i].name, turns, 0);
    *(alone ? &w->explain->alone : &w->explain->looked) += 1;
    snprintf(text, sizeof text, "\"calls\":%d,\"turns\":%d", count * turns, turns);
    if (w->noted_start > 0)
        span(m, WATCH_NOTE, watch_phase_names[WATCH_NOTE], w->noted_start, start, text);
    watch_span(m, WATCH_REPLAY, start, "%s", text);
    w->noted_start = m->run->calls_noted ? machine_clock_s() : 0; /* those that are left */
    settle(m, false);
    if (w->machine)
        trace_flush();
}

/* ---- evaluations ---- */

void watch_evaluated(struct machine *m, double start, bool wanted, int targets)
{
    struct watch *w = m->watch;
    struct explain *e = w->explain;
    const char *why = wanted             ? "looked at"
                      : m->run->flushing ? "much was waiting"
                      : m->run->eager    ? "at once"
                                         : "asked to";
    *(wanted             ? &e->looked
      : m->run->flushing ? &e->alone
      : m->run->eager    ? &e->eager
                         : &e->flushed) += 1;
    watch_span(m, WATCH_EVALUATE, start, "\"why\":\"%s\",\"targets\":%d", why, targets);
    settle(m, false);
    if (w->machine)
        trace_flush();
}

/* ---- commands ---- */

void watch_launch(struct machine *m, struct kernel_note *note)
{
    m->watch->next = note;
    m->watch->next_bytes = 0;
}

void watch_arrays(struct machine *m, size_t bytes)
{
    m->watch->next = NULL;
    m->watch->next_bytes = bytes;
}

static struct command *newest(struct watch *w)
{
    return &w->commands[(w->commands_first + w->commands_count) % COMMANDS_MOST];
}

cl_event *watch_command(struct machine *m, double start)
{
    struct watch *w = m->watch;
    if (w->commands_count == COMMANDS_MOST)
        settle(m, true);
    struct command *c = newest(w);
    *c = (struct command){.before = start > 0 ? start : machine_clock_s()};
    return &c->done;
}

static void commanded(struct machine *m, cl_int error, struct kernel_note *note, size_t bytes)
{
    struct watch *w = m->watch;
    struct command *c = newest(w);
    if (error || !c->done || !note)
        return;
    c->after = machine_clock_s();
    c->note = note;
    c->bytes = bytes;
    note->facts.runs++;
    note->facts.bytes += note->facts.generated
                             ? note->facts.processors * (uint64_t)(note->facts.bytes_read +
                                                                   note->facts.bytes_written)
                             : bytes;
    w->commands_count++;
}

void watch_launched(struct machine *m, cl_int error, cl_kernel kernel, const char *what)
{
    struct watch *w = m->watch;
    struct kernel_note *note = w->next;
    if (!note) {
        char function[64] = "", name[160];
        clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof function - 1, function, NULL);
        snprintf(name, sizeof name, "%s: %s", what, function);
        note = explain_note(w->explain, kernel, name, 0, 0);
    }
    commanded(m, error, note, w->next_bytes);
    w->next = NULL;
    w->next_bytes = 0;
}

void watch_moves(struct machine *m, cl_int error, const char *what, size_t bytes)
{
    commanded(m, error, explain_note(m->watch->explain, NULL, what, 0, 0), bytes);
}

/* What is known of a command that has ended goes to the trace. */
static void tell(struct machine *m, const struct command *c, double start, double end,
                 bool timed)
{
    struct watch *w = m->watch;
    const struct machine_explained_kernel *k = &c->note->facts;
    char text[DETAILS_BYTES];
    if (k->generated)
        snprintf(text, sizeof text,
                 "\"VP set\":%d,\"processors\":%llu,\"bytes read\":%llu,\"bytes written\":%llu,"
                 "\"operations a processor\":%d,\"made\":\"%s\",\"timed by\":\"%s\"",
                 k->vpset, (unsigned long long)k->processors,
                 (unsigned long long)k->processors * (unsigned)k->bytes_read,
                 (unsigned long long)k->processors * (unsigned)k->bytes_written, k->operations,
                 k->made, timed ? "device" : "front end");
    else
        snprintf(text, sizeof text, "\"bytes of arrays\":%llu,\"timed by\":\"%s\"",
                 (unsigned long long)c->bytes, timed ? "device" : "front end");
    trace_event(w->machine, TRACE_DEVICE, k->name, "run", start, timed ? end : start - 1, text);
}

/* When a command was queued, began and ended, by the device's clock. */
struct times {
    cl_ulong queued, started, ended;
};

static bool times_of(cl_event done, struct times *t)
{
    return !clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_QUEUED, sizeof t->queued,
                                    &t->queued, NULL) &&
           !clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_START, sizeof t->started,
                                    &t->started, NULL) &&
           !clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_END, sizeof t->ended, &t->ended,
                                    NULL) &&
           t->queued && t->ended >= t->started;
}

static void clocks_compare(struct watch *w, const struct times *t, double before, double after)
{
    double now = machine_clock_s(), low = before - 1e-9 * (double)t->queued,
           high = after - 1e-9 * (double)t->queued, over = now - 1e-9 * (double)t->ended;
    high = over < high ? over : high; /* it has ended by now */
    if (!w->offset_known || w->offset > high)
        w->offset = high;
    if (w->offset < low)
        w->offset = low;
    w->offset_known = true;
}

static void command_end(struct machine *m, const struct command *c)
{
    struct watch *w = m->watch;
    struct times t = {0, 0, 0};
    bool timed = times_of(c->done, &t);
    double start = c->before, end = c->before;
    if (timed) {
        clocks_compare(w, &t, c->before, c->after);
        start = 1e-9 * (double)t.started + w->offset;
        start = start > w->device_end ? start : w->device_end; /* one after the other */
        end = start + 1e-9 * (double)(t.ended - t.started);
        w->device_end = end;
        c->note->facts.runs_timed++;
        c->note->facts.time_s += 1e-9 * (double)(t.ended - t.started);
    }
    if (w->machine)
        tell(m, c, start, end, timed);
}

/* The clocks, on commands that do nothing: the first kernels take long to be queued, for they are compiled. */
static void clocks_begin(struct machine *m)
{
    struct device_buffer *b = device_buffer_get(m, 64);
    m->device->inside++;
    for (int i = 0; b && i < 8; i++) {
        struct times t;
        cl_event done = NULL;
        cl_uint zero = 0;
        double before = machine_clock_s();
        cl_int error = clEnqueueFillBuffer(m->device->queue, b->mem, &zero, sizeof zero, 0, 64,
                                           0, NULL, &done);
        double after = machine_clock_s();
        if (!error && !clWaitForEvents(1, &done) && times_of(done, &t))
            clocks_compare(m->watch, &t, before, after);
        if (done)
            clReleaseEvent(done);
    }
    m->device->inside--;
    if (b)
        device_buffer_unref(m, b);
    machine_error_clear(m); /* then later commands must do */
}

static void settle(struct machine *m, bool wait)
{
    struct watch *w = m->watch;
    if (wait && w->commands_count) {
        m->device->inside++;
        clFinish(m->device->queue);
        m->device->inside--;
    }
    while (w->commands_count) {
        struct command *c = &w->commands[w->commands_first];
        cl_int state = CL_COMPLETE;
        clGetEventInfo(c->done, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state, NULL);
        if (state > CL_COMPLETE) /* below: it failed, which is said elsewhere */
            return;
        if (state == CL_COMPLETE)
            command_end(m, c);
        clReleaseEvent(c->done);
        w->commands_first = (w->commands_first + 1) % COMMANDS_MOST;
        w->commands_count--;
    }
}

void watch_settle(struct machine *m)
{
    settle(m, true);
}

void watch_ready(struct machine *m)
{
    char text[400];
    snprintf(text, sizeof text, "%d processors on %s", m->values->processors_count,
             m->device->name);
    clocks_begin(m);
    if (m->watch->machine)
        trace_title(m->watch->machine, text);
    if (m->watch->explains)
        explain_ready(m, m->watch->explain);
}

void watch_leave(struct machine *m)
{
    if (!m->watch || !m->device->queue)
        return;
    settle(m, true);
    if (m->watch->machine)
        trace_leave();
}

/* ---- waits ---- */

void watch_bytes(struct machine *m, size_t bytes)
{
    m->watch->waited_bytes = bytes;
}

void watch_waited(struct machine *m, double start, const char *what)
{
    struct watch *w = m->watch;
    double end = machine_clock_s();
    char text[60] = "";
    int i = 0;
    struct machine_explained *f = &w->explain->facts;
    while (i < f->transfers_count && strcmp(f->transfers[i].name, what) != 0)
        i++;
    if (i < (int)(sizeof f->transfers / sizeof *f->transfers)) {
        f->transfers_count += i == f->transfers_count;
        f->transfers[i].name = what;
        f->transfers[i].count++;
        f->transfers[i].time_s += end - start;
        f->transfers[i].bytes += w->waited_bytes;
    }
    if (w->waited_bytes)
        snprintf(text, sizeof text, "\"bytes\":%llu", (unsigned long long)w->waited_bytes);
    w->waited_bytes = 0;
    span(m, WATCH_WAIT, what, start, end, text);
    settle(m, false);
    if (w->machine)
        trace_flush();
}
