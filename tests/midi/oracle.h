/* oracle.h - the parser's slow twin: has all bytes at once, and reads real-time messages and
 * the others separately.
 *
 * It takes out the real-time bytes first, each with its place. It cuts the rest at its status
 * bytes and reads each part by itself; a message has the place of its last byte. The places
 * then give the order of all messages. */
#ifndef LUTETIA_TESTS_MIDI_ORACLE_H
#define LUTETIA_TESTS_MIDI_ORACLE_H

#include <midi_parser.h>

#include "taken.h"

/* Parses all bytes; the source is lost at their end. */
void oracle_parse(const uint8_t *bytes, size_t count, struct taken *out,
                  struct midi_parser_counts *counts);

/* Draws bytes that an instrument, a bad cable or an attacker might send. The same seed gives
 * the same bytes. */
void oracle_bytes(uint64_t *seed, uint8_t *bytes, size_t count);

#endif
