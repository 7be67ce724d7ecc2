/* springs_machine.c - a script's network stepped by a program in C/Paris: n:machine(). */
#include "script_springs.h"

#include <dyn_machine.h>

/* WORK_BYTES: of each mass and spring, its fields and the front end's copies of them. */
enum { STEPS_AT_ONCE = 100 /* between looks at the limits */, STEPS_MOST = 1000000 };
enum { WORK_BYTES = 800 };

static const char running_type[] = "lutetia springs on the machine";

static int running_gc(lua_State *L)
{
    struct dyn_machine **running = luaL_checkudata(L, 1, running_type);
    dyn_machine_destroy(*running);
    *running = NULL;
    return 0;
}

static void can_run(lua_State *L, const struct script_network *s)
{
    if (s->clamps)
        luaL_error(L, "the machine leads no masses along keys: n:step() does");
    if (s->collide)
        luaL_error(L, "the machine keeps no letters apart: n:step() does");
}

/* n:machine([count [, seconds]]): as n:step(), on the machine. After an error the network is as
 * it was. */
static int network_machine(lua_State *L)
{
    lua_settop(L, 3);
    struct script_network *s = script_network_at(L, 1);
    long count = script_arg_count(L, 2, "the count of steps", 1, 0, STEPS_MOST);
    double dt = lua_isnil(L, 3) ? 1.0 / 240 : script_arg_at(L, 3, "a step's seconds", 1e-9, 1);
    can_run(L, s);
    struct dyn_machine **running = lua_newuserdatauv(L, sizeof(struct dyn_machine *), 0);
    *running = NULL;
    luaL_setmetatable(L, running_type);
    script_memory_machine(L, "the machine makes these steps");
    script_memory_hold(
        L, (double)WORK_BYTES * (dyn_masses_count(s->network) + dyn_springs_count(s->network)),
        "springs on the machine");
    script_dyn_check(L, dyn_machine_create(s->network, dt, running));
    for (; count > 0; count -= STEPS_AT_ONCE) {
        script_check(L);
        script_dyn_check(
            L, dyn_machine_step(*running, count < STEPS_AT_ONCE ? (int)count : STEPS_AT_ONCE));
        script_dyn_check(L, dyn_machine_finish(*running));
    }
    script_dyn_check(L, dyn_machine_read(*running, s->network));
    dyn_machine_destroy(*running);
    *running = NULL;
    script_memory_release(L, lua_gettop(L));
    return 0;
}

const luaL_Reg script_network_machine_methods[] = {{"machine", network_machine}, {NULL, NULL}};

void script_springs_machine_open(lua_State *L)
{
    script_type_open(L, running_type, running_gc);
}
