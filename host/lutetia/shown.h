/* shown.h - where what is shown comes from: a program that runs, a recording, the standard
 * input.
 *
 *     struct shown shown = {.verb = "leds", .variable = "LUTETIA_LEDS", .line = LIGHT_RECORDING_LINE, .context = &leds, ...};
 *     status = shown_source(&shown, argc, argv);
 *
 * A program writes its recording into a pipe, which the variable names to its libparis. What
 * was read is passed to feed(). If `apart` is set, a thread of its own reads and feeds, with
 * the lock held, so that the program does not wait while a picture is drawn; whoever looks at
 * what feed() makes then holds the lock, too.
 *
 * LUTETIA_LEDS=window, LUTETIA_DISPLAY=window: libparis runs `lutetia VERB --window -` with
 * VARIABLE_PROGRAM="PID NAME" of the program that is watched. A byte on the standard output
 * then says that the window is ready, and closing the window interrupts that process. */
#ifndef LUTETIA_SHOWN_H
#define LUTETIA_SHOWN_H

#include <display.h>
#include <picture_room.h>

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

struct shown {
    const char *verb, *variable;
    const char *line; /* a recording begins so */
    void *context;
    bool (*go_on)(void *context);               /* false: stop reading, and end the program */
    void (*turn)(void *context, double wait_s); /* takes the window's events, or waits */
    void (*wake)(void); /* NULL, or ends a turn's wait, from another thread */
    bool (*has_window)(void *context);
    bool (*taken)(void *context); /* something has been shown */
    enum display_status (*feed)(void *context, const uint8_t *bytes, size_t count);
    enum display_status (*end)(void *context); /* the bytes have ended */
    bool apart;
    bool room_wanted;         /* pictures may lie in memory that is shared with the program */
    struct picture_room room; /* zeros: there is none */

    pid_t watched; /* the process that libparis watches by us; 0: none */
    char name[64]; /* the source's name, for the title */
    bool seen;     /* pieces come as the program runs: their times have really passed */
    uint64_t base_us,
        last_us; /* when the present one of several recordings begins; the last time */
    pthread_mutex_t lock;
};

/* Gets the source's name and the watched process. word: the program or the recording; "":
 * none. */
void shown_name(struct shown *shown, const char *word);
/* The file begins as a recording, or it cannot be executed: then reading it gives the error
 * message. */
bool shown_is_recording(const struct shown *shown, const char *path);
/* Shows what the command line names, to its end. Returns an exit status; what was wrong has
 * been printed. */
int shown_source(struct shown *shown, int argc, char **argv);
/* The time of a piece, from the first recording's beginning: several may follow each other,
 * each with times from 0 on. */
uint64_t shown_time_us(struct shown *shown, uint64_t time_us);
/* Whether a recording may have pictures up to that time, fps a second. A few bytes can say that
 * a thousand years have gone by: their times may ask for SHOWN_ANY pictures and SHOWN_EACH for
 * each of the `taken` pieces (of a `kind`: "light"), or for `most` if it is not 0; a program
 * that is seen to run, for any. False: it has been said. */
enum {
    SHOWN_ANY = 3000,
    SHOWN_EACH = 100,
    SHOWN_PICTURES_MOST = 999999 /* as names have digits for */
};
bool shown_times_good(const struct shown *shown, uint64_t until_us, double fps, int most,
                      uint64_t taken, const char *kind);
/* A window is ready: tells the watched program. False: it has gone. */
bool shown_ready(const struct shown *shown);
/* The window was closed: interrupts the watched program. */
void shown_interrupt(const struct shown *shown);

#endif
