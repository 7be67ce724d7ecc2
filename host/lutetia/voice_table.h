/* voice_table.h - what was heard in a voice as a table: comma-separated values (RFC 4180), a
 * line for each frame of voice.h, numbers with a point. What there is none of (a pitch, a
 * formant) is empty. */
#ifndef LUTETIA_VOICE_TABLE_H
#define LUTETIA_VOICE_TABLE_H

#include <voice.h>

/* EXIT_SUCCESS, or prints why not. The file appears when it is whole. */
int voice_table_write(const char *path, const struct voice_frame *frames, int count);

#endif
