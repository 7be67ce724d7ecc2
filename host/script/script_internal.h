/* script_internal.h - what the files of the script library share.
 *
 * Papers, masks, pictures and brushes are userdata that free themselves; what they take is counted with Lua's memory. */
#ifndef LUTETIA_SCRIPT_INTERNAL_H
#define LUTETIA_SCRIPT_INTERNAL_H

#include "script.h"

#include <paper.h>
#include <techniques.h>

#include <lauxlib.h>
#include <lua.h>
#include <members.h>

#include <pthread.h>
#include <stdatomic.h>

/* How far from the origin a script can name a place, in fibers. */
enum { SCRIPT_PLACE_MAX = 100000 };

struct script_paper;

/* Ends a process whose script cannot be stopped otherwise (watchdog.c). */
struct script_watchdog {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool running, over, paused; /* under the lock */
    double grace_from_s;        /* under the lock: nobody is told before that and a little */
    atomic_bool at_work;
};

struct script {
    const struct script_config *config;
    const struct script_host *host;
    double began_s, deadline_s; /* by script_clock_s(); deadline 0: none */
    size_t memory_bytes;        /* taken */
    bool memory_short;          /* Lua was refused some */
    bool
        answers; /* it is asked again and again, and each answer has its own time (script_map.h) */
    bool over; /* only finalizers run, which can call the library no more */
    bool asked[SCRIPT_WORDS_MAX], words_checked;
    int papers_made;
    uint64_t seeds;                                /* taken by what happens by chance */
    struct script_paper *first_paper, *last_paper; /* that are open, by number */
    int papers_open;
    long steps_done, steps_expected; /* by the script; expected 0: it did not say */
    struct script_watchdog watchdog;
};

/* Whose state it is. */
struct script *script_of(lua_State *L);
double script_clock_s(void);

/* ---- limits ---- */

/* Time is up, or the host says so. */
bool script_due(const struct script *script);
/* Raises an error then, in the line of level 0, the function that runs, or 1, what called it. */
void script_stop_if_due(lua_State *L, int level);
void script_check(lua_State *L); /* level 1 */
/* Counts memory that is not Lua's; raises an error, having counted nothing, where there is not enough. */
void script_memory_take(lua_State *L, double bytes, const char *what);
void script_memory_give(struct script *script, double bytes);
/* What may still be taken. */
double script_memory_left(const struct script *script);

/* From here on the host's overdue() is called when the script goes on for some seconds after it should have stopped; nothing
 * happens where there is no such function. False: no thread for it. */
bool script_watchdog_start(struct script *script);
void script_watchdog_end(struct script *script);
/* Not while the host is at work; afterwards time is given anew. */
void script_watchdog_pause(struct script *script, bool paused);
/* While papers are at work, which look at the clock between their steps, it waits longer: kernels may have to be compiled. */
void script_at_work(struct script *script, bool at_work);

/* Lua's allocator, whose context is the script; the handler of errors that are no text; and what the host is told of an error that
 * is on the top, once a call has failed with that status. */
void *script_allocate(void *context, void *block, size_t old, size_t new);
int script_message(lua_State *L);
void script_failure_tell(lua_State *L, int status);
/* Looks at the clock every thousand instructions from here on. */
void script_hook_set(lua_State *L);

/* ---- what the host is told ---- */

bool script_interrupted(const struct script *script);
void script_error_tell(const struct script *script, const char *text);
void script_note_tell(const struct script *script, const char *text);
/* NULL: the work is over. */
void script_progress_tell(const struct script *script, const struct script_progress *progress);

/* Pushes the script as a function, or why it cannot be read or is none; returns what lua_load() would. */
int script_load(lua_State *L, const char *path);
/* Before the first step: a key=value that the script's text has nowhere is an error now, not when all is done. */
void script_words_check(lua_State *L);

/* Resolves a file's name within a folder and pushes its path; raises an error for names that lead out of it. */
const char *script_path(lua_State *L, const char *folder, const char *name, const char *what);

/* The same for a file that is written, in the script's folder for that: of this ending, not hidden, and no option to
 * other programs. */
const char *script_path_to_write(lua_State *L, const char *name, const char *ending,
                                 const char *what);

/* ---- arguments ---- */

/* Field `name` of the table at index, a finite number within low..high; missing is fallback. `what` says whose. */
double script_arg_number(lua_State *L, int index, const char *what, const char *name,
                         double fallback, double low, double high);
int script_arg_integer(lua_State *L, int index, const char *what, const char *name,
                       int fallback, double low, double high);
bool script_arg_boolean(lua_State *L, int index, const char *what, const char *name,
                        bool fallback);
/* NULL if missing; it is the table's. */
const char *script_arg_text(lua_State *L, int index, const char *what, const char *name);
/* Up to count numbers {a, b, c}, or one for all; false if missing. */
bool script_arg_numbers(lua_State *L, int index, const char *what, const char *name,
                        double *out, int count, double low, double high);
/* "#rrggbb" or {r, g, b} in 0..1; false if missing. */
bool script_arg_color(lua_State *L, int index, const char *what, const char *name,
                      double out[3]);
/* The row of a NULL-ended list that the text is, or an error that lists them. */
int script_arg_choice(lua_State *L, const char *what, const char *text,
                      const char *const *names);
