/* voice_transcript.c - see voice_transcript.h. */
#include "voice_transcript.h"

#include "voice_letters.h"

#include <input_file.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BYTES_MAX = 16 << 20, CUES_MAX = 1 << 20 };

/* A part of the bytes, and the number of its line. */
struct line {
    const char *at, *end;
    int number;
};

struct reader {
    const char *name, *at, *end;
    int number;
    struct voice_transcript *out;
    int room;
    char *why;
    size_t why_room;
};

static bool refuse(struct reader *r, int line, const char *what)
{
    if (line > 0)
        snprintf(r->why, r->why_room, "%s:%d: %s", r->name, line, what);
    else
        snprintf(r->why, r->why_room, "%s: %s", r->name, what);
    return false;
}

static bool line_next(struct reader *r, struct line *out)
{
    if (r->at >= r->end)
        return false;
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    out->at = r->at;
    out->end = stop ? stop : r->end;
    out->number = ++r->number;
    r->at = stop ? stop + 1 : r->end;
    if (out->end > out->at && out->end[-1] == '\r')
        out->end--;
    return true;
}

static bool line_empty(const struct line *l)
{
    for (const char *at = l->at; at < l->end; at++)
        if (*at != ' ' && *at != '\t')
            return false;
    return true;
}

static bool begins_with(const struct line *l, const char *word)
{
    const size_t n = strlen(word);
    return (size_t)(l->end - l->at) >= n && memcmp(l->at, word, n) == 0;
}

/* ---- times ---- */

/* Digits, at most nine; how many, or 0. */
static int digits_read(const char **at, const char *end, long *out)
{
    int n = 0;
    *out = 0;
    while (*at < end && **at >= '0' && **at <= '9' && n < 9) {
        *out = 10 * *out + (**at - '0');
        ++*at;
        n++;
    }
    return n;
}

/* [hours:]minutes:seconds with a fraction after a point or a comma. */
static bool time_read(const char **at, const char *end, double *seconds)
{
    long part[3], fraction = 0;
    int parts = 0;
    double scale = 1;
    do {
        if (parts == 3 || digits_read(at, end, &part[parts++]) == 0)
            return false;
    } while (*at < end && **at == ':' && ++*at);
    if (parts < 2)
        return false;
    if (*at < end && (**at == ',' || **at == '.')) {
        ++*at;
        int n = digits_read(at, end, &fraction);
        if (n == 0)
            return false;
        while (n-- > 0)
            scale *= 10;
    }
    const long seconds_whole = part[parts - 1], minutes = part[parts - 2];
    if (seconds_whole > 59 || (parts == 3 && minutes > 59))
        return false;
    *seconds = (parts == 3 ? 3600.0 * (double)part[0] : 0) + 60.0 * (double)minutes +
               (double)seconds_whole + (double)fraction / scale;
    return true;
}

static void spaces_skip(const char **at, const char *end)
{
    while (*at < end && (**at == ' ' || **at == '\t'))
        ++*at;
}

static bool has_arrow(const struct line *l)
{
    for (const char *at = l->at; at + 3 <= l->end; at++)
        if (memcmp(at, "-->", 3) == 0)
            return true;
    return false;
}

static bool times_read(const struct line *l, double *begin_s, double *end_s)
{
    const char *at = l->at;
    spaces_skip(&at, l->end);
    if (!time_read(&at, l->end, begin_s))
        return false;
    spaces_skip(&at, l->end);
    if (l->end - at < 3 || memcmp(at, "-->", 3) != 0)
        return false;
    at += 3;
    spaces_skip(&at, l->end);
    return time_read(&at, l->end, end_s) && (at == l->end || *at == ' ' || *at == '\t');
}

/* ---- cues ---- */

static bool has_word(const char *text)
{
    struct voice_words words;
    bool empty;
    const bool there = voice_words_make(text, &words, &empty);
    if (there)
        voice_words_finish(&words);
    return there;
}

/* Takes the text: it is freed where it has no word. False: no memory, or refused. */
static bool cue_add(struct reader *r, double begin_s, double end_s, char *text, int line)
{
    struct voice_transcript *t = r->out;
    if (!text)
        return refuse(r, 0, "no memory");
    if (!has_word(text)) {
        free(text);
        return true;
    }
    if (t->count == CUES_MAX || (t->count > 0 && begin_s < t->cues[t->count - 1].begin_s)) {
        free(text);
        return refuse(r, line,
                      t->count == CUES_MAX ? "there are too many cues"
                                           : "this begins before the one above it: sort them");
    }
    if (t->count == r->room) {
        const int room = 2 * r->room + 64;
        struct voice_cue *grown = realloc(t->cues, (size_t)room * sizeof *grown);
        if (!grown) {
            free(text);
            return refuse(r, 0, "no memory");
        }
        t->cues = grown;
        r->room = room;
    }
    if (t->count > 0 && t->cues[t->count - 1].end_s > begin_s)
        t->cues[t->count - 1].end_s = begin_s;
    t->cues[t->count++] = (struct voice_cue){begin_s, end_s, text};
    return true;
}

