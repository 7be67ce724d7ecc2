/* glfw_library.c - see glfw_library.h. */
#include "glfw_library.h"

#include <library.h>

#include <dlfcn.h>

struct glfw3 glfw3;

#define GLFW_ROW(name) {"glfw" #name, offsetof(struct glfw3, name)},
static const struct library_function functions[] = {GLFW_NAMES(GLFW_ROW)};

bool glfw_load(const char **why)
{
    const char *missing = NULL;
    bool done =
        glfw3.Init || library_load(GLFW_FILE, functions, sizeof functions / sizeof *functions,
                                   &glfw3, &missing);
    if (!done)
        *why = missing ? missing : dlerror();
    return done;
}
