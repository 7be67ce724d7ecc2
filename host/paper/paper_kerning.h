/* paper_kerning.h - pair kerning of OpenType fonts whose only kerning is in their GPOS table.
 *
 *     struct paper_kerning k;
 *     paper_kerning_create(&k, face);
 *     x += paper_kerning_between(&k, left_glyph, right_glyph);
 *     paper_kerning_destroy(&k);
 */
#ifndef LUTETIA_PAPER_KERNING_H
#define LUTETIA_PAPER_KERNING_H

#include <stddef.h>
#include <stdint.h>

#include <ft2build.h>
#include FT_FREETYPE_H

struct paper_kerning {
    uint8_t *gpos; /* the whole table; NULL: there is none, or no memory for it */
    size_t bytes;
};

void paper_kerning_create(struct paper_kerning *k, FT_Face face);
void paper_kerning_destroy(struct paper_kerning *k);
/* Units: font units, added to the left glyph's advance. A damaged table gives 0. */
int paper_kerning_between(const struct paper_kerning *k, unsigned left, unsigned right);

#endif
