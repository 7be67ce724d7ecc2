/* script_internal.h - shared by the files of the script library.
 *
 * Papers, masks, pictures and brushes are userdata, freed by Lua's garbage collector; their
 * memory is counted with Lua's.
 */
#ifndef LUTETIA_SCRIPT_INTERNAL_H
#define LUTETIA_SCRIPT_INTERNAL_H

#include "script.h"

#include <paper.h>
#include <techniques.h>

#include <lauxlib.h>
#include <lua.h>
#include <members.h>
#include <patience.h>

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

/* The largest coordinate of a place that a script can name, in fibers. */
enum { SCRIPT_PLACE_MAX = 100000 };

struct script_paper;

/* Ends the process of a script that cannot be stopped otherwise (watchdog.c). */
struct script_watchdog {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool running, over, paused; /* under the lock */
    double grace_from_s;        /* under the lock: the grace period begins at this time at
                                 * the earliest */
    atomic_bool at_work;
    atomic_bool
        overfull; /* the process takes more than the script may; looked at by the script */
};

struct script {
    const struct script_config *config;
    const struct script_host *host;
    double began_s;         /* by script_clock_s() */
    double deadline_s;      /* by `clock`; 0: none */
    clockid_t clock;        /* CLOCK_MONOTONIC; of an answer: what its thread has computed */
    lua_State *main;        /* its first thread; NULL: not opened yet */
    size_t memory_bytes;    /* taken */
    bool memory_short;      /* an allocation of Lua's was refused */
    struct patience before; /* of the thread, before the script (limits.c) */
    /* it is asked again and again, and each answer has its own time (script_map.h,
     * script_live.h) */
    bool answers;
    bool guest;              /* a small part of its process, whose memory tells nothing of it */
    const char *stack_begin; /* where the C stack was when the script began; NULL: not known */
    lua_Integer objects_numbered;
    bool over; /* only finalizers run, which can no longer call the library */
    bool asked[SCRIPT_WORDS_MAX], words_checked;
    int papers_made;
    bool driver_works; /* OpenCL's driver is in the process, with its memory */
    uint64_t seeds;    /* counter of the seeds of random
                                                    * operations */
    struct script_paper *first_paper, *last_paper; /* open papers, by number */
    int papers_open;
    unsigned notes_told;             /* a bit for each enum script_once */
    long steps_done, steps_expected; /* of the whole script; expected 0: not given */
    struct script_watchdog watchdog;
};

/* The script of a state. */
struct script *script_of(lua_State *L);
double script_clock_s(void); /* CLOCK_MONOTONIC */

/* ---- limits ---- */

/* Whether time is up, or the host wants the script to stop. */
bool script_due(const struct script *script);
/* It is late once its clock has gone on by these seconds. */
void script_deadline_set(struct script *script, double seconds);
/* Libraries that the script calls ask the script's limits from here on (patience.h), until the
 * end. */
void script_patience_begin(struct script *script);
void script_patience_end(struct script *script);
/* Raises the error of a library that has failed, or what made it give up. */
int script_fail(lua_State *L, const char *text);
/* If it is due, or the process takes too much memory, raises an error, located at level 0, the
 * function that runs, or 1, its caller. */
void script_stop_if_due(lua_State *L, int level);
void script_check(lua_State *L); /* level 1 */
/* The same for a loop's row of that number: a row takes about as long as a look, so it is done
 * for each thirty-second one. */
void script_check_row(lua_State *L, int row);
/* Counts memory that is not Lua's. If there is not enough, raises an error and counts
 * nothing. */
void script_memory_take(lua_State *L, double bytes, const char *what);
void script_memory_give(struct script *script, double bytes);
/* Before OpenCL's device is used: the first time there must be room for its driver, which is
 * not counted. Else raises an error, which says why it is used: "papers need a machine". */
void script_memory_machine(lua_State *L, const char *why);
/* Counts memory for a while: pushes what gives it back when it is released, or collected after
 * an error. */
