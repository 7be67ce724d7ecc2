/* exit_status.h - a failure that shows in the exit status, though the program goes on: a trace
 * that is lost on a full disk.
 *
 *     if (!growing_file_append(...)) {
 *         fprintf(stderr, ...);
 *         exit_status_fail();
 *     } */
#ifndef LUTETIA_EXIT_STATUS_H
#define LUTETIA_EXIT_STATUS_H

/* If the process ends by exit(0), or by a return of 0 from main(), its status is EXIT_FAILURE
 * from now on. Other statuses stay, and those of forked children. May be called while the
 * process exits. Threads: any. */
void exit_status_fail(void);

#endif
