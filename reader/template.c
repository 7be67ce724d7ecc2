/* template.c - templates as texts: see reader_template.h. */
#include "reader_internal.h"
#include "reader_template.h"

#include <input_file.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- those that are built in ---- */

static const struct {
    const char *name, *text;
} built_in[] = {{"screen", "name screen\n"
                           "columns 34 12.2\n"
                           "gutter 0.8\n"
                           "text 1\n"
                           "notes 2\n"},
                {"book", "name book\n"
                         "columns 7 30 13\n"
                         "gutter 1.6\n"
                         "text 2\n"
                         "notes 3\n"
                         "headings 1-2\n"
                         "figures 1-2\n"
                         "demonstrations 2-3\n"
                         "tables 1-2\n"},
                {"two-columns", "name two-columns\n"
                                "columns 8..12 19..27 19..27 8..12\n"
                                "gutter 1.5\n"
                                "text 2 3\n"
                                "notes 1 4\n"
                                "headings 2-3\n"
                                "figures 2-3\n"
                                "demonstrations 2-3\n"
                                "tables 2-3\n"}};
enum { BUILT_IN = sizeof built_in / sizeof *built_in };
const char *const reader_template_names[] = {"screen", "book", "two-columns", NULL};

enum reader_status reader_template_named(const char *name, struct reader_template *out)
{
    for (int i = 0; i < BUILT_IN; i++)
        if (strcmp(name, built_in[i].name) == 0)
            return reader_template_parse(built_in[i].text, strlen(built_in[i].text),
                                         built_in[i].name, out);
    return reader_fail(READER_BAD_ARGUMENT, "templates are %s, %s and %s (got '%.60s')",
                       built_in[0].name, built_in[1].name, built_in[2].name, name);
}

/* ---- words ---- */

static const char *const wide_names[READER_WIDES] = {"headings", "figures", "demonstrations",
                                                     "tables"};
const char *const reader_size_names[READER_SIZES] = {"heading-1", "heading-2", "heading-3",
                                                     "note",      "code",      "table"};
enum { WORDS_MAX = READER_GRID_COLUMNS_MAX + 2 };

/* A line's words, and where it is. */
struct reading {
    struct reader_template *t;
    const char *where;
    int line, count;
    char words[WORDS_MAX][READER_TEMPLATE_NAME_BYTES];
    bool seen_columns, seen_gutter, seen_text, seen_notes, seen_wide[READER_WIDES];
};

__attribute__((format(printf, 2, 3))) static enum reader_status wrong(const struct reading *r,
                                                                      const char *format, ...)
{
    char text[400];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return reader_fail(READER_BAD_ARGUMENT, "%s:%d: %s", r->where, r->line, text);
}

/* Digits, and up to two behind a point; whatever the locale. *rest: behind them. */
static bool number_read(const char *word, double *to, const char **rest)
{
    int value = 0, digits = 0;
    double scale = 1;
    for (; *word >= '0' && *word <= '9'; word++, digits++) {
        if (digits >= 4)
            return false;
        value = 10 * value + *word - '0';
    }
    *to = value;
    if (digits && *word == '.' && word[1] != '.') {
        word++;
        for (digits = 0; *word >= '0' && *word <= '9'; word++, digits++) {
            if (digits >= 2)
                return false;
            scale *= 10;
            value = 10 * value + *word - '0';
        }
        *to = value / scale;
    }
    *rest = word;
    return digits > 0;
}

/* 24, 20..34 or 2*. */
static enum reader_status column_read(const struct reading *r, const char *word,
                                      struct reader_template_column *column)
{
    const double most = 200;
    const char *rest;
    double a, b;
    *column = (struct reader_template_column){0};
    bool good = number_read(word, &a, &rest);
    b = a;
    if (good && strcmp(rest, "*") == 0) {
        column->share = a;
        if (a >= 0.01 && a <= most)
            return READER_OK;
    } else if (good && strncmp(rest, "..", 2) == 0) {
        good = number_read(rest + 2, &b, &rest);
    }
    if (!good || *rest || a < 1 || b < a || b > most)
        return wrong(
            r,
            "a column is 1..%.0f ems wide, as 24, or 20..34, or has a share of what is "
            "left, as 2* (got '%.40s')",
            most, word);
    column->share = 0;
    column->least_em = a;
    column->most_em = b;
    return READER_OK;
}

