/* session.c - see session.h. */
#include "session.h"

#include <array.h>
#include <input_file.h>
#include <output_file.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 9, LINE_MAX_BYTES = 4400 };
enum { PATH_MOST = 4095 };
static const long file_bytes_max = 1L << 28;

static const char *const kind_names[] = {"hand", "set",  "load", "text",
                                         "mark", "drop", "undo", "reset"};
static const char *const event_names[] = {"down", "move", "up", "cancel"};

void stage_session_finish(struct stage_session *s)
{
    for (int i = 0; i < s->files_count; i++)
        free(s->files[i].path);
    free(s->files);
    for (int i = 0; i < s->texts_count; i++)
        free(s->texts[i]);
    free(s->texts);
    free(s->deeds);
    memset(s, 0, sizeof *s);
}

void stage_session_add(struct stage_session *s, const struct stage_deed *deed)
{
    if (s->broken)
        return;
    struct stage_deed *last = s->count ? &s->deeds[s->count - 1] : NULL;
    if (last && deed->kind == STAGE_DEED_SET && last->kind == STAGE_DEED_SET &&
        last->control == deed->control && last->step == deed->step) {
        last->value = deed->value; /* a wheel that is turned sends thousands */
        return;
    }
    if (s->count == STAGE_DEEDS_MAX ||
        !array_reserve(&s->deeds, &s->capacity, s->count + 1, sizeof *s->deeds)) {
        s->broken = "it is too long";
        return;
    }
    s->deeds[s->count++] = *deed;
}

/* What can be gone back to keeps its rate, as stage.c's marks do. */
struct rates {
    double now, beginning, marks[STAGE_SESSION_MARKS_MAX];
    int count;
};

static void rate_push(struct rates *r)
{
    if (r->count == STAGE_SESSION_MARKS_MAX)
        memmove(r->marks, r->marks + 1, (size_t)--r->count * sizeof *r->marks);
    r->marks[r->count++] = r->now;
}

static void rate_follow(struct rates *r, const struct stage_deed *d, int rate_control)
{
    switch (d->kind) {
    case STAGE_DEED_SET:
        if (d->control == rate_control)
            r->now = d->value;
        break;
    case STAGE_DEED_MARK:
        rate_push(r);
        break;
    case STAGE_DEED_DROP:
        r->count -= r->count > 0;
        break;
    case STAGE_DEED_UNDO:
        if (r->count > 0)
            r->now = r->marks[--r->count];
        break;
    case STAGE_DEED_RESET:
        rate_push(r);
        r->now = r->beginning;
        break;
    case STAGE_DEED_HAND:
    case STAGE_DEED_LOAD:
    case STAGE_DEED_TEXT:
        break;
    }
}

double stage_session_seconds(const struct stage_session *s, double rate, double step_s,
                             int rate_control)
{
    struct rates rates = {.now = rate, .beginning = rate};
    int64_t step = 0;
    double seconds = 0;
    for (int i = 0; i < s->count; i++) {
        seconds += (double)(s->deeds[i].step - step) * step_s / rates.now;
        step = s->deeds[i].step;
        rate_follow(&rates, &s->deeds[i], rate_control);
    }
    return s->end > step ? seconds + (double)(s->end - step) * step_s / rates.now : seconds;
}

/* ---- texts ---- */

void stage_session_add_text(struct stage_session *s, int64_t step, const char *words)
{
    if (s->broken)
        return;
    char *copy = strdup(words);
    if (!copy ||
        !array_reserve(&s->texts, &s->texts_capacity, s->texts_count + 1, sizeof *s->texts)) {
        free(copy);
        s->broken = "it is too long";
        return;
    }
    s->texts[s->texts_count++] = copy;
    stage_session_add(s, &(struct stage_deed){.step = step,
                                              .kind = STAGE_DEED_TEXT,
                                              .file = s->texts_count - 1});
}

static void text_print(const char *words, FILE *to)
{
    for (; *words; words++)
        if (*words == '\n' || *words == '\\')
            fprintf(to, "\\%c", *words == '\n' ? 'n' : '\\');
        else
            fputc(*words, to);
}

/* The other way round, in place. False: a backslash has nothing to say, or it is no text of a
 * stage's length. */
static bool text_unprint(char *words)
{
    char *to = words;
    for (const char *at = words; *at; at++) {
        if (*at == '\\') {
            at++;
            if (*at != 'n' && *at != '\\')
                return false;
            *to++ = *at == 'n' ? '\n' : '\\';
        } else {
            *to++ = *at;
        }
    }
    *to = '\0';
    return to > words && to - words <= STAGE_TEXT_BYTES;
}

