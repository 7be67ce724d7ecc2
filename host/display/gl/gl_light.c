/* gl_light.c - see gl_light.h. A driver may return functions that it does not implement, so
 * the version is checked. */
#include "gl_light.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stddef.h>

bool gl_light_mixed(void (*(*function)(const char *name))(void))
{
    GLint major = 0, encoding = 0, bound = 0;
    void (*get)(GLenum, GLint *) = (void (*)(GLenum, GLint *))function("glGetIntegerv");
    GLenum (*error)(void) = (GLenum(*)(void))function("glGetError");
    void (*attachment)(GLenum, GLenum, GLenum, GLint *) = (void (*)(
        GLenum, GLenum, GLenum, GLint *))function("glGetFramebufferAttachmentParameteriv");
    if (!get || !error || !attachment)
        return false;
    get(GL_MAJOR_VERSION, &major);
    if (error() != GL_NO_ERROR || major < 3)
        return false;
    get(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    attachment(GL_DRAW_FRAMEBUFFER, bound ? GL_COLOR_ATTACHMENT0 : GL_BACK_LEFT,
               GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING, &encoding);
    return error() == GL_NO_ERROR && encoding == GL_SRGB;
}
