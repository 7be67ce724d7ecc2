/* live_player.h - plays a stage: what comes from a source goes to the stage's actor, if it
 * plays, and, through a script, to any control.
 *
 *     struct live_player *player;
 *     live_player_create(&def, stage, &player);
 *     window.before = live_player_before, window.key = live_player_key, window.context = player;
 *
 * A script (script_map.h) is handed each message, and sets controls of the stage and its actor
 * by their names. Knobs (knobs.h) are learnt and move controls without one. By OSC
 * (osc_stage.h) all of it is reached, and told. */
#ifndef LUTETIA_LIVE_PLAYER_H
#define LUTETIA_LIVE_PLAYER_H

#include <help_sheet.h>
#include <script_map.h>
#include <stage.h>

#include "knobs.h"
#include "live_source.h"
#include "osc_port.h"

enum { LIVE_KNOBS_MAX = 8 }; /* files of knobs */

struct live_player_def {
    struct live_source *source;
    const char *script;       /* a file; NULL: none */
    const char *const *words; /* key=value for the script's param() */
    int words_count;
    const char *const *knobs; /* files of knobs (knobs.h), of which one is heard at a time */
    const char *theme;        /* the stage's, for new files of knobs */
    bool is_film;             /* nothing is learnt: the files must be there */
    int knobs_count;          /* LIVE_KNOBS_MAX at most */
    const char *text;         /* a file whose words are the stage's as it changes; NULL: none */
    const char *cues;         /* a file of cues (cues.h); NULL: none */
    bool no_go;               /* nobody can say go: cues that wait are refused */
    struct osc_port_def osc;  /* zeros: no OSC (osc_stage.h) */
    /* A line for whoever looks: an error of the script's, what it prints, what the server
     * does. */
    void (*tell)(void *context, const char *text);
    /* A message of a song, which was due late_s ago, for whoever lets it be heard; NULL. */
    void (*played)(void *context, const struct midi_message *m, double late_s);
    void *played_context;
    void *context;
};

struct live_player;
/* Borrows the source and the stage. Errors: BAD_FILE (what the script says while it is read has
 * been told), BAD_ARGUMENT, FAILED (OSC), NO_MEMORY. */
enum stage_status live_player_create(const struct live_player_def *def, struct stage *stage,
                                     struct live_player **out);
void live_player_destroy(struct live_player *player); /* NULL is fine */

/* For stage_window_def and stage_film_def; context: the player. */
enum stage_status live_player_before(void *player, struct stage *stage, double now_s);
/* When a song's next message is due: live_player_before() at that time takes it. INFINITY:
 * there is none. For films, in which messages have their own times. */
double live_player_due_s(void *player);
bool live_player_key(void *player, const struct input_event *event);
int live_player_readable(void *player);

/* The script or cues lead by time, whether anything is played or not. */
bool live_player_leads(const struct live_player *player);

/* What the stage's actor lets hear, for whom OSC is sent to. */
void live_player_heard(struct live_player *player, const struct stage_sound *sound);

/* The knobs that are heard, for a window's panel; zeros: there are no files of any. */
struct stage_panel_knobs live_player_knobs(struct live_player *player);
/* The keys that live_player_key() takes besides played notes, for the help; *count: how
 * many. */
const struct help_row *live_player_keys(const struct live_player *player, int *count);

#endif
