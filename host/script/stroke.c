/* stroke.c - strokes in scripts: paper:stroke{...}, and their paths.
 *
 * All samples of all lines of a stroke are made first, which may call the script's
 * functions; then the stroke is painted.
 */
#include "script_brush.h"

#include <brush.h>
#include <path.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CONTROL_MAX = 20000, PROFILE_MAX = 1000 };
#define PI 3.14159265358979323846
#define PROFILE_HZ 120.0 /* samples a second if pressure is a function of the way */
#define LINE_SPACING 3.0 /* fibers between samples of a line from a path */

/* ---- ways ---- */

/* A similarity transform of a way: x' = scale * turned (x) + place. */
struct placing {
    double x, y, scale, c, s;
};

static void placed(const struct placing *p, double *x, double *y)
{
    double u = p->scale * (p->c * *x - p->s * *y) + p->x;
    *y = p->scale * (p->s * *x + p->c * *y) + p->y;
    *x = u;
}

/* Allocates samples; the state frees them. */
static struct paper_stroke_sample *samples_new(lua_State *L, int count)
{
    return lua_newuserdatauv(L, (size_t)count * sizeof(struct paper_stroke_sample), 0);
}

/* The pressure 0..1 at u, 0..1 of the way: a number, a list of numbers at even distances, or
 * a function. */
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
        script_callback(L, 1, 1);
    } else {
        lua_pushvalue(L, index);
    }
    value = script_arg_at(L, -1, "stroke pressure", 0, 1);
    lua_pop(L, 1);
    return value;
}

/* The arguments of paper:stroke{...}, and the strokes made from them. */
struct drawing {
    struct paper_stroke stroke; /* the brush and the pace */
    struct placing placing;
    double speed; /* fibers a second */
    double tilt[2];
    double seconds; /* of the whole stroke; 0: from the speed */
    bool timed;     /* the samples have times */
    bool profiled;  /* pressure is given by the profile */
    int pressure;   /* the profile's index on the stack */
    struct paper_stroke *strokes;
    int strokes_count;
    int samples; /* stack index of the table that holds their samples */
};

/* Makes times from the speed and the chords' lengths. */
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

/* Pushes memory for strokes, and the table of their samples. */
static void strokes_begin(lua_State *L, struct drawing *d, int most)
{
    d->strokes = lua_newuserdatauv(L, (size_t)(most + 1) * sizeof *d->strokes, 0);
    lua_newtable(L);
    d->samples = lua_gettop(L);
}

static void strokes_paint(lua_State *L, struct script_paper *paper, const struct drawing *d)
{
    script_paper_stop_when_due(L, paper);
    for (int i = 0; i < d->strokes_count; i++) {
        script_paper_check(L, paper_sheet_stroke(paper->sheet, &d->strokes[i], NULL));
        script_check(L);
    }
}

/* Adds a stroke with the samples on the top of the stack. */
static void stroke_add(lua_State *L, struct drawing *d, struct paper_stroke_sample *samples,
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
    if (d->profiled) { /* closer samples, so that the pressure follows the profile */
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
    d->strokes[d->strokes_count++] = d->stroke;
    lua_pushvalue(L, -1);
    lua_rawseti(L, d->samples, d->strokes_count);
    lua_settop(L, top);
    script_check(L);
}

/* Adds a polyline as samples at even distances. */
static void line_add(lua_State *L, struct drawing *d, const struct paper_way *way)
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
    stroke_add(L, d, samples, count);
    lua_pop(L, 1);
}

