/* knobs_file.c - see knobs_file.h. */
#include "knobs_file.h"

#include <array.h>
#include <input_file.h>
#include <output_file.h>

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_BYTES = 400, WORDS_MAX = 7, FILE_BYTES_MAX = 1 << 20 };
static const double fade_most_s = 600;

/* has_channel, has_number: which words stand behind the kind; number_most: the largest
 * number. */
static const struct {
    const char *name, *words;
    bool has_channel, has_number;
    int number_most;
} kinds[KNOB_KINDS] = {[KNOB_CONTROL] = {"control", "controller", true, true, 127},
                       [KNOB_FINE] = {"fine", "fine controller", true, true, 31},
                       [KNOB_NRPN] = {"nrpn", "NRPN", true, true, 16383},
                       [KNOB_BEND] = {"bend", "bend", true, false, 0},
                       [KNOB_PRESSURE] = {"pressure", "aftertouch", true, false, 0},
                       [KNOB_NOTE] = {"note", "key", true, true, 127},
                       [KNOB_CLOCK] = {"clock", "beat", false, false, 0},
                       [KNOB_TEMPO] = {"tempo", "tempo", false, false, 0}};

void knob_words(const struct knob *knob, char *text, size_t room)
{
    char number[16] = "", channel[16] = "";
    if (kinds[knob->kind].has_number)
        snprintf(number, sizeof number, " %d", knob->number);
    if (knob->channel >= 0)
        snprintf(channel, sizeof channel, ", ch %d", knob->channel + 1);
    snprintf(text, room, "%s%s%s", kinds[knob->kind].words, number, channel);
}

void knobs_text_finish(struct knobs_text *text)
{
    if (text)
        free(text->sets);
    if (text)
        *text = (struct knobs_text){0};
}

enum stage_status knobs_set_add(struct knobs_text *text, const struct knobs_set *set)
{
    if (text->sets_count == KNOBS_SETS_MAX)
        return stage_fail(STAGE_BAD_ARGUMENT, "all scenes together set at most %d controls",
                          KNOBS_SETS_MAX);
    if (!array_reserve(&text->sets, &text->sets_capacity, text->sets_count + 1,
                       sizeof *text->sets))
        return stage_fail(STAGE_NO_MEMORY, "no memory for scenes");
    text->sets[text->sets_count++] = *set;
    return STAGE_OK;
}

/* ---- reading ---- */

struct line {
    char text[LINE_BYTES];
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

static bool integer_read(const char *word, int least, int most, int *out)
{
    char *end;
    errno = 0;
    const long value = strtol(word, &end, 10);
    if (end == word || *end || errno || value < least || value > most)
        return false;
    *out = (int)value;
    return true;
}

static bool number_read(const char *word, double most, double *out)
{
    char *end;
    *out = strtod(word, &end);
    return end != word && !*end && *out >= 0 && *out <= most;
}

/* Letters, digits and _ : what controls are called. */
static bool name_read(const char *word, char out[KNOBS_NAME_BYTES])
{
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "0123456789_-";
    const size_t length = strlen(word);
    if (length >= KNOBS_NAME_BYTES || strspn(word, allowed) != length)
        return false;
    memcpy(out, word, length + 1);
    return true;
}

static int kind_find(const char *name)
{
    for (int i = 0; i < KNOB_KINDS; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return i;
    return -1;
}

/* NULL: it is fine; else what the line must be. So for all of these. */
static const char *knob_read(struct line *line, struct knobs_text *out)
{
    static const char must[] =
        "`knob KIND [CHANNEL] [NUMBER] CONTROL FROM TO`, KIND control, fine, nrpn, bend, "
        "pressure, note, clock or tempo, CHANNEL 1 to 16 or *, FROM and TO 0 to 1";
    struct knobs_row row = {.knob.channel = -1};
    const int kind = line->count > 1 ? kind_find(line->words[1]) : -1;
    int at = 2;
    if (out->rows_count == KNOBS_MAX)
        return "one of 128 knobs at most";
    if (kind < 0 || line->count != 5 + kinds[kind].has_channel + kinds[kind].has_number)
        return must;
    row.knob.kind = (enum knob_kind)kind;
    if (kinds[kind].has_channel) {
        const char *word = line->words[at++];
        int channel = 0;
        if (strcmp(word, "*") != 0 && !integer_read(word, 1, 16, &channel))
            return must;
        row.knob.channel = channel - 1;
    }
    if (kinds[kind].has_number &&
        !integer_read(line->words[at++], 0, kinds[kind].number_most, &row.knob.number))
        return must;
    if (!name_read(line->words[at], row.control) ||
        !number_read(line->words[at + 1], 1, &row.from) ||
        !number_read(line->words[at + 2], 1, &row.to))
        return must;
    out->rows[out->rows_count++] = row;
    return NULL;
}

static const char *scene_read(struct line *line, struct knobs_text *out)
{
    struct knobs_set set = {0};
    if (line->count != 4 || !integer_read(line->words[1], 1, KNOBS_SCENES, &set.scene) ||
        !name_read(line->words[2], set.control) || strlen(line->words[3]) >= sizeof set.value)
        return "`scene NUMBER CONTROL VALUE`, NUMBER 1 to 128";
    memcpy(set.value, line->words[3], strlen(line->words[3]) + 1);
    return knobs_set_add(out, &set) == STAGE_OK ? NULL : "one of 4096 lines of scenes at most";
}

static const char *fade_read(struct line *line, struct knobs_text *out)
{
    int scene;
    double seconds;
    if (line->count != 3 || !integer_read(line->words[1], 1, KNOBS_SCENES, &scene) ||
        !number_read(line->words[2], fade_most_s, &seconds))
        return "`fade NUMBER SECONDS`, NUMBER 1 to 128, SECONDS at most 600";
    out->fade_s[scene] = seconds;
    return NULL;
}

static const char *theme_read(struct line *line, struct knobs_text *out)
{
    if (line->count != 2 || strlen(line->words[1]) >= sizeof out->theme)
        return "`theme NAME`, a name or a file without blanks";
    memcpy(out->theme, line->words[1], strlen(line->words[1]) + 1);
    return NULL;
}

static const struct {
    const char *name;
    const char *(*read)(struct line *line, struct knobs_text *out);
} line_kinds[] = {
    {"knob", knob_read}, {"scene", scene_read}, {"fade", fade_read}, {"theme", theme_read}};

static const char *line_read(struct line *line, struct knobs_text *out)
{
    for (size_t i = 0; i < sizeof line_kinds / sizeof *line_kinds; i++)
        if (strcmp(line->words[0], line_kinds[i].name) == 0)
            return line_kinds[i].read(line, out);
    return "knob, scene, fade, theme or end, and what belongs to it";
}

/* Copies a line. Returns where the next one begins; NULL: it is no text, or too long. */
static const char *line_take(struct line *line, const char *text, const char *end)
{
    const char *stop = memchr(text, '\n', (size_t)(end - text));
    const size_t length = (size_t)((stop ? stop : end) - text);
    if (length >= sizeof line->text)
        return NULL;
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)text[i] < ' ' && text[i] != '\t' && text[i] != '\r')
            return NULL;
    memcpy(line->text, text, length);
    line->text[length] = '\0';
    line_split(line);
    return stop ? stop + 1 : end;
}

