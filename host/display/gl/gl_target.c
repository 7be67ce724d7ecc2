/* gl_target.c - see gl_target.h. GL_FRAMEBUFFER_SRGB is disabled for copies, so numbers are
 * copied unchanged. */
#include "gl_target.h"
#include "display_internal.h"

#include <srgb.h>

#include <stdlib.h>

#define GL_FUNCTIONS(X)                                                                        \
    X(void, BindFramebuffer, (GLenum, GLuint))                                                 \
    X(void, BindRenderbuffer, (GLenum, GLuint))                                                \
    X(void, BlitFramebuffer,                                                                   \
      (GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum))            \
    X(GLenum, CheckFramebufferStatus, (GLenum))                                                \
    X(void, DeleteFramebuffers, (GLsizei, const GLuint *))                                     \
    X(void, DeleteRenderbuffers, (GLsizei, const GLuint *))                                    \
    X(void, FramebufferRenderbuffer, (GLenum, GLenum, GLenum, GLuint))                         \
    X(void, GenFramebuffers, (GLsizei, GLuint *))                                              \
    X(void, GenRenderbuffers, (GLsizei, GLuint *))                                             \
    X(GLenum, GetError, (void))                                                                \
    X(void, GetIntegerv, (GLenum, GLint *))                                                    \
    X(void, PixelStorei, (GLenum, GLint))                                                      \
    X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *))              \
    X(void, RenderbufferStorage, (GLenum, GLenum, GLsizei, GLsizei))

#include "gl_functions.h"

struct gl_target {
    struct gl gl;
    GLuint framebuffer, colors;
    GLint before; /* the framebuffer that was drawn to */
    int width_px, height_px;
};

/* Framebuffers of one's own came with OpenGL 3. */
static bool functions_find(struct gl *gl, void (*(*function)(const char *name))(void))
{
    GLint major = 0;
    if (!gl_functions_find(gl, function))
        return false;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    return gl->GetError() == GL_NO_ERROR && major >= 3;
}

enum display_status gl_target_create(void (*(*function)(const char *name))(void),
                                     struct gl_target **out)
{
    *out = NULL;
    struct gl_target *t = calloc(1, sizeof *t);
    if (!t)
        return display_fail(DISPLAY_NO_MEMORY, "no memory to draw with OpenGL");
    if (!functions_find(&t->gl, function)) {
        free(t);
        return display_fail(DISPLAY_NO_WINDOW, "this display has no OpenGL 3");
    }
    t->gl.GenFramebuffers(1, &t->framebuffer);
    t->gl.GenRenderbuffers(1, &t->colors);
    *out = t;
    return DISPLAY_OK;
}

void gl_target_destroy(struct gl_target *t)
{
    if (!t)
        return;
    t->gl.DeleteFramebuffers(1, &t->framebuffer);
    t->gl.DeleteRenderbuffers(1, &t->colors);
    free(t);
}

enum display_status gl_target_begin(struct gl_target *t, int width_px, int height_px)
{
    const struct gl *gl = &t->gl;
    gl->GetIntegerv(GL_FRAMEBUFFER_BINDING, &t->before);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    if (width_px == t->width_px && height_px == t->height_px)
        return DISPLAY_OK;
    gl->BindRenderbuffer(GL_RENDERBUFFER, t->colors);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width_px, height_px);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                t->colors);
    t->width_px = width_px;
    t->height_px = height_px;
    if (gl->GetError() == GL_NO_ERROR &&
        gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return DISPLAY_OK;
    t->width_px = t->height_px = 0;
    return display_fail(DISPLAY_NO_MEMORY, "OpenGL has no memory for a picture of %dx%d pixels",
                        width_px, height_px);
}

void gl_target_show(struct gl_target *t)
{
    const int w = t->width_px, h = t->height_px;
    t->gl.BindFramebuffer(GL_READ_FRAMEBUFFER, t->framebuffer);
    t->gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    t->gl.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    t->gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* Rows from the top; OpenGL's are from the bottom up. */
static enum display_status rows_read(struct gl_target *t, struct display_image *image,
                                     int channels)
{
    const int w = t->width_px, h = t->height_px;
    if (!image->pixels || image->width_px != w || image->height_px != h ||
        image->channels != channels) {
        display_image_destroy(image);
        *image = (struct display_image){.width_px = w, .height_px = h, .channels = channels};
        enum display_status status = display_image_create(image);
        if (status != DISPLAY_OK)
            return status;
    }
    t->gl.BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    t->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int y = 0; y < h; y++)
        t->gl.ReadPixels(0, h - 1 - y, w, 1, channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                         image->pixels + (size_t)y * (size_t)w * (size_t)channels);
    t->gl.BindFramebuffer(GL_FRAMEBUFFER, (GLuint)t->before);
    return DISPLAY_OK;
}

enum display_status gl_target_read(struct gl_target *t, struct display_image *image)
{
    return rows_read(t, image, 3);
}

enum display_status gl_target_read_alpha(struct gl_target *t, struct display_image *image)
{
    enum { STEPS = 4095 };
    double light[256];
    uint8_t number[STEPS + 1];
    enum display_status status = rows_read(t, image, 4);
    if (status != DISPLAY_OK)
        return status;
    for (int i = 0; i < 256; i++)
        light[i] = srgb_light(i / 255.0);
    for (int i = 0; i <= STEPS; i++)
        number[i] = (uint8_t)lround(255 * srgb_number((double)i / STEPS));
    uint8_t *p = image->pixels;
    for (size_t left = (size_t)image->width_px * (size_t)image->height_px; left; left--, p += 4)
        for (int c = 0; p[3] < 255 && c < 3; c++) {
            const double whole = p[3] ? light[p[c]] * 255 / p[3] : 0;
            p[c] = number[whole < 1 ? (int)(STEPS * whole + 0.5) : STEPS];
        }
    return DISPLAY_OK;
}
