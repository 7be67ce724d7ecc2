/* front_panel_scene.h - the cube in its dark room, without its lights: the camera, and what
 * each pixel sees. Lengths are in half edges of the cube, which is [-1,1]^3; x right, y up,
 * z from the front towards the viewer. */
#ifndef LUTETIA_FRONT_PANEL_SCENE_H
#define LUTETIA_FRONT_PANEL_SCENE_H

#include "front_panel.h"

struct vec {
    float x, y, z;
};

/* Looks from eye along forward; a point at distance d along it is scale/d pixels for a length
 * of 1. */
struct scene_camera {
    struct vec eye, forward, right, up;
    float scale, centre_x, centre_y;
};

#define SCENE_FLOOR (-1.10f)
#define SCENE_LIGHTS_Z 0.975f /* the lights are behind the doors */
enum { SCENE_GLOWS = 4 };     /* doors that light the floor */

struct scene_pixel {
    float rgb[3];            /* linear */
    float mirror;            /* how much of a mirrored light is visible here, on the floor */
    float glow[SCENE_GLOWS]; /* the light that a door adds when all its lights are on */
};

struct scene_camera scene_camera_make(const struct front_panel_config *config);
/* Pixel coordinates of a point before the camera. */
void scene_project(const struct scene_camera *camera, struct vec p, float *x, float *y);
/* The centre of a place on the front, in columns and rows from the top left. */
struct vec scene_front_point(float column, float row);
/* The mean over a pixel's samples. */
struct scene_pixel scene_pixel_trace(const struct scene_camera *camera,
                                     enum front_panel_view view, int x, int y, int samples);

#endif
