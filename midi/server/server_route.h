/* server_route.h - messages between devices and clients. */
#ifndef LUTETIA_MIDI_SERVER_ROUTE_H
#define LUTETIA_MIDI_SERVER_ROUTE_H

#include "server.h"

/* Devices' upcalls. */
void route_received(struct server_device *d, const struct midi_message *m);
void route_read(struct server_device *d);
void route_drained(struct server_device *d);
/* It is away: what sounds of it ends, and nobody plays it. */
void route_device_away(struct midi_server *s, int device);

/* A message of a client for a device. */
enum client_verdict route_message(struct midi_server *s, struct server_client *c,
                                  const struct midi_wire_frame *f);
/* The notes that only this client plays end. */
void route_client_away(struct midi_server *s, struct server_client *c);
/* What the client hears of the device, from now on; chain NULL: nothing. Takes the chain over. */
void route_hear(struct midi_server *s, struct server_client *c, int device,
                struct midi_chain *chain);
void route_send_filter(struct midi_server *s, struct server_client *c, int device,
                       struct midi_chain *chain);
/* Values that filters held back and that are due. */
void route_thinned(struct server_timer *t, uint64_t now_ns);

#endif
