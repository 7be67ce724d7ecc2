/* jack_library.c - see jack_library.h. */
#include "jack_library.h"

#include <library.h>
#include <midi_internal.h>

#include <dlfcn.h>
#include <stdbool.h>
#include <string.h>

#define FUNCTION(name) LIBRARY_FUNCTION(struct jack_library, name)

static const struct library_function functions[] = {
    FUNCTION(jack_client_open),
    FUNCTION(jack_client_close),
    FUNCTION(jack_activate),
    FUNCTION(jack_deactivate),
    FUNCTION(jack_connect),
    FUNCTION(jack_port_register),
    FUNCTION(jack_port_get_buffer),
    FUNCTION(jack_set_process_callback),
    FUNCTION(jack_set_xrun_callback),
    FUNCTION(jack_on_shutdown),
    FUNCTION(jack_get_sample_rate),
    FUNCTION(jack_frames_since_cycle_start),
    FUNCTION(jack_last_frame_time),
    FUNCTION(jack_midi_get_event_count),
    FUNCTION(jack_midi_get_lost_event_count),
    FUNCTION(jack_midi_event_get),
    FUNCTION(jack_midi_clear_buffer),
    FUNCTION(jack_midi_event_write),
    FUNCTION(jack_set_error_function),
    FUNCTION(jack_set_info_function),
};

static void told(const char *text)
{
    (void)text; /* we report failures ourselves */
}

enum midi_status jack_load(const struct jack_library **out)
{
    static struct jack_library loaded;
    static bool there;
    *out = &loaded;
    if (there)
        return MIDI_OK;
    const char *missing;
    if (!library_load("libjack.so.0", functions, sizeof functions / sizeof *functions, &loaded,
                      &missing))
        return missing ? midi_fail(MIDI_NO_DEVICE, "JACK has no %s: install libjack-jackd2-0",
                                   missing)
                       : midi_fail(MIDI_NO_DEVICE,
                                   "JACK is not installed: install libjack-jackd2-0 (%s)",
                                   dlerror());
    loaded.jack_set_error_function(told);
    loaded.jack_set_info_function(told);
    there = true;
    return MIDI_OK;
}
