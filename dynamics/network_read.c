/* network_read.c - see network_file.h.
 *
 * A line is words between blanks. The first says what it is, and is looked up in a table; the function found reads the
 * others. */
#include "internal.h"
#include "network_file.h"

#include <errno.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { LINE_MAX_BYTES = 1000, FILE_MAX_BYTES = 2000000000 };

struct reader {
    const char *name;
    long line;
    char text[LINE_MAX_BYTES + 1]; /* the line's words; blanks become ends of strings */
    char *next;                    /* of the words that are not read yet */
    bool ended;
    struct dyn_network *n;
};

/* In the words of the failure before. */
static enum dyn_status wrong_as_said(const struct reader *r, enum dyn_status status)
{
    status = status == DYN_BAD_ARGUMENT ? DYN_BAD_FILE : status;
    return dyn_fail(status, "%.200s:%ld: %s", r->name, r->line, dyn_error());
}

#define wrong(r, ...)                                                                          \
    (dyn_fail(DYN_BAD_ARGUMENT, __VA_ARGS__), wrong_as_said((r), DYN_BAD_ARGUMENT))

/* NULL: no more. */
static char *word_next(struct reader *r)
{
    char *word = r->next + strspn(r->next, " \t");
    if (!*word)
        return NULL;
    r->next = word + strcspn(word, " \t");
    if (*r->next)
        *r->next++ = '\0';
    return word;
}

static enum dyn_status number_read(struct reader *r, const char *what, const char *word,
                                   double *value)
{
    char *end = NULL;
    if (!word)
        return wrong(r, "there is no %s", what);
    *value = strtod(word, &end);
    if (end == word || *end)
        return wrong(r, "%s: '%.40s' is no number", what, word);
    return DYN_OK;
}

static enum dyn_status index_read(struct reader *r, const char *what, const char *word,
                                  int *value)
{
    char *end = NULL;
    errno = 0;
    long number = word ? strtol(word, &end, 10) : 0;
    if (!word)
        return wrong(r, "there is no %s", what);
    if (end == word || *end || errno || number < 0 || number >= DYN_MASSES_MAX)
        return wrong(r, "%s: '%.40s' is no mass's number", what, word);
    *value = (int)number;
    return DYN_OK;
}

/* name=value. *seen: bits of those of the fields that the line has had. */
static enum dyn_status field_read(struct reader *r, const struct dyn_control *fields,
                                  const struct dyn_control *(*find)(const char *), char *word,
                                  void *of, unsigned *seen)
{
    double value = 0;
    char *equals = strchr(word, '=');
    if (!equals)
        return wrong(r, "'%.40s' is no name=value", word);
    *equals = '\0';
    const struct dyn_control *field = find(word);
    if (!field)
        return wrong_as_said(r, DYN_BAD_ARGUMENT);
    if (*seen >> (field - fields) & 1)
        return wrong(r, "%s twice", field->name);
    *seen |= 1u << (field - fields);
    enum dyn_status status = number_read(r, field->name, equals + 1, &value);
    if (status == DYN_OK && dyn_control_write(field, of, value) != DYN_OK)
        status = wrong_as_said(r, DYN_BAD_ARGUMENT);
    return status;
}

/* ---- lines ---- */

static enum dyn_status time_read(struct reader *r)
{
    double time = 0;
    enum dyn_status status = number_read(r, "time", word_next(r), &time);
    if (status != DYN_OK)
        return status;
    if (!(time >= -DYN_TIME_MAX && time <= DYN_TIME_MAX))
        return wrong(r, "time_s must be %g..%g (got %g)", -DYN_TIME_MAX, DYN_TIME_MAX, time);
    dyn_network_time_set(r->n, time);
    return DYN_OK;
}

static enum dyn_status control_read(struct reader *r)
{
    const char *name = word_next(r), *text = word_next(r);
    struct dyn_world world = *dyn_network_world(r->n);
    double value = 0;
    if (!name || !text)
        return wrong(r, "a control has a name and a value");
    const struct dyn_control *control = dyn_control_find(name);
    if (!control || dyn_control_parse(control, text, &value) != DYN_OK ||
        dyn_control_write(control, &world, value) != DYN_OK ||
        dyn_network_world_set(r->n, &world) != DYN_OK)
        return wrong_as_said(r, DYN_BAD_ARGUMENT);
    return DYN_OK;
}

static enum dyn_status mass_read(struct reader *r)
{
    struct dyn_mass mass = dyn_mass_usual();
    unsigned seen = 0;
    for (char *word; (word = word_next(r));) {
        enum dyn_status status = DYN_OK;
        if (strcmp(word, "stuck") == 0)
            mass.hold |= DYN_STUCK;
        else if (strcmp(word, "held") == 0)
            mass.hold |= DYN_HELD;
        else
            status = field_read(r, dyn_mass_fields, dyn_mass_field_find, word, &mass, &seen);
        if (status != DYN_OK)
            return status;
    }
    enum dyn_status status = dyn_mass_add(r->n, &mass, NULL);
    return status == DYN_OK ? DYN_OK : wrong_as_said(r, status);
}

static enum dyn_status spring_read(struct reader *r)
{
    struct dyn_spring spring = dyn_spring_usual();
    unsigned seen = 0;
    enum dyn_status status = DYN_OK;
    for (int i = 0; i < 2 && status == DYN_OK; i++)
        status = index_read(r, i ? "second end" : "first end", word_next(r), &spring.end[i]);
    for (char *word; status == DYN_OK && (word = word_next(r));)
        if (strcmp(word, "broken") == 0)
            spring.broken = true;
        else
            status =
                field_read(r, dyn_spring_fields, dyn_spring_field_find, word, &spring, &seen);
    if (status != DYN_OK)
        return status;
    status = dyn_spring_add(r->n, &spring, NULL);
    return status == DYN_OK ? DYN_OK : wrong_as_said(r, status);
}

