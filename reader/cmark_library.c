/* cmark_library.c - see cmark_library.h. The version is the one that this was built with: the
 * numbers of its kinds of nodes are in our code. */
#include "cmark_library.h"

#include <library.h>

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>

enum { REASON_BYTES = 256 };

struct cmark_library cmark;
static bool loaded;
static char reason[REASON_BYTES];

#define CMARK_ROW(name) {"cmark_" #name, offsetof(struct cmark_library, name)},
static const struct library_function functions[] = {CMARK_NAMES(CMARK_ROW)};
static const struct library_function extensions[] = {CMARK_EXTENSION_NAMES(CMARK_ROW)};

static bool load(const char *file, const struct library_function *of, size_t count)
{
    const char *missing = NULL;
    if (library_load_exactly(file, of, count, &cmark, &missing))
        return true;
    const char *said = missing ? missing : dlerror();
    snprintf(reason, sizeof reason, "%s%s", missing ? "it has no " : "", said ? said : file);
    return false;
}

static void load_once(void)
{
    loaded = load(CMARK_FILE, functions, sizeof functions / sizeof *functions) &&
             load(CMARK_EXTENSIONS_FILE, extensions, sizeof extensions / sizeof *extensions);
    if (loaded)
        cmark.gfm_core_extensions_ensure_registered();
}

bool cmark_load(const char **why)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load_once);
    if (!loaded)
        *why = reason;
    return loaded;
}
