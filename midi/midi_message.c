/* midi_message.c - see midi_message.h. */
#include "midi_message.h"
#include "midi_internal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct midi_row rows[] = {
    {"note-off", 0x80, MIDI_KIND_CHANNEL, 2},
    {"note-on", 0x90, MIDI_KIND_CHANNEL, 2},
    {"poly-pressure", 0xa0, MIDI_KIND_CHANNEL, 2},
    {"control", 0xb0, MIDI_KIND_CHANNEL, 2},
    {"program", 0xc0, MIDI_KIND_CHANNEL, 1},
    {"pressure", 0xd0, MIDI_KIND_CHANNEL, 1},
    {"bend", 0xe0, MIDI_KIND_CHANNEL, 2},
    {"sysex", 0xf0, MIDI_KIND_SYSEX, 0},
    {"quarter-frame", 0xf1, MIDI_KIND_COMMON, 1},
    {"song-position", 0xf2, MIDI_KIND_COMMON, 2},
    {"song-select", 0xf3, MIDI_KIND_COMMON, 1},
    {"undefined-f4", 0xf4, MIDI_KIND_UNDEFINED, 0},
    {"undefined-f5", 0xf5, MIDI_KIND_UNDEFINED, 0},
    {"tune-request", 0xf6, MIDI_KIND_COMMON, 0},
    {"sysex-end", 0xf7, MIDI_KIND_SYSEX, 0},
    {"clock", 0xf8, MIDI_KIND_REAL_TIME, 0},
    {"undefined-f9", 0xf9, MIDI_KIND_UNDEFINED_REAL_TIME, 0},
    {"start", 0xfa, MIDI_KIND_REAL_TIME, 0},
    {"continue", 0xfb, MIDI_KIND_REAL_TIME, 0},
    {"stop", 0xfc, MIDI_KIND_REAL_TIME, 0},
    {"undefined-fd", 0xfd, MIDI_KIND_UNDEFINED_REAL_TIME, 0},
    {"sensing", 0xfe, MIDI_KIND_REAL_TIME, 0},
    {"reset", 0xff, MIDI_KIND_REAL_TIME, 0},
};

enum { ROWS_COUNT = sizeof rows / sizeof *rows, CHANNEL_ROWS = 7 };

const struct midi_row *midi_rows(int *count)
{
    *count = ROWS_COUNT;
    return rows;
}

const struct midi_row *midi_row_of(uint8_t status)
{
    if (status < 0x80)
        return NULL;
    return status < 0xf0 ? &rows[(status >> 4) - 8] : &rows[CHANNEL_ROWS + (status & 15)];
}

struct midi_message midi_message_make(uint64_t time_ns, uint8_t status, uint8_t first,
                                      uint8_t second)
{
    struct midi_message m = {.time_ns = time_ns, .count = 1, .bytes = {status}};
    const struct midi_row *row = midi_row_of(status);
    m.count = (uint16_t)(1 + (row ? row->data_count : 0));
    m.bytes[1] = first & 0x7f;
    m.bytes[2] = second & 0x7f;
    return m;
}

enum midi_kind midi_message_kind(const struct midi_message *m)
{
    const struct midi_row *row = midi_row_of(m->bytes[0]);
    return row ? row->kind : MIDI_KIND_SYSEX;
}

int midi_message_channel(const struct midi_message *m)
{
    return m->bytes[0] >= 0x80 && m->bytes[0] < 0xf0 ? m->bytes[0] & 15 : -1;
}

bool midi_message_good(const struct midi_message *m)
{
    if (m->count < 1 || m->count > MIDI_BYTES_MAX)
        return false;
    const enum midi_kind kind = midi_message_kind(m);
    const bool sysex = kind == MIDI_KIND_SYSEX;
    if (kind == MIDI_KIND_UNDEFINED || kind == MIDI_KIND_UNDEFINED_REAL_TIME ||
        (!sysex && m->count != 1 + midi_row_of(m->bytes[0])->data_count))
        return false;
    for (int i = 0; i < m->count; i++) {
        const bool status = m->bytes[i] >= 0x80;
        const bool may = (i == 0 && m->bytes[0] != MIDI_SYSEX_END) ||
                         (sysex && i == m->count - 1 && m->bytes[i] == MIDI_SYSEX_END);
        if (status && !may)
            return false;
    }
    return true;
}

