/* brush.c - brushes in scripts: paper:brush{...}, brush:dip{...}, paper:stroke{...}, and the paths that strokes follow. */
#include "script_internal.h"

#include <brush.h>
#include <path.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char script_brush_type[] = "lutetia brush";

enum { PLACE_MAX = 100000, CONTROL_MAX = 20000, PROFILE_MAX = 1000 };
#define PI 3.14159265358979323846
#define PROFILE_HZ 120.0 /* samples a second where pressure is a function of the way */
#define LINE_SPACING 3.0 /* fibers between samples on a line that comes from a path */

struct script_brush {
    int number;
    double width;
};

static struct script_brush *brush_at(lua_State *L, int index)
{
    return luaL_checkudata(L, index, script_brush_type);
}

/* The brush's paper, which it holds. */
static struct paper_sheet *brush_sheet(lua_State *L, int index)
{
    lua_getiuservalue(L, index, 1);
    struct paper_sheet *sheet = script_paper_arg(L, -1);
    lua_pop(L, 1);
    return sheet;
}

/* ---- making ---- */

/* Sizes are parts of the width. */
static const struct kind {
    const char *name;
    bool flat;
    double depth, point, uneven, splay, bend, bristles, thickness, reach, load, mixing;
} kinds[] = {
    {"round", false, 0.75, 0.75, 0.25, 0.25, 0.3, 8, 0.07, 30, 0.7, 0.15},
    {"flat", true, 0.22, 0.1, 0.3, 0.15, 0.2, 7, 0.06, 22, 0.7, 0.15},
    {"mop", false, 0.9, 0.35, 0.15, 0.5, 0.3, 8, 0.10, 60, 1.0, 0.25},
    {"rigger", false, 1.0, 0.9, 0.1, 0.4, 0.8, 8, 0.15, 140, 0.6, 0.1},
    {"fan", true, 0.15, 0.0, 1.0, 0.5, 0.15, 2.5, 0.05, 18, 0.6, 0.1},
    {"bristle", true, 0.35, 0.15, 0.9, 0.3, 0.3, 4, 0.05, 14, 0.6, 0.1},
};

static const struct kind *kind_find(lua_State *L, const char *name)
{
    luaL_Buffer list;
    if (!name)
        return &kinds[0];
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return &kinds[i];
    luaL_buffinit(L, &list);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        luaL_addstring(&list, i ? ", " : "");
        luaL_addstring(&list, kinds[i].name);
    }
    luaL_pushresult(&list);
    luaL_error(L, "brush kind must be one of %s (got '%s')", lua_tostring(L, -1), name);
    return NULL;
}

