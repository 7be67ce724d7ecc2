/* paper_look.c - reading papers in scripts: layers as numbers, masks and functions; totals;
 * pictures. */
#include "script_paper.h"

#include <display.h>
#include <history.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- layers ---- */

static const char *const layer_names[] = {[PAPER_LAYER_HEIGHT] = "height",
                                          [PAPER_LAYER_ABSORBENCY] = "absorbency",
                                          [PAPER_LAYER_CAPACITY] = "capacity",
                                          [PAPER_LAYER_RESIST] = "resist",
                                          [PAPER_LAYER_VARNISH] = "varnish",
                                          [PAPER_LAYER_SALT] = "salt",
                                          [PAPER_LAYER_BRINE] = "brine",
                                          [PAPER_LAYER_RED] = "red",
                                          [PAPER_LAYER_GREEN] = "green",
                                          [PAPER_LAYER_BLUE] = "blue",
                                          [PAPER_LAYER_SURFACE_WATER] = "surface water",
                                          [PAPER_LAYER_INFUSED_WATER] = "infused water",
                                          [PAPER_LAYER_DRIED_WATER] = "dried water",
                                          [PAPER_LAYER_SURFACE_PIGMENT] = "surface pigment",
                                          [PAPER_LAYER_INFUSED_PIGMENT] = "infused pigment",
                                          [PAPER_LAYER_FIXED_PIGMENT] = "fixed pigment",
                                          [PAPER_LAYER_SIZING] = "sizing",
                                          [PAPER_LAYER_CURRENT] = "current",
                                          [PAPER_LAYER_WET_PART] = "wet part",
                                          [PAPER_LAYER_GRIP] = "grip",
                                          [PAPER_LAYER_THICKNESS] = "thickness",
                                          [PAPER_LAYER_STAINED_PART] = "stained part",
                                          [PAPER_LAYERS_COUNT] = NULL};

/* Finds the layer of that name, and its pigment if it has one. */
static enum paper_layer layer_read(lua_State *L, const struct script_paper *paper,
                                   const char *name, const char *pigment_name, int *pigment)
{
    enum paper_layer layer =
        (enum paper_layer)script_arg_choice(L, "a layer", name, layer_names);
    *pigment = 0;
    if (layer < PAPER_LAYER_SURFACE_PIGMENT || layer > PAPER_LAYER_FIXED_PIGMENT)
        return layer;
    if (!pigment_name)
        luaL_error(L, "layer '%s' needs a pigment's name", name);
    *pigment = script_paper_pigment_number_of(L, paper->sheet, pigment_name);
    return layer;
}

/* The same for names in the arguments at index and pigment_index. */
static enum paper_layer layer_arg(lua_State *L, const struct script_paper *paper, int index,
                                  int pigment_index, int *pigment)
{
    return layer_read(L, paper, luaL_checkstring(L, index),
                      luaL_optstring(L, pigment_index, NULL), pigment);
}

/* A buffer, freed by the state, with a number for each fiber. */
static float *values_new(lua_State *L, const struct paper_sheet_config *config)
{
    return lua_newuserdatauv(L, (size_t)config->width * (size_t)config->height * sizeof(float),
                             0);
}

/* paper:layer(name, value [, pigment]): value is a number, a mask, or a function of x and y. */
static int paper_layer(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 4);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    int pigment, x = 0, y = 0;
    enum paper_layer layer = layer_arg(L, paper, 2, 4, &pigment);
    double range[2];
    char what[64];
    paper_sheet_layer_range(paper->sheet, layer, range);
    if (range[0] >= range[1]) /* it is refused below */
        range[1] = 1e6;
    snprintf(what, sizeof what, "a layer's value (%s)", layer_names[layer]);
    size_t width = (size_t)config->width, count = width * (size_t)config->height;
    float *values = values_new(L, config);
    memset(values, 0, count * sizeof *values);
    if (lua_type(L, 3) == LUA_TNUMBER) {
        double value = script_arg_at(L, 3, what, range[0], range[1]);
        for (size_t i = 0; i < count; i++)
            values[i] = (float)value;
    } else if (lua_type(L, 3) == LUA_TFUNCTION) {
        for (size_t i = 0; i < count; i++) {
            lua_pushvalue(L, 3);
            lua_pushinteger(L, (lua_Integer)(i % width));
            lua_pushinteger(L, (lua_Integer)(i / width));
            script_callback(L, 2, 1);
            values[i] = (float)script_arg_at(L, -1, what, range[0], range[1]);
            lua_pop(L, 1);
        }
    } else {
        struct paper_screen screen;
        if (script_mask_screen(L, 3, config->width, config->height, &screen, &x, &y))
            for (int row = 0; row < screen.height_px; row++)
                for (int column = 0; column < screen.width_px; column++) {
                    int at_x = x + column, at_y = y + row;
                    if (at_x >= 0 && at_y >= 0 && at_x < config->width && at_y < config->height)
                        values[(size_t)at_y * width + (size_t)at_x] =
                            screen
                                .gray[(size_t)row * (size_t)screen.width_px + (size_t)column] /
                            255.0f;
                }
    }
    script_paper_check(L, paper_sheet_layer_write(paper->sheet, layer, pigment, values));
    script_check(L);
    return 0;
}

