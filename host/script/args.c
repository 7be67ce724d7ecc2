/* args.c - checks the arguments of scripts; every error names the wrong value and what it
 * must be. */
#include "script_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A short description of the value at index, for messages. */
static const char *described(lua_State *L, int index, char out[64])
{
    switch (lua_type(L, index)) {
    case LUA_TNUMBER:
        if (lua_isinteger(L, index))
            snprintf(out, 64, "%lld", (long long)lua_tointeger(L, index));
        else
            snprintf(out, 64, "%.6g", lua_tonumber(L, index));
        break;
    case LUA_TSTRING:
        snprintf(out, 64, "'%.40s'", lua_tostring(L, index));
        break;
    case LUA_TBOOLEAN:
        snprintf(out, 64, "%s", lua_toboolean(L, index) ? "true" : "false");
        break;
    default:
        snprintf(out, 64, "a %s", luaL_typename(L, index));
    }
    return out;
}

void script_names_push(lua_State *L, const char *const *names)
{
    luaL_Buffer list;
    luaL_buffinit(L, &list);
    for (int i = 0; names[i]; i++) {
        luaL_addstring(&list, i ? ", " : "");
        luaL_addstring(&list, names[i]);
    }
    luaL_pushresult(&list);
}

/* Pops the number on the top, which must be within bounds. */
static double number_pop(lua_State *L, const char *what, const char *name, double low,
                         double high)
{
    char shown[64];
    double value = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : NAN;
    if (!(value >= low && value <= high)) {
        char range[64];
        snprintf(range, sizeof range, "%g..%g", low, high);
        luaL_error(L, "%s%s%s must be %s (got %s)", what, *name ? " " : "", name, range,
                   described(L, -1, shown));
    }
    lua_pop(L, 1);
    return value;
}

/* Pushes a field of a copied table (script_arg_options) without metamethods. Returns its
 * type. */
static int field_push(lua_State *L, int index, const char *name)
{
    lua_pushstring(L, name);
    return lua_rawget(L, index);
}

double script_arg_number(lua_State *L, int index, const char *what, const char *name,
                         double fallback, double low, double high)
{
    if (field_push(L, index, name) == LUA_TNIL) {
        lua_pop(L, 1);
        return fallback;
    }
    return number_pop(L, what, name, low, high);
}

int script_arg_integer(lua_State *L, int index, const char *what, const char *name,
                       int fallback, double low, double high)
{
    char shown[64];
    if (field_push(L, index, name) == LUA_TNIL) {
        lua_pop(L, 1);
        return fallback;
    }
    lua_Number value = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : NAN;
    if (!(value >= low && value <= high) || floor(value) != value)
        luaL_error(L, "%s %s must be %d..%d (got %s)", what, name, (int)low, (int)high,
                   described(L, -1, shown));
    lua_pop(L, 1);
    return (int)value;
}

bool script_arg_boolean(lua_State *L, int index, const char *what, const char *name,
                        bool fallback)
{
    char shown[64];
    int type = field_push(L, index, name);
    if (type != LUA_TNIL && type != LUA_TBOOLEAN)
        luaL_error(L, "%s %s must be true or false (got %s)", what, name,
                   described(L, -1, shown));
    bool value = type == LUA_TNIL ? fallback : lua_toboolean(L, -1);
    lua_pop(L, 1);
    return value;
}

const char *script_arg_text(lua_State *L, int index, const char *what, const char *name)
{
    char shown[64];
    int type = field_push(L, index, name);
    if (type != LUA_TNIL && type != LUA_TSTRING)
        luaL_error(L, "%s %s must be a text (got %s)", what, name, described(L, -1, shown));
    const char *value = type == LUA_TNIL ? NULL : lua_tostring(L, -1);
    lua_pop(L, 1); /* the copy keeps it alive */
    return value;
}