bool midi_message_open(const struct midi_message *m)
{
    return midi_message_kind(m) == MIDI_KIND_SYSEX && m->bytes[m->count - 1] != MIDI_SYSEX_END;
}

bool midi_message_equal(const struct midi_message *a, const struct midi_message *b)
{
    return a->count == b->count && !memcmp(a->bytes, b->bytes, a->count);
}

bool midi_message_strikes(const struct midi_message *m)
{
    return (m->bytes[0] & 0xf0) == MIDI_NOTE_ON && m->bytes[2];
}

bool midi_message_releases(const struct midi_message *m)
{
    return (m->bytes[0] & 0xf0) == MIDI_NOTE_OFF ||
           ((m->bytes[0] & 0xf0) == MIDI_NOTE_ON && !m->bytes[2]);
}

/* ---- as words ---- */

static const char *const note_names[12] = {"c",  "c#", "d",  "d#", "e",  "f",
                                           "f#", "g",  "g#", "a",  "a#", "b"};

void midi_note_text(int note, char text[8])
{
    const unsigned int one = (unsigned int)note % MIDI_NOTES;
    snprintf(text, 8, "%s%d", note_names[one % 12], (int)(one / 12) - 1);
}

/* A whole decimal number within a range. */
static bool number_read(const char *word, long least, long most, long *value)
{
    char *end;
    errno = 0;
    *value = strtol(word, &end, 10);
    return end != word && !*end && !errno && *value >= least && *value <= most;
}

int midi_note_read(const char *word)
{
    static const int steps[7] = {9, 11, 0, 2, 4, 5, 7}; /* a, b, c, ... */
    long value;
    if (number_read(word, 0, MIDI_NOTES - 1, &value))
        return (int)value;
    const char letter = (char)(word[0] | 0x20);
    if (letter < 'a' || letter > 'g')
        return -1;
    int step = steps[letter - 'a'];
    word++;
    for (; *word == '#' || *word == 'b'; word++)
        step += *word == '#' ? 1 : -1;
    if (!number_read(word, -1, 9, &value))
        return -1;
    step += 12 * ((int)value + 1);
    return step >= 0 && step < MIDI_NOTES ? step : -1;
}

static bool has_note(uint8_t status)
{
    return status < 0xb0;
}

void midi_message_text(const struct midi_message *m, char text[MIDI_TEXT_MAX])
{
    const struct midi_row *row = midi_row_of(m->bytes[0]);
    if (midi_message_kind(m) == MIDI_KIND_SYSEX) {
        int at = snprintf(text, MIDI_TEXT_MAX, "sysex");
        for (int i = 0; i < m->count; i++)
            at += snprintf(text + at, (size_t)(MIDI_TEXT_MAX - at), " %02x", m->bytes[i]);
        return;
    }
    int at = snprintf(text, MIDI_TEXT_MAX, "%s", row->name);
    if (row->kind == MIDI_KIND_CHANNEL)
        at += snprintf(text + at, (size_t)(MIDI_TEXT_MAX - at), " %d", 1 + (m->bytes[0] & 15));
    int first = 1;
    if (row->kind == MIDI_KIND_CHANNEL && has_note(row->status)) {
        char note[8];
        midi_note_text(m->bytes[1], note);
        at += snprintf(text + at, (size_t)(MIDI_TEXT_MAX - at), " %s", note);
        first = 2;
    }
    if (row->status == MIDI_BEND || row->status == 0xf2) { /* 14 bits, the lower seven first */
        int value = m->bytes[1] + 128 * m->bytes[2] - (row->status == MIDI_BEND ? 8192 : 0);
        snprintf(text + at, (size_t)(MIDI_TEXT_MAX - at), " %d", value);
        return;
    }
    for (int i = first; i < m->count; i++)
        at += snprintf(text + at, (size_t)(MIDI_TEXT_MAX - at), " %d", m->bytes[i]);
}

