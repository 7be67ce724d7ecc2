/* script_grammar.c - see script_grammar.h.
 *
 * A script begins with papers, brushes, masks and pictures in globals, and with callbacks that
 * close, collect, fail, yield, recurse and paint. Most statements call a function of ours. */
#include "script_grammar.h"

#include <script_internal.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { STATEMENTS_MAX = 14, DEPTH_MAX = 4 };

/* The kinds of a function's arguments, a letter each:
 *   n number   i small whole number   b boolean   c two numbers   m mask   q picture   A amounts   O options   U a stroke's options
 *   L layer   l a layer's value   P pigment   W substance   f function   t corners   D path   S text   s a picture's file
 *   h a paper's file   r render's numbers   C a control of springs   v anything */
static const struct {
    const char *of, *name, *takes;
    const char *options; /* key:letter, for an O */
} grammar[] = {
    {NULL, "print", "vv", ""},
    {NULL, "param", "Sv", ""},
    {NULL, "expect", "i", ""},
    {NULL, "rect", "nnnn", ""},
    {NULL, "ellipse", "nnnn", ""},
    {NULL, "circle", "nnn", ""},
    {NULL, "polygon", "t", ""},
    {NULL, "line", "tn", ""},
    {NULL, "text", "SO",
     "size:n font:S x:n y:n align:S tracking:n filter:S angle:n width:n leading:n features:S "
     "language:S anchor:n right_to_left:b axes:S darken:n corners:t warp:S"},
    {NULL, "page", "SO",
     "width:n height:n margin:n columns:i gap:n size:n font:S italic:S bold:S leading:n "
     "align:S indent:n notes:n page:i hyphenate:b language:S features:S protrude:n expand:n "
     "vertical:b around:t inside:t x:n y:n filter:S darken:n tolerance:n"},
    {NULL, "typeface", "SO", "size:n filter:S axes:S"},
    {NULL, "image", "snn", ""},
    {NULL, "song", "S", ""},
    {NULL, "mask", "iif", ""},
    {NULL, "path", "Dn", ""},
    {NULL, "svg", "Sn", ""},
    {NULL, "picture", "iif", ""},
    {"mask", "move", "nn", ""},
    {"mask", "rotate", "nnn", ""},
    {"mask", "scale", "nnn", ""},
    {"mask", "soften", "n", ""},
    {"mask", "bounds", "", ""},
    {"mask", "__add", "m", ""},
    {"mask", "__mul", "m", ""},
    {"mask", "__sub", "m", ""},
    {"papers", "__call", "O",
     "width:i height:i torus:b model:S rule:S stock:S seed:i pigments:v color:v deckle:v "
     "color_variation:n absorbency:n capacity:n roughness:n grain:n fibers:v history:b undo:n"},
    {"papers", "load", "hi", ""},
    {"paper", "put", "mA", ""},
    {"paper", "blot", "mnn", ""},
    {"paper", "resist", "m", ""},
    {"paper", "unresist", "m", ""},
    {"paper", "dry", "", ""},
    {"paper", "seal", "", ""},
    {"paper", "tilt", "nn", ""},
    {"paper", "air", "O",
     "gravity:v seep:v spread:n relief:n film:n pinning:n absorption:n "
     "carry:n humidity:n edge:n edge_width:n settling:n"},
    {"paper", "step", "i", ""},
    {"paper", "type", "SOA", "size:n x:n y:n align:S width:n"},
    {"paper", "close", "", ""},
    {"paper", "layer", "LlP", ""},
    {"paper", "mask", "LnnP", ""},
    {"paper", "at", "if", ""},
    {"paper", "total", "W", ""},
    {"paper", "frame", "sO",
     "show:S layer:L pigment:P low:n high:n bits:i light:n scale:i ground:v"},
    {"paper", "undo", "i", ""},
    {"paper", "redo", "i", ""},
    {"paper", "to", "i", ""},
    {"paper", "moments", "", ""},
    {"paper", "again", "S", ""},
    {"paper", "save", "h", ""},
    {"paper", "render", "r", ""},
    {"paper", "film", "O", "show:S x:n y:n width:n height:n"},
    {"paper", "brush", "O",
     "kind:S width:n depth:n bristles:i angle:n follows:b point:n uneven:n splay:n bend:n "
     "thickness:n reach:n load:n flow:n mixing:n seed:i mirrored:b number:i"},
    {"paper", "stroke", "U", ""},
    {"paper", "wash", "AO", "from:c to:c into:A mask:m"},
    {"paper", "lift", "mn", ""},
    {"paper", "varnish", "mn", ""},
    {"paper", "splatter", "OA", "x:n y:n radius:n drops:i size:c angle:n thrown:n seed:i"},
    {"paper", "salt", "O", "x:n y:n radius:n grains:i size:c strength:n reach:n mask:m seed:i"},
    {"paper", "picture", "", ""},
    {"paper", "separate", "qO",
     "x:i y:i width:i height:i pigments:v most:n thrift:n strength:n water:n mask:m"},
    {"brush", "dip", "AO", "part:n side:c"},
    {"brush", "rinse", "n", ""},
    {"brush", "wipe", "n", ""},
    {"brush", "holds", "W", ""},
    {"picture", "size", "", ""},
    {"spring", "network", "S", ""},
    {"spring", "word", "O",
     "text:S font:S size:n x:n y:n width:n align:S features:S preset:S path:t circle:v side:n "
     "link:n letter_mass:n box:S tack:S link_breaking:n gravity:n stiffness:n integrator:i"},
    {"network", "word", "O", "text:S size:n x:n y:n preset:S path:t side:n damping_ratio:n"},
    {"network", "hang", "ii", ""},
    {"network", "letters", "", ""},
    {"network", "letter", "i", ""},
    {"network", "mask", "O", "scale:n x:n y:n"},
    {"network", "mass", "O", "x:n y:n vx:n vy:n mass:n drag:n gravity:n friction:n stuck:b"},
    {"network", "spring", "iiO", "constant:n rest_length:n damping:n breaking_strain:n"},
    {"network", "place", "i", ""},
    {"network", "masses", "", ""},
    {"network", "springs", "", ""},
    {"network", "ends", "i", ""},
    {"network", "nearest", "nnn", ""},
    {"network", "time", "", ""},
    {"network", "energy", "", ""},
    {"network", "save", "S", ""},
    {"network", "set", "Cn", ""},
    {"network", "get", "C", ""},
    {"network", "set_mass", "iCn", ""},
    {"network", "set_spring", "iCn", ""},
    {"network", "hold", "inn", ""},
    {"network", "clamp", "inn", ""},
    {"network", "release", "i", ""},
    {"network", "tack", "i", ""},
    {"network", "untack", "i", ""},
    {"network", "pull", "innn", ""},
    {"network", "key", "innn", ""},
    {"network", "free", "in", ""},
    {"network", "keys", "S", ""},
    {"network", "cut", "innn", ""},
    {"network", "pluck", "in", ""},
    {"network", "collide", "b", ""},
    {"network", "events", "", ""},
    {"network", "on", "f", ""},
    {"network", "step", "in", ""},
    {"network", "machine", "in", ""},
};
enum { GRAMMAR_COUNT = sizeof grammar / sizeof *grammar };

