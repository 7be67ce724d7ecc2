/* paper.c - sheets in scripts: paper{...} and its methods. */
#include "script_paper.h"

#include <brush.h>
#include <describe.h>
#include <history.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The memory for the checkpoints of a paper's history: a share of the run's memory, with a
 * maximum. */
#define UNDO_SHARE 16
#define UNDO_BYTES_MOST 256e6

static const struct paper_sheet_config *config_of(const struct script_paper *paper)
{
    return paper_sheet_get_config(paper->sheet);
}

/* ---- making ---- */

enum { NAMES_ROOM = PAPER_PIGMENT_NAMES_ROOM };

static const struct paper_pigment *pigment_find(lua_State *L, const char *name, bool curtis)
{
    const struct paper_pigment *pigment =
        curtis ? paper_pigment_curtis(name) : paper_pigment_find(name);
    char known[NAMES_ROOM];
    if (!pigment && curtis)
        luaL_error(L,
                   "Curtis et al. have no pigment '%s'; without paints = \"curtis\" there "
                   "may be one",
                   name);
    if (!pigment) {
        paper_pigment_names(known, sizeof known);
        luaL_error(L, "there is no pigment '%s'; there are %s", name, known);
    }
    return pigment;
}

static const struct paper_stock *stock_find(lua_State *L, const char *name)
{
    const struct paper_stock *stock = paper_stock_find(name);
    char known[NAMES_ROOM];
    if (!stock) {
        paper_stock_names(known, sizeof known);
        luaL_error(L, "there is no paper stock '%s'; there are %s", name, known);
    }
    return stock;
}

/* Whether a table says anything of a field that is a list. */
static bool field_said(lua_State *L, int t, const char *field)
{
    const bool said = lua_getfield(L, t, field) != LUA_TNIL;
    lua_pop(L, 1);
    return said;
}

/* What a pigment's table says of it by bands: a pigment that is told by three channels is not
 * known by bands. */
static void bands_read(lua_State *L, int t, struct paper_pigment *pigment)
{
    const bool absorbs = field_said(L, t, "absorption"),
               scatters = field_said(L, t, "scattering");
    if (absorbs != scatters)
        luaL_error(L, "a pigment needs both by bands, absorption and scattering");
    if (field_said(L, t, "K") || field_said(L, t, "S"))
        paper_pigment_unband(pigment);
    script_fields_read(L, t, "pigment", &paper_bands_members, pigment);
}

/* Reads a pigment from the text or table on the top, and pops it. */
static void pigment_read(lua_State *L, struct paper_pigment *pigment, bool curtis)
{
    static const char *const besides[] = {"name",       "like",       "white", "black",
                                          "absorption", "scattering", "shift", NULL};
    if (lua_type(L, -1) == LUA_TSTRING) {
        *pigment = *pigment_find(L, lua_tostring(L, -1), curtis);
        lua_pop(L, 1);
        return;
    }
    if (lua_type(L, -1) != LUA_TTABLE)
        luaL_error(L, "a pigment must be a name or a table (got a %s)", luaL_typename(L, -1));
    int t = lua_gettop(L);
    script_fields_options(L, t, "pigment", &paper_pigment_members, besides);
    const char *like = script_arg_text(L, t, "pigment", "like"),
               *name = script_arg_text(L, t, "pigment", "name");
    *pigment = *pigment_find(L, like ? like : "cyan", curtis);
    if (name && (strlen(name) == 0 || strlen(name) >= PAPER_NAME_MAX))
        luaL_error(L, "a pigment's name must have 1..%d characters", PAPER_NAME_MAX - 1);
    if (name)
        snprintf(pigment->name, sizeof pigment->name, "%s", name);
    double white[3], black[3];
    bool has_white = script_arg_color(L, t, "pigment", "white", white);
    bool has_black = script_arg_color(L, t, "pigment", "black", black);
    if (has_white != has_black)
        luaL_error(L, "a pigment needs both colours, white and black: how it looks over them");
    if (has_white) {
        for (int i = 0; i < 3; i++) {
            white[i] = paper_light_linear(white[i]);
            black[i] = paper_light_linear(black[i]);
        }
        script_paper_check(L, paper_pigment_colors(pigment, white, black));
    }
    script_fields_read(L, t, "pigment", &paper_pigment_members, pigment);
    bands_read(L, t, pigment);
    lua_pop(L, 1);
}

