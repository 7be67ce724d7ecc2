/* song_support.h - songs by chance, and whether two are the same. */
#ifndef LUTETIA_TESTS_MIDI_SONG_SUPPORT_H
#define LUTETIA_TESTS_MIDI_SONG_SUPPORT_H

#include <midi_song.h>

/* A song with notes, tempos, system exclusive, texts; seed: the same gives the same. Owns: the caller. */
struct midi_song *song_by_chance(uint64_t *seed, int events_count);

/* NULL: the same events at the same ticks and times, and the same ends; else what differs. */
const char *songs_differ(struct midi_song *a, struct midi_song *b);

#endif
