/* notes.h - calls that are foreseen: noted, and performed when somebody looks. */
#ifndef LUTETIA_MACHINE_NOTES_H
#define LUTETIA_MACHINE_NOTES_H

#include "machine.h"
#include "run/run.h"

/* Calls noted are performed: before anything looks at what fields and flags hold, or changes it. */
void notes_perform(struct machine *m);

/* Before fields die, or VP sets change their shape. */
void notes_forget(struct machine *m);
bool notes_take(struct machine *m, const struct machine_call *call);
/* The call is not the next one of the edge: but perhaps that of another. */
bool notes_take_elsewhere(struct machine *m, const struct machine_call *call);

#endif
