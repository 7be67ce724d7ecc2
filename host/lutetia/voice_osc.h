/* voice_osc.h - what is heard of a voice, by Open Sound Control, to other programs. */
#ifndef LUTETIA_VOICE_OSC_H
#define LUTETIA_VOICE_OSC_H

#include <osc_port.h>
#include <voice.h>

/* to: ADDRESS:PORT, or PORT of this computer. Exit statuses; what is wrong has been said. Owns:
 * the caller closes *out. */
int voice_osc_open(const char *to, struct osc_port **out);

/* Sends a frame as one bundle: what is lost on the way is lost together. Each feature is a
 * message of one number, the formants of two; /voice/attack, with the level, says where a sound
 * begins. */
void voice_osc_send(struct osc_port *port, const struct voice_frame *frame);

#endif
