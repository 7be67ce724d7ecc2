/* lua_sandbox.c - what a script may not do: reach files, processes and the interpreter's inside, run for ever, or take all
 * memory. Trusted scripts get Lua's whole library. */
#include "lua_run.h"
#include "lutetia.h"

#include <lualib.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct run *run_of(lua_State *L)
{
    struct run *run;
    memcpy(&run, lua_getextraspace(L), sizeof run);
    return run;
}

bool run_due(const struct run *run)
{
    return interrupted() || (run->deadline_s > 0 && clock_s() > run->deadline_s);
}

struct progress run_progress_begin(const struct run *run, const char *what, long total)
{
    struct progress progress = progress_begin(what, (int)total);
    if (run->quiet || run->report_to)
        progress.shown = false;
    return progress;
}

/* level: 0 for the script itself, 1 for a function that it called. */
static void stop_if_due(lua_State *L, int level)
{
    const struct run *run = run_of(L);
    char text[96];
    if (interrupted())
        snprintf(text, sizeof text, "interrupted");
    else if (run->deadline_s > 0 && clock_s() > run->deadline_s)
        snprintf(text, sizeof text,
                 "stopped after %g seconds; --timeout says how long a script may take",
                 run->timeout_s);
    else
        return;
    luaL_where(L, level);
    lua_pushstring(L, text);
    lua_concat(L, 2);
    lua_error(L);
}

void run_check(lua_State *L)
{
    stop_if_due(L, 1);
}

void run_memory_take(lua_State *L, double bytes, const char *what)
{
    struct run *run = run_of(L);
    if (!(bytes >= 0 && bytes + (double)run->memory_bytes <= (double)run->memory_most_bytes)) {
        lua_gc(L, LUA_GCCOLLECT); /* masks and sheets that nobody holds any more */
        if (!(bytes >= 0 &&
              bytes + (double)run->memory_bytes <= (double)run->memory_most_bytes)) {
            char text[96];
            snprintf(text, sizeof text, "%.0f MB for %s, and --memory allows %.0f in all",
                     bytes * 1e-6, what, (double)run->memory_most_bytes * 1e-6);
            luaL_error(L, "not enough memory: %s", text);
        }
    }
    run->memory_bytes += (size_t)bytes;
}

void run_memory_give(struct run *run, double bytes)
{
    run->memory_bytes -= (size_t)bytes;
}

/* The folder with all links followed, and what is left of the name, must be where they seem to be. */
const char *run_path(lua_State *L, const char *folder, const char *name, const char *what)
{
    if (strlen(name) == 0 || strlen(name) > 1000)
        luaL_error(L, "%s must have a name of 1..1000 characters (got %d)", what,
                   (int)(strlen(name) > 1000000 ? 1000000 : strlen(name)));
    for (const char *c = name; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127)
            luaL_error(L, "%s's name has a control character in it", what);
    if (run_of(L)->trusted && name[0] == '/')
        return lua_pushstring(L, name);
    const char *path = lua_pushfstring(L, "%s/%s", folder, name);
    if (run_of(L)->trusted)
        return path;
    static const char outside[] =
        "%s must be in the folder given (got '%s'); --in and --out name folders";
    if (name[0] == '/' || strcmp(name, "..") == 0 || strncmp(name, "../", 3) == 0 ||
        strstr(name, "/../") ||
        (strlen(name) >= 3 && strcmp(name + strlen(name) - 3, "/..") == 0))
        luaL_error(L, outside, what, name);
    /* links: of the file if there is one, else of its folder */
    char whole[PATH_MAX], root[PATH_MAX];
    char *parent = lua_newuserdatauv(L, strlen(path) + 1, 0);
    strcpy(parent, path);
    bool there = realpath(path, whole) != NULL;
    if (!there) {
        *strrchr(parent, '/') = '\0';
        there = realpath(parent, whole) != NULL;
    }
    if (!realpath(folder, root) || !there)
        luaL_error(L, "%s '%s': there is no such folder", what, name);
    size_t length = strlen(root);
    if (strncmp(whole, root, length) != 0 ||
        (whole[length] != '/' && whole[length] != '\0' && strcmp(root, "/") != 0))
        luaL_error(L, outside, what, name);
    lua_pop(L, 1);
    return path;
}

/* After time is up every instruction is stopped, so that a script cannot go on by catching errors. */
static void hook(lua_State *L, lua_Debug *event)
{
    (void)event;
    const struct run *run = run_of(L);
    if (interrupted() || (run->deadline_s > 0 && clock_s() > run->deadline_s)) {
        lua_sethook(L, hook, LUA_MASKCOUNT, 1);
        stop_if_due(L, 0);
    }
}

/* print: as Lua's; progress lines are on the standard error. */
static int print(lua_State *L)
{
    int count = lua_gettop(L);
    for (int i = 1; i <= count; i++) {
        size_t length;
        const char *text = luaL_tolstring(L, i, &length);
        if (i > 1)
            putchar('\t');
        fwrite(text, 1, length, stdout);
        lua_pop(L, 1);
    }
    putchar('\n');
    fflush(stdout);
    run_check(L);
    return 0;
}

