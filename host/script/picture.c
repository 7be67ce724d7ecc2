/* picture.c - pictures in scripts, and their separation into a paper's pigments. */
#include "script_paper.h"

#include <display.h>
#include <separate.h>
#include <techniques.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

const uint8_t *script_picture_pixels(lua_State *L, int index, int *width, int *height)
{
    const struct script_picture *picture = luaL_testudata(L, index, script_picture_type);
    if (!picture)
        return NULL;
    *width = picture->width;
    *height = picture->height;
    return picture->rgb;
}

static uint8_t byte_of(double value)
{
    return (uint8_t)lround(255 * (value > 0 ? value < 1 ? value : 1 : 0));
}

/* picture("photo.png"), or picture(width, height, function(x, y) return red, green, blue
 * end) */
static int make_picture(lua_State *L)
{
    if (lua_type(L, 1) == LUA_TSTRING) {
        const char *path =
            script_path(L, script_of(L)->config->in_folder, lua_tostring(L, 1), "picture");
        struct script_picture *read = lua_newuserdatauv(L, sizeof *read, 0);
        struct display_image image;
        *read = (struct script_picture){.script = script_of(L)};
        luaL_setmetatable(L, script_picture_type);
        script_memory_hold(L, display_png_bytes(path, 3), "a picture");
        const int hold = lua_gettop(L);
        if (display_png_read_rgb(path, &image) != DISPLAY_OK)
            script_fail(L, display_error());
        read->rgb = image.pixels;
        read->width = image.width_px;
        read->height = image.height_px;
        script_memory_release(L, hold);
        lua_settop(L, hold - 1);
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
            script_callback(L, 2, 3);
            for (int c = 0; c < 3; c++)
                *at++ = byte_of(lua_tonumber(L, c - 3));
            lua_pop(L, 3);
        }
    return 1;
}

/* paper:picture([{light =}]): the paper's present look */
static int paper_picture(lua_State *L)
{
    static const char *const keys[] = {"light", NULL};
    struct paper_sheet *sheet = script_paper_begin(L, 2)->sheet;
    script_arg_options(L, 2, "picture", keys);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    size_t count = 3 * (size_t)config->width * (size_t)config->height;
    struct script_picture *picture = picture_new(L, config->width, config->height);
    picture_allocate(L, picture);
    uint16_t *rgb = lua_newuserdatauv(L, count * sizeof *rgb, 0);
    struct paper_sheet_view view = paper_sheet_view_default(config);
    view.light = script_arg_number(L, 2, "picture", "light", view.light, 0, 4);
    script_paper_check(L, paper_sheet_view(sheet, &view, rgb));
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

/* The mean of the area of a picture, scaled to width x height, that falls on pixel x, y; in
 * linear light. */
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

/* The pigments named in field "pigments", in the sheet's order; all if it is missing. */
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
        if (all || chosen[i])
            number[s->pigments_count++] = i;
    if (s->pigments_count == 0)
        luaL_error(L, "a separation needs pigments");
    paper_separation_choose(s, config, number, s->pigments_count);
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

/* paper:separate(picture [, {x =, y =, width =, height =, pigments =, most =, thrift =,
 * strength =, water =, mask =}]) */
static int paper_separate_picture(lua_State *L)
{
    static const char *const keys[] = {"x",        "y",    "width",  "height",
                                       "pigments", "most", "thrift", "strength",
                                       "water",    "mask", NULL};
    struct paper_sheet *sheet = script_paper_begin(L, 3)->sheet;
    const struct script_picture *picture = luaL_checkudata(L, 2, script_picture_type);
    script_arg_options(L, 3, "separate", keys);
    struct paper_separation s = paper_separation_of(paper_sheet_get_config(sheet));
    struct paper_print print = {0};
    int number[PAPER_PIGMENTS_MAX];
    print.x = script_arg_integer(L, 3, "separate", "x", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    print.y = script_arg_integer(L, 3, "separate", "y", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
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
    if (!script_mask_place(L, 3, sheet, &screen, &place))
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

const luaL_Reg script_picture_functions[] = {{"picture", make_picture}, {NULL, NULL}};

const luaL_Reg script_picture_paper_methods[] = {
    {"picture", paper_picture}, {"separate", paper_separate_picture}, {NULL, NULL}};

const luaL_Reg script_picture_methods[] = {{"size", picture_size}, {NULL, NULL}};

void script_picture_open(lua_State *L)
{
    script_type_open(L, script_picture_type, picture_gc);
}
