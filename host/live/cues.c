/* cues.c - see cues.h. */
#include "cues.h"

#include "cues_file.h"

#include <control_table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A control on its way; length_s 0: none. */
struct fade {
    const char *name; /* a cue's */
    double from, to;  /* along its slider */
    double begin_s, length_s, value;
};

struct cues {
    struct cues_def def;
    struct cues_text text;
    struct fade *fades; /* as many as there are cues */
    int next, fades_count, gone;
    double last_s; /* when the cue before was due */
};

static const struct control *row_of(const struct cues *c, const char *name)
{
    int count;
    const struct control *rows = stage_controls(c->def.stage, &count);
    return stage_control_find(rows, count, name);
}

/* ---- a list ---- */

/* Whether all of it can be done on this stage, as it is now. */
static enum stage_status cue_check(const struct cues *c, const struct cue *cue)
{
    const char *path = c->def.path;
    if (cue->when == CUE_GO && c->def.is_film)
        return stage_fail(STAGE_BAD_FILE,
                          "%.200s:%d: a film waits for nobody: give seconds in place of go",
                          path, cue->line);
    if (cue->what == CUE_SCENE && !c->def.scene)
        return stage_fail(STAGE_BAD_FILE,
                          "%.200s:%d: there are no scenes: --knobs FILE has them", path,
                          cue->line);
    double value;
    const struct control *row = cue->what == CUE_SET ? row_of(c, cue->name) : NULL;
    if (cue->what == CUE_SCENE ||
        (cue->what == CUE_TEXT && stage_text_check(c->def.stage, cue->text) == STAGE_OK) ||
        (row && stage_control_parse(row, cue->text, &value) == STAGE_OK &&
         stage_control_check(row, value) == STAGE_OK))
        return STAGE_OK;
    return stage_fail(STAGE_BAD_FILE, "%.200s:%d: %.800s", path, cue->line, stage_error());
}

enum stage_status cues_open(const struct cues_def *def, struct cues **out)
{
    struct cues *c = calloc(1, sizeof *c);
    *out = NULL;
    if (!c)
        return stage_fail(STAGE_NO_MEMORY, "no memory for cues");
    c->def = *def;
    enum stage_status status = cues_file_read(def->path, &c->text);
    for (int i = 0; i < c->text.count && status == STAGE_OK; i++)
        status = cue_check(c, &c->text.cues[i]);
    if (status == STAGE_OK && !(c->fades = calloc((size_t)c->text.count, sizeof *c->fades)))
        status = stage_fail(STAGE_NO_MEMORY, "no memory for cues");
    if (status == STAGE_OK)
        *out = c;
    else
        cues_close(c);
    return status;
}

void cues_close(struct cues *c)
{
    if (!c)
        return;
    cues_text_finish(&c->text);
    free(c->fades);
    free(c);
}

void cues_go(struct cues *c)
{
    for (int i = c->next, waiting = 0; i < c->text.count; i++)
        if (c->text.cues[i].when == CUE_GO && ++waiting > c->gone) {
            c->gone++;
            return;
        }
}

/* ---- what is due ---- */

static void told(const struct cues *c, const struct cue *cue, const char *why)
{
    char line[400];
    snprintf(line, sizeof line, "cue of line %d: %.300s", cue->line, why);
    if (c->def.tell)
        c->def.tell(c->def.context, line);
}

/* The fade of a control's before, if it is on its way, is given up. */
static struct fade *fade_of(struct cues *c, const char *name)
{
    for (int i = 0; i < c->fades_count; i++)
        if (strcmp(c->fades[i].name, name) == 0)
            return &c->fades[i];
    return &c->fades[c->fades_count++];
}

static const char *control_set(struct cues *c, const struct cue *cue, double due_s)
{
    double value;
    const struct control *row = row_of(c, cue->name);
    if (!row || stage_control_parse(row, cue->text, &value) != STAGE_OK)
        return stage_error();
    struct fade *fade = fade_of(c, cue->name);
    *fade = (struct fade){.name = cue->name};
    const bool steps = row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE;
    if (cue->fade_s <= 0 || steps)
        return stage_control_write(row, c->def.stage, value) == STAGE_OK ? NULL : stage_error();
    fade->from = control_along(row, control_read(row, c->def.stage));
    fade->to = control_along(row, value);
    fade->begin_s = due_s;
    fade->length_s = cue->fade_s;
    fade->value = value;
    return NULL;
}

static void cue_do(struct cues *c, const struct cue *cue, double due_s)
{
    const char *why = NULL;
    if (cue->what == CUE_TEXT)
        why = stage_text(c->def.stage, cue->text) == STAGE_OK ? NULL : stage_error();
    else if (cue->what == CUE_SCENE)
        why = c->def.scene(c->def.context, cue->scene);
    else
        why = control_set(c, cue, due_s);
    if (why)
        told(c, cue, why);
}

static void fade_frame(struct cues *c, struct fade *fade, double now_s)
{
    const struct control *row = fade->length_s > 0 ? row_of(c, fade->name) : NULL;
    if (!row)
        return;
    const double part = fmax(0, (now_s - fade->begin_s) / fade->length_s);
    const double along = fade->from + part * (fade->to - fade->from);
    stage_control_write(row, c->def.stage, part < 1 ? control_at(row, along) : fade->value);
    if (part >= 1)
        fade->length_s = 0;
}

void cues_frame(struct cues *c, double now_s)
{
    while (c->next < c->text.count) {
        const struct cue *cue = &c->text.cues[c->next];
        double due_s = cue->when == CUE_AFTER ? c->last_s + cue->time_s : cue->time_s;
        if (cue->when == CUE_GO)
            due_s = c->gone > 0 ? now_s : INFINITY;
        if (due_s > now_s + 1e-9)
            break;
        c->gone -= cue->when == CUE_GO;
        c->last_s = due_s;
        c->next++;
        cue_do(c, cue, due_s);
    }
    for (int i = 0; i < c->fades_count; i++)
        fade_frame(c, &c->fades[i], now_s);
}