static enum reader_status columns_read(struct reading *r)
{
    if (r->count < 2 || r->count - 1 > READER_GRID_COLUMNS_MAX)
        return wrong(r, "a grid has 1..%d columns", READER_GRID_COLUMNS_MAX);
    r->t->columns_count = r->count - 1;
    r->seen_columns = true;
    enum reader_status status = READER_OK;
    for (int i = 1; i < r->count && status == READER_OK; i++)
        status = column_read(r, r->words[i], &r->t->columns[i - 1]);
    return status;
}

/* 2 or 2-3, of the grid's columns. */
static enum reader_status span_read(const struct reading *r, const char *word,
                                    struct reader_place_span *span)
{
    const char *rest;
    double first, last;
    bool good = number_read(word, &first, &rest);
    last = first;
    if (good && *rest == '-')
        good = number_read(rest + 1, &last, &rest);
    if (!good || *rest || first != floor(first) || last != floor(last) || first < 1 ||
        last < first || last > r->t->columns_count)
        return wrong(r, "a place is columns of the grid's 1..%d, as 2 or 2-3 (got '%.40s')",
                     r->t->columns_count, word);
    *span = (struct reader_place_span){(int)first - 1, (int)last - 1};
    return READER_OK;
}

static enum reader_status spans_read(struct reading *r, struct reader_place_span *spans,
                                     int most, int *count)
{
    enum reader_status status = READER_OK;
    if (!r->seen_columns)
        return wrong(r, "'columns' comes before '%s'", r->words[0]);
    if (r->count - 1 < 1 || r->count - 1 > most)
        return wrong(r, "'%s' has 1..%d places (got %d)", r->words[0], most, r->count - 1);
    for (int i = 1; i < r->count && status == READER_OK; i++)
        status = span_read(r, r->words[i], &spans[i - 1]);
    *count = r->count - 1;
    return status;
}

static enum reader_status size_read(struct reading *r)
{
    const char *rest;
    double size;
    for (int i = 0; i < READER_SIZES && r->count == 3; i++) {
        if (strcmp(r->words[1], reader_size_names[i]) != 0)
            continue;
        if (!number_read(r->words[2], &size, &rest) || *rest || size < READER_SIZE_LEAST ||
            size > READER_SIZE_MOST)
            return wrong(r, "a size is 0.4..4 of the text's (got '%.40s')", r->words[2]);
        r->t->sizes[i] = size;
        return READER_OK;
    }
    return wrong(r, "a size is as 'size note 0.82', of heading-1, heading-2, heading-3, note, "
                    "code or table");
}

/* right 40%: the words as a figure would say them. */
static enum reader_status beside_line(struct reading *r)
{
    char words[WORDS_MAX * READER_TEMPLATE_NAME_BYTES] = "";
    for (int i = 1; i < r->count; i++) {
        strcat(words, r->words[i]);
        strcat(words, " ");
    }
    return reader_beside_read(words, &r->t->beside)
               ? READER_OK
               : wrong(r, "figures stand beside text as 'beside right 40%%': left or right, "
                          "10%%..90%% of the column, and round or shape; or full");
}

static double *colour_of(struct reader_template *t, int theme, int number)
{
    return reader_colour_at(&t->colours[theme], number);
}

static enum reader_status colour_line(struct reading *r)
{
    for (int i = 0; i < READER_COLOURS && r->count == 4; i++)
        if (strcmp(r->words[1], reader_colour_names[i]) == 0)
            return reader_colour_read(r->words[2], colour_of(r->t, 0, i)) &&
                           reader_colour_read(r->words[3], colour_of(r->t, 1, i))
                       ? READER_OK
                       : wrong(r,
                               "a colour is #rrggbb, light and dark (got '%.20s' and '%.20s')",
                               r->words[2], r->words[3]);
    return wrong(r, "a colour is as 'colour ink #121214 #dbd9d1', of paper, ink, link, struck, "
                    "selected, found, current, marked or noted");
}

