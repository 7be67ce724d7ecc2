/* midi_proof.h - how both ends of a TCP connection show that they know the token, and never
 * send it.
 *
 *     client                                   server
 *     hello:     "lutetia-midi 2\nNAME\nNONCE"  ->
 *                                              <-  challenge: "NONCE", another one
 *     proof:     code of "client"               ->      wrong: the connection ends
 *                                              <-  welcome:   "lutetia-midi 2\n", code of
 *                                                  "server"
 *
 * A nonce is 64 random hexadecimal digits. A code is HMAC-SHA-256 by the token, in hexadecimal
 * digits, of the side's name, a line end, and the SHA-256 of the port, a line end, the hello, a
 * line end and the challenge. So no code is of use in another connection, for the other side,
 * or at another port. The client shows first: who only asks a server gets no code to guess
 * tokens by.
 */
#ifndef LUTETIA_MIDI_PROOF_H
#define LUTETIA_MIDI_PROOF_H

#include <sha256.h>

#include <stdbool.h>

#define MIDI_PROOF_GREETING "lutetia-midi 2" /* instead of MIDI_WIRE_GREETING, over TCP */

enum { MIDI_PROOF_DIGITS = 2 * SHA256_BYTES };

/* What both sides have said so far. */
struct midi_proof {
    uint8_t said[SHA256_BYTES];
};

/* 64 digits and a zero. False: the system has no random numbers. */
bool midi_proof_nonce(char nonce[static MIDI_PROOF_DIGITS + 1]);
void midi_proof_begin(struct midi_proof *proof, int port, const char *hello,
                      const char *challenge);
/* side: "client" or "server". */
void midi_proof_code(const struct midi_proof *proof, const char *token, const char *side,
                     char code[static MIDI_PROOF_DIGITS + 1]);
/* Whether `said` is that code; takes as long whatever differs. */
bool midi_proof_right(const struct midi_proof *proof, const char *token, const char *side,
                      const char *said);

#endif