/* ---- loaded files ---- */

uint64_t stage_digest(uint64_t digest, const void *bytes, size_t count)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < count; i++)
        digest = (digest ^ b[i]) * 0x100000001b3u;
    return digest;
}

/* NULL: it was read; else why not. */
static const char *digest_find(const char *path, uint64_t *digest)
{
    const char *why = NULL;
    unsigned char bytes[1 << 14];
    FILE *file = input_file_open(path, &why);
    *digest = STAGE_DIGEST_NONE;
    if (!file)
        return why;
    for (size_t count; (count = fread(bytes, 1, sizeof bytes, file)) > 0;)
        *digest = stage_digest(*digest, bytes, count);
    why = ferror(file) ? strerror(errno) : NULL;
    fclose(file);
    return why;
}

/* False: no memory. */
static bool file_add(struct stage_session *s, const char *path, uint64_t digest)
{
    char *copy = strdup(path);
    if (!copy ||
        !array_reserve(&s->files, &s->files_capacity, s->files_count + 1, sizeof *s->files)) {
        free(copy);
        return false;
    }
    s->files[s->files_count++] = (struct stage_file){copy, digest};
    return true;
}

void stage_session_add_load(struct stage_session *s, int64_t step, const char *path)
{
    uint64_t digest;
    size_t length = strlen(path);
    if (s->broken)
        return;
    if (!length || length > PATH_MOST || strpbrk(path, "\r\n"))
        s->broken = "a file with such a name was loaded";
    else if (digest_find(path, &digest))
        s->broken = "a file was loaded that is gone";
    else if (!file_add(s, path, digest))
        s->broken = "it is too long";
    else
        stage_session_add(s, &(struct stage_deed){.step = step,
                                                  .kind = STAGE_DEED_LOAD,
                                                  .file = s->files_count - 1});
}

enum stage_status stage_session_file_check(const struct stage_file *file, const char *name,
                                           int line)
{
    uint64_t digest;
    const char *why = digest_find(file->path, &digest);
    if (why)
        return stage_fail(STAGE_BAD_FILE, "%s:%d: loads %s, which cannot be read: %s", name,
                          line, file->path, why);
    if (digest != file->digest)
        return stage_fail(STAGE_BAD_FILE,
                          "%s:%d: loads %s, which has changed since the session", name, line,
                          file->path);
    return STAGE_OK;
}

/* ---- writing ---- */

void stage_session_deed_print(const struct stage_session *s, const struct stage_deed *d,
                              const struct control *rows, FILE *to)
{
    const struct stage_event *e = &d->event;
    fprintf(to, "%lld %s", (long long)d->step, kind_names[d->kind]);
    if (d->kind == STAGE_DEED_SET)
        fprintf(to, " %s %.17g", rows[d->control].name, d->value);
    if (d->kind == STAGE_DEED_LOAD)
        fprintf(to, " %016llx %s", (unsigned long long)s->files[d->file].digest,
                s->files[d->file].path);
    if (d->kind == STAGE_DEED_TEXT) {
        fputc(' ', to);
        text_print(s->texts[d->file], to);
    }
    if (d->kind == STAGE_DEED_HAND)
        fprintf(to, " %s %.17g %.17g %.17g %.17g %d %u", event_names[e->kind], e->x, e->y,
                e->near, e->pressure, e->button, e->modifiers);
    fputc('\n', to);
}

enum stage_status stage_session_write(const struct stage_session *s, const struct control *rows,
                                      const char *path)
{
    struct output_file out;
    if (s->broken)
        return stage_fail(STAGE_BAD_ARGUMENT, "%s: the session cannot be written: %s", path,
                          s->broken);
    if (!output_file_open(&out, path))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    fputs("session 1\n", out.stream);
    if (s->begin)
        fprintf(out.stream, "begin %016llx\n", (unsigned long long)s->begin);
    for (int i = 0; i < s->count; i++)
        stage_session_deed_print(s, &s->deeds[i], rows, out.stream);
    if (s->end)
        fprintf(out.stream, "end %lld\n", (long long)s->end);
    else
        fputs("end\n", out.stream);
    if (!output_file_commit(&out))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    return STAGE_OK;
}

/* ---- reading ---- */

struct line {
    char text[LINE_MAX_BYTES];
    char whole[LINE_MAX_BYTES]; /* with its blanks */
    char *words[WORDS_MAX];
    int count; /* WORDS_MAX + 1: more */
};