enum stage_status knobs_text_read(const char *text, size_t bytes, const char *name,
                                  struct knobs_text *out)
{
    const char *end = text + bytes, *must = NULL;
    bool begun = false, ended = false;
    int number = 0;
    *out = (struct knobs_text){0};
    while (text < end && !ended && !must) {
        struct line line;
        text = line_take(&line, text, end);
        number++;
        if (!text)
            return stage_fail(STAGE_BAD_FILE, "%s:%d: must be a line of text, not so long",
                              name, number);
        if (line.count == 0 || line.words[0][0] == '#')
            continue;
        if (!begun) {
            begun = line.count == 2 && !strcmp(line.words[0], "knobs") &&
                    !strcmp(line.words[1], "1");
            must = begun ? NULL : "`knobs 1`: is this a file of knobs?";
            continue;
        }
        ended = line.count == 1 && strcmp(line.words[0], "end") == 0;
        must = ended ? NULL : line_read(&line, out);
    }
    if (must)
        return stage_fail(STAGE_BAD_FILE, "%s:%d: must be %s", name, number, must);
    return ended ? STAGE_OK
                 : stage_fail(STAGE_BAD_FILE, "%s: is cut short: there is no `end`", name);
}

enum stage_status knobs_file_read(const char *path, struct knobs_text *out)
{
    const char *why;
    size_t count;
    char *text = input_file_read(path, FILE_BYTES_MAX, &count, &why);
    *out = (struct knobs_text){0};
    if (!text)
        return stage_fail(errno == ENOMEM ? STAGE_NO_MEMORY : STAGE_BAD_FILE,
                          "%s: cannot be read: %s", path, why);
    const enum stage_status status = knobs_text_read(text, count, path, out);
    free(text);
    return status;
}

/* ---- writing ---- */

static void row_print(const struct knobs_row *row, FILE *to)
{
    fprintf(to, "knob %s", kinds[row->knob.kind].name);
    if (kinds[row->knob.kind].has_channel && row->knob.channel < 0)
        fputs(" *", to);
    else if (kinds[row->knob.kind].has_channel)
        fprintf(to, " %d", row->knob.channel + 1);
    if (kinds[row->knob.kind].has_number)
        fprintf(to, " %d", row->knob.number);
    fprintf(to, " %s %.9g %.9g\n", row->control, row->from, row->to);
}

enum stage_status knobs_file_write(const struct knobs_text *text, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    fputs("knobs 1\n", out.stream);
    if (text->theme[0])
        fprintf(out.stream, "theme %s\n", text->theme);
    for (int i = 0; i < text->rows_count; i++)
        row_print(&text->rows[i], out.stream);
    for (int i = 1; i <= KNOBS_SCENES; i++)
        if (text->fade_s[i] > 0)
            fprintf(out.stream, "fade %d %.9g\n", i, text->fade_s[i]);
    for (int i = 0; i < text->sets_count; i++)
        fprintf(out.stream, "scene %d %s %s\n", text->sets[i].scene, text->sets[i].control,
                text->sets[i].value);
    fputs("end\n", out.stream);
    if (!output_file_commit(&out))
        return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", path, out.why);
    return STAGE_OK;
}
