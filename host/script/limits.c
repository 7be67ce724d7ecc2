/* limits.c - a script's limits: time, the host's wish to stop, and memory. */
#include "script_internal.h"

#include <resident.h>

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <time.h>

/* ---- time ---- */

static double clock_s(clockid_t clock)
{
    struct timespec now = {0};
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double script_clock_s(void)
{
    return clock_s(CLOCK_MONOTONIC);
}

void script_deadline_set(struct script *script, double seconds)
{
    script->deadline_s = clock_s(script->clock) + seconds;
}

static bool late(const struct script *script)
{
    return script->deadline_s > 0 && clock_s(script->clock) > script->deadline_s;
}

bool script_due(const struct script *script)
{
    return script_interrupted(script) || late(script);
}

/* Collects garbage, which may be what is too much: C's memory is not seen by Lua's
 * collector. */
static void overfull_check(lua_State *L, int level)
{
    struct script *script = script_of(L);
    if (!atomic_load(&script->watchdog.overfull))
        return;
    lua_gc(L, LUA_GCCOLLECT);
    malloc_trim(0);
    const double more = script_overfull_bytes(script);
    atomic_store(&script->watchdog.overfull, false);
    if (more <= 0)
        return;
    luaL_where(L, level);
    char text[128];
    snprintf(text, sizeof text, "not enough memory: %.0f MB more than %s allows (%.0f)",
             more * 1e-6, script_memory_limit(script),
             (double)script->config->memory_bytes * 1e-6);
    lua_pushstring(L, text);
    lua_concat(L, 2);
    lua_error(L);
}

void script_stop_if_due(lua_State *L, int level)
{
    const struct script *script = script_of(L);
    overfull_check(L, level);
    char text[96];
    if (script_interrupted(script))
        snprintf(text, sizeof text, "interrupted");
    else if (late(script)) /* asked once: it may become late between two questions */
        snprintf(text, sizeof text, "stopped after %g seconds%s", script->config->timeout_s,
                 script->answers ? ": an answer takes less"
                                 : "; --timeout says how long a script may take");
    else
        return;
    luaL_where(L, level);
    lua_pushstring(L, text);
    lua_concat(L, 2);
    lua_error(L);
}

void script_check(lua_State *L)
{
    script_stop_if_due(L, 1);
}

void script_check_row(lua_State *L, int row)
{
    if (row % 32 == 0)
        script_check(L);
}

static bool impatient(void *context)
{
    const struct script *script = context;
    return atomic_load(&script->watchdog.overfull) || script_due(script);
}

void script_patience_begin(struct script *script)
{
    script->before = patience_set((struct patience){impatient, script});
}

void script_patience_end(struct script *script)
{
    patience_set(script->before);
}

int script_fail(lua_State *L, const char *text)
{
    script_check(L);
    return luaL_error(L, "%s", text);
}

/* ---- memory ---- */

const char *script_memory_limit(const struct script *script)
{
    return script->answers ? "its limit" : "--memory";
}

/* What a process takes tells nothing of a map, which is a small part of it; nor under a
 * sanitizer, which keeps what is freed. Where nobody watches (a test's own state), it may be
 * anything. */
static bool process_tells(const struct script *script)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    (void)script;
    return false;
#else
    return !script->guest && script->host->overdue;
#endif
}

double script_overfull_bytes(const struct script *script)
{
    if (!process_tells(script))
        return -INFINITY;
    return resident_bytes() - (double)script->config->memory_bytes - SCRIPT_BESIDES_BYTES;
}

double script_memory_left(const struct script *script)
{
    return script->memory_bytes < script->config->memory_bytes
               ? (double)(script->config->memory_bytes - script->memory_bytes)
               : 0;
}

/* What is large must have its room beside all that the process takes already. */
static bool process_has_room(const struct script *script, double bytes)
{
    const double large_bytes = 1 << 20;
    return bytes < large_bytes || script_overfull_bytes(script) + bytes <= 0;
}

void script_memory_take(lua_State *L, double bytes, const char *what)
{
    struct script *script = script_of(L);
    bool fits = bytes >= 0 && bytes <= script_memory_left(script);
    bool room = process_has_room(script, bytes);
    if (!fits || !room) {
        lua_gc(L, LUA_GCCOLLECT); /* frees masks and sheets without references */
        malloc_trim(0);
        fits = bytes >= 0 && bytes <= script_memory_left(script);
        room = process_has_room(script, bytes);
    }
    if (!fits || !room) {
        char text[200], taken[80] = "";
        if (fits)
            snprintf(taken, sizeof taken, "%s has %.0f already, ",
                     script->papers_made ? "the process, with the papers' machine,"
                                         : "the process",
                     resident_bytes() * 1e-6);
        snprintf(text, sizeof text, "%.0f MB for %s, %sand %s allows %.0f in all", bytes * 1e-6,
                 what, taken, script_memory_limit(script),
                 (double)script->config->memory_bytes * 1e-6);
        luaL_error(L, "not enough memory: %s", text);
    }
    script->memory_bytes += (size_t)bytes;
}

void script_memory_machine(lua_State *L, const char *why)
{
    struct script *script = script_of(L);
    if (!script->driver_works && !process_has_room(script, SCRIPT_MACHINE_BYTES))
        luaL_error(L,
                   "not enough memory: %s, whose driver takes %d MB as it begins, and %s "
                   "allows %d in all",
                   why, (int)(SCRIPT_MACHINE_BYTES * 1e-6), script_memory_limit(script),
                   (int)((double)script->config->memory_bytes * 1e-6));
    script->driver_works = true;
}

void script_memory_give(struct script *script, double bytes)
{
    script->memory_bytes -= (size_t)bytes;
}

/* ---- memory for a while ---- */

struct hold {
    struct script *script;
    double bytes;
};

static const char hold_type[] = "lutetia hold";

static int hold_end(lua_State *L)
{
    struct hold *hold = luaL_checkudata(L, 1, hold_type);
    script_memory_give(hold->script, hold->bytes);
    hold->bytes = 0;
    return 0;
}

void script_memory_hold(lua_State *L, double bytes, const char *what)
{
    struct hold *hold = lua_newuserdatauv(L, sizeof *hold, 0);
    *hold = (struct hold){.script = script_of(L)};
    luaL_setmetatable(L, hold_type);
    script_memory_take(L, bytes, what);
    hold->bytes = bytes;
}

void script_memory_release(lua_State *L, int index)
{
    struct hold *hold = luaL_checkudata(L, index, hold_type);
    script_memory_give(hold->script, hold->bytes);
    hold->bytes = 0;
}

void script_limits_open(lua_State *L)
{
    script_type_open(L, hold_type, hold_end);
}
