/* call.c - rules for every call from a script into the library.
 *
 * A function first reads all its arguments: numbers into C variables, options from a private
 * copy of their table (args.c), without metamethods. Then it calls the script's functions that
 * it was given, if any. Then it does its work.
 *
 * Other Lua code can run in between: the script's functions, and a trusted script's finalizers
 * during any allocation. This code can do anything except close a paper that is in use. For
 * this, a function pins its paper:
 *
 *     stack   1 .. count    arguments
 *             count + 1     a pin: to be closed when the function returns or fails, which takes
 *                           it off the paper
 *             above         what the function makes
 *
 * Objects that cannot be closed (masks, pictures, lists of lines) live as long as they are
 * on the stack.
 */
#include "script_internal.h"
#include "script_paper.h"

#include <history.h>

#include <stdlib.h>

/* The most values of a function on the stack, including a plane for each pigment. */
enum { STACK_ROOM = 64 };

static const char pin_type[] = "lutetia pin", box_type[] = "lutetia memory";

/* ---- calls ---- */

/* The called function's row is its upvalue. */
static int called(lua_State *L)
{
    const luaL_Reg *row = lua_touserdata(L, lua_upvalueindex(1));
    struct script *script = script_of(L);
    if (script->over) /* an object made now would never be finalized */
        luaL_error(L, "the script is over");
    script_check(L);
    if (!lua_checkstack(L, STACK_ROOM))
        luaL_error(L, script->memory_short ? "not enough memory" : "stack overflow");
    script_at_work(script, true);
    int count = row->func(L);
    script_at_work(script, false);
    return count;
}

void script_functions_set(lua_State *L, const luaL_Reg *rows)
{
    for (; rows->name; rows++) {
        lua_pushlightuserdata(L, (void *)(uintptr_t)rows);
        lua_pushcclosure(L, called, 1);
        lua_setfield(L, -2, rows->name);
    }
}

void script_callback(lua_State *L, int arguments, int results)
{
    struct script *script = script_of(L);
    script_at_work(script, false);
    lua_call(L, arguments, results);
    script_at_work(script, true);
}

int script_callback_protected(lua_State *L, int arguments)
{
    struct script *script = script_of(L);
    script_at_work(script, false);
    int status = lua_pcall(L, arguments, 0, 0);
    script_at_work(script, true);
    return status;
}

/* ---- pins ---- */

struct pin {
    struct script_paper *paper; /* NULL: unpinned */
};

static int unpin(lua_State *L)
{
    struct pin *pin = luaL_checkudata(L, 1, pin_type);
    if (pin->paper)
        pin->paper->pins--;
    pin->paper = NULL;
    return 0;
}

struct script_paper *script_paper_pin(lua_State *L, int index)
{
    struct script_paper *paper = luaL_checkudata(L, index, script_paper_type);
    struct pin *pin = lua_newuserdatauv(L, sizeof *pin, 1);
    pin->paper = NULL;
    luaL_setmetatable(L, pin_type);
    lua_pushvalue(L, index); /* keeps the paper alive as long as the pin */
    lua_setiuservalue(L, -2, 1);
    if (!paper->sheet)
        luaL_error(L, "this paper is closed");
    lua_toclose(L, -1);
    pin->paper = paper;
    paper->pins++;
    /* count the memory of new history */
    double more = paper_history_bytes(paper->sheet) - paper->history_bytes;
    if (more > 0)
        script_memory_take(L, more, "a paper's history (history = false does without)");
    else
        script_memory_give(paper->script, -more);
    paper->history_bytes += more;
    return paper;
}

struct script_paper *script_paper_begin(lua_State *L, int count)
{
    lua_settop(L, count);
    return script_paper_pin(L, 1);
}

/* ---- memory ---- */

static int box_gc(lua_State *L)
{
    void **memory = luaL_checkudata(L, 1, box_type);
    free(*memory);
    *memory = NULL;
    return 0;
}

void **script_box_new(lua_State *L)
{
    void **memory = lua_newuserdatauv(L, sizeof *memory, 0);
    *memory = NULL;
    luaL_setmetatable(L, box_type);
    return memory;
}

void script_call_open(lua_State *L)
{
    script_type_open(L, box_type, box_gc);
    script_type_open(L, pin_type, unpin); /* for pins of a coroutine that was never closed */
    luaL_getmetatable(L, pin_type);
    lua_pushcfunction(L, unpin);
    lua_setfield(L, -2, "__close");
    lua_pop(L, 1);
}
