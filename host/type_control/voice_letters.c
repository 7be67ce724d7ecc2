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

/* Scripts whose letters join or are reordered, and those that run to the left. */
static const uint32_t joining[][2] = {
    {0x590, 0x8ff},   {0x900, 0x109f},  {0x1780, 0x18af}, {0x1900, 0x1aff}, {0x1b00, 0x1c4f},
    {0xa800, 0xa87f}, {0xa880, 0xaaff}, {0xfb1d, 0xfdff}, {0xfe70, 0xfefc}, {0x10800, 0x11fff}};
static const uint32_t leftward[][2] = {
    {0x590, 0x8ff}, {0xfb1d, 0xfdff}, {0xfe70, 0xfefc}, {0x10800, 0x10fff}, {0x1e800, 0x1efff}};

static bool within(uint32_t c, const uint32_t (*ranges)[2], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (c >= ranges[i][0] && c <= ranges[i][1])
            return true;
    return false;
}

bool voice_word_joins(const struct voice_words *words, int word)
{
    int begin, end;
    voice_word_bytes(words, word, &begin, &end);
    for (const char *at = words->text + begin; at < words->text + end;) {
        uint32_t c;
        font_utf8_next(&at, words->text + end, &c);
        if (within(c, joining, sizeof joining / sizeof *joining))
            return true;
    }
    return false;
}

bool voice_words_to_left(const struct voice_words *words)
{
    for (int i = 0; i < words->letters_count; i++) {
        const char *at = words->text + words->letters[i].begin;
        uint32_t c;
        font_utf8_next(&at, words->text + words->letters[i].end, &c);
        if (within(c, leftward, sizeof leftward / sizeof *leftward))
            return true;
        if (c >= 0x41 && !is_punctuation(c))
            return false;
    }
    return false;
}

void voice_word_bytes(const struct voice_words *words, int word, int *begin, int *end)
{
    *begin = words->letters[words->first[word]].before;
    *end = words->letters[words->first[word + 1] - 1].after;
}

/* ---- times ---- */

/* The last span that begins by then; -1: none. */
static int span_before(const struct voice_span *spans, int count, double time_s)
{
    int low = -1, high = count;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (spans[middle].begin_s <= time_s)
            low = middle;
        else
            high = middle;
    }
    return low;
}

int voice_word_at(const struct voice_timing *t, double time_s)
{
    const int word = span_before(t->words, t->words_count, time_s),
              sound = span_before(t->sounds, t->sounds_count, time_s);
    return word >= 0 && time_s < t->words[word].end_s && sound >= 0 &&
                   time_s < t->sounds[sound].end_s
               ? word
               : -1;
}

void voice_timing_finish(struct voice_timing *timing)
{
    free(timing->words);
    free(timing->letters);
    free(timing->sounds);
    *timing = (struct voice_timing){0};
}
