/* face_find.c - a font's file by its name: see face.h. */
#include "face.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include <fontconfig/fontconfig.h>

/* Of files of one name OpenType comes first, then Type 1, then what is left: bitmaps,
 * compressed ones. */
static int ending_rank(const char *path)
{
    static const char *const endings[] = {".otf", ".ttf", ".otc", ".ttc",
                                          ".t1",  ".pfb", ".pfa"};
    enum { COUNT = sizeof endings / sizeof *endings, OPENTYPE = 4 };
    const char *ending = strrchr(path, '.');
    for (int i = 0; ending && i < COUNT; i++)
        if (strcasecmp(ending, endings[i]) == 0)
            return i < OPENTYPE ? 0 : 1;
    return 2;
}

static bool comes_first(const char *path, const char *other)
{
    int rank = ending_rank(path), others = ending_rank(other);
    return rank != others ? rank < others : strcmp(path, other) < 0;
}

/* fontconfig's pattern of a family's name, or NULL. "FAMILY-12" is a family at a size there,
 * and fontconfig leaves out what is no size after a dash: here such a dash is part of the
 * family's name. */
static FcPattern *family_parse(const char *name)
{
    const char *end = name + strcspn(name, ":");
    char *escaped = malloc(2 * strlen(name) + 1), *to = escaped;
    if (!escaped)
        return NULL;
    for (const char *at = name; *at; *to++ = *at++) {
        const bool is_dash = *at == '-' && at < end && (at == name || at[-1] != '\\');
        const size_t size = is_dash ? strspn(at + 1, "0123456789.,") : 0;
        if (is_dash && (size == 0 || at + 1 + size < end))
            *to++ = '\\';
    }
    *to = '\0';
    FcPattern *pattern = FcNameParse((const FcChar8 *)escaped);
    free(escaped);
    return pattern;
}

/* A file called so, or a family that fontconfig has: the path, or NULL. */
static char *by_fontconfig(const char *name, int *index)
{
    char *path = NULL;
    FcPattern *pattern = NULL, *match = NULL;
    FcFontSet *all = NULL;
    FcObjectSet *objects = NULL;
    FcResult result;
    if (!FcInit())
        return NULL;
    /* By the file's name, so that a file is always found by it. Of several the first in
     * order. */
    objects = FcObjectSetBuild(FC_FILE, (char *)NULL);
    pattern = FcPatternCreate();
    all = objects && pattern ? FcFontList(NULL, pattern, objects) : NULL;
    size_t length = strlen(name);
    for (int i = 0; all && i < all->nfont; i++) {
        FcChar8 *file;
        if (FcPatternGetString(all->fonts[i], FC_FILE, 0, &file) != FcResultMatch)
            continue;
        const char *base = strrchr((char *)file, '/');
        base = base ? base + 1 : (char *)file;
        if (strncasecmp(base, name, length) != 0 || (base[length] && base[length] != '.'))
            continue;
        if (!path || comes_first((char *)file, path)) {
            free(path);
            path = strdup((char *)file);
        }
    }
    if (pattern)
        FcPatternDestroy(pattern);
    pattern = NULL;
    const bool of_file = ending_rank(name) < 2;
    if (!path && !of_file && (pattern = family_parse(name))) {
        FcChar8 *wanted, *got, *file;
        FcPattern *asked = FcPatternDuplicate(pattern);
        FcConfigSubstitute(NULL, pattern, FcMatchPattern);
        FcDefaultSubstitute(pattern);
        match = FcFontMatch(NULL, pattern, &result);
        /* fontconfig always has an answer: it must be of the family asked for. */
        bool same = false;
        for (int i = 0; match && asked &&
                        FcPatternGetString(asked, FC_FAMILY, 0, &wanted) == FcResultMatch &&
                        FcPatternGetString(match, FC_FAMILY, i, &got) == FcResultMatch;
             i++)
            same = same || FcStrCmpIgnoreCase(wanted, got) == 0;
        if (same && FcPatternGetString(match, FC_FILE, 0, &file) == FcResultMatch) {
            path = strdup((char *)file);
            int found = 0;
            if (*index == 0 && FcPatternGetInteger(match, FC_INDEX, 0, &found) == FcResultMatch)
                *index = found & 0xffff;
        }
        if (asked)
            FcPatternDestroy(asked);
    }
    if (match)
        FcPatternDestroy(match);
    if (pattern)
        FcPatternDestroy(pattern);
    if (all)
        FcFontSetDestroy(all);
    if (objects)
        FcObjectSetDestroy(objects);
    return path;
}

char *font_face_find(const char *name, int *index)
{
    struct stat about;
    int own = 0;
    if (!name || !*name)
        return NULL;
    if (strchr(name, '/') || (stat(name, &about) == 0 && S_ISREG(about.st_mode)))
        return strdup(name);
    return by_fontconfig(name, index ? index : &own);
}

const char *font_face_first(const char *const *names)
{
    for (int i = 0; names[i]; i++) {
        char *path = font_face_find(names[i], NULL);
        bool found = path != NULL;
        free(path);
        if (found)
            return names[i];
    }
    return names[0];
}
