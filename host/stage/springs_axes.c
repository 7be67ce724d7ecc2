/* springs_axes.c - the axes of a variable font as controls: letters are drawn as the axes are,
 * in the boxes that they have. */
#include "springs_internal.h"

#include <stdio.h>
#include <string.h>

static double axis_read(void *actor, int index)
{
    const struct springs *s = actor;
    return s->set.axes[index];
}

static enum stage_status axis_write(void *actor, int index, double value)
{
    struct springs *s = actor;
    if (font_face_axis_set(s->face, s->axes[index], value) != FONT_OK)
        return stage_fail(STAGE_FAILED, "%s", font_error());
    s->set.axes[index] = value;
    return STAGE_OK;
}

void springs_axes_set(struct springs *s)
{
    for (int i = 0; i < s->axes_count; i++)
        (void)font_face_axis_set(s->face, s->axes[i],
                                 s->set.axes[i]); /* it was set so before */
}

/* What people call an axis; else its tag, which has to be a name: letters and digits. NULL: it
 * is none. */
static const char *name_of(const char *tag)
{
    static const char *const names[][2] = {{"wght", "weight"},
                                           {"wdth", "width"},
                                           {"slnt", "slant"},
                                           {"ital", "italic"},
                                           {"opsz", "optical_size"}};
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i][0], tag) == 0)
            return names[i][1];
    return tag[0] && tag[strspn(tag, allowed)] == '\0' ? tag : NULL;
}

int springs_axes_find(struct springs *s, struct stage_control rows[SPRINGS_AXES_MAX])
{
    struct font_face_info info = {0};
    struct font_axis axis;
    if (s->face)
        font_face_describe(s->face, &info);
    for (int i = 0; i < info.axes_count && s->axes_count < SPRINGS_AXES_MAX; i++) {
        const int at = s->axes_count;
        if (font_face_axis(s->face, i, &axis) != FONT_OK || !(axis.most > axis.least))
            continue;
        snprintf(s->axes[at], sizeof s->axes[at], "%.4s", axis.tag);
        const char *name = name_of(s->axes[at]);
        if (!name)
            continue;
        s->set.axes[at] = axis.value;
        rows[at] = (struct stage_control){.name = name,
                                          .unit = "",
                                          .least = axis.least,
                                          .most = axis.most,
                                          .usual = axis.usual,
                                          .curve = STAGE_LINEAR,
                                          .does = "of the font's letters: one of its axes",
                                          .read = axis_read,
                                          .write = axis_write,
                                          .index = at};
        s->axes_count++;
    }
    return s->axes_count;
}