/* param("name", default): what the command line said as name=value; a number where the default is one. */
static int param(lua_State *L)
{
    struct run *run = run_of(L);
    const char *name = luaL_checkstring(L, 1);
    size_t length = strlen(name);
    for (int i = run->words_count - 1; i >= 0; i--) {
        if (strncmp(run->words[i], name, length) != 0 || run->words[i][length] != '=')
            continue;
        for (int j = 0; j <= i; j++)
            if (strncmp(run->words[j], name, length) == 0 && run->words[j][length] == '=')
                run->asked[j] = true;
        const char *value = run->words[i] + length + 1;
        if (lua_type(L, 2) == LUA_TNUMBER) {
            if (lua_stringtonumber(L, value) == 0)
                luaL_error(L, "%s must be a number (got '%s')", name, value);
        } else if (lua_type(L, 2) == LUA_TBOOLEAN) {
            bool yes = strcmp(value, "true") == 0;
            if (!yes && strcmp(value, "false") != 0)
                luaL_error(L, "%s must be true or false (got '%s')", name, value);
            lua_pushboolean(L, yes);
        } else {
            lua_pushstring(L, value);
        }
        return 1;
    }
    lua_settop(L, 2);
    return 1;
}

/* The script's text; NULL where it cannot be read, or has zeros in it. */
static char *script_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    size_t room = 0;
    ssize_t length = file ? getdelim(&text, &room, '\0', file) : -1;
    bool whole = length >= 0 && feof(file);
    if (file)
        fclose(file);
    if (!whole) {
        free(text);
        return NULL;
    }
    return text;
}

void run_words_check(lua_State *L)
{
    struct run *run = run_of(L);
    bool all_asked = true;
    for (int i = 0; i < run->words_count; i++)
        all_asked = all_asked && run->asked[i];
    if (run->words_checked || all_asked ||
        run->trusted) /* trusted: it may be in another file */
        return;
    run->words_checked = true;
    char *text = script_text(run->script), key[64] = "";
    for (int i = 0; text && i < run->words_count && !*key; i++) {
        char one[sizeof key];
        size_t length = strcspn(run->words[i], "=");
        if (run->asked[i] || length >= sizeof one)
            continue;
        snprintf(one, sizeof one, "%.*s", (int)length, run->words[i]);
        if (!strstr(text, one))
            strcpy(key, one);
    }
    free(text);
    if (*key)
        luaL_error(L, "the script asks for no '%s'", key);
}

/* Lua's order of text keys differs from run to run; pictures must not. */
static const char prelude[] = "local type, next, sort, tostring, getmetatable = type, next, "
                              "table.sort, tostring, getmetatable\n"
                              "local order = {number = 1, string = 2}\n"
                              "function pairs(t)\n"
                              "  local keys = {}\n"
                              "  for k in next, t do keys[#keys + 1] = k end\n"
                              "  sort(keys, function(a, b)\n"
                              "    local x, y = order[type(a)] or 3, order[type(b)] or 3\n"
                              "    if x ~= y then return x < y end\n"
                              "    if x == 3 then return false end\n"
                              "    return a < b\n"
                              "  end)\n"
                              "  local i = 0\n"
                              "  return function()\n"
                              "    while i < #keys do\n"
                              "      i = i + 1\n"
                              "      local v = t[keys[i]]\n"
                              "      if v ~= nil then return keys[i], v end\n"
                              "    end\n"
                              "  end, t, nil\n"
                              "end\n";

void lua_sandbox_open(lua_State *L)
{
    struct run *run = run_of(L);
    static const luaL_Reg libraries[] = {
        {LUA_GNAME, luaopen_base},       {LUA_COLIBNAME, luaopen_coroutine},
        {LUA_TABLIBNAME, luaopen_table}, {LUA_STRLIBNAME, luaopen_string},
        {LUA_MATHLIBNAME, luaopen_math}, {LUA_UTF8LIBNAME, luaopen_utf8}};
    static const char *const taken[] = {"dofile", "loadfile", "load", "collectgarbage",
                                        "next",   "require",  NULL};
    if (run->trusted)
        luaL_openlibs(L);
    else
        for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
            luaL_requiref(L, libraries[i].name, libraries[i].func, 1);
            lua_pop(L, 1);
        }
    if (luaL_loadbufferx(L, prelude, sizeof prelude - 1, "=prelude", "t") != LUA_OK)
        lua_error(L);
    lua_call(L, 0, 0);
    if (!run->trusted) {
        for (int i = 0; taken[i]; i++) {
            lua_pushnil(L);
            lua_setglobal(L, taken[i]);
        }
        lua_getglobal(L, "string");
        lua_pushnil(L);
        lua_setfield(L, -2, "dump");
        lua_pop(L, 1);
    }
    lua_register(L, "print", print);
    lua_register(L, "param", param);
    lua_getglobal(L, "math");
    lua_getfield(L, -1, "randomseed");
    lua_pushinteger(L, (lua_Integer)run->seed);
    lua_call(L, 1, 0);
    lua_pop(L, 1);
    lua_sethook(L, hook, LUA_MASKCOUNT, 1000);
}
