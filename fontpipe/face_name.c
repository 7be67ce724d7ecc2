/* face_name.c - a glyph by whatever it is called: see font_face_glyph_named() in face.h. */
#include "face_internal.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* A number to the end of the text. */
static bool number_is(const char *text, int base, unsigned long most, uint32_t *value)
{
    const char *digits = base == 16 ? "0123456789abcdefABCDEF" : "0123456789";
    size_t length = strspn(text, digits);
    if (length == 0 || length > 8 || text[length])
        return false;
    unsigned long number = strtoul(text, NULL, base);
    *value = (uint32_t)number;
    return number <= most;
}

/* One character alone, or like U+0041. */
static bool character_is(const char *text, uint32_t *character)
{
    const char *at = text, *end = text + strlen(text);
    if ((text[0] == 'U' || text[0] == 'u') && text[1] == '+')
        return number_is(text + 2, 16, 0x10ffff, character);
    return at < end && font_utf8_next(&at, end, character) && at == end;
}

/* 0: there is none, or it is glyph 0. */
static bool name_is(const struct font_face *face, const char *text, uint32_t *glyph)
{
    char name[FONT_GLYPH_NAME_BYTES];
    if (!FT_HAS_GLYPH_NAMES(face->ft) || strlen(text) >= sizeof name)
        return false;
    *glyph = FT_Get_Name_Index(face->ft, text);
    return *glyph ||
           (!FT_Get_Glyph_Name(face->ft, 0, name, sizeof name) && strcmp(name, text) == 0);
}

enum font_status font_face_glyph_named(const struct font_face *face, const char *text,
                                       uint32_t *glyph)
{
    uint32_t character;
    if (character_is(text, &character)) {
        *glyph = font_face_glyph(face, character);
        return *glyph ? FONT_OK
                      : font_fail(FONT_NO_GLYPH, "the font has no glyph for U+%04X",
                                  (unsigned)character);
    }
    if (text[0] == '#' && number_is(text + 1, 10, 0xffffffff, glyph))
        return *glyph < (uint32_t)face->ft->num_glyphs
                   ? FONT_OK
                   : font_fail(FONT_NO_GLYPH, "the font has glyphs #0 to #%ld, and no %.40s",
                               face->ft->num_glyphs - 1, text);
    if (name_is(face, text, glyph))
        return FONT_OK;
    return font_fail(FONT_BAD_ARGUMENT,
                     "the font has no glyph '%.60s': a character, U+0041, #214 or a name like "
                     "f_f_i is one%s",
                     text, FT_HAS_GLYPH_NAMES(face->ft) ? "" : " (its glyphs have no names)");
}
