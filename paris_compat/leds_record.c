/* LUTETIA_LEDS=FILE: each state of the lights is appended to FILE at once. So the file of a
 * program that crashes is complete up to its last latch, and a pipe shows the present state.
 *
 *     "lutetia leds 1 4096\n"                             once, when the first frame is written
 *     microseconds since then, 8 bytes, lowest first      each frame: 520 bytes
 *     512 bytes of lights: light l is bit l mod 8 of byte l div 8
 *
 * `lutetia leds FILE` makes pictures of it. LUTETIA_LEDS=window: the file is a pipe to
 * `lutetia leds` (leds_window.c); a file of that name is ./window.
 */
#include <growing_file.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "leds.h"
#include "paris_state.h"

static int file = -1;
static bool failed;
static struct timespec began;

bool leds_recording(void)
{
    const char *name = getenv("LUTETIA_LEDS");
    return name && *name && !failed;
}

static void fail(const char *what)
{
    int error = errno;
    failed = true; /* so that an error handler is called once */
    paris_fail("LUTETIA_LEDS: cannot %s %.200s: %s; name a file that can be written", what,
               getenv("LUTETIA_LEDS"), strerror(error));
}

static bool bytes_write(const void *bytes, size_t count)
{
    const char *at = bytes;
    while (count > 0) {
        ssize_t done = write(file, at, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0) {
            fail("write to");
            return false;
        }
        at += done;
        count -= (size_t)done;
    }
    return true;
}

static bool file_open(void)
{
    static const char line[] = "lutetia leds 1 4096\n";
    if (file >= 0)
        return true;
    if (strcmp(getenv("LUTETIA_LEDS"), "window") == 0) {
        failed = true; /* set while opening: an error handler may not return */
        file = paris_lights_window_open();
        failed = file < 0;
    } else {
        file = growing_file_open(getenv("LUTETIA_LEDS"));
        if (file < 0)
            fail("open");
    }
    if (file < 0)
        return false;
    clock_gettime(CLOCK_MONOTONIC, &began);
    return bytes_write(line, sizeof line - 1);
}

void leds_record(const uint8_t lights[PARIS_LIGHTS_BYTES])
{
    if (!file_open())
        return;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    uint64_t us = (uint64_t)(now.tv_sec - began.tv_sec) * 1000000 +
                  (uint64_t)(now.tv_nsec / 1000) - (uint64_t)(began.tv_nsec / 1000);
    uint8_t frame[8 + PARIS_LIGHTS_BYTES];
    for (int i = 0; i < 8; i++)
        frame[i] = (uint8_t)(us >> 8 * i);
    memcpy(frame + 8, lights, PARIS_LIGHTS_BYTES);
    bytes_write(frame, sizeof frame); /* one write, so that a frame is complete or missing */
}
