/* hdf5_library.c - see hdf5_library.h. */
#include "states/hdf5_library.h"

#include <library.h>

#include <dlfcn.h>

struct hdf5 hdf5;

#define HDF5_SYMBOL(name)                                                                      \
    SYMBOL_TEXT(H5##name) /* some names are macros for names with a version */
#define SYMBOL_TEXT(name) SYMBOL_TEXT_OF(name)
#define SYMBOL_TEXT_OF(name) #name
#define HDF5_ROW(name) {HDF5_SYMBOL(name), offsetof(struct hdf5, name)},
static const struct library_function symbols[] = {HDF5_NAMES(HDF5_ROW)};

enum paper_status hdf5_load(const char *path)
{
    const char *missing = NULL;
    if (hdf5.open || library_load_exactly(HDF5_FILE, symbols, sizeof symbols / sizeof *symbols,
                                          &hdf5, &missing))
        return PAPER_OK;
    return missing ? paper_fail(PAPER_BAD_ARGUMENT,
                                "%s: saved states are HDF5's, and the " HDF5_FILE
                                " that is installed has no %s",
                                path, missing)
                   : paper_fail(PAPER_BAD_ARGUMENT,
                                "%s: saved states are HDF5's, which cannot be loaded: %s", path,
                                dlerror());
}

void hdf5_begin(void)
{
    hdf5.check_version(
        H5_VERS_MAJOR, H5_VERS_MINOR,
        H5_VERS_RELEASE); /* another one than was compiled with ends the program */
    hdf5.dont_atexit();
    hdf5.open();
    hdf5.Eset_auto2(H5E_DEFAULT, NULL, NULL);
}
