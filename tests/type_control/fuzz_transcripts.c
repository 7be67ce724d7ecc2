/* fuzz_transcripts.c - damaged subtitles: each is refused in one line, or its cues are in order
 * and have words. `fuzz_transcripts [ROUNDS]` */
#include <voice_transcript.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const pieces[] = {"WEBVTT\n",
                                     "\n",
                                     "\r\n",
                                     "1\n",
                                     "NOTE",
                                     "STYLE\n",
                                     "00:01.000",
                                     "00:00:02,500",
                                     " --> ",
                                     "-->",
                                     "00:03.000 --> 00:04.000\n",
                                     "00:00:04,000 --> 00:00:09,000\n",
                                     "word",
                                     "Aagh! ",
                                     "<b>",
                                     "</b>",
                                     "<00:05.000>",
                                     "<",
                                     ">",
                                     "{\\an8}",
                                     "{",
                                     "}",
                                     "&amp;",
                                     "&",
                                     "\xd8\xb9",
                                     "\xff",
                                     "99999999999:99",
                                     "\xef\xbb\xbf",
                                     "00:00.000 --> 99:59:59.999 x\n"};
enum { PIECES = sizeof pieces / sizeof *pieces };

static uint64_t state = 1990;

static uint64_t chance(uint64_t below)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state % below;
}

static int look(const struct voice_transcript *t)
{
    double before_s = 0;
    for (int i = 0; i < t->count; i++) {
        const struct voice_cue *c = &t->cues[i];
        if (c->begin_s < before_s || c->end_s < c->begin_s || !*c->text ||
            strchr(c->text, '\n'))
            return 1;
        before_s = c->begin_s;
    }
    return t->count == 0 || !t->text;
}

int main(int argc, char **argv)
{
    const long rounds = argc > 1 ? strtol(argv[1], NULL, 10) : 20000;
    long read = 0;
    for (long round = 0; round < rounds; round++) {
        struct voice_transcript t;
        char text[1024], why[300] = "";
        size_t count = 0;
        for (uint64_t n = chance(24); n > 0; n--) {
            const char *piece = pieces[chance(PIECES)];
            memcpy(text + count, piece, strlen(piece));
            count += strlen(piece);
        }
        for (uint64_t n = count ? chance(3) : 0; n > 0; n--)
            text[chance(count)] = (char)chance(256);
        char *own = malloc(count + 1); /* so that each byte beyond is seen */
        if (!own)
            return 1;
        memcpy(own, text, count);
        if (voice_transcript_parse("x", own, count, &t, why, sizeof why)) {
            read++;
            if (look(&t)) {
                fprintf(stderr, "round %ld: cues that are wrong\n", round);
                return 1;
            }
            voice_transcript_finish(&t);
        } else if (!*why || strchr(why, '\n')) {
            fprintf(stderr, "round %ld: not one line: '%s'\n", round, why);
            return 1;
        }
        free(own);
    }
    printf("%ld of %ld read\n", read, rounds);
    return read == 0 || read == rounds;
}
