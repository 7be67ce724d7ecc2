/* test_hostile.c - hostile scripts: each changes or closes an object that the library is using.
 * Under ASan none may use freed memory, and each must end as its row says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <sys/wait.h>
#include <unistd.h>

#include "scripted.h"

/* Every row can use: a paper p, a brush b, a mask m and a picture q; open(), which must work
 * afterwards; closing(), a table whose __index closes the paper; texts(), a table whose __index
 * returns a string that nothing else refers to. */
static const char prelude[] =
    "p = paper{width = 16, height = 12, pigments = {'cyan'}, model = {'infused'}} "
    "b = p:brush{width = 3, bristles = 8} m = rect(1, 1, 5, 5) "
    "q = picture(3, 2, function() return 1, 0, 0.5 end) "
    "function close() p:close() return 0.5 end "
    "function open() p:put(m, {water = 0.1}) print('open', p:total('water') > 0) end "
    "function closing(t) return setmetatable(t or {}, {__index = function() p:close() end}) "
    "end "
    "function litter() for i = 1, 3000 do local s = ('x'):rep(200) .. i end end "
    "held = {font = 1, filter = 1, features = 1, language = 1, like = 1, name = 1, layer = 1, "
    "stock = 1} "
    "function texts(t) return setmetatable(t or {}, {__index = function(_, k) "
    "  litter() return held[k] and ('y'):rep(90) .. #k end}) end ";

#define IN_USE "in use"
#define OPEN "open\ttrue\n"

