/* live_player.c - see live_player.h. */
#include "live_player.h"

#include "cues.h"
#include "osc_stage.h"
#include "watched_text.h"

#include <midi_time.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MESSAGES_OF_A_TURN = 2000 }; /* more wait for the next picture: nobody can hold it up */

struct live_player {
    struct live_player_def def;
    struct stage *stage;
    struct stage_actor actor; /* the stage's, which takes what is played */
    struct script_map *map;
    struct knobs *knobs[LIVE_KNOBS_MAX];
    int heard; /* the file of knobs that is */
    struct beat beat;
    struct osc_stage *osc;
    struct watched_text *watched;
    struct cues *cues;
    double began_s; /* when the first picture was due */
    bool began;
    char told[300]; /* what was told last: once is enough */
};

static void tell(struct live_player *p, const char *text)
{
    char cut[sizeof p->told];
    snprintf(cut, sizeof cut, "%s", text);
    if (strcmp(p->told, cut) == 0)
        return;
    memcpy(p->told, cut, sizeof cut);
    if (p->def.tell)
        p->def.tell(p->def.context, text);
}

/* ---- what a script may do ---- */

static void map_tell(void *context, const char *text)
{
    tell(context, text);
}

static const struct control *row_of(struct live_player *p, const char *name)
{
    int count;
    const struct control *rows = stage_controls(p->stage, &count);
    return stage_control_find(rows, count, name);
}

static const char *map_set(void *context, const char *name, const char *text)
{
    struct live_player *p = context;
    double value;
    const struct control *row = row_of(p, name);
    if (!row || stage_control_parse(row, text, &value) != STAGE_OK ||
        stage_control_write(row, p->stage, value) != STAGE_OK)
        return stage_error();
    return NULL;
}

static const char *map_along(void *context, const char *name, double along)
{
    struct live_player *p = context;
    const struct control *row = row_of(p, name);
    if (!row || stage_control_write(row, p->stage, control_at(row, along)) != STAGE_OK)
        return stage_error();
    return NULL;
}

static const char *map_text(void *context, const char *words)
{
    const struct live_player *p = context;
    return stage_text(p->stage, words) == STAGE_OK ? NULL : stage_error();
}

static const char *map_get(void *context, const char *name, double *value)
{
    struct live_player *p = context;
    const struct control *row = row_of(p, name);
    if (!row)
        return stage_error();
    *value = control_read(row, p->stage);
    return NULL;
}

static const char *map_send(void *context, const char *address,
                            const struct script_map_argument *arguments, int count)
{
    const struct live_player *p = context;
    struct osc_argument all[OSC_ARGUMENTS_MAX];
    uint8_t out[OSC_PACKET_MAX];
    if (!p->osc || !p->def.osc.send)
        return "nobody is sent to: --osc-to ADDRESS:PORT";
    if (address[0] != '/' || count > OSC_ARGUMENTS_MAX)
        return "an address begins with /, and a message has at most 32 arguments";
    for (int i = 0; i < count; i++)
        all[i] =
            (struct osc_argument){.text = arguments[i].text, .number = arguments[i].number};
    const size_t bytes = osc_arguments_write(out, sizeof out, address, all, count);
    osc_stage_send(p->osc, out, bytes);
    return bytes ? NULL : "a message has at most 8192 bytes";
}

static bool map_beat(void *context, double *phase, double *per_minute)
{
    const struct live_player *p = context;
    return beat_now(&p->beat, midi_now_ns(), phase, per_minute);
}

/* It is at work within one function of Lua's, which nothing can interrupt: the window would
 * stand still for good. */
static void map_overdue(void *context)
{
    static const char said[] =
        "lutetia: the map did not come to an end with a message; ended\n";
    (void)context;
    ssize_t written = write(STDERR_FILENO, said, sizeof said - 1);
    (void)written;
    _exit(EXIT_FAILURE);
}

static enum stage_status map_open(struct live_player *p)
{
    struct script_map_def def = {.path = p->def.script,
                                 .words = p->def.words,
                                 .words_count = p->def.words_count,
                                 .set = map_set,
                                 .along = map_along,
                                 .get = map_get,
                                 .text = map_text,
                                 .beat = map_beat,
                                 .send = map_send,
                                 .tell = map_tell,
                                 .overdue = map_overdue,
                                 .context = p};
    return script_map_open(&def, &p->map) == SCRIPT_OK
               ? STAGE_OK
               : stage_fail(STAGE_BAD_FILE, "%s",
                            p->told[0] ? p->told : "the map cannot be read");
}

/* ---- knobs ---- */

static enum stage_status knobs_begin(struct live_player *p)
{
    enum stage_status status = STAGE_OK;
    if (p->def.knobs_count > LIVE_KNOBS_MAX)
        return stage_fail(STAGE_BAD_ARGUMENT, "%d files of knobs are the most", LIVE_KNOBS_MAX);
    for (int i = 0; i < p->def.knobs_count && status == STAGE_OK; i++)
        status =
            knobs_open(p->stage, p->def.knobs[i], p->def.theme, p->def.is_film, &p->knobs[i]);
    return status;
}

