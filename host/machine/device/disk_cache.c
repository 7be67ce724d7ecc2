/* disk_cache.c - files kept on disk from run to run: compiled programs, and tunings (tuning.c).
 *
 * Files are in $XDG_CACHE_HOME/lutetia, or ~/.cache/lutetia, if only this user can write there
 * (user_folder.h). A program's file is named by a hash of its key. The file begins with the
 * whole key, which is compared when it is read:
 *
 *     two lengths, 8 bytes each | platform, device, driver, options, text | binary
 *
 * A file appears under its name only when it is complete. If a file cannot be read or
 * written, the cache is not used. An empty file, named in the same way, is a mark: it says
 * that the driver has the program in its own cache (background.c).
 */
#include "device/disk_cache.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "input_file.h"
#include "oldest.h"
#include "output_file.h"
#include "user_folder.h"

enum { TRIM_EVERY = 256 }; /* files that a process adds */

uint64_t cache_hash(uint64_t h, const char *s)
{
    for (; *s; s++)
        h = (h ^ (unsigned char)*s) * 0x100000001b3u;
    return (h ^ 0xff) * 0x100000001b3u;
}

/* Removes part files of dead processes, once for each process. */
static void sweep_once(const char *path)
{
    static atomic_flag swept = ATOMIC_FLAG_INIT;
    if (atomic_flag_test_and_set(&swept))
        return;
    int folder = input_folder_descriptor(AT_FDCWD, path);
    if (folder < 0)
        return;
    output_file_sweep(folder);
    close(folder);
}

/* Files of programs and marks, 32 digits and a suffix. */
static bool is_program(const char *name)
{
    const size_t digits = strspn(name, "0123456789abcdef");
    return digits == 32 && (!strcmp(name + digits, ".bin") || !strcmp(name + digits, ".has"));
}

int cache_trim(const char *path, int most, double unused_s)
{
    int folder = input_folder_descriptor(AT_FDCWD, path), count = 0;
    DIR *list = folder >= 0 ? fdopendir(folder) : NULL;
    struct oldest o = {.folder = folder};
    for (const struct dirent *e; list && (e = readdir(list));)
        count += is_program(e->d_name);
    if (count > most)
        rewinddir(list);
    for (const struct dirent *e; count > most && (e = readdir(list));)
        if (is_program(e->d_name))
            oldest_add(&o, e->d_name, NULL);
    count = oldest_remove(&o, most, unused_s);
    if (list)
        closedir(list);
    else if (folder >= 0)
        close(folder);
    return count;
}

/* A file was added: now and then there are too many. */
static void trim_sometimes(void)
{
    static atomic_uint added;
    char path[MACHINE_CACHE_FOLDER_MAX];
    if (atomic_fetch_add(&added, 1) % TRIM_EVERY == 0 && machine_cache_folder(path, NULL))
        cache_trim(path, CACHE_FILES_MOST, 0);
}

/* It is not among the oldest any more. */
static void was_used(const char *path)
{
    utimensat(AT_FDCWD, path, NULL, AT_SYMLINK_NOFOLLOW);
}

bool machine_cache_folder(char out[static MACHINE_CACHE_FOLDER_MAX], const char **why)
{
    bool there = user_cache_folder("lutetia", out, why);
    if (there)
        sweep_once(out);
    return there;
}

FILE *cache_file_read(const char *path)
{
    int file = input_file_descriptor_no_link(path, NULL);
    FILE *f = file >= 0 ? fdopen(file, "rb") : NULL;
    if (!f && file >= 0)
        close(file);
    return f;
}

char *cache_key(const struct device *d, const char *const parts[DEVICE_PARTS],
                const char *options, const char *name)
{
    size_t size = strlen(options) + strlen(name) + strlen(parts[DEVICE_PARTS - 1]) + 64;
    char *key = malloc(size);
    uint64_t library = CACHE_HASH_BEGIN;
    for (int i = 0; i < DEVICE_PARTS - 1; i++)
        library = cache_hash(library, parts[i]);
    if (key)
        snprintf(key, size, "%s %s\n%s %llx\n%s", options, d->options, name,
                 (unsigned long long)library, parts[DEVICE_PARTS - 1]);
    return key;
}

static bool path_of(char *out, size_t size, const struct device *d, const char *key,
                    const char *suffix)
{
    char folder[MACHINE_CACHE_FOLDER_MAX];
    if (!machine_cache_folder(folder, NULL))
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
    size_t size =
        strlen(d->platform_name) + strlen(d->name) + strlen(d->driver) + strlen(key) + 4;
    char *whole = malloc(size);
    if (whole)
        snprintf(whole, size, "%s\n%s\n%s\n%s", d->platform_name, d->name, d->driver, key);
    return whole;
}

static unsigned char *binary_read(const char *path, const char *key, size_t *size)
{
    FILE *f = cache_file_read(path);
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
    if (binary)
        was_used(path);
    return binary;
}

static void binary_write(const char *path, const char *key, cl_program program)
{
    size_t size = 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL) || !size)
        return;
    unsigned char *binary = malloc(size);
    struct output_file out;
    if (binary &&
        !clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) &&
        output_file_open(&out, path)) {
        uint64_t length[2] = {strlen(key), size};
        fwrite(length, sizeof length, 1, out.stream);
        fwrite(key, 1, length[0], out.stream);
        fwrite(binary, 1, size, out.stream);
        output_file_commit(&out);
        trim_sometimes();
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
    char path[700];
    char *whole = whole_key(d, key);
    if (whole && path_of(path, sizeof path, d, key, ".bin"))
        binary_write(path, whole, program);
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
    const bool there = path_of(path, sizeof path, d, key, ".has") && !access(path, F_OK);
    if (there)
        was_used(path);
    return there;
}

void cache_mark_write(const struct device *d, const char *key)
{
    char path[700];
    int file = -1;
    if (path_of(path, sizeof path, d, key, ".has"))
        file = open(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
    if (file >= 0) {
        close(file);
        trim_sometimes();
    }
}
