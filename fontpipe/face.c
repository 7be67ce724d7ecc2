/* face.c - see face.h. Files are read whole: FreeType and HarfBuzz look at the same bytes. */
#include "face_internal.h"

#include <input_file.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_FONT_FORMATS_H
#include FT_TRUETYPE_TABLES_H

#include <fontconfig/fcfreetype.h> /* after both */

enum { FILE_BYTES_MAX = 1 << 29 };

static enum font_status axes_read(struct font_face *face)
{
    if (!FT_HAS_MULTIPLE_MASTERS(face->ft) || FT_Get_MM_Var(face->ft, &face->axes))
        return FONT_OK; /* no axes, or none that can be read: the font as it is */
    face->axes_count =
        face->axes->num_axis > FACE_AXES_MAX ? FACE_AXES_MAX : (int)face->axes->num_axis;
    for (int i = 0; i < face->axes_count; i++)
        face->values[i] = face->axes->axis[i].def;
    return FONT_OK;
}

struct FT_FaceRec_ *font_face_freetype(struct font_face *face)
{
    return face->ft;
}

/* Of pictures in colours alone. FreeType leaves such a face's em out. */
static bool has_pictures(FT_Face ft)
{
    const TT_Header *head = FT_Get_Sfnt_Table(ft, FT_SFNT_HEAD);
    if (!FT_HAS_COLOR(ft) || ft->num_fixed_sizes < 1 || !head)
        return false;
    ft->units_per_EM = head->Units_Per_EM;
    return true;
}

/* Takes path and bytes. */
static enum font_status face_begin(char *path, unsigned char *bytes, size_t count, int index,
                                   bool pictures, struct font_face **out)
{
    struct font_face *face = calloc(1, sizeof *face);
    *out = NULL;
    if (!face || !path || !bytes) {
        free(face);
        free(path);
        free(bytes);
        return font_fail(FONT_NO_MEMORY, "no memory for a font");
    }
    face->path = path;
    face->bytes = bytes;
    face->bytes_count = count;
    font_face_version_renew(face);
    enum font_status status = FONT_OK;
    FT_Error error = FT_Init_FreeType(&face->library);
    if (!error && index >= 0)
        error = FT_New_Memory_Face(face->library, bytes, (FT_Long)count, index, &face->ft);
    if (index < 0 || FT_ERROR_BASE(error) == FT_Err_Invalid_Argument) {
        status = font_fail(FONT_BAD_ARGUMENT, "%s has no face %d", path, index);
    } else if (error) {
        status = font_face_fail(face, "not a font that can be read", error);
    } else if (!(FT_IS_SCALABLE(face->ft) || (pictures && has_pictures(face->ft))) ||
               face->ft->units_per_EM == 0) {
        status = font_fail(FONT_BAD_FILE, "%s has no outlines, only bitmaps", path);
    } else {
        status = axes_read(face);
    }
    if (status != FONT_OK)
        font_face_close(face);
    else
        *out = face;
    return status;
}

static enum font_status memory_open(const void *bytes, size_t count, int index, bool pictures,
                                    struct font_face **out)
{
    *out = NULL;
    if (!bytes || count == 0 || count > FILE_BYTES_MAX)
        return font_fail(FONT_BAD_FILE, "a font of %zu bytes cannot be", count);
    unsigned char *copy = malloc(count);
    if (copy)
        memcpy(copy, bytes, count);
    return face_begin(strdup("font in memory"), copy, count, index, pictures, out);
}

enum font_status font_face_open_memory(const void *bytes, size_t count, int index,
                                       struct font_face **out)
{
    return memory_open(bytes, count, index, false, out);
}

enum font_status font_face_open_memory_coloured(const void *bytes, size_t count, int index,
                                                struct font_face **out)
{
    return memory_open(bytes, count, index, true, out);
}

/* ---- opening ---- */

static enum font_status file_read(const char *path, unsigned char **bytes, size_t *count)
{
    const char *why;
    *bytes = (unsigned char *)input_file_read(path, FILE_BYTES_MAX, count, &why);
    if (*bytes && *count > 0)
        return FONT_OK;
    const int error = *bytes ? EFBIG : errno;
    free(*bytes);
    *bytes = NULL;
    return error == EFBIG    ? font_fail(FONT_BAD_FILE, "%s is no font file", path)
           : error == ENOMEM ? font_fail(FONT_NO_MEMORY, "no memory for %s", path)
                             : font_fail(FONT_BAD_FILE, "%s: %s", path, why);
}

