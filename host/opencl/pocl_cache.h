/* pocl_cache.h - PoCL's cache of kernels does not grow without end: PoCL itself never removes
 * any. */
#ifndef LUTETIA_OPENCL_POCL_CACHE_H
#define LUTETIA_OPENCL_POCL_CACHE_H

enum { POCL_CACHE_MOST = 8192 }; /* programs; some 100 kB each */

/* Removes the programs that were used last longest ago from PoCL's cache in that folder, until
 * so many are left; none that was used in the last hour, which some process may be about to
 * load. Returns how many. */
int pocl_cache_trim(const char *folder, int most, double unused_s);

#endif