/* paper:brush{...} */
static int paper_brush(lua_State *L)
{
    static const char *const keys[] = {"kind",      "width",    "depth",  "bristles", "angle",
                                       "follows",   "point",    "uneven", "splay",    "bend",
                                       "thickness", "reach",    "load",   "flow",     "mixing",
                                       "seed",      "mirrored", "number", NULL};
    struct paper_sheet *sheet = script_paper_arg(L, 1);
    if (lua_isnoneornil(L, 2)) {
        lua_settop(L, 1);
        lua_newtable(L);
    }
    luaL_checktype(L, 2, LUA_TTABLE);
    lua_settop(L, 2);
    script_arg_keys(L, 2, "brush", keys);
    const struct kind *kind = kind_find(L, script_arg_text(L, 2, "brush", "kind"));
    struct paper_brush b = paper_brush_default();
    int free_one = 0;
    while (free_one < PAPER_BRUSHES_MAX && paper_history_brush(sheet, free_one))
        free_one++;
    b.number =
        script_arg_integer(L, 2, "brush", "number", free_one + 1, 1, PAPER_BRUSHES_MAX + 1) - 1;
    if (b.number == PAPER_BRUSHES_MAX)
        luaL_error(L, "a paper has up to %d brushes; number = 1 replaces the first",
                   PAPER_BRUSHES_MAX);
    b.width = script_arg_number(L, 2, "brush", "width", 20, 1, 1000);
    b.depth =
        script_arg_number(L, 2, "brush", "depth", fmax(1, kind->depth * b.width), 1, 1000);
    b.bristles =
        script_arg_integer(L, 2, "brush", "bristles",
                           (int)fmin(PAPER_BRISTLES_MAX, fmax(12, kind->bristles * b.width)), 1,
                           PAPER_BRISTLES_MAX);
    b.angle = script_arg_number(L, 2, "brush", "angle", 0, -36000, 36000) * PI / 180;
    b.follows = script_arg_boolean(L, 2, "brush", "follows", false);
    b.flat = kind->flat;
    b.point = script_arg_number(L, 2, "brush", "point", kind->point, 0, 1);
    b.uneven = script_arg_number(L, 2, "brush", "uneven", kind->uneven, 0, 1);
    b.splay = script_arg_number(L, 2, "brush", "splay", kind->splay, 0, 2);
    b.bend = script_arg_number(L, 2, "brush", "bend", kind->bend, 0, 2);
    b.thickness = script_arg_number(L, 2, "brush", "thickness",
                                    fmax(1.2, kind->thickness * b.width), 0, 100);
    b.reach = script_arg_number(L, 2, "brush", "reach", kind->reach * b.width, 1, 1e6);
    b.load = script_arg_number(L, 2, "brush", "load", kind->load, 0.01, 2);
    b.flow = script_arg_number(L, 2, "brush", "flow", b.flow, 0, 1e6);
    b.mixing = script_arg_number(L, 2, "brush", "mixing", kind->mixing, 0, 1);
    b.seed = (uint64_t)script_arg_integer(L, 2, "brush", "seed", b.number + 1, 0, 2147483647);
    b.mirrored = script_arg_boolean(L, 2, "brush", "mirrored", false);

    struct script_brush *own = lua_newuserdatauv(L, sizeof *own, 1);
    *own = (struct script_brush){.number = b.number, .width = b.width};
    luaL_setmetatable(L, script_brush_type);
    lua_pushvalue(L, 1);
    lua_setiuservalue(L, -2, 1);
    script_paper_memory_take(L, 1,
                             8e6 + 2.0 * paper_sheet_get_config(sheet)->width *
                                       paper_sheet_get_config(sheet)->height,
                             "brushes");
    script_paper_check(L, paper_sheet_brush(sheet, &b));
    return 1;
}

/* ---- dipping ---- */

static void dip(lua_State *L, struct paper_dip *d)
{
    static const char *const keys[] = {"part", "side", NULL};
    d->number = brush_at(L, 1)->number;
    d->part = 1;
    d->side[0] = -1;
    d->side[1] = 1;
    if (lua_istable(L, 3)) {
        script_arg_keys(L, 3, "dip", keys);
        d->part = script_arg_number(L, 3, "dip", "part", 1, 0, 1);
        script_arg_numbers(L, 3, "dip", "side", d->side, 2, -1, 1);
    } else if (!lua_isnoneornil(L, 3)) {
        luaL_checktype(L, 3, LUA_TTABLE);
    }
    script_paper_check(L, paper_sheet_dip(brush_sheet(L, 1), d));
}

/* brush:dip({water = 1, ["burnt umber"] = 0.5} [, {part =, side = {from, to}}]) */
static int brush_dip(lua_State *L)
{
    struct paper_dip d = {0};
    struct paper_sheet *sheet = (brush_at(L, 1), brush_sheet(L, 1));
    lua_settop(L, 3);
    script_paper_amounts(L, 2, sheet, d.amount);
    dip(L, &d);
    return 0;
}

/* brush:rinse([water]): clean water only */
static int brush_rinse(lua_State *L)
{
    struct paper_dip d = {.amount = {1}};
    brush_at(L, 1);
    if (!lua_isnoneornil(L, 2))
        d.amount[0] = script_arg_at(L, 2, "rinse's water", 0, 1);
    lua_settop(L, 1);
    dip(L, &d);
    return 0;
}

/* brush:wipe([part]): on a cloth */
static int brush_wipe(lua_State *L)
{
    struct paper_dip d = {0};
    brush_at(L, 1);
    double part = lua_isnoneornil(L, 2) ? 1 : script_arg_at(L, 2, "wipe's part", 0, 1);
    lua_settop(L, 2);
    lua_newtable(L);
    lua_pushnumber(L, part);
    lua_setfield(L, -2, "part");
    dip(L, &d);
    return 0;
}

