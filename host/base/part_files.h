/* part_files.h - names of files that must be gone when a signal ends the process.
 *
 *     // before the file is made
 *     int noted = part_file_note(folder, ".page.png.0123456789abcdef.part");
 *     ...
 *     // it has its own name, or is removed
 *     part_file_forget(noted);
 *
 * While names are noted, each signal that would end the process by default (SIGINT, SIGTERM,
 * SIGHUP, a crash) is caught: the names are removed, and the signal ends the process as it
 * would have. Signals that the program handles or ignores are left alone; a program whose
 * handler ends it at once calls part_files_die() there. Forked children remove nothing. After
 * SIGKILL the names stay: output_file_sweep() removes them.
 *
 * Threads: any. */
#ifndef LUTETIA_PART_FILES_H
#define LUTETIA_PART_FILES_H

/* Notes a name within a folder, whose descriptor stays open until the name is forgotten.
 * Returns its number, from 1 on; 0: there are too many, or the name is too long, and it stays
 * after a signal. */
int part_file_note(int folder, const char *name);

/* 0 is fine. */
void part_file_forget(int number);

/* Catches those signals from now on, as long as the process lives, and not only while names are
 * noted: called first in main(). Libraries that catch signals (a driver's compiler) then pass
 * them on to us; else they would be asked first, and we not at all. */
void part_files_catch(void);

/* The handler: removes the names, and ends the process by the signal. May be called in
 * handlers. */
void part_files_die(int signal_number);

#endif
