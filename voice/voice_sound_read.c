/* voice_sound_read.c - reads sound files by libsndfile. The library is loaded when the first
 * sound is read, because it brings many codecs, and most commands read no sounds. */
#include "voice_sound.h"

#include <sndfile.h>

#include <errno.h>
#include <fcntl.h>
#include <input_file.h>
#include <library.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FRAMES_AT_ONCE = 4096, CHANNELS_MAX = 64 };

struct sndfile {
    SNDFILE *(*sf_open_fd)(int, int, SF_INFO *, int);
    sf_count_t (*sf_readf_float)(SNDFILE *, float *, sf_count_t);
    int (*sf_close)(SNDFILE *);
};

/* False: libsndfile is not installed. It stays loaded for the next sound. */
static bool sndfile_load(struct sndfile *out)
{
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(struct sndfile, sf_open_fd),
        LIBRARY_FUNCTION(struct sndfile, sf_readf_float),
        LIBRARY_FUNCTION(struct sndfile, sf_close)};
    const char *missing;
    return library_load("libsndfile.so.1", functions, sizeof functions / sizeof *functions, out,
                        &missing);
}

/* Appends the rest of the file. False: no memory, or the sound is too long: then *too_long
 * is true. */
static bool frames_read(const struct sndfile *library, SNDFILE *file, const SF_INFO *info,
                        struct voice_sound *out, bool *too_long)
{
    size_t room = 0, most = (size_t)VOICE_SECONDS_MAX * (size_t)info->samplerate;
    float *frames = malloc(sizeof *frames * FRAMES_AT_ONCE * (size_t)info->channels);
    bool memory = frames != NULL;
    *too_long = false;
    while (memory && !*too_long) {
        sf_count_t count = library->sf_readf_float(file, frames, FRAMES_AT_ONCE);
        if (count <= 0)
            break;
        *too_long = out->count + (size_t)count > most;
        if (out->count + (size_t)count > room) {
            room = 2 * room + FRAMES_AT_ONCE;
            float *grown = realloc(out->samples, room * sizeof *grown);
            memory = grown != NULL;
            if (!grown)
                break;
            out->samples = grown;
        }
        for (sf_count_t i = 0; i < count; i++) {
            float sum = 0;
            for (int c = 0; c < info->channels; c++)
                sum += frames[i * info->channels + c];
            sum /= (float)info->channels;
            out->samples[out->count++] = isfinite(sum) ? fmaxf(-1, fminf(1, sum)) : 0;
        }
    }
    free(frames);
    return memory && !*too_long;
}

static bool refuse(struct voice_sound *out, char *why, size_t room, const char *path,
                   const char *what)
{
    snprintf(why, room, "%s: %s", path, what);
    voice_sound_finish(out);
    return false;
}

bool voice_sound_read(const char *path, struct voice_sound *out, char *why, size_t room)
{
    SF_INFO info = {0};
    struct sndfile library;
    bool too_long;
    *out = (struct voice_sound){0};
    int descriptor = input_file_descriptor(path, NULL);
    if (descriptor < 0)
        return refuse(out, why, room, path,
                      errno == ENOTSUP || errno == EISDIR ? "a sound must be a regular file"
                                                          : strerror(errno));
    if (!sndfile_load(&library)) {
        close(descriptor);
        return refuse(out, why, room, path, "sounds need libsndfile: install libsndfile1");
    }
    SNDFILE *file = library.sf_open_fd(descriptor, SFM_READ, &info, 0);
    if (!file) {
        close(descriptor);
        return refuse(out, why, room, path,
                      "not a sound that can be read (WAV, FLAC, AIFF, Ogg, ...)");
    }
    bool good = info.channels >= 1 && info.channels <= CHANNELS_MAX &&
                info.samplerate >= VOICE_RATE_MIN && info.samplerate <= VOICE_RATE_MAX;
    out->rate_hz = info.samplerate;
    bool done = good && frames_read(&library, file, &info, out, &too_long);
    library.sf_close(file);
    close(descriptor);
    if (!good)
        return refuse(
            out, why, room, path,
            "a sound must have 1 to 64 channels and 4,000 to 384,000 samples a second");
    if (!done)
        return refuse(out, why, room, path,
                      too_long ? "the sound is longer than an hour and a half" : "no memory");
    if (out->count == 0)
        return refuse(out, why, room, path, "there is no sound in it");
    return true;
}
