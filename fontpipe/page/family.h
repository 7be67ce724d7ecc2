/* family.h - a font's slanted and bold ones. */
#ifndef LUTETIA_PAGE_FAMILY_H
#define LUTETIA_PAGE_FAMILY_H

#include <stddef.h>

/* The name of the font's family's face of a kind: "Italic", "Bold" or "BoldItalic"; the font
 * itself where the family has none. Returns room or `font`, never NULL. Owns: the caller. */
const char *page_family_face(const char *font, const char *kind, char *room, size_t bytes);

#endif
