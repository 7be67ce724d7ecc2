/* live.c - see script_live.h. */
#include "live_internal.h"

#include "script_mask.h"
#include "script_paper.h"

#include <picture.h>

#include <ink.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- calls ---- */

struct step {
    double seconds;
};

static int step_protected(lua_State *L)
{
    const struct step *step = lua_touserdata(L, 1);
    if (live_function_push(L, "step")) {
        lua_pushnumber(L, step->seconds);
        lua_call(L, 1, 0);
    }
    return 0;
}

bool script_live_step(struct script_live *live, double seconds)
{
    struct step step = {seconds};
    return live_call(live, step_protected, &step, live->def.answer_s);
}

struct pointed {
    const char *what;
    double x, y, pressure;
};

static int pointer_protected(lua_State *L)
{
    const struct pointed *p = lua_touserdata(L, 1);
    if (live_function_push(L, "pointer")) {
        lua_pushstring(L, p->what);
        lua_pushnumber(L, p->x);
        lua_pushnumber(L, p->y);
        lua_pushnumber(L, p->pressure);
        lua_call(L, 4, 0);
    }
    return 0;
}

bool script_live_pointer(struct script_live *live, const char *what, double x, double y,
                         double pressure)
{
    struct pointed pointed = {what, x, y, pressure};
    return live_call(live, pointer_protected, &pointed, live->def.answer_s);
}

struct typed {
    const char *function, *name;
};

static int key_protected(lua_State *L)
{
    const struct typed *typed = lua_touserdata(L, 1);
    if (live_function_push(L, typed->function)) {
        lua_pushstring(L, typed->name);
        lua_call(L, 1, 0);
    }
    return 0;
}

bool script_live_key(struct script_live *live, bool down, const char *name)
{
    struct typed typed = {down ? "key" : "release", name};
    return live_call(live, key_protected, &typed, live->def.answer_s);
}

/* ---- drawing ---- */

static void light_make(struct script_live *live)
{
    for (int i = 0; i < 256; i++)
        live->light[i] = (float)font_light(i / 255.0, 0);
    for (int i = 0; i <= LIGHT_STEPS; i++)
        live->value[i] = (uint8_t)lrint(255 * font_number((double)i / LIGHT_STEPS, 0));
}

struct drawing {
    struct script_live *live;
    uint8_t *rgb;
};

static uint8_t *row_of(const struct drawing *d, int y)
{
    return d->rgb + 3 * (size_t)y * (size_t)d->live->def.width_px;
}

static void color_fill(const struct drawing *d, const uint8_t color[3])
{
    for (int y = 0; y < d->live->def.height_px; y++)
        for (int x = 0; x < d->live->def.width_px; x++)
            memcpy(row_of(d, y) + 3 * x, color, 3);
}

static void mask_paint(lua_State *L, const struct drawing *d, int index, const uint8_t color[3])
{
    const struct script_live *live = d->live;
    const struct script_mask *mask = script_mask_grayed(L, index);
    for (int y = 0; y < live->def.height_px; y++) {
        uint8_t *row = row_of(d, y);
        script_check_row(L, y);
        for (int x = 0; x < live->def.width_px; x++) {
            const float part = (float)script_mask_gray_at(mask, x, y) / 255;
            if (part >= 1)
                memcpy(row + 3 * x, color, 3);
            for (int c = 0; c < 3 && part > 0 && part < 1; c++) {
                const float under = live->light[row[3 * x + c]],
                            mixed = under + part * (live->light[color[c]] - under);
                row[3 * x + c] = live->value[(int)(mixed * LIGHT_STEPS + 0.5f)];
            }
        }
    }
    lua_pop(L, 1);
}

/* Its pin stays on the stack until draw_protected() returns. */
static void paper_paint(lua_State *L, const struct drawing *d, int index)
{
    struct script_paper *paper = script_paper_pin(L, index);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    const struct paper_sheet_view view = paper_sheet_view_default(config);
    const struct script_live_def *def = &d->live->def;
    const struct paper_area area = {
        0, 0, config->width < def->width_px ? config->width : def->width_px,
        config->height < def->height_px ? config->height : def->height_px};
    script_paper_check(L, paper_sheet_view_area(paper->sheet, &view, &area, d->rgb,
                                                3 * (size_t)def->width_px));
}

static void picture_paint(const struct drawing *d, const uint8_t *from, int width, int height)
{
    const int wide = width < d->live->def.width_px ? width : d->live->def.width_px,
              high = height < d->live->def.height_px ? height : d->live->def.height_px;
    for (int y = 0; y < high; y++)
        memcpy(row_of(d, y), from + 3 * (size_t)y * (size_t)width, 3 * (size_t)wide);
}

/* The colour at an index, as "#rrggbb" or {r, g, b}. False: it is none of both. */
static bool color_read(lua_State *L, int index, uint8_t color[3])
{
    double rgb[3];
    const int type = lua_type(L, index);
    if (type != LUA_TSTRING && type != LUA_TTABLE)
        return false;
    lua_createtable(L, 0, 1);
    lua_pushvalue(L, index);
    lua_setfield(L, -2, "color");
    script_arg_color(L, lua_gettop(L), "draw", "color", rgb);
    lua_pop(L, 1);
    for (int c = 0; c < 3; c++)
        color[c] = (uint8_t)lround(255 * rgb[c]);
    return true;
}

