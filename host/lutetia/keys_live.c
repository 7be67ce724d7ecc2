/* keys_live.c - see keys_live.h. */
#include "keys_live.h"

#include "lutetia.h"

#include <keys_actor.h>
#include <paper_actor.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool keys_live_range(const char *text, int range[2])
{
    char lowest[16];
    const char *dash = strchr(text, '-');
    while (dash && dash[1] >= '0' && dash[1] <= '9' && strchr(dash + 1, '-'))
        dash = strchr(dash + 1, '-'); /* c-1-c5 */
    if (!dash || dash - text >= (ptrdiff_t)sizeof lowest)
        return false;
    memcpy(lowest, text, (size_t)(dash - text));
    lowest[dash - text] = '\0';
    range[0] = midi_note_read(lowest);
    range[1] = midi_note_read(dash + 1);
    return range[0] >= 0 && range[1] >= range[0] + 11;
}

/* So often a sheet is asked for its steps; a letter that is played waits no longer. */
#define PAPER_STEP_S (1.0 / 60)

static int paper_make(const struct keys_live *def, const struct keys_actor_def *keys,
                      struct stage_actor *out)
{
    struct paper_actor_def actor = paper_actor_def_default();
    actor.keys = *keys;
    actor.width = def->size[0] / 2; /* two pixels a fiber */
    actor.height = def->size[1] / 2;
    if (actor.width < PAPER_SIDE_MIN || actor.height < PAPER_SIDE_MIN)
        return fail_usage("keys", "--picture must be %dx%d or more with --wet (got %dx%d)",
                          2 * PAPER_SIDE_MIN, 2 * PAPER_SIDE_MIN, def->size[0], def->size[1]);
    if (def->stock)
        actor.stock = def->stock;
    if (def->pigments.count > PAPER_ACTOR_PIGMENTS)
        return fail_usage("keys", "--pigment: at most %d", PAPER_ACTOR_PIGMENTS);
    for (int i = 0; i < def->pigments.count; i++)
        actor.pigments[i] = def->pigments.texts[i];
    if (def->pigments.count)
        actor.pigments_count = def->pigments.count;
    int status =
        machine_prepare("keys", actor.width, actor.height,
                        paper_sheet_bytes(actor.width, actor.height, actor.pigments_count));
    if (status != EXIT_SUCCESS)
        return status;
    const enum stage_status made = paper_actor_create(&actor, out);
    return made == STAGE_OK             ? EXIT_SUCCESS
           : made == STAGE_BAD_ARGUMENT ? fail_usage("keys", "%s", stage_error())
                                        : fail("keys", "%s", stage_error());
}

static int stage_make(const struct keys_live *def, struct stage **out)
{
    struct keys_actor_def actor = keys_actor_def_default();
    struct stage_def stage = stage_def_default();
    *out = NULL;
    actor.face = def->face;
    memcpy(actor.range, def->range, sizeof actor.range);
    actor.score = def->score;
    actor.text = def->text;
    actor.letters = def->letters;
    actor.keys = def->keys;
    stage.forgets = true;
    const char *theme = def->theme ? def->theme : live_theme(&def->live);
    if (theme)
        stage.theme = theme;
    if (def->wet) {
        int made = paper_make(def, &actor, &stage.actor);
        if (made != EXIT_SUCCESS)
            return made;
        stage.step_s = PAPER_STEP_S;
    }
    enum stage_status status = def->wet ? STAGE_OK : keys_actor_create(&actor, &stage.actor);
    if (status == STAGE_OK)
        status = stage_create(&stage, out);
    for (int i = 0; status == STAGE_OK && i < def->sets.count; i++)
        status = stage_set(*out, def->sets.texts[i]);
    if (status == STAGE_BAD_ARGUMENT)
        return fail_usage("keys", "%s", stage_error());
    return status == STAGE_OK ? EXIT_SUCCESS : fail("keys", "%s", stage_error());
}

static int both_make(const struct keys_live *def, struct stage **stage, struct live *live)
{
    *live = (struct live){.verb = "keys"};
    int status = stage_make(def, stage);
    if (status != EXIT_SUCCESS)
        return status;
    struct live_options options = def->live;
    options.theme = def->theme;
    return live_begin("keys", &options, def->song, def->range[0], *stage, live);
}

int keys_live_window(const struct keys_live *def)
{
    struct stage *stage;
    struct live live;
    struct stage_window_def window = stage_window_def_default();
    window.title = "keys";
    window.width_px = def->size[0];
    window.height_px = def->size[1];
    window.record_path = "keys.mp4";
    window.screen = def->live.screen;
    window.stream = def->live.stream;
    int status = both_make(def, &stage, &live);
    if (status == EXIT_SUCCESS)
        status =
            live_window(&live, stage, &window,
                        "run it where there is a desktop, or take a song and --video FILE");
    live_end(&live);
    stage_destroy(stage);
    return status;
}

static bool stopped(void *context, int frame, int frames)
{
    (void)context;
    (void)frame;
    (void)frames;
    return interrupted();
}

static enum stage_status song_before(void *context, struct stage *stage, double now_s)
{
    const struct live *live = context;
    return live_player_before(live->player, stage, now_s);
}

static double song_due_s(void *context)
{
    const struct live *live = context;
    return live_player_due_s(live->player);
}

int keys_live_film(const struct keys_live *def)
{
    struct stage *stage;
    struct live live;
    struct stage_film_def film = def->film;
    int status = both_make(def, &stage, &live);
    film.before = song_before;
    film.due_s = song_due_s;
    film.after = stopped;
    film.context = &live;
    if (status == EXIT_SUCCESS && stage_film(stage, &film) != STAGE_OK)
        status = fail("keys", "%s", stage_error());
    if (status == EXIT_SUCCESS && interrupted())
        status = EXIT_FAILED;
    live_end(&live);
    stage_destroy(stage);
    return status;
}
