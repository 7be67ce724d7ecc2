/* rows.h - of what operations' arguments and a sheet's description consist, a row for each member (events: members.h). From these
 * rows follow their checks, their bytes in histories and saved states, and their values at another resolution. */
#ifndef LUTETIA_PAPER_ROWS_H
#define LUTETIA_PAPER_ROWS_H

#include "arguments/arguments.h"

#include <members.h>

/* In files: their order and kinds never change. */
extern const struct members paper_air_members, paper_stock_members, paper_pigment_members,
    paper_put_members, paper_blot_members, paper_resist_members, paper_layer_members,
    paper_brush_members, paper_dip_members, paper_stroke_members, paper_sample_members,
    paper_salt_members, paper_wash_members, paper_print_members, paper_lift_members,
    paper_varnish_members;

/* As members_check(). Errors: BAD_ARGUMENT. */
enum paper_status paper_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where);

#endif