static bool panel_of(void *context, int row, struct stage_panel_knob *out)
{
    const struct live_player *p = context;
    return knobs_of(p->knobs[p->heard], row, out);
}

static void panel_learn(void *context, int row)
{
    const struct live_player *p = context;
    knobs_learn(p->knobs[p->heard], row);
}

static void panel_forget(void *context, int row)
{
    const struct live_player *p = context;
    knobs_forget(p->knobs[p->heard], row);
}

static void panel_end(void *context, int row, double along)
{
    const struct live_player *p = context;
    knobs_end(p->knobs[p->heard], row, along);
}

struct stage_panel_knobs live_player_knobs(struct live_player *p)
{
    if (!p->knobs[0])
        return (struct stage_panel_knobs){0};
    return (struct stage_panel_knobs){panel_of, panel_learn, panel_forget, panel_end, p};
}

static void knobs_pass(struct live_player *p, double now_s)
{
    for (int i = 0; i < p->def.knobs_count; i++) {
        knobs_frame(p->knobs[i], now_s, i == p->heard ? &p->beat : NULL);
        const char *said = knobs_said(p->knobs[i]);
        p->told[0] = said ? '\0' : p->told[0]; /* the same may be said again */
        if (said)
            tell(p, said);
    }
}

const struct help_row *live_player_keys(const struct live_player *p, int *count)
{
    static const struct help_row rows[] = {
        {"G, Page down", "the next cue that waits"},
        {"right click on a slider", "the knob that is turned next moves it"},
        {"Shift and drag on a slider", "an end of its knob"},
        {"Shift and right click on it", "no knob moves it"},
        {"1 to 9, or a program change", "a scene"},
        {"Control 1 to 9", "keep all controls as a scene"},
        {"F1 to F8", "the knobs of another file"}};
    const int cues = p->cues ? 1 : 0;
    *count = p->knobs[0] ? (int)(sizeof rows / sizeof *rows) - 1 + cues : cues;
    return rows + 1 - cues;
}

/* True: it was a key for knobs. */
static bool knobs_key(struct live_player *p, const struct input_event *e)
{
    const int digit = e->key - '0', file = e->key - INPUT_KEY_F1;
    if (!p->knobs[0] || e->kind != INPUT_KEY_DOWN)
        return false;
    if (file >= 0 && file < p->def.knobs_count) {
        char text[200];
        p->heard = file;
        snprintf(text, sizeof text, "knobs of %.150s", p->def.knobs[file]);
        tell(p, text);
        return true;
    }
    if (digit < 1 || digit > 9 || (e->modifiers & ~(unsigned)INPUT_CONTROL))
        return false;
    struct knobs *k = p->knobs[p->heard];
    const enum stage_status status =
        e->modifiers ? knobs_scene_keep(k, digit) : knobs_scene_play(k, digit);
    if (status != STAGE_OK)
        tell(p, stage_error());
    return true;
}

/* ---- OSC ---- */

static bool osc_other(void *context, const struct osc_message *m)
{
    struct live_player *p = context;
    struct script_map_argument arguments[OSC_ARGUMENTS_MAX];
    for (int i = 0; i < m->count; i++)
        arguments[i] =
            (struct script_map_argument){m->arguments[i].text, m->arguments[i].number};
    return p->map && script_map_hears_osc(p->map) &&
           (script_map_osc(p->map, m->address, arguments, m->count), true);
}

static const char *osc_scene(void *context, int number)
{
    const struct live_player *p = context;
    if (!p->knobs[0])
        return "there are none: --knobs FILE has them";
    return knobs_scene_play(p->knobs[p->heard], number) == STAGE_OK ? NULL : stage_error();
}

static const char *osc_knobs(void *context, int number)
{
    struct live_player *p = context;
    if (number > p->def.knobs_count)
        return "there are not so many files of --knobs";
    p->heard = number - 1;
    return NULL;
}

static const char *osc_go(void *context, int number)
{
    const struct live_player *p = context;
    (void)number;
    if (!p->cues)
        return "there are no cues: --cues FILE has them";
    cues_go(p->cues);
    return NULL;
}

static enum stage_status osc_begin(struct live_player *p)
{
    const struct osc_stage_def def = {.port = p->def.osc,
                                      .stage = p->stage,
                                      .scene = osc_scene,
                                      .knobs = osc_knobs,
                                      .text = map_text,
                                      .go = osc_go,
                                      .other = osc_other,
                                      .tell = map_tell,
                                      .context = p};
    if (!def.port.listen && !def.port.send)
        return STAGE_OK;
    return osc_stage_open(&def, &p->osc);
}

void live_player_heard(struct live_player *p, const struct stage_sound *sound)
{
    if (p->osc)
        osc_stage_sound(p->osc, sound);
}

