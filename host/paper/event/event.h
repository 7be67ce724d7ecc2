/* event.h - what is done to a sheet, as data: each operation is a row of one table.
 *
 * A public operation says sheet_event(p, SHEET_EVENT_PUT, &arguments).  The row of its kind says how the arguments are checked and
 * performed, and of what members their struct consists (arguments/members.h); from the members follow their ranges, how it is kept as
 * bytes (history.h), read back from a file, and brought to another resolution.  So a new operation is a struct, the rows of its
 * members, its functions and a row:
 *
 *     struct event_salt { int grains_count; const double *grains; double strength; };
 *     enum paper_status paper_sheet_salt(struct paper_sheet *p, const struct event_salt *salt)
 *     {
 *         return sheet_event(p, SHEET_EVENT_SALT, salt);
 *     }
 *
 * What it does must follow from the sheet and from these arguments alone: chance comes from a seed among them. */
#ifndef LUTETIA_PAPER_EVENT_H
#define LUTETIA_PAPER_EVENT_H

#include "arguments/arguments.h"
#include "base/base.h"

struct members;

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
    SHEET_EVENT_KINDS
};

const char *event_name(enum sheet_event_kind kind);
/* By name; -1: none. */
int event_find(const char *name, size_t length);
const struct members *event_members(enum sheet_event_kind kind);
/* Arguments that are all 0, and theirs what they will point to. NULL: no memory. */
void *event_blank(enum sheet_event_kind kind);
enum paper_status event_check(const struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments);
enum paper_status event_perform(struct paper_sheet *p, enum sheet_event_kind kind,
                                const void *arguments);

/* ---- as bytes ---- */

struct event_bytes {
    uint8_t *at;
    size_t count, room;
    bool short_of_memory;
};

struct event_reader {
    const uint8_t *at, *end;
    bool bad; /* it did not hold what was asked for; what was read is zeros */
};

void event_put_bytes(struct event_bytes *b, const void *bytes, size_t count);
void event_put_number(struct event_bytes *b, uint64_t number, int bytes); /* low byte first */
void event_put_double(struct event_bytes *b, double number);
uint64_t event_get_number(struct event_reader *r, int bytes);
double event_get_double(struct event_reader *r);
const uint8_t *event_get_bytes(struct event_reader *r, size_t count); /* NULL: bad */

/* Appends the arguments, of a sheet of that size; what of a screen lies outside of the sheet is left out. */
void event_encode(struct event_bytes *b, const struct paper_sheet_config *config,
                  enum sheet_event_kind kind, const void *arguments);
/* Errors: BAD_FILE, NO_MEMORY; *arguments is then NULL. Owns: the caller frees *arguments by event_free(). NULL is fine as
 * arguments of kinds that have none. */
enum paper_status event_decode(const uint8_t *bytes, size_t count,
                               const struct paper_sheet_config *config,
                               enum sheet_event_kind kind, void **arguments);
void event_free(enum sheet_event_kind kind, void *arguments);
/* Bytes of its arguments, of kinds that have only numbers, flags and text. */
size_t event_size(enum sheet_event_kind kind);

void event_config_encode(struct event_bytes *b, const struct paper_sheet_config *config);
enum paper_status event_config_decode(struct event_reader *r,
                                      struct paper_sheet_config *config);
void event_air_encode(struct event_bytes *b, const struct paper_air *air);
void event_air_decode(struct event_reader *r, struct paper_air *air);

/* ---- at another resolution ---- */

struct event_scaling {
    double length;             /* fibers for one */
    double pace;               /* steps for one */
    int width, height;         /* of the sheet that the event was for */
    int new_width, new_height; /* and of the one that it is for now */
};
/* Errors: NO_MEMORY. */
enum paper_status event_scale(enum sheet_event_kind kind, void *arguments,
                              const struct event_scaling *scaling);
void event_config_scale(struct paper_sheet_config *config, const struct event_scaling *scaling);

#endif
