/* text_internal.h - what text.c and text_lines.c share. */
#ifndef LUTETIA_FONT_TEXT_INTERNAL_H
#define LUTETIA_FONT_TEXT_INTERNAL_H

#include "edges.h"
#include "text.h"

#include <fontconfig/fontconfig.h>
#include <hb.h>

enum { FONT_FACES_MAX = 24, FONT_KNOWN = 512 };

struct font_shaped_face {
    struct font_face *face;
    hb_font_t *own; /* as the font's file has it */
    hb_font_t *hb;  /* with the advances of replaced glyphs; else the same */
    uint64_t version;
    bool owned;
    double units_per_em;
    int candidate; /* which of fontconfig's it is, where it is one of those */
};

/* A character, and the face that it was found in. */
struct font_known {
    uint32_t character;
    int face; /* 0: none yet; -1: there is none */
};

struct font_shaper {
    struct font_shaped_face faces[FONT_FACES_MAX];
    int faces_count;
    bool colour; /* faces of pictures are welcome */
    hb_buffer_t *buffer;
    struct font_known known[FONT_KNOWN];
    FcFontSet *candidates; /* fontconfig's, best first; NULL until the first is needed */
    /* The candidate opened last of which nothing was seen; NULL: none. */
    struct font_face *spare;
    int spare_candidate;
};

/* What a face's own leading has above a baseline, and below it. */
struct font_room {
    double above_px, below_px;
};
struct font_room font_room_of(const struct font_face *face, double size_px);

/* Makes the HarfBuzz font, again if the face's axes were set since. */
void font_shaped_refresh(struct font_shaped_face *face);
/* A face of the shaper that has the character, opened if need be; -1 if there is none. */
int font_shaper_face_for(struct font_shaper *shaper, uint32_t character);
/* The same for a picture of several characters, of a face in colours that has all of them; -1
 * also where pictures are not welcome. */
int font_shaper_face_for_picture(struct font_shaper *shaper, const uint32_t *characters,
                                 int count);

/* text_runs.c: nothing is drawn for it, so no font need have it; a mark, which goes with its
 * letter; white space; a new line, and what Unicode has beside it. */
bool font_text_invisible(uint32_t character);
bool font_text_mark(uint32_t character);
bool font_text_white(uint32_t character);
/* How many characters from here on are one picture in colours that is told by several of them
 * (UTS 51): a flag's letters, a keycap, a sign with U+FE0F, with a skin, joined to others. 0:
 * none is. */
int font_text_picture(const uint32_t *characters, int count);
/* Whether letters of the script are joined to each other: nothing may part them. */
bool font_text_joins(hb_script_t script);
bool font_text_ends_line(uint32_t character);
/* text_lines.c: a feature's text, like kern=0, of that length. False: it is none. HarfBuzz
 * since 10 takes any signs for a name; these are letters, digits and low lines. */
bool font_feature_read(const char *text, int length, hb_feature_t *out);
/* Adds what a distance between letters switches off: features that make one form of several
 * letters, before those that were asked for. features: room for FONT_APART more. */
enum { FONT_APART = 4 };
void font_features_apart(hb_feature_t *features, unsigned *count);
/* Common and inherited characters go with those before them, at the beginning with those
 * behind. */
void font_scripts_choose(const uint32_t *characters, int count, hb_script_t *scripts);
/* How a character is in a line that goes down (UTR 50): it lies on its side, it stands, or it
 * stands where the font has a form of it for that. UNKNOWN: there is no ICU that says. */
enum font_stand { FONT_STAND_UNKNOWN, FONT_LIES, FONT_STANDS, FONT_STANDS_IF_DRAWN };
enum font_stand font_stand_of(uint32_t character);
/* line_ends.c: where lines may end (UAX 14), by libunibreak's signs, of the place behind each
 * character. False: no memory. */
bool font_breaks_find(const uint32_t *characters, int count, const char *language,
                      char *breaks);
/* Whether both libraries say the same of all places but the last, at which only libunibreak
 * says that a line must end. */
bool font_breaks_plain(const uint32_t *characters, int count);
/* By ICU whatever the characters; false also where it is not installed. */
bool font_breaks_by_icu(const uint32_t *characters, int count, const char *language,
                        char *breaks);
/* The paragraph's levels (UAX 9). direction: 1 it runs to the left, -1 to the right, 0 as its
 * first letter; *base: its own level. False: no memory. */
bool font_levels_find(const uint32_t *characters, int count, int direction, int8_t *levels,
                      int *base);

/* What a character does to levels: nothing by itself, it runs to the right or to the left, is a
 * number in a text that runs to the left, or begins or ends what is embedded or isolated. */
enum font_direction {
    FONT_RUNS_NOWHERE,
    FONT_RUNS_RIGHT,
    FONT_RUNS_LEFT,
    FONT_NUMBERS,
    FONT_EMBEDS
};
enum font_direction font_direction_of(uint32_t character);
/* Whether it is one of a pair of brackets. */
bool font_bracket(uint32_t character);

/* Characters of one level, and whatever else they have in common. */
struct font_run {
    int begin, end, level;
};
/* Puts a line's runs in the order in which they are seen (rule L2). */
void font_runs_order(struct font_run *runs, int count);

#endif
