/* at_once_when.c - see at_once_when.h.
 *
 * Calls that repeat are worth recording: whole turns of a loop become one kernel, and their
 * calls need only be compared. So operations are computed at once until a loop is found
 * (history.c), and again some time after the last foreseen call. */
#include "run/at_once_when.h"

#include "interpret/at_once.h"

enum { UNFORESEEN_LEAST = 2048 }; /* calls */

enum at_once_may at_once_may(const struct machine *m)
{
    const struct settings *s = &m->settings;
    const bool cuts_small = s->blocks > 1 && s->blocks_from != SETTING_FREE;
    if (!s->at_once || !m->device->is_pocl || !s->near || m->watch || cuts_small)
        return AT_ONCE_NEVER;
    if (s->at_once > 1)
        return AT_ONCE_ALWAYS;
    return s->interpret != 1 || !s->optimise_after || !s->box_after ? AT_ONCE_NEVER
                                                                    : AT_ONCE_SOMETIMES;
}

static bool is_wanted(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (m->run->calls_foreseen != p->foreseen_at_once) {
        p->foreseen_at_once = m->run->calls_foreseen;
        p->unforeseen = 0;
    }
    if (m->run->mode != RUN_FREE || p->at_once == AT_ONCE_ALWAYS)
        return m->run->mode == RUN_FREE;
    return (!p->foreseen_at_once || ++p->unforeseen > UNFORESEEN_LEAST) && !history_in_loop(m);
}

void at_once_choose(struct machine *m)
{
    const bool was = m->values->at_once, is = is_wanted(m);
    m->values->at_once = is ? at_once_operation : NULL;
    if (was && !is) /* as if all had been evaluated */
        m->values->epoch++;
}
