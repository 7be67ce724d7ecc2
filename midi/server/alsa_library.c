/* alsa_library.c - see alsa_library.h. */
#include "alsa_library.h"

#include <library.h>
#include <midi_internal.h>

#include <dlfcn.h>
#include <stdbool.h>
#include <string.h>

_Static_assert(sizeof(struct alsa_event) == 28, "as the kernel declares it");

#define FUNCTION(name) LIBRARY_FUNCTION(struct alsa_library, name)

static const struct library_function functions[] = {
    FUNCTION(snd_seq_open),
    FUNCTION(snd_seq_close),
    FUNCTION(snd_seq_set_client_name),
    FUNCTION(snd_seq_create_simple_port),
    FUNCTION(snd_seq_parse_address),
    FUNCTION(snd_seq_connect_from),
    FUNCTION(snd_seq_connect_to),
    FUNCTION(snd_seq_poll_descriptors),
    FUNCTION(snd_seq_event_input),
    FUNCTION(snd_seq_event_input_pending),
    FUNCTION(snd_seq_event_output_direct),
    FUNCTION(snd_midi_event_new),
    FUNCTION(snd_midi_event_free),
    FUNCTION(snd_midi_event_no_status),
    FUNCTION(snd_midi_event_encode),
    FUNCTION(snd_midi_event_decode),
    FUNCTION(snd_strerror),
    FUNCTION(snd_lib_error_set_handler),
};

static void told(const char *file, int line, const char *function, int error,
                 const char *format, ...)
{
    (void)file, (void)line, (void)function, (void)error, (void)format; /* we report failures */
}

enum midi_status alsa_load(const struct alsa_library **out)
{
    static struct alsa_library loaded;
    static bool there;
    *out = &loaded;
    if (there)
        return MIDI_OK;
    const char *missing;
    if (!library_load("libasound.so.2", functions, sizeof functions / sizeof *functions,
                      &loaded, &missing))
        return missing
                   ? midi_fail(MIDI_NO_DEVICE, "ALSA has no %s: install libasound2", missing)
                   : midi_fail(MIDI_NO_DEVICE, "ALSA is not installed: install libasound2 (%s)",
                               dlerror());
    loaded.snd_lib_error_set_handler(told);
    there = true;
    return MIDI_OK;
}