/* Lines are owned by a userdata, so that they are freed after errors, too. */
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
static void points_add(lua_State *L, struct drawing *d)
{
    int list = lua_gettop(L);
    int count = lua_istable(L, list) ? (int)lua_rawlen(L, list) : 0;
    if (count < 1 || count > CONTROL_MAX)
        luaL_error(L, "stroke points must be a list of 1..%d (got %d)", CONTROL_MAX, count);
    struct paper_stroke_sample *samples = samples_new(L, count);
    int pressed = 0, timed = 0;
    for (int i = 0; i < count; i++) {
        double n[6] = {0, 0, 0.6, 0, d->tilt[0], d->tilt[1]};
        static const double lows[6] = {-SCRIPT_PLACE_MAX, -SCRIPT_PLACE_MAX, 0, 0, -1.5, -1.5},
                            highs[6] = {SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX, 1, 1e5, 1.5, 1.5};
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
    stroke_add(L, d, samples, count);
}

/* file = "recorded.csv" */
static void recording_add(lua_State *L, struct drawing *d, const char *file)
{
    struct paper_stroke_sample *read;
    int count;
    void **box = script_box_new(L);
    const char *path = script_path(L, script_of(L)->config->in_folder, file, "samples");
    script_paper_check(L, paper_samples_read(path, &read, &count));
    *box = read;
    struct paper_stroke_sample *samples = samples_new(L, count);
    memcpy(samples, read, (size_t)count * sizeof *samples);
    for (int i = 0; i < count; i++)
        placed(&d->placing, &samples[i].x, &samples[i].y);
    d->timed = true;
    d->profiled = !lua_isnil(L, d->pressure);
    stroke_add(L, d, samples, count);
}

/* way = function(t) return x, y [, pressure [, tilt x, tilt y]] end, t from 0 to seconds */
static void way_add(lua_State *L, struct drawing *d)
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
        script_callback(L, 1, 5);
        double x = script_arg_at(L, -5, "a stroke's x", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
        double y = script_arg_at(L, -4, "a stroke's y", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
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
    stroke_add(L, d, samples, count);
}

enum { POINTS, PATH, SVG, RECORDING, WAY, WAYS_COUNT };
static const char *const ways[] = {"points", "path", "svg", "file", "way"};

/* Finds which of these the options at 2 have. */
static int way_find(lua_State *L)
{
    int found = -1, count = 0;
    for (int i = 0; i < WAYS_COUNT; i++) {
        if (lua_getfield(L, 2, ways[i]) != LUA_TNIL) {
            found = i;
            count++;
        }
        lua_pop(L, 1);
    }
    if (count != 1)
        luaL_error(L, "a stroke has one of points, path, svg, file, way (got %d)", count);
    return found;
}

/* The brush in the options at 2, which reference it; it must be a brush of the paper at 1. */
static const struct script_brush *brush_read(lua_State *L)
{
    lua_getfield(L, 2, "brush");
    const struct script_brush *brush = luaL_testudata(L, -1, script_brush_type);
    if (!brush)
        luaL_error(L, "stroke brush must be a brush of this paper (got a %s)",
                   luaL_typename(L, -1));
    lua_getiuservalue(L, -1, 1);
    if (!lua_rawequal(L, -1, 1))
        luaL_error(L, "stroke brush must be a brush of this paper (got one of another)");
    lua_pop(L, 2);
    return brush;
}

/* paper:stroke{brush =, points = | path = | svg = | file = | way =, ...} */
static int paper_stroke(lua_State *L)
{
    static const char *const keys[] = {
        "brush", "points", "path", "svg", "file",  "way",    "pressure",  "speed", "seconds",
        "pace",  "tilt",   "x",    "y",   "scale", "rotate", "tolerance", NULL};
    struct script_paper *paper = script_paper_begin(L, 2);
    struct drawing d = {.stroke = {0}};
    luaL_checktype(L, 2, LUA_TTABLE);
    script_arg_options(L, 2, "stroke", keys);
    const struct script_brush *brush = brush_read(L);
    d.stroke.number = brush->number;
    d.stroke.pace = script_arg_number(L, 2, "stroke", "pace", 30, 0, 10000);
    d.speed = script_arg_number(L, 2, "stroke", "speed", 200 + 12 * brush->width, 0.1, 1e6);
    d.seconds = script_arg_number(L, 2, "stroke", "seconds", 0, 0, 1e5);
    script_arg_numbers(L, 2, "stroke", "tilt", d.tilt, 2, -1.5, 1.5);
    d.placing.x =
        script_arg_number(L, 2, "stroke", "x", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    d.placing.y =
        script_arg_number(L, 2, "stroke", "y", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
    d.placing.scale = script_arg_number(L, 2, "stroke", "scale", 1, 1e-3, 1e3);
    double turn = script_arg_number(L, 2, "stroke", "rotate", 0, -36000, 36000) * PI / 180;
    d.placing.c = cos(turn);
    d.placing.s = sin(turn);
    double tolerance =
        script_arg_number(L, 2, "stroke", "tolerance", 0.1 / d.placing.scale, 1e-4, 1e3);
    int way = way_find(L);
    const char *text =
        way == POINTS || way == WAY ? NULL : script_arg_text(L, 2, "stroke", ways[way]);
    lua_getfield(L, 2, "pressure");
    d.pressure = lua_gettop(L);
    if (text && way != RECORDING) {
        const struct paper_lines *lines =
            lines_read(L, way == PATH ? text : NULL, way == SVG ? text : NULL, tolerance);
        strokes_begin(L, &d, lines->count);
        for (int i = 0; i < lines->count; i++)
            line_add(L, &d, &lines->line[i]);
    } else {
        strokes_begin(L, &d, 1);
        lua_getfield(L, 2, ways[way]);
        if (way == POINTS)
            points_add(L, &d);
        else if (way == WAY)
            way_add(L, &d);
        else
            recording_add(L, &d, text);
    }
    strokes_paint(L, paper, &d);
    if (!brush->dipped)
        script_note_once(L, SCRIPT_NOT_DIPPED,
                         "stroke: this brush is dry, since it was not dipped; "
                         "brush:dip{water = 1, ...} comes first");
    return 0;
}

/* path("M0 0L5 5" [, tolerance]), svg("file.svg" [, tolerance]): a list of lines, each a
 * list of {x, y}. */
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

const luaL_Reg script_stroke_methods[] = {{"stroke", paper_stroke}, {NULL, NULL}};

const luaL_Reg script_stroke_functions[] = {
    {"path", make_path}, {"svg", make_svg}, {NULL, NULL}};

void script_stroke_open(lua_State *L)
{
    script_type_open(L, lines_type, lines_gc);
}
