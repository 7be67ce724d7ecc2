/* sandbox.c - what a script may not do: reach files, processes and the interpreter's
 * internals, run for ever, or take all memory. Trusted scripts get Lua's whole library. */
#include "script_internal.h"

#include <edits.h>
#include <input_file.h>
#include <text.h>

#include <lualib.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The resolved path, with all links followed, must lie in the folder. */
const char *script_path(lua_State *L, const char *folder, const char *name, const char *what)
{
    if (strlen(name) == 0 || strlen(name) > 1000)
        luaL_error(L, "%s must have a name of 1..1000 characters (got %d)", what,
                   (int)(strlen(name) > 1000000 ? 1000000 : strlen(name)));
    for (const char *c = name; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127)
            luaL_error(L, "%s's name has a control character in it", what);
    if (!folder)
        luaL_error(L, "%s '%s': this script has no files", what, name);
    if (script_of(L)->config->trusted && name[0] == '/')
        return lua_pushstring(L, name);
    const char *path = lua_pushfstring(L, "%s/%s", folder, name);
    if (script_of(L)->config->trusted)
        return path;
    static const char outside[] =
        "%s must be in the folder given (got '%s'); --in and --out name folders";
    if (name[0] == '/' || strcmp(name, "..") == 0 || strncmp(name, "../", 3) == 0 ||
        strstr(name, "/../") ||
        (strlen(name) >= 3 && strcmp(name + strlen(name) - 3, "/..") == 0))
        luaL_error(L, outside, what, name);
    /* whole: the file's resolved path if it exists, else its folder's */
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

/* Whether edits are in the script's folder under that name. */
static bool edits_are_here(const struct script_config *config, const char *name)
{
    char path[PATH_MAX];
    int n =
        config->in_folder ? snprintf(path, sizeof path, "%s/%s", config->in_folder, name) : 0;
    return n > 0 && n < (int)sizeof path && name[0] != '/' && font_edits_is(path);
}

const char *script_font(lua_State *L, const char *name, const char *what)
{
    const struct script_config *config = script_of(L)->config;
    if (strchr(name, '/') && !config->trusted)
        luaL_error(L, "%s must be a font's name, not a file (got '%s')", what, name);
    const char *plus = edits_are_here(config, name) ? NULL : strrchr(name, '+');
    const char *folder = plus ? plus + 1 : name; /* FONT+FOLDER */
    bool is_here = edits_are_here(config, folder) && plus != name;
    if (!is_here && !config->trusted && font_edits_folder(name))
        luaL_error(L, "%s '%s': a font's edits must be in the folder given; --in names it",
                   what, name);
    if (!is_here)
        return name;
    const char *kept = script_path(L, config->in_folder, folder, what);
    if (plus) {
        lua_pushlstring(L, name, (size_t)(folder - name));
        lua_pushstring(L, kept);
        lua_concat(L, 2);
        lua_remove(L, -2);
        kept = lua_tostring(L, -1);
    }
    lua_pushvalue(L, -1); /* for as long as the script runs */
    lua_setfield(L, LUA_REGISTRYINDEX, kept);
    lua_pop(L, 1);
    return kept;
}

/* A note of that text, unless there was one. */
static void note_new(lua_State *L, const char *text)
{
    if (lua_getfield(L, LUA_REGISTRYINDEX, text) == LUA_TNIL) {
        lua_pushboolean(L, true);
        lua_setfield(L, LUA_REGISTRYINDEX, text);
        script_note_where(L, text);
    }
    lua_pop(L, 1);
}

void script_edits_tell(lua_State *L)
{
    const char *changed = font_edits_said();
    if (changed)
        note_new(L, changed);
}

void script_missing_tell(lua_State *L, const char *font, const uint32_t *missing, int count)
{
    for (int i = 0; i < count && i < FONT_MISSING_MAX; i++) {
        char text[160];
        snprintf(text, sizeof text,
                 "no font has a glyph for U+%04X; %.80s's sign for that is set instead",
                 (unsigned)missing[i], font);
        note_new(L, text);
    }
}

const char *script_path_to_write(lua_State *L, const char *name, const char *ending,
                                 const char *what)
{
    const struct script_config *config = script_of(L)->config;
    const char *last = strrchr(name, '/');
    size_t stem = strlen(last ? last + 1 : name), tail = strlen(ending);
    if (stem <= tail || strcmp(name + strlen(name) - tail, ending) != 0)
        luaL_error(L, "%s's file must end in %s (got '%s')", what, ending, name);
    for (const char *part = name; part && !config->trusted; part = strchr(part, '/')) {
        part += *part == '/';
        if (part[0] == '.' && part[1] != '/' && strncmp(part, "../", 3) != 0)
            luaL_error(L, "%s's file must not be hidden (got '%s')", what, name);
        if (part[0] == '-') /* other programs would take the name for an option */
            luaL_error(L, "%s's file must not begin with '-' (got '%s')", what, name);
    }
    return script_path(L, config->out_folder, name, what);
}

/* Once time is up every instruction raises an error, so that a script cannot go on by
 * catching errors. */
static void hook(lua_State *L, lua_Debug *event)
{
    (void)event;
    struct script *script = script_of(L);
    script_at_work(script, false); /* the hook runs only in Lua code, not during a paper's
                                    * work */
    if (script_due(script))
        lua_sethook(L, hook, LUA_MASKCOUNT, 1);
    script_stop_if_due(L, 0);
}

void script_hook_set(lua_State *L)
{
    lua_sethook(L, hook, LUA_MASKCOUNT, 1000);
}

/* print: as Lua's, to the host's function. */
static int print(lua_State *L)
{
    const struct script_host *host = script_of(L)->host;
    int count = lua_gettop(L);
    luaL_Buffer line;
    luaL_buffinit(L, &line);
    for (int i = 1; i <= count; i++) {
        if (i > 1)
            luaL_addchar(&line, '\t');
        script_text_push(L, i);
        luaL_addvalue(&line);
    }
    luaL_addchar(&line, '\n');
    luaL_pushresult(&line);
    size_t length;
    const char *text = lua_tolstring(L, -1, &length);
    if (host->print)
        host->print(host->context, text, length);
    script_check(L);
    return 0;
}

/* param("name", default): the value of name=value on the command line; a number if the
 * default is one. */
static int param(lua_State *L)
{
    struct script *script = script_of(L);
    const char *name = luaL_checkstring(L, 1);
    size_t length = strlen(name);
    for (int i = script->config->words_count - 1; i >= 0; i--) {
        if (strncmp(script->config->words[i], name, length) != 0 ||
            script->config->words[i][length] != '=')
            continue;
        for (int j = 0; j <= i; j++)
            if (strncmp(script->config->words[j], name, length) == 0 &&
                script->config->words[j][length] == '=')
                script->asked[j] = true;
        const char *value = script->config->words[i] + length + 1;
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

/* ---- the script's file ---- */

struct piece {
    FILE *stream;
    char bytes[4096];
};

static const char *piece_read(lua_State *L, void *context, size_t *count)
{
    struct piece *piece = context;
    (void)L;
    *count = fread(piece->bytes, 1, sizeof piece->bytes, piece->stream);
    return *count ? piece->bytes : NULL;
}

/* Skips a UTF-8 byte order mark, and a first line that names an interpreter. */
static void beginning_skip(FILE *stream)
{
    char mark[3];
    if (fread(mark, 1, sizeof mark, stream) != sizeof mark ||
        memcmp(mark, "\xef\xbb\xbf", sizeof mark) != 0)
        rewind(stream);
    int c = getc(stream);
    bool names = c == '#';
    while (names && c != EOF &&
           c != '\n') /* keep the line's end, so that line numbers are right */
        c = getc(stream);
    if (c != EOF)
        ungetc(c, stream);
}

int script_load(lua_State *L, const char *path)
{
    const char *why = "";
    struct piece piece = {.stream = input_file_open(path, &why)};
    if (!piece.stream) {
        lua_pushfstring(L, "%s: cannot read: %s", path, why);
        return LUA_ERRFILE;
    }
    beginning_skip(piece.stream);
    lua_pushfstring(L, "@%s", path);
    int status = lua_load(L, piece_read, &piece, lua_tostring(L, -1), "t");
    lua_remove(L, -2);
    bool failed = ferror(piece.stream) != 0;
    fclose(piece.stream);
    if (!failed)
        return status;
    lua_pop(L, 1);
    lua_pushfstring(L, "%s: cannot be read whole", path);
    return LUA_ERRFILE;
}

/* Reads the script's text; NULL if it cannot be read, or contains zeros. */
static char *script_text(const char *path)
{
    FILE *file = input_file_open(path, NULL);
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

void script_words_check(lua_State *L)
{
    struct script *script = script_of(L);
    bool all_asked = true;
    for (int i = 0; i < script->config->words_count; i++)
        all_asked = all_asked && script->asked[i];
    if (script->words_checked || all_asked ||
        script->config->trusted) /* a trusted script may read parameters in another file */
        return;
    script->words_checked = true;
    char *text = script_text(script->config->path), key[64] = "";
    for (int i = 0; text && i < script->config->words_count && !*key; i++) {
        char one[sizeof key];
        size_t length = strcspn(script->config->words[i], "=");
        if (script->asked[i] || length >= sizeof one)
            continue;
        snprintf(one, sizeof one, "%.*s", (int)length, script->config->words[i]);
        if (!strstr(text, one))
            strcpy(key, one);
    }
    free(text);
    if (*key)
        luaL_error(L, "the script asks for no '%s'", key);
}

/* pairs() visits text keys in sorted order, because Lua's order differs from run to run, and
 * pictures must not. */
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

const luaL_Reg script_sandbox_functions[] = {{"print", print}, {"param", param}, {NULL, NULL}};

void script_sandbox_open(lua_State *L)
{
    struct script *script = script_of(L);
    static const luaL_Reg libraries[] = {
        {LUA_GNAME, luaopen_base},       {LUA_COLIBNAME, luaopen_coroutine},
        {LUA_TABLIBNAME, luaopen_table}, {LUA_STRLIBNAME, luaopen_string},
        {LUA_MATHLIBNAME, luaopen_math}, {LUA_UTF8LIBNAME, luaopen_utf8}};
    static const char *const taken[] = {"dofile", "loadfile", "load", "collectgarbage",
                                        "next",   "require",  NULL};
    if (script->config->trusted)
        luaL_openlibs(L);
    else
        for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
            luaL_requiref(L, libraries[i].name, libraries[i].func, 1);
            lua_pop(L, 1);
        }
    if (luaL_loadbufferx(L, prelude, sizeof prelude - 1, "=prelude", "t") != LUA_OK)
        lua_error(L);
    lua_call(L, 0, 0);
    if (!script->config->trusted) {
        for (int i = 0; taken[i]; i++) {
            lua_pushnil(L);
            lua_setglobal(L, taken[i]);
        }
    }
    lua_getglobal(L, "math");
    lua_getfield(L, -1, "randomseed");
    lua_pushinteger(L, (lua_Integer)script->config->seed);
    lua_call(L, 1, 0);
    lua_pop(L, 1);
    script_lua_functions_open(L);
    script_hook_set(L);
}
