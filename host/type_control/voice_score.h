/* voice_score.h - which features of a voice set which properties of its letters, at any moment.
 *
 * A feature is a measure of the voice, as a number from 0 to 1. A mapping assigns features to
 * properties of letters:
 *
 *     size      of the letters: from the least to the most, straight
 *     weight    of a font that varies: from the lightest to the boldest
 *     slant     of a font that varies, or by shearing
 *     baseline  from where it is up by `rise_em` of the most size
 *     ink       colour: feature 0 is one end of the inks, 1 the other; `vowel` mixes three
 *               inks, for [a], [i] and [u]
 *
 * Source of the idea: Small 1990, 3.3: the energy of a cry is the size of "Aagh".
 */
#ifndef LUTETIA_VOICE_SCORE_H
#define LUTETIA_VOICE_SCORE_H

#include <voice.h>

enum voice_feature {
    VOICE_NOTHING,  /* the property stays */
    VOICE_ENVELOPE, /* of the loudest in the sound */
    VOICE_LEVEL,
    /* from the lowest to the highest in the sound, by octaves; kept where there is none */
    VOICE_PITCH,
    VOICE_CLARITY, /* 0 noise, 1 periodic */
    VOICE_OPEN,    /* the first formant: 0 [i] [u], 1 [a] */
    VOICE_FRONT,   /* the second: 0 [u], 1 [i] */
    VOICE_VOWEL,   /* both; ink only */
    VOICE_FEATURES
};
enum voice_property {
    TYPE_SIZE,
    TYPE_WEIGHT,
    TYPE_WIDTH,
    TYPE_SLANT,
    TYPE_BASELINE,
    TYPE_INK,
    TYPE_PROPERTIES
};

struct voice_mapping {
    enum voice_feature feature[TYPE_PROPERTIES];
};
/* The default: size by the envelope. */
struct voice_mapping voice_mapping_default(void);
/* "size=envelope,baseline=pitch": sets the named properties; the rest stays. False: `why`
 * gets the error, with the known names. */
bool voice_mapping_read(struct voice_mapping *mapping, const char *text, char *why,
                        size_t room);

/* A sound's frames, and their ranges. */
struct voice_score {
    const struct voice_frame *frames; /* borrowed */
    int count;
    double seconds;
    double loudest;         /* envelope */
    double loudest_level;   /* level */
    double pitch_octave[2]; /* log2 of Hz, the 5th and 95th percentile */
    double *pitch_kept;     /* of each frame, 0..1 */
    double *open_kept, *front_kept;
    double *begin_s; /* beginnings of the sounds, ascending: at least one */
    int begins;
    double end_s; /* of what can be heard */
};
/* `silence`: relative to the loudest; anything below is silence. False: no memory, or all is
 * silence (*empty true). Owns: the caller finishes *out. */
bool voice_score_make(const struct voice_frame *frames, int count, double silence,
                      struct voice_score *out, bool *empty);
void voice_score_finish(struct voice_score *score);
/* 0..1, linear between frames. VOWEL: as OPEN. */
double voice_score_at(const struct voice_score *score, enum voice_feature feature,
                      double time_s);

#endif
