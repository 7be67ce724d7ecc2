/* springs.c - networks of masses and springs in scripts: spring.network(), and methods for
 * networks of words, too.
 *
 * Masses, springs, letters and words are numbered from 1.
 */
#include "script_springs.h"

#include <collide.h>
#include <energy.h>
#include <events.h>
#include <fields.h>
#include <hand.h>
#include <network_file.h>
#include <step.h>

#include <stdlib.h>
#include <string.h>

/* Bytes for each mass and spring, with their copies for steps; for a network, a font as it is
 * open, and what draws letters. */
enum {
    MASS_BYTES = 300,
    SPRING_BYTES = 200,
    NETWORK_BYTES = 4096,
    FONT_BYTES = 900000,
    PAINTER_BYTES = 160000,
    STEPS_MOST = 1000000
};

void script_dyn_check(lua_State *L, enum dyn_status status)
{
    if (status != DYN_OK)
        script_fail(L, dyn_error());
}

static int network_gc(lua_State *L)
{
    struct script_network *s = luaL_checkudata(L, 1, script_network_type);
    for (int i = 0; i < s->words_count; i++)
        dyn_word_destroy(s->words[i]);
    for (int i = 0; i < s->fonts_count; i++) {
        font_shaper_destroy(s->fonts[i].shaper);
        font_face_close(s->fonts[i].face);
    }
    font_painter_destroy(s->painter);
    dyn_clamps_destroy(s->clamps);
    dyn_network_destroy(s->network);
    script_memory_give(s->script, s->bytes + s->keys_bytes);
    *s = (struct script_network){.script = s->script};
    return 0;
}

struct script_network *script_network_new(lua_State *L)
{
    struct script_network *s = lua_newuserdatauv(L, sizeof *s, 1);
    *s = (struct script_network){.script = script_of(L)};
    luaL_setmetatable(L, script_network_type);
    script_memory_take(L, NETWORK_BYTES, "a network");
    s->bytes = NETWORK_BYTES;
    script_dyn_check(L, dyn_network_create(&s->network));
    return s;
}

struct script_network *script_network_at(lua_State *L, int index)
{
    struct script_network *s = luaL_checkudata(L, index, script_network_type);
    if (!s->network)
        luaL_error(L, "this network is gone");
    return s;
}

static void more_take(lua_State *L, struct script_network *s, double bytes, const char *what)
{
    script_memory_take(L, bytes, what);
    s->bytes += bytes;
    s->besides_bytes += bytes;
}

void script_network_font_take(lua_State *L, struct script_network *s)
{
    more_take(L, s, FONT_BYTES, "a font");
}

void script_network_painter_take(lua_State *L, struct script_network *s)
{
    more_take(L, s, PAINTER_BYTES, "letters");
}

void script_network_count(lua_State *L, struct script_network *s)
{
    double bytes = NETWORK_BYTES + s->besides_bytes +
                   (double)MASS_BYTES * dyn_masses_count(s->network) +
                   (double)SPRING_BYTES * dyn_springs_count(s->network);
    if (bytes > s->bytes)
        script_memory_take(L, bytes - s->bytes, "a network");
    else
        script_memory_give(s->script, s->bytes - bytes);
    s->bytes = bytes;
}

/* ---- numbers ---- */

int script_network_mass_at(lua_State *L, const struct script_network *s, int index)
{
    return script_arg_index(L, index, "a mass's number", dyn_masses_count(s->network));
}

static int spring_at(lua_State *L, const struct script_network *s, int index)
{
    return script_arg_index(L, index, "a spring's number", dyn_springs_count(s->network));
}

static double place_at(lua_State *L, int index, const char *what)
{
    return script_arg_at(L, index, what, -1e6, 1e6);
}

double script_control_pop(lua_State *L, const struct control *control)
{
    double value = 0;
    switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
        value = lua_tonumber(L, -1);
        script_dyn_check(L, dyn_control_check(control, value));
        break;
    case LUA_TBOOLEAN:
        value = lua_toboolean(L, -1);
        script_dyn_check(L, dyn_control_check(control, value));
        break;
    case LUA_TSTRING:
        script_dyn_check(L, dyn_control_parse(control, lua_tostring(L, -1), &value));
        break;
    default:
        luaL_error(L, "%s must be a number, a text or a boolean (got a %s)", control->name,
                   luaL_typename(L, -1));
    }
    lua_pop(L, 1);
    return value;
}

