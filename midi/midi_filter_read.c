/* midi_filter_read.c - parses the text of a chain of filters. */
#include "midi_filter_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool number_read(const char *text, double least, double most, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return end != text && !*end && *value >= least && *value <= most;
}

static bool whole_read(const char *text, int least, int most, int *value)
{
    double number;
    if (!number_read(text, least, most, &number) || number != floor(number))
        return false;
    *value = (int)number;
    return true;
}

/* ---- names of messages ---- */

static const struct {
    const char *name;
    const char *rows[8];
} groups[] = {
    {"aftertouch", {"poly-pressure", "pressure"}},
    {"real-time", {"clock", "start", "continue", "stop", "sensing", "reset"}},
    {"controls", {"control"}},
    {"notes", {"note-off", "note-on"}},
};

static uint32_t row_bit(const char *name)
{
    int count;
    const struct midi_row *rows = midi_rows(&count);
    for (int i = 0; i < count; i++)
        if (!strcmp(rows[i].name, name))
            return UINT32_C(1) << i;
    return 0;
}

static enum midi_status names_read(char *text, uint32_t *bits)
{
    *bits = 0;
    for (char *word; (word = strsep(&text, ","));) {
        uint32_t found = row_bit(word);
        for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
            for (int k = 0; !strcmp(groups[i].name, word) && groups[i].rows[k]; k++)
                found |= row_bit(groups[i].rows[k]);
        if (!found)
            return midi_fail(
                MIDI_BAD_ARGUMENT,
                "there is no message '%.40s' to filter; known are note-off, "
                "note-on, poly-pressure, control, program, pressure, bend, sysex, "
                "quarter-frame, song-position, song-select, tune-request, clock, "
                "start, continue, stop, sensing, reset, and aftertouch, real-time, "
                "controls, notes",
                word);
        *bits |= found;
    }
    return MIDI_OK;
}

/* ---- a link each ---- */

static enum midi_status drop_read(char *text, struct midi_link *link)
{
    return names_read(text, &link->rows);
}

static enum midi_status keep_read(char *text, struct midi_link *link)
{
    enum midi_status status = names_read(text, &link->rows);
    link->rows = ~link->rows;
    return status;
}

static enum midi_status channels_read(char *text, struct midi_link *link)
{
    for (char *word; (word = strsep(&text, ","));) {
        char *last = word, *first = strsep(&last, "-");
        int from, to;
        if (!whole_read(first, 1, MIDI_CHANNELS, &from) ||
            !whole_read(last ? last : first, 1, MIDI_CHANNELS, &to) || to < from)
            return midi_fail(MIDI_BAD_ARGUMENT,
                             "channels= takes numbers and ranges of 1..16, like 1-4,10");
        for (int i = from; i <= to; i++)
            link->channels |= (uint16_t)(1u << (i - 1));
    }
    return MIDI_OK;
}

static enum midi_status notes_read(char *text, struct midi_link *link)
{
    /* the first - after the first character separates the two notes: c-1-c4 */
    char *part = text[0] ? strchr(text + 1, '-') : NULL;
    if (part && (part[-1] < '0' || part[-1] > '9'))
        part = strchr(part + 1, '-'); /* that - was the sign of an octave */
    if (part)
        *part++ = '\0';
    link->least = midi_note_read(text);
    link->most = part ? midi_note_read(part) : link->least;
    if (link->least < 0 || link->most < link->least)
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "notes= takes a range from low to high, like c2-c6 or 36-84");
    return MIDI_OK;
}

static enum midi_status transpose_read(char *text, struct midi_link *link)
{
    if (!whole_read(text, -127, 127, &link->steps))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "transpose= takes semitones, -127..127 (got '%.20s')", text);
    return MIDI_OK;
}

