/* leds.h - what the files about lights share: the recording. */
#ifndef PARIS_LEDS_H
#define PARIS_LEDS_H

#include "paris_internal.h"

/* LUTETIA_LEDS is set, and nothing has gone wrong with the file that it names. */
bool leds_recording(void);
/* Adds a frame; says what is wrong, once. */
void leds_record(const uint8_t lights[PARIS_LIGHTS_BYTES]);
/* LUTETIA_LEDS=window: where frames are written to, or -1; it has said why. */
int paris_lights_window_open(void);

#endif
