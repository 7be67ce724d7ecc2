/* lua_functions.c - functions of Lua's own library, as untrusted scripts have them.
 *
 *     setmetatable           no finalizers
 *     tostring, format       no addresses: an object has a number, given when it is first asked
 *                            for
 *     math.randomseed        without a number: the run's seed (Lua's takes an address, and
 *                            tells it)
 *     coroutine.close, wrap, resume
 *                            not deeper within each other than the C stack has room for
 *     text's metatable       hidden
 */
#include "script_internal.h"

#include <lualib.h>

#include <stdio.h>
#include <string.h>

/* ---- objects have numbers ---- */

static const char numbers_key[] = "lutetia numbers";

/* Pushes the table of the objects' numbers; its keys are weak. */
static void numbers_push(lua_State *L)
{
    if (luaL_getsubtable(L, LUA_REGISTRYINDEX, numbers_key))
        return;
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
}

/* An object is the same one as long as it has the same number. */
static lua_Integer object_number(lua_State *L, int index)
{
    struct script *script = script_of(L);
    index = lua_absindex(L, index);
    numbers_push(L);
    lua_pushvalue(L, index);
    lua_Integer number = lua_rawget(L, -2) == LUA_TNUMBER ? lua_tointeger(L, -1) : 0;
    lua_pop(L, 1);
    if (number == 0) {
        number = ++script->objects_numbered;
        lua_pushvalue(L, index);
        lua_pushinteger(L, number);
        lua_rawset(L, -3);
    }
    lua_pop(L, 1);
    return number;
}

static bool is_object(lua_State *L, int index)
{
    const int type = lua_type(L, index);
    return type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TUSERDATA ||
           type == LUA_TTHREAD || type == LUA_TLIGHTUSERDATA;
}

void script_text_push(lua_State *L, int index)
{
    if (script_of(L)->config->trusted || !is_object(L, index)) {
        luaL_tolstring(L, index, NULL);
        return;
    }
    index = lua_absindex(L, index);
    if (luaL_callmeta(L, index, "__tostring")) {
        if (!lua_isstring(L, -1))
            luaL_error(L, "'__tostring' must return a string");
        return;
    }
    const bool named = luaL_getmetafield(L, index, "__name") != LUA_TNIL;
    const char *kind =
        named && lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : luaL_typename(L, index);
    lua_pushfstring(L, "%s: %I", kind, (LUAI_UACINT)object_number(L, index));
    if (named)
        lua_remove(L, -2);
}

static int to_string(lua_State *L)
{
    luaL_checkany(L, 1);
    script_text_push(L, 1);
    return 1;
}

/* Lua's own function, which is the upvalue and has none itself, does the call in our place: its
 * errors have the script's line. */
