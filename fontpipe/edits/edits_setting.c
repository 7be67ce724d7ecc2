/* edits_setting.c - settings of axes as words of edits.txt: see edits_internal.h. */
#include "edits_internal.h"

#include <stdlib.h>
#include <string.h>

enum font_status edits_setting_of(const struct font_face *face, char **out)
{
    char text[EDITS_SETTING_BYTES] = "@";
    *out = NULL;
    font_face_axes_text(face, text + 1);
    if (text[strcspn(text, " \t\r\n")])
        return font_fail(FONT_BAD_ARGUMENT, "axes with a blank in their tags have no edits");
    *out = strdup(text);
    return *out ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for edits");
}

enum font_status edits_setting_set(struct font_face *face, const char *setting)
{
    enum font_status status = setting ? font_face_axes_reset(face) : FONT_OK;
    return status == FONT_OK && setting ? font_face_axes_set(face, setting + 1) : status;
}

bool edits_setting_same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}