void script_memory_hold(lua_State *L, double bytes, const char *what);
void script_memory_release(lua_State *L, int index);
void script_limits_open(lua_State *L);
/* What says how much memory it may take, in messages. */
const char *script_memory_limit(const struct script *script);
/* The memory that may still be allocated. */
double script_memory_left(const struct script *script);

/* What the process takes besides what is counted: the program, C's libraries, what is freed and
 * not given back. Papers need the machine, OpenCL's driver and its compiler, some 90 to 160 MB:
 * they are of the script's memory, as far as they have no room here. */
#define SCRIPT_BESIDES_BYTES ((double)(40 << 20))
#define SCRIPT_MACHINE_BYTES 80e6 /* as it begins */
/* How much more than that and the script's memory the process takes; negative: it takes less,
 * or it does not tell. */
double script_overfull_bytes(const struct script *script);

/* Starts the watchdog: if the script goes on for some seconds after it should have stopped,
 * the host's overdue() is called. Does nothing if the host has no such function. False: no
 * thread could be made. */
bool script_watchdog_start(struct script *script);
void script_watchdog_end(struct script *script);
/* Pauses the watchdog while the host works; the grace period then begins anew. */
void script_watchdog_pause(struct script *script, bool paused);
/* Tells the watchdog that papers are at work. They check the time between their steps, but
 * kernels may have to be compiled, so it waits longer. */
void script_at_work(struct script *script, bool at_work);

/* Lua's allocator, whose context is the script; the handler of errors that are no text; and
 * what the host is told of an error that is on the top, once a call has failed with that
 * status. */
void *script_allocate(void *context, void *block, size_t old, size_t new);
int script_message(lua_State *L);
void script_failure_tell(lua_State *L, int status);
/* Looks at the clock every thousand instructions from here on. */
void script_hook_set(lua_State *L);

/* answers.c: a state of Lua's for a script that answers, and its watchdog, which is paused but
 * in calls. NULL: there is no memory for it, or no thread. Owns: script_answers_close(). */
lua_State *script_answers_open(struct script *script);
/* Calls the function with the argument as its light userdata; it has so many seconds of the
 * script's clock. What is on the stack is popped. False: it has failed, and the host was
 * told. */
bool script_answers_call(lua_State *L, lua_CFunction function, void *argument, double seconds);
void script_answers_close(struct script *script, lua_State *L); /* NULL: nothing */

/* ---- what the host is told ---- */

bool script_interrupted(const struct script *script);
void script_error_tell(const struct script *script, const char *text);
void script_note_tell(const struct script *script, const char *text);
/* The same, with the script's line. */
void script_note_where(lua_State *L, const char *text);
/* What is said once in a script, the first time that it happens: it is no error, and seldom
 * meant. */
enum script_once { SCRIPT_OFF_PAPER, SCRIPT_NOT_DIPPED, SCRIPT_DIPPED_IN_NOTHING };
void script_note_once(lua_State *L, enum script_once what, const char *text);
/* A file of that path has been written. */
void script_wrote_tell(const struct script *script, const char *path);
/* NULL: the work is over. */
void script_progress_tell(const struct script *script, const struct script_progress *progress);

/* Pushes the script as a function, or an error message; returns lua_load()'s status. */
int script_load(lua_State *L, const char *path);
/* Before the first step: raises an error for a key=value whose key is nowhere in the
 * script's text. */
void script_words_check(lua_State *L);

/* Resolves a file's name within a folder and pushes its path; raises an error for names that
 * lead out of it. */
const char *script_path(lua_State *L, const char *folder, const char *name, const char *what);

/* A font's name; or with the path of a folder with edits of one, in the folder that is read, as
 * font_edits_open() takes it. Raises an error for names of files. what: "text font". Owns: the
 * script, as long as it runs, or as `name`. */
const char *script_font(lua_State *L, const char *name, const char *what);
/* After a font was opened: a note if it has changed since its edits were made; once of each. */
void script_edits_tell(lua_State *L);
/* A note of each character that no font has, once of each. */
void script_missing_tell(lua_State *L, const char *font, const uint32_t *missing, int count);

