/* live.h - verbs whose stage is played: by the messages of a MIDI server, a song, or the
 * computer's keyboard, through a map in Lua, or through knobs that are learnt. */
#ifndef LUTETIA_LIVE_H
#define LUTETIA_LIVE_H

#include "options.h"

#include <live_player.h>
#include <stage_film.h>
#include <stage_window.h>

struct live_options {
    const char *map, *server, *device, *filters;
    const char *theme; /* the stage's */
    struct option_texts params, knobs, osc_from;
    const char *osc, *osc_to;
    const char *text; /* a watched file */
    const char *cues; /* a file of cues */
    bool no_go;       /* nobody can say go */
    const char *screen, *stream;
    /* A song's messages, for whoever lets them be heard (live_player.h); NULL. */
    void (*played)(void *context, const struct midi_message *m, double late_s);
    void *played_context;
    bool knobs_alone; /* the computer's keyboard plays no notes */
};

struct live {
    struct live_source *source;
    struct live_player *player;
    const char *verb;
    struct stage_window *window; /* where lines are said; NULL: standard error */
    char note[400];              /* told once the window is open; empty: nothing */
};

/* The theme that the first file of --knobs with a theme names; NULL: none does. */
const char *live_theme(const struct live_options *options);

/* song: NULL: live. lowest: the computer's lowest key. An exit status; what is wrong has been
 * said. The caller ends *out, also then. */
int live_begin(const char *verb, const struct live_options *options, struct midi_song *song,
               int lowest, struct stage *stage, struct live *out);
void live_end(struct live *live);

/* Opens a window for the stage and plays until somebody closes it. no_display: what to do where
 * there is none. */
int live_window(struct live *live, struct stage *stage, struct stage_window_def *def,
                const char *no_display);

#define LIVE_SCREEN_OPTION(value)                                                              \
    {                                                                                          \
        "screen", 0, OPTION_TEXT, "N|N,N|N=N|all",                                             \
            "the window fills this screen, lies over several, or is the same on each, "        \
            "without edges",                                                                   \
            value, 0, 0, 0                                                                     \
    }

#define LIVE_STREAM_OPTION(value)                                                              \
    {                                                                                          \
        "stream", 0, OPTION_TEXT, "TO[,WxH][,FPS]",                                            \
            "hand the window's pictures to other programs: pipewire, or a loopback device",    \
            value, 0, 0, 0                                                                     \
    }

/* The rows of Open Sound Control, of a table of options. */
#define LIVE_OSC_OPTIONS(live)                                                                 \
    {"osc",                                                                                    \
     0,                                                                                        \
     OPTION_TEXT,                                                                              \
     "PORT",                                                                                   \
     "hear Open Sound Control at this port, or ADDRESS:PORT",                                  \
     (&(live)->osc),                                                                           \
     0,                                                                                        \
     0,                                                                                        \
     0},                                                                                       \
        {"osc-from",                                                                           \
         0,                                                                                    \
         OPTION_TEXTS,                                                                         \
         "ADDRESS",                                                                            \
         "another computer whose OSC is heard; as often as wanted",                            \
         &(live)->osc_from,                                                                    \
         0,                                                                                    \
         0,                                                                                    \
         0},                                                                                   \
    {                                                                                          \
        "osc-to", 0, OPTION_TEXT, "ADDRESS:PORT",                                              \
            "send what changes and what is heard there by OSC, or to a PORT", &(live)->osc_to, \
            0, 0, 0                                                                            \
    }

#endif
