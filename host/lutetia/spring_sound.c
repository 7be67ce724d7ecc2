/* spring_sound.c - see spring_sound.h. */
#include "spring_sound.h"

#include <sound.h>
#include <sound_events.h>

#include <math.h>
#include <stdlib.h>

enum { AT_ONCE = 64, LOUDEST = 127, CLANK_PER_SPEED = 20 };

struct spring_sound {
    const char *path;
    struct sound_def def;
    struct midi_song *song;
    int count;
    enum midi_status status;
};

enum midi_status spring_sound_create(const char *path, struct spring_sound **out)
{
    struct sound *probe;
    struct spring_sound *s = calloc(1, sizeof *s);
    *out = s;
    if (!s)
        return MIDI_NO_MEMORY;
    s->path = path;
    s->def = sound_def_default();
    s->def.room = true;
    enum midi_status status = sound_create(&s->def, &probe); /* not after a long film */
    if (status == MIDI_OK)
        sound_destroy(probe);
    s->song = status == MIDI_OK ? sound_events_song() : NULL;
    if (status == MIDI_OK && !s->song)
        status = MIDI_NO_MEMORY;
    if (status != MIDI_OK) {
        free(s);
        *out = NULL;
    }
    return status;
}

void spring_sound_abandon(struct spring_sound *s)
{
    if (s)
        midi_song_destroy(s->song);
    free(s);
}

/* A clank's strength is a speed; the others' is 1 where it is usual. */
static int velocity_of(enum sound_kind kind, double strength)
{
    if (kind == SOUND_CLANK)
        return (int)fmin(LOUDEST, CLANK_PER_SPEED * strength);
    return (int)(LOUDEST * (1 - exp(-1.5 * fmax(strength, 0))));
}

void spring_sound_take(struct spring_sound *s, struct stage *stage)
{
    const struct stage_actor actor = stage_actor(stage);
    const struct font_box box = actor.kind->extent(actor.self);
    const double width = fmax(box.x1 - box.x0, 1e-9);
    struct stage_sound heard[AT_ONCE];
    for (int count; (count = actor.kind->heard(actor.self, heard, AT_ONCE)) > 0;)
        for (int i = 0; i < count && s->status == MIDI_OK; i++) {
            const int kind = sound_kind_read(heard[i].name);
            if (kind < 0)
                continue;
            const double across = fmin(fmax((heard[i].x - box.x0) / width, 0), 1);
            const struct sound_event e = {
                .kind = (enum sound_kind)kind,
                .time_s = fmax(heard[i].time_s, 0),
                .velocity = velocity_of((enum sound_kind)kind, heard[i].strength),
                .height = 0.25 + 0.5 * across,
                .side = 1.4 * (across - 0.5)};
            s->status = sound_event_add(s->song, &e);
            s->count++;
        }
}

enum midi_status spring_sound_finish(struct spring_sound *s, double seconds, int *count)
{
    enum midi_status status = s->status;
    if (status == MIDI_OK)
        status = sound_render(&s->def, s->song, seconds, s->path);
    *count = s->count;
    spring_sound_abandon(s);
    return status;
}
