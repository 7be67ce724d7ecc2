/* voice_pitch.h - the pitch of a voice: YIN. Private to the library. */
#ifndef LUTETIA_VOICE_PITCH_H
#define LUTETIA_VOICE_PITCH_H

/* The pitch of `count` samples, 0 if there is none, and its clarity, 0..1. The samples must
 * hold at least two periods of `least_hz`; `room` holds count numbers. */
double voice_pitch(const float *samples, int count, double rate_hz, double least_hz,
                   double most_hz, float *room, double *clarity);

#endif
