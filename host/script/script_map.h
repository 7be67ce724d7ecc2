/* script_map.h - a script that is kept open and answers messages of instruments: what it makes
 * of them goes to controls, by name.
 *
 *     function message(m)                                  -- each message; m.kind is
 *                                                          "note-on", "control", ...
 *       if m.kind == "control" and m.control == 1 then along("gravity", m.value) end
 *     end
 *     function frame(time) ... end                         -- before each picture; may be left
 *                                                          out
 *
 * It is in the same sandbox as scripts of papers, with none of their library: set(), along(),
 * get(), text(), beat(), send(), print() and param() are all that it reaches. An answer that
 * takes too long, or fails, is told, and the next message comes all the same.
 *
 * docs/midi.md has the reference. Threads: a map belongs to one. */
#ifndef LUTETIA_SCRIPT_MAP_H
#define LUTETIA_SCRIPT_MAP_H

#include <midi_message.h>

#include "script.h"

enum { SCRIPT_MAP_ARGUMENTS = 32 };

/* Of a message that is no instrument's: a number, or a text that is not NULL. */
struct script_map_argument {
    const char *text;
    double number;
};

struct script_map_def {
    const char *path;
    const char *const *words; /* key=value, for param() */
    int words_count;
    /* What the script does. Each returns NULL, or why it cannot be: the host's text, that lasts
     * until the next call. */
    const char *(*set)(void *context, const char *name, const char *value);
    const char *(*along)(void *context, const char *name,
                         double along); /* 0..1: as a slider that is so far along its way */
    const char *(*get)(void *context, const char *name, double *value);
    bool (*beat)(void *context, double *phase,
                 double *per_minute); /* false, or NULL: no clock */
    /* A message of the script's own, to whoever listens; NULL: nobody does. */
    const char *(*send)(void *context, const char *address,
                        const struct script_map_argument *arguments, int count);
    const char *(*text)(void *context, const char *words); /* NULL: there are none to change */
    void (*tell)(void *context, const char *text); /* a line: what it prints, and errors */
    void (*overdue)(void *context);                /* as script_host's; may be NULL */
    void *context;
};

struct script_map;
/* Reads and runs the file, which must leave a function `message` or `frame`. Errors: FAILED,
 * which has been told. */
enum script_status script_map_open(const struct script_map_def *def, struct script_map **out);
void script_map_close(struct script_map *map); /* NULL is fine */

/* False: the script failed, which has been told. */
bool script_map_message(struct script_map *map, const struct midi_message *m);
/* It leads by time alone: it has a function `frame`. */
bool script_map_leads(const struct script_map *map);
/* Whether it has message(m): else nobody need play for it. */
bool script_map_hears(const struct script_map *map);
/* A message with an address, for the script's function osc(address, ...), where it has one.
 * False: it failed, which has been told, or has none. */
bool script_map_hears_osc(const struct script_map *map);
bool script_map_osc(struct script_map *map, const char *address,
                    const struct script_map_argument *arguments, int count);
bool script_map_frame(struct script_map *map, double time_s);

#endif
