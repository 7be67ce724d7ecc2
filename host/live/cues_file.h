/* cues_file.h - a list of cues: what happens on a stage, and when. A text file, a line each:
 *
 *     # when   what
 *     0        text "Breath"          seconds from the beginning
 *     2.5      scene 2                a scene of the knobs' file (knobs.h)
 *     +1       set gravity=0 fade 3   seconds after the cue before; a control goes there in 3
 *     go       text "Out\nagain"      when somebody says so
 *     +0       set friction=2
 *
 * Times do not go back, and behind a `go` they are counted from the cue before. In a text \n is
 * a line's end, \" a quote and \\ a backslash.
 */
#ifndef LUTETIA_LIVE_CUES_FILE_H
#define LUTETIA_LIVE_CUES_FILE_H

#include <session.h>

#include <stdbool.h>

enum { CUES_MAX = 1000, CUES_FILE_BYTES_MAX = 1 << 20, CUE_NAME_BYTES = 64 };

enum cue_when { CUE_AT, CUE_AFTER, CUE_GO };
enum cue_what { CUE_TEXT, CUE_SCENE, CUE_SET };

struct cue {
    enum cue_when when;
    enum cue_what what;
    int line, scene;
    double time_s, fade_s;
    char name[CUE_NAME_BYTES]; /* of a control */
    char *text;                /* words, or a control's value; owned */
};

struct cues_text {
    struct cue *cues;
    int count, capacity;
};

/* Owns: the caller finishes *out, also where it fails. Errors: BAD_FILE, with the line;
 * NO_MEMORY. */
enum stage_status cues_file_read(const char *path, struct cues_text *out);
/* The same of `count` bytes and a 0 behind them, which are changed; name: of the file, for
 * errors. */
enum stage_status cues_text_read(char *text, size_t count, const char *name,
                                 struct cues_text *out);
/* When the last cue's fade is over; a go takes no time. */
double cues_text_seconds(const struct cues_text *text);
void cues_text_finish(struct cues_text *text);

#endif
