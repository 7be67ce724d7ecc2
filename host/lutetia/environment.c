/* environment.c - see environment.h. The machine's rows are those of machine_settings.tab. */
#include "environment.h"

#include <stddef.h>

const char *environment_group_name(enum environment_group group)
{
    switch (group) {
    case ENVIRONMENT_USER:
        return "user";
    case ENVIRONMENT_PARIS:
        return "paris";
    case ENVIRONMENT_MIDI:
        return "midi";
    case ENVIRONMENT_ENGINE:
        return "engine";
    case ENVIRONMENT_OTHERS:
        return "others";
    }
    return "";
}

#define USER ENVIRONMENT_USER
#define PARIS ENVIRONMENT_PARIS
#define MIDI ENVIRONMENT_MIDI
#define ENGINE ENVIRONMENT_ENGINE
#define OTHERS ENVIRONMENT_OTHERS

const struct environment_row environment_rows[] = {
    {"LUTETIA_DEVICE", "NAME", USER,
     "the OpenCL device: a part of its name or of its platform's, or its number in `lutetia "
     "info` "
     "(the first)"},

    {"LUTETIA_RANKS", "0", PARIS,
     "processes that mpirun or srun makes of a C/Paris program are programs of their own, and "
     "not one on several processes"},
    {"LUTETIA_EXPLAIN", "FILE", PARIS,
     "when the program ends, what its machine did is written there as text"},
    {"LUTETIA_EXPLAIN_JSON", "FILE", PARIS, "the same as JSON"},
    {"LUTETIA_TRACE", "FILE", PARIS,
     "what happens when is written there, in Chrome's trace event format"},
    {"LUTETIA_DUMP", "DIR", PARIS, "graphs and generated kernels are written there"},
    {"LUTETIA_LEDS", "window|FILE", PARIS,
     "the lights that CM_latch_leds sets are shown in a window, or recorded in a file for "
     "`lutetia "
     "leds FILE`"},
    {"LUTETIA_LEDS_PROGRAM", "PID NAME", PARIS,
     "libparis sets it for the window that shows a program's lights: which program"},
    {"LUTETIA_DISPLAY", "window|FILE", PARIS,
     "the frame buffer's displays (<cm/cmfb.h>) are shown in windows, or recorded in a file "
     "for "
     "`lutetia display FILE`"},
    {"LUTETIA_DISPLAY_PROGRAM", "PID NAME", PARIS,
     "libparis sets it for the windows that show a program's displays: which program"},
    {"LUTETIA_DISPLAY_ROOM", "FD NUMBER PIPE", PARIS,
     "libparis and `lutetia display` set it for each other: memory for pictures that both see"},

    {"LUTETIA_SOUNDFONT", "FILE", MIDI,
     "the instruments of what is heard, an SF2 file (the distribution's)"},
    {"LUTETIA_MIDI_TOKEN", "TEXT", MIDI,
     "the secret that server and clients share over TCP (`lutetia midi serve --tcp`)"},

    {"LUTETIA_COMPILER", "FILE", ENGINE,
     "the lutetia-compiler that compiles in the background; empty: as LUTETIA_BACKGROUND=0"},

#define SETTING(variable, member, read, usual, least, most, multiple, may_be, value, group,    \
                does)                                                                          \
    {"LUTETIA_" #variable, value, group, does},
#include "machine_settings.tab"
#undef SETTING

    {"POCL_AFFINITY", "0", OTHERS, "PoCL's threads are not tied to a processor each"},
    {"POCL_MAX_PTHREAD_COUNT", "N", OTHERS, "how many threads PoCL has (one a processor)"},
    {"POCL_CACHE_DIR", "DIR", OTHERS,
     "where PoCL keeps the kernels that it builds ($XDG_CACHE_HOME/pocl/kcache)"},
    {"POCL_KERNEL_CACHE", "0", OTHERS, "PoCL keeps no kernels on disk"},
    {"XDG_CACHE_HOME", "DIR", OTHERS, "where caches are (~/.cache)"},
    {"XDG_RUNTIME_DIR", "DIR", OTHERS, "where the MIDI server's socket is"},
    {"TMPDIR", "DIR", OTHERS, "where temporary files are (/tmp)"},
    {"CC", "COMMAND", OTHERS, "the C compiler of `lutetia cc` (cc)"},
    {"CXX", "COMMAND", OTHERS, "its C++ compiler, where a source is C++ (c++)"},
    {"DISPLAY", "NAME", OTHERS, "the display of windows; WAYLAND_DISPLAY is looked at, too"},
    {NULL, NULL, USER, NULL},
};