static const struct control *style_find(const char *name)
{
    for (int i = 0; i < dyn_word_controls_count; i++)
        if (strcmp(dyn_word_controls[i].name, name) == 0)
            return &dyn_word_controls[i];
    return NULL;
}

void script_network_set(lua_State *L, struct script_network *s, const char *name, int index)
{
    const struct control *of_style = style_find(name);
    const struct control *control = of_style ? of_style : dyn_control_find(name);
    if (!control)
        script_fail(L, dyn_error());
    lua_pushvalue(L, index);
    double value = script_control_pop(L, control);
    if (!of_style) {
        struct dyn_world world = *dyn_network_world(s->network);
        script_dyn_check(L, dyn_control_write(control, &world, value));
        script_dyn_check(L, dyn_network_world_set(s->network, &world));
        return;
    }
    for (int i = 0; i < s->words_count; i++) {
        struct dyn_word_style style = dyn_word_style_get(s->words[i]);
        script_dyn_check(L, dyn_control_write(control, &style, value));
        script_dyn_check(L, dyn_word_style_set(s->words[i], s->network, &style));
    }
}

/* ---- making ---- */

/* spring.network(["file.springs"]) */
static int make_network(lua_State *L)
{
    lua_settop(L, 1);
    const char *path = NULL;
    if (!lua_isnil(L, 1))
        path =
            script_path(L, script_of(L)->config->in_folder, luaL_checkstring(L, 1), "network");
    struct script_network *s = script_network_new(L);
    if (path) {
        struct dyn_network *read;
        script_dyn_check(L, dyn_network_read(path, &read));
        dyn_network_destroy(s->network);
        s->network = read;
        script_network_count(L, s);
    }
    return 1;
}

/* Reads the fields that a copied table of options at index has. */
static void fields_read(lua_State *L, int index, const struct control *fields, int count,
                        void *of)
{
    for (int i = 0; i < count; i++) {
        lua_pushstring(L, fields[i].name);
        if (lua_rawget(L, index) == LUA_TNIL) {
            lua_pop(L, 1);
            continue;
        }
        script_dyn_check(L,
                         dyn_control_write(&fields[i], of, script_control_pop(L, &fields[i])));
    }
}

/* n:mass{x =, y =, mass =, …, stuck = true} */
static int network_mass(lua_State *L)
{
    static const char *const keys[] = {"x",        "y",     "vx",      "vy",
                                       "mass",     "drag",  "gravity", "restitution",
                                       "friction", "stuck", NULL};
    lua_settop(L, 2);
    struct script_network *s = script_network_at(L, 1);
    script_arg_options(L, 2, "mass", keys);
    struct dyn_mass mass = dyn_mass_usual();
    fields_read(L, 2, dyn_mass_fields, dyn_mass_fields_count, &mass);
    mass.hold = script_arg_boolean(L, 2, "mass", "stuck", false) ? DYN_STUCK : DYN_FREE;
    int index;
    script_dyn_check(L, dyn_mass_add(s->network, &mass, &index));
    script_network_count(L, s);
    lua_pushinteger(L, index + 1);
    return 1;
}

/* n:spring(a, b [, {constant =, rest_length =, damping =, breaking_strain =}]) */
static int network_spring(lua_State *L)
{
    static const char *const keys[] = {"constant", "rest_length", "damping", "breaking_strain",
                                       NULL};
    lua_settop(L, 4);
    struct script_network *s = script_network_at(L, 1);
    struct dyn_spring spring = dyn_spring_usual();
    for (int i = 0; i < 2; i++)
        spring.end[i] = script_network_mass_at(L, s, 2 + i);
    if (spring.end[0] == spring.end[1])
        luaL_error(L, "a spring cannot go from mass %d to itself", spring.end[0] + 1);
    script_arg_options(L, 4, "spring", keys);
    fields_read(L, 4, dyn_spring_fields, dyn_spring_fields_count, &spring);
    int index;
    script_dyn_check(L, dyn_spring_add(s->network, &spring, &index));
    script_network_count(L, s);
    lua_pushinteger(L, index + 1);
    return 1;
}

