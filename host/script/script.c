/* script.c - a run of a script: its state, its memory, its end. */
#include "script_internal.h"
#include "script_paper.h"

#include <brush.h>
#include <history.h>

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct script_config script_config_default(const char *path)
{
    return (struct script_config){.path = path,
                                  .in_folder = ".",
                                  .out_folder = ".",
                                  .timeout_s = 600,
                                  .grace_s = 1,
                                  .memory_bytes = (size_t)4 << 30,
                                  .seed = 1990};
}

/* ---- memory ---- */

/* Lua drops an object whose finalizer fails, and with it what the object holds in C; and a call
 * needs some memory. So finalizers have a little beyond the limit. While one runs, Lua's
 * collector answers nothing but -1. */
static bool finalizer_has_room(const struct script *script, size_t more)
{
    const double finalizer_bytes = 1 << 20;
    return script->main && lua_gc(script->main, LUA_GCISRUNNING) == -1 &&
           (double)script->memory_bytes + (double)more <=
               (double)script->config->memory_bytes + finalizer_bytes;
}

/* Counts Lua's memory with the script's other memory. */
void *script_allocate(void *context, void *block, size_t old, size_t new)
{
    struct script *script = context;
    old = block ? old : 0;
    if (new == 0) {
        free(block);
        script->memory_bytes -= old;
        return NULL;
    }
    if (new > old && (double)(new - old) > script_memory_left(script) &&
        !finalizer_has_room(script, new - old)) {
        script->memory_short = true;
        return NULL;
    }
    void *made = realloc(block, new);
    if (made)
        script->memory_bytes += new - old;
    return made;
}

/* ---- the run ---- */

/* Whether the object is missing before a method's arguments, as in p.frame("a.png"): no method
 * takes one of these as its first argument. */
static bool object_missing(const char *text)
{
    const char *const types[] = {script_paper_type, script_brush_type, script_network_type};
    char expected[80];
    if (!strstr(text, "bad argument #1 to '"))
        return false;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        snprintf(expected, sizeof expected, "(%s expected, got ", types[i]);
        if (strstr(text, expected))
            return true;
    }
    return false;
}

/* Converts errors that are not text; says what is usually meant. */
int script_message(lua_State *L)
{
    if (lua_type(L, 1) != LUA_TSTRING)
        lua_pushfstring(L, "error: (a %s)", luaL_typename(L, 1));
    else if (object_missing(lua_tostring(L, 1)))
        lua_pushfstring(L, "%s: a method is called with a colon, object:method(...)",
                        lua_tostring(L, 1));
    return 1;
}

/* Names and texts of scripts must not end a line or control a terminal: C0, DEL, and C1 in
 * UTF-8. */
static void one_line(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        if (*c == '\n' || *c == '\r')
            *c = ' ';
        else if (*c < ' ' || *c == 127)
            *c = '?';
        else if (*c == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0)
            c[0] = c[1] = '?';
    }
}

void script_failure_tell(lua_State *L, int status)
{
    struct script *script = script_of(L);
    const char *text = lua_tostring(L, -1);
    char line[1200];
    if (status == LUA_ERRMEM ||
        (script->memory_short && text && strcmp(text, "not enough memory") == 0))
        snprintf(line, sizeof line, "%s: not enough memory; %s allows %.0f MB",
                 script->config->path, script_memory_limit(script),
                 (double)script->config->memory_bytes * 1e-6);
    else
        snprintf(line, sizeof line, "%s", text ? text : "error");
    one_line(line);
    script_error_tell(script, line);
}

static enum script_status perform(struct script *script, lua_State *L)
{
    const char *path = script->config->path;
    lua_pushcfunction(L, script_message);
    lua_pushcfunction(L, script_open);
    int status = lua_pcall(L, 0, 0, 1);
    if (status == LUA_OK)
        status = script_load(L, path);
    if (status == LUA_OK)
        status = lua_pcall(L, 0, 0, 1);
    if (status == LUA_OK)
        return SCRIPT_OK;
    script_failure_tell(L, status);
    return script_interrupted(script) ? SCRIPT_INTERRUPTED : SCRIPT_FAILED;
}

/* Calls the host's finish(), with all papers that are open. */
static enum script_status finish(struct script *script, enum script_status status)
{
    size_t count = 0, room = 0;
    for (struct script_paper *p = script->first_paper; p; p = p->next) {
        /* computing for finish() is not interrupted */
        paper_history_set_watch(p->sheet, NULL, NULL);
        paper_sheet_stop_when(p->sheet, NULL, NULL);
        room++;
    }
    if (!script->host->finish)
        return status;
    struct paper_state_sheet *papers = calloc(room + 1, sizeof *papers);
    if (!papers) {
        script_error_tell(script, "no memory for the list of papers");
        return SCRIPT_FAILED;
    }
    for (struct script_paper *p = script->first_paper; p; p = p->next)
        papers[count++] = (struct paper_state_sheet){p->number, p->sheet};
    status = script->host->finish(script->host->context, papers, (int)count, status);
    free(papers);
    return status;
}

static enum script_status words_end(const struct script *script)
{
    for (int i = 0; i < script->config->words_count; i++)
        if (!script->asked[i]) {
            const char *word = script->config->words[i];
            char text[1200];
            snprintf(text, sizeof text, "%s asked for no '%.*s'", script->config->path,
                     (int)strcspn(word, "="), word);
            script_error_tell(script, text);
            return SCRIPT_FAILED;
        }
    return SCRIPT_OK;
}

enum script_status script_run(const struct script_config *config,
                              const struct script_host *host)
{
    struct script script = {.config = config,
                            .host = host,
                            .began_s = script_clock_s(),
                            .clock = CLOCK_MONOTONIC},
                  *self = &script;
    char text[128];
    script.stack_begin = __builtin_frame_address(0);
    if (config->words_count > SCRIPT_WORDS_MAX) {
        snprintf(text, sizeof text, "a script takes up to %d key=value", SCRIPT_WORDS_MAX);
        script_error_tell(self, text);
        return SCRIPT_FAILED;
    }
    if (config->timeout_s > 0)
        script_deadline_set(self, config->timeout_s);
    lua_State *L = lua_newstate(script_allocate, self);
    if (!L) {
        snprintf(text, sizeof text, "no memory for Lua; --memory must be more than %zu bytes",
                 config->memory_bytes);
        script_error_tell(self, text);
        return SCRIPT_FAILED;
    }
    memcpy(lua_getextraspace(L), &self, sizeof self);
    if (!script_watchdog_start(self)) {
        script_error_tell(self, "no thread to watch over the script");
        lua_close(L);
        return SCRIPT_FAILED;
    }
    script_patience_begin(self);
    enum script_status status = perform(self, L);
    script_patience_end(self);
    script_watchdog_pause(self, true);
    status = finish(self, status);
    script_watchdog_pause(self, false);
    self->over = true;
    lua_close(L); /* runs a trusted script's finalizers */
    script_watchdog_end(self);
    assert(script.memory_bytes == 0); /* all memory that was counted has been freed */
    return status == SCRIPT_OK ? words_end(self) : status;
}
