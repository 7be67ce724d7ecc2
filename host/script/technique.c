/* technique.c - washes, splatter, salt, lifting and varnish in scripts; pictures and their separation into pigments. */
#include "script_internal.h"

#include <display.h>
#include <separate.h>
#include <techniques.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char script_picture_type[] = "lutetia picture";

enum { PLACE_MAX = 100000, SEED_MAX = 2147483647 };
#define PI 3.14159265358979323846

/* The mask in field "mask" of the table at index, kept on the stack; missing: everywhere. False: it covers nothing. */
static bool place_read(lua_State *L, int index, const struct paper_sheet *sheet,
                       struct paper_screen *screen, struct paper_place *place)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    *place = (struct paper_place){0};
    if (lua_getfield(L, index, "mask") == LUA_TNIL) {
        lua_pop(L, 1);
        return true;
    }
    if (!script_mask_screen(L, lua_gettop(L), config->width, config->height, screen, &place->x,
                            &place->y))
        return false;
    place->screen = screen;
    return true;
}

/* Each kind of chance on a paper has seeds of its own, in the order of its calls. */
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
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    struct paper_wash wash = {0};
    struct paper_screen screen;
    lua_settop(L, 3);
    script_paper_amounts(L, 2, sheet, wash.amount);
    if (lua_isnil(L, 3)) {
        script_paper_check(L, paper_sheet_put(sheet, NULL, 0, 0, wash.amount));
        script_check(L);
        return 0;
    }
    luaL_checktype(L, 3, LUA_TTABLE);
    script_arg_keys(L, 3, "wash", keys);
    bool from = script_arg_numbers(L, 3, "wash", "from", wash.from, 2, -PLACE_MAX, PLACE_MAX);
    bool to = script_arg_numbers(L, 3, "wash", "to", wash.to, 2, -PLACE_MAX, PLACE_MAX);
    memcpy(wash.end, wash.amount, sizeof wash.end);
    bool into = lua_getfield(L, 3, "into") != LUA_TNIL;
    if (into)
        script_paper_amounts(L, lua_gettop(L), sheet, wash.end);
    if (from != to || from != into)
        luaL_error(L, "a graded wash needs from, to and into");
    if (place_read(L, 3, sheet, &screen, &wash.place))
        script_paper_check(L, paper_sheet_wash(sheet, &wash));
    script_check(L);
    return 0;
}

/* paper:lift(mask, part) */
static int paper_lift(lua_State *L)
{
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    struct paper_lift lift = {.part = script_arg_at(L, 3, "lift's part", 0, 1)};
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
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    struct paper_varnish varnish = {
        .amount = lua_isnoneornil(L, 3) ? 1 : script_arg_at(L, 3, "varnish's amount", 0, 1)};
    if (script_mask_screen(L, 2, config->width, config->height, &screen, &varnish.place.x,
                           &varnish.place.y)) {
        varnish.place.screen = &screen;
        script_paper_check(L, paper_sheet_varnish(sheet, &varnish));
    }
    script_check(L);
    return 0;
}

/* size = {least, most}, or one for both */
static void size_read(lua_State *L, const char *what, double size[2], double least, double most)
{
    script_arg_numbers(L, 2, what, "size", size, 2, least, most);
    if (size[1] < size[0])
        luaL_error(L, "%s size must be {least, most} (got {%f, %f})", what, size[0], size[1]);
}

/* paper:splatter({x =, y =, radius =, drops =, size =, angle =, thrown =, seed =}, {water =, ...}) */
static int paper_splatter(lua_State *L)
{
    static const char *const keys[] = {"x",     "y",      "radius", "drops", "size",
                                       "angle", "thrown", "seed",   NULL};
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    luaL_checktype(L, 2, LUA_TTABLE);
    lua_settop(L, 3);
    script_arg_keys(L, 2, "splatter", keys);
    struct paper_splatter s = {.size = {0.6, 4}};
    s.x = script_arg_number(L, 2, "splatter", "x", config->width / 2.0, -PLACE_MAX, PLACE_MAX);
    s.y = script_arg_number(L, 2, "splatter", "y", config->height / 2.0, -PLACE_MAX, PLACE_MAX);
    s.radius = script_arg_number(L, 2, "splatter", "radius", 80, 0, PLACE_MAX);
    s.drops = script_arg_integer(L, 2, "splatter", "drops", 60, 1, 100000);
    s.toward = script_arg_number(L, 2, "splatter", "angle", 0, -36000, 36000) * PI / 180;
    s.thrown = script_arg_number(L, 2, "splatter", "thrown", 0, 0, 4);
    size_read(L, "splatter", s.size, 0.1, 500);
    s.seed = seed_read(L, 2, "splatter");
    script_paper_amounts(L, 3, sheet, s.amount);
    script_paper_check(L, paper_sheet_splatter(sheet, &s));
    script_check(L);
    return 0;
}

