/* options.c - parses a command line by its table. */
#include "options.h"
#include "lutetia.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { SHOWN_MAX = 60 }; /* characters of a wrong value that a message shows */

/* Reads a finite number within the row's range; *end is behind it. */
static bool number_read(const struct option_row *row, const char *text, const char **end,
                        double *out)
{
    char *stop;
    errno = 0;
    if (*text == ' ' || *text == '\t' || *text == '\n')
        return false;
    *out = strtod(text, &stop);
    *end = stop;
    return stop != text && isfinite(*out) && errno != ERANGE && *out >= row->least &&
           *out <= row->most;
}

static bool integer_read(const struct option_row *row, const char *text, const char **end,
                         int *out)
{
    char *stop;
    errno = 0;
    if (*text == ' ' || *text == '\t' || *text == '\n')
        return false;
    long value = strtol(text, &stop, 10);
    *end = stop;
    if (stop == text || errno == ERANGE || (double)value < row->least ||
        (double)value > row->most)
        return false;
    *out = (int)value;
    return true;
}

static bool numbers_read(const struct option_row *row, const char *text, double *out)
{
    double values[OPTION_NUMBERS_MAX];
    for (int i = 0; i < row->count; i++) {
        if (!number_read(row, text, &text, &values[i]) ||
            *text != (i + 1 < row->count ? ',' : '\0'))
            return false;
        text++;
    }
    memcpy(out, values, sizeof *values * (size_t)row->count);
    return true;
}

/* A name for a PNG: it ends in .png, or has no ending. */
static bool png_named(const char *text)
{
    const char *slash = strrchr(text, '/'), *name = slash ? slash + 1 : text;
    const char *ending = strrchr(name, '.');
    return *text && (!ending || ending == name || strcasecmp(ending, ".png") == 0);
}

static bool value_take(const struct option_row *row, const char *text)
{
    const char *end = "";
    double number;
    int integer, size[2];
    struct option_list *list;
    struct option_texts *texts;
    switch (row->kind) {
    case OPTION_FLAG:
        *(bool *)row->target = true;
        return true;
    case OPTION_TEXT:
        *(const char **)row->target = text;
        return *text != '\0';
    case OPTION_PNG:
        *(const char **)row->target = text;
        return png_named(text);
    case OPTION_INTEGER:
        if (!integer_read(row, text, &end, &integer) || *end)
            return false;
        *(int *)row->target = integer;
        return true;
    case OPTION_NUMBER:
        if (!number_read(row, text, &end, &number) || *end)
            return false;
        *(double *)row->target = number;
        return true;
    case OPTION_NUMBERS:
        return numbers_read(row, text, row->target);
    case OPTION_SIZE:
        if (!integer_read(row, text, &end, &size[0]) || *end != 'x' ||
            !integer_read(row, end + 1, &end, &size[1]) || *end)
            return false;
        memcpy(row->target, size, sizeof size);
        return true;
    case OPTION_LIST:
        list = row->target;
        if (list->count == OPTION_LIST_MAX ||
            !numbers_read(row, text, list->numbers[list->count]))
            return false;
        list->count++;
        return true;
    case OPTION_TEXTS:
        texts = row->target;
        if (texts->count == OPTION_LIST_MAX || !*text)
            return false;
        texts->texts[texts->count++] = text;
        return true;
    }
    return false;
}

static bool value_wrong(const char *verb, const struct option_row *row, const char *text)
{
    char range[80] = "", count[32] = "";
    const char *shape = "must be";
    switch (row->kind) {
    case OPTION_TEXTS:
        if (((struct option_texts *)row->target)->count == OPTION_LIST_MAX) {
            fail_usage(verb, "--%s can be given %d times", row->name, OPTION_LIST_MAX);
            return false;
        }
        fail_usage(verb, "--%s needs a value: %s", row->name, row->value);
        return false;
    case OPTION_FLAG:
    case OPTION_TEXT:
        fail_usage(verb, "--%s needs a value: %s", row->name, row->value);
        return false;
    case OPTION_PNG:
        fail_usage(verb, "--%s names a picture, and pictures are PNG: FILE.png (got '%.*s')",
                   row->name, SHOWN_MAX, text);
        return false;
    case OPTION_INTEGER:
        shape = "must be a whole number in";
        break;
    case OPTION_NUMBER:
    case OPTION_NUMBERS:
    case OPTION_SIZE:
    case OPTION_LIST:
        break;
    }
    if (row->count > 0 && strstr(row->value, "..")) /* a value "X,Y,.." does not give the
                                                     * number */
        snprintf(count, sizeof count, "%d numbers ", row->count);
    snprintf(range, sizeof range, "%.10g..%.10g", row->least, row->most);
    if (row->kind == OPTION_INTEGER || row->kind == OPTION_NUMBER)
        fail_usage(verb, "--%s %s %s (got '%.*s')", row->name, shape, range, SHOWN_MAX, text);
    else if (row->kind == OPTION_LIST &&
             ((struct option_list *)row->target)->count == OPTION_LIST_MAX)
        fail_usage(verb, "--%s can be given %d times", row->name, OPTION_LIST_MAX);
    else
        fail_usage(verb, "--%s %s %s%s with each in %s (got '%.*s')", row->name, shape, count,
                   row->value, range, SHOWN_MAX, text);
    return false;
}

