/* cues_file.c - see cues_file.h. */
#include "cues_file.h"

#include <array.h>
#include <input_file.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double time_most_s = 36000, fade_most_s = 600;

struct reader {
    const char *path;
    int line;
    char *at; /* what is left of the line */
    struct cues_text *out;
};

static enum stage_status wrong(const struct reader *r, const char *why)
{
    return stage_fail(STAGE_BAD_FILE, "%.200s:%d: %s (got '%.40s')", r->path, r->line, why,
                      r->at);
}

/* The next word of the line, which it ends; "" at the end of the line. */
static char *word_take(struct reader *r)
{
    char *word = r->at + strspn(r->at, " \t");
    r->at = word + strcspn(word, " \t");
    if (*r->at)
        *r->at++ = '\0';
    r->at += strspn(r->at, " \t");
    return word;
}

static bool number_read(const char *text, double most, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && !*end && *out >= 0 && *out <= most;
}

static enum stage_status when_read(struct reader *r, struct cue *cue)
{
    const struct cues_text *all = r->out;
    const char *before = r->at, *word = word_take(r);
    bool gone = false;
    double last_s = 0;
    for (int i = 0; i < all->count; i++) {
        gone = gone || all->cues[i].when == CUE_GO;
        last_s =
            all->cues[i].when == CUE_AT ? all->cues[i].time_s : last_s + all->cues[i].time_s;
    }
    cue->when = strcmp(word, "go") == 0 ? CUE_GO : *word == '+' ? CUE_AFTER : CUE_AT;
    if (cue->when == CUE_GO)
        return STAGE_OK;
    if (!number_read(word + (cue->when == CUE_AFTER), time_most_s, &cue->time_s)) {
        r->at = (char *)(uintptr_t)before;
        return wrong(r, "a line begins with seconds, +seconds or go");
    }
    if (cue->when == CUE_AT && gone)
        return wrong(r, "behind a go times are counted from the cue before: +seconds");
    if (cue->when == CUE_AT && cue->time_s < last_s)
        return wrong(r, "times do not go back");
    return STAGE_OK;
}

/* The quote that ends the text that begins with one; NULL: there is none, or an escape that
 * means nothing. */
static char *quote_end(char *text)
{
    if (*text != '"')
        return NULL;
    for (char *at = text + 1; *at; at++) {
        if (*at == '"')
            return at;
        if (*at == '\\' && (!*++at || !strchr("n\"\\", *at)))
            return NULL;
    }
    return NULL;
}

/* "...": takes the escapes out, in place. NULL: it is none, and is as it was. */
static char *quoted_take(struct reader *r)
{
    char *text = r->at, *to = r->at, *end = quote_end(r->at);
    if (!end)
        return NULL;
    for (const char *from = text + 1; from < end; from++) {
        const bool escape = *from == '\\';
        from += escape;
        *to++ = escape && *from == 'n' ? '\n' : *from;
    }
    *to = '\0';
    r->at = end + 1 + strspn(end + 1, " \t");
    return text;
}

static enum stage_status text_read(struct reader *r, struct cue *cue)
{
    const char *text = quoted_take(r);
    if (!text)
        return wrong(r, "text goes with words in quotes, where \\n is a line's end");
    if (strlen(text) > STAGE_TEXT_BYTES)
        return wrong(r, "a text has 1000 bytes at most");
    cue->text = strdup(text);
    return cue->text ? STAGE_OK : stage_fail(STAGE_NO_MEMORY, "no memory for cues");
}

static enum stage_status scene_read(struct reader *r, struct cue *cue)
{
    double number;
    if (!number_read(word_take(r), 128, &number) || number < 1 || number != floor(number))
        return wrong(r, "scene goes with a number, 1 to 128");
    cue->scene = (int)number;
    return STAGE_OK;
}