/* paper:salt{x =, y =, radius =, grains =, size =, strength =, reach =, mask =, seed =} */
static int paper_salt(lua_State *L)
{
    static const char *const keys[] = {"x",        "y",     "radius", "grains", "size",
                                       "strength", "reach", "mask",   "seed",   NULL};
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    struct paper_screen screen;
    script_arg_table(L, 2);
    script_arg_keys(L, 2, "salt", keys);
    struct paper_salt s = {.size = {0.7, 1.6}};
    s.x = script_arg_number(L, 2, "salt", "x", config->width / 2.0, -PLACE_MAX, PLACE_MAX);
    s.y = script_arg_number(L, 2, "salt", "y", config->height / 2.0, -PLACE_MAX, PLACE_MAX);
    s.radius = script_arg_number(L, 2, "salt", "radius",
                                 hypot(config->width, config->height) / 2, 0, PLACE_MAX);
    s.grains = script_arg_integer(L, 2, "salt", "grains", 100, 1, 100000);
    size_read(L, "salt", s.size, 0.1, 50);
    s.strength = script_arg_number(L, 2, "salt", "strength", 1, 0, 4);
    s.reach = script_arg_number(L, 2, "salt", "reach", 10, 1, 100);
    s.seed = seed_read(L, 2, "salt");
    if (place_read(L, 2, sheet, &screen, &s.place))
        script_paper_check(L, paper_sheet_salt(sheet, &s));
    script_check(L);
    return 0;
}

/* ---- pictures ---- */

struct script_picture {
    struct script *script;
    int width, height;
    uint8_t *rgb;
    double bytes;
};

static struct script_picture *picture_new(lua_State *L, int width, int height)
{
    double bytes = 3.0 * width * height;
    struct script_picture *picture = lua_newuserdatauv(L, sizeof *picture, 0);
    *picture =
        (struct script_picture){.script = script_of(L), .width = width, .height = height};
    luaL_setmetatable(L, script_picture_type);
    script_memory_take(L, bytes, "a picture");
    picture->bytes = bytes;
    return picture;
}

static int picture_gc(lua_State *L)
{
    struct script_picture *picture = luaL_checkudata(L, 1, script_picture_type);
    free(picture->rgb);
    script_memory_give(picture->script, picture->bytes);
    *picture = (struct script_picture){.script = picture->script};
    return 0;
}

static void picture_allocate(lua_State *L, struct script_picture *picture)
{
    picture->rgb = calloc((size_t)picture->width * (size_t)picture->height, 3);
    if (!picture->rgb)
        luaL_error(L, "no memory for a picture of %dx%d", picture->width, picture->height);
}

static uint8_t byte_of(double value)
{
    return (uint8_t)lround(255 * (value > 0 ? value < 1 ? value : 1 : 0));
}

/* picture("photo.png"), or picture(width, height, function(x, y) return red, green, blue end) */
static int make_picture(lua_State *L)
{
    if (lua_type(L, 1) == LUA_TSTRING) {
        const char *path =
            script_path(L, script_of(L)->config->in_folder, lua_tostring(L, 1), "picture");
        struct script_picture *read = lua_newuserdatauv(L, sizeof *read, 0);
        struct display_image image;
        *read = (struct script_picture){.script = script_of(L)};
        luaL_setmetatable(L, script_picture_type);
        if (display_png_read_rgb(path, &image) != DISPLAY_OK)
            luaL_error(L, "%s", display_error());
        read->rgb = image.pixels;
        read->width = image.width_px;
        read->height = image.height_px;
        double bytes = 3.0 * read->width * read->height;
        script_memory_take(L, bytes, "a picture");
        read->bytes = bytes;
        return 1;
    }
    int width = (int)floor(script_arg_at(L, 1, "picture's width", 1, PAPER_SIDE_MAX));
    int height = (int)floor(script_arg_at(L, 2, "picture's height", 1, PAPER_SIDE_MAX));
    luaL_checktype(L, 3, LUA_TFUNCTION);
    struct script_picture *picture = picture_new(L, width, height);
    picture_allocate(L, picture);
    uint8_t *at = picture->rgb;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            lua_pushvalue(L, 3);
            lua_pushinteger(L, x);
            lua_pushinteger(L, y);
            lua_call(L, 2, 3);
            for (int c = 0; c < 3; c++)
                *at++ = byte_of(lua_tonumber(L, c - 3));
            lua_pop(L, 3);
        }
    return 1;
}