/* ---- a watched file ---- */

static void text_pass(struct live_player *p, double now_s)
{
    const char *words = watched_text_look(p->watched, now_s);
    if (words && stage_text(p->stage, words) != STAGE_OK)
        tell(p, stage_error());
    const char *wrong = watched_text_wrong(p->watched);
    if (wrong)
        tell(p, wrong);
}

/* ---- cues ---- */

static enum stage_status cues_begin(struct live_player *p)
{
    const struct cues_def def = {.path = p->def.cues,
                                 .stage = p->stage,
                                 .is_film = p->def.no_go,
                                 .scene = p->knobs[0] ? osc_scene : NULL,
                                 .tell = map_tell,
                                 .context = p};
    return cues_open(&def, &p->cues);
}

/* True: it was the key for cues, alone or, where letters play notes, with Control. */
static bool cues_key(struct live_player *p, const struct input_event *e)
{
    const bool go = e->key == INPUT_KEY_PAGE_DOWN || e->key == 'G';
    if (!p->cues || e->kind != INPUT_KEY_DOWN || !go ||
        (e->modifiers & ~(unsigned)INPUT_CONTROL))
        return false;
    cues_go(p->cues);
    return true;
}

/* ---- a player ---- */

enum stage_status live_player_create(const struct live_player_def *def, struct stage *stage,
                                     struct live_player **out)
{
    struct live_player *p = calloc(1, sizeof *p);
    *out = NULL;
    if (!p)
        return stage_fail(STAGE_NO_MEMORY, "no memory for a player");
    p->def = *def;
    p->stage = stage;
    p->actor = stage_actor(stage);
    enum stage_status status = STAGE_OK;
    if (def->script) {
        void (*told)(void *context, const char *text) = p->def.tell;
        p->def.tell = NULL; /* what it says before it plays is the error */
        status = map_open(p);
        p->def.tell = told;
    }
    if (status == STAGE_OK && !p->actor.kind->play && !(p->map && script_map_hears(p->map)))
        live_source_no_computer(def->source);
    if (status == STAGE_OK)
        status = knobs_begin(p);
    if (status == STAGE_OK)
        status = osc_begin(p);
    if (status == STAGE_OK && def->text)
        status = watched_text_open(def->text, &p->watched);
    if (status == STAGE_OK && def->cues)
        status = cues_begin(p);
    if (status != STAGE_OK) {
        live_player_destroy(p);
        return status;
    }
    *out = p;
    return STAGE_OK;
}

void live_player_destroy(struct live_player *p)
{
    if (!p)
        return;
    script_map_close(p->map);
    osc_stage_close(p->osc);
    watched_text_close(p->watched);
    cues_close(p->cues);
    for (int i = 0; i < LIVE_KNOBS_MAX; i++)
        knobs_close(p->knobs[i]);
    free(p);
}

int live_player_readable(void *player)
{
    const struct live_player *p = player;
    return live_source_descriptor(p->def.source);
}

enum stage_status live_player_before(void *player, struct stage *stage, double now_s)
{
    struct live_player *p = player;
    struct midi_message m;
    enum stage_status status = STAGE_OK;
    (void)stage;
    if (!p->began)
        p->began_s = now_s;
    p->began = true;
    now_s -= p->began_s; /* a song's second 0 is the first picture's */
    for (int i = 0; i < MESSAGES_OF_A_TURN && status == STAGE_OK; i++) {
        if (!live_source_next(p->def.source, now_s, &m))
            break;
        beat_take(&p->beat, &m);
        if (p->def.played)
            p->def.played(p->def.played_context, &m, now_s - (double)m.time_ns / 1e9);
        if (p->actor.kind->play)
            status = p->actor.kind->play(p->actor.self, m.bytes);
        if (p->map)
            script_map_message(p->map, &m);
        if (p->knobs[0])
            knobs_message(p->knobs[p->heard], &m);
    }
    if (p->watched)
        text_pass(p, now_s);
    if (p->osc)
        osc_stage_take(p->osc);
    if (p->cues)
        cues_frame(p->cues, now_s);
    if (p->map)
        script_map_frame(p->map, now_s);
    knobs_pass(p, now_s);
    if (p->osc)
        osc_stage_tell(p->osc);
    const char *said = live_source_said(p->def.source);
    if (said)
        tell(p, said);
    return status;
}

double live_player_due_s(void *player)
{
    const struct live_player *p = player;
    const double due_s = live_source_due_s(p->def.source);
    return p->began && p->began_s != 0 ? nextafter(p->began_s + due_s, INFINITY) : due_s;
}

bool live_player_leads(const struct live_player *p)
{
    return p->cues || (p->map && script_map_leads(p->map));
}

bool live_player_key(void *player, const struct input_event *event)
{
    struct live_player *p = player;
    return live_source_key(p->def.source, event) || knobs_key(p, event) || cues_key(p, event);
}