unsigned script_byte(struct script_source *s)
{
    return s->at < s->end ? *s->at++ : 0;
}

__attribute__((format(printf, 2, 3))) static void say(struct script_source *s,
                                                      const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    size_t room = sizeof s->text - s->length;
    int count = vsnprintf(s->text + s->length, room, format, arguments);
    va_end(arguments);
    if (count > 0 && (size_t)count < room)
        s->length += (size_t)count;
    else
        s->text[s->length] = '\0';
}

#define ONE_OF(s, list) ((list)[script_byte(s) % (sizeof(list) / sizeof *(list))])

static void value(struct script_source *s, char what, const char *options, int depth);
static void call(struct script_source *s, int depth);
static void statement(struct script_source *s, int depth);

/* ---- values ---- */

static void number(struct script_source *s)
{
    static const char *const wild[] = {
        "-1",         "0/0",   "1/0",    "-1/0",   "1e300",  "1 << 62",         "-0.0", "16384",
        "0x7fffffff", "-2^31", "1e-300", "100000", "-99999", "math.mininteger", "20000"};
    unsigned kind = script_byte(s);
    if (kind < 40)
        say(s, "%s", ONE_OF(s, wild));
    else if (kind < 130)
        say(s, "%u", script_byte(s) % 12);
    else
        say(s, "%.3g", (script_byte(s) + 1) / (kind < 200 ? 256.0 : 16.0));
}

