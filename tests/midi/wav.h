/* wav.h - reads WAV files that FluidSynth writes, and measures their sound. Include after
 * cmocka.h. */
#ifndef LUTETIA_TESTS_MIDI_WAV_H
#define LUTETIA_TESTS_MIDI_WAV_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct wav {
    int rate_hz, channels;
    long count; /* of moments */
    int16_t *samples;
};

static inline uint32_t wav_little(const uint8_t *bytes, int count)
{
    uint32_t value = 0;
    for (int i = count - 1; i >= 0; i--)
        value = value << 8 | bytes[i];
    return value;
}

/* The chunks that FluidSynth writes. */
static inline struct wav wav_read(const char *path)
{
    struct wav w = {.count = 0};
    FILE *file = fopen(path, "rb");
    uint8_t head[12], chunk[8], format[16];
    assert_non_null(file);
    assert_int_equal(fread(head, 1, 12, file), 12);
    assert_memory_equal(head, "RIFF", 4);
    assert_memory_equal(head + 8, "WAVE", 4);
    while (fread(chunk, 1, 8, file) == 8) {
        const uint32_t length = wav_little(chunk + 4, 4);
        if (!memcmp(chunk, "fmt ", 4)) {
            assert_int_equal(fread(format, 1, 16, file), 16);
            assert_int_equal(wav_little(format, 2), 1);
            assert_int_equal(wav_little(format + 14, 2), 16);
            w.channels = (int)wav_little(format + 2, 2);
            w.rate_hz = (int)wav_little(format + 4, 4);
            fseek(file, (long)length - 16, SEEK_CUR);
        } else if (!memcmp(chunk, "data", 4)) {
            w.samples = malloc(length);
            assert_non_null(w.samples);
            assert_int_equal(fread(w.samples, 1, length, file), length);
            w.count = (long)(length / 2) / w.channels;
        } else {
            fseek(file, (long)length, SEEK_CUR);
        }
    }
    fclose(file);
    assert_non_null(w.samples);
    return w;
}

/* The greatest sample between two times, of all channels. */
static inline int wav_peak(const struct wav *w, double from_s, double to_s)
{
    int loudest = 0;
    for (long i = from_s > 0 ? (long)(from_s * w->rate_hz) : 0;
         i < (long)(to_s * w->rate_hz) && i < w->count; i++)
        for (int c = 0; c < w->channels; c++) {
            const int sample = abs(w->samples[i * w->channels + c]);
            loudest = sample > loudest ? sample : loudest;
        }
    return loudest;
}

/* Finds onsets: milliseconds that are loud, and louder than the ten before. Returns how
 * many. */
static inline int wav_onsets(const struct wav *w, double *times_s, int most)
{
    const double step_s = 0.001;
    int count = 0;
    double last_s = -1;
    for (double t = 0; t < (double)w->count / w->rate_hz && count < most; t += step_s) {
        const int now = wav_peak(w, t, t + step_s);
        if (now > 60 && now > 2 * wav_peak(w, t - 0.012, t - 0.002 + 1e-9) &&
            t - last_s > 0.05) {
            times_s[count++] = t;
            last_s = t;
        }
    }
    return count;
}

#endif
