/* keys_letters.c - see keys_letters.h. */
#include "keys_letters.h"

#include <text.h>

#include <input_file.h>

#include <stdio.h>
#include <string.h>

void keys_letters_names(struct keys_letters *out)
{
    static const char *const names[12] = {"C",  "C♯", "D",  "D♯", "E",  "F",
                                          "F♯", "G",  "G♯", "A",  "A♯", "B"};
    for (int i = 0; i < MIDI_NOTES; i++)
        snprintf(out->of[i], KEYS_LETTER_BYTES, "%s", names[i % 12]);
}

struct range {
    uint32_t first, last;
};

static bool within(uint32_t c, const struct range *ranges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (c >= ranges[i].first && c <= ranges[i].last)
            return true;
    return false;
}
#define WITHIN(c, ranges) within(c, ranges, sizeof(ranges) / sizeof *(ranges))

/* Whether a character is a mark of the letter before it: accents, vowel signs, joiners. */
static bool is_mark(uint32_t c)
{
    static const struct range marks[] = {
        {0x300, 0x36f}, {0x591, 0x5bd},   {0x610, 0x61a},   {0x64b, 0x65f},   {0x670, 0x670},
        {0x6d6, 0x6dc}, {0x1ab0, 0x1aff}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}, {0x200c, 0x200d},
        {0xe31, 0xe31}, {0xe34, 0xe3a},   {0xe47, 0xe4e}};
    /* the Indic blocks are alike, 128 characters each */
    const uint32_t at = c & 0x7f;
    const bool indic = c >= 0x900 && c <= 0xdff;
    return WITHIN(c, marks) ||
           (indic && (at <= 0x03 || at == 0x3c || (at >= 0x3e && at <= 0x4d)));
}

/* What kills a consonant's vowel, so that the next consonant joins it. */
static bool is_virama(uint32_t c)
{
    return c >= 0x900 && c <= 0xdff && (c & 0x7f) == 0x4d;
}

static bool is_arabic(uint32_t c)
{
    return (c >= 0x620 && c <= 0x64a) || (c >= 0x66e && c <= 0x6d5) ||
           (c >= 0x6fa && c <= 0x77f);
}

/* Whether an Arabic letter joins the one after it; and the one before it. */
static bool joins_next(uint32_t c)
{
    static const struct range no[] = {{0x621, 0x625}, {0x627, 0x627}, {0x629, 0x629},
                                      {0x62f, 0x632}, {0x648, 0x648}, {0x671, 0x677},
                                      {0x688, 0x699}, {0x6c0, 0x6c0}, {0x6c3, 0x6cb},
                                      {0x6cd, 0x6cd}, {0x6cf, 0x6cf}, {0x6d2, 0x6d5}};
    return is_arabic(c) && !WITHIN(c, no);
}

static bool joins_last(uint32_t c)
{
    return is_arabic(c) && c != 0x621 && c != 0x674 && c != 0x6d4;
}

static bool runs_to_left(uint32_t c)
{
    static const struct range left[] = {{0x590, 0x8ff}, {0xfb1d, 0xfdff}, {0xfe70, 0xfefc}};
    return WITHIN(c, left);
}

static bool is_space(uint32_t c)
{
    return c <= ' ' || c == 0xa0 || (c >= 0x2000 && c <= 0x200a) || c == 0x3000;
}

/* A letter of the text with its marks, and the characters beside it; 0: a space, or nothing. */
struct letter {
    const char *begin;
    size_t count;
    uint32_t own, last, next;
};

/* The next letter with its marks. False: none. */
static bool letter_next(const char **at, const char *end, struct letter *out)
{
    uint32_t c;
    bool conjunct = false;
    *out = (struct letter){.last = out->own};
    while (*at < end) {
        const char *here = *at;
        (void)font_utf8_next(at, end, &c);
        if (out->begin && !is_mark(c) && !conjunct) {
            *at = here;
            out->next = is_space(c) ? 0 : c;
            break;
        }
        if (is_space(c)) {
            out->last = 0;
            conjunct = false;
            continue;
        }
        if (!out->begin) {
            out->begin = here;
            out->own = c;
        }
        conjunct = is_virama(c) || (conjunct && c == 0x200d);
        out->count = (size_t)(*at - out->begin);
    }
    return out->begin != NULL;
}

/* A letter as it is within its word: zero width joiners stand for its neighbours. */
static void letter_write(const struct letter *l, char out[static KEYS_LETTER_BYTES])
{
    static const char joiner[] = "\xe2\x80\x8d";
    const bool before = joins_next(l->last) && joins_last(l->own),
               after = joins_next(l->own) && joins_last(l->next);
    if (l->count + 2 * sizeof joiner >= KEYS_LETTER_BYTES)
        return; /* so many marks are none */
    snprintf(out, KEYS_LETTER_BYTES, "%s%.*s%s", before ? joiner : "", (int)l->count, l->begin,
             after ? joiner : "");
}

bool keys_letters_text(const struct keys_score *score, const char *text,
                       struct keys_letters *out)
{
    const char *at = text, *end = text + strlen(text);
    struct letter letter = {0};
    memset(out, 0, sizeof *out);
    if (!letter_next(&at, end, &letter))
        return false;
    const bool to_left = runs_to_left(letter.own);
    at = text;
    letter = (struct letter){0};
    for (int i = 0; i < score->keys_count; i++) {
        if (!letter_next(&at, end, &letter)) {
            at = text; /* from the beginning */
            letter = (struct letter){0};
            (void)letter_next(&at, end, &letter);
        }
        letter_write(&letter, out->of[score->keys[to_left ? score->keys_count - 1 - i : i]]);
    }
    return true;
}

bool keys_letters_file(const char *path, struct keys_letters *out, char *why, size_t room)
{
    char line[256];
    const char *wrong = "";
    FILE *file = input_file_open(path, &wrong);
    if (!file) {
        snprintf(why, room, "%s: cannot read: %s", path, wrong);
        return false;
    }
    bool good = true;
    for (int number = 1; good && fgets(line, sizeof line, file); number++) {
        char key[16], letter[KEYS_LETTER_BYTES], more[2];
        const int words = line[0] == '#' ? 0 : sscanf(line, "%15s %63s %1s", key, letter, more);
        if (words <= 0)
            continue;
        const int note = midi_note_read(key);
        good = words == 2 && note >= 0;
        if (good)
            memcpy(out->of[note], letter, sizeof letter);
        else
            snprintf(why, room, "%s:%d: a line is a key and what it plays, like 'c4 A'", path,
                     number);
    }
    fclose(file);
    return good;
}