/* Copies characters without tags; *at ends at a tag that is a time, or at the end. */
static char *plain_text(const char **at, const char *end)
{
    static const struct {
        const char *name, *is;
    } entities[] = {{"&amp;", "&"},  {"&lt;", "<"}, {"&gt;", ">"},
                    {"&nbsp;", " "}, {"&lrm;", ""}, {"&rlm;", ""}};
    char *out = malloc((size_t)(end - *at) + 1);
    size_t n = 0;
    while (out && *at < end) {
        const char *stop = **at == '<'   ? memchr(*at, '>', (size_t)(end - *at))
                           : **at == '{' ? memchr(*at, '}', (size_t)(end - *at))
                                         : NULL;
        if (stop && **at == '<' && (*at)[1] >= '0' && (*at)[1] <= '9')
            break;
        if (stop && (**at == '<' || (*at)[1] == '\\')) {
            *at = stop + 1;
            continue;
        }
        size_t i = 0, count = sizeof entities / sizeof *entities;
        while (i < count && ((size_t)(end - *at) < strlen(entities[i].name) ||
                             memcmp(*at, entities[i].name, strlen(entities[i].name)) != 0))
            i++;
        if (i < count) {
            n += strlen(strcpy(out + n, entities[i].is));
            *at += strlen(entities[i].name);
            continue;
        }
        out[n++] = **at == '\n' || **at == '\r' || **at == '\0' ? ' ' : **at;
        ++*at;
    }
    if (out)
        out[n] = '\0';
    return out;
}

/* A cue's lines; a time within them, <00:01.400>, begins another cue. */
static bool cue_divide(struct reader *r, double begin_s, double end_s, const char *at,
                       const char *end, int line)
{
    for (;;) {
        char *text = plain_text(&at, end);
        double next_s = end_s;
        if (!text || at >= end)
            return cue_add(r, begin_s, end_s, text, line);
        at++;
        const bool good = time_read(&at, end, &next_s) && at < end && *at == '>' &&
                          next_s >= begin_s && next_s <= end_s;
        if (!good) {
            free(text);
            return refuse(r, line,
                          "a time within a cue must be between those before and after");
        }
        at++;
        if (!cue_add(r, begin_s, next_s, text, line))
            return false;
        begin_s = next_s;
    }
}

static bool cue_read(struct reader *r, const struct line *times)
{
    double begin_s, end_s;
    struct line l;
    if (!times_read(times, &begin_s, &end_s))
        return refuse(r, times->number, "a cue's times are like 00:00:01,000 --> 00:00:02,500");
    if (end_s <= begin_s)
        return refuse(r, times->number, "a cue must end after it begins");
    const char *from = r->at, *to = from;
    while (line_next(r, &l) && !line_empty(&l))
        to = l.end;
    return cue_divide(r, begin_s, end_s, from, to, times->number);
}

static bool cues_read(struct reader *r)
{
    struct line l;
    while (line_next(r, &l)) {
        if (begins_with(&l, "NOTE") || begins_with(&l, "STYLE") || begins_with(&l, "REGION")) {
            if (has_arrow(&l))
                return refuse(r, l.number, "a note cannot have times");
            while (line_next(r, &l) && !line_empty(&l))
                ;
        } else if (has_arrow(&l) && !cue_read(r, &l)) {
            return false;
        }
    }
    return r->out->count > 0 || refuse(r, 0, "there is no cue with a word in it");
}

static bool texts_join(struct reader *r)
{
    size_t bytes = 1, at = 0;
    for (int i = 0; i < r->out->count; i++)
        bytes += strlen(r->out->cues[i].text) + 1;
    r->out->text = malloc(bytes);
    if (!r->out->text)
        return refuse(r, 0, "no memory");
    for (int i = 0; i < r->out->count; i++) {
        const size_t n = strlen(r->out->cues[i].text);
        memcpy(r->out->text + at, r->out->cues[i].text, n);
        at += n;
        r->out->text[at++] = ' ';
    }
    r->out->text[at] = '\0';
    return true;
}

bool voice_transcript_parse(const char *name, const char *bytes, size_t count,
                            struct voice_transcript *out, char *why, size_t room)
{
    *out = (struct voice_transcript){0};
    if (count >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0) { /* a byte order mark */
        bytes += 3;
        count -= 3;
    }
    struct reader r = {.name = name,
                       .at = bytes,
                       .end = bytes + count,
                       .out = out,
                       .why = why,
                       .why_room = room};
    if (cues_read(&r) && texts_join(&r))
        return true;
    voice_transcript_finish(out);
    return false;
}

bool voice_transcript_read(const char *path, struct voice_transcript *out, char *why,
                           size_t room)
{
    const char *reason;
    size_t count;
    char *bytes = input_file_read(path, BYTES_MAX, &count, &reason);
    *out = (struct voice_transcript){0};
    if (!bytes && errno == EFBIG)
        snprintf(why, room, "%s: a transcript has 16 MB at most", path);
    else if (!bytes)
        snprintf(why, room, "%s: cannot read: %s", path, reason);
    const bool done = bytes && voice_transcript_parse(path, bytes, count, out, why, room);
    free(bytes);
    return done;
}

void voice_transcript_finish(struct voice_transcript *t)
{
    for (int i = 0; i < t->count; i++)
        free(t->cues[i].text);
    free(t->cues);
    free(t->text);
    *t = (struct voice_transcript){0};
}