static enum reader_status line_take(struct reading *r)
{
    const char *word = r->words[0], *rest;
    int count;
    for (int i = 0; i < READER_WIDES; i++)
        if (strcmp(word, wide_names[i]) == 0) {
            r->seen_wide[i] = true;
            return spans_read(r, &r->t->wide[i], 1, &count);
        }
    if (strcmp(word, "columns") == 0)
        return r->seen_columns ? wrong(r, "'columns' stands once") : columns_read(r);
    if (strcmp(word, "text") == 0) {
        r->seen_text = true;
        return spans_read(r, r->t->text, READER_TEXTS_MAX, &r->t->texts_count);
    }
    if (strcmp(word, "notes") == 0)
        return spans_read(r, r->t->notes, READER_TEXTS_MAX, &r->t->notes_count);
    if (strcmp(word, "beside") == 0)
        return beside_line(r);
    if (strcmp(word, "size") == 0)
        return size_read(r);
    if (strcmp(word, "colour") == 0)
        return colour_line(r);
    if (strcmp(word, "name") == 0 && r->count == 2) {
        snprintf(r->t->name, sizeof r->t->name, "%s", r->words[1]);
        return READER_OK;
    }
    if (strcmp(word, "name") == 0)
        return wrong(r, "a name is one word");
    if (strcmp(word, "gutter") == 0) {
        if (r->count == 2 && number_read(r->words[1], &r->t->gutter_em, &rest) && !*rest &&
            r->t->gutter_em >= 0.2 && r->t->gutter_em <= 20)
            return READER_OK;
        return wrong(r, "a gutter is 0.2..20 ems (got '%.40s')",
                     r->count > 1 ? r->words[1] : "");
    }
    return wrong(r,
                 "there is no '%.40s' (known: name, columns, gutter, text, notes, headings, "
                 "figures, demonstrations, tables, beside, size, colour)",
                 word);
}

/* ---- what fits together ---- */

static bool overlap(struct reader_place_span a, struct reader_place_span b)
{
    return a.first <= b.last && b.first <= a.last;
}

static enum reader_status check(struct reading *r)
{
    struct reader_template *t = r->t;
    if (!r->seen_columns || !r->seen_text)
        return wrong(r, "a template says its 'columns', and which of them are 'text'");
    for (int i = 1; i < t->texts_count; i++)
        if (t->text[i].first <= t->text[i - 1].last)
            return wrong(r,
                         "columns of text stand from the left to the right, none on another");
    if (t->notes_count && t->notes_count != t->texts_count)
        return wrong(r, "'notes' has a place for each column of text: %d (got %d)",
                     t->texts_count, t->notes_count);
    for (int i = 0; i < t->notes_count; i++)
        for (int k = 0; k < t->texts_count; k++)
            if (overlap(t->notes[i], t->text[k]) ||
                (k > i && overlap(t->notes[i], t->notes[k])))
                return wrong(r, "notes stand beside text and beside each other, not on them");
    for (int i = 0; i < READER_WIDES; i++)
        if (!r->seen_wide[i])
            t->wide[i] =
                (struct reader_place_span){t->text[0].first, t->text[t->texts_count - 1].last};
    return READER_OK;
}

/* The line's words; false: too many, or too long. */
static bool line_split(struct reading *r, const char *line, size_t bytes)
{
    r->count = 0;
    for (size_t at = 0; at < bytes;) {
        size_t begin = at;
        while (at < bytes && !strchr(" \t\r", line[at]) && line[at])
            at++;
        if (at > begin) {
            if (r->count == WORDS_MAX || at - begin >= READER_TEMPLATE_NAME_BYTES)
                return false;
            memcpy(r->words[r->count], line + begin, at - begin);
            r->words[r->count++][at - begin] = '\0';
        } else {
            at++;
        }
    }
    return true;
}

enum reader_status reader_template_parse(const char *text, size_t bytes, const char *where,
                                         struct reader_template *out)
{
    struct reader_template made = {
        .gutter_em = 1.5, .colours = {*reader_colours_of(false), *reader_colours_of(true)}};
    struct reading r = {.t = &made, .where = where};
    enum reader_status status = READER_OK;
    if (bytes > READER_TEMPLATE_BYTES_MAX)
        return reader_fail(READER_TOO_LARGE, "%s: a template has up to %d bytes", where,
                           READER_TEMPLATE_BYTES_MAX);
    for (size_t at = 0; at < bytes && status == READER_OK;) {
        const char *line = text + at, *end = memchr(line, '\n', bytes - at);
        const size_t length = end ? (size_t)(end - line) : bytes - at;
        r.line++;
        at += length + 1;
        if (length && line[strspn(line, " \t")] == '#')
            continue;
        if (!line_split(&r, line, length))
            status = wrong(&r,
                           "a line has up to %d words of up to %d bytes: a grid has 1..%d "
                           "columns",
                           WORDS_MAX, READER_TEMPLATE_NAME_BYTES - 1, READER_GRID_COLUMNS_MAX);
        else if (r.count)
            status = line_take(&r);
    }
    if (status == READER_OK)
        status = check(&r);
    if (status == READER_OK)
        *out = made;
    return status;
}