static const struct {
    const char *script;
    const char *says;   /* part of the error; NULL: no error */
    const char *prints; /* all of it; NULL: whatever */
    bool trusted;
} rows[] = {
    /* a callback closes the paper that has called it */
    {"p:stroke{brush = b, pace = 0, points = {{1, 1}, {9, 9}}, pressure = close}", IN_USE, "",
     false},
    {"p:stroke{brush = b, pace = 0, path = 'M1 1L9 9M2 2L7 3', pressure = close}", IN_USE, "",
     false},
    {"p:stroke{brush = b, pace = 0, way = function(t) close() return t, t end}", IN_USE, "",
     false},
    {"p:layer('height', close)", IN_USE, "", false},
    {"p:at(0, close)", IN_USE, "", false},
    {"p:at(0, function(x) x:close() end)", IN_USE, "", false},
    {"p:at(0, function(x) pcall(x.close, x) end) open()", NULL, OPEN, false},
    {"p:layer('height', function() pcall(close) return 1 end) open() p:close()", NULL, OPEN,
     false},
    {"p:layer('height', function() p:at(0, close) end)", IN_USE, "", false},
    {"p:layer('height', function() p:layer('resist', close) end)", IN_USE, "", false},
    /* after the call, however it ended, the paper can be closed */
    {"pcall(p.layer, p, 'height', close) open() close() p:put(m, {water = 1})",
     "this paper is closed", OPEN, false},
    {"pcall(p.layer, p, 'height', error) close() print(pcall(b.dip, b, {water = 1}))", NULL,
     "false\tthis paper is closed\n", false},
    {"local c = coroutine.create(function() p:layer('height', error) end) coroutine.resume(c) "
     "print(coroutine.status(c)) close() print(coroutine.resume(c))",
     NULL, "dead\nfalse\tcannot resume dead coroutine\n", false},
    {"pcall(coroutine.wrap(function() p:layer('height', error) end)) close() print('closed')",
     NULL, "closed\n", false},
    {"local c = coroutine.create(function() p:layer('height', error) end) "
     "local d = coroutine.wrap(function() coroutine.resume(c) end) d() close() print('closed')",
     NULL, "closed\n", false},
    /* a failed coroutine loses its last reference while it closes its variables */
    {"K = coroutine.create(function() local x <close> = setmetatable({}, {__close = function() "
     "K = nil "
     "for i = 1, 9 do collectgarbage() coroutine.wrap(litter)() end end}) error('x') end) "
     "print(coroutine.resume(K)) open()",
     NULL, NULL, true},
    {"K = coroutine.create(function() local x <close> = setmetatable({}, {__close = function() "
     "K = nil "
     "for i = 1, 40 do coroutine.wrap(litter)() end end}) error('x') end) coroutine.resume(K) "
     "open()",
     NULL, OPEN, false},
    {"coroutine.resume(5)", "coroutine expected", "", false},
    {"coroutine.resume()", "coroutine expected", "", false},
    /* a callback changes the paper that has called it */
    {"p:layer('height', function(x, y) p:put(m, {water = 0.01}) return x / 99 end) open()",
     NULL, OPEN, false},
    {"p:layer('height', function(x, y) if x + y == 3 then p:undo() p:redo() p:to(0) end return "
     "x / 99 end) open()",
     NULL, OPEN, false},
    {"p:stroke{brush = b, pace = 0, points = {{1, 1}, {9, 9}}, pressure = function(u) "
     "b:dip{water = u} "
     "p:brush{number = 1, width = 5} return u end} open()",
     NULL, OPEN, false},
    {"local n = 0 p:layer('height', function(x, y) n = n + 1 if n < 300 then p:layer('height', "
     "function() "
     "return n / 1e4 end) end return n / 1e4 end)",
     NULL, "", false},
    {"local function deep() p:layer('height', deep) end deep()", "C stack overflow", "", false},
    {"local function deep() p:at(0, deep) end deep()", "", "", false},
    {"p:stroke{brush = b, pace = 0, path = 'M1 1L9 9M2 2L7 3', pressure = function(u) "
     "p:undo(9) return u end}",
     "no brush 0", "", false},
    /* callbacks that yield, fail, or return no number */
    {"coroutine.wrap(function() p:layer('height', coroutine.yield) end)()", "attempt to yield",
     "", false},
    {"coroutine.wrap(function() p:stroke{brush = b, pace = 0, way = coroutine.yield} end)()",
     "attempt to yield", "", false},
    {"coroutine.wrap(function() p:at(0, coroutine.yield) end)()", "attempt to yield", "",
     false},
    {"coroutine.wrap(function() mask(3, 3, coroutine.yield) end)()", "attempt to yield", "",
     false},
    {"coroutine.wrap(function() picture(3, 3, coroutine.yield) end)()", "attempt to yield", "",
     false},
    {"p:layer('height', function() error('mine') end)", "mine", "", false},
    {"p:stroke{brush = b, pace = 0, path = 'M1 1L9 9M2 2L7 3', pressure = function(u) "
     "error({}) end}",
     "a table", "", false},
    {"print(p:total('water')) pcall(p.stroke, p, {brush = b, pace = 0, path = 'M1 1L9 9M2 2L7 "
     "3', "
     "pressure = function(u) if n then error'' end n = u == 1 or nil return u end}) "
     "print(p:total('water'))",
     NULL, "0.0\n0.0\n", false}, /* a stroke that fails in its second line paints nothing */
    {"p:layer('height', tostring)", "a layer's value", "", false},
    {"p:layer('height', 1.5)", "a layer's value (height) must be", "", false},
    {"p:layer('grip', function() return 0 end)", "a layer's value (grip)", "", false},
    {"mask(3, 3, function() return {} end)", NULL, "", false},
    /* the library reads tables without their metamethods */
    {"p:splatter(closing{drops = 3}, {water = 0.1}) open()", NULL, OPEN, false},
    {"p:brush(closing{width = 4, bristles = 8}) open()", NULL, OPEN, false},
    {"p:wash({water = 0.1}, closing()) open()", NULL, OPEN, false},
    {"p:wash(closing{water = 0.1}) open()", NULL, OPEN, false},
    {"p:salt(closing{grains = 3}) open()", NULL, OPEN, false},
    {"p:separate(q, closing()) open()", NULL, OPEN, false},
    {"p:separate(q, {pigments = closing()}) open()", "needs pigments", "", false},
    {"p:air(closing()) open()", NULL, OPEN, false},
    {"p:air{gravity = closing{0, 1}} open()", NULL, OPEN, false},
    {"p:frame('hostile.png', closing()) open()", NULL, OPEN, false},
    {"p:type('a', closing{size = 9}, {water = 0.1}) open()", NULL, OPEN, false},
    {"text('a', closing{size = 9}) open()", NULL, OPEN, false},
    {"p:stroke(closing{brush = b, pace = 0, points = {{1, 1}, {9, 9}}}) open()", NULL, OPEN,
     false},
    {"p:stroke{brush = b, pace = 0, points = closing{closing{1, 1}, closing{9, 9}}} open()",
     NULL, OPEN, false},
    {"p:stroke{brush = b, pace = 0, points = {{1, 1}, {9, 9}}, pressure = closing{0.5, 1}} "
     "open()",
     NULL, OPEN, false},
    {"p:film(closing()) open()", NULL, OPEN, false},
    {"b:dip({water = 0.5}, closing()) open()", NULL, OPEN, false},
    {"b:dip(closing{water = 0.5}) open()", NULL, OPEN, false},
    {"p:put(m, closing{water = 0.5}) open()", NULL, OPEN, false},
    {"paper(closing{width = 8, height = 8}) open()", NULL, OPEN, false},
    {"polygon(closing{{1, 1}, {5, 5}, closing{2, 8}}) open()", NULL, OPEN, false},
    {"line(closing{closing{1, 1}, {5, 5}}) open()", NULL, OPEN, false},
    /* strings that only a metamethod would return */
    {"p:frame('hostile.png', texts()) open()", NULL, OPEN, false},
    {"p:type('a', texts{size = 9}, {water = 0.1}) open()", NULL, OPEN, false},
    {"text('a', texts{size = 9})", NULL, "", false},
    {"text('a', {corners = {{0, 0}, {9, 0}, {9, 9}}})", "four points", "", false},
    {"text('a', {corners = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, x = 3})", "go without x", "",
     false},
    {"page('a', {columns = 99})", "columns must be", "", false},
    {"page('a', {size = 30, width = 20})", "too small for letters", "", false},
    {"page('a', {around = {{1, 2}}})", "3..400 points", "", false},
    {"page('a', {font = '/etc/passwd'})", "not a file", "", false},
    {"local m, n = page(('a marsh '):rep(900), {width = 200, height = 200, hyphenate = true, "
     "around = {{90, 90}, {120, 90}, {100, 130}}}); assert(n > 3); "
     "local x, y, w, h = m:bounds(); assert(w == 200 and h == 200)",
     NULL, "", false},
    {"text('a', {axes = 'wght'})", "axes must be like", "", false},
    {"text('a', {warp = 'round'})", "warp must be", "", false},
    {"local m = text('a', {size = 9, corners = {{0, 0}, {99, 0}, {99, 50}, {0, 50}}}); "
     "local x, y, w, h = m:bounds(); assert(w > 80 and h > 20)",
     NULL, "", false},
    {"p:brush(texts{width = 4, bristles = 8})", NULL, "", false},
    {"p:stroke(texts{brush = b, pace = 0, path = 'M1 1L9 9'}) open()", NULL, OPEN, false},
    {"p:film(texts())", NULL, "", false},
    {"paper(texts{width = 8, height = 8})", NULL, "", false},
    {"paper{width = 8, height = 8, pigments = {texts()}}", NULL, "", false},
    {"p:layer(setmetatable({}, {__tostring = close}), 1)", "string expected", "", false},
    {"print(setmetatable({}, {__tostring = function() litter() return 'z' end}))", NULL, "z\n",
     false},
    {"print(pcall(print, setmetatable({}, {__tostring = close}))) b:dip{water = 1}",
     "this paper is closed", NULL, false},
    /* the sandbox has no finalizers, by any way */
    {"setmetatable({}, {__gc = close})", "have no __gc", "", false},
    {"local t = {} setmetatable(t, {__gc = true})", "have no __gc", "", false},
    {"local mt = {} local t = setmetatable({}, mt) mt.__gc = close t = nil litter() litter() "
     "open()",
     NULL, OPEN, false},
    {"getmetatable('').__gc = close litter() open()", "index a boolean value", "", false},
    /* no metatable is reached, nor a function in one, nor an address (security.md 1) */
    {"print(getmetatable(spring), getmetatable(''), getmetatable(spring.network()))", NULL,
     "false\tfalse\tfalse\n", false},
    {"spring[1], spring[{}], spring[true], spring.last = 1, 1, 1, 1; print(spring.nothing)",
     "spring has no 'nothing'; it has last, network, word", "", false},
    {"for i = 1, 1000 do spring['n' .. i] = i end spring.nothing()", "it has ", "", false},
    {"local t = {} assert(tostring(t) == tostring(t) and tostring(t) ~= tostring({})) "
     "for _, x in ipairs{t, print, p, m, paper, coroutine.create(print)} do "
     "  local s = tostring(x) assert(s == ('%s'):format(x) and #s:match(': (%d+)$') < 4, s) "
     "  assert(('%p'):format(x) == s:match('%d+$') and not ('%p|%s'):format(x, x):find('0x')) "
     "end "
     "print(('%p %5p|%-6s|%s %d%%'):format('a', 1, {} and 'x', nil, 3))",
     NULL, "(null) (null)|x     |nil 3%\n", false},
    {"local a, b = math.randomseed() local x = math.random(1 << 40) math.randomseed() "
     "print(a, b, x == math.random(1 << 40))",
     NULL, "1990\t0\ttrue\n", false},
    {"print(('%s %s'):format(1))", "bad argument #2 to 'format'", "", false},
    {"print(('%'):format(1))", "invalid conversion", "", false},
    {"print(('%p'):rep(99):format(table.unpack({p, p, p, p}, 1, 99)):sub(1, 2))", NULL, NULL,
     false},
    /* coroutines that close each other do not overflow the C stack */
    {"local co = {} for i = 1, 15000 do co[i] = coroutine.create(function() "
     "local x <close> = setmetatable({}, {__close = function() "
     "if co[i + 1] then coroutine.close(co[i + 1]) end end}) coroutine.yield() end) "
     "coroutine.resume(co[i]) end print(coroutine.close(co[1]))",
     NULL, NULL, false},
    {"local co = {} for i = 15000, 1, -1 do co[i] = coroutine.wrap(function() "
     "local x <close> = setmetatable({}, {__close = function() "
     "if co[i + 1] then co[i + 1]() end end}) error('x') end) end print(pcall(co[1]))",
     NULL, NULL, false},
    {"local co = {} for i = 15000, 1, -1 do co[i] = coroutine.create(function() "
     "local x <close> = setmetatable({}, {__close = function() "
     "if co[i + 1] then coroutine.resume(co[i + 1]) end end}) error('x') end) end "
     "print(coroutine.resume(co[1]))",
     NULL, NULL, false},
    {"setmetatable(p, {})", "table expected", "", false},
    {"setmetatable({}, 5)", "nil or table expected", "", false},
    {"print(getmetatable(p), getmetatable(m), getmetatable(b), getmetatable(q), "
     "getmetatable(paper))",
     NULL, "false\tfalse\tfalse\tfalse\tfalse\n", false},
    {"p.put(m, m)", "lutetia paper expected", "", false},
    {"p.close(b)", "lutetia paper expected", "", false},
    {"p.frame('a.png')", "a method is called with a colon", "", false},
    {"b.dip{water = 1}", "a method is called with a colon", "", false},
    {"p:put('a', {water = 1})", "got string)\n", "", false},
    {"b.dip(p, {water = 1})", "lutetia brush expected", "", false},
    {"m.bounds(q)", "lutetia mask expected", "", false},
    /* what is wrong is said with its line, also where Lua's own functions are between */
    {"print((select(2, pcall(function() return 'a' - m end))):match(':%d+: (.*)'))", NULL,
     "- joins a mask with a mask or a number (got a string)\n", false},
    {"print((select(2, pcall(function() return m + {} end))):match(':%d+: (.*)'))", NULL,
     "+ joins a mask with a mask or a number (got a table)\n", false},
    {"print((select(2, pcall(function() setmetatable({}, 5) end))):match(':%d+: (.*)'))", NULL,
     "bad argument #2 to 'setmetatable' (nil or table expected, got number)\n", false},
    /* to-be-closed variables close the paper while it is in use, and when it is not */
    {"p:layer('height', function() local x <close> = setmetatable({}, {__close = close}) "
     "return 1 end)",
     IN_USE, "", false},
    {"do local x <close> = setmetatable({}, {__close = close}) end p:put(m, {})",
     "this paper is closed", "", false},
    {"p:layer('height', function() local x <close> = p return 1 end)", "non-closable", "",
     false},
    /* a trusted script's finalizers run during calls: they cannot close objects in use, and may
     * use the library */
    {"setmetatable({}, {__gc = close}) p:layer('height', function() collectgarbage() return 1 "
     "end) open()",
     NULL, OPEN, true},
    {"collectgarbage('setpause', 0) collectgarbage('setstepmul', 1000) "
     "local function again() setmetatable({}, {__gc = function() pcall(close) again() end}) "
     "end again() "
     "pcall(function() while true do p:frame('hostile.png') p:layer('height', 1) "
     "p:mask('height') p:moments() "
     "p:stroke{brush = b, pace = 0, path = 'M1 1L9 9'} p:separate(q) b:dip{water = 1} "
     "p:total('water') end end) "
     "p:put(m, {})",
     "this paper is closed", "", true},
    {"local mt = {} mt.__gc = function(x) setmetatable({}, mt) m:bounds() p:put(m, {water = "
     "0.01}) end setmetatable({}, mt) "
     "collectgarbage('setpause', 0) for i = 1, 3 do p:layer('height', rect(1, 1, i, "
     "2):soften(2)) p:at('height', i % 9, 3) "
     "p:mask('height') end open()",
     NULL, NULL, true},
    {"local t = {drops = 5} setmetatable({}, {__gc = function() for k in next, t do t[k] = nil "
     "end end}) "
     "collectgarbage('setpause', 0) for i = 1, 50 do pcall(p.splatter, p, t, {water = 0.1}) "
     "t.drops = 5 t.size = 2 end open()",
     NULL, OPEN, true},
    {"x = setmetatable({}, {__gc = function() local y while true do y = {y} end end}) x = nil "
     "collectgarbage() open()",
     NULL, NULL, true},
    {"x = setmetatable({}, {__gc = function() local y while true do y = {y} end end})", NULL,
     "", true}, /* when the state is closed */
    {"x = setmetatable({}, {__gc = function() open() p:close() p = paper{width = 8, height = "
     "8} end})",
     NULL, NULL, true},
    /* scripts that make objects without end */
    {"while true do paper{width = 8, height = 8} end", "stopped after", "", false},
    {"while true do p:brush{number = 1} end", "stopped after", "", false},
    {"while true do pcall(paper, {width = 8, height = 8}) end", "stopped after", "", false},
    {"local t = {} while true do t[#t + 1] = paper{width = 8, height = 8} end", "memory", "",
     false},
    {"local t = {} while true do t[#t + 1] = rect(1, 1, 9, 9):soften(9) end", "memory", "",
     false},
    {"p:layer('height', function() while true do end end)", "stopped after", "", false},
    {"p:at(0, function() while true do end end)", "stopped after", "", false},
    {"while true do pcall(p.at, p, 0, function() while true do end end) end", "stopped after",
     "", false},
    {"local c = coroutine.wrap(function() p:layer('height', function() while true do end end) "
     "end) c()",
     "stopped after", "", false},
    {"local x <close> = setmetatable({}, {__close = function() while true do end end})",
     "stopped after", "", false},
};

