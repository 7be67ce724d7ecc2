/* papers.c - a script's papers: made, counted, kept while they are open, shown to the host. */
#include "script_paper.h"

#include <brush.h>
#include <history.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

void script_paper_check(lua_State *L, enum paper_status status)
{
    if (status != PAPER_OK) {
        script_check(L); /* after Ctrl-C, that is the reason of the failure */
        script_fail(L, paper_error());
    }
}

/* ---- making ---- */

/* Checks the limit of open papers, which is that of a saved state. Papers without references
 * are closed first. */
static void papers_check(lua_State *L)
{
    const struct script *script = script_of(L);
    int most = script->config->papers_max;
    if (most > 0 && script->papers_open >= most)
        lua_gc(L, LUA_GCCOLLECT);
    if (most > 0 && script->papers_open >= most)
        luaL_error(L, "a run that is saved has up to %d papers open; p:close() closes one",
                   most);
}

struct script_paper *script_paper_new(lua_State *L)
{
    papers_check(L);
    struct script_paper *paper = lua_newuserdatauv(L, sizeof *paper, 0);
    memset(paper, 0, sizeof *paper);
    paper->script = script_of(L);
    paper->number = ++paper->script->papers_made;
    luaL_setmetatable(L, script_paper_type);
    return paper;
}

/* What a paper of any size takes besides: the machine's arrays are not smaller than some
 * pages. */
enum { BESIDES_BYTES = 512 << 10 };

void script_paper_room_take(lua_State *L, struct script_paper *paper, double width,
                            double height, int pigments)
{
    double bytes = paper_sheet_bytes(width, height, pigments) + BESIDES_BYTES;
    double there = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (bytes > there) {
        char text[128];
        snprintf(text, sizeof text,
                 "a paper of %.0fx%.0f takes %.1f GB, and this machine has %.1f", width, height,
                 bytes * 1e-9, there * 1e-9);
        luaL_error(L, "not enough memory: %s", text);
    }
    script_memory_take(L, bytes, "a paper");
    paper->bytes = bytes;
    script_memory_machine(L, "papers need a machine");
}

const char *script_paper_shown(struct script_paper *paper)
{
    const struct script_host *host = paper->script->host;
    return host->step ? host->step(host->context, paper->number, paper->sheet) : NULL;
}

void script_paper_show(lua_State *L, struct script_paper *paper)
{
    const char *error = script_paper_shown(paper);
    if (error)
        luaL_error(L, "%s", error);
}

/* Called between the steps of a stroke. */
static bool due(void *context)
{
    struct script_paper *paper = context;
    script_paper_shown(paper); /* a failure is reported afterwards */
    return script_due(paper->script);
}

void script_paper_stop_when_due(lua_State *L, struct script_paper *paper)
{
    paper_sheet_stop_when(paper->sheet, due, paper);
    script_paper_show(L, paper);
}

/* ---- papers that are open ---- */

/* Called while the past is computed again. */
static bool watch(void *context, long done, long total)
{
    struct script_paper *paper = context;
    struct script *script = paper->script;
    if (paper->replay_began_s == 0 && total > 0)
        paper->replay_began_s = script_clock_s();
    if (paper->replay_began_s > 0) {
        script_progress_tell(
            script, &(struct script_progress){true, done, total, paper->replay_began_s});
        if (done >= total) {
            script_progress_tell(script, NULL);
            paper->replay_began_s = 0;
        }
    }
    return !script_due(script);
}

void script_paper_keep(struct script_paper *paper)
{
    struct script *script = paper->script;
    struct script_paper *before = script->last_paper;
    while (before && before->number > paper->number)
        before = before->before;
    script->papers_open++;
    paper->before = before;
    paper->next = before ? before->next : script->first_paper;
    *(before ? &before->next : &script->first_paper) = paper;
    *(paper->next ? &paper->next->before : &script->last_paper) = paper;
    paper_history_set_watch(paper->sheet, watch, paper);
}

