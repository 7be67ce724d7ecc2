/* paper_time.c - a paper's time in scripts: undo and redo, earlier times, other resolutions,
 * saving, loading, filming. */
#include "script_paper.h"
#include "script_text.h"

#include <history.h>
#include <state.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TIME_MOST = 1000000000 };

/* ---- back and forth ---- */

static void history_need(lua_State *L, const struct script_paper *paper)
{
    if (!paper_history_has(paper->sheet))
        luaL_error(L, "this paper has no history: it was made with history = false");
}

/* Goes back or forth, and returns by how many operations. */
static int paper_go(lua_State *L, int (*go)(struct paper_sheet *sheet, int count),
                    const char *what)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    history_need(L, paper);
    lua_pushinteger(L, go(paper->sheet, (int)script_arg_count(L, 2, what, 1, 0, TIME_MOST)));
    return 1;
}

static int paper_undo(lua_State *L)
{
    return paper_go(L, paper_history_undo, "undo's count");
}

static int paper_redo(lua_State *L)
{
    return paper_go(L, paper_history_redo, "redo's count");
}

/* paper:to(time) */
static int paper_to(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    history_need(L, paper);
    script_paper_check(
        L, paper_history_seek(paper->sheet, script_arg_count(L, 2, "a time", 0, 0, TIME_MOST)));
    return 0;
}

/* paper:again("..."): an operation by its bytes, as session.c writes them */
static int paper_again(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    size_t length, count;
    uint8_t *bytes;
    const char *text = luaL_checklstring(L, 2, &length);
    if (!script_text_bytes(text, length, &bytes, &count))
        luaL_error(
            L, "again's text must be an operation that a session's script has (it is damaged)");
    script_paper_stop_when_due(L, paper);
    const enum paper_status status = paper_sheet_again(paper->sheet, bytes, count);
    free(bytes);
    script_paper_check(L, status);
    script_check(L);
    return 0;
}

/* Adds what the operation put to its table, which is on the top: put = {water =, ...}, and the
 * rectangle. */
static void put_tell(lua_State *L, const struct paper_sheet *sheet, int number)
{
    static const char *const sides[] = {"x", "y", "width", "height"};
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double amount[1 + PAPER_PIGMENTS_MAX];
    int box[4];
    bool puts;
    script_paper_check(L, paper_history_moment_put(sheet, number, amount, box, &puts));
    if (!puts)
        return;
    lua_newtable(L);
    for (int i = 0; i <= config->pigments_count; i++)
        if (amount[i] != 0) {
            lua_pushnumber(L, amount[i]);
            lua_setfield(L, -2, i ? config->pigments[i - 1].name : "water");
        }
    lua_setfield(L, -2, "put");
    for (int i = 0; i < 4; i++) {
        lua_pushinteger(L, box[i]);
        lua_setfield(L, -2, sides[i]);
    }
}

/* paper:moments(): a list of {what =, time =, steps =, done =}; of what was put also put =, x
 * =, y =, width =, height =. */
static int paper_moments(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 1);
    struct paper_moment moment;
    history_need(L, paper);
    int done = paper_history_done(paper->sheet);
    lua_newtable(L);
    for (int i = 0; paper_history_moment(paper->sheet, i, &moment); i++) {
        lua_createtable(L, 0, 4);
        lua_pushstring(L, moment.what);
        lua_setfield(L, -2, "what");
        lua_pushinteger(L, moment.time);
        lua_setfield(L, -2, "time");
        lua_pushinteger(L, moment.steps);
        lua_setfield(L, -2, "steps");
        lua_pushboolean(L, i < done);
        lua_setfield(L, -2, "done");
        put_tell(L, paper->sheet, i);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

/* paper:at(time, function): runs the function at that time of the past, and repeats
 * everything that followed. */
int script_paper_at_time(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 3);
    history_need(L, paper);
    long time = script_arg_count(L, 2, "a time", 0, 0, TIME_MOST);
    luaL_checktype(L, 3, LUA_TFUNCTION);
    script_paper_check(L, paper_history_insert_begin(paper->sheet, time));
    lua_pushvalue(L, 3);
    lua_pushvalue(L, 1);
    int status = script_callback_protected(L, 1);
    script_paper_check(L, paper_history_insert_end(paper->sheet, status == LUA_OK));
    if (status != LUA_OK)
        lua_error(L);
    return 0;
}

