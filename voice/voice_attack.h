/* voice_attack.h - where sounds begin. Inside of the library. */
#ifndef LUTETIA_VOICE_ATTACK_H
#define LUTETIA_VOICE_ATTACK_H

#include <stdbool.h>

enum { VOICE_ATTACK_FRAMES_MAX = 64 }; /* a frame is decided upon so many later at most */

struct voice_attack {
    double least; /* rise that counts, nepers */
    int span;     /* frames that a rise is taken over */
    int around;   /* frames before and after that rise less */
    int gap;      /* frames from attack to attack */
    /* its own */
    double energy[2][VOICE_ATTACK_FRAMES_MAX]; /* logarithms: of all, of the upper part */
    double rise[VOICE_ATTACK_FRAMES_MAX];
    long count, last;
};

void voice_attack_init(struct voice_attack *a, double frames_hz, double least, double gap_s);
/* The next frame's energies. Returns whether the frame `around` frames before this one begins a sound. */
bool voice_attack_next(struct voice_attack *a, double energy, double upper);

#endif
