/* window_internal.h - what window.c (OpenGL), window_input.c (events) and window_open.c share
 * of a window. */
#ifndef LUTETIA_WINDOW_INTERNAL_H
#define LUTETIA_WINDOW_INTERNAL_H

#include "glfw_library.h"
#include "pen.h"
#include "window.h"
#include "window_x11.h"

#ifndef GL_CLAMP_TO_EDGE /* OpenGL 1.2 */
#define GL_CLAMP_TO_EDGE 0x812F
#endif

#define GL_FUNCTIONS(X)                                                                        \
    X(Begin, (GLenum))                                                                         \
    X(BindTexture, (GLenum, GLuint))                                                           \
    X(BlendFunc, (GLenum, GLenum))                                                             \
    X(Clear, (GLbitfield))                                                                     \
    X(ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                        \
    X(CopyTexImage2D, (GLenum, GLint, GLenum, GLint, GLint, GLsizei, GLsizei, GLint))          \
    X(DeleteTextures, (GLsizei, const GLuint *))                                               \
    X(Disable, (GLenum))                                                                       \
    X(Enable, (GLenum))                                                                        \
    X(End, (void))                                                                             \
    X(Flush, (void))                                                                           \
    X(GenTextures, (GLsizei, GLuint *))                                                        \
    X(GetIntegerv, (GLenum, GLint *))                                                          \
    X(PixelStorei, (GLenum, GLint))                                                            \
    X(TexCoord2f, (GLfloat, GLfloat))                                                          \
    X(TexEnvi, (GLenum, GLenum, GLint))                                                        \
    X(TexImage2D,                                                                              \
      (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *))           \
    X(TexParameteri, (GLenum, GLenum, GLint))                                                  \
    X(TexSubImage2D,                                                                           \
      (GLenum, GLint, GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, const void *))           \
    X(Vertex2f, (GLfloat, GLfloat))                                                            \
    X(Viewport, (GLint, GLint, GLsizei, GLsizei))

/* Screens with a scale below this count as 1: a pixel is a pixel. */
#define SCALE_LEAST 1.5f

struct gl {
#define GL_MEMBER(name, parameters) void(*name) parameters;
    GL_FUNCTIONS(GL_MEMBER)
    GLenum (*GetError)(void);
    const GLubyte *(*GetString)(GLenum);
    void (*GenerateMipmap)(
        GLenum); /* NULL before OpenGL 3: shrunk images are then less smooth */
};

struct window {
    GLFWwindow *glfw;
    struct gl gl;
    bool drawn_by_caller;
    GLuint texture;
    int side_max_px;
    int image_width_px, image_height_px, channels; /* of the texture; 0: there is none */
    bool mipmaps;                                  /* mipmaps of the present image have been
                                                    * made */
    bool stale;                                    /* the window must be redrawn */
    struct window_x11 *x11;                        /* NULL: pictures go through OpenGL */
    bool direct; /* the picture that is seen is x11's; the texture is not */
    /* Events. */
    struct input_queue queue;
    struct input_event pointer; /* the pointer and the modifiers as they are now */
    struct pen *pen;            /* NULL: no pen with pressure */
    /* Where the window was before it filled the screen. */
    bool fullscreen;
    bool edgeless;                /* over several screens: there is no larger size */
    struct window_repeat *repeat; /* NULL: on no further screens */
    int before[4];
};

/* GLFW is there from now on: window_wake() may be called. NULL: it draws on something else than
 * X11. */
void window_wakes(void *x11_display);

/* Waits for the window's events, which it handles, and for the descriptor (-1: none). True:
 * that is readable. */
bool window_wait_or(double wait_s, int descriptor);

/* Redraws the image, scaled to fit. */
void window_draw(struct window *window);

/* Sets the callbacks that put events into the queue. */
void window_input_begin(struct window *window);

#endif