/* paper:picture(): what it looks like now */
static int paper_picture(lua_State *L)
{
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    size_t count = 3 * (size_t)config->width * (size_t)config->height;
    struct script_picture *picture = picture_new(L, config->width, config->height);
    picture_allocate(L, picture);
    uint16_t *rgb = lua_newuserdatauv(L, count * sizeof *rgb, 0);
    script_paper_check(L, paper_sheet_view(sheet, &(struct paper_sheet_view){.high = 1}, rgb));
    for (size_t i = 0; i < count; i++)
        picture->rgb[i] = (uint8_t)((rgb[i] * 255u + 32767) / 65535);
    lua_pop(L, 1);
    return 1;
}

/* picture:size() */
static int picture_size(lua_State *L)
{
    const struct script_picture *picture = luaL_checkudata(L, 1, script_picture_type);
    lua_pushinteger(L, picture->width);
    lua_pushinteger(L, picture->height);
    return 2;
}

/* The mean of what falls on pixel x, y of a picture that is width x height large; in linear light. */
static void sampled(const struct script_picture *picture, const float *linear, int width,
                    int height, int x, int y, uint8_t rgb[3])
{
    double x1 = (double)x * picture->width / width, x2 = (x + 1.0) * picture->width / width;
    double y1 = (double)y * picture->height / height, y2 = (y + 1.0) * picture->height / height;
    double sum[3] = {0}, all = 0;
    for (int row = (int)y1; row < picture->height && row < y2; row++)
        for (int column = (int)x1; column < picture->width && column < x2; column++) {
            double part =
                (fmin(x2, column + 1) - fmax(x1, column)) * (fmin(y2, row + 1) - fmax(y1, row));
            const uint8_t *at =
                picture->rgb + 3 * ((size_t)row * (size_t)picture->width + (size_t)column);
            for (int c = 0; c < 3; c++)
                sum[c] += part * (double)linear[at[c]];
            all += part;
        }
    for (int c = 0; c < 3; c++)
        rgb[c] = byte_of(paper_light_display(sum[c] / all));
}

/* The pigments that field "pigments" names, in the order of the sheet's; all without it. */
static void pigments_choose(lua_State *L, struct paper_sheet *sheet, struct paper_separation *s,
                            int number[PAPER_PIGMENTS_MAX])
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    bool chosen[PAPER_PIGMENTS_MAX] = {false}, all = lua_getfield(L, 3, "pigments") == LUA_TNIL;
    if (!all)
        luaL_checktype(L, -1, LUA_TTABLE);
    for (int i = 1, count = all ? 0 : (int)lua_rawlen(L, -1); i <= count; i++) {
        if (lua_rawgeti(L, -1, i) != LUA_TSTRING)
            luaL_error(L, "separate pigments must be names (got a %s)", luaL_typename(L, -1));
        chosen[script_paper_pigment_number_of(L, sheet, lua_tostring(L, -1))] = true;
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    s->pigments_count = 0;
    for (int i = 0; i < config->pigments_count; i++)
        if (all || chosen[i]) {
            number[s->pigments_count] = i;
            s->pigments[s->pigments_count++] = config->pigments[i];
        }
    if (s->pigments_count == 0)
        luaL_error(L, "a separation needs pigments");
}

/* amounts *= the mask's values */
static void mask_apply(lua_State *L, const struct paper_place *place, struct paper_print *print,
                       float *const *planes, int count)
{
    for (int row = 0; row < print->height; row++)
        for (int column = 0; column < print->width; column++) {
            int x = print->x + column - place->x, y = print->y + row - place->y;
            bool there =
                x >= 0 && y >= 0 && x < place->screen->width_px && y < place->screen->height_px;
            float share =
                there
                    ? place->screen
                              ->gray[(size_t)y * (size_t)place->screen->width_px + (size_t)x] /
                          255.0f
                    : 0;
            for (int i = 0; i < count; i++)
                planes[i][(size_t)row * (size_t)print->width + (size_t)column] *= share;
        }
    script_check(L);
}

