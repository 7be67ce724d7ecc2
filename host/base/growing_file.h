/* growing_file.h - writes a file piece by piece while the program runs: traces, recordings,
 * reports.
 *
 *     struct growing_file trace;
 *     if (!growing_file_open(&trace, getenv("LUTETIA_TRACE")))
 *         complain(trace.why);
 *     // the tail goes when the next piece comes
 *     if (!growing_file_append(&trace, event, event_bytes, "\n]\n", 3))
 *         complain(trace.why);
 *     growing_file_close(&trace);
 *
 * The file takes its name with the first piece, in one step (output_file.h), and grows under
 * it: whoever reads it meanwhile, or after the program was killed, finds whole pieces. What had
 * the name before is kept until the file is closed. If a piece cannot be written (a full disk),
 * the file goes, and what was there has its name again.
 *
 * A pipe or a device is written to itself, without the tail. Links are refused, but for the
 * system's names of open files: /dev/stderr, /dev/stdout, /dev/fd/N, /proc/PID/fd/N; where they
 * lead to a file, it is appended to. A pipe of another user's (and not root's) is refused, too.
 * Opening a pipe waits for its reader. */
#ifndef LUTETIA_GROWING_FILE_H
#define LUTETIA_GROWING_FILE_H

#include "output_file.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

struct growing_file {
    const char
        *why;  /* after a failure: what was wrong, and what to do where there is something */
    int error; /* after a failure: errno */
    bool is_open;
    /* private */
    struct output_file out; /* a file of ours */
    int descriptor;         /* else a pipe or a device, or what /dev/fd leads to; -1 */
    off_t end;              /* without the tail */
    pid_t owner;
    bool named;
};

/* False if it cannot be written; nothing is left to release. */
bool growing_file_open(struct growing_file *f, const char *path);

/* The same for a descriptor of a pipe, which belongs to the file then. */
void growing_file_of_pipe(struct growing_file *f, int descriptor);

/* Adds a piece, and behind it a tail that the next piece replaces (NULL, 0: none). False if
 * that failed, before or now: the file is closed, and what was there before is there again.
 * Forked children may add pieces without tails to their parent's file. */
bool growing_file_append(struct growing_file *f, const void *bytes, size_t count,
                         const char *tail, size_t tail_count);

/* Ends the file. False if it did not get onto the disk: then what was there before is there
 * again. A file without a piece does not appear. Does nothing to a file that is not open. In a
 * forked child its parent's file stays as it is. */
bool growing_file_close(struct growing_file *f);

#endif
