/* gl_light.h - how what is drawn to mixes colours. */
#ifndef LUTETIA_GL_LIGHT_H
#define LUTETIA_GL_LIGHT_H

#include <stdbool.h>

/* The framebuffer that is bound for drawing is encoded as sRGB: with GL_FRAMEBUFFER_SRGB enabled colours are light, and
 * light is mixed. False before OpenGL 3. function: finds OpenGL's functions by their names. */
bool gl_light_mixed(void (*(*function)(const char *name))(void));

#endif
