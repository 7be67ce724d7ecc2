/* mask_change.c - new masks from masks: moved, turned, scaled, joined, with numbers,
 * softened. */
#include "script_mask.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Pushes the mask at 1, transformed by x' = m[0] x + m[1] y + m[2], y' = m[3] x + m[4] y +
 * m[5]. */
static int transformed(lua_State *L, const double m[6])
{
    const struct script_mask *mask = luaL_checkudata(L, 1, script_mask_type);
    double det = m[0] * m[4] - m[1] * m[3];
    if (mask->points) {
        struct script_mask *made = script_mask_polygon_new(L, mask->points_count);
        for (int i = 0; i < mask->points_count; i++) {
            double x = mask->points[2 * i], y = mask->points[2 * i + 1];
            made->points[2 * i] = m[0] * x + m[1] * y + m[2];
            made->points[2 * i + 1] = m[3] * x + m[4] * y + m[5];
        }
        return 1;
    }
    double x1 = INFINITY, y1 = INFINITY, x2 = -INFINITY, y2 = -INFINITY;
    for (int i = 0; i < 4; i++) {
        double x = mask->x + (i & 1 ? mask->width : 0),
               y = mask->y + (i & 2 ? mask->height : 0);
        double to_x = m[0] * x + m[1] * y + m[2], to_y = m[3] * x + m[4] * y + m[5];
        x1 = fmin(x1, floor(to_x));
        y1 = fmin(y1, floor(to_y));
        x2 = fmax(x2, ceil(to_x));
        y2 = fmax(y2, ceil(to_y));
    }
    if (!mask->gray || det == 0) {
        script_mask_gray_new(L, 0, 0, 0, 0)->outside = mask->outside;
        return 1;
    }
    struct script_mask *made = script_mask_gray_new(L, x2 - x1, y2 - y1, x1, y1);
    made->outside = mask->outside;
    for (int row = 0; row < made->height; row++) {
        script_check_row(L, row);
        for (int column = 0; column < made->width; column++) {
            double px = column + made->x + 0.5 - m[2], py = row + made->y + 0.5 - m[5];
            double x = (m[4] * px - m[1] * py) / det - mask->x - 0.5;
            double y = (m[0] * py - m[3] * px) / det - mask->y - 0.5, sum = 0;
            int left = (int)floor(x), top = (int)floor(y);
            for (int i = 0; i < 4; i++) {
                int at_x = left + (i & 1), at_y = top + (i >> 1);
                sum += (1 - fabs(x - at_x)) * (1 - fabs(y - at_y)) *
                       script_mask_gray_at(mask, mask->x + at_x, mask->y + at_y);
            }
            made->gray[(size_t)row * (size_t)made->width + (size_t)column] =
                (uint8_t)lround(sum);
        }
    }
    return 1;
}

