/* font_axes.c - see font_axes.h. */
#include "font_axes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLUMNS = 1 + STAGE_LEADS_MAX };

/* Of an axis's way to either end. Both ways together have fewer settings than a face remembers
 * versions of (face.h), so letters that come back to one are found as they were drawn. */
static const double steps = 31;

/* What people call an axis; else its tag, which has to be a name: letters and digits. NULL: it
 * is none. */
static const char *name_of(const char *tag, const char *taken)
{
    static const char *const names[][2] = {{"wght", "weight"},
                                           {"wdth", "width"},
                                           {"slnt", "slant"},
                                           {"ital", "italic"},
                                           {"opsz", "optical_size"}};
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i][0], tag) == 0 && (!taken || strcmp(names[i][1], taken) != 0))
            return names[i][1];
    return tag[0] && tag[strspn(tag, allowed)] == '\0' ? tag : NULL;
}

static void axis_add(struct stage_axes *a, struct stage_axes_set *set,
                     const struct font_axis *axis, const char *name)
{
    const int i = a->count++;
    memcpy(a->tags[i], axis->tag, sizeof a->tags[i]);
    a->least[i] = axis->least;
    a->most[i] = axis->most;
    a->usual[i] = axis->usual;
    set->values[i][0] = axis->value;
    snprintf(a->names[i][0], STAGE_AXIS_NAME_BYTES, "%s", name);
    for (int lead = 0; lead < a->leads_count; lead++)
        snprintf(a->names[i][1 + lead], STAGE_AXIS_NAME_BYTES, "%s_%s", name,
                 a->leads[lead].name);
}

void stage_axes_find(struct stage_axes *a, struct stage_axes_set *set, struct font_face *face,
                     const struct stage_lead *leads, int leads_count, const char *taken)
{
    struct font_face_info info = {0};
    struct font_axis axis;
    *a = (struct stage_axes){.face = face, .leads = leads, .leads_count = leads_count};
    *set = (struct stage_axes_set){0};
    if (face)
        font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count && a->count < STAGE_AXES_MAX; i++) {
        if (font_face_axis(face, i, &axis) != FONT_OK || !(axis.most > axis.least))
            continue;
        const char *name = name_of(axis.tag, taken);
        if (name)
            axis_add(a, set, &axis, name);
    }
}

int stage_axes_rows(const struct stage_axes *a, struct control *rows,
                    double (*read)(void *actor, int index),
                    unsigned (*write)(void *actor, int index, double value))
{
    int count = 0;
    for (int i = 0; i < a->count; i++) {
        rows[count++] = (struct control){.name = a->names[i][0],
                                         .unit = "",
                                         .least = a->least[i],
                                         .most = a->most[i],
                                         .usual = a->usual[i],
                                         .curve = CONTROL_LINEAR,
                                         .does = "of the font's letters: one of its axes",
                                         .read = read,
                                         .write = write,
                                         .at = i * COLUMNS};
        for (int lead = 0; lead < a->leads_count; lead++)
            rows[count++] = (struct control){.name = a->names[i][1 + lead],
                                             .unit = "",
                                             .least = -1,
                                             .most = 1,
                                             .usual = 0,
                                             .curve = CONTROL_LINEAR,
                                             .does = a->leads[lead].does,
                                             .read = read,
                                             .write = write,
                                             .at = i * COLUMNS + 1 + lead};
    }
    return count;
}

double *stage_axes_setting(struct stage_axes_set *set, int index)
{
    return &set->values[index / COLUMNS][index % COLUMNS];
}

static bool is_led(const struct stage_axes *a, const struct stage_axes_set *set, int axis)
{
    bool led = false;
    for (int lead = 0; lead < a->leads_count; lead++)
        led |= set->values[axis][1 + lead] != 0;
    return led;
}

bool stage_axes_led(const struct stage_axes *a, const struct stage_axes_set *set)
{
    bool led = false;
    for (int i = 0; i < a->count; i++)
        led |= is_led(a, set, i);
    return led;
}

static enum stage_status lead_write(const struct stage_axes *a, struct stage_axes_set *set,
                                    int index, double value)
{
    double *setting = stage_axes_setting(set, index);
    const double before = *setting;
    int led = 0;
    *setting = value;
    for (int i = 0; i < a->count; i++)
        led += is_led(a, set, i);
    if (led <= STAGE_LETTER_AXES_MAX)
        return STAGE_OK;
    *setting = before;
    return stage_fail(STAGE_BAD_ARGUMENT,
                      "%d of a font's axes are led already, which is the most: set what leads "
                      "one of them to 0",
                      STAGE_LETTER_AXES_MAX);
}

enum stage_status stage_axes_write(const struct stage_axes *a, struct stage_axes_set *set,
                                   int index, double value)
{
    if (index % COLUMNS)
        return lead_write(a, set, index, value);
    if (font_face_axis_set(a->face, a->tags[index / COLUMNS], value) != FONT_OK)
        return stage_fail(STAGE_FAILED, "%s", font_error());
    *stage_axes_setting(set, index) = value;
    return STAGE_OK;
}

void stage_axes_put(const struct stage_axes *a, const struct stage_axes_set *set)
{
    for (int i = 0; i < a->count; i++)
        (void)font_face_axis_set(a->face, a->tags[i],
                                 set->values[i][0]); /* it was set so before */
}

void stage_axes_of(const struct stage_axes *a, const struct stage_axes_set *set,
                   const double *parts, struct stage_letter_axes *out)
{
    *out = (struct stage_letter_axes){0};
    for (int i = 0; i < a->count && out->count < STAGE_LETTER_AXES_MAX; i++) {
        const double is = set->values[i][0];
        double along = 0;
        for (int lead = 0; lead < a->leads_count; lead++)
            along += set->values[i][1 + lead] * parts[lead];
        along = round(steps * fmax(-1, fmin(1, along))) / steps;
        const double to = is + along * (along > 0 ? a->most[i] - is : is - a->least[i]);
        if (!(fabs(to - is) > 0))
            continue;
        struct stage_letter_axis *axis = &out->axes[out->count++];
        memcpy(axis->tag, a->tags[i], sizeof axis->tag);
        axis->value = to;
    }
}

static double value_of(const struct font_face *face, const char *tag)
{
    struct font_axis axis;
    for (int i = 0; font_face_axis(face, i, &axis) == FONT_OK; i++)
        if (strcmp(axis.tag, tag) == 0)
            return axis.value;
    return 0;
}

bool stage_letter_axes_same(const struct stage_letter_axes *a,
                            const struct stage_letter_axes *b)
{
    bool same = a->count == b->count;
    for (int i = 0; same && i < a->count; i++)
        same = strcmp(a->axes[i].tag, b->axes[i].tag) == 0 &&
               !(fabs(a->axes[i].value - b->axes[i].value) > 0);
    return same;
}

void stage_letter_axes_put(struct font_face *face, const struct stage_letter_axes *axes,
                           struct stage_letter_axes *before)
{
    struct stage_letter_axes was = *axes;
    for (int i = 0; i < axes->count; i++) {
        was.axes[i].value = value_of(face, axes->axes[i].tag);
        (void)font_face_axis_set(face, axes->axes[i].tag,
                                 axes->axes[i].value); /* within the axis's range */
    }
    if (before)
        *before = was;
}
