/* gl_offscreen.c - see gl_offscreen.h.
 *
 * libEGL and libOSMesa stay loaded, because drivers keep resources to the end of the process.
 *
 * In both ways, drawing goes to a framebuffer object. OSMesa also needs memory of its own as
 * a target; nothing is drawn there.
 */
#include "gl_offscreen.h"
#include "display_internal.h"

#include <library.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#ifdef LUTETIA_OSMESA
#include <GL/osmesa.h>
#endif
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define EGL_FUNCTIONS(X)                                                                       \
    X(EGLBoolean, Initialize, (EGLDisplay, EGLint *, EGLint *))                                \
    X(EGLBoolean, BindAPI, (EGLenum))                                                          \
    X(EGLContext, CreateContext, (EGLDisplay, EGLConfig, EGLContext, const EGLint *))          \
    X(EGLBoolean, MakeCurrent, (EGLDisplay, EGLSurface, EGLSurface, EGLContext))               \
    X(EGLBoolean, DestroyContext, (EGLDisplay, EGLContext))                                    \
    X(EGLDisplay, GetPlatformDisplayEXT, (EGLenum, void *, const EGLint *))

#define GL_FUNCTIONS(X)                                                                        \
    X(void, BindFramebuffer, (GLenum, GLuint))                                                 \
    X(void, BindRenderbuffer, (GLenum, GLuint))                                                \
    X(GLenum, CheckFramebufferStatus, (GLenum))                                                \
    X(void, Clear, (GLbitfield))                                                               \
    X(void, ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                  \
    X(void, DeleteFramebuffers, (GLsizei, const GLuint *))                                     \
    X(void, DeleteRenderbuffers, (GLsizei, const GLuint *))                                    \
    X(void, FramebufferRenderbuffer, (GLenum, GLenum, GLenum, GLuint))                         \
    X(void, GenFramebuffers, (GLsizei, GLuint *))                                              \
    X(void, GenRenderbuffers, (GLsizei, GLuint *))                                             \
    X(void, PixelStorei, (GLenum, GLint))                                                      \
    X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *))              \
    X(void, RenderbufferStorage, (GLenum, GLenum, GLsizei, GLsizei))                           \
    X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

#define MEMBER(result, name, parameters) result(*name) parameters;
struct functions {
    GL_FUNCTIONS(MEMBER)
};

struct egl {
    EGL_FUNCTIONS(MEMBER)
    EGLDisplay display;
    EGLContext context;
};

typedef void (*function)(void);

#ifdef LUTETIA_OSMESA
struct osmesa {
    OSMesaContext (*OSMesaCreateContextExt)(GLenum, GLint, GLint, GLint, OSMesaContext);
    GLboolean (*OSMesaMakeCurrent)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*OSMesaDestroyContext)(OSMesaContext);
    function (*OSMesaGetProcAddress)(const char *);
    OSMesaContext context;
    uint8_t unused[4]; /* OSMesa's own target, of one pixel */
};
#endif

struct gl_offscreen {
    enum gl_offscreen_way way;
    function (*function)(const char *name);
    struct functions f;
    int width_px, height_px;
    struct egl egl;
#ifdef LUTETIA_OSMESA
    struct osmesa osmesa;
#endif
    GLuint framebuffer, colors;
};

function gl_offscreen_function(const char *name)
{
    static struct {
        function (*eglGetProcAddress)(const char *);
    } egl;
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(egl, eglGetProcAddress)};
    const char *missing;
    return egl.eglGetProcAddress || library_load("libEGL.so.1", functions, 1, &egl, &missing)
               ? egl.eglGetProcAddress(name)
               : NULL;
}

static bool functions_find(struct functions *f, function (*find)(const char *name))
{
    bool all = true;
#define FIND_GL(result, name, parameters)                                                      \
    f->name = (result(*) parameters)find("gl" #name);                                          \
    all = all && f->name;
    GL_FUNCTIONS(FIND_GL)
    return all;
}

static bool egl_context_make(struct egl *e)
{
    static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT, EGL_NONE};
    e->display =
        e->GetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!e->display || !e->Initialize(e->display, NULL, NULL) || !e->BindAPI(EGL_OPENGL_API))
        return false;
    e->context = e->CreateContext(e->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    return e->context && e->MakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, e->context);
}

static enum display_status egl_make(struct gl_offscreen *s)
{
    bool all = true;
#define FIND_EGL(result, name, parameters)                                                     \
    s->egl.name = (result(*) parameters)gl_offscreen_function("egl" #name);                    \
    all = all && s->egl.name;
    EGL_FUNCTIONS(FIND_EGL)
    s->function = gl_offscreen_function;
    if (!all || !functions_find(&s->f, s->function))
        return display_fail(DISPLAY_NO_WINDOW,
                            "no OpenGL without a window: libEGL.so.1 is missing or old; "
                            "install libegl1 and libgl1-mesa-dri");
    if (!egl_context_make(&s->egl))
        return display_fail(
            DISPLAY_NO_WINDOW,
            "no OpenGL 3 without a window: EGL has no driver for it; install libgl1-mesa-dri");
    return DISPLAY_OK;
}

#ifdef LUTETIA_OSMESA
static bool osmesa_load(struct osmesa *o)
{
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(struct osmesa, OSMesaCreateContextExt),
        LIBRARY_FUNCTION(struct osmesa, OSMesaMakeCurrent),
        LIBRARY_FUNCTION(struct osmesa, OSMesaDestroyContext),
        LIBRARY_FUNCTION(struct osmesa, OSMesaGetProcAddress)};
    const char *missing;
    return library_load("libOSMesa.so.8", functions, sizeof functions / sizeof *functions, o,
                        &missing);
}

