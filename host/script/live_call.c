/* live_call.c - how functions of a live script are called: see live_internal.h. */
#include "live_internal.h"

bool live_call(struct script_live *live, lua_CFunction function, void *argument, double seconds)
{
    live->config.timeout_s = seconds;
    script_patience_begin(&live->script);
    const bool good = script_answers_call(live->L, function, argument, seconds);
    script_patience_end(&live->script);
    return good;
}

bool live_function_push(lua_State *L, const char *name)
{
    if (lua_getglobal(L, name) == LUA_TFUNCTION)
        return true;
    lua_pop(L, 1);
    return false;
}
