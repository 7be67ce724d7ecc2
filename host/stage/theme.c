/* theme.c - see theme.h. */
#include "theme.h"

#include <input_file.h>
#include <srgb.h>
#include <themes.h>

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_BYTES_MAX = 1 << 16, NAME_MAX_BYTES = 32 };
static const double size_most_px = 1000;

#define THEME_NAME(upper, lower) #lower,
static const char *const color_names[] = {STAGE_THEME_COLORS(THEME_NAME)};
static const char *const size_names[] = {STAGE_THEME_SIZES(THEME_NAME)};
#undef THEME_NAME

static int name_find(const char *const *names, int count, const char *name, size_t length)
{
    for (int i = 0; i < count; i++)
        if (strlen(names[i]) == length && memcmp(names[i], name, length) == 0)
            return i;
    return -1;
}

static int hex_of(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* #rrggbb or #rrggbbaa. */
static bool color_parse(const char *text, size_t length, struct stage_color *out)
{
    float parts[4] = {0, 0, 0, 1};
    if ((length != 7 && length != 9) || text[0] != '#')
        return false;
    for (size_t i = 1; i < length; i += 2) {
        int high = hex_of(text[i]), low = hex_of(text[i + 1]);
        if (high < 0 || low < 0)
            return false;
        parts[i / 2] = (float)(16 * high + low) / 255;
    }
    *out = (struct stage_color){parts[0], parts[1], parts[2], parts[3]};
    return true;
}

static bool size_parse(const char *text, size_t length, double *out)
{
    char number[NAME_MAX_BYTES], *end;
    if (length == 0 || length >= sizeof number)
        return false;
    memcpy(number, text, length);
    number[length] = '\0';
    double value = strtod(number, &end);
    if (*end || end == number || !(fabs(value) <= size_most_px))
        return false;
    *out = value;
    return true;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Removes blanks on both sides. */
static const char *trimmed(const char *text, size_t *length)
{
    while (*length && is_blank(text[0]))
        text++, --*length;
    while (*length && is_blank(text[*length - 1]))
        --*length;
    return text;
}

static enum stage_status unknown(const char *name, size_t length, const char *file, int line)
{
    char known[600] = "";
    for (int i = 0; i < (int)STAGE_COLORS_COUNT + (int)STAGE_SIZES_COUNT; i++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "",
                 i < STAGE_COLORS_COUNT ? color_names[i] : size_names[i - STAGE_COLORS_COUNT]);
    }
    return stage_fail(STAGE_BAD_FILE, "%s:%d: a theme has no '%.*s'; it has %s", file, line,
                      (int)(length < NAME_MAX_BYTES ? length : NAME_MAX_BYTES), name, known);
}

static enum stage_status line_read(const char *text, size_t length, const char *file, int line,
                                   struct stage_theme *theme)
{
    text = trimmed(text, &length);
    if (length == 0 || text[0] == '#')
        return STAGE_OK;
    const char *equals = memchr(text, '=', length);
    if (!equals)
        return stage_fail(STAGE_BAD_FILE, "%s:%d: a line must be `name = value`", file, line);
    size_t name_length = (size_t)(equals - text), value_length = length - name_length - 1;
    const char *name = trimmed(text, &name_length);
    const char *value = trimmed(equals + 1, &value_length);
    int color = name_find(color_names, STAGE_COLORS_COUNT, name, name_length);
    int size = name_find(size_names, STAGE_SIZES_COUNT, name, name_length);
    if (color < 0 && size < 0)
        return unknown(name, name_length, file, line);
    if (color >= 0 && !color_parse(value, value_length, &theme->colors[color]))
        return stage_fail(STAGE_BAD_FILE, "%s:%d: %s must be a colour, #rrggbb or #rrggbbaa",
                          file, line, color_names[color]);
    if (size >= 0 && !size_parse(value, value_length, &theme->sizes[size]))
        return stage_fail(STAGE_BAD_FILE, "%s:%d: %s must be a number of pixels, at most %g",
                          file, line, size_names[size], size_most_px);
    return STAGE_OK;
}

enum stage_status stage_theme_read(const char *text, size_t bytes, const char *name,
                                   struct stage_theme *theme)
{
    struct stage_theme read = *theme;
    const char *end = text + bytes;
    for (int line = 1; text < end; line++) {
        const char *stop = memchr(text, '\n', (size_t)(end - text));
        size_t length = (size_t)((stop ? stop : end) - text);
        enum stage_status status = line_read(text, length, name, line, &read);
        if (status != STAGE_OK)
            return status;
        text += length + (stop ? 1 : 0);
    }
    *theme = read;
    return STAGE_OK;
}

static enum stage_status file_read(const char *path, struct stage_theme *theme)
{
    static const char hint[] = "a theme is light, dark, or a file with lines `name = value`";
    const char *why;
    size_t count;
    char *text = input_file_read(path, FILE_BYTES_MAX, &count, &why);
    if (!text)
        return stage_fail(errno == ENOMEM ? STAGE_NO_MEMORY : STAGE_BAD_FILE,
                          "%s: cannot be read: %s: %s", path, why, hint);
    const enum stage_status status = stage_theme_read(text, count, path, theme);
    free(text);
    return status;
}

enum stage_status stage_theme_open(const char *name, struct stage_theme *theme)
{
    *theme = (struct stage_theme){0};
    enum stage_status status = stage_theme_read(stage_light_theme, sizeof stage_light_theme - 1,
                                                "the light theme", theme);
    if (status != STAGE_OK || strcmp(name, "light") == 0)
        return status;
    if (strcmp(name, "dark") == 0)
        return stage_theme_read(stage_dark_theme, sizeof stage_dark_theme - 1, "the dark theme",
                                theme);
    return file_read(name, theme);
}

/* ---- colours ---- */

static float mixed(float from, float to, float part)
{
    return (float)srgb_number(srgb_light(from) + part * (srgb_light(to) - srgb_light(from)));
}

struct stage_color stage_color_mix(struct stage_color from, struct stage_color to, double part)
{
    float p = (float)fmin(1, fmax(0, part));
    return (struct stage_color){mixed(from.r, to.r, p), mixed(from.g, to.g, p),
                                mixed(from.b, to.b, p), from.a + p * (to.a - from.a)};
}

struct stage_color stage_color_fade(struct stage_color color, double part)
{
    color.a *= (float)fmin(1, fmax(0, part));
    return color;
}