bool script_arg_numbers(lua_State *L, int index, const char *what, const char *name,
                        double *out, int count, double low, double high)
{
    char shown[64];
    int type = field_push(L, index, name);
    if (type == LUA_TNIL) {
        lua_pop(L, 1);
        return false;
    }
    if (type == LUA_TNUMBER) {
        double value = number_pop(L, what, name, low, high);
        for (int i = 0; i < count; i++)
            out[i] = value;
        return true;
    }
    if (type != LUA_TTABLE || (int)lua_rawlen(L, -1) != count)
        luaL_error(L, "%s %s must be %d numbers in braces (got %s)", what, name, count,
                   described(L, -1, shown));
    for (int i = 0; i < count; i++) {
        lua_rawgeti(L, -1, i + 1);
        out[i] = number_pop(L, what, name, low, high);
    }
    lua_pop(L, 1);
    return true;
}

bool script_arg_color(lua_State *L, int index, const char *what, const char *name,
                      double out[3])
{
    char shown[64];
    if (field_push(L, index, name) != LUA_TSTRING) {
        lua_pop(L, 1);
        return script_arg_numbers(L, index, what, name, out, 3, 0, 1);
    }
    unsigned red = 0, green = 0, blue = 0;
    const char *text = lua_tostring(L, -1);
    if (strlen(text) != 7 || text[0] != '#' ||
        strspn(text + 1, "0123456789abcdefABCDEF") != 6 ||
        sscanf(text, "#%2x%2x%2x", &red, &green, &blue) != 3)
        luaL_error(L, "%s %s must be a colour, \"#rrggbb\" or {r, g, b} (got %s)", what, name,
                   described(L, -1, shown));
    out[0] = red / 255.0;
    out[1] = green / 255.0;
    out[2] = blue / 255.0;
    lua_pop(L, 1);
    return true;
}

void script_arg_options(lua_State *L, int index, const char *what, const char *const *names)
{
    if (!lua_isnil(L, index))
        luaL_checktype(L, index, LUA_TTABLE);
    lua_newtable(L);
    int copy = lua_gettop(L);
    lua_pushnil(L);
    while (lua_istable(L, index) && lua_next(L, index)) {
        char shown[64];
        bool known = false;
        if (lua_type(L, -2) == LUA_TSTRING)
            for (int i = 0; names[i] && !known; i++)
                known = strcmp(lua_tostring(L, -2), names[i]) == 0;
        if (!known) {
            described(L, -2, shown);
            script_names_push(L, names);
            luaL_error(L, "%s has no %s; it has %s", what, shown, lua_tostring(L, -1));
        }
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, copy);
    }
    lua_settop(L, copy);
    lua_replace(L, index);
}

long script_arg_count(lua_State *L, int index, const char *what, long fallback, long low,
                      long high)
{
    char shown[64];
    if (lua_isnoneornil(L, index))
        return fallback;
    lua_Number value = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : NAN;
    if (!(value >= (lua_Number)low && value <= (lua_Number)high) || floor(value) != value)
        luaL_error(L, "%s must be a whole number in %I..%I (got %s)", what, (LUAI_UACINT)low,
                   (LUAI_UACINT)high, described(L, index, shown));
    return (long)value;
}

int script_arg_index(lua_State *L, int index, const char *what, int count)
{
    if (count < 1)
        luaL_error(L, "%s must be given, and there is none yet", what);
    if (lua_isnoneornil(L, index))
        luaL_error(L, "%s must be given: 1..%d", what, count);
    return (int)script_arg_count(L, index, what, 1, 1, count) - 1;
}

double script_arg_at(lua_State *L, int index, const char *what, double low, double high)
{
    lua_pushvalue(L, index);
    return number_pop(L, what, "", low, high);
}

/* Finds the text in a NULL-ended list; raises an error that lists the choices. */
int script_arg_choice(lua_State *L, const char *what, const char *text,
                      const char *const *names)
{
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], text) == 0)
            return i;
    script_names_push(L, names);
    return luaL_error(L, "%s must be one of %s (got '%s')", what, lua_tostring(L, -1), text);
}
