/* session.h - what was done on a stage, at which step: kept as it happens, written as text, and done again to the bit.
 *
 *     stage_session_save(stage, "word.session");            // after an hour of play
 *     ...a stage that began as that one did...
 *     stage_session_replay(again, "word.session");          // before its first frame
 *     stage_film(again, &film);                             // the same motion, drawn exactly
 *
 * A session is a line for each thing that was done; the number is how many steps had been made by then:
 *
 *     session 1
 *     412 mark
 *     412 hand down 0.25 2.5 0.23 0 0 1        what, x, y, how far is near, pressure, button, modifiers
 *     415 hand move 0.5 2.75 0.23 0 0 1
 *     430 hand up 0.5 2.75 0.23 0 0 1
 *     500 set gravity 3.7
 *     612 undo                                 and mark, drop (a mark), reset, hand cancel
 *     end
 *
 * Time is in steps, so stopping is not seen and slow motion is what it was. What is loaded from files is not in it: a session
 * in which something was loaded cannot be saved. */
#ifndef LUTETIA_STAGE_SESSION_H
#define LUTETIA_STAGE_SESSION_H

#include "actor.h"

#include <stdint.h>

enum stage_deed_kind {
    STAGE_DEED_HAND,
    STAGE_DEED_SET,
    STAGE_DEED_MARK,
    STAGE_DEED_DROP,
    STAGE_DEED_UNDO,
    STAGE_DEED_RESET
};

struct stage_deed {
    int64_t step; /* how many steps had been made */
    enum stage_deed_kind kind;
    struct stage_event event; /* HAND */
    int control;              /* SET: the row of the stage's table */
    double value;
};

enum { STAGE_DEEDS_MAX = 1 << 22 };

/* All zeros is an empty session. */
struct stage_session {
    struct stage_deed *deeds;
    int count, capacity;
    const char *broken; /* why it cannot be saved; NULL: it can */
};

void stage_session_finish(struct stage_session *session); /* frees; zeros it */

/* Where there is no more room the session is broken. */
void stage_session_add(struct stage_session *session, const struct stage_deed *deed);

/* rows: what controls are called. Errors: BAD_FILE, BAD_ARGUMENT (broken). */
enum stage_status stage_session_write(const struct stage_session *session,
                                      const struct stage_control *rows, const char *path);

/* Errors: BAD_FILE, with the file's name and the line; NO_MEMORY. *out is then empty. */
enum stage_status stage_session_read(const char *path, const struct stage_control *rows,
                                     int rows_count, struct stage_session *out);
/* The same of a text in memory; name: what errors call it. */
enum stage_status stage_session_parse(const char *text, size_t bytes, const char *name,
                                      const struct stage_control *rows, int rows_count,
                                      struct stage_session *out);

#endif