static enum font_status face_open(const char *name, int index, bool pictures,
                                  struct font_face **out)
{
    *out = NULL;
    if (!name || !*name)
        return font_fail(FONT_BAD_ARGUMENT, "a font needs a name");
    char *path = font_face_find(name, &index);
    if (!path)
        return font_fail(FONT_BAD_FILE,
                         "there is no font '%.80s'; give a file, or a name that fc-list shows",
                         name);
    unsigned char *bytes;
    size_t count = 0;
    enum font_status status = file_read(path, &bytes, &count);
    if (status != FONT_OK) {
        free(path);
        return status;
    }
    return face_begin(path, bytes, count, index, pictures, out);
}

enum font_status font_face_open(const char *name, int index, struct font_face **out)
{
    return face_open(name, index, false, out);
}

enum font_status font_face_open_coloured(const char *name, int index, struct font_face **out)
{
    return face_open(name, index, true, out);
}

void font_face_close(struct font_face *face)
{
    if (!face)
        return;
    font_face_harfbuzz_finish(face);
    if (face->axes)
        FT_Done_MM_Var(face->library, face->axes);
    if (face->ft)
        FT_Done_Face(face->ft);
    if (face->library)
        FT_Done_FreeType(face->library);
    font_face_replaced_finish(face);
    font_own_finish(face);
    free(face->own_settings);
    free(face->settings);
    free(face->bytes);
    free(face->path);
    free(face);
}

/* ---- what there is ---- */

void font_face_describe(const struct font_face *face, struct font_face_info *out)
{
    FT_Face ft = face->ft;
    const char *format = FT_Get_Font_Format(ft);
    *out = (struct font_face_info){
        .family = ft->family_name ? ft->family_name : "",
        .style = ft->style_name ? ft->style_name : "",
        .format = format ? format : "",
        .path = face->path,
        .glyphs_count = (int)ft->num_glyphs,
        .faces_count = (int)ft->num_faces,
        .index = (int)(ft->face_index & 0xffff),
        .axes_count = face->axes_count,
        .units_per_em = ft->units_per_EM,
        .ascender = ft->ascender,
        .descender = ft->descender,
        .line_height = ft->height,
        .underline_y = ft->underline_position,
        .underline_height = ft->underline_thickness,
    };
    /* Damaged files say anything; a line is then an em and a bit. */
    if (!(out->line_height > 0))
        out->line_height = 1.2 * out->units_per_em;
    if (!(out->ascender > out->descender)) {
        out->ascender = 0.8 * out->units_per_em;
        out->descender = -0.2 * out->units_per_em;
    }
}

struct font_manner font_face_manner(const struct font_face *face)
{
    struct font_manner manner = {FC_WEIGHT_REGULAR, FC_SLANT_ROMAN, FC_WIDTH_NORMAL};
    FcPattern *pattern =
        FcInit() ? FcFreeTypeQueryFace(face->ft, (const FcChar8 *)face->path, 0, NULL) : NULL;
    if (pattern) {
        FcPatternGetDouble(pattern, FC_WEIGHT, 0, &manner.weight);
        FcPatternGetInteger(pattern, FC_SLANT, 0, &manner.slant);
        FcPatternGetInteger(pattern, FC_WIDTH, 0, &manner.width);
        FcPatternDestroy(pattern);
    }
    struct font_axis axis;
    for (int i = 0; i < face->axes_count && font_face_axis(face, i, &axis) == FONT_OK; i++) {
        if (strcmp(axis.tag, "wght") == 0)
            manner.weight = FcWeightFromOpenTypeDouble(axis.value);
        else if (strcmp(axis.tag, "wdth") == 0)
            manner.width = (int)lrint(axis.value); /* both in percent */
        else if ((strcmp(axis.tag, "slnt") == 0 && axis.value != 0) ||
                 (strcmp(axis.tag, "ital") == 0 && axis.value > 0.5))
            manner.slant = FC_SLANT_OBLIQUE;
    }
    return manner;
}

uint32_t font_face_glyph(const struct font_face *face, uint32_t character)
{
    return FT_Get_Char_Index(face->ft, character);
}

const char *font_face_glyph_name(const struct font_face *face, uint32_t glyph,
                                 char room[FONT_GLYPH_NAME_BYTES])
{
    bool plain = FT_HAS_GLYPH_NAMES(face->ft) &&
                 !FT_Get_Glyph_Name(face->ft, glyph, room, FONT_GLYPH_NAME_BYTES) && room[0];
    for (const char *c = room; plain && *c; c++)
        plain = *c > ' ' && *c < 0x7f;
    /* A name of one letter is read as that character, and U+ and # have their own meaning. */
    if (plain && !room[1])
        plain = font_face_glyph(face, (unsigned char)room[0]) == glyph;
    else if (plain)
        plain = room[0] != '#' && room[1] != '+' && FT_Get_Name_Index(face->ft, room) == glyph;
    if (!plain)
        snprintf(room, FONT_GLYPH_NAME_BYTES, "#%u", (unsigned)glyph);
    return room;
}

