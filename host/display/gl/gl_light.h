/* gl_light.h - whether the framebuffer mixes colours as light or as encoded numbers. */
#ifndef LUTETIA_GL_LIGHT_H
#define LUTETIA_GL_LIGHT_H

#include <stdbool.h>

/* True if the framebuffer bound for drawing is encoded as sRGB: with GL_FRAMEBUFFER_SRGB
 * enabled, colours are then linear light, and blending mixes light. False before OpenGL 3.
 * function: finds OpenGL's functions by their names. */
bool gl_light_mixed(void (*(*function)(const char *name))(void));

#endif