static void line_split(struct line *line)
{
    char *rest = line->text;
    line->count = 0;
    snprintf(line->whole, sizeof line->whole, "%s", line->text);
    for (char *word; (word = strtok_r(rest, " \t\r", &rest));) {
        if (line->count == WORDS_MAX) {
            line->count++;
            return;
        }
        line->words[line->count++] = word;
    }
}

static bool number_read(const char *word, double least, double most, double *out)
{
    char *end;
    *out = strtod(word, &end);
    return end != word && !*end && *out >= least && *out <= most;
}

static bool integer_read(const char *word, long long most, long long *out)
{
    char *end;
    errno = 0;
    *out = strtoll(word, &end, 10);
    return end != word && !*end && !errno && *out >= 0 && *out <= most;
}

static int name_find(const char *const *names, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return (int)i;
    return -1;
}

/* STEP hand WHAT X Y NEAR PRESSURE BUTTON MODIFIERS */
static bool hand_read(const struct line *line, struct stage_event *event)
{
    const double far = 1e9;
    long long button, modifiers;
    int kind = line->count == 9 ? name_find(event_names, 4, line->words[2]) : -1;
    if (kind < 0 || !number_read(line->words[3], -far, far, &event->x) ||
        !number_read(line->words[4], -far, far, &event->y) ||
        !number_read(line->words[5], 0, far, &event->near) ||
        !number_read(line->words[6], 0, 1, &event->pressure) ||
        !integer_read(line->words[7], 255, &button) ||
        !integer_read(line->words[8], 255, &modifiers))
        return false;
    event->kind = (enum stage_event_kind)kind;
    event->button = (int)button;
    event->modifiers = (unsigned)modifiers;
    return true;
}

/* STEP set NAME VALUE. NULL: it is fine; else what it must be. */
static const char *set_read(const struct line *line, const struct control *rows, int count,
                            struct stage_deed *deed)
{
    const struct control *row =
        line->count == 4 ? stage_control_find(rows, count, line->words[2]) : NULL;
    if (line->count != 4)
        return "`STEP set NAME VALUE`";
    if (!row || !number_read(line->words[3], row->least, row->most, &deed->value))
        return row ? "a value within the control's range" : "a control that there is";
    deed->control = (int)(row - rows);
    return NULL;
}

static bool digest_read(const char *word, uint64_t *out)
{
    *out = strtoull(word, NULL, 16);
    return strlen(word) == 16 && strspn(word, "0123456789abcdef") == 16;
}

/* STEP load DIGEST PATH: a path may have blanks. NULL: it is fine; else what it must be. */
static const char *load_read(struct line *line, struct stage_session *out,
                             struct stage_deed *deed)
{
    static const char must[] = "`STEP load DIGEST FILE`, a digest of 16 hexadecimal digits";
    if (line->count < 4)
        return must;
    const char *digits = line->words[2];
    char *path = line->whole + (digits - line->text) + strlen(digits) + 1;
    size_t length = strlen(path);
    if (length && path[length - 1] == '\r')
        path[--length] = '\0';
    uint64_t digest;
    if (!digest_read(digits, &digest) || !length || length > PATH_MOST)
        return must;
    if (!file_add(out, path, digest))
        out->broken = "no memory";
    deed->file = out->files_count - 1;
    return NULL;
}

/* STEP text WORDS. NULL: it is fine, and added; else what it must be. */
static const char *text_read(struct line *line, struct stage_session *out,
                             const struct stage_deed *deed)
{
    char *words = line->count > 2
                      ? line->whole + (line->words[1] - line->text) + strlen(line->words[1]) + 1
                      : NULL;
    const size_t length = words ? strlen(words) : 0;
    if (length && words[length - 1] == '\r')
        words[length - 1] = '\0';
    if (!words || !text_unprint(words))
        return "`STEP text WORDS`, of 1000 bytes at most, \\n for a line's end, \\\\ for a "
               "backslash";
    stage_session_add_text(out, deed->step, words);
    if (out->count)
        out->deeds[out->count - 1].line = deed->line;
    return NULL;
}

/* NULL: it is fine; else what the line must be. */
static const char *deed_read(struct line *line, const struct control *rows, int rows_count,
                             int number, struct stage_session *out, struct stage_deed *deed)
{
    int64_t least_step = out->count ? out->deeds[out->count - 1].step : 0;
    long long step;
    *deed = (struct stage_deed){.line = number};
    if (line->count < 2 || !integer_read(line->words[0], INT64_MAX, &step) || step < least_step)
        return "STEP and what was done, steps in their order";
    int kind = name_find(kind_names, sizeof kind_names / sizeof *kind_names, line->words[1]);
    deed->step = step;
    deed->kind = (enum stage_deed_kind)kind;
    if (kind == STAGE_DEED_SET)
        return set_read(line, rows, rows_count, deed);
    if (kind == STAGE_DEED_TEXT)
        return text_read(line, out, deed);
    if (kind == STAGE_DEED_LOAD)
        return load_read(line, out, deed);
    if (kind == STAGE_DEED_HAND)
        return hand_read(line, &deed->event)
                   ? NULL
                   : "`STEP hand down|move|up|cancel X Y NEAR PRESSURE BUTTON MODIFIERS`";
    return kind >= 0 && line->count == 2
               ? NULL
               : "hand, set, load, text, mark, drop, undo or reset after STEP";
}

