/* live_internal.h - a live script, shared by its files: what it is asked and draws (live.c),
 * how it is called (live_call.c), its controls (live_controls.c). */
#ifndef LUTETIA_LIVE_INTERNAL_H
#define LUTETIA_LIVE_INTERNAL_H

#include "script_internal.h"
#include "script_live.h"

/* What colours are mixed by: light that each display value is, and the nearest value of
 * light. */
enum { LIGHT_STEPS = 4096 };

/* Its texts are those that `shown` points to. */
struct live_control {
    struct script_live_control shown;
    char name[SCRIPT_LIVE_NAME_MAX + 1], unit[SCRIPT_LIVE_UNIT_MAX + 1],
        choices[SCRIPT_LIVE_TEXT_MAX + 1], does[SCRIPT_LIVE_TEXT_MAX + 1];
    int network; /* in the registry: the network that has it; LUA_NOREF: it is the script's */
};

struct script_live {
    struct script script;
    struct script_config config;
    struct script_host host;
    struct script_live_def def;
    lua_State *L;
    struct live_control controls[SCRIPT_LIVE_CONTROLS_MAX];
    int controls_count;
    bool opened; /* its text has been run: there are no more controls */
    float light[256];
    uint8_t value[LIGHT_STEPS + 1];
    size_t collected_bytes; /* that were left when garbage was collected last */
};

/* live_call.c: a call of the script's, with the time that it has. */
bool live_call(struct script_live *live, lua_CFunction function, void *argument,
               double seconds);
/* Pushes the script's function of that name. False: it has none. */
bool live_function_push(lua_State *L, const char *name);

/* live_controls.c: sets the function `control`. */
void live_controls_open(lua_State *L, struct script_live *live);

#endif
