/* studio_palette.c - see studio_palette.h. */
#include "studio_palette.h"

#include <error_text.h>
#include <input_file.h>
#include <number_text.h>
#include <output_file.h>

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AMOUNT_MOST 2.0

/* ---- reading ---- */

struct reading {
    const struct paper_sheet_config *config;
    struct studio_palette *out;
    int line;
    char *why;
    size_t room;
};

__attribute__((format(printf, 2, 3))) static bool wrong(struct reading *r, const char *format,
                                                        ...)
{
    char text[200];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    snprintf(r->why, r->room, "line %d: %s", r->line, text);
    return false;
}

/* The number of what has the name: 0 is water; -1: the sheet does not have it. */
static int substance_find(const struct paper_sheet_config *config, const char *name)
{
    if (strcmp(name, "water") == 0)
        return 0;
    for (int i = 0; i < config->pigments_count; i++)
        if (strcmp(config->pigments[i].name, name) == 0)
            return 1 + i;
    return -1;
}

static char *trimmed(char *text)
{
    text += strspn(text, " \t\r");
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r", text[length - 1]))
        text[--length] = '\0';
    return text;
}

/* Whether the name is one of those in a list with ", " between. */
static bool list_has(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = list; *at;) {
        const size_t here = strcspn(at, ",");
        if (here == length && memcmp(at, name, length) == 0)
            return true;
        at += here;
        at += strspn(at, ", ");
    }
    return false;
}

/* "french ultramarine 0.6" */
static bool amount_read(struct reading *r, int well, char *text)
{
    char *name = trimmed(text), *number = strrchr(name, ' '), *end;
    if (!number)
        return wrong(r, "a name and an amount, not '%.60s'", name);
    *number++ = '\0';
    const double amount = strtod(number, &end);
    if (end == number || *end || !(amount >= 0 && amount <= AMOUNT_MOST))
        return wrong(r, "an amount is 0..%g, not '%.60s'", AMOUNT_MOST, number);
    name = trimmed(name);
    if (!*name || strlen(name) >= PAPER_NAME_MAX)
        return wrong(r, "no name of a pigment: '%.60s'", name);
    const int substance = substance_find(r->config, name);
    if (substance >= 0)
        r->out->amount[well][substance] = amount;
    else if (!list_has(r->out->missing, name))
        error_text_list(r->out->missing, sizeof r->out->missing, ", ", name);
    return true;
}

/* "1: water 0.8, ..." */
static bool well_read(struct reading *r, char *line)
{
    char *text = trimmed(line), *end;
    if (!*text || *text == '#')
        return true;
    const long number = strtol(text, &end, 10);
    if (end == text || *end != ':' || number < 1 || number > STUDIO_WELLS)
        return wrong(r, "a well is 1..%d and a colon, not '%.60s'", STUDIO_WELLS, text);
    const int well = (int)number - 1;
    if (r->out->filled[well])
        return wrong(r, "well %d is there twice", well + 1);
    r->out->filled[well] = true;
    for (char *part = trimmed(end + 1); part && *part;) {
        char *next = strchr(part, ',');
        if (next)
            *next++ = '\0';
        if (!amount_read(r, well, part))
            return false;
        part = next;
    }
    return true;
}

bool studio_palette_parse(const char *text, const struct paper_sheet_config *config,
                          struct studio_palette *out, char *why, size_t room)
{
    struct reading r = {.config = config, .out = out, .why = why, .room = room};
    char line[4096];
    bool good = true;
    *out = (struct studio_palette){0};
    for (const char *at = text; good && *at;) {
        const size_t length = strcspn(at, "\n");
        r.line++;
        if (length >= sizeof line)
            return wrong(&r, "it is too long");
        memcpy(line, at, length);
        line[length] = '\0';
        at += length + (at[length] == '\n');
        good = well_read(&r, line);
    }
    bool any = false;
    for (int i = 0; i < STUDIO_WELLS; i++)
        any = any || out->filled[i];
    if (good && !any)
        snprintf(why, room, "it has no well in it: a line is '1: water 0.8, NAME 0.6'");
    return good && any;
}

bool studio_palette_read(const char *path, const struct paper_sheet_config *config,
                         struct studio_palette *out, char *why, size_t room)
{
    const char *reason;
    char inner[400] = "";
    size_t count;
    char *text = input_file_read(path, STUDIO_PALETTE_BYTES, &count, &reason);
    *out = (struct studio_palette){0};
    if (!text && errno != EFBIG) {
        snprintf(why, room, "%s: cannot read: %s", path, reason);
        return false;
    }
    bool good = false;
    if (!text || memchr(text, 0, count))
        snprintf(inner, sizeof inner, "it is no palette");
    else
        good = studio_palette_parse(text, config, out, inner, sizeof inner);
    free(text);
    if (!good)
        snprintf(why, room, "%s: %s", path, inner);
    return good;
}

/* ---- writing ---- */

bool studio_palette_write(const char *path, const struct paper_sheet_config *config,
                          const struct studio_palette *palette, char *why, size_t room)
{
    struct output_file out;
    if (!output_file_open(&out, path)) {
        snprintf(why, room, "%s: cannot write: %s", path, out.why);
        return false;
    }
    fputs("# a palette of lutetia studio: a well a line, amounts 0..2 by name\n", out.stream);
    for (int well = 0; well < STUDIO_WELLS; well++) {
        const char *between = " ";
        fprintf(out.stream, "%d:", well + 1);
        for (int i = 0; i <= config->pigments_count; i++) {
            if (palette->amount[well][i] == 0)
                continue;
            fprintf(out.stream, "%s%s ", between, i ? config->pigments[i - 1].name : "water");
            number_text_print(out.stream, palette->amount[well][i]);
            between = ", ";
        }
        fputc('\n', out.stream);
    }
    if (output_file_commit(&out))
        return true;
    snprintf(why, room, "%s: cannot write: %s", path, out.why);
    return false;
}
