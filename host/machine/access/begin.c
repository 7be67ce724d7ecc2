/* begin.c - before an instruction. */
#include "run/replay.h"
#include "values/graph.h"
#include "watch/trace.h"
#include "watch/watch_struct.h"

void machine_begin(struct machine *m)
{
    graph_give_back(m);
    m->values->simplify_budget = 256;
    if (!run_in_call(m)) {
        notes_settle(m);
        run_flush_due(m);
        history_looked(m);
    }
}

/* One that no call goes before: it looks at something, or makes something. */
void machine_instruction(struct machine *m, const char *name)
{
    machine_begin(m);
    struct watch *w = m->watch;
    if (!w)
        return;
    if (!w->depth) {
        sums_call(w->explain, name, 0, 0);
        if (w->machine)
            trace_event(w->machine, TRACE_FRONT_END, name, "record", clock_s(), 0, NULL);
    }
    if (w->explain->between)
        w->explain->between();
}