/* ---- looking ---- */

/* n:place(mass): x, y, vx, vy */
static int network_place(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    const struct dyn_state *state =
        &dyn_network_states(s->network)[script_network_mass_at(L, s, 2)];
    lua_pushnumber(L, state->x);
    lua_pushnumber(L, state->y);
    lua_pushnumber(L, state->vx);
    lua_pushnumber(L, state->vy);
    return 4;
}

/* n:masses(), n:springs() */
static int network_masses(lua_State *L)
{
    lua_pushinteger(L, dyn_masses_count(script_network_at(L, 1)->network));
    return 1;
}

static int network_springs(lua_State *L)
{
    lua_pushinteger(L, dyn_springs_count(script_network_at(L, 1)->network));
    return 1;
}

/* n:ends(spring): its masses, whether it is unbroken, its strain */
static int network_ends(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    int index = spring_at(L, s, 2);
    struct dyn_spring spring = dyn_spring_get(s->network, index);
    lua_pushinteger(L, spring.end[0] + 1);
    lua_pushinteger(L, spring.end[1] + 1);
    lua_pushboolean(L, !spring.broken);
    lua_pushnumber(L, dyn_spring_strain(s->network, index));
    return 4;
}

/* n:nearest(x, y [, within]): a mass's number, or nil */
static int network_nearest(lua_State *L)
{
    lua_settop(L, 4);
    const struct script_network *s = script_network_at(L, 1);
    double x = place_at(L, 2, "nearest's x"), y = place_at(L, 3, "nearest's y");
    double within = lua_isnil(L, 4) ? 1e6 : script_arg_at(L, 4, "nearest's distance", 0, 1e6);
    int mass = dyn_network_nearest(s->network, x, y, within);
    if (mass < 0)
        lua_pushnil(L);
    else
        lua_pushinteger(L, mass + 1);
    return 1;
}

static int network_time(lua_State *L)
{
    lua_pushnumber(L, dyn_network_time_s(script_network_at(L, 1)->network));
    return 1;
}

/* n:energy(): {motion =, gravity =, springs =, pulls =} */
static int network_energy(lua_State *L)
{
    struct dyn_energy e = dyn_network_energy(script_network_at(L, 1)->network);
    lua_createtable(L, 0, 4);
    lua_pushnumber(L, e.motion);
    lua_setfield(L, -2, "motion");
    lua_pushnumber(L, e.gravity);
    lua_setfield(L, -2, "gravity");
    lua_pushnumber(L, e.springs);
    lua_setfield(L, -2, "springs");
    lua_pushnumber(L, e.pulls);
    lua_setfield(L, -2, "pulls");
    return 1;
}

/* n:save("file.springs") */
static int network_save(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    const char *path = script_path_to_write(L, luaL_checkstring(L, 2), ".springs", "network");
    script_dyn_check(L, dyn_network_write(s->network, path));
    script_wrote_tell(script_of(L), path);
    return 0;
}

/* ---- changing ---- */

/* n:set(control, value) */
static int network_set(lua_State *L)
{
    lua_settop(L, 3);
    script_network_set(L, script_network_at(L, 1), luaL_checkstring(L, 2), 3);
    return 0;
}

/* n:get(control): of the world */
static int network_get(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    const struct control *control = dyn_control_find(luaL_checkstring(L, 2));
    if (!control)
        script_fail(L, dyn_error());
    lua_pushnumber(L, control_read(control, dyn_network_world(s->network)));
    return 1;
}

/* n:set_mass(number or nil, field, value): one mass or all; n:set_spring likewise */
static int network_set_mass(lua_State *L)
{
    lua_settop(L, 4);
    const struct script_network *s = script_network_at(L, 1);
    int index = lua_isnil(L, 2) ? DYN_ALL : script_network_mass_at(L, s, 2);
    const struct control *field = dyn_mass_field_find(luaL_checkstring(L, 3));
    if (!field)
        script_fail(L, dyn_error());
    script_dyn_check(L, dyn_mass_write(s->network, index, field, script_control_pop(L, field)));
    return 0;
}