static enum stage_status set_read(struct reader *r, struct cue *cue)
{
    char *name = word_take(r), *value = strchr(name, '=');
    if (!value || value == name || value - name >= CUE_NAME_BYTES || !value[1])
        return wrong(r, "set goes with CONTROL=VALUE");
    *value++ = '\0';
    memcpy(cue->name, name, strlen(name) + 1);
    cue->text = strdup(value);
    if (!cue->text)
        return stage_fail(STAGE_NO_MEMORY, "no memory for cues");
    if (strncmp(r->at, "fade", 4) != 0)
        return STAGE_OK;
    word_take(r);
    return number_read(word_take(r), fade_most_s, &cue->fade_s)
               ? STAGE_OK
               : wrong(r, "fade goes with seconds, 0 to 600");
}

static enum stage_status line_read(struct reader *r)
{
    struct cues_text *all = r->out;
    struct cue cue = {.line = r->line};
    if (all->count == CUES_MAX)
        return wrong(r, "1000 cues are the most");
    if (!array_reserve(&all->cues, &all->capacity, all->count + 1, sizeof *all->cues))
        return stage_fail(STAGE_NO_MEMORY, "no memory for cues");
    enum stage_status status = when_read(r, &cue);
    const char *what = status == STAGE_OK ? word_take(r) : "";
    if (status == STAGE_OK && strcmp(what, "text") == 0) {
        cue.what = CUE_TEXT;
        status = text_read(r, &cue);
    } else if (status == STAGE_OK && strcmp(what, "scene") == 0) {
        cue.what = CUE_SCENE;
        status = scene_read(r, &cue);
    } else if (status == STAGE_OK && strcmp(what, "set") == 0) {
        cue.what = CUE_SET;
        status = set_read(r, &cue);
    } else if (status == STAGE_OK) {
        status = stage_fail(STAGE_BAD_FILE,
                            "%.200s:%d: there is no cue '%.40s'; there are text, scene and set",
                            r->path, r->line, what);
    }
    if (status == STAGE_OK && *r->at)
        status = wrong(r, "there is something behind the cue");
    if (status == STAGE_OK)
        all->cues[all->count++] = cue;
    else
        free(cue.text);
    return status;
}

enum stage_status cues_text_read(char *text, size_t count, const char *name,
                                 struct cues_text *out)
{
    struct reader r = {.path = name, .out = out};
    enum stage_status status = STAGE_OK;
    *out = (struct cues_text){0};
    if (memchr(text, 0, count))
        status = stage_fail(STAGE_BAD_FILE, "%.200s: is no text", name);
    for (char *line = text; line && status == STAGE_OK;) {
        char *next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        line[strcspn(line, "\r")] = '\0';
        r.line++;
        r.at = line + strspn(line, " \t");
        if (*r.at && *r.at != '#')
            status = line_read(&r);
        line = next;
    }
    return status == STAGE_OK && out->count == 0
               ? stage_fail(STAGE_BAD_FILE, "%.200s: there is no cue in it", name)
               : status;
}

enum stage_status cues_file_read(const char *path, struct cues_text *out)
{
    size_t count = 0;
    const char *why = NULL;
    *out = (struct cues_text){0};
    char *text = input_file_read(path, CUES_FILE_BYTES_MAX, &count, &why);
    if (!text)
        return stage_fail(STAGE_BAD_FILE, "%.200s: cannot be read: %s", path, why);
    const enum stage_status status = cues_text_read(text, count, path, out);
    free(text);
    return status;
}

double cues_text_seconds(const struct cues_text *text)
{
    double at_s = 0, end_s = 0;
    for (int i = 0; i < text->count; i++) {
        const struct cue *cue = &text->cues[i];
        at_s = cue->when == CUE_AT ? cue->time_s : at_s + cue->time_s;
        end_s = fmax(end_s, at_s + cue->fade_s);
    }
    return end_s;
}

void cues_text_finish(struct cues_text *text)
{
    for (int i = 0; i < text->count; i++)
        free(text->cues[i].text);
    free(text->cues);
    *text = (struct cues_text){0};
}
