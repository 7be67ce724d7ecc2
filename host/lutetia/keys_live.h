/* keys_live.h - `lutetia keys` on a stage: in a window, or a film of a song through a map in
 * Lua. */
#ifndef LUTETIA_KEYS_LIVE_H
#define LUTETIA_KEYS_LIVE_H

#include "live.h"

#include <keys_letters.h>

struct keys_live {
    struct font_face *face;
    const struct keys_score *score; /* of the song; NULL: the keys of the range */
    const struct keys_letters *letters;
    const char *text, *theme;
    bool wet;          /* on paper: */
    const char *stock; /* NULL: the usual one */
    struct option_texts pigments;
    int range[2];
    struct keys_def keys;
    struct option_texts sets;
    struct live_options live;
    struct midi_song *song;
    struct stage_film_def film;
    int size[2];
};

/* "c3-c5". False: it is no range of an octave or more. */
bool keys_live_range(const char *text, int range[2]);

/* Exit statuses; what is wrong has been said. */
int keys_live_window(const struct keys_live *def);
int keys_live_film(const struct keys_live *def);

#endif
