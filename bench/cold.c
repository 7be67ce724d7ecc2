/* cold.c - see cold.h. */
#include "cold.h"

#include <ftw.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness.h"
#include "input_file.h"
#include "output_file.h"
#include "user_folder.h"

enum { COLD_FOLDER = 512 };

extern char **environ;

static int entry_remove(const char *path, const struct stat *status, int kind,
                        struct FTW *where)
{
    (void)status;
    (void)kind;
    (void)where;
    return remove(path);
}

void cold_folder_remove(const char *folder)
{
    nftw(folder, entry_remove, 16, FTW_DEPTH | FTW_PHYS);
}

/* The environment, but with caches in that folder; LUTETIA_BACKGROUND as anybody's. The
 * caller's to free. */
static char **environment_of(char *cache, char *driver)
{
    static const char *const left_out[] = {
        "XDG_CACHE_HOME=", "POCL_CACHE_DIR=", "LUTETIA_BACKGROUND="};
    size_t count = 0, kept = 0;
    while (environ[count])
        count++;
    char **out = calloc(count + 3, sizeof *out);
    for (size_t i = 0; out && i < count; i++) {
        bool wanted = true;
        for (int k = 0; k < 3; k++)
            wanted = wanted && strncmp(environ[i], left_out[k], strlen(left_out[k])) != 0;
        if (wanted)
            out[kept++] = environ[i];
    }
    if (out) {
        out[kept++] = cache;
        out[kept] = driver;
    }
    return out;
}

bool cold_tell(const char *path, const struct cold *c)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return false;
    fprintf(out.stream, "%.9f %.0f %u", c->seconds, c->kernels, c->result);
    return output_file_commit(&out);
}

bool cold_measure(const char *bench, const char *what, struct cold *out)
{
    char folder[COLD_FOLDER], cache[COLD_FOLDER + 32], driver[COLD_FOLDER + 32],
        path[COLD_FOLDER + 32];
    char name[] = "lutetia-bench", flag[] = COLD_FLAG, of[32], which[32];
    if (!user_folder_temporary("cold", folder, sizeof folder))
        return bench_fail("%s: no folder can be made", folder);
    snprintf(cache, sizeof cache, "XDG_CACHE_HOME=%s", folder);
    snprintf(driver, sizeof driver, "POCL_CACHE_DIR=%s/pocl", folder);
    snprintf(path, sizeof path, "%s/times", folder);
    snprintf(of, sizeof of, "%s", bench);
    snprintf(which, sizeof which, "%s", what);
    bool ok =
        mkdir(strchr(driver, '=') + 1, 0700) == 0 || bench_fail("%s: cannot be made", folder);
    char **environment = ok ? environment_of(cache, driver) : NULL;
    char *arguments[] = {name, of, flag, which, path, NULL};
    pid_t pid;
    int status = 0;
    ok = environment &&
         !posix_spawn(&pid, "/proc/self/exe", NULL, NULL, arguments, environment) &&
         waitpid(pid, &status, 0) == pid && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    FILE *file = ok ? input_file_open(path, NULL) : NULL;
    unsigned result = 0;
    ok = (file && fscanf(file, "%lf %lf %u", &out->seconds, &out->kernels, &result) == 3) ||
         bench_fail("a cold run of %s did not succeed", what);
    out->result = result;
    if (file)
        fclose(file);
    free(environment);
    cold_folder_remove(folder);
    return ok;
}
