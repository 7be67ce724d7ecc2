/* map.c - see script_map.h. */
#include "script_map.h"

#include "script_internal.h"

#include <midi_fine.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An answer computes no longer, nor does the file's reading, however busy the computer is; and
 * all of the map takes no more memory. */
static const double answer_s = 0.1;
/* A map that is cut off ends the performance, so it gets longer than a script: one call of C
 * with much memory may take some seconds on a busy computer. */
static const double grace_s = 10;
static const size_t memory_bytes = (size_t)64 << 20;

struct script_map {
    struct script script;
    struct script_config config;
    struct script_host host;
    struct script_map_def def;
    lua_State *L;
    struct midi_fine fine;
    bool frames, hears, hears_osc; /* there is a function `frame`, `message`, `osc` */
};

static struct script_map *map_of(lua_State *L)
{
    return script_of(L)->host->context;
}

/* ---- what a map reaches ---- */

static void refuse(lua_State *L, const char *why)
{
    if (why)
        luaL_error(L, "%s", why);
}

/* set(control, value): a number, true or false, or a choice by its name */
static int map_set(lua_State *L)
{
    const struct script_map *map = map_of(L);
    const char *name = luaL_checkstring(L, 1);
    char text[64];
    if (lua_type(L, 2) == LUA_TBOOLEAN)
        snprintf(text, sizeof text, "%s", lua_toboolean(L, 2) ? "on" : "off");
    else if (lua_type(L, 2) == LUA_TNUMBER)
        snprintf(text, sizeof text, "%.17g", lua_tonumber(L, 2));
    else
        snprintf(text, sizeof text, "%s", luaL_checkstring(L, 2));
    refuse(L, map->def.set(map->def.context, name, text));
    return 0;
}

/* along(control, part): as far along its range as a slider would be, 0..1 */
static int map_along(lua_State *L)
{
    const struct script_map *map = map_of(L);
    const char *name = luaL_checkstring(L, 1);
    refuse(L, map->def.along(map->def.context, name,
                             script_arg_at(L, 2, "how far along it is", 0, 1)));
    return 0;
}

/* get(control): a number */
static int map_get(lua_State *L)
{
    const struct script_map *map = map_of(L);
    double value = 0;
    refuse(L, map->def.get(map->def.context, luaL_checkstring(L, 1), &value));
    lua_pushnumber(L, value);
    return 1;
}

/* text(words): other words on the stage */
static int map_text(lua_State *L)
{
    const struct script_map *map = map_of(L);
    const char *words = luaL_checkstring(L, 1);
    if (!map->def.text)
        return luaL_error(L, "there are no words to change here");
    refuse(L, map->def.text(map->def.context, words));
    return 0;
}

/* beat(): the part of the quarter note that has gone, and quarter notes in a minute; nil where
 * no clock runs */
static int map_beat(lua_State *L)
{
    const struct script_map *map = map_of(L);
    double phase, per_minute;
    if (!map->def.beat || !map->def.beat(map->def.context, &phase, &per_minute)) {
        lua_pushnil(L);
        return 1;
    }
    lua_pushnumber(L, phase);
    lua_pushnumber(L, per_minute);
    return 2;
}

/* send(address, ...): numbers, texts, true and false */
static int map_send(lua_State *L)
{
    const struct script_map *map = map_of(L);
    struct script_map_argument arguments[SCRIPT_MAP_ARGUMENTS];
    const char *address = luaL_checkstring(L, 1);
    const int count = lua_gettop(L) - 1;
    if (!map->def.send)
        return luaL_error(L, "nobody is sent to: --osc-to ADDRESS:PORT");
    if (count > SCRIPT_MAP_ARGUMENTS)
        return luaL_error(L, "a message has at most %d arguments", SCRIPT_MAP_ARGUMENTS);
    for (int i = 0; i < count; i++) {
        arguments[i] = (struct script_map_argument){0};
        if (lua_type(L, i + 2) == LUA_TSTRING)
            arguments[i].text = lua_tostring(L, i + 2);
        else if (lua_type(L, i + 2) == LUA_TBOOLEAN)
            arguments[i].number = lua_toboolean(L, i + 2);
        else
            arguments[i].number = luaL_checknumber(L, i + 2);
    }
    refuse(L, map->def.send(map->def.context, address, arguments, count));
    return 0;
}

static const luaL_Reg functions[] = {
    {"set", map_set},   {"along", map_along}, {"get", map_get}, {"text", map_text},
    {"beat", map_beat}, {"send", map_send},   {NULL, NULL}};

/* ---- what a map is told ---- */

static void host_print(void *context, const char *text, size_t length)
{
    const struct script_map *map = context;
    char line[300];
    snprintf(line, sizeof line, "%.*s",
             (int)(length && text[length - 1] == '\n' ? length - 1 : length), text);
    map->def.tell(map->def.context, line);
}

static void host_error(void *context, const char *text)
{
    const struct script_map *map = context;
    map->def.tell(map->def.context, text);
}

static void host_overdue(void *context)
{
    const struct script_map *map = context;
    map->def.overdue(map->def.context);
}

/* ---- a map ---- */

/* Calls with an answer's time; what is on the stack is popped. */
static bool answer(struct script_map *map, lua_CFunction function, void *argument)
{
    if (pthread_getcpuclockid(pthread_self(), &map->script.clock) != 0)
        map->script.clock = CLOCK_MONOTONIC;
    return script_answers_call(map->L, function, argument, answer_s);
}

