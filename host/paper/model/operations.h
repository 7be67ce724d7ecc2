/* operations.h - what operations do to a sheet: the functions of the event table's rows
 * (event/event.c).
 *
 * `arguments` is the struct of the operation's kind. A check looks at the arguments and at what
 * the sheet is made of, and changes nothing; what depends on what has been done to the sheet,
 * the operation itself finds. Nothing here knows of histories. Errors: BAD_ARGUMENT, NO_MEMORY,
 * MACHINE_FAILED. */
#ifndef LUTETIA_PAPER_OPERATIONS_H
#define LUTETIA_PAPER_OPERATIONS_H

#include "arguments.h"

enum paper_status sheet_step(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_put_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_put(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_blot_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_blot(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_resist_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_resist(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_dry(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_seal(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_layer_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_layer(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_brush_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_brush(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_dip_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_dip(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_stroke_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_stroke(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_salt_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_salt(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_wash_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_wash(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_print_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_print(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_lift_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_lift(struct paper_sheet *p, const void *arguments);
enum paper_status sheet_varnish_check(const struct paper_sheet *p, const void *arguments);
enum paper_status sheet_varnish(struct paper_sheet *p, const void *arguments);

#endif
