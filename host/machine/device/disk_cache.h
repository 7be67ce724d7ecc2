/* disk_cache.h - built programs, and tunings, on disk. */
#ifndef LUTETIA_MACHINE_DISK_CACHE_H
#define LUTETIA_MACHINE_DISK_CACHE_H

#include <stdio.h>

#include "device/device.h"

#define CACHE_HASH_BEGIN UINT64_C(0xcbf29ce484222325)
uint64_t cache_hash(uint64_t h, const char *s);
/* Opens a regular file of the cache for reading; NULL if there is none, and for pipes, links
 * and devices. */
FILE *cache_file_read(const char *path);
/* The key of a kernel: its name, its build options, the last part of its text, and a hash of
 * the parts before that. The caller frees it; NULL: no memory. */
char *cache_key(const struct device *d, const char *const parts[DEVICE_PARTS],
                const char *options, const char *name);
/* Programs and marks in the folder: this many at most, and up to 256 more until the process
 * that adds them looks. Those go that were used last longest ago. */
enum { CACHE_FILES_MOST = 4096 };
/* Removes the oldest until so many are left, none that was used in so many seconds; returns how
 * many. Other files stay. */
int cache_trim(const char *folder, int most, double unused_s);
unsigned char *cache_program_read(const struct device *d, const char *key, size_t *size);
void cache_program_write(const struct device *d, const char *key, cl_program program);
bool cache_program_is_there(const struct device *d, const char *key);
bool cache_mark_is_there(const struct device *d, const char *key);
void cache_mark_write(const struct device *d, const char *key);

#endif
