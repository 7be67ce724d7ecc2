/* live_controls.c - the controls that a live script declares, control{...}: numbers of its own
 * with a range, or rows of a network's table. See script_live.h. */
#include "live_internal.h"

#include "script_springs.h"

#include <visible_text.h>
#include <word_list.h>

#include <math.h>
#include <string.h>

static const double far_away = 1e9;

/* ---- declaring ---- */

static void text_read(lua_State *L, const char *key, char *out, size_t room)
{
    const char *text = script_arg_text(L, 1, "control", key);
    if (text && strlen(text) >= room)
        luaL_error(L, "control %s has up to %d bytes", key, (int)room - 1);
    visible_text(out, room, text ? text : "");
}

static void curve_read(lua_State *L, struct control *row)
{
    static const char *const curves[] = {"linear", "logarithmic", "centred",
                                         "switch", "choice",      NULL};
    const char *curve = script_arg_text(L, 1, "control", "curve");
    row->curve = row->choices[0] ? CONTROL_CHOICE
                 : curve
                     ? (enum control_curve)script_arg_choice(L, "control curve", curve, curves)
                     : CONTROL_LINEAR;
    if (row->curve == CONTROL_CHOICE && !row->choices[0])
        luaL_error(L, "control choices must be names with blanks between them");
}

/* Between what, and what it is at first. */
static void range_read(lua_State *L, struct control *row)
{
    const bool named = row->curve == CONTROL_CHOICE || row->curve == CONTROL_SWITCH;
    row->least =
        named ? 0 : script_arg_number(L, 1, "control", "least", 0, -far_away, far_away);
    row->most = row->curve == CONTROL_CHOICE ? word_list_count(row->choices) - 1
                : named                      ? 1
                        : script_arg_number(L, 1, "control", "most", 1, -far_away, far_away);
    row->usual = row->least;
    if (!(row->least < row->most))
        luaL_error(L,
                   "control '%s' must have a range: least is below most, and of choices there "
                   "are two or more",
                   row->name);
    lua_pushstring(L, "usual");
    if (lua_rawget(L, 1) == LUA_TNIL)
        lua_pop(L, 1);
    else
        row->usual = script_control_pop(L, row);
}

/* Numbers of the script's own. */
static void own_read(lua_State *L, struct live_control *c)
{
    struct control *row = &c->shown.row;
    text_read(L, "unit", c->unit, sizeof c->unit);
    text_read(L, "does", c->does, sizeof c->does);
    text_read(L, "choices", c->choices, sizeof c->choices);
    *row = (struct control){
        .name = c->name, .unit = c->unit, .choices = c->choices, .does = c->does};
    curve_read(L, row);
    range_read(L, row);
    c->shown.value = row->usual;
}

/* The value of a control of the network's first word, or of its world, and its row. Raises an
 * error where there is none. */
static double network_value(lua_State *L, const struct script_network *s, const char *name,
                            struct control *row)
{
    const struct control *of_world;
    for (int i = 0; s->words_count && i < dyn_word_controls_count; i++)
        if (strcmp(dyn_word_controls[i].name, name) == 0) {
            const struct dyn_word_style style = dyn_word_style_get(s->words[0]);
            *row = dyn_word_controls[i];
            return control_read(row, &style);
        }
    of_world = dyn_control_find(name);
    if (!of_world)
        script_fail(L, dyn_error());
    *row = *of_world;
    return control_read(row, dyn_network_world(s->network));
}

/* The row of a network's control, in its table. What is usual is what it is now. The network is
 * on the stack's top, and goes. */
static void network_read(lua_State *L, struct live_control *c)
{
    static const char *const others[] = {"unit",  "least",   "most", "usual",
                                         "curve", "choices", "does"};
    const struct script_network *network = script_network_at(L, -1);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        lua_pushstring(L, others[i]);
        if (lua_rawget(L, 1) != LUA_TNIL)
            luaL_error(L, "control of a network has what its table says: '%s' cannot be said",
                       others[i]);
        lua_pop(L, 1);
    }
    c->shown.value = network_value(L, network, c->name, &c->shown.row);
    c->shown.row.usual = c->shown.value;
    if (!c->shown.row.choices)
        c->shown.row.choices = "";
    c->network = luaL_ref(L, LUA_REGISTRYINDEX);
}