/* Puts a copy that nobody else holds in the place of the table at an argument's index, made without metamethods; an empty table
 * where there is none. Every key must be among the names (NULL-terminated). The functions above are for such copies: what they
 * hold stays as it is, and a text lasts as long as the copy is on the stack. */
void script_arg_options(lua_State *L, int index, const char *what, const char *const *names);
/* The same for what rows describe: keys are the rows' fields, and the names besides (NULL-terminated; NULL: none). */
void script_fields_options(lua_State *L, int index, const char *what,
                           const struct members *members, const char *const *besides);
/* Reads the rows' fields of such a copy into the struct, each within its row's range; what is missing stays as it is. */
void script_fields_read(lua_State *L, int index, const char *what,
                        const struct members *members, void *of);
/* The whole number at an argument's index within bounds; missing is fallback. */
long script_arg_count(lua_State *L, int index, const char *what, long fallback, long low,
                      long high);
/* The number, from 1, of one of `count` things at an argument's index, as a number from 0; an error where it is missing. */
int script_arg_index(lua_State *L, int index, const char *what, int count);
/* The number at an argument's index within bounds. */
double script_arg_at(lua_State *L, int index, const char *what, double low, double high);

/* ---- masks ---- */

struct script_mask;
/* The mask at an argument, as a screen within width x height; empty: false. The screen is the state's: it is kept on the stack. */
bool script_mask_screen(lua_State *L, int index, int width, int height,
                        struct paper_screen *screen, int *x, int *y);
/* The mask in the field "mask" of options at index, kept on the stack; missing: everywhere. False: it covers nothing. */
bool script_mask_place(lua_State *L, int index, const struct paper_sheet *sheet,
                       struct paper_screen *screen, struct paper_place *place);
/* Pushes what Lua's text() makes of the text at an argument and the table behind it: a mask, a length and a height. */
int script_mask_text_push(lua_State *L, int index);
/* Pushes a mask of gray values; takes them over by copying. */
void script_mask_push(lua_State *L, const uint8_t *gray, int width, int height, int x, int y);

/* ---- calls ---- */

/* Sets the functions of a list in the table on the top. */
void script_functions_set(lua_State *L, const luaL_Reg *rows);
/* Calls a function that the script gave, as lua_call() and lua_pcall(). */
void script_callback(lua_State *L, int arguments, int results);
int script_callback_protected(lua_State *L, int arguments);
/* Cuts off or fills up the arguments to `count`, and pins the paper that is the first: it cannot be closed until the function
 * returns or fails. The pin is on the stack, at count + 1. Raises an error where the paper is closed. */
struct script_paper *script_paper_begin(lua_State *L, int count);
/* Pins the paper at an index; pushes the pin. */
struct script_paper *script_paper_pin(lua_State *L, int index);
/* Pushes a place for memory of C's that is freed with it. */
void **script_box_new(lua_State *L);

/* ---- papers, for what is put on them ---- */

void script_paper_check(lua_State *L, enum paper_status status);
/* {water = 0.5, ["phthalo green"] = 0.2}: amount has 1 + PAPER_PIGMENTS_MAX numbers, in the order of the sheet's substances. */
void script_paper_amounts(lua_State *L, int index, const struct paper_sheet *sheet,
                          double *amount);
int script_paper_pigment_number_of(lua_State *L, const struct paper_sheet *sheet,
                                   const char *name);
/* Pushes a message of an instrument's as a table. */
struct midi_message;
void script_midi_push(lua_State *L, const struct midi_message *m);

/* ---- the library ---- */

/* Makes the metatable of a kind of userdata; gc may be NULL. */
void script_type_open(lua_State *L, const char *name, lua_CFunction gc);
/* The types of the library, without their methods. */
void script_call_open(lua_State *L);
void script_mask_open(lua_State *L);
void script_paper_open(lua_State *L);
void script_paper_time_open(lua_State *L);
void script_brush_open(lua_State *L);
void script_stroke_open(lua_State *L);
void script_picture_open(lua_State *L);
void script_springs_open(lua_State *L);

extern const char script_mask_type[], script_papers_type[], script_paper_type[],
    script_brush_type[], script_picture_type[], script_spring_type[], script_network_type[];

/* The rows of each file. */
extern const luaL_Reg script_sandbox_functions[], script_song_functions[], script_mask_makers[],
    script_page_makers[], script_mask_methods[], script_mask_operators[],
    script_papers_operators[], script_papers_functions[], script_paper_methods[],
    script_paper_look_methods[], script_paper_time_methods[], script_paper_time_functions[],
    script_brush_paper_methods[], script_brush_methods[], script_stroke_methods[],
    script_stroke_functions[], script_technique_methods[], script_picture_paper_methods[],
    script_picture_functions[], script_picture_methods[], script_spring_makers[],
    script_spring_word_makers[], script_network_methods[], script_network_word_methods[],
    script_network_key_methods[];

/* All of them: what a script can call (open.c). Ended by a row without functions. */
struct script_functions {
    const char *of; /* the type; NULL: global functions */
    const luaL_Reg *functions;
    bool operators; /* of the type's metatable */
};
extern const struct script_functions script_functions[];

/* Opens the whole library; in the sandbox unless the script is trusted. */
int script_open(lua_State *L);
/* Takes away what reaches out of the script, seeds math.random, and makes pairs() go in order. */
void script_sandbox_open(lua_State *L);

#endif
