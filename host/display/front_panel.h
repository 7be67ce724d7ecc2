/* front_panel.h - a picture of the Connection Machine: a black cube made of cubes, and behind
 * its dark doors 4096 red lights.
 *
 *     struct front_panel_config config = front_panel_config_default();
 *     struct front_panel *panel;
 *     struct display_image image = {0};
 *     if (front_panel_create(&config, &panel) != DISPLAY_OK ||
 *         front_panel_draw(panel, lights, &image) != DISPLAY_OK)
 *         die(display_error());
 *     display_png_write("cube.png", &image);
 *     display_image_destroy(&image);
 *     front_panel_destroy(panel);
 *
 * Making a panel computes all that does not depend on the lights (a second for 1920x1080); a
 * picture then takes some hundredths of a second. Threads. One panel, one thread. */
#ifndef LUTETIA_FRONT_PANEL_H
#define LUTETIA_FRONT_PANEL_H

#include "display.h"

enum {
    FRONT_PANEL_LIGHTS = 4096,
    FRONT_PANEL_BYTES = FRONT_PANEL_LIGHTS / 8,
    FRONT_PANEL_COLUMNS = 64,
    FRONT_PANEL_SIDE_MIN = 64,
    FRONT_PANEL_SIDE_MAX = 8192
};

enum front_panel_view {
    FRONT_PANEL_CUBE,  /* the cube on a polished floor */
    FRONT_PANEL_FRONT, /* its four doors, straight on */
    FRONT_PANEL_DOOR   /* the first door: the first 32 lights of the first 32 rows */
};

struct front_panel_config {
    int width_px, height_px; /* FRONT_PANEL_SIDE_MIN..MAX */
    enum front_panel_view view;
    double brightness; /* of the lights, 0..10; 1 */
};
struct front_panel_config front_panel_config_default(void); /* the cube, 960x960 */

struct front_panel;

/* Errors: BAD_ARGUMENT, NO_MEMORY; *out is then NULL. Owns: the caller destroys *out. */
enum display_status front_panel_create(const struct front_panel_config *config,
                                       struct front_panel **out);
void front_panel_destroy(struct front_panel *panel); /* NULL is fine */

/* Where a light is on the front: column and row from the top left, 0..63; light l is in row l
 * div 64 and column l mod 64. Each door shows 32 rows of 32: two sub-cubes, the one in front
 * and the one behind it, of sixteen boards each; a board is a column of lights. */
void front_panel_place(int light, int *column, int *row);

/* Draws the lights: light l is bit l mod 8 of byte l div 8. An image without pixels is created,
 * and the caller destroys it; otherwise its size must be the panel's, with three channels.
 * Errors: BAD_ARGUMENT, NO_MEMORY. */
enum display_status front_panel_draw(struct front_panel *panel,
                                     const uint8_t lights[FRONT_PANEL_BYTES],
                                     struct display_image *image);

/* The pixel in which a light's centre is; 0 if it is outside the picture. */
int front_panel_light_at(const struct front_panel *panel, int light, int *x_px, int *y_px);

#endif
