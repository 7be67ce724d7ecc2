/* face_list.c - what a font has to choose from: scripts, features, named places on its axes.
 * See face.h. */
#include "face_internal.h"

#include <hb-ot.h>

#include <stdlib.h>
#include <string.h>

enum { TAGS_MOST = 512 };

/* Adds a tag where it belongs in the alphabet, once. */
static void tag_add(hb_tag_t tags[TAGS_MOST], int *count, hb_tag_t tag)
{
    int i = 0;
    while (i < *count && tags[i] < tag)
        i++;
    if (*count == TAGS_MOST || (i < *count && tags[i] == tag))
        return;
    memmove(&tags[i + 1], &tags[i], (size_t)(*count - i) * sizeof *tags);
    tags[i] = tag;
    ++*count;
}

/* All of a table's scripts or features. */
static void table_add(hb_face_t *face, hb_tag_t table, bool features, hb_tag_t tags[TAGS_MOST],
                      int *count)
{
    unsigned from = 0, got;
    do {
        hb_tag_t some[64];
        got = sizeof some / sizeof *some;
        if (features)
            hb_ot_layout_table_get_feature_tags(face, table, from, &got, some);
        else
            hb_ot_layout_table_get_script_tags(face, table, from, &got, some);
        for (unsigned i = 0; i < got; i++)
            tag_add(tags, count, some[i]);
        from += got;
    } while (got > 0);
}

int font_face_tags(struct font_face *face, bool features, char (*out)[5], int most)
{
    hb_tag_t tags[TAGS_MOST];
    int count = 0;
    hb_face_t *hb = font_face_harfbuzz(face);
    table_add(hb, HB_OT_TAG_GSUB, features, tags, &count);
    table_add(hb, HB_OT_TAG_GPOS, features, tags, &count);
    for (int i = 0; i < count && i < most; i++) {
        for (int k = 0; k < 4; k++) {
            char c = (char)(tags[i] >> (24 - 8 * k) & 0xff);
            out[i][k] = c >= ' ' && c < 0x7f ? c : '?';
        }
        out[i][4] = '\0';
    }
    return count;
}

bool font_face_feature_name(struct font_face *face, const char *tag, char *room, size_t bytes)
{
    hb_face_t *hb = font_face_harfbuzz(face);
    hb_tag_t wanted = hb_tag_from_string(tag, -1);
    const hb_tag_t tables[] = {HB_OT_TAG_GSUB, HB_OT_TAG_GPOS};
    for (int t = 0; t < 2; t++) {
        unsigned total = hb_ot_layout_table_get_feature_tags(hb, tables[t], 0, NULL, NULL);
        for (unsigned i = 0; i < total && i < 65536; i++) {
            hb_tag_t found;
            unsigned one = 1, size = (unsigned)bytes;
            hb_ot_name_id_t label = HB_OT_NAME_ID_INVALID;
            hb_ot_layout_table_get_feature_tags(hb, tables[t], i, &one, &found);
            if (one == 1 && found == wanted &&
                hb_ot_layout_feature_get_name_ids(hb, tables[t], i, &label, NULL, NULL, NULL,
                                                  NULL) &&
                label != HB_OT_NAME_ID_INVALID &&
                hb_ot_name_get_utf8(hb, label, hb_language_from_string("en", -1), &size, room) >
                    0)
                return true;
        }
    }
    return false;
}

/* HarfBuzz's: FreeType adds the usual place where the font does not name it. */
int font_face_instances_count(struct font_face *face)
{
    return face->axes_count ? (int)hb_ot_var_get_named_instance_count(font_face_harfbuzz(face))
                            : 0;
}

enum font_status font_face_instance(struct font_face *face, int i, struct font_instance *out)
{
    *out = (struct font_instance){0};
    if (i < 0 || i >= font_face_instances_count(face))
        return font_fail(FONT_BAD_ARGUMENT, "%s has no instance %d", face->path, i);
    hb_face_t *hb = font_face_harfbuzz(face);
    unsigned size = sizeof out->name, count = FONT_AXES_MAX;
    float values[FONT_AXES_MAX] = {0};
    hb_ot_name_get_utf8(hb, hb_ot_var_named_instance_get_subfamily_name_id(hb, (unsigned)i),
                        hb_language_from_string("en", -1), &size, out->name);
    hb_ot_var_named_instance_get_design_coords(hb, (unsigned)i, &count, values);
    for (int k = 0; k < face->axes_count; k++)
        out->values[k] = (double)values[k];
    return FONT_OK;
}
