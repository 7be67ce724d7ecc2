/* session.h - the actions on a stage, each with its step: recorded, written as text, and
 * repeated to the bit.
 *
 *     stage_session_save(stage, "word.session");            // after an hour of play
 *     ...a stage that began as that one did...
 *     stage_session_replay(again, "word.session");          // before its first frame
 *     stage_film(again, &film);                             // the same motion, drawn exactly
 *
 * A session has a line for each action; the number is that of steps made before it:
 *
 *     session 1
 *     begin 51ab7e0fd0c94c22                   of the actor as it began: actor.h
 *     412 mark
 *     412 hand down 0.25 2.5 0.23 0 0 1        what, x, y, how far is near, pressure, button,
 *                                              modifiers
 *     415 hand move 0.5 2.75 0.23 0 0 1
 *     430 hand up 0.5 2.75 0.23 0 0 1
 *     500 set gravity 3.7
 *     540 load 8a1c0f3e55d2b790 word.springs   the file's digest, and its name
 *     560 text other words                     the rest of the line: \n is a line's end, \\ a
 *                                              backslash
 *     612 undo                                 and mark, drop (a mark), reset, hand cancel
 *     end 900                                  the steps that were made in all (earlier
 *                                              sessions lack the number)
 *
 * Time is in steps, so pauses and slow motion do not matter. A loaded file is not part of the
 * session: it must be where it was, seen from the working folder, and have the same bytes, or
 * the session is refused when it is read. What it began with (words, their font, a network, a
 * script) must be the same, too, or its first frame fails; other controls may be set.
 */
#ifndef LUTETIA_STAGE_SESSION_H
#define LUTETIA_STAGE_SESSION_H

#include "actor.h"

#include <stdint.h>
#include <stdio.h>

enum stage_deed_kind {
    STAGE_DEED_HAND,
    STAGE_DEED_SET,
    STAGE_DEED_LOAD,
    STAGE_DEED_TEXT,
    STAGE_DEED_MARK,
    STAGE_DEED_DROP,
    STAGE_DEED_UNDO,
    STAGE_DEED_RESET
};

struct stage_deed {
    int64_t step; /* the number of steps made before it */
    enum stage_deed_kind kind;
    struct stage_event event; /* HAND */
    int control;              /* SET: the row of the stage's table */
    double value;
    int file; /* LOAD: of the session's files; TEXT: of its texts */
    int line; /* of a session that was read */
};

/* FNV-1a: continues a digest with more bytes. */
#define STAGE_DIGEST_NONE 0xcbf29ce484222325u
uint64_t stage_digest(uint64_t digest, const void *bytes, size_t count);

/* A file that was loaded. */
struct stage_file {
    char *path;
    uint64_t digest;
};

enum { STAGE_DEEDS_MAX = 1 << 22, STAGE_SESSION_MARKS_MAX = 64, STAGE_TEXT_BYTES = 1000 };

/* All zeros is an empty session. */
struct stage_session {
    struct stage_deed *deeds;
    int count, capacity;
    struct stage_file *files;
    int files_count, files_capacity;
    char **texts;
    int texts_count, texts_capacity;
    uint64_t begin;     /* the actor's digest; 0: unknown */
    int64_t end;        /* the number of steps in all; 0: unknown */
    const char *broken; /* why it cannot be saved; NULL: it can */
};

void stage_session_finish(struct stage_session *session); /* frees; zeros it */

/* If memory is short the session is marked broken. */
void stage_session_add(struct stage_session *session, const struct stage_deed *deed);

/* An action's line. rows: the controls' names. */
void stage_session_deed_print(const struct stage_session *session,
                              const struct stage_deed *deed, const struct control *rows,
                              FILE *to);
/* Writes all of it. Errors: BAD_FILE, BAD_ARGUMENT (broken). */
enum stage_status stage_session_write(const struct stage_session *session,
                                      const struct control *rows, const char *path);

/* How long a session takes that begins with this rate, of steps of this length: rates that are
 * set, undone and reset count. Without a known end it is that of the last action. rate_control:
 * the rate's row. */
double stage_session_seconds(const struct stage_session *session, double rate, double step_s,
                             int rate_control);

/* Adds that a file is loaded, with its present digest. If that fails the session is marked
 * broken. */
void stage_session_add_load(struct stage_session *session, int64_t step, const char *path);

/* Adds that there are other words, of STAGE_TEXT_BYTES at most. */
void stage_session_add_text(struct stage_session *session, int64_t step, const char *words);

/* Checks that a loaded file is what it was. name, line: of the session, for the error. Errors:
 * BAD_FILE (it is not there, or is another). */
enum stage_status stage_session_file_check(const struct stage_file *file, const char *name,
                                           int line);

/* Errors: BAD_FILE, with the file's name and the line, also if a loaded file is not there or
 * has changed; NO_MEMORY. *out is then empty. */
enum stage_status stage_session_read(const char *path, const struct control *rows,
                                     int rows_count, struct stage_session *out);
/* The same for a text in memory, without a look at loaded files; name: used in errors. */
enum stage_status stage_session_parse(const char *text, size_t bytes, const char *name,
                                      const struct control *rows, int rows_count,
                                      struct stage_session *out);

#endif
