/* gl_functions.h - the functions of OpenGL that a file calls, found at run time. The file says
 * which, and then includes this:
 *
 *     #define GL_FUNCTIONS(X) X(void, Clear, (GLbitfield)) X(void, End, (void))
 *     #include "gl_functions.h"
 *
 * and has struct gl, with a member for each, and gl_functions_find(). No include guard: each
 * file has its own. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdbool.h>

struct gl {
#define GL_MEMBER(result, name, parameters) result(*name) parameters;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

/* function: finds a function by its name. False: there are not all of them. */
static bool gl_functions_find(struct gl *gl, void (*(*function)(const char *name))(void))
{
    bool all = true;
#define GL_FIND(result, name, parameters)                                                      \
    gl->name = (result(*) parameters)function("gl" #name);                                     \
    all = all && gl->name;
    GL_FUNCTIONS(GL_FIND)
#undef GL_FIND
    return all;
}
