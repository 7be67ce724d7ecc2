/* lua_mask.h - a script's masks: what making and changing them share. */
#ifndef LUTETIA_LUA_MASK_H
#define LUTETIA_LUA_MASK_H

#include "lua_run.h"

extern const char mask_type[];

struct run_mask {
    struct run *run;
    double *points; /* pairs; NULL: gray */
    int points_count;
    uint8_t *gray; /* NULL if empty */
    int x, y, width, height;
    double bytes;
};

enum { PLACE_MAX = 100000 };

/* Push one: without a shape; with room for so many corners; with room for gray values, all 0. They raise errors where there is no
 * memory for it. */
struct run_mask *mask_new(lua_State *L);
struct run_mask *mask_polygon_new(lua_State *L, int count);
struct run_mask *mask_gray_new(lua_State *L, double width, double height, double x, double y);
/* Pushes the mask at index as gray. */
struct run_mask *mask_grayed(lua_State *L, int index);

/* m:move() and the like; __add, __mul, __sub. */
extern const luaL_Reg lua_mask_methods[], lua_mask_operators[];

#endif
