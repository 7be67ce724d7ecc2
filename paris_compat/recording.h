/* recording.h - what a program shows, piece by piece in a file or a pipe: the lights
 * (LUTETIA_LEDS), the frame buffer (LUTETIA_DISPLAY).
 *
 *     static struct paris_recording lights = {.variable = "LUTETIA_LEDS", .verb = "leds", .line = "lutetia leds 1 4096\n"};
 *     if (paris_recording_wanted(&lights))
 *         paris_recording_add(&lights, frame, sizeof frame);
 *
 * The variable names a file, to which each piece is appended at once (growing_file.h), or says
 * `window`: then the file is a pipe to `lutetia VERB` (viewer.c). A file of that name is
 * ./window. So the file of a program that crashes is complete up to its last piece, and a pipe
 * shows the present state. If a piece cannot be appended, what was there before the program is
 * there again. */
#ifndef PARIS_RECORDING_H
#define PARIS_RECORDING_H

#include <growing_file.h>
#include <picture_room.h>

#include <stdbool.h>
#include <stdint.h>
#include <time.h>

struct paris_recording {
    const char *variable, *verb;
    const char *line;     /* what the file begins with */
    void (*finish)(void); /* paris_recording_finish() of it, when the program ends */
    bool room_wanted;     /* for pictures, in memory that is shared with a window */
    struct growing_file file;
    struct picture_room room; /* zeros: there is none */
    bool failed, begun;
    struct timespec began;
};

/* Whether the variable is set, and its file has not failed. */
bool paris_recording_wanted(const struct paris_recording *r);
/* Appends a piece, after the first line where it is the first. Says once what failed. */
void paris_recording_add(struct paris_recording *r, const void *piece, size_t bytes);
/* Microseconds since the file was opened, which the first call does. */
uint64_t paris_recording_us(struct paris_recording *r);
/* When the program ends. */
void paris_recording_finish(struct paris_recording *r);

/* The descriptor for pieces, or -1; the error has been reported. */
int paris_viewer_open(struct paris_recording *of);

#endif
