/* fuzz_sandbox.c - walks everything that a script reaches in its sandbox, and calls each
 * function with everything (security.md 1, 3).
 *
 *     fuzz_sandbox                  a walk, and some thousand calls, the same in every run
 *     fuzz_sandbox --seconds S SEED random calls for so long
 *
 * Reached are: globals; what tables hold; what calls return, and so iterators and new objects.
 * What C alone reaches (metatables, the upvalues of functions) is looked at, too: every
 * metatable that is not a script's own must be hidden, and no text may hold an address of this
 * process. Under ASan a call that trusts an argument is seen. */
#include "../../host/script/script_internal.h"

#include <lualib.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../display/scratch.h"
#include "../sample.h"

enum { CALLS = 12000, POOL_MAX = 700, ARGUMENTS_MAX = 5, MEMORY_BYTES = 64 << 20 };

/* Objects of each kind, coroutines of each state, functions that call back, close, fail and
 * yield. */
static const char prelude[] =
    "p = paper{width = 8, height = 8, pigments = {'cyan'}, model = {'infused'}} "
    "b = p:brush{width = 2, bristles = 4} m = rect(1, 1, 5, 5) g = m:soften(1) - 0.5 "
    "q = picture(3, 2, function() return 1, 0, 0.5 end) n = spring.network() n:mass{} "
    "w = spring.word{text = 'ab'} "
    "closed = paper{width = 8, height = 8} closed:close() "
    "fresh = coroutine.create(function(...) return coroutine.yield(...) end) "
    "halted = coroutine.create(function() local x <close> = setmetatable({}, {__close = "
    "function() coroutine.close(fresh) end}) coroutine.yield(p) end) coroutine.resume(halted) "
    "failed = coroutine.create(error) coroutine.resume(failed, 'x') "
    "dead = coroutine.create(function() end) coroutine.resume(dead) "
    "wrapped = coroutine.wrap(function(...) while true do coroutine.yield(p, m, ...) end end) "
    "words = ('a b c'):gmatch('%a') each, all, first = pairs{a = 1, b = m} one = ipairs{1} "
    "codes = utf8.codes('\\u{20ac}') "
    "function closes() p:close() return 0.5 end function fails() error(m) end "
    "function yields(...) return coroutine.yield(...) end function gives(...) return ... end "
    "odd = setmetatable({1, 2, x = 1}, {__index = closes, __len = function() return 1 << 20 "
    "end, "
    "  __tostring = function() return 'odd' end, __name = {}, __call = gives, __add = fails, "
    "  __lt = closes, __eq = fails, __concat = gives, __close = closes, __newindex = gives}) "
    "named = setmetatable({}, {__name = 'named', __mode = 'kv'}) "
    "points = {{1, 1}, {5, 5}, {2, 6}} amounts = {water = 0.1, cyan = 0.2} "
    "texts = {'', 'a', 'height', 'water', 'cyan', '%p%s%d', '%99d', '.*', 'M1 1L5 5', '\\0', "
    "  '../x', 'x.png', '#102030', 'n', 'lutetia paper', 'gravity', 'constant'} "
    "numbers = {0, -1, 1, 2, 3, 0.5, 7, 255, 1e300, -1e300, 0 / 0, 1 / 0, 1 << 20, true, "
    "false} ";

struct walk {
    struct script script;
    struct script_config config;
    lua_State *L;
    uint64_t random;
    long calls, metatables, functions;
    time_t until; /* 0: some thousand calls */
};

/* What a script reaches is kept in two lists of the registry: functions, and all else. */
static const char functions_key[] = "walk functions", values_key[] = "walk values",
                  seen_key[] = "walk seen";

static unsigned chance(struct walk *w, unsigned of)
{
    return (unsigned)(sample_word(&w->random) >> 33) % of;
}

_Noreturn static void found(const char *what, const char *detail)
{
    fprintf(stderr, "fuzz_sandbox: %s: %s\n", what, detail);
    abort();
}

/* Long numbers in hexadecimal digits: only an address looks so. */
static void text_check(const char *text, size_t length)
{
    for (size_t i = 0; i + 10 < length; i++)
        if (text[i] == '0' && text[i + 1] == 'x' &&
            strspn(text + i + 2, "0123456789abcdef") >= 8)
            found("an address is told", text);
}

/* Appends the value on the top to a list in the registry, in the place of another one if that
 * is full; pops it. */
static void list_add(struct walk *w, const char *key)
{
    lua_State *L = w->L;
    luaL_getsubtable(L, LUA_REGISTRYINDEX, key);
    const lua_Integer count = (lua_Integer)lua_rawlen(L, -1);
    lua_insert(L, -2);
    lua_rawseti(L, -2, count < POOL_MAX ? count + 1 : 1 + chance(w, POOL_MAX));
    lua_pop(L, 1);
}