/* The same for a file to write, in the output folder: with this ending, not hidden, and not
 * like an option. */
const char *script_path_to_write(lua_State *L, const char *name, const char *ending,
                                 const char *what);

/* ---- arguments ---- */

/* Reads field `name` of the table at index, a finite number within low..high; default:
 * fallback. `what` names the table in messages. */
double script_arg_number(lua_State *L, int index, const char *what, const char *name,
                         double fallback, double low, double high);
int script_arg_integer(lua_State *L, int index, const char *what, const char *name,
                       int fallback, double low, double high);
bool script_arg_boolean(lua_State *L, int index, const char *what, const char *name,
                        bool fallback);
/* NULL if missing; the text belongs to the table. */
const char *script_arg_text(lua_State *L, int index, const char *what, const char *name);
/* Reads up to count numbers {a, b, c}, or one for all; false if missing. */
bool script_arg_numbers(lua_State *L, int index, const char *what, const char *name,
                        double *out, int count, double low, double high);
/* Reads "#rrggbb" or {r, g, b} in 0..1; false if missing. */
bool script_arg_color(lua_State *L, int index, const char *what, const char *name,
                      double out[3]);
/* Pushes the names of a NULL-ended list as one text, with commas between them. */
void script_names_push(lua_State *L, const char *const *names);
/* Finds the text in a NULL-ended list; raises an error that lists the choices. */
int script_arg_choice(lua_State *L, const char *what, const char *text,
                      const char *const *names);
/* Replaces the table at an argument's index by a private copy, made without metamethods; a
 * missing table becomes an empty one. Every key must be among the names (NULL-terminated).
 * The functions above are for such copies: their content cannot change, and a text lasts as
 * long as the copy is on the stack. */
void script_arg_options(lua_State *L, int index, const char *what, const char *const *names);
/* The same with keys described by rows, and additional names (NULL-terminated; NULL: none). */
void script_fields_options(lua_State *L, int index, const char *what,
                           const struct members *members, const char *const *besides);
/* Reads the rows' fields of such a copy into the struct, each within its row's range;
 * missing fields are unchanged. */
void script_fields_read(lua_State *L, int index, const char *what,
                        const struct members *members, void *of);
/* Reads the number at an argument's index, within the range of the row of that name; default:
 * fallback, or none where that is NaN. */
double script_member_at(lua_State *L, int index, const char *what,
                        const struct members *members, const char *name, double fallback);
/* Reads the integer at an argument's index, within bounds; default: fallback. */
long script_arg_count(lua_State *L, int index, const char *what, long fallback, long low,
                      long high);
/* Reads the number, from 1, of one of `count` things, and returns it from 0; raises an error
 * if it is missing. */
int script_arg_index(lua_State *L, int index, const char *what, int count);
/* Reads the number at an argument's index, within bounds. */
double script_arg_at(lua_State *L, int index, const char *what, double low, double high);

/* ---- masks ---- */

struct script_mask;
/* Gets the mask at an argument as a screen within width x height; false if it is empty
 * there. The screen belongs to the state and stays on the stack. */
bool script_mask_screen(lua_State *L, int index, int width, int height,
                        struct paper_screen *screen, int *x, int *y);
/* The same, and a mask that lies off the paper is not noted. */
bool script_mask_screen_quietly(lua_State *L, int index, int width, int height,
                                struct paper_screen *screen, int *x, int *y);
/* Gets the mask in the field "mask" of the options at index, kept on the stack; if missing:
 * everywhere. False: it covers nothing. */
bool script_mask_place(lua_State *L, int index, const struct paper_sheet *sheet,
                       struct paper_screen *screen, struct paper_place *place);
/* Calls Lua's text() with the text at an argument and the table behind it; pushes a mask, a
 * length and a height. */
int script_mask_text_push(lua_State *L, int index);
/* Puts a table behind the text at an argument, by which text() fills width x height, but for a
 * margin, well. */