/* Paints what draw() has returned at first..top. */
static void values_paint(lua_State *L, const struct drawing *d, int first, int top)
{
    for (int i = first; i <= top; i++) {
        uint8_t color[3] = {24, 28, 38};
        int width, height;
        const uint8_t *pixels = script_picture_pixels(L, i, &width, &height);
        if (pixels) {
            picture_paint(d, pixels, width, height);
        } else if (luaL_testudata(L, i, script_paper_type)) {
            paper_paint(L, d, i);
        } else if (luaL_testudata(L, i, script_mask_type)) {
            const bool colored = i < top && color_read(L, i + 1, color);
            mask_paint(L, d, i, color);
            i += colored;
        } else if (color_read(L, i, color)) {
            color_fill(d, color);
        } else {
            luaL_error(
                L, "draw must return masks, colours, papers and pictures (value %d is a %s)",
                i - first + 1, luaL_typename(L, i));
        }
    }
}

static int draw_protected(lua_State *L)
{
    const struct drawing *d = lua_touserdata(L, 1);
    enum { VALUES_MAX = 64 };
    const uint8_t blank[3] = {254, 252, 248};
    color_fill(d, blank);
    lua_settop(L, 1);
    if (!live_function_push(L, "draw"))
        luaL_error(L, "%s: its function draw() has gone", d->live->def.name);
    lua_call(L, 0, LUA_MULTRET);
    const int top = lua_gettop(L);
    if (top - 1 > VALUES_MAX)
        luaL_error(L, "draw may return up to %d values (got %d)", VALUES_MAX, top - 1);
    luaL_checkstack(L, VALUES_MAX + 20, "pictures");
    values_paint(L, d, 2, top);
    return 0;
}

/* What pictures leave behind is C's memory, of which Lua's collector knows nothing. */
static void garbage_collect(struct script_live *live)
{
    const size_t more = (size_t)16 << 20;
    if (live->script.memory_bytes < live->collected_bytes + more)
        return;
    lua_gc(live->L, LUA_GCCOLLECT);
    live->collected_bytes = live->script.memory_bytes;
}

bool script_live_draw(struct script_live *live, uint8_t *rgb)
{
    struct drawing drawing = {live, rgb};
    const bool good = live_call(live, draw_protected, &drawing, live->def.answer_s);
    garbage_collect(live);
    return good;
}

/* ---- opening ---- */

static void host_print(void *context, const char *text, size_t length)
{
    const struct script_live *live = context;
    live->def.print(live->def.context, text, length);
}

static void host_error(void *context, const char *text)
{
    const struct script_live *live = context;
    live->def.error(live->def.context, text);
}

static void host_overdue(void *context)
{
    const struct script_live *live = context;
    live->def.overdue(live->def.context);
}

static void host_overfull(void *context)
{
    const struct script_live *live = context;
    live->def.overfull(live->def.context);
}

static int open_protected(lua_State *L)
{
    struct script_live *live = lua_touserdata(L, 1);
    const struct script_live_def *def = &live->def;
    script_open(L);
    lua_createtable(L, 0, 2);
    lua_pushinteger(L, def->width_px);
    lua_setfield(L, -2, "width");
    lua_pushinteger(L, def->height_px);
    lua_setfield(L, -2, "height");
    lua_setglobal(L, "stage");
    live_controls_open(L, live);
    lua_pushfstring(L, "=%s", def->name);
    if (luaL_loadbufferx(L, def->text, def->bytes, lua_tostring(L, -1), "t") != LUA_OK)
        lua_error(L);
    lua_call(L, 0, 0);
    if (!live_function_push(L, "draw"))
        luaL_error(L, "%s: a live script has a function draw()", def->name);
    return 0;
}

static void live_configure(struct script_live *live, const struct script_live_def *def)
{
    live->def = *def;
    live->config = script_config_default(def->name);
    live->config.in_folder = live->config.out_folder = NULL;
    live->config.memory_bytes = def->memory_bytes;
    live->host = (struct script_host){.context = live,
                                      .print = host_print,
                                      .error = host_error,
                                      .overdue = host_overdue,
                                      .overfull = host_overfull};
    live->script = (struct script){.config = &live->config,
                                   .host = &live->host,
                                   .began_s = script_clock_s(),
                                   .clock = CLOCK_PROCESS_CPUTIME_ID,
                                   .answers = true};
    light_make(live);
}

enum script_status script_live_open(const struct script_live_def *def, struct script_live **out)
{
    *out = NULL;
    struct script_live *live = calloc(1, sizeof *live);
    if (!live) {
        def->error(def->context, "no memory for a live script");
        return SCRIPT_FAILED;
    }
    live_configure(live, def);
    live->L = script_answers_open(&live->script);
    bool good = false;
    if (live->L)
        good = live_call(live, open_protected, live, def->open_s);
    else
        def->error(def->context, "no memory for a live script");
    live->def.text = NULL;
    live->opened = true;
    if (!good) {
        script_live_close(live);
        return SCRIPT_FAILED;
    }
    *out = live;
    return SCRIPT_OK;
}

void script_live_close(struct script_live *live)
{
    if (!live)
        return;
    script_answers_close(&live->script, live->L);
    free(live);
}
