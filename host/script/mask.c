/* mask.c - masks: shapes through which a script puts water and pigment.
 *
 * A mask is either a polygon, kept as its corners until it is used, or gray values with a
 * place. Masks never change: methods that move, join or soften a mask make a new one. Outside
 * its shape a mask is 0; what is made from masks by numbers, as 1 - m, may be more there.
 */
#include "script_mask.h"

#include <display.h>
#include <face.h>
#include <text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
enum { CORNERS_MAX = 20000 };

struct script_mask *script_mask_new(lua_State *L)
{
    struct script_mask *mask = lua_newuserdatauv(L, sizeof *mask, 0);
    memset(mask, 0, sizeof *mask);
    mask->script = script_of(L);
    luaL_setmetatable(L, script_mask_type);
    return mask;
}

struct script_mask *script_mask_polygon_new(lua_State *L, int count)
{
    double bytes = 2.0 * count * (double)sizeof(double);
    struct script_mask *mask = script_mask_new(L);
    script_memory_take(L, bytes, "a shape");
    mask->bytes = bytes;
    mask->points = calloc((size_t)count * 2, sizeof(double));
    if (!mask->points)
        luaL_error(L, "no memory for a shape");
    mask->points_count = count;
    return mask;
}

/* All 0. */
struct script_mask *script_mask_gray_new(lua_State *L, double width, double height, double x,
                                         double y)
{
    struct script_mask *mask = script_mask_new(L);
    if (!(width >= 1 && height >= 1))
        return mask;
    if (!(width <= SCRIPT_PLACE_MAX && height <= SCRIPT_PLACE_MAX &&
          fabs(x) <= 10.0 * SCRIPT_PLACE_MAX && fabs(y) <= 10.0 * SCRIPT_PLACE_MAX))
        luaL_error(L, "a mask must be up to %d pixels wide and high, and near the paper",
                   SCRIPT_PLACE_MAX);
    script_memory_take(L, width * height, "a mask");
    mask->bytes = width * height;
    mask->width = (int)width;
    mask->height = (int)height;
    mask->x = (int)x;
    mask->y = (int)y;
    mask->gray = calloc((size_t)mask->height, (size_t)mask->width);
    if (!mask->gray)
        luaL_error(L, "no memory for a mask of %dx%d", mask->width, mask->height);
    return mask;
}

static int mask_gc(lua_State *L)
{
    struct script_mask *mask = luaL_checkudata(L, 1, script_mask_type);
    free(mask->points);
    free(mask->gray);
    free(mask->drawn.at);
    script_memory_give(mask->script, mask->bytes);
    *mask = (struct script_mask){.script = mask->script};
    return 0;
}

void script_mask_push(lua_State *L, const uint8_t *gray, int width, int height, int x, int y)
{
    struct script_mask *mask = script_mask_gray_new(L, width, height, x, y);
    memcpy(mask->gray, gray, (size_t)width * (size_t)height);
}

/* ---- from corners to gray ---- */

/* Pushes the mask at index, converted to gray values. */
struct script_mask *script_mask_grayed(lua_State *L, int index)
{
    const struct script_mask *mask = luaL_checkudata(L, index, script_mask_type);
    if (!mask->points) {
        lua_pushvalue(L, index);
        return lua_touserdata(L, -1);
    }
    double x1 = INFINITY, y1 = INFINITY, x2 = -INFINITY, y2 = -INFINITY;
    for (int i = 0; i < mask->points_count; i++) {
        x1 = fmin(x1, floor(mask->points[2 * i]));
        y1 = fmin(y1, floor(mask->points[2 * i + 1]));
        x2 = fmax(x2, ceil(mask->points[2 * i]));
        y2 = fmax(y2, ceil(mask->points[2 * i + 1]));
    }
    struct script_mask *made = script_mask_gray_new(L, x2 - x1, y2 - y1, x1, y1);
    if (!made->gray)
        return made;
    struct script_mask *shifted = script_mask_polygon_new(L, mask->points_count);
    for (int i = 0; i < mask->points_count; i++) {
        shifted->points[2 * i] = mask->points[2 * i] - x1;
        shifted->points[2 * i + 1] = mask->points[2 * i + 1] - y1;
    }
    struct paper_screen screen;
    int x, y;
    if (paper_polygon_screen(shifted->points, shifted->points_count, made->width, made->height,
                             &screen, &x, &y) != PAPER_OK)
        script_fail(L, paper_error());
    for (int row = 0; row < screen.height_px; row++)
        memcpy(made->gray + (size_t)(row + y) * (size_t)made->width + x,
               screen.gray + (size_t)row * (size_t)screen.width_px, (size_t)screen.width_px);
    paper_screen_destroy(&screen);
    lua_pop(L, 1);
    script_mask_drawn_join(made, mask, NULL, 0);
    return made;
}

