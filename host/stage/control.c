/* control.c - see control.h. */
#include "control.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct stage_control *stage_control_find(const struct stage_control *rows, int count,
                                               const char *name)
{
    char known[400] = "";
    for (int i = 0; i < count; i++) {
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", rows[i].name);
    }
    stage_fail(STAGE_BAD_ARGUMENT, "there is no control '%.60s'; there are %s", name, known);
    return NULL;
}

double stage_control_read(const struct stage_control *row, void *actor)
{
    return row->read(actor, row->index);
}

enum stage_status stage_control_write(const struct stage_control *row, void *actor,
                                      double value)
{
    bool whole = row->curve == STAGE_SWITCH || row->curve == STAGE_CHOICE;
    if (!(value >= row->least && value <= row->most) || (whole && value != floor(value)))
        return stage_fail(STAGE_BAD_ARGUMENT, "%s must be %s%g..%g%s%s (got %g)", row->name,
                          whole ? "a whole number of " : "", row->least, row->most,
                          row->unit[0] ? " " : "", row->unit, value);
    return row->write(actor, row->index, value);
}

/* The choice of that number, and its length. NULL: none. */
static const char *choice_at(const char *choices, int number, size_t *length)
{
    while (choices && *choices) {
        *length = strcspn(choices, " ");
        if (number-- == 0)
            return choices;
        choices += *length;
        choices += strspn(choices, " ");
    }
    return NULL;
}

enum stage_status stage_control_parse(const struct stage_control *row, const char *text,
                                      double *value)
{
    char *end;
    size_t length;
    if (row->curve == STAGE_SWITCH && (!strcmp(text, "on") || !strcmp(text, "off"))) {
        *value = text[1] == 'n';
        return STAGE_OK;
    }
    for (int i = 0; row->curve == STAGE_CHOICE; i++) {
        const char *choice = choice_at(row->choices, i, &length);
        if (!choice)
            return stage_fail(STAGE_BAD_ARGUMENT, "%s must be one of %s (got '%.40s')",
                              row->name, row->choices, text);
        if (strlen(text) == length && strncmp(choice, text, length) == 0) {
            *value = i;
            return STAGE_OK;
        }
    }
    *value = strtod(text, &end);
    if (end == text || *end || !isfinite(*value))
        return stage_fail(STAGE_BAD_ARGUMENT, "%s must be %s (got '%.40s')", row->name,
                          row->curve == STAGE_SWITCH ? "on or off" : "a number", text);
    return STAGE_OK;
}

void stage_control_text(const struct stage_control *row, double value, char *text, size_t room)
{
    size_t length = 0;
    const char *choice =
        row->curve == STAGE_CHOICE ? choice_at(row->choices, (int)value, &length) : NULL;
    if (row->curve == STAGE_SWITCH)
        snprintf(text, room, "%s", value != 0 ? "on" : "off");
    else if (choice)
        snprintf(text, room, "%.*s", (int)length, choice);
    else
        snprintf(text, room, "%.4g", value);
}

/* ---- along a slider ---- */

/* For ranges that begin at 0 or below: where the logarithmic part begins, and the part of
 * the slider before it. */
static const double linear_part = 0.01, linear_share = 0.2;

double stage_control_along(const struct stage_control *row, double value)
{
    value = fmin(row->most, fmax(row->least, value));
    if (row->curve != STAGE_LOGARITHMIC)
        return (value - row->least) / (row->most - row->least);
    if (row->least > 0)
        return log(value / row->least) / log(row->most / row->least);
    double from = row->most * linear_part;
    if (value <= from)
        return linear_share * (value - row->least) / (from - row->least);
    return linear_share + (1 - linear_share) * log(value / from) / log(row->most / from);
}

double stage_control_at(const struct stage_control *row, double along)
{
    double value;
    along = fmin(1, fmax(0, along));
    if (row->curve != STAGE_LOGARITHMIC)
        value = row->least + along * (row->most - row->least);
    else if (row->least > 0)
        value = row->least * pow(row->most / row->least, along);
    else if (along <= linear_share)
        value = row->least + along / linear_share * (row->most * linear_part - row->least);
    else
        value = row->most * linear_part *
                pow(1 / linear_part, (along - linear_share) / (1 - linear_share));
    if (row->curve == STAGE_SWITCH || row->curve == STAGE_CHOICE)
        value = floor(value + 0.5);
    return fmin(row->most, fmax(row->least, value));
}
