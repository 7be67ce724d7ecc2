/* types.c - the kinds of userdata in scripts. */
#include "script_internal.h"

const char script_mask_type[] = "lutetia mask", script_papers_type[] = "lutetia papers",
           script_paper_type[] = "lutetia paper", script_brush_type[] = "lutetia brush",
           script_picture_type[] = "lutetia picture", script_spring_type[] = "lutetia spring",
           script_network_type[] = "lutetia network";

void script_type_open(lua_State *L, const char *name, lua_CFunction gc)
{
    luaL_newmetatable(L, name);
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, "methods");
    lua_setfield(L, -2, "__index");
    if (gc) {
        lua_pushcfunction(L, gc);
        lua_setfield(L, -2, "__gc");
    }
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable"); /* hides the metatable and its __gc from scripts */
    lua_pop(L, 1);
}