static void pigments_read(lua_State *L, struct paper_sheet_config *config)
{
    static const char *const tables[] = {"shops", "curtis", NULL};
    const char *paints = script_arg_text(L, 1, "paper", "paints");
    const bool curtis = paints && script_arg_choice(L, "paper paints", paints, tables) == 1;
    lua_pushliteral(L, "pigments");
    int type = lua_rawget(L, 1);
    if (type == LUA_TNIL) {
        lua_pop(L, 1);
        if (config->parts) /* the thesis's paper has none of itself */
            config->pigments[config->pigments_count++] =
                *pigment_find(L, PAPER_PIGMENT_USUAL, curtis);
        return;
    }
    if (type != LUA_TTABLE || lua_rawlen(L, -1) > PAPER_PIGMENTS_MAX)
        luaL_error(L, "paper pigments must be a list of up to %d", PAPER_PIGMENTS_MAX);
    config->pigments_count = (int)lua_rawlen(L, -1);
    for (int i = 0; i < config->pigments_count; i++) {
        lua_rawgeti(L, -1, i + 1);
        pigment_read(L, &config->pigments[i], curtis);
        for (int j = 0; j < i; j++)
            if (strcmp(config->pigments[i].name, config->pigments[j].name) == 0)
                luaL_error(L, "two pigments are called '%s'; give them names",
                           config->pigments[i].name);
    }
    lua_pop(L, 1);
}

static const char *const parts_names[] = {"infused", "surface", "fixing", "edge", NULL};

static void parts_read(lua_State *L, struct paper_sheet_config *config)
{
    static const char *const models[] = {"full", "thesis", NULL};
    lua_pushliteral(L, "model");
    int type = lua_rawget(L, 1);
    if (type == LUA_TTABLE) {
        config->parts = PAPER_PART_INFUSED;
        int count = (int)lua_rawlen(L, -1);
        for (int i = 1; i <= count; i++) {
            lua_rawgeti(L, -1, i);
            config->parts |= 1u << script_arg_choice(L, "a part of paper's model",
                                                     luaL_checkstring(L, -1), parts_names);
            lua_pop(L, 1);
        }
    } else if (type == LUA_TSTRING) {
        bool thesis = script_arg_choice(L, "paper model", lua_tostring(L, -1), models) == 1;
        config->parts = thesis ? 0 : PAPER_PARTS_ALL;
        if (thesis)
            config->rule = PAPER_RULE_SUBTRACT;
    } else if (type != LUA_TNIL) {
        luaL_error(L, "paper model must be \"full\", \"thesis\" or a list of parts");
    }
    lua_pop(L, 1);
}

static void stock_read(lua_State *L, struct paper_stock *stock)
{
    const char *name = script_arg_text(L, 1, "paper", "stock");
    if (name)
        *stock = *stock_find(L, name);
    script_arg_color(L, 1, "paper", "color", stock->color);
    script_fields_read(L, 1, "paper", &paper_stock_members, stock);
}

/* deckle = true, or a table of its numbers. */
static void deckle_read(lua_State *L, struct paper_sheet_config *config)
{
    lua_pushliteral(L, "deckle");
    int type = lua_rawget(L, 1);
    if (type == LUA_TTABLE) {
        int t = lua_gettop(L);
        script_fields_options(L, t, "deckle", &paper_deckle_members, NULL);
        script_fields_read(L, t, "deckle", &paper_deckle_members, &config->deckle);
    } else if (type != LUA_TNIL && type != LUA_TBOOLEAN) {
        luaL_error(L, "paper deckle must be true, false or a table (got a %s)",
                   luaL_typename(L, -1));
    }
    config->deckled = type == LUA_TTABLE || lua_toboolean(L, -1);
    lua_pop(L, 1);
}

static const char *const rules[] = {"kubelka-munk", "subtract", "luminous", NULL};

