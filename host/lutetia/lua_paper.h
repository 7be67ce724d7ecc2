/* lua_paper.h - a script's paper: what the files of its methods share. */
#ifndef LUTETIA_LUA_PAPER_H
#define LUTETIA_LUA_PAPER_H

#include "lua_run.h"
#include "lutetia.h"

struct run_paper {
    struct run *run;
    struct paper_sheet *sheet; /* NULL: closed */
    int number;                /* which of the script's papers, from 1 */
    double bytes;
    double history_bytes; /* of these, what its past takes */
    struct progress replay;
};

/* The first argument; raises an error where it is closed. */
struct run_paper *paper_at(lua_State *L);
/* Pushes one without a sheet. */
struct run_paper *paper_new(lua_State *L);
/* Counts what a sheet of that size takes; raises an error, before it is tried, where there is not so much. */
void paper_room_take(lua_State *L, struct run_paper *paper, double width, double height,
                     int pigments);

/* Enters the paper's sheet among those that --save saves, and forgets it again. */
void paper_keep(struct run_paper *paper);
void paper_forget(struct run_paper *paper);
/* The sheet of --resume that the paper is; *found false: there is none. */
enum paper_status paper_resumed(struct run_paper *paper,
                                const struct paper_sheet_config *config, double budget_bytes,
                                bool *found);

/* paper:at(time, function) */
int paper_at_time(lua_State *L);
/* paper.load(name) */
int paper_load(lua_State *L);

#endif