/* Pushes a control's value: a number, whether a switch is on, or the name of a choice. */
static void value_push(lua_State *L, const struct script_live_control *c)
{
    const char *word;
    size_t length;
    switch (c->row.curve) {
    case CONTROL_SWITCH:
        lua_pushboolean(L, c->value != 0);
        return;
    case CONTROL_CHOICE:
        word = word_list_at(c->row.choices, (int)c->value, &length);
        lua_pushlstring(L, word, length);
        return;
    case CONTROL_LINEAR:
    case CONTROL_LOGARITHMIC:
    case CONTROL_CENTRED:
        lua_pushnumber(L, c->value);
        return;
    }
}

static struct script_live *live_of(lua_State *L)
{
    return lua_touserdata(L, lua_upvalueindex(1));
}

/* What control{...} returns: its value. */
static int control_value(lua_State *L)
{
    const struct script_live *live = live_of(L);
    value_push(L, &live->controls[lua_tointeger(L, lua_upvalueindex(2))].shown);
    return 1;
}

/* control{name =, unit =, least =, most =, usual =, curve =, choices =, does =, of =} */
static int control_declare(lua_State *L)
{
    static const char *const keys[] = {"name",  "unit",    "least", "most", "usual",
                                       "curve", "choices", "does",  "of",   NULL};
    struct script_live *live = live_of(L);
    struct live_control *c = &live->controls[live->controls_count];
    lua_settop(L, 1);
    script_arg_options(L, 1, "control", keys);
    if (live->opened)
        luaL_error(L, "control is called while the script begins, not later");
    if (live->controls_count == SCRIPT_LIVE_CONTROLS_MAX)
        luaL_error(L, "a live script has up to %d controls", SCRIPT_LIVE_CONTROLS_MAX);
    *c = (struct live_control){.network = LUA_NOREF};
    text_read(L, "name", c->name, sizeof c->name);
    if (!c->name[0])
        luaL_error(L, "control name must be a text of 1 to %d bytes", SCRIPT_LIVE_NAME_MAX);
    for (int i = 0; i < live->controls_count; i++)
        if (strcmp(live->controls[i].name, c->name) == 0)
            luaL_error(L, "there is a control '%s' already", c->name);
    lua_pushstring(L, "of");
    if (lua_rawget(L, 1) == LUA_TNIL) {
        lua_pop(L, 1);
        own_read(L, c);
    } else {
        network_read(L, c);
    }
    lua_pushlightuserdata(L, live);
    lua_pushinteger(L, live->controls_count++);
    lua_pushcclosure(L, control_value, 2);
    return 1;
}

void live_controls_open(lua_State *L, struct script_live *live)
{
    lua_pushlightuserdata(L, live);
    lua_pushcclosure(L, control_declare, 1);
    lua_setglobal(L, "control");
}

/* ---- what a hand does ---- */

const struct script_live_control *script_live_control(const struct script_live *live,
                                                      int control)
{
    return control >= 0 && control < live->controls_count ? &live->controls[control].shown
                                                          : NULL;
}

struct setting {
    struct script_live *live;
    int control;
    double value;
};

static int set_protected(lua_State *L)
{
    const struct setting *setting = lua_touserdata(L, 1);
    struct live_control *c = &setting->live->controls[setting->control];
    c->shown.value = setting->value;
    if (c->network != LUA_NOREF) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, c->network);
        lua_pushnumber(L, setting->value);
        script_network_set(L, script_network_at(L, -2), c->name, lua_gettop(L));
    }
    if (live_function_push(L, "changed")) {
        lua_pushstring(L, c->name);
        value_push(L, &c->shown);
        lua_call(L, 2, 0);
    }
    return 0;
}

bool script_live_set(struct script_live *live, int control, double value)
{
    struct setting setting = {live, control, value};
    const struct script_live_control *c = script_live_control(live, control);
    if (!c || dyn_control_check(&c->row, value) != DYN_OK)
        return true; /* nobody's slider goes there */
    return live_call(live, set_protected, &setting, live->def.answer_s);
}