void script_paper_forget(struct script_paper *paper)
{
    struct script *script = paper->script;
    if (!paper->before && script->first_paper != paper)
        return;
    script->papers_open--;
    *(paper->before ? &paper->before->next : &script->first_paper) = paper->next;
    *(paper->next ? &paper->next->before : &script->last_paper) = paper->before;
    paper->before = paper->next = NULL;
}

enum paper_status script_paper_resumed(struct script_paper *paper,
                                       const struct paper_sheet_config *config,
                                       double budget_bytes, bool *found)
{
    struct paper_state *state = paper->script->config->resumed;
    *found = false;
    for (int i = 0; state && i < paper_state_count(state); i++) {
        struct paper_sheet_config saved;
        if (paper_state_number(state, i) != paper->number)
            continue;
        paper_state_limit(state, script_memory_left(paper->script));
        enum paper_status status = paper_state_describe(state, i, &saved);
        if (status != PAPER_OK)
            return status;
        if (!paper_sheet_config_same(&saved, config)) {
            char text[80];
            snprintf(text, sizeof text,
                     "paper %d is not the one that was saved; it begins anew", paper->number);
            script_note_tell(paper->script, text);
            return PAPER_OK;
        }
        *found = true;
        return paper_state_load(state, i, true, budget_bytes, &paper->sheet);
    }
    return PAPER_OK;
}

/* ---- substances ---- */

/* The sheet's pigment of that name; -1: it has none. */
static int pigment_number(const struct paper_sheet_config *config, const char *name)
{
    for (int i = 0; i < config->pigments_count; i++)
        if (strcmp(config->pigments[i].name, name) == 0)
            return i;
    const struct paper_pigment *paint = paper_pigment_find(name); /* a shorter name of one */
    for (int i = 0; paint && i < config->pigments_count; i++)
        if (strcmp(config->pigments[i].name, paint->name) == 0)
            return i;
    return -1;
}

/* Pushes the names of the sheet's pigments, behind `first` unless that is NULL. */
static void pigments_push(lua_State *L, const struct paper_sheet_config *config,
                          const char *first)
{
    const char *names[1 + PAPER_PIGMENTS_MAX + 1] = {first};
    for (int i = 0; i < config->pigments_count; i++)
        names[(first != NULL) + i] = config->pigments[i].name;
    script_names_push(L, names);
}

int script_paper_pigment_number_of(lua_State *L, const struct paper_sheet *sheet,
                                   const char *name)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    int number = pigment_number(config, name);
    if (number >= 0)
        return number;
    if (!config->pigments_count)
        return luaL_error(L,
                          "this paper has no pigment '%s', and no other: its pigments are "
                          "named where it is made",
                          name);
    pigments_push(L, config, NULL);
    return luaL_error(L, "this paper has no pigment '%s'; it has %s", name,
                      lua_tostring(L, -1));
}

/* {water = 0.5, ["phthalo green"] = 0.2}: reads amounts in the order of the sheet's
 * substances. */
void script_paper_amounts(lua_State *L, int index, const struct paper_sheet *sheet,
                          double *amount)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    luaL_checktype(L, index, LUA_TTABLE);
    memset(amount, 0, sizeof(double) * (1 + PAPER_PIGMENTS_MAX));
    lua_pushnil(L);
    while (lua_next(L, index)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            luaL_error(L, "amounts are written name = number, ink[\"phthalo green\"] = 0.5");
        const char *name = lua_tostring(L, -2);
        int i = strcmp(name, "water") == 0 ? 0 : 1 + pigment_number(config, name);
        if (i == 0 && strcmp(name, "water") != 0) {
            pigments_push(L, config, "water");
            luaL_error(L, "this paper has no pigment '%s'; it takes %s", name,
                       lua_tostring(L, -1));
        }
        lua_pushvalue(L, -1);
        amount[i] = script_arg_at(L, -1, name, -4, 4);
        lua_pop(L, 2);
    }
}
