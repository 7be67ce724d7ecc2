/* script_mask.h - a script's masks, shared by the files that make and change them. */
#ifndef LUTETIA_SCRIPT_MASK_H
#define LUTETIA_SCRIPT_MASK_H

#include "script_internal.h"

#include <drawing.h>

struct script_mask {
    struct script *script;
    double *points; /* pairs; NULL: gray */
    int points_count;
    uint8_t *gray; /* NULL if empty */
    int x, y, width, height;
    uint8_t outside; /* the value everywhere else; of a polygon 0 */
    struct event_bytes
        drawn; /* what gray values were drawn from (drawing.h), for renders; none: {0} */
    struct paper_drawing drawing; /* what screens point to */
    double bytes;
};

/* Each pushes a mask: without a shape; with room for corners; with room for gray values, all
 * 0. Raise an error if memory is short. */
struct script_mask *script_mask_new(lua_State *L);
struct script_mask *script_mask_polygon_new(lua_State *L, int count);
struct script_mask *script_mask_gray_new(lua_State *L, double width, double height, double x,
                                         double y);
/* Pushes the mask at index, converted to gray values. */
struct script_mask *script_mask_grayed(lua_State *L, int index);
/* Adds what the mask is drawn from (mask_drawn.c). False: it is not known. */
bool script_mask_drawn(const struct script_mask *mask, struct event_bytes *b);
/* `made` is a and b, joined; NULL: what the mask a is drawn from is all. */
void script_mask_drawn_join(struct script_mask *made, const struct script_mask *a,
                            const struct script_mask *b, char operation);
/* `all` is joined with what the part is drawn from. False: it is not known. */
bool script_mask_drawn_part(struct script_mask *all, const struct script_mask *part,
                            bool joined);
/* Counts its memory, at most PAPER_DRAWING_MOST; if it is not known, it is forgotten. */
void script_mask_drawn_keep(struct script_mask *mask, bool known);
/* The screen knows what its mask was drawn from, as long as the mask lives. */
void script_mask_drawing_tell(struct script_mask *mask, struct paper_screen *screen);
/* The value of a gray mask, in 0..255, at a place. */
int script_mask_gray_at(const struct script_mask *mask, int x, int y);

#endif