static enum stage_status wrong(const char *name, int number, const char *must)
{
    return stage_fail(STAGE_BAD_FILE, "%s:%d: must be %s", name, number, must);
}

struct reader {
    const struct control *rows;
    int rows_count, number; /* of the line */
    bool begun, ended;
};

/* end [STEP]. NULL: it is fine; else what the line must be. */
static const char *end_read(struct reader *r, const struct line *line,
                            struct stage_session *out)
{
    long long step = 0;
    const int64_t least = out->count ? out->deeds[out->count - 1].step : 0;
    r->ended =
        line->count == 1 ||
        (line->count == 2 && integer_read(line->words[1], INT64_MAX, &step) && step >= least);
    out->end = step;
    return r->ended ? NULL : "`end STEP`, not before what was done";
}

/* NULL: it is fine; else what the line must be. */
static const char *line_read(struct reader *r, struct line *line, struct stage_session *out)
{
    struct stage_deed deed;
    const char *first = line->words[0];
    if (!r->begun) {
        r->begun =
            line->count == 2 && !strcmp(first, "session") && !strcmp(line->words[1], "1");
        return r->begun ? NULL : "`session 1`: is this a session?";
    }
    if (strcmp(first, "end") == 0)
        return end_read(r, line, out);
    if (strcmp(first, "begin") == 0)
        return line->count == 2 && !out->count && digest_read(line->words[1], &out->begin)
                   ? NULL
                   : "`begin DIGEST`, before what was done";
    const char *must = deed_read(line, r->rows, r->rows_count, r->number, out, &deed);
    if (!must && deed.kind != STAGE_DEED_TEXT) /* which is added with its words */
        stage_session_add(out, &deed);
    return must;
}

enum stage_status stage_session_parse(const char *text, size_t bytes, const char *name,
                                      const struct control *rows, int rows_count,
                                      struct stage_session *out)
{
    const char *end = text + bytes;
    struct reader r = {.rows = rows, .rows_count = rows_count};
    enum stage_status status = STAGE_OK;
    *out = (struct stage_session){0};
    while (status == STAGE_OK && text < end && !r.ended) {
        struct line line;
        const char *stop = memchr(text, '\n', (size_t)(end - text));
        size_t length = (size_t)((stop ? stop : end) - text);
        r.number++;
        if (length >= sizeof line.text || memchr(text, '\0', length)) {
            status = wrong(name, r.number, "a line of text, not so long");
            break;
        }
        memcpy(line.text, text, length);
        line.text[length] = '\0';
        line_split(&line);
        text += length + (stop ? 1 : 0);
        if (line.count == 0 || line.words[0][0] == '#')
            continue;
        const char *must = line_read(&r, &line, out);
        if (must)
            status = wrong(name, r.number, must);
        else if (out->broken)
            status = stage_fail(STAGE_NO_MEMORY, "%s: the session is too long", name);
    }
    if (status == STAGE_OK && !r.ended)
        status = wrong(name, r.number + 1, "`end`: the session was cut short");
    if (status != STAGE_OK)
        stage_session_finish(out);
    return status;
}

enum stage_status stage_session_read(const char *path, const struct control *rows,
                                     int rows_count, struct stage_session *out)
{
    *out = (struct stage_session){0};
    const char *why;
    size_t count;
    char *text = input_file_read(path, (size_t)file_bytes_max, &count, &why);
    if (!text)
        return stage_fail(errno == ENOMEM ? STAGE_NO_MEMORY : STAGE_BAD_FILE,
                          "%s: cannot be read: %s", path, why);
    enum stage_status status = stage_session_parse(text, count, path, rows, rows_count, out);
    free(text);
    for (int i = 0; status == STAGE_OK && i < out->count; i++)
        if (out->deeds[i].kind == STAGE_DEED_LOAD)
            status = stage_session_file_check(&out->files[out->deeds[i].file], path,
                                              out->deeds[i].line);
    if (status != STAGE_OK)
        stage_session_finish(out);
    return status;
}