/* paper:mask(name, low, high [, pigment]): a mask of a layer, 0 at low and 1 at high. */
static int paper_mask(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 5);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    int pigment;
    enum paper_layer layer = layer_arg(L, paper, 2, 5, &pigment);
    double low = lua_isnoneornil(L, 3) ? 0 : script_arg_at(L, 3, "a mask's black", -1e6, 1e6);
    double high = lua_isnoneornil(L, 4) ? 1 : script_arg_at(L, 4, "a mask's white", -1e6, 1e6);
    if (low == high)
        luaL_error(L, "a mask's black and white must differ");
    float *values = values_new(L, config);
    script_paper_check(L, paper_sheet_layer_read(paper->sheet, layer, pigment, values));
    size_t count = (size_t)config->width * (size_t)config->height;
    uint8_t *gray = lua_newuserdatauv(L, count, 0);
    for (size_t i = 0; i < count; i++)
        gray[i] =
            (uint8_t)lround(255 * fmin(1, fmax(0, ((double)values[i] - low) / (high - low))));
    script_mask_push(L, gray, config->width, config->height, 0, 0);
    return 1;
}

/* paper:at(name, x, y [, pigment]) */
static int paper_at_fiber(lua_State *L)
{
    if (lua_type(L, 2) == LUA_TNUMBER)
        return script_paper_at_time(L);
    struct script_paper *paper = script_paper_begin(L, 5);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    int pigment;
    enum paper_layer layer = layer_arg(L, paper, 2, 5, &pigment);
    double x = floor(script_arg_at(L, 3, "x", 0, config->width - 1));
    double y = floor(script_arg_at(L, 4, "y", 0, config->height - 1));
    float *values = values_new(L, config);
    script_paper_check(L, paper_sheet_layer_read(paper->sheet, layer, pigment, values));
    lua_pushnumber(L, (double)values[(size_t)y * (size_t)config->width + (size_t)x]);
    return 1;
}

static int paper_total_of(lua_State *L)
{
    struct script_paper *paper = script_paper_begin(L, 2);
    const char *name = luaL_checkstring(L, 2);
    int substance = strcmp(name, "water") == 0 ? 0
                    : strcmp(name, "dried") == 0
                        ? -1
                        : 1 + script_paper_pigment_number_of(L, paper->sheet, name);
    double total;
    script_paper_check(L, paper_sheet_total(paper->sheet, substance, &total));
    lua_pushnumber(L, total);
    return 1;
}

/* ---- looking ---- */

const char *const script_shows[] = {"color", "water", "wet", "layer", NULL};

/* What a sheet with a deckle lies on: a colour, the usual one, or (true) nothing. */
static bool ground_read(lua_State *L, const struct paper_sheet_config *config,
                        struct paper_sheet_view *view, double ground[3])
{
    lua_getfield(L, 3, "ground");
    const int type = lua_type(L, -1);
    const bool none = type == LUA_TSTRING && strcmp(lua_tostring(L, -1), "none") == 0;
    lua_pop(L, 1);
    if (type == LUA_TNIL)
        return false;
    if (!config->deckled)
        luaL_error(L, "frame ground is what paper with a deckle lies on; this paper has none");
    if (view->show != PAPER_SHOW_COLOR && view->show != PAPER_SHOW_WET)
        luaL_error(L, "frame ground goes with show = \"color\" or \"wet\"");
    if (!none && script_arg_color(L, 3, "frame", "ground", ground))
        view->ground = ground;
    return none;
}

