/* midi_status.h - errors of MIDI bytes, files, devices and servers, and their messages.
 *
 * Errors: functions that can fail return a status; midi_error() then has one line: what, where,
 * what to do.
 *
 * Ownership: the message is the library's. Threads: any; the message belongs to the thread that
 * failed.
 */
#ifndef LUTETIA_MIDI_STATUS_H
#define LUTETIA_MIDI_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

enum midi_status {
    MIDI_OK = 0,
    MIDI_BAD_ARGUMENT, /* an invalid text, number or message */
    MIDI_BAD_FILE,     /* not a Standard MIDI File, or a damaged one */
    MIDI_IO_FAILED,    /* the system's reason is in midi_error() */
    MIDI_NO_MEMORY,
    MIDI_NO_DEVICE, /* the device is missing, or this build lacks its kind */
    MIDI_NO_SERVER, /* no server answers at that address */
    MIDI_REFUSED    /* the server refused; its reason is in midi_error() */
};

/* Detail of this thread's last failure, one line without a newline; never NULL. Owns: the
 * library; valid until the next failure. */
const char *midi_error(void);

#ifdef __cplusplus
}
#endif

#endif