/* Whether the object on the top is new. */
static bool is_new(lua_State *L)
{
    luaL_getsubtable(L, LUA_REGISTRYINDEX, seen_key);
    lua_pushvalue(L, -2);
    const bool known = lua_rawget(L, -2) != LUA_TNIL;
    lua_pop(L, 1);
    if (!known) {
        lua_pushvalue(L, -2);
        lua_pushboolean(L, 1);
        lua_rawset(L, -3);
    }
    lua_pop(L, 1);
    return !known;
}

static void reach(struct walk *w, int deep);

/* A metatable of C's makes itself known by its fields: all must be hidden from
 * getmetatable(). */
static void metatable_check(struct walk *w)
{
    lua_State *L = w->L;
    if (!lua_getmetatable(L, -1))
        return;
    w->metatables++;
    lua_pushliteral(L, "__metatable");
    const bool hidden = lua_rawget(L, -2) != LUA_TNIL && !lua_istable(L, -1);
    lua_pop(L, 1);
    bool of_c = lua_type(L, -2) != LUA_TTABLE;
    lua_pushnil(L);
    while (lua_next(L, -2)) {
        of_c = of_c || lua_iscfunction(L, -1);
        lua_pop(L, 1);
    }
    if (of_c && !hidden)
        found("a metatable is not hidden", luaL_typename(L, -2));
    lua_pop(L, 1);
}

/* Takes in the value on the top, and pops it. */
static void reach(struct walk *w, int deep)
{
    lua_State *L = w->L;
    if (deep > 6 || !lua_checkstack(L, 20)) {
        lua_pop(L, 1);
        return;
    }
    const int type = lua_type(L, -1);
    metatable_check(w);
    if (type == LUA_TSTRING)
        text_check(lua_tostring(L, -1), lua_rawlen(L, -1));
    if (type == LUA_TLIGHTUSERDATA)
        found("a pointer is reached", "light userdata");
    if (type == LUA_TNIL || (type > LUA_TSTRING && !is_new(L))) {
        lua_pop(L, 1);
        return;
    }
    if (type == LUA_TUSERDATA && luaL_getmetafield(L, -1, "methods") != LUA_TNIL)
        reach(w, deep + 1);
    if (type == LUA_TFUNCTION) {
        w->functions++;
        lua_pushvalue(L, -1);
        list_add(w, functions_key);
        for (int i = 1; lua_getupvalue(L, -1, i); i++) {
            if (lua_islightuserdata(L, -1)) /* a row of the library's, which C alone sees */
                lua_pop(L, 1);
            else if (lua_iscfunction(L, -2)) { /* its upvalues are C's own */
                metatable_check(w);
                lua_pop(L, 1);
            } else
                reach(w, deep + 1);
        }
    }
    if (type == LUA_TTABLE) {
        lua_pushnil(L);
        for (int i = 0; i < 400 && lua_next(L, -2); i++) {
            reach(w, deep + 1);
            lua_pushvalue(L, -1);
            reach(w, deep + 1);
            if (i == 399)
                lua_pop(L, 1);
        }
    }
    list_add(w, values_key);
}

/* Pushes a value by chance. */
static void value_push(struct walk *w, const char *key)
{
    lua_State *L = w->L;
    luaL_getsubtable(L, LUA_REGISTRYINDEX, key);
    lua_rawgeti(L, -1, 1 + chance(w, (unsigned)lua_rawlen(L, -1)));
    lua_remove(L, -2);
}

static void hook(lua_State *L, lua_Debug *event)
{
    (void)event;
    script_stop_if_due(L, 0);
}

/* Calls the function below the arguments, sometimes in a coroutine; takes in what it returns,
 * or its error. */
static void call(struct walk *w, int arguments)
{
    lua_State *L = w->L;
    const int base = lua_gettop(L) - arguments;
    w->calls++;
    w->script.deadline_s = script_clock_s() + 0.2;
    w->script.memory_short = false;
    w->config.memory_bytes = MEMORY_BYTES;
    lua_sethook(L, hook, LUA_MASKCOUNT, 1000);
    if (chance(w, 4) == 0) {
        w->config.memory_bytes = SIZE_MAX / 2;
        lua_State *other = lua_newthread(L);
        lua_insert(L, base);
        w->config.memory_bytes = MEMORY_BYTES;
        int results = 0;
        lua_xmove(L, other, arguments + 1);
        lua_sethook(other, hook, LUA_MASKCOUNT, 1000);
        const int status = lua_resume(other, L, arguments, &results);
        w->config.memory_bytes = SIZE_MAX / 2;
        if (status != LUA_OK && status != LUA_YIELD)
            results = 1;
        results = results < 20 ? results : 20;
        if (lua_checkstack(L, results))
            lua_xmove(other, L, results);
        while (lua_gettop(L) > base)
            reach(w, 0);
        lua_settop(L, base - 1);
        return;
    }
    lua_pcall(L, arguments, LUA_MULTRET, 0);
    w->config.memory_bytes = SIZE_MAX / 2; /* the walk itself is not protected */
    for (int i = 0; i < 20 && lua_gettop(L) >= base; i++)
        reach(w, 0);
    lua_settop(L, base - 1);
}