static enum dyn_status pull_read(struct reader *r)
{
    static const char *const names[] = {"x", "y", "constant", "damping"};
    double values[4] = {0};
    int mass = 0;
    enum dyn_status status = index_read(r, "mass", word_next(r), &mass);
    for (int i = 0; i < 4 && status == DYN_OK; i++)
        status = number_read(r, names[i], word_next(r), &values[i]);
    if (status != DYN_OK)
        return status;
    if (dyn_control_check(dyn_spring_field_find("damping"), values[3]) != DYN_OK)
        return wrong_as_said(r, DYN_BAD_ARGUMENT);
    status = dyn_pull_begin(r->n, mass, values[0], values[1], values[2]);
    if (status != DYN_OK)
        return wrong_as_said(r, status);
    dyn_pull_of(r->n, mass)->damping = values[3];
    return DYN_OK;
}

static enum dyn_status end_read(struct reader *r)
{
    r->ended = true;
    return DYN_OK;
}

static const struct {
    const char *word;
    enum dyn_status (*read)(struct reader *r);
} lines[] = {
    {"time_s", time_read},   {"control", control_read}, {"mass", mass_read},
    {"spring", spring_read}, {"pull", pull_read},       {"end", end_read},
};

static enum dyn_status line_read(struct reader *r)
{
    r->next = r->text;
    const char *first = word_next(r);
    if (!first || *first == '#')
        return DYN_OK;
    if (r->ended)
        return wrong(r, "after 'end' there can be nothing more");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (strcmp(first, lines[i].word) == 0) {
            enum dyn_status status = lines[i].read(r);
            const char *more = status == DYN_OK ? word_next(r) : NULL;
            return more ? wrong(r, "'%.40s' is one word too many", more) : status;
        }
    return wrong(r,
                 "a line begins with time_s, control, mass, spring, pull or end (got '%.40s')",
                 first);
}

/* Copies a line, without what ends it, into r->text. Returns where the next one begins; NULL: it is no line of text. */
static const char *line_take(struct reader *r, const char *text, const char *end)
{
    const char *newline = memchr(text, '\n', (size_t)(end - text));
    size_t length = (size_t)((newline ? newline : end) - text);
    r->line++;
    if (length > LINE_MAX_BYTES) {
        wrong(r, "a line has at most %d bytes", LINE_MAX_BYTES);
        return NULL;
    }
    memcpy(r->text, text, length);
    length -= length > 0 && r->text[length - 1] == '\r';
    r->text[length] = '\0';
    for (size_t i = 0; i < length; i++) {
        unsigned char byte = (unsigned char)r->text[i];
        if ((byte < ' ' && byte != '\t') || byte == 127) {
            wrong(r, "a byte of value %d is no text", byte);
            return NULL;
        }
    }
    return newline ? newline + 1 : end;
}

static enum dyn_status lines_read(struct reader *r, const char *text, const char *end)
{
    const char *next = line_take(r, text, end);
    if (next && strcmp(r->text, "springs 1") != 0)
        return wrong(r, "no network: its first line must be 'springs 1'");
    enum dyn_status status = next ? DYN_OK : DYN_BAD_FILE;
    while (status == DYN_OK && next < end) {
        next = line_take(r, next, end);
        status = next ? line_read(r) : DYN_BAD_FILE;
    }
    if (status == DYN_OK && !r->ended)
        return wrong(r, "the file is cut short: there is no 'end'");
    return status;
}

enum dyn_status dyn_network_parse(const char *text, size_t bytes, const char *name,
                                  struct dyn_network **out)
{
    struct reader r = {.name = name};
    *out = NULL;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!plain)
        return dyn_fail(DYN_NO_MEMORY, "no memory for a locale");
    enum dyn_status status = dyn_network_create(&r.n);
    if (status == DYN_OK) {
        locale_t before = uselocale(plain);
        status = lines_read(&r, text, text + bytes);
        uselocale(before);
    }
    freelocale(plain);
    if (status == DYN_OK)
        *out = r.n;
    else
        dyn_network_destroy(r.n);
    return status;
}

enum dyn_status dyn_network_read(const char *path, struct dyn_network **out)
{
    *out = NULL;
    struct stat about;
    FILE *file = fopen(path, "rb");
    if (!file)
        return dyn_fail(DYN_BAD_FILE, "%.200s: cannot be read: %s", path, strerror(errno));
    char *text = NULL;
    enum dyn_status status = DYN_OK;
    if (fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode))
        status = dyn_fail(DYN_BAD_FILE, "%.200s: is no file", path);
    else if (about.st_size > FILE_MAX_BYTES)
        status = dyn_fail(DYN_TOO_LARGE, "%.200s: a network has at most %d bytes", path,
                          FILE_MAX_BYTES);
    else if (!(text = malloc((size_t)about.st_size + 1)))
        status = dyn_fail(DYN_NO_MEMORY, "%.200s: no memory for it", path);
    if (status == DYN_OK) {
        size_t bytes = fread(text, 1, (size_t)about.st_size, file);
        status = ferror(file) ? dyn_fail(DYN_BAD_FILE, "%.200s: cannot be read: %s", path,
                                         strerror(errno))
                              : dyn_network_parse(text, bytes, path, out);
    }
    free(text);
    fclose(file);
    return status;
}