enum reader_status reader_template_open(const char *name, struct reader_template *out)
{
    const char *why;
    size_t bytes;
    for (int i = 0; i < BUILT_IN; i++)
        if (strcmp(name, built_in[i].name) == 0)
            return reader_template_named(name, out);
    char *text = input_file_read(name, READER_TEMPLATE_BYTES_MAX, &bytes, &why);
    if (!text)
        return reader_fail(errno == EFBIG ? READER_TOO_LARGE : READER_FAILED,
                           "%s: cannot read: %s (built in are %s, %s and %s)", name, why,
                           built_in[0].name, built_in[1].name, built_in[2].name);
    enum reader_status status = reader_template_parse(text, bytes, name, out);
    free(text);
    return status;
}

/* ---- writing ---- */

/* At most two digits behind a point, in any locale. */
static void number_put(FILE *out, double number)
{
    const long hundredths = lrint(100 * number);
    fprintf(out, "%ld", hundredths / 100);
    if (hundredths % 10)
        fprintf(out, ".%02ld", hundredths % 100);
    else if (hundredths % 100)
        fprintf(out, ".%ld", hundredths % 100 / 10);
}

static void spans_put(FILE *out, const char *word, const struct reader_place_span *spans,
                      int count)
{
    if (count)
        fputs(word, out);
    for (int i = 0; i < count; i++)
        if (spans[i].first == spans[i].last)
            fprintf(out, " %d", spans[i].first + 1);
        else
            fprintf(out, " %d-%d", spans[i].first + 1, spans[i].last + 1);
    if (count)
        fputc('\n', out);
}

static void columns_put(FILE *out, const struct reader_template *t)
{
    fputs("columns", out);
    for (int i = 0; i < t->columns_count; i++) {
        const struct reader_template_column *c = &t->columns[i];
        fputc(' ', out);
        number_put(out, c->share > 0 ? c->share : c->least_em);
        if (c->share > 0)
            fputc('*', out);
        else if (c->most_em > c->least_em) {
            fputs("..", out);
            number_put(out, c->most_em);
        }
    }
    fputs("\ngutter ", out);
    number_put(out, t->gutter_em);
    fputc('\n', out);
}

static void beside_put(FILE *out, const struct reader_beside *b)
{
    static const char *const sides[] = {"", "left", "right", "full"};
    if (b->side == READER_SIDE_USUAL)
        return;
    fprintf(out, "beside %s", sides[b->side]);
    if (b->percent)
        fprintf(out, " %d%%", b->percent);
    fprintf(out, "%s\n", b->round ? " round" : b->shape ? " shape" : "");
}

/* Those that are not as usual. */
static void colours_put(FILE *out, const struct reader_template *t)
{
    struct reader_template own = *t, usual = {.colours = {*reader_colours_of(false),
                                                          *reader_colours_of(true)}};
    for (int i = 0; i < READER_COLOURS; i++) {
        if (memcmp(colour_of(&own, 0, i), colour_of(&usual, 0, i), 3 * sizeof(double)) == 0 &&
            memcmp(colour_of(&own, 1, i), colour_of(&usual, 1, i), 3 * sizeof(double)) == 0)
            continue;
        fprintf(out, "colour %s", reader_colour_names[i]);
        for (int theme = 0; theme < 2; theme++) {
            char text[8];
            const double *c = colour_of(&own, theme, i);
            reader_colour_text(c, text);
            fprintf(out, " %s", text);
        }
        fputc('\n', out);
    }
}

char *reader_template_text(const struct reader_template *t)
{
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    if (!out)
        return NULL;
    if (*t->name)
        fprintf(out, "name %s\n", t->name);
    columns_put(out, t);
    spans_put(out, "text", t->text, t->texts_count);
    spans_put(out, "notes", t->notes, t->notes_count);
    for (int i = 0; i < READER_WIDES; i++)
        spans_put(out, wide_names[i], &t->wide[i], 1);
    beside_put(out, &t->beside);
    for (int i = 0; i < READER_SIZES; i++)
        if (t->sizes[i] > 0) {
            fprintf(out, "size %s ", reader_size_names[i]);
            number_put(out, t->sizes[i]);
            fputc('\n', out);
        }
    colours_put(out, t);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}