/* Numbers of 16 bits as a PNG file with 8 or 16; alpha: its own channel, or NULL. */
static void frame_write(lua_State *L, const char *path, int width, int height, int bits,
                        const uint16_t *rgb, const uint16_t *alpha)
{
    const size_t pixels = (size_t)width * (size_t)height, channels = alpha ? 4 : 3,
                 count = channels * pixels;
    enum display_status status;
    const uint16_t *all = rgb;
    if (alpha) {
        uint16_t *joined = lua_newuserdatauv(L, count * sizeof *joined, 0);
        for (size_t i = 0; i < pixels; i++) {
            memcpy(joined + 4 * i, rgb + 3 * i, 3 * sizeof *rgb);
            joined[4 * i + 3] = alpha[i];
        }
        all = joined;
    }
    if (bits == 16) {
        status = display_png_write_16(path, width, height, (int)channels, all);
    } else {
        uint8_t *bytes = lua_newuserdatauv(L, count, 0);
        for (size_t i = 0; i < count; i++)
            bytes[i] = (uint8_t)((all[i] * 255u + 32767) / 65535);
        status = display_png_write(path, &(struct display_image){.width_px = width,
                                                                 .height_px = height,
                                                                 .channels = (int)channels,
                                                                 .pixels = bytes});
    }
    if (status != DISPLAY_OK)
        script_fail(L, display_error());
}

/* paper:frame("name.png" [, {show=, layer=, pigment=, low=, high=, bits=, light=, scale=,
 * ground=}]) */
static int paper_frame(lua_State *L)
{
    static const char *const keys[] = {"show", "layer", "pigment", "low",    "high",
                                       "bits", "light", "scale",   "ground", NULL};
    struct script_paper *paper = script_paper_begin(L, 3);
    const struct paper_sheet_config *config = paper_sheet_get_config(paper->sheet);
    const char *name = luaL_checkstring(L, 2);
    script_arg_options(L, 3, "frame", keys);
    struct paper_sheet_view view = paper_sheet_view_default(config);
    const char *show = script_arg_text(L, 3, "frame", "show"),
               *layer = script_arg_text(L, 3, "frame", "layer");
    if (layer) {
        view.show = PAPER_SHOW_LAYER;
        view.layer = layer_read(L, paper, layer, script_arg_text(L, 3, "frame", "pigment"),
                                &view.pigment);
    }
    if (show)
        view.show = (enum paper_show)script_arg_choice(L, "frame show", show, script_shows);
    view.low = script_arg_number(L, 3, "frame", "low", 0, -1e6, 1e6);
    view.high = script_arg_number(L, 3, "frame", "high", 1, -1e6, 1e6);
    view.light = script_arg_number(L, 3, "frame", "light", view.light, 0, 4);
    view.scale = script_arg_integer(L, 3, "frame", "scale", 1, 1, 4);
    if (view.scale == 3)
        luaL_error(L, "frame scale must be 1, 2 or 4 pixels a fiber (got 3)");
    int bits = script_arg_integer(L, 3, "frame", "bits", 8, 8, 16);
    if (bits != 8 && bits != 16)
        luaL_error(L, "frame bits must be 8 or 16 (got %d)", bits);
    double ground[3];
    const bool bare = ground_read(L, config, &view, ground);
    const char *path = script_path_to_write(L, name, ".png", "frame");

    if (paper_history_following(paper->sheet) > 0 && access(path, F_OK) == 0)
        return 0; /* written before this run was saved */
    const int width = config->width * view.scale, height = config->height * view.scale;
    size_t count = 3 * (size_t)width * (size_t)height;
    uint16_t *rgb = lua_newuserdatauv(L, count * sizeof *rgb, 0);
    if (bare)
        view.alpha = lua_newuserdatauv(L, count / 3 * sizeof *view.alpha, 0);
    const double besides = paper_sheet_view_bytes(config, view.scale);
    script_memory_take(L, besides, "a picture");
    const enum paper_status viewed = paper_sheet_view(paper->sheet, &view, rgb);
    script_memory_give(paper->script, besides);
    script_paper_check(L, viewed);
    script_check(L);
    frame_write(L, path, width, height, bits, rgb, view.alpha);
    script_wrote_tell(paper->script, path);
    return 0;
}

const luaL_Reg script_paper_look_methods[] = {{"layer", paper_layer}, {"mask", paper_mask},
                                              {"at", paper_at_fiber}, {"total", paper_total_of},
                                              {"frame", paper_frame}, {NULL, NULL}};
