/* test_live_film.c - films of what a song plays: when the actor is played. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <live_player.h>
#include <stage_film.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"

static const uint8_t played[][3] = {{0x90, 60, 127}, {0xb0, 1, 127}, {0xb0, 2, 64},
                                    {0xe0, 0, 0},    {0x90, 60, 0},  {0xc0, 5, 0}};

static struct midi_song *song_of(const uint8_t (*bytes)[3], const int *ms, int count)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < count; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)ms[i] * 1000000, bytes[i][0], bytes[i][1], bytes[i][2]);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    return song;
}

/* An actor that keeps when it was played. */
struct clocked {
    double time_s, at_s[6];
    int played;
};

static const struct control *clocked_controls(void *actor, int *count)
{
    (void)actor;
    *count = 0;
    return NULL;
}

static enum stage_status clocked_step(void *actor, double dt_s)
{
    ((struct clocked *)actor)->time_s += dt_s;
    return STAGE_OK;
}

static enum stage_status clocked_play(void *actor, const uint8_t *bytes)
{
    struct clocked *c = actor;
    assert_int_equal(bytes[0], played[c->played][0]);
    c->at_s[c->played++] = c->time_s;
    return STAGE_OK;
}

static void clocked_draw(void *actor, const struct stage_look *look,
                         struct stage_draw_list *list)
{
    (void)actor;
    (void)look;
    (void)list;
}

static struct font_box clocked_extent(void *actor)
{
    (void)actor;
    return (struct font_box){0, 0, 1, 1};
}

static enum stage_status clocked_keep(void *actor, void **state)
{
    *state = malloc(sizeof(struct clocked));
    assert_non_null(*state);
    memcpy(*state, actor, sizeof(struct clocked));
    return STAGE_OK;
}

static enum stage_status clocked_restore(void *actor, const void *state)
{
    memcpy(actor, state, sizeof(struct clocked));
    return STAGE_OK;
}

static void clocked_destroy(void *actor)
{
    (void)actor;
}

static enum stage_status film_before(void *player, struct stage *stage, double now_s)
{
    return live_player_before(player, stage, now_s);
}

/* In a film messages come at their own times, to a step, however few pictures it has. */
static void films_play_between_pictures(void **unused)
{
    (void)unused;
    static const struct stage_actor_kind kind = {.name = "clocked",
                                                 .controls = clocked_controls,
                                                 .step = clocked_step,
                                                 .play = clocked_play,
                                                 .draw = clocked_draw,
                                                 .extent = clocked_extent,
                                                 .keep = clocked_keep,
                                                 .restore = clocked_restore,
                                                 .forget = free,
                                                 .destroy = clocked_destroy};
    static const int ms[] = {0, 1, 133, 250, 999, 1000};
    for (int fps = 4; fps <= 60; fps += 28) {
        struct clocked clocked = {0};
        struct stage_def def = stage_def_default();
        struct midi_song *song = song_of(played, ms, 6);
        struct live_source_def source_def = {.song = song};
        struct live_source *source;
        struct live_player *player;
        struct stage *stage;
        def.actor = (struct stage_actor){&kind, &clocked};
        assert_int_equal(live_source_open(&source_def, &source), MIDI_OK);
        assert_int_equal(stage_create(&def, &stage), STAGE_OK);
        const struct live_player_def player_def = {.source = source, .is_film = true};
        assert_int_equal(live_player_create(&player_def, stage, &player), STAGE_OK);
        struct stage_film_def film = stage_film_def_default();
        film.still = scratch_path("film.png");
        film.width_px = film.height_px = 16;
        film.fps = fps;
        film.seconds = 1;
        film.before = film_before;
        film.due_s = live_player_due_s;
        film.context = player;
        assert_int_equal(stage_film(stage, &film), STAGE_OK);
        assert_int_equal(clocked.played, 6);
        for (int i = 0; i < 6; i++)
            if (fabs(clocked.at_s[i] - ms[i] / 1e3) > 1.01 / 240)
                fail_msg("%d pictures a second: %d ms: played at %g s", fps, ms[i],
                         clocked.at_s[i]);
        live_player_destroy(player);
        stage_destroy(stage);
        live_source_close(source);
        midi_song_destroy(song);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(films_play_between_pictures)};
    return cmocka_run_group_tests_name("live film", tests, NULL, NULL);
}