static enum midi_status velocity_read(char *text, struct midi_link *link)
{
    double power = 1;
    int fixed = 0;
    if (!strncmp(text, "fixed:", 6) ? !whole_read(text + 6, 1, 127, &fixed)
                                    : !number_read(text, 0.05, 20, &power))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "velocity= takes a power, 0.05..20, or fixed:1..127 (got '%.20s')",
                         text);
    for (int v = 1; v < 128; v++) { /* a note-on stays a note-on: never velocity 0 */
        const double curved = 127 * pow(v / 127.0, power);
        link->curve[v] = (uint8_t)(fixed ? fixed : fmax(1, round(curved)));
    }
    return MIDI_OK;
}

static enum midi_status channel_read(char *text, struct midi_link *link)
{
    if (!whole_read(text, 1, MIDI_CHANNELS, &link->channel))
        return midi_fail(MIDI_BAD_ARGUMENT, "channel= takes a number, 1..16 (got '%.20s')",
                         text);
    link->channel--;
    return MIDI_OK;
}

static enum midi_status split_read(char *text, struct midi_link *link)
{
    char *channel = text;
    strsep(&channel, ":");
    link->least = midi_note_read(text);
    if (link->least < 0 || !channel || !whole_read(channel, 1, MIDI_CHANNELS, &link->channel))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "split= takes a note and the channel of those below it, like c4:2");
    link->channel--;
    return MIDI_OK;
}

static enum midi_status thin_read(char *text, struct midi_link *link)
{
    double ms;
    if (!number_read(text, 0.1, 10000, &ms))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "thin= takes milliseconds, 0.1..10000 (got '%.20s')", text);
    link->interval_ns = (uint64_t)(1e6 * ms);
    link->held = calloc(MIDI_HELD_MAX, sizeof *link->held);
    return link->held ? MIDI_OK
                      : midi_fail(MIDI_NO_MEMORY, "no memory for a filter that thins");
}

static const struct {
    const char *name;
    enum midi_link_kind kind;
    enum midi_status (*read)(char *text, struct midi_link *link);
} readers[] = {
    {"drop", MIDI_LINK_DROP, drop_read},
    {"keep", MIDI_LINK_DROP, keep_read},
    {"channels", MIDI_LINK_CHANNELS, channels_read},
    {"notes", MIDI_LINK_NOTES, notes_read},
    {"transpose", MIDI_LINK_TRANSPOSE, transpose_read},
    {"velocity", MIDI_LINK_VELOCITY, velocity_read},
    {"channel", MIDI_LINK_CHANNEL, channel_read},
    {"split", MIDI_LINK_SPLIT, split_read},
    {"thin", MIDI_LINK_THIN, thin_read},
};

enum { READERS_COUNT = sizeof readers / sizeof *readers };

static enum midi_status link_read(char *word, struct midi_chain *chain)
{
    char *value = word;
    strsep(&value, "=");
    for (int i = 0; i < READERS_COUNT; i++) {
        if (strcmp(readers[i].name, word) != 0)
            continue;
        if (!value || !*value)
            return midi_fail(MIDI_BAD_ARGUMENT, "the filter %s needs a value: %s=...", word,
                             word);
        if (chain->links_count == MIDI_LINKS_MAX)
            return midi_fail(MIDI_BAD_ARGUMENT, "a chain has at most %d filters",
                             MIDI_LINKS_MAX);
        struct midi_link *link = &chain->links[chain->links_count++];
        link->kind = readers[i].kind;
        return readers[i].read(value, link);
    }
    return midi_fail(MIDI_BAD_ARGUMENT,
                     "there is no filter '%.40s'; known are drop, keep, channels, notes, "
                     "transpose, velocity, channel, split, thin",
                     word);
}

enum midi_status midi_chain_create(const char *text, struct midi_chain **out)
{
    struct midi_chain *chain = calloc(1, sizeof *chain);
    char *copy = strdup(text), *rest = copy;
    enum midi_status status = MIDI_OK;
    *out = NULL;
    if (!chain || !copy)
        status = midi_fail(MIDI_NO_MEMORY, "no memory for a chain of filters");
    for (char *word; status == MIDI_OK && (word = strsep(&rest, " \t\n"));)
        if (*word)
            status = link_read(word, chain);
    free(copy);
    if (status != MIDI_OK) {
        midi_chain_destroy(chain);
        return status;
    }
    *out = chain;
    return MIDI_OK;
}
