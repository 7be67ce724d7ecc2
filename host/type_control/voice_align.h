/* voice_align.h - when each word and each letter of a text is said in a sound: the text is
 * aligned to the voice.
 *
 *     struct voice_timing timing;
 *     if (!voice_align(&words, frames, frames_count, silence, &timing))
 *         die("no memory");
 *     timing.words[3].begin_s;              // when the fourth word begins
 *     voice_timing_finish(&timing);
 *
 * The way is dynamic programming over pairs (unit of the text, frame of the sound). A unit
 * (voice_units.h) that lasts so many frames costs by how unlike its expected length that is,
 * and by how unlike its class the frames sound. Between two words there may be a pause, which
 * costs where the sound is a voice, and costs more or less by the sign at the first word's end.
 *
 *     frames   .....vvvvvvsssvvv.......vvvvv....      voice, hiss, nothing
 *     units         el e phan t  (pause) Wh y
 *
 * It goes twice: whole words over long frames to find about where each is, then units over
 * short frames near that place. So time and memory are proportional to the length of the sound.
 *
 * What is no voice. Frames that are no louder than the noise around them, and loud frames that
 * are far from any periodic one. A sound in which almost nothing is periodic (a whisper, a
 * drum) is a voice where it is loud.
 *
 * A text of one word is said whenever the voice sounds, and its letters share this time alike.
 */
#ifndef LUTETIA_VOICE_ALIGN_H
#define LUTETIA_VOICE_ALIGN_H

#include "voice_letters.h"
#include "voice_transcript.h"

#include <voice.h>

/* `silence`: a level of full scale below which nothing is heard. Shape: one span for each word
 * and for each letter of `words`. False: no memory. Owns: the caller finishes *out. */
bool voice_align(const struct voice_words *words, const struct voice_frame *frames, int count,
                 double silence, struct voice_timing *out);
/* The same where a transcript says in which cue each word is; `words` are those of its text. */
bool voice_align_cues(const struct voice_words *words, const struct voice_transcript *cues,
                      const struct voice_frame *frames, int count, double silence,
                      struct voice_timing *out);

/* For each frame whether it is a voice, as said above. Shape: count flags. False: no memory. */
bool voice_frames_spoken(const struct voice_frame *frames, int count, double silence,
                         bool *spoken);

#endif
