/* voice_units.c - see voice_units.h. */
#include "voice_units.h"

#include <text.h>

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define VOWEL_S 0.085
#define MORE_VOWEL_S 0.035 /* a vowel's second letter */
#define VOICED_S 0.06
#define HISS_S 0.09
#define BREATH_S 0.065
#define STOP_S 0.07
#define ANY_S 0.3
#define LAST_LONGER 1.35 /* the last vowel before a pause */

/* ---- letters ---- */

/* The base letters of U+00C0..U+017F, which are Latin with marks. */
static const char bases[] = "aaaaaaaceeeeiiiidnooooo.ouuuuytsaaaaaaaceeeeiiiidnooooo.ouuuuyty"
                            "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
                            "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

static bool among(uint32_t c, const uint32_t *set, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (set[i] == c)
            return true;
    return false;
}

/* The Latin letter without marks, in lower case; 0: another script. */
static char latin(uint32_t c)
{
    if (c >= 'A' && c <= 'Z')
        return (char)(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z')
        return (char)c;
    return c >= 0xc0 && c < 0xc0 + sizeof bases - 1 && bases[c - 0xc0] != '.' ? bases[c - 0xc0]
                                                                              : '\0';
}

static enum voice_class latin_class(char letter, char next)
{
    switch (letter) {
    case 'a':
    case 'e':
    case 'i':
    case 'o':
    case 'u':
    case 'y':
        return VOICE_CLASS_VOWEL;
    case 's':
    case 'z':
    case 'x':
        return VOICE_CLASS_HISS;
    case 'c':
        return next == 'e' || next == 'i' || next == 'y' ? VOICE_CLASS_HISS
               : next == 'h'                             ? VOICE_CLASS_BREATH
                                                         : VOICE_CLASS_STOP;
    case 'f':
    case 'h':
        return VOICE_CLASS_BREATH;
    case 'p':
        return next == 'h' ? VOICE_CLASS_BREATH : VOICE_CLASS_STOP;
    case 't':
        return next == 'h' ? VOICE_CLASS_BREATH : VOICE_CLASS_STOP;
    case 'k':
    case 'q':
        return VOICE_CLASS_STOP;
    default:
        return VOICE_CLASS_VOICED;
    }
}

/* Cyrillic, Greek, Hebrew, Arabic: what is not listed is voiced. */
static bool other_alphabet(uint32_t c, enum voice_class *out)
{
    static const uint32_t vowels[] = {U'а',  U'е',  U'ё',  U'и',  U'о',  U'у',  U'ы',  U'э',
                                      U'ю',  U'я',  U'і',  U'ї',  U'є',  U'α',  U'ε',  U'η',
                                      U'ι',  U'ο',  U'υ',  U'ω',  U'ά',  U'έ',  U'ή',  U'ί',
                                      U'ό',  U'ύ',  U'ώ',  U'ϊ',  U'ϋ',  U'ΐ',  U'ΰ',  0x5d0,
                                      0x627, 0x622, 0x623, 0x625, 0x648, 0x64a, 0x649, 0x6cc};
    static const uint32_t hisses[] = {U'с',  U'з',  U'ш',  U'щ',  U'ж',  U'ц',  U'ч',
                                      U'σ',  U'ς',  U'ζ',  U'ξ',  U'ψ',  0x5d6, 0x5e1,
                                      0x5e6, 0x5e9, 0x633, 0x634, 0x635, 0x632, 0x62b};
    static const uint32_t stops[] = {U'к',  U'п',  U'т',  U'κ',  U'π',  U'τ',  0x5d8, 0x5db,
                                     0x5e4, 0x5e7, 0x5ea, 0x62a, 0x637, 0x642, 0x643};
    static const uint32_t breaths[] = {U'ф',  U'х',  U'φ',  U'χ',  U'θ', 0x5d4,
                                       0x5d7, 0x62d, 0x62e, 0x641, 0x647};
    if (!(c >= 0x370 && c <= 0x52f) && !(c >= 0x5d0 && c <= 0x6ff))
        return false;
    if (c >= 0x410 && c <= 0x42f) /* small letters */
        c += 0x20;
    else if (c >= 0x400 && c <= 0x40f)
        c += 0x50;
    else if (c >= 0x391 && c <= 0x3a9)
        c += 0x20;
    *out = among(c, vowels, sizeof vowels / sizeof *vowels)      ? VOICE_CLASS_VOWEL
           : among(c, hisses, sizeof hisses / sizeof *hisses)    ? VOICE_CLASS_HISS
           : among(c, stops, sizeof stops / sizeof *stops)       ? VOICE_CLASS_STOP
           : among(c, breaths, sizeof breaths / sizeof *breaths) ? VOICE_CLASS_BREATH
                                                                 : VOICE_CLASS_VOICED;
    return true;
}

/* ---- units ---- */

struct units {
    struct voice_unit *at;
    int count;
};

static const double usual_s[VOICE_CLASSES] = {VOWEL_S,  VOICED_S, HISS_S,
                                              BREATH_S, STOP_S,   ANY_S};

static void unit_add(struct units *units, enum voice_class what, double seconds, int letter,
                     int word)
{
    units->at[units->count++] = (struct voice_unit){what, seconds, letter, letter + 1, word};
}

static uint32_t letter_character(const struct voice_words *words, int letter)
{
    const struct voice_letter *l = &words->letters[letter];
    const char *at = words->text + l->begin;
    uint32_t c = 0;
    if (l->end > l->begin)
        font_utf8_next(&at, words->text + l->end, &c);
    return c;
}

/* Whether a letter goes on with the sound of the last unit, of the same word. */
static bool same_sound(const struct voice_unit *last, enum voice_class what, char before,
                       char letter)
{
    if (what == VOICE_CLASS_VOWEL && last->what == VOICE_CLASS_VOWEL)
        return true;
    if (letter == 'h' && before && strchr("sctpgkr", before))
        return true;
    return letter == before || (letter == 'k' && before == 'c') ||
           (letter == 'c' && before == 's' && last->what == what);
}

static void latin_add(struct units *units, const struct voice_words *words, int letter,
                      bool begins, bool ends)
{
    const int word = words->letters[letter].word;
    const char own = latin(letter_character(words, letter)),
               before = begins ? '\0' : latin(letter_character(words, letter - 1)),
               after = ends ? '\0' : latin(letter_character(words, letter + 1));
    const enum voice_class what = latin_class(own, after);
    struct voice_unit *last = begins ? NULL : &units->at[units->count - 1];
    if (last && same_sound(last, what, before, own)) {
        last->letters_end = letter + 1;
        last->seconds += what == VOICE_CLASS_VOWEL ? MORE_VOWEL_S : 0.01;
        return;
    }
    const bool mute = ends && own == 'e' && letter - words->first[word] >= 2;
    unit_add(units, what, mute ? VOWEL_S / 3 : usual_s[what], letter, word);
}

/* A letter that is a consonant with its vowel: Indic scripts, Hangul, kana. `vowel`: it is
 * sounded. */
static void syllable_add(struct units *units, int letter, int word, bool consonant, bool vowel)
{
    if (consonant)
        unit_add(units, vowel ? VOICE_CLASS_ANY : VOICE_CLASS_VOICED, VOICED_S, letter, word);
    if (vowel)
        unit_add(units, VOICE_CLASS_VOWEL, VOWEL_S, letter, word);
}

static bool has_bytes(const struct voice_words *words, int letter, uint32_t from, uint32_t to)
{
    const struct voice_letter *l = &words->letters[letter];
    const char *at = words->text + l->begin, *end = words->text + l->end;
    uint32_t c;
    while (at < end) {
        font_utf8_next(&at, end, &c);
        if (c >= from && c <= to)
            return true;
    }
    return false;
}

/* Indic blocks are alike: 128 characters each, independent vowels at 05..14, vowel signs at
 * 3e..4c, the virama at 4d. */
static void indic_add(struct units *units, const struct voice_words *words, int letter,
                      bool begins, bool ends)
{
    const uint32_t c = letter_character(words, letter), block = c & ~0x7fu, at = c & 0x7f;
    const bool vowel = at >= 0x05 && at <= 0x14,
               sign = has_bytes(words, letter, block + 0x3e, block + 0x4c),
               killed = has_bytes(words, letter, block + 0x4d, block + 0x4d);
    const bool bare_end = ends && !begins && !sign; /* its vowel is mute in most languages */
    syllable_add(units, letter, words->letters[letter].word, !vowel,
                 vowel || (!killed && !bare_end));
}

static void letter_add(struct units *units, const struct voice_words *words, int letter,
                       bool begins, bool ends)
{
    const uint32_t c = letter_character(words, letter);
    const int word = words->letters[letter].word;
    enum voice_class what;
    if (latin(c)) {
        latin_add(units, words, letter, begins, ends);
    } else if (other_alphabet(c, &what)) {
        const bool unwritten = c >= 0x5d0 && c <= 0x6ff && what != VOICE_CLASS_VOWEL;
        unit_add(units, what, usual_s[what], letter, word);
        if (unwritten && !ends) /* half of the vowels are not written */
            unit_add(units, VOICE_CLASS_VOWEL, VOWEL_S / 2, letter, word);
    } else if (c >= 0x900 && c <= 0xdff) {
        indic_add(units, words, letter, begins, ends);
    } else if (c >= 0xe00 && c <= 0xeff) { /* Thai, Lao */
        unit_add(units, VOICE_CLASS_ANY, VOWEL_S, letter, word);
    } else if (c >= 0x1100) {
        syllable_add(units, letter, word, true, true);
    } else {
        unit_add(units, VOICE_CLASS_ANY, ANY_S, letter, word);
    }
}

/* ---- pauses ---- */

static bool sign_is(uint32_t c, const uint32_t *signs, size_t count)
{
    return among(c, signs, count);
}

enum voice_break voice_break_after(const struct voice_words *words, int word)
{
    static const uint32_t longs[] = {'.',    '!',   '?',    ':',   ';',    0x2026,
                                     0x61f,  0x61b, 0x964,  0x965, 0x3002, 0xff01,
                                     0xff1f, 0x589, 0x2014, 0x6d4};
    static const uint32_t shorts[] = {',',    ')',    '(',  0x60c, 0x3001,
                                      0xff0c, 0x2013, 0xbb, 0x201d};
    const struct voice_letter *last = &words->letters[words->first[word + 1] - 1];
    const char *at = words->text + last->end, *end = words->text + last->after;
    enum voice_break found = VOICE_BREAK_NONE;
    while (at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        if (sign_is(c, longs, sizeof longs / sizeof *longs))
            return VOICE_BREAK_LONG;
        if (sign_is(c, shorts, sizeof shorts / sizeof *shorts))
            found = VOICE_BREAK_SHORT;
    }
    return found;
}

static void last_vowel_lengthen(struct units *units, int from)
{
    for (int i = units->count - 1; i >= from; i--)
        if (units->at[i].what == VOICE_CLASS_VOWEL) {
            units->at[i].seconds *= LAST_LONGER;
            return;
        }
}

bool voice_units_make(const struct voice_words *words, struct voice_unit **out, int *count)
{
    struct units units = {.at = malloc(sizeof *units.at * 2 * (size_t)words->letters_count)};
    *out = units.at;
    *count = 0;
    if (!units.at)
        return false;
    for (int word = 0; word < words->count; word++) {
        const int first = words->first[word], end = words->first[word + 1], from = units.count;
        for (int letter = first; letter < end; letter++)
            letter_add(&units, words, letter, letter == first, letter + 1 == end);
        if (voice_break_after(words, word) != VOICE_BREAK_NONE || word + 1 == words->count)
            last_vowel_lengthen(&units, from);
    }
    *count = units.count;
    return true;
}
