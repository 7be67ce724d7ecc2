/* voice.h - features of a voice, frame by frame: loudness, beginnings of sounds, pitch, and
 * vowel.
 *
 *     struct voice_def def = voice_def_default();
 *     struct voice *voice;
 *     if (!voice_create(&def, 44100, &voice))
 *         die("no memory");
 *     voice_hear(voice, samples, count);        // in pieces of any length
 *     voice_end(voice);                         // nothing more comes
 *     struct voice_frame frame;
 *     while (voice_next(voice, &frame))
 *         use(&frame);
 *     voice_destroy(voice);
 *
 * Frames do not depend on the pieces in which samples arrive. A frame is ready when the samples
 * up to VOICE_DELAY_S after it have arrived, because these decide whether it is the beginning
 * of a sound.
 *
 * Level. The root of the mean square over 20 ms, weighted by a Hann window, of full scale (a
 * sine of amplitude 1: 0.707). Envelope. It follows the level within `rise_s` and falls within
 * `fall_s` (each to 1/e). Attack. The logarithm of the energy, and that of the energy's upper
 * part, rises by more than `attack` in 50 ms, more than just before and after, and no attack
 * was less than `attack_gap_s` ago. Pitch. De Cheveigné and Kawahara's YIN (JASA 2002) over two
 * periods of the lowest; 0 where there is none. Formants. The two lowest resonances of a linear
 * prediction (Burg), where there is a pitch; 0 where none is found.
 *
 * Threads: a voice belongs to one thread at a time.
 */
#ifndef LUTETIA_VOICE_H
#define LUTETIA_VOICE_H

#include <stdbool.h>
#include <stddef.h>

#define VOICE_DELAY_S 0.08

struct voice_def {
    double frames_hz;            /* 20..500 */
    double rise_s, fall_s;       /* 0..2 */
    double pitch_hz[2];          /* lowest and highest, 40..2000 */
    double attack, attack_gap_s; /* nepers, 0.05..10; 0.01..2 */
    double silence;              /* level below which everything is silence, 0..1 */
};
struct voice_def voice_def_default(void);

struct voice_frame {
    double time_s;        /* of its middle */
    double level;         /* 0..1 */
    double envelope;      /* 0..1 */
    double pitch_hz;      /* 0: none */
    double clarity;       /* 0 noise .. 1 periodic */
    double bright;        /* 0 all energy is in low frequencies .. 1 in those near 5 kHz */
    double formant_hz[2]; /* 0: none */
    bool attack;
};

struct voice;

/* Says in one line which member of the definition is out of range; NULL: none. */
const char *voice_def_wrong(const struct voice_def *def);
/* False: no memory. The definition must be valid and the rate VOICE_RATE_MIN to
 * VOICE_RATE_MAX (voice_sound.h). Owns: the caller destroys *out. */
bool voice_create(const struct voice_def *def, int rate_hz, struct voice **out);
void voice_destroy(struct voice *voice); /* NULL is fine */
/* False: no memory for the frames that have not been taken yet; the samples are lost. */
bool voice_hear(struct voice *voice, const float *samples, size_t count);
bool voice_end(struct voice *voice);
bool voice_next(struct voice *voice, struct voice_frame *out);

/* Computes all frames of a sound at once. Owns: the caller frees *frames. False: no memory. */
bool voice_frames(const struct voice_def *def, const float *samples, size_t count, int rate_hz,
                  struct voice_frame **frames, int *frames_count);

#endif