/* paper:render(scale [, pace]): a new paper with the same history at another resolution. */
static int paper_render(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 3);
    history_need(L, paper);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    double scale = script_arg_at(L, 2, "render's scale", 1.0 / 64, 64);
    double pace = lua_isnoneornil(L, 3)
                      ? scale * scale
                      : script_arg_at(L, 3, "render's pace", 1.0 / 4096, 4096);
    struct script_paper *made = script_paper_new(L);
    script_paper_room_take(L, made, round(config->width * scale), round(config->height * scale),
                           config->pigments_count);
    script_paper_check(L, paper_history_render(paper->sheet, scale, pace, 0, &made->sheet));
    script_paper_keep(made);
    return 1;
}

/* ---- files ---- */

/* paper:save("state.h5") */
static int paper_save(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    history_need(L, paper);
    const char *path = script_path_to_write(L, luaL_checkstring(L, 2), ".h5", "a saved paper");
    script_paper_check(L,
                       paper_state_save(path, &(struct paper_state_sheet){1, paper->sheet}, 1));
    script_wrote_tell(paper->script, path);
    return 0;
}

static const char state_type[] = "lutetia state";

static int state_gc(lua_State *L)
{
    struct paper_state **state = luaL_checkudata(L, 1, state_type);
    paper_state_close(*state);
    *state = NULL;
    return 0;
}

/* paper.load("state.h5" [, number]) */
static int papers_load(lua_State *L)
{
    struct script *script = script_of(L);
    const char *name = luaL_checkstring(L, 1);
    long number = script_arg_count(L, 2, "a paper's number", 1, 1, TIME_MOST);
    const char *path = script_path(L, script->config->in_folder, name, "a saved paper");
    if (access(path, F_OK) != 0) /* a paper that the script itself saved is in the output
                                  * folder */
        path = script_path(L, script->config->out_folder, name, "a saved paper");
    struct paper_state **state = lua_newuserdatauv(L, sizeof *state, 0);
    *state = NULL;
    luaL_setmetatable(L, state_type);
    script_paper_check(L, paper_state_open(path, state));
    int index = 0, count = paper_state_count(*state);
    while (index < count && paper_state_number(*state, index) != number)
        index++;
    if (index == count)
        luaL_error(L, "%s has no paper %d", path, (int)number);
    struct paper_sheet_config config;
    paper_state_limit(*state, script_memory_left(script));
    script_paper_check(L, paper_state_describe(*state, index, &config));
    struct script_paper *paper = script_paper_new(L);
    script_paper_room_take(L, paper, config.width, config.height, config.pigments_count);
    paper_state_limit(*state, script_memory_left(script));
    script_paper_check(L, paper_state_load(*state, index, false, 0, &paper->sheet));
    script_paper_keep(paper);
    return 1;
}

/* ---- film ---- */

/* paper:film{show =, x =, y =, width =, height =}: films this paper with these settings. */
static int paper_film(lua_State *L)
{
    static const char *const keys[] = {"show", "x", "y", "width", "height", NULL};
    struct script_paper *paper = script_paper_begin(L, 2);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    const struct script_host *host = paper->script->host;
    struct script_camera camera = {.paper = paper->number, .show = PAPER_SHOW_COLOR};
    script_arg_options(L, 2, "film", keys);
    const char *show = script_arg_text(L, 2, "film", "show");
    if (show && strcmp(show, "color") != 0 && strcmp(show, "wet") != 0)
        luaL_error(L, "film show must be one of color, wet (got '%s')", show);
    if (show && strcmp(show, "wet") == 0)
        camera.show = PAPER_SHOW_WET;
    camera.x = script_arg_number(L, 2, "film", "x", 0, 0, config->width - 2);
    camera.y = script_arg_number(L, 2, "film", "y", 0, 0, config->height - 2);
    camera.width =
        script_arg_number(L, 2, "film", "width", config->width - camera.x, 2, config->width);
    camera.height =
        script_arg_number(L, 2, "film", "height", config->height - camera.y, 2, config->height);
    if (host->film)
        host->film(host->context, &camera);
    return 0;
}

/* expect(steps): the steps of the whole script, for the estimate of the time left. */
static int expect(lua_State *L)
{
    script_of(L)->steps_expected = script_arg_count(L, 1, "steps expected", 0, 0, TIME_MOST);
    return 0;
}

const luaL_Reg script_paper_time_methods[] = {
    {"undo", paper_undo},       {"redo", paper_redo},   {"to", paper_to},
    {"moments", paper_moments}, {"save", paper_save},   {"render", paper_render},
    {"film", paper_film},       {"again", paper_again}, {NULL, NULL}};

const luaL_Reg script_papers_functions[] = {{"load", papers_load}, {NULL, NULL}};

const luaL_Reg script_paper_time_functions[] = {{"expect", expect}, {NULL, NULL}};

void script_paper_time_open(lua_State *L)
{
    script_type_open(L, state_type, state_gc);
}
