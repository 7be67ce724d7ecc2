/* midi_status.h - what can go wrong with MIDI bytes, files, devices and servers, and where the detail of it is found.
 *
 * Functions that can fail return a status; midi_error() then has one line: what, where, what to do.
 * Threads: any; the detail belongs to the thread that failed. */
#ifndef LUTETIA_MIDI_STATUS_H
#define LUTETIA_MIDI_STATUS_H

enum midi_status {
    MIDI_OK = 0,
    MIDI_BAD_ARGUMENT, /* a text, a number or a message that means nothing */
    MIDI_BAD_FILE,     /* not a Standard MIDI File, or a damaged one */
    MIDI_IO_FAILED,    /* the system's reason is in midi_error() */
    MIDI_NO_MEMORY,
    MIDI_NO_DEVICE, /* it is not there, or this build has no such kind */
    MIDI_NO_SERVER, /* none answers at that address */
    MIDI_REFUSED    /* the other side said no, and why */
};

/* Detail of this thread's last failure, one line without a newline. Owns: the library; valid until the next failure. */
const char *midi_error(void);

#endif