/* ---- measures ---- */

double font_face_kerning(struct font_face *face, uint32_t left, uint32_t right)
{
    FT_Vector kerning = {0, 0};
    if (!FT_HAS_KERNING(face->ft) ||
        FT_Get_Kerning(face->ft, left, right, FT_KERNING_UNSCALED, &kerning))
        return 0;
    return (double)kerning.x;
}

/* ---- axes ---- */

enum font_status font_face_axis(const struct font_face *face, int axis, struct font_axis *out)
{
    if (axis < 0 || axis >= face->axes_count)
        return font_fail(FONT_BAD_ARGUMENT, "%s has no axis %d", face->path, axis);
    const FT_Var_Axis *from = &face->axes->axis[axis];
    *out = (struct font_axis){.name = from->name ? from->name : "",
                              .least = (double)from->minimum / 65536,
                              .most = (double)from->maximum / 65536,
                              .usual = (double)from->def / 65536,
                              .value = (double)face->values[axis] / 65536};
    for (int i = 0; i < 4; i++) {
        char c = (char)(from->tag >> (24 - 8 * i) & 0x7f);
        out->tag[i] = c >= ' ' && c < 0x7f ? c : '?';
    }
    return FONT_OK;
}

enum font_status font_face_axis_set(struct font_face *face, const char *tag, double value)
{
    struct font_axis axis;
    int i = 0;
    for (; i < face->axes_count; i++)
        if (font_face_axis(face, i, &axis) == FONT_OK && strcmp(axis.tag, tag) == 0)
            break;
    if (i == face->axes_count)
        return font_fail(FONT_BAD_ARGUMENT, "%s has no axis '%.20s'", face->path, tag);
    if (!isfinite(value))
        return font_fail(FONT_BAD_ARGUMENT, "axis %s cannot be %g", tag, value);
    font_face_version_keep_first(face);
    FT_Fixed before = face->values[i];
    double within = fmax(axis.least, fmin(axis.most, value));
    face->values[i] = (FT_Fixed)lrint(fmax(-32768, fmin(32767, within)) * 65536);
    FT_Error error =
        FT_Set_Var_Design_Coordinates(face->ft, (FT_UInt)face->axes_count, face->values);
    if (error) {
        face->values[i] = before;
        return font_face_fail(face, "its axes cannot be set", error);
    }
    font_face_version_find(face);
    font_face_own_setting_find(face);
    return FONT_OK;
}

const void *font_face_bytes(const struct font_face *face, size_t *count)
{
    *count = face->bytes_count;
    return face->bytes;
}

enum font_status font_face_axes_reset(struct font_face *face)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < face->axes_count && status == FONT_OK; i++) {
        struct font_axis axis;
        status = font_face_axis(face, i, &axis);
        if (status == FONT_OK && axis.value != axis.usual)
            status = font_face_axis_set(face, axis.tag, axis.usual);
    }
    return status;
}

const char *font_face_axes_text(const struct font_face *face, char room[FONT_AXES_BYTES])
{
    size_t used = 0;
    room[0] = '\0';
    for (int i = 0; i < face->axes_count; i++) {
        struct font_axis axis;
        if (font_face_axis(face, i, &axis) != FONT_OK || axis.value == axis.usual)
            continue;
        int n = snprintf(room + used, FONT_AXES_BYTES - used, "%s%s=%.9g", used ? "," : "",
                         axis.tag, axis.value);
        if (n < 0 || (size_t)n >= FONT_AXES_BYTES - used) {
            room[used] = '\0';
            break;
        }
        used += (size_t)n;
    }
    return room;
}

enum font_status font_face_axes_set(struct font_face *face, const char *axes)
{
    while (axes && *axes) {
        char tag[5] = "", *end = NULL;
        size_t length = strcspn(axes, "=,");
        if (length >= 1 && length <= 4)
            memcpy(tag, axes, length);
        double value = axes[length] == '=' ? strtod(axes + length + 1, &end) : NAN;
        if (!tag[0] || !isfinite(value) || end == axes + length + 1 || (*end && *end != ','))
            return font_fail(FONT_BAD_ARGUMENT,
                             "axes must be like wght=700,wdth=80 (got '%.60s')", axes);
        enum font_status status = font_face_axis_set(face, tag, value);
        if (status != FONT_OK)
            return status;
        axes = *end ? end + 1 : end;
    }
    return FONT_OK;
}
