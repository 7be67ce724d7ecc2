/* light_recording.h - reads what libparis writes where LUTETIA_LEDS is set: the states of the
 * machine's lights, one after the other.
 *
 *     struct light_reader reader = {.take = draw, .context = &picture};
 *     while ((count = fread(bytes, 1, sizeof bytes, file)) > 0)
 *         if (light_reader_feed(&reader, bytes, count) != DISPLAY_OK)
 *             die(display_error());
 *     if (light_reader_end(&reader) != DISPLAY_OK)
 *         die(display_error());
 *
 * A recording is the line "lutetia leds 1 4096\n" and then frames of 520 bytes: the
 * microseconds since the program's first latch, 8 bytes, lowest first; and 512 bytes of lights,
 * light l in bit l mod 8 of byte l div 8. Where a frame could begin the line may come again:
 * recordings one behind the other are one (the times begin anew).  The reader is fed pieces of
 * any size, from a file or a pipe. */
#ifndef LUTETIA_LIGHT_RECORDING_H
#define LUTETIA_LIGHT_RECORDING_H

#include "display.h"

#define LIGHT_RECORDING_LINE "lutetia leds 1 4096\n"

enum {
    LIGHT_RECORDING_LINE_BYTES = sizeof LIGHT_RECORDING_LINE - 1,
    LIGHT_RECORDING_LIGHTS_BYTES = 512,
    LIGHT_RECORDING_FRAME_BYTES = 8 + LIGHT_RECORDING_LIGHTS_BYTES
};

struct light_frame {
    uint64_t time_us; /* since the recording's first frame */
    uint64_t number;  /* from 0 on */
    uint8_t lights[LIGHT_RECORDING_LIGHTS_BYTES];
};

struct light_reader {
    /* Receives each frame; returns 0 to stop. */
    int (*take)(void *context, const struct light_frame *frame);
    void *context;

    uint64_t frames; /* taken so far */
    uint64_t read;   /* bytes understood so far */
    uint8_t begun;   /* the first line has been read */
    uint8_t stopped; /* take() has stopped: the rest is ignored */
    size_t held;     /* bytes of an incomplete item */
    uint8_t bytes[LIGHT_RECORDING_FRAME_BYTES];
};

/* Errors: BAD_FILE if the bytes are no recording. */
enum display_status light_reader_feed(struct light_reader *reader, const uint8_t *bytes,
                                      size_t count);
/* Errors: BAD_FILE if the recording ends within a frame, or before the first line is
 * complete. */
enum display_status light_reader_end(const struct light_reader *reader);

#endif
