/* jail.h - a process that runs code which nobody has read: it reaches the files that it is
 * given, and no others.
 *
 *     static const char *const reads[] = {"/usr", "/lib", NULL};
 *     struct jail jail = {.reads = reads, .writes = folder, .cpu_seconds = 20, ...};
 *     if (fork() == 0) {
 *         if (!jail_enter(&jail))
 *             _exit(127);
 *         execv(program, arguments);
 *     }
 *
 * Files are kept from it by Landlock, calls of the system by seccomp; both stay for good, in
 * all that it starts. It asks whether files exist, and how large they are, of any name: neither
 * of the two hides that. It has no network, no other process to talk to, no shared memory but
 * what it has open, and cannot change the rights, the names or the times of files elsewhere.
 *
 * Unlike confine.h, which is for code of ours that reads bytes, this lets a whole program be
 * loaded. */
#ifndef LUTETIA_JAIL_H
#define LUTETIA_JAIL_H

#include <stdbool.h>

struct jail {
    const char *const *reads; /* folders and files that may be read and executed, up to NULL;
                               * what is not there is passed over */
    const char *writes;       /* a folder in which files may be made, too; NULL: none */
    bool starts;              /* it may start processes; else threads alone */
    unsigned cpu_seconds;     /* of each process; 0: any number */
    unsigned long long memory_bytes, file_bytes; /* of each process, of each file; 0: any */
    unsigned files;                              /* open at a time */
};

/* Whether this system has Landlock (Linux 5.13) and seccomp. */
bool jail_possible(void);
/* In a child, before it executes a program. False: not all of it could be done, and the child
 * is to end. */
bool jail_enter(const struct jail *jail);

#endif