static void mask(struct script_source *s, int depth)
{
    static const char *const good[] = {"M",
                                       "N",
                                       "E",
                                       "rect(1, 2, 5, 4)",
                                       "ellipse(5, 5, 3.5, 2)",
                                       "polygon{{1, 1}, {9, 2}, {4, 8}}",
                                       "rect(-5, -5, 40, 40)",
                                       "line({{1, 1, 3}, {8, 7, 0}})"};
    static const char *const operators[] = {"+", "*", "-"};
    unsigned kind = script_byte(s);
    if (kind < 160 || depth > DEPTH_MAX) {
        say(s, "%s", ONE_OF(s, good));
    } else if (kind < 220) {
        say(s, "(");
        mask(s, depth + 1);
        say(s, " %s ", ONE_OF(s, operators));
        mask(s, depth + 1);
        say(s, ")");
    } else {
        say(s, "(");
        mask(s, depth + 1);
        say(s, "):move(");
        number(s);
        say(s, ", ");
        number(s);
        say(s, ")");
    }
}

/* Writes a function; its results suit most callers. */
static void function(struct script_source *s, int depth)
{
    static const char *const known[] = {"close", "close",  "collect", "fail",  "again",
                                        "paint", "yield",  "undo",    "brush", "half",
                                        "place", "resume", "change",  "half"};
    if (script_byte(s) % 4 || depth > 2) {
        say(s, "%s", ONE_OF(s, known));
        return;
    }
    say(s, "function(x, y) ");
    for (unsigned count = script_byte(s) % 2 + 1; count > 0; count--)
        statement(s, depth + 1);
    say(s, "return 0.5, 0.25 end");
}

static void options_write(struct script_source *s, const char *keys, int depth)
{
    char key[32];
    say(s, "{");
    for (int length; sscanf(keys, " %31[^:]%n", key, &length) == 1;) {
        char what = keys[length + 1];
        keys += length + 2;
        if (script_byte(s) % 3)
            continue;
        say(s, "%s = ", key);
        value(s, what, "", depth + 1);
        say(s, ", ");
    }
    if (script_byte(s) % 40 == 0)
        say(s, "bogus = 1");
    say(s, "}");
}

/* Writes a table, sometimes one with metamethods. */
static void table(struct script_source *s, const char *keys, int depth)
{
    bool answers = script_byte(s) % 6 == 0;
    if (answers)
        say(s, "setmetatable(");
    options_write(s, keys, depth);
    if (answers) {
        say(s, ", {__index = ");
        function(s, depth + 1);
        say(s, ", __len = fail, __newindex = close, __pairs = close, __tostring = half})");
    }
}

static void stroke(struct script_source *s, int depth)
{
    say(s, "{brush = %s, pace = %d", script_byte(s) % 8 ? "B" : "C", script_byte(s) % 16 == 0);
    static const char *const ways[] = {
        "points = ", "path = ", "way = ", "points = ", "svg = ", "file = "};
    static const char letters[] = "tDftSS";
    unsigned way = script_byte(s) % 6;
    say(s, ", %s", ways[way]);
    value(s, letters[way], "", depth + 1);
    unsigned pressed = script_byte(s) % 4;
    if (pressed) {
        say(s, ", pressure = ");
        value(s, pressed == 1 ? 'v' : 'f', "", depth + 1);
    }
    if (script_byte(s) % 4 == 0) {
        say(s, ", speed = ");
        number(s);
        say(s, ", seconds = 0.1, scale = ");
        number(s);
        say(s, ", rotate = ");
        number(s);
    }
    say(s, "}");
}

