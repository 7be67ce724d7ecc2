/* server_route.h - messages between devices and clients. */
#ifndef LUTETIA_MIDI_SERVER_ROUTE_H
#define LUTETIA_MIDI_SERVER_ROUTE_H

#include "server.h"

/* Devices' upcalls. */
void route_received(struct server_device *d, const struct midi_message *m);
void route_read(struct server_device *d);
void route_drained(struct server_device *d);
/* Messages of the device are lost: who hears it is told, and what it believes to sound is
 * ended. */
void route_device_lost(struct midi_server *s, int device, uint32_t count);
/* The device is away: ends its sounding notes, and forgets its players. */
void route_device_away(struct midi_server *s, int device);

/* Routes a message of a client to a device. */
enum client_verdict route_message(struct midi_server *s, struct server_client *c,
                                  const struct midi_wire_frame *f);
/* Ends the notes that only this client plays. */
void route_client_away(struct midi_server *s, struct server_client *c);
/* Sets what the client receives of the device from now on; chain NULL: nothing. Takes the
 * chain over. */
void route_hear(struct midi_server *s, struct server_client *c, int device,
                struct midi_chain *chain);
void route_send_filter(struct midi_server *s, struct server_client *c, int device,
                       struct midi_chain *chain);
/* Sends the values that filters held back and that are due. */
void route_thinned(struct server_timer *t, uint64_t now_ns);

#endif
