/* voice_sound.c - sounds in memory, and to WAV files. */
#include "voice_sound.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

enum { SAMPLES_AT_ONCE = 4096 };

void voice_sound_finish(struct voice_sound *sound)
{
    free(sound->samples);
    *sound = (struct voice_sound){0};
}

static bool all_written(int descriptor, const void *bytes, size_t count)
{
    const char *at = bytes;
    while (count > 0) {
        ssize_t done = write(descriptor, at, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return false;
        at += done;
        count -= (size_t)done;
    }
    return true;
}

bool voice_sound_write(int descriptor, const struct voice_sound *sound)
{
    uint32_t bytes = (uint32_t)(2 * sound->count), rate = (uint32_t)sound->rate_hz;
    struct {
        char riff[4];
        uint32_t size;
        char wave[4], format[4];
        uint32_t format_size;
        uint16_t kind, channels;
        uint32_t rate, bytes_second;
        uint16_t block, bits;
        char data[4];
        uint32_t bytes;
    } head = {{'R', 'I', 'F', 'F'},
              36 + bytes,
              {'W', 'A', 'V', 'E'},
              {'f', 'm', 't', ' '},
              16,
              1,
              1,
              rate,
              2 * rate,
              2,
              16,
              {'d', 'a', 't', 'a'},
              bytes};
    _Static_assert(sizeof head == 44, "as in files");
    int16_t some[SAMPLES_AT_ONCE];
    bool done = all_written(descriptor, &head, sizeof head);
    for (size_t at = 0; at < sound->count && done; at += SAMPLES_AT_ONCE) {
        size_t count =
            sound->count - at < SAMPLES_AT_ONCE ? sound->count - at : SAMPLES_AT_ONCE;
        for (size_t i = 0; i < count; i++)
            some[i] = (int16_t)lrintf(32767 * sound->samples[at + i]);
        done = all_written(descriptor, some, 2 * count);
    }
    return done;
}
