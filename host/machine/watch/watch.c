/* watch.c - passes what the hooks report to the trace's file and to the sums. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "watch/trace.h"
#include "watch/watch_struct.h"

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
    [WATCH_INTERPRET] = "interpret",
    [WATCH_NOTE] = "note calls",
    [WATCH_REPLAY] = "replay",
    [WATCH_WAIT] = "wait",
};

static const char *const categories[WATCH_PHASES_COUNT] = {
    [WATCH_RECORD] = "record",    [WATCH_ROLL] = "simplify",      [WATCH_EVALUATE] = "evaluate",
    [WATCH_TARGETS] = "evaluate", [WATCH_SIGNATURE] = "evaluate", [WATCH_LOOKUP] = "evaluate",
    [WATCH_PLAN] = "plan",        [WATCH_GENERATE] = "generate",  [WATCH_BUILD] = "build",
    [WATCH_BUILD_LOAD] = "build", [WATCH_BUILD_FIRST] = "build",  [WATCH_LAUNCH] = "run",
    [WATCH_INTERPRET] = "run",    [WATCH_NOTE] = "replay",        [WATCH_REPLAY] = "replay",
    [WATCH_WAIT] = "wait",
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
        m->watch->explain = sums_create();
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
    sums_destroy(w->explain);
    free(w->commands);
    free(w);
    m->watch = NULL;
}

struct watch_sums *watch_sums(const struct machine *m)
{
    return m->watch->explain;
}

struct watch_sums *watch_explain(const struct machine *m)
{
    return m->watch && m->watch->explains ? m->watch->explain : NULL;
}

/* ---- spans ---- */

void watch_span_named(struct machine *m, enum watch_phase phase, const char *name, double start,
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
    double end = clock_s();
    if (details) {
        va_list arguments;
        va_start(arguments, details);
        vsnprintf(text, sizeof text, details, arguments);
        va_end(arguments);
    }
    watch_span_named(m, phase, watch_phase_names[phase], start, end, text);
}

void watch_interpreted(struct machine *m, struct kernel_note *note, double start)
{
    watch_span(m, WATCH_INTERPRET, start, NULL);
    if (!note)
        return;
    note->facts.runs++;
    note->facts.runs_timed++;
    note->facts.time_s += clock_s() - start;
}

void watch_near(struct machine *m, const char *what, double start)
{
    watch_interpreted(m, sums_note(m->watch->explain, 0, what, 0, 0), start);
}

/* It is no time of the front end's. */
void watch_background(struct machine *m, const char *what, double start, double end,
                      const char *options)
{
    struct watch *w = m->watch;
    char text[DETAILS_BYTES];
    if (!w->machine)
        return;
    if (!w->background)
        trace_background(w->machine);
    w->background = true;
    snprintf(text, sizeof text, "\"options\":\"%s\"", options);
    trace_event(w->machine, TRACE_BACKGROUND, what, what, start, end, text);
}

/* ---- calls ---- */

/* False: observers are not told. */
static bool between_calls(const struct watch *w)
{
    if (!w->silent && !w->depth && w->explain->between)
        w->explain->between();
    return !w->silent;
}

void watch_noted(struct machine *m, bool first)
{
    struct watch *w = m->watch;
    if (between_calls(w) && first)
        w->noted_start = clock_s();
}

void watch_call(struct machine *m, const char *name)
{
    struct watch *w = m->watch;
    if (!between_calls(w))
        return;
    if (w->depth++)
        return;
    w->noted_start = 0;
    w->call = name ? name : "a call without a name";
    w->call_start = clock_s();
}

void watch_performed(struct machine *m)
{
    struct watch *w = m->watch;
    if (!w->depth || --w->depth)
        return;
    double end = clock_s();
    sums_call(w->explain, w->call, 0, end - w->call_start);
    watch_span_named(m, WATCH_RECORD, w->call, w->call_start, end, NULL);
}

void watch_call_failed(struct machine *m)
{
    m->watch->depth = 0;
}

void machine_explain_between(struct machine *m, void (*between)(void))
{
    struct watch_sums *e = watch_explain(m);
    if (e)
        e->between = between;
}

void watch_replayed(struct machine *m, double start, const struct machine_call *calls,
                    int count, int turns, bool alone, bool more)
{
    struct watch *w = m->watch;
    char text[60];
    for (int i = 0; i < count && w->explains; i++)
        sums_call(w->explain, calls[i].name, turns, 0);
    w->explain->evaluations[alone ? WATCH_MUCH_WAITED : WATCH_LOOKED_AT]++;
    snprintf(text, sizeof text, "\"calls\":%d,\"turns\":%d", count * turns, turns);
    if (w->noted_start > 0)
        watch_span_named(m, WATCH_NOTE, watch_phase_names[WATCH_NOTE], w->noted_start, start,
                         text);
    watch_span(m, WATCH_REPLAY, start, "%s", text);
    w->noted_start = more ? clock_s() : 0;
    commands_settle(m, false);
    if (w->machine)
        trace_flush();
}

void watch_instruction(struct machine *m, const char *name)
{
    struct watch *w = m->watch;
    if (!w->depth) {
        sums_call(w->explain, name, 0, 0);
        if (w->machine)
            trace_event(w->machine, TRACE_FRONT_END, name, "record", clock_s(), 0, NULL);
    }
    if (w->explain->between)
        w->explain->between();
}

void watch_silent(struct machine *m, bool silent)
{
    m->watch->silent = silent;
}

/* ---- values ---- */

void watch_vanished(struct machine *m, int op)
{
    struct watch_sums *e = watch_sums(m);
    if (m->watch->silent)
        return;
    e->facts.values_vanished++;
    e->vanished[op]++;
}

void watch_overwritten(struct machine *m)
{
    if (!m->watch->silent)
        watch_sums(m)->overwritten++;
}

void watch_computed(struct machine *m, int count, int stored)
{
    struct machine_explained *f = &watch_sums(m)->facts;
    f->values_computed += (uint64_t)count;
    f->values_stored += (uint64_t)stored;
}

/* ---- evaluations ---- */

void watch_evaluated(struct machine *m, double start, enum watch_why why, int targets)
{
    static const char *const names[] = {[WATCH_LOOKED_AT] = "looked at",
                                        [WATCH_MUCH_WAITED] = "much was waiting",
                                        [WATCH_AT_ONCE] = "at once",
                                        [WATCH_ASKED_TO] = "asked to"};
    struct watch *w = m->watch;
    w->explain->evaluations[why]++;
    watch_span(m, WATCH_EVALUATE, start, "\"why\":\"%s\",\"targets\":%d", names[why], targets);
    commands_settle(m, false);
    if (w->machine)
        trace_flush();
}

/* ---- waits ---- */

void watch_bytes(struct machine *m, size_t bytes)
{
    m->watch->waited_bytes = bytes;
}

void watch_waited(struct machine *m, double start, const char *what)
{
    struct watch *w = m->watch;
    double end = clock_s();
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
    watch_span_named(m, WATCH_WAIT, what, start, end, text);
    commands_settle(m, false);
    if (w->machine)
        trace_flush();
}
