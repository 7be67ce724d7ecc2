/* log.h - the list of events that happened, as bytes. Undo, redo and saving walk through this
 * list.
 *
 *     put   air   step x 300        blot
 *    +-----+-----+-----------------+------+
 *      0     1     2                 3       count 4
 *
 * Arguments of more than a few bytes are deflated if that saves much: masks are mostly
 * empty. Repeated events (steps) are one record with a count.
 */
#ifndef LUTETIA_EVENTS_LOG_H
#define LUTETIA_EVENTS_LOG_H

#include "kinds.h"

struct event_record {
    int kind;       /* the module's number of the kind */
    int steps;      /* that it takes */
    uint8_t *bytes; /* the arguments, deflated if stored < raw */
    size_t raw, stored;
    uint64_t digest; /* digest of the arguments; 0 in records that were read from a file */
};

struct event_log { /* {0}: empty. Owns: event_log_free() */
    struct event_record *records;
    int count, room;
    double bytes; /* that it takes */
};

/* False: no memory. Owns: a log takes it over, or the caller frees it by
 * event_record_free(). */
bool event_record_make(struct event_record *record, int number, const struct event_kind *kind,
                       const void *arguments, const void *context);
void event_record_free(struct event_record *record);
/* The digest of the arguments before deflating. */
uint64_t event_record_digest(const struct event_record *record);
/* As event_decode(). */
enum event_decoded event_record_arguments(const struct event_record *record,
                                          const struct event_kind *kind, const void *context,
                                          void **arguments);
/* Checks a record's numbers as read from a file: `raw` is at most `most` bytes. */
bool event_record_plausible(uint64_t raw, uint64_t stored, uint64_t most);

/* Takes ownership of the record, also on failure. False: no memory. */
bool event_log_append(struct event_log *log, struct event_record record);
/* Splits a record: the first part takes `steps`, the second the rest. Only the arguments of
 * kinds without any may be split so: the second part has none. False: no memory. */
bool event_log_split(struct event_log *log, int at, int steps);
/* Undoes a split: records at - 1 and at, the second of which has no arguments, are one
 * again. */
void event_log_join(struct event_log *log, int at);
/* Removes the records from `count` on. */
void event_log_cut(struct event_log *log, int count);
/* Removes `count` records from `at` on; those behind them move up. */
void event_log_remove(struct event_log *log, int at, int count);
/* Moves the records from `count` on out of the log into an array; log->bytes still counts
 * them. False: no memory; nothing is moved. Owns: the caller gives the array to
 * event_log_put_back(). */
bool event_log_take_away(struct event_log *log, int count, struct event_record **out,
                         int *out_count);
/* Appends the records again, and frees the array. False: no memory; the records are lost. */
bool event_log_put_back(struct event_log *log, struct event_record *records, int count);
void event_log_free(struct event_log *log);

#endif
