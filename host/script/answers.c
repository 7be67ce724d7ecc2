/* answers.c - scripts that are asked again and again, each answer with a time of its own: maps
 * and live scripts. */
#include "script_internal.h"

#include <assert.h>
#include <string.h>

lua_State *script_answers_open(struct script *script)
{
    lua_State *L = lua_newstate(script_allocate, script);
    if (!L)
        return NULL;
    memcpy(lua_getextraspace(L), &script, sizeof script);
    if (script_watchdog_start(script))
        return L;
    lua_close(L);
    return NULL;
}

bool script_answers_call(lua_State *L, lua_CFunction function, void *argument, double seconds)
{
    struct script *script = script_of(L);
    script_deadline_set(script, seconds);
    script->memory_short = false;
    script->stack_begin = __builtin_frame_address(0);
    script_hook_set(L);
    script_watchdog_pause(script, false);
    lua_pushcfunction(L, script_message);
    lua_pushcfunction(L, function);
    lua_pushlightuserdata(L, argument);
    const int status = lua_pcall(L, 1, 0, 1);
    script_watchdog_pause(script, true);
    if (status != LUA_OK)
        script_failure_tell(L, status);
    lua_settop(L, 0);
    return status == LUA_OK;
}

void script_answers_close(struct script *script, lua_State *L)
{
    if (!L)
        return;
    script->over = true;
    lua_close(L);
    script_watchdog_end(script);
    assert(script->memory_bytes == 0); /* all that was counted has been freed */
}
