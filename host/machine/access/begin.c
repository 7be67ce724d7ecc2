/* begin.c - the beginning of an instruction: finishes what earlier instructions have left to
 * do.
 *
 *     the program          machine_instruction()     values handed out before are given back;
 *     a call of Paris      machine_begin()           calls that are noted are performed; an
 *                          evaluation that is due is made
 *
 * Inside a call that is being performed, only values are released. Functions that read or
 * change fields settle noted calls themselves (settle.h), because not every caller begins an
 * instruction.
 */
#include "access/settle.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "run/replay.h"
#include "values/graph.h"
#include "watch/watch.h"

enum { SIMPLIFY_BUDGET = 256 }; /* the most nodes that rules may visit in one instruction */

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
    evaluate_due(m);
    history_looked(m);
}

void machine_instruction(struct machine *m, const char *name)
{
    machine_begin(m);
    if (m->watch)
        watch_instruction(m, name);
}