static int mask_move(lua_State *L)
{
    double x = script_arg_at(L, 2, "move's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    double y = script_arg_at(L, 3, "move's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    return transformed(L, (double[6]){1, 0, x, 0, 1, y});
}

/* Reads the point at arguments index, index + 1; default: the origin. */
static void center_read(lua_State *L, int index, double center[2])
{
    for (int i = 0; i < 2; i++)
        center[i] = lua_isnoneornil(L, index + i)
                        ? 0
                        : script_arg_at(L, index + i, "the center", -SCRIPT_PLACE_MAX,
                                        SCRIPT_PLACE_MAX);
}

static int mask_rotate(lua_State *L)
{
    double angle = script_arg_at(L, 2, "rotate's angle", -1e6, 1e6) * PI / 180, at[2];
    center_read(L, 3, at);
    double c = cos(angle), s = sin(angle);
    return transformed(L, (double[6]){c, -s, at[0] - c * at[0] + s * at[1], s, c,
                                      at[1] - s * at[0] - c * at[1]});
}

static int mask_scale(lua_State *L)
{
    double scale = script_arg_at(L, 2, "scale's factor", 0.001, 1000), at[2];
    center_read(L, 3, at);
    return transformed(
        L, (double[6]){scale, 0, at[0] * (1 - scale), 0, scale, at[1] * (1 - scale)});
}

/* A mask and a number: m * n, n * m, m + n, n + m, m - n, n - m, within 0..1. */
static int mask_count(lua_State *L, char operation)
{
    const bool first = lua_type(L, 1) == LUA_TNUMBER;
    const int of = first ? 2 : 1;
    const double number = operation == '*'
                              ? script_arg_at(L, 3 - of, "a mask's factor", 0, 255)
                              : script_arg_at(L, 3 - of, "what a mask is shifted by", -1, 1);
    const struct script_mask *mask = script_mask_grayed(L, of);
    uint8_t table[256];
    for (int i = 0; i < 256; i++)
        table[i] = paper_gray_number(operation, number, first, i);
    struct script_mask *made =
        script_mask_gray_new(L, mask->width, mask->height, mask->x, mask->y);
    made->outside = table[mask->outside];
    for (size_t i = 0; made->gray && i < (size_t)made->width * (size_t)made->height; i++) {
        if (i % 65536 == 0)
            script_check(L);
        made->gray[i] = table[mask->gray[i]];
    }
    script_mask_drawn_join(made, mask, NULL, 0);
    if (made->drawn.count > 0)
        paper_drawing_number(&made->drawn, operation, number, first);
    return 1;
}

/* Text has operators of its own, which call the mask's: the script's line is the first caller's
 * that has one. */
static int operand_wrong(lua_State *L, char operation, const char *what)
{
    enum { DEEPEST = 4 };
    for (int level = 1; level <= DEEPEST; level++) {
        luaL_where(L, level);
        if (*lua_tostring(L, -1))
            break;
        lua_pop(L, 1);
    }
    lua_pushfstring(L, "%c joins a mask with a mask or a number (got a %s)", operation, what);
    lua_concat(L, lua_gettop(L) - 2);
    return lua_error(L);
}

static int mask_join(lua_State *L, char operation)
{
    lua_settop(L, 2);
    for (int i = 1; i <= 2; i++)
        if (lua_type(L, i) != LUA_TNUMBER && !luaL_testudata(L, i, script_mask_type))
            return operand_wrong(L, operation, luaL_typename(L, i));
    if (lua_type(L, 1) == LUA_TNUMBER || lua_type(L, 2) == LUA_TNUMBER)
        return mask_count(L, operation);
    const struct script_mask *a = script_mask_grayed(L, 1), *b = script_mask_grayed(L, 2);
    int x1 = a->x, y1 = a->y, x2 = a->x + a->width, y2 = a->y + a->height;
    if ((operation == '+' || a->outside || b->outside) && b->gray) {
        bool first = a->gray != NULL;
        x1 = first && x1 < b->x ? x1 : b->x;
        y1 = first && y1 < b->y ? y1 : b->y;
        x2 = first && x2 > b->x + b->width ? x2 : b->x + b->width;
        y2 = first && y2 > b->y + b->height ? y2 : b->y + b->height;
    }
    struct script_mask *made = script_mask_gray_new(L, x2 - x1, y2 - y1, x1, y1);
    made->outside = (uint8_t)paper_gray_join(operation, a->outside, b->outside);
    for (int y = y1; y < y2 && made->gray; y++) {
        script_check_row(L, y - y1);
        for (int x = x1; x < x2; x++) {
            int value = paper_gray_join(operation, script_mask_gray_at(a, x, y),
                                        script_mask_gray_at(b, x, y));
            made->gray[(size_t)(y - y1) * (size_t)made->width + (size_t)(x - x1)] =
                (uint8_t)value;
        }
    }
    script_mask_drawn_join(made, a, b, operation);
    return 1;
}

/* a + b: union; a * b: intersection; a - b: a without b. */
static int mask_add(lua_State *L)
{
    return mask_join(L, '+');
}

static int mask_multiply(lua_State *L)
{
    return mask_join(L, '*');
}

static int mask_subtract(lua_State *L)
{
    return mask_join(L, '-');
}

/* One pass of a box 2 * radius + 1 wide over `count` values `stride` apart. */
static void box_pass(uint8_t *values, uint8_t *scratch, int count, size_t stride, int radius,
                     int outside)
{
    int size = 2 * radius + 1, sum = size * outside;
    for (int i = -radius; i < count; i++) {
        if (i + radius < count)
            sum += values[(size_t)(i + radius) * stride] - outside;
        if (i - radius - 1 >= 0)
            sum -= values[(size_t)(i - radius - 1) * stride] - outside;
        if (i >= 0)
            scratch[i] = (uint8_t)((sum + size / 2) / size);
    }
    for (int i = 0; i < count; i++)
        values[(size_t)i * stride] = scratch[i];
}

/* soften(radius): three box blurs, which approximate a Gaussian. */
static int mask_soften(lua_State *L)
{
    int radius = (int)lround(script_arg_at(L, 2, "soften's radius", 0, 1000));
    lua_settop(L, 1);
    const struct script_mask *mask = script_mask_grayed(L, 1);
    int box = (radius + 1) / 2, rim = 3 * box;
    if (!mask->gray || box == 0)
        return 1;
    struct script_mask *made = script_mask_gray_new(
        L, mask->width + 2.0 * rim, mask->height + 2.0 * rim, mask->x - rim, mask->y - rim);
    made->outside = mask->outside;
    memset(made->gray, made->outside, (size_t)made->width * (size_t)made->height);
    for (int y = 0; y < mask->height; y++)
        memcpy(made->gray + (size_t)(y + rim) * (size_t)made->width + rim,
               mask->gray + (size_t)y * (size_t)mask->width, (size_t)mask->width);
    size_t width = (size_t)made->width;
    uint8_t *scratch = lua_newuserdatauv(
        L, (size_t)(made->width > made->height ? made->width : made->height), 0);
    for (int pass = 0; pass < 3; pass++) {
        for (int y = 0; y < made->height; y++) {
            script_check_row(L, y);
            box_pass(made->gray + (size_t)y * width, scratch, made->width, 1, box,
                     made->outside);
        }
        for (int x = 0; x < made->width; x++) {
            script_check_row(L, x);
            box_pass(made->gray + x, scratch, made->height, width, box, made->outside);
        }
    }
    lua_pop(L, 1);
    return 1;
}

/* Returns x, y, width, height of the area that the mask covers. */
static int mask_bounds(lua_State *L)
{
    const struct script_mask *mask = script_mask_grayed(L, 1);
    int bounds[4] = {mask->x, mask->y, mask->width, mask->height};
    for (int i = 0; i < 4; i++)
        lua_pushinteger(L, bounds[i]);
    return 4;
}

const luaL_Reg script_mask_methods[] = {{"move", mask_move},     {"rotate", mask_rotate},
                                        {"scale", mask_scale},   {"soften", mask_soften},
                                        {"bounds", mask_bounds}, {NULL, NULL}};

const luaL_Reg script_mask_operators[] = {
    {"__add", mask_add}, {"__mul", mask_multiply}, {"__sub", mask_subtract}, {NULL, NULL}};
