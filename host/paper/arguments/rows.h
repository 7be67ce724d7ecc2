/* rows.h - of what operations' arguments and a sheet's description consist, a row for each member (events: members.h). From these
 * rows follow their checks, their bytes in histories and saved states, and their values at another resolution. */
#ifndef LUTETIA_PAPER_ROWS_H
#define LUTETIA_PAPER_ROWS_H

#include "arguments/arguments.h"
#include "describe.h"

/* The others are public. In files their order and kinds never change. */
extern const struct members paper_put_members, paper_blot_members, paper_resist_members,
    paper_layer_members;

/* As members_check(). Errors: BAD_ARGUMENT. */
enum paper_status paper_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where);

#endif
