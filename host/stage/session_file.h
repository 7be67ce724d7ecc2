/* session_file.h - a session in a file that grows as it happens, so that a program that is
 * killed leaves it.
 *
 *     struct stage_session_file *file;
 *     if (stage_session_file_open("play.session", &file) != STAGE_OK)
 *         return fail(stage_error());
 *     for (...) { // each frame
 *         stage_session_file_add(file, &session, rows, steps_count);
 *     }
 *     session.end = steps_count;
 *     if (stage_session_file_close(file, &session, rows) != STAGE_OK)
 *         return fail(stage_error());
 *
 * The file takes its name with the first frame and is a whole session after each
 * (growing_file.h): the last line is always `end`. A thread brings it to the disk once a second
 * where it has grown, for that can take longer than a picture. */
#ifndef LUTETIA_STAGE_SESSION_FILE_H
#define LUTETIA_STAGE_SESSION_FILE_H

#include "session.h"

struct stage_session_file;

/* Errors: BAD_FILE (it cannot be written there), NO_MEMORY. Owns: the caller closes *out. */
enum stage_status stage_session_file_open(const char *path, struct stage_session_file **out);

/* Adds what is new in the session, whose begin is known, up to now. rows: the controls' names.
 * Where that fails (a full disk) what was there before is there again, and
 * stage_session_file_said() says so; closing tries to write all of it. */
void stage_session_file_add(struct stage_session_file *file,
                            const struct stage_session *session, const struct control *rows,
                            int64_t step);
/* A line for whoever plays, once; NULL: there is none. */
const char *stage_session_file_said(struct stage_session_file *file);

/* Ends the file with the session's end. NULL session: as it is. Errors: BAD_FILE; BAD_ARGUMENT
 * (the session is broken: the file has what came before). */
enum stage_status stage_session_file_close(struct stage_session_file *file,
                                           const struct stage_session *session,
                                           const struct control *rows);

#endif
