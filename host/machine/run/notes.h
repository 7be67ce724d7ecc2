/* notes.h - foreseen calls: noted, and performed before anything is observed. */
#ifndef LUTETIA_MACHINE_NOTES_H
#define LUTETIA_MACHINE_NOTES_H

#include "machine.h"
#include "run/run.h"

/* Performs the noted calls. Called before anything reads or changes what fields and flags
 * hold. */
void notes_perform(struct machine *m);

/* Called before fields are deallocated, or VP sets change their shape. */
void notes_forget(struct machine *m);
bool notes_take(struct machine *m, const struct machine_call *call);
/* The call is not the next one of the edge; looks for another edge that has it. */
bool notes_take_elsewhere(struct machine *m, const struct machine_call *call);

#endif
