/* studio_input.c - see studio_input.h. */
#include "studio_input.h"

#include "studio_settings.h"

#include <error_text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TIME_MOST 1e6
#define PLACE_MOST 1e6

static const struct word {
    const char *name;
    enum studio_input_kind kind;
    enum input_kind event;
    int button;
    int numbers_least, numbers_most;
    bool texts;  /* a text follows the numbers */
    bool eraser; /* a pen's other end */
    unsigned modifiers;
} words[] = {
    {"down", STUDIO_INPUT_EVENT, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, 2, 5, false, false, 0},
    {"move", STUDIO_INPUT_EVENT, INPUT_POINTER_MOVE, 0, 2, 5, false, false, 0},
    {"up", STUDIO_INPUT_EVENT, INPUT_POINTER_UP, INPUT_BUTTON_LEFT, 2, 5, false, false, 0},
    {"shift-down", STUDIO_INPUT_EVENT, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, 2, 5, false,
     false, INPUT_SHIFT},
    {"alt-down", STUDIO_INPUT_EVENT, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, 2, 5, false, false,
     INPUT_ALT},
    {"middle-down", STUDIO_INPUT_EVENT, INPUT_POINTER_DOWN, INPUT_BUTTON_MIDDLE, 2, 2, false,
     false, 0},
    {"middle-up", STUDIO_INPUT_EVENT, INPUT_POINTER_UP, INPUT_BUTTON_MIDDLE, 2, 2, false, false,
     0},
    {"eraser-down", STUDIO_INPUT_EVENT, INPUT_POINTER_DOWN, INPUT_BUTTON_LEFT, 2, 5, false,
     true, 0},
    {"eraser-move", STUDIO_INPUT_EVENT, INPUT_POINTER_MOVE, 0, 2, 5, false, true, 0},
    {"eraser-up", STUDIO_INPUT_EVENT, INPUT_POINTER_UP, INPUT_BUTTON_LEFT, 2, 5, false, true,
     0},
    {"leave", STUDIO_INPUT_EVENT, INPUT_POINTER_LEAVE, 0, 0, 0, false, false, 0},
    {"focus-lost", STUDIO_INPUT_EVENT, INPUT_FOCUS_LOST, 0, 0, 0, false, false, 0},
    {"set", STUDIO_INPUT_SET, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"action", STUDIO_INPUT_ACTION, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"step", STUDIO_INPUT_STEP, INPUT_NONE, 0, 1, 1, false, false, 0},
    {"moment", STUDIO_INPUT_MOMENT, INPUT_NONE, 0, 1, 1, false, false, 0},
    {"view", STUDIO_INPUT_VIEW, INPUT_NONE, 0, 5, 5, false, false, 0},
    {"type", STUDIO_INPUT_TYPE, INPUT_NONE, 0, 2, 2, true, false, 0},
    {"save", STUDIO_INPUT_SAVE, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"picture", STUDIO_INPUT_PICTURE, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"script", STUDIO_INPUT_SCRIPT, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"palette", STUDIO_INPUT_PALETTE, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"save-palette", STUDIO_INPUT_PALETTE_SAVE, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"film", STUDIO_INPUT_FILM, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"bookmark", STUDIO_INPUT_BOOKMARK, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"stamp", STUDIO_INPUT_STAMP, INPUT_NONE, 0, 0, 0, true, false, 0},
    {"measure", STUDIO_INPUT_MEASURE, INPUT_NONE, 0, 0, 0, true, false, 0},
};
/* What is an action of the window by its own name. */
static const char *const actions[] = {"undo", "redo", "dry", "seal", "close"};

static int wrong(char *why, size_t room, const char *what, const char *with)
{
    snprintf(why, room, "%s '%.60s'", what, with);
    return -1;
}

/* What is known in the place of a name that is not: `next` is called until it returns NULL. */
static int unknown(char *why, size_t room, const char *what, const char *with,
                   const char *(*next)(size_t i))
{
    wrong(why, room, what, with);
    for (size_t i = 0; next(i); i++)
        error_text_list(why, room, i == 0 ? "; there are " : ", ", next(i));
    return -1;
}

static const char *word_name(size_t i)
{
    const size_t count = sizeof words / sizeof *words;
    return i < count                                      ? words[i].name
           : i < count + sizeof actions / sizeof *actions ? actions[i - count]
                                                          : NULL;
}

static const char *setting_name(size_t i)
{
    return i < STUDIO_SETTINGS ? studio_controls[i].name : NULL;
}

static const char *blanks_skip(const char *text)
{
    return text + strspn(text, " \t");
}

