/* <cm/cmfb.h> - the frame buffer: fields as pictures on displays.
 *
 *     CMFB_display_id_t screen = CMFB_attach_display ("");
 *     CMFB_initialize_display (screen, 8, 1024, 512);
 *     for (;;) {
 *         step ();
 *         CMFB_write_news_always (screen, 0, picture, 0, 0);
 *     }
 *
 * A display has two buffers of `width` x `height` pixels of 8 or 24 bits, of which one is seen.
 * Pixel (0, 0) is at the top left. What is seen goes through the display's zoom, its pan and
 * its colour map. LUTETIA_DISPLAY says who looks on: `window`, or a file for `lutetia display
 * FILE`; `lutetia display PROG` makes a window, stills, frames or a film of a program. Where
 * nobody looks on, calls are checked, nothing is computed for them, and nothing is kept.
 *
 * Which of these names are those of 1990 and which are our own: docs/frame-buffer.md.
 *
 * Context. All calls that end in _always read their fields in all processors. Errors: a wrong
 * call has no effect and is explained to the error handler, as in <cm/paris.h>; a call that
 * returns a number returns 0 then. Ownership: displays belong to the library; ids name them
 * until they are detached. Arrays and texts that are passed stay the caller's. Threads: all
 * calls belong to the thread that makes the calls of <cm/paris.h>. */
#ifndef CM_CMFB_H
#define CM_CMFB_H

#include <cm/paris.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int CMFB_display_id_t;

#define CMFB_no_display 0
#define CMFB_displays_most 8 /* attached at the same time */
#define CMFB_side_most 8192  /* pixels along a side */
#define CMFB_colors 256      /* rows of a colour map */

/* ---- displays ---- */

/* Attaches a display; the name is its window's title ("" or NULL: the program's name). It has
 * no size until it is initialised. */
extern CMFB_display_id_t CMFB_attach_display(const char *name);
/* The display's number is free again. */
extern void CMFB_detach_display(CMFB_display_id_t display);
/* 1 if there is such a display, else 0. Never fails. */
extern int CMFB_attached(CMFB_display_id_t display);
/* Gives the display pixels of 8 or 24 bits and a size. Both buffers become 0, buffer 0 is seen,
 * zoom is 1, pan is 0, and the colour map maps each value to itself (gray, with 8 bits). May be
 * called again. */
extern void CMFB_initialize_display(CMFB_display_id_t display, unsigned int bits,
                                    unsigned int width, unsigned int height);
extern unsigned int
CMFB_display_bits(CMFB_display_id_t display); /* 0 before it is initialised */
extern unsigned int CMFB_display_width(CMFB_display_id_t display);
extern unsigned int CMFB_display_height(CMFB_display_id_t display);
/* Whether somebody looks on: a program may leave out what serves pictures only. Never fails. */
extern int CMFB_watched(void);

/* ---- pixels ---- */

/* Which axes of a VP set are the columns and the rows of its picture: the last one and the one
 * before, until this is called. Other axes of a set may not be longer than 1. */
extern void CMFB_set_axes(CMFB_display_id_t display, unsigned int x_axis, unsigned int y_axis);
/* Writes a field of the current VP set, 8 or 24 bits as the display has, to a buffer, with its
 * first row and column at (x_offset, y_offset). What reaches out of the display is left out. Of
 * 24 bits, red is bits 0 to 7, green 8 to 15, blue 16 to 23. A set of one axis is a row. */
extern void CMFB_write_news_always(CMFB_display_id_t display, unsigned int buffer,
                                   CM_field_id_t source, int x_offset, int y_offset);
/* The same of three fields of 8 bits, on a display of 24. */
extern void CMFB_write_rgb_news_always(CMFB_display_id_t display, unsigned int buffer,
                                       CM_field_id_t red, CM_field_id_t green,
                                       CM_field_id_t blue, int x_offset, int y_offset);
/* The same of a field in the frame buffer's order: the pixels, from left to right and from top
 * to bottom, are those of the processors in the order of their send addresses. */
extern void CMFB_write_always(CMFB_display_id_t display, unsigned int buffer,
                              CM_field_id_t source, int x_offset, int y_offset);
/* Brings a field of `len` bits, 1 to 64, from NEWS order into the frame buffer's, by the
 * display's axes. dest may be source. */
extern void CMFB_shuffle_from_news_always(CMFB_display_id_t display, CM_field_id_t dest,
                                          CM_field_id_t source, unsigned int len);
/* Gives all pixels of a buffer one value. */
extern void CMFB_clear(CMFB_display_id_t display, unsigned int buffer, unsigned int value);

/* ---- what is seen ---- */

/* Shows buffer 0 or 1. */
extern void CMFB_switch_buffer(CMFB_display_id_t display, unsigned int buffer);
/* Shows the other buffer. */
extern void CMFB_spin(CMFB_display_id_t display);
extern unsigned int CMFB_buffer_seen(CMFB_display_id_t display);
/* Each pixel becomes x_zoom x y_zoom, 1 to 256. */
extern void CMFB_set_zoom(CMFB_display_id_t display, unsigned int x_zoom, unsigned int y_zoom);
/* The buffer's pixel that is seen at the top left. Beyond the buffer all is black. */
extern void CMFB_set_pan(CMFB_display_id_t display, int x, int y);
/* Sets rows first to first + count - 1 of the colour map. With 8 bits a pixel's value is the
 * row of its colour; with 24 each part of a pixel is the row of its own column. */
extern void CMFB_write_color_map(CMFB_display_id_t display, unsigned int first,
                                 unsigned int count, const unsigned char *red,
                                 const unsigned char *green, const unsigned char *blue);
extern void CMFB_read_color_map(CMFB_display_id_t display, unsigned int first,
                                unsigned int count, unsigned char *red, unsigned char *green,
                                unsigned char *blue);
/* Moves these rows up by `steps` (down, if it is negative); what leaves at one end comes in at
 * the other. */
extern void CMFB_cycle_color_map(CMFB_display_id_t display, unsigned int first,
                                 unsigned int count, int steps);

#ifdef __cplusplus
}
#endif

#endif
