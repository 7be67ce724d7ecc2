/* cache.c - what is kept on disk from run to run: compiled programs, and what `lutetia tune` found (tuning.c).
 *
 * Files are in $XDG_CACHE_HOME/lutetia, or ~/.cache/lutetia. A program's is named by a hash of text, options,
 * device and driver, which it begins with, to be compared as a whole:
 *
 *     two lengths, 8 bytes each | driver, device, options, text | binary
 *
 * Each appears under its name only when it is complete. What cannot be read or written is done without. An empty file,
 * named in the same way, is a mark: background.c notes what the driver has in a cache of its own. */
#include "internal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

uint64_t cache_hash(uint64_t h, const char *s)
{
    for (; *s; s++)
        h = (h ^ (unsigned char)*s) * 0x100000001b3u;
    return (h ^ 0xff) * 0x100000001b3u;
}

bool machine_cache_folder(char *out, size_t size)
{
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int n = -1;
    if (base && *base == '/')
        n = snprintf(out, size, "%s/lutetia", base);
    else if (home && *home == '/')
        n = snprintf(out, size, "%s/.cache/lutetia", home);
    return n >= 0 && (size_t)n < size;
}

void cache_folder_make(char *folder)
{
    for (size_t i = 1; folder[0] && folder[i]; i++)
        if (folder[i] == '/') {
            folder[i] = 0;
            mkdir(folder, 0700);
            folder[i] = '/';
        }
    mkdir(folder, 0700);
}

FILE *cache_temporary(const char *path, char *temporary, size_t size)
{
    int n = snprintf(temporary, size, "%s.XXXXXX", path);
    int file = n > 0 && (size_t)n < size ? mkostemp(temporary, O_CLOEXEC) : -1;
    FILE *f = file >= 0 ? fdopen(file, "wb") : NULL;
    if (!f && file >= 0) {
        close(file);
        unlink(temporary);
    }
    return f;
}

static bool path_of(char *out, size_t size, const struct device *d, const char *key,
                    const char *suffix)
{
    char folder[512];
    if (!machine_cache_folder(folder, sizeof folder))
        return false;
    uint64_t a = cache_hash(cache_hash(cache_hash(CACHE_HASH_BEGIN, key), d->name), d->driver);
    uint64_t b = cache_hash(cache_hash(cache_hash(0x84222325cbf29ce4u, d->platform_name), key),
                            d->driver);
    int n = snprintf(out, size, "%s/%016llx%016llx%s", folder, (unsigned long long)a,
                     (unsigned long long)b, suffix);
    return n > 0 && (size_t)n < size;
}

static char *whole_key(const struct device *d, const char *key)
{
    size_t size = strlen(d->name) + strlen(d->driver) + strlen(key) + 3;
    char *whole = malloc(size);
    if (whole)
        snprintf(whole, size, "%s\n%s\n%s", d->name, d->driver, key);
    return whole;
}

static unsigned char *binary_read(const char *path, const char *key, size_t *size)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return NULL;
    unsigned char *binary = NULL;
    uint64_t length[2];
    size_t key_length = strlen(key);
    char *read_key = malloc(key_length + 1);
    if (read_key && fread(length, sizeof length, 1, f) == 1 && length[0] == key_length &&
        length[1] > 0 && length[1] < (64u << 20) &&
        fread(read_key, 1, key_length, f) == key_length && !memcmp(read_key, key, key_length)) {
        *size = (size_t)length[1];
        binary = malloc(*size);
        if (binary && fread(binary, 1, *size, f) != *size) {
            free(binary);
            binary = NULL;
        }
    }
    free(read_key);
    fclose(f);
    return binary;
}

static void binary_write(const char *path, const char *key, cl_program program)
{
    size_t size = 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL) || !size)
        return;
    unsigned char *binary = malloc(size);
    char temporary[720];
    FILE *f =
        binary && !clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL)
            ? cache_temporary(path, temporary, sizeof temporary)
            : NULL;
    if (f) {
        uint64_t length[2] = {strlen(key), size};
        bool good = fwrite(length, sizeof length, 1, f) == 1 &&
                    fwrite(key, 1, length[0], f) == length[0] &&
                    fwrite(binary, 1, size, f) == size;
        good = fclose(f) == 0 && good;
        if (!good || rename(temporary, path))
            unlink(temporary);
    }
    free(binary);
}

unsigned char *cache_program_read(const struct device *d, const char *key, size_t *size)
{
    char path[700];
    char *whole = whole_key(d, key);
    unsigned char *binary = whole && path_of(path, sizeof path, d, key, ".bin")
                                ? binary_read(path, whole, size)
                                : NULL;
    free(whole);
    return binary;
}

void cache_program_write(const struct device *d, const char *key, cl_program program)
{
    char path[700], folder[512];
    char *whole = whole_key(d, key);
    if (whole && machine_cache_folder(folder, sizeof folder) &&
        path_of(path, sizeof path, d, key, ".bin")) {
        cache_folder_make(folder);
        binary_write(path, whole, program);
    }
    free(whole);
}

bool cache_program_is_there(const struct device *d, const char *key)
{
    char path[700];
    return path_of(path, sizeof path, d, key, ".bin") && !access(path, R_OK);
}

bool cache_mark_is_there(const struct device *d, const char *key)
{
    char path[700];
    return path_of(path, sizeof path, d, key, ".has") && !access(path, F_OK);
}

void cache_mark_write(const struct device *d, const char *key)
{
    char path[700], folder[512];
    int file = -1;
    if (machine_cache_folder(folder, sizeof folder) &&
        path_of(path, sizeof path, d, key, ".has")) {
        cache_folder_make(folder);
        file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    }
    if (file >= 0)
        close(file);
}
