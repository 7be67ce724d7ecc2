/* host.c - finds a state's script, and calls its host's functions. */
#include "script_internal.h"

#include <string.h>

struct script *script_of(lua_State *L)
{
    struct script *script;
    memcpy(&script, lua_getextraspace(L), sizeof script);
    return script;
}

bool script_interrupted(const struct script *script)
{
    return script->host->interrupted && script->host->interrupted(script->host->context);
}

void script_error_tell(const struct script *script, const char *text)
{
    if (script->host->error)
        script->host->error(script->host->context, text);
}

void script_note_tell(const struct script *script, const char *text)
{
    if (script->host->note)
        script->host->note(script->host->context, text);
}

void script_note_where(lua_State *L, const char *text)
{
    luaL_where(L, 1);
    lua_pushstring(L, text);
    lua_concat(L, 2);
    script_note_tell(script_of(L), lua_tostring(L, -1));
    lua_pop(L, 1);
}

void script_note_once(lua_State *L, enum script_once what, const char *text)
{
    struct script *script = script_of(L);
    if (!(script->notes_told >> what & 1))
        script_note_where(L, text);
    script->notes_told |= 1u << what;
}

void script_wrote_tell(const struct script *script, const char *path)
{
    if (script->host->wrote)
        script->host->wrote(script->host->context, path);
}

void script_progress_tell(const struct script *script, const struct script_progress *progress)
{
    if (script->host->progress)
        script->host->progress(script->host->context, progress);
}
