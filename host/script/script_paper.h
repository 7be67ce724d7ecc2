/* script_paper.h - a script's paper, shared by the files of its methods. */
#ifndef LUTETIA_SCRIPT_PAPER_H
#define LUTETIA_SCRIPT_PAPER_H

#include "script_internal.h"

struct script_paper {
    struct script *script;
    struct paper_sheet *sheet; /* NULL: closed */
    int number;                /* the paper's number in the script, from 1 */
    int pins;                  /* number of calls that use it; it cannot be closed meanwhile */
    bool brushes_counted;
    double bytes;
    double history_bytes;               /* the history's part of these bytes */
    double replay_began_s;              /* when computing the past again began; 0: not under
                                         * way */
    struct script_paper *before, *next; /* list of open papers */
};

/* Pushes a paper without a sheet. */
struct script_paper *script_paper_new(lua_State *L);
/* Counts the memory of a sheet of that size; raises an error, before allocating, if there is
 * not enough. */
void script_paper_room_take(lua_State *L, struct script_paper *paper, double width,
                            double height, int pigments);

/* Adds the paper, which has a sheet now, to the list of open papers; removes it. */
void script_paper_keep(struct script_paper *paper);
void script_paper_forget(struct script_paper *paper);
/* The saved sheet that this paper resumes, if it is as the script describes it now; *found
 * false: none. */
enum paper_status script_paper_resumed(struct script_paper *paper,
                                       const struct paper_sheet_config *config,
                                       double budget_bytes, bool *found);

/* Shows the paper to the host. Returns why the host wants the script to stop, or NULL; the
 * second function raises that as an error. */
const char *script_paper_shown(struct script_paper *paper);
void script_paper_show(lua_State *L, struct script_paper *paper);

/* For paper_sheet_stop_when(): shows the paper after each step, and stops when time is up. */
void script_paper_stop_when_due(lua_State *L, struct script_paper *paper);

/* paper:at(time, function) */
int script_paper_at_time(lua_State *L);
/* Words for enum paper_show; NULL ends them (paper_look.c). */
extern const char *const script_shows[];

#endif
