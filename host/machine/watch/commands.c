/* commands.c - the device's own times of its commands.
 *
 * Each command has an event, which is read when the command has ended, in the order of the
 * queue. The device has its own clock. Its time `queued` lies within our call that queued the
 * command:
 *
 *     our clock       before ...... after          before <= queued + offset <= after
 *     its clock              queued
 *
 * So each command bounds the offset of the clocks from both sides. Our finding that a
 * command has ended gives a further bound. The offset is moved only as far as the newest
 * command's bounds require, so it follows clocks that drift apart.
 */
#include <stdio.h>

#include "watch/trace.h"
#include "watch/watch_struct.h"

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
        commands_settle(m, true);
    struct command *c = newest(w);
    *c = (struct command){.before = start > 0 ? start : clock_s()};
    return &c->done;
}

static void commanded(struct machine *m, cl_int error, struct kernel_note *note, size_t bytes)
{
    struct watch *w = m->watch;
    struct command *c = newest(w);
    if (error || !c->done || !note)
        return;
    c->after = clock_s();
    c->note = note;
    c->bytes = bytes;
    note->facts.runs++;
    note->facts.bytes += note->facts.generated
                             ? note->facts.processors * (uint64_t)(note->facts.bytes_read +
                                                                   note->facts.bytes_written)
                             : bytes;
    w->commands_count++;
}

void watch_launched(struct machine *m, cl_int error, cl_kernel kernel, uint64_t id,
                    const char *what)
{
    struct watch *w = m->watch;
    struct kernel_note *note = w->next;
    if (!note) {
        char function[64] = "", name[160];
        clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof function - 1, function, NULL);
        snprintf(name, sizeof name, "%s: %s", what, function);
        note = sums_note(w->explain, id, name, 0, 0);
    }
    commanded(m, error, note, w->next_bytes);
    w->next = NULL;
    w->next_bytes = 0;
}

void watch_moves(struct machine *m, cl_int error, const char *what, size_t bytes)
{
    commanded(m, error, sums_note(m->watch->explain, 0, what, 0, 0), bytes);
}

/* Reports a command that has ended to the trace. */
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
    double now = clock_s(), low = before - 1e-9 * (double)t->queued,
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
        start = start > w->device_end ? start : w->device_end; /* commands run one after the
                                                                * other */
        end = start + 1e-9 * (double)(t.ended - t.started);
        w->device_end = end;
        c->note->facts.runs_timed++;
        c->note->facts.time_s += 1e-9 * (double)(t.ended - t.started);
    }
    if (w->machine)
        tell(m, c, start, end, timed);
}

/* Calibrates the clocks with commands that do nothing. The first kernels would not serve,
 * since they take long to be queued: they are compiled. */
static void clocks_begin(struct watch *w, cl_mem scratch)
{
    for (int i = 0; i < 8; i++) {
        struct times t;
        cl_event done = NULL;
        cl_uint zero = 0;
        double before = clock_s();
        cl_int error =
            clEnqueueFillBuffer(w->queue, scratch, &zero, sizeof zero, 0, 64, 0, NULL, &done);
        double after = clock_s();
        if (!error && !clWaitForEvents(1, &done) && times_of(done, &t))
            clocks_compare(w, &t, before, after);
        if (done)
            clReleaseEvent(done);
    }
}

void commands_settle(struct machine *m, bool wait)
{
    struct watch *w = m->watch;
    if (wait && w->commands_count) {
        m->inside++;
        clFinish(w->queue);
        m->inside--;
    }
    while (w->commands_count) {
        struct command *c = &w->commands[w->commands_first];
        cl_int state = CL_COMPLETE;
        clGetEventInfo(c->done, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state, NULL);
        if (state > CL_COMPLETE) /* negative: it failed, which is reported elsewhere */
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
    commands_settle(m, true);
}

void watch_ready(struct machine *m, cl_command_queue queue, cl_mem scratch, const char *title)
{
    struct watch *w = m->watch;
    w->queue = queue;
    m->inside++;
    if (scratch)
        clocks_begin(w, scratch);
    m->inside--;
    if (w->machine)
        trace_title(w->machine, title);
}

void watch_leave(struct machine *m)
{
    if (!m->watch || !m->watch->queue)
        return;
    commands_settle(m, true);
    if (m->watch->machine)
        trace_leave();
}
