/* fuzz_song.c - reads any bytes as a Standard MIDI File. A file is refused, or reading, writing
 * and reading it again gives the same song. (security.md 29) With libFuzzer it is the target;
 * without, it changes bytes of random songs. */
#include "song_support.h"

#include "../must.h"
#include "../sample.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void message_check(void *context, const struct midi_message *m)
{
    (void)context;
    must(midi_message_good(m));
}

static bool fuzz_one(const uint8_t *bytes, size_t count)
{
    struct midi_song *song, *back;
    if (midi_song_parse("fuzz", bytes, count, &song) != MIDI_OK) {
        must(!song && midi_error()[0]);
        return false;
    }
    const struct midi_song_info info = midi_song_info(song);
    struct midi_parser parser;
    uint64_t before_ns = 0;
    midi_parser_init(&parser);
    for (size_t i = 0; i < info.events_count; i++) {
        const struct midi_song_event e = midi_song_event(song, i);
        must(e.time_ns >= before_ns && e.time_ns <= info.end_ns);
        must(e.track < info.tracks_count);
        before_ns = e.time_ns;
        midi_song_play(&e, &parser, message_check, NULL);
    }
    uint8_t *written;
    size_t written_count;
    must(midi_song_bytes(song, &written, &written_count) == MIDI_OK);
    must(midi_song_parse("written", written, written_count, &back) == MIDI_OK);
    must(!songs_differ(song, back));
    midi_song_destroy(song);
    midi_song_destroy(back);
    free(written);
    return true;
}

#ifdef LUTETIA_FUZZ_TARGET
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_one(bytes, count);
    return 0;
}
#else
int main(void)
{
    uint64_t seed = 8;
    int read = 0;
    enum { TURNS = 3000 };
    for (int turn = 0; turn < TURNS; turn++) {
        struct midi_song *song = song_by_chance(&seed, (int)(sample_word(&seed) % 12));
        uint8_t *bytes;
        size_t count;
        must(midi_song_bytes(song, &bytes, &count) == MIDI_OK);
        midi_song_destroy(song);
        for (uint64_t k = sample_word(&seed) % 5; k; k--) {
            const uint64_t any = sample_word(&seed);
            bytes[(any >> 8) % count] = (uint8_t)(any >> 40);
            if (any % 16 == 0)
                count = 1 + (any >> 8) % count;
        }
        read += fuzz_one(bytes, count);
        free(bytes);
    }
    printf("%d of %d were songs\n", read, TURNS);
    must(read > TURNS / 10 && read < TURNS);
    return 0;
}
#endif
