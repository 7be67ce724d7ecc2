/* voice_formants.h - the resonances of a vocal tract: roots of a linear prediction. Private
 * to the library. */
#ifndef LUTETIA_VOICE_FORMANTS_H
#define LUTETIA_VOICE_FORMANTS_H

enum { VOICE_ORDER_MAX = 24 };

/* The two lowest formants in Hz, 0 where there is none. `samples` are overwritten; `room` holds
 * 2 * count numbers. order: 2..VOICE_ORDER_MAX, even; 2 more than the thousands of samples a
 * second is usual. */
void voice_formants(float *samples, int count, double rate_hz, int order, double *room,
                    double formant_hz[2]);

#endif
