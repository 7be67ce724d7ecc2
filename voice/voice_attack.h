/* voice_attack.h - finds where sounds begin. Private to the library. */
#ifndef LUTETIA_VOICE_ATTACK_H
#define LUTETIA_VOICE_ATTACK_H

#include <stdbool.h>

enum { VOICE_ATTACK_FRAMES_MAX = 64 }; /* the longest delay of a decision, in frames */

struct voice_attack {
    double least; /* the smallest rise of an attack, nepers */
    int span;     /* frames over which a rise is measured */
    int around;   /* frames before and after that must rise less */
    int gap;      /* the least number of frames between attacks */
    /* its own */
    double energy[2][VOICE_ATTACK_FRAMES_MAX]; /* logarithms of the energies: of all, of the
                                                * upper part */
    double rise[VOICE_ATTACK_FRAMES_MAX];
    long count, last;
};

void voice_attack_init(struct voice_attack *a, double frames_hz, double least, double gap_s);
/* Takes the next frame's energies. Returns whether the frame `around` frames before this one
 * begins a sound. */
bool voice_attack_next(struct voice_attack *a, double energy, double upper);

#endif
