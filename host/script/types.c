/* types.c - the kinds of userdata in scripts. */
#include "script_internal.h"

#include <string.h>

const char script_mask_type[] = "lutetia mask", script_papers_type[] = "lutetia papers",
           script_paper_type[] = "lutetia paper", script_brush_type[] = "lutetia brush",
           script_picture_type[] = "lutetia picture", script_spring_type[] = "lutetia spring",
           script_network_type[] = "lutetia network";

/* What a type without such a method answers: the methods that it has. */
static int method_missing(lua_State *L)
{
    luaL_tolstring(L, 2, NULL);
    lua_pushvalue(L, 1);
    script_method_unknown(L, lua_tostring(L, lua_upvalueindex(1)), lua_tostring(L, -2));
    return 0;
}

void script_method_unknown(lua_State *L, const char *type, const char *name)
{
    int methods = lua_gettop(L), count = 0;
    lua_newtable(L);
    lua_pushnil(L);
    while (lua_next(L, methods)) {
        lua_pop(L, 1);
        lua_pushvalue(L, -1);
        lua_rawseti(L, methods + 1, ++count);
    }
    /* in order, or the message would differ from run to run */
    for (int i = 2; i <= count; i++)
        for (int j = i; j > 1; j--) {
            lua_rawgeti(L, methods + 1, j - 1);
            lua_rawgeti(L, methods + 1, j);
            const bool after = strcmp(lua_tostring(L, -2), lua_tostring(L, -1)) > 0;
            if (after)
                lua_rawseti(L, methods + 1, j - 1);
            else
                lua_pop(L, 1);
            if (after)
                lua_rawseti(L, methods + 1, j);
            else
                lua_pop(L, 1);
        }
    luaL_Buffer list;
    luaL_buffinit(L, &list);
    for (int i = 1; i <= count; i++) {
        luaL_addstring(&list, i > 1 ? ", " : "");
        lua_rawgeti(L, methods + 1, i);
        luaL_addvalue(&list);
    }
    luaL_pushresult(&list);
    luaL_error(L, "%s has no '%s'; it has %s", type, name, lua_tostring(L, -1));
}

void script_type_open(lua_State *L, const char *name, lua_CFunction gc)
{
    luaL_newmetatable(L, name);
    lua_newtable(L);
    lua_newtable(L);
    lua_pushstring(L, strncmp(name, "lutetia ", 8) == 0 ? name + 8 : name);
    lua_pushcclosure(L, method_missing, 1);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
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
