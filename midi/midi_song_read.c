/* midi_song_read.c - parses a Standard MIDI File.
 *
 *     MThd 6 format tracks division          numbers with the high byte first
 *     MTrk length  (delta event)...          delta: seven bits a byte, the high bit says that
 *                  another follows
 */
#include "midi_song_internal.h"

#include <input_file.h>

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct reader {
    const char *name;
    const uint8_t *bytes; /* of the whole file */
    size_t at, end;       /* end: of the present chunk, or of the file */
    int track;            /* from 1, for errors; 0: outside of tracks */
    enum midi_status status;
};

/* Sets the error and returns false. */
static bool wrong(struct reader *r, const char *what)
{
    if (r->track)
        r->status = midi_fail(MIDI_BAD_FILE, "%s: track %d %s, at byte %zu", r->name, r->track,
                              what, r->at);
    else
        r->status = midi_fail(MIDI_BAD_FILE, "%s: %s, at byte %zu", r->name, what, r->at);
    return false;
}

static uint32_t number(struct reader *r, int bytes_count)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes_count; i++)
        value = value << 8 | r->bytes[r->at++];
    return value;
}

/* Reads a variable-length number of one to four bytes. */
static bool length_read(struct reader *r, uint32_t *value)
{
    *value = 0;
    for (int i = 0; i < 4; i++) {
        if (r->at == r->end)
            return wrong(r, "ends within an event");
        const uint8_t byte = r->bytes[r->at++];
        *value = *value << 7 | (byte & 0x7f);
        if (byte < 0x80)
            return true;
    }
    return wrong(r, "has a number of more than four bytes");
}

/* Whether `count` more bytes exist. */
static bool there(struct reader *r, size_t count)
{
    return count <= r->end - r->at || wrong(r, "ends within an event");
}

static bool meta_read(struct reader *r, struct midi_song_event *e, bool *ended)
{
    if (!there(r, 1))
        return false;
    e->kind = MIDI_SONG_META;
    e->meta = r->bytes[r->at++];
    if (e->meta > 0x7f)
        return wrong(r, "has a meta event of a type above 7f");
    if (!length_read(r, &e->count) || !there(r, e->count))
        return false;
    *ended = e->meta == MIDI_META_END;
    e->bytes = r->bytes + r->at;
    r->at += e->count;
    return true;
}

/* Reads what follows f0 or f7. A system exclusive is kept with its f0, which precedes the
 * length in the file. */
static bool sysex_read(struct reader *r, struct midi_song *song, struct midi_song_event *e,
                       bool begins)
{
    if (!length_read(r, &e->count) || !there(r, e->count))
        return false;
    e->kind = begins ? MIDI_SONG_SYSEX : MIDI_SONG_ESCAPE;
    e->bytes = r->bytes + r->at;
    r->at += e->count;
    if (!begins)
        return true;
    uint8_t *whole = malloc((size_t)e->count + 1);
    if (!whole) {
        r->status = midi_fail(MIDI_NO_MEMORY, "%s: no memory for %u bytes", r->name, e->count);
        return false;
    }
    whole[0] = MIDI_SYSEX;
    memcpy(whole + 1, e->bytes, e->count);
    e->bytes = whole;
    e->count++;
    r->status = midi_song_add(song, e);
    free(whole);
    e->count = 0; /* added here */
    e->bytes = NULL;
    return r->status == MIDI_OK;
}

static bool message_read(struct reader *r, struct midi_song_event *e, uint8_t status,
                         uint8_t room[static 3])
{
    const int data = midi_row_of(status)->data_count;
    if (!there(r, (size_t)data))
        return false;
    room[0] = status;
    for (int i = 0; i < data; i++) {
        room[1 + i] = r->bytes[r->at++];
        if (room[1 + i] > 0x7f) {
            r->at--;
            return wrong(r, "has a status byte where data must be");
        }
    }
    e->kind = MIDI_SONG_MESSAGE;
    e->bytes = room;
    e->count = (uint32_t)(1 + data);
    return true;
}

static bool event_read(struct reader *r, struct midi_song *song, uint32_t tick,
                       uint8_t *running, bool *ended)
{
    struct midi_song_event e = {.tick = tick, .track = (uint16_t)(r->track - 1)};
    uint8_t room[3];
    if (!there(r, 1))
        return false;
    uint8_t status = r->bytes[r->at];
    if (status >= 0x80)
        r->at++;
    else if (!*running)
        return wrong(r, "has data without a status byte");
    else
        status = *running;
    if (status == 0xff) {
        if (!meta_read(r, &e, ended))
            return false;
    } else if (status == MIDI_SYSEX || status == MIDI_SYSEX_END) {
        *running = 0;
        if (!sysex_read(r, song, &e, status == MIDI_SYSEX))
            return false;
        if (status == MIDI_SYSEX)
            return true;
    } else if (status >= 0xf0) {
        r->at--;
        return wrong(r, "has a system message, which no file can have");
    } else {
        *running = status;
        if (!message_read(r, &e, status, room))
            return false;
    }
    r->status = *ended ? midi_song_end(song, r->track - 1, tick) : midi_song_add(song, &e);
    return r->status == MIDI_OK;
}

