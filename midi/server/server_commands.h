/* server_commands.h - what clients ask for in words. docs/midi.md lists them. */
#ifndef LUTETIA_MIDI_SERVER_COMMANDS_H
#define LUTETIA_MIDI_SERVER_COMMANDS_H

#include "server.h"

/* Answers; the text ends with a zero and is changed. */
void command_do(struct midi_server *s, struct server_client *c, uint32_t number, char *text);
/* A device's line: "NAME KIND in,out up". */
void command_device_text(const struct server_device *d, char text[static 160]);

#endif
