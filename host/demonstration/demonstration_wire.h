/* demonstration_wire.h - what a demonstration's process and who looks at it say to each other.
 *
 *     looks                                        the process (demonstration_main.c)
 *                                          <- CONTROL 0 "speed" 0..4, ...   once, at first
 *       POINTER, KEY, SET, ... , FRAME 7 (0.016 s)  ->  hears them, steps, draws
 *                                                  picture 7 -> one of two in shared memory
 *                              <- SAID "..."       what the script has printed, its last line
 *                              <- LINE "...", ...     what a program has printed, its last lines
 *                              <- SHOWN 7, which of the two
 *
 * Each is one packet of a socket that keeps packets apart (SOCK_SEQPACKET), checked as bytes
 * from outside are. Between SHOWN and the next FRAME the process writes into no picture, and
 * then into the other one; the number that stands before a picture is 0 while it is written. So
 * a picture that has the same number before and after it was copied is whole. */
#ifndef LUTETIA_DEMONSTRATION_WIRE_H
#define LUTETIA_DEMONSTRATION_WIRE_H

#include <control.h>

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum demonstration_kind {
    DEMONSTRATION_FRAME = 1, /* number, seconds */
    DEMONSTRATION_POINTER,   /* which: what it did; x, y, pressure */
    DEMONSTRATION_KEY,       /* text: its name */
    DEMONSTRATION_RELEASE,   /* text: the same key is up again */
    DEMONSTRATION_SET,       /* which: of the controls; value */
    DEMONSTRATION_SHOWN,     /* number; which: of the two pictures */
    DEMONSTRATION_SAID,      /* text */
    DEMONSTRATION_FAILED,    /* text: why it has ended */
    DEMONSTRATION_CONTROL,   /* which, from 0, in order; control */
    DEMONSTRATION_LINE,      /* text: a line that a program has printed */
    DEMONSTRATION_KINDS
};

enum demonstration_pointer {
    DEMONSTRATION_DOWN,
    DEMONSTRATION_MOVE,
    DEMONSTRATION_UP,
    DEMONSTRATION_POINTERS
};

/* With this begins why a program has ended that could not be compiled. */
#define DEMONSTRATION_UNCOMPILED "it was not compiled"

/* What the process has open beside the standard streams. */
enum { DEMONSTRATION_SOCKET = 3, DEMONSTRATION_PICTURES = 4 };

enum {
    DEMONSTRATION_TEXT_MAX = 600,
    DEMONSTRATION_KEY_MAX = 40,
    DEMONSTRATION_PACKET_MAX = DEMONSTRATION_TEXT_MAX + 1,
    DEMONSTRATION_SIDE_MIN = 16,
    DEMONSTRATION_SIDE_MAX = 1600,
    DEMONSTRATION_CONTROLS_MAX = 12,
    DEMONSTRATION_NAME_MAX = 40, /* of a control's name, of its unit, of its other texts */
    DEMONSTRATION_UNIT_MAX = 20,
    DEMONSTRATION_NOTE_MAX = 200
};

/* A number that a slider sets: least < most, and usual and value are between them. */
struct demonstration_control {
    char name[DEMONSTRATION_NAME_MAX + 1], unit[DEMONSTRATION_UNIT_MAX + 1],
        choices[DEMONSTRATION_NOTE_MAX + 1] /* with blanks between them */,
        does[DEMONSTRATION_NOTE_MAX + 1];
    double least, most, usual, value;
    enum control_curve curve;
};

struct demonstration_message {
    enum demonstration_kind kind;
    uint32_t number; /* from 1 */
    int which;
    double seconds, x, y, pressure; /* 0..1 s; within a million; 0..1 */
    double value;                   /* within a milliard */
    struct demonstration_control control;
    char text[DEMONSTRATION_TEXT_MAX + 1]; /* a line of UTF-8 */
};

/* The packet's length. A text that is too long is cut off. */
size_t demonstration_message_write(const struct demonstration_message *message,
                                   uint8_t packet[DEMONSTRATION_PACKET_MAX]);
/* False: these bytes are no message that may go that way. to_process: from who looks. */
bool demonstration_message_read(const uint8_t *packet, size_t bytes, bool to_process,
                                struct demonstration_message *message);

/* The shared memory: this, then both pictures, 3 bytes a pixel. */
struct demonstration_memory {
    _Atomic uint32_t number[2]; /* of each picture; 0: it is being written, or none yet */
    uint32_t reserved[14];
};
size_t demonstration_picture_bytes(int width_px, int height_px);
size_t demonstration_memory_bytes(int width_px, int height_px);

#endif