/* brush:holds("water"), in units */
static int brush_holds(lua_State *L)
{
    struct script_brush *brush = brush_at(L, 1);
    struct paper_sheet *sheet = brush_sheet(L, 1);
    const char *name = luaL_checkstring(L, 2);
    int substance =
        strcmp(name, "water") == 0 ? 0 : 1 + script_paper_pigment_number_of(L, sheet, name);
    double total;
    script_paper_check(L, paper_sheet_brush_total(sheet, brush->number, substance, &total));
    lua_pushnumber(L, total);
    return 1;
}

/* ---- ways ---- */

/* What moves and turns a way: x' = scale * turned (x) + place. */
struct placing {
    double x, y, scale, c, s;
};

static void placed(const struct placing *p, double *x, double *y)
{
    double u = p->scale * (p->c * *x - p->s * *y) + p->x;
    *y = p->scale * (p->s * *x + p->c * *y) + p->y;
    *x = u;
}

/* Samples that the state frees. */
static struct paper_stroke_sample *samples_new(lua_State *L, int count)
{
    return lua_newuserdatauv(L, (size_t)count * sizeof(struct paper_stroke_sample), 0);
}

/* Pressure 0..1 on the way at u, 0..1: a number, a list of numbers at even places, or a function. */
static double pressure_at(lua_State *L, int index, double u)
{
    double value;
    if (lua_isnil(L, index))
        return 0.6;
    if (lua_istable(L, index)) {
        int count = (int)lua_rawlen(L, index);
        if (count < 1 || count > PROFILE_MAX)
            luaL_error(L, "stroke pressure must be 1..%d numbers (got %d)", PROFILE_MAX, count);
        double at = u * (count - 1);
        int low = (int)fmin(floor(at), count > 1 ? count - 2 : 0);
        lua_rawgeti(L, index, low + 1);
        value = script_arg_at(L, -1, "stroke pressure", 0, 1);
        lua_pop(L, 1);
        if (count > 1) {
            lua_rawgeti(L, index, low + 2);
            value += (at - low) * (script_arg_at(L, -1, "stroke pressure", 0, 1) - value);
            lua_pop(L, 1);
        }
        return fmin(1, fmax(0, value));
    }
    if (lua_isfunction(L, index)) {
        lua_pushvalue(L, index);
        lua_pushnumber(L, u);
        lua_call(L, 1, 1);
    } else {
        lua_pushvalue(L, index);
    }
    value = script_arg_at(L, -1, "stroke pressure", 0, 1);
    lua_pop(L, 1);
    return value;
}

struct drawing {
    struct paper_sheet *sheet;
    struct paper_stroke stroke;
    struct placing placing;
    double speed; /* fibers a second */
    double tilt[2];
    double seconds; /* of the whole stroke; 0: as the speed says */
    bool timed;     /* samples have times */
    bool profiled;  /* pressure comes from the profile */
    int pressure;   /* the profile's index on the stack */
};

/* Times from the speed: the chords' lengths. */
static void times_make(const struct drawing *d, struct paper_stroke_sample *samples, int count)
{
    double time = 0;
    for (int i = 0; i < count; i++) {
        if (i > 0)
            time +=
                fmax(hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y),
                     1e-3) /
                d->speed;
        samples[i].time_s = time;
    }
}

static void draw(lua_State *L, struct drawing *d, struct paper_stroke_sample *samples,
                 int count)
{
    int top = lua_gettop(L);
    if (!d->timed)
        times_make(d, samples, count);
    double start = samples[0].time_s, length = samples[count - 1].time_s - start;
    if (d->seconds > 0 && length > 0)
        for (int i = 0; i < count; i++)
            samples[i].time_s = (samples[i].time_s - start) / length * d->seconds;
    d->stroke.samples = samples;
    d->stroke.samples_count = count;
    script_paper_check(L, paper_stroke_check(&d->stroke));
    if (d->profiled) { /* finer, for the pressure to follow its profile */
        start = samples[0].time_s;
        length = samples[count - 1].time_s - start;
        int fine = (int)fmin(CONTROL_MAX, fmax(2, ceil(length * PROFILE_HZ)));
        struct paper_stroke_sample *made = samples_new(L, fine);
        int cursor = 0;
        if (count == 1)
            fine = 1;
        for (int i = 0; i < fine; i++) {
            double u = fine > 1 ? (double)i / (fine - 1) : 0;
            made[i] = paper_stroke_at(&d->stroke, start + u * length, &cursor);
            made[i].time_s = start + u * length;
            made[i].pressure = pressure_at(L, d->pressure, u);
        }
        d->stroke.samples = made;
        d->stroke.samples_count = fine;
    }
    script_paper_check(L, paper_sheet_stroke(d->sheet, &d->stroke, NULL));
    lua_settop(L, top);
    script_check(L);
}