static int network_set_spring(lua_State *L)
{
    lua_settop(L, 4);
    const struct script_network *s = script_network_at(L, 1);
    int index = lua_isnil(L, 2) ? DYN_ALL : spring_at(L, s, 2);
    const struct control *field = dyn_spring_field_find(luaL_checkstring(L, 3));
    if (!field)
        script_fail(L, dyn_error());
    script_dyn_check(L,
                     dyn_spring_write(s->network, index, field, script_control_pop(L, field)));
    return 0;
}

/* n:hold(mass, x, y), n:clamp(mass, x, y) */
static int network_hold(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    script_dyn_check(L, dyn_mass_hold(s->network, mass, place_at(L, 3, "hold's x"),
                                      place_at(L, 4, "hold's y")));
    return 0;
}

static int network_clamp(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    script_dyn_check(L, dyn_mass_clamp(s->network, mass, place_at(L, 3, "clamp's x"),
                                       place_at(L, 4, "clamp's y")));
    return 0;
}

/* n:release(mass): removes what holds or pulls it */
static int network_release(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    script_dyn_check(L, dyn_mass_release(s->network, mass));
    script_dyn_check(L, dyn_pull_end(s->network, mass));
    return 0;
}

static int network_tack(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    script_dyn_check(L, dyn_mass_tack(s->network, script_network_mass_at(L, s, 2)));
    return 0;
}

static int network_untack(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    script_dyn_check(L, dyn_mass_untack(s->network, script_network_mass_at(L, s, 2)));
    return 0;
}

/* n:pull(mass, x, y [, constant]) */
static int network_pull(lua_State *L)
{
    lua_settop(L, 5);
    const struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    double x = place_at(L, 3, "pull's x"), y = place_at(L, 4, "pull's y");
    double constant = lua_isnil(L, 5) ? 200 : script_arg_at(L, 5, "pull's constant", 0, 1e9);
    script_dyn_check(L, dyn_pull_begin(s->network, mass, x, y, constant));
    return 0;
}

/* n:cut(spring), or n:cut(x0, y0, x1, y1): along a line; returns how many springs were cut */
static int network_cut(lua_State *L)
{
    lua_settop(L, 5);
    const struct script_network *s = script_network_at(L, 1);
    int cut = 1;
    if (lua_isnil(L, 3)) {
        int spring = spring_at(L, s, 2);
        cut = !dyn_spring_get(s->network, spring).broken;
        script_dyn_check(L, dyn_spring_cut(s->network, spring));
    } else {
        double at[4];
        for (int i = 0; i < 4; i++)
            at[i] = place_at(L, 2 + i, "cut's place");
        script_dyn_check(L, dyn_network_cut(s->network, at[0], at[1], at[2], at[3], &cut));
    }
    lua_pushinteger(L, cut);
    return 1;
}

/* n:pluck(spring, speed) */
static int network_pluck(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    int spring = spring_at(L, s, 2);
    script_dyn_check(L, dyn_spring_pluck(s->network, spring,
                                         script_arg_at(L, 3, "pluck's speed", -1e4, 1e4)));
    return 0;
}

/* n:collide(true): letters push each other apart from now on */
static int network_collide(lua_State *L)
{
    struct script_network *s = script_network_at(L, 1);
    luaL_checktype(L, 2, LUA_TBOOLEAN);
    s->collide = lua_toboolean(L, 2);
    return 0;
}

/* ---- time ---- */