static const struct option_row *row_find(const struct option_row *rows, const char *argument,
                                         const char **value)
{
    *value = NULL;
    for (const struct option_row *row = rows; row->name; row++) {
        size_t length = strlen(row->name);
        if (argument[1] == '-' && strncmp(argument + 2, row->name, length) == 0 &&
            (argument[2 + length] == '\0' || argument[2 + length] == '=')) {
            *value = argument[2 + length] ? argument + 2 + length + 1 : NULL;
            return row;
        }
        if (row->letter && argument[1] == row->letter) {
            *value = argument[2] ? argument + 2 : NULL;
            return row;
        }
    }
    return NULL;
}

bool options_parse(const char *verb, const struct option_row *rows, int argc, char **argv,
                   struct option_words *words)
{
    *words = (struct option_words){0};
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            words->help = true;
            return true;
        }
    bool options_end = false;
    for (int i = 1; i < argc; i++) {
        const char *argument = argv[i], *value;
        if (!options_end && strcmp(argument, "--") == 0) {
            options_end = true;
            continue;
        }
        if (options_end || argument[0] != '-' || argument[1] == '\0') {
            if (words->count == OPTION_WORDS_MAX) {
                fail_usage(verb, "more than %d words", OPTION_WORDS_MAX);
                return false;
            }
            words->words[words->count++] = argument;
            continue;
        }
        const struct option_row *row = row_find(rows, argument, &value);
        if (!row) {
            fail_usage(verb, "there is no option '%.*s'; `lutetia %s --help` lists them",
                       SHOWN_MAX, argument, verb);
            return false;
        }
        if (row->kind == OPTION_FLAG && value) {
            fail_usage(verb, "--%s takes no value", row->name);
            return false;
        }
        if (row->kind != OPTION_FLAG && !value) {
            if (i + 1 == argc) {
                fail_usage(verb, "--%s needs a value: %s", row->name, row->value);
                return false;
            }
            value = argv[++i];
        }
        if (!value_take(row, value))
            return value_wrong(verb, row, value);
        if (row - rows < OPTION_ROWS_MAX)
            words->given[row - rows] = true;
    }
    return true;
}

/* ---- options without effect ---- */

/* Whether the option, or a word, of that name is given. */
static bool is_given(const struct option_row *rows, const struct option_words *words,
                     const char *name, size_t length)
{
    if (length == 4 && memcmp(name, "WORD", 4) == 0)
        return words->count > 0;
    for (int i = 0; rows[i].name; i++)
        if (strlen(rows[i].name) == length && memcmp(rows[i].name, name, length) == 0)
            return words->given[i];
    return false;
}

/* Whether one of the alternatives is there. */
static bool has_effect(const struct option_row *rows, const struct option_words *words,
                       const char *needs)
{
    bool all = true;
    for (const char *at = needs;; at++) {
        const bool not = *at == '!';
        const char *name = at + not ;
        const size_t length = strcspn(name, "|+");
        all = all && is_given(rows, words, name, length) != not ;
        at = name + length;
        if (*at == '+')
            continue;
        if (all || !*at)
            return all;
        all = true;
    }
}

/* "goes with --still or --video"; or, where nothing else helps, "does not go with a word". */
static void needs_text(const char *needs, char *out, size_t room)
{
    size_t used = (size_t)snprintf(out, room, "it goes with");
    const size_t begun = used;
    for (const char *at = needs; *at; at += strcspn(at, "|"), at += *at == '|') {
        const size_t length = strcspn(at, "|+");
        if (*at != '!' && used < room)
            used += (size_t)snprintf(out + used, room - used, "%s %s%.*s",
                                     used > begun ? " or" : "",
                                     memcmp(at, "WORD", 4) == 0 ? "" : "--", (int)length, at);
    }
    if (used == begun)
        snprintf(out, room,
                 strstr(needs, "!WORD") ? "it is for a window, without a file"
                                        : "it is for a window, without pictures");
}

bool options_effects(const char *verb, const struct option_row *rows,
                     const struct option_need *needs, const struct option_words *words)
{
    for (; needs->name; needs++) {
        char text[200];
        if (!is_given(rows, words, needs->name, strlen(needs->name)) ||
            has_effect(rows, words, needs->needs))
            continue;
        needs_text(needs->needs, text, sizeof text);
        fail_usage(verb, "--%s has no effect here: %s", needs->name, text);
        return false;
    }
    return true;
}

int options_own(const struct option_row *rows, int argc, char **argv)
{
    int i = 1;
    while (i < argc && argv[i][0] == '-' && argv[i][1] != '\0' && strcmp(argv[i], "--") != 0) {
        const char *value;
        const struct option_row *row = row_find(rows, argv[i], &value);
        i += row && row->kind != OPTION_FLAG && !value ? 2 : 1;
    }
    return i < argc ? i : argc;
}