/* A line of chords as samples at even distances. */
static void line_draw(lua_State *L, struct drawing *d, const struct paper_way *way)
{
    double length = 0, done = 0;
    for (int i = 1; i < way->points_count; i++)
        length += hypot(way->points[2 * i] - way->points[2 * i - 2],
                        way->points[2 * i + 1] - way->points[2 * i - 1]);
    int count = (int)fmin(CONTROL_MAX, 2 + floor(length * d->placing.scale / LINE_SPACING));
    if (length <= 0)
        count = 1;
    struct paper_stroke_sample *samples = samples_new(L, count);
    for (int i = 0, at = 1; i < count; i++) {
        double want = count > 1 ? length * i / (count - 1) : 0, x, y;
        for (;; at++) {
            const double *a = way->points + 2 * (way->points_count > 1 ? at - 1 : 0);
            const double *b = way->points_count > 1 ? a + 2 : a;
            double chord = hypot(b[0] - a[0], b[1] - a[1]);
            if (at + 1 < way->points_count && done + chord < want) {
                done += chord;
                continue;
            }
            double u = chord > 0 ? fmin(1, (want - done) / chord) : 0;
            x = a[0] + u * (b[0] - a[0]);
            y = a[1] + u * (b[1] - a[1]);
            break;
        }
        placed(&d->placing, &x, &y);
        samples[i] = (struct paper_stroke_sample){
            .x = x, .y = y, .tilt_x = d->tilt[0], .tilt_y = d->tilt[1]};
    }
    d->timed = false;
    d->profiled = true;
    draw(L, d, samples, count);
    lua_pop(L, 1);
}

/* Lines are freed whatever happens: they are a userdata's. */
static const char lines_type[] = "lutetia lines";

static int lines_gc(lua_State *L)
{
    paper_lines_destroy(luaL_checkudata(L, 1, lines_type));
    return 0;
}

static struct paper_lines *lines_new(lua_State *L)
{
    struct paper_lines *lines = lua_newuserdatauv(L, sizeof *lines, 0);
    *lines = (struct paper_lines){0};
    luaL_setmetatable(L, lines_type);
    return lines;
}

/* Pushes the lines of a path, or of a file. */
static struct paper_lines *lines_read(lua_State *L, const char *path, const char *file,
                                      double tolerance)
{
    struct paper_lines *lines = lines_new(L);
    if (path) {
        script_paper_check(L, paper_path_parse(path, tolerance, lines));
    } else {
        const char *name = script_path(L, script_of(L)->config->in_folder, file, "svg");
        script_paper_check(L, paper_svg_read(name, tolerance, lines));
        lua_pop(L, 1);
    }
    return lines;
}

/* ---- strokes ---- */

