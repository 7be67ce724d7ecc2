/* live.c - see live.h. */
#include "live.h"

#include "lutetia.h"

#include <window.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *live_theme(const struct live_options *options)
{
    static char theme[KNOBS_THEME_BYTES];
    struct knobs_text *text = calloc(1, sizeof *text);
    theme[0] = '\0';
    for (int i = 0; text && i < options->knobs.count && !theme[0]; i++) {
        if (knobs_file_read(options->knobs.texts[i], text) == STAGE_OK)
            memcpy(theme, text->theme, sizeof theme);
        knobs_text_finish(text); /* what is wrong with a file is said when it is opened */
    }
    free(text);
    return theme[0] ? theme : NULL;
}

static void said(void *context, const char *text)
{
    const struct live *live = context;
    if (live->window)
        stage_window_say(live->window, text);
    else
        tell(live->verb, "%s", text);
}

int live_begin(const char *verb, const struct live_options *options, struct midi_song *song,
               int lowest, struct stage *stage, struct live *out)
{
    const struct live_source_def source = {.song = song,
                                           .server = options->server,
                                           .device = options->device,
                                           .filters = options->filters,
                                           .lowest = lowest,
                                           .no_computer = options->knobs_alone};
    *out = (struct live){.verb = verb};
    if (live_source_open(&source, &out->source) != MIDI_OK)
        return fail(verb, "%s", midi_error());
    const struct live_player_def player = {.source = out->source,
                                           .script = options->map,
                                           .words = options->params.texts,
                                           .words_count = options->params.count,
                                           .knobs = options->knobs.texts,
                                           .knobs_count = options->knobs.count,
                                           .theme = options->theme,
                                           .text = options->text,
                                           .cues = options->cues,
                                           .no_go = options->no_go,
                                           .osc = {.listen = options->osc,
                                                   .from = options->osc_from.texts,
                                                   .from_count = options->osc_from.count,
                                                   .send = options->osc_to},
                                           .is_film = song != NULL,
                                           .tell = said,
                                           .played = song ? options->played : NULL,
                                           .played_context = options->played_context,
                                           .context = out};
    return live_player_create(&player, stage, &out->player) == STAGE_OK
               ? EXIT_SUCCESS
               : fail(verb, "%s", stage_error());
}

void live_end(struct live *live)
{
    live_player_destroy(live->player);
    live_source_close(live->source);
    *live = (struct live){.verb = live->verb};
}

/* What a window has of which nothing else is kept. */
struct kept {
    struct live *live;
    struct stage *stage;
};

static void display_lost(void *context)
{
    const struct kept *kept = context;
    struct live *live = kept->live;
    stage_window_record_end(live->window);
    const char *recorded = stage_window_recorded(live->window);
    tell(live->verb, "the display is gone%s%s%s", recorded ? "; the film " : "",
         recorded ? recorded : "", recorded ? " is whole up to there" : "");
    if (stage_session_end(kept->stage) != STAGE_OK)
        tell(live->verb, "%s", stage_error());
    live->window = NULL;
    live_end(live);
}

int live_window(struct live *live, struct stage *stage, struct stage_window_def *def,
                const char *no_display)
{
    struct stage_window *window;
    if (live->player) {
        def->before = live_player_before;
        def->readable = live_player_readable;
        def->key = live_player_key;
        def->context = live->player;
        def->knobs = live_player_knobs(live->player);
        def->keys = live_player_keys(live->player, &def->keys_count);
    }
    if (live->source && live_source_by_computer(live->source))
        def->played = "notes: one row from Z, one from Q";
    enum stage_status status = stage_window_create(stage, def, &window);
    if (status == STAGE_NO_DISPLAY)
        return fail(live->verb, "%s; %s", stage_error(), no_display);
    if (status != STAGE_OK)
        return fail(live->verb, "%s", stage_error());
    live->window = window;
    if (live->note[0])
        tell(live->verb, "%s", live->note);
    if (live->source && live_source_by_computer(live->source))
        stage_window_say(window, "no MIDI server: the computer's keys play, from Z and from Q");
    struct kept kept = {live, stage};
    window_lost_set(display_lost, &kept);
    while (status == STAGE_OK && stage_window_open(window) && !interrupted()) {
        const char *wrong = stage_session_said(stage);
        if (wrong)
            stage_window_say(window, wrong);
        status = stage_window_turn(window);
    }
    window_lost_set(NULL, NULL);
    if (status != STAGE_OK)
        fail(live->verb, "%s", stage_error());
    live->window = NULL;
    stage_window_destroy(window);
    return status == STAGE_OK ? EXIT_SUCCESS : EXIT_FAILED;
}