static int make_paper(lua_State *L)
{
    static const char *const besides[] = {"width", "height", "torus",    "model", "rule",
                                          "stock", "seed",   "pigments", "color", "history",
                                          "undo",  "deckle", "paints",   NULL};
    lua_remove(L, 1); /* removes the table `paper`, which was called */
    lua_settop(L, 1);
    luaL_checktype(L, 1, LUA_TTABLE);
    script_fields_options(L, 1, "paper", &paper_stock_members, besides);
    struct script *script = script_of(L);
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width =
        script_arg_integer(L, 1, "paper", "width", 512, PAPER_SIDE_MIN, PAPER_SIDE_MAX);
    config.height =
        script_arg_integer(L, 1, "paper", "height", 512, PAPER_SIDE_MIN, PAPER_SIDE_MAX);
    config.torus = script_arg_boolean(L, 1, "paper", "torus", false);
    config.seed = (uint64_t)script_arg_integer(
        L, 1, "paper", "seed", (int)(script->config->seed & 0x7fffffff), 0, 2147483647);
    parts_read(L, &config);
    const char *rule = script_arg_text(L, 1, "paper", "rule");
    if (rule)
        config.rule = (enum paper_rule)script_arg_choice(L, "paper rule", rule, rules);
    stock_read(L, &config.stock);
    deckle_read(L, &config);
    pigments_read(L, &config);
    bool history = script_arg_boolean(L, 1, "paper", "history", true);
    double undo = fmin(UNDO_BYTES_MOST, (double)(script->config->memory_bytes / UNDO_SHARE));
    undo = 1e6 * script_arg_number(L, 1, "paper", "undo", undo * 1e-6, 0, 1e6);

    struct script_paper *paper = script_paper_new(L);
    script_paper_room_take(L, paper, config.width, config.height, config.pigments_count);
    bool found = false;
    enum paper_status status = PAPER_OK;
    if (history)
        status = script_paper_resumed(paper, &config, undo, &found);
    if (status == PAPER_OK && !found)
        status = paper_sheet_create(&config, &paper->sheet);
    if (status == PAPER_OK && !found && history)
        status = paper_history_begin(paper->sheet, undo);
    script_paper_check(L, status);
    script_paper_keep(paper);
    script_paper_show(L, paper);
    return 1;
}

static void finish(struct script_paper *paper)
{
    script_paper_forget(paper);
    paper_sheet_destroy(paper->sheet);
    paper->sheet = NULL;
    script_memory_give(paper->script, paper->bytes + paper->history_bytes);
    paper->bytes = paper->history_bytes = 0;
}

/* A pinned paper keeps its sheet: then a debugger called __gc, and the collector will call
 * it again. */
static int paper_gc(lua_State *L)
{
    struct script_paper *paper = luaL_checkudata(L, 1, script_paper_type);
    if (paper->pins == 0)
        finish(paper);
    return 0;
}

static int paper_close(lua_State *L)
{
    struct script_paper *paper = luaL_checkudata(L, 1, script_paper_type);
    if (paper->pins > 0)
        luaL_error(L, "this paper is in use: it cannot be closed before the call ends that "
                      "uses it");
    finish(paper);
    return 0;
}

/* ---- putting and taking ---- */

/* Gets the mask at index as a screen; no mask means everywhere (*everywhere). False: it
 * covers nothing. */
static bool screen_read(lua_State *L, int index, const struct script_paper *paper,
                        struct paper_screen *screen, int *x, int *y)
{
    const struct paper_sheet_config *config = config_of(paper);
    return script_mask_screen(L, index, config->width, config->height, screen, x, y);
}

static int paper_put(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 3);
    double amount[1 + PAPER_PIGMENTS_MAX];
    struct paper_screen screen;
    int x, y;
    script_paper_amounts(L, 3, paper->sheet, amount);
    if (screen_read(L, 2, paper, &screen, &x, &y))
        script_paper_check(L, paper_sheet_put(paper->sheet, &screen, x, y, amount));
    script_check(L);
    return 0;
}

/* What type is put with where a script names no amounts: water, and the first pigment. */
#define TYPE_WATER 0.75
#define TYPE_PIGMENT 1.2

static void type_amounts_usual(lua_State *L, const struct paper_sheet_config *config,
                               double *amount)
{
    if (config->pigments_count == 0)
        luaL_error(L, "type on a paper without pigments needs amounts: p:type(\"word\", {}, "
                      "{water = 1})");
    memset(amount, 0, sizeof(double) * (1 + PAPER_PIGMENTS_MAX));
    amount[0] = TYPE_WATER;
    amount[1] = TYPE_PIGMENT;
}

/* Says that type is off the sheet: how much of its ink. */
static void off_sheet_tell(lua_State *L, const struct paper_sheet_config *config,
                           const struct paper_screen *screen, int x, int y)
{
    double all = 0, off = 0;
    const double edge = config->deckled ? config->deckle.margin : 0;
    char text[256];
    for (int row = 0; row < screen->height_px && !config->torus; row++)
        for (int column = 0; column < screen->width_px; column++) {
            const int at_x = x + column, at_y = y + row;
            const double ink =
                screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column];
            all += ink;
            if (at_x < edge || at_y < edge || at_x >= config->width - edge ||
                at_y >= config->height - edge)
                off += ink;
        }
    if (off == 0)
        return;
    snprintf(text, sizeof text,
             "type: %s of it is off the paper: it takes %d..%d by %d..%d, the paper is %dx%d",
             off == all ? "all" : "some", x, x + screen->width_px, y, y + screen->height_px,
             config->width, config->height);
    if (edge > 0)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 " with a margin of %g around it", edge);
    script_note_where(L, text);
}

