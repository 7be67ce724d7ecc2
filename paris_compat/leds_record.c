/* The recording of the lights (recording.h):
 *
 *     "lutetia leds 1 4096\n"                             once
 *     microseconds since then, 8 bytes, lowest first      each frame: 520 bytes
 *     512 bytes of lights: light l is bit l mod 8 of byte l div 8
 *
 * `lutetia leds FILE` makes pictures of it. */
#include <string.h>

#include "leds.h"
#include "recording.h"

static void finish(void);
static struct paris_recording lights_recording = {.variable = "LUTETIA_LEDS",
                                                  .verb = "leds",
                                                  .line = "lutetia leds 1 4096\n",
                                                  .finish = finish};

static void finish(void)
{
    paris_recording_finish(&lights_recording);
}

bool leds_recording(void)
{
    return paris_recording_wanted(&lights_recording);
}

void leds_record(const uint8_t lights[PARIS_LIGHTS_BYTES])
{
    uint8_t frame[8 + PARIS_LIGHTS_BYTES];
    const uint64_t us = paris_recording_us(&lights_recording);
    for (int i = 0; i < 8; i++)
        frame[i] = (uint8_t)(us >> 8 * i);
    memcpy(frame + 8, lights, PARIS_LIGHTS_BYTES);
    if (leds_recording())
        paris_recording_add(&lights_recording, frame, sizeof frame);
}
