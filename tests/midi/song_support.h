/* song_support.h - random songs, and a comparison of songs. */
#ifndef LUTETIA_TESTS_MIDI_SONG_SUPPORT_H
#define LUTETIA_TESTS_MIDI_SONG_SUPPORT_H

#include <midi_song.h>

/* Draws a song with notes, tempos, system exclusives and texts. The same seed gives the same
 * song. Owns: the caller. */
struct midi_song *song_by_chance(uint64_t *seed, int events_count);

/* Compares events, ticks, times and ends. Returns NULL or a text that tells what differs. */
const char *songs_differ(struct midi_song *a, struct midi_song *b);

#endif
