/* voice_letters.c - see voice_letters.h. */
#include "voice_letters.h"

#include <text.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool is_space(uint32_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r') || c == 0x85 || c == 0xa0 || c == 0x1680 ||
           (c >= 0x2000 && c <= 0x200a) || c == 0x2028 || c == 0x2029 || c == 0x202f ||
           c == 0x205f || c == 0x3000;
}

/* Whether a character belongs to the letter before it: combining marks, joiners, variation
 * selectors, skin tones. */
static bool is_mark(uint32_t c)
{
    static const uint32_t ranges[][2] = {
        {0x300, 0x36f},     {0x483, 0x489},    {0x591, 0x5bd},   {0x610, 0x61a},
        {0x64b, 0x65f},     {0x900, 0x903},    {0x93a, 0x94f},   {0x981, 0x983},
        {0x9bc, 0x9cd},     {0xe31, 0xe31},    {0xe34, 0xe3a},   {0xe47, 0xe4e},
        {0x1ab0, 0x1aff},   {0x1dc0, 0x1dff},  {0x200d, 0x200d}, {0x20d0, 0x20ff},
        {0x302a, 0x302f},   {0x3099, 0x309a},  {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f},
        {0x1f3fb, 0x1f3ff}, {0xe0100, 0xe01ef}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (c >= ranges[i][0] && c <= ranges[i][1])
            return true;
    return false;
}

static bool is_punctuation(uint32_t c)
{
    static const uint32_t ranges[][2] = {{'!', '%'},       {'\'', '/'},      {':', '?'},
                                         {'[', '`'},       {'{', '~'},       {0xa1, 0xa1},
                                         {0xab, 0xab},     {0xb7, 0xb7},     {0xbb, 0xbb},
                                         {0xbf, 0xbf},     {0x589, 0x58a},   {0x5be, 0x5be},
                                         {0x60c, 0x60c},   {0x61b, 0x61f},   {0x964, 0x965},
                                         {0x2010, 0x2027}, {0x2030, 0x205e}, {0x3001, 0x3003},
                                         {0x3008, 0x3011}, {0xff01, 0xff0f}, {0xff1a, 0xff20}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (c >= ranges[i][0] && c <= ranges[i][1])
            return true;
    return false;
}

/* In a word without a letter, punctuation is treated as letters. */
static bool word_has_letter(const char *at, const char *end)
{
    uint32_t c;
    while (at < end) {
        font_utf8_next(&at, end, &c);
        if (is_space(c))
            return false;
        if (!is_punctuation(c) && !is_mark(c))
            return true;
    }
    return false;
}

static void words_walk(struct voice_words *out, const char *end)
{
    bool within = false, lettered = false, begun = false;
    int before = 0;
    for (const char *at = out->text; at < end;) {
        const char *here = at;
        int begin = (int)(at - out->text);
        uint32_t c;
        font_utf8_next(&at, end, &c);
        int after = (int)(at - out->text);
        if (is_space(c)) {
            within = false;
            continue;
        }
        if (!within) {
            out->first[out->count++] = out->letters_count;
            lettered = word_has_letter(here, end);
            before = begin;
            begun = false;
        }
        within = true;
        struct voice_letter *last = begun ? &out->letters[out->letters_count - 1] : NULL;
        if (last && is_mark(c) && last->end == begin) {
            last->end = last->after = after;
        } else if (lettered && (is_punctuation(c) || is_mark(c))) {
            if (last)
                last->after = after; /* else it is put before the first letter */
        } else {
            /* an apostrophe within a word is put before the next letter only, not also after
             * the last one */
            out->letters[out->letters_count++] = (struct voice_letter){
                last ? begin : before, begin, after, after, out->count - 1};
            begun = true;
        }
    }
    out->first[out->count] = out->letters_count;
}

bool voice_words_make(const char *text, struct voice_words *out, bool *empty)
{
    size_t length = strlen(text);
    *out = (struct voice_words){.text = text};
    out->first = malloc(sizeof *out->first * (length / 2 + 2));
    out->letters = malloc(sizeof *out->letters * (length + 1));
    bool memory = out->first && out->letters;
    if (memory)
        words_walk(out, text + length);
    *empty = memory && out->count == 0;
    if (memory && out->count > 0)
        return true;
    voice_words_finish(out);
    return false;
}

void voice_words_finish(struct voice_words *words)
{
    free(words->first);
    free(words->letters);
    *words = (struct voice_words){0};
}

/* The words of a sound: first..last, inclusive. */
static void words_of(const struct voice_words *w, const struct voice_score *s, int sound,
                     int *first, int *last)
{
    *first = (int)((int64_t)sound * w->count / s->begins);
    *last = (int)((int64_t)(sound + 1) * w->count / s->begins) - 1;
    if (*last < *first)
        *last = *first;
}

void voice_words_at(const struct voice_words *w, const struct voice_score *s, double time_s,
                    int *begin, int *end)
{
    int first, last;
    words_of(w, s, voice_score_sound(s, time_s), &first, &last);
    *begin = w->letters[w->first[first]].before;
    *end = w->letters[w->first[last + 1] - 1].after;
}

/* The sounds that show the same first word as this one: from..to, inclusive. */
static void sounds_alike(const struct voice_words *w, const struct voice_score *s, int sound,
                         int *from, int *to)
{
    int first, last, other;
    words_of(w, s, sound, &first, &last);
    *from = *to = sound;
    while (*from > 0 && (words_of(w, s, *from - 1, &other, &last), other == first))
        --*from;
    while (*to + 1 < s->begins && (words_of(w, s, *to + 1, &other, &last), other == first))
        ++*to;
}

int voice_letter_at(const struct voice_words *w, const struct voice_score *s, double time_s,
                    double *until_s)
{
    int sound = voice_score_sound(s, time_s), first, last, from, to;
    words_of(w, s, sound, &first, &last);
    sounds_alike(w, s, sound, &from, &to);
    double start = s->begin_s[from], stop = to + 1 < s->begins ? s->begin_s[to + 1] : s->end_s;
    int begin = w->first[first], count = w->first[last + 1] - begin;
    double part = stop > start ? (time_s - start) / (stop - start) : 0;
    int number = (int)fmin(count - 1, fmax(0, floor(part * count)));
    *until_s = start + (stop - start) * (number + 1) / count;
    return begin + number;
}
