/* call_line.c - where the program's source calls the library.
 *
 * The return addresses on the stack lead from the complaint through the library to its caller:
 * the first one outside the library is the call. The program's debug information (DWARF, made
 * by -g1, which `lutetia cc` asks for) gives its file and line. elfutils' libdw reads that
 * information. It is loaded at the first complaint, so a program without mistakes does not pay
 * for it.
 *
 * There is no line where the program has no debug information, where libdw is not installed,
 * and where the library is linked into the program itself.
 */
#include "call_line.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/auxv.h>
#include <unistd.h>

#ifdef LUTETIA_HAS_LIBDW
#include <elfutils/libdwfl.h>
#include <library.h>

enum { FRAMES = 64, CALLS = 64 };

static struct {
    Dwfl *(*dwfl_begin)(const Dwfl_Callbacks *callbacks);
    void (*dwfl_end)(Dwfl *session);
    int (*dwfl_linux_proc_report)(Dwfl *session, pid_t process);
    int (*dwfl_report_end)(Dwfl *session,
                           int (*removed)(Dwfl_Module *, void *, const char *, Dwarf_Addr,
                                          void *),
                           void *argument);
    int (*dwfl_linux_proc_find_elf)(Dwfl_Module *module, void **data, const char *name,
                                    Dwarf_Addr base, char **file, Elf **elf);
    Dwfl_Module *(*dwfl_addrmodule)(Dwfl *session, Dwarf_Addr address);
    Dwarf_Die *(*dwfl_module_addrdie)(Dwfl_Module *module, Dwarf_Addr address,
                                      Dwarf_Addr *bias);
    Dwarf_Die *(*dwfl_module_nextcu)(Dwfl_Module *module, Dwarf_Die *last, Dwarf_Addr *bias);
    int (*dwarf_haspc)(Dwarf_Die *unit, Dwarf_Addr address);
    Dwarf_Line *(*dwarf_getsrc_die)(Dwarf_Die *unit, Dwarf_Addr address);
    const char *(*dwarf_linesrc)(Dwarf_Line *line, Dwarf_Word *time, Dwarf_Word *length);
    int (*dwarf_lineno)(Dwarf_Line *line, int *number);
} dw;

#define DW(function) LIBRARY_FUNCTION(dw, function)
static const struct library_function functions[] = {
    DW(dwfl_begin),
    DW(dwfl_end),
    DW(dwfl_linux_proc_report),
    DW(dwfl_report_end),
    DW(dwfl_linux_proc_find_elf),
    DW(dwfl_addrmodule),
    DW(dwfl_module_addrdie),
    DW(dwfl_module_nextcu),
    DW(dwarf_haspc),
    DW(dwarf_getsrc_die),
    DW(dwarf_linesrc),
    DW(dwarf_lineno),
};

static bool libdw_loaded(void)
{
    static enum { UNKNOWN, LOADED, MISSING } state;
    const char *missing;
    if (state == UNKNOWN)
        state = library_load("libdw.so.1", functions, sizeof functions / sizeof *functions, &dw,
                             &missing)
                    ? LOADED
                    : MISSING;
    return state == LOADED;
}

/* Debug information in files of its own is not looked for: libdw might ask a server for it. */
static int separate_file_none(Dwfl_Module *module, void **data, const char *name,
                              Dwarf_Addr base, const char *file, const char *link,
                              GElf_Word checksum, char **found)
{
    (void)module, (void)data, (void)name, (void)base, (void)file, (void)link, (void)checksum;
    *found = NULL;
    return -1;
}

/* The process's modules, as they were when they were last read; NULL: they cannot be read. */
static Dwfl *session;

static void modules_read(void)
{
    static Dwfl_Callbacks callbacks;
    callbacks.find_elf = dw.dwfl_linux_proc_find_elf;
    callbacks.find_debuginfo = separate_file_none;
    if (session)
        dw.dwfl_end(session);
    session = dw.dwfl_begin(&callbacks);
    if (session && (dw.dwfl_linux_proc_report(session, getpid()) != 0 ||
                    dw.dwfl_report_end(session, NULL, NULL) != 0)) {
        dw.dwfl_end(session);
        session = NULL;
    }
}

/* The line of an instruction in a module; NULL: unknown. clang writes no table from addresses
 * to compilation units (.debug_aranges), so there each unit is asked. */
static Dwarf_Line *line_in(Dwfl_Module *module, Dwarf_Addr address)
{
    Dwarf_Addr bias = 0;
    Dwarf_Die *unit = dw.dwfl_module_addrdie(module, address, &bias);
    if (!unit)
        while ((unit = dw.dwfl_module_nextcu(module, unit, &bias)) &&
               dw.dwarf_haspc(unit, address - bias) <= 0)
            ;
    return unit ? dw.dwarf_getsrc_die(unit, address - bias) : NULL;
}

/* The line of an instruction's address; NULL: unknown. A module that was loaded after the
 * modules were read makes them be read again. */
static Dwarf_Line *line_of(Dwarf_Addr address)
{
    Dwfl_Module *module = session ? dw.dwfl_addrmodule(session, address) : NULL;
    if (!module) {
        modules_read();
        module = session ? dw.dwfl_addrmodule(session, address) : NULL;
    }
    return module ? line_in(module, address) : NULL;
}

/* The address that the first function outside the library will return to; 0: none is found, or
 * the library is part of the program. The uppermost frames may be a sanitizer's, which takes
 * the place of backtrace(). */
static uintptr_t caller_find(void)
{
    void *frames[FRAMES];
    Dl_info here, there, program;
    int count = backtrace(frames, FRAMES);
    bool inside = false;
    if (!dladdr(__extension__(void *) caller_find, &here) ||
        !dladdr((void *)(uintptr_t)getauxval(AT_ENTRY), &program) ||
        program.dli_fbase == here.dli_fbase)
        return 0;
    for (int i = 0; i < count; i++) {
        if (!dladdr(frames[i], &there))
            continue;
        if (inside && there.dli_fbase != here.dli_fbase)
            return (uintptr_t)frames[i];
        inside = inside || there.dli_fbase == here.dli_fbase;
    }
    return 0;
}

/* Places that were looked up before: a program with a handler may make the same mistake
 * often. */
static struct {
    uintptr_t address;
    char text[200];
} calls[CALLS];

static void place_print(char *text, size_t size, Dwarf_Line *line)
{
    int number = 0;
    const char *file = dw.dwarf_linesrc(line, NULL, NULL);
    const char *slash = file ? strrchr(file, '/') : NULL;
    if (file && dw.dwarf_lineno(line, &number) == 0 && number > 0)
        snprintf(text, size, "%s:%d", slash ? slash + 1 : file, number);
}

const char *paris_call_line(void)
{
    uintptr_t address = caller_find();
    if (!address || !libdw_loaded())
        return "";
    size_t slot = address / 4 % CALLS;
    if (calls[slot].address != address) {
        Dwarf_Line *line = line_of(address - 1); /* within the call instruction */
        calls[slot].address = address;
        calls[slot].text[0] = '\0';
        if (line)
            place_print(calls[slot].text, sizeof calls[slot].text, line);
    }
    return calls[slot].text;
}

#else

const char *paris_call_line(void)
{
    return "";
}

#endif
