/* studio_played.h - the studio's window that is played recorded input, for tests: in a folder
 * of their own, which is also where sheets are kept that were not saved.
 *
 *     FILE *events = played_begin();
 *     fprintf(events, "0 down 0 0\n0.1 up 5 5\n0.2 picture %s\n0.3 close\n", played_path("seen.png"));
 *     fclose(events);
 *     played_run(NULL);
 *     assert_int_equal(played.status, 0);
 */
#ifndef LUTETIA_TEST_STUDIO_PLAYED_H
#define LUTETIA_TEST_STUDIO_PLAYED_H

#include <stdio.h>
#include <sys/types.h>

#include "../lutetia/child.h"

extern struct child played; /* the last one that was run */

/* Setup and teardown of a group: the folder. */
int played_folder_make(void **state);
int played_folder_remove(void **state);
/* A name in the folder; eight at a time. */
const char *played_path(const char *name);
/* The events of the next run. */
FILE *played_begin(void);
/* Runs the window with the events until they close it, on a new sheet of the scene's
 * (studio_scene.h). */
void played_run(const char *variable);
/* The same, on the sheet that was not saved. */
void played_again(void);
/* As played_run(), beside the test: its process. */
pid_t played_start(void);
/* The bytes of a file; the caller frees them. */
size_t played_file(const char *path, char **bytes);
void played_files_same(const char *path, const char *other);
/* What the script makes is the picture. */
void played_script_is(const char *script, const char *made, const char *picture);
/* The journal of the only sheet that was not saved; false: there is none. */
bool played_journal(char *path, size_t room);

#endif
