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

enum { WORDS_MAX = 9, LINE_MAX_BYTES = 400 };
static const long file_bytes_max = 1L << 28;

static const char *const kind_names[] = {"hand", "set", "mark", "drop", "undo", "reset"};
static const char *const event_names[] = {"down", "move", "up", "cancel"};

void stage_session_finish(struct stage_session *s)
{
    free(s->deeds);
    memset(s, 0, sizeof *s);
}

void stage_session_add(struct stage_session *s, const struct stage_deed *deed)
{
    if (s->broken)
        return;
    if (s->count == STAGE_DEEDS_MAX ||
        !array_reserve(&s->deeds, &s->capacity, s->count + 1, sizeof *s->deeds)) {
        s->broken = "it is too long";
        return;
    }
    s->deeds[s->count++] = *deed;
}

/* ---- writing ---- */

static void deed_print(const struct stage_deed *d, const struct stage_control *rows, FILE *to)
{
    const struct stage_event *e = &d->event;
    fprintf(to, "%lld %s", (long long)d->step, kind_names[d->kind]);
    if (d->kind == STAGE_DEED_SET)
        fprintf(to, " %s %.17g", rows[d->control].name, d->value);
    if (d->kind == STAGE_DEED_HAND)
        fprintf(to, " %s %.17g %.17g %.17g %.17g %d %u", event_names[e->kind], e->x, e->y,
                e->near, e->pressure, e->button, e->modifiers);
    fputc('\n', to);
}

enum stage_status stage_session_write(const struct stage_session *s,
                                      const struct stage_control *rows, const char *path)
{
    struct output_file out;
    if (s->broken)
        return stage_fail(STAGE_BAD_ARGUMENT, "%s: the session cannot be written: %s", path,
                          s->broken);
    if (!output_file_open(&out, path))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    fputs("session 1\n", out.stream);
    for (int i = 0; i < s->count; i++)
        deed_print(&s->deeds[i], rows, out.stream);
    fputs("end\n", out.stream);
    if (!output_file_commit(&out))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    return STAGE_OK;
}

/* ---- reading ---- */

struct line {
    char text[LINE_MAX_BYTES];
    char *words[WORDS_MAX];
    int count; /* WORDS_MAX + 1: more */
};

static void line_split(struct line *line)
{
    char *rest = line->text;
    line->count = 0;
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
static const char *set_read(const struct line *line, const struct stage_control *rows,
                            int count, struct stage_deed *deed)
{
    const struct stage_control *row =
        line->count == 4 ? stage_control_find(rows, count, line->words[2]) : NULL;
    if (line->count != 4)
        return "`STEP set NAME VALUE`";
    if (!row || !number_read(line->words[3], row->least, row->most, &deed->value))
        return row ? "a value within the control's range" : "a control that there is";
    deed->control = (int)(row - rows);
    return NULL;
}

/* NULL: it is fine; else what the line must be. */
static const char *deed_read(const struct line *line, const struct stage_control *rows,
                             int rows_count, int64_t least_step, struct stage_deed *deed)
{
    long long step;
    *deed = (struct stage_deed){0};
    if (line->count < 2 || !integer_read(line->words[0], INT64_MAX, &step) || step < least_step)
        return "STEP and what was done, steps in their order";
    int kind = name_find(kind_names, sizeof kind_names / sizeof *kind_names, line->words[1]);
    deed->step = step;
    deed->kind = (enum stage_deed_kind)kind;
    if (kind == STAGE_DEED_SET)
        return set_read(line, rows, rows_count, deed);
    if (kind == STAGE_DEED_HAND)
        return hand_read(line, &deed->event)
                   ? NULL
                   : "`STEP hand down|move|up|cancel X Y NEAR PRESSURE BUTTON MODIFIERS`";
    return kind >= 0 && line->count == 2 ? NULL
                                         : "hand, set, mark, drop, undo or reset after STEP";
}

static enum stage_status wrong(const char *name, int number, const char *must)
{
    return stage_fail(STAGE_BAD_FILE, "%s:%d: must be %s", name, number, must);
}

enum stage_status stage_session_parse(const char *text, size_t bytes, const char *name,
                                      const struct stage_control *rows, int rows_count,
                                      struct stage_session *out)
{
    const char *end = text + bytes;
    bool begun = false, ended = false;
    int number = 0;
    enum stage_status status = STAGE_OK;
    *out = (struct stage_session){0};
    while (status == STAGE_OK && text < end && !ended) {
        struct line line;
        struct stage_deed deed;
        const char *stop = memchr(text, '\n', (size_t)(end - text));
        size_t length = (size_t)((stop ? stop : end) - text);
        const char *must = NULL;
        number++;
        if (length >= sizeof line.text || memchr(text, '\0', length)) {
            status = wrong(name, number, "a line of text, not so long");
            break;
        }
        memcpy(line.text, text, length);
        line.text[length] = '\0';
        line_split(&line);
        text += length + (stop ? 1 : 0);
        if (line.count == 0 || line.words[0][0] == '#')
            continue;
        if (!begun)
            must = line.count == 2 && !strcmp(line.words[0], "session") &&
                           !strcmp(line.words[1], "1")
                       ? NULL
                       : "`session 1`: is this a session?";
        else if (line.count == 1 && strcmp(line.words[0], "end") == 0)
            ended = true;
        else
            must = deed_read(&line, rows, rows_count,
                             out->count ? out->deeds[out->count - 1].step : 0, &deed);
        if (must)
            status = wrong(name, number, must);
        else if (begun && !ended)
            stage_session_add(out, &deed);
        begun = true;
        if (out->broken)
            status = stage_fail(STAGE_NO_MEMORY, "%s: the session is too long", name);
    }
    if (status == STAGE_OK && !ended)
        status = wrong(name, number + 1, "`end`: the session was cut short");
    if (status != STAGE_OK)
        stage_session_finish(out);
    return status;
}

enum stage_status stage_session_read(const char *path, const struct stage_control *rows,
                                     int rows_count, struct stage_session *out)
{
    *out = (struct stage_session){0};
    const char *why;
    FILE *file = input_file_open(path, &why);
    if (!file)
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be read: %s", path, why);
    long bytes = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *text = bytes >= 0 && bytes <= file_bytes_max ? malloc((size_t)bytes + 1) : NULL;
    rewind(file);
    size_t count = text ? fread(text, 1, (size_t)bytes, file) : 0;
    bool whole = text && count == (size_t)bytes && !ferror(file);
    fclose(file);
    enum stage_status status =
        whole ? stage_session_parse(text, count, path, rows, rows_count, out)
              : stage_fail(STAGE_BAD_FILE, "%s: cannot be read, or is too long", path);
    free(text);
    return status;
}
