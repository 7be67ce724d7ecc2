/* face_version.c - versions of a face, by which others find what they keep of it: see
 * face.h. */
#include "face_internal.h"

#include <stdlib.h>
#include <string.h>

static _Atomic uint64_t versions;

uint64_t font_face_version(const struct font_face *face)
{
    return face->version;
}

void font_face_version_find(struct font_face *face)
{
    for (int i = 0; face->settings && i < face->settings_count; i++)
        if (memcmp(face->settings[i].values, face->values, sizeof face->values) == 0) {
            face->version = face->settings[i].version;
            return;
        }
    face->version = ++versions;
    if (!face->settings)
        return; /* no memory: it will only not be found again */
    struct font_setting *s = &face->settings[face->settings_next];
    memcpy(s->values, face->values, sizeof s->values);
    s->version = face->version;
    face->settings_next = (face->settings_next + 1) % FACE_SETTINGS_KEPT;
    if (face->settings_count < FACE_SETTINGS_KEPT)
        face->settings_count++;
}

void font_face_version_renew(struct font_face *face)
{
    free(face->settings);
    face->settings = NULL;
    face->settings_count = face->settings_next = 0;
    face->version = ++versions;
}

void font_face_version_keep_first(struct font_face *face)
{
    if (face->settings)
        return;
    face->settings = calloc(FACE_SETTINGS_KEPT, sizeof *face->settings);
    if (face->settings) {
        memcpy(face->settings[0].values, face->values, sizeof face->values);
        face->settings[0].version = face->version;
        face->settings_count = face->settings_next = 1;
    }
}

/* ---- settings of which something is not the font's own ---- */

void font_face_own_setting_find(struct font_face *face)
{
    face->own_setting = 0;
    for (int i = 0; i < face->own_settings_count && !face->own_setting; i++)
        if (memcmp(face->own_settings[i].values, face->values, sizeof face->values) == 0)
            face->own_setting = i + 1;
}

int font_face_own_setting(struct font_face *face)
{
    font_face_own_setting_find(face);
    if (face->own_setting)
        return face->own_setting;
    if (!array_reserve(&face->own_settings, &face->own_settings_capacity,
                       face->own_settings_count + 1, sizeof *face->own_settings))
        return 0;
    struct font_own_setting *s = &face->own_settings[face->own_settings_count++];
    memcpy(s->values, face->values, sizeof s->values);
    face->own_setting = face->own_settings_count;
    return face->own_setting;
}
