/* voice_transcript.h - a text with times: subtitles as SRT or WebVTT.
 *
 *     1                                    WEBVTT
 *     00:00:01,000 --> 00:00:02,500
 *     The elephant.                        00:01.000 --> 00:02.500 align:start
 *                                          The <00:01.400>elephant.
 *
 * Tags and names of speakers are left out; times within a WebVTT line divide it. Cues begin one
 * after the other; one that lasts into the next ends where that begins.
 */
#ifndef LUTETIA_VOICE_TRANSCRIPT_H
#define LUTETIA_VOICE_TRANSCRIPT_H

#include <stdbool.h>
#include <stddef.h>

struct voice_cue {
    double begin_s, end_s;
    char *text; /* UTF-8, with a word at least */
};

struct voice_transcript {
    struct voice_cue *cues;
    int count;
    char *text; /* of all cues, with a space between two */
};

/* False: `why` gets the reason in one line, with the number of the line that is wrong; *out is
 * then empty. Owns: the caller finishes *out. */
bool voice_transcript_read(const char *path, struct voice_transcript *out, char *why,
                           size_t room);
/* The same of bytes in memory; `name` is for the reason. */
bool voice_transcript_parse(const char *name, const char *bytes, size_t count,
                            struct voice_transcript *out, char *why, size_t room);
void voice_transcript_finish(struct voice_transcript *transcript); /* an empty one is fine */

#endif
