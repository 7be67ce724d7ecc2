/* script_springs.h - a script's networks of masses and springs, shared by the files of their
 * methods. */
#ifndef LUTETIA_SCRIPT_SPRINGS_H
#define LUTETIA_SCRIPT_SPRINGS_H

#include "script_internal.h"

#include <clamps.h>
#include <paint.h>
#include <word.h>

enum { SCRIPT_WORDS_OF_NETWORK = 256, SCRIPT_FONTS_OF_NETWORK = 16 };

struct script_font {
    char name[128];
    struct font_face *face;
    struct font_shaper *shaper;
};

struct script_network {
    struct script *script;
    struct dyn_network *network;
    struct dyn_word *words[SCRIPT_WORDS_OF_NETWORK];
    struct script_font fonts[SCRIPT_FONTS_OF_NETWORK];
    struct font_painter *painter; /* NULL until first used */
    struct dyn_clamps *clamps;    /* NULL: no keys */
    int words_count, fonts_count;
    bool collide;
    double bytes, keys_bytes; /* taken; of bytes, for fonts and what draws letters: */
    double besides_bytes;
};

/* Pushes one with an empty network. */
struct script_network *script_network_new(lua_State *L);
struct script_network *script_network_at(lua_State *L, int index);
/* Reads the number of a mass at the argument, and returns it from 0. */
int script_network_mass_at(lua_State *L, const struct script_network *s, int index);
/* Raises an error with the library's message, if there is one. */
void script_dyn_check(lua_State *L, enum dyn_status status);
/* Take memory before a font is opened, and before letters are drawn. */
void script_network_font_take(lua_State *L, struct script_network *s);
void script_network_painter_take(lua_State *L, struct script_network *s);
/* Counts the memory that the network has allocated since. */
void script_network_count(lua_State *L, struct script_network *s);
/* Pops a control's value: a number, a text or a boolean. */
double script_control_pop(lua_State *L, const struct control *control);
/* Sets a control of the world, or of all words' styles. */
void script_network_set(lua_State *L, struct script_network *s, const char *name, int index);

#endif
