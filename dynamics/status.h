/* status.h - the simulation's errors.
 *
 *     if (dyn_network_create(&network) != DYN_OK)
 *         die(dyn_error());
 *
 * Errors: a function that can fail returns a status; dyn_error() then has one line: what is
 * wrong, and where.
 *
 * Ownership: the message is the library's. Threads: any; the message belongs to the thread that
 * failed. */
#ifndef LUTETIA_DYN_STATUS_H
#define LUTETIA_DYN_STATUS_H

enum dyn_status {
    DYN_OK = 0,
    DYN_BAD_ARGUMENT, /* a number, name or index that is invalid */
    DYN_BAD_FILE,     /* a file that cannot be read or written, or is malformed */
    DYN_TOO_LARGE,    /* exceeds the limits in network.h */
    DYN_NO_MEMORY
};

/* Detail of this thread's last failure, one line; "" if there was none, never NULL.
 * Owns: the library; valid until this thread's next failure. */
const char *dyn_error(void);

#endif
