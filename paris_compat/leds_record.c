/* LUTETIA_LEDS=FILE: each state of the lights is appended to FILE at once (growing_file.h). So the file of a
 * program that crashes is complete up to its last latch, and a pipe shows the present state. If a state cannot be appended, what was
 * there before the program is there again.
 *
 *     "lutetia leds 1 4096\n"                             once, when the first frame is written
 *     microseconds since then, 8 bytes, lowest first      each frame: 520 bytes
 *     512 bytes of lights: light l is bit l mod 8 of byte l div 8
 *
 * `lutetia leds FILE` makes pictures of it. LUTETIA_LEDS=window: the file is a pipe to
 * `lutetia leds` (leds_window.c); a file of that name is ./window.
 */
#include <exit_status.h>
#include <growing_file.h>
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "leds.h"
#include "paris_state.h"

static struct growing_file file;
static bool failed;
static struct timespec began;

bool leds_recording(void)
{
    const char *name = getenv("LUTETIA_LEDS");
    return name && *name && !failed;
}

static void fail(const char *what)
{
    failed = true; /* so that an error handler is called once */
    exit_status_fail();
    paris_fail("LUTETIA_LEDS: cannot %s %.200s: %s", what, getenv("LUTETIA_LEDS"), file.why);
}

/* When the program ends. */
static void file_close(void)
{
    if (!growing_file_close(&file)) {
        visible_say("LUTETIA_LEDS: cannot write to the recording: %s", file.why);
        exit_status_fail();
    }
}

static bool file_open(void)
{
    if (file.is_open)
        return true;
    if (strcmp(getenv("LUTETIA_LEDS"), "window") == 0) {
        failed = true; /* set while opening: an error handler may not return */
        const int pipe = paris_lights_window_open();
        failed = pipe < 0;
        if (failed)
            return false;
        growing_file_of_pipe(&file, pipe);
    } else if (!growing_file_open(&file, getenv("LUTETIA_LEDS"))) {
        fail("open");
        return false;
    }
    atexit(file_close);
    clock_gettime(CLOCK_MONOTONIC, &began);
    return true;
}

void leds_record(const uint8_t lights[PARIS_LIGHTS_BYTES])
{
    static const char line[] = "lutetia leds 1 4096\n";
    enum { LINE_BYTES = sizeof line - 1, FRAME_BYTES = 8 + PARIS_LIGHTS_BYTES };
    uint8_t piece[LINE_BYTES + FRAME_BYTES], *frame = piece + LINE_BYTES;
    const bool first = !file.is_open;
    struct timespec now;
    if (!file_open())
        return;
    clock_gettime(CLOCK_MONOTONIC, &now);
    uint64_t us = (uint64_t)(now.tv_sec - began.tv_sec) * 1000000 +
                  (uint64_t)(now.tv_nsec / 1000) - (uint64_t)(began.tv_nsec / 1000);
    memcpy(piece, line, LINE_BYTES);
    for (int i = 0; i < 8; i++)
        frame[i] = (uint8_t)(us >> 8 * i);
    memcpy(frame + 8, lights, PARIS_LIGHTS_BYTES);
    /* one write, so that a frame is complete or missing */
    if (!growing_file_append(&file, first ? piece : frame,
                             first ? sizeof piece : (size_t)FRAME_BYTES, NULL, 0))
        fail("write to");
}
