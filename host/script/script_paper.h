/* script_paper.h - a script's paper: what the files of its methods share. */
#ifndef LUTETIA_SCRIPT_PAPER_H
#define LUTETIA_SCRIPT_PAPER_H

#include "script_internal.h"

struct script_paper {
    struct script *script;
    struct paper_sheet *sheet; /* NULL: closed */
    int number;                /* which of the script's papers, from 1 */
    int pins;                  /* calls that use it: it cannot be closed */
    bool brushes_counted;
    double bytes;
    double history_bytes;               /* of these, what its past takes */
    double replay_began_s;              /* what is computed again; 0: nothing is */
    struct script_paper *before, *next; /* of those that are open */
};

/* Pushes one without a sheet. */
struct script_paper *script_paper_new(lua_State *L);
/* Counts what a sheet of that size takes; raises an error, before it is tried, where there is not so much. */
void script_paper_room_take(lua_State *L, struct script_paper *paper, double width,
                            double height, int pigments);

/* Enters the paper, which has a sheet now, among those that are open, and takes it out again. */
void script_paper_keep(struct script_paper *paper);
void script_paper_forget(struct script_paper *paper);
/* The saved sheet that the paper is; *found false: there is none. */
enum paper_status script_paper_resumed(struct script_paper *paper,
                                       const struct paper_sheet_config *config,
                                       double budget_bytes, bool *found);

/* Shows the host the paper. Why the host wants the script to stop, or NULL; the second one raises that as an error. */
const char *script_paper_shown(struct script_paper *paper);
void script_paper_show(lua_State *L, struct script_paper *paper);

/* For paper_sheet_stop_when(): shows the paper's steps, and stops when time is up. */
void script_paper_stop_when_due(lua_State *L, struct script_paper *paper);

/* paper:at(time, function) */
int script_paper_at_time(lua_State *L);
#endif
