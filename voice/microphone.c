/* microphone.c - see microphone.h. */
#include "microphone_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int microphone_rate_hz(const struct microphone *m)
{
    return m->rate_hz;
}

size_t microphone_lost(const struct microphone *m)
{
    return atomic_load(&m->lost);
}

bool microphone_gone(const struct microphone *m)
{
    return atomic_load(&m->gone);
}

void microphone_close(struct microphone *m)
{
    if (m && m->close)
        m->close(m);
    free(m);
}

bool microphone_known(const char *source)
{
    return !source || strcmp(source, "jack") == 0 || strcmp(source, "pulse") == 0;
}

bool microphone_open(const char *source, struct microphone **out, char *why, size_t room)
{
    static const struct {
        const char *name;
        bool (*open)(struct microphone *m, char *why, size_t room);
    } kinds[] = {{"jack", microphone_jack_open}, {"pulse", microphone_pulse_open}};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    char reason[KINDS][200] = {"", ""};
    *out = NULL;
    struct microphone *m = calloc(1, sizeof *m);
    if (!m) {
        snprintf(why, room, "no memory for a microphone");
        return false;
    }
    bool known = false;
    for (int i = 0; i < KINDS; i++) {
        if (source && strcmp(source, kinds[i].name) != 0)
            continue;
        known = true;
        if (kinds[i].open(m, reason[i], sizeof reason[i])) {
            *out = m;
            return true;
        }
    }
    free(m);
    if (!known)
        snprintf(why, room, "no microphone '%.40s'; known ones are jack, pulse", source);
    else if (source)
        snprintf(why, room, "%s", reason[strcmp(source, kinds[0].name) != 0]);
    else
        snprintf(why, room, "no microphone: %s; %s", reason[0], reason[1]);
    return false;
}