static int open_protected(lua_State *L)
{
    struct script_map *map = lua_touserdata(L, 1);
    script_sandbox_open(L);
    lua_pushglobaltable(L);
    script_functions_set(L, script_sandbox_functions);
    script_functions_set(L, functions);
    lua_settop(L, 0);
    if (script_load(L, map->config.path) != LUA_OK)
        lua_error(L);
    lua_call(L, 0, 0);
    map->frames = lua_getglobal(L, "frame") == LUA_TFUNCTION;
    map->hears_osc = lua_getglobal(L, "osc") == LUA_TFUNCTION;
    const int message = lua_getglobal(L, "message");
    map->hears = message == LUA_TFUNCTION;
    if (message != LUA_TFUNCTION && (message != LUA_TNIL || !(map->frames || map->hears_osc)))
        luaL_error(L, "%s: a map has a function message(m), osc(address, ...) or frame(time)",
                   map->config.path);
    return 0;
}

struct message_call {
    struct midi_message message;
    struct midi_fine_value fine;
    bool is_fine;
};

static int message_protected(lua_State *L)
{
    const struct message_call *c = lua_touserdata(L, 1);
    if (lua_getglobal(L, "message") == LUA_TFUNCTION) {
        script_midi_push(L, &c->message);
        if (c->is_fine) {
            lua_pushnumber(L, c->fine.value / (double)MIDI_FINE_MOST);
            lua_setfield(L, -2, "fine");
        }
        if (c->is_fine && c->fine.is_parameter) {
            lua_pushinteger(L, c->fine.number);
            lua_setfield(L, -2, "nrpn");
        }
        lua_call(L, 1, 0);
    }
    return 0;
}

static int frame_protected(lua_State *L)
{
    const double *time_s = lua_touserdata(L, 1);
    if (lua_getglobal(L, "frame") == LUA_TFUNCTION) {
        lua_pushnumber(L, *time_s);
        lua_call(L, 1, 0);
    }
    return 0;
}

bool script_map_message(struct script_map *map, const struct midi_message *m)
{
    struct message_call call = {.message = *m};
    call.is_fine = midi_fine_take(&map->fine, m, &call.fine);
    return answer(map, message_protected, &call);
}

bool script_map_hears(const struct script_map *map)
{
    return map->hears;
}

bool script_map_hears_osc(const struct script_map *map)
{
    return map->hears_osc;
}

struct osc_call {
    const char *address;
    const struct script_map_argument *arguments;
    int count;
};

static int osc_protected(lua_State *L)
{
    const struct osc_call *c = lua_touserdata(L, 1);
    if (lua_getglobal(L, "osc") != LUA_TFUNCTION)
        return 0;
    luaL_checkstack(L, c->count + 2, "arguments");
    lua_pushstring(L, c->address);
    for (int i = 0; i < c->count; i++)
        if (c->arguments[i].text)
            lua_pushstring(L, c->arguments[i].text);
        else
            lua_pushnumber(L, c->arguments[i].number);
    lua_call(L, c->count + 1, 0);
    return 0;
}

bool script_map_osc(struct script_map *map, const char *address,
                    const struct script_map_argument *arguments, int count)
{
    struct osc_call call = {address, arguments, count};
    return map->hears_osc && answer(map, osc_protected, &call);
}

bool script_map_leads(const struct script_map *map)
{
    return map->frames;
}

bool script_map_frame(struct script_map *map, double time_s)
{
    return !map->frames || answer(map, frame_protected, &time_s);
}

static enum script_status words_end(const struct script_map *map)
{
    char line[400];
    for (int i = 0; i < map->config.words_count; i++)
        if (!map->script.asked[i]) {
            snprintf(line, sizeof line, "%s asked for no '%.*s'", map->config.path,
                     (int)strcspn(map->config.words[i], "="), map->config.words[i]);
            map->def.tell(map->def.context, line);
            return SCRIPT_FAILED;
        }
    return SCRIPT_OK;
}

static void map_configure(struct script_map *map, const struct script_map_def *def)
{
    map->def = *def;
    map->config = script_config_default(def->path);
    map->config.timeout_s = answer_s;
    map->config.grace_s = grace_s;
    map->config.memory_bytes = memory_bytes;
    map->config.words = def->words;
    map->config.words_count = def->words_count;
    map->host = (struct script_host){.context = map, .print = host_print, .error = host_error};
    if (def->overdue)
        map->host.overdue = host_overdue;
    map->script = (struct script){.config = &map->config,
                                  .host = &map->host,
                                  .began_s = script_clock_s(),
                                  .clock = CLOCK_MONOTONIC,
                                  .answers = true,
                                  .guest = true};
}

enum script_status script_map_open(const struct script_map_def *def, struct script_map **out)
{
    *out = NULL;
    struct script_map *map = calloc(1, sizeof *map);
    if (!map || def->words_count > SCRIPT_WORDS_MAX) {
        def->tell(def->context, map ? "too many key=value for a map" : "no memory for a map");
        free(map);
        return SCRIPT_FAILED;
    }
    map_configure(map, def);
    map->L = script_answers_open(&map->script);
    bool good = false;
    if (map->L)
        good = answer(map, open_protected, map) && words_end(map) == SCRIPT_OK;
    else
        def->tell(def->context, "no memory for a map");
    if (!good) {
        script_map_close(map);
        return SCRIPT_FAILED;
    }
    *out = map;
    return SCRIPT_OK;
}

void script_map_close(struct script_map *map)
{
    if (!map)
        return;
    script_answers_close(&map->script, map->L);
    free(map);
}
