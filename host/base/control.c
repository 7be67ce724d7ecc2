/* control.c - see control.h. */
#include "control.h"
#include "word_list.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct control *control_find(const struct control *rows, int count, const char *name,
                                   char *names, size_t room)
{
    *names = '\0';
    for (int i = 0; i < count; i++) {
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
        error_text_list(names, room, ", ", rows[i].name);
    }
    return NULL;
}

static bool is_whole(const struct control *row)
{
    return row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE;
}

bool control_check(const struct control *row, double value, struct error_text *why)
{
    const bool whole = is_whole(row);
    if (value >= row->least && value <= row->most && (!whole || value == floor(value)))
        return true;
    return error_text_false(why, "%s must be %s%g..%g%s%s (got %g)", row->name,
                            whole ? "a whole number of " : "", row->least, row->most,
                            row->unit[0] ? " " : "", row->unit, value);
}

double control_read(const struct control *row, const void *of)
{
    double value;
    if (row->read)
        return row->read((void *)(uintptr_t)of, row->at);
    memcpy(&value, (const char *)of + row->at, sizeof value);
    return value;
}

unsigned control_put(const struct control *row, void *of, double value)
{
    if (row->write)
        return row->write(of, row->at, value);
    memcpy((char *)of + row->at, &value, sizeof value);
    return 0;
}

bool control_parse(const struct control *row, const char *text, double *value,
                   struct error_text *why)
{
    const bool choice = row->curve == CONTROL_CHOICE;
    const char *words = row->curve == CONTROL_SWITCH ? "off on" : choice ? row->choices : NULL;
    const int chosen = words ? word_list_find(words, text) : -1;
    char *end;
    const double number = chosen >= 0 ? chosen : strtod(text, &end);
    if (chosen < 0 && (end == text || *end || !isfinite(number)))
        return error_text_false(why, "%s must be %s%s (got '%.40s')", row->name,
                                choice  ? "one of "
                                : words ? "on or off"
                                        : "a number",
                                choice ? words : "", text);
    if (!control_check(row, number, why))
        return false;
    *value = number;
    return true;
}

void control_text(const struct control *row, double value, char *text, size_t room)
{
    size_t length = 0;
    const char *choice = row->curve == CONTROL_CHOICE && value >= 0
                             ? word_list_at(row->choices, (int)value, &length)
                             : NULL;
    if (row->curve == CONTROL_SWITCH)
        snprintf(text, room, "%s", value != 0 ? "on" : "off");
    else if (length > 0)
        snprintf(text, room, "%.*s", (int)length, choice);
    else
        snprintf(text, room, "%.4g", value);
}

void control_number(const struct control *row, double value, char *text, size_t room)
{
    enum { DECIMALS_MOST = 9, NUMBER_BYTES = 400 }; /* those of the largest double */
    const double near = 5e-5 * fmin(row->most - row->least, fabs(value));
    char number[NUMBER_BYTES] = "";
    for (int decimals = 0; decimals <= DECIMALS_MOST; decimals++) {
        snprintf(number, sizeof number, "%.*f", decimals, value);
        if (fabs(strtod(number, NULL) - value) <= near)
            break;
    }
    const bool zero = strtod(number, NULL) == 0;
    snprintf(text, room, "%s", zero ? "0" : number);
}

/* ---- along a slider ----
 *
 *     0    linear_share          1/2                    1        along
 *     |---------|-----------------|---------------------|
 *   least     bottom            middle                 most      value
 *      (0 or below)
 *
 * Each half is bent: it begins at the middle with half of its mean slope, and ends with one and
 * a half times that. */

static const double linear_share = 0.05, bottom_part = 1e-3, middle_part = 1e-2;

/* 0..1 to 0..1, and back. */
static double bend(double part)
{
    return (part + part * part) / 2;
}

static double unbend(double bent)
{
    return (sqrt(1 + 8 * bent) - 1) / 2;
}

/* What the middle of the slider is. */
static double middle_of(const struct control *row)
{
    if (row->usual > row->least && row->usual < row->most &&
        (row->usual > 0 || row->curve == CONTROL_CENTRED))
        return row->usual;
    if (row->curve == CONTROL_CENTRED)
        return (row->least + row->most) / 2;
    return row->least > 0 ? sqrt(row->least * row->most) : row->most * middle_part;
}

static double centred_along(const struct control *row, double value)
{
    const double middle = middle_of(row);
    return value >= middle ? 0.5 + unbend((value - middle) / (row->most - middle)) / 2
                           : 0.5 - unbend((middle - value) / (middle - row->least)) / 2;
}

static double centred_at(const struct control *row, double along)
{
    const double middle = middle_of(row);
    return along >= 0.5 ? middle + bend(2 * along - 1) * (row->most - middle)
                        : middle - bend(1 - 2 * along) * (middle - row->least);
}

static double logarithmic_along(const struct control *row, double value)
{
    const double middle = middle_of(row);
    const double bottom = row->least > 0 ? row->least : middle * bottom_part;
    const double share = row->least > 0 ? 0 : linear_share;
    if (value >= middle)
        return 0.5 + unbend(log(value / middle) / log(row->most / middle)) / 2;
    if (value < bottom)
        return share * (value - row->least) / (bottom - row->least);
    return 0.5 - (0.5 - share) * unbend(log(value / middle) / log(bottom / middle));
}

static double logarithmic_at(const struct control *row, double along)
{
    const double middle = middle_of(row);
    const double bottom = row->least > 0 ? row->least : middle * bottom_part;
    const double share = row->least > 0 ? 0 : linear_share;
    if (along >= 0.5)
        return middle * pow(row->most / middle, bend(2 * along - 1));
    if (along < share)
        return row->least + along / share * (bottom - row->least);
    return middle * pow(bottom / middle, bend((0.5 - along) / (0.5 - share)));
}

double control_along(const struct control *row, double value)
{
    value = fmin(row->most, fmax(row->least, value));
    if (row->curve == CONTROL_LOGARITHMIC)
        return logarithmic_along(row, value);
    if (row->curve == CONTROL_CENTRED)
        return centred_along(row, value);
    return (value - row->least) / (row->most - row->least);
}

double control_at(const struct control *row, double along)
{
    along = fmin(1, fmax(0, along));
    double value = row->least + along * (row->most - row->least);
    if (row->curve == CONTROL_LOGARITHMIC)
        value = logarithmic_at(row, along);
    if (row->curve == CONTROL_CENTRED)
        value = centred_at(row, along);
    if (row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE)
        value = floor(value + 0.5);
    return fmin(row->most, fmax(row->least, value));
}
