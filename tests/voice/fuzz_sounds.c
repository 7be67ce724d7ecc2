/* fuzz_sounds.c - reads damaged WAV files. Each is refused in one line, or analysed without
 * harm. `fuzz_sounds FILE [ROUNDS]` */
#include <voice.h>
#include <voice_sound.h>

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SAMPLES = 400, BYTES = 44 + 2 * SAMPLES };

static uint64_t state = 1990;

static uint64_t chance(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

static bool file_make(const char *path, const uint8_t *bytes, size_t count)
{
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    bool done = file >= 0 && write(file, bytes, count) == (ssize_t)count;
    if (file >= 0)
        close(file);
    return done;
}

int main(int argc, char **argv)
{
    long rounds = argc > 2 ? strtol(argv[2], NULL, 10) : 400, heard = 0;
    float samples[SAMPLES];
    uint8_t whole[BYTES], bytes[BYTES];
    struct voice_sound sound = {samples, SAMPLES, 8000};
    struct voice_def def = voice_def_default();
    if (argc < 2)
        return 2;
    for (int i = 0; i < SAMPLES; i++)
        samples[i] = (float)((double)(chance() >> 11) * 0x1p-52 - 1);
    int file = open(argv[1], O_RDWR | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || !voice_sound_write(file, &sound) || pread(file, whole, BYTES, 0) != BYTES)
        return 1;
    close(file);
    for (long round = 0; round < rounds; round++) {
        struct voice_sound read;
        struct voice_frame *frames;
        char why[200] = "";
        int count;
        memcpy(bytes, whole, BYTES);
        for (uint64_t i = chance() % 6; i > 0; i--)
            bytes[chance() % (chance() % 4 ? 44 : BYTES)] = (uint8_t)chance();
        size_t length = chance() % 3 ? BYTES : chance() % (BYTES + 1);
        if (!file_make(argv[1], bytes, length))
            return 1;
        if (!voice_sound_read(argv[1], &read, why, sizeof why)) {
            if (!*why || strchr(why, '\n')) {
                fprintf(stderr, "round %ld: not one line: '%s'\n", round, why);
                return 1;
            }
            continue;
        }
        heard++;
        if (!voice_frames(&def, read.samples, read.count, read.rate_hz, &frames, &count))
            return 1;
        free(frames);
        voice_sound_finish(&read);
    }
    unlink(argv[1]);
    printf("%ld of %ld heard\n", heard, rounds);
    return heard == 0 || heard == rounds;
}