/* points = {{x, y [, pressure [, seconds [, tilt x, tilt y]]]}, ...} */
static void points_draw(lua_State *L, struct drawing *d)
{
    int list = lua_gettop(L);
    int count = lua_istable(L, list) ? (int)lua_rawlen(L, list) : 0;
    if (count < 1 || count > CONTROL_MAX)
        luaL_error(L, "stroke points must be a list of 1..%d (got %d)", CONTROL_MAX, count);
    struct paper_stroke_sample *samples = samples_new(L, count);
    int pressed = 0, timed = 0;
    for (int i = 0; i < count; i++) {
        double n[6] = {0, 0, 0.6, 0, d->tilt[0], d->tilt[1]};
        static const double lows[6] = {-PLACE_MAX, -PLACE_MAX, 0, 0, -1.5, -1.5},
                            highs[6] = {PLACE_MAX, PLACE_MAX, 1, 1e5, 1.5, 1.5};
        lua_rawgeti(L, list, i + 1);
        if (!lua_istable(L, -1))
            luaL_error(L, "stroke point %d must be {x, y [, pressure [, seconds]]} (got a %s)",
                       i + 1, luaL_typename(L, -1));
        int numbers = (int)lua_rawlen(L, -1);
        if (numbers < 2 || numbers > 6)
            luaL_error(L, "stroke point %d must have 2..6 numbers (got %d)", i + 1, numbers);
        for (int j = 0; j < numbers; j++) {
            lua_rawgeti(L, -1, j + 1);
            n[j] = script_arg_at(L, -1, "a number of a stroke's point", lows[j], highs[j]);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
        pressed += numbers > 2;
        timed += numbers > 3;
        placed(&d->placing, &n[0], &n[1]);
        samples[i] = (struct paper_stroke_sample){n[3], n[0], n[1], n[2], n[4], n[5]};
    }
    if (timed && timed != count)
        luaL_error(L, "all points of a stroke have seconds, or none (got %d of %d)", timed,
                   count);
    d->timed = timed > 0;
    d->profiled = !pressed || !lua_isnil(L, d->pressure);
    draw(L, d, samples, count);
}

/* file = "recorded.csv" */
static void recording_draw(lua_State *L, struct drawing *d, const char *file)
{
    struct paper_stroke_sample *read;
    int count;
    const char *path = script_path(L, script_of(L)->config->in_folder, file, "samples");
    script_paper_check(L, paper_samples_read(path, &read, &count));
    struct paper_stroke_sample *samples = samples_new(L, count);
    memcpy(samples, read, (size_t)count * sizeof *samples);
    free(read);
    for (int i = 0; i < count; i++)
        placed(&d->placing, &samples[i].x, &samples[i].y);
    d->timed = true;
    d->profiled = !lua_isnil(L, d->pressure);
    draw(L, d, samples, count);
}

/* way = function(t) return x, y [, pressure [, tilt x, tilt y]] end, t from 0 to seconds */
static void way_draw(lua_State *L, struct drawing *d)
{
    int function = lua_gettop(L);
    if (!lua_isfunction(L, function))
        luaL_error(L, "stroke way must be a function of seconds (got a %s)",
                   luaL_typename(L, function));
    double seconds = d->seconds > 0 ? d->seconds : 1;
    int count = (int)fmin(CONTROL_MAX, fmax(2, ceil(seconds * PROFILE_HZ) + 1));
    struct paper_stroke_sample *samples = samples_new(L, count);
    int pressed = 0;
    for (int i = 0; i < count; i++) {
        double time = seconds * i / (count - 1);
        lua_pushvalue(L, function);
        lua_pushnumber(L, time);
        lua_call(L, 1, 5);
        double x = script_arg_at(L, -5, "a stroke's x", -PLACE_MAX, PLACE_MAX);
        double y = script_arg_at(L, -4, "a stroke's y", -PLACE_MAX, PLACE_MAX);
        bool own = !lua_isnil(L, -3), leans = !lua_isnil(L, -2);
        double pressure = own ? script_arg_at(L, -3, "a stroke's pressure", 0, 1) : 0.6;
        double tilt_x = leans ? script_arg_at(L, -2, "a stroke's tilt", -1.5, 1.5) : d->tilt[0];
        double tilt_y = leans ? script_arg_at(L, -1, "a stroke's tilt", -1.5, 1.5) : d->tilt[1];
        lua_pop(L, 5);
        pressed += own;
        placed(&d->placing, &x, &y);
        samples[i] = (struct paper_stroke_sample){time, x, y, pressure, tilt_x, tilt_y};
    }
    d->timed = true;
    d->profiled = !pressed || !lua_isnil(L, d->pressure);
    draw(L, d, samples, count);
}

/* paper:stroke{brush =, points = | path = | svg = | file = | way =, ...} */
static int paper_stroke(lua_State *L)
{
    static const char *const keys[] = {
        "brush", "points", "path", "svg", "file",  "way",    "pressure",  "speed", "seconds",
        "pace",  "tilt",   "x",    "y",   "scale", "rotate", "tolerance", NULL};
    static const char *const ways[] = {"points", "path", "svg", "file", "way"};
    struct drawing d = {.sheet = script_paper_arg(L, 1)};
    luaL_checktype(L, 2, LUA_TTABLE);
    lua_settop(L, 2);
    script_arg_keys(L, 2, "stroke", keys);
    lua_getfield(L, 2, "brush"); /* 3 */
    const struct script_brush *brush = luaL_testudata(L, 3, script_brush_type);
    if (!brush)
        luaL_error(L, "stroke brush must be a brush of this paper (got a %s)",
                   luaL_typename(L, 3));
    lua_getiuservalue(L, 3, 1);
    if (!lua_rawequal(L, -1, 1))
        luaL_error(L, "stroke brush must be a brush of this paper (got one of another)");
    lua_pop(L, 1);
    d.stroke.number = brush->number;
    d.stroke.pace = script_arg_number(L, 2, "stroke", "pace", 30, 0, 10000);
    d.speed = script_arg_number(L, 2, "stroke", "speed", 200 + 12 * brush->width, 0.1, 1e6);
    d.seconds = script_arg_number(L, 2, "stroke", "seconds", 0, 0, 1e5);
    script_arg_numbers(L, 2, "stroke", "tilt", d.tilt, 2, -1.5, 1.5);
    d.placing.x = script_arg_number(L, 2, "stroke", "x", 0, -PLACE_MAX, PLACE_MAX);
    d.placing.y = script_arg_number(L, 2, "stroke", "y", 0, -PLACE_MAX, PLACE_MAX);
    d.placing.scale = script_arg_number(L, 2, "stroke", "scale", 1, 1e-3, 1e3);
    double turn = script_arg_number(L, 2, "stroke", "rotate", 0, -36000, 36000) * PI / 180;
    d.placing.c = cos(turn);
    d.placing.s = sin(turn);
    double tolerance =
        script_arg_number(L, 2, "stroke", "tolerance", 0.1 / d.placing.scale, 1e-4, 1e3);
    lua_getfield(L, 2, "pressure");
    d.pressure = lua_gettop(L); /* 4 */
    int found = -1, count = 0;
    for (int i = 0; i < 5; i++) {
        if (lua_getfield(L, 2, ways[i]) != LUA_TNIL) {
            found = i;
            count++;
        }
        lua_pop(L, 1);
    }
    if (count != 1)
        luaL_error(L, "a stroke has one of points, path, svg, file, way (got %d)", count);
    script_paper_stop_when_due(L, 1);
    const char *text =
        found == 0 || found == 4 ? NULL : script_arg_text(L, 2, "stroke", ways[found]);
    if (found == 0 || found == 4) {
        lua_getfield(L, 2, ways[found]);
        if (found == 0)
            points_draw(L, &d);
        else
            way_draw(L, &d);
    } else if (found == 3) {
        recording_draw(L, &d, text);
    } else {
        const struct paper_lines *lines =
            lines_read(L, found == 1 ? text : NULL, found == 2 ? text : NULL, tolerance);
        for (int i = 0; i < lines->count; i++)
            line_draw(L, &d, &lines->line[i]);
    }
    script_check(L);
    return 0;
}

/* path("M0 0L5 5" [, tolerance]), svg("file.svg" [, tolerance]): a list of lines, each a list of {x, y}. */
static int lines_push(lua_State *L, bool file)
{
    const char *text = luaL_checkstring(L, 1);
    double tolerance =
        lua_isnoneornil(L, 2) ? 0.1 : script_arg_at(L, 2, "tolerance", 1e-4, 1e3);
    const struct paper_lines *lines =
        lines_read(L, file ? NULL : text, file ? text : NULL, tolerance);
    lua_createtable(L, lines->count, 0);
    for (int i = 0; i < lines->count; i++) {
        lua_createtable(L, lines->line[i].points_count, 0);
        for (int j = 0; j < lines->line[i].points_count; j++) {
            lua_createtable(L, 2, 0);
            for (int k = 0; k < 2; k++) {
                lua_pushnumber(L, lines->line[i].points[2 * j + k]);
                lua_rawseti(L, -2, k + 1);
            }
            lua_rawseti(L, -2, j + 1);
        }
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

static int make_path(lua_State *L)
{
    return lines_push(L, false);
}

static int make_svg(lua_State *L)
{
    return lines_push(L, true);
}

const luaL_Reg script_brush_paper_methods[] = {
    {"brush", paper_brush}, {"stroke", paper_stroke}, {NULL, NULL}};

const luaL_Reg script_brush_methods[] = {{"dip", brush_dip},
                                         {"rinse", brush_rinse},
                                         {"wipe", brush_wipe},
                                         {"holds", brush_holds},
                                         {NULL, NULL}};

const luaL_Reg script_brush_functions[] = {
    {"path", make_path}, {"svg", make_svg}, {NULL, NULL}};

void script_brush_open(lua_State *L)
{
    script_type_open(L, script_brush_type, NULL);
    script_type_open(L, lines_type, lines_gc);
}
