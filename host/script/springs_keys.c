/* springs_keys.c - keyframes of masses in scripts: n:key(), n:free(), n:keys(). */
#include "script_springs.h"

#include <clamps.h>

enum { KEY_BYTES = 64 };

static struct dyn_clamps *clamps_of(lua_State *L, struct script_network *s)
{
    if (!s->clamps)
        script_dyn_check(L, dyn_clamps_create(&s->clamps));
    return s->clamps;
}

/* n:key(mass, seconds, x, y): the mass is at (x, y) at that time */
static int network_key(lua_State *L)
{
    struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    double time = script_arg_at(L, 3, "a key's time", -1e12, 1e12);
    double x = script_arg_at(L, 4, "key's x", -1e6, 1e6);
    double y = script_arg_at(L, 5, "key's y", -1e6, 1e6);
    script_memory_take(L, KEY_BYTES, "a key");
    s->keys_bytes += KEY_BYTES;
    script_dyn_check(L, dyn_clamps_key(clamps_of(L, s), mass, time, x, y));
    return 0;
}

/* n:free(mass, seconds): releases the mass at that time */
static int network_free(lua_State *L)
{
    struct script_network *s = script_network_at(L, 1);
    int mass = script_network_mass_at(L, s, 2);
    double time = script_arg_at(L, 3, "a key's time", -1e12, 1e12);
    script_memory_take(L, KEY_BYTES, "a key");
    s->keys_bytes += KEY_BYTES;
    script_dyn_check(L, dyn_clamps_free(clamps_of(L, s), mass, time));
    return 0;
}

/* n:keys("file.clamps"): replaces all keys by the file's */
static int network_keys(lua_State *L)
{
    struct script_network *s = script_network_at(L, 1);
    const char *path =
        script_path(L, script_of(L)->config->in_folder, luaL_checkstring(L, 2), "keys");
    struct dyn_clamps *read;
    script_dyn_check(L, dyn_clamps_read(path, &read));
    dyn_clamps_destroy(s->clamps);
    s->clamps = read;
    double bytes = (double)KEY_BYTES * dyn_clamps_count(read);
    script_memory_give(s->script, s->keys_bytes);
    s->keys_bytes = 0;
    script_memory_take(L, bytes, "keys");
    s->keys_bytes = bytes;
    return 0;
}

const luaL_Reg script_network_key_methods[] = {
    {"key", network_key}, {"free", network_free}, {"keys", network_keys}, {NULL, NULL}};