/* A number, and what follows it; NULL: there is none. */
static const char *number_read(const char *text, double most, double *out)
{
    char *end;
    *out = strtod(text, &end);
    if (end == text || !(fabs(*out) <= most) || (*end && !strchr(" \t", *end)))
        return NULL;
    return blanks_skip(end);
}

static void text_read(const char *text, char *out, size_t room)
{
    size_t used = 0;
    for (; *text && used + 1 < room; text++) {
        if (text[0] == '\\' && text[1] == 'n') {
            out[used++] = '\n';
            text++;
        } else
            out[used++] = *text;
    }
    out[used] = '\0';
}

static void event_fill(struct input_event *e, const double *number, int count)
{
    e->x_px = number[0];
    e->y_px = number[1];
    e->pen = count > 2;
    e->pressure = count > 2 ? fmin(1, fmax(0, number[2])) : 0;
    e->tilt_x = count > 4 ? fmin(1, fmax(-1, number[3])) : 0;
    e->tilt_y = count > 4 ? fmin(1, fmax(-1, number[4])) : 0;
}

/* "NAME VALUE" of a setting. */
static int setting_read(struct studio_input *out, char *why, size_t room)
{
    const char *value = blanks_skip(out->text + strlen(out->name));
    for (int i = 0; i < STUDIO_SETTINGS; i++)
        if (strcmp(studio_controls[i].name, out->name) == 0) {
            out->setting = i;
            if (stage_control_parse(&studio_controls[i], value, &out->value) != STAGE_OK ||
                !(out->value >= studio_controls[i].least &&
                  out->value <= studio_controls[i].most))
                return wrong(why, room, "a value out of range:", out->text);
            return 1;
        }
    return unknown(why, room, "no setting", out->name, setting_name);
}

static int word_read(const struct word *word, const char *rest, struct studio_input *out,
                     char *why, size_t room)
{
    double number[5] = {0};
    int count = 0;
    for (const char *next;
         count < word->numbers_most && (next = number_read(rest, PLACE_MOST, &number[count]));
         count++)
        rest = next;
    if (count < word->numbers_least || (*rest && !word->texts) || (!*rest && word->texts))
        return wrong(why, room, "not what belongs after", word->name);
    out->kind = word->kind;
    out->event = (struct input_event){
        .kind = word->event, .time_s = out->time_s, .button = word->button};
    event_fill(&out->event, number, count);
    out->event.eraser = word->eraser;
    out->event.modifiers = word->modifiers;
    text_read(rest, out->text, sizeof out->text);
    const size_t length = strcspn(out->text, " \t");
    snprintf(out->name, sizeof out->name, "%.*s", (int)(length < 63 ? length : 63), out->text);
    out->x = number[word->kind == STUDIO_INPUT_VIEW ? 1 : 0];
    out->y = number[word->kind == STUDIO_INPUT_VIEW ? 2 : 1];
    out->zoom = number[0];
    out->degrees = number[3];
    out->mirrored = number[4] != 0;
    out->value = number[0];
    if (word->kind == STUDIO_INPUT_SET)
        return setting_read(out, why, room);
    if (word->kind == STUDIO_INPUT_ACTION) {
        const char *after = blanks_skip(out->text + strlen(out->name));
        memmove(out->text, after, strlen(after) + 1);
    }
    if (word->kind == STUDIO_INPUT_STEP && !(out->value >= 1 && out->value <= 100000))
        return wrong(why, room, "steps must be 1..100000, not", rest);
    if (word->kind == STUDIO_INPUT_MOMENT && !(out->value >= 0 && out->value <= 1e6))
        return wrong(why, room, "a moment is after 0..1000000 deeds, not", rest);
    if (word->kind == STUDIO_INPUT_VIEW && !(out->zoom > 0))
        return wrong(why, room, "a zoom must be above 0 in", word->name);
    return 1;
}

int studio_input_parse(const char *line, struct studio_input *out, char *why, size_t room)
{
    char name[24];
    *out = (struct studio_input){0};
    line = blanks_skip(line);
    if (!*line || *line == '#')
        return 0;
    line = number_read(line, TIME_MOST, &out->time_s);
    if (!line || out->time_s < 0)
        return wrong(why, room, "a line begins with its seconds", "");
    const size_t length = strcspn(line, " \t");
    snprintf(name, sizeof name, "%.*s", (int)(length < 23 ? length : 23), line);
    const char *rest = blanks_skip(line + length);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i].name, name) == 0)
            return word_read(&words[i], rest, out, why, room);
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++)
        if (strcmp(actions[i], name) == 0 && !*rest) {
            out->kind = STUDIO_INPUT_ACTION;
            snprintf(out->name, sizeof out->name, "%s", name);
            return 1;
        }
    return unknown(why, room, "no such word:", name, word_name);
}
