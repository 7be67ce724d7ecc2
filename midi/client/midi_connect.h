/* midi_connect.h - connects to a server, and checks its owner. */
#ifndef LUTETIA_MIDI_CONNECT_H
#define LUTETIA_MIDI_CONNECT_H

#include <midi_status.h>

/* address NULL: the user's own server. *port: the TCP port, whose owner nobody has checked; 0:
 * a socket of this user's or of root's. Errors: NO_SERVER, REFUSED (another user's),
 * BAD_ARGUMENT; *file is then -1. */
enum midi_status midi_connect(const char *address, int *file, int *port);

#endif
