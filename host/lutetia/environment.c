/* environment.c - see environment.h. The rows of the engine are explained at length in docs/engine.md. */
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
    {"LUTETIA_PROCESSORS", "N", USER, "how many physical processors, a power of two (65536)"},
    {"LUTETIA_MEMORY", "N", USER,
     "bytes that the machine's arrays may take together (15 of 16 parts of what is available)"},
    {"LUTETIA_TUNED", "0", USER, "what `lutetia tune` kept for the device is ignored"},
    {"LUTETIA_VERBOSE", "1", USER,
     "says so when what `lutetia tune` kept is ignored: it is damaged, or of another driver"},

    {"LUTETIA_EAGER", "1", PARIS,
     "every instruction is computed at once: slow, simple, and the same bits"},
    {"LUTETIA_LENIENT", "1", PARIS,
     "as after CM_set_safety_mode (0): what the real machine let pass is let pass"},
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

    {"LUTETIA_SOUNDFONT", "FILE", MIDI,
     "the instruments of what is heard, an SF2 file (the distribution's)"},
    {"LUTETIA_MIDI_TOKEN", "TEXT", MIDI,
     "the secret that server and clients share over TCP (`lutetia midi serve --tcp`)"},

    {"LUTETIA_REPLAY", "0", ENGINE, "calls that were seen before are recorded, too"},
    {"LUTETIA_FLUSH_AFTER", "N", ENGINE, "an evaluation is due when N values wait (384)"},
    {"LUTETIA_INTERPRET", "0..3", ENGINE,
     "plans are never interpreted; until kernels pay (1, the default); always; always, and by "
     "the "
     "device's own interpreter"},
    {"LUTETIA_AT_ONCE", "0|2", ENGINE,
     "operations of small sets are never computed at once; always"},
    {"LUTETIA_NUMBERS", "0|1", ENGINE,
     "numbers are never arguments of kernels; wherever they can be"},
    {"LUTETIA_NEAR", "0|2", ENGINE,
     "the front end reads nothing of little by itself; all of it in several parts"},
    {"LUTETIA_WARM_UP", "0", ENGINE, "CM_init performs nothing before the program does"},
    {"LUTETIA_BACKGROUND", "0", ENGINE, "the program waits for its kernels to be compiled"},
    {"LUTETIA_COMPILER", "FILE", ENGINE,
     "the lutetia-compiler that compiles in the background; empty: as LUTETIA_BACKGROUND=0"},
    {"LUTETIA_OPTIMISE_AFTER", "N", ENGINE,
     "processors that a plan has run on before its kernel is optimised (4194304)"},
    {"LUTETIA_BOX_AFTER", "N", ENGINE,
     "processors that a plan has run on before its kernel is made for its size (33554432); 0: "
     "the "
     "best kernels at once"},
    {"LUTETIA_KERNELS", "N", ENGINE,
     "compiled kernels that are kept in memory, in units (512)"},
    {"LUTETIA_KERNELS_EVER", "N", ENGINE,
     "kernels that a process may start before other plans are interpreted for good (8192)"},
    {"LUTETIA_KEEP", "0|1", ENGINE, "kernels are not kept on disk; are kept"},
    {"LUTETIA_STRIPS", "0|1", ENGINE, "stages are never in one kernel; wherever that can be"},
    {"LUTETIA_STRIPS_EACH", "N", ENGINE, "strips for each compute unit, about (3)"},
    {"LUTETIA_COLUMNS", "N", ENGINE, "the width of a strip, a multiple of 16 (4096)"},
    {"LUTETIA_TILE", "WxH", ENGINE, "the size of a tile (what the model says)"},
    {"LUTETIA_VECTOR", "1|4|8|16", ENGINE, "lanes of a work-item"},
    {"LUTETIA_RUN", "N", ENGINE, "columns that a work-item goes along, a multiple of 16, or 1"},
    {"LUTETIA_TURNS", "N", ENGINE, "turns of a loop that are evaluated at once, at most (8)"},
    {"LUTETIA_IN_PLACE", "0|1", ENGINE,
     "nothing is written over what was read; all that can be"},
    {"LUTETIA_NARROW", "0", ENGINE, "no narrow lanes"},
    {"LUTETIA_GATHER", "0", ENGINE, "a get is a kernel of its own"},
    {"LUTETIA_SCATTER", "0|1", ENGINE,
     "work-items share out the destinations of a send; the senders write theirs"},
    {"LUTETIA_KEEPS_NAN", "0", ENGINE,
     "every operation counts as one that may change a NaN's bits"},
    {"LUTETIA_STREAMS", "0|1", ENGINE, "stores never pass the caches by; where it pays"},
    {"LUTETIA_CLAIMS", "0", ENGINE, "the driver says which thread computes what"},
    {"LUTETIA_AWAKE", "0|1", ENGINE,
     "processors may halt between kernels; they do not, wherever that can be"},

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