static void anything(struct script_source *s, int depth)
{
    static const char *const words[] = {
        "nil",
        "true",
        "p",
        "P",
        "T",
        "B",
        "M",
        "N",
        "paper",
        "print",
        "p.put",
        "V",
        "{}",
        "''",
        "'\\0\\27[m'",
        "{0.2, 0.9}",
        "{1, 2, 3}",
        "'#a0b0c0'",
        "{'cyan'}",
        "{'cyan', {name = 'x', white = '#c04020', black = '#201008'}}",
        "K",
        "coroutine.running()",
        "string.rep('x', 3000)",
        "{{1, 2}, {8, 7}}",
        "setmetatable({}, {__index = close})",
        "setmetatable({1, 2}, {__index = collect, __call = fail})",
        "p.mask",
        "function() return K end"};
    unsigned kind = script_byte(s) % 8;
    if (kind < 2)
        number(s);
    else if (kind < 3 && depth < DEPTH_MAX)
        call(s, depth + 1);
    else
        say(s, "%s", ONE_OF(s, words));
}

/* Kinds of arguments that are one of a list. */
static const struct {
    char what;
    bool quoted;
    const char *of[21];
} lists[] = {
    {'L',
     true,
     {"height", "absorbency", "capacity", "resist", "varnish", "salt", "brine", "red",
      "surface water", "infused water", "dried water", "surface pigment", "infused pigment",
      "fixed pigment", "steam"}},
    {'S', true, {"a",        "",      "cold press", "wet",         "color", "center", "thesis",
                 "luminous", "fan",   "flat",       "DejaVuSerif", "box",   "x.svg",  "../x",
                 "f i",      "\\xff", "full",       "kern=0",      "en",    "layer"}},
    {'D',
     true,
     {"M1 1L9 9", "M1 1Q5 5 9 2z", "M2 2h3v3zM1 5L8 5", "M0 0A5 5 0 0 1 9 9", "", "M",
      "M1e9 1L-1e9 3"}},
    {'P', true, {"cyan", "cyan", "spot", "soot"}},
    {'W', true, {"water", "cyan", "dried", "soot"}},
    {'s', true, {"a.png", "a.png", "b.png", "../a.png", ".a.png"}},
    {'h', true, {"a.h5", "a.h5", "none.h5", "a.png"}},
    {'t',
     false,
     {"{{1, 1}, {9, 2}, {4, 8}}", "{{2, 3}, {7, 5, 1}}", "{{1, 1, 0.5, 0}, {3, 9, 1, 0.2}}",
      "{}", "{{1, 1}}", "{{0/0, 1}, {2, 2}, {3, 3}}", "K",
      "{{-50, -60}, {70, 80}, {5, 5}, {5, 5}}"}},
    {'r', false, {"1", "1", "2, 1", "0.9, 2"}},
    {'b', false, {"true", "false"}},
    {'q', false, {"I", "I", "I", "p:picture()"}},
    {'C',
     true,
     {"gravity", "stiffness", "floor_on", "integrator", "restitution", "side", "mass", "x",
      "constant", "rest_length", "tack", "none"}},
};

static bool listed(struct script_source *s, char what)
{
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        unsigned count = 0;
        while (lists[i].of[count])
            count++;
        if (lists[i].what != what)
            continue;
        const char *text = lists[i].of[script_byte(s) % count];
        say(s, lists[i].quoted ? "'%s'" : "%s", text);
        return true;
    }
    return false;
}

static void value(struct script_source *s, char what, const char *options, int depth)
{
    if (script_byte(s) % 24 == 0)
        what = 'v';
    if (listed(s, what))
        return;
    switch (what) {
    case 'n':
        number(s);
        break;
    case 'i':
        say(s, "%u", script_byte(s) % 8 ? script_byte(s) % 20 : script_byte(s));
        break;
    case 'c':
        say(s, "{%u, %u}", script_byte(s) % 9, script_byte(s) % 9);
        break;
    case 'm':
        mask(s, depth);
        break;
    case 'A':
        say(s,
            script_byte(s) % 8 ? "{water = %.2g, cyan = %.2g}" : "{water = %.2g, spot = %.2g}",
            script_byte(s) / 128.0, script_byte(s) / 256.0);
        break;
    case 'O':
        table(s, options, depth);
        break;
    case 'U':
        stroke(s, depth);
        break;
    case 'f':
        function(s, depth);
        break;
    case 'l':
        value(s, "ffmn"[script_byte(s) % 4], "", depth);
        break;
    default:
        anything(s, depth);
    }
}