static enum display_status osmesa_make(struct gl_offscreen *s)
{
    struct osmesa *o = &s->osmesa;
    if (!osmesa_load(o))
        return display_fail(
            DISPLAY_NO_WINDOW,
            "no OpenGL by OSMesa: libOSMesa.so.8 is missing; install libosmesa6, or "
            "draw by EGL where Mesa no longer has it");
    s->function = o->OSMesaGetProcAddress;
    o->context = o->OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, NULL);
    if (!o->context || !o->OSMesaMakeCurrent(o->context, o->unused, GL_UNSIGNED_BYTE, 1, 1) ||
        !functions_find(&s->f, s->function))
        return display_fail(DISPLAY_NO_WINDOW,
                            "no OpenGL by OSMesa: it makes no context of OpenGL 3");
    return DISPLAY_OK;
}

static void osmesa_end(struct osmesa *o)
{
    if (!o->context)
        return;
    o->OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
    o->OSMesaDestroyContext(o->context);
}
#else
static enum display_status osmesa_make(struct gl_offscreen *s)
{
    (void)s;
    return display_fail(DISPLAY_NO_WINDOW,
                        "no OpenGL by OSMesa: this lutetia was built without "
                        "it (libosmesa6-dev was not there, and Mesa has none since 25.1); "
                        "draw by EGL");
}
#endif

static bool framebuffer_make(struct gl_offscreen *s)
{
    const struct functions *f = &s->f;
    f->GenFramebuffers(1, &s->framebuffer);
    f->GenRenderbuffers(1, &s->colors);
    f->BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    f->BindRenderbuffer(GL_RENDERBUFFER, s->colors);
    f->RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, s->width_px, s->height_px);
    f->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                               s->colors);
    if (f->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return false;
    f->Viewport(0, 0, s->width_px, s->height_px);
    gl_offscreen_clear(s, (const double[]){0, 0, 0});
    return true;
}

enum display_status gl_offscreen_create_by(enum gl_offscreen_way way, int width_px,
                                           int height_px, struct gl_offscreen **out)
{
    enum display_status status = DISPLAY_OK;
    *out = NULL;
    if (width_px < 1 || height_px < 1 || width_px > GL_OFFSCREEN_SIDE_MAX ||
        height_px > GL_OFFSCREEN_SIDE_MAX)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a picture drawn by OpenGL has 1..%d pixels a side (got %dx%d)",
                            GL_OFFSCREEN_SIDE_MAX, width_px, height_px);
    struct gl_offscreen *s = calloc(1, sizeof *s);
    if (!s)
        return display_fail(DISPLAY_NO_MEMORY, "no memory to draw with OpenGL");
    s->way = way;
    s->width_px = width_px;
    s->height_px = height_px;
    status = way == GL_OFFSCREEN_OSMESA ? osmesa_make(s) : egl_make(s);
    if (status == DISPLAY_OK && !framebuffer_make(s))
        status = display_fail(DISPLAY_NO_MEMORY,
                              "OpenGL has no memory for a picture of %dx%d pixels", width_px,
                              height_px);
    if (status == DISPLAY_OK)
        *out = s;
    else
        gl_offscreen_destroy(s);
    return status;
}

enum display_status gl_offscreen_create(int width_px, int height_px, struct gl_offscreen **out)
{
    return gl_offscreen_create_by(GL_OFFSCREEN_EGL, width_px, height_px, out);
}

gl_offscreen_find *gl_offscreen_functions(const struct gl_offscreen *s)
{
    return s->function;
}

void gl_offscreen_destroy(struct gl_offscreen *s)
{
    if (!s)
        return;
    if (s->framebuffer)
        s->f.DeleteFramebuffers(1, &s->framebuffer);
    if (s->colors)
        s->f.DeleteRenderbuffers(1, &s->colors);
    if (s->egl.context) {
        s->egl.MakeCurrent(s->egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        s->egl.DestroyContext(s->egl.display, s->egl.context);
    }
#ifdef LUTETIA_OSMESA
    osmesa_end(&s->osmesa);
#endif
    free(s);
}

void gl_offscreen_clear(struct gl_offscreen *s, const double color[3])
{
    s->f.ClearColor((float)color[0], (float)color[1], (float)color[2], 1);
    s->f.Clear(GL_COLOR_BUFFER_BIT);
}

enum display_status gl_offscreen_read(struct gl_offscreen *s, struct display_image *image)
{
    *image = (struct display_image){
        .width_px = s->width_px, .height_px = s->height_px, .channels = 3};
    enum display_status status = display_image_create(image);
    if (status != DISPLAY_OK)
        return status;
    s->f.PixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int y = 0; y < s->height_px; y++) /* OpenGL's rows are from the bottom up */
        s->f.ReadPixels(0, s->height_px - 1 - y, s->width_px, 1, GL_RGB, GL_UNSIGNED_BYTE,
                        image->pixels + (size_t)y * (size_t)s->width_px * 3);
    return DISPLAY_OK;
}
