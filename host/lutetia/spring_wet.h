/* spring_wet.h - a film of letters over wet paper: where they were they have left ink, which
 * spreads.
 *
 * Every `every_s` the letters as they are, under their maps, are screened into a sheet of paper
 * (host/paper), a fiber a pixel; the sheet goes on while they move. A picture is the sheet with
 * the present's letters on it. */
#ifndef LUTETIA_SPRING_WET_H
#define LUTETIA_SPRING_WET_H

#include <stage.h>

#include <display.h>

struct spring_wet_def {
    const char *pigment; /* of the tracks, by its name; "french ultramarine" */
    double every_s;      /* from print to print; 0.1 */
    double water;        /* that a print brings; 0.3 */
    double ink; /* and pigment; 0.25. A place that is printed again takes less each time */
    int width, height; /* of the pictures */
    int fps;
};
struct spring_wet_def spring_wet_def_default(void);

struct spring_wet;
/* An exit status; what is wrong has been said. Owns: the caller destroys *out. */
int spring_wet_create(const struct spring_wet_def *def, struct spring_wet **out);
void spring_wet_destroy(struct spring_wet *wet); /* NULL is fine */

/* Prints if it is time, lets the sheet go on for a picture's time, and draws: the image becomes
 * the sheet with the letters on it. */
enum stage_status spring_wet_picture(struct spring_wet *wet, const struct stage_draw_list *list,
                                     struct display_image *image);

#endif
