/* shown.h - waits for what a demonstration shows, however slow the computer is. */
#ifndef LUTETIA_TEST_SHOWN_H
#define LUTETIA_TEST_SHOWN_H

#include <demonstration.h>

#include <stdio.h>
#include <string.h>
#include <time.h>

/* Starts a script; fails the test where it cannot. */
static inline struct demonstration *shown_start(const char *script, int width, int height)
{
    const struct demonstration_def def =
        demonstration_def_default(script, strlen(script), width, height);
    struct demonstration *d;
    if (!demonstration_start(&def, &d))
        fail_msg("%s", demonstration_error());
    return d;
}

/* Asks for pictures until so many more have come, or it has ended; false: it has. Without an
 * answer a demonstration ends by its patience, so this always ends. */
static inline bool shown_wait(struct demonstration *d, long more)
{
    const struct timespec short_while = {0, 1000000};
    const long all = demonstration_pictures(d) + more;
    while (demonstration_pictures(d) < all && !demonstration_ended(d)) {
        demonstration_frame(d, demonstration_waits(d) ? 0 : 1.0 / 64);
        if (!demonstration_take(d))
            nanosleep(&short_while, NULL);
    }
    return !demonstration_ended(d);
}

/* It ends, and says this. */
static inline void shown_ends(struct demonstration *d, const char *says)
{
    shown_wait(d, 1000000);
    if (!demonstration_ended(d) || !strstr(demonstration_ended(d), says))
        fail_msg("it ends with '%s', and not with '%s'", demonstration_ended(d), says);
}

static inline const uint8_t *shown_pixel(const struct demonstration *d, int width, int x, int y)
{
    return demonstration_picture(d) + 3 * ((size_t)y * (size_t)width + (size_t)x);
}

static inline void shown_is(const struct demonstration *d, int width, int x, int y, int red,
                            int green, int blue)
{
    const uint8_t *p = shown_pixel(d, width, x, y);
    if (p[0] != red || p[1] != green || p[2] != blue)
        fail_msg("the pixel at %d, %d is %d %d %d, and not %d %d %d", x, y, p[0], p[1], p[2],
                 red, green, blue);
}

#endif