/* ---- calls ---- */

static void call(struct script_source *s, int depth)
{
    static const char *const papers[] = {"p", "p", "p", "P", "P", "T", "V"};
    unsigned row = script_byte(s) % GRAMMAR_COUNT;
    for (int i = 0; i < 3 && !strpbrk(grammar[row].takes, "flUO"); i++) /* most call back */
        row = script_byte(s) % GRAMMAR_COUNT;
    const char *of = grammar[row].of, *name = grammar[row].name;
    if (name[0] == '_' && strcmp(name, "__call") != 0) {
        mask(s, 0);
        return;
    }
    if (strcmp(name, "close") == 0 && script_byte(s) % 3)
        name = "dry";
    if (of && strcmp(of, "paper") == 0)
        say(s, "used(%s):%s(", ONE_OF(s, papers), name);
    else if (of && strcmp(of, "papers") == 0)
        say(s, "paper%s%s(", name[0] == '_' ? "" : ".", name[0] == '_' ? "" : name);
    else if (of && strcmp(of, "spring") == 0)
        say(s, "spring.%s(", name);
    else if (of && strcmp(of, "network") == 0)
        say(s, "W:%s(", name);
    else if (of)
        say(s, "%s:%s(",
            strcmp(of, "mask") == 0    ? (script_byte(s) % 2 ? "M" : "N")
            : strcmp(of, "brush") == 0 ? (script_byte(s) % 4 ? "B" : "C")
                                       : "I",
            name);
    else
        say(s, "%s(", name);
    if (strcmp(name, "step") == 0 && !s->trusted) /* kernels take long to compile */
        say(s, "%u", script_byte(s) % 32 == 0);
    else if (strcmp(name, "at") == 0 && script_byte(s) % 2) {
        value(s, 'L', "", depth);
        say(s, ", 3, 4, 'cyan'");
    } else
        for (const char *what = grammar[row].takes; *what; what++) {
            if (script_byte(s) % 16 == 0)
                break;
            say(s, "%s", what == grammar[row].takes ? "" : ", ");
            value(s, *what, grammar[row].options, depth + 1);
        }
    say(s, ")");
}

/* ---- statements ---- */

static void statement(struct script_source *s, int depth)
{
    static const char *const kept[] = {"M", "N", "I", "V", "K", "B", "W"};
    static const char *const collections[] = {
        "collectgarbage() ", "collectgarbage('step', 100) ", "collectgarbage('generational') ",
        "collectgarbage('incremental', 1, 1000) ", "collectgarbage('setpause', 0) "};
    switch (depth < 3 ? script_byte(s) % 16 : 0) {
    case 1: /* keeps the call's result, if it is an object */
        say(s, "pcall(function() local v = ");
        call(s, depth);
        say(s, " if type(v) == 'userdata' then %s = v end end) ", ONE_OF(s, kept));
        break;
    case 2:
        say(s, "pcall(coroutine.wrap(function() ");
        statement(s, depth + 1);
        say(s, "coroutine.yield(1) ");
        statement(s, depth + 1);
        say(s, "end)) ");
        break;
    case 3:
        say(s, "K = coroutine.create(function(...) local x <close> = setmetatable({}, {__close "
               "= ");
        function(s, depth + 1);
        say(s, "}) ");
        statement(s, depth + 1);
        say(s, "coroutine.yield(...) ");
        call(s, depth + 1);
        say(s, " end) coroutine.resume(K) ");
        break;
    case 4:
        say(s, "if type(K) == 'thread' then coroutine.%s end ",
            script_byte(s) % 2 ? "resume(K, p)" : "close(K)");
        break;
    case 5:
        say(s, "pcall(function() local x <close> = setmetatable({}, {__close = ");
        function(s, depth + 1);
        say(s, "}) ");
        statement(s, depth + 1);
        say(s, "end) ");
        break;
    case 6:
        say(s, "pcall(function() setmetatable({}, {__gc = ");
        function(s, depth + 1);
        say(s, "}) end) ");
        break;
    case 7:
        say(s, "%s", s->trusted ? ONE_OF(s, collections) : "collect() ");
        break;
    case 8:
        say(s, "pcall(reopen) ");
        break;
    default:
        say(s, "pcall(function() return ");
        call(s, depth);
        say(s, " end) ");
    }
}

