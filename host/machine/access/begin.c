/* begin.c - the beginning of an instruction: the one place where what is left of earlier ones is seen to.
 *
 *     the program          machine_instruction()     values handed out before are given back;
 *     a call of Paris      machine_begin()           calls that are noted are performed; an evaluation that is due is made
 *
 * Inside a call that is performed only values are given back. Functions that look at fields, or change them, settle what is
 * noted for themselves (settle.h), for not everybody begins an instruction. */
#include "access/settle.h"
#include "run/notes.h"
#include "run/replay.h"
#include "values/graph.h"
#include "watch/watch.h"

enum { SIMPLIFY_BUDGET = 256 }; /* nodes that rules may look at in one instruction */

static bool in_call(const struct machine *m)
{
    return m->run->replay && m->run->replay->depth;
}

void machine_begin(struct machine *m)
{
    graph_give_back(m);
    m->values->simplify_budget = SIMPLIFY_BUDGET;
    if (in_call(m))
        return;
    settle(m);
    run_flush_due(m);
    history_looked(m);
}

void machine_instruction(struct machine *m, const char *name)
{
    machine_begin(m);
    if (m->watch)
        watch_instruction(m, name);
}
