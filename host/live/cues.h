/* cues.h - a list of cues is played on a stage: other words, scenes, controls, at their times
 * or when somebody says go.
 *
 *     struct cues_def def = {.path = "evening.cues", .stage = stage};
 *     struct cues *cues;
 *     if (cues_open(&def, &cues) != STAGE_OK)
 *         die(stage_error());
 *     cues_frame(cues, now_s);                     // before each picture
 *     cues_go(cues);                               // a key was pressed
 *     cues_close(cues);
 *
 * The file is described in cues_file.h. A control that fades goes along its slider's way.
 *
 * Threads: the stage's.
 */
#ifndef LUTETIA_LIVE_CUES_H
#define LUTETIA_LIVE_CUES_H

#include <stage.h>

struct cues_def {
    const char *path;
    struct stage *stage; /* borrowed */
    bool is_film;        /* nobody says go: a file in which one waits is refused */
    /* Plays a scene; NULL, or why it cannot be. NULL: there are none, and a file with some is
     * refused. */
    const char *(*scene)(void *context, int number);
    void (*tell)(void *context, const char *text); /* a line: what could not be done */
    void *context;
};

struct cues;
/* Errors: BAD_FILE, with the line (also where it names a control that the stage has not, or a
 * value that it cannot have), NO_MEMORY. Owns: the caller closes *out. */
enum stage_status cues_open(const struct cues_def *def, struct cues **out);
void cues_close(struct cues *cues); /* NULL is fine */

/* Does what is due; now_s: from the beginning, never back. */
void cues_frame(struct cues *cues, double now_s);
/* The cue that waits, or the next one that will, is due: with the next frame. */
void cues_go(struct cues *cues);

#endif
