/* wav_file.h - a WAV file of 16 bits and two channels, written as its samples come.
 *
 *     struct wav_file wav;
 *     bool whole = wav_file_begin(&wav, stream, 44100) && wav_file_add(&wav, samples, 64) && wav_file_end(&wav);
 *
 *     RIFF size WAVE | JUNK 28 zeros | fmt  format | data size | left right left right ...
 *
 * From 4 GB on, which the sizes cannot tell, the file is an RF64 (EBU Tech 3306): then ds64
 * takes the place of JUNK.
 *
 * Errors: false, with errno. Ownership: the stream is the caller's, and must be able to go
 * back. Threads: one at a time. */
#ifndef LUTETIA_MIDI_WAV_FILE_H
#define LUTETIA_MIDI_WAV_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct wav_file {
    FILE *stream;
    int rate_hz;
    uint64_t moments;
};

bool wav_file_begin(struct wav_file *wav, FILE *stream, int rate_hz);
/* Shape: `moments` pairs of left and right. */
bool wav_file_add(struct wav_file *wav, const int16_t *samples, int moments);
/* Writes the sizes at the beginning; the stream stays open. */
bool wav_file_end(struct wav_file *wav);

#endif