int script_mask_gray_at(const struct script_mask *mask, int x, int y)
{
    if (!mask->gray || x < mask->x || y < mask->y || x >= mask->x + mask->width ||
        y >= mask->y + mask->height)
        return mask->outside;
    return mask->gray[(size_t)(y - mask->y) * (size_t)mask->width + (size_t)(x - mask->x)];
}

/* Pushes the mask as it is on a sheet of that size. */
static const struct script_mask *all_over(lua_State *L, const struct script_mask *mask,
                                          int width, int height)
{
    struct script_mask *made = script_mask_gray_new(L, width, height, 0, 0);
    for (int y = 0; y < made->height; y++) {
        script_check_row(L, y);
        for (int x = 0; x < made->width; x++)
            made->gray[(size_t)y * (size_t)made->width + (size_t)x] =
                (uint8_t)script_mask_gray_at(mask, x, y);
    }
    return made;
}

bool script_mask_screen_quietly(lua_State *L, int index, int width, int height,
                                struct paper_screen *screen, int *x, int *y)
{
    struct script_mask *mask = luaL_checkudata(L, index, script_mask_type);
    *screen = (struct paper_screen){0};
    if (mask->outside) {
        const struct script_mask *all = all_over(L, mask, width, height);
        *x = *y = 0;
        screen->width_px = all->width;
        screen->height_px = all->height;
        screen->gray = all->gray;
        script_mask_drawing_tell(mask, screen);
        return all->gray != NULL;
    }
    if (!mask->points) {
        *x = mask->x;
        *y = mask->y;
        screen->width_px = mask->width;
        screen->height_px = mask->height;
        screen->gray = mask->gray;
        script_mask_drawing_tell(mask, screen);
        return mask->gray != NULL;
    }
    struct script_mask *kept = script_mask_new(L); /* takes over the gray values */
    if (paper_polygon_screen(mask->points, mask->points_count, width, height, screen, x, y) !=
        PAPER_OK)
        script_fail(L, paper_error());
    kept->gray = screen->gray;
    if (!screen->gray)
        return false;
    kept->width = screen->width_px;
    kept->height = screen->height_px;
    double bytes = (double)screen->width_px * screen->height_px;
    script_memory_take(L, bytes, "a mask");
    kept->bytes = bytes;
    kept->x = *x;
    kept->y = *y;
    script_mask_drawn_join(kept, mask, NULL, 0);
    script_mask_drawing_tell(kept, screen);
    return true;
}

bool script_mask_screen(lua_State *L, int index, int width, int height,
                        struct paper_screen *screen, int *x, int *y)
{
    const struct script_mask *mask = luaL_checkudata(L, index, script_mask_type);
    const bool some = script_mask_screen_quietly(L, index, width, height, screen, x, y);
    if (some ? *x >= width || *y >= height || *x + screen->width_px <= 0 ||
                   *y + screen->height_px <= 0
             : mask->points != NULL)
        script_note_once(L, SCRIPT_OFF_PAPER,
                         "this mask lies off the paper, or is empty: nothing happens there");
    return some;
}

