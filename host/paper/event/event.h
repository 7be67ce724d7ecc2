/* event.h - the operations on a sheet, as data: each operation is a row of one table.
 *
 * A public operation calls sheet_event(p, SHEET_EVENT_PUT, &arguments). The row of its kind
 * gives the functions that check and perform it, and the members of its arguments
 * (arguments/rows.h). The members determine the ranges, the bytes in histories and files
 * (history.h), and the scaling to another resolution.  So a new operation is a struct, the rows
 * of its members, its functions and a row:
 *
 *     struct event_salt { int grains_count; const double *grains; double strength; };
 *     enum paper_status paper_sheet_salt(struct paper_sheet *p, const struct event_salt *salt)
 *     {
 *         return sheet_event(p, SHEET_EVENT_SALT, salt);
 *     }
 *
 * The effect of an operation must depend only on the sheet and these arguments. Random
 * operations have a seed among their arguments.
 */
#ifndef LUTETIA_PAPER_EVENT_H
#define LUTETIA_PAPER_EVENT_H

#include "arguments.h"
#include "base/base.h"

#include <kinds.h>
#include <scale.h>

enum sheet_event_kind {
    SHEET_EVENT_STEP,
    SHEET_EVENT_AIR,
    SHEET_EVENT_PUT,
    SHEET_EVENT_BLOT,
    SHEET_EVENT_RESIST,
    SHEET_EVENT_DRY,
    SHEET_EVENT_SEAL,
    SHEET_EVENT_LAYER,
    SHEET_EVENT_BRUSH,
    SHEET_EVENT_DIP,
    SHEET_EVENT_STROKE,
    SHEET_EVENT_SALT,
    SHEET_EVENT_WASH,
    SHEET_EVENT_PRINT,
    SHEET_EVENT_LIFT,
    SHEET_EVENT_VARNISH,
    SHEET_EVENT_BOOKMARK,
    SHEET_EVENT_KINDS
};

const struct event_kind *sheet_event_kind(enum sheet_event_kind kind);
const char *sheet_event_name(enum sheet_event_kind kind);
/* By name; -1: none. */
int sheet_event_find(const char *name, size_t length);
enum paper_status sheet_event_check(const struct paper_sheet *p, enum sheet_event_kind kind,
                                    const void *arguments);
enum paper_status sheet_event_perform(struct paper_sheet *p, enum sheet_event_kind kind,
                                      const void *arguments);
/* Converts the result of event_decode() to a status. Errors: BAD_FILE, NO_MEMORY. */
enum paper_status sheet_event_decoded(enum event_decoded decoded, enum sheet_event_kind kind);
/* scaling->context is a struct paper_sizes (arguments/forms.h). Errors: NO_MEMORY. */
enum paper_status sheet_event_scale(enum sheet_event_kind kind, void *arguments,
                                    const struct event_scaling *scaling);

/* ---- a sheet's description and its air (event/description.c) ---- */

void sheet_config_encode(struct event_bytes *b, const struct paper_sheet_config *config);
/* Errors: BAD_FILE. */
enum paper_status sheet_config_decode(struct event_reader *r,
                                      struct paper_sheet_config *config);
void sheet_config_scale(struct paper_sheet_config *config, const struct event_scaling *scaling);
void sheet_air_encode(struct event_bytes *b, const struct paper_air *air);
void sheet_air_decode(struct event_reader *r, struct paper_air *air);

#endif
