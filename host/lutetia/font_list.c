/* font_list.c - what `lutetia font` prints of a font: its axes and named places on them,
 * scripts and features. */
#include "font_verb.h"

#include <visible_text.h>

#include <stdio.h>
#include <string.h>

enum { TAGS_MOST = 512, ROW = 96 };

/* Words behind a heading, in lines. */
static void words_print(const char *heading, char (*words)[5], int count)
{
    int at = printf("%s:", heading);
    for (int i = 0; i < count; i++) {
        if (at + 5 > ROW)
            at = printf("\n   ") - 1;
        visible_print(" %.4s", words[i]);
        at += 5;
    }
    printf(count ? "\n" : " none\n");
}

static void axes_print(struct font_face *face)
{
    struct font_face_info info;
    struct font_axis axis;
    struct font_instance named;
    font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count && font_face_axis(face, i, &axis) == FONT_OK; i++)
        visible_print("axis %s (%s): %g..%g, usually %g, now %g\n", axis.tag, axis.name,
                      axis.least, axis.most, axis.usual, axis.value);
    for (int n = 0; n < font_face_instances_count(face); n++) {
        if (font_face_instance(face, n, &named) != FONT_OK)
            continue;
        visible_print("instance %s:", named.name[0] ? named.name : "without a name");
        for (int i = 0; i < info.axes_count && font_face_axis(face, i, &axis) == FONT_OK; i++)
            visible_print("%s%s=%g", i ? "," : " ", axis.tag, named.values[i]);
        printf("\n");
    }
}

void font_list_print(struct font_face *face)
{
    static char tags[TAGS_MOST][5];
    char name[128];
    axes_print(face);
    int count = font_face_tags(face, false, tags, TAGS_MOST);
    words_print("scripts", tags, count);
    count = font_face_tags(face, true, tags, TAGS_MOST);
    words_print("features", tags, count);
    for (int i = 0; i < count; i++) /* ss01, cv01: what the font calls them */
        if (font_face_feature_name(face, tags[i], name, sizeof name))
            visible_print("feature %s: %s\n", tags[i], name);
}
