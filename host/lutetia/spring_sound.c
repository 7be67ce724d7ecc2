/* spring_sound.c - see spring_sound.h. */
#include "spring_sound.h"

#include <live_sound.h>
#include <midi_internal.h>
#include <sound.h>
#include <sound_events.h>

#include <math.h>
#include <stdlib.h>

enum { AT_ONCE = 64 };

struct spring_sound {
    struct sound_def def;
    struct midi_song *song;
    double seconds;
    int count;
};

static enum midi_status spring_sound_create(double seconds, struct spring_sound **out)
{
    struct sound *probe;
    struct sound_def def = sound_def_default();
    struct spring_sound *s = NULL;
    *out = NULL;
    def.room = true;
    enum midi_status status = sound_create(&def, &probe); /* check before a long film, not
                                                           * after it */
    if (status != MIDI_OK)
        return status;
    sound_destroy(probe);
    s = calloc(1, sizeof *s);
    if (s)
        s->song = sound_events_song();
    if (!s || !s->song) {
        free(s);
        return midi_fail(MIDI_NO_MEMORY, "no memory for sounds");
    }
    s->def = def;
    s->seconds = seconds;
    *out = s;
    return MIDI_OK;
}

void spring_sound_destroy(struct spring_sound *s)
{
    if (s)
        midi_song_destroy(s->song);
    free(s);
}

int spring_sound_count(const struct spring_sound *s)
{
    return s->count;
}

static enum midi_status sounds_take(struct spring_sound *s, struct stage *stage)
{
    const struct stage_actor actor = stage_actor(stage);
    const struct font_box box = actor.kind->extent(actor.self);
    struct stage_sound heard[AT_ONCE];
    struct sound_event e;
    enum midi_status status = MIDI_OK;
    for (int count; (count = actor.kind->heard(actor.self, heard, AT_ONCE)) > 0;)
        for (int i = 0; i < count && status == MIDI_OK; i++) {
            if (!live_sound_event(&heard[i], &box, &e))
                continue;
            status = sound_event_add(s->song, &e);
            s->count++;
        }
    return status;
}

enum midi_status
spring_sound_hear(struct stage *stage, int fps, double seconds,
                  enum stage_status (*before)(void *context, struct stage *stage, double now_s),
                  void *context, struct midi_song *beside, struct spring_sound **out)
{
    const int last = (int)lround(seconds * fps);
    enum midi_status status = spring_sound_create((double)(last + 1) / fps, out);
    if (status == MIDI_OK)
        (*out)->def.beside = beside;
    stage_clock(stage)->frame_max_s = INFINITY; /* every frame counts, as in a film */
    for (int frame = 0; frame <= last && status == MIDI_OK; frame++) {
        const double now_s = (double)frame / fps;
        if ((before && before(context, stage, now_s) != STAGE_OK) ||
            stage_frame(stage, now_s, NULL) != STAGE_OK)
            status = midi_fail(MIDI_BAD_ARGUMENT, "%s", stage_error());
        else
            status = sounds_take(*out, stage);
    }
    if (status != MIDI_OK) {
        spring_sound_destroy(*out);
        *out = NULL;
    }
    return status;
}

enum midi_status spring_sound_write(struct spring_sound *s, const char *path)
{
    return sound_render(&s->def, s->song, s->seconds, path);
}

enum midi_status spring_sound_open(struct spring_sound *s, int *file)
{
    return sound_render_open(&s->def, s->song, s->seconds, file);
}
