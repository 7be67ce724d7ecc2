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

/* Whether a character is a mark of the letter before it. */
static bool is_mark(uint32_t c)
{
    return (c >= 0x300 && c <= 0x36f) || (c >= 0xfe00 && c <= 0xfe0f) || c == 0x200d;
}

static bool is_space(uint32_t c)
{
    return c <= ' ' || c == 0xa0 || (c >= 0x2000 && c <= 0x200a) || c == 0x3000;
}

/* The next letter with its marks; NULL: none. *count: its bytes. */
static const char *letter_next(const char **at, const char *end, size_t *count)
{
    const char *begin = NULL;
    while (*at < end) {
        const char *before = *at;
        uint32_t c;
        (void)font_utf8_next(at, end, &c);
        if (begin && !is_mark(c)) {
            *at = before;
            break;
        }
        if (!begin && !is_space(c))
            begin = before;
    }
    *count = begin ? (size_t)(*at - begin) : 0;
    return begin;
}

bool keys_letters_text(const struct keys_score *score, const char *text,
                       struct keys_letters *out)
{
    const char *at = text, *end = text + strlen(text);
    size_t count;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < score->keys_count; i++) {
        const char *letter = letter_next(&at, end, &count);
        if (!letter) {
            at = text; /* from the beginning */
            letter = letter_next(&at, end, &count);
        }
        if (!letter)
            return false;
        count = count < KEYS_LETTER_BYTES ? count : 0; /* so many marks are none */
        memcpy(out->of[score->keys[i]], letter, count);
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