/* p:type("word" [, {…} [, {water = …}]]): puts text() onto the sheet; without options in its
 * middle, as large as goes well. Returns its length, and its lines' height. */
static int paper_put_type(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 4);
    double amount[1 + PAPER_PIGMENTS_MAX];
    struct paper_screen screen;
    int x, y;
    const bool none = lua_isnoneornil(L, 4), usual = none && config_of(paper)->parts;
    if (none)
        type_amounts_usual(L, config_of(paper), amount);
    else
        script_paper_amounts(L, 4, paper->sheet, amount);
    if (lua_isnoneornil(L, 3))
        script_mask_text_fit(L, 2, config_of(paper)->width, config_of(paper)->height,
                             paper_sheet_margin(config_of(paper)));
    int made = script_mask_text_push(L, 2);
    if (script_mask_screen_quietly(L, lua_gettop(L) - made + 1, config_of(paper)->width,
                                   config_of(paper)->height, &screen, &x, &y)) {
        off_sheet_tell(L, config_of(paper), &screen, x, y);
        script_paper_check(L, usual ? paper_sheet_put_charged(
                                          paper->sheet, &screen, x, y, amount,
                                          script_arg_number(L, 3, "text", "size", 100, 1, 8192))
                                    : paper_sheet_put(paper->sheet, &screen, x, y, amount));
    }
    script_check(L);
    return made - 1;
}

static int paper_blot(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 4);
    struct paper_screen screen;
    int x, y;
    double part = script_member_at(L, 3, "blot's part", &paper_blot_members, "part", 1);
    double lift = script_member_at(L, 4, "blot's lift", &paper_blot_members, "lift", 0);
    if (screen_read(L, 2, paper, &screen, &x, &y))
        script_paper_check(L, paper_sheet_blot(paper->sheet, &screen, x, y, part, lift));
    script_check(L);
    return 0;
}

static int resist_set(lua_State *L, bool on)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    struct paper_screen screen;
    int x, y;
    if (screen_read(L, 2, paper, &screen, &x, &y))
        script_paper_check(L, paper_sheet_resist(paper->sheet, &screen, x, y, on));
    script_check(L);
    return 0;
}

static int paper_resist(lua_State *L)
{
    return resist_set(L, true);
}

static int paper_unresist(lua_State *L)
{
    return resist_set(L, false);
}

static int paper_dry(lua_State *L)
{
    script_paper_check(L, paper_sheet_dry(script_paper_begin(L, 1)->sheet));
    return 0;
}

static int paper_seal(lua_State *L)
{
    script_paper_check(L, paper_sheet_seal(script_paper_begin(L, 1)->sheet));
    return 0;
}

/* ---- time ---- */

/* A pull has a direction: one number would mean right and down at once. 0 is none. */
static void one_way_refuse(lua_State *L)
{
    static const char *const pulls[] = {"gravity", "seep"};
    for (int i = 0; i < 2; i++) {
        lua_pushstring(L, pulls[i]);
        if (lua_rawget(L, 2) == LUA_TNUMBER && lua_tonumber(L, -1) != 0)
            luaL_error(L, "air %s must be {right, down}, or 0 for none (got %s)", pulls[i],
                       lua_tostring(L, -1));
        lua_pop(L, 1);
    }
}

static int paper_air(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    luaL_checktype(L, 2, LUA_TTABLE);
    script_fields_options(L, 2, "air", &paper_air_members, NULL);
    struct paper_air air = *paper_sheet_get_air(paper->sheet);
    struct members members = paper_air_members;
    if (config_of(paper)->parts == 0) { /* in the thesis's model, gravity is a factor; 1 is
                                         * none */
        double gravity[2] = {air.thesis.gravity_x, air.thesis.gravity_y};
        script_arg_numbers(L, 2, "air", "gravity", gravity, 2, 0.5, PAPER_GRAVITY_MAX);
        air.thesis.gravity_x = gravity[0];
        air.thesis.gravity_y = gravity[1];
        while (members.first->element) { /* skip the rows of gravity's vector */
            members.first++;
            members.count--;
        }
    } else
        one_way_refuse(L);
    script_fields_read(L, 2, "air", &members, &air);
    if (config_of(paper)->parts == 0)
        air.thesis.humidity = air.humidity;
    script_paper_check(L, paper_sheet_air(paper->sheet, &air));
    return 0;
}

