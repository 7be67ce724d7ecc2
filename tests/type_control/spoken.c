/* spoken.c - see spoken.h. */
#include "spoken.h"

#include <espeak-ng/speak_lib.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct spoken *saying;
static size_t said_from;     /* the first sample of the sentence */
static int said_byte;        /* its first byte */
static const char *sentence; /* UTF-8 */

static void *grown(void *at, size_t bytes)
{
    void *more = realloc(at, bytes);
    if (!more)
        abort();
    return more;
}

static void samples_room(struct spoken *s, size_t more)
{
    if (s->count + more <= s->room)
        return;
    s->room = 2 * (s->count + more) + 65536;
    s->samples = grown(s->samples, s->room * sizeof *s->samples);
}

/* The byte of a character of the sentence, counted from 1. */
static int byte_of(int character)
{
    const char *at = sentence;
    for (int i = 1; i < character && *at; i++)
        do
            at++;
        while (((unsigned char)*at & 0xc0) == 0x80);
    return (int)(at - sentence);
}

static void word_add(struct spoken *s, int byte, double begin_s)
{
    if (s->words_count > 0 && s->words[s->words_count - 1].byte >= byte)
        return; /* a word that it says in two parts begins once */
    if (s->words_count == s->words_room) {
        s->words_room = 2 * s->words_room + 64;
        s->words = grown(s->words, (size_t)s->words_room * sizeof *s->words);
    }
    s->words[s->words_count++] = (struct spoken_word){byte, begin_s};
}

static int heard(short *wave, int count, espeak_EVENT *events)
{
    struct spoken *s = saying;
    for (; events && events->type != espeakEVENT_LIST_TERMINATED; events++)
        if (events->type == espeakEVENT_WORD)
            word_add(s, said_byte + byte_of(events->text_position),
                     (double)said_from / s->rate_hz + events->audio_position / 1000.0);
    if (!wave || count <= 0)
        return 0;
    samples_room(s, (size_t)count);
    for (int i = 0; i < count; i++)
        s->samples[s->count++] = (float)wave[i] / 32768.0F;
    return 0;
}

bool spoken_begin(struct spoken *out, const char *language)
{
    static int rate_hz;
    *out = (struct spoken){0};
    if (!rate_hz)
        rate_hz =
            espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, NULL, espeakINITIALIZE_DONT_EXIT);
    out->rate_hz = rate_hz;
    espeak_SetSynthCallback(heard);
    return rate_hz > 0 && espeak_SetVoiceByName(language) == EE_OK;
}

void spoken_say(struct spoken *s, const char *text)
{
    const size_t bytes = strlen(text);
    if (s->text_bytes + bytes + 2 > s->text_room) {
        s->text_room = 2 * (s->text_bytes + bytes) + 1024;
        s->text = grown(s->text, s->text_room);
    }
    memcpy(s->text + s->text_bytes, text, bytes);
    saying = s;
    sentence = text;
    said_from = s->count;
    said_byte = (int)s->text_bytes;
    s->text_bytes += bytes;
    s->text[s->text_bytes++] = ' ';
    s->text[s->text_bytes] = '\0';
    if (espeak_Synth(text, bytes + 1, 0, POS_CHARACTER, 0, espeakCHARS_UTF8, NULL, NULL) !=
        EE_OK)
        abort();
    espeak_Synchronize();
}

/* The same numbers everywhere. */
static float noise_next(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (float)((double)state / 2147483648.0 - 1);
}

void spoken_noise(struct spoken *s, double seconds, double level)
{
    const size_t count = (size_t)(seconds * s->rate_hz);
    samples_room(s, count);
    for (size_t i = 0; i < count; i++)
        s->samples[s->count++] = (float)level * 1.732F * noise_next();
}

void spoken_silence(struct spoken *s, double seconds)
{
    spoken_noise(s, seconds, 0);
}

void spoken_noise_over(struct spoken *s, double level)
{
    for (size_t i = 0; i < s->count; i++)
        s->samples[i] += (float)level * 1.732F * noise_next();
}

void spoken_end(struct spoken *s)
{
    free(s->text);
    free(s->samples);
    free(s->words);
    *s = (struct spoken){0};
}
