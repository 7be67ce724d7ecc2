/* voice_pitch.h - how high a voice is: YIN. Inside of the library. */
#ifndef LUTETIA_VOICE_PITCH_H
#define LUTETIA_VOICE_PITCH_H

/* The pitch of `count` samples, 0 where there is none, and its clarity, 0..1. `least_hz` has at least two periods in them; `room` holds
 * count numbers. */
double voice_pitch(const float *samples, int count, double rate_hz, double least_hz,
                   double most_hz, float *room, double *clarity);

#endif