bool script_mask_place(lua_State *L, int index, const struct paper_sheet *sheet,
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

/* ---- making ---- */

static int make_rectangle(lua_State *L)
{
    double x = script_arg_at(L, 1, "rect's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = script_arg_at(L, 2, "rect's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double width = script_arg_at(L, 3, "rect's width", 0, SCRIPT_PLACE_MAX);
    double height = script_arg_at(L, 4, "rect's height", 0, SCRIPT_PLACE_MAX);
    const double corners[8] = {x, y, x + width, y, x + width, y + height, x, y + height};
    memcpy(script_mask_polygon_new(L, 4)->points, corners, sizeof corners);
    return 1;
}

static void ellipse_push(lua_State *L, double x, double y, double a, double b)
{
    int count = (int)fmin(1024, 24 + 2 * sqrt(fmax(a, b)) * 4);
    struct script_mask *mask = script_mask_polygon_new(L, count);
    for (int i = 0; i < count; i++) {
        double angle = 2 * PI * i / count;
        mask->points[2 * i] = x + a * cos(angle);
        mask->points[2 * i + 1] = y + b * sin(angle);
    }
}

static int make_ellipse(lua_State *L)
{
    double x = script_arg_at(L, 1, "ellipse's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = script_arg_at(L, 2, "ellipse's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double a = script_arg_at(L, 3, "ellipse's radius", 0, SCRIPT_PLACE_MAX);
    double b = lua_isnoneornil(L, 4)
                   ? a
                   : script_arg_at(L, 4, "ellipse's radius", 0, SCRIPT_PLACE_MAX);
    ellipse_push(L, x, y, a, b);
    return 1;
}

static int make_circle(lua_State *L)
{
    double x = script_arg_at(L, 1, "circle's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = script_arg_at(L, 2, "circle's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double radius = script_arg_at(L, 3, "circle's radius", 0, SCRIPT_PLACE_MAX);
    ellipse_push(L, x, y, radius, radius);
    return 1;
}

/* Reads corner i (from 1) of the list at index. */
static void corner_read(lua_State *L, int index, int i, const char *what, double out[2])
{
    if (lua_rawgeti(L, index, i) != LUA_TTABLE)
        luaL_error(L, "%s's corner %d must be {x, y} (got a %s)", what, i,
                   luaL_typename(L, -1));
    for (int j = 0; j < 2; j++) {
        lua_rawgeti(L, -1, j + 1);
        out[j] = script_arg_at(L, -1, what, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

static int corners_count(lua_State *L, const char *what, int least)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_Unsigned count = lua_rawlen(L, 1);
    if (count < (lua_Unsigned)least || count > CORNERS_MAX)
        luaL_error(L, "%s must have %d..%d corners (got %d)", what, least, CORNERS_MAX,
                   (int)(count > 1000000 ? 1000000 : count));
    return (int)count;
}

static int make_polygon(lua_State *L)
{
    int count = corners_count(L, "polygon", 3);
    struct script_mask *mask = script_mask_polygon_new(L, count);
    for (int i = 0; i < count; i++)
        corner_read(L, 1, i + 1, "polygon", mask->points + 2 * i);
    return 1;
}

/* Joins b to a by the maximum. Both are gray, and a is large enough. */
static void gray_join(struct script_mask *a, const struct script_mask *b)
{
    for (int row = 0; row < b->height; row++) {
        uint8_t *to = a->gray + (size_t)(row + b->y - a->y) * (size_t)a->width + (b->x - a->x);
        const uint8_t *from = b->gray + (size_t)row * (size_t)b->width;
        for (int x = 0; x < b->width; x++)
            to[x] = to[x] > from[x] ? to[x] : from[x];
    }
}

/* A line of varying width: {x, y, width}; a round dot at each corner, a quadrangle between. */
static int make_line(lua_State *L)
{
    int count = corners_count(L, "line", 2);
    double width = lua_isnoneornil(L, 2) ? 1 : script_arg_at(L, 2, "line's width", 0.01, 10000);
    double x1 = INFINITY, y1 = INFINITY, x2 = -INFINITY, y2 = -INFINITY, corner[2];
    for (int i = 1; i <= count; i++) {
        corner_read(L, 1, i, "line", corner);
        lua_rawgeti(L, 1, i);
        lua_rawgeti(L, -1, 3);
        double own = lua_isnil(L, -1) ? width : script_arg_at(L, -1, "line's width", 0, 10000);
        lua_pop(L, 2);
        x1 = fmin(x1, floor(corner[0] - own));
        y1 = fmin(y1, floor(corner[1] - own));
        x2 = fmax(x2, ceil(corner[0] + own));
        y2 = fmax(y2, ceil(corner[1] + own));
    }
    struct script_mask *all = script_mask_gray_new(L, x2 - x1, y2 - y1, x1, y1);
    int all_index = lua_gettop(L);
    double before[3] = {0};
    bool drawn = true;
    for (int i = 1; i <= count; i++) {
        double at[3];
        corner_read(L, 1, i, "line", at);
        lua_rawgeti(L, 1, i);
        lua_rawgeti(L, -1, 3);
        at[2] = (lua_isnil(L, -1) ? width : lua_tonumber(L, -1)) / 2;
        lua_settop(L, all_index);
        ellipse_push(L, at[0], at[1], at[2], at[2]);
        struct script_mask *part = script_mask_grayed(L, -1);
        if (part->gray)
            gray_join(all, part);
        drawn = drawn && script_mask_drawn_part(all, lua_touserdata(L, all_index + 1), i > 1);
        double dx = at[0] - before[0], dy = at[1] - before[1], length = hypot(dx, dy);
        if (i > 1 && length > 0) {
            double nx = -dy / length, ny = dx / length;
            struct script_mask *bar = script_mask_polygon_new(L, 4);
            const double corners[8] = {before[0] + nx * before[2], before[1] + ny * before[2],
                                       at[0] + nx * at[2],         at[1] + ny * at[2],
                                       at[0] - nx * at[2],         at[1] - ny * at[2],
                                       before[0] - nx * before[2], before[1] - ny * before[2]};
            memcpy(bar->points, corners, sizeof corners);
            part = script_mask_grayed(L, -1);
            if (part->gray)
                gray_join(all, part);
            drawn = drawn && script_mask_drawn_part(all, bar, true);
        }
        lua_settop(L, all_index);
        memcpy(before, at, sizeof at);
        script_check(L);
    }
    script_mask_drawn_keep(all, drawn);
    return 1;
}

static const char *const text_fonts[] = {"EBGaramond12-Regular", "DejaVuSerif", NULL};

/* corners = {{x, y}, ...}: upper left, upper right, lower right, lower left. False: there
 * are none. */
static bool text_corners(lua_State *L, int index, double corners[8])
{
    if (lua_isnoneornil(L, index) || lua_getfield(L, index, "corners") == LUA_TNIL)
        return false;
    if (!lua_istable(L, -1) || lua_rawlen(L, -1) != 4)
        luaL_error(L, "text corners must be four points: {{x, y}, {x, y}, {x, y}, {x, y}}");
    for (int i = 0; i < 4; i++)
        corner_read(L, lua_absindex(L, -1), i + 1, "text corner", corners + 2 * i);
    static const char *const others[] = {"x", "y", "angle", "anchor"};
    for (int i = 0; i < 4; i++) {
        if (lua_getfield(L, index, others[i]) != LUA_TNIL)
            luaL_error(L, "text corners go without %s", others[i]);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return true;
}

/* The options that text{} and p:type{} share: all except the place. */
static void text_options(lua_State *L, int index, struct paper_line *line)
{
    static const char *const keys[] = {
        "size",  "font",   "x",       "y",        "align",    "tracking", "filter",
        "angle", "width",  "leading", "features", "language", "anchor",   "right_to_left",
        "axes",  "darken", "corners", "warp",     NULL};
    static const enum paper_align aligns[] = {[FONT_ALIGN_LEFT] = PAPER_ALIGN_LEFT,
                                              [FONT_ALIGN_RIGHT] = PAPER_ALIGN_RIGHT,
                                              [FONT_ALIGN_CENTER] = PAPER_ALIGN_CENTER,
                                              [FONT_ALIGN_JUSTIFY] = PAPER_ALIGN_JUSTIFY};
    script_arg_options(L, index, "text", keys);
    line->font = script_arg_text(L, index, "text", "font");
    line->size_px = script_arg_number(L, index, "text", "size", 100, 1, 8192);
    line->tracking_em = script_arg_number(L, index, "text", "tracking", 0, -1, 10);
    line->filter = script_arg_text(L, index, "text", "filter");
    line->angle_deg = script_arg_number(L, index, "text", "angle", 0, -3600, 3600);
    line->width_px = script_arg_number(L, index, "text", "width", 0, 0, SCRIPT_PLACE_MAX);
    line->leading = script_arg_number(L, index, "text", "leading", 0, 0, 100);
    line->features = script_arg_text(L, index, "text", "features");
    line->language = script_arg_text(L, index, "text", "language");
    line->right_to_left = script_arg_boolean(L, index, "text", "right_to_left", false);
    line->axes = script_arg_text(L, index, "text", "axes");
    line->darken_px = script_arg_number(L, index, "text", "darken", 0, 0, 2);
    const char *warp = script_arg_text(L, index, "text", "warp");
    if (warp && strcmp(warp, "bilinear") != 0 && strcmp(warp, "projective") != 0)
        luaL_error(L, "text warp must be \"projective\" or \"bilinear\" (got '%s')", warp);
    line->bilinear = warp && strcmp(warp, "bilinear") == 0;
    const char *align = script_arg_text(L, index, "text", "align");
    enum font_align aligned;
    if (align && !font_align_named(align, &aligned))
        luaL_error(
            L, "text align must be \"left\", \"center\", \"right\" or \"justify\" (got '%s')",
            align);
    if (align)
        line->align = aligns[aligned];
    line->anchor = line->align == PAPER_ALIGN_CENTER  ? 0.5
                   : line->align == PAPER_ALIGN_RIGHT ? 1
                                                      : 0;
    line->anchor = script_arg_number(L, index, "text", "anchor", line->anchor, 0, 1);
    if (line->font)
        line->font = script_font(L, line->font, "text font");
    if (!line->font)
        line->font = font_face_first(text_fonts);
}

/* A text without options takes these parts of a sheet's width or height; it is measured at
 * the size of the trial. */
#define TEXT_WIDE 0.8
#define TEXT_HIGH 0.6
#define TEXT_TRIAL 100.0

/* text("word", {size=, font=, x=, y=, align=, …}): x, y is the beginning of the baseline, or
 * its middle or end. */
int script_mask_text_push(lua_State *L, int index)
{
    struct paper_line line = {.text = luaL_checkstring(L, index)};
    struct script *script = script_of(L);
    int options = index + 1;
    double corners[8];
    text_options(L, options, &line);
    line.corners = text_corners(L, options, corners) ? corners : NULL;
    double x =
        script_arg_number(L, options, "text", "x", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = script_arg_number(L, options, "text", "y", line.size_px, -SCRIPT_PLACE_MAX,
                                 SCRIPT_PLACE_MAX);
    if (line.corners)
        x = y = 0;
    line.x_px = x - floor(x);
    line.y_px = y - floor(y);
    /* The most memory for drawing a letter at its place in the picture; only the picture's
     * memory stays counted. */
    double work = 16 * line.size_px * line.size_px + 64 * (double)strlen(line.text);
    script_memory_hold(L, work, "a text");
    const int hold = lua_gettop(L);
    line.pixels_max = fmax(1, script_memory_left(script));
    struct script_mask *mask = script_mask_new(L); /* takes over the screen's gray values */
    struct paper_screen screen;
    uint32_t missing = 0;
    enum paper_status status = paper_line_screen(&line, &screen, &missing);
    script_memory_release(L, hold);
    script_edits_tell(L);
    script_missing_tell(L, line.font, &missing, status == PAPER_OK && missing);
    if (status != PAPER_OK)
        script_fail(L, paper_error());
    mask->bytes = (double)screen.width_px * screen.height_px;
    script->memory_bytes += (size_t)mask->bytes; /* within pixels_max */
    mask->gray = screen.gray;
    mask->width = screen.width_px;
    mask->height = screen.height_px;
    mask->x = (int)floor(x) - screen.origin_x_px;
    mask->y = (int)floor(y) - screen.baseline_y_px;
    script_mask_drawn_keep(mask, paper_drawing_line(&mask->drawn, &line, x, y) &&
                                     mask->drawn.count <= PAPER_DRAWING_MOST);
    lua_pushnumber(L, screen.advance_px);
    lua_pushnumber(L, screen.lines_count * screen.line_height_px);
    return 3;
}

/* The options of a text that is as wide as it goes well, in the middle of width x height. */
static void text_place(lua_State *L, int options, double size, double x, double y)
{
    const struct {
        const char *name;
        double value;
    } fields[] = {{"size", size}, {"x", x}, {"y", y}};
    lua_createtable(L, 0, 3);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        lua_pushnumber(L, fields[i].value);
        lua_setfield(L, -2, fields[i].name);
    }
    lua_replace(L, options);
}

void script_mask_text_fit(lua_State *L, int index, int width, int height, double margin)
{
    const int options = index + 1;
    text_place(L, options, TEXT_TRIAL, 0, 0);
    lua_pop(L, script_mask_text_push(L, index) - 1);
    const struct script_mask *trial = luaL_checkudata(L, -1, script_mask_type);
    const double by_width = TEXT_WIDE * (width - 2 * margin) / fmax(1, trial->width),
                 by_height = TEXT_HIGH * (height - 2 * margin) / fmax(1, trial->height);
    const double scale =
        fmax(1, fmin(8192, TEXT_TRIAL * fmin(by_width, by_height))) / TEXT_TRIAL;
    const double x = width / 2.0 - scale * (trial->x + trial->width / 2.0),
                 y = height / 2.0 - scale * (trial->y + trial->height / 2.0);
    lua_pop(L, 1);
    text_place(L, options, scale * TEXT_TRIAL, x, y);
}

static int make_text(lua_State *L)
{
    lua_settop(L, 2);
    return script_mask_text_push(L, 1);
}

/* image("file.png" [, x, y]): black is 1. */
static int make_image(lua_State *L)
{
    const char *name = luaL_checkstring(L, 1);
    double x = lua_isnoneornil(L, 2)
                   ? 0
                   : script_arg_at(L, 2, "image's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = lua_isnoneornil(L, 3)
                   ? 0
                   : script_arg_at(L, 3, "image's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    const char *path = script_path(L, script_of(L)->config->in_folder, name, "image");
    struct script_mask *mask = script_mask_new(L);
    struct display_image image;
    script_memory_hold(L, display_png_bytes(path, 1), "an image");
    const int hold = lua_gettop(L);
    if (display_png_read_gray(path, &image) != DISPLAY_OK)
        script_fail(L, display_error());
    mask->gray = image.pixels;
    mask->width = image.width_px;
    mask->height = image.height_px;
    mask->x = (int)x;
    mask->y = (int)y;
    size_t count = (size_t)mask->width * (size_t)mask->height;
    script_memory_release(L, hold);
    for (size_t i = 0; i < count; i++)
        mask->gray[i] = (uint8_t)(255 - mask->gray[i]);
    script_memory_take(L, (double)count, "an image");
    mask->bytes = (double)count;
    lua_settop(L, hold - 1);
    return 1;
}

/* mask(width, height, function(x, y) ... end): the function's values are 0..1. */
static int make_function(lua_State *L)
{
    double width = floor(script_arg_at(L, 1, "mask's width", 1, SCRIPT_PLACE_MAX));
    double height = floor(script_arg_at(L, 2, "mask's height", 1, SCRIPT_PLACE_MAX));
    luaL_checktype(L, 3, LUA_TFUNCTION);
    struct script_mask *mask = script_mask_gray_new(L, width, height, 0, 0);
    size_t beyond = 0;
    for (int y = 0; y < mask->height; y++)
        for (int x = 0; x < mask->width; x++) {
            lua_pushvalue(L, 3);
            lua_pushinteger(L, x);
            lua_pushinteger(L, y);
            script_callback(L, 2, 1);
            double value = lua_tonumber(L, -1);
            lua_pop(L, 1);
            beyond += !(value >= 0 && value <= 1);
            mask->gray[(size_t)y * (size_t)mask->width + (size_t)x] =
                (uint8_t)lround(255 * (value > 0 ? value < 1 ? value : 1 : 0));
        }
    if (beyond > 0) {
        char text[128];
        snprintf(text, sizeof text,
                 "mask: %zu of its %zu values were not within 0..1 and were clamped", beyond,
                 (size_t)mask->width * (size_t)mask->height);
        script_note_where(L, text);
    }
    return 1;
}

const luaL_Reg script_mask_makers[] = {
    {"rect", make_rectangle},  {"ellipse", make_ellipse}, {"circle", make_circle},
    {"polygon", make_polygon}, {"line", make_line},       {"text", make_text},
    {"image", make_image},     {"mask", make_function},   {NULL, NULL}};

void script_mask_open(lua_State *L)
{
    script_type_open(L, script_mask_type, mask_gc);
}
