/* gl_program.h - two shaders as a program. */
#ifndef LUTETIA_GL_PROGRAM_H
#define LUTETIA_GL_PROGRAM_H

#include <GL/gl.h>

/* function: finds OpenGL's functions by their names. 0: this display has no shaders, or does
 * not take these. The caller deletes the program. */
GLuint gl_program_make(void (*(*function)(const char *name))(void), const char *vertex_text,
                       const char *fragment_text);

#endif
