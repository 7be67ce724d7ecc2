/* script_mask.h - a script's masks, shared by the files that make and change them. */
#ifndef LUTETIA_SCRIPT_MASK_H
#define LUTETIA_SCRIPT_MASK_H

#include "script_internal.h"

struct script_mask {
    struct script *script;
    double *points; /* pairs; NULL: gray */
    int points_count;
    uint8_t *gray; /* NULL if empty */
    int x, y, width, height;
    uint8_t outside; /* the value everywhere else; of a polygon 0 */
    double bytes;
};

/* Each pushes a mask: without a shape; with room for corners; with room for gray values, all
 * 0. Raise an error if memory is short. */
struct script_mask *script_mask_new(lua_State *L);
struct script_mask *script_mask_polygon_new(lua_State *L, int count);
struct script_mask *script_mask_gray_new(lua_State *L, double width, double height, double x,
                                         double y);
/* Pushes the mask at index, converted to gray values. */
struct script_mask *script_mask_grayed(lua_State *L, int index);
/* The value of a gray mask, in 0..255, at a place. */
int script_mask_gray_at(const struct script_mask *mask, int x, int y);

#endif
