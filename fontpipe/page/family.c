/* family.c - see family.h. */
#include "family.h"

#include "../internal.h"

#include <edits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The face's other file, where it lies beside it under such a name: one family may have several
 * sizes of each. */
static bool file_beside(const char *path, const char *kind, char *room, size_t bytes)
{
    static const char *const plain[] = {"Regular", "Roman", "Book"};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        const char *at = strstr(path, plain[i]);
        struct stat about;
        int n = at ? snprintf(room, bytes, "%.*s%s%s", (int)(at - path), path, kind,
                              at + strlen(plain[i]))
                   : -1;
        if (n > 0 && (size_t)n < bytes && stat(room, &about) == 0 && S_ISREG(about.st_mode))
            return true;
    }
    return false;
}

const char *page_family_face(const char *font, const char *kind, char *room, size_t bytes)
{
    struct font_face *face;
    struct font_face_info info;
    if (font_edits_open(font, 0, false, &face) != FONT_OK)
        return font;
    font_face_describe(face, &info);
    bool found = file_beside(info.path, kind, room, bytes);
    if (!found) {
        bool bold = strncmp(kind, "Bold", 4) == 0;
        const char *style = strcmp(kind, "BoldItalic") == 0 ? "bold:italic"
                            : bold                          ? "bold"
                                                            : "italic:weight=80";
        int n = snprintf(room, bytes, "%s:%s", info.family, style);
        char *path = n > 0 && (size_t)n < bytes ? font_face_find(room, NULL) : NULL;
        found = path != NULL;
        free(path);
    }
    font_face_close(face);
    return found ? room : font;
}
