/* server_commands.h - the commands of clients. docs/midi.md lists them. */
#ifndef LUTETIA_MIDI_SERVER_COMMANDS_H
#define LUTETIA_MIDI_SERVER_COMMANDS_H

#include "server.h"

/* Executes a command and replies; the text ends with a zero and is modified. */
void command_do(struct midi_server *s, struct server_client *c, uint32_t number, char *text);
/* Writes a device's line: "NAME KIND in,out up". */
void command_device_text(const struct server_device *d, char text[static 160]);

#endif