static const char functions[] =
    "local depth, turns = 0, 0\n"
    "function used(x) last = x return x end\n"
    "function close() local x = last or p x:close() return 0.5, 1 end\n"
    "function collect() for i = 1, 40 do V = ('x'):rep(50 * i) .. i end if collectgarbage then "
    "collectgarbage() end return 0.5, 1 end\n"
    "function fail(x) error(x or {}) end\n"
    "function again() depth, turns = depth + 1, turns + 1 if depth < 9 and turns < 60 then "
    "pcall(p.layer, p, 'height', again) "
    "pcall(p.at, p, 0, again) end depth = depth - 1 return 0.5, 1 end\n"
    "function paint() p:put(M, {water = 0.1}) P:wash{water = 0.1} B:dip{water = 0.2} return "
    "0.5, 1 end\n"
    "function yield() return coroutine.yield(0.5) end\n"
    "function undo() p:undo(2) p:redo(1) p:to(0) return 0.5, 1 end\n"
    "function brush() B = p:brush{number = 1, width = 4, bristles = 6} return 0.5, 1 end\n"
    "function half() return 0.5, 0.25 end\n"
    "function place(x) return 3 + 2 * (tonumber(x) or 0), 4 end\n"
    "function resume() if type(K) == 'thread' then coroutine.resume(K) coroutine.close(K) end "
    "return 0.5, 1 end\n"
    "function change() M, N, B, I = N, M, C, I return 0.5, 1 end\n";

const char *script_by_chance(struct script_source *s)
{
    static const char *const models[] = {"{'infused'}", "'full'", "'thesis'",
                                         "'full', deckle = {margin = 2, thin = 1}"};
    s->length = 0;
    s->text[0] = '\0';
    say(s, "%s", functions);
    say(s,
        "function reopen() last = nil p = paper{width = %u, height = %u, pigments = {'cyan'}, "
        "model = {'infused'}, "
        "torus = %s} B = p:brush{width = 3, bristles = 8} end\n",
        8 + script_byte(s) % 25, 8 + script_byte(s) % 25,
        script_byte(s) % 2 ? "true" : "false");
    say(s,
        "function anew() P = paper{width = 9, height = 8, pigments = {'cyan', {name = 'spot', "
        "white = "
        "'#c04020', black = '#201008'}}, model = %s, history = %s} C = B pcall(function() C = "
        "P:brush{width = 2, bristles = 4} end) end\n",
        ONE_OF(s, models), script_byte(s) % 4 ? "true" : "false");
    say(s,
        "function open(x) return x and pcall(function() return x.width end) end\n"
        "function ready() if not open(p) then reopen() end if not open(P) then anew() end end\n"
        "ready() T = p M, N, E = rect(1, 1, 5, 4), ellipse(4, 5, 3):soften(1), rect(0, 0, 0, "
        "0)\n"
        "I = picture(3, 2, function(x, y) return x / 3, y / 2, 0.5 end) "
        "W = spring.word{text = 'ab', y = 1, link_breaking = 0.2}\n");
    for (int i = 0; i < STATEMENTS_MAX && s->at < s->end; i++) {
        statement(s, 0);
        say(s, "pcall(ready)\n");
    }
    return s->text;
}

/* ---- whether all is there ---- */

static bool row_is(size_t row, const char *of, const char *name)
{
    static const char prefix[] = "lutetia ";
    return strcmp(grammar[row].name, name) == 0 && !grammar[row].of == !of &&
           (!of || strcmp(of + strlen(prefix), grammar[row].of) == 0);
}

const char *script_grammar_lacks(void)
{
    for (const struct script_functions *f = script_functions; f->functions; f++)
        for (const luaL_Reg *function = f->functions; function->name; function++) {
            size_t row = 0;
            while (row < GRAMMAR_COUNT && !row_is(row, f->of, function->name))
                row++;
            if (row == GRAMMAR_COUNT)
                return function->name;
        }
    return NULL;
}