/* An exact 0 where only rounding makes it another number: such a pull would cost steps. */
static double pull(double part)
{
    return fabs(part) < 1e-12 ? 0 : part;
}

/* paper:tilt(degrees [, toward]): the board leans. toward: 0 to the right, 90 down. */
static int paper_tilt(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 3);
    const double degree = 3.14159265358979323846 / 180;
    const double leans = script_arg_at(L, 2, "tilt's degrees", 0, 90) * degree;
    const double toward = lua_isnil(L, 3)
                              ? 90 * degree
                              : script_arg_at(L, 3, "tilt's direction", -36000, 36000) * degree;
    if (config_of(paper)->parts == 0)
        luaL_error(L,
                   "the thesis's paper lies flat; p:air{gravity = {1, 1.2}} pulls its water");
    struct paper_air air = *paper_sheet_get_air(paper->sheet);
    air.gravity[0] = pull(sin(leans) * cos(toward));
    air.gravity[1] = pull(sin(leans) * sin(toward));
    script_paper_check(L, paper_sheet_air(paper->sheet, &air));
    return 0;
}

static int paper_step(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    struct script *script = paper->script;
    int count = (int)script_arg_count(L, 2, "step's count", 1, 0, 1000000);
    script_words_check(L);
    bool expected = script->steps_expected > 0;
    long first = expected ? script->steps_done : 0;
    long total = expected && script->steps_expected > first + count ? script->steps_expected
                                                                    : first + count;
    struct script_progress progress = {.done = first,
                                       .total = total,
                                       .began_s =
                                           expected ? script->began_s : script_clock_s()};
    const char *error = NULL;
    paper_history_mark(paper->sheet);
    enum paper_status status = PAPER_OK;
    for (int i = 0; i < count && status == PAPER_OK && !error; i++) {
        status = paper_sheet_step(paper->sheet);
        if (status == PAPER_OK)
            status = paper_sheet_finish(paper->sheet);
        if (status == PAPER_OK && (error = script_paper_shown(paper)) != NULL)
            break;
        script->steps_done++;
        progress.done++;
        script_progress_tell(script, &progress);
        if (script_due(script))
            break;
    }
    script_progress_tell(script, NULL);
    script_check(L);
    script_paper_check(L, status);
    if (error)
        luaL_error(L, "%s", error);
    return 0;
}

/* Reads a field of the paper, or finds a method. */
static int paper_index(lua_State *L)
{
    struct script_paper *paper = luaL_checkudata(L, 1, script_paper_type);
    const char *key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
    if (paper->sheet && strcmp(key, "width") == 0)
        lua_pushinteger(L, config_of(paper)->width);
    else if (paper->sheet && strcmp(key, "height") == 0)
        lua_pushinteger(L, config_of(paper)->height);
    else if (paper->sheet && strcmp(key, "margin") == 0)
        lua_pushinteger(L, (lua_Integer)ceil(paper_sheet_margin(config_of(paper))));
    else if (strcmp(key, "steps") == 0)
        lua_pushinteger(L, paper->sheet ? paper_sheet_steps(paper->sheet) : 0);
    else {
        lua_pushvalue(L, 2);
        lua_rawget(L, lua_upvalueindex(1));
        if (lua_isnil(L, -1)) {
            lua_pushvalue(L, lua_upvalueindex(1));
            script_method_unknown(L, "paper", key);
        }
    }
    return 1;
}

const luaL_Reg script_paper_methods[] = {
    {"put", paper_put},           {"blot", paper_blot},   {"resist", paper_resist},
    {"unresist", paper_unresist}, {"dry", paper_dry},     {"seal", paper_seal},
    {"air", paper_air},           {"tilt", paper_tilt},   {"step", paper_step},
    {"type", paper_put_type},     {"close", paper_close}, {NULL, NULL}};

const luaL_Reg script_papers_operators[] = {{"__call", make_paper}, {NULL, NULL}};

void script_paper_open(lua_State *L)
{
    script_type_open(L, script_paper_type, paper_gc);
    luaL_getmetatable(L, script_paper_type);
    lua_getfield(L, -1, "methods");
    lua_pushcclosure(L, paper_index, 1);
    lua_setfield(L, -2, "__index");
    lua_pop(L, 1);
    /* for paper{...} and paper.load(...) */
    script_type_open(L, script_papers_type, NULL);
    lua_newtable(L);
    luaL_setmetatable(L, script_papers_type);
    lua_setglobal(L, "paper");
}
