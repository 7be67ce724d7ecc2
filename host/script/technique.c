/* technique.c - washes, splatter, salt, lifting and varnish in scripts. */
#include "script_paper.h"

#include <describe.h>
#include <techniques.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SEED_MAX = 2147483647 };
#define PI 3.14159265358979323846

/* Each random technique of a paper has its own sequence of seeds, in the order of its calls. */
static uint64_t seed_read(lua_State *L, int index, const char *what)
{
    struct script *script = script_of(L);
    uint64_t count = script->seeds++ % SEED_MAX;
    return (uint64_t)script_arg_integer(
        L, index, what, "seed", (int)((script->config->seed * 1000003u + count) % SEED_MAX), 0,
        SEED_MAX);
}

/* ---- washes ---- */

/* paper:wash({water =, ...} [, {from = {x, y}, to = {x, y}, into = {water =, ...}, mask =}]) */
static int paper_wash(lua_State *L)
{
    static const char *const keys[] = {"from", "to", "into", "mask", NULL};
    struct paper_sheet *sheet = script_paper_begin(L, 3)->sheet;
    struct paper_wash wash = {0};
    struct paper_screen screen;
    script_paper_amounts(L, 2, sheet, wash.amount);
    if (lua_isnil(L, 3)) {
        script_paper_check(L, paper_sheet_put(sheet, NULL, 0, 0, wash.amount));
        script_check(L);
        return 0;
    }
    script_arg_options(L, 3, "wash", keys);
    bool from = script_arg_numbers(L, 3, "wash", "from", wash.from, 2, -SCRIPT_PLACE_MAX,
                                   SCRIPT_PLACE_MAX);
    bool to =
        script_arg_numbers(L, 3, "wash", "to", wash.to, 2, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    memcpy(wash.end, wash.amount, sizeof wash.end);
    bool into = lua_getfield(L, 3, "into") != LUA_TNIL;
    if (into)
        script_paper_amounts(L, lua_gettop(L), sheet, wash.end);
    if (from != to || from != into)
        luaL_error(L, "a graded wash needs from, to and into");
    if (script_mask_place(L, 3, sheet, &screen, &wash.place))
        script_paper_check(L, paper_sheet_wash(sheet, &wash));
    script_check(L);
    return 0;
}

/* paper:lift(mask, part) */
static int paper_lift(lua_State *L)
{
    struct paper_sheet *sheet = script_paper_begin(L, 3)->sheet;
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    struct paper_lift lift = {
        .part = script_member_at(L, 3, "lift's part", &paper_lift_members, "part", NAN)};
    if (script_mask_screen(L, 2, config->width, config->height, &screen, &lift.place.x,
                           &lift.place.y)) {
        lift.place.screen = &screen;
        script_paper_check(L, paper_sheet_lift(sheet, &lift));
    }
    script_check(L);
    return 0;
}

/* paper:varnish(mask [, amount]) */
static int paper_varnish(lua_State *L)
{
    struct paper_sheet *sheet = script_paper_begin(L, 3)->sheet;
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    struct paper_varnish varnish = {
        .amount =
            script_member_at(L, 3, "varnish's amount", &paper_varnish_members, "amount", 1)};
    if (script_mask_screen(L, 2, config->width, config->height, &screen, &varnish.place.x,
                           &varnish.place.y)) {
        varnish.place.screen = &screen;
        script_paper_check(L, paper_sheet_varnish(sheet, &varnish));
    }
    script_check(L);
    return 0;
}

/* size = {least, most}, or one for both */
static void size_check(lua_State *L, const char *what, const double size[2])
{
    if (size[1] < size[0])
        luaL_error(L, "%s size must be {least, most} (got {%f, %f})", what, size[0], size[1]);
}

/* paper:splatter({x =, y =, radius =, drops =, size =, angle =, thrown =, seed =}, {water =,
 * ...}) */
static int paper_splatter(lua_State *L)
{
    static const char *const besides[] = {"seed", NULL};
    struct paper_sheet *sheet = script_paper_begin(L, 3)->sheet;
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    luaL_checktype(L, 2, LUA_TTABLE);
    script_fields_options(L, 2, "splatter", &paper_splatter_members, besides);
    struct paper_splatter s = {.x = config->width / 2.0,
                               .y = config->height / 2.0,
                               .radius = 80,
                               .drops = 60,
                               .size = {0.6, 4}};
    script_fields_read(L, 2, "splatter", &paper_splatter_members, &s);
    size_check(L, "splatter", s.size);
    s.seed = seed_read(L, 2, "splatter");
    script_paper_amounts(L, 3, sheet, s.amount);
    script_paper_check(L, paper_sheet_splatter(sheet, &s));
    script_check(L);
    return 0;
}

/* paper:salt{x =, y =, radius =, grains =, size =, strength =, reach =, mask =, seed =} */
static int paper_salt(lua_State *L)
{
    static const char *const besides[] = {"mask", "seed", NULL};
    struct paper_sheet *sheet = script_paper_begin(L, 2)->sheet;
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    script_fields_options(L, 2, "salt", &paper_salt_members, besides);
    struct paper_salt s = {.x = config->width / 2.0,
                           .y = config->height / 2.0,
                           .radius = hypot(config->width, config->height) / 2,
                           .grains = 100,
                           .size = {0.7, 1.6},
                           .strength = 1,
                           .reach = 10};
    script_fields_read(L, 2, "salt", &paper_salt_members, &s);
    size_check(L, "salt", s.size);
    s.seed = seed_read(L, 2, "salt");
    if (script_mask_place(L, 2, sheet, &screen, &s.place))
        script_paper_check(L, paper_sheet_salt(sheet, &s));
    script_check(L);
    return 0;
}

const luaL_Reg script_technique_methods[] = {
    {"wash", paper_wash},         {"lift", paper_lift}, {"varnish", paper_varnish},
    {"splatter", paper_splatter}, {"salt", paper_salt}, {NULL, NULL}};
