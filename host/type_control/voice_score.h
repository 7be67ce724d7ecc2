/* voice_score.h - what of a voice plays what of its letters, at any moment.
 *
 * A feature is something heard, as a number from 0 to 1; a property is something of a letter. A mapping ties properties to features:
 *
 *     size      of the letters: from the least to the most, straight
 *     weight    of a font that varies: from the lightest to the boldest
 *     slant     of a font that varies, or by shearing
 *     baseline  from where it is up by `rise_em` of the most size
 *     ink       colour: feature 0 is one end of the inks, 1 the other; `vowel` mixes three inks, for [a], [i] and [u]
 *
 * Source of the idea: Small 1990, 3.3: the energy of a cry is the size of "Aagh". */
#ifndef LUTETIA_VOICE_SCORE_H
#define LUTETIA_VOICE_SCORE_H

#include <voice.h>

enum voice_feature {
    VOICE_NOTHING,  /* the property stays */
    VOICE_ENVELOPE, /* of the loudest in the sound */
    VOICE_LEVEL,
    VOICE_PITCH, /* from the lowest to the highest in the sound, by octaves; kept where there is none */
    VOICE_CLARITY, /* 0 noise, 1 periodic */
    VOICE_OPEN,    /* the first formant: 0 [i] [u], 1 [a] */
    VOICE_FRONT,   /* the second: 0 [u], 1 [i] */
    VOICE_VOWEL,   /* both; ink only */
    VOICE_FEATURES
};
enum voice_property {
    TYPE_SIZE,
    TYPE_WEIGHT,
    TYPE_SLANT,
    TYPE_BASELINE,
    TYPE_INK,
    TYPE_PROPERTIES
};

struct voice_mapping {
    enum voice_feature feature[TYPE_PROPERTIES];
};
/* Size by the envelope, and nothing else. */
struct voice_mapping voice_mapping_default(void);
/* "size=envelope,baseline=pitch": ties what is named, the rest stays. False: `why` says what is wrong, with the names there are. */
bool voice_mapping_read(struct voice_mapping *mapping, const char *text, char *why,
                        size_t room);

/* A sound's frames, and what is most and least in them. */
struct voice_score {
    const struct voice_frame *frames; /* borrowed */
    int count;
    double seconds;
    double loudest;         /* envelope */
    double loudest_level;   /* level */
    double pitch_octave[2]; /* log2 of Hz, the 5th and 95th of a hundred */
    double *pitch_kept;     /* of each frame, 0..1 */
    double *open_kept, *front_kept;
    double *begin_s; /* where its sounds begin, ascending: at least one */
    int begins;
    double end_s; /* of what can be heard */
};
/* `silence`: of the loudest; what is below it is not heard. False: no memory, or nothing is heard in it (*empty true). Owns: the
 * caller finishes *out. */
bool voice_score_make(const struct voice_frame *frames, int count, double silence,
                      struct voice_score *out, bool *empty);
void voice_score_finish(struct voice_score *score);
/* 0..1, straight between frames. VOWEL: as OPEN. */
double voice_score_at(const struct voice_score *score, enum voice_feature feature,
                      double time_s);
/* The sound that lasts at that time: 0 before the second one begins. */
int voice_score_sound(const struct voice_score *score, double time_s);

#endif