/* paper:separate(picture [, {x =, y =, width =, height =, pigments =, most =, thrift =, strength =, water =, mask =}]) */
static int paper_separate_picture(lua_State *L)
{
    static const char *const keys[] = {"x",        "y",    "width",  "height",
                                       "pigments", "most", "thrift", "strength",
                                       "water",    "mask", NULL};
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    const struct script_picture *picture = luaL_checkudata(L, 2, script_picture_type);
    script_arg_table(L, 3);
    script_arg_keys(L, 3, "separate", keys);
    struct paper_separation s = paper_separation_of(paper_sheet_get_config(sheet));
    struct paper_print print = {0};
    int number[PAPER_PIGMENTS_MAX];
    print.x = script_arg_integer(L, 3, "separate", "x", 0, -PLACE_MAX, PLACE_MAX);
    print.y = script_arg_integer(L, 3, "separate", "y", 0, -PLACE_MAX, PLACE_MAX);
    print.width =
        script_arg_integer(L, 3, "separate", "width", picture->width, 1, PAPER_SIDE_MAX);
    print.height =
        script_arg_integer(L, 3, "separate", "height", picture->height, 1, PAPER_SIDE_MAX);
    s.most = script_arg_number(L, 3, "separate", "most", s.most, 0.01, 4);
    s.thrift = script_arg_number(L, 3, "separate", "thrift", s.thrift, 0, 10);
    double strength = script_arg_number(L, 3, "separate", "strength", 1, 0, 1);
    double water = script_arg_number(L, 3, "separate", "water", 0, 0, 4);
    pigments_choose(L, sheet, &s, number);

    size_t count = (size_t)print.width * (size_t)print.height;
    float linear[256], *planes[1 + PAPER_PIGMENTS_MAX];
    script_memory_take(L, (double)count * (3 + 4.0 * (1 + s.pigments_count)), "a separation");
    script_memory_give(script_of(L), (double)count * (3 + 4.0 * (1 + s.pigments_count)));
    uint8_t *rgb = lua_newuserdatauv(L, 3 * count, 0);
    for (int i = 0; i < 256; i++)
        linear[i] = (float)paper_light_linear(i / 255.0);
    for (int y = 0; y < print.height; y++) {
        for (int x = 0; x < print.width; x++)
            sampled(picture, linear, print.width, print.height, x, y,
                    rgb + 3 * ((size_t)y * (size_t)print.width + (size_t)x));
        script_check(L);
    }
    for (int i = 0; i <= s.pigments_count; i++)
        planes[i] = lua_newuserdatauv(L, count * sizeof(float), 0);
    script_paper_check(L, paper_separate(&s, rgb, count, planes));
    script_check(L);
    for (size_t i = 0; i < count; i++) {
        for (int j = 0; j < s.pigments_count; j++)
            planes[j][i] *= (float)strength;
        planes[s.pigments_count][i] = (float)water;
    }
    struct paper_screen screen;
    struct paper_place place;
    if (!place_read(L, 3, sheet, &screen, &place))
        return 0;
    if (place.screen)
        mask_apply(L, &place, &print, planes, s.pigments_count + 1);
    for (int j = 0; j < s.pigments_count; j++)
        print.amount[1 + number[j]] = planes[j];
    if (water > 0)
        print.amount[0] = planes[s.pigments_count];
    script_paper_check(L, paper_sheet_print(sheet, &print));
    script_check(L);
    return 0;
}

const luaL_Reg script_technique_methods[] = {{"wash", paper_wash},
                                             {"lift", paper_lift},
                                             {"varnish", paper_varnish},
                                             {"splatter", paper_splatter},
                                             {"salt", paper_salt},
                                             {"picture", paper_picture},
                                             {"separate", paper_separate_picture},
                                             {NULL, NULL}};

const luaL_Reg script_technique_functions[] = {{"picture", make_picture}, {NULL, NULL}};

const luaL_Reg script_picture_methods[] = {{"size", picture_size}, {NULL, NULL}};

void script_technique_open(lua_State *L)
{
    script_type_open(L, script_picture_type, picture_gc);
}
