/* brush.c - brushes in scripts: paper:brush{...}, and their methods. */
#include "script_brush.h"

#include <brush.h>
#include <describe.h>
#include <history.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static struct script_brush *brush_at(lua_State *L, int index)
{
    return luaL_checkudata(L, index, script_brush_type);
}

/* Sets the number of a brush method's arguments, and pins the brush's paper, which the brush
 * references. Above the arguments are the paper and the pin. */
static struct script_paper *brush_begin(lua_State *L, int count)
{
    lua_settop(L, count);
    brush_at(L, 1);
    lua_getiuservalue(L, 1, 1);
    return script_paper_pin(L, count + 1);
}

/* ---- making ---- */

static void kind_set(lua_State *L, struct paper_brush *brush, const char *kind)
{
    luaL_Buffer list;
    if (paper_brush_of_kind(brush, kind ? kind : paper_brush_kind(0)))
        return;
    luaL_buffinit(L, &list);
    for (int i = 0; paper_brush_kind(i); i++) {
        luaL_addstring(&list, i ? ", " : "");
        luaL_addstring(&list, paper_brush_kind(i));
    }
    luaL_pushresult(&list);
    luaL_error(L, "brush kind must be one of %s (got '%s')", lua_tostring(L, -1), kind);
}

/* paper:brush{...} */
static int paper_brush(lua_State *L)
{
    static const char *const besides[] = {"kind", "seed", "number", NULL};
    struct script_paper *paper = script_paper_begin(L, 2);
    struct paper_sheet *sheet = paper->sheet;
    script_fields_options(L, 2, "brush", &paper_brush_members, besides);
    const char *kind = script_arg_text(L, 2, "brush", "kind");
    struct paper_brush b = paper_brush_default();
    kind_set(L, &b, kind);
    int free_one = 0;
    while (free_one < PAPER_BRUSHES_MAX && paper_history_brush(sheet, free_one))
        free_one++;
    b.number =
        script_arg_integer(L, 2, "brush", "number", free_one + 1, 1, PAPER_BRUSHES_MAX + 1) - 1;
    if (b.number == PAPER_BRUSHES_MAX)
        luaL_error(L, "a paper has up to %d brushes; number = 1 replaces the first",
                   PAPER_BRUSHES_MAX);
    script_fields_read(L, 2, "brush", &paper_brush_members, &b);
    kind_set(L, &b, kind); /* once more: defaults depend on the width */
    b.follows = b.flat && lua_getfield(L, 2, "angle") == LUA_TNIL;
    script_fields_read(L, 2, "brush", &paper_brush_members, &b);
    b.seed = (uint64_t)script_arg_integer(L, 2, "brush", "seed", b.number + 1, 0, 2147483647);

    struct script_brush *own = lua_newuserdatauv(L, sizeof *own, 1);
    *own = (struct script_brush){.number = b.number, .width = b.width};
    luaL_setmetatable(L, script_brush_type);
    lua_pushvalue(L, 1);
    lua_setiuservalue(L, -2, 1);
    if (!paper->brushes_counted) { /* the memory of all brushes is counted once, until the
                                    * paper is closed */
        double bytes = 8e6 + 2.0 * paper_sheet_get_config(sheet)->width *
                                 paper_sheet_get_config(sheet)->height;
        script_memory_take(L, bytes, "brushes");
        paper->bytes += bytes;
        paper->brushes_counted = true;
    }
    script_paper_check(L, paper_sheet_brush(sheet, &b));
    return 1;
}

/* ---- dipping ---- */

static struct paper_dip dip_of(lua_State *L)
{
    return (struct paper_dip){.number = brush_at(L, 1)->number, .part = 1, .side = {-1, 1}};
}

static bool amounts_none(const double *amount)
{
    for (int i = 0; i <= PAPER_PIGMENTS_MAX; i++)
        if (amount[i] != 0)
            return false;
    return true;
}

/* brush:dip({water = 1, ["burnt umber"] = 0.5} [, {part =, side = {from, to}}]) */
static int brush_dip(lua_State *L)
{
    struct script_paper *paper = brush_begin(L, 3);
    struct paper_dip d = dip_of(L);
    script_paper_amounts(L, 2, paper->sheet, d.amount);
    script_fields_options(L, 3, "dip", &paper_dip_members, NULL);
    script_fields_read(L, 3, "dip", &paper_dip_members, &d);
    script_paper_check(L, paper_sheet_dip(paper->sheet, &d));
    brush_at(L, 1)->dipped = true;
    if (amounts_none(d.amount))
        script_note_once(L, SCRIPT_DIPPED_IN_NOTHING,
                         "dip: the brush takes nothing, since water and pigments are 0; "
                         "brush:wipe() dries it");
    return 0;
}

/* brush:rinse([water]): clean water only */
static int brush_rinse(lua_State *L)
{
    struct script_paper *paper = brush_begin(L, 2);
    struct paper_dip d = dip_of(L);
    d.amount[0] = lua_isnil(L, 2) ? 1 : script_arg_at(L, 2, "rinse's water", 0, 1);
    script_paper_check(L, paper_sheet_dip(paper->sheet, &d));
    brush_at(L, 1)->dipped = true;
    return 0;
}

/* brush:wipe([part]): on a cloth */
static int brush_wipe(lua_State *L)
{
    struct script_paper *paper = brush_begin(L, 2);
    struct paper_dip d = dip_of(L);
    d.part = script_member_at(L, 2, "wipe's part", &paper_dip_members, "part", 1);
    script_paper_check(L, paper_sheet_dip(paper->sheet, &d));
    return 0;
}

/* brush:holds("water"), in units */
static int brush_holds(lua_State *L)
{
    struct script_paper *paper = brush_begin(L, 2);
    const char *name = luaL_checkstring(L, 2);
    int substance = strcmp(name, "water") == 0
                        ? 0
                        : 1 + script_paper_pigment_number_of(L, paper->sheet, name);
    double total;
    script_paper_check(
        L, paper_sheet_brush_total(paper->sheet, brush_at(L, 1)->number, substance, &total));
    lua_pushnumber(L, total);
    return 1;
}

const luaL_Reg script_brush_paper_methods[] = {{"brush", paper_brush}, {NULL, NULL}};

const luaL_Reg script_brush_methods[] = {{"dip", brush_dip},
                                         {"rinse", brush_rinse},
                                         {"wipe", brush_wipe},
                                         {"holds", brush_holds},
                                         {NULL, NULL}};

void script_brush_open(lua_State *L)
{
    script_type_open(L, script_brush_type, NULL);
}
