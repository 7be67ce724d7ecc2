/* midi_connect.h - connects to a server, and checks its owner. */
#ifndef LUTETIA_MIDI_CONNECT_H
#define LUTETIA_MIDI_CONNECT_H

#include <midi_status.h>

/* address NULL: the user's own server. Errors: NO_SERVER, REFUSED (another user's),
 * BAD_ARGUMENT; *file is then -1. */
enum midi_status midi_connect(const char *address, int *file);

#endif
