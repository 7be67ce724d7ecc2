/* osc_port.h - where packets of OSC come from and go to: UDP.
 *
 *     struct osc_port_def def = {.listen = "9000", .send = "127.0.0.1:9001"};
 *     struct osc_port *port;
 *     if (osc_port_open(&def, &port) != STAGE_OK)
 *         die(stage_error());
 *     while ((count = osc_port_next(port, bytes, sizeof bytes)) > 0)
 *         ...osc_packet_read(bytes, count, ...)...
 *     osc_port_send(port, bytes, count);
 *     osc_port_close(port);
 *
 * A port alone is this computer's, 127.0.0.1: nobody outside reaches it. An address of a
 * network is heard only where `from` says whose packets are: others are dropped, and counted.
 * UDP proves no sender: on a network where others may forge packets `from` is no lock.
 * Addresses are numbers, so nothing waits for a name server.
 *
 * Threads: a port belongs to one.
 */
#ifndef LUTETIA_LIVE_OSC_PORT_H
#define LUTETIA_LIVE_OSC_PORT_H

#include <stage_status.h>

#include <stddef.h>
#include <stdint.h>

struct osc_port_def {
    const char *listen;      /* PORT, ADDRESS:PORT or [ADDRESS]:PORT; NULL: nothing is heard */
    const char *const *from; /* addresses that are heard besides this computer's */
    int from_count;          /* OSC_FROM_MAX at most */
    const char *send;        /* as listen; NULL: nothing is sent but answers */
};
enum { OSC_FROM_MAX = 16 };

struct osc_port;
/* Errors: BAD_ARGUMENT (no address or port; an address of a network without `from`), FAILED
 * (the port is taken, or no address of this computer's). Owns: the caller closes *out. */
enum stage_status osc_port_open(const struct osc_port_def *def, struct osc_port **out);
void osc_port_close(struct osc_port *port); /* NULL is fine */

/* The next packet that has come from whom is heard; 0: there is none now. Waits for none. */
size_t osc_port_next(struct osc_port *port, uint8_t *bytes, size_t room);
/* To the sender of the last packet; to `send`. What does not get through is lost, as UDP's
 * packets are. */
void osc_port_answer(struct osc_port *port, const uint8_t *bytes, size_t count);
void osc_port_send(struct osc_port *port, const uint8_t *bytes, size_t count);

/* The port that is heard, for tests: 0 is any that is free. */
int osc_port_number(const struct osc_port *port);
long osc_port_dropped(const struct osc_port *port); /* packets of others */

#endif
