/* types.c - the kinds of userdata in scripts. */
#include "script_internal.h"

#include <stdlib.h>
#include <string.h>

const char script_mask_type[] = "lutetia mask", script_papers_type[] = "lutetia papers",
           script_paper_type[] = "lutetia paper", script_brush_type[] = "lutetia brush",
           script_picture_type[] = "lutetia picture", script_spring_type[] = "lutetia spring",
           script_network_type[] = "lutetia network";

/* What a type without such a method answers: the methods that it has. Its upvalues: the type's
 * name, the table of methods. */
static int method_missing(lua_State *L)
{
    lua_settop(L, 2);
    script_text_push(L, 2);
    lua_pushvalue(L, lua_upvalueindex(2));
    script_method_unknown(L, lua_tostring(L, lua_upvalueindex(1)), lua_tostring(L, 3));
    return 0;
}

static int names_order(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* A script may have put anything into the table `spring`: only names count, and not too
 * many. */
void script_method_unknown(lua_State *L, const char *type, const char *name)
{
    enum { NAMES_MAX = 100 };
    const char *names[NAMES_MAX]; /* they live in the table */
    int methods = lua_gettop(L), count = 0;
    lua_pushnil(L);
    while (count < NAMES_MAX && lua_next(L, methods)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING)
            names[count++] = lua_tostring(L, -1);
    }
    lua_settop(L, methods);
    /* in order, or the message would differ from run to run */
    qsort(names, (size_t)count, sizeof *names, names_order);
    luaL_Buffer list;
    luaL_buffinit(L, &list);
    for (int i = 0; i < count; i++) {
        luaL_addstring(&list, i > 0 ? ", " : "");
        luaL_addstring(&list, names[i]);
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
    lua_pushvalue(L, -3);
    lua_pushcclosure(L, method_missing, 2);
    lua_setfield(L, -2, "__index");
    script_metatable_hide(L);
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, "methods");
    lua_setfield(L, -2, "__index");
    if (gc) {
        lua_pushcfunction(L, gc);
        lua_setfield(L, -2, "__gc");
    }
    script_metatable_hide(L);
    lua_pop(L, 1);
}
