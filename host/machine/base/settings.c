/* settings.c - environment variables that force the engine's decisions.
 *
 * Each variable is a row of the table; docs/engine-reference.md explains them. A variable that is
 * empty counts as not set. With an invalid value no machine is created.
 */
#include <errno.h>
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
#define SETTING_READ(variable, name, read)                                                     \
    "LUTETIA_" #variable, offsetof(struct settings, name), read
#define SETTING(variable, name) SETTING_READ(variable, name, settings_number)
    {SETTING(EAGER, eager), 0, 0, 1, 0, "0 or 1"},
    {SETTING(REPLAY, replay), 1, 0, 1, 0, "0 or 1"},
    {SETTING(FLUSH_AFTER, flush_after), SETTING_FREE, 1, 1 << 30, 0, "a number from 1 to 2^30"},
    {SETTING(OPTIMISE_AFTER, optimise_after), 4 << 20, 0, UINT64_MAX - 1, 0, "a number"},
    {SETTING(BOX_AFTER, box_after), 32 << 20, 0, UINT64_MAX - 1, 0, "a number"},
    {SETTING(INTERPRET, interpret), 1, 0, 3, 0, "0, 1, 2 or 3"},
    {SETTING(NUMBERS, numbers), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(AT_ONCE, at_once), 1, 0, 2, 0, "0, 1 or 2"},
    {SETTING(WARM_UP, warm_up), 1, 0, 1, 0, "0 or 1"},
    {SETTING(KERNELS, kernels), 512, 1, 1 << 20, 0, "a number from 1 to 2^20"},
    {SETTING(KERNELS_EVER, kernels_ever), 8192, 0, 1 << 20, 0, "a number up to 2^20"},
    {SETTING(BACKGROUND, background), 1, 0, 1, 0, "0 or 1"},
    {SETTING(STRIPS, strips), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING_READ(TILE, tile, sides_read), SETTING_FREE, 0, UINT64_MAX, 0,
     "a width and a height from 1 to 1024, as 64x16"},
    {SETTING(IN_PLACE, in_place), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(NARROW, narrow), 1, 0, 1, 0, "0 or 1"},
    {SETTING(CLAIMS, claims), 1, 0, 1, 0, "0 or 1"},
    {SETTING(KEEPS_NAN, keeps_nan), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(SCATTER, scatter), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(AWAKE, awake), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(NEAR, near), 1, 0, 2, 0, "0, 1 or 2"},
    {SETTING(LENIENT, lenient), 0, 0, 1, 0, "0 or 1"},
    {SETTING(GATHER, gather), 1, 0, 1, 0, "0 or 1"},
    {SETTING(PROCESSORS, processors), SETTING_FREE, 1, 1 << 30, 0,
     "a power of two from 1 to 2^30"},
    {SETTING(MEMORY, memory), SETTING_FREE, 1, UINT64_MAX - 1, 0, "a number of bytes"},
    {SETTING(TUNED, tuned), 1, 0, 1, 0, "0 or 1"},
    {SETTING(KEEP, keep), SETTING_FREE, 0, 1, 0, "0 or 1"},
    {SETTING(VERBOSE, verbose), 0, 0, 1, 0, "0 or 1"},
/* The knobs; a file of tuning.c can set them, too. */
#define KNOB(variable, which) SETTING(variable, knob[which]), SETTING_FREE
    {KNOB(VECTOR, MACHINE_VECTOR), 1, 16, 0, "1, 4, 8 or 16"},
    {KNOB(RUN, MACHINE_RUN), 1, 1 << 20, 0, "1, or a multiple of 16 up to 2^20"},
    {KNOB(STREAMS, MACHINE_STREAMS), 0, 1, 0, "0 or 1"},
    {KNOB(TURNS, MACHINE_TURNS), 1, 64, 0, "a number from 1 to 64"},
    {KNOB(COLUMNS, MACHINE_COLUMNS), 16, 1 << 16, 16, "a multiple of 16 from 16 to 65536"},
    {KNOB(STRIPS_EACH, MACHINE_STRIPS_EACH), 1, 64, 0, "a number from 1 to 64"},
#undef KNOB
#undef SETTING
#undef SETTING_READ
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
