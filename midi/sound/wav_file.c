/* wav_file.c - see wav_file.h. */
#include "wav_file.h"

#include <string.h>

enum { HEAD = 80, MOMENT = 4, AT_ONCE = 256 };

static uint8_t *little_put(uint8_t *at, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        *at++ = (uint8_t)(value >> 8 * i);
    return at;
}

static uint8_t *chunk_put(uint8_t *at, const char *name, uint64_t size)
{
    memcpy(at, name, 4);
    return little_put(at + 4, size > UINT32_MAX ? UINT32_MAX : size, 4);
}

static bool head_write(const struct wav_file *wav)
{
    const uint64_t bytes = wav->moments * MOMENT, all = HEAD - 8 + bytes;
    const bool is_long = all > UINT32_MAX;
    const uint32_t rate = (uint32_t)wav->rate_hz;
    uint8_t head[HEAD] = {0},
            *at = chunk_put(head, is_long ? "RF64" : "RIFF", is_long ? UINT64_MAX : all);
    memcpy(at, "WAVE", 4);
    at = chunk_put(at + 4, is_long ? "ds64" : "JUNK", 28);
    if (is_long)
        little_put(little_put(little_put(at, all, 8), bytes, 8), wav->moments, 8);
    at = chunk_put(at + 28, "fmt ", 16);
    at = little_put(little_put(at, 1, 2), 2, 2); /* whole numbers, two channels */
    at = little_put(little_put(at, rate, 4), rate * MOMENT, 4);
    at = little_put(little_put(at, MOMENT, 2), 16, 2);
    chunk_put(at, "data", is_long ? UINT64_MAX : bytes);
    return fwrite(head, 1, HEAD, wav->stream) == HEAD;
}

bool wav_file_begin(struct wav_file *wav, FILE *stream, int rate_hz)
{
    *wav = (struct wav_file){.stream = stream, .rate_hz = rate_hz};
    return head_write(wav);
}

bool wav_file_add(struct wav_file *wav, const int16_t *samples, int moments)
{
    for (int done = 0; done < moments; done += AT_ONCE) {
        uint8_t bytes[AT_ONCE * MOMENT], *at = bytes;
        for (int i = 2 * done; i < 2 * moments && i < 2 * (done + AT_ONCE); i++)
            at = little_put(at, (uint16_t)samples[i], 2);
        if (fwrite(bytes, 1, (size_t)(at - bytes), wav->stream) != (size_t)(at - bytes))
            return false;
    }
    wav->moments += (uint64_t)moments;
    return true;
}

bool wav_file_end(struct wav_file *wav)
{
    return fseek(wav->stream, 0, SEEK_SET) == 0 && head_write(wav) && fflush(wav->stream) == 0;
}