void script_mask_text_fit(lua_State *L, int index, int width, int height, double margin);
/* Pushes a mask with a copy of the gray values. */
void script_mask_push(lua_State *L, const uint8_t *gray, int width, int height, int x, int y);

/* ---- pictures ---- */

/* The pixels of the picture at an index, red, green, blue, rows without gaps; NULL: it is no
 * picture. Owns: the state. */
const uint8_t *script_picture_pixels(lua_State *L, int index, int *width, int *height);

/* ---- calls ---- */

/* Adds the functions of a list to the table on the top. */
void script_functions_set(lua_State *L, const luaL_Reg *rows);
/* Calls a function of the script, as lua_call() and lua_pcall() do. */
void script_callback(lua_State *L, int arguments, int results);
int script_callback_protected(lua_State *L, int arguments);
/* Sets the number of arguments to `count`, and pins the paper that is the first: it cannot
 * be closed until the function returns or fails. The pin is on the stack at count + 1.
 * Raises an error if the paper is closed. */
struct script_paper *script_paper_begin(lua_State *L, int count);
/* Pins the paper at an index; pushes the pin. */
struct script_paper *script_paper_pin(lua_State *L, int index);
/* Pushes a userdata that frees memory of C's. */
void **script_box_new(lua_State *L);

/* ---- papers, for what is put on them ---- */

void script_paper_check(lua_State *L, enum paper_status status);
/* Reads {water = 0.5, ["phthalo green"] = 0.2}: amount has 1 + PAPER_PIGMENTS_MAX numbers,
 * in the order of the sheet's substances. */
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
/* Hides the metatable on the top, and the functions in it, from scripts. */
void script_metatable_hide(lua_State *L);
/* Raises an error that names the methods in the table on the top. */
void script_method_unknown(lua_State *L, const char *type, const char *name);
/* Makes the metatables of the library's types, without their methods. */
void script_call_open(lua_State *L);
void script_mask_open(lua_State *L);
void script_paper_open(lua_State *L);
void script_paper_time_open(lua_State *L);
void script_brush_open(lua_State *L);
void script_stroke_open(lua_State *L);
void script_picture_open(lua_State *L);
void script_springs_open(lua_State *L);
void script_springs_machine_open(lua_State *L);
void script_song_open(lua_State *L);
void script_typeface_open(lua_State *L);

extern const char script_mask_type[], script_papers_type[], script_paper_type[],
    script_brush_type[], script_picture_type[], script_spring_type[], script_network_type[];

/* The tables of functions of each file. */
extern const luaL_Reg script_sandbox_functions[], script_song_functions[], script_mask_makers[],
    script_page_makers[], script_typeface_makers[], script_mask_methods[],
    script_mask_operators[], script_papers_operators[], script_papers_functions[],
    script_paper_methods[], script_paper_look_methods[], script_paper_time_methods[],
    script_paper_time_functions[], script_brush_paper_methods[], script_brush_methods[],
    script_stroke_methods[], script_stroke_functions[], script_technique_methods[],
    script_picture_paper_methods[], script_picture_functions[], script_picture_methods[],
    script_spring_makers[], script_spring_word_makers[], script_network_methods[],
    script_network_word_methods[], script_network_key_methods[],
    script_network_machine_methods[];

/* All functions that a script can call (open.c). Ended by a row without functions. */
struct script_functions {
    const char *of; /* the type's name; NULL: global functions */
    const luaL_Reg *functions;
    bool operators; /* functions of the metatable itself */
};
extern const struct script_functions script_functions[];

/* Opens the whole library, in the sandbox unless the script is trusted. */
int script_open(lua_State *L);
/* Replaces functions of Lua's own library by some that are safe for untrusted scripts
 * (lua_functions.c). */
void script_lua_functions_open(lua_State *L);
/* Pushes the value at an index as a text, as tostring() does. An object has a number there, not
 * its address. */
void script_text_push(lua_State *L, int index);
/* Removes what reaches outside of the script, seeds math.random, and makes pairs() ordered. */
void script_sandbox_open(lua_State *L);

#endif
