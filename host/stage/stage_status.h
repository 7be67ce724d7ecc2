/* stage_status.h - the stage's errors.
 *
 *     if (stage_theme_open("dark", &theme) != STAGE_OK)
 *         die(stage_error());
 *
 * Threads. stage_error() belongs to the thread that failed.
 */
#ifndef LUTETIA_STAGE_STATUS_H
#define LUTETIA_STAGE_STATUS_H

enum stage_status {
    STAGE_OK = 0,
    STAGE_BAD_ARGUMENT, /* a name, number or size that is invalid */
    STAGE_BAD_FILE,     /* a file that cannot be read, or is malformed */
    STAGE_NO_DISPLAY,   /* no window, or no OpenGL */
    STAGE_NO_MEMORY,
    STAGE_FAILED /* an actor, a font or a picture failed */
};

/* Detail of this thread's last failure, one line; "" if there was none.
 * Owns: the library; valid until this thread's next failure. */
const char *stage_error(void);

/* For the stage and its actors: keeps the message and returns the status. */
enum stage_status stage_fail(enum stage_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