static void each_gets_what_its_row_says(void **state)
{
    (void)state;
    static char script[8192];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct scripted s = {.config = scripted_config()};
        bool endless = rows[i].says && strstr(rows[i].says, "stopped");
        s.config.trusted = rows[i].trusted;
        s.config.timeout_s = endless ? 0.1 : 60;
        s.config.memory_bytes =
            (size_t)(rows[i].says && strstr(rows[i].says, "memory") ? 8 : 64) << 20;
        snprintf(script, sizeof script, "%s\n%s\n", prelude, rows[i].script);
        enum script_status status = scripted_run(&s, script);
        if (status != (rows[i].says ? SCRIPT_FAILED : SCRIPT_OK))
            fail_msg("%s: status %d: %s", rows[i].script, (int)status, s.errors);
        if (rows[i].says && !strstr(s.errors, rows[i].says))
            fail_msg("%s: it said: %s", rows[i].script, s.errors);
        if (rows[i].says && !(strchr(s.errors, '\n') && !strchr(s.errors, '\n')[1]))
            fail_msg("%s: not one line: %s", rows[i].script, s.errors);
        if (rows[i].prints && strcmp(s.prints, rows[i].prints) != 0)
            fail_msg("%s: it printed: %s", rows[i].script, s.prints);
        if (rows[i].says && strcmp(rows[i].says, IN_USE) == 0 &&
            !strstr(s.errors, "script.lua:"))
            fail_msg("%s: no line: %s", rows[i].script, s.errors);
    }
}

