/* spoken.h - sentences that espeak-ng says, with the time of each word by its own account: the
 * truth that alignments are tested against. */
#ifndef LUTETIA_TEST_SPOKEN_H
#define LUTETIA_TEST_SPOKEN_H

#include <stdbool.h>
#include <stddef.h>

struct spoken_word {
    int byte; /* of the text, where the word begins */
    double begin_s;
};

struct spoken {
    char *text;
    size_t text_bytes, text_room;
    float *samples;
    size_t count, room;
    int rate_hz;
    struct spoken_word *words;
    int words_count, words_room;
};

/* False: this voice is not installed. */
bool spoken_begin(struct spoken *out, const char *language);
void spoken_say(struct spoken *s, const char *sentence); /* and a space after it */
void spoken_silence(struct spoken *s, double seconds);
/* White noise for so long, of that level. */
void spoken_noise(struct spoken *s, double seconds, double level);
/* White noise over all that was said so far. */
void spoken_noise_over(struct spoken *s, double level);
void spoken_end(struct spoken *s);

#endif
