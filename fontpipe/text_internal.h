/* text_internal.h - what text.c and text_lines.c share. */
#ifndef LUTETIA_FONT_TEXT_INTERNAL_H
#define LUTETIA_FONT_TEXT_INTERNAL_H

#include "edges.h"
#include "text.h"

#include <fontconfig/fontconfig.h>
#include <hb.h>

enum { FONT_FACES_MAX = 24 };

struct font_shaped_face {
    struct font_face *face;
    hb_font_t *hb;
    uint64_t version;
    bool owned;
    double units_per_em;
};

struct font_shaper {
    struct font_shaped_face faces[FONT_FACES_MAX];
    int faces_count;
    hb_buffer_t *buffer;
    FcFontSet *candidates; /* fontconfig's, best first; NULL until the first is needed */
};

/* Makes the HarfBuzz font, again if the face's axes were set since. */
void font_shaped_refresh(struct font_shaped_face *face);
/* A face of the shaper that has the character, opened if need be; -1 if there is none. */
int font_shaper_face_for(struct font_shaper *shaper, uint32_t character);

#endif