static int own(lua_State *L)
{
    return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

/* What %p writes: an object's number, and for all else what Lua writes for what has no
 * address. */
static void pointer_replace(lua_State *L, int index)
{
    if (is_object(L, index))
        lua_pushfstring(L, "%I", (LUAI_UACINT)object_number(L, index));
    else
        lua_pushliteral(L, "(null)");
    lua_replace(L, index);
}

/* string.format: as Lua's, once the objects among the arguments are texts, and %p is %s. */
static int format(lua_State *L)
{
    size_t length;
    const char *text = luaL_checklstring(L, 1, &length), *end = text + length;
    const int count = lua_gettop(L);
    int argument = 1;
    luaL_Buffer changed;
    bool as_it_is = !memchr(text, 'p', length);
    for (int i = 2; i <= count && as_it_is; i++)
        as_it_is = !is_object(L, i);
    if (as_it_is)
        return own(L);
    luaL_checkstack(L, 20 + count, "too many arguments");
    luaL_buffinit(L, &changed);
    while (text < end) {
        const bool conversion = *text == '%';
        luaL_addchar(&changed, *text++);
        if (!conversion)
            continue;
        while (text < end && *text && strchr("-+ #0123456789.", *text))
            luaL_addchar(&changed, *text++);
        if (text == end)
            break;
        const char kind = *text++;
        luaL_addchar(&changed, kind == 'p' ? 's' : kind);
        if (kind == '%' || ++argument > count)
            continue;
        if (kind == 'p' || (kind == 's' && is_object(L, argument))) {
            /* a buffer wants the stack as it was: its own values are above */
            luaL_pushresult(&changed);
            if (kind == 'p') {
                pointer_replace(L, argument);
            } else {
                script_text_push(L, argument);
                lua_replace(L, argument);
            }
            size_t so_far;
            const char *kept = lua_tolstring(L, -1, &so_far);
            luaL_buffinit(L, &changed);
            luaL_addlstring(&changed, kept, so_far);
        }
    }
    luaL_pushresult(&changed);
    lua_replace(L, 1);
    lua_settop(L, count);
    return own(L);
}

/* math.randomseed */
static int random_seed(lua_State *L)
{
    if (lua_gettop(L) == 0) {
        lua_pushinteger(L, (lua_Integer)script_of(L)->config->seed);
        lua_pushinteger(L, 0);
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

/* ---- tables ---- */

/* Hides the metatable on the top, and the functions in it, from scripts. */
void script_metatable_hide(lua_State *L)
{
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
}

/* setmetatable: as Lua's, but without finalizers. A finalizer runs during any allocation,
 * and Lua calls no hook there, so only the end of the process could stop it. Lua looks for
 * __gc only in setmetatable; a __gc added to the metatable later is never called. */
static int set_metatable(lua_State *L)
{
    lua_settop(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE); /* here, where the script's line is known */
    luaL_argexpected(L, lua_isnil(L, 2) || lua_istable(L, 2), 2, "nil or table");
    if (lua_istable(L, 2)) {
        lua_pushliteral(L, "__gc");
        if (lua_rawget(L, 2) != LUA_TNIL)
            luaL_error(L, "a script's tables have no __gc; local x <close> = ... is closed "
                          "where its block ends");
        lua_pop(L, 1);
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, 2, 1);
    return 1;
}

/* ---- coroutines ---- */

/* Lua counts the calls of C within each other for each coroutine anew when one is closed, so a
 * chain of coroutines that close each other would overflow the C stack. What they have taken of
 * it is measured. */
enum { STACK_BYTES_MOST = 1 << 20 };

static void stack_check(lua_State *L)
{
    const char *begin = script_of(L)->stack_begin;
    const char *here =
        __builtin_frame_address(0); /* a variable may lie elsewhere, under ASan */
    const ptrdiff_t taken = begin - here;
    if (begin && (taken > STACK_BYTES_MOST || taken < -STACK_BYTES_MOST))
        luaL_error(L, "C stack overflow");
}

/* coroutine.resume: as Lua's, but a coroutine that failed is closed at once, which releases
 * its pins. The coroutine stays on the stack, because code that runs while it is closed may
 * drop the last reference. */
static int resume(lua_State *L)
{
    lua_State *other = lua_tothread(L, 1);
    luaL_argexpected(L, other, 1, "coroutine");
    stack_check(L);
    lua_pushvalue(L, 1);
    lua_insert(L, 1);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 2);
    lua_call(L, lua_gettop(L) - 2, LUA_MULTRET);
    if (lua_status(other) != LUA_OK && lua_status(other) != LUA_YIELD) {
        lua_resetthread(other);
        lua_settop(other, 0); /* the error was moved here before */
    }
    return lua_gettop(L) - 1;
}

/* What coroutine.wrap() returns, where the C stack has room; the upvalue has upvalues. */
static int wrapped(lua_State *L)
{
    stack_check(L);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

/* coroutine.close */
static int close(lua_State *L)
{
    stack_check(L);
    return own(L);
}

/* coroutine.wrap: what it returns closes the coroutine if that fails. */
static int wrap(lua_State *L)
{
    luaL_checktype(L, 1, LUA_TFUNCTION);
    lua_settop(L, 1);
    own(L);
    lua_pushcclosure(L, wrapped, 1);
    return 1;
}

/* ---- all ---- */

/* Replaces a function of the table on the top; the new function has the old one as its
 * upvalue. */
static void replace(lua_State *L, const char *name, lua_CFunction function)
{
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

void script_lua_functions_open(lua_State *L)
{
    lua_getglobal(L, "coroutine");
    replace(L, "resume", resume);
    lua_pop(L, 1);
    if (script_of(L)->config->trusted)
        return;
    static const struct {
        const char *library, *name;
        lua_CFunction function;
    } rows[] = {{LUA_GNAME, "setmetatable", set_metatable},
                {LUA_GNAME, "tostring", to_string},
                {LUA_STRLIBNAME, "format", format},
                {LUA_MATHLIBNAME, "randomseed", random_seed},
                {LUA_COLIBNAME, "close", close},
                {LUA_COLIBNAME, "wrap", wrap}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lua_getglobal(L, rows[i].library);
        replace(L, rows[i].name, rows[i].function);
        lua_pop(L, 1);
    }
    lua_getglobal(L, LUA_STRLIBNAME);
    lua_pushnil(L);
    lua_setfield(L, -2, "dump");
    lua_pushliteral(L, "");
    if (lua_getmetatable(L, -1)) {
        script_metatable_hide(L);
        lua_pop(L, 1);
    }
    lua_pop(L, 2);
}
