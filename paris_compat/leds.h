/* leds.h - the recording of the lights, shared by the files about them. */
#ifndef PARIS_LEDS_H
#define PARIS_LEDS_H

#include "paris_internal.h"

/* Whether LUTETIA_LEDS is set, and its file has not failed. */
bool leds_recording(void);
/* Adds a frame; prints an error once. */
void leds_record(const uint8_t lights[PARIS_LIGHTS_BYTES]);

#endif