/* A count of C's loops that nothing can stop, as table.move's, is no fault of ours. */
static bool endless(lua_State *L, int function, int arguments)
{
    static const char *const names[] = {"move", "concat", "unpack", "rep"};
    bool is = false;
    for (size_t i = 0; i < sizeof names / sizeof *names && !is; i++) {
        lua_getglobal(L, i < 3 ? "table" : "string");
        if (lua_istable(L, -1)) {
            lua_pushstring(L, names[i]);
            lua_rawget(L, -2);
            is = lua_rawequal(L, -1, function);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    for (int i = 1; i <= arguments && is; i++)
        if (lua_isnumber(L, function + i) && lua_tonumber(L, function + i) > 1000)
            return true;
    return false;
}

static void call_by_chance(struct walk *w)
{
    lua_State *L = w->L;
    value_push(w, functions_key);
    const int arguments = (int)chance(w, 1 + ARGUMENTS_MAX), function = lua_gettop(L);
    for (int i = 0; i < arguments; i++)
        value_push(w, values_key);
    if (endless(L, function, arguments))
        lua_settop(L, function - 1);
    else
        call(w, arguments);
}

/* Every function with every value as its receiver. */
static void all_with_all(struct walk *w)
{
    lua_State *L = w->L;
    luaL_getsubtable(L, LUA_REGISTRYINDEX, functions_key);
    const lua_Integer functions = (lua_Integer)lua_rawlen(L, -1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, values_key);
    const lua_Integer values = (lua_Integer)lua_rawlen(L, -1);
    for (lua_Integer i = 1; i <= functions; i++)
        for (lua_Integer k = 1 + chance(w, 5); k <= values; k += 5) {
            lua_rawgeti(L, -2, i);
            lua_rawgeti(L, -2, k);
            const int function = lua_gettop(L) - 1;
            if (endless(L, function, 1))
                lua_pop(L, 2);
            else
                call(w, 1);
        }
    lua_pop(L, 2);
}

static int opened(lua_State *L)
{
    script_open(L);
    if (luaL_loadbufferx(L, prelude, sizeof prelude - 1, "=prelude", "t") != LUA_OK)
        return lua_error(L);
    lua_call(L, 0, 0);
    return 0;
}

/* In a call, as every script is: else a coroutine could resume or close the main thread, below
 * the walk's own feet. */
static int walk_run(lua_State *L)
{
    struct walk *w = lua_touserdata(L, 1);
    lua_settop(L, 0);
    lua_pushglobaltable(L);
    reach(w, 0);
    if (w->metatables < 10 || w->functions < 150)
        found("the walk reached too little", "");
    all_with_all(w);
    for (long i = 0; i < CALLS && (!w->until || time(NULL) < w->until); i++)
        call_by_chance(w);
    return 0;
}

static bool stop(void *context)
{
    (void)context;
    return false;
}

static void walked(uint64_t seed, time_t until)
{
    struct walk w = {
        .random = sample_mixed(seed), .until = until, .config = script_config_default("walk")};
    w.config.in_folder = w.config.out_folder = scratch_dir;
    const struct script_host host = {.interrupted = stop};
    struct script *script = &w.script;
    *script = (struct script){.config = &w.config,
                              .host = &host,
                              .began_s = script_clock_s(),
                              .stack_begin = __builtin_frame_address(0)};
    lua_State *L = w.L = lua_newstate(script_allocate, script);
    memcpy(lua_getextraspace(L), &script, sizeof script);
    lua_pushcfunction(L, opened);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK)
        found("the prelude failed", lua_tostring(L, -1));
    lua_pushcfunction(L, walk_run);
    lua_pushlightuserdata(L, &w);
    if (lua_pcall(L, 1, 0, 0) != LUA_OK)
        found("the walk failed", lua_tostring(L, -1));
    printf("seed %llu: %ld functions, %ld metatables, %ld calls\n", (unsigned long long)seed,
           w.functions, w.metatables, w.calls);
    fflush(stdout);
    script->over = true;
    script->deadline_s = 0;
    lua_close(L);
    if (script->memory_bytes != 0) {
        char bytes[32];
        snprintf(bytes, sizeof bytes, "%zu bytes", script->memory_bytes);
        found("memory is not given back", bytes);
    }
}

int main(int argc, char **argv)
{
    scratch_path("");
    if (argc == 4 && strcmp(argv[1], "--seconds") == 0) {
        const time_t until = time(NULL) + atol(argv[2]);
        for (uint64_t seed = strtoull(argv[3], NULL, 10); time(NULL) < until; seed++)
            walked(seed, until);
        return 0;
    }
    if (argc > 1) {
        fputs("usage: fuzz_sandbox [--seconds S SEED]\n", stderr);
        return 2;
    }
    walked(1, 0);
    return 0;
}
