/* rows.h - the members of operations' arguments and of a sheet's description, a row for each
 * (events: members.h). The rows determine the checks, the bytes in histories and saved
 * states, and the scaling to another resolution. */
#ifndef LUTETIA_PAPER_ROWS_H
#define LUTETIA_PAPER_ROWS_H

#include "arguments.h"
#include "describe.h"

/* Other rows are in public headers. The order and the kinds of rows never change, because
 * files depend on them. */
extern const struct members paper_put_members, paper_resist_members, paper_layer_members,
    paper_bookmark_members;

/* As members_check(). Errors: BAD_ARGUMENT. */
enum paper_status paper_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where);

#endif