static enum midi_status sysex_read(char *words[], int count, struct midi_message *m)
{
    m->count = 0;
    for (int i = 1; i < count; i++) {
        char *end;
        unsigned long byte = strtoul(words[i], &end, 16);
        if (end == words[i] || *end || byte > 0xff || strlen(words[i]) > 2)
            return midi_fail(
                MIDI_BAD_ARGUMENT,
                "sysex takes bytes of two hexadecimal digits, f0 ... f7 (got '%.20s')",
                words[i]);
        m->bytes[m->count++] = (uint8_t)byte;
    }
    if (!m->count || !midi_message_good(m) || midi_message_kind(m) != MIDI_KIND_SYSEX)
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "sysex begins with f0, ends with f7, and has data below 80 between");
    return MIDI_OK;
}

static enum midi_status name_unknown(const char *name)
{
    char known[400] = "";
    for (int i = 0; i < ROWS_COUNT; i++)
        if (strncmp(rows[i].name, "undefined", 9) != 0 && rows[i].status != MIDI_SYSEX_END)
            error_text_list(known, sizeof known, ", ", rows[i].name);
    return midi_fail(MIDI_BAD_ARGUMENT, "there is no message '%.40s'; known are %s", name,
                     known);
}

/* The words after the name: channel, note, numbers. */
static enum midi_status data_read(const struct midi_row *row, char *words[], int count,
                                  struct midi_message *m)
{
    const bool channel = row->kind == MIDI_KIND_CHANNEL;
    const bool wide = row->status == MIDI_BEND || row->status == 0xf2;
    const int wanted = 1 + channel + (wide ? 1 : row->data_count);
    long value = 1;
    if (count != wanted)
        return midi_fail(MIDI_BAD_ARGUMENT, "%s takes %d number%s%s (got %d)", row->name,
                         wanted - 1, wanted == 2 ? "" : "s",
                         channel ? ", the channel first" : "", count - 1);
    if (channel && !number_read(words[1], 1, MIDI_CHANNELS, &value))
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: the channel must be 1..16 (got '%.20s')",
                         row->name, words[1]);
    *m = midi_message_make(0, (uint8_t)(row->status | (channel ? value - 1 : 0)), 0, 0);
    const int least = row->status == MIDI_BEND ? -8192 : 0;
    for (int i = 1 + channel; i < wanted; i++) {
        const bool note = channel && has_note(row->status) && i == 2;
        if (note)
            value = midi_note_read(words[i]);
        if (note ? value < 0
                 : !number_read(words[i], least, wide ? least + 16383 : 127, &value))
            return midi_fail(MIDI_BAD_ARGUMENT, "%s: %s must be %d..%d%s (got '%.20s')",
                             row->name, note ? "the note" : "the number", least,
                             wide ? least + 16383 : 127, note ? " or like c#4" : "", words[i]);
        m->bytes[i - channel] = (uint8_t)(value & 0x7f);
        if (wide) {
            m->bytes[1] = (uint8_t)((value - least) & 0x7f);
            m->bytes[2] = (uint8_t)((value - least) >> 7);
        }
    }
    return MIDI_OK;
}

enum midi_status midi_message_read(const char *text, struct midi_message *m)
{
    enum { WORDS_MAX = MIDI_BYTES_MAX + 1 };
    char copy[MIDI_TEXT_MAX], *words[WORDS_MAX], *rest = copy;
    int count = 0;
    *m = (struct midi_message){0};
    if (strlen(text) >= sizeof copy)
        return midi_fail(MIDI_BAD_ARGUMENT, "a message in words has at most %d characters",
                         MIDI_TEXT_MAX - 1);
    memcpy(copy, text, strlen(text) + 1);
    for (char *word; count < WORDS_MAX && (word = strsep(&rest, " \t\n"));)
        if (*word)
            words[count++] = word;
    if (!count)
        return midi_fail(MIDI_BAD_ARGUMENT, "a message is missing, like 'note-on 1 c4 100'");
    for (int i = 0; i < ROWS_COUNT; i++) {
        if (strcmp(rows[i].name, words[0]) != 0)
            continue;
        if (rows[i].status == MIDI_SYSEX)
            return sysex_read(words, count, m);
        if (rows[i].kind == MIDI_KIND_CHANNEL || rows[i].kind == MIDI_KIND_COMMON ||
            rows[i].kind == MIDI_KIND_REAL_TIME)
            return data_read(&rows[i], words, count, m);
    }
    return name_unknown(words[0]);
}