/* ---- scripts that nothing in the process can stop ---- */

static const struct {
    const char *script;
    bool trusted, interrupted; /* else its time is up */
} endless[] = {
    {"string.rep('a', 99):find(string.rep('a-', 99) .. 'b')", false, false},
    {"string.rep('a', 99):find(string.rep('a-', 99) .. 'b')", false, true},
    {"table.move({}, 1, 1 << 60, 2)", false, false},
    {"setmetatable({}, {__gc = function() while true do end end}) collectgarbage()", true,
     false},
    {"x = setmetatable({}, {__gc = function() while true do end end})", true,
     false}, /* at its end */
    {"x = setmetatable({}, {__gc = function() while true do end end})", true, true},
    {"x = setmetatable({}, {__gc = function() while true do pcall(string.rep, 'x', 1 << 20) "
     "end end})",
     true, false},
};

static void overdue(void *context)
{
    (void)context;
    _exit(42);
}

static bool end_asked(void *context)
{
    (void)context;
    return true;
}

static void what_nothing_stops_is_told(void **state)
{
    (void)state;
    enum { COUNT = sizeof endless / sizeof *endless };
    pid_t children[COUNT];
    for (int i = 0; i < COUNT; i++) {
        children[i] = fork();
        if (children[i] == 0) {
            struct scripted s = {.config = scripted_config(), .host = {.overdue = overdue}};
            s.config.trusted = endless[i].trusted;
            s.config.timeout_s = endless[i].interrupted ? 60 : 0.1;
            s.config.grace_s = 0.1;
            if (endless[i].interrupted)
                s.host.interrupted = end_asked;
            char name[32];
            snprintf(name, sizeof name, "endless-%d", i);
            mkdir(scratch_path(name), 0700);
            strcat(scratch_dir, "/");
            strcat(scratch_dir, name);
            scripted_run(&s, endless[i].script);
            _exit(0);
        }
    }
    for (int i = 0; i < COUNT; i++) {
        int status;
        assert_int_equal(waitpid(children[i], &status, 0), children[i]);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 42)
            fail_msg("%s: status %d", endless[i].script, status);
    }
}

int main(void)
{
    scratch_path("");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            what_nothing_stops_is_told), /* first: it forks before there is a machine */
        cmocka_unit_test(each_gets_what_its_row_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
