/* server_log.h - what the server tells while it runs: a line for each event, and no more than
 * its reader can keep.
 *
 * A plug that makes bad contact comes and goes ten times a second, for years. After LOG_AT_ONCE
 * lines in a row there is one in LOG_EVERY_S seconds, and the next line tells how many were
 * left out: some 700 KB a day at most.
 */
#ifndef LUTETIA_MIDI_SERVER_LOG_H
#define LUTETIA_MIDI_SERVER_LOG_H

#include <stdint.h>

enum { LOG_AT_ONCE = 100, LOG_EVERY_S = 10, LOG_LINE_BYTES = 400 };

struct server_log {
    void (*line)(void *context, const char *line);
    void *context;
    uint64_t
        paid_ns; /* each line takes LOG_EVERY_S of a time that may be LOG_AT_ONCE lines ahead */
    uint32_t left_out;
};

/* line NULL: nothing is told. */
void log_begin(struct server_log *log, void (*line)(void *context, const char *line),
               void *context);
__attribute__((format(printf, 2, 3))) void log_tell(struct server_log *log, const char *format,
                                                    ...);
/* The same at a time given. */
__attribute__((format(printf, 3, 4))) void log_tell_at(struct server_log *log, uint64_t now_ns,
                                                       const char *format, ...);

#endif
