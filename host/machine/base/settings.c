/* settings.c - environment variables that force the engine's decisions.
 *
 * Each variable is a row of machine_settings.tab; docs/engine-reference.md explains them.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/parts.h"

enum { TILE_SIDE_MOST = 1024 };

bool settings_number(const char *text, uint64_t *out)
{
    char *end;
    if (*text < '0' || *text > '9')
        return false;
    errno = 0;
    *out = strtoull(text, &end, 10);
    return !*end && !errno;
}

/* Reads "64x16" as width << 16 | height. */
static bool sides_read(const char *text, uint64_t *out)
{
    char width[8];
    size_t length = strcspn(text, "x");
    uint64_t w, h;
    if (length >= sizeof width || text[length] != 'x')
        return false;
    memcpy(width, text, length);
    width[length] = 0;
    if (!settings_number(width, &w) || !settings_number(text + length + 1, &h))
        return false;
    *out = w << 16 | h;
    return w >= 1 && w <= TILE_SIDE_MOST && h >= 1 && h <= TILE_SIDE_MOST;
}

static const struct setting {
    const char *variable;
    size_t at; /* offset in struct settings */
    bool (*read)(const char *text, uint64_t *out);
    uint64_t usual, least, most; /* usual: the value if the variable is not set */
    uint64_t multiple;           /* the value must be a multiple of it; 0: any */
    const char *may_be;
} table[] = {
#define SETTING(variable, member, read, usual, least, most, multiple, may_be, ...)             \
    {"LUTETIA_" #variable,                                                                     \
     offsetof(struct settings, member),                                                        \
     read,                                                                                     \
     usual,                                                                                    \
     least,                                                                                    \
     most,                                                                                     \
     multiple,                                                                                 \
     may_be},
#include "machine_settings.tab"
#undef SETTING
};

static bool suits(const struct setting *s, uint64_t value)
{
    if (value < s->least || value > s->most || (s->multiple && value % s->multiple))
        return false;
    if (s->at == offsetof(struct settings, processors))
        return (value & (value - 1)) == 0;
    if (s->at == offsetof(struct settings, knob[MACHINE_VECTOR]))
        return value == 1 || value == 4 || value == 8 || value == 16;
    if (s->at == offsetof(struct settings, knob[MACHINE_RUN]))
        return value == 1 || value % 16 == 0;
    return true;
}

enum machine_status settings_read(struct machine *m)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const struct setting *s = &table[i];
        const char *text = getenv(s->variable);
        uint64_t value = s->usual;
        if (text && *text && (!s->read(text, &value) || !suits(s, value)))
            return machine_fail(m, MACHINE_BAD_ARGUMENT, "%s must be %s (is \"%.40s\")",
                                s->variable, s->may_be, text);
        memcpy((char *)&m->settings + s->at, &value, sizeof value);
    }
    return MACHINE_OK;
}

void settings_text(char *out, size_t size)
{
    size_t used = 0;
    *out = 0;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const char *text = getenv(table[i].variable);
        const size_t more = text ? strlen(table[i].variable) + strlen(text) + 2 : 0;
        if (text && *text && used + more < size)
            used +=
                (size_t)snprintf(out + used, size - used, "%s=%s\n", table[i].variable, text);
    }
}

/* The knobs are the last rows, in the order of the enum. */
static const struct setting *knob_row(enum machine_knob knob)
{
    return &table[sizeof table / sizeof *table - MACHINE_KNOBS + knob];
}

bool machine_knob_allows(enum machine_knob knob, int value)
{
    return value >= 0 && suits(knob_row(knob), (uint64_t)value);
}

const char *settings_knob_may_be(enum machine_knob knob)
{
    return knob_row(knob)->may_be;
}
