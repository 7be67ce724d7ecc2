/* voice_sound_none.c - for builds without libsndfile: reading fails with a message. */
#include "voice_sound.h"

#include <stdio.h>

bool voice_sound_read(const char *path, struct voice_sound *out, char *why, size_t room)
{
    *out = (struct voice_sound){0};
    snprintf(why, room,
             "%s: this build reads no sounds; install libsndfile1-dev and build anew", path);
    return false;
}
