/* lua_run.h - `lutetia run`: what the files of the script library share.
 *
 * A script is one Lua state. Its sheets and masks are userdata that free themselves; all memory is counted, and
 * whatever takes long looks at the clock and at Ctrl-C. */
#ifndef LUTETIA_LUA_RUN_H
#define LUTETIA_LUA_RUN_H

#include "film.h"
#include "lutetia.h"

#include <paper.h>
#include <sheet.h>
#include <state.h>

#include <lauxlib.h>
#include <lua.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RUN_WORDS_MAX = 64, RUN_PAPERS_MAX = PAPER_STATE_SHEETS_MAX };

struct run {
    const char *script;     /* as it was named */
    const char *in_folder;  /* pictures to read */
    const char *out_folder; /* pictures to write */
    bool trusted;           /* no sandbox */
    bool quiet;
    double deadline_s; /* by clock_s(); 0: none */
    double timeout_s;
    size_t memory_bytes, memory_most_bytes;
    bool memory_short; /* Lua was refused some */
    uint64_t seed;
    const char *words[RUN_WORDS_MAX]; /* key=value */
    bool asked[RUN_WORDS_MAX];
    int words_count;
    bool words_checked;
    int pictures;
    int papers_made;
    struct paper_state_sheet kept[RUN_PAPERS_MAX]; /* papers that are open, by number */
    int kept_count;
    struct paper_state *resumed; /* --resume; NULL: none */
    const char *save;            /* --save; NULL: none */
    struct film film;
    long steps_done, steps_expected; /* by the script; expected 0: it did not say */
    double began_s;
    int report_to; /* where steps are reported to, of a run among others; 0: nowhere */
};

/* The run of a state. */
struct run *run_of(lua_State *L);

/* Time is up, or Ctrl-C was pressed. */
bool run_due(const struct run *run);
/* A progress line of the run; not shown where it is quiet. */
struct progress run_progress_begin(const struct run *run, const char *what, long total);
/* Tells whoever runs this run among others (run_sweep.c). */
void run_report(struct run *run, long done, long total);
/* Raises an error when time is up or Ctrl-C was pressed. */
void run_check(lua_State *L);
/* Counts memory that is not Lua's; raises an error, having counted nothing, where there is not enough. */
void run_memory_take(lua_State *L, double bytes, const char *what);
void run_memory_give(struct run *run, double bytes);

/* While the paper is at work, which looks at the clock between its steps, --timeout's end waits longer: kernels may have to be
 * compiled. */
void run_at_work(bool at_work);
/* Before the first step: a key=value that the script's text has nowhere is an error now, not when all is done. */
void run_words_check(lua_State *L);

/* Resolves a file's name within a folder and pushes its path; raises an error for names that lead out of it. */
const char *run_path(lua_State *L, const char *folder, const char *name, const char *what);

/* ---- arguments ---- */

/* Field `name` of the table at index, a finite number within low..high; missing is fallback. `what` says whose. */
double arg_number(lua_State *L, int index, const char *what, const char *name, double fallback,
                  double low, double high);
int arg_integer(lua_State *L, int index, const char *what, const char *name, int fallback,
                double low, double high);
bool arg_boolean(lua_State *L, int index, const char *what, const char *name, bool fallback);
/* NULL if missing; it is the table's. */
const char *arg_text(lua_State *L, int index, const char *what, const char *name);
/* Up to count numbers {a, b, c}, or one for all; false if missing. */
bool arg_numbers(lua_State *L, int index, const char *what, const char *name, double *out,
                 int count, double low, double high);
/* "#rrggbb" or {r, g, b} in 0..1; false if missing. */
bool arg_color(lua_State *L, int index, const char *what, const char *name, double out[3]);
/* The row of a NULL-ended list that the text is, or an error that lists them. */
int arg_choice(lua_State *L, const char *what, const char *text, const char *const *names);
/* The last argument, a table; an empty one in its place where it is not there. */
void arg_table(lua_State *L, int index);
/* Every key must be among the names (NULL-terminated). */
void arg_keys(lua_State *L, int index, const char *what, const char *const *names);
/* The whole number at an argument's index within bounds; missing is fallback. */
long arg_count(lua_State *L, int index, const char *what, long fallback, long low, long high);
/* The number at an argument's index within bounds. */
double arg_at(lua_State *L, int index, const char *what, double low, double high);

/* ---- masks ---- */

struct run_mask;
/* The mask at an argument, as a screen within width x height; empty: false. The screen is the state's: it is kept on the stack. */
bool mask_screen(lua_State *L, int index, int width, int height, struct paper_screen *screen,
                 int *x, int *y);
/* Pushes what Lua's text() makes of the text at an argument and the table behind it: a mask, a length and a height. */
int mask_text_push(lua_State *L, int index);
/* Pushes a mask of gray values; takes them over by copying. */
void mask_push(lua_State *L, const uint8_t *gray, int width, int height, int x, int y);

/* ---- papers, for what is put on them ---- */

/* The sheet of the paper at index; raises an error where there is none, or it is closed. */
struct paper_sheet *paper_arg(lua_State *L, int index);
void paper_check(lua_State *L, enum paper_status status);
/* {water = 0.5, ["phthalo green"] = 0.2}: amount has 1 + PAPER_PIGMENTS_MAX numbers, in the order of the sheet's substances. */
void paper_amounts(lua_State *L, int index, const struct paper_sheet *sheet, double *amount);
int paper_pigment_number_of(lua_State *L, const struct paper_sheet *sheet, const char *name);
/* Memory that is the paper's until it is closed. */
void paper_memory_take(lua_State *L, int index, double bytes, const char *what);
/* For paper_sheet_stop_when(), with the paper at index: films steps, and stops when time is up. */
void paper_stop_when_due(lua_State *L, int index);
extern const luaL_Reg lua_brush_methods[], lua_technique_methods[], lua_time_methods[],
    lua_look_methods[];
/* Makes the metatable of a kind of userdata; methods and gc may be NULL. */
void run_type_open(lua_State *L, const char *name, const luaL_Reg *methods, lua_CFunction gc);

void lua_mask_open(lua_State *L);
void lua_paper_open(lua_State *L);
void lua_brush_open(lua_State *L);
void lua_technique_open(lua_State *L);
void lua_time_open(lua_State *L);

/* Takes away what reaches out of the script, seeds math.random, and makes pairs() go in order. */
void lua_sandbox_open(lua_State *L);

#endif
