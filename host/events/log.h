/* log.h - a list of events that happened, as bytes: what undoing, saving and doing again walk through.
 *
 *     put   air   step x 300        blot
 *    +-----+-----+-----------------+------+
 *      0     1     2                 3       count 4
 *
 * Arguments of more than a few bytes are deflated where that saves much: masks are mostly empty. What happens in runs (steps) is one
 * record with a number. */
#ifndef LUTETIA_EVENTS_LOG_H
#define LUTETIA_EVENTS_LOG_H

#include "kinds.h"

struct event_record {
    int kind;       /* the module's number */
    int steps;      /* that it takes */
    uint8_t *bytes; /* arguments, deflated if stored < raw */
    size_t raw, stored;
    uint64_t digest; /* of the arguments; 0 in records that were read */
};

struct event_log { /* {0}: empty. Owns: event_log_free() */
    struct event_record *records;
    int count, room;
    double bytes; /* that it takes */
};

/* False: no memory. Owns: a log takes it over, or the caller frees it by event_record_free(). */
bool event_record_make(struct event_record *record, int number, const struct event_kind *kind,
                       const void *arguments, const void *context);
void event_record_free(struct event_record *record);
/* Of the arguments as they were before deflating. */
uint64_t event_record_digest(const struct event_record *record);
/* As event_decode(). */
enum event_decoded event_record_arguments(const struct event_record *record,
                                          const struct event_kind *kind, const void *context,
                                          void **arguments);
/* Whether a record's numbers, as a file has them, can be right: `raw` is at most `most` bytes. */
bool event_record_plausible(uint64_t raw, uint64_t stored, uint64_t most);

/* Takes the record over, also when it fails. False: no memory. */
bool event_log_append(struct event_log *log, struct event_record record);
/* Makes two records of one: the first takes `steps`, the second what is left. The second's arguments are the log's only where the
 * kind has none. False: no memory. */
bool event_log_split(struct event_log *log, int at, int steps);
/* Forgets records from `count` on. */
void event_log_cut(struct event_log *log, int count);
/* Moves the records from `count` on out of the log, into an array; log->bytes still counts them. False: no memory, nothing is
 * moved. Owns: the caller gives the array to event_log_put_back(). */
bool event_log_take_away(struct event_log *log, int count, struct event_record **out,
                         int *out_count);
/* Appends them again, and frees the array. False: no memory; they are gone. */
bool event_log_put_back(struct event_log *log, struct event_record *records, int count);
void event_log_free(struct event_log *log);

#endif