static void event_push(lua_State *L, const struct dyn_event *e)
{
    lua_createtable(L, 0, 8);
    lua_pushstring(L, dyn_event_name(e->kind));
    lua_setfield(L, -2, "kind");
    lua_pushnumber(L, e->time_s);
    lua_setfield(L, -2, "time");
    lua_pushnumber(L, e->strength);
    lua_setfield(L, -2, "strength");
    lua_pushnumber(L, e->x);
    lua_setfield(L, -2, "x");
    lua_pushnumber(L, e->y);
    lua_setfield(L, -2, "y");
    if (e->mass >= 0) {
        lua_pushinteger(L, e->mass + 1);
        lua_setfield(L, -2, "mass");
    }
    if (e->spring >= 0) {
        lua_pushinteger(L, e->spring + 1);
        lua_setfield(L, -2, "spring");
    }
    if (e->kind == DYN_CLANK) {
        lua_pushinteger(L, dyn_clank_velocity(e->strength));
        lua_setfield(L, -2, "velocity");
    }
}

/* n:events(): all waiting events, oldest first */
static int network_events(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    struct dyn_event event;
    lua_newtable(L);
    for (int i = 1; dyn_events_take(s->network, &event, 1); i++) {
        event_push(L, &event);
        lua_rawseti(L, -2, i);
    }
    return 1;
}

/* n:on(function(event) … end): called for each event of later steps; nil: no function */
static int network_on(lua_State *L)
{
    lua_settop(L, 2);
    script_network_at(L, 1);
    if (!lua_isnil(L, 2))
        luaL_checktype(L, 2, LUA_TFUNCTION);
    lua_setiuservalue(L, 1, 1);
    return 0;
}

/* Passes the waiting events to the function at index. */
static void events_tell(lua_State *L, struct script_network *s, int index)
{
    struct dyn_event event;
    while (s->network && dyn_events_take(s->network, &event, 1)) {
        lua_pushvalue(L, index);
        event_push(L, &event);
        script_callback(L, 1, 0);
    }
}

/* n:step([count [, seconds]]): that many steps of that length (1 of 1/240 s) */
static int network_step(lua_State *L)
{
    lua_settop(L, 3);
    struct script_network *s = script_network_at(L, 1);
    long count = script_arg_count(L, 2, "the count of steps", 1, 0, STEPS_MOST);
    double dt = lua_isnil(L, 3) ? 1.0 / 240 : script_arg_at(L, 3, "a step's seconds", 1e-9, 1);
    bool told = lua_getiuservalue(L, 1, 1) == LUA_TFUNCTION;
    for (; count > 0; count--) {
        script_check(L);
        script_dyn_check(L, s->clamps ? dyn_clamps_step(s->clamps, s->network, dt, 1)
                                      : dyn_network_step(s->network, dt, 1));
        if (s->collide)
            script_dyn_check(L, dyn_words_collide(s->network,
                                                  (const struct dyn_word *const *)s->words,
                                                  s->words_count, NULL));
        if (told)
            events_tell(L, s, 4);
    }
    return 0;
}

const luaL_Reg script_spring_makers[] = {{"network", make_network}, {NULL, NULL}};

const luaL_Reg script_network_methods[] = {{"mass", network_mass},
                                           {"spring", network_spring},
                                           {"place", network_place},
                                           {"masses", network_masses},
                                           {"springs", network_springs},
                                           {"ends", network_ends},
                                           {"nearest", network_nearest},
                                           {"time", network_time},
                                           {"energy", network_energy},
                                           {"save", network_save},
                                           {"set", network_set},
                                           {"get", network_get},
                                           {"set_mass", network_set_mass},
                                           {"set_spring", network_set_spring},
                                           {"hold", network_hold},
                                           {"clamp", network_clamp},
                                           {"release", network_release},
                                           {"tack", network_tack},
                                           {"untack", network_untack},
                                           {"pull", network_pull},
                                           {"cut", network_cut},
                                           {"pluck", network_pluck},
                                           {"collide", network_collide},
                                           {"events", network_events},
                                           {"on", network_on},
                                           {"step", network_step},
                                           {NULL, NULL}};

/* The functions are in the global table `spring`. */
void script_springs_open(lua_State *L)
{
    script_type_open(L, script_network_type, network_gc);
    script_type_open(L, script_spring_type, NULL);
    luaL_getmetatable(L, script_spring_type);
    lua_getfield(L, -1, "methods");
    lua_setglobal(L, "spring");
    lua_pop(L, 1);
}