static enum midi_status track_read(struct reader *r, struct midi_song *song)
{
    uint32_t tick = 0, delta;
    uint8_t running = 0;
    bool ended = false;
    r->status = midi_song_end(song, r->track - 1, 0);
    while (r->status == MIDI_OK && !ended && r->at < r->end) {
        if (!length_read(r, &delta))
            break;
        if (delta > UINT32_MAX - tick)
            wrong(r, "is longer than 2^32 ticks");
        tick += delta;
        if (r->status != MIDI_OK)
            break;
        if (r->at == r->end) /* a last delta without an event: some programs end tracks so */
            r->status = midi_song_end(song, r->track - 1, tick);
        else
            event_read(r, song, tick, &running, &ended);
    }
    return r->status;
}

/* Reads a chunk's four letters and its length; r->at is at its content, which ends at *end. */
static bool chunk_read(struct reader *r, size_t file_end, const char *letters, size_t *end)
{
    if (file_end - r->at < 8)
        return false;
    const bool is = !memcmp(r->bytes + r->at, letters, 4);
    r->at += 4;
    const uint32_t length = number(r, 4);
    *end = length <= file_end - r->at ? r->at + length : SIZE_MAX;
    return is;
}

static enum midi_status tracks_read(struct reader *r, struct midi_song *song, size_t file_end,
                                    int tracks_said)
{
    int found = 0;
    while (r->status == MIDI_OK && file_end - r->at >= 8 && found < tracks_said) {
        size_t end;
        r->track = 0;
        const bool is = chunk_read(r, file_end, "MTrk", &end);
        if (is)
            r->track = ++found;
        if (end == SIZE_MAX) {
            wrong(r, is ? "says it is longer than the file"
                        : "a chunk says it is longer than the file");
            break;
        }
        r->end = end;
        if (is)
            track_read(r, song);
        r->at = end;
    }
    if (r->status == MIDI_OK && !found) {
        r->track = 0;
        wrong(r, "no track is in it");
    }
    return r->status;
}

enum midi_status midi_song_parse(const char *name, const uint8_t *bytes, size_t count,
                                 struct midi_song **out)
{
    struct reader r = {.name = name, .bytes = bytes, .end = count};
    size_t end;
    *out = NULL;
    if (count > SONG_BYTES_MAX)
        return midi_fail(MIDI_BAD_FILE, "%s: a MIDI file has at most %d MiB", name,
                         SONG_BYTES_MAX >> 20);
    if (count > 20 && !memcmp(bytes, "RIFF", 4) && !memcmp(bytes + 8, "RMIDdata", 8))
        r.at = 20;
    if (!chunk_read(&r, count, "MThd", &end))
        return midi_fail(MIDI_BAD_FILE, "%s: no MIDI file: it does not begin with MThd", name);
    if ((end == SIZE_MAX || end - r.at < 6) && !wrong(&r, "the header is cut off"))
        return r.status;
    const int format = (int)number(&r, 2), tracks = (int)number(&r, 2);
    const int division = (int)number(&r, 2);
    if (format > 1)
        return midi_fail(
            MIDI_BAD_FILE,
            "%s: format %d is not read, only 0 (one track) and 1 (tracks that play "
            "together)",
            name, format);
    struct midi_song_def def = {format, division};
    if (division & 0x8000) /* frames are negative; the ticks of a frame follow */
        def.division = -((256 - (division >> 8)) << 8 | (division & 255));
    if (midi_song_create(&def, out) == MIDI_NO_MEMORY)
        return MIDI_NO_MEMORY;
    if (!*out)
        return midi_fail(MIDI_BAD_FILE, "%s: its division of %04x means nothing", name,
                         (unsigned)division);
    r.at = end;
    if (tracks_read(&r, *out, count, format ? tracks : 1) == MIDI_OK)
        r.status = song_sort(*out);
    if (r.status != MIDI_OK) {
        midi_song_destroy(*out);
        *out = NULL;
    }
    return r.status;
}

/* Reads a whole open file. */
static enum midi_status file_read(const char *path, int file, uint8_t **bytes, size_t *count)
{
    struct stat about;
    if (fstat(file, &about) != 0)
        return midi_fail(MIDI_IO_FAILED, "%s: %s", path, strerror(errno));
    if (about.st_size > SONG_BYTES_MAX)
        return midi_fail(MIDI_BAD_FILE, "%s: a MIDI file has at most %d MiB", path,
                         SONG_BYTES_MAX >> 20);
    *bytes = malloc((size_t)about.st_size + 1);
    if (!*bytes)
        return midi_fail(MIDI_NO_MEMORY, "%s: no memory for it", path);
    for (*count = 0; *count < (size_t)about.st_size;) {
        ssize_t got = read(file, *bytes + *count, (size_t)about.st_size - *count);
        if (got < 0)
            return midi_fail(MIDI_IO_FAILED, "%s: %s", path, strerror(errno));
        if (!got)
            break;
        *count += (size_t)got;
    }
    return MIDI_OK;
}

enum midi_status midi_song_read(const char *path, struct midi_song **out)
{
    uint8_t *bytes = NULL;
    size_t count = 0;
    *out = NULL;
    const char *why;
    int file = input_file_descriptor(path, &why);
    if (file < 0)
        return midi_fail(MIDI_IO_FAILED, "%s: %s", path, why);
    enum midi_status status = file_read(path, file, &bytes, &count);
    if (status == MIDI_OK)
        status = midi_song_parse(path, bytes, count, out);
    free(bytes);
    close(file);
    return status;
}
