/* keys_places.c - see keys_places.h. */
#include "keys_places.h"

#include <string.h>

enum { OCTAVE = 12 };

static enum stage_status keys_place(const struct keys_actor_def *def, struct keys_score *score)
{
    if (def->score) {
        memcpy(score->keys, def->score->keys, sizeof score->keys);
        memcpy(score->rank, def->score->rank, sizeof score->rank);
        score->keys_count = def->score->keys_count;
        return STAGE_OK;
    }
    if (def->range[0] < 0 || def->range[1] >= MIDI_NOTES ||
        def->range[1] - def->range[0] < OCTAVE - 1)
        return stage_fail(STAGE_BAD_ARGUMENT,
                          "the keys must be an octave or more, of notes 0..127 (got %d to %d)",
                          def->range[0], def->range[1]);
    keys_score_range(score, def->range[0], def->range[1]);
    return STAGE_OK;
}

enum stage_status keys_places_make(const struct keys_actor_def *def, struct keys_score *score,
                                   struct keys_letters *letters)
{
    enum stage_status status = keys_place(def, score);
    if (status != STAGE_OK)
        return status;
    keys_letters_names(letters);
    if (def->text && !keys_letters_text(score, def->text, letters))
        return stage_fail(STAGE_BAD_ARGUMENT, "there is no letter in the text");
    for (int i = 0; def->letters && i < MIDI_NOTES; i++)
        if (def->letters->of[i][0])
            memcpy(letters->of[i], def->letters->of[i], KEYS_LETTER_BYTES);
    return STAGE_OK;
}

enum stage_status keys_places_text(const struct keys_score *score, const char *words,
                                   struct keys_letters *out)
{
    struct keys_letters letters;
    keys_letters_names(&letters);
    if (!keys_letters_text(score, words, &letters))
        return stage_fail(STAGE_BAD_ARGUMENT, "there is no letter in the text");
    *out = letters;
    return STAGE_OK;
}

int keys_places_near(const struct keys_score *s, int key)
{
    for (int away = 0; away < MIDI_NOTES; away += OCTAVE) {
        if (key - away >= 0 && s->rank[key - away] >= 0)
            return key - away;
        if (key + away < MIDI_NOTES && s->rank[key + away] >= 0)
            return key + away;
    }
    return key;
}
