/* edits_open.c - fonts by the name of a folder of edits: see edits.h. */
#include "edits_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static _Thread_local struct error_text changed, changed_said;

const char *font_edits_said(void)
{
    if (!changed.text[0])
        return NULL;
    error_text_fail(&changed_said, 0, "%s", changed.text);
    changed.text[0] = '\0';
    return changed_said.text;
}

bool font_edits_is(const char *name)
{
    struct stat about;
    if (!name || stat(name, &about) != 0 || !S_ISDIR(about.st_mode))
        return false;
    char *path = edits_path(name, "edits.txt");
    bool is = path && stat(path, &about) == 0 && S_ISREG(about.st_mode);
    free(path);
    return is;
}

const char *font_edits_folder(const char *name)
{
    const char *plus = name && !font_edits_is(name) ? strrchr(name, '+') : NULL;
    if (!plus)
        return name && font_edits_is(name) ? name : NULL;
    return plus > name && font_edits_is(plus + 1) ? plus + 1 : NULL;
}

/* The font's file in the folder or beside it, else a font of the system's that is called so. */
static enum font_status font_open(const struct font_edits *list, int index, bool coloured,
                                  struct font_face **out)
{
    enum font_status (*opened)(const char *, int, struct font_face **) =
        coloured ? font_face_open_coloured : font_face_open;
    const char *const beside[] = {"", "/.."};
    char path[4096], name[sizeof list->font];
    for (int i = 0; i < 2; i++) {
        struct stat about;
        int n = snprintf(path, sizeof path, "%s%s/%s", list->folder, beside[i], list->font);
        if (n > 0 && n < (int)sizeof path && lstat(path, &about) == 0 && S_ISREG(about.st_mode))
            return opened(path, index, out);
    }
    snprintf(name, sizeof name, "%s", list->font);
    char *dot = strrchr(name, '.');
    if (dot && dot != name)
        *dot = '\0';
    enum font_status status = opened(name, index, out);
    return status == FONT_OK
               ? status
               : font_fail(status, "%s/edits.txt: %.300s", list->folder, font_error());
}

/* The font of its own that the name has before the folder's. */
static enum font_status named_open(const char *name, const char *folder, int index,
                                   bool coloured, struct font_face **out)
{
    char *font = strndup(name, (size_t)(folder - 1 - name));
    if (!font)
        return font_fail(FONT_NO_MEMORY, "no memory for edits");
    enum font_status status =
        coloured ? font_face_open_coloured(font, index, out) : font_face_open(font, index, out);
    free(font);
    return status;
}

enum font_status font_edits_open(const char *name, int index, bool coloured,
                                 struct font_face **out)
{
    struct font_edits *list = NULL, *edits = NULL;
    const char *folder = font_edits_folder(name);
    *out = NULL;
    if (!folder)
        return coloured ? font_face_open_coloured(name, index, out)
                        : font_face_open(name, index, out);
    enum font_status status = edits_list_read(folder, &list);
    if (status == FONT_OK && folder != name)
        status = named_open(name, folder, index ? index : list->face, coloured, out);
    else if (status == FONT_OK)
        status = font_open(list, index ? index : list->face, coloured, out);
    if (status == FONT_OK)
        status = font_edits_read(folder, *out, &edits);
    if (status == FONT_OK)
        status = font_edits_apply(edits, *out);
    if (status == FONT_OK && edits->changed.text[0])
        changed = edits->changed;
    font_edits_destroy(list);
    font_edits_destroy(edits);
    if (status != FONT_OK) {
        font_face_close(*out);
        *out = NULL;
    }
    return status;
}
