/* gl_program.c - see gl_program.h. */
#include "gl_program.h"

#include <stddef.h>

#define GL_FUNCTIONS(X)                                                                        \
    X(void, AttachShader, (GLuint, GLuint))                                                    \
    X(void, CompileShader, (GLuint))                                                           \
    X(GLuint, CreateProgram, (void))                                                           \
    X(GLuint, CreateShader, (GLenum))                                                          \
    X(void, DeleteProgram, (GLuint))                                                           \
    X(void, DeleteShader, (GLuint))                                                            \
    X(void, GetProgramiv, (GLuint, GLenum, GLint *))                                           \
    X(void, LinkProgram, (GLuint))                                                             \
    X(void, ShaderSource, (GLuint, GLsizei, const char *const *, const GLint *))
#include "gl_functions.h"

GLuint gl_program_make(void (*(*function)(const char *name))(void), const char *vertex_text,
                       const char *fragment_text)
{
    struct gl gl;
    const char *texts[2] = {vertex_text, fragment_text};
    GLint linked = 0;
    if (!gl_functions_find(&gl, function))
        return 0;
    GLuint program = gl.CreateProgram();
    for (int i = 0; i < 2; i++) {
        GLuint shader = gl.CreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        gl.ShaderSource(shader, 1, &texts[i], NULL);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader); /* freed with the program */
    }
    gl.LinkProgram(program);
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        return program;
    gl.DeleteProgram(program);
    return 0;
}
